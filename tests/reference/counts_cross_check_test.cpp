// SPDX-License-Identifier: MIT
//
// `--any-count` against trying: random trees of .btf, BehaviorTree.CPP and Nav2
// that count, and some of py_trees, under every tick semantics, with random
// rules. Each "for every number from k on" is asked of the tree with k, k + 1,
// … written into its text, to three beyond the greater of k and its own number.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "check/check.hpp"
#include "explore/reduce/counters.hpp"
#include "model/lowering.hpp"
#include "model/tree/node_types.hpp"
#include "reference/effort.hpp"
#include "reference/naive_network.hpp"
#include "reference/random_property.hpp"
#include "reference/random_tree.hpp"
#include "reference/random_xml_tree.hpp"

namespace btcheck::reference::counts_cross_check_test {
namespace {

constexpr TickSemantics kAllTicks[] = {
    TickSemantics::Root, TickSemantics::Leaves, TickSemantics::Nodes,
    TickSemantics::None};
constexpr Profile kProfiles[] = {Profile::Btcpp4, Profile::Btcpp38,
                                 Profile::Nav2Humble, Profile::Nav2Jazzy,
                                 Profile::Nav2Main};
constexpr std::uint64_t kMostStates = 2000;
constexpr int kRules = 4;

// The words of .btf and XML that a number follows.
constexpr std::array kAttributes = {":repeat ",        ":num_attempts ",
                                    ":num_retries ",   "num_cycles=\"",
                                    "num_attempts=\"", "number_of_retries=\"",
                                    "num_success=\"",  "num_failures=\""};

// What stands in the root of a tree of py_trees.
constexpr std::array kPyTrees = {
    R"(<Retry name="r" num_failures="2"><Action name="a" ID="A"/></Retry>)",
    R"(<Repeat name="r" num_success="3"><Sequence name="s" memory="true">
       <Condition name="c" ID="C"/><Action name="a" ID="A"/></Sequence>
       </Repeat>)",
    R"(<Selector name="s" memory="false"><Condition name="c" ID="C"/>
       <Retry name="r" num_failures="3"><Action name="a" ID="A"/></Retry>
       </Selector>)",
    R"(<Repeat name="q" num_success="2"><Retry name="r" num_failures="2">
       <Action name="a" ID="A"/></Retry></Repeat>)"};

struct Census {
  int trees = 0;    // that count
  int telling = 0;  // of which something was told
  int claims = 0;
  int found = 0;       // of these, of rules against which there is a run
  int beyond_one = 0;  // that begin later than with the least number
  int open = 0;
  int checked = 0;  // numbers that were tried
  std::map<std::string, int> reasons;
  std::map<std::string_view, int> profiles;
};

// Where the number of a node is written, from where the node stands.
std::size_t number_at(const std::string& text, const SourceSpan& node) {
  std::size_t at = 0;
  for (int line = 1; line < node.line; ++line) at = text.find('\n', at) + 1;
  std::size_t first = text.npos;
  for (const std::string_view attribute : kAttributes) {
    const std::size_t found =
        text.find(attribute, at + static_cast<std::size_t>(node.column - 1));
    if (found != text.npos) first = std::min(first, found + attribute.size());
  }
  REQUIRE(first != text.npos);
  return first;
}

std::string with_number(std::string text, const SourceSpan& node, int number) {
  const std::size_t begin = number_at(text, node);
  std::size_t end = begin;
  while (end < text.size() && std::isdigit(text[end]) != 0) ++end;
  return text.replace(begin, end - begin, std::to_string(number));
}

struct Case {
  std::string name;
  std::string text;
  TreeReading reading;
  std::string rules;
  CheckOptions how;

  CheckResult checked(const std::string& tree) const {
    return check(TreeInput({name, FileText(tree)}, reading),
                 {{"r.ltl", FileText(rules)}}, how);
  }
};

bool counts(const Node& node) {
  return node.repetitions > 0 &&
         (node.type == NodeType::Repeat || node.type == NodeType::Recovery ||
          node.type == NodeType::RetryUntilSuccessful);
}

// "the child answers so three times": <> (c.ticked and <> (c.failure and …)).
std::string answers_often(const std::string& child, std::string_view answer,
                          int times, std::string text = "true") {
  for (int i = 0; i < times; ++i) {
    text = fmt::format("<> ({0}.ticked and <> ({0}.{1} and {2}))", child,
                       answer, text);
  }
  return text;
}

