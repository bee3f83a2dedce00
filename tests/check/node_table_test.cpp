// SPDX-License-Identifier: MIT
//
// What the table of node types says of each, told by verdicts on trees of every
// profile.
#include <doctest/doctest.h>

#include <string>

#include "check/node_rows.hpp"

namespace btcheck::node_table_test {
namespace {

TEST_CASE("what is ticked beside a running child is what the table says") {
  for (const NodeTypeInfo& info : kNodeTypes) {
    if (info.max_children < 2) continue;
    CAPTURE(info.name);
    REQUIRE(kInXml.contains(info.type));
    if (kInXml.at(info.type).empty()) continue;
    const std::string told =
        verdicts(over_condition_and_action(info.type),
                 "prove never C.ticked and A.status == running\n"
                 "prove never A.running\n");
    // A is ticked, and so it may run.
    CHECK(told[1] == 'V');
    // C has ended when A runs, and is not ticked again by who counts that.
    const bool passes_over =
        info.beside == Beside::None || info.beside == Beside::Counted;
    CHECK((told[0] == 'H') == passes_over);
  }
}

// Of a RoundRobin nobody knows which child came before which.
TEST_CASE("guards go stale under every type that resumes, and no other") {
  for (const NodeTypeInfo& info : kNodeTypes) {
    if (info.max_children < 2 || kInXml.at(info.type).empty()) continue;
    CAPTURE(info.name);
    const CheckResult result =
        checked(over_condition_and_action(info.type), {});
    const auto& stale = result.files[0].defaults->stale_guards;
    CHECK(stale.empty() ==
          (info.beside != Beside::None || info.type == NodeType::RoundRobin));
  }
}

// Their drawings halt the child that runs and ask nothing of the others.
TEST_CASE("under a type that resumes no two children run at a time") {
  const std::string rule =
      "prove never A.status == running and B.status == running\n"
      "prove never B.running\n";
  for (const NodeTypeInfo& info : kNodeTypes) {
    if (info.max_children < 2 || info.beside != Beside::None) continue;
    CAPTURE(info.name);
    const std::string& written = kInXml.at(info.type);
    const std::string id = written.substr(0, written.find(' '));
    Asked asked = over_condition_and_action(info.type);
    asked.tree = "<ReactiveSequence><C/><" + written + "><A/><B/></" + id +
                 "></ReactiveSequence>";
    asked.leaves = "(defaction * :returns (success failure running))";
    CHECK(verdicts(asked, rule) == "HV");
  }
}

}  // namespace
}  // namespace btcheck::node_table_test
