// SPDX-License-Identifier: MIT
//
// btcheck.toml: what it says, what is wrong with it, and what wins over it.
#include "cli/settings/choices.hpp"

#include <doctest/doctest.h>

#include <string>
#include <vector>

namespace btcheck::settings_test {
namespace {

Settings settings_of(const std::string& text) {
  const auto read = read_settings("/home/me", "robot/btcheck.toml", text);
  for (const Diagnostic& found : read.diagnostics) FAIL(render(found));
  REQUIRE(read.value.has_value());
  return *read.value;
}

std::string mistake_in(const std::string& text) {
  const auto read = read_settings("/home/me", "btcheck.toml", text);
  CHECK(!read.value.has_value());
  REQUIRE(read.diagnostics.size() == 1);
  return render(read.diagnostics[0]);
}

// "BT2205=1 in /home/me/robot of vendor/*": each rule on a line.
std::string told(const std::vector<LevelRule>& rules) {
  std::string text;
  for (const LevelRule& rule : rules) {
    text += rule.code + "=" + std::to_string(static_cast<int>(rule.level)) +
            " in " + rule.folder + " of " + rule.pattern + "\n";
  }
  return text;
}

TEST_CASE("settings say how trees are read, with files beside them") {
  const Options options = settled({},
                                  settings_of("profile = \"nav2-jazzy\"\n"
                                              "tick-ms = 10\n"
                                              "loop = true\n"
                                              "wake-ups = true\n"
                                              "models = \"nodes.xml\"\n"
                                              "leaves = [\"../a.leaves\"]\n"),
                                  "t.xml");
  CHECK(options.profile == Profile::Nav2Jazzy);
  CHECK(options.tick_ms == 10);
  CHECK(options.loops);
  CHECK(options.wakes);
  CHECK(options.models == std::vector<std::string>{"robot/nodes.xml"});
  CHECK(options.leaves == std::vector<std::string>{"a.leaves"});
}

TEST_CASE("what the command line or a manifest says wins over settings") {
  Options line;
  line.tick_ms = 20;
  line.given = {"--tick-ms"};
  const Settings settings =
      settings_of("profile = \"nav2-jazzy\"\ntick-ms = 10\n");
  CHECK(settled(line, settings, "t.xml").tick_ms == 20);
  CHECK(settled(line, settings, "t.xml").profile == Profile::Nav2Jazzy);
  const Options entry = applied({}, {{"--profile", [](Options& options) {
                                        options.profile = Profile::Btcpp4;
                                      }}});
  CHECK(settled(entry, settings, "t.xml").profile == Profile::Btcpp4);
  CHECK(settled(entry, settings, "t.xml").tick_ms == 10);
}

TEST_CASE("a tree takes of the settings what its kind has") {
  const Settings settings = settings_of(
      "profile = \"nav2-jazzy\"\nleaves = \"a.leaves\"\ntick-ms = 10\n");
  const Options btf = settled({}, settings, "t.btf");
  CHECK(!btf.profile.has_value());
  CHECK(btf.leaves.empty());
  CHECK(!settled({}, settings_of("profile = \"paper\""), "t.xml")
             .profile.has_value());
}

TEST_CASE("enumerators are declared beside contracts, whichever comes first") {
  for (const char* text : {"enums = { RED = 1, GREEN = 2 }\nleaves = \"a\"\n",
                           "leaves = \"a\"\nenums = { RED = 1, GREEN = 2 }\n",
                           "leaves = \"a\"\n[enums]\nRED = 1\nGREEN = 2\n"}) {
    CAPTURE(text);
    const Options all = settled({}, settings_of(text), "t.xml");
    CHECK(all.leaves ==
          std::vector<std::string>{"robot/a", "(defenum RED 1 GREEN 2)"});
    Options line;
    line.leaves = {"b"};
    line.given = {"--leaves"};
    CHECK(settled(line, settings_of(text), "t.xml").leaves ==
          std::vector<std::string>{"b", "(defenum RED 1 GREEN 2)"});
    CHECK(settled({}, settings_of(text), "t.btf").leaves.empty());
  }
}

TEST_CASE("levels stand in the order in which they count") {
  const Settings settings = settings_of(
      "deny = [\"warnings\", \"bt2208\"]\n"
      "[[paths]]\n"
      "match = [\"vendor/*\", \"*_test.xml\"]\n"
      "levels = { BT2205 = \"allow\", warnings = \"note\" }\n"
      "[levels]\n"
      "BT1007 = \"error\"\n");
  CHECK(settings.denied == std::vector<std::string>{"warnings"});
  CHECK(told(settings.levels) ==
        "BT2208=3 in /home/me/robot of \n"
        "BT1007=3 in /home/me/robot of \n"
        "warnings=1 in /home/me/robot of vendor/*\n"
        "BT2205=0 in /home/me/robot of vendor/*\n"
        "warnings=1 in /home/me/robot of *_test.xml\n"
        "BT2205=0 in /home/me/robot of *_test.xml\n");
}

TEST_CASE("what is wrong with settings is told where it stands") {
  CHECK(mistake_in("profil = \"paper\"\n") ==
        "error[BT1503]: unknown key `profil`\n"
        "  --> btcheck.toml:1:1\n"
        "  |\n"
        "1 | profil = \"paper\"\n"
        "  | ^^^^^^\n"
        "  |\n"
        "  = help: did you mean `profile`?\n");
  CHECK(mistake_in("[levels]\nBT2205 = \"notes\"\n") ==
        "error[BT1504]: `BT2205` is one of: allow, note, warning, error\n"
        "  --> btcheck.toml:2:10\n"
        "  |\n"
        "2 | BT2205 = \"notes\"\n"
        "  |          ^^^^^^^ not one of them\n"
        "  |\n"
        "  = help: did you mean `note`?\n");
  CHECK(mistake_in("[levels]\nBT22O5 = \"note\"\n") ==
        "error[BT1510]: no code `BT22O5`\n"
        "  --> btcheck.toml:2:1\n"
        "  |\n"
        "2 | BT22O5 = \"note\"\n"
        "  | ^^^^^^\n"
        "  |\n"
        "  = help: did you mean `BT2205`?\n");
  CHECK(mistake_in("max-states = 7\n").starts_with("error[BT1503]"));
  CHECK(mistake_in("tick-ms = 0\n").starts_with("error[BT1504]"));
  CHECK(mistake_in("levels = 3\n").starts_with("error[BT1504]"));
  CHECK(mistake_in("enums = [\"RED\"]\n").starts_with("error[BT1504]"));
  CHECK(mistake_in("paths = { match = \"x\" }\n").starts_with("error[BT1504]"));
  CHECK(mistake_in("[[paths]]\nmatch = \"x\"\n").starts_with("error[BT1505]"));
  CHECK(mistake_in("[[paths]]\nmatch = \"x\"\nlevel = 1\nlevels = {}\n")
            .starts_with("error[BT1503]: unknown key `level`"));
  CHECK(mistake_in("deny = \"all\"\n").starts_with("error[BT1510]"));
  CHECK(mistake_in("[levels\n").starts_with("error[BT1502]"));
}

TEST_CASE("an error of reading and the verdict of a rule have no level") {
  const std::string error = mistake_in("[levels]\nBT1004 = \"note\"\n");
  CHECK(
      error.starts_with("error[BT1510]: BT1004 is an error and has no level"));
  CHECK(error.find("nothing can be checked") != std::string::npos);
  const std::string verdict = mistake_in("deny = [\"BT2001\"]\n");
  CHECK(verdict.find("write `expect violated`") != std::string::npos);
  CHECK(settings_of("[levels]\nBT2104 = \"note\"\n").levels.size() == 1);
}

TEST_CASE("a key of many parts is refused, dots in texts are not") {
  const std::string dots(100, '.');
  const Settings settings = settings_of("models = \"" + dots + "\" # " + dots +
                                        "\n" + "leaves = 'a\"" + dots + "'\n");
  CHECK(settings.reading.models);
  CHECK(settings.reading.leaves);
  std::string key = "a";
  for (int i = 0; i < 100; ++i) key += ".a";
  CHECK(mistake_in("tick-ms = 1\n" + key + " = 1\n")
            .starts_with("error[BT1502]: this is not TOML\n"
                         "  --> btcheck.toml:2:66\n"));
  CHECK(mistake_in("[" + key + "]\n").starts_with("error[BT1502]"));
}

TEST_CASE("a file of mistakes is told in part") {
  std::string text = "[levels]\n";
  for (int i = 0; i < 1000; ++i) text += "x" + std::to_string(i) + " = 1\n";
  CHECK(read_settings("/", "btcheck.toml", text).diagnostics.size() == 100);
}

}  // namespace
}  // namespace btcheck::settings_test
