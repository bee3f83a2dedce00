// SPDX-License-Identifier: MIT
//
// BehaviorTree.CPP's TestNode (src/actions/test_node.cpp, 4.10) is less than a
// script of answers. With an async_delay its first answer of an activation is
// RUNNING, and after the delay each tick asks its script. Without one the
// first tick asks the script, and if that says RUNNING, the node runs until it
// is halted. So what a leaf did decides which of the two it becomes:
//
//   it never ran                      no delay, all answers in the script
//   every activation began running    delay, all answers but the first ones
//   activations that began running    no delay, only the first answer of each
//     never completed                 activation
//   all else                          no delay, completions only, and a note
//
// Rules find nodes by name, so leaves of one name share one counter and answer
// in the order of the run; where an inner node or a node type has that name
// too, there can be no rule.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <span>
#include <vector>

#include "model/tree/node_types.hpp"
#include "model/tree/tree.hpp"
#include "trace/run/itf.hpp"
#include "trace/run/shown_text.hpp"

namespace btcheck {
namespace {

struct Answer {
  Phase phase;           // Running, Success or Failure
  bool is_first;         // of its activation
  std::size_t part = 0;  // 0 before the loop, 1 its first passage, 2 its second
};

std::string status_word(Phase phase) {
  if (phase == Phase::Running) return "RUNNING";
  return phase == Phase::Success ? "SUCCESS" : "FAILURE";
}

// The leaves of one name.
struct Group {
  std::string name;
  std::vector<std::uint32_t> leaves;
  std::vector<Answer> answers;  // of all of them, in the order of the run
};

// What its test node does.
struct Plan {
  bool is_delayed = false;
  bool is_exact = true;
  std::vector<Phase> values;  // what the script answers, one after the other
  std::size_t next = 0;       // which value follows the last one
};

// True if the script gives this answer.
bool is_scripted(const Answer& answer, bool is_delayed, bool runs_for_ever) {
  if (is_delayed) return !answer.is_first;
  if (answer.phase != Phase::Running) return true;
  return runs_for_ever && answer.is_first;
}

Plan planned(const std::vector<Answer>& answers) {
  bool has_run = false;
  bool first_ones_run = true;
  bool runs_for_ever = true;
  for (const Answer& answer : answers) {
    const bool runs = answer.phase == Phase::Running;
    has_run |= runs;
    first_ones_run &= runs || !answer.is_first;
    runs_for_ever &= runs || answer.is_first;
  }
  Plan plan;
  plan.is_delayed = has_run && first_ones_run;
  plan.is_exact = !has_run || plan.is_delayed || runs_for_ever;
  std::vector<Phase> parts[3];
  for (const Answer& answer : answers) {
    if (is_scripted(answer, plan.is_delayed, runs_for_ever)) {
      parts[answer.part].push_back(answer.phase);
    }
  }
  // In its first passage the loop may find a leaf running that began before.
  if (parts[1] != parts[2]) {
    std::ranges::copy(parts[1], std::back_inserter(parts[0]));
    parts[1] = parts[2];
  }
  plan.values = parts[0];
  std::ranges::copy(parts[1], std::back_inserter(plan.values));
  if (plan.values.empty()) plan.values.push_back(Phase::Running);
  plan.next = std::min(parts[0].size(), plan.values.size() - 1);
  return plan;
}

// Equal values one after the other.
struct Stretch {
  std::size_t begin;
  Phase value;
};

std::vector<Stretch> stretches_of(const std::vector<Phase>& values) {
  std::vector<Stretch> stretches;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (i == 0 || values[i] != values[i - 1]) {
      stretches.push_back({i, values[i]});
    }
  }
  return stretches;
}

// "(@c < 3 ? RUNNING : SUCCESS)"; halved again and again, so that the
// parentheses do not nest deep.
std::string choice_text(const std::string& counter,
                        std::span<const Stretch> stretches) {
  if (stretches.size() == 1) return status_word(stretches[0].value);
  const std::size_t middle = stretches.size() / 2;
  return fmt::format("({} < {} ? {} : {})", counter, stretches[middle].begin,
                     choice_text(counter, stretches.first(middle)),
                     choice_text(counter, stretches.subspan(middle)));
}

class RuleWriter {
 public:
  explicit RuleWriter(const RecordedRun& run)
      : run_(run), children_(children_of(run)) {}

