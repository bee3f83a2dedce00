// SPDX-License-Identifier: MIT
#include "btcpp_random/random_rules.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <vector>

#include "model/tree/node_types.hpp"
#include "reference/random_tree.hpp"

namespace btcheck::reference {
namespace {

using Words = std::vector<std::string_view>;

class RuleWriter {
 public:
  RuleWriter(std::uint64_t seed, const BehaviorTree& tree)
      : random_(seed), tree_(tree) {
    for (const StateVariable& variable : tree.variables) {
      if (variable.is_enumeration()) entries_.push_back(&variable);
    }
  }

  std::string rule() {
    switch (random_.below(16)) {
      case 0:
      case 1:
        return "never " + condition();
      case 2:
        return "always " + condition();
      case 3:
        return "possible " + condition();
      case 4:
      case 5:
        return fmt::format(
            "{} {}", one_of({"every tick:", "in no tick:", "in some tick:"}),
            condition());
      case 6:
        return fmt::format("whenever {} then {}", condition(), condition());
      case 7:
        return fmt::format("{} {} {}", condition(),
                           one_of({"precedes", "forbids", "requires"}),
                           condition());
      case 8:
        return in_scope();
      case 9:
      case 10:
      case 11:
        return timed();
      default:
        return temporal(2 + random_.below(2));
    }
  }

 private:
  std::string one_of(const Words& words) {
    return std::string(words[static_cast<std::size_t>(
        random_.below(static_cast<int>(words.size())))]);
  }

  // Two nodes of one name have the same subtree twice above them.
  std::string node() {
    const auto number = static_cast<std::uint32_t>(
        random_.below(static_cast<int>(tree_.nodes.size())));
    if (number == 0) return "root";
    const std::string& name = tree_.nodes[number].name;
    const auto alike = std::ranges::count(
        tree_.nodes, name, [](const Node& each) { return each.name; });
    return alike == 1 && !random_.percent(10) ? name
                                              : fmt::format("btn{}", number);
  }

  std::string about_node() {
    const std::string of = node();
    const bool is_root = of == "root";
    switch (random_.below(10)) {
      case 0:
        return fmt::format("{}.status {} {}", of,
                           random_.percent(70) ? "==" : "!=",
                           one_of({"success", "failure", "running", "idle"}));
      case 1:
      case 2:
        return fmt::format(
            "{}.answer {} {}", of, random_.percent(70) ? "==" : "!=",
            one_of({"success", "failure", "running", "skipped", "none"}));
      case 3:
        return fmt::format("{}.answered {}", of,
                           one_of({"success", "failure", "running"}));
      default:
        break;
    }
    return fmt::format(
        "{}.{}", of,
        is_root ? one_of({"ticked", "success", "failure", "running", "ended",
                          "skipped"})
                : one_of({"ticked", "success", "failure", "running", "halted",
                          "skipped", "done", "active", "ticked", "success"}));
  }

  std::string about_entry() {
    const StateVariable& entry = *entries_[static_cast<std::size_t>(
        random_.below(static_cast<int>(entries_.size())))];
    const bool has_numbers = std::ranges::any_of(
        entry.values,
        [](const EntryValue& value) { return value.numbers.has_value(); });
    // `f` may stand for an operator.
    const std::string name =
        entry.name.size() == 1 ? '"' + entry.name + '"' : entry.name;
    const std::string is = random_.percent(70) ? "==" : "!=";
    if (has_numbers && random_.percent(85)) {
      if (random_.percent(15)) {
        return fmt::format("{} {} {}", name, is, one_of({"true", "false"}));
      }
      if (random_.percent(10)) {
        const int low = random_.below(4) - 1;
        return fmt::format("{} in {}..{}", name, low, low + random_.below(3));
      }
      return fmt::format("{} {} {}", name,
                         one_of({"==", "!=", "<", "<=", ">", ">="}),
                         random_.below(6) - 2);
    }
    std::vector<std::string_view> words;
    for (const std::string& state : entry.states) {
      if (is_word(state)) words.push_back(state);
    }
    if (words.empty()) return about_node();
    return fmt::format("{} {} {}", name, is, one_of(words));
  }
  // No keyword or number, and nothing that stands for several values.
  static bool is_word(std::string_view state) {
    if (state == "unknown" || state == "any" || state == "f") return false;
    return state[0] >= 'a' && state[0] <= 'z' &&
           std::ranges::none_of(state, [](char c) { return c == ' '; });
  }

