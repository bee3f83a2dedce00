// SPDX-License-Identifier: MIT
//
// Random trees are trees; what they do obeys the frame of every node.
#include "reference/random_tree.hpp"

#include <doctest/doctest.h>

#include <array>
#include <string>

#include "model/tree/node_types.hpp"
#include "model/tree/tree.hpp"
#include "reference/effort.hpp"
#include "reference/tick_interpreter.hpp"

namespace btcheck::reference::random_tree_test {
namespace {

TEST_CASE("SplitMix64 gives the published numbers") {
  SplitMix64 random(1234567);
  CHECK(random.next() == 6457827717110365317U);
  CHECK(random.next() == 3203168211198807973U);
}

TEST_CASE("equal seeds give equal trees, different seeds others") {
  CHECK(random_tree(7) == random_tree(7));
  CHECK(random_tree(7) != random_tree(8));
}

TEST_CASE("printing and parsing are inverse") {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const std::string text = random_tree(seed);
    CHECK(print_s_expression(parse_s_expression(text)) == text);
  }
}

TEST_CASE("shrinking leaves what the failure needs and no more") {
  const std::string text =
      "((defsv x :init 2 :min 0 :max 3) ; a comment\n"
      " (BehaviorTree :name t (Sequence :name s (Action :ID a)"
      " (Repeat :repeat 7 (Inverter (Eval (= x 1)))))))";
  const auto fails = [](const std::string& candidate) {
    const auto repeat = candidate.find("(Repeat");
    return repeat != std::string::npos &&
           candidate.find("(Eval", repeat) != std::string::npos;
  };
  CHECK(shrink(text, fails) == "(Repeat\n (Eval))\n");
}

std::size_t place(NodeType type) { return static_cast<std::size_t>(type); }

TEST_CASE("every random tree can be read, and every node type occurs") {
  std::array<int, kNodeTypeCount> seen{};
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    const std::string text = random_tree(seed);
    INFO(text);
    const Result<BehaviorTree> tree = read_btf("random.btf", text);
    for (const Diagnostic& diagnostic : tree.diagnostics)
      if (diagnostic.severity == Severity::Error) FAIL(render(diagnostic));
    REQUIRE(tree.value.has_value());
    CHECK(tree.value->nodes.size() <= 9);
    for (const Node& node : tree.value->nodes) ++seen[place(node.type)];
  }
  for (const NodeTypeInfo& info : btf_node_types()) {
    INFO(info.name);
    CHECK_COVERED(
        (seen[place(info.type)] >= 20 || info.type == NodeType::SubTree));
  }
}

// Answers at random; free variables move along at most one transition.
Script random_script(SplitMix64& random, const BehaviorTree& tree) {
  const auto choose = [&random](auto allowed) {
    return allowed[static_cast<std::size_t>(
        random.below(static_cast<int>(allowed.size())))];
  };
  return {.action = [choose](NodeId, auto allowed) { return choose(allowed); },
          .set_sv = [choose](NodeId, auto allowed) { return choose(allowed); },
          .due = [&random](NodeId, int) { return random.percent(50); },
          .free_moves =
              [&random, &tree](std::span<int> values) {
                for (std::uint32_t i = 0; i < values.size(); ++i)
                  if (moves_freely(tree, StateVariableId{i}))
                    for (const auto& [from, to] : tree.variables[i].transitions)
                      if (values[i] == from && random.percent(30)) {
                        values[i] = to;
                        break;
                      }
              },
          .timely_move = [choose](StateVariableId,
                                  auto allowed) { return choose(allowed); }};
}

// Each ticked node answers once, inside its parent; who is halted was
// running, has no running child left, and has failed.
void check_frame(const BehaviorTree& tree, const TickResult& before,
                 const TickResult& after) {
  std::vector<NodeStatus> status = before.statuses;
  std::vector<NodeId> open;
  for (const TickEvent& event : after.events) {
    NodeStatus& own = status[index(event.node)];
    if (event.kind == EventKind::Ticked) {
      CHECK((open.empty() ? tree.node(event.node).is_root()
                          : tree.node(event.node).parent == open.back()));
      open.push_back(event.node);
      own = NodeStatus::NoRetStatus;
    } else if (event.kind == EventKind::Halted) {
      CHECK(own == NodeStatus::Running);
      for (const NodeId child : tree.node(event.node).children)
        CHECK(status[index(child)] != NodeStatus::Running);
      own = NodeStatus::Failure;
    } else {
      REQUIRE(!open.empty());
      CHECK(open.back() == event.node);
      open.pop_back();
      own = event.kind == EventKind::Success   ? NodeStatus::Success
            : event.kind == EventKind::Failure ? NodeStatus::Failure
                                               : NodeStatus::Running;
    }
  }
  CHECK((open.empty() || after.fault));
  CHECK(status == after.statuses);
}

TEST_CASE("on random trees every event fits the frame of its node") {
  int halts = 0;
  int faults = 0;
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    const std::string text = random_tree(seed);
    INFO(text);
    const Result<BehaviorTree> tree = read_btf("random.btf", text);
    REQUIRE(tree.value.has_value());
    SplitMix64 random(seed);
    TickInterpreter run(*tree.value, random_script(random, *tree.value));
    for (int i = 0; i < 20 && !run.ended() && !run.fault(); ++i) {
      const TickResult before = run.state();
      const TickResult after = run.tick();
      check_frame(*tree.value, before, after);
      for (const TickEvent& event : after.events)
        halts += event.kind == EventKind::Halted ? 1 : 0;
      faults += after.fault ? 1 : 0;
    }
  }
  MESSAGE(halts << " halts, " << faults << " faults");
  CHECK_COVERED(halts > 1000);
  CHECK_COVERED(faults > 10);
}

bool halts_something(const std::string& text) {
  const Result<BehaviorTree> tree = read_btf("random.btf", text);
  if (!tree.value) return false;
  SplitMix64 random(1);
  for (int trial = 0; trial < 20; ++trial) {
    TickInterpreter run(*tree.value, random_script(random, *tree.value));
    for (int i = 0; i < 10 && !run.ended() && !run.fault(); ++i)
      for (const TickEvent& event : run.tick().events)
        if (event.kind == EventKind::Halted) return true;
  }
  return false;
}

TEST_CASE("a tree that halts something shrinks to a few nodes") {
  int found = 0;
  for (std::uint64_t seed = 0; found < 10; ++seed) {
    const std::string text = random_tree(seed);
    if (!halts_something(text)) continue;
    ++found;
    const std::string small = shrink(text, halts_something);
    INFO(text << "became\n" << small);
    CHECK(halts_something(small));
    CHECK(read_btf("small.btf", small).value->nodes.size() <= 5);
    CHECK(shrink(small, halts_something) == small);
  }
}

}  // namespace
}  // namespace btcheck::reference::random_tree_test
