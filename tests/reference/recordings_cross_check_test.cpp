// SPDX-License-Identifier: MIT
//
// Logs and kept runs of random trees, beside the runs that they were made of.
//
// What a log says about a rule must be so of the run, which the monitors see
// state by state; a kept run must say just the same. A log must conform to its
// tree, and the state behind the run must be among those that are left open.
// A corrupted log is refused exactly where no run writes it: that is found out
// once more by walking through runs, choice by choice, and writing the log of
// each.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <random>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "check/check.hpp"
#include "check/monitor/rule_monitor.hpp"
#include "check/rules_network.hpp"
#include "model/lowering.hpp"
#include "model/tree_file.hpp"
#include "reference/effort.hpp"
#include "reference/random_run.hpp"
#include "reference/random_tree.hpp"
#include "reference/random_xml_tree.hpp"
#include "trace/conform/conform.hpp"
#include "trace/conform/start.hpp"
#include "trace/run/itf.hpp"
#include "trace/run/record.hpp"
#include "trace/watch/watched_run.hpp"

namespace btcheck::reference::recordings_cross_check_test {
namespace {

// A tree, one of its runs, and what is kept of it.
struct Case {
  TreeInput input;
  BehaviorTree tree;
  std::unique_ptr<Network> network;
  Run run;
  RecordedRun recorded;
  std::string bytes;  // the log

  Result<BehaviorLog> log() const { return read_log("run.btlog", bytes); }
};

// Has the case another run, of this network.
void run_again(Case& one, std::unique_ptr<Network> network, int seed) {
  one.network = std::move(network);
  one.run =
      random_run(one.tree, *one.network, static_cast<std::uint64_t>(seed), 6);
  one.recorded = recorded(one.tree, *one.network, one.run, {});
  one.bytes = btlog_bytes(one.recorded, 1);
}

// Nothing where the tree cannot be used: several roots, no steps.
std::optional<Case> made(std::uint64_t seed, bool is_xml,
                         const RandomTreeWeights& weights = {}) {
  Case made;
  const std::string text = is_xml ? random_xml_tree(seed, Profile::Btcpp4)
                                  : random_tree(seed, weights);
  made.input = TreeInput(is_xml ? "t.xml" : "t.btf", text);
  if (is_xml) made.input.reading.profile = Profile::Btcpp4;
  auto tree = read_tree(made.input.name, text, made.input.reading);
  if (!tree.value || tree.value->roots.size() != 1) return std::nullopt;
  made.tree = std::move(*tree.value);
  run_again(made,
            std::make_unique<Network>(lower(made.tree, TickSemantics::Root)),
            static_cast<int>(seed));
  return made;
}

Valuation last_state(const Run& run) { return run.state(run.steps.size()); }

Conformance conformed(const Case& one, const BehaviorLog& log) {
  const CompiledNetwork system(*one.network);
  Limits limits;
  limits.max_states = 300'000;
  const auto nodes =
      LoggedNodes::match(log, one.tree, recorded_tree(one.tree, one.input));
  REQUIRE_MESSAGE(nodes.value, nodes.diagnostics.front().message);
  return conform(one.tree, system, log, *nodes.value, limits);
}

// Whether the packed states, and what can be reached from them without a word,
// have this one; a run may go on behind its last record.
bool leads_to(const Case& one, const Conformance& found,
              const Valuation& wanted) {
  const CompiledNetwork system(*one.network);
  const auto is_wanted = [&](StateView state) {
    for (std::uint32_t v = 0; v < wanted.variables.size(); ++v) {
      if (system.value(state, VariableId{v}) != wanted.variables[v]) {
        return false;
      }
    }
    return true;
  };
  std::vector<StateVector> queue = found.states;
  for (std::size_t i = 0; i < queue.size() && i < 200'000; ++i) {
    if (is_wanted(queue[i])) return true;
    const StateVector state = queue[i];
    system.successors(state, [&](StateView target, Step) {
      StateVector next(target.begin(), target.end());
      if (queue.size() < 5'000 &&
          std::ranges::find(queue, next) == queue.end()) {
        queue.push_back(std::move(next));
      }
    });
  }
  return false;
}

TEST_CASE("a log conforms to the tree that wrote it") {
  int logs = 0;
  const int cases = by_effort(250, 1500);
  for (int seed = 0; seed < cases; ++seed) {
    const bool is_xml = seed % 2 == 1;
    const auto one = made(static_cast<std::uint64_t>(seed), is_xml);
    if (!one) continue;
    CAPTURE(one->input.text);
    const auto log = one->log();
    if (!log.value) continue;  // a tree of no logged node
    const Conformance found = conformed(*one, *log.value);
    if (found.stopped != StopReason::None) continue;
    if (found.refused) {
      FAIL_CHECK("record " << *found.refused + 1 << " of\n"
                           << log_text(*log.value));
      continue;
    }
    ++logs;
    CHECK(leads_to(*one, found, last_state(one->run)));
  }
  CHECK_COVERED(logs > cases / 3);
}

// --- Corrupted logs ----------------------------------------------------------

std::string corrupted(const std::string& bytes, std::size_t begin,
                      std::mt19937& random, std::string& how) {
  constexpr std::size_t kRecord = 9;
  const std::size_t count = (bytes.size() - begin) / kRecord;
  const std::size_t at = begin + kRecord * (random() % count);
  std::string changed = bytes;
  switch (random() % 5) {
    case 0:
      how = "cut off";
      return bytes.substr(0, at + random() % kRecord);
    case 1:
      how = "one record left out";
      return changed.erase(at, kRecord);
    case 2:
      how = "two records exchanged";
      if (at + 2 * kRecord > bytes.size()) return "";
      // Their times stay where they are.
      for (std::size_t i = 6; i < kRecord; ++i) {
        std::swap(changed[at + i], changed[at + kRecord + i]);
      }
      return changed;
    case 3:
      how = "another status";
      changed[at + 8] = static_cast<char>(random() % 4);
      return changed;
    default:
      how = "another node";
      changed[at + 6] = static_cast<char>(1 + random() % 4);
      return changed;
  }
}

// What a log says of which node in which tick. A node that is given back after
// its end says nothing; one that changes to what it is already, what no run
// says.
struct Said {
  std::uint16_t uid = 0;
  LogStatus status = LogStatus::Idle;
  std::int64_t tick = 0;

