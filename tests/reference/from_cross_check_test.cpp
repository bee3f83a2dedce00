// SPDX-License-Identifier: MIT
//
// `--from` against enumeration. A run of a random tree is kept as ITF or as a
// log, and all questions are asked from there, as the command does. They are
// asked of the written-out space, too: of the part that can be reached from
// where the run itself has come to.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "cli/from.hpp"
#include "model/lowering.hpp"
#include "reference/effort.hpp"
#include "reference/naive_defaults.hpp"
#include "reference/naive_verdict.hpp"
#include "reference/random_run.hpp"
#include "reference/random_tree.hpp"
#include "temporary_folder.hpp"
#include "trace/conform/start.hpp"
#include "trace/run/itf.hpp"
#include "trace/run/record.hpp"

namespace btcheck::reference::from_cross_check_test {
namespace {

constexpr std::size_t kMostStates = 3000;
constexpr int kRules = 4;               // of one run
constexpr std::size_t kMostStarts = 8;  // of one log

struct Counts {
  int clocks = 0;   // runs from whose end nothing can be asked
  int several = 0;  // logs that leave several states open
  int reports = 0;
  int rules = 0;
  int violated = 0;
  int others = 0;  // rules of another verdict than from the beginning
  int past_violated = 0;
};

// What can be reached from one of the states, which becomes the first.
NaiveSpace part_from(const NaiveSpace& whole, std::size_t start) {
  std::vector<std::size_t> order = {start};
  std::vector<std::optional<std::size_t>> number(whole.states.size());
  number[start] = 0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    for (const NaiveSpace::Step& step : whole.steps[order[i]]) {
      if (number[step.target]) continue;
      number[step.target] = order.size();
      order.push_back(step.target);
    }
  }
  NaiveSpace part;
  for (const std::size_t s : order) {
    part.states.push_back(whole.states[s]);
    part.dead.push_back(whole.dead[s]);
    part.steps.push_back(whole.steps[s]);
    for (auto& step : part.steps.back()) step.target = *number[step.target];
  }
  return part;
}

// A tree with its space, and a run of it.
struct Case {
  std::string text;
  BehaviorTree tree;
  TickSemantics ticks = TickSemantics::Root;
  Network network;
  NaiveSpace space;
  Run run;
  RecordedRun kept;
  std::optional<int> tick;  // at whose end questions are asked
  std::size_t end = 0;      // the state of the run that this is

