// SPDX-License-Identifier: MIT
//
// The same answers from one thread and from several, reduced or not.
#include "check/search/searches.hpp"

#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "check/checked.hpp"
#include "check/replay/evidence.hpp"
#include "check/search/searched_network.hpp"
#include "explore/search/reachability.hpp"
#include "explore/tiny_scratch.hpp"

namespace btcheck::state_search_test {
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

// With the runs that a search gives away.
struct Answers {
  ReachabilityResult result;
  std::vector<std::optional<Lasso>> found;
};

Answers answers_of(const ReducedNetwork& system,
                   const std::vector<StatePredicate>& questions,
                   const SearchChoices& how, const Limits& limits) {
  Answers answers{{}, std::vector<std::optional<Lasso>>(questions.size())};
  const StateAnswers met = search_states(
      system, questions, {}, how, limits,
      [&](std::size_t question, const std::function<Lasso()>& run) {
        answers.found[question] = run();
      });
  answers.result = met.result;
  for (std::size_t q = 0; q < questions.size(); ++q) {
    CHECK(met.met[q] == answers.found[q].has_value());
  }
  return answers;
}

void check_equal(const Lowered& model, Reduction reduction) {
  const auto questions = questions_about(model.network);
  const SearchedNetwork searched(
      model.system, observed_by(model.network, questions), reduction);
  const auto answers_with = [&](unsigned threads, std::uint64_t sequential) {
    return answers_of(searched.system(), questions,
                      {.threads = threads, .sequential_states = sequential},
                      {});
  };
  const Answers alone = answers_with(1, UINT64_MAX);
  std::size_t found = 0;
  for (const unsigned threads : {1u, 2u, 4u}) {
    const Answers together = answers_with(threads, 10);
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
  const Answers answers = answers_of(model.system, {nowhere},
                                     {.threads = 2, .sequential_states = 100},
                                     {.max_states = 5000});
  CHECK(answers.result.stopped == StopReason::MaxStates);
  CHECK(!answers.result.is_complete);
  CHECK(answers.result.progress.states >= 5000);
}

// Met by this one state.
StatePredicate is_there(const Lowered& model, StateView state) {
  Expression all = Expression::constant(1);
  for (std::size_t v = 0; v < model.network.variables.size(); ++v) {
    const VariableId variable{static_cast<std::uint32_t>(v)};
    all = Expression::binary(
        Operation::And, std::move(all),
        equals(variable,
               static_cast<int>(model.system.value(state, variable))));
  }
  return {std::move(all), {}};
}

// Any memory limit that a search in memory cannot keep, and one on disk can.
TEST_CASE("what memory does not suffice for is answered on disk") {
  const Lowered model(example("drone3-fixed.btf"));
  ReachabilityVisitor nothing;
  const Limits unlimited;
  BreadthFirst search(model.system, unlimited);
  const auto states = search.run(nothing).progress.states;
  const StateId last{static_cast<std::uint32_t>(states - 1)};
  const std::vector<RunState> expected = search.path_to(last);
  const StatePredicate predicate =
      is_there(model, StateView(expected.back().state));

  int on_disk_only = 0;
  for (std::uint64_t bytes = 8'000'000; bytes > 5'000'000; bytes -= 1'000'000) {
    const Limits limits{.max_bytes = bytes};
    SearchChoices how{.threads = 2};
    const Answers in_memory =
        answers_of(model.system, {predicate}, how, limits);
    how.scratch.folder = tiny_scratch().folder;
    how.scratch.words_in_memory = 1000;
    const Answers on_disk = answers_of(model.system, {predicate}, how, limits);
    if (in_memory.result.stopped != StopReason::Memory) continue;
    if (on_disk.result.stopped == StopReason::Memory) continue;
    ++on_disk_only;
    REQUIRE(on_disk.found[0]);
    CHECK(on_disk.found[0]->prefix.size() == expected.size());
    CHECK(on_disk.found[0]->prefix.back().state == expected.back().state);
  }
  CHECK(on_disk_only > 0);
}

TEST_CASE("a disk that fails leaves the question open") {
  const Lowered model(example("drone3-fixed.btf"));
  const StatePredicate nowhere{Expression::constant(0), {}};
  SearchChoices how{.threads = 2};
  how.scratch.folder = "/dev/null/no-folder";
  const Answers answers =
      answers_of(model.system, {nowhere}, how, {.max_bytes = 3'000'000});
  CHECK(answers.result.stopped == StopReason::Disk);
  CHECK(!answers.result.is_complete);
  CHECK(!answers.found[0]);
}

}  // namespace
}  // namespace btcheck::state_search_test
