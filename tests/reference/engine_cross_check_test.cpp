// SPDX-License-Identifier: MIT
//
// The whole engine against enumeration, on random trees and properties.
//
// Every tree is lowered under each tick semantics and its space written out
// naively. States and transitions must be as many as the search finds, every
// verdict, the default ones included, as the naive one, and every run that is
// told must have stood being replayed; one that violates a time must do so by
// the definition as well. Some property files assume something of all runs. The
// table at the end says how often each edge of each node type's automaton was
// taken.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "check/questions/defaults.hpp"
#include "check/search/engine.hpp"
#include "explore/search/reachability.hpp"
#include "model/lowering.hpp"
#include "reference/edge_census.hpp"
#include "reference/effort.hpp"
#include "reference/naive_defaults.hpp"
#include "reference/naive_verdict.hpp"
#include "reference/random_property.hpp"
#include "reference/random_tree.hpp"

namespace btcheck::reference::engine_cross_check_test {
namespace {

constexpr std::size_t kMostStates = 3000;
constexpr int kPropertiesOfSmallNetwork = 8;
constexpr int kPropertiesOfLargeNetwork = 4;
constexpr TickSemantics kAllTicks[] = {
    TickSemantics::Root, TickSemantics::Leaves, TickSemantics::Nodes,
    TickSemantics::None};

struct Census {
  int trees = 0;
  int trees_with_halt = 0;
  int networks = 0;
  int skipped = 0;
  int properties = 0;
  int violated = 0;
  std::uint64_t states = 0;
  EdgeCensus edges;
  struct Kind {
    int properties = 0;
    int violated = 0;
    int assumed = 0;
    int assumed_violated = 0;
    int no_run = 0;
  };
  std::array<Kind, kPropertyKinds> kinds;
};

// What the file assumes, then one line for each property, in the order asked.
std::string property_text(const std::vector<RandomProperty>& properties) {
  std::string text = properties.at(0).assumption.text;
  for (std::size_t i = 0; i < properties.size(); ++i) {
    text += fmt::format("property p{} : {}\n", i, properties[i].body);
  }
  return text;
}

std::string_view word_of(bool holds) { return holds ? "holds" : "violated"; }

// What is wrong with an engine's verdict, "" for nothing.
std::string flaw(const PropertyVerdict& found, bool expected) {
  if (!found.error.empty()) return found.error;
  const bool holds = found.verdict == Verdict::Holds;
  if (found.verdict == Verdict::Undecided) return "undecided";
  if (holds != expected) {
    return fmt::format("{}, but naively {}", word_of(holds), word_of(expected));
  }
  // Of branching time there is not always a run to be told.
  if (found.property->form == PropertyForm::Branching) return {};
  const bool wants_run =
      found.property->form == PropertyForm::Possible ? holds : !holds;
  return found.run.has_value() == wants_run ? "" : "a run too many or too few";
}

// One property file on one network.
class FileComparison {
 public:
  FileComparison(const BehaviorTree& tree, const CompiledNetwork& system,
                 const NaiveSpace& space,
                 std::vector<RandomProperty> properties, Census& census)
      : tree_(tree),
        system_(system),
        space_(space),
        properties_(std::move(properties)),
        census_(census) {}

  // With both orders of search, where these may make a difference.
  std::string flaw_of_all() {
    for (const Reduction reduction :
         {Reduction::None, Reduction::Live, Reduction::Full}) {
      const std::string wrong =
          flaw_with({SearchOrder::BreadthFirst, reduction});
      if (!wrong.empty() || expected_.empty()) return wrong;
    }
    SearchChoices in_parts;
    in_parts.parts = PartsUse::Always;
    const std::string wrong = flaw_with(in_parts);
    if (!wrong.empty()) return "in parts: " + wrong;
    for (std::size_t i = properties_.size(); i-- > 0;) {
      const PropertyKind kind = properties_[i].kind;
      if (kind == PropertyKind::State || kind == PropertyKind::Ltl ||
          kind == PropertyKind::Pattern) {
        continue;
      }
      const auto place = static_cast<std::ptrdiff_t>(i);
      properties_.erase(properties_.begin() + place);
      expected_.erase(expected_.begin() + place);
    }
    return properties_.empty()
               ? ""
               : flaw_with({SearchOrder::DepthFirst, Reduction::Full});
  }

