// SPDX-License-Identifier: MIT
#include "report/diff/told.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

#include "check/replay/executed.hpp"
#include "report/formats/reported.hpp"
#include "report/text/report.hpp"
#include "report/whatif/words.hpp"
#include "text/utf8.hpp"
#include "trace/run/record.hpp"

namespace btcheck {
namespace {

std::string first_line(const std::string& text) {
  return text.substr(0, text.find('\n'));
}

// A finding is the same where its code is, and its place in the tree or what
// it says.
using Identity = std::pair<std::string, std::string>;
std::set<Identity> identities(const ReportedTree& tree) {
  std::set<Identity> all;
  for (const Finding& each : tree.findings) {
    all.emplace(each.code, each.identity);
    all.emplace(each.code, first_line(each.message));
  }
  return all;
}

bool is_told(const Finding& finding) {
  return finding.about != Finding::About::Rule &&
         finding.severity != Severity::Note;
}

void add_findings(const ReportedTree& of, const std::set<Identity>& known,
                  DiffChange::Kind kind, std::vector<DiffChange>& changes) {
  for (const Finding& each : of.findings) {
    if (!is_told(each) || known.contains({each.code, each.identity}) ||
        known.contains({each.code, first_line(each.message)})) {
      continue;
    }
    DiffChange change;
    change.kind = kind;
    change.code = each.code;
    change.text = first_line(each.message);
    change.file = each.place.file;
    change.line = each.place.span.line;
    changes.push_back(std::move(change));
  }
}

}  // namespace

std::vector<DiffChange> changes_between(const CheckResult& one,
                                        const CheckResult& other) {
  const ReportedTree was = reported(one, one.tree->file, exit_code_of(one));
  const ReportedTree is =
      reported(other, other.tree->file, exit_code_of(other));
  std::vector<DiffChange> changes;
  for (std::size_t f = 0; f < std::min(was.files.size(), is.files.size());
       ++f) {
    const auto& before = was.files[f].verdicts;
    const auto& now = is.files[f].verdicts;
    for (std::size_t i = 0; i < std::min(before.size(), now.size()); ++i) {
      if (before[i].verdict == now[i].verdict) continue;
      DiffChange change;
      change.text = now[i].name;
      change.was = verdict_word(before[i].verdict);
      change.is = verdict_word(now[i].verdict);
      change.file = now[i].place.file;
      change.line = now[i].place.span.line;
      changes.push_back(std::move(change));
    }
  }
  add_findings(is, identities(was), DiffChange::Kind::New, changes);
  add_findings(was, identities(is), DiffChange::Kind::Gone, changes);
  return changes;
}

std::string DiffReport::label(std::size_t side) const {
  if (!profiles[side].empty()) return profiles[side];
  const auto parts_of = [](const std::string& name) {
    std::vector<std::string> parts;
    for (std::size_t at = 0; at <= name.size();) {
      const std::size_t end = std::min(name.find('/', at), name.size());
      parts.push_back(name.substr(at, end - at));
      at = end + 1;
    }
    return parts;
  };
  std::vector<std::string> own = parts_of(names[side]);
  std::vector<std::string> other = parts_of(names[1 - side]);
  const auto drop_common = [&] {
    while (own.size() > 1 && other.size() > 1 && own.front() == other.front()) {
      own.erase(own.begin());
      other.erase(other.begin());
    }
  };
  const auto turn = [&] {
    std::ranges::reverse(own);
    std::ranges::reverse(other);
  };
  drop_common();
  turn();
  drop_common();
  turn();
  if (own == other) return names[side];
  std::string label;
  for (const std::string& part : own)
    label += (label.empty() ? "" : "/") + part;
  return label;
}

std::string_view DiffReport::verdict() const {
  if (diff.stopped != StopReason::None) return "undecided";
  return diff.difference ? "different" : "equivalent";
}

ExitCode DiffReport::code() const {
  if (!diff.error.empty()) return ExitCode::Internal;
  if (diff.stopped != StopReason::None) return ExitCode::Undecided;
  return diff.difference ? ExitCode::Missed : ExitCode::Met;
}

namespace {

// What is seen by whom.
class Words {
 public:
  explicit Words(const DiffReport& report) : diff_(report.diff) {}

