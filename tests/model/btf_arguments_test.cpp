// SPDX-License-Identifier: MIT
//
// What :args are evaluated to, and what their values stay between.
#include <doctest/doctest.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "model/tree/tree.hpp"

namespace btcheck::btf_arguments_test {
namespace {

constexpr std::string_view kDeclarations =
    "(defsv level :min -1 :max 3) (defsv battery :states (Good Low))"
    "(defun twice (x) (* 2 x))";

BehaviorTree tree_with(const std::string& text) {
  auto read = read_btf("t.btf", std::string(kDeclarations) + text);
  REQUIRE(read.value.has_value());
  return std::move(*read.value);
}

ArgumentValue value_of(const std::string& argument) {
  CAPTURE(argument);
  const BehaviorTree tree =
      tree_with("(BehaviorTree (Sequence (Action :ID a :args (z " + argument +
                ")) (Eval (= 2 (twice 1)))))");
  const auto& known = tree.nodes[2].arguments.at(0).known;
  REQUIRE(known.has_value());
  return *known;
}

std::int64_t constant_of(const ArgumentValue& value) {
  return value.value.evaluate([](const Term&) { return std::int64_t{0}; });
}

}  // namespace

TEST_CASE("an argument is a number, a state, true or false, or a symbol") {
  const ArgumentValue number = value_of("(+ 1 (twice $level))");
  CHECK(number.min == -1);
  CHECK(number.max == 7);
  CHECK(number.decimals == 0);
  CHECK(number.names.empty());
  const std::vector<std::string> states = {"Good", "Low"};
  CHECK(value_of("$battery").names == states);
  const std::vector<std::string> truth = {"false", "true"};
  CHECK(value_of("(= battery Low)").names == truth);
  for (const std::string word : {"level", "a/b", "GridBased", "1.2.3", "5m"}) {
    CHECK(value_of(word).names == std::vector<std::string>{word});
  }
  CHECK(value_of("\"two words\"").names ==
        std::vector<std::string>{"two words"});
}

TEST_CASE("decimals are counted") {
  const struct {
    const char* written;
    int value;
    int decimals;
  } kCases[] = {{"0.5", 5, 1},
                {"-.25", -25, 2},
                {"+1.50", 15, 1},
                {"2.0", 2, 0},
                {"1.", 1, 0},
                {"(+ 1 0.5)", 15, 1},
                {"(- 0.5 0.25)", 25, 2},
                {"(* 0.5 0.25 2)", 250, 3},
                {"(- 0.5)", -5, 1}};
  for (const auto& each : kCases) {
    const ArgumentValue value = value_of(each.written);
    CHECK(constant_of(value) == each.value);
    CHECK(value.decimals == each.decimals);
  }
  CHECK(value_of("(* 0.5 $level)").min == -5);
  CHECK(constant_of(value_of("(< 0.5 0.25)")) == 0);
  CHECK(constant_of(value_of("(< 0.5 1)")) == 1);
  CHECK(decimal_text(-5, 1) == "-0.5");
  CHECK(decimal_text(1500, 3) == "1.5");
  CHECK(decimal_text(20, 1) == "2");
  CHECK(decimal_text(7, 0) == "7");
}

TEST_CASE("what belongs to the program around the tree is not known") {
  const BehaviorTree tree = tree_with(
      "(BehaviorTree (Sequence (Eval (= 2 (twice level))) (SubTree :ID s :args "
      "(goal $target pose (1 $x))))) (BehaviorTree :name s (Action :ID a :args "
      "(goal $goal pose $pose)))");
  for (const Node& node : tree.nodes) {
    for (const Argument& each : node.arguments) CHECK(!each.known.has_value());
  }
}

}  // namespace btcheck::btf_arguments_test