 private:
  std::string flaw_with(SearchChoices choices) {
    const std::string text = property_text(properties_);
    const auto file = read_properties("random.ltl", text);
    if (!file.value) return "cannot be read\n" + render(file.diagnostics.at(0));
    const SourceText source("random.ltl", text);
    const auto bound = bind_properties(
        tree_, system_.network(), *file.value, source,
        properties_[0].assumption.by_option ? ExtraAssumption::ActionsEnd
                                            : ExtraAssumption::None);
    if (!bound.value) return "cannot be bound\n" + text;
    if (expected_.empty() && !answer_naively()) return {};
    return flaw_of(*bound.value, choices);
  }

  // False when an atom makes no sense here.
  bool answer_naively() {
    for (const RandomProperty& property : properties_) {
      const auto answer =
          naive_verdict(tree_, system_.network(), space_, property);
      if (!answer) {
        expected_.clear();
        return false;
      }
      expected_.push_back(*answer);
    }
    return true;
  }

  std::string flaw_of(const BoundFile& file, SearchChoices choices) {
    const auto verdicts = verify(system_, file, choices, Limits{}).verdicts;
    const bool is_in_doubt =
        std::any_of(verdicts.begin(), verdicts.end(),
                    [](const PropertyVerdict& found) { return !found.run; });
    for (std::size_t i = 0; i < properties_.size(); ++i) {
      const PropertyVerdict& found = verdicts.at(i);
      std::string wrong = flaw(found, expected_[i].holds);
      if (wrong.empty() &&
          found.no_run != (is_in_doubt && !expected_[i].has_run)) {
        wrong = "wrong about whether there is an assumed run";
      }
      if (wrong.empty()) wrong = flaw_of_evidence(i, found);
      if (!wrong.empty()) {
        return fmt::format("{}{}\n  reduction {}: {}",
                           properties_[i].assumption.text, properties_[i].body,
                           static_cast<int>(choices.reduction), wrong);
      }
      if (choices.order == SearchOrder::BreadthFirst &&
          choices.reduction == Reduction::None) {
        count(i, found);
      }
    }
    return {};
  }

  std::string flaw_of_evidence(std::size_t i, const PropertyVerdict& found) {
    if (properties_[i].form != PropertyForm::Timed || !found.run) return {};
    return timed_evidence_flaw(tree_, system_.network(), space_, properties_[i],
                               *found.run, found.trigger_state);
  }

  void count(std::size_t i, const PropertyVerdict& found) {
    const RandomProperty& property = properties_[i];
    Census::Kind& kind = census_.kinds[static_cast<std::size_t>(property.kind)];
    const bool is_assumed = !property.assumption.is_empty();
    ++census_.properties;
    ++kind.properties;
    kind.assumed += is_assumed ? 1 : 0;
    if (found.verdict == Verdict::Violated) {
      ++census_.violated;
      ++kind.violated;
      kind.assumed_violated += is_assumed ? 1 : 0;
    }
    kind.no_run += found.no_run ? 1 : 0;
  }