  std::string write() {
    find_groups();
    find_answers();
    for (const Group& group : groups_) write_group(group);
    if (!blackboard_.is_empty()) {
      note(
          "set each member of Blackboard on tree.rootBlackboard() before the "
          "first tick; return_status_script needs BehaviorTree.CPP 4.10");
    }
    const Json document{{"TestNodeConfigs", configs_},
                        {"SubstitutionRules", rules_},
                        {"Blackboard", blackboard_},
                        {"Notes", notes_}};
    return document.indented(2) + "\n";
  }

 private:
  void find_groups() {
    std::map<std::string, std::size_t> known;
    for (std::uint32_t n = 0; n < run_.nodes.size(); ++n) {
      const RecordedNode& node = run_.nodes[n];
      // The engine's own scripts do the same again, with what they write.
      if (!children_[n].empty() || node.type == type_name(NodeType::Script)) {
        taken_.insert({node.name, node.type});
        continue;
      }
      const auto [at, is_new] = known.emplace(node.name, groups_.size());
      if (is_new) groups_.push_back({node.name, {}, {}});
      groups_[at->second].leaves.push_back(n);
    }
  }

  void find_answers() {
    std::vector<Phase> last(run_.nodes.size(), Phase::Unvisited);
    std::vector<bool> is_running(run_.nodes.size(), false);
    const auto passings = unrolled(run_, 2);
    for (std::size_t i = 0; i < passings.size(); ++i) {
      const auto& phases = run_.states[passings[i].state].phases;
      const std::size_t part = i < run_.loop            ? 0
                               : i < run_.states.size() ? 1
                                                        : 2;
      for (Group& group : groups_) {
        for (const std::uint32_t leaf : group.leaves) {
          const Phase now = phases[leaf];
          if (now == last[leaf]) continue;
          last[leaf] = now;
          if (is_active(now)) continue;
          const bool runs = now == Phase::Running;
          if (runs || is_completed(now)) {
            group.answers.push_back({now, !is_running[leaf], part});
          }
          is_running[leaf] = runs;
        }
      }
    }
  }

  void note(std::string_view text) { notes_.push(text); }

  void write_group(const Group& group) {
    if (group.answers.empty()) return;  // the run never gets there
    if (taken_.contains(group.name)) {
      return note(fmt::format(
          "no rule for the leaf `{}`: a node with children, or a type of "
          "nodes, has that name too",
          group.name));
    }
    const Plan plan = planned(group.answers);
    if (group.leaves.size() > 1) {
      note(fmt::format(
          "{} leaves are called `{}`: together they answer in the run's order",
          group.leaves.size(), group.name));
    }
    if (!plan.is_exact) {
      note(fmt::format(
          "`{}` answers as often as in the run, but never running: it ran "
          "before some of its answers and not before others, which a test node "
          "cannot do",
          group.name));
    }
    configs_.add(group.name, config(group.name, plan));
    rules_.add(group.name, group.name);
  }

  Json config(const std::string& name, const Plan& plan) {
    Json config = Json::object();
    if (plan.is_delayed) config.add("async_delay", 1);
    config.add("return_status", status_word(plan.values.front()));
    const std::string entry = counter_name(name);
    const std::string counter = "@" + entry;
    const auto stretches = stretches_of(plan.values);
    if (stretches.size() == 1) return config;
    config.add("return_status_script", choice_text(counter, stretches));
    config.add("post_script",
               fmt::format("{0} := ({0} + 1 < {1} ? {0} + 1 : {2})", counter,
                           plan.values.size(), plan.next));
    counters_.insert(entry);
    blackboard_.add(entry, 0);
    return config;
  }

  // A name for the blackboard that scripts can spell, of this leaf alone.
  std::string counter_name(const std::string& leaf) const {
    std::string name = "btcheck_" + plain_word(leaf);
    while (counters_.contains(name)) name += '_';
    return name;
  }

  const RecordedRun& run_;
  const Children children_;
  std::vector<Group> groups_;       // in the order of their first leaves
  std::set<std::string> taken_;     // names and types of nodes with children
  std::set<std::string> counters_;  // names on the blackboard
  Json configs_ = Json::object();
  Json rules_ = Json::object();
  Json blackboard_ = Json::object();
  Json notes_ = Json::array();
};

}  // namespace

std::string substitution_text(const RecordedRun& run) {
  return RuleWriter(run).write();
}

}  // namespace btcheck