  friend bool operator==(const Said&, const Said&) = default;
};

std::vector<Said> said_in(const BehaviorLog& log) {
  std::vector<Said> said;
  TickCounter ticks(log, {});
  for (const LogTransition& record : log.transitions) {
    const std::int64_t tick = ticks.tick_at(record.time);
    const bool is_over =
        record.after == LogStatus::Idle || record.after == LogStatus::Skipped;
    if (record.before == record.after) {
      said.push_back({0, record.after, tick});
      continue;
    }
    if (is_over && record.before != LogStatus::Running) continue;
    said.push_back(
        {record.uid, is_over ? LogStatus::Idle : record.after, tick});
  }
  return said;
}

enum class Written : std::uint8_t { Yes, No, Unknown };

// Whether a run of the tree writes this log.
class LogWriter {
 public:
  LogWriter(const Case& one, const BehaviorLog& log)
      : one_(one), wanted_(said_in(log)) {}

  Written run(std::size_t most) {
    most_ = most;
    std::vector<std::size_t> path;
    if (go_on(path)) return Written::Yes;
    return looks_ >= most_ ? Written::Unknown : Written::No;
  }

 private:
  Simulation after(const std::vector<std::size_t>& path) const {
    Simulation simulation(one_.tree, *one_.network, Interleaving::Open);
    for (const std::size_t choice : path) simulation.take(choice);
    return simulation;
  }

  // How many of the records the run has written; nothing when it writes others.
  std::optional<std::size_t> written(const Run& run) const {
    const auto log = read_log(
        "w.btlog", btlog_bytes(recorded(one_.tree, *one_.network, run, {}), 1));
    if (!log.value) return std::nullopt;
    const std::vector<Said> said = said_in(*log.value);
    const std::size_t count = std::min(said.size(), wanted_.size());
    if (!std::equal(said.begin(), said.begin() + count, wanted_.begin())) {
      return std::nullopt;
    }
    return count;
  }

  bool go_on(std::vector<std::size_t>& path) {
    if (++looks_ >= most_) return false;
    const Simulation here = after(path);
    const auto count = written(here.run());
    if (!count) return false;
    if (*count == wanted_.size()) return true;
    const bool is_new =
        seen_
            .insert({here.state().variables, here.state().clocks, *count,
                     here.ticks(one_.tree.roots[0])})
            .second;
    if (!is_new || here.end() != RunEnd::None) return false;
    for (std::size_t i = 0; i < here.choices().size(); ++i) {
      path.push_back(i);
      if (go_on(path)) return true;
      path.pop_back();
    }
    return false;
  }

