// SPDX-License-Identifier: MIT
//
// What can be done about a finding: the repair that was checked, a comment that
// allows it, a rule that watches for it.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <map>

#include "lsp/diagnostics.hpp"
#include "lsp/features.hpp"
#include "lsp/words.hpp"
#include "report/codes/codes.hpp"
#include "style/style.hpp"
#include "text/utf8.hpp"

namespace btcheck::lsp {
namespace {

namespace fs = std::filesystem;

// A finding at a place of the document as it is now.
struct FindingHere {
  const Look* look = nullptr;
  const v1::Finding* finding = nullptr;
  TextStretch at;
};

std::vector<FindingHere> findings_in(const View& view, const Range& range) {
  std::vector<FindingHere> all;
  const std::size_t first = range.begin.line;
  const std::size_t last = range.end.line;
  const auto add = [&](const Look& look, const TimedReport& from) {
    for (const v1::Finding& each : from.report->findings) {
      if (each.where.file != view.document.path) continue;
      const auto at = view.now(each.where, from.texts);
      if (!at) continue;
      const std::size_t line = view.range(*at).begin.line;
      const bool is_known =
          std::ranges::any_of(all, [&](const FindingHere& other) {
            return other.finding->code == each.code &&
                   other.at.begin == at->begin &&
                   other.finding->message == each.message;
          });
      if (first <= line && line <= last && !is_known) {
        all.push_back({&look, &each, *at});
      }
    }
  };
  for (const Look& look : view.looks) {
    if (look.is_checked()) add(look, look.check);
  }
  for (const Look& look : view.looks) {
    if (look.is_linted()) add(look, look.lint);
  }
  return all;
}

Json edit_of_files(const View& view, const std::map<std::string, Json>& edits) {
  Json changes = Json::object();
  for (const auto& [path, list] : edits) changes.add(view.uri(path), list);
  return {{"changes", changes}};
}

// --- Repairs ---------------------------------------------------------------

// The line ends of a text.
std::string_view line_end(std::string_view text) {
  const std::size_t at = text.find('\n');
  return at != text.npos && at > 0 && text[at - 1] == '\r' ? "\r\n" : "\n";
}

std::optional<Json> repair(const View& view, const FindingHere& here) {
  const v1::Finding& finding = *here.finding;
  if (finding.repair.empty()) return std::nullopt;
  std::map<std::string, Json> edits;
  for (const v1::Change& change : finding.repair) {
    const FileText* text = view.text(change.file);
    const auto then = here.look->check.texts->find(change.file);
    // Lines are those of the text that was checked.
    if (text == nullptr || then == here.look->check.texts->end() ||
        !(then->second == *text)) {
      return std::nullopt;
    }
    const auto lines = text->parsed<Lines>();
    const std::size_t begin = lines->whole_line(change.first - 1).begin;
    const std::size_t end =
        lines->whole_line(change.first - 1 + change.removed).begin;
    std::string added;
    for (std::string_view line : change.added) {
      while (line.ends_with('\n') || line.ends_with('\r')) {
        line.remove_suffix(1);
      }
      added += line;
      added += line_end(text->text());
    }
    const bool is_open_end = end == text->size() && change.removed > 0 &&
                             !text->text().ends_with('\n');
    if (is_open_end && !added.empty()) {
      added.resize(added.size() - line_end(text->text()).size());
    }
    edits.try_emplace(change.file, Json::array())
        .first->second.push(
            text_edit(lines->range({begin, end}, view.encoding), added));
  }
  std::string what = finding.help.substr(0, finding.help.find('\n'));
  if (what.ends_with('.')) what.pop_back();
  if (what.empty()) what = "repair " + finding.code;
  const std::string title = fmt::format("btcheck: {} (checked)", what);
  return Json{{"title", title},
              {"kind", "quickfix"},
              {"isPreferred", true},
              {"edit", edit_of_files(view, edits)}};
}

// --- Comments that allow ---------------------------------------------------

constexpr std::string_view kReason = "why this is meant";

std::optional<Json> allowance(const View& view, const FindingHere& here) {
  const CodeRow* row = code_named(here.finding->code);
  if (row == nullptr || !has_level(*row) || here.finding->where.line == 0) {
    return std::nullopt;
  }
  const std::string& text = view.document.text.text();
  const std::size_t line = view.range(here.at).begin.line;
  const TextStretch whole = view.lines->whole_line(line);
  const std::string_view written = whole.in(text);
  const std::size_t indent =
      std::min(written.find_first_not_of(" \t"), written.size());
  std::size_t at = whole.begin;
  std::string comment =
      fmt::format("btcheck: allow {}: {}", here.finding->code, kReason);
  const std::string begin(written.substr(0, indent));
  if (view.document.kind == FileKind::Xml) {
    const auto scan = view.document.text.parsed<XmlScan>();
    const std::size_t element = scan->tag_at(here.at.begin);
    comment = fmt::format("<!-- {} -->", comment);
    // A tag that is not the first of its line has the comment before it.
    const std::size_t tag = element == kNone ? whole.begin + indent
                                             : (*scan)[element].start_tag.begin;
    if (tag > whole.begin + indent) {
      at = tag;
    } else {
      // A tag of several lines begins above.
      at = view.lines->whole_line(view.range({tag, tag}).begin.line).begin;
      comment = begin + comment + std::string(line_end(text));
    }
  } else if (view.document.kind == FileKind::Btf) {
    comment = fmt::format("{}; {}{}", begin, comment, line_end(text));
  } else {
    return std::nullopt;
  }
  Json edits = Json::array();
  edits.push(text_edit(view.range({at, at}), comment));
  return Json{{"title", fmt::format("btcheck: allow {} here, with a reason",
                                    here.finding->code)},
              {"kind", "quickfix"},
              {"edit", edit_of_files(view, {{view.document.path, edits}})}};
}

// --- Rules -----------------------------------------------------------------

// A rule that is violated while the finding is there. `{0}` is the node, `{1}`
// the root of its tree.
struct RuleForm {
  std::string_view code;
  std::string_view suffix;  // of its name
  std::string_view title;
  std::string_view body;
};
constexpr auto kRuleForms = std::to_array<RuleForm>({
    {"BT2104", "can_end", "the mission can always come to an end",
     "AG EF {1}.ended"},
    {"BT2105", "can_succeed", "the mission can succeed",
     "possible {1}.success"},
    {"BT2201", "is_reached", "the node is ticked on some run",
     "possible {0}.ticked"},
    {"BT2202", "can_succeed", "the node can succeed", "possible {0}.success"},
    {"BT2203", "can_fail", "the condition is false at times",
     "possible {0}.failure"},
    {"BT2204", "can_succeed", "the condition is true at times",
     "possible {0}.success"},
    {"BT2206", "is_not_left_running",
     "nothing goes on when the mission has ended",
     "never {1}.ended and {0}.active"},
    {"BT2207", "failure_counts", "its failure is a failure of the mission",
     "{0}.failure leadsto {1}.failure"},
    {"BT2212", "is_reached", "the node is ticked on some run",
     "possible {0}.ticked"},
    {"BT2214", "is_not_cut_off", "the task is never halted",
     "never {0}.halted"},
});

// As a rule names it.
std::string rule_name(const Look& look, std::size_t number) {
  const auto& nodes = look.description->nodes;
  const std::string& label = nodes[number].label;
  const auto count = std::ranges::count_if(nodes, [&](const auto& node) {
    return equal_ignoring_case(node.label, label);
  });
  const std::string& name = count == 1 ? label : nodes[number].name;
  const bool is_plain =
      !name.empty() && !is_digit(name[0]) &&
      std::ranges::all_of(name, [](char c) { return is_word_letter(c); });
  return is_plain ? name : fmt::format("\"{}\"", name);
}

std::string plain_word(std::string_view name) {
  std::string word;
  for (const char c : name) {
    word += is_letter(c) || is_digit(c) ? lowered(c) : '_';
  }
  return word;
}

std::optional<Json> rule(const View& view, const FindingHere& here) {
  const auto form =
      std::ranges::find(kRuleForms, here.finding->code, &RuleForm::code);
  if (form == kRuleForms.end() || !here.look->description) return std::nullopt;
  const auto nodes = nodes_at(view, view.document.path, here.at.begin);
  const auto found = std::ranges::find_if(
      nodes, [&](const NodeHere& node) { return node.look == here.look; });
  if (found == nodes.end()) return std::nullopt;
  std::size_t root = found->number;
  const auto& all = here.look->description->nodes;
  while (all[root].parent != root) root = all[root].parent;
  const std::string name = rule_name(*here.look, found->number);
  std::string body(form->body);
  const auto put = [&](std::string_view gap, const std::string& word) {
    for (std::size_t at = body.find(gap); at != body.npos;
         at = body.find(gap, at + word.size())) {
      body.replace(at, gap.size(), word);
    }
  };
  put("{0}", name);
  put("{1}", rule_name(*here.look, root));
  const std::string& tree = here.look->subject.tree;
  const std::string text =
      fmt::format("\n## {}\nproperty {}_{}: {}\n", form->title,
                  plain_word(all[found->number].label), form->suffix, body);
  // Into the rules that there are, or into new ones beside the tree.
  std::string path = fs::path(tree).replace_extension(".ltl").string();
  for (const Look& look : view.looks) {
    if (!look.subject.rules.empty()) path = look.subject.rules;
  }
  Json changes = Json::array();
  std::string added = text;
  Range at;
  if (const FileText* file = view.text(path)) {
    at = view.range_in(path, {file->size(), file->size()});
    if (!file->empty() && !file->text().ends_with('\n')) added.insert(0, "\n");
  } else {
    changes.push(Json{{"kind", "create"},
                      {"uri", view.uri(path)},
                      {"options", Json{{"ignoreIfExists", true}}}});
    added = fmt::format("tree \"{}\"\n{}", fs::path(tree).filename().string(),
                        text);
  }
  Json edits = Json::array();
  edits.push(text_edit(at, added));
  changes.push(Json{{"textDocument",
                     Json{{"uri", view.uri(path)}, {"version", Json::null()}}},
                    {"edits", edits}});
  return Json{{"title",
               fmt::format("btcheck: write a rule for this ({}_{})",
                           plain_word(all[found->number].label), form->suffix)},
              {"kind", "refactor"},
              {"edit", Json{{"documentChanges", changes}}}};
}

}  // namespace

Json actions(const View& view, const Range& range) {
  Json all = Json::array();
  const auto here = findings_in(view, range);
  const auto add = [&](auto make) {
    for (const FindingHere& each : here) {
      if (auto json = make(view, each)) all.push(*json);
    }
  };
  add(repair);
  add(allowance);
  add(rule);
  for (const FindingHere& each : here) {
    if (!each.finding->run || each.finding->run->name.empty()) continue;
    Json arguments = Json::array();
    arguments.push(
        Json{{"uri", view.document.uri}, {"run", each.finding->run->name}});
    all.push(Json{{"title", fmt::format("btcheck: show the run of {}",
                                        each.finding->code)},
                  {"kind", "source"},
                  {"command", Json{{"title", "show the run"},
                                   {"command", "btcheck.showRun"},
                                   {"arguments", arguments}}}});
  }
  return all;
}

Json formatted(const View& view) {
  if (view.document.kind == FileKind::Other) return Json::null();
  const std::string& before = view.document.text.text();
  const auto after = styled({view.document.path, view.document.text});
  if (!after.value) return Json::null();
  Json edits = Json::array();
  if (before == *after.value) return edits;
  // What neither beginning nor end have in common, by whole lines.
  const Shift shift(before, *after.value);
  std::size_t begin = shift.part().begin;
  while (begin > 0 && before[begin - 1] != '\n') --begin;
  std::size_t end = shift.part().end;
  while (end < before.size() && (end == 0 || before[end - 1] != '\n')) ++end;
  const std::size_t kept = before.size() - end;
  edits.push(text_edit(view.range({begin, end}),
                       std::string_view(*after.value)
                           .substr(begin, after.value->size() - kept - begin)));
  return edits;
}

}  // namespace btcheck::lsp
