// SPDX-License-Identifier: MIT
//
// What the formats have in common, and lines of JSON.
#include <fmt/format.h>

#include <algorithm>
#include <sstream>
#include <vector>

#include "check/simulate/course.hpp"
#include "model/tree/node_types.hpp"
#include "suites/formats.hpp"
#include "text/json.hpp"
#include "trace/formats/text.hpp"

namespace btcheck {

std::string tick_text(const DescribedSuite& described, const SuiteTick& tick) {
  if (tick.root.empty()) return "throws";
  std::string text = "root=" + tick.root;
  for (const auto& [node, answers] : tick.nodes) {
    text += fmt::format(" {}={}", described.keys[index(node)], answers);
  }
  return text;
}

std::string answers_text(const std::vector<LeafAnswer>& answers) {
  std::string text;
  for (std::size_t i = 0; i < answers.size();) {
    std::size_t end = i + 1;
    while (end < answers.size() && answers[end].answer == answers[i].answer) {
      ++end;
    }
    if (!text.empty()) text += ' ';
    text += answers[i].answer;
    if (end - i > 1) text += fmt::format("*{}", end - i);
    i = end;
  }
  return text;
}

std::string script_text(const DescribedSuite& described,
                        const BehaviorTree& tree, const SuiteTest& test) {
  std::string text;
  for (const auto& [leaf, answers] : test.leaves) {
    text += fmt::format("{}: {}\n", described.keys[index(leaf)],
                        answers_text(answers));
  }
  // One value for each tick.
  std::map<StateVariableId, int> moved;
  for (const SuiteTick& tick : test.ticks) {
    for (const auto& [variable, value] : tick.variables) moved[variable] = 0;
  }
  for (const auto& [variable, none] : moved) {
    const StateVariable& named = tree.variable(variable);
    int value = named.initial;
    std::string values;
    for (const SuiteTick& tick : test.ticks) {
      const auto move = tick.variables.find(variable);
      if (move != tick.variables.end()) value = move->second;
      values += ' ' + named.value_name(value);
    }
    text += fmt::format("${}:{}\n", named.name, values);
  }
  return text;
}

std::vector<std::string> played_script(const BehaviorTree& tree,
                                       const Network& network,
                                       const std::string& script, int ticks) {
  std::vector<std::string> all;
  TickLines lines(tree, network);
  const auto take = [&](const std::string& line) {
    std::istringstream words(line.substr(line.find(": ") + 2));
    std::string text;
    for (std::string word; words >> word;) {
      const std::string name = word.substr(0, word.find('='));
      if (std::ranges::count(tree.variables, name, &StateVariable::name) > 0) {
        continue;
      }
      text += (text.empty() ? "" : " ") + word;
    }
    all.push_back(text.starts_with("root=none") ? "throws" : text);
  };
  Course course;
  course.ticks = ticks;
  course.told = [&](const Valuation&, const RunStep& step) {
    const std::string line = lines.take(step);
    if (!line.empty()) take(line);
  };
  const SourceText source("script", script);
  const auto run = simulated_by_script(tree, network, source, course);
  if (run.value) {
    const std::string rest = lines.rest(run.value->state());
    if (!rest.empty()) take(rest.substr(0, rest.find('\n')));
  }
  if (has_error(run.diagnostics)) all.push_back(run.diagnostics[0].message);
  return all;
}

void note_scripts(const DescribedSuite& described, const BehaviorTree& tree,
                  const Network& network, Suite& suite) {
  for (SuiteTest& test : suite.tests) {
    std::vector<std::string> expected;
    for (const SuiteTick& tick : test.ticks) {
      expected.push_back(tick_text(described, tick));
    }
    test.has_script =
        played_script(tree, network, script_text(described, tree, test),
                      static_cast<int>(expected.size())) == expected;
  }
}

namespace {

Json value_json(const btcpp::ScriptValue& value) {
  if (value.kind == btcpp::ScriptKind::Text) return Json(value.text);
  if (value.type == btcpp::NumberType::Integer) {
    return Json(static_cast<std::int64_t>(value.number));
  }
  const std::string digits = fmt::format("{}", value.exact_number());
  const bool has_point = digits.find_first_of(".en") != digits.npos;
  return Json::number(has_point ? digits : digits + ".0");
}

Json writes_json(const DescribedSuite& described,
                 const std::vector<EntryWrite>& writes) {
  Json all = Json::array();
  for (const EntryWrite& write : writes) {
    all.push(Json{{"home", described.keys[index(write.home)]},
                  {"entry", write.key},
                  {"value", value_json(write.value)}});
  }
  return all;
}

Json cells_json(const DescribedSuite& described, const std::set<Cell>& cells) {
  Json all = Json::array();
  for (const auto& [node, question] : cells) {
    all.push(Json{{"node", described.keys[index(node)]},
                  {"answer", word_of(question)}});
  }
  return all;
}

Json suite_json(const DescribedSuite& described, const BehaviorTree& tree,
                const Suite& suite) {
  Json leaves = Json::array();
  for (const SuiteLeaf& leaf : described.leaves) {
    Json ports = Json::array();
    for (const SuiteLeafPort& port : leaf.ports) {
      ports.push(Json{{"name", port.name},
                      {"direction", std::string(1, port.direction)},
                      {"type", port.type}});
    }
    leaves.push(Json{{"id", leaf.id},
                     {"is_condition", leaf.is_condition},
                     {"ports", ports}});
  }
  Json nodes = Json::array();
  for (std::uint32_t n = 0; n < tree.nodes.size(); ++n) {
    const Node& node = tree.nodes[n];
    if (node.is_root()) continue;
    nodes.push(
        Json{{"key", described.keys[n]},
             {"type", node.type == NodeType::SubTree ? "SubTree" : node.id},
             {"keeps", node.contract.memory == LeafMemory::Latched}});
  }
  Json left_out = Json::array();
  for (const LeftOut& left : suite.left_out) {
    left_out.push(Json{{"node", described.keys[index(left.cell.first)]},
                       {"answer", word_of(left.cell.second)},
                       {"reason", left.reason}});
  }
  Json json{{"kind", "suite"},
            {"schema", "btcheck-tests/1"},
            {"about", kSuiteMark},
            {"suite", described.name},
            {"file", described.file},
            {"tree", described.title},
            {"profile", profile_name(tree.profile)},
            {"release", described.release},
            {"tests", suite.tests.size()},
            {"proven", suite.proven.size()},
            {"reached", cells_json(described, suite.reached)},
            {"left_out", left_out},
            {"is_complete", suite.is_complete},
            {"linked", Json::array(described.linked)},
            {"unknown", Json::array(described.unknown)},
            {"leaves", leaves},
            {"nodes", nodes},
            {"initial", writes_json(described, suite.initial)},
            {"xml", described.xml}};
  return json;
}

Json test_json(const DescribedSuite& described, const BehaviorTree& tree,
               const SuiteTest& test) {
  Json leaves = Json::array();
  for (const auto& [leaf, answers] : test.leaves) {
    Json given = Json::array();
    for (const LeafAnswer& each : answers) {
      given.push(Json{{"answer", each.answer},
                      {"writes", writes_json(described, each.writes)}});
    }
    leaves.push(
        Json{{"leaf", described.keys[index(leaf)]}, {"answers", given}});
  }
  Json ticks = Json::array();
  for (const SuiteTick& tick : test.ticks) {
    Json nodes = Json::array();
    for (const auto& [node, answers] : tick.nodes) {
      nodes.push(
          Json{{"node", described.keys[index(node)]}, {"answers", answers}});
    }
    Json moves = Json::array();
    for (const auto& [variable, value] : tick.variables) {
      moves.push(Json{{"variable", tree.variable(variable).name},
                      {"value", tree.variable(variable).value_name(value)}});
    }
    ticks.push(Json{{"before", writes_json(described, tick.before)},
                    {"moves", moves},
                    {"root", tick.root.empty() ? "throws" : tick.root},
                    {"nodes", nodes}});
  }
  return Json{{"kind", "test"},
              {"name", test.name},
              {"about", test.about},
              {"code", test.code},
              {"reaches", cells_json(described, test.cells)},
              {"leaves", leaves},
              {"ticks", ticks}};
}

}  // namespace

SuiteFile jsonl_file(const DescribedSuite& described, const BehaviorTree& tree,
                     const Suite& suite) {
  std::string text = suite_json(described, tree, suite).text() + '\n';
  for (const SuiteTest& test : suite.tests) {
    text += test_json(described, tree, test).text() + '\n';
  }
  return {described.name + ".tests.jsonl", std::move(text)};
}

}  // namespace btcheck