// Rules whose verdict hangs on how many rounds a node goes.
std::string counting_rules(const BehaviorTree& tree, TickSemantics ticks,
                           SplitMix64& random) {
  std::string text;
  for (std::uint32_t n = 0; n < tree.nodes.size(); ++n) {
    const Node& node = tree.nodes[n];
    if (!counts(node)) continue;
    const std::string child = unique_name(
        tree, node.children[static_cast<std::size_t>(
                  random.below(static_cast<int>(node.children.size())))]);
    const std::string answer = random.percent(50) ? "failure" : "success";
    const int times = 1 + random.below(4);
    text += fmt::format("property n{} : ltl {}{}\n", n,
                        random.percent(70) ? "not " : "",
                        answers_often(child, answer, times));
    text += fmt::format("property e{} : ltl [] ({}.ticked => {})\n", n,
                        unique_name(tree, NodeId{n}),
                        answers_often(child, answer, 1 + times / 2));
    // It comes to rest behind so many rounds.
    text +=
        fmt::format("property r{} : ltl not {}\n", n,
                    answers_often(child, answer, times, "[] not root.ended"));
    if (ticks == TickSemantics::None) continue;
    text += fmt::format(
        "property t{} : {}.ticked leadsto root.ended within {}"
        " ticks\n",
        n, child, random.below(7));
  }
  return text;
}

// Random atoms may name what only trees of .btf have.
bool can_be_bound(const BehaviorTree& tree, const Network& network,
                  const std::string& text) {
  const auto file = read_properties("r.ltl", text);
  return file.value &&
         bind_properties(tree, network, *file.value, {"r.ltl", text}, {})
             .value.has_value();
}

std::string random_rules(const BehaviorTree& tree, TickSemantics ticks,
                         SplitMix64& random) {
  const Network network = lower(tree, ticks);
  PropertyWeights weights;
  weights.most_temporal = 3;
  weights.response = weights.timed = ticks != TickSemantics::None;
  weights.branching = false;
  const SplitMix64 stream(random.next());
  const bool assumes = random.percent(35);
  std::string text;
  for (int i = 0; i < kRules; ++i) {
    RandomProperty rule = random_property(tree, network, random, weights);
    if (assumes) assume_something(rule, tree, network, stream);
    const bool has_text = !rule.assumption.by_option;
    const std::string assumed = has_text ? rule.assumption.text : "";
    if (i == 0 && can_be_bound(tree, network, assumed)) text = assumed;
    const std::string line = fmt::format("property p{} : {}\n", i, rule.body);
    if (can_be_bound(tree, network, line)) text += line;
  }
  return text + counting_rules(tree, ticks, random) +
         "property fails : never root.failure\n"
         "property ends : eventually root.ended\n"
         "property can : possible root.success\n"
         "property again : [] <> tick\n";
}

// The claims of a case, each tried; "" when all are right.
std::string flaw_of(const Case& one, Census& census) {
  Case asks = one;
  asks.how.any_count = true;
  const CheckResult result = asks.checked(one.text);
  if (result.files.empty()) return {};
  const CheckedFile& file = result.files.front();
  REQUIRE(file.counts.size() == file.verdicts.size());
  ++census.trees;
  ++census.profiles[profile_name(result.tree->profile)];
  bool tells = false;
  std::map<std::pair<NodeId, int>, std::vector<Verdict>> known;
  for (std::size_t i = 0; i < file.verdicts.size(); ++i) {
    for (const CountClaim& claim : file.counts[i]) {
      if (!claim.from) {
        ++census.open;
        ++census.reasons[claim.open];
        continue;
      }
      const Node& node = result.tree->node(claim.node);
      tells = true;
      ++census.claims;
      const bool is_least =
          *claim.from <= (node.type == NodeType::Recovery ? 0 : 1);
      census.beyond_one += is_least ? 0 : 1;
      const bool wants_run =
          file.verdicts[i].property->form == PropertyForm::Possible;
      census.found +=
          (file.verdicts[i].verdict == Verdict::Holds) == wants_run ? 1 : 0;
      if (*claim.from > node.repetitions)
        return "its own number is not told of";
      const int most = node.repetitions + 3;
      for (int number = *claim.from; number <= most; ++number) {
        auto& verdicts = known[{claim.node, number}];
        if (verdicts.empty()) {
          const CheckResult other =
              one.checked(with_number(one.text, node.span, number));
          if (other.files.empty()) return "cannot be read with another number";
          for (const PropertyVerdict& verdict : other.files[0].verdicts) {
            verdicts.push_back(verdict.verdict);
          }
        }
        if (verdicts[i] == Verdict::Undecided) continue;
        ++census.checked;
        if (verdicts[i] == file.verdicts[i].verdict) continue;
        return fmt::format(
            "{} is {} for every {} >= {} at line {}, but not {}",
            file.verdicts[i].property->name,
            file.verdicts[i].verdict == Verdict::Holds ? "told to hold"
                                                       : "told to be violated",
            claim.attribute, *claim.from, node.span.line, number);
      }
    }
  }
  census.telling += tells ? 1 : 0;
  return {};
}

