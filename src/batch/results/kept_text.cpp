// SPDX-License-Identifier: MIT
//
// JSON, which has no line feed of its own. Each struct is an object with the
// names of its members; enumerations are their numbers.
#include "batch/results/kept_text.hpp"

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

namespace nlohmann {

template <class Value>
struct adl_serializer<std::optional<Value>> {
  static void to_json(json& to, const std::optional<Value>& value) {
    if (value) {
      to = *value;
    } else {
      to = nullptr;
    }
  }
  static void from_json(const json& from, std::optional<Value>& value) {
    if (from.is_null()) {
      value.reset();
    } else {
      // Not `get`: clang 14 holds that a nested struct with default values
      // cannot be made by default.
      value.emplace(Value{});
      from.get_to(*value);
    }
  }
};

}  // namespace nlohmann

namespace btcheck {

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(SourceSpan, line, column, length)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(ChangedLines, first, before, after)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(ChangedFile, file, changes, around)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(CheckedRepair, files, comes_from)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Diagnostic, severity, code, message, file,
                                   span, source_line, label, help, repair)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(SearchProgress, states, expanded,
                                   transitions, depth, bytes)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Place, file, span)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(RelatedPlace, place, text)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(ReportedReply, words, contracts, comment)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(ToldStep, kind, text, time, is_chosen, place)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(ToldRun, steps, unit, time, loop)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Finding, about, code, severity, title,
                                   message, place, node, related, run, repair,
                                   answers, identity, told, trace, page)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(ReportedCount, node, place, attribute, from)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(ReportedProperty, name, title, text, tags,
                                   place, verdict, expectation, is_met,
                                   is_vacuous, note, reason, error, stopped,
                                   progress, triggers, longest_answer,
                                   for_every, run, told, page)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(ReportedAnswer, key, code, question, answer,
                                   verdict, is_fault, run, trace, page)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(ReportedNode::Possible, verdict, time)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(ReportedNode, key, name, type, place,
                                   answers)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(ReportedFile, properties, profile, ticks,
                                   assumptions, has_faults, verdicts, answers,
                                   nodes, stopped, progress, error)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(KnownFinding, code, file, node, text, count,
                                   can_fail)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Judged, allowed, told, known, is_denied,
                                   is_whole, has_baseline, files)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(ReportedTree, entry, main_tree, not_run,
                                   file, nodes, variables, root, diagnostics,
                                   files, findings, judged, left_out, code,
                                   seconds, peak_bytes)

std::string kept_text(const ReportedTree& tree) {
  using nlohmann::json;
  return json(tree).dump(-1, ' ', false, json::error_handler_t::replace);
}

std::optional<ReportedTree> tree_from(std::string_view text) {
  const auto json = nlohmann::json::parse(text, nullptr, false);
  if (json.is_discarded()) return std::nullopt;
  try {
    return json.get<ReportedTree>();
  } catch (const nlohmann::json::exception&) {
    return std::nullopt;  // another version's
  }
}

bool may_be_kept(const ReportedTree& tree) {
  const auto is_final = [](const auto& searched) {
    return searched.stopped != StopReason::Memory &&
           searched.stopped != StopReason::Disk &&
           searched.stopped != StopReason::Interrupted;
  };
  if (tree.code == ExitCode::Internal || tree.code == ExitCode::BadInput) {
    return false;
  }
  return !tree.files.empty() &&
         std::all_of(tree.files.begin(), tree.files.end(),
                     [&](const ReportedFile& file) {
                       return is_final(file) &&
                              std::all_of(file.verdicts.begin(),
                                          file.verdicts.end(), is_final);
                     });
}

bool drop_lost_pages(ReportedTree& tree) {
  bool has_lost = false;
  const auto look_at = [&](auto& told) {
    std::error_code fault;
    if (told.page.empty() || std::filesystem::exists(told.page, fault)) return;
    told.page.clear();
    has_lost = true;
  };
  for (ReportedFile& file : tree.files) {
    std::ranges::for_each(file.verdicts, look_at);
    std::ranges::for_each(file.answers, look_at);
  }
  std::ranges::for_each(tree.findings, look_at);
  return has_lost;
}

}  // namespace btcheck
