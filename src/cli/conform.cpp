// SPDX-License-Identifier: MIT
//
// `btcheck conform LOG... [TREE]`: could the tree have written these logs?
#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "check/questions/defaults.hpp"
#include "cli/commands.hpp"
#include "cli/console/console.hpp"
#include "cli/inputs/files.hpp"
#include "cli/inputs/inputs.hpp"
#include "cli/inputs/watch.hpp"
#include "cli/recordings.hpp"
#include "model/tree/node_types.hpp"
#include "report/text/report.hpp"
#include "trace/conform/conform.hpp"
#include "trace/conform/evidence_of_logs.hpp"
#include "trace/logs/behavior_log.hpp"
#include "trace/run/record.hpp"

namespace btcheck {
namespace {

constexpr std::string_view kIndent = "           ";

struct NamedLog {
  std::string name;
  BehaviorLog log;
};

// What the command line names.
struct Recordings {
  std::vector<NamedLog> logs;
  std::string tree;  // "" where none is named
};

std::optional<Recordings> read_recordings(const Options& options,
                                          const Limits& limits) {
  Recordings read;
  std::vector<Diagnostic> found;
  for (const std::string& name : options.inputs) {
    auto file = read_file_in(options.roots, name);
    found.insert(found.end(), file.diagnostics.begin(), file.diagnostics.end());
    if (!file.value) continue;
    if (is_log(name, file.value->text)) {
      auto log = read_whole_log(options, name, file.value->text, limits);
      found.insert(found.end(), log.diagnostics.begin(), log.diagnostics.end());
      if (log.value) read.logs.push_back({name, std::move(*log.value)});
    } else if (read.tree.empty()) {
      read.tree = name;
    } else {
      found.push_back(file_error(
          "BT1302", name, "this is no log of BehaviorTree.CPP",
          fmt::format("the tree is {}; all others are logs", read.tree)));
    }
  }
  if (read.logs.empty() && !has_error(found)) {
    found.push_back(file_error("BT1302", read.tree,
                               "this is no log of BehaviorTree.CPP",
                               "btcheck conform robot.btlog"));
  }
  show(options, found);
  if (has_error(found)) return std::nullopt;
  return read;
}

std::string shown_event(const BehaviorTree& tree, const LogEvent& event) {
  return fmt::format("{} -> {}", short_name(tree, event.node),
                     kLogStatusNames[static_cast<std::size_t>(event.status)]);
}

// What a record that no run takes may mean.
std::string meaning_of(const BehaviorTree& tree, const LogEvent& refused,
                       const Conformance& found) {
  const std::string name = short_name(tree, refused.node);
  if (!found.contradiction.empty()) {
    return fmt::format("the log contradicts itself: {}", found.contradiction);
  }
  if (found.is_in_wrong_tick) {
    return "it may come in another tick: a duration outside its contract, or a "
           "record missing";
  }
  if (found.allowed.empty()) {
    return "the tree has ended and does nothing more; --loop ticks it again";
  }
  const bool is_asked = std::ranges::any_of(
      found.allowed,
      [&](const LogEvent& allowed) { return allowed.node == refused.node; });
  const Node& node = tree.node(refused.node);
  if (is_asked && node.children.empty()) {
    return fmt::format(
        "`{}` has a turn here and may not answer so: a leaf "
        "outside its contract ({})",
        name, line_of(tree, refused.node));
  }
  return fmt::format(
      "`{}` has no turn here: another profile or release of the engine, or "
      "another tree ({})",
      name, line_of(tree, refused.node));
}

// The events allowed, the first few.
std::string allowed_text(const BehaviorTree& tree,
                         const std::vector<LogEvent>& allowed) {
  constexpr std::size_t kMostTold = 8;
  std::string text;
  for (std::size_t i = 0; i < allowed.size() && i < kMostTold; ++i) {
    text += (i == 0 ? "" : ", ") + shown_event(tree, allowed[i]);
  }
  return text + (allowed.size() > kMostTold ? ", ..." : "");
}

// Lets a leaf run as long as it likes; false where it may already.
bool forget_duration(Node& leaf) {
  const bool is_bound =
      leaf.type == NodeType::Action && leaf.duration.has_value();
  if (is_bound) {
    leaf.duration.reset();
    leaf.contract.may_run = true;
  }
  return is_bound;
}

// Lets a leaf answer as it likes; false where it may already.
bool forget_answers(Node& leaf) {
  LeafContract& contract = leaf.contract;
  const LeafContract any;
  const bool may_run = leaf.type == NodeType::Action;
  const bool is_bound = !contract.may_succeed || !contract.may_fail ||
                        (may_run && !contract.may_run) ||
                        contract.requirement_program != kNoProgram ||
                        contract.decision_program != kNoProgram ||
                        !contract.requirement.is_true() ||
                        !contract.decision.is_true();
  if (is_bound) {
    contract.may_succeed = contract.may_fail = true;
    contract.may_run = may_run;
    contract.requirement = any.requirement;
    contract.decision = any.decision;
    contract.unmet = any.unmet;
    contract.decided_against = any.decided_against;
    contract.requirement_program = contract.decision_program = kNoProgram;
  }
  return is_bound;
}

std::string told(const NamedLog& named, const BehaviorTree& tree,
                 const LoggedNodes& nodes, const Conformance& found,
                 const std::string& left_contract,
                 const std::string& other_profile) {
  const std::size_t count = named.log.transitions.size();
  if (found.stopped != StopReason::None) {
    return fmt::format("UNDECIDED  {}\n{}{}\n", named.name, kIndent,
                       stop_text(found.stopped, found.progress));
  }
  if (!found.refused) {
    return fmt::format("CONFORMS   {}  ({}, {} states)\n", named.name,
                       counted(count, "record", "records"),
                       grouped(found.progress.states));
  }
  const LogTransition record = *found.refused < count
                                   ? named.log.transitions[*found.refused]
                                   : LogTransition{};
  const LogEvent event = found.refused_answer
                             ? *found.refused_answer
                             : LogEvent{nodes.node(record.uid), record.after};
  const auto status_name = [](LogStatus status) {
    return kLogStatusNames[static_cast<std::size_t>(status)];
  };
  std::string text =
      found.refused_answer
          ? fmt::format("REFUSED    {}  (tick {})\n{}{} answers {}\n",
                        named.name, found.tick, kIndent,
                        short_name(tree, event.node), status_name(event.status))
          : fmt::format(
                "REFUSED    {}  (record {} of {}, after {} s)\n"
                "{}{} {} -> {}\n",
                named.name, *found.refused + 1, count,
                seconds_text(record.time), kIndent,
                short_name(tree, event.node), status_name(record.before),
                status_name(record.after));
  if (!found.allowed.empty()) {
    text += fmt::format("{}the tree could do: {}\n", kIndent,
                        allowed_text(tree, found.allowed));
  }
  text += fmt::format(
      "{}{}\n", kIndent,
      left_contract.empty() ? meaning_of(tree, event, found) : left_contract);
  if (!other_profile.empty()) {
    text += fmt::format("{}with --profile {} the log conforms\n", kIndent,
                        other_profile);
  }
  return text;
}

class Following {
 public:
  Following(const Options& options, Recordings read, Lowered lowered,
            Watch& watch)
      : options_(options),
        read_(std::move(read)),
        lowered_(std::move(lowered)),
        watch_(watch),
        system_(lowered_.network),
        run_(recorded_tree(lowered_.tree, lowered_.input)),
        evidence_(lowered_.tree) {}