  const BehaviorTree& tree_;
  const CompiledNetwork& system_;
  const NaiveSpace& space_;
  std::vector<RandomProperty> properties_;
  Census& census_;
  std::vector<NaiveAnswer> expected_;
};

std::string compare_spaces(const CompiledNetwork& system,
                           const NaiveSpace& space) {
  const std::string gate = broken_gate(system.network(), space);
  if (!gate.empty()) return gate + " acts though nobody has called it";
  ReachabilityVisitor visitor;
  const Limits limits;
  BreadthFirst search(system, limits);
  const SearchProgress progress = search.run(visitor).progress;
  if (progress.states == space.states.size() &&
      progress.transitions == space.transitions) {
    return {};
  }
  return fmt::format("{} states, {} transitions; naively {} and {}",
                     progress.states, progress.transitions, space.states.size(),
                     space.transitions);
}

// The limits keep the naive searches fast.
std::vector<RandomProperty> random_properties(const BehaviorTree& tree,
                                              const Network& network,
                                              std::size_t states,
                                              SplitMix64& random) {
  PropertyWeights weights;
  weights.most_temporal = states < 100   ? 4
                          : states < 300 ? 3
                          : states < 800 ? 2
                                         : 1;
  weights.response = network.ticks != TickSemantics::None && states < 500;
  weights.timed = network.ticks != TickSemantics::None && states < 300;
  weights.branching = states < 300;
  const bool assumes = states < 100 && random.percent(40);
  if (assumes) weights.most_temporal = 2;
  const SplitMix64 stream(random.next());
  RandomProperty probe;
  probe.atoms.resize(3);
  assume_something(probe, tree, network, stream);
  if (assumes && probe.assumption.formula) weights.branching = false;
  std::vector<RandomProperty> properties;
  const int count =
      states < 300 ? kPropertiesOfSmallNetwork : kPropertiesOfLargeNetwork;
  for (int i = 0; i < count; ++i) {
    properties.push_back(random_property(tree, network, random, weights));
    if (assumes) assume_something(properties.back(), tree, network, stream);
  }
  return properties;
}

// Everything about one network, "" when all agree. Without properties of its
// own it gets random ones.
std::string disagreement(const BehaviorTree& tree, TickSemantics ticks,
                         std::vector<RandomProperty>& properties,
                         SplitMix64& random, Census& census) {
  const Network network = lower(tree, ticks);
  const auto space = naive_space(network, kMostStates);
  if (!space) {
    ++census.skipped;
    return {};
  }
  ++census.networks;
  census.states += space->states.size();
  count_edges(tree, network, *space, census.edges);
  const CompiledNetwork system(network);
  std::string wrong = compare_spaces(system, *space);
  for (const Reduction reduction :
       {Reduction::None, Reduction::Live, Reduction::Full}) {
    if (!wrong.empty()) break;
    wrong = flaw_of(check_defaults(tree, system, reduction, Limits{}), tree,
                    network, *space);
    if (!wrong.empty()) {
      wrong += fmt::format(" (reduction {})", static_cast<int>(reduction));
    }
  }
  if (!wrong.empty()) return wrong;
  if (properties.empty()) {
    properties = random_properties(tree, network, space->states.size(), random);
  }
  return FileComparison(tree, system, *space, properties, census).flaw_of_all();
}

bool can_halt(const BehaviorTree& tree) {
  const Network network = lower(tree, TickSemantics::Root);
  const auto space = naive_space(network, kMostStates);
  if (!space) return false;
  for (std::uint32_t n = 0; n < tree.nodes.size(); ++n) {
    if (naive_answer(network, *space, NodeId{n}, NodeQuestion::Halted)) {
      return true;
    }
  }
  return false;
}

// The least tree on which one of the properties still goes wrong.
std::string smallest(const std::string& text, TickSemantics ticks,
                     const std::vector<RandomProperty>& properties) {
  std::string wrong;
  const auto fails = [&](const std::string& candidate) {
    const auto tree = read_btf("random.btf", candidate);
    if (!tree.value) return false;
    for (const RandomProperty& property : properties) {
      Census census;
      SplitMix64 random(1);
      std::vector<RandomProperty> one = {property};
      const std::string found =
          disagreement(*tree.value, ticks, one, random, census);
      if (found.empty() || found.starts_with("cannot be")) continue;
      wrong = found;
      return true;
    }
    return false;
  };
  const std::string small = shrink(text, fails);
  fails(small);
  return small + wrong;
}

void check_tree(const std::string& text, std::uint64_t seed, Census& census) {
  const auto tree = read_btf("random.btf", text);
  REQUIRE(tree.value.has_value());
  ++census.trees;
  census.trees_with_halt += can_halt(*tree.value) ? 1 : 0;
  SplitMix64 random(seed);
  for (const TickSemantics ticks : kAllTicks) {
    std::vector<RandomProperty> properties;
    const std::string wrong =
        disagreement(*tree.value, ticks, properties, random, census);
    if (wrong.empty()) continue;
    if (properties.empty()) {
      SplitMix64 any(1);
      const Network network = lower(*tree.value, ticks);
      properties = random_properties(*tree.value, network, kMostStates, any);
    }
    FAIL("seed ", seed, ", tick ", tick_name(ticks), "\n", text, wrong,
         "\nand after shrinking\n", smallest(text, ticks, properties));
  }
}

std::vector<RandomTreeWeights> weight_settings() {
  RandomTreeWeights plain;
  RandomTreeWeights waiting;
  waiting.halt_option = 20;
  waiting.wait_option = 80;
  waiting.looping_root = 70;
  RandomTreeWeights timed;
  timed.duration = 60;
  timed.contract = 60;
  timed.sampled = 20;
  timed.moving_number = 30;
  timed.decided = 40;
  RandomTreeWeights deep;
  deep.max_nodes = 8;
  deep.max_variables = 1;
  deep.max_running = 2;
  deep.max_depth = 6;
  deep.looping_root = 80;
  return {plain, waiting, timed, deep, timed_weather()};
}

// What the generator makes rarely or never: subtrees, divisors that are zero
// and effects of every kind, and everything that can run, halted by a parent.
std::vector<std::string> directed_trees() {
  const std::string counter =
      "((defsv x :init 1 :min 0 :max 2) (defaction i :returns (success)"
      " :on-success ((:= x (mod (+ x 1) 3))))";
  const std::string row =
      " (BehaviorTree :name t :loop 1 (Sequence"
      " (Action :ID i :SF) ";
  std::vector<std::string> trees = {
      counter + row + "(Eval (= (/ 4 x) 2)))))",
      counter + row + "(Eval (:= x (/ 2 (- 2 x)))))))",
      counter + " (defcondition c :requires (= (/ 2 x) 1)" +
          " :on-success ((:= x (+ x 1))))" + row + "(Condition :ID c))))",
      "(BehaviorTree :name t :loop 1 (Timeout :duration 9 (Action :ID a)))",
      "(BehaviorTree :name t :loop 1 (RateController :hz 2 (Condition :ID c)))",
      "((BehaviorTree :name s (Sequence (Action :ID a) (Condition :ID c)))"
      " (BehaviorTree :name t (ReactiveSequence :halt 1 (Condition :ID d)"
      " (SubTree :ID s) (SubTree :ID s))))"};
  for (const std::string contract :
       {":requires (= (/ 2 x) 1)", ":on-failure ((:= x (/ 2 x)))",
        ":on-success ((:= x (+ x 1)))", ":on-success ((:= x (- 2 x)))"}) {
    for (const std::string kind :
         {"(defaction a ", "(defaction a :duration [1,2] ",
          "(defcondition a "}) {
      const bool acts = kind.starts_with("(defaction");
      trees.push_back(counter + kind + contract + ")" + row +
                      (acts ? "(Action :ID a))))" : "(Condition :ID a))))"));
    }
  }
  for (const std::string halted :
       {"Parallel :success 1", "Parallel :success 1 :halt 1",
        "Parallel :success 1 :wait 1", "ParallelAll", "ParallelAll :halt 1",
        "ParallelAll :wait 1", "ReactiveSequence", "ReactiveSequence :wait 1",
        "ReactiveSequence :halt 1", "ReactiveFallback",
        "ReactiveFallback :wait 1", "ReactiveFallback :halt 1",
        "PipelineSequence", "RoundRobin", "Recovery :num_retries 1"}) {
    trees.push_back(
        "((BehaviorTree :name t (ReactiveSequence :halt 1 (Condition :ID c) (" +
        halted + " (Action :ID a) (Action :ID b)))))");
  }
  return trees;
}

void show(const Census& census) {
  std::string table;
  for (const auto& [edge, count] : census.edges) {
    table += fmt::format("\n{:>10}  {}", count, edge);
  }
  MESSAGE("edges taken:" << table);
  constexpr std::array<const char*, kPropertyKinds> kNames = {
      "state", "ltl", "response", "pattern", "timed", "branching", "event"};
  for (std::size_t k = 0; k < kPropertyKinds; ++k) {
    const Census::Kind& kind = census.kinds[k];
    MESSAGE(std::string(kNames[k])
            << ": " << kind.properties << " properties, " << kind.violated
            << " violated; under assumptions " << kind.assumed << ", "
            << kind.assumed_violated << " violated, " << kind.no_run
            << " without a run");
  }
  MESSAGE(census.trees << " trees, " << census.trees_with_halt
                       << " of them with a halt; " << census.networks
                       << " networks and " << census.skipped << " skipped, "
                       << census.states << " states; " << census.properties
                       << " properties, " << census.violated << " violated");
}

}  // namespace

TEST_CASE("the engine says what enumeration says") {
  const std::uint64_t seed = seed_or(1);
  const auto trees = by_effort<std::uint64_t>(250, 5000);
  const std::vector<RandomTreeWeights> settings = weight_settings();
  Census census;
  for (const std::string& text : directed_trees()) {
    CAPTURE(text);
    check_tree(text, seed, census);
  }
  for (std::uint64_t i = 0; i < trees; ++i) {
    const std::uint64_t here = seed * 1'000'000 + i;
    check_tree(random_tree(here, settings[i % settings.size()]), here, census);
  }
  show(census);
  CHECK_COVERED(census.violated * 100 >= census.properties * 30);
  for (const Census::Kind& kind : census.kinds) {
    CHECK_COVERED(kind.violated * 100 >= kind.properties * 20);
    CHECK_COVERED(kind.assumed * 100 >= kind.properties * 4);
    CHECK_COVERED(kind.assumed_violated > 0);
    CHECK_COVERED(kind.no_run > 0);
  }
  CHECK_COVERED(census.trees_with_halt * 100 >= census.trees * 20);
  CHECK_COVERED(census.skipped * 100 <=
                (census.networks + census.skipped) * 40);
  for (const auto& entry : census.edges) {
    const std::string& edge = entry.first;
    CAPTURE(edge);
    CHECK_COVERED(entry.second > 0);
  }
}

}  // namespace btcheck::reference::engine_cross_check_test
