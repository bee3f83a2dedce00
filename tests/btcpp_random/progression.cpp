// SPDX-License-Identifier: MIT
#include "btcpp_random/progression.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace btcheck::reference {
namespace {

// Of one question; larger ones are not asked.
constexpr std::size_t kMostSets = 20'000;
constexpr std::size_t kMostLeft = 2'000;
constexpr std::size_t kMostBranches = 200'000;  // of one set

using Set = Obligations::Set;
using Left = Obligations::Left;

// Without those that hold another one.
Left smallest(const Left& left) {
  Left kept;
  for (const Set& set : left) {
    const bool is_needed = std::ranges::none_of(left, [&](const Set& other) {
      return other.size() < set.size() && std::ranges::includes(set, other);
    });
    if (is_needed) kept.insert(set);
  }
  if (kept.size() > kMostLeft) throw std::length_error("many obligations");
  return kept;
}

Left either(const Left& one, const Left& other) {
  Left both = one;
  both.insert(other.begin(), other.end());
  return smallest(both);
}

Left both(const Left& one, const Left& other) {
  Left made;
  for (const Set& left : one) {
    for (const Set& right : other) {
      Set joined = left;
      joined.insert(right.begin(), right.end());
      made.insert(std::move(joined));
    }
  }
  return smallest(made);
}

}  // namespace

Obligations::Obligations() {
  stored({.kind = Kind::Yes, .of = {}});
  stored({.kind = Kind::No, .of = {}});
}

Obligations::Id Obligations::stored(Node node) {
  const auto [place, is_new] =
      numbers_.emplace(std::move(node), static_cast<Id>(nodes_.size()));
  if (is_new) nodes_.push_back(place->first);
  return place->second;
}

Obligations::Id Obligations::literal(Atom atom, bool is_positive) {
  return stored({.kind = Kind::Literal,
                 .atom = atom,
                 .is_positive = is_positive,
                 .of = {}});
}

// With what is inside one of its own kind; `x and (x or y)` is x.
Obligations::Id Obligations::joined(Kind kind, std::vector<Id> of) {
  const Id neutral = kind == Kind::All ? yes() : no();
  const Id decisive = kind == Kind::All ? no() : yes();
  const Kind other = kind == Kind::All ? Kind::Some : Kind::All;
  std::set<Id> parts;
  for (const Id part : of) {
    if (nodes_[part].kind == kind) {
      parts.insert(nodes_[part].of.begin(), nodes_[part].of.end());
    } else {
      parts.insert(part);
    }
  }
  parts.erase(neutral);
  if (parts.contains(decisive)) return decisive;
  std::vector<Id> kept;
  for (const Id part : parts) {
    const Node& node = nodes_[part];
    if (node.kind == Kind::Literal &&
        parts.contains(literal(node.atom, !node.is_positive))) {
      return decisive;
    }
    const bool is_absorbed =
        nodes_[part].kind == other &&
        std::ranges::any_of(nodes_[part].of,
                            [&](Id inner) { return parts.contains(inner); });
    if (!is_absorbed) kept.push_back(part);
  }
  if (kept.empty()) return neutral;
  if (kept.size() == 1) return kept.front();
  return stored({.kind = kind, .of = std::move(kept)});
}

Obligations::Id Obligations::all(std::vector<Id> of) {
  return joined(Kind::All, std::move(of));
}
Obligations::Id Obligations::some(std::vector<Id> of) {
  return joined(Kind::Some, std::move(of));
}
Obligations::Id Obligations::next(Id of) {
  if (of == yes() || of == no()) return of;
  return stored({.kind = Kind::Next, .of = {of}});
}
Obligations::Id Obligations::until(Id left, Id right) {
  if (right == yes() || right == no() || left == no()) return right;
  return stored({.kind = Kind::Until, .of = {left, right}});
}
Obligations::Id Obligations::release(Id left, Id right) {
  if (right == yes() || right == no() || left == yes()) return right;
  return stored({.kind = Kind::Release, .of = {left, right}});
}

Obligations::Id Obligations::negation(Id of) {
  const auto known = negations_.find(of);
  if (known != negations_.end()) return known->second;
  const Node node = nodes_[of];
  std::vector<Id> parts;
  for (const Id part : node.of) parts.push_back(negation(part));
  Id made = no();
  switch (node.kind) {
    case Kind::Yes:
      break;
    case Kind::No:
      made = yes();
      break;
    case Kind::Literal:
      made = literal(node.atom, !node.is_positive);
      break;
    case Kind::All:
      made = some(parts);
      break;
    case Kind::Some:
      made = all(parts);
      break;
    case Kind::Next:
      made = next(parts[0]);
      break;
    case Kind::Until:
      made = release(parts[0], parts[1]);
      break;
    case Kind::Release:
      made = until(parts[0], parts[1]);
      break;
  }
  negations_[of] = made;
  return made;
}

Left Obligations::after(const Left& left,
                        const std::vector<bool>& atoms) const {
  Known known;
  Left made;
  for (const Set& set : left) {
    Left of_all{{}};
    for (const Id formula : set) {
      of_all = both(of_all, after(formula, atoms, known));
    }
    made = either(made, of_all);
  }
  return made;
}

