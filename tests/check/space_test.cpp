// SPDX-License-Identifier: MIT
//
// State spaces as graphs, and quotients of them; what is too large to be drawn
// is refused.
#include "check/space/space.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "check/space/graph.hpp"
#include "check/space/quotient.hpp"
#include "model/btf_text.hpp"
#include "model/lowering.hpp"
#include "text/budget.hpp"

namespace btcheck::space_test {
namespace {

Network network_of(std::string_view text,
                   TickSemantics ticks = TickSemantics::Root) {
  return lower(tree_of(text), ticks);
}

// What is written, and what is said.
struct Written {
  std::string text;
  std::vector<Diagnostic> found;
};

Written written(const Network& network, const GraphOptions& options,
                const Limits& limits = {}) {
  Written result;
  result.found = write_space_graph(network, options, limits, "t.btf",
                                   [&](std::string_view text) {
                                     result.text += text;
                                     return true;
                                   });
  return result;
}

std::string graph_of(const Network& network, const GraphOptions& options) {
  const Written result = written(network, options);
  REQUIRE(result.found.empty());
  return result.text;
}

std::string text_of(const SpaceQuotient& quotient, GraphFormat format) {
  std::string text;
  const auto found =
      write_quotient(quotient, format, "t.btf", [&](std::string_view piece) {
        text += piece;
        return true;
      });
  REQUIRE(found.empty());
  return text;
}

constexpr std::string_view kAlwaysTrue =
    "(BehaviorTree :name t (Eval :name e (= 1 1)))";

TEST_CASE("every step is a line of Aldebaran's, in order of discovery") {
  CHECK(graph_of(network_of(kAlwaysTrue, TickSemantics::Root), {}) ==
        R"(des (0, 9, 10)
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
  const std::string drawn =
      graph_of(network_of(kAlwaysTrue), {GraphFormat::Dot});
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
  const Written drawn = written(network, {GraphFormat::Dot});
  CHECK(drawn.text.empty());
  REQUIRE(drawn.found.size() == 1);
  CHECK(render(drawn.found[0]) ==
        "error[BT0007]: the state space has more than 2,000 states, too many "
        "for a drawing\n  --> t.btf\n"
        "  = help: --export aut takes any number\n");
  CHECK(graph_of(network, {}).starts_with("des (0, 279000, 10000)\n"));
}

TEST_CASE("a graph of any size is handed on in pieces, with every step") {
  std::string moving;
  for (int i = 0; i < 14; ++i) {
    moving +=
        "(defsv v" + std::to_string(i) + " :states (a b) :transitions :all)";
  }
  const Network network = network_of(moving + std::string(kAlwaysTrue));
  const ReachabilityResult counted = measure_space(network, {}, {}).result;
  REQUIRE(counted.progress.states == 163'840);
  std::string head;
  std::uint64_t lines = 0;
  std::size_t largest = 0;
  const auto found =
      write_space_graph(network, {}, {}, "t.btf", [&](std::string_view piece) {
        if (head.empty()) head = piece.substr(0, piece.find('\n'));
        lines += static_cast<std::uint64_t>(std::ranges::count(piece, '\n'));
        largest = std::max(largest, piece.size());
        return true;
      });
  CHECK(found.empty());
  CHECK(head == "des (0, " + std::to_string(counted.progress.transitions) +
                    ", 163840)");
  CHECK(lines == counted.progress.transitions + 1);
  CHECK(largest < 100'000);
}

TEST_CASE("nobody who takes no more is handed more") {
  int pieces = 0;
  const auto found = write_space_graph(network_of(free_variables(3)), {}, {},
                                       "t.btf", [&](std::string_view) {
                                         ++pieces;
                                         return false;
                                       });
  CHECK(found.empty());
  CHECK(pieces == 1);
}

TEST_CASE("a limit leaves no graph behind") {
  const Limits limits{100, UINT64_MAX, nullptr};
  const Written result = written(network_of(free_variables(4)), {}, limits);
  CHECK(result.text.empty());
  REQUIRE(result.found.size() == 1);
  CHECK(result.found[0].code == "BT0007");
  CHECK(result.found[0].message ==
        "a limit was reached before all states were found");
}

TEST_CASE("time that runs out while steps are written ends the writing") {
  // Asked for the search, it lets it go on; then the steps come.
  struct TimeOut : SearchMonitor {
    StopReason observe(const SearchProgress& progress) override {
      const bool is_over = progress.expanded == progress.states;
      return is_over ? StopReason::Timeout : StopReason::None;
    }
  } monitor;
  const Limits limits{UINT64_MAX, UINT64_MAX, &monitor};
  const Written result = written(network_of(free_variables(3)), {}, limits);
  REQUIRE(result.found.size() == 1);
  CHECK(result.found[0].message ==
        "a limit was reached before all steps were written");
  CHECK(result.text.empty());
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
    CHECK(graph_of(network, {GraphFormat::Aldebaran, reduce})
              .starts_with("des (0, " +
                           std::to_string(counted.progress.transitions) + ", " +
                           std::to_string(counted.progress.states) + ")\n"));
    CHECK(counted.progress.states < before);
    before = counted.progress.states;
  }
}

TEST_CASE("labels tell what an Eval or a contract assigns, once") {
  for (const Reduction reduce : {Reduction::None, Reduction::Full}) {
    const std::string graph =
        graph_of(network_of(kSideBySide), {GraphFormat::Aldebaran, reduce});
    CHECK(graph.find("success, n := (n + 1) mod 4") != std::string::npos);
    CHECK(graph.find("success, battery := Good") != std::string::npos);
    CHECK(graph.find("battery := Good, battery") == std::string::npos);
  }
}

// --- What is seen ----------------------------------------------------------

TEST_CASE("a graph has answers and time, and `i` for what is hidden") {
  CHECK(graph_of(network_of(kAlwaysTrue),
                 {GraphFormat::Aldebaran, Reduction::None,
                  SeenAnswers::OfAll}) == R"(des (0, 9, 10)
(0, "i", 1)
(1, "time", 2)
(2, "i", 3)
(3, "i", 4)
(4, "i", 5)
(5, "e_btn1 -> success", 6)
(6, "i", 7)
(7, "i", 8)
(8, "t_btn0 -> success", 9)
)");
}

SpaceQuotient quotient_of(std::string_view text, SeenAnswers seen,
                          Equivalence equivalence = Equivalence::Branching) {
  return quotient_of_space(network_of(text), equivalence, seen, {});
}

TEST_CASE("the quotient has what is seen, and nothing else") {
  const auto all = quotient_of(kAlwaysTrue, SeenAnswers::OfAll);
  CHECK(text_of(all, GraphFormat::Aldebaran) == R"(des (0, 3, 4)
(0, "time", 1)
(1, "e_btn1 -> success", 2)
(2, "t_btn0 -> success", 3)
)");
  CHECK(all.whole.states == 10);
  CHECK(all.whole.transitions == 9);
  CHECK(text_of(quotient_of(kAlwaysTrue, SeenAnswers::OfRoot),
                GraphFormat::Aldebaran) == R"(des (0, 2, 3)
(0, "time", 1)
(1, "t_btn0 -> success", 2)
)");
  CHECK(text_of(quotient_of(kAlwaysTrue, SeenAnswers::OfLeaves),
                GraphFormat::Aldebaran) == R"(des (0, 2, 3)
(0, "time", 1)
(1, "e_btn1 -> success", 2)
)");
}

TEST_CASE("hidden steps are steps where equivalence is strong") {
  const auto strong =
      quotient_of(kAlwaysTrue, SeenAnswers::OfAll, Equivalence::Strong);
  CHECK(strong.graph.size() == 10);
  CHECK(strong.labels.front() == "i");
  CHECK(text_of(strong, GraphFormat::Aldebaran)
            .starts_with("des (0, 9, 10)\n(0, \"i\", 1)\n"));
}

TEST_CASE("a quotient is drawn, with its dead states") {
  const std::string drawn =
      text_of(quotient_of(kAlwaysTrue, SeenAnswers::OfRoot), GraphFormat::Dot);
  CHECK(drawn.find("  0 [penwidth=2];\n  2 [shape=box];\n") != drawn.npos);
  CHECK(drawn.find("  0 -> 1 [label=\"time\"];\n") != drawn.npos);
}

// Battery changes are hidden, and may go on for ever without time.
TEST_CASE("hidden steps without an end are seen as such") {
  const auto with = quotient_of(
      "(defsv v :states (a b) :transitions :all)"
      "(BehaviorTree :name t (Eval (= 1 1)))",
      SeenAnswers::OfRoot);
  // As without the variable, but each state can go on silently for ever.
  CHECK(with.graph.size() == 3);
  for (std::uint32_t s = 0; s < 3; ++s) {
    CHECK(std::ranges::count(with.graph.arcs(s),
                             LabelledGraph::Arc{LabelledGraph::kSilent, s}) ==
          1);
  }
}

TEST_CASE("a limit leaves no quotient") {
  const Limits few{100, UINT64_MAX, nullptr};
  const auto cut =
      quotient_of_space(network_of(free_variables(4)), Equivalence::Branching,
                        SeenAnswers::OfAll, few);
  CHECK(cut.stopped == StopReason::MaxStates);
  CHECK(cut.graph.size() == 0);
  const auto found = write_quotient(cut, GraphFormat::Aldebaran, "t.btf",
                                    [](std::string_view) {
                                      FAIL("something is written");
                                      return true;
                                    });
  REQUIRE(found.size() == 1);
  CHECK(found[0].code == "BT0007");
}

TEST_CASE("nothing is left of a budget: states are not compared") {
  // All that comes before has its time.
  struct NoTime : Budget {
    Spent look() override {
      const std::string_view now = doing();
      return now == "states were compared" ? Spent::Time : Spent::Nothing;
    }
  } budget;
  const Network network = network_of(kSideBySide);
  const BudgetScope scope(&budget);
  CHECK(
      quotient_of_space(network, Equivalence::Branching, SeenAnswers::OfAll, {})
          .stopped == StopReason::Timeout);
}

}  // namespace
}  // namespace btcheck::space_test
