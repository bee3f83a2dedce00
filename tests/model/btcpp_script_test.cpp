// SPDX-License-Identifier: MIT
//
// The syntax of scripts, after BehaviorTree.CPP's own tests of its parser.
#include <doctest/doctest.h>

#include <memory>
#include <string>

#include "model/btcpp/script/script.hpp"

namespace btcheck::btcpp::btcpp_script_test {
namespace {

// "x:= y=" for a script that creates x and changes y; "z" is read.
std::string names_of(std::string_view script) {
  std::string all;
  for (const ScriptName& each : parse_script(script).names) {
    if (!all.empty()) all += ' ';
    all += each.name;
    if (each.use == ScriptUse::Create) all += ":=";
    if (each.use == ScriptUse::Change) all += "=";
  }
  return all;
}

TEST_CASE("what is a script") {
  for (const char* script : {"1",
                             "x",
                             "x:=1",
                             "x := 1; y = 2 ;; z",
                             "a b c",
                             "a<b<=c",
                             "!-~x",
                             "a ? b : c",
                             "a ? x := 1 : y",
                             "'text' .. 65.43",
                             "65..66",
                             "0xAf",
                             "1e3",
                             "2.5E-2",
                             "@x + _y",
                             "(a && b) || !c",
                             "a & b | c ^ d",
                             "x += 1\n y -= 2",
                             "true",
                             "x = y == 3"}) {
    CAPTURE(script);
    CHECK(parse_script(script).flaw == "");
  }
}

TEST_CASE("enumerators are numbers where they are read") {
  const auto enums =
      std::make_shared<const ScriptEnums>(ScriptEnums{{"RED", 1}, {"x", 7}});
  const auto names = [&](std::string_view script) {
    std::string all;
    for (const ScriptName& each :
         parse_script(script, kNewestRelease, enums).names) {
      all += each.name + (each.use == ScriptUse::Read ? " " : "= ");
    }
    return all;
  };
  CHECK(names("y := RED + GREEN") == "y= GREEN ");
  CHECK(names("RED := 5; y = RED") == "RED= y= ");
  CHECK(names("x += x") == "x= ");
  CHECK(names("@RED == RED") == "@RED ");
  const ScriptTree tree = parse_script("RED", kNewestRelease, enums).tree;
  CHECK(tree.terms[0].number == 1.0);
  CHECK(!tree.terms[0].is_integer);  // Any(double(…)) of ExprName
}

TEST_CASE("what is none, and where") {
  struct Flaw {
    const char* script;
    std::size_t at;
    const char* flaw;
  };
  for (const Flaw& each :
       {Flaw{"", 0, "the script is empty"},
        Flaw{";", 0, "an operand is missing"},
        Flaw{"x := 1 +", 8, "an operand is missing"},
        Flaw{"(a", 2, "`)` is missing"},
        Flaw{"a ? b", 5, "`:` is missing after `?`"},
        Flaw{"'open", 0, "`'open` means nothing here"},
        Flaw{"65.x", 0, "`65.x` means nothing here"},
        Flaw{"3foo", 0, "`3foo` means nothing here"},
        Flaw{"0x", 0, "`0x` means nothing here"},
        Flaw{"1e", 0, "`1e` means nothing here"},
        Flaw{"a # b", 2, "`#` means nothing here"},
        Flaw{"1 := 2", 2, "only a name can be assigned to"},
        Flaw{"a + b := 2", 6, "only a name can be assigned to"},
        Flaw{"a ? b : c := 1", 10, "an operand is missing"}}) {
    CAPTURE(each.script);
    const ScriptSyntax syntax = parse_script(each.script);
    CHECK(syntax.flaw == each.flaw);
    CHECK(syntax.flaw_at == each.at);
  }
}

TEST_CASE("nesting is bounded") {
  CHECK(
      parse_script(std::string(100, '(') + "x" + std::string(100, ')')).flaw ==
      "");
  CHECK(parse_script(std::string(100000, '(')).flaw ==
        "this is nested too deeply");
  CHECK(parse_script(std::string(100000, '!')).flaw ==
        "this is nested too deeply");
}

TEST_CASE("names are read, created or changed") {
  CHECK(names_of("x := y + 1; z += x; @w == true") == "x:= y z= x @w");
  CHECK(names_of("a ? b := 1 : c") == "a b:= c");
  CHECK(names_of("x := y = 3") == "x:= y=");
}

}  // namespace
}  // namespace btcheck::btcpp::btcpp_script_test