  // "`land` succeeds", of a tree; by the other's name where it has none.
  std::string of(SeenEvent event, std::size_t side) const {
    if (event == kThrown) return "an exception leaves the tree";
    const WatchedPair& watched = diff_.watched[event.number()];
    const std::string who = name_of(watched, side);
    if (event.what() == Happening::Asked) {
      return watched.is_root ? "the next tick begins" : who + " is ticked";
    }
    if (watched.is_root && event.what() == Happening::Halted) {
      return "the caller halts " + who;
    }
    return fmt::format("{} {}", who, does(event.what()));
  }

  std::string name_of(const WatchedPair& watched, std::size_t side) const {
    const auto& [one, other] = watched.nodes;
    const std::size_t at = (side == 0 ? one : other) ? side : 1 - side;
    const std::size_t roots = diff_.sides[at].tree.roots.size();
    if (watched.is_root && roots == 1) return "the tree";
    return name_in_text(diff_.sides[at].tree, at == 0 ? *one : *other);
  }

  std::string instead(const Difference& found, std::size_t side) const {
    constexpr std::size_t kMost = 3;
    std::vector<std::string> all;
    for (const SeenEvent& event : found.instead) {
      if (event == found.run.back() && found.end == TraceEnd::Seen) continue;
      all.push_back(of(event, side));
    }
    if (found.other_stops) all.emplace_back("nothing more happens");
    if (found.other_unseen) all.emplace_back("it goes on unseen");
    if (all.empty()) return "nothing of it";
    std::string text;
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (i == kMost && all.size() > kMost + 1) {
        return text + fmt::format(", or {} others", all.size() - i);
      }
      text += i == 0 ? "" : i + 1 == all.size() ? ", or " : ", ";
      text += all[i];
    }
    return text;
  }

 private:
  const Diff& diff_;
};

class Rows {
 public:
  explicit Rows(const DiffReport& report)
      : diff_(report.diff), words_(report) {}

  std::vector<DiffRow> take() {
    const Difference& found = *diff_.difference;
    const bool has_last =
        found.kind == Difference::Kind::Told ||
        (found.kind == Difference::Kind::Runs && found.end == TraceEnd::Seen);
    const std::size_t common = found.run.size() - (has_last ? 1 : 0);
    for (std::size_t i = 0; i < common; ++i) {
      // That a leaf is ticked goes without saying where it answers at once.
      const bool is_said = i + 1 < found.run.size() &&
                           is_answered_by(found.run[i], found.run[i + 1]) &&
                           i + 1 < common;
      add(found.run[i], is_said);
    }
    if (found.kind == Difference::Kind::Told) {
      tell_otherwise(found.run.back());
    } else if (found.kind == Difference::Kind::Runs) {
      end(found);
    } else {
      for (const PlayRound& round : found.play) play(round);
    }
    return std::move(rows_);
  }

 private:
  static bool is_answered_by(SeenEvent asked, SeenEvent answer) {
    return asked.what() == Happening::Asked && answer != kThrown &&
           asked.number() == answer.number() && is_answer(answer.what());
  }
  bool begins_tick(SeenEvent event) const {
    return event != kThrown && event.what() == Happening::Asked &&
           diff_.watched[event.number()].is_root;
  }

  void add(SeenEvent event, bool is_said) {
    if (begins_tick(event)) {
      ++tick_;
      return;
    }
    if (is_said) return;
    rows_.push_back({std::max(tick_, 1),
                     {words_.of(event, 0), words_.of(event, 1)},
                     false});
  }

  void add_difference(std::size_t side, std::string own, std::string others) {
    DiffRow& row = rows_.emplace_back();
    row.tick = std::max(tick_, 1);
    row.cells[side] = std::move(own);
    row.cells[1 - side] = std::move(others);
    row.differs = true;
  }

  void end(const Difference& found) {
    std::string own =
        found.end == TraceEnd::Seen    ? words_.of(found.run.back(), found.side)
        : found.end == TraceEnd::Stops ? "nothing more happens"
                                       : "it goes on for ever, unseen";
    add_difference(found.side, std::move(own),
                   words_.instead(found, 1 - found.side));
  }

  void tell_otherwise(SeenEvent event) {
    const WatchedPair& watched = diff_.watched[event.number()];
    add_difference(
        0, words_.of(event, 0),
        fmt::format("{}, {}", words_.of(event, 1), watched.otherwise));
  }

