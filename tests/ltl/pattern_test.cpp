// SPDX-License-Identifier: MIT
//
// Every pattern in every scope, in words and by its macro name, is the formula
// that the catalogue of Dwyer, Avrunin and Corbett gives it.
#include <doctest/doctest.h>

#include <cctype>
#include <string>
#include <vector>

#include "ltl/property_text.hpp"

namespace btcheck::test::pattern_test {

namespace {

// The catalogue's letters P, S, Q and r (R is an operator) as conditions: each
// is a node that is done.
std::string spelled_out(const std::string& text) {
  const auto is_part_of_word = [&](std::size_t at) {
    return at < text.size() &&
           std::isalpha(static_cast<unsigned char>(text[at])) != 0;
  };
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    result += text[i];
    const bool is_letter =
        text[i] == 'P' || text[i] == 'S' || text[i] == 'Q' || text[i] == 'r';
    const bool stands_alone =
        (i == 0 || !is_part_of_word(i - 1)) && !is_part_of_word(i + 1);
    if (is_letter && stands_alone) result += ".done";
  }
  return result;
}

// What a body means, with a formula read from `expected` beside it.
void check_pattern(const std::string& body, const std::string& expected) {
  CAPTURE(body);
  const PropertyFile file =
      accepted("prove " + spelled_out(body) + "\n" + "prove ltl " +
               spelled_out(expected) + "\n");
  REQUIRE(file.properties.size() == 2);
  CHECK(file.properties[0].form == PropertyForm::Ltl);
  CHECK(text_of(file, file.properties[0].formula) ==
        text_of(file, file.properties[1].formula));
  CHECK(file.properties[0].formula == file.properties[1].formula);
}

}  // namespace

TEST_CASE("absence in its scopes") {
  check_pattern("absent P before r", "<> r => ((not P) U r)");
  check_pattern("absent P after Q", "[] (Q => [] not P)");
  check_pattern("absent P between Q and r",
                "[] ((Q and not r and <> r) => ((not P) U r))");
  check_pattern("never P after Q until r",
                "[] ((Q and not r) => ((not P) W r))");
}

TEST_CASE("universality in its scopes") {
  check_pattern("always P before r", "<> r => (P U r)");
  check_pattern("always P after Q", "[] (Q => [] P)");
  check_pattern("always P between Q and r",
                "[] ((Q and not r and <> r) => (P U r))");
  check_pattern("always P after Q until r", "[] ((Q and not r) => (P W r))");
}

TEST_CASE("existence in its scopes") {
  check_pattern("present P", "<> P");
  check_pattern("present P before r", "(not r) W (P and not r)");
  check_pattern("eventually P after Q", "([] not Q) or (<> (Q and <> P))");
  check_pattern("present P between Q and r",
                "[] ((Q and not r) => ((not r) W (P and not r)))");
  check_pattern("present P after Q until r",
                "[] ((Q and not r) => ((not r) U (P and not r)))");
}

TEST_CASE("response in its scopes") {
  check_pattern("P leadsto S", "[] (P => <> S)");
  check_pattern("P leadsto S before r",
                "<> r => ((P => ((not r) U (S and not r))) U r)");
  check_pattern("whenever P then S after Q", "[] (Q => [] (P => <> S))");
  check_pattern("P leadsto S between Q and r",
                "[] ((Q and not r and <> r) => "
                "((P => ((not r) U (S and not r))) U r))");
  check_pattern("P leadsto S after Q until r",
                "[] ((Q and not r) => ((P => ((not r) U (S and not r))) W r))");
}

TEST_CASE("precedence in its scopes, in three words") {
  check_pattern("S precedes P", "(not P) W S");
  check_pattern("S before P", "(not P) W S");
  check_pattern("P requires S", "(not P) W S");
  check_pattern("S precedes P before r", "<> r => ((not P) U (S or r))");
  check_pattern("S precedes P after Q",
                "([] not Q) or (<> (Q and ((not P) W S)))");
  check_pattern("P requires S between Q and r",
                "[] ((Q and not r and <> r) => ((not P) U (S or r)))");
  check_pattern("S precedes P after Q until r",
                "[] ((Q and not r) => ((not P) W (S or r)))");
}

TEST_CASE("exclusion in its scopes") {
  check_pattern("P forbids S", "[] (P => [] not S)");
  check_pattern("P forbids S before r", "<> r => ((P => ((not S) U r)) U r)");
  check_pattern("P forbids S after Q", "[] (Q => [] (P => [] not S))");
  check_pattern("P forbids S between Q and r",
                "[] ((Q and not r and <> r) => ((P => ((not S) U r)) U r))");
  check_pattern("P forbids S after Q until r",
                "[] ((Q and not r) => ((P => ((not S) W r)) W r))");
}

TEST_CASE("Fiacre's words without a scope") {
  check_pattern("infinitelyOften P", "[] <> P");
  check_pattern("always eventually P", "[] <> P");
  check_pattern("mortal P", "<> [] not P");
  check_pattern("eventually always P", "<> [] P");
}

TEST_CASE("a scope may stand in front, with a comma") {
  check_pattern("after Q, never P", "[] (Q => [] not P)");
  check_pattern("before r, P leadsto S",
                "<> r => ((P => ((not r) U (S and not r))) U r)");
  check_pattern("between Q and r, always P",
                "[] ((Q and not r and <> r) => (P U r))");
  check_pattern("after Q until r, S precedes P",
                "[] ((Q and not r) => ((not P) W (S or r)))");
  check_pattern("globally, present P", "<> P");
  check_pattern("present P globally", "<> P");
}

