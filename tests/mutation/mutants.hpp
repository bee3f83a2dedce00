// SPDX-License-Identifier: MIT
//
// Each wrong table against the specification of its node type.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "mutation/specification.hpp"
#include "mutation/table_mutation.hpp"

namespace btcheck::mutation {

// The same mistake in every automaton of the type, in every harness that has
// such an edge.
struct Mutant {
  Operator which{};
  std::string text;
  struct Place {
    std::size_t harness = 0;
    AutomatonId automaton{};
    std::vector<std::pair<std::size_t, Edge>> edges;
  };
  std::vector<Place> places;
};

// Every mutant, in the order in which its first edge stands in the first table
// that has it.
std::vector<Mutant> mutants_of(const Specification& specification);

// So many of them (or all, if there are fewer) that every operator has its
// turn, evenly spread over each operator's.
std::vector<Mutant> sample_of(std::vector<Mutant> mutants, std::size_t count);

enum class Fate : std::uint8_t {
  Killed,      // some property is not answered as expected
  NeverTaken,  // no run of any harness comes to a changed edge, old or new
  SameRuns,    // in no harness can the two tables be told apart from outside
  Survives     // a hole in the specification
};
struct Judgement {
  Fate fate = Fate::Survives;
  std::string killer;  // Killed: file and property
};

// Judges mutants one after another. Properties that have killed often are
// asked first: whether a mutant survives does not depend on it, but one with
// the same runs may be killed before it is compared, by a property that names a
// local.
class Judge {
 public:
  explicit Judge(const Specification& specification);
  Judgement judge(const Mutant& mutant);

  // The properties that are not answered as expected of the right tables.
  std::vector<std::string> wrong_from_the_start() const;

 private:
  struct Candidate {
    Question question;
    std::size_t kills = 0;
  };
  std::string name_of(Question question) const;
  // Of the first harness and what has killed before, or all.
  enum class Asked : std::uint8_t { Small, All };
  // The first question that one of the networks, by harness, fails; those that
  // are absent are the right ones.
  std::optional<std::string> killer_of(
      const std::vector<std::optional<Network>>& networks, Asked asked);

  const Specification& specification_;
  std::vector<Candidate> candidates_;
};

}  // namespace btcheck::mutation
