// SPDX-License-Identifier: MIT
//
// Who reads and writes what in networks of two or three automata.
#include "explore/state/accesses.hpp"

#include <doctest/doctest.h>

#include <vector>

#include "explore/toy.hpp"

namespace btcheck::accesses_test {
namespace {

using Automata = std::vector<AutomatonId>;

// One copies y into x, where it has found z to be 1; the other sets x.
struct Pair {
  toy::Draft draft;
  VariableId x = draft.variable("x", 0, 3);
  VariableId y = draft.variable("y", 0, 3);
  VariableId z = draft.variable("z", 0, 3);
  AutomatonId copier =
      draft.automaton(AutomatonKind::Node, "copier", {"here", "there"});
  AutomatonId setter = draft.automaton(AutomatonKind::Node, "setter", {"here"});

  Pair() {
    draft.edge(copier, 0, 1, kAtOnce, toy::is(z, 1),
               {{x, toy::variable(y)}, {x, toy::variable(y)}});
    draft.edge(copier, 1, 0, kAtOnce, toy::is(z, 0));
    draft.edge(setter, 0, 0, kAtOnce, {}, {toy::assign(x, 1)});
  }
};

TEST_CASE("guards and values are read and targets of updates written") {
  Pair pair;
  const Accesses accesses(pair.draft.finish());
  CHECK(accesses.readers[index(pair.x)].empty());
  CHECK(accesses.writers[index(pair.x)] == Automata{pair.copier, pair.setter});
  CHECK(accesses.readers[index(pair.y)] == Automata{pair.copier});
  CHECK(accesses.writers[index(pair.y)].empty());
  CHECK(accesses.readers[index(pair.z)] == Automata{pair.copier});
  CHECK(accesses.writers[index(pair.z)].empty());
}

TEST_CASE("an automaton reads and writes its location, but not without edges") {
  Pair pair;
  const AutomatonId idle =
      pair.draft.automaton(AutomatonKind::Node, "idle", {"here"});
  const Accesses accesses(pair.draft.finish());
  const VariableId own = pair.draft.location(pair.copier);
  CHECK(accesses.readers[index(own)] == Automata{pair.copier});
  CHECK(accesses.writers[index(own)] == Automata{pair.copier});
  const VariableId unused = pair.draft.location(idle);
  CHECK(accesses.readers[index(unused)].empty());
  CHECK(accesses.writers[index(unused)].empty());
}

TEST_CASE("a gate is read though no guard names it") {
  Pair pair;
  const AutomatonId gated =
      pair.draft.automaton(AutomatonKind::Node, "gated", {"here"}, pair.y);
  pair.draft.edge(gated, 0, 0);
  const Accesses accesses(pair.draft.finish());
  CHECK(accesses.readers[index(pair.y)] == Automata{pair.copier, gated});
  CHECK(accesses.writers[index(pair.y)].empty());
}

TEST_CASE("a variable is only its users' where readers and writers are") {
  Pair pair;
  const Accesses accesses(pair.draft.finish());
  CHECK(accesses.are_only_by(Automata{pair.copier}, pair.y));
  CHECK(!accesses.are_only_by(Automata{pair.setter}, pair.y));
  CHECK(!accesses.are_only_by(Automata{pair.copier}, pair.x));
  CHECK(accesses.are_only_by(Automata{pair.setter, pair.copier}, pair.x));
}

TEST_CASE("an edge tells its location, its reads, then what it writes") {
  Pair pair;
  const Network network = pair.draft.finish();
  const Automaton& copier = network.automaton(pair.copier);
  std::vector<VariableId> read, written;
  for_each_access(
      copier, copier.edges[0], [&](VariableId id) { read.push_back(id); },
      [&](VariableId id) { written.push_back(id); });
  CHECK(read == std::vector{copier.location, pair.z, pair.y, pair.y});
  CHECK(written == std::vector{copier.location, pair.x, pair.x});
}

}  // namespace
}  // namespace btcheck::accesses_test
