// SPDX-License-Identifier: MIT
//
// Branching time on graphs made by hand: states, fairness, paths.
#include "ltl/branching/ctl.hpp"

#include <doctest/doctest.h>

#include <initializer_list>
#include <memory>
#include <vector>

namespace btcheck::ctl_test {
namespace {

using Kind = FormulaKind;
using Numbers = std::vector<std::uint32_t>;

struct WrittenArc {
  std::uint32_t from;
  std::uint32_t to;
  bool progress = true;
};

// Sources in ascending order.
StoredGraph graph_of(std::size_t states,
                     std::initializer_list<WrittenArc> arcs) {
  StoredGraph graph;
  for (const WrittenArc& arc : arcs) {
    graph.add(StateId{arc.from}, {0, 0, arc.progress}, StateId{arc.to});
  }
  graph.close(states);
  return graph;
}

StateSet set_of(std::size_t states, const Numbers& members) {
  StateSet set(states);
  for (const std::uint32_t member : members) set.set(member);
  return set;
}

Numbers numbers_of(const StateSet& set) {
  Numbers numbers;
  for (std::uint32_t s = 0; s < set.size(); ++s) {
    if (set[s]) numbers.push_back(s);
  }
  return numbers;
}

Numbers numbers_of(const std::vector<StateId>& states) {
  Numbers numbers;
  for (const StateId state : states) numbers.push_back(index(state));
  return numbers;
}

// Formulas over p and q, as one writes them.
struct Formulas {
  FormulaPool pool;
  FormulaId p = pool.atom(0);
  FormulaId q = pool.atom(1);

  FormulaId unary(Kind kind, FormulaId of) { return pool.unary(kind, of); }
  FormulaId no(FormulaId f) { return unary(Kind::Not, f); }
  FormulaId both(FormulaId f, FormulaId g) {
    return pool.binary(Kind::And, f, g);
  }
  FormulaId e(FormulaId path) { return unary(Kind::ExistsPath, path); }
  FormulaId a(FormulaId path) { return unary(Kind::ForAllPaths, path); }
  FormulaId x(FormulaId f) { return unary(Kind::Next, f); }
  FormulaId f(FormulaId of) { return unary(Kind::Eventually, of); }
  FormulaId g(FormulaId of) { return unary(Kind::Always, of); }
  FormulaId until(FormulaId f, FormulaId g) {
    return pool.binary(Kind::Until, f, g);
  }
};

// A graph where p and q hold in the states named.
struct Case : Formulas {
  Case(StoredGraph of, const Numbers& p_in, const Numbers& q_in = {},
       std::vector<FairnessSets> conditions = {})
      : graph(std::move(of)),
        checker(std::make_shared<FairRuns>(graph, std::move(conditions)), pool,
                {set_of(graph.size(), p_in), set_of(graph.size(), q_in)}) {}

  Numbers where(FormulaId formula) {
    return numbers_of(checker.satisfying(formula));
  }
  GraphPath why(FormulaId formula) {
    const auto path = demonstrate(checker, {formula, true}, StateId{0});
    REQUIRE(path);
    return *path;
  }
  GraphPath why_not(FormulaId formula) {
    const auto path = demonstrate(checker, {formula, false}, StateId{0});
    REQUIRE(path);
    return *path;
  }