// The text of a random tree that counts, to a number of up to five.
Case random_case(std::uint64_t seed) {
  SplitMix64 random(seed);
  while (true) {
    Case made;
    made.how.limits.max_states = kMostStates;
    made.how.choices.tells_more = false;
    made.how.ticks = kAllTicks[random.below(4)];
    if (random.percent(25)) {
      RandomTreeWeights weights;
      if (random.percent(30)) weights = timed_weather();
      if (random.percent(30)) weights.looping_root = 90;
      made.name = "t.btf";
      made.text = random_tree(random.next(), weights);
    } else if (random.percent(4)) {
      made.name = "t.xml";
      made.text = fmt::format(
          "<root BTCPP_format=\"4\" py_trees=\"2.2.3\"><BehaviorTree "
          "ID=\"Main\">"
          "\n{}\n</BehaviorTree></root>",
          kPyTrees[static_cast<std::size_t>(random.below(kPyTrees.size()))]);
      made.reading.loops = random.percent(50);
    } else {
      made.name = "t.xml";
      made.reading.profile = kProfiles[random.below(5)];
      made.reading.loops = random.percent(50);
      made.text = random_xml_tree(random.next(), *made.reading.profile);
      // In rules `T` is an operator.
      made.text.replace(made.text.find("\"T\""), 3, "\"Main\"");
    }
    const auto tree = read_tree(made.name, FileText(made.text), made.reading);
    if (!tree.value || !std::ranges::any_of(tree.value->nodes, counts)) {
      continue;
    }
    for (const Node& node : tree.value->nodes) {
      if (!counts(node) || !random.percent(40)) continue;
      made.text = with_number(made.text, node.span, 1 + random.below(5));
      break;
    }
    const auto changed =
        read_tree(made.name, FileText(made.text), made.reading);
    if (!changed.value) continue;
    made.rules = random_rules(*changed.value, *made.how.ticks, random);
    return made;
  }
}

// States without the local that was added last, what leads from each where, by
// which automaton, and whether each is dead.
struct OpenSpace {
  using Arc = std::pair<std::optional<std::size_t>, NaiveState>;
  std::map<NaiveState, std::set<Arc>> arcs;
  std::map<NaiveState, bool> dead;
};

std::optional<std::size_t> mover_of(const Network& network,
                                    const NaiveSpace::Step& step) {
  if (!step.edge) return std::nullopt;
  return static_cast<std::size_t>(&network.owner_of_edge(*step.edge) -
                                  network.automata.data());
}

std::optional<OpenSpace> open_space(const Network& network) {
  const auto space = naive_space(network, kMostStates);
  if (!space) return std::nullopt;
  std::vector<NaiveState> states = space->states;
  for (NaiveState& state : states) state.values.pop_back();
  OpenSpace open;
  for (std::size_t s = 0; s < states.size(); ++s) {
    const auto [at, is_new] = open.dead.emplace(states[s], space->dead[s]);
    // What is remembered of uncounted rounds changes nothing.
    REQUIRE((is_new || at->second == space->dead[s]));
    for (const NaiveSpace::Step& step : space->steps[s]) {
      open.arcs[states[s]].emplace(mover_of(network, step),
                                   states[step.target]);
    }
  }
  return open;
}

