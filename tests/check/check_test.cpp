// SPDX-License-Identifier: MIT
//
// Texts in, verdicts out: an error in any input comes before any search.
#include "check/check.hpp"

#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "check/checked.hpp"

namespace btcheck::check_test {
namespace {

const InputFile kTree{"t.btf",
                      "(BehaviorTree :name t (Sequence (Action :ID a)))"};
const InputFile kBadTree{"bad.btf",
                         "(BehaviorTree :name t (Sequence (Acton :ID a)\n"
                         " (Action :ID b :halt 1)))"};

// Says that a search has begun.
class Alarm : public SearchMonitor {
 public:
  StopReason observe(const SearchProgress&) override {
    ++searches;
    return StopReason::None;
  }
  int searches = 0;
};

CheckResult checked(const InputFile& tree,
                    const std::vector<InputFile>& properties, Alarm& alarm) {
  CheckOptions options;
  options.limits.monitor = &alarm;
  return check(tree, properties, options);
}

// "file:code" for each error.
std::vector<std::string> errors_of(const CheckResult& result) {
  std::vector<std::string> errors;
  for (const Diagnostic& found : result.diagnostics) {
    if (found.severity != Severity::Error) continue;
    errors.push_back(found.file + ":" + found.code);
  }
  return errors;
}

using Errors = std::vector<std::string>;

TEST_CASE("a tree without properties gets the default report") {
  Alarm alarm;
  const CheckResult result = checked(kTree, {}, alarm);
  CHECK(result.diagnostics.empty());
  REQUIRE(result.tree != nullptr);
  CHECK(result.tree->file == "t.btf");
  REQUIRE(result.files.size() == 1);
  CHECK(result.files[0].defaults.has_value());
  CHECK(result.files[0].properties == nullptr);
  CHECK(result.files[0].verdicts.empty());
  CHECK(alarm.searches == 1);
}

TEST_CASE("each property file gets its verdicts") {
  Alarm alarm;
  const CheckResult result =
      checked(kTree,
              {{"p.ltl", "prove never a.halted\nprove possible a.running\n"},
               {"q.ltl", "prove ltl <> root.ended\n"}},
              alarm);
  CHECK(errors_of(result).empty());
  REQUIRE(result.files.size() == 2);
  CHECK(result.files[0].properties->file == "p.ltl");
  REQUIRE(result.files[0].verdicts.size() == 2);
  CHECK(result.files[0].verdicts[0].verdict == Verdict::Holds);
  CHECK(result.files[0].verdicts[1].verdict == Verdict::Holds);
  CHECK(result.files[1].verdicts[0].verdict == Verdict::Violated);
  CHECK(!result.files[0].defaults.has_value());
}

TEST_CASE("an error in the tree means that nothing is searched") {
  Alarm alarm;
  const CheckResult result =
      checked(kBadTree, {{"p.ltl", "prove never a.halted\n"}}, alarm);
  CHECK(result.tree == nullptr);
  CHECK(result.files.empty());
  CHECK(alarm.searches == 0);
  CHECK(errors_of(result) == Errors{"bad.btf:BT1004", "bad.btf:BT1005"});
}

TEST_CASE("an error in any property file means that nothing is searched") {
  const InputFile good{"good.ltl", "prove never a.halted\n"};
  const std::vector<InputFile> bad = {
      {"bad.ltl", "prove never\n"},
      {"bad.ltl", "prove never x.ticked\n"},
      {"bad.ltl", "prove [] <> a.ticked and\n"},
      {"bad.ltl", "prove possible a.height > 3\n"}};
  for (const InputFile& file : bad) {
    CAPTURE(file.text);
    for (const auto& files : {std::vector{good, file}, {file, good}}) {
      Alarm alarm;
      const CheckResult result = checked(kTree, files, alarm);
      CHECK(result.files.empty());
      CHECK(alarm.searches == 0);
      REQUIRE(!errors_of(result).empty());
      CHECK(errors_of(result)[0].starts_with("bad.ltl:"));
    }
  }
}

TEST_CASE("every error of every input is there") {
  Alarm alarm;
  const InputFile names{"n.ltl",
                        "prove never x.ticked\nprove never y.ticked\n"};
  const InputFile syntax{"s.ltl", "prove never (\n"};
  const CheckResult one = checked(kTree, {names, syntax}, alarm);
  const Errors found = errors_of(one);
  REQUIRE(found.size() == 3);
  CHECK(found[0] == "n.ltl:BT1101");
  CHECK(found[1] == "n.ltl:BT1101");
  CHECK(found[2].starts_with("s.ltl:"));

  const Errors both = errors_of(checked(kBadTree, {names, syntax}, alarm));
  REQUIRE(both.size() == 3);
  CHECK(both[0].starts_with("bad.btf:"));
  CHECK(both[2].starts_with("s.ltl:"));
}

TEST_CASE("a warning does not keep a search from beginning") {
  Alarm alarm;
  const CheckResult result = checked(kTree,
                                     {{"p.ltl",
                                       "prove never A.halted\nprove never "
                                       "(a.running and a.status == halt_me)\n"
                                       "prove [] a.ticked => <> root.ended\n"}},
                                     alarm);
  CHECK(!result.diagnostics.empty());
  CHECK(errors_of(result).empty());
  CHECK(result.files.size() == 1);
  CHECK(alarm.searches > 0);
}

TEST_CASE("the command line overrides the ticks of a property file") {
  const InputFile nodes{"p.ltl", "tick nodes\nprove never a.halted\n"};
  CheckOptions options;
  CHECK(check(kTree, {nodes}, options).files[0].network->ticks ==
        TickSemantics::Nodes);
  CHECK(check(kTree, {}, options).files[0].network->ticks ==
        TickSemantics::Root);
  options.ticks = TickSemantics::Leaves;
  CHECK(check(kTree, {nodes}, options).files[0].network->ticks ==
        TickSemantics::Leaves);
  CHECK(check(kTree, {}, options).files[0].network->ticks ==
        TickSemantics::Leaves);
}

TEST_CASE("each property file has the ticks that it asks for") {
  const CheckResult result =
      check(kTree,
            {{"p.ltl", "tick nodes\nprove never a.halted\n"},
             {"q.ltl", "prove never a.halted\n"}},
            {});
  REQUIRE(result.files.size() == 2);
  CHECK(result.files[0].network->ticks == TickSemantics::Nodes);
  CHECK(result.files[1].network->ticks == TickSemantics::Root);
}

TEST_CASE("the tree that a property file names") {
  CHECK(tree_of_properties({"p.ltl", "tree \"x.btf\"\nprove dead\n"}).value ==
        "x.btf");
  CHECK(tree_of_properties({"p.ltl", "prove dead\n"}).value == "");
  const auto bad = tree_of_properties({"p.ltl", "prove never (\n"});
  CHECK(!bad.value.has_value());
  CHECK(has_error(bad.diagnostics));
}

TEST_CASE("a limit leaves every property undecided") {
  CheckOptions options;
  options.limits.max_states = 1;
  const CheckResult result =
      check(kTree, {{"p.ltl", "prove never a.halted\nprove possible dead\n"}},
            options);
  REQUIRE(result.files.size() == 1);
  for (const PropertyVerdict& verdict : result.files[0].verdicts) {
    CHECK(verdict.verdict == Verdict::Undecided);
  }
}

}  // namespace
}  // namespace btcheck::check_test
