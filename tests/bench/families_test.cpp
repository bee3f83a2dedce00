// SPDX-License-Identifier: MIT
//
// The trees of bench/families, of which docs/performance.md speaks: each family
// can be read, has as many states as was written down when it was made, and its
// rules come out as they expect. The drone and Nav2 are those of examples/, so
// the figures of the families continue those of the examples.
#include <doctest/doctest.h>

#include <filesystem>
#include <regex>
#include <string>

#include "shell.hpp"
#include "temporary_folder.hpp"

namespace fs = std::filesystem;

namespace {

using btcheck::Outcome;
using btcheck::quoted;

// Complaints on stderr are expected: some cases provoke them.
Outcome run(const std::string& command) {
  return btcheck::run(command + " 2>/dev/null");
}

// A family that has become too large is a failure, not a test without end.
const std::string kLimits = " -q --timeout 60 ";
const std::string kProgram = "'" BTCHECK_PROGRAM "' ";

// The tree and the rules of a family, for as long as this object lives.
class Member {
 public:
  explicit Member(const std::string& words) {
    const std::string families = "'" BTCHECK_BENCH "/families' " + words;
    const Outcome outcome = run(families + " >" + quoted(tree()) + " && " +
                                families + " --properties >" + quoted(rules()));
    REQUIRE(outcome.code == 0);
  }

  fs::path tree() const { return folder_.path() / "tree.btf"; }
  fs::path rules() const { return folder_.path() / "rules.ltl"; }

 private:
  btcheck::TemporaryFolder folder_;
};

// One line of what `btcheck space` prints, without its blanks: 328,443.
std::string figure(const std::string& text, const std::string& name) {
  std::smatch found;
  const std::regex line("\n +" + name + " +([0-9,]+)");
  return std::regex_search(text, found, line) ? found[1].str() : "";
}

std::string explored(const fs::path& tree, const std::string& options = "") {
  return run(kProgram + "space --reduce none " + quoted(tree) + kLimits +
             options)
      .text;
}

}  // namespace

TEST_CASE("the smallest members have the states they had when recorded") {
  struct Recorded {
    const char* words;
    const char* states;
    const char* transitions;
  };
  for (const Recorded& recorded : {Recorded{"drone0 1 1", "144,888", "173,619"},
                                   Recorded{"drones 1", "328,443", "400,488"},
                                   Recorded{"parallel 2", "3,584", "7,039"},
                                   Recorded{"binary 71", "31,419", "45,173"},
                                   Recorded{"rate 4", "410", "420"}}) {
    CAPTURE(recorded.words);
    const Member member(recorded.words);
    const std::string text = explored(member.tree());
    CHECK(figure(text, "states") == recorded.states);
    CHECK(figure(text, "transitions") == recorded.transitions);
  }
}

TEST_CASE("the rules of the families come out as they expect") {
  for (const char* words :
       {"drone0 1 1", "drones 1", "parallel 2", "binary 71", "rate 4"}) {
    CAPTURE(words);
    const Member member(words);
    const Outcome outcome = run(kProgram + quoted(member.tree()) + kLimits +
                                "--prop " + quoted(member.rules()));
    CAPTURE(outcome.text);
    CHECK(outcome.code == 0);
  }
}

TEST_CASE("large members can be read, and a limit stops them") {
  for (const char* words : {"drone 6 3", "drones 3", "nav2 5", "binary 2055"}) {
    CAPTURE(words);
    const Member member(words);
    const Outcome outcome =
        run(kProgram + quoted(member.tree()) + kLimits +
            "--max-states 2000 --prop " + quoted(member.rules()));
    CAPTURE(outcome.text);
    CHECK((outcome.code == 0 || outcome.code == 3));
  }
}

TEST_CASE("one drone of the family is drone3 of the examples") {
  const Member member("drones 1");
  const std::string ours = explored(member.tree());
  const std::string theirs = explored(BTCHECK_EXAMPLES "/drone3.btf");
  for (const char* name : {"states", "markings", "transitions", "depth"}) {
    CHECK(figure(ours, name) == figure(theirs, name));
    CHECK(!figure(ours, name).empty());
  }
}

TEST_CASE("four remedies make Nav2, but for the names of its nodes") {
  // Too many states to count them: the automata themselves are compared.
  const auto nameless = [](const fs::path& tree) {
    const std::string text =
        run(kProgram + "export --to promela " + quoted(tree)).text;
    const std::regex names_and_blanks("[A-Za-z]\\w*?_(btn[0-9]+)|[\\\\\\s]+");
    return std::regex_replace(text.substr(text.find("*/")), names_and_blanks,
                              "$1");
  };
  const Member member("nav2 4");
  const std::string ours = nameless(member.tree());
  CHECK(ours.size() > 10000);
  CHECK((ours == nameless(BTCHECK_EXAMPLES "/nav2.btf")));
}

TEST_CASE("a family says what is wrong with its numbers") {
  for (const char* words : {"drone 6", "binary 12", "nav2 0", "hexapod 1"}) {
    CAPTURE(words);
    const Outcome outcome =
        run("'" BTCHECK_BENCH "/families' " + std::string(words));
    CHECK(outcome.code != 0);
    CHECK(outcome.text.empty());
  }
}
