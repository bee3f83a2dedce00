// SPDX-License-Identifier: MIT
//
// Findings on random XML trees against all states written out: the run of each
// is executed once more and ends with what it is said to show, and what a node
// is said never to do it does in no state.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "btcpp_random/scripted_run.hpp"
#include "btcpp_random/scripted_tree.hpp"
#include "check/findings/findings.hpp"
#include "check/questions/defaults.hpp"
#include "explore/state/step.hpp"
#include "model/lowering.hpp"
#include "model/tree_file.hpp"
#include "reference/effort.hpp"
#include "reference/naive_defaults.hpp"
#include "reference/naive_network.hpp"
#include "reference/random_tree.hpp"
#include "reference/random_xml_tree.hpp"
#include "reference/telling_names.hpp"
#include "trace/formats/text.hpp"

namespace btcheck::reference::findings_cross_check_test {
namespace {

// A step of a run: the state before, and the edge; none where time passes.
struct Event {
  NaiveState before;
  std::optional<std::uint32_t> edge;
};

class Confirmation {
 public:
  Confirmation(const BehaviorTree& tree, const Network& network,
               const NaiveSpace& space)
      : network_(network),
        naive_(network),
        space_(space),
        suspicions_(suspicions_of(NormalTree(tree))) {}

  // What is wrong with a finding, or "".
  std::string flaw(const TreeFinding& finding) const {
    std::vector<Event> run;
    if (finding.run) {
      if (!execute(*finding.run, run)) return "its run cannot be executed";
    }
    if (is_so_by_answers(finding)) return "";
    const bool is_by_run = finding.code == "BT2205" ||
                           finding.code == "BT2206" || finding.code == "BT2501";
    if (is_by_run) {
      if (is_so_by_run(finding, run)) return "";
    }
    for (const Suspicion& each : suspicions_) {
      if (each.finding.code == finding.code &&
          each.finding.node == finding.node && is_shown(each, run) &&
          !is_cleared(each)) {
        return "";
      }
    }
    return "nothing shows it";
  }

 private:
  bool execute(const KeptRun& run, std::vector<Event>& events) const {
    NaiveState state = naive_.initial();
    for (const Step& step : run.steps()) {
      const NaiveState before = state;
      if (step.edge == kTimeStep) {
        if (!naive_.may_wait(state)) return false;
        state = naive_.waited(state);
        events.push_back({before, std::nullopt});
        continue;
      }
      const auto enabled = naive_.enabled(state);
      if (std::ranges::count(enabled, step.edge) == 0) return false;
      const Automaton& owner = network_.owner_of_edge(step.edge);
      state = naive_.after(state, owner, network_.edge(step.edge));
      events.push_back({before, step.edge});
    }
    return true;
  }

  bool can(NodeId node, NodeQuestion question) const {
    return naive_answer(network_, space_, node, question);
  }
  NodeStatus status(const NaiveState& state, NodeId node) const {
    return static_cast<NodeStatus>(
        state.value(network_.node_status[index(node)]));
  }

  // By what the node can do in any state.
  bool is_so_by_answers(const TreeFinding& finding) const {
    using enum NodeQuestion;
    const NodeId node = finding.node;
    if (finding.code == "BT2201") return !can(node, Ticked);
    if (finding.code == "BT2202") return !can(node, Success);
    if (finding.code == "BT2203") {
      return !can(node, Failure) && can(node, Success);
    }
    if (finding.code == "BT2204") {
      return !can(node, Success) && can(node, Failure);
    }
    if (finding.code == "BT2213") {
      return !can(node, Success) || !can(node, Failure);
    }
    if (finding.code == "BT2512") return can(node, Failure);
    if (finding.code == "BT2212") {
      return !can(node, Success) && !can(node, Failure) && !can(node, Running);
    }
    return false;
  }

  // Stale guards and what is left running: by the end of the run.
  bool is_so_by_run(const TreeFinding& finding,
                    const std::vector<Event>& run) const {
    if (run.empty() || !run.back().edge) return false;
    const NaiveState& before = run.back().before;
    if (finding.code == "BT2206") {
      const NodeId above = finding.others.at(0);
      return node_entering(network_, *run.back().edge, LocationRole::Start) ==
                 above &&
             status(before, finding.node) == NodeStatus::Running;
    }
    const auto action =
        node_entering(network_, *run.back().edge, LocationRole::Tick);
    if (!action || std::ranges::count(finding.others, *action) == 0 ||
        status(before, *action) != NodeStatus::Running) {
      return false;
    }
    // From the end backwards: the action's answer before the guard's tick.
    for (std::size_t i = run.size() - 1; i-- > 0;) {
      if (!run[i].edge) continue;
      if (enters(run[i], finding.node, LocationRole::Tick)) return false;
      if (enters(run[i], *action, LocationRole::Running)) return true;
    }
    return false;
  }

  bool enters(const Event& event, NodeId node, LocationRole role) const {
    return event.edge && node_entering(network_, *event.edge, role) == node;
  }

  bool is_seen(const Sighting& sighting, const Event& event) const {
    if (!enters(event, sighting.node, sighting.role)) return false;
    const bool is_with =
        std::ranges::all_of(sighting.with, [&](const auto& each) {
          return status(event.before, each.first) == each.second;
        });
    return is_with && (!sighting.retried || retries(event, *sighting.retried));
  }

  bool retries(const Event& event, NodeId recovery) const {
    const AutomatonId automaton = network_.node_automaton[index(recovery)];
    for (std::uint32_t v = 0; v < network_.variables.size(); ++v) {
      const Variable& variable = network_.variables[v];
      if (variable.owner == automaton && variable.local == LocalRole::Rounds) {
        return event.before.value(VariableId{v}) != 0;
      }
    }
    return false;
  }

