// SPDX-License-Identifier: MIT
//
// A table of rules made in the program that runs the tree.
#include <doctest/doctest.h>

#include <stdexcept>
#include <string>

#include "btcheck/check.hpp"
#include "btcheck/monitor.hpp"

namespace btcheck::monitor_table_test {
namespace {

namespace v1 = btcheck::v1;

constexpr const char* kTree =
    "<root BTCPP_format=\"4\"><BehaviorTree ID=\"Main\"><Sequence name=\"go\">"
    "<Action ID=\"Look\" name=\"look\"/><Action ID=\"Drive\" name=\"drive\"/>"
    "</Sequence></BehaviorTree></root>";

v1::RuleTable made(v1::Request request) {
  v1::Files files;
  files.add("t.xml", kTree);
  files.add("r.ltl", "property a: look.success precedes drive.ticked\n");
  request.tree = "t.xml";
  return v1::monitor_table(request, files);
}

TEST_CASE("a table watches a run of its tree") {
  v1::Request request;
  request.rules = {"r.ltl"};
  const v1::RuleTable table = made(request);
  REQUIRE(table.outcome == v1::Outcome::Met);
  const auto read = monitor::Table::read(table.text);
  monitor::Monitor monitor(read, monitor::Knowledge::Exact);
  monitor.begin_tick();
  monitor.begin_node(1);
  monitor.begin_node(3);
  CHECK(monitor.verdict(0) == monitor::Verdict::Violated);
  request.rules.clear();
  request.typed_rules = {"never drive.failure"};
  CHECK(made(request).outcome == v1::Outcome::Met);
}

TEST_CASE("what is no table says why") {
  v1::Request request;
  v1::RuleTable table = made(request);
  CHECK(table.outcome == v1::Outcome::BadInput);
  CHECK(table.text.empty());
  REQUIRE(!table.findings.empty());
  CHECK(table.findings.back().code == "BT0005");
  request.typed_rules = {"AG EF root.success"};
  table = made(request);
  CHECK(table.outcome == v1::Outcome::BadInput);
  REQUIRE(!table.findings.empty());
  CHECK(table.findings.back().code == "BT1801");
}

}  // namespace
}  // namespace btcheck::monitor_table_test
