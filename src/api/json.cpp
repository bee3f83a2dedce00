// SPDX-License-Identifier: MIT
//
// What the program has no command for, as JSON under the names of the header;
// what nobody knows or has written is null.
#include "text/json.hpp"

#include <array>
#include <optional>
#include <string_view>

#include "btcheck/check.hpp"

namespace btcheck::v1 {
namespace {

template <class Items, class Write>
Json json_list(const Items& items, Write write) {
  Json list = Json::array();
  for (const auto& item : items) list.push(write(item));
  return list;
}

Json json_or_null(const std::optional<std::string>& text) {
  return text ? Json(*text) : Json::null();
}

Json json_of(const Position& where) {
  if (where.line == 0 && where.file.empty()) return Json::null();
  return Json{{"file", where.file},
              {"line", where.line},
              {"column", where.column},
              {"length", where.length}};
}

Json json_of(const Step& step) {
  return Json{{"text", step.text},
              {"time", step.time},
              {"is_chosen", step.is_chosen},
              {"where", json_of(step.where)}};
}

Json json_of(const std::vector<Step>& steps) {
  return json_list(steps, [](const Step& step) { return json_of(step); });
}

// `finding`: its number in the report.
void add_run(const std::optional<Run>& run, Json finding, Json& to) {
  if (!run) return;
  to.push(Json{{"name", run->name},
               {"finding", std::move(finding)},
               {"loop", run->loop ? Json(*run->loop) : Json::null()},
               {"steps", json_of(run->steps)}});
}

Json json_of(const Finding& finding) {
  constexpr std::array<std::string_view, 3> kLevels = {"note", "warning",
                                                       "error"};
  return Json{{"code", finding.code},
              {"level", kLevels[static_cast<std::size_t>(finding.level)]},
              {"message", finding.message},
              {"help", finding.help},
              {"where", json_of(finding.where)},
              {"node", finding.node}};
}

Json json_of(const Port& port) {
  constexpr std::array<std::string_view, 4> kDirections = {"unknown", "input",
                                                           "output", "both"};
  return Json{
      {"name", port.name},
      {"direction", kDirections[static_cast<std::size_t>(port.direction)]},
      {"type", port.type},
      {"value", json_or_null(port.value)},
      {"preset", json_or_null(port.preset)},
      {"about", port.about},
      {"entry", port.entry},
      {"where", json_of(port.where)}};
}

Json json_of(const DescribedNode& node) {
  return Json{
      {"name", node.name},
      {"label", node.label},
      {"type", node.type},
      {"kind", node.kind},
      {"about", node.about},
      {"where", json_of(node.where)},
      {"parent", node.parent},
      {"ports",
       json_list(node.ports, [](const Port& port) { return json_of(port); })},
      {"reads", Json::array(node.reads)},
      {"writes", Json::array(node.writes)}};
}

Json json_of(const Entry& entry) {
  return Json{{"name", entry.name},
              {"values", Json::array(entry.values)},
              {"writers", Json::array(entry.writers)},
              {"readers", Json::array(entry.readers)}};
}

Json json_of(const std::vector<Value>& values) {
  Json object = Json::array();
  for (const Value& each : values) {
    object.push(Json{{"name", each.name}, {"value", each.value}});
  }
  return object;
}

Json json_of(const std::vector<Finding>& findings) {
  return json_list(findings, [](const Finding& each) { return json_of(each); });
}

}  // namespace

std::string Report::runs_json() const {
  Json runs = Json::array();
  for (const Rule& rule : rules) add_run(rule.run, Json::null(), runs);
  for (const Answer& each : answers) add_run(each.run, Json::null(), runs);
  for (std::size_t i = 0; i < findings.size(); ++i) {
    add_run(findings[i].run, i, runs);
  }
  return Json{{"schema", "btcheck-runs/1"}, {"runs", runs}}.text();
}

std::string Description::json() const {
  return Json{
      {"schema", "btcheck-description/1"},
      {"outcome", static_cast<int>(outcome)},
      {"tree", tree},
      {"profile", profile},
      {"findings", json_of(findings)},
      {"nodes",
       json_list(nodes,
                 [](const DescribedNode& each) { return json_of(each); })},
      {"entries",
       json_list(entries, [](const Entry& each) { return json_of(each); })}}
      .text();
}

std::string Explanation::json() const {
  return Json{{"schema", "btcheck-explanation/1"},
              {"code", code},
              {"summary", summary},
              {"description", description},
              {"help", help}}
      .text();
}

std::string Simulation::json() const {
  constexpr std::array<std::string_view, 6> kEndings = {
      "ended", "fault", "stuck", "ticks", "stopped", "refused"};
  return Json{{"schema", "btcheck-simulation/1"},
              {"outcome", static_cast<int>(outcome)},
              {"tree", tree},
              {"profile", profile},
              {"findings", json_of(findings)},
              {"ending", kEndings[static_cast<std::size_t>(ending)]},
              {"end", end},
              {"ticks", ticks},
              {"lines", Json::array(lines)},
              {"steps", run ? json_of(run->steps) : Json::array()},
              {"variables", json_of(variables)},
              {"statuses", json_of(statuses)}}
      .text();
}

}  // namespace btcheck::v1
