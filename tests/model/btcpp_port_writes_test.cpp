// SPDX-License-Identifier: MIT
//
// Entries that the ports of leaves write: their values, and what is known of a
// condition over a value that is not.
#include <doctest/doctest.h>

#include <algorithm>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "btcpp_text.hpp"
#include "model/btcpp/entries/meaning.hpp"
#include "script_engine.hpp"

namespace btcheck::btcpp::btcpp_port_writes_test {
namespace {

using script_engine::Script;
using script_engine::Thrown;
using script_engine::Value;

std::string escaped(const std::string& script) {
  std::string all;
  for (const char c : script) {
    all += c == '<' ? "&lt;" : c == '&' ? "&amp;" : std::string(1, c);
  }
  return all;
}

// The type of a port that writes `x`, in a model: "" for none.
std::string written(const std::string& type, const std::string& script) {
  return "<root BTCPP_format=\"4\"><BehaviorTree ID=\"T\"><Sequence>"
         "<Read out=\"{x}\"/><Script code=\"" +
         escaped(script) +
         "\"/></Sequence></BehaviorTree><TreeNodesModel><Action ID=\"Read\">"
         "<output_port name=\"out\"" +
         (type.empty() ? type : " type=\"" + type + "\"") +
         "/></Action></TreeNodesModel></root>";
}

struct Written {
  ReadTree tree;
  ScriptWorld world;
  std::vector<int> state;

  Written(const std::string& type, const std::string& script)
      : tree(good_tree(written(type, script))),
        world(script_world(tree.expansion)) {
    for (const auto& each : world.variables) state.push_back(each.initial);
  }

