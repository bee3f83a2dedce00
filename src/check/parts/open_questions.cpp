// SPDX-License-Identifier: MIT
#include "check/parts/open_questions.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <string>

namespace btcheck {
namespace {

constexpr std::int32_t kOfNode = 0;
constexpr std::int32_t kOfSighting = 1;
constexpr std::int32_t kOfSearch = 2;

// As they lie in memory: only this build, on a machine like this one, reads
// what it has kept.
using Figures = std::array<std::uint64_t, 5>;

std::string bytes_of(const SearchProgress& progress) {
  const auto& [states, expanded, transitions, depth, bytes] = progress;
  const Figures figures{states, expanded, transitions, depth, bytes};
  return {reinterpret_cast<const char*>(figures.data()), sizeof figures};
}

std::optional<SearchProgress> progress_in(const std::string& text) {
  Figures figures{};
  if (text.size() != sizeof figures) return std::nullopt;
  std::memcpy(figures.data(), text.data(), sizeof figures);
  const auto [states, expanded, transitions, depth, bytes] = figures;
  return SearchProgress{states, expanded, transitions, depth, bytes};
}

}  // namespace

ContentHash AskedContent::of(NodeId node, std::size_t question) const {
  return content_.of(std::vector<std::int32_t>{
      kOfNode, number(node), static_cast<std::int32_t>(question)});
}

ContentHash AskedContent::of(const Sighting& sighting) const {
  std::vector<std::int32_t> asked = {kOfSighting};
  put(sighting, asked);
  return content_.of(asked);
}

ContentHash AskedContent::of(const QuestionsAsked& asked,
                             const std::vector<Sighting>& sightings) const {
  std::vector<std::int32_t> all = {kOfSearch};
  for (std::uint32_t n = 0; n < asked.nodes.size(); ++n) {
    if (asked.nodes[n].none()) continue;
    all.push_back(number(NodeId{n}));
    all.push_back(static_cast<std::int32_t>(asked.nodes[n].to_ulong()));
  }
  for (std::size_t i = 0; i < asked.sightings.size(); ++i) {
    if (!asked.sightings[i]) continue;
    std::vector<std::int32_t> one;
    put(sightings[i], one);
    all.push_back(-2);  // no node has this number
    all.push_back(static_cast<std::int32_t>(one.size()));
    all.insert(all.end(), one.begin(), one.end());
  }
  return content_.of(all);
}

void AskedContent::put(const Sighting& sighting,
                       std::vector<std::int32_t>& to) const {
  to.push_back(number(sighting.node));
  to.push_back(static_cast<std::int32_t>(sighting.role));
  to.push_back(sighting.retried ? number(*sighting.retried) : -1);
  for (const auto& [node, status] : sighting.with) {
    to.push_back(content_.number(network_.node_status[index(node)]));
    to.push_back(static_cast<std::int32_t>(status));
  }
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
  QuestionsAsked in_vain = searched.asked;
  for (std::uint32_t n = 0; n < in_vain.nodes.size(); ++n) {
    for (std::size_t q = 0; q < kNodeQuestionCount; ++q) {
      if (searched.nodes[n][q]) in_vain.nodes[n].reset(q);
    }
  }
  for (std::size_t i = 0; i < in_vain.sightings.size(); ++i) {
    if (searched.sightings.found()[i]) in_vain.sightings[i] = false;
  }
  take_over(network, in_vain);
}

// What is asked of the tree, and who is left running, are questions of more
// than the content.
std::optional<SearchProgress> OpenQuestions::in_vain(
    const AskedContent& network, const QuestionsAsked& asked) const {
  if (known_ == nullptr || asked.of_tree || asked.left_running) {
    return std::nullopt;
  }
  const auto bytes = known_->find_bytes(network.of(asked, sightings_));
  return bytes ? progress_in(*bytes) : std::nullopt;
}

void OpenQuestions::take_over(const AskedContent& network,
                              const QuestionsAsked& asked) {
  for (std::uint32_t n = 0; n < asked.nodes.size(); ++n) {
    for (std::size_t q = 0; q < kNodeQuestionCount; ++q) {
      if (!asked.nodes[n][q]) continue;
      never_[n].set(q);
      if (known_ != nullptr) known_->keep(network.of(NodeId{n}, q), nullptr);
    }
  }
  for (std::size_t i = 0; i < asked.sightings.size(); ++i) {
    if (known_ == nullptr || !asked.sightings[i]) continue;
    known_->keep(network.of(sightings_[i]), nullptr);
  }
}

void OpenQuestions::share_in_vain(const AskedContent& network,
                                  const QuestionsAsked& asked,
                                  const SearchProgress& progress) const {
  if (known_ == nullptr || asked.of_tree || asked.left_running) return;
  known_->share_bytes(network.of(asked, sightings_), bytes_of(progress));
}

}  // namespace btcheck
