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
                             const DefaultQuestions* shown,
                             ComponentStore* known)
    : sightings_(sightings), shown_(shown), known_(known) {
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

bool OpenQuestions::is_open(NodeId node, std::size_t question) const {
  return !never_[index(node)][question] &&
         !(shown_ != nullptr && shown_->nodes[index(node)][question]);
}

bool OpenQuestions::is_any_open(NodeId node) const {
  for (std::size_t q = 0; q < kNodeQuestionCount; ++q) {
    if (is_open(node, q)) return true;
  }
  return false;
}

template <class Visit>
void OpenQuestions::for_each_open(const QuestionsAsked& asked,
                                  Visit&& visit) const {
  for (std::uint32_t n = 0; n < never_.size(); ++n) {
    if (!asked.has_node(NodeId{n})) continue;
    for (std::size_t q = 0; q < kNodeQuestionCount; ++q) {
      if (is_open(NodeId{n}, q)) visit(NodeId{n}, q);
    }
  }
}

void OpenQuestions::leave_out_shown(QuestionsAsked& asked) const {
  for (std::uint32_t n = 0; n < asked.nodes.size(); ++n) {
    if (asked.nodes[n]) asked.nodes[n] = is_any_open(NodeId{n});
  }
  if (shown_ == nullptr) return;
  for (std::size_t i = 0; i < asked.sightings.size(); ++i) {
    if (shown_->sightings.found()[i]) asked.sightings[i] = false;
  }
}

void OpenQuestions::leave_out_known(const AskedContent& network,
                                    QuestionsAsked& asked) {
  if (known_ == nullptr) return;
  for_each_open(asked, [&](NodeId node, std::size_t question) {
    if (known_->find(network.of(node, question))) {
      never_[index(node)].set(question);
    }
  });
  for (std::uint32_t n = 0; n < asked.nodes.size(); ++n) {
    if (asked.nodes[n]) asked.nodes[n] = is_any_open(NodeId{n});
  }
  for (std::size_t i = 0; i < asked.sightings.size(); ++i) {
    if (asked.sightings[i] && known_->find(network.of(sightings_[i]))) {
      asked.sightings[i] = false;
    }
  }
}

void OpenQuestions::keep(const AskedContent& network,
                         const DefaultQuestions& searched) {
  if (known_ == nullptr) return;
  for_each_open(searched.asked, [&](NodeId node, std::size_t question) {
    if (searched.nodes[index(node)][question]) return;
    known_->keep(network.of(node, question), nullptr);
  });
  for (std::size_t i = 0; i < sightings_.size(); ++i) {
    if (!searched.asked.has_sighting(i) || searched.sightings.found()[i]) {
      continue;
    }
    known_->keep(network.of(sightings_[i]), nullptr);
  }
}

}  // namespace btcheck