  std::size_t number_of(const Valuation& state) const {
    const auto found = std::ranges::find(
        space.states, NaiveState{state.variables, state.clocks});
    REQUIRE(found != space.states.end());
    return static_cast<std::size_t>(found - space.states.begin());
  }
  bool has_clock(std::size_t state) const {
    return std::ranges::any_of(space.states[state].clocks,
                               [](int clock) { return clock > 0; });
  }
};

RandomTreeWeights weights_of(std::uint64_t seed) {
  RandomTreeWeights weights;
  if (seed % 3 == 1) weights = timed_weather();
  if (seed % 3 == 2) {
    weights.looping_root = 80;
    weights.contract = 40;
    weights.moving_number = 30;
  }
  return weights;
}

// Nothing for trees of large spaces.
std::optional<Case> made(std::uint64_t seed, TickSemantics ticks) {
  Case made;
  made.text = random_tree(seed, weights_of(seed));
  auto tree = read_btf("t.btf", made.text);
  REQUIRE(tree.value);
  made.tree = std::move(*tree.value);
  made.ticks = ticks;
  made.network = lower(made.tree, ticks);
  auto space = naive_space(made.network, kMostStates);
  if (!space) return std::nullopt;
  made.space = std::move(*space);
  SplitMix64 random(seed);
  made.run = random_run(made.tree, made.network, seed, random.below(6));
  made.kept = recorded(made.tree, made.network, made.run, {});
  made.end = made.run.steps.size();
  if (random.percent(50)) {
    const int last = made.kept.states.back().tick;
    made.tick = made.kept.states[0].tick +
                random.below(last - made.kept.states[0].tick + 1);
    while (made.kept.states[made.end].tick > *made.tick) --made.end;
  }
  return made;
}

// What is asked from a file; without rules, the default report.
CheckResult asked(const Case& one, const std::string& file,
                  const std::string& bytes, std::uint64_t seed,
                  const std::string& rules = "") {
  const TemporaryFolder folder;
  Options options;
  options.from = folder.path() / file;
  options.from_tick = one.tick;
  std::ofstream(options.from, std::ios::binary) << bytes;
  CheckOptions how;
  how.ticks = one.ticks;
  how.choices.reduction = static_cast<Reduction>(seed % 3);
  how.wants_shortest = false;
  std::vector<InputFile> properties;
  if (!rules.empty()) properties.push_back({"r.ltl", rules});
  auto result = check_from(options, {"t.btf", one.text}, properties, how);
  REQUIRE(result);
  return std::move(*result);
}

// Of the error that keeps the questions from being asked, "" where they are.
std::string code_of(const CheckResult& result) {
  const auto found = std::ranges::find(result.diagnostics, Severity::Error,
                                       &Diagnostic::severity);
  return found == result.diagnostics.end() ? "" : std::string(found->code);
}

std::vector<RandomProperty> random_rules(const Case& one, std::uint64_t seed) {
  SplitMix64 random(seed);
  const std::size_t states = one.space.states.size();
  PropertyWeights weights;
  weights.most_temporal = states < 100 ? 3 : states < 300 ? 2 : 1;
  weights.response = weights.timed =
      one.ticks != TickSemantics::None && states < 300;
  weights.branching = states < 300;
  std::vector<RandomProperty> rules;
  for (int r = 0; r < kRules; ++r) {
    rules.push_back(random_property(one.tree, one.network, random, weights));
  }
  return rules;
}

std::string text_of(const std::vector<RandomProperty>& rules) {
  std::string text;
  for (const RandomProperty& rule : rules) {
    text += fmt::format("property p{}: {}\n", text.size(), rule.body);
  }
  return text;
}

// Rules hold when they hold from each of the starts.
void compare_rules(const Case& one, const CheckResult& result,
                   const std::vector<RandomProperty>& rules,
                   const std::set<std::size_t>& starts, Counts& counts) {
  REQUIRE(result.files.size() == 1);
  for (std::size_t r = 0; r < rules.size(); ++r) {
    CAPTURE(rules[r].body);
    const PropertyVerdict& found = result.files[0].verdicts.at(r);
    REQUIRE(found.error == "");
    const auto at_first =
        naive_verdict(one.tree, one.network, one.space, rules[r]);
    if (!at_first) continue;
    const bool holds = std::ranges::all_of(starts, [&](std::size_t start) {
      return naive_verdict(one.tree, one.network, part_from(one.space, start),
                           rules[r])
          ->holds;
    });
    CHECK((found.verdict == Verdict::Holds) == holds);
    CHECK(found.verdict != Verdict::Undecided);
    ++counts.rules;
    counts.violated += !holds;
    counts.others += holds != at_first->holds;
  }
}

// `never (P since Q) and R`, where P is any state of a `once Q`.
struct PastRule {
  std::string text;
  StateTest held;   // P
  StateTest began;  // Q
  StateTest now;    // R
};

PastRule past_rule(const Case& one, std::uint64_t seed) {
  constexpr std::pair<const char*, const char*> kEvents[] = {
      {"ticked", "tick_node"},
      {"success", "success"},
      {"failure", "failure"},
      {"running", "running"}};
  SplitMix64 random(seed);
  PastRule rule;
  const auto event = [&](StateTest& test) {
    const int node = random.below(static_cast<int>(one.tree.nodes.size()));
    const auto& [word, location] = kEvents[random.below(4)];
    test = node_event(one.network, NodeId{static_cast<std::uint32_t>(node)},
                      location);
    return fmt::format("btn{}.{}", node, word);
  };
  const std::string began = event(rule.began);
  std::string past = "once " + began;
  rule.held = [](const NaiveSpace&, std::size_t) { return true; };
  if (random.percent(50)) {
    past = fmt::format("not {} since {}", event(rule.held), began);
    rule.held = [of = rule.held](const NaiveSpace& space, std::size_t s) {
      return !of(space, s);
    };
  }
  rule.text =
      fmt::format("property past: never ({}) and {}\n", past, event(rule.now));
  return rule;
}

// What the rule asks for still comes, after what the run has been through.
bool comes(const Case& one, const PastRule& rule) {
  const auto remembers = [&](bool before, std::size_t s) {
    return rule.began(one.space, s) || (before && rule.held(one.space, s));
  };
  std::pair<std::size_t, bool> start{0, false};
  for (std::size_t i = 0; i <= one.end; ++i) {
    start.first = one.number_of(one.run.state(i));
    start.second = remembers(start.second, start.first);
  }
  std::set<std::pair<std::size_t, bool>> seen = {start};
  std::vector<std::pair<std::size_t, bool>> open = {start};
  for (std::size_t i = 0; i < open.size(); ++i) {
    const auto [state, memory] = open[i];
    if (memory && rule.now(one.space, state)) return true;
    for (const NaiveSpace::Step& step : one.space.steps[state]) {
      const std::pair next{step.target, remembers(memory, step.target)};
      if (seen.insert(next).second) open.push_back(next);
    }
  }
  return false;
}

void compare_report(const Case& one, const CheckResult& result,
                    std::size_t start, Counts& counts) {
  REQUIRE(result.files.size() == 1);
  CHECK(flaw_of(*result.files[0].defaults, one.tree, one.network,
                part_from(one.space, start)) == "");
  ++counts.reports;
}

// Whether the end of the run and one of the states lead to the same: a log has
// the call of a node one step earlier, and branches one after another.
bool meet_end(const Case& one, const std::set<std::size_t>& states) {
  const auto reached_from = [&](std::size_t from) {
    auto reached = part_from(one.space, from).states;
    std::ranges::sort(reached);
    return reached;
  };
  const auto behind_end = reached_from(one.number_of(one.run.state(one.end)));
  return std::ranges::any_of(states, [&](std::size_t state) {
    std::vector<NaiveState> both;
    std::ranges::set_intersection(reached_from(state), behind_end,
                                  std::back_inserter(both));
    return !both.empty();
  });
}

TickSemantics ticks_of(std::uint64_t seed) {
  constexpr TickSemantics kAll[] = {TickSemantics::Root, TickSemantics::Root,
                                    TickSemantics::Leaves, TickSemantics::Nodes,
                                    TickSemantics::None};
  return kAll[seed % std::size(kAll)];
}

}  // namespace