const Left& Obligations::after(Id formula, const std::vector<bool>& atoms,
                               Known& known) const {
  const auto place = known.find(formula);
  if (place != known.end()) return place->second;
  const Node& node = nodes_[formula];
  const auto part = [&](std::size_t i) {
    return after(node.of[i], atoms, known);
  };
  Left made;
  switch (node.kind) {
    case Kind::Yes:
      made = {{}};
      break;
    case Kind::No:
      break;
    case Kind::Literal:
      if (atoms.at(node.atom) == node.is_positive) made = {{}};
      break;
    case Kind::All:
      made = {{}};
      for (std::size_t i = 0; i < node.of.size(); ++i)
        made = both(made, part(i));
      break;
    case Kind::Some:
      for (std::size_t i = 0; i < node.of.size(); ++i) {
        made = either(made, part(i));
      }
      break;
    case Kind::Next:
      made = {{node.of[0]}};
      break;
    case Kind::Until:
      made = either(part(1), both(part(0), {{formula}}));
      break;
    case Kind::Release:
      made = both(part(1), either(part(0), {{formula}}));
      break;
  }
  return known[formula] = std::move(made);
}

// Takes one of those that are still to be met now. Where a choice has been made
// already by another, nothing is to be chosen.
void Obligations::branch(std::vector<Id> todo, Set done, Branch made,
                         std::set<Branch>& found) {
  if (++branches_ > kMostBranches) throw std::length_error("many branches");
  while (!todo.empty()) {
    const Id id = todo.back();
    todo.pop_back();
    if (!done.insert(id).second) continue;
    const Node node = nodes_[id];
    if (node.kind == Kind::No) return;
    if (node.kind == Kind::Literal &&
        done.contains(literal(node.atom, !node.is_positive))) {
      return;
    }
    const auto go = [&](const std::vector<Id>& now, bool is_put_off) {
      std::vector<Id> more = todo;
      more.insert(more.end(), now.begin(), now.end());
      Branch other = made;
      if (is_put_off) other.next.insert(id);
      if (is_put_off && node.kind == Kind::Until) other.put_off.insert(id);
      branch(std::move(more), done, std::move(other), found);
    };
    const auto is_met = [&](Id part) { return done.contains(part); };
    switch (node.kind) {
      case Kind::All:
        todo.insert(todo.end(), node.of.begin(), node.of.end());
        break;
      case Kind::Next:
        made.next.insert(node.of[0]);
        break;
      case Kind::Some:
        if (std::ranges::any_of(node.of, is_met)) break;
        for (const Id part : node.of) go({part}, false);
        return;
      case Kind::Until:
        if (is_met(node.of[1])) break;
        go({node.of[1]}, false);
        return go({node.of[0]}, true);
      case Kind::Release:
        go({node.of[1], node.of[0]}, false);
        return go({node.of[1]}, true);
      default:
        break;
    }
  }
  found.insert(std::move(made));
}

bool Obligations::is_satisfiable(const Left& left) {
  return std::ranges::any_of(
      left, [&](const Set& set) { return is_satisfiable(set); });
}

// Sets of obligations as a graph: some component that is reached and can be
// stayed in puts off none of its untils for ever.
bool Obligations::is_satisfiable(const Set& of) {
  const auto known = satisfiable_.find(of);
  if (known != satisfiable_.end()) return known->second;
  struct Step {
    std::size_t target = 0;
    Set put_off;
  };
  std::map<Set, std::size_t> numbers;
  std::vector<Set> sets;
  std::vector<std::vector<Step>> steps;
  const auto number = [&](const Set& set) {
    const auto [place, is_new] = numbers.emplace(set, sets.size());
    if (is_new) sets.push_back(set);
    return place->second;
  };
  number(of);
  for (std::size_t i = 0; i < sets.size(); ++i) {
    if (sets.size() > kMostSets) throw std::length_error("many obligations");
    std::set<Branch> found;
    branches_ = 0;
    branch({sets[i].begin(), sets[i].end()}, {}, {}, found);
    steps.emplace_back();
    for (const Branch& each : found) {
      const std::size_t target = number(each.next);
      steps[i].push_back({target, each.put_off});
    }
  }
  // Where each can go, and back: by finishing times, as components are found.
  std::vector<std::vector<std::size_t>> back(sets.size());
  for (std::size_t i = 0; i < sets.size(); ++i) {
    for (const Step& step : steps[i]) back[step.target].push_back(i);
  }
  std::vector<std::size_t> order;
  std::vector<bool> seen(sets.size());
  std::vector<std::pair<std::size_t, std::size_t>> path;
  for (std::size_t first = 0; first < sets.size(); ++first) {
    if (seen[first]) continue;
    seen[first] = true;
    path.push_back({first, 0});
    while (!path.empty()) {
      auto& [at, edge] = path.back();
      if (edge == steps[at].size()) {
        order.push_back(at);
        path.pop_back();
        continue;
      }
      const std::size_t target = steps[at][edge++].target;
      if (seen[target]) continue;
      seen[target] = true;
      path.push_back({target, 0});
    }
  }
  std::vector<std::size_t> component(sets.size(), sets.size());
  bool is_found = false;
  for (auto root = order.rbegin(); root != order.rend() && !is_found; ++root) {
    if (component[*root] != sets.size()) continue;
    std::vector<std::size_t> members{*root};
    component[*root] = *root;
    for (std::size_t i = 0; i < members.size(); ++i) {
      for (const std::size_t from : back[members[i]]) {
        if (component[from] != sets.size()) continue;
        component[from] = *root;
        members.push_back(from);
      }
    }
    bool has_step = false;
    Set always_put_off;
    for (const std::size_t member : members) {
      for (const Step& step : steps[member]) {
        if (component[step.target] != *root) continue;
        if (!has_step) {
          always_put_off = step.put_off;
        } else {
          std::erase_if(always_put_off, [&](Id until) {
            return !step.put_off.contains(until);
          });
        }
        has_step = true;
      }
    }
    is_found = has_step && always_put_off.empty();
  }
  return satisfiable_[of] = is_found;
}

}  // namespace btcheck::reference
