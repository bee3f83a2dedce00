// SPDX-License-Identifier: MIT
//
// Rules about arguments of nodes against their definition, on random trees.
//
// The network of the tree knows nothing of arguments. Beside each of its
// states, written out naively, stands the value that a node has been given: it
// is evaluated when the node is ticked and does not run, and forgotten when it
// gives control back and does not run. Every verdict must be as on these pairs,
// with whatever reduction, and the states as many as them.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "check/check.hpp"
#include "explore/search/reachability.hpp"
#include "model/lowering.hpp"
#include "reference/effort.hpp"
#include "reference/naive_network.hpp"
#include "reference/random_tree.hpp"

namespace btcheck::reference::argument_cross_check_test {
namespace {

constexpr std::size_t kMostStates = 2000;
constexpr TickSemantics kTicks[] = {TickSemantics::Root, TickSemantics::Leaves,
                                    TickSemantics::Nodes, TickSemantics::None};

using Given = std::optional<std::int64_t>;
using Pair = std::pair<NaiveState, Given>;

// The values that one argument of a node is given.
class NaiveArgument {
 public:
  NaiveArgument(const BehaviorTree& tree, const Network& network, NodeId node)
      : naive_(network),
        network_(network),
        node_(node),
        value_(tree.node(node).arguments[0].known->value) {}

  // Nothing when there are more than so many pairs.
  std::optional<std::vector<Pair>> pairs(std::size_t most) const {
    std::map<Pair, bool> seen = {{{naive_.initial(), {}}, true}};
    std::vector<Pair> found = {{naive_.initial(), {}}};
    for (std::size_t at = 0; at < found.size(); ++at) {
      if (found.size() > most) return std::nullopt;
      const Pair here = found[at];
      const auto add = [&](Pair next) {
        if (seen.emplace(next, true).second) found.push_back(std::move(next));
      };
      for (const std::uint32_t edge : naive_.enabled(here.first)) {
        add(after(here, edge));
      }
      if (naive_.may_wait(here.first)) {
        add({naive_.waited(here.first), here.second});
      }
    }
    return found;
  }

  bool is_at(const NaiveState& state, LocationRole role) const {
    const Automaton& automaton = network_.automaton(node_);
    const auto location = automaton.find_location(role);
    return location && state.value(automaton.location) ==
                           static_cast<int>(index(*location));
  }

 private:
  bool runs(const NaiveState& state) const {
    return state.value(network_.node_status[index(node_)]) ==
           static_cast<int>(NodeStatus::Running);
  }

  Pair after(const Pair& here, std::uint32_t number) const {
    const Automaton& mover = network_.owner_of_edge(number);
    const Edge& edge = network_.edge(number);
    Pair next = {naive_.after(here.first, mover, edge), here.second};
    if (mover.kind != AutomatonKind::Node || mover.node != node_) return next;
    if (mover.target(edge).role == LocationRole::Tick && !runs(here.first)) {
      next.second = evaluated(here.first);
    }
    if (mover.target(edge).role == LocationRole::Start && !runs(next.first)) {
      next.second.reset();
    }
    return next;
  }

  std::int64_t evaluated(const NaiveState& state) const {
    return value_.evaluate([&](const Term& term) -> std::int64_t {
      return state.value(term.operation == Operation::Status
                             ? network_.node_status[term.operand]
                             : network_.state_variable[term.operand]);
    });
  }