  ExitCode run() {
    const BehaviorTree& tree = lowered_.tree;
    std::string text = fmt::format(
        "{}: {}, {}; profile {}, tick {}\n", tree.file,
        counted(tree.nodes.size(), "node", "nodes"),
        counted(tree.variables.size(), "variable", "variables"),
        profile_name(tree.profile), tick_name(lowered_.network.ticks));
    for (NamedLog& named : read_.logs) {
      auto log = placed(std::move(named.log), tree, run_);
      for (Diagnostic& found : log.diagnostics) found.file = named.name;
      show(options_, log.diagnostics);
      if (!log.value) return ExitCode::BadInput;
      named.log = std::move(*log.value);
      const auto nodes = LoggedNodes::match(named.log, tree, run_);
      if (!nodes.value) {
        Diagnostic found = nodes.diagnostics.front();
        found.file = named.name;
        show(options_, {found});
        return ExitCode::BadInput;
      }
      text += judged(named, *nodes.value);
    }
    watch_.monitor.clear();
    if (options_.tells_coverage) text += coverage();
    print(text);
    return worst_of(learned(), worst_of(code_, lowered_.code()));
  }

 private:
  std::string judged(const NamedLog& named, const LoggedNodes& nodes) {
    const Conformance found =
        conform(lowered_.tree, system_, named.log, nodes, watch_.limits);
    if (found.stopped != StopReason::None) {
      code_ = worst_of(code_, ExitCode::Undecided);
    } else if (found.refused) {
      code_ = worst_of(code_, ExitCode::Missed);
    } else {
      evidence_.add(named.log, nodes, reading_of(options_));
    }
    const bool is_refused = found.refused && found.contradiction.empty();
    std::string contract;
    if (is_refused) contract = left_contract(named.log, nodes, found);
    const bool is_other = is_refused && contract.empty();
    return told(named, lowered_.tree, nodes, found, contract,
                is_other ? other_profile(named.log) : "");
  }

