// SPDX-License-Identifier: MIT
//
// What people read of faults.
#include "report/whatif/table.hpp"

#include <doctest/doctest.h>

#include <regex>
#include <set>
#include <sstream>
#include <string>

#include "mission.hpp"
#include "text/utf8.hpp"

namespace btcheck::whatif_table_test {
namespace {

std::string table(SearchedMission& mission, bool tells_all) {
  return what_if_text(mission.tree(), mission.result(), {tells_all});
}

bool has(const std::string& text, std::string_view part) {
  return text.find(part) != std::string::npos;
}

// The numbers of rows that stand at the left: "1-3, 7".
std::set<int> numbers_in(const std::string& text) {
  std::set<int> numbers;
  std::istringstream lines(text);
  const std::regex left(R"(^ +(\d+(-\d+)?(, \d+(-\d+)?)*)(  .*)?$)");
  const std::regex range(R"((\d+)(-(\d+))?)");
  for (std::string line; std::getline(lines, line);) {
    std::smatch found;
    if (!std::regex_match(line, found, left)) continue;
    const std::string all = found[1];
    for (std::sregex_iterator at(all.begin(), all.end(), range), end; at != end;
         ++at) {
      const int first = std::stoi((*at)[1]);
      const int last = (*at)[3].matched ? std::stoi((*at)[3]) : first;
      for (int n = first; n <= last; ++n) CHECK(numbers.insert(n).second);
    }
  }
  return numbers;
}

}  // namespace

TEST_CASE("what is lost is said, and what is never asked is one line") {
  SearchedMission mission(kPictures);
  const std::string text = table(mission, false);
  CHECK(has(text, "silent (3): the mission succeeds without it, and nobody"));
  CHECK(has(text,
            "1-3  `TakePicture` fails whenever it is asked, once, or "
            "from some tick on\n"));
  CHECK(has(text, "what `TakePicture` is for was not done"));
  CHECK(has(text, "never asked while all else works"));
  CHECK(has(text, "`DockBack`"));
  CHECK(!has(text, "the mission is never asked"));
  CHECK(has(text, "Without a fault the mission succeeds on every run."));
  CHECK(has(text, "actions succeed, before a"));
  CHECK(has(text, "The mission: of "));
}

TEST_CASE("each row stands in the table once, by its number") {
  for (const bool tells_all : {false, true}) {
    SearchedMission mission(kPictures);
    const std::set<int> numbers = numbers_in(table(mission, tells_all));
    CHECK(numbers.size() == mission.result().rows.size());
    CHECK(*numbers.begin() == 1);
    CHECK(*numbers.rbegin() == static_cast<int>(mission.result().rows.size()));
  }
}

TEST_CASE("lines are no wider than asked for, unless a name is") {
  SearchedMission mission(kPictures, with_pairs());
  for (const bool tells_all : {false, true}) {
    std::istringstream lines(table(mission, tells_all));
    std::size_t count = 0;
    for (std::string line; std::getline(lines, line); ++count) {
      CAPTURE(line);
      CHECK(count_code_points(line) <= static_cast<int>(kLineWidth));
    }
    if (!tells_all) CHECK(count <= 90);
  }
}

TEST_CASE("kinds of faults are told in a sentence") {
  using enum FaultKind;
  const std::vector<FaultKind> one = {NeverEnds};
  const std::vector<FaultKind> two = {Fails, FailsOnce};
  const std::vector<FaultKind> three = {Fails, FailsOnce, FailsOn};
  const std::vector<FaultKind> other = {NeverEnds, Throws};
  CHECK(kinds_text(one) == "never ends");
  CHECK(kinds_text(two) == "fails whenever it is asked or once");
  CHECK(kinds_text(three) ==
        "fails whenever it is asked, once, or from some tick on");
  CHECK(kinds_text(other) == "never ends or throws an exception");
  CHECK(kind_words(three) == "fails, fails-once, fails-for-ever");
}

TEST_CASE("the exit code says whether a single fault is bad") {
  SearchedMission mission(kPictures);
  CHECK(exit_code_of(mission.result()) == ExitCode::Missed);
  for (FaultRow& row : mission.result().rows) row.harm = Harm::Throws;
  CHECK(exit_code_of(mission.result()) == ExitCode::Met);
  mission.result().rows[0].harm = Harm::Undecided;
  CHECK(exit_code_of(mission.result()) == ExitCode::Undecided);
  mission.result().stopped = StopReason::MaxStates;
  CHECK(has(table(mission, false), "\nUNDECIDED "));
  mission.result().rows[1].harm = Harm::LeftOn;
  CHECK(exit_code_of(mission.result()) == ExitCode::Missed);
  mission.result().error = "a run was not executed again";
  CHECK(exit_code_of(mission.result()) == ExitCode::Internal);
}

TEST_CASE("parts of the mission have scores that add up") {
  SearchedMission mission(kPictures);
  std::size_t total = 0;
  const auto parts = scored_parts(mission.tree());
  CHECK(parts.size() == 5);
  for (const NodeId part : parts) {
    total += mission.result().score_below(mission.tree(), part).total();
  }
  CHECK(total == mission.result().rows.size());
}

}  // namespace btcheck::whatif_table_test