  NaiveNetwork naive_;
  const Network& network_;
  NodeId node_;
  Expression value_;
};

// A rule, and whether it holds on the pairs.
struct AskedRule {
  std::string text;
  bool holds = true;
};

// Gives one leaf of the tree an argument `z`; "" where there is nothing to make
// it of.
std::string with_argument(const std::string& text, SplitMix64& random) {
  SExpression file = parse_s_expression(text);
  std::vector<std::string> numbers;
  for (const SExpression& form : file.list) {
    if (form.list.size() < 2 || form.list[0].word != "defsv") continue;
    for (const SExpression& each : form.list) {
      if (each.word == ":max") numbers.push_back(form.list[1].word);
    }
  }
  std::vector<SExpression*> leaves;
  std::vector<SExpression*> open;
  for (SExpression& form : file.list) {
    if (!form.list.empty() && form.list[0].word == "BehaviorTree") {
      open.push_back(&form);
    }
  }
  while (!open.empty()) {
    SExpression& form = *open.back();
    open.pop_back();
    const std::string& type = form.list[0].word;
    if (type == "Eval") continue;
    if (type == "Action" || type == "Condition" || type == "SetSV") {
      leaves.push_back(&form);
    }
    for (SExpression& item : form.list) {
      if (!item.list.empty() && !item.list[0].list.empty()) continue;
      if (!item.list.empty() && item.list[0].word[0] >= 'A' &&
          item.list[0].word[0] <= 'Z') {
        open.push_back(&item);
      }
    }
  }
  if (numbers.empty() || leaves.empty()) return {};
  const auto any = [&](int count) {
    return static_cast<std::size_t>(random.below(count));
  };
  const std::string& v = numbers[any(static_cast<int>(numbers.size()))];
  const std::string& w = numbers[any(static_cast<int>(numbers.size()))];
  const int k = 1 + random.below(3);
  const std::vector<std::string> values = {
      fmt::format("${}", v),
      fmt::format("(* {} ${})", k, v),
      fmt::format("(- {} {})", k, v),
      fmt::format("(+ {} ${} {})", v, w, k),
      fmt::format("(mod (+ {} {}) 2)", v, k),
      fmt::format("(/ 6 ${})", v)};
  const std::string& value = values[any(static_cast<int>(values.size()))];
  SExpression& leaf = *leaves[any(static_cast<int>(leaves.size()))];
  const SExpression extra =
      parse_s_expression(fmt::format("(:args (z {}))", value));
  leaf.list.insert(leaf.list.end(), extra.list.begin(), extra.list.end());
  return print_s_expression(file);
}

std::vector<AskedRule> rules_of(const BehaviorTree& tree,
                                const Network& network, NodeId node,
                                const NaiveArgument& argument,
                                const std::vector<Pair>& pairs,
                                SplitMix64& random) {
  const ArgumentValue& known = *tree.node(node).arguments[0].known;
  const std::string z = unique_name(tree, node) + ".z";
  const std::string name = unique_name(tree, node);
  const int c = known.min - 1 + random.below(known.max - known.min + 3);
  const StateVariableId v{static_cast<std::uint32_t>(
      random.below(static_cast<int>(tree.variables.size())))};
  const StateVariable& other = tree.variable(v);
  const int d = other.min + random.below(other.max - other.min + 1);
  const std::string is_d =
      fmt::format("{} == {}", other.name, other.value_name(d));
  const auto has = [&](const auto& what) {
    return std::ranges::any_of(pairs, [&](const Pair& pair) {
      const bool is_other =
          pair.first.value(network.state_variable[index(v)]) == d;
      return what(pair.first, pair.second, is_other);
    });
  };
  const bool above = has([&](const NaiveState&, Given given, bool) {
    return given && *given > c;
  });
  const bool equal = has([&](const NaiveState&, Given given, bool) {
    return given && *given == c;
  });
  return {{fmt::format("never {} > {}", z, c), !above},
          {fmt::format("always {} <= {}", z, c), !above},
          {fmt::format("[] {} <= {}", z, c), !above},
          {fmt::format("never not {} <= {}", z, c), !above},
          {fmt::format("always not {} == {}", z, c), !equal},
          {fmt::format("possible {} == {}", z, c), equal},
          {fmt::format("possible {}.running and {} == {}", name, z, c),
           has([&](const NaiveState& state, Given given, bool) {
             return argument.is_at(state, LocationRole::Running) && given == c;
           })},
          {fmt::format("[] ({}.ticked => {} <= {})", name, z, c),
           !has([&](const NaiveState& state, Given given, bool) {
             return argument.is_at(state, LocationRole::Tick) &&
                    !(given && *given <= c);
           })},
          {fmt::format("never ({} == {} and {})", z, c, is_d),
           !has([&](const NaiveState&, Given given, bool is_other) {
             return given == c && is_other;
           })},
          {fmt::format("always ({} <= {} or {})", z, c, is_d),
           !has([&](const NaiveState&, Given given, bool is_other) {
             return given && *given > c && !is_other;
           })},
          {fmt::format("always ({} => {} <= {})", is_d, z, c),
           !has([&](const NaiveState&, Given given, bool is_other) {
             return given && *given > c && is_other;
           })}};
}

struct Census {
  int trees = 0;
  int rules = 0;
  int broken = 0;
};

// What is wrong, "" for nothing.
std::string flaw_of(const std::string& text, const std::string& rules,
                    const std::vector<AskedRule>& asked, std::size_t pairs,
                    TickSemantics ticks, Reduction reduction) {
  CheckOptions options;
  options.ticks = ticks;
  options.choices.reduction = reduction;
  const CheckResult result =
      check({"random.btf", text}, {{"random.ltl", rules}}, options);
  if (result.files.empty()) {
    return "refused\n" + render(result.diagnostics.at(0));
  }
  const CheckedFile& file = result.files[0];
  for (std::size_t i = 0; i < asked.size(); ++i) {
    const PropertyVerdict& found = file.verdicts.at(i);
    const Verdict wanted = asked[i].holds ? Verdict::Holds : Verdict::Violated;
    if (found.error.empty() && found.verdict == wanted) continue;
    return fmt::format("{}: {} expected, found {} {}", asked[i].text,
                       asked[i].holds, static_cast<int>(found.verdict),
                       found.error);
  }
  const CompiledNetwork system(*file.network);
  ReachabilityVisitor visitor;
  BreadthFirst search(system, Limits{});
  const std::uint64_t states = search.run(visitor).progress.states;
  if (states == pairs) return {};
  return fmt::format("{} states, {} pairs", states, pairs);
}

void check_tree(const std::string& text, std::uint64_t seed, Census& census) {
  SplitMix64 random(seed);
  const std::string full = with_argument(text, random);
  if (full.empty()) return;
  const auto read = read_btf("random.btf", full);
  INFO(full);
  REQUIRE(read.value.has_value());
  const BehaviorTree& tree = *read.value;
  NodeId node{};
  for (std::uint32_t n = 0; n < tree.nodes.size(); ++n) {
    if (!tree.nodes[n].arguments.empty() &&
        tree.nodes[n].arguments[0].key == "z") {
      node = NodeId{n};
    }
  }
  const TickSemantics ticks = kTicks[seed % 4];
  const Network network = lower(tree, ticks);
  const NaiveArgument argument(tree, network, node);
  const auto pairs = argument.pairs(kMostStates);
  if (!pairs) return;
  const auto asked = rules_of(tree, network, node, argument, *pairs, random);
  std::string rules;
  for (std::size_t i = 0; i < asked.size(); ++i) {
    rules += fmt::format("property p{}: {}\n", i, asked[i].text);
    census.broken += !asked[i].holds;
  }
  ++census.trees;
  census.rules += static_cast<int>(asked.size());
  INFO(rules, "tick ", tick_name(ticks));
  for (const Reduction reduction :
       {Reduction::None, Reduction::Live, Reduction::Full}) {
    const std::string wrong =
        flaw_of(full, rules, asked, pairs->size(), ticks, reduction);
    INFO("reduction ", static_cast<int>(reduction));
    REQUIRE(wrong == "");
  }
}

}  // namespace

TEST_CASE("rules about arguments mean what their definition says") {
  RandomTreeWeights weights;
  weights.max_nodes = 8;
  weights.contract = 40;
  weights.looping_root = 70;
  const std::uint64_t first = shifted_seed(83) * std::uint64_t{1'000'000};
  Census census;
  for (int i = 0; i < by_effort(400, 4000); ++i) {
    const std::uint64_t seed = first + static_cast<std::uint64_t>(i);
    check_tree(random_tree(seed, weights), seed, census);
  }
  MESSAGE(census.trees, " trees, ", census.rules, " rules, ", census.broken,
          " of them broken");
  CHECK_COVERED(census.trees > 100);
  CHECK_COVERED(census.broken > census.rules / 6);
}

}  // namespace btcheck::reference::argument_cross_check_test
