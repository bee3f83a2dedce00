// SPDX-License-Identifier: MIT
#include "check/parts/open_questions.hpp"

#include <algorithm>
#include <cstdint>

namespace btcheck {
namespace {

constexpr std::int32_t kOfNode = 0;
constexpr std::int32_t kOfSighting = 1;

}  // namespace

ContentHash AskedContent::of(NodeId node, std::size_t question) const {
  return content_.of(std::vector<std::int32_t>{
      kOfNode, number(node), static_cast<std::int32_t>(question)});
}

ContentHash AskedContent::of(const Sighting& sighting) const {
  std::vector<std::int32_t> asked = {kOfSighting, number(sighting.node),
                                     static_cast<std::int32_t>(sighting.role)};
  asked.push_back(sighting.retried ? number(*sighting.retried) : -1);
  for (const auto& [node, status] : sighting.with) {
    asked.push_back(content_.number(network_.node_status[index(node)]));
    asked.push_back(static_cast<std::int32_t>(status));
  }
  return content_.of(asked);
}

OpenQuestions::OpenQuestions(const Network& network,
                             const std::vector<Sighting>& sightings,
                             const EarlierRuns* earlier, ComponentStore* known)
    : sightings_(sightings), earlier_(earlier), known_(known) {
  for (const AutomatonId id : network.node_automaton) {
    const Automaton& automaton = network.automaton(id);
    auto& never = never_.emplace_back();
    never.set();
    for (const Edge& edge : automaton.edges) {
      const auto role =
          std::ranges::find(kNodeQuestionRoles, automaton.target(edge).role);
      if (role == kNodeQuestionRoles.end()) continue;
      never.reset(static_cast<std::size_t>(role - kNodeQuestionRoles.begin()));
    }
  }
}

void OpenQuestions::leave_out_shown(QuestionsAsked& asked) const {
  for (std::uint32_t n = 0; n < asked.nodes.size(); ++n) {
    NodeQuestions& open = asked.nodes[n];
    if (open.none()) continue;
    open &= ~never_[n];
    if (earlier_ != nullptr) open &= ~earlier_->shown(NodeId{n});
  }
  if (earlier_ == nullptr) return;
  for (std::size_t i = 0; i < asked.sightings.size(); ++i) {
    if (earlier_->shows(i)) asked.sightings[i] = false;
  }
}

void OpenQuestions::leave_out_known(const AskedContent& network,
                                    QuestionsAsked& asked) {
  if (known_ == nullptr) return;
  for (std::uint32_t n = 0; n < asked.nodes.size(); ++n) {
    for (std::size_t q = 0; q < kNodeQuestionCount; ++q) {
      if (!asked.nodes[n][q] || !known_->find(network.of(NodeId{n}, q))) {
        continue;
      }
      asked.nodes[n].reset(q);
      never_[n].set(q);
    }
  }
  for (std::size_t i = 0; i < asked.sightings.size(); ++i) {
    if (asked.sightings[i] && known_->find(network.of(sightings_[i]))) {
      asked.sightings[i] = false;
    }
  }
}

void OpenQuestions::keep(const AskedContent& network,
                         const DefaultQuestions& searched) {
  const QuestionsAsked& asked = searched.asked;
  for (std::uint32_t n = 0; n < asked.nodes.size(); ++n) {
    for (std::size_t q = 0; q < kNodeQuestionCount; ++q) {
      if (!asked.nodes[n][q] || searched.nodes[n][q]) continue;
      never_[n].set(q);
      if (known_ == nullptr) continue;
      known_->keep(network.of(NodeId{n}, q), nullptr);
    }
  }
  for (std::size_t i = 0; i < asked.sightings.size(); ++i) {
    if (known_ == nullptr || !asked.sightings[i] ||
        searched.sightings.found()[i]) {
      continue;
    }
    known_->keep(network.of(sightings_[i]), nullptr);
  }
}

}  // namespace btcheck
