// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "model/tree/node_types.hpp"
#include "report/explain/text.hpp"
#include "report/text/report.hpp"
#include "report/whatif/words.hpp"
#include "trace/logs/behavior_log.hpp"

namespace btcheck {
namespace {

constexpr std::size_t kMostTimes = 6;   // listed of one node
constexpr std::size_t kMostOthers = 4;  // suspects besides the first
constexpr std::size_t kMostSteps = 8;   // of a way

std::string seconds(std::int64_t time) { return seconds_text(time) + " s"; }

std::string joined(const std::vector<std::string>& words,
                   std::string_view last = " and ") {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i) {
    text += i == 0 ? "" : i + 1 == words.size() ? last : ", ";
    text += words[i];
  }
  return text;
}

std::string at_text(const LogMoments& moments, std::size_t moment) {
  const Moment& there = moments.at(moment);
  return moments.knows_ticks() ? fmt::format("in tick {}", there.tick)
                               : fmt::format("after {}", seconds(there.time));
}
std::string from_text(const LogMoments& moments, std::size_t moment) {
  const Moment& there = moments.at(moment);
  return moments.knows_ticks() ? fmt::format("tick {}", there.tick)
                               : seconds(there.time);
}

// "in ticks 4, 6 and 9", "after 0.412 s and 0.530 s".
std::string at_text(const LogMoments& moments,
                    const std::vector<std::size_t>& at) {
  std::vector<std::string> words;
  for (const std::size_t each : at) {
    const Moment& moment = moments.at(each);
    auto word = moments.knows_ticks() ? fmt::format("{}", moment.tick)
                                      : seconds(moment.time);
    if (words.empty() || words.back() != word) words.push_back(std::move(word));
  }
  if (words.empty()) return "";
  if (words.size() > kMostTimes) {
    const std::string times = counted(at.size(), "time", "times");
    return moments.knows_ticks() ? fmt::format("{} from tick {} to {}", times,
                                               words.front(), words.back())
                                 : fmt::format("{} between {} and {}", times,
                                               words.front(), words.back());
  }
  const std::string_view before = !moments.knows_ticks() ? "after "
                                  : words.size() == 1    ? "in tick "
                                                         : "in ticks ";
  return fmt::format("{}{}", before, joined(words));
}

std::string_view did(Happening what) {
  switch (what) {
    case Happening::Success:
      return "succeeded";
    case Happening::Failure:
      return "failed";
    case Happening::Running:
      return "runs";
    case Happening::Skipped:
      return "was skipped";
    case Happening::Halted:
      return "was halted";
    case Happening::Asked:
    case Happening::Struck:
      break;
  }
  return "was left";
}

class Teller {
 public:
  explicit Teller(const ExplainedRun& run)
      : run_(run), moments_(run.log.moments), found_(run.found) {}

  std::string text() {
    add(0, fmt::format("{}: {}", run_.name, how_it_ended()));
    for (const Cause& cause : found_.causes) tell(cause, 1);
    if (found_.stopped != StopReason::None) {
      gap();
      add(0, "Undecided: " + stop_text(found_.stopped, found_.progress));
      return text_;
    }
    gap();
    if (found_.is_refused()) {
      tell_refusal();
      tell_answers();
      return text_;
    }
    tell_fault();
    tell_ways();
    tell_findings();
    return text_;
  }

 private:
  void add(std::size_t depth, const std::string& line) {
    text_ += fmt::format("{}{}\n", std::string(2 * depth, ' '), line);
  }
  void gap() {
    if (!text_.ends_with("\n\n")) text_ += '\n';
  }
  std::string name(NodeId node) const { return name_in_text(run_.tree, node); }

  // --- How it ended

  std::string how_it_ended() const {
    const Mission& mission = moments_.last();
    const std::string records =
        counted(run_.log.log.transitions.size(), "record", "records");
    if (mission.outcome == Outcome::Nothing) {
      return fmt::format("nothing has happened ({})", records);
    }
    const std::string when = at_text(moments_, mission.end - 1);
    std::string text;
    switch (mission.outcome) {
      case Outcome::Success:
        text = fmt::format("the mission succeeded {}", when);
        break;
      case Outcome::Failure:
        text = fmt::format("the mission failed {}", when);
        break;
      case Outcome::Exception:
        text = fmt::format("an exception left the tree {}", when);
        if (!moments_.exception().empty()) {
          text += fmt::format(": {}", moments_.exception());
        }
        break;
      case Outcome::Running:
      case Outcome::Nothing:
        text = moments_.knows_ticks()
                   ? fmt::format(
                         "the log ends in tick {}, and the mission "
                         "does not",
                         moments_.last_tick())
                   : fmt::format("the log ends {}, and the mission does not",
                                 when);
        break;
    }
    text += fmt::format(" ({})", records);
    const std::size_t before = moments_.missions().size() - 1;
    if (before > 0) {
      text += fmt::format("; {} before it",
                          counted(before, "run has ended", "runs have ended"));
    }
    return text;
  }