  void play(const PlayRound& round) {
    const std::size_t side = round.is_of_first ? 0 : 1;
    const auto seen = [&](std::size_t of) {
      return words_.of(SeenEvent(round.label), of);
    };
    switch (round.kind) {
      case PlayRound::Kind::Moves:
        return add(SeenEvent(round.label), false);
      case PlayRound::Kind::Settles:
        return add_difference(side, "it is settled, unseen, how it goes on",
                              "it is still open");
      case PlayRound::Kind::Yields:
        return add_difference(side, "to answer, it settles how it goes on",
                              "it is still open");
      case PlayRound::Kind::Wins:
        return add_difference(side,
                              round.label == LabelledGraph::kSilent
                                  ? "it can settle how it goes on"
                                  : "it is possible that " + seen(side),
                              "that is not possible here");
      case PlayRound::Kind::Stays:
        return add_difference(side, "it can go on for ever, unseen",
                              "that is not possible here");
    }
  }

  const Diff& diff_;
  Words words_;
  std::vector<DiffRow> rows_;
  int tick_ = 0;
};

std::string seen_words(const DiffReport& report) {
  std::string text;
  for (const std::string& each : report.observe) {
    text += text.empty() ? "" : ", ";
    text +=
        each == "leaves" || each == "root" ? each : fmt::format("`{}`", each);
  }
  return text.empty() ? "leaves" : text;
}

}  // namespace

std::vector<DiffRow> rows_of(const DiffReport& report) {
  if (!report.diff.difference) return {};
  return Rows(report).take();
}

std::string verdict_text(const DiffReport& report) {
  const Diff& diff = report.diff;
  if (diff.stopped != StopReason::None) {
    return fmt::format(
        "UNDECIDED: a limit ({}) was reached before all runs were known",
        stop_word(diff.stopped));
  }
  const std::string seen = fmt::format(
      "{} and {} states, seen: {}; {}", grouped(diff.sides[0].states),
      grouped(diff.sides[1].states), seen_words(report),
      report.caller == Caller::Any ? "every caller" : "ticked until they end");
  if (!diff.difference) {
    return fmt::format("equivalent in every world ({})", seen);
  }
  switch (diff.difference->kind) {
    case Difference::Kind::Runs: {
      const std::size_t side = diff.difference->side;
      return fmt::format("different: a run of {} that {} has not ({})",
                         report.label(side), report.label(1 - side), seen);
    }
    case Difference::Kind::Choices:
      return fmt::format(
          "different: the same runs, but it is settled at another time how "
          "they go on ({})",
          seen);
    case Difference::Kind::Told:
      return fmt::format(
          "different: the same runs, but a leaf is told something else ({})",
          seen);
  }
  return "";
}

std::optional<RecordedRun> run_of(const DiffReport& report, std::size_t side) {
  const DiffSide& own = report.diff.sides[side];
  if (own.steps.empty()) return std::nullopt;
  const auto run = executed(own.network, own.steps);
  if (!run) return std::nullopt;
  RunHeading heading;
  heading.property = report.names[side];
  heading.formula = verdict_text(report);
  heading.verdict = "VIOLATED";
  if (report.inputs[side] != nullptr) {
    add_sources(heading, own.tree, *report.inputs[side]);
  }
  return recorded(own.tree, own.network, *run, heading);
}

std::string partners_text(const DiffReport& report) {
  const Words words(report);
  std::string text;
  for (const WatchedPair& each : report.diff.watched) {
    const auto& [one, other] = each.nodes;
    if (!one || !other) {
      const std::size_t side = one ? 0 : 1;
      text += fmt::format("{} is in {} only\n", words.name_of(each, side),
                          report.label(side));
    } else if (!each.otherwise.empty()) {
      text += fmt::format("{} of {}: {}\n", words.name_of(each, 1),
                          report.label(1), each.otherwise);
    }
  }
  return text;
}

std::string change_text(const DiffChange& change) {
  const std::string where =
      change.file.empty() ? ""
      : change.line == 0  ? fmt::format(" ({})", change.file)
                          : fmt::format(" ({}:{})", change.file, change.line);
  switch (change.kind) {
    case DiffChange::Kind::Verdict:
      return fmt::format("rule `{}`: {} before, {} now", change.text,
                         change.was, change.is);
    case DiffChange::Kind::New:
      return fmt::format("new: {}: {}{}", change.code, change.text, where);
    case DiffChange::Kind::Gone:
      return fmt::format("gone: {}: {}{}", change.code, change.text, where);
  }
  return "";
}

}  // namespace btcheck