TEST_CASE("the ends of a scope may be conditions of several words") {
  check_pattern("absent P between (Q and S) and (r or S)",
                "[] (((Q and S) and not (r or S) and <> (r or S)) => "
                "((not P) U (r or S)))");
  check_pattern("absent P and S after Q or r until S",
                "[] (((Q or r) and not S) => ((not (P and S)) W S))");
}

TEST_CASE("macro names are the patterns in their scopes") {
  check_pattern("absentAfter P Q", "[] (Q => [] not P)");
  check_pattern("absentBefore (P) (r)", "<> r => ((not P) U r)");
  check_pattern("alwaysBetween (P, Q, r)",
                "[] ((Q and not r and <> r) => (P U r))");
  check_pattern("presentUntil P Q r",
                "[] ((Q and not r) => ((not r) U (P and not r)))");
  check_pattern("presentAfterUntil P Q (not r)",
                "[] ((Q and not (not r)) => "
                "((not (not r)) U (P and not (not r))))");
  check_pattern("leadstoAfter P S Q", "[] (Q => [] (P => <> S))");
  check_pattern("precedesBefore S P r", "<> r => ((not P) U (S or r))");
}

TEST_CASE("real-time patterns, with closed, open and endless intervals") {
  const auto claims = [](const std::string& body) {
    const PropertyFile file = accepted("prove " + spelled_out(body) + "\n");
    CHECK(file.properties[0].form == PropertyForm::Timed);
    return meaning(file, file.properties[0]);
  };
  const auto expected = [](const std::string& text) {
    return spelled_out(text);
  };
  CHECK(claims("P leadsto S within [0,2]") ==
        expected("response [0,2]: P ~> S"));
  CHECK(claims("whenever P then S within 3 ticks") ==
        expected("response [0,3]: P ~> S"));
  CHECK(claims("P leadsto S within ]0,4[") ==
        expected("response [1,3]: P ~> S"));
  CHECK(claims("P leadsto S within [2,...[") ==
        expected("response [2,inf]: P ~> S"));
  CHECK(claims("P leadsto first S within ]1,inf[") ==
        "first response [2,inf]: P.done ~> S.done");
  CHECK(claims("P leadsto S within [0,2] before r") ==
        expected("response [0,2]: P ~> S before r"));
  CHECK(claims("after Q, P leadsto S within [0,2]") ==
        expected("response [0,2]: P ~> S after Q"));
  CHECK(claims("P forbids S within 2 ticks") ==
        expected("absence [0,2]: P ~> S"));
  CHECK(claims("present P within [0,3]") == "response [0,3]: P.done");
  CHECK(claims("present P after Q within [1,3]") ==
        expected("response [1,3]: P after Q"));
  CHECK(claims("present first P after Q within [1,3]") ==
        "first response [1,3]: P.done after Q.done");
  CHECK(claims("absent P within [0,3]") == "absence [0,3]: P.done");
  CHECK(claims("absent P after Q for 3") ==
        "absence [0,3]: P.done after Q.done");
  CHECK(claims("never P after Q for [2,3]") ==
        "absence [2,3]: P.done after Q.done");
  CHECK(claims("always P after Q for 3 ticks") ==
        "absence [0,3]: not P.done after Q.done");
  CHECK(claims("absent P before r for 3") ==
        "absence [0,2]: P.done ~> r.done before r.done");
  CHECK(claims("present P lasting 3") ==
        "lasting [0,2]: P.done after P.done at least once");
}

TEST_CASE("branching time is read with its quantifiers") {
  CHECK(proves("AG EF a.done") == "branching: AG EF a.done");
  CHECK(proves("live a.done") == "branching: AG EF a.done");
  CHECK(proves("AG (a.done => AF b.done)") ==
        "branching: AG (a.done => AF b.done)");
  CHECK(proves("A [a.done U b.done]") == "branching: A (a.done U b.done)");
  CHECK(proves("E (a.done W (b.done or tick))") ==
        "branching: E (a.done W (b.done or tick))");
  CHECK(proves("not EX a.done") == "branching: not EX a.done");
  CHECK(codes("prove AX a.done") == "BT1204");
  CHECK(proves("EG not a.done") == "branching: EG not a.done");
}

TEST_CASE("events of steps are atoms of runs, not of states") {
  CHECK(proves("[] (enter a.done => <> b.done)") ==
        "ltl: [] (enter a.done => <> b.done)");
  CHECK(proves("never leave (a.done or b.done)") ==
        "ltl: [] not (leave (a.done or b.done))");
  CHECK(proves("always (time.passes => not a.moves)") ==
        "ltl: [] (time.passes => not a.moves)");
  CHECK(codes("prove possible enter a.done") == "BT1214");
  CHECK(codes("prove a.moves leadsto b.done within [0,1]") == "BT1214");
  CHECK(codes("prove <> enter (enter a.done)") == "BT1214");
  CHECK(codes("prove <> enter (<> a.done)") == "BT1214");
}

TEST_CASE("assumptions have names or get one") {
  const PropertyFile file = accepted(
      "assume actions_end: every action eventually ends\n"
      "assume [] <> a.done => [] <> b.done\n"
      "assume sane is never c.done\n"
      "prove <> b.done\n");
  REQUIRE(file.assumptions.size() == 3);
  CHECK(file.assumptions[0].kind == Assumption::Kind::ActionsEnd);
  CHECK(file.assumptions[0].name == "actions_end");
  CHECK(file.assumptions[1].name == "assume2");
  CHECK(text_of(file, file.assumptions[1].formula) ==
        "[] <> a.done => [] <> b.done");
  CHECK(file.assumptions[2].name == "sane");
  CHECK(text_of(file, file.assumptions[2].formula) == "[] not c.done");
}

}  // namespace btcheck::test::pattern_test
