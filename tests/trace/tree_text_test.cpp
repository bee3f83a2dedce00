// SPDX-License-Identifier: MIT
//
// A tree and what its nodes do, line by line.
#include "trace/formats/tree_text.hpp"

#include <doctest/doctest.h>

#include <string>

#include "trace/run/record.hpp"
#include "trace/told.hpp"

namespace btcheck {
namespace {

constexpr std::string_view kTree =
    "(BehaviorTree :name t (Sequence :name s (Action :ID a)\n"
    " (Inverter :name i (Sequence :name j (Action :ID b) (Action :ID c)))))";

std::string text_after(const std::vector<std::string>& script,
                       Folding folding) {
  const Lowered model(kTree);
  const RecordedRun run =
      recorded(model.tree, model.network, scripted(model, script), {});
  return tree_text(run, run.states.size() - 1, folding);
}

TEST_CASE("a tree that nobody has ticked is its names") {
  const Lowered model(kTree);
  Run run;
  run.initial = NetworkInterpreter(model.network).initial();
  const RecordedRun record = recorded(model.tree, model.network, run, {});
  CHECK(tree_text(record, 0, Folding::None) ==
        "t\n"
        "  s\n"
        "    a\n"
        "    i\n"
        "      j\n"
        "        b\n"
        "        c\n");
  CHECK(tree_text(record, 0, Folding::Unvisited) == "t and 6 below it\n");
}

TEST_CASE("beside each node stands what it does") {
  CHECK(text_after({"a -> running"}, Folding::Unvisited) ==
        "t      waiting\n"
        "  s    waiting\n"
        "    a  here\n"
        "    i and 3 below it\n");
  CHECK(text_after({"a -> success", "b -> running"}, Folding::None) ==
        "t          waiting\n"
        "  s        waiting\n"
        "    a      success\n"
        "    i      waiting\n"
        "      j    waiting\n"
        "        b  here\n"
        "        c\n");
}

TEST_CASE("what is of an earlier tick stands in parentheses") {
  CHECK(text_after({"a -> success", "b -> running", "b -> success"},
                   Folding::Unvisited) ==
        "t          waiting\n"
        "  s        waiting\n"
        "    a      (success)\n"
        "    i      waiting\n"
        "      j    waiting\n"
        "        b  here\n"
        "        c\n");
}

}  // namespace
}  // namespace btcheck