  const Case& one_;
  std::vector<Said> wanted_;
  std::size_t most_ = 0;
  std::size_t looks_ = 0;
  std::set<std::tuple<std::vector<int>, std::vector<int>, std::size_t, int>>
      seen_;
};

TEST_CASE("a corrupted log is refused, or has another run") {
  std::mt19937 random(shifted_seed(20));
  int tried = 0;
  int refused = 0;
  int written = 0;
  int never_written = 0;
  const int wanted = by_effort(300, 1500);
  // Walking takes long, and most of it is the writing of logs.
  const auto looks = by_effort<std::size_t>(300, 3'000);
  const int most_walks = by_effort(60, 1500);
  int walks = 0;
  for (std::uint64_t seed = 5000; tried < wanted; ++seed) {
    const auto one = made(seed, seed % 2 == 1);
    if (!one) continue;
    const auto log = one->log();
    if (!log.value || log.value->transitions.size() < 4) continue;
    const std::size_t begin =
        one->bytes.size() - 9 * log.value->transitions.size();
    std::string how;
    const std::string bytes = corrupted(one->bytes, begin, random, how);
    if (bytes.empty() || bytes == one->bytes) continue;
    ++tried;
    CAPTURE(how);
    const auto read = read_log("run.btlog", bytes);
    if (!read.value) {  // it names a node that is not there
      ++refused;
      continue;
    }
    const Conformance found = conformed(*one, *read.value);
    if (found.refused) {
      ++refused;
      CHECK(*found.refused < read.value->transitions.size());
      CHECK(found.states.empty());
    } else if (found.stopped == StopReason::None) {
      CHECK(!found.states.empty());
    } else {
      continue;
    }
    if (walks == most_walks) continue;
    ++walks;
    CAPTURE(one->input.text);
    CAPTURE(log_text(*read.value));
    switch (LogWriter(*one, *read.value).run(looks)) {
      case Written::Yes:
        ++written;
        CHECK(!found.refused);
        break;
      case Written::No:
        ++never_written;
        CHECK(found.refused);
        break;
      case Written::Unknown:
        break;
    }
  }
  MESSAGE(refused << " of " << tried << " corrupted logs are refused; a run "
                  << "writes " << written << " others, and none "
                  << never_written << " of the refused");
  CHECK_COVERED(written > walks / 6);
  CHECK_COVERED(never_written > walks / 6);
  CHECK_COVERED(refused > tried / 2);
}

// --- Rules
// ---------------------------------------------------------------------

// A rule over what logs show of some nodes; with `is_whole` also variables.
std::string random_rule(std::mt19937& random, const BehaviorTree& tree,
                        bool is_whole) {
  const auto below = [&](std::size_t bound) { return random() % bound; };
  const auto atom = [&]() -> std::string {
    const std::size_t node = 1 + below(tree.nodes.size() - 1);
    const std::string name = fmt::format("btn{}", node);
    const bool is_leaf = tree.nodes[node].children.empty();
    switch (below(is_whole ? 9 : 8)) {
      case 0:
        return name + ".success";
      case 1:
        return name + ".failure";
      case 2:
        return name + ".ticked";
      case 3:
        return name + ".halted";
      case 4:
        return name + (is_leaf ? ".running" : ".ticked");
      case 5:
        return name + ".answer == success";
      case 6:
        return "root.success";
      case 7:
        return fmt::format("once {}.failure", name);
      default:
        break;
    }
    if (tree.variables.empty()) return name + ".success";
    const StateVariable& variable =
        tree.variables[below(tree.variables.size())];
    return fmt::format("{} == {}", variable.name,
                       variable.value_name(variable.min));
  };
  switch (below(8)) {
    case 0:
      return fmt::format("never ({}) and ({})", atom(), atom());
    case 1:
      return fmt::format("whenever {} then ({}) within {} ticks", atom(),
                         atom(), below(3));
    case 2:
      return fmt::format("({}) precedes ({})", atom(), atom());
    case 3:
      return fmt::format("possible {}", atom());
    case 4:
      return fmt::format("[] (({}) => <> ({}))", atom(), atom());
    case 5:
      return fmt::format("in no tick: ({}) and ({})", atom(), atom());
    case 6:
      return fmt::format("absent {} after {}", atom(), atom());
    default:
      return fmt::format("(not ({})) U ({})", atom(), atom());
  }
}

// The outlook of each rule by the monitors of the network.
// `goes_on`: where the tree has ended, time is seen to pass behind the run.
std::vector<Outlook> seen_by_network(const Case& one, const BoundFile& bound,
                                     const SourceText& source, bool goes_on) {
  const auto monitors = monitors_of(bound, source);
  REQUIRE(monitors.value);
  RunMonitor watch(*one.network, *monitors.value);
  watch.see(one.run.initial, 0);
  for (const RunStep& step : one.run.steps) {
    watch.see(step.after, step.step.elapsed);
  }
  if (goes_on && !one.run.steps.empty()) {
    const auto& last = one.run.steps.back().after;
    const VariableId status =
        one.network->node_status[index(one.tree.roots.at(0))];
    const auto answered =
        static_cast<NodeStatus>(last.variables[index(status)]);
    const bool has_ended =
        answered == NodeStatus::Success || answered == NodeStatus::Failure;
    if (has_ended) watch.see(last, 1);
  }
  std::vector<Outlook> outlooks;
  for (const RunMonitor::Seen& seen : watch.rules()) {
    outlooks.push_back(seen.run.outlook());
  }
  return outlooks;
}

std::string_view name_of(Outlook outlook) {
  return kOutlookNames[static_cast<std::size_t>(outlook)];
}

TEST_CASE("what is said of a recording is so of the run") {
  std::mt19937 random(shifted_seed(21));
  int decided = 0;
  int agreed = 0;
  int timelessly = 0;
  int guessed = 0;
  const int cases = by_effort(300, 2000);
  for (int i = 0; i < cases; ++i) {
    const bool is_xml = i % 3 == 2;
    // Side by side, the branches of a .btf tree interleave more freely than a
    // log can tell: it has when nodes are called and give control back.
    RandomTreeWeights one_by_one;
    one_by_one.max_parallels = 0;
    auto one = made(9000 + static_cast<std::uint64_t>(i), is_xml, one_by_one);
    if (!one || one->tree.nodes.size() < 2) continue;
    for (const bool is_whole : {false, true}) {
      std::string text;
      for (int r = 0; r < 4; ++r) {
        text += fmt::format("property p{}: {}\n", r,
                            random_rule(random, one->tree, is_whole));
      }
      const auto file = read_properties("r.ltl", text);
      if (!file.value) continue;
      const SourceText source("r.ltl", text);
      CAPTURE(one->input.text);
      CAPTURE(text);
      auto bound = network_for(one->tree, {one->input.name, one->input.text},
                               *file.value, source, TickSemantics::Root);
      if (!bound.value) continue;
      run_again(*one, std::move(bound.value->network), 9000 + i);
      const std::vector<Outlook> real =
          seen_by_network(*one, bound.value->bound, source, !is_whole);
      if (is_whole) {
        const auto kept =
            watch_run("r.itf.json", one->recorded, *file.value, source);
        REQUIRE(kept.value);
        for (std::size_t r = 0; r < real.size(); ++r) {
          CAPTURE(r);
          CHECK(name_of(kept.value->rules[r].outlook) == name_of(real[r]));
        }
        continue;
      }
      const auto log = one->log();
      if (!log.value) continue;
      CAPTURE(log_text(*log.value));
      const auto told =
          watch_log("r.btlog", *log.value, {}, *file.value, source);
      if (!told.value) {  // side by side
        CHECK(told.diagnostics.at(0).code == "BT1805");
        continue;
      }
      for (std::size_t r = 0; r < real.size(); ++r) {
        CAPTURE(r);
        const Outlook outlook = told.value->rules[r].outlook;
        if (real[r] != Outlook::Open) ++decided;
        if (outlook == Outlook::Open) continue;
        CHECK(name_of(outlook) == name_of(real[r]));
        ++agreed;
      }
      // The same as a robot logs it, with times that say nothing of ticks.
      BehaviorLog timeless = *log.value;
      timeless.begin = 1;
      std::int64_t time = 0;
      for (LogTransition& record : timeless.transitions) {
        constexpr std::array<std::int64_t, 4> kPauses = {0, 3, 4'000, 90'000};
        record.time = time += kPauses[random() % kPauses.size()];
      }
      const auto without =
          watch_log("r.btlog", timeless, {}, *file.value, source);
      REQUIRE(without.value);
      for (std::size_t r = 0; r < real.size(); ++r) {
        CAPTURE(r);
        const WatchedRule& rule = without.value->rules[r];
        guessed += rule.guess == TickGuess::Begin;
        if (rule.outlook == Outlook::Open) continue;
        CHECK(name_of(rule.outlook) == name_of(real[r]));
        ++timelessly;
      }
    }
  }
  MESSAGE("of " << decided << " decided rules the log decides " << agreed
                << ", without ticks " << timelessly << "; " << guessed
                << " rest on where ticks begin");
  CHECK_COVERED(agreed > decided / 2);
  CHECK_COVERED(timelessly > decided / 8);
  CHECK_COVERED(guessed > 0);
}

// --- From where a run has come to
// ---------------------------------------------

TEST_CASE("a kept run leads to where it has been") {
  int runs = 0;
  for (int seed = 0; seed < by_effort(150, 1000); ++seed) {
    const auto one = made(20000 + static_cast<std::uint64_t>(seed), seed % 2);
    if (!one) continue;
    CAPTURE(one->input.text);
    const auto read = read_itf("r.itf.json", itf_text(one->recorded));
    REQUIRE(read.value);
    const auto states =
        states_after("r", one->tree, *one->network, *read.value, std::nullopt);
    REQUIRE(states.value);
    CHECK(std::ranges::find(*states.value, last_state(one->run)) !=
          states.value->end());
    ++runs;
  }
  CHECK(runs > 50);
}

}  // namespace
}  // namespace btcheck::reference::recordings_cross_check_test