  // A leaf and the clause of its contract without which a refused log goes on,
  // in words; "" for none. Of several, the one that goes on furthest.
  std::string left_contract(const BehaviorLog& log, const LoggedNodes& nodes,
                            const Conformance& refused) const {
    std::vector<NodeId> leaves;  // that the log knows by then
    const std::size_t count =
        std::min(*refused.refused + 1, log.transitions.size());
    for (std::size_t i = 0; i < count; ++i) {
      const NodeId node = nodes.node(log.transitions[i].uid);
      if (!lowered_.tree.node(node).children.empty()) continue;
      if (std::ranges::find(leaves, node) == leaves.end()) {
        leaves.push_back(node);
      }
    }
    for (const bool is_time : {true, false}) {
      const auto forget = is_time ? forget_duration : forget_answers;
      if (!goes_on(log, nodes, refused, leaves, forget)) continue;
      Conformance furthest = refused;
      NodeId leaf{};
      for (const NodeId each : leaves) {
        const auto found = goes_on(log, nodes, furthest, {each}, forget);
        if (!found) continue;
        furthest = *found;
        leaf = each;
        if (furthest.conforms()) break;
      }
      if (furthest.records == refused.records && !furthest.conforms()) continue;
      const Node& node = lowered_.tree.node(leaf);
      const std::string clause =
          is_time ? ":duration " + duration_text(*node.duration)
                  : "what it answers, and when";
      return fmt::format(
          "`{}` leaves its contract ({}): without it the log {} ({})",
          short_name(lowered_.tree, leaf), clause,
          furthest.conforms()
              ? "conforms"
              : fmt::format("goes on to record {}", *furthest.refused + 1),
          line_of(lowered_.tree, leaf));
    }
    return "";
  }

  // What becomes of a log where these leaves forget a clause; nothing where it
  // goes no further than before.
  std::optional<Conformance> goes_on(const BehaviorLog& log,
                                     const LoggedNodes& nodes,
                                     const Conformance& before,
                                     const std::vector<NodeId>& leaves,
                                     bool (*forget)(Node&)) const {
    BehaviorTree tree = lowered_.tree;
    bool is_other = false;
    for (const NodeId leaf : leaves)
      is_other |= forget(tree.nodes[index(leaf)]);
    if (!is_other) return std::nullopt;
    const TreeInput& input = lowered_.input;
    const auto network =
        lower_values(tree, {input.name, input.text}, lowered_.network.ticks);
    if (!network.value) return std::nullopt;
    const CompiledNetwork system(*network.value);
    Conformance found = conform(tree, system, log, nodes, watch_.limits);
    const bool is_further = found.conforms() || found.records > before.records;
    return is_further ? std::optional(std::move(found)) : std::nullopt;
  }