// Whether the map of docs/reductions.md takes every step of the network into
// one of the open network, and dead states into dead ones; "" or what is wrong.
std::string simulation_flaw(const Network& network, VariableId counter,
                            int least, const OpenSpace& open) {
  const auto space = naive_space(network, kMostStates);
  if (!space) return {};
  const int more = network.variable(counter).max - least;
  const auto image = [&](std::size_t s) {
    NaiveState state = space->states[s];
    int& count = state.values[index(counter)];
    count = std::max(0, count - more);
    return state;
  };
  for (std::size_t s = 0; s < space->states.size(); ++s) {
    const NaiveState from = image(s);
    const auto at = open.dead.find(from);
    if (at == open.dead.end()) return "a state has no image";
    if (at->second != space->dead[s]) return "an image is dead, or is not";
    if (space->steps[s].empty()) continue;
    const auto arcs = open.arcs.find(from);
    for (const NaiveSpace::Step& step : space->steps[s]) {
      if (arcs == open.arcs.end() ||
          !arcs->second.contains(
              {mover_of(network, step), image(step.target)})) {
        return "a step has no image";
      }
    }
  }
  return {};
}

Network with_rounds(BehaviorTree tree, NodeId node, int number,
                    TickSemantics ticks) {
  tree.nodes[index(node)].repetitions = number;
  return lower(tree, ticks);
}

// Of each node that counts; how many networks were compared.
int compare_networks(const Case& one) {
  const auto tree = read_tree(one.name, FileText(one.text), one.reading);
  REQUIRE(tree.value);
  int compared = 0;
  for (std::uint32_t n = 0; n < tree.value->nodes.size(); ++n) {
    const NodeId node{n};
    if (!counts(tree.value->nodes[n])) continue;
    const auto lowered = [&](int number) {
      return with_rounds(*tree.value, node, number, *one.how.ticks);
    };
    const Network large = lowered(5);
    const auto counter = round_counter(large, node);
    REQUIRE(counter);
    const int offset = 5 - large.variable(counter->variable).max;
    for (int least = 1; least <= 3; ++least) {
      Network opened = lowered(least + offset);
      const auto own = round_counter(opened, node);
      REQUIRE(own);
      leave_rounds_open(*own, opened);
      const auto open = open_space(opened);
      if (!open) continue;
      for (int last = least; last <= least + 3; ++last) {
        const std::string wrong = simulation_flaw(lowered(last + offset),
                                                  own->variable, least, *open);
        ++compared;
        if (!wrong.empty()) {
          FAIL("last value ", last, ", left open from ", least, ": ", wrong,
               "\n", one.text);
        }
      }
    }
  }
  return compared;
}

}  // namespace

TEST_CASE("what is told for every number is so for the next ones") {
  Census census;
  SplitMix64 seeds(seed_or(20261130));
  const int wanted = by_effort(220, 3000);
  while (census.trees < wanted) {
    const std::uint64_t seed = seeds.next();
    const Case one = random_case(seed);
    const std::string wrong = flaw_of(one, census);
    if (!wrong.empty()) {
      FAIL("seed ", seed, ", tick ", tick_name(*one.how.ticks), ", ", wrong,
           "\n", one.text, "\n", one.rules);
    }
  }
  std::string reasons;
  for (const auto& [reason, count] : census.reasons) {
    reasons += fmt::format("\n{:>6}  {}", count, reason);
  }
  for (const auto& [profile, count] : census.profiles) {
    reasons += fmt::format("\n{:>6}  trees of {}", count, profile);
  }
  MESSAGE(census.trees << " trees, " << census.telling << " of them told of; "
                       << census.claims << " claims (" << census.found
                       << " with runs, " << census.beyond_one
                       << " from a later number on), " << census.checked
                       << " numbers tried; open: " << reasons);
  CHECK_COVERED(census.telling * 10 > census.trees * 8);
  CHECK_COVERED(census.claims > census.open);
  CHECK_COVERED(census.found > 200);
  CHECK_COVERED(census.beyond_one > 20);
  CHECK_COVERED(census.profiles.size() == 2 + std::size(kProfiles));
}

// The map on which the argument rests, state by state.
TEST_CASE("with rounds left open a network simulates all that count further") {
  SplitMix64 seeds(seed_or(711));
  int compared = 0;
  for (int i = by_effort(60, 1000); i > 0; --i) {
    compared += compare_networks(random_case(seeds.next()));
  }
  MESSAGE(compared << " networks compared");
  CHECK_COVERED(compared > 500);
}

}  // namespace btcheck::reference::counts_cross_check_test