  StateVariableId number(const std::string& name) const {
    return *world.variable_of({0, name});
  }
  std::string get(const std::string& name) const {
    const std::size_t i = index(number(name));
    return world.variables[i].value_name(state[i]);
  }
  std::string states(const std::string& name) const {
    std::string all;
    for (const auto& each : world.variables[index(number(name))].states) {
      all += (all.empty() ? "" : " ") + each;
    }
    return all;
  }
  std::int64_t evaluated(const Expression& expression) const {
    return expression.evaluate([&](const Term& term) {
      return state[static_cast<std::size_t>(term.operand)];
    });
  }
  void assign(const std::vector<StateAssignment>& assignments) {
    for (const StateAssignment& each : assignments) {
      state[index(each.variable)] = static_cast<int>(evaluated(each.value));
    }
  }
  // The leaf `Read` is node 1.
  void write(bool is_sure) {
    assign(
        compile_port_writes(world, world.writers.port_writes.at(1), is_sure));
  }
  ScriptMeaning meaning(const std::string& script) const {
    return compile_script(tree.expansion, world, 0, parse_script(script));
  }
  // "T", "F", "!" for an exception, "-" where the entry may not be there.
  std::string told(const std::string& script) const {
    const ScriptMeaning is = meaning(script);
    std::string all;
    if (evaluated(is.may_hold) != 0) all += 'T';
    if (evaluated(is.may_fail) != 0) all += 'F';
    if (evaluated(is.may_throw) != 0) all += '!';
    if (evaluated(is.may_lack) != 0) all += '-';
    return all;
  }
};

// What is known of a condition over what a port of this type has written.
std::string told(const std::string& type, const std::string& condition) {
  Written w(type, condition);
  w.write(true);
  return w.told(condition);
}

TEST_CASE("an entry has any value after its port was written") {
  Written w("std::string", "x := 'driver'");
  CHECK(w.states("x") == "unknown any driver");
  CHECK(w.told("x == 'driver'") == "TF!-");
  w.write(true);
  CHECK(w.get("x") == "any");
  CHECK(w.told("x == 'driver'") == "TF");
  w.assign(w.meaning("x := 'driver'").assignments);
  CHECK(w.get("x") == "driver");
  CHECK(w.told("x == 'driver'") == "T");
  w.write(false);
  CHECK(w.get("x") == "any");
}

TEST_CASE("what a port may not have written is unknown still") {
  Written w("int", "x < 10");
  w.write(false);
  CHECK(w.get("x") == "unknown");
  CHECK(w.told("x < 10") == "TF!-");
  w.write(true);
  w.write(false);
  CHECK(w.get("x") == "any");
  CHECK(w.told("x < 10") == "TF");
}

TEST_CASE("an entry keeps the type of its port") {
  const auto after = [](const std::string& type, const std::string& script) {
    Written w(type, script);
    w.write(true);
    w.assign(w.meaning(script).assignments);
    return w.get("x");
  };
  CHECK(after("std::string", "x := 'a'") == "a");
  CHECK(after("int", "x := '7'; x < 9") == "7");
  CHECK(after("double", "x := '7.5'; x < 9") == "7_5");
  CHECK(after("", "x := 'a'") == "a");
  CHECK(after("", "x := 3") == "3");
  CHECK(after("Pose2D", "x := 'a'") == "any");
  // Neither throws because of what a leaf writes, but where it always would.
  CHECK(Written("int", "x := 'a'").told("x := 'a'") == "!");
}

TEST_CASE("a condition that no value meets is known not to hold") {
  const auto all = [](const std::string& condition, const std::string& what) {
    CAPTURE(condition);
    CHECK(told("", condition) == what);
  };
  all("x >= 30 && x < 10", "F");
  all("x >= 10 && x < 30", "TF");
  all("10 <= x < 30", "TF");
  all("30 <= x < 10", "F");
  all("x == 'a' && x == 'b'", "F");
  all("x == 'a' || x != 'a'", "T");
  all("x > 'a' && x < 'b'", "TF");
  all("!x && x", "F");
  all("x == 3 && x > 3", "TF");  // equal within an epsilon
  // What is computed with it is not looked at so closely.
  all("x + 0 >= 30 && x < 10", "TF");
}

TEST_CASE("the type of a port makes a condition known") {
  CHECK(told("int", "x > 3 && x < 4") == "F");
  CHECK(told("double", "x > 3 && x < 4") == "TF");
  CHECK(told("int", "x == 3 && x > 3") == "F");
  CHECK(told("std::string", "x == 'Idle' && x == 'Busy'") == "F");
  CHECK(told("", "x == 'Idle' && x == 'Busy'") == "TF");  // enumerators
  CHECK(told("std::string", "x == 'a' && x > 3") == "TF");
  CHECK(told("std::string", "x > 3 && x < 2") == "F");
  CHECK(told("double", "x < 3 || x >= 3") == "T");
  CHECK(told("double", "x == 3 || x < 3 || x > 3") == "T");
}

TEST_CASE("no value is left out: what the engine does may be") {
  const std::vector<std::pair<std::string, std::vector<Value>>> types = {
      {"int", {std::int64_t{1}, 0L, -2L, 3L, 4L, 5L, 7L, 100L}},
      {"double", {0.0, 1.0, 0.5, 3.0, 3.00000005, 2.99999995, 4.5, 1e30, -2.5}},
      {"std::string", {"", "a", "b", "aa", "3", "7", "true", "c", "4x"}},
      {"", {1L, 3L, 4.5, 0.0, "", "a", "ab", "3", "7.5", "false", 3.00000005}}};
  const std::vector<Value> literals = {0L,  1L,  3L,  4L,    3.5,
                                       "a", "b", "3", "true"};
  std::mt19937 random(7);
  const auto any = [&](const auto& of) { return of[random() % of.size()]; };
  const std::vector<std::string> signs = {"==", "!=", "<", "<=", ">", ">="};
  const auto asked = [&](auto& again, int depth) -> Script {
    const Script x = script_engine::named("x");
    if (depth == 0 || random() % 3 == 0) {
      if (random() % 8 == 0) return x;
      if (random() % 8 == 0) return script_engine::joined("!", {x});
      Script compared = script_engine::joined(
          "cmp", {x, script_engine::literal(any(literals))});
      if (random() % 2 == 0) std::swap(compared.kids[0], compared.kids[1]);
      compared.chain = {any(signs)};
      return compared;
    }
    return script_engine::joined(
        random() % 2 == 0 ? "&&" : "||",
        {again(again, depth - 1), again(again, depth - 1)});
  };
  int ends = 0;
  int decided = 0;
  for (int trial = 0; trial < 1500; ++trial) {
    const auto picked = any(types);
    const std::string& type = picked.first;
    const Script condition = asked(asked, 2);
    const std::string text = condition.text();
    CAPTURE(type);
    CAPTURE(text);
    const std::string what = told(type, text);
    for (const Value& value : picked.second) {
      script_engine::Blackboard board = {{"x", value}};
      std::optional<bool> holds;
      try {
        holds = script_engine::as_truth(script_engine::run(condition, board));
      } catch (const Thrown&) {
        continue;
      }
      ++ends;
      CHECK(what.find(*holds ? 'T' : 'F') != std::string::npos);
    }
    if (what == "T" || what == "F") ++decided;
  }
  CHECK(ends > 3000);
  CHECK(decided > 60);
}

}  // namespace
}  // namespace btcheck::btcpp::btcpp_port_writes_test
