// SPDX-License-Identifier: MIT
//
// What the user says of findings, one after the other: comments, levels, what
// is denied, the baseline.
#include "check/findings/judgement.hpp"

#include <doctest/doctest.h>

#include <string>
#include <vector>

namespace btcheck::judgement_test {
namespace {

Diagnostic found(const std::string& code, Severity severity, int line = 1,
                 const std::string& file = "a/t.xml") {
  Diagnostic diagnostic;
  diagnostic.code = code;
  diagnostic.severity = severity;
  diagnostic.file = file;
  diagnostic.span = {line, 1, 1};
  diagnostic.source_line = "  <A/> ";
  return diagnostic;
}

Judgement said() {
  Judgement judgement;
  judgement.directory = "/w";
  return judgement;
}

LevelRule rule(const std::string& code, Level level,
               const std::string& pattern = "") {
  return {code, level, "/w", pattern};
}

// "error BT2205, note BT2208": what is left of them.
std::string left_of(std::vector<Diagnostic> all, const Judgement& judgement,
                    Judged* judged = nullptr,
                    const std::string& text = "<A/>") {
  const std::vector<SourceText> sources = {{"a/t.xml", text}};
  FindingsJudge judging(judgement, sources);
  judging.judge(all);
  std::string left;
  for (const Diagnostic& each : all) {
    left += (left.empty() ? "" : ", ") +
            std::string(severity_name(each.severity)) + " " + each.code;
  }
  if (judged != nullptr) *judged = judging.take();
  return left;
}

const std::vector<Diagnostic> kThree = {found("BT2205", Severity::Note),
                                        found("BT2208", Severity::Warning),
                                        found("BT1004", Severity::Error)};

TEST_CASE("a level is what a finding has from then on; errors keep theirs") {
  Judgement judgement = said();
  judgement.levels = {rule("BT2205", Level::Error), rule("BT2208", Level::Note),
                      rule("BT1004", Level::Allow)};
  Judged judged;
  CHECK(left_of(kThree, judgement, &judged) ==
        "error BT2205, note BT2208, error BT1004");
  CHECK(judged.is_denied);
  judgement.levels = {rule("BT2208", Level::Allow)};
  CHECK(left_of(kThree, judgement, &judged) == "note BT2205, error BT1004");
  CHECK(judged.allowed == 1);
  CHECK(!judged.is_denied);
}

TEST_CASE("the last level that fits the file decides") {
  const std::vector<Diagnostic> one = {found("BT2208", Severity::Warning)};
  Judgement judgement = said();
  const auto with = [&](const std::string& pattern) {
    judgement.levels = {rule("BT2208", Level::Error),
                        rule("BT2208", Level::Note, pattern)};
    return left_of(one, judgement);
  };
  CHECK(with("a/*") == "note BT2208");
  CHECK(with("a/**") == "note BT2208");
  CHECK(with("*.xml") == "note BT2208");
  CHECK(with("t.?ml") == "note BT2208");
  CHECK(with("a") == "error BT2208");
  CHECK(with("b/*") == "error BT2208");
  CHECK(with("/w/a/*") == "error BT2208");
}

TEST_CASE("what is denied is denied in the end, whatever the levels say") {
  Judgement judgement = said();
  judgement.levels = {rule("BT2208", Level::Allow),
                      rule("BT2205", Level::Warning)};
  judgement.denied = {"BT2208"};
  CHECK(left_of(kThree, judgement) ==
        "warning BT2205, error BT2208, error BT1004");
  judgement.denied = {"warnings"};
  CHECK(left_of(kThree, judgement) == "error BT2205, error BT1004");
}

TEST_CASE("all warnings may have a level, and some of them another") {
  Judgement judgement = said();
  judgement.levels = {rule("warnings", Level::Allow),
                      rule("BT2205", Level::Warning)};
  CHECK(left_of(kThree, judgement) == "warning BT2205, error BT1004");
}

TEST_CASE("a comment allows what is said of its line") {
  Judged judged;
  CHECK(left_of({found("BT2208", Severity::Warning, 2)}, said(), &judged,
                "<!-- btcheck: allow BT2208: meant -->\n<A/>") == "");
  CHECK(judged.allowed == 1);
}

TEST_CASE("what the baseline has is known, as often as it has it") {
  const std::vector<Diagnostic> three = {
      found("BT2208", Severity::Warning, 1),
      found("BT2208", Severity::Warning, 5),
      found("BT2208", Severity::Warning, 9, "b/t.xml")};
  Judgement judgement = said();
  judgement.baseline = {{"BT2208", "/w/a/t.xml", "", "<A/>", 1}};
  Judged judged;
  CHECK(left_of(three, judgement, &judged) == "warning BT2208, warning BT2208");
  REQUIRE(judged.known.size() == 1);
  CHECK(judged.known[0].file == "a/t.xml");
  CHECK(judged.told.size() == 2);
  judgement.baseline[0].count = 2;
  CHECK(left_of(three, judgement) == "warning BT2208");
  judgement.baseline[0].text = "<B/>";
  CHECK(left_of(three, judgement) ==
        "warning BT2208, warning BT2208, warning BT2208");
}

TEST_CASE("what is known is not counted, denied or not") {
  Judgement judgement = said();
  judgement.denied = {"warnings"};
  judgement.baseline = {{"BT2208", "/w/a/t.xml", "", "<A/>", 1}};
  Judged judged;
  CHECK(left_of({found("BT2208", Severity::Warning)}, judgement, &judged) ==
        "");
  CHECK(!judged.is_denied);
}

TEST_CASE("of a line that is a whole file the beginning is known") {
  Diagnostic long_line = found("BT2208", Severity::Warning);
  long_line.source_line = std::string(159, 'x') + "\u00fc" + "more";
  Judged judged;
  left_of({long_line}, said(), &judged);
  REQUIRE(judged.told.size() == 1);
  CHECK(judged.told[0].text == std::string(159, 'x'));
}

}  // namespace
}  // namespace btcheck::judgement_test
