// SPDX-License-Identifier: MIT
//
// What stands between and behind the lines: runs to be shown, and what a check
// has come to.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "api/told.hpp"
#include "lsp/features.hpp"
#include "lsp/words.hpp"

namespace btcheck::lsp {
namespace {

// 110578 → "110,578".
std::string with_commas(std::uint64_t number) {
  std::string text = std::to_string(number);
  for (std::size_t at = text.size(); at > 3;) {
    at -= 3;
    text.insert(at, ",");
  }
  return text;
}

std::string counted_of(std::size_t count, std::string_view one,
                       std::string_view many) {
  return fmt::format("{} {}", count, count == 1 ? one : many);
}

Json command(std::string_view title, std::string_view name, const Json& args) {
  Json arguments = Json::array();
  arguments.push(args);
  return {{"title", title}, {"command", name}, {"arguments", arguments}};
}

Json lens(const View& view, TextStretch at, const Json& command) {
  return {{"range", json_of(view.range(at))}, {"command", command}};
}

std::string verdict_text(const v1::Rule& rule) {
  return fmt::format(
      "{}{}", v1::verdict_word(rule.verdict),
      rule.is_vacuous ? ", but nothing is ever asked of it" : "");
}

// Where the trees of the document begin, by what is asked of each.
struct TreeHere {
  const Look* look = nullptr;
  TextStretch at;
};

std::vector<TreeHere> trees_here(const View& view) {
  std::vector<TreeHere> all;
  for (const Look& look : view.looks) {
    if (look.subject.tree != view.document.path ||
        !look.subject.rules.empty() || !look.description ||
        look.description->nodes.empty()) {
      continue;
    }
    const auto at = view.now(look.description->nodes[0].where, look.described);
    if (at) all.push_back({&look, *at});
  }
  return all;
}

// What has to be looked at: neither notes nor questions.
std::size_t finding_count(const v1::Report& report) {
  return static_cast<std::size_t>(std::ranges::count_if(
      report.findings,
      [](const v1::Finding& each) { return each.level != v1::Level::Note; }));
}

}  // namespace

Json runs(const View& view) {
  Json all = Json::array();
  std::set<std::string> names;
  const auto add = [&](const std::optional<v1::Run>& run,
                       const std::string& title) {
    if (!run || run->name.empty() || !names.insert(run->name).second) return;
    all.push(Json{{"name", run->name}, {"title", title}});
  };
  for (const Look& look : view.looks) {
    if (!look.is_checked()) continue;
    for (const v1::Rule& each : look.check.report->rules) {
      add(each.run, fmt::format("{}: {}", each.name, verdict_text(each)));
    }
    for (const v1::Finding& each : look.check.report->findings) {
      add(each.run,
          fmt::format("{}: {}", each.code,
                      each.message.substr(0, each.message.find('\n'))));
    }
    for (const v1::Answer& each : look.check.report->answers) {
      add(each.run, fmt::format("{}: {}", each.question, each.answer));
    }
  }
  return all;
}

Json lenses(const View& view) {
  Json all = Json::array();
  for (const TreeHere& tree : trees_here(view)) {
    all.push(lens(view, tree.at,
                  command("step through", "btcheck.stepThrough",
                          Json{{"uri", view.document.uri},
                               {"tree", tree.look->subject.main_tree}})));
  }
  std::set<std::string> names;
  for (const Look& look : view.looks) {
    if (!look.is_checked()) continue;
    const auto add = [&](const v1::Position& where,
                         const std::optional<v1::Run>& run,
                         const std::string& what) {
      if (!run || run->name.empty() || where.file != view.document.path) return;
      const auto at = view.now(where, look.check.texts);
      if (!at || !names.insert(run->name).second) return;
      all.push(
          lens(view, *at,
               command(fmt::format("▶ {}", what), "btcheck.showRun",
                       Json{{"uri", view.document.uri}, {"run", run->name}})));
    };
    for (const v1::Rule& each : look.check.report->rules) {
      add(each.where, each.run, "run");
    }
    for (const v1::Finding& each : look.check.report->findings) {
      add(each.where, each.run, fmt::format("run of {}", each.code));
    }
  }
  return all;
}

Json hints(const View& view, const Range& range) {
  Json all = Json::array();
  std::map<std::size_t, std::string> by_line;
  const auto add = [&](TextStretch at, const std::string& text) {
    const std::size_t line = view.range(at).begin.line;
    if (line < range.begin.line || line > range.end.line) return;
    std::string& there = by_line[line];
    there += there.empty() ? text : " · " + text;
  };
  for (const TreeHere& tree : trees_here(view)) {
    if (!tree.look->is_checked()) continue;
    const v1::Report& report = *tree.look->check.report;
    std::string text;
    if (report.states > 0) {
      text = fmt::format("{} states", with_commas(report.states));
    }
    text +=
        fmt::format("{}{}", text.empty() ? "" : " · ",
                    counted_of(finding_count(report), "finding", "findings"));
    if (!report.stopped.empty()) {
      text += fmt::format(" · stopped: {}", report.stopped);
    }
    add(tree.at, text);
  }
  for (const Look& look : view.looks) {
    if (look.subject.rules != view.document.path || !look.is_checked())
      continue;
    for (const v1::Rule& each : look.check.report->rules) {
      const auto at = view.now(each.where, look.check.texts);
      if (!at) continue;
      std::string text = verdict_text(each);
      if (!each.note.empty()) text += ", " + each.note;
      if (!each.is_met) text += ", which is not what is expected";
      add(*at, text);
    }
  }
  for (const auto& [line, text] : by_line) {
    const TextStretch whole = view.lines->whole_line(line);
    const std::size_t end = whole.begin + view.lines->line(line).size();
    all.push(Json{{"position", json_of(view.range({end, end}).begin)},
                  {"label", text},
                  {"paddingLeft", true}});
  }
  return all;
}

std::string summary(const View& view) {
  std::string text;
  const auto add = [&](const std::string& part) {
    text += text.empty() ? part : "; " + part;
  };
  for (const Look& look : view.looks) {
    if (!look.is_checked()) continue;
    const v1::Report& report = *look.check.report;
    if (report.outcome == v1::Outcome::BadInput) {
      const std::string& file =
          look.subject.rules.empty() ? look.subject.tree : look.subject.rules;
      add(fmt::format("{} is not checked: there are errors",
                      file.substr(file.find_last_of('/') + 1)));
    } else if (look.subject.rules.empty()) {
      const std::size_t count = finding_count(report);
      add(count == 0 ? std::string("nothing found")
                     : counted_of(count, "finding", "findings"));
    } else {
      const auto met = static_cast<std::size_t>(
          std::ranges::count(report.rules, true, &v1::Rule::is_met));
      add(fmt::format("{} of {} met", met,
                      counted_of(report.rules.size(), "rule", "rules")));
    }
    if (!report.stopped.empty()) add("stopped by " + report.stopped);
  }
  return text.empty() ? "nothing to check" : text;
}

}  // namespace btcheck::lsp