TEST_CASE("from where a kept run ends all answers are those of that state") {
  const std::uint64_t first = 30000 + seed_or(0) * 1'000'000;
  Counts counts;
  for (int i = 0; i < by_effort(300, 6000); ++i) {
    const std::uint64_t seed = first + static_cast<std::uint64_t>(i);
    const auto one = made(seed, ticks_of(seed));
    if (!one) continue;
    CAPTURE(seed);
    CAPTURE(one->text);
    const std::size_t start = one->number_of(one->run.state(one->end));
    const std::string file = itf_text(one->kept);
    const CheckResult report = asked(*one, "r.itf.json", file, seed);
    if (one->has_clock(start)) {
      CHECK(code_of(report) == "BT1810");
      ++counts.clocks;
      continue;
    }
    REQUIRE(code_of(report) == "");
    compare_report(*one, report, start, counts);
    const auto rules = random_rules(*one, seed);
    const PastRule past = past_rule(*one, seed);
    const CheckResult answers =
        asked(*one, "r.itf.json", file, seed, text_of(rules) + past.text);
    REQUIRE(code_of(answers) == "");
    compare_rules(*one, answers, rules, {start}, counts);
    CAPTURE(past.text);
    const bool comes_yet = comes(*one, past);
    CHECK((answers.files[0].verdicts.back().verdict == Verdict::Violated) ==
          comes_yet);
    counts.past_violated += comes_yet;
  }
  MESSAGE(counts.reports << " reports and " << counts.rules << " rules agree, "
                         << counts.violated << " violated, " << counts.others
                         << " not as from the beginning; of as many rules "
                            "about the past as reports "
                         << counts.past_violated
                         << " are violated; a clock runs at " << counts.clocks
                         << " ends");
  CHECK_COVERED(counts.reports > 100);
  CHECK_COVERED(counts.past_violated > counts.reports / 20);
  CHECK_COVERED(counts.clocks > 10);
  CHECK_COVERED(counts.violated > counts.rules / 5);
  CHECK_COVERED(counts.others > counts.rules / 40);
}

TEST_CASE("from where a log ends all answers are those of the states there") {
  const std::uint64_t first = 60000 + seed_or(0) * 1'000'000;
  Counts counts;
  for (int i = 0; i < by_effort(200, 4000); ++i) {
    const std::uint64_t seed = first + static_cast<std::uint64_t>(i);
    const auto one = made(seed, TickSemantics::Root);
    if (!one || one->tree.roots.size() != 1) continue;
    CAPTURE(seed);
    CAPTURE(one->text);
    const std::string bytes = btlog_bytes(one->kept, 1);
    const auto log = read_log("r.btlog", bytes);
    if (!log.value) continue;  // a tree of no logged node
    const auto states =
        states_after("r.btlog", one->tree, one->network,
                     recorded_tree(one->tree, {"t.btf", one->text}), *log.value,
                     {}, one->tick, Limits{});
    REQUIRE(states.value);
    std::set<std::size_t> starts;
    for (const Valuation& state : *states.value) {
      starts.insert(one->number_of(state));
    }
    CHECK(meet_end(*one, starts));
    if (starts.size() > kMostStarts) continue;
    const CheckResult report = asked(*one, "r.btlog", bytes, seed);
    const auto rules = random_rules(*one, seed);
    const CheckResult answers =
        asked(*one, "r.btlog", bytes, seed, text_of(rules));
    if (std::ranges::any_of(
            starts, [&](auto start) { return one->has_clock(start); })) {
      CHECK(code_of(report) == "BT1810");
      CHECK(code_of(answers) == "BT1810");
      ++counts.clocks;
      continue;
    }
    if (starts.size() > 1) {
      CHECK(code_of(report) == "BT1809");
      ++counts.several;
    } else {
      compare_report(*one, report, *starts.begin(), counts);
    }
    compare_rules(*one, answers, rules, starts, counts);
  }
  MESSAGE(counts.reports << " reports and " << counts.rules << " rules agree, "
                         << counts.violated << " violated, " << counts.others
                         << " not as from the beginning; " << counts.several
                         << " logs leave several states, with clocks "
                         << counts.clocks);
  CHECK_COVERED(counts.reports > 30);
  CHECK_COVERED(counts.several > 30);
  CHECK_COVERED(counts.clocks > 5);
  CHECK_COVERED(counts.others > counts.rules / 40);
}

}  // namespace btcheck::reference::from_cross_check_test