  void tell(const Cause& cause, std::size_t depth) {
    std::string line = fmt::format("{}{} {}", depth > 1 ? "because " : "",
                                   name(cause.node), did(cause.what));
    if (cause.what == Happening::Running) {
      line += fmt::format(" since {}", from_text(moments_, cause.at.front()));
    } else {
      line += fmt::format(" {}", at_text(moments_, cause.at));
    }
    add(depth, line);
    for (const Cause& each : cause.because) tell(each, depth + 1);
  }

  // --- The fault

  std::string suspect(const Suspect& each) const {
    return fmt::format("{} {}", name(each.leaf), suspect_text(moments_, each));
  }

  void tell_fault() {
    const Suspects& suspects = found_.suspects;
    if (!suspects.single.empty()) {
      const bool is_certain =
          suspects.is_needed() || moments_.last().outcome == Outcome::Exception;
      if (is_certain) {
        add(0, fmt::format("The fault: {}", suspect(suspects.single.front())));
      } else {
        add(0, without_fault());
        add(0, fmt::format("If one: {}", suspect(suspects.single.front())));
      }
      tell_rows();
      tell_others();
    } else if (!suspects.together.empty()) {
      add(0, "No single fault explains it; these do together:");
      for (const Suspect& each : suspects.together) add(1, suspect(each));
    } else if (suspects.is_needed()) {
      add(0, "No single fault explains it");
      tell_answers();
    } else {
      add(0, without_fault());
    }
    gap();
  }

  std::string without_fault() const {
    switch (moments_.last().outcome) {
      case Outcome::Failure:
        return "No fault: it ended so by what conditions answered";
      case Outcome::Running:
        return "No fault is needed for it: every leaf may have worked";
      case Outcome::Exception:
        return "No leaf has thrown it: it comes from the nodes around them";
      default:
        return "No fault: every leaf has worked";
    }
  }

  void tell_rows() {
    for (const FaultRowInTable& row : found_.rows) {
      add(1, fmt::format("row {} of `btcheck whatif`, {}: the mission {}",
                         row.number, facts_of(row.fault.fault.kind).word,
                         facts_of(row.harm).told));
    }
    if (!found_.rows.empty()) return;
    std::vector<std::string> words;
    for (const InjectedFault& each : found_.suspects.single.front().faults) {
      words.emplace_back(facts_of(each.fault.kind).word);
    }
    add(1, fmt::format("of `btcheck whatif`: {}", joined(words, " or ")));
  }

  void tell_others() {
    const auto& all = found_.suspects.single;
    for (std::size_t i = 1; i < all.size() && i <= kMostOthers; ++i) {
      add(1, fmt::format("or {}", suspect(all[i])));
    }
    if (all.size() > kMostOthers + 1) {
      add(1, fmt::format("or {}", counted(all.size() - kMostOthers - 1,
                                          "other leaf", "other leaves")));
    }
  }

  // --- Where it was decided

  std::string way_text(const LastWay& last) const {
    // A leaf that runs on is told by its end.
    std::vector<NodeEvent> way = last.way;
    std::erase_if(way, [](const NodeEvent& event) {
      return event.what() == Happening::Running;
    });
    std::vector<std::string> words;
    for (std::size_t i = 0; i < way.size() && i < kMostSteps; ++i) {
      words.push_back(
          fmt::format("{} {}", name(way[i].node()), does(way[i].what())));
    }
    if (way.size() > kMostSteps) {
      words.push_back(fmt::format("{} more", way.size() - kMostSteps));
    }
    return words.empty() ? "" : joined(words, ", then ");
  }

  void tell_ways() {
    if (found_.is_hopeless) {
      add(0, "It could not have succeeded, whatever leaves answered");
    } else if (found_.last_way) {
      tell_way(*found_.last_way, "");
    }
    const bool is_same =
        found_.last_way && found_.last_way_with_fault &&
        found_.last_way->records == found_.last_way_with_fault->records;
    if (found_.is_hopeless_with_fault) {
      add(0,
          "With this fault, and all else working, it could not have "
          "succeeded");
    } else if (found_.last_way_with_fault && !is_same) {
      tell_way(*found_.last_way_with_fault,
               "With this fault, and all else working: ");
    }
    gap();
  }