  // Those of its own family first, the newest of them first.
  static std::vector<Profile> others_of(Profile own) {
    std::vector<Profile> others;
    for (std::size_t i = kProfiles.size(); i-- > 0;) {
      const auto profile = static_cast<Profile>(i);
      if (is_engine(profile) && profile != own) others.push_back(profile);
    }
    std::stable_partition(others.begin(), others.end(), [&](Profile each) {
      return has_nav2(each) == has_nav2(own);
    });
    return others;
  }

  // A profile with which the log conforms, "" for none.
  std::string other_profile(const BehaviorLog& log) {
    const Profile own = lowered_.tree.profile;
    if (!is_engine(own)) return "";
    for (const Profile profile : others_of(own)) {
      TreeInput input = lowered_.input;
      input.reading.profile = profile;
      const auto tree = read_tree(input.name, input.text, input.reading);
      if (!tree.value) continue;
      const auto network =
          lower_values(*tree.value, {input.name, input.text},
                       options_.ticks.value_or(TickSemantics::Root));
      if (!network.value) continue;
      const auto nodes = LoggedNodes::match(log, *tree.value,
                                            recorded_tree(*tree.value, input));
      if (!nodes.value) continue;
      const CompiledNetwork system(*network.value);
      const Conformance found =
          conform(*tree.value, system, log, *nodes.value, watch_.limits);
      if (found.conforms()) return std::string(profile_name(profile));
    }
    return "";
  }

  std::string coverage() {
    const DefaultReport report =
        check_defaults(lowered_.tree, system_, Reduction::Full, watch_.limits);
    watch_.monitor.clear();
    const auto covered = evidence_.coverage(report);
    std::string text =
        fmt::format("\nShown by logs: {} of {} that nodes can do\n",
                    covered.seen, covered.possible);
    for (const std::string& line : evidence_.unseen(report)) {
      text += fmt::format("  not shown  {}\n", line);
    }
    if (report.stopped != StopReason::None) {
      code_ = worst_of(code_, ExitCode::Undecided);
      text += stop_text(report.stopped, report.progress, report.open) + "\n";
    }
    return text;
  }

  // Only where every log conforms: others are of something else.
  ExitCode learned() {
    if (options_.learned.empty()) return ExitCode::Met;
    if (code_ == ExitCode::Missed) {
      tell("nothing is learned: a log does not conform\n");
      return ExitCode::Met;
    }
    return write_output(options_.learned, evidence_.leaves_text());
  }

  const Options& options_;
  Recordings read_;
  Lowered lowered_;
  Watch& watch_;
  CompiledNetwork system_;
  RecordedRun run_;
  LogEvidence evidence_;
  ExitCode code_ = ExitCode::Met;
};

}  // namespace

ExitCode run_conform(const Options& options) {
  Watch watch(options);
  auto read = read_recordings(options, watch.limits);
  if (!read) {
    return watch.limits.reached({}) == StopReason::None ? ExitCode::BadInput
                                                        : ExitCode::Undecided;
  }
  // Whether it is ticked again once it has ended is up to the robot's program.
  const bool loops = std::ranges::any_of(
      read->logs, [](const NamedLog& named) { return !is_own(named.log); });
  const NamedLog& first = read->logs.front();
  auto lowered = tree_of_log(options, read->tree, first.name, first.log, loops);
  if (!lowered) return ExitCode::BadInput;
  return Following(options, std::move(*read), std::move(*lowered), watch).run();
}

}  // namespace btcheck
