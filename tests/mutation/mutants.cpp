// SPDX-License-Identifier: MIT
//
// A mutant is put into copies of the networks, which the same predicates as
// ever then speak of: the variables keep their places. The gate of a changed
// automaton is taken off, since it rests on a frame that is drawn rightly.
#include "mutation/mutants.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <optional>

#include "mutation/same_runs.hpp"

namespace btcheck::mutation {
namespace {

// The mutant's network of each harness; nothing where it is the right one.
std::vector<std::optional<Network>> networks_of(
    const Specification& specification, const Mutant& mutant) {
  std::vector<std::optional<Network>> networks(specification.harnesses.size());
  for (const Mutant::Place& place : mutant.places) {
    std::optional<Network>& network = networks[place.harness];
    if (!network) network = specification.harnesses[place.harness]->network;
    Automaton& automaton = network->automata[index(place.automaton)];
    automaton.gate.reset();
    for (const auto& [at, edge] : place.edges) automaton.edges[at] = edge;
  }
  return networks;
}

bool takes_changed_edge(const Network& network, const Mutant& mutant,
                        std::size_t harness) {
  const std::set<std::uint32_t> taken = edges_taken(network);
  for (const Mutant::Place& place : mutant.places) {
    if (place.harness != harness) continue;
    const std::uint32_t first = network.automaton(place.automaton).first_edge;
    for (const auto& change : place.edges) {
      if (taken.contains(first + static_cast<std::uint32_t>(change.first))) {
        return true;
      }
    }
  }
  return false;
}

}  // namespace

std::vector<Mutant> mutants_of(const Specification& specification) {
  std::vector<Mutant> mutants;
  std::map<std::string, std::size_t> by_text;
  const auto& harnesses = specification.harnesses;
  for (const auto& harness : harnesses) {
    for (const AutomatonId subject : harness->subjects) {
      for (const Mutation& found :
           mutations_of(harness->tree, harness->network, subject)) {
        if (by_text.emplace(found.text, mutants.size()).second) {
          mutants.push_back({found.which, found.text, {}});
        }
      }
    }
  }
  for (std::size_t h = 0; h < harnesses.size(); ++h) {
    for (const AutomatonId automaton : harnesses[h]->of_type) {
      for (Mutation& found :
           mutations_of(harnesses[h]->tree, harnesses[h]->network, automaton)) {
        const auto known = by_text.find(found.text);
        if (known == by_text.end()) continue;
        mutants[known->second].places.push_back(
            {h, automaton, std::move(found.edges)});
      }
    }
  }
  return mutants;
}

std::vector<Mutant> sample_of(std::vector<Mutant> mutants, std::size_t count) {
  std::array<std::vector<std::size_t>, kOperatorCount> by_operator;
  for (std::size_t i = 0; i < mutants.size(); ++i) {
    by_operator[static_cast<std::size_t>(mutants[i].which)].push_back(i);
  }
  std::array<std::size_t, kOperatorCount> shares{};
  for (std::size_t left = std::min(count, mutants.size()); left > 0;) {
    for (std::size_t o = 0; o < kOperatorCount && left > 0; ++o) {
      if (shares[o] == by_operator[o].size()) continue;
      ++shares[o];
      --left;
    }
  }
  std::vector<std::size_t> chosen;
  for (std::size_t o = 0; o < kOperatorCount; ++o) {
    for (std::size_t i = 0; i < shares[o]; ++i) {
      chosen.push_back(by_operator[o][i * by_operator[o].size() / shares[o]]);
    }
  }
  std::sort(chosen.begin(), chosen.end());
  std::vector<Mutant> sample;
  for (std::size_t i : chosen) sample.push_back(std::move(mutants[i]));
  return sample;
}

Judge::Judge(const Specification& specification)
    : specification_(specification) {
  for (const Question& question : questions_of(specification)) {
    candidates_.push_back({question});
  }
}

std::string Judge::name_of(Question question) const {
  const Harness& harness = *specification_.harnesses[question.harness];
  return harness.file + ": " +
         harness.questions[question.question].properties[0].property->name;
}

Judgement Judge::judge(const Mutant& mutant) {
  auto networks = networks_of(specification_, mutant);
  bool is_taken = false;
  for (std::size_t h = 0; h < networks.size(); ++h) {
    const Network& right = specification_.harnesses[h]->network;
    if (!networks[h]) continue;
    if (takes_changed_edge(*networks[h], mutant, h) ||
        takes_changed_edge(right, mutant, h)) {
      is_taken = true;
    } else {
      networks[h].reset();  // the same graph
    }
  }
  if (!is_taken) return {Fate::NeverTaken, {}};
  if (auto killer = killer_of(networks, Asked::Small)) {
    return {Fate::Killed, *killer};
  }
  bool differs = false;
  for (std::size_t h = 0; h < networks.size(); ++h) {
    if (!networks[h]) continue;
    const Network& right = specification_.harnesses[h]->network;
    if (have_same_runs(right, *networks[h])) {
      networks[h].reset();
    } else {
      differs = true;
    }
  }
  if (!differs) return {Fate::SameRuns, {}};
  if (auto killer = killer_of(networks, Asked::All)) {
    return {Fate::Killed, *killer};
  }
  return {Fate::Survives, {}};
}

std::optional<std::string> Judge::killer_of(
    const std::vector<std::optional<Network>>& networks, Asked asked) {
  for (Candidate& candidate : candidates_) {
    const Question question = candidate.question;
    if (asked == Asked::Small && question.harness > 0 && candidate.kills == 0) {
      continue;
    }
    const auto& network = networks[question.harness];
    if (!network || is_met(*specification_.harnesses[question.harness],
                           question.question, *network)) {
      continue;
    }
    ++candidate.kills;
    std::stable_sort(candidates_.begin(), candidates_.end(),
                     [](const Candidate& one, const Candidate& other) {
                       return one.kills > other.kills;
                     });
    return name_of(question);
  }
  return std::nullopt;
}

std::vector<std::string> Judge::wrong_from_the_start() const {
  std::vector<std::string> wrong;
  for (const Question& question : questions_of(specification_)) {
    const Harness& harness = *specification_.harnesses[question.harness];
    if (!is_met(harness, question.question, harness.network)) {
      wrong.push_back(name_of(question));
    }
  }
  return wrong;
}

}  // namespace btcheck::mutation