  StoredGraph graph;
  CtlChecker checker;
};

constexpr std::size_t kFinite = GraphPath::kFinite;

// 0 → 1 → 2 ⟲, and 0 → 3 ⟲: a fork with two ends.
StoredGraph fork() {
  return graph_of(4, {{0, 1}, {0, 3}, {1, 2}, {2, 2}, {3, 3}});
}

TEST_CASE("a quantifier directly over a temporal operator is CTL") {
  Formulas w;
  CHECK(!first_non_ctl(w.pool, w.p));
  CHECK(!first_non_ctl(w.pool, w.a(w.g(w.e(w.f(w.p))))));
  CHECK(!first_non_ctl(w.pool, w.no(w.e(w.until(w.p, w.a(w.x(w.q)))))));
}

TEST_CASE("a temporal operator without a quantifier is not CTL") {
  Formulas w;
  CHECK(first_non_ctl(w.pool, w.f(w.p)) == w.f(w.p));
  CHECK(first_non_ctl(w.pool, w.a(w.g(w.f(w.p)))) == w.f(w.p));
  CHECK(first_non_ctl(w.pool, w.both(w.q, w.g(w.p))) == w.g(w.p));
}

TEST_CASE("a quantifier without a temporal operator is not CTL") {
  Formulas w;
  CHECK(first_non_ctl(w.pool, w.e(w.p)) == w.e(w.p));
  CHECK(first_non_ctl(w.pool, w.a(w.e(w.f(w.p)))) == w.a(w.e(w.f(w.p))));
  const FormulaId two = w.a(w.both(w.f(w.p), w.g(w.q)));
  CHECK(first_non_ctl(w.pool, w.no(two)) == two);
}

TEST_CASE("what is shared is judged at each place where it stands") {
  Formulas w;
  const FormulaId shared = w.f(w.p);
  CHECK(first_non_ctl(w.pool, w.both(w.e(shared), shared)) == shared);
}

TEST_CASE("of several parts that are not CTL the first as read is named") {
  Formulas w;
  const FormulaId later = w.f(w.p);
  const FormulaId sooner = w.g(w.q);
  CHECK(first_non_ctl(w.pool, w.both(sooner, later)) == sooner);
}

TEST_CASE("some run reaches a state, not every run does") {
  Case c(fork(), {2});
  CHECK(c.where(c.e(c.f(c.p))) == Numbers{0, 1, 2});
  CHECK(c.where(c.a(c.f(c.p))) == Numbers{1, 2});
  CHECK(c.where(c.a(c.g(c.e(c.f(c.p))))) == Numbers{1, 2});
  CHECK(c.where(c.e(c.x(c.p))) == Numbers{1, 2});
  CHECK(c.where(c.a(c.x(c.e(c.f(c.p))))) == Numbers{1, 2});
}

TEST_CASE("until, weak until and release differ as they should") {
  Case c(fork(), {0, 1, 3}, {2});
  const auto weak = c.pool.binary(Kind::WeakUntil, c.p, c.q);
  const auto release = c.pool.binary(Kind::Release, c.q, c.p);
  CHECK(c.where(c.e(c.until(c.p, c.q))) == Numbers{0, 1, 2});
  CHECK(c.where(c.a(c.until(c.p, c.q))) == Numbers{1, 2});
  CHECK(c.where(c.a(weak)) == Numbers{0, 1, 2, 3});
  CHECK(c.where(c.e(release)) == Numbers{0, 3});
  CHECK(c.where(c.a(release)) == Numbers{3});
}

TEST_CASE("a run that only makes free moves is no run") {
  // 0 may stay for ever by a free move.
  Case c(graph_of(2, {{0, 0, false}, {0, 1}, {1, 1}}), {1});
  CHECK(c.where(c.a(c.f(c.p))) == Numbers{0, 1});
  CHECK(c.where(c.e(c.g(c.no(c.p)))).empty());
}

TEST_CASE("where no fair run begins, A holds and E does not") {
  Case c(graph_of(2, {{0, 0}, {0, 1}, {1, 1, false}}), {1});
  CHECK(numbers_of(c.checker.runs().starts()) == Numbers{0});
  CHECK(c.where(c.e(c.f(c.p))).empty());
  CHECK(c.where(c.a(c.g(c.no(c.p)))) == Numbers{0, 1});
  CHECK(c.where(c.a(c.x(c.pool.constant(false)))) == Numbers{1});
}

TEST_CASE("what is requested for ever is granted") {
  // 0 asks again and again and could always go to 1, which grants.
  const auto asking = [] { return graph_of(2, {{0, 0}, {0, 1}, {1, 0}}); };
  Case without(asking(), {1});
  CHECK(without.where(without.a(without.f(without.p))) == Numbers{1});
  Case with(asking(), {1}, {}, {{set_of(2, {0}), set_of(2, {1})}});
  CHECK(with.where(with.a(with.f(with.p))) == Numbers{0, 1});
}

TEST_CASE("checkers of one graph may share its fair runs") {
  const StoredGraph graph = fork();
  const auto runs = std::make_shared<const FairRuns>(graph);
  Formulas one;
  Formulas other;
  CtlChecker first(runs, one.pool, {set_of(4, {2})});
  CtlChecker second(runs, other.pool, {set_of(4, {3})});
  CHECK(numbers_of(first.satisfying(one.e(one.f(one.p)))) == Numbers{0, 1, 2});
  CHECK(numbers_of(second.satisfying(other.e(other.f(other.p)))) ==
        Numbers{0, 3});
}

TEST_CASE("a component is searched again without what is not granted") {
  // The whole ring asks in 0 and grants nothing; 1 and 2 go on by themselves.
  const auto ring = [] {
    return graph_of(3, {{0, 1}, {1, 2}, {2, 0}, {2, 1}});
  };
  Case c(ring(), {0}, {}, {{set_of(3, {0}), StateSet(3)}});
  CHECK(numbers_of(c.checker.runs().starts()) == Numbers{0, 1, 2});
  CHECK(c.where(c.e(c.g(c.e(c.f(c.p))))) == Numbers{0, 1, 2});
  CHECK(c.where(c.a(c.f(c.a(c.g(c.no(c.p)))))).empty());
  // And once more: what 1 asks for is granted in 0 alone.
  Case none(ring(), {0}, {},
            {{set_of(3, {0}), StateSet(3)}, {set_of(3, {1}), set_of(3, {0})}});
  CHECK(numbers_of(none.checker.runs().starts()).empty());
}

TEST_CASE("a reachable state is shown by a shortest path") {
  Case c(graph_of(5, {{0, 1}, {0, 2}, {1, 3}, {2, 4}, {3, 4}, {4, 4}}), {4});
  const GraphPath path = c.why(c.e(c.f(c.p)));
  CHECK(numbers_of(path.states) == Numbers{0, 2, 4});
  CHECK(path.loop == kFinite);
  CHECK(path.is_complete());
}

TEST_CASE("no path ends where no fair run goes on") {
  // p is nearest in 1, which can only be left by free moves for ever.
  Case c(graph_of(4, {{0, 1}, {0, 2}, {1, 1, false}, {2, 3}, {3, 3}}), {1, 3});
  CHECK(numbers_of(c.why(c.e(c.f(c.p))).states) == Numbers{0, 2, 3});
}

TEST_CASE("a broken AG is shown by a shortest path to where it breaks") {
  Case c(fork(), {0, 1, 3});
  const GraphPath path = c.why_not(c.a(c.g(c.p)));
  CHECK(numbers_of(path.states) == Numbers{0, 1, 2});
  CHECK(path.is_complete());
}

TEST_CASE("a broken AF is shown by a fair cycle that avoids it") {
  Case c(fork(), {2});
  const GraphPath path = c.why_not(c.a(c.f(c.p)));
  CHECK(numbers_of(path.states) == Numbers{0, 3});
  CHECK(path.loop == 1);
  CHECK(path.is_complete());
}

TEST_CASE("a cycle takes a step of progress even if that is the longer way") {
  Case c(graph_of(3, {{0, 0, false}, {0, 1, false}, {1, 2}, {2, 0, false}}),
         {});
  const GraphPath path = c.why(c.e(c.g(c.no(c.p))));
  CHECK(numbers_of(path.states) == Numbers{0, 1, 2});
  CHECK(path.loop == 0);
}

TEST_CASE("a cycle visits what is granted for what it requests") {
  Case c(graph_of(4, {{0, 0}, {0, 1}, {1, 2}, {2, 3}, {3, 0}}), {}, {},
         {{set_of(4, {0}), set_of(4, {2})}});
  const GraphPath path = c.why(c.e(c.g(c.no(c.p))));
  CHECK(numbers_of(path.states) == Numbers{0, 1, 2, 3});
  CHECK(path.loop == 0);
}

TEST_CASE("a path to where something is out of reach says what that is") {
  Case c(fork(), {2});
  const FormulaId reachable = c.e(c.f(c.p));
  const GraphPath path = c.why_not(c.a(c.g(reachable)));
  CHECK(numbers_of(path.states) == Numbers{0, 3});
  CHECK(path.loop == kFinite);
  REQUIRE(path.unshown.size() == 1);
  CHECK(path.unshown[0].claim == Claim{reachable, false});
  CHECK(path.unshown[0].first == 1);
  CHECK(path.unshown[0].last == 1);
}

TEST_CASE("a path goes on into the formula that fails at its end") {
  // q in 1, and from there p may be avoided in the cycle 2, 3.
  Case c(graph_of(5, {{0, 1}, {1, 2}, {1, 4}, {2, 3}, {3, 2}, {4, 4}}), {4},
         {1});
  const FormulaId answered =
      c.a(c.g(c.pool.binary(Kind::Implies, c.q, c.a(c.f(c.p)))));
  const GraphPath path = c.why_not(answered);
  CHECK(numbers_of(path.states) == Numbers{0, 1, 2, 3});
  CHECK(path.loop == 2);
  CHECK(path.is_complete());
}

TEST_CASE("what an until passes through is noted when it is no mere state") {
  Case c(fork(), {2}, {3});
  const FormulaId may_stop = c.e(c.f(c.q));
  const GraphPath path = c.why(c.e(c.until(may_stop, c.e(c.x(c.p)))));
  CHECK(numbers_of(path.states) == Numbers{0, 1, 2});
  REQUIRE(path.unshown.size() == 1);
  CHECK(path.unshown[0].claim == Claim{may_stop, true});
  CHECK(path.unshown[0].first == 0);
  CHECK(path.unshown[0].last == 0);
}

TEST_CASE("of two things to show, one is gone on with, the other noted") {
  Case c(fork(), {2}, {3});
  const FormulaId first = c.a(c.f(c.both(c.p, c.q)));
  const FormulaId second = c.e(c.f(c.q));
  const GraphPath path = c.why(c.both(c.no(first), second));
  CHECK(path.unshown.size() == 1);
  CHECK(!path.is_complete());
}

TEST_CASE("there is no path for what no path shows, nor for what is not so") {
  Case c(fork(), {2});
  CHECK(!demonstrate(c.checker, {c.e(c.x(c.p)), false}, StateId{0}));
  CHECK(!demonstrate(c.checker,
                     {c.a(c.g(c.e(c.x(c.pool.constant(true))))), true},
                     StateId{0}));
  CHECK(!demonstrate(c.checker, {c.p, true}, StateId{0}));
  CHECK(numbers_of(c.why_not(c.p).states) == Numbers{0});
}

TEST_CASE("a formula of great depth and a long path need no deep stack") {
  constexpr std::uint32_t kLength = 100'000;
  StoredGraph graph;
  for (std::uint32_t s = 0; s < kLength; ++s) {
    graph.add(StateId{s}, {}, StateId{s + 1 < kLength ? s + 1 : s});
  }
  graph.close(kLength);
  Case c(std::move(graph), {kLength - 1});
  FormulaId formula = c.p;
  for (int i = 0; i < 2000; ++i) formula = c.e(c.x(formula));
  CHECK(c.checker.satisfying(formula).count() == 2001);
  const GraphPath path = c.why(c.e(c.f(formula)));
  CHECK(path.states.size() == kLength);
}

}  // namespace
}  // namespace btcheck::ctl_test
