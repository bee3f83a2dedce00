// SPDX-License-Identifier: MIT
//
// Explanations do not depend on which family has drawn a node.
#include <doctest/doctest.h>

#include <string>

#include "check/node_rows.hpp"
#include "trace/why/why.hpp"

namespace btcheck::why_table_test {
namespace {

// Why the rule is violated; "holds" when it is not.
std::string reason(const Asked& asked, const std::string& rule) {
  const CheckResult result = checked(asked, {{"p.ltl", rule}});
  const CheckedFile& file = result.files[0];
  const PropertyVerdict& verdict = file.verdicts[0];
  if (verdict.verdict == Verdict::Holds) return "holds";
  REQUIRE(verdict.verdict == Verdict::Violated);
  return why(*result.tree, *file.network, *verdict.run, verdict.subjects,
             verdict.trigger_state);
}

TEST_CASE("whoever resumes a child is told to pass the guard over") {
  for (const NodeTypeInfo& info : kNodeTypes) {
    if (info.max_children < 2 || kInXml.at(info.type).empty()) continue;
    CAPTURE(info.name);
    const std::string told =
        reason(over_condition_and_action(info.type),
               "prove whenever A.running then C.ticked within 2 ticks");
    if (info.beside == Beside::None) {
      CHECK(told ==
            "n goes on with A, which was running, and does not tick C again.");
    } else {
      CHECK(told.find("goes on with") == told.npos);
    }
  }
}

TEST_CASE("whoever halts a child is told, with the reason") {
  for (const NodeTypeInfo& info : kNodeTypes) {
    if (info.max_children < 2 || kInXml.at(info.type).empty()) continue;
    CAPTURE(info.name);
    const std::string told =
        reason(over_condition_and_action(info.type), "prove never A.halted");
    if (told == "holds") {
      CHECK(info.beside != Beside::TheLeft);
      continue;
    }
    CHECK(told.find("n halts A because ") == 0);
    const bool counts = info.beside == Beside::Counted;
    CHECK((told.find("of its children have") != told.npos) == counts);
  }
}

TEST_CASE("what a timer or a script decides is told as the reason") {
  CHECK(reason({"<Timeout name=\"n\" msec=\"200\"><A/></Timeout>"},
               "prove never A.halted") == "n halts A because the time is up.");
  CHECK(reason({"<Sequence><Script code=\"x := 1\"/>"
                "<Parallel success_count=\"2\">"
                "<Sequence name=\"n\" _while=\"x == 1\"><A/></Sequence>"
                "<Script code=\"x := 2\"/></Parallel></Sequence>"},
               "prove never A.halted") ==
        "n halts A because `x == 1` is false.");
}

}  // namespace
}  // namespace btcheck::why_table_test
