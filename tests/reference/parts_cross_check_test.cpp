// SPDX-License-Identifier: MIT
//
// The default report asked in parts against the one of the whole, on random
// trees under every tick semantics: the same answers, the same findings, and
// runs that end with what they are told for. Also where some is known before:
// from a search of the whole that was given up, from a tree in which one leaf
// was another, or from one that has little to do with it.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <array>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "check/parts/earlier_runs.hpp"
#include "check/parts/in_parts.hpp"
#include "check/questions/defaults.hpp"
#include "check/replay/executed.hpp"
#include "explore/state/step.hpp"
#include "model/lowering.hpp"
#include "model/tree/node_types.hpp"
#include "model/tree_file.hpp"
#include "reference/effort.hpp"
#include "reference/kept_bytes.hpp"
#include "reference/random_tree.hpp"
#include "reference/random_xml_tree.hpp"
#include "reference/telling_names.hpp"

namespace btcheck::reference::parts_cross_check_test {
namespace {

constexpr std::uint64_t kMostStatesOfTree = 20'000;

// A tree with its report.
struct Checked {
  Checked(BehaviorTree read, TickSemantics ticks)
      : tree(std::move(read)), network(lower(tree, ticks)), system(network) {}

  BehaviorTree tree;
  Network network;
  CompiledNetwork system;
  DefaultReport report;
};

struct Census {
  std::size_t trees = 0;
  std::size_t parts = 0;  // decided in full, in four ways
  std::size_t findings = 0;
  std::size_t stuck = 0;  // some tree question is answered no
  std::size_t never = 0;  // node questions
  std::unique_ptr<const Checked> last;
};

std::string found(const DefaultReport& report, const BehaviorTree& tree) {
  std::set<std::string> all;
  for (const TreeFinding& each : report.findings) {
    all.insert(
        fmt::format("{} at {}", each.code, tree.node(each.node).span.line));
  }
  for (const LeftRunningReport& each : report.left_running) {
    all.insert(fmt::format("left running: {} by {}", index(each.leaf),
                           index(each.above)));
  }
  for (const StaleGuardReport& each : report.stale_guards) {
    for (const NodeId guard : each.guards) {
      all.insert(fmt::format("not asked again: {} while {} runs", index(guard),
                             index(each.action)));
    }
  }
  return fmt::format("{}", fmt::join(all, "\n"));
}

// It is a run, and its last step brings the node to where the question asks.
bool shows(const Network& network, const KeptRun& run, NodeId node,
           NodeQuestion question) {
  const auto steps = run.steps();
  const LocationRole role =
      kNodeQuestionRoles[static_cast<std::size_t>(question)];
  return !steps.empty() && executed(network, steps) &&
         steps.back().edge != kTimeStep &&
         node_entering(network, steps.back().edge, role) == node;
}

std::shared_ptr<KeptBytes> kept_bytes() {
  static const auto kept = std::make_shared<KeptBytes>();
  return kept;
}

// Of all trees that were checked before, as far as there is room; of every
// other one as it comes back from where it was kept as bytes.
ComponentStore& known_parts(std::size_t tree) {
  static ComponentStore store(std::size_t{4} << 20);
  static ComponentStore forgetful(0);
  forgetful.keep_in(kept_bytes());
  return tree % 2 == 0 ? store : forgetful;
}

std::string difference(const BehaviorTree& tree, const Network& network,
                       const DefaultReport& whole, const DefaultReport& parts,
                       Census& census) {
  if (!parts.error.empty()) return parts.error;
  if (parts.stopped != StopReason::None) return {};
  ++census.parts;
  if (parts.tree.size() != whole.tree.size()) return "questions of the tree";
  for (std::size_t i = 0; i < whole.tree.size(); ++i) {
    census.stuck += whole.tree[i].verdict == Verdict::Violated;
    const auto& run = parts.tree[i].run;
    if (whole.tree[i].verdict == parts.tree[i].verdict &&
        whole.tree[i].run.has_value() == run.has_value() &&
        (!run || executed(network, run->steps()))) {
      continue;
    }
    return fmt::format("tree question {}: {} and {}", i,
                       static_cast<int>(whole.tree[i].verdict),
                       static_cast<int>(parts.tree[i].verdict));
  }
  for (std::uint32_t n = 0; n < tree.nodes.size(); ++n) {
    for (std::size_t q = 0; q < kNodeQuestionCount; ++q) {
      const Possibility& one = whole.nodes[n].answers[q];
      const Possibility& other = parts.nodes[n].answers[q];
      census.never += one.verdict == Verdict::Violated;
      if (one.verdict != other.verdict) {
        return fmt::format("node {}, {}: {} and {}", n, kNodeQuestionNames[q],
                           static_cast<int>(one.verdict),
                           static_cast<int>(other.verdict));
      }
      if (other.run && !shows(network, *other.run, NodeId{n},
                              static_cast<NodeQuestion>(q))) {
        return fmt::format("node {}: the run does not end with {}", n,
                           kNodeQuestionNames[q]);
      }
    }
  }
  census.findings += whole.findings.size();
  const std::string one = found(whole, tree);
  const std::string other = found(parts, tree);
  return one == other ? "" : one + "\n-- in parts\n" + other;
}

// What is told of how far a report came does not hang on what was kept before,
// of this tree and of others.
std::string difference_of_effort(const BehaviorTree& tree,
                                 const CompiledNetwork& system,
                                 std::size_t together) {
  ComponentStore nothing;
  ComponentStore reading;
  reading.keep_in(kept_bytes());
  const auto asked = [&](ComponentStore& known) {
    return check_defaults_in_parts(tree, system, {}, &known, together, nullptr);
  };
  const DefaultReport one = asked(nothing);
  const DefaultReport first = asked(reading);
  reading.forget();
  const DefaultReport again = asked(reading);
  for (const DefaultReport* other : {&first, &again}) {
    const auto& [states, expanded, transitions, depth, bytes] = other->progress;
    if (one.searches == other->searches && one.progress.states == states &&
        one.progress.expanded == expanded && one.progress.depth == depth &&
        one.progress.transitions == transitions &&
        one.progress.bytes == bytes) {
      continue;
    }
    return fmt::format("{} searches of {} states, and {} of {}", one.searches,
                       one.progress.states, other->searches, states);
  }
  return {};
}

// One node counts to another number, where one counts.
bool edit_count(BehaviorTree& tree, std::uint64_t number) {
  std::vector<int*> counts;
  for (Node& node : tree.nodes) {
    if (node.repetitions > 1) counts.push_back(&node.repetitions);
    const bool is_some = node.type == NodeType::Parallel && node.threshold > 1;
    if (is_some) counts.push_back(&node.threshold);
  }
  if (counts.empty()) return false;
  --*counts[number % counts.size()];
  return true;
}

// Or one leaf can do less, or more.
void edit(BehaviorTree& tree, std::uint64_t number) {
  if (number % 3 == 0 && edit_count(tree, number)) return;
  std::vector<Node*> leaves;
  for (Node& node : tree.nodes) {
    if (node.children.empty()) leaves.push_back(&node);
  }
  Node& leaf = *leaves[number % leaves.size()];
  const bool is_quick = leaf.type == NodeType::Condition || number % 2 == 0;
  if (is_quick && !leaf.contract.may_succeed) return;
  bool& may = is_quick ? leaf.contract.may_fail : leaf.contract.may_run;
  may = !may;
}

// `again` is the tree once more, to be changed.
std::string flaw_of(const BehaviorTree& tree, BehaviorTree again,
                    TickSemantics ticks, Census& census) {
  const Network network = lower(tree, ticks);
  const CompiledNetwork system(network);
  Limits few;
  few.max_states = kMostStatesOfTree;
  const DefaultReport whole =
      check_defaults(tree, system, Reduction::None, few);
  if (whole.stopped != StopReason::None) return {};
  ++census.trees;
  const std::size_t together = 1 + census.trees % 4;
  const auto in_parts = [&](const BehaviorTree& of, const CompiledNetwork& its,
                            const EarlierReport* earlier) {
    return check_defaults_in_parts(of, its, {}, &known_parts(census.trees),
                                   together, earlier);
  };
  few.max_states = census.trees % 100;
  const DefaultReport begun =
      check_defaults(tree, system, Reduction::None, few);
  const EarlierReport at_first{tree, network, begun};
  edit(again, census.trees);
  auto edited = std::make_unique<Checked>(std::move(again), ticks);
  edited->report = in_parts(edited->tree, edited->system, nullptr);
  std::vector<std::pair<const char*, const EarlierReport*>> ways = {
      {"", nullptr}, {"after a few states: ", &at_first}};
  const EarlierReport of_edited{edited->tree, edited->network, edited->report};
  ways.emplace_back("after an edit: ", &of_edited);
  std::optional<EarlierReport> of_last;
  if (const Checked* last = census.last.get()) {
    of_last.emplace(EarlierReport{last->tree, last->network, last->report});
    ways.emplace_back("after another tree: ", &*of_last);
  }
  for (const auto& [words, earlier] : ways) {
    const std::string flaw = difference(
        tree, network, whole, in_parts(tree, system, earlier), census);
    if (!flaw.empty()) return words + flaw;
  }
  census.last = std::move(edited);
  if (census.trees % 3 != 0) return {};
  return difference_of_effort(tree, system, together);
}

constexpr std::array<TickSemantics, 4> kTicks = {
    TickSemantics::Root, TickSemantics::Leaves, TickSemantics::Nodes,
    TickSemantics::None};
constexpr std::array<Profile, 5> kProfiles = {
    Profile::Btcpp38, Profile::Btcpp4, Profile::Nav2Humble, Profile::Nav2Jazzy,
    Profile::Nav2Main};

void tell(const Census& census) {
  MESSAGE(census.trees << " trees, " << census.parts << " decided in parts; "
                       << census.findings << " findings, " << census.stuck
                       << " questions of trees answered no, " << census.never
                       << " of nodes; " << kept_bytes()->found
                       << " contents from bytes");
  CHECK_COVERED(census.parts > 2 * census.trees);
  CHECK_COVERED(census.never > census.trees);
  CHECK_COVERED(kept_bytes()->found > census.trees);
  CHECK(kept_bytes()->refused == 0);
}

}  // namespace

TEST_CASE("the default report in parts is that of the whole") {
  Census census;
  const std::uint64_t seed = seed_or(1);
  const auto trees = by_effort<std::uint64_t>(250, 4000);
  for (std::uint64_t i = 0; i < trees; ++i) {
    const std::uint64_t here = seed * 1'000'000 + i;
    const std::string text =
        i % 3 == 2 ? random_tree(here, timed_weather()) : random_tree(here);
    CAPTURE(text);
    const auto tree = read_btf("t.btf", text);
    auto edited = read_btf("t.btf", text);
    REQUIRE(tree.value);
    const TickSemantics ticks = kTicks[i % kTicks.size()];
    CAPTURE(tick_name(ticks));
    CHECK(flaw_of(*tree.value, std::move(*edited.value), ticks, census) == "");
  }
  tell(census);
}

TEST_CASE("the default report of XML in parts is that of the whole") {
  Census census;
  const std::uint64_t seed = seed_or(1);
  const auto trees = by_effort<std::uint64_t>(400, 8000);
  for (std::uint64_t i = 0; i < trees; ++i) {
    TreeReading reading;
    reading.profile = kProfiles[i % kProfiles.size()];
    SplitMix64 random(seed * 1'000'003 + i);
    std::string text = random_xml_tree(random.next(), *reading.profile);
    text = with_telling_names(text, random.next());
    CAPTURE(text);
    const auto tree = read_tree("t.xml", text, reading);
    auto edited = read_tree("t.xml", text, reading);
    if (!tree.value) continue;
    const TickSemantics ticks = kTicks[i % 5 == 4 ? 3 : 0];
    CAPTURE(tick_name(ticks));
    CHECK(flaw_of(*tree.value, std::move(*edited.value), ticks, census) == "");
  }
  tell(census);
}

}  // namespace btcheck::reference::parts_cross_check_test