  std::string atom() {
    if (random_.percent(4)) return "tick.ends";
    if (!entries_.empty() && random_.percent(30)) return about_entry();
    return about_node();
  }

  // On single states.
  std::string condition() { return condition(random_.below(3)); }
  std::string condition(int depth) {
    if (depth == 0) return atom();
    const auto inner = [&] { return condition(depth - 1); };
    switch (random_.below(8)) {
      case 0:
        return fmt::format("not ({})", inner());
      case 1:
        return fmt::format("once ({})", inner());
      case 2:
        return fmt::format("previously ({})", inner());
      case 3:
        return fmt::format("(({}) since ({}))", inner(), inner());
      case 4:
        return fmt::format("({} => {})", inner(), inner());
      case 5:
        return fmt::format("({} or {})", inner(), inner());
      default:
        return fmt::format("({} and {})", inner(), inner());
    }
  }

  std::string formula(int depth) {
    if (depth == 0) return condition(random_.percent(25) ? 1 : 0);
    if (random_.percent(65)) return temporal(depth);
    if (random_.percent(20)) {
      return fmt::format("(not {})", formula(depth - 1));
    }
    return fmt::format("({} {} {})", formula(depth - 1),
                       one_of({"and", "or", "=>", "<=>"}), formula(depth - 1));
  }
  std::string temporal(int depth) {
    const auto inner = [&] {
      return formula(random_.percent(30) ? 0 : depth - 1);
    };
    if (random_.percent(45)) {
      return fmt::format("({} {})", one_of({"<>", "[]"}), inner());
    }
    return fmt::format("({} {} {})", inner(), one_of({"U", "W", "R"}), inner());
  }

  std::string in_scope() {
    const std::string p = condition();
    const std::string claim =
        random_.percent(40)
            ? fmt::format("({}) {} ({})", p, one_of({"leadsto", "precedes"}),
                          atom())
            : fmt::format("{} ({})", one_of({"absent", "always", "present"}),
                          p);
    switch (random_.below(4)) {
      case 0:
        return fmt::format("{} before ({})", claim, atom());
      case 1:
        return fmt::format("{} after ({})", claim, atom());
      case 2:
        return fmt::format("{} between ({}) and ({})", claim, atom(), atom());
      default:
        return fmt::format("{} after ({}) until ({})", claim, atom(), atom());
    }
  }

  std::string interval() {
    const int from = random_.below(3);
    const int to = from + random_.below(3);
    if (random_.percent(15)) return fmt::format("[{},...[", from);
    return fmt::format("[{},{}]", from, to);
  }

  std::string timed() {
    const std::string p = condition();
    const std::string q = condition();
    switch (random_.below(10)) {
      case 0:
      case 1:
        return fmt::format("whenever ({}) then ({}) within {} ticks", p, q,
                           random_.below(4));
      case 2:
        return fmt::format("({}) leadsto ({}) within {}", p, q, interval());
      case 3:
        return fmt::format("({}) leadsto first ({}) within {}", p, q,
                           interval());
      case 4:
        return fmt::format("({}) forbids ({}) within {}", p, q, interval());
      case 5:
        return fmt::format("present ({}) after ({}) within {}", p, q,
                           interval());
      case 6:
        return fmt::format("absent ({}) after ({}) for {}", p, q,
                           1 + random_.below(4));
      case 7:
        return fmt::format("present ({}) lasting {}", p, 1 + random_.below(3));
      case 8:
        return fmt::format("({}) leadsto ({}) within {} before ({})", p, q,
                           interval(), atom());
      default:
        return fmt::format("absent ({}) before ({}) for {}", p, q,
                           1 + random_.below(3));
    }
  }

  SplitMix64 random_;
  const BehaviorTree& tree_;
  std::vector<const StateVariable*> entries_;
};

}  // namespace

std::string random_rules(std::uint64_t seed, const BehaviorTree& tree,
                         int count) {
  RuleWriter writer(seed, tree);
  std::string text;
  for (int i = 1; i <= count; ++i) {
    text += fmt::format("property r{}: {}\n", i, writer.rule());
  }
  return text;
}

}  // namespace btcheck::reference
