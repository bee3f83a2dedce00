// SPDX-License-Identifier: MIT
//
// Positions, quoting, and the exact shape of a shown diagnostic.
#include "text/diagnostic.hpp"
#include "text/colors.hpp"

#include <doctest/doctest.h>

#include <string>

using namespace std::string_literals;

namespace btcheck::diagnostic_test {
namespace {

TEST_CASE("columns count code points from 1") {
  const SourceText source("a.btf", "one\nzwölf Bäume\r\nend");
  const SourceSpan span = source.span(11, 17);
  CHECK(span.line == 2);
  CHECK(span.column == 7);
  CHECK(span.length == 5);
  CHECK(source.line(2) == "zwölf Bäume");
}

TEST_CASE("a span that runs past its line is cut there") {
  const SourceText source("a.btf", "one\r\ntwo\n");
  CHECK(source.span(1, 9).length == 2);
  CHECK(source.span(1, 1).length == 1);
}

TEST_CASE("a position beyond the text is its end") {
  const SourceText source("a.btf", "one");
  const SourceSpan span = source.span(99, 120);
  CHECK(span.line == 1);
  CHECK(span.column == 4);
  CHECK(span.length == 1);
  CHECK(SourceText("a.btf", "").span(0, 0).line == 1);
}

TEST_CASE("a line that does not exist is empty") {
  const SourceText source("a.btf", "one\ntwo");
  CHECK(source.line(0).empty());
  CHECK(source.line(-1).empty());
  CHECK(source.line(3).empty());
  CHECK(source.line(2) == "two");
}

TEST_CASE("what a terminal would obey is shown as question marks") {
  const SourceText source("a", "a\x1b[31mb\tc\x80 d\xE2\x80\xAE e\xC2\x9B");
  CHECK(source.line(1) == "a?[31mb c? d? e?");
}

TEST_CASE("broken UTF-8 still has one column per shown character") {
  const SourceText source("a", "\xFF\xC3\xED\xA0\x80x");
  CHECK(source.line(1) == "?????x");
  CHECK(source.span(5, 6).column == 6);
}

TEST_CASE("a file with a NUL byte or broken UTF-8 is refused") {
  CHECK(!SourceText("a", "text äöü 🚁\n").refuse_binary());
  CHECK(!SourceText("a", "").refuse_binary());
  const auto nul = SourceText("a", "ab\0c"s).refuse_binary();
  REQUIRE(nul);
  CHECK(nul->code == "BT1000");
  CHECK(nul->span.column == 3);
  const auto broken = SourceText("a", "ok\n\xC3(").refuse_binary();
  REQUIRE(broken);
  CHECK(broken->span.line == 2);
  CHECK(SourceText("a", "\xC0\x80").refuse_binary());      // overlong
  CHECK(SourceText("a", "\xED\xA0\x80").refuse_binary());  // a surrogate
  CHECK(SourceText("a", "\xF4\x90\x80\x80").refuse_binary());
  CHECK(SourceText("a", "\xE2\x82").refuse_binary());  // cut short
}

TEST_CASE("a diagnostic is shown with its line, carets and help") {
  const SourceText source("drone3.ltl",
                          "    whenever critical then land_.done");
  const Diagnostic diagnostic = source.diagnostic(
      Severity::Error, "BT1104", source.span(27, 32), "unknown node `land_`",
      "no node or variable has this name", "did you mean `land`?");
  CHECK(render(diagnostic) ==
        R"(error[BT1104]: unknown node `land_`
  --> drone3.ltl:1:28
  |
1 |     whenever critical then land_.done
  |                            ^^^^^ no node or variable has this name
  |
  = help: did you mean `land`?
)");
}

TEST_CASE("the margin is as wide as the line number") {
  Diagnostic diagnostic{Severity::Warning, "BT1007", "a message", "a.btf",
                        {120, 2, 3},       "xabcx",  "",          ""};
  CHECK(render(diagnostic) == R"(warning[BT1007]: a message
    --> a.btf:120:2
    |
120 | xabcx
    |  ^^^
)");
}

TEST_CASE("a diagnostic of a whole file quotes nothing") {
  const Diagnostic diagnostic{Severity::Note, "", "a message", "a.btf",
                              SourceSpan{},   "", "",          "do this\nthat"};
  CHECK(render(diagnostic) == R"(note: a message
  --> a.btf
  = help: do this
          that
)");
}

TEST_CASE("an empty line has carets too") {
  const Diagnostic diagnostic{Severity::Error, "BT1", "m", "a",
                              {1, 1, 1},       "",    "l", ""};
  CHECK(render(diagnostic) ==
        "error[BT1]: m\n  --> a:1:1\n  |\n1 |\n"
        "  | ^ l\n");
}

TEST_CASE("a long line is shown through a window") {
  const std::string line =
      std::string(200, 'a') + "BAD" + std::string(200, 'z');
  const SourceText source("a", line);
  const std::string shown = render(source.diagnostic(
      Severity::Error, "BT1", source.span(200, 203), "m", "here"));
  CHECK(shown == "error[BT1]: m\n  --> a:1:201\n  |\n1 | ..." +
                     std::string(30, 'a') + "BAD" + std::string(67, 'z') +
                     "...\n  | " + std::string(33, ' ') + "^^^ here\n");
}

TEST_CASE("carets never leave the line") {
  Diagnostic diagnostic{Severity::Error, "",     "m", "",
                        {1, 3, 999},     "abcd", "",  ""};
  CHECK(render(diagnostic).ends_with("1 | abcd\n  |   ^^\n"));
  diagnostic.span = {1, 999, 999};
  CHECK(render(diagnostic).ends_with("1 | abcd\n  |     ^\n"));
  diagnostic.source_line = std::string(5000, 'x');
  diagnostic.span = {1, 9999, 5};
  CHECK(render(diagnostic).ends_with("^\n"));
  diagnostic.span = {1, -5, -5};
  CHECK(render(diagnostic).ends_with("  | ^\n"));
}

TEST_CASE("names and messages cannot carry escapes into the output") {
  const Diagnostic diagnostic{Severity::Error, "B\x1b",   "m\x1b[2J\n",
                              "f\x1b.btf",     {1, 1, 1}, "x\x1b",
                              "l\x1b",         "h\x1b"};
  CHECK(render(diagnostic).find('\x1b') == std::string::npos);
}

TEST_CASE("colour adds sequences and changes no character") {
  const SourceText source("a.btf", "one two");
  const Diagnostic diagnostic = source.diagnostic(
      Severity::Warning, "BT1", source.span(4, 7), "message", "label", "help");
  CHECK(colored(render(diagnostic)) ==
        "\x1b[1;33mwarning[BT1]\x1b[0m: \x1b[1mmessage\x1b[0m\n"
        "\x1b[1;34m  -->\x1b[0m a.btf:1:5\n"
        "\x1b[1;34m  |\x1b[0m\n"
        "\x1b[1;34m1 |\x1b[0m one two\n"
        "\x1b[1;34m  |\x1b[0m\x1b[1;33m     ^^^ label\x1b[0m\n"
        "\x1b[1;34m  |\x1b[0m\n"
        "\x1b[1;34m  =\x1b[0m help: help\n");
  const std::string report =
      "HOLDS      a\nVIOLATED   b\nUNDECIDED  c\nnotes of mine\n\n"
      "    -- here it is so: x\n  = repair, checked: this\n"
      "    12 - old\n    - old\n    + new\n\n    - no repair";
  const std::string painted = colored(report);
  CHECK(painted.starts_with("\x1b[1;32mHOLDS\x1b[0m      a\n"));
  CHECK(painted.ends_with("\x1b[1;32m    + new\x1b[0m\n\n    - no repair"));
  std::string plain;
  for (std::size_t i = 0; i < painted.size(); ++i) {
    if (painted[i] == '\x1b') {
      i = painted.find('m', i);
    } else {
      plain += painted[i];
    }
  }
  CHECK(plain == report);
}

TEST_CASE("the closest match is near enough to be meant") {
  const std::vector<std::string> names = {"Sequence", "Fallback", "Low"};
  CHECK(closest_match("Sequnce", names) == "Sequence");
  CHECK(closest_match("SEQUENCE", names) == "Sequence");
  CHECK(closest_match("Sqeuence", names) == "Sequence");
  CHECK(closest_match("Lw", names) == "Low");
  CHECK(!closest_match("Inverter", names));
  CHECK(!closest_match("", names));
  CHECK(!closest_match(std::string(1000, 'a'), names));
  CHECK(!closest_match("Low", {}));
}

TEST_CASE("the nearest of several candidates wins, then the first") {
  const std::vector<std::string> names = {"batteries", "battery", "battory"};
  CHECK(closest_match("baterry", names) == "battery");
  CHECK(closest_match("battxry", names) == "battery");
}

TEST_CASE("advice names the closest match, or says something else") {
  const std::vector<std::string> names = {"Sequence", "Fallback"};
  CHECK(did_you_mean("Sequnce", names) == "did you mean `Sequence`?");
  CHECK(did_you_mean("Inverter", names).empty());
  CHECK(did_you_mean("Inverter", names, "write `x`") == "write `x`");
}

TEST_CASE("only errors make a list of findings an error") {
  std::vector<Diagnostic> found(2);
  found[0].severity = Severity::Warning;
  found[1].severity = Severity::Note;
  CHECK(!has_error(found));
  found[1].severity = Severity::Error;
  CHECK(has_error(found));
}

TEST_CASE("words are equal without regard to ASCII case only") {
  CHECK(equal_ignoring_case("Critical", "cRITICAL"));
  CHECK(!equal_ignoring_case("Critical", "Critica"));
  CHECK(!equal_ignoring_case("ä", "Ä"));
  CHECK(!equal_ignoring_case("@", "`"));
}

}  // namespace
}  // namespace btcheck::diagnostic_test