  // The run ends with what shows it, or with what follows from that.
  bool is_shown(const Suspicion& suspicion,
                const std::vector<Event>& run) const {
    if (suspicion.shown_by.empty()) return true;
    for (std::size_t i = run.size(); i-- > 0;) {
      const bool is_one = std::ranges::any_of(
          suspicion.shown_by,
          [&](const Sighting& each) { return is_seen(each, run[i]); });
      if (is_one && suspicion.after &&
          !std::ranges::any_of(run, [&](const Event& event) {
            return enters(event, suspicion.after->node,
                          suspicion.after->answer);
          })) {
        return false;
      }
      if (is_one && has_ticked(run, suspicion.shown_by[0])) return false;
      if (is_one) {
        return suspicion.then ? follows(*suspicion.then, run, i)
                              : i + 1 == run.size();
      }
      // Between the two the world outside has no say.
      if (!run[i].edge || network_.edge(*run[i].edge).asks_world) return false;
    }
    return false;
  }

  // One of whom the sighting says that it is not ticked yet.
  bool has_ticked(const std::vector<Event>& run,
                  const Sighting& sighting) const {
    return std::ranges::any_of(sighting.with, [&](const auto& each) {
      return each.second == NodeStatus::NoRetStatus &&
             std::ranges::any_of(run, [&](const Event& event) {
               return enters(event, each.first, LocationRole::Tick);
             });
    });
  }

  bool follows(const Consequence& then, const std::vector<Event>& run,
               std::size_t sighting) const {
    return sighting + 1 < run.size() &&
           enters(run.back(), then.node, then.answer);
  }

  bool is_cleared(const Suspicion& suspicion) const {
    return std::ranges::any_of(
        suspicion.cleared_by, [&](const Sighting& sighting) {
          for (std::size_t s = 0; s < space_.states.size(); ++s) {
            for (const NaiveSpace::Step& step : space_.steps[s]) {
              if (step.edge && is_seen(sighting, {space_.states[s], step.edge}))
                return true;
            }
          }
          return false;
        });
  }

  const Network& network_;
  NaiveNetwork naive_;
  const NaiveSpace& space_;
  std::vector<Suspicion> suspicions_;
};

struct Counts {
  std::size_t trees = 0;
  std::map<std::string, std::size_t> findings;  // by code

  std::size_t all() const {
    std::size_t sum = 0;
    for (const auto& [code, count] : findings) sum += count;
    return sum;
  }
};

void confirm(const BehaviorTree& tree, const std::string& text,
             Counts& counts) {
  const Network network = lower(tree, TickSemantics::Root);
  const auto space = naive_space(network, 6000);
  if (!space) return;
  ++counts.trees;
  const CompiledNetwork system(network);
  const Confirmation confirmation(tree, network, *space);
  for (const Reduction reduction :
       {Reduction::None, Reduction::Live, Reduction::Full}) {
    const DefaultReport report = check_defaults(tree, system, reduction, {});
    REQUIRE(report.error == "");
    for (const TreeFinding& finding : report.findings) {
      const std::string flaw = confirmation.flaw(finding);
      if (!flaw.empty()) {
        const std::string run =
            finding.run
                ? run_text(tree, network, finding.run->told(), TextStyle{})
                : "no run\n";
        FAIL_CHECK(flaw << " (reduction " << static_cast<int>(reduction)
                        << "): " << finding.code << " " << finding.message
                        << "\n"
                        << text << run);
      }
      if (reduction == Reduction::None) {
        ++counts.findings[std::string(finding.code)];
      }
    }
  }
}

void tell(const Counts& counts) {
  std::string kinds;
  for (const auto& [code, count] : counts.findings) {
    kinds += fmt::format("; {} of {}", count, code);
  }
  MESSAGE(counts.trees << " trees: " << counts.all() << " findings confirmed"
                       << kinds);
}

constexpr std::array<Profile, 5> kProfiles = {
    Profile::Btcpp38, Profile::Btcpp4, Profile::Nav2Humble, Profile::Nav2Jazzy,
    Profile::Nav2Main};

}  // namespace

TEST_CASE("findings on random XML trees are so") {
  const std::uint64_t first = seed_or(1);
  const auto trees = by_effort<std::uint64_t>(800, 20'000);
  Counts counts;
  for (std::uint64_t i = 0; i < trees; ++i) {
    TreeReading reading;
    reading.profile = kProfiles[i % kProfiles.size()];
    SplitMix64 random(first * 1'000'003 + i);
    std::string text = random_xml_tree(random.next(), *reading.profile);
    text = with_telling_names(text, random.next());
    const auto tree = read_tree("t.xml", text, reading);
    if (!tree.value) FAIL(text << render(tree.diagnostics.at(0)));
    confirm(*tree.value, text, counts);
  }
  tell(counts);
  CHECK_COVERED(counts.all() > trees / 5);
  CHECK_COVERED(counts.findings.size() >= 8);
}

TEST_CASE("findings on random XML trees with scripts are so") {
  const std::uint64_t first = seed_or(1);
  const auto trees = by_effort<std::uint64_t>(60, 1500);
  Counts counts;
  for (std::uint64_t i = 0; i < trees; ++i) {
    const Profile profile = kProfiles[1 + i % 4];
    const ScriptedTree made = random_scripted_tree(first * 1'000'003 + i,
                                                   profile, World::Scripted, 5);
    const auto tree =
        read_tree("t.xml", made.xml, scripted_reading(profile, made.leaves));
    REQUIRE(tree.value);
    confirm(*tree.value, made.xml, counts);
  }
  tell(counts);
  CHECK_COVERED(counts.all() > trees / 4);
}

}  // namespace btcheck::reference::findings_cross_check_test
