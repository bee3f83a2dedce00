// SPDX-License-Identifier: MIT
//
// Small state spaces as graphs, and large ones refused.
#include "check/space/space.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <string>

#include "model/btf_text.hpp"
#include "model/lowering.hpp"

namespace btcheck::space_test {
namespace {

Network network_of(std::string_view text,
                   TickSemantics ticks = TickSemantics::Root) {
  return lower(tree_of(text), ticks);
}

std::string graph_of(const Network& network, GraphFormat format) {
  const Limits limits;
  auto graph = space_graph(network, format, limits, "t.btf");
  REQUIRE(graph.value);
  return *graph.value;
}

constexpr std::string_view kAlwaysTrue =
    "(BehaviorTree :name t (Eval :name e (= 1 1)))";

TEST_CASE("every step is a line of Aldebaran's, in order of discovery") {
  CHECK(graph_of(network_of(kAlwaysTrue, TickSemantics::Root),
                 GraphFormat::Aldebaran) == R"(des (0, 9, 10)
(0, "t_btn0.start_ -> tick_node", 1)
(1, "time", 2)
(2, "t_btn0.tick_node -> e_btn1, tick", 3)
(3, "t_btn0.e_btn1 -> e_btn1_done, calls e_btn1", 4)
(4, "e_btn1.start_ -> tick_node, is called", 5)
(5, "e_btn1.tick_node -> success", 6)
(6, "e_btn1.success -> done, returns success", 7)
(7, "e_btn1.done -> start_, gives control back", 8)
(8, "t_btn0.e_btn1_done -> success", 9)
)");
}

TEST_CASE("a drawing marks the first state and the dead ones") {
  const std::string drawn = graph_of(network_of(kAlwaysTrue), GraphFormat::Dot);
  CHECK(drawn.starts_with("digraph \"states\" {\n"));
  CHECK(drawn.find("  0 [penwidth=2];\n  9 [shape=box];\n") != drawn.npos);
  CHECK(drawn.find("  1 -> 2 [label=\"time\"];\n") != drawn.npos);
  CHECK(drawn.ends_with("}\n"));
}

// Enumerations that move by themselves, each of ten values.
std::string free_variables(int count) {
  std::string text;
  for (int i = 0; i < count; ++i) {
    text += "(defsv v" + std::to_string(i) +
            " :states (a b c d e f g h i j) :transitions :all)";
  }
  return text + std::string(kAlwaysTrue);
}

TEST_CASE("what is too large to be drawn is refused by the number") {
  const Network network = network_of(free_variables(3));
  const Limits limits;
  const auto drawn = space_graph(network, GraphFormat::Dot, limits, "t.btf");
  CHECK(!drawn.value);
  REQUIRE(drawn.diagnostics.size() == 1);
  CHECK(render(drawn.diagnostics[0]) ==
        "error[BT0007]: the state space has more than 2,000 states, too many "
        "for a drawing\n  --> t.btf\n"
        "  = help: --export aut takes up to 100,000 states\n");
  CHECK(graph_of(network, GraphFormat::Aldebaran)
            .starts_with("des (0, 279000, 10000)\n"));
}

TEST_CASE("what is too large for a text is refused as well") {
  const Limits limits;
  const auto text = space_graph(network_of(free_variables(5)),
                                GraphFormat::Aldebaran, limits, "t.btf");
  CHECK(!text.value);
  REQUIRE(text.diagnostics.size() == 1);
  CHECK(text.diagnostics[0].message ==
        "the state space has more than 100,000 states, too many for a text of "
        "each step");
}

TEST_CASE("a limit leaves no graph behind") {
  const Limits limits{100, UINT64_MAX, nullptr};
  const auto text = space_graph(network_of(free_variables(4)),
                                GraphFormat::Aldebaran, limits, "t.btf");
  CHECK(!text.value);
  REQUIRE(text.diagnostics.size() == 1);
  CHECK(text.diagnostics[0].code == "BT0007");
}

// Two branches side by side, over a counter and an enumeration.
constexpr std::string_view kSideBySide = R"((defsv n :max 3)
(defsv battery :states (Good Low))
(defaction go :on-success ((:= battery Good)))
(BehaviorTree :name t :loop 1
 (Parallel :success 2 :halt 1
  (Sequence (Action :ID go) (Eval (:= n (mod (+ n 1) 4))))
  (Fallback (SetSV :sv battery) (Action :ID stay)))))";

TEST_CASE("a reduced graph has the states and steps that are counted") {
  const Network network = network_of(kSideBySide);
  const Limits limits;
  std::uint64_t before = UINT64_MAX;
  for (const Reduction reduce :
       {Reduction::None, Reduction::Live, Reduction::Full}) {
    SpaceOptions options;
    options.reduce = reduce;
    const ReachabilityResult counted =
        measure_space(network, options, limits).result;
    const auto graph =
        space_graph(network, GraphFormat::Aldebaran, limits, "t", reduce);
    REQUIRE(graph.value);
    CHECK(graph.value->starts_with(
        "des (0, " + std::to_string(counted.progress.transitions) + ", " +
        std::to_string(counted.progress.states) + ")\n"));
    CHECK(counted.progress.states < before);
    before = counted.progress.states;
  }
}

TEST_CASE("labels tell what an Eval or a contract assigns, once") {
  for (const Reduction reduce : {Reduction::None, Reduction::Full}) {
    const Limits limits;
    const auto graph = space_graph(network_of(kSideBySide),
                                   GraphFormat::Aldebaran, limits, "t", reduce);
    REQUIRE(graph.value);
    CHECK(graph.value->find("success, n := (n + 1) mod 4") !=
          std::string::npos);
    CHECK(graph.value->find("success, battery := Good") != std::string::npos);
    CHECK(graph.value->find("battery := Good, battery") == std::string::npos);
  }
}

}  // namespace
}  // namespace btcheck::space_test
