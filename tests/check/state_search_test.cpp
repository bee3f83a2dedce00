// SPDX-License-Identifier: MIT
//
// The same answers from one thread and from several, reduced or not.
#include "check/state_search.hpp"

#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "check/checked.hpp"
#include "check/evidence.hpp"
#include "check/searched_network.hpp"

namespace btcheck {
namespace {

// Whether each node can be in each of its locations, and whether it can be
// where it never is.
std::vector<StatePredicate> questions_about(const Network& network) {
  std::vector<StatePredicate> questions;
  for (const Automaton& automaton : network.automata) {
    const auto here = Expression::variable(
        static_cast<std::int32_t>(index(automaton.location)));
    for (std::size_t l = 0; l <= automaton.locations.size(); ++l) {
      questions.push_back(
          {Expression::binary(Operation::Equal, here,
                              Expression::constant(static_cast<int>(l))),
           {}});
    }
  }
  return questions;
}

void check_equal(const Lowered& model, Reduction reduction) {
  const auto questions = questions_about(model.network);
  const SearchedNetwork searched(
      model.system, observed_by(model.network, questions), reduction);
  const auto answers_with = [&](unsigned threads, std::uint64_t sequential) {
    return search_states(searched.system(), questions, {},
                         {SearchOrder::BreadthFirst, threads, sequential}, {});
  };
  const StateAnswers alone = answers_with(1, UINT64_MAX);
  std::size_t found = 0;
  for (const unsigned threads : {1u, 2u, 4u}) {
    const StateAnswers together = answers_with(threads, 10);
    CHECK(together.result.is_complete);
    for (std::size_t q = 0; q < questions.size(); ++q) {
      REQUIRE(together.found[q].has_value() == alone.found[q].has_value());
      if (!alone.found[q]) continue;
      ++found;
      CHECK(together.found[q]->prefix.size() == alone.found[q]->prefix.size());
      std::string error;
      const auto run = searched.replayed(*together.found[q], error);
      REQUIRE(error == "");
      CHECK(ends_with(model.network, *run, questions[q]));
    }
  }
  CHECK(found > 0);
  CHECK(found < 3 * questions.size());
}

TEST_CASE("a search that grows large answers as a small one does") {
  const Lowered model(example("drone1.btf"));
  for (const Reduction reduction :
       {Reduction::None, Reduction::Live, Reduction::Full}) {
    check_equal(model, reduction);
  }
}

TEST_CASE("a limit above the sequential part still ends the search") {
  const Lowered model(example("drone1.btf"));
  const StatePredicate nowhere{
      Expression::binary(Operation::Less, Expression::constant(1),
                         Expression::constant(0)),
      {}};
  const StateAnswers answers =
      search_states(model.system, {nowhere}, {},
                    {SearchOrder::BreadthFirst, 2, 100}, {.max_states = 5000});
  CHECK(answers.result.stopped == StopReason::MaxStates);
  CHECK(!answers.result.is_complete);
  CHECK(answers.result.progress.states >= 5000);
}

}  // namespace
}  // namespace btcheck