  void tell_way(const LastWay& last, const std::string& before) {
    if (!last.moment) {
      add(0, fmt::format("{}{} where the log ends it can still succeed", before,
                         before.empty() ? "Not decided:" : ""));
    } else {
      const Moment& there = moments_.at(*last.moment);
      add(0, fmt::format("{}{} {}: {} {}", before,
                         before.empty() ? "Decided" : "decided",
                         at_text(moments_, *last.moment), name(there.node),
                         did(there.what)));
    }
    const std::string way = way_text(last);
    if (!way.empty()) {
      add(1, fmt::format("the nearest way to success from there: {}", way));
    }
  }

  // --- Findings

  void tell_findings() {
    if (found_.findings.empty()) return;
    add(0, "The log shows what a check of the tree finds:");
    for (const FindingInLog& each : found_.findings) {
      add(1, fmt::format("{} in tick {}, {}: {}", each.code, each.tick,
                         line_of(run_.tree, each.node), each.message));
    }
  }

  // --- Refused

  void tell_refusal() {
    const Conformance& followed = found_.followed;
    const auto& records = run_.log.log.transitions;
    const LogTransition record = *followed.refused < records.size()
                                     ? records[*followed.refused]
                                     : LogTransition{};
    const LogEvent event =
        followed.refused_answer
            ? *followed.refused_answer
            : LogEvent{run_.log.nodes.node(record.uid), record.after};
    add(0, fmt::format(
               "The tree cannot have written this log: not its record {} of "
               "{}, {} -> {} (tick {})",
               *followed.refused + 1, records.size(), name(event.node),
               kLogStatusNames[static_cast<std::size_t>(event.status)],
               followed.tick));
    add(1,
        "nor with any fault of one leaf; `btcheck conform` tells what it "
        "could have done there");
  }

  void tell_answers() {
    for (const Suspect& each : found_.suspects.failed) {
      add(1, fmt::format("{} failed {}", name(each.leaf),
                         at_text(moments_, each.at)));
    }
  }

  const ExplainedRun& run_;
  const LogMoments& moments_;
  const Explanation& found_;
  std::string text_;
};

bool has(const Suspect& suspect, FaultKind kind) {
  return std::ranges::any_of(suspect.faults, [&](const InjectedFault& each) {
    return each.fault.kind == kind;
  });
}

}  // namespace

std::string suspect_text(const LogMoments& moments, const Suspect& suspect) {
  using enum FaultKind;
  const FaultKind kind = suspect.faults.front().fault.kind;
  const std::string when = at_text(moments, suspect.at);
  const bool lasts = has(suspect, FailsOn);
  const auto from = [&] { return from_text(moments, suspect.at.front()); };
  const auto was = [&](std::size_t at, Happening what) {
    return moments.at(suspect.at[at]).what == what;
  };
  const bool has_run = suspect.at.size() == 2 && was(0, Happening::Running);
  const bool is_halted = has_run && was(1, Happening::Halted);
  switch (suspect.at.empty() ? WritesOther : kind) {
    case Fails:
      return suspect.at.size() == 1
                 ? fmt::format("fails {} (once or for ever: it was asked once)",
                               when)
                 : fmt::format("fails whenever it is asked: {}", when);
    case FailsOnce:
      if (suspect.at.size() > 1) {
        return fmt::format("fails now and then: {}", when);
      }
      return lasts ? fmt::format(
                         "fails {} (once or for ever: it was not "
                         "asked again)",
                         when)
                   : fmt::format("fails once, {}", when);
    case FailsOn:
      return fmt::format("fails for ever from {} on: {}", from(), when);
    case NeverEnds:
      return fmt::format(
          "never ends{}{}: it {}",
          has(suspect, EndsLate) ? ", or ends late" : "",
          has(suspect, Throws) ? ", or has thrown an exception" : "",
          is_halted ? fmt::format("ran since {} and was halted {}", from(),
                                  at_text(moments, suspect.at.back()))
                    : fmt::format("runs since {}", from()));
    case Throws:
      return fmt::format("throws an exception {}", when);
    case EndsLate:
      return has_run ? fmt::format("ends late, {}: it ran since {}",
                                   at_text(moments, suspect.at.back()), from())
                     : fmt::format("ends late, {}", when);
    default:
      break;
  }
  return fmt::format("{}{}{}", facts_of(kind).told, when.empty() ? "" : ", ",
                     when);
}

std::string explain_text(const ExplainedRun& run) {
  std::string text = Teller(run).text();
  while (text.ends_with("\n\n")) text.pop_back();
  return text;
}

}  // namespace btcheck
