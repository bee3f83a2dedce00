// SPDX-License-Identifier: MIT
//
// Results beside earlier ones.
#include "report/whatif/earlier.hpp"

#include <doctest/doctest.h>

#include <string>

#include "mission.hpp"
#include "report/whatif/files.hpp"
#include "report/whatif/words.hpp"

namespace btcheck::whatif_earlier_test {
namespace {

std::string mistake_in(const std::string& text) {
  const auto read = read_earlier("old.json", text);
  CHECK(!read.value.has_value());
  REQUIRE(read.diagnostics.size() == 1);
  return render(read.diagnostics[0]);
}

EarlierResult earlier(const SearchedMission& mission) {
  auto read = read_earlier("old.json", what_if_json(mission.report()));
  REQUIRE(read.value.has_value());
  return std::move(*read.value);
}

std::string replaced(std::string text, const std::string& what,
                     const std::string& with) {
  std::size_t count = 0;
  for (auto at = text.find(what); at != text.npos;
       at = text.find(what, at + with.size())) {
    text.replace(at, what.size(), with);
    ++count;
  }
  REQUIRE(count > 0);
  return text;
}

const std::string kTree(kPictures);

}  // namespace

TEST_CASE("nothing is otherwise beside the same") {
  SearchedMission mission(kTree, with_pairs());
  const WhatIfChange change = change_since(earlier(mission), mission.report());
  CHECK(change.text == "beside old.json: 0 worse, 0 better\n");
  CHECK(exit_code_of(mission.result(), change) == ExitCode::Met);
  CHECK(exit_code_of(mission.result()) == ExitCode::Missed);
}

TEST_CASE("a retry that is taken away is worse, and the other way round") {
  const std::string less =
      replaced(kTree, "num_attempts=\"3\"", "num_attempts=\"1\"");
  SearchedMission before(kTree);
  SearchedMission after(less);
  const WhatIfChange change = change_since(earlier(before), after.report());
  CHECK(change.worse == 1);
  CHECK(change.better == 0);
  CHECK(change.text.find("`Upload` fails once: the mission always fails (was "
                         "survives)") != std::string::npos);
  CHECK(exit_code_of(after.result(), change) == ExitCode::Missed);
  const WhatIfChange back = change_since(earlier(after), before.report());
  CHECK(back.worse == 0);
  CHECK(back.better == 1);
  CHECK(exit_code_of(before.result(), back) == ExitCode::Met);
}

TEST_CASE("a leaf is found again where it was moved to") {
  const std::string moved =
      replaced(kTree, "<Action ID=\"Undock\"/>\n      <Force",
               "<Sequence><Action ID=\"Undock\"/></Sequence>\n      <Force");
  SearchedMission before(kTree);
  SearchedMission after(moved);
  const WhatIfChange change = change_since(earlier(before), after.report());
  CHECK(change.text == "beside old.json: 0 worse, 0 better\n");
}

TEST_CASE("a new fault counts where it is bad, one that is gone is better") {
  const std::string more = replaced(
      kTree, "<Timeout ",
      "<ForceSuccess><Action ID=\"DockBack\" name=\"Wave\"/></ForceSuccess>"
      "<Timeout ");
  SearchedMission before(kTree);
  SearchedMission after(more);
  const WhatIfChange change = change_since(earlier(before), after.report());
  // Silent three times, and without an end.
  CHECK(change.worse == 4);
  CHECK(change.text.find("`Wave`") != std::string::npos);
  CHECK(change.text.find("(new)") != std::string::npos);
  const WhatIfChange back = change_since(earlier(after), before.report());
  CHECK(back.worse == 0);
  CHECK(back.better == 4);
  CHECK(back.text.find("Wave fails: gone (was silent)") != std::string::npos);
}

TEST_CASE("another rule that is broken, another leaf left on, is worse") {
  SearchedMission mission(kTree);
  EarlierResult before = earlier(mission);
  FaultRow& row = mission.result().rows[0];
  row.harm = Harm::LeftOn;
  row.effect.left_running = {row.faults[0].leaf};
  const std::string path = "Main/Sequence/ForceSuccess/TakePicture fails";
  REQUIRE(before.faults.contains(path));
  before.faults[path].harm = Harm::LeftOn;
  before.faults[path].more = {"TakePicture"};
  CHECK(change_since(before, mission.report()).worse == 0);
  before.faults[path].more = {"Upload"};
  CHECK(change_since(before, mission.report()).worse == 1);
}

TEST_CASE("what is not decided is neither, and told") {
  SearchedMission mission(kTree);
  const EarlierResult before = earlier(mission);
  mission.result().rows[5].harm = Harm::Undecided;
  const WhatIfChange change = change_since(before, mission.report());
  CHECK(change.worse == 0);
  CHECK(change.text.find(", 1 not decided\n") != std::string::npos);
  CHECK(exit_code_of(mission.result(), change) == ExitCode::Undecided);
}

TEST_CASE("pairs are compared where both results have looked at them") {
  SearchedMission alone(kTree);
  SearchedMission pairs(kTree, with_pairs());
  REQUIRE(!pairs.result().pairs.empty());
  CHECK(change_since(earlier(alone), pairs.report()).worse == 0);
  CHECK(change_since(earlier(pairs), alone.report()).better == 0);
  EarlierResult fewer = earlier(pairs);
  std::size_t bad = 0;
  for (const FaultRow& pair : pairs.result().pairs) bad += is_bad(pair.harm);
  std::erase_if(fewer.faults, [](const auto& each) {
    return each.first.find(" + ") != std::string::npos;
  });
  CHECK(change_since(fewer, pairs.report()).worse == bad);
}

TEST_CASE("any other file is refused, with where and why") {
  CHECK(mistake_in("{").starts_with("error[BT1515]: this is no JSON\n"));
  CHECK(mistake_in("").starts_with("error[BT1515]: this is no JSON\n"));
  CHECK(mistake_in("[]").find("its `schema` is not btcheck-whatif/1") !=
        std::string::npos);
  CHECK(mistake_in(R"({"schema": 7})").starts_with("error[BT1515]: no result"));
  CHECK(mistake_in(R"({"schema": "btcheck-whatif/1"})")
            .starts_with("error[BT1515]: no result of btcheck whatif: "));
  SearchedMission mission(kTree);
  const std::string good = what_if_json(mission.report());
  CHECK(mistake_in(replaced(good, "\"harm\": \"silent\"", "\"harm\": \"loud\""))
            .find("`loud` is no harm") != std::string::npos);
  // Cut anywhere it is no such file, and nothing else happens.
  for (std::size_t end = 0; end + 2 < good.size(); end += 997) {
    CHECK(!read_earlier("old.json", good.substr(0, end)).value);
  }
  CHECK(mistake_in(replaced(good, "\"late\": 10", "\"late\": \"x\""))
            .starts_with("error[BT1515]: no result"));
}

}  // namespace btcheck::whatif_earlier_test
