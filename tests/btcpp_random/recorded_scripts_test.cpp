// SPDX-License-Identifier: MIT
//
// Random scripts as BehaviorTree.CPP 4.10 itself has run them
// (tests/btcpp_engine/run_scripts): what it did is among what btcheck says that
// they may do, and executed on real values they do nothing else.
#include <doctest/doctest.h>

#include <cstdint>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "file_text.hpp"
#include "model/btcpp/tree/entry_programs.hpp"
#include "model/script_engine.hpp"
#include "model/tree_file.hpp"

namespace btcheck::reference::recorded_scripts_test {
namespace {

using btcpp::EntryExecution;
using btcpp::ScriptKind;
using btcpp::ScriptValue;

std::string escaped(const std::string& script) {
  std::string text;
  for (const char c : script) {
    text += c == '<' ? "&lt;" : c == '&' ? "&amp;" : std::string(1, c);
  }
  return text;
}

BehaviorTree condition_of(const std::string& script) {
  TreeReading reading;
  reading.profile = Profile::Btcpp4;
  auto tree = read_tree("t.xml",
                        "<root BTCPP_format=\"4\"><BehaviorTree ID=\"M\">"
                        "<ScriptCondition code=\"" +
                            escaped(script) + "\"/></BehaviorTree></root>",
                        reading);
  REQUIRE(tree.value.has_value());
  return std::move(*tree.value);
}

// As the records show it; nothing where the value is not known.
std::optional<std::string> told(const ScriptValue& value) {
  switch (value.kind) {
    case ScriptKind::Unset:
    case ScriptKind::Empty:
      return "nothing";
    case ScriptKind::NotANumber:
      return "nan";
    case ScriptKind::Text:
      return script_engine::shown(value.text);
    case ScriptKind::Number:
      if (value.type == btcpp::NumberType::Integer) {
        return script_engine::shown(static_cast<std::int64_t>(value.number));
      }
      return script_engine::shown(value.exact_number());
    default:
      return std::nullopt;
  }
}

struct Counts {
  int scripts = 0;
  int open = 0;     // may come out in more ways than one, on real values
  int entries = 0;  // told of
  int unknown = 0;  // of these, on real values
};

// What the scripts may come to: the engine's words, of which only "throws" ends
// the run; "no truth" is an exception of the ScriptCondition.
struct Told {
  bool holds = false;
  bool fails = false;
  bool throws = false;

  bool allows(const std::string& outcome) const {
    return outcome.starts_with("true")    ? holds
           : outcome.starts_with("false") ? fails
                                          : throws;
  }
  bool is_sure() const { return holds + fails + throws == 1; }
};

// Of the script's meaning over all values of the entries.
Told told_by_meaning(const BehaviorTree& tree, const Script& script) {
  const auto is_so = [&](const Expression& where) {
    return where.evaluate([&](const Term& term) {
      return tree.variable(static_cast<StateVariableId>(term.operand)).initial;
    }) != 0;
  };
  const auto may = [&](const std::optional<Expression>& where) {
    return where.has_value() && is_so(*where);
  };
  Told told{is_so(script.may_hold), is_so(script.may_fail), false};
  told.throws = may(script.may_throw) || may(script.may_lack) ||
                may(script.may_leave) || (!told.holds && !told.fails);
  return told;
}

Told told_by_values(const BehaviorTree& tree, std::int32_t program) {
  const auto may = [&](ScriptOutcomeKind outcome) {
    return EntryExecution(*tree.programs).execute({program, outcome});
  };
  return {may(ScriptOutcomeKind::Holds), may(ScriptOutcomeKind::Fails),
          may(ScriptOutcomeKind::Throws)};
}

void check_entries(const BehaviorTree& tree, std::int32_t program,
                   const std::string& outcome, Counts& counts) {
  EntryExecution values(*tree.programs);
  values.execute({program, outcome.starts_with("true")
                               ? ScriptOutcomeKind::Holds
                               : ScriptOutcomeKind::Fails});
  for (std::size_t i = 0; i < values.values().size(); ++i) {
    const std::string& name = tree.programs->entries[i].name;
    const auto now = told(values.values()[i]);
    ++counts.entries;
    if (!now) ++counts.unknown;
    if (!now) continue;
    const std::string held = " " + name + "=" + *now;
    CAPTURE(held);
    CHECK((outcome + " ").find(held + " ") != outcome.npos);
  }
}

void check_line(const std::string& line, Counts& counts) {
  CAPTURE(line);
  const std::size_t arrow = line.find(" => ");
  REQUIRE(arrow != line.npos);
  const std::string outcome = line.substr(arrow + 4);
  const BehaviorTree tree = condition_of(line.substr(0, arrow));
  const Script& script = tree.nodes.back().own_scripts.at(0);
  ++counts.scripts;
  CHECK(told_by_meaning(tree, script).allows(outcome));
  const Told told = told_by_values(tree, script.program);
  CHECK(told.allows(outcome));
  if (!told.is_sure()) ++counts.open;
  const bool ends = outcome.starts_with("true") || outcome.starts_with("false");
  if (ends) check_entries(tree, script.program, outcome, counts);
}

}  // namespace

TEST_CASE("random scripts come out as BehaviorTree.CPP 4.10 has run them") {
  std::istringstream lines(
      file_text(std::string(BTCHECK_BTCPP_RECORDS) + "/scripts-4.10.0.txt"));
  Counts counts;
  for (std::string line; std::getline(lines, line);) check_line(line, counts);
  MESSAGE(counts.scripts << " scripts, of which " << counts.open
                         << " may come out in several ways; of "
                         << counts.entries << " entries " << counts.unknown
                         << " are not known");
  CHECK(counts.scripts >= 1000);
  CHECK(counts.open * 100 < counts.scripts * 5);
  CHECK(counts.unknown * 100 < counts.entries * 2);
}

}  // namespace btcheck::reference::recorded_scripts_test
