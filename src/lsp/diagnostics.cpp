// SPDX-License-Identifier: MIT
#include "lsp/diagnostics.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

#include "api/told.hpp"
#include "ltl/rules/property.hpp"
#include "model/btcpp/tree/leaf_rules.hpp"
#include "model/tree_file.hpp"

namespace btcheck::lsp {
namespace {

constexpr std::size_t kMostRelated = 12;

int severity_number(v1::Level level) {
  if (level == v1::Level::Error) return 1;
  return level == v1::Level::Warning ? 2 : 3;
}

// The run came to an end because an edit or a limit ended it.
bool is_of_the_call(const v1::Finding& finding) {
  return finding.code.starts_with("BT90");
}

}  // namespace

std::optional<TextStretch> Movement::operator()(const v1::Position& place) {
  const auto [known, is_new] = files_.try_emplace(place.file);
  OfFile& file = known->second;
  if (is_new) {
    const auto before = then_.find(place.file);
    const auto after = now_.find(place.file);
    if (before != then_.end() && after != now_.end()) {
      file.lines = before->second.parsed<Lines>();
      if (!(before->second == after->second)) {
        file.shift.emplace(before->second.text(), after->second.text());
      }
    }
  }
  if (!file.lines) return std::nullopt;
  const TextStretch part =
      file.lines->stretch(place.line, place.column, place.length);
  return file.shift ? file.shift->moved(part) : part;
}

std::string message_of(const v1::Finding& finding) {
  return finding.help.empty() ? finding.message
                              : finding.message + "\n" + finding.help;
}

void DiagnosticList::add_file(const std::string& path, FileKind kind) {
  files_[path];
  const auto text = texts_.find(path);
  if (text == texts_.end()) return;
  std::vector<Diagnostic> found;
  if (kind == FileKind::Leaves) {
    found = read_leaf_files({{path, text->second}}).diagnostics;
  } else if (kind == FileKind::Rules) {
    found = read_properties(path, text->second).diagnostics;
  }
  Movement unmoved(texts_, texts_);
  for (const Diagnostic& each : found) {
    add(v1::finding_of(btcheck::finding_of(each)), unmoved);
  }
}

void DiagnosticList::add(const v1::Report& report, const Buffers& then) {
  Movement moved(then, texts_);
  for (const v1::Finding& finding : report.findings) {
    if (!is_of_the_call(finding)) add(finding, moved);
  }
  // A rule is told at the node that breaks it; and where it stands.
  for (const v1::Rule& rule : report.rules) {
    for (v1::Finding finding : report.findings) {
      if (!v1::is_of_rule(finding) ||
          !finding.message.starts_with(rule.name + " is ")) {
        continue;
      }
      finding.where = rule.where;
      add(finding, moved);
    }
  }
}

void DiagnosticList::add(const v1::Finding& finding, Movement& moved) {
  const auto at = moved(finding.where);
  if (!at) return;
  const std::string& path = finding.where.file;
  const std::string message = message_of(finding);
  if (!said_.insert({path, at->begin, finding.code, message}).second) return;
  const auto lines = texts_.at(path).parsed<Lines>();
  Json json{{"range", json_of(lines->range(*at, encoding_))},
            {"severity", severity_number(finding.level)},
            {"code", finding.code},
            {"source", "btcheck"},
            {"message", message}};
  Json related = Json::array();
  std::size_t count = 0;
  if (finding.run) {
    for (const v1::Step& step : finding.run->steps) {
      const auto place = moved(step.where);
      if (!step.is_chosen || !place || count++ >= kMostRelated) continue;
      const auto of = texts_.at(step.where.file).parsed<Lines>();
      related.push(
          {{"location", Json{{"uri", documents_.uri(step.where.file)},
                             {"range", json_of(of->range(*place, encoding_))}}},
           {"message", step.text}});
    }
  }
  if (!related.is_empty()) json.add("relatedInformation", related);
  files_[path].push_back({*at, severity_number(finding.level), json.text()});
}

std::map<std::string, std::string> DiagnosticList::take() {
  std::map<std::string, std::string> all;
  for (auto& [path, entries] : files_) {
    std::ranges::stable_sort(entries, {}, [](const Entry& each) {
      return std::tuple(each.at.begin, each.level);
    });
    std::string& json = all[path];
    json = "[";
    for (const Entry& entry : entries) {
      if (json.size() > 1) json += ',';
      json += entry.json;
    }
    json += ']';
  }
  return all;
}

}  // namespace btcheck::lsp
