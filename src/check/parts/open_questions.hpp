// SPDX-License-Identifier: MIT
//
// Which questions of a report have to be searched for, part by part.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "check/findings/suspicion.hpp"
#include "check/parts/earlier_runs.hpp"
#include "check/questions/default_questions.hpp"
#include "check/questions/witnesses.hpp"
#include "explore/components/component_store.hpp"
#include "explore/components/network_content.hpp"
#include "explore/state/limits.hpp"
#include "model/automata/network.hpp"

namespace btcheck {

// A network in which parts are asked for, by content: in equal ones equal
// questions have equal answers.
class AskedContent {
 public:
  // The network must outlive this.
  explicit AskedContent(const Network& network)
      : network_(network), content_(network) {}

  ContentHash of(NodeId node, std::size_t question) const;
  ContentHash of(const Sighting& sighting) const;
  // Of all that is asked of single nodes, in one search.
  ContentHash of(const QuestionsAsked& asked,
                 const std::vector<Sighting>& sightings) const;

 private:
  void put(const Sighting& sighting, std::vector<std::int32_t>& to) const;
  std::int32_t number(NodeId node) const {
    return content_.number(network_.node_automaton[index(node)]);
  }

  const Network& network_;
  NetworkContent content_;
};

// What is open: neither shown by a run that is known already, nor known never
// to be.
class OpenQuestions {
 public:
  // `earlier`: runs of the whole that are known; may be null. `known`: the
  // contents and questions of which a search has found nothing; may be null.
  // All must outlive this.
  OpenQuestions(const Network& network, const std::vector<Sighting>& sightings,
                const EarlierRuns* earlier, ComponentStore* known);

  // Leaves out of what is asked what runs show, and what nodes cannot do.
  void leave_out_shown(QuestionsAsked& asked) const;
  // What is never found in the network, as a search has found out before.
  void leave_out_known(const AskedContent& network, QuestionsAsked& asked);
  // What a complete search of the network has been asked for in vain is known
  // from then on.
  void keep(const AskedContent& network, const DefaultQuestions& searched);

  // How far a complete search of the network came that was asked all that, and
  // nothing else, in vain: in another process, where what is known is kept for
  // others. What it was asked for is known then as if it had been here.
  std::optional<SearchProgress> in_vain(const AskedContent& network,
                                        const QuestionsAsked& asked) const;
  void take_over(const AskedContent& network, const QuestionsAsked& asked);
  void share_in_vain(const AskedContent& network, const QuestionsAsked& asked,
                     const SearchProgress& progress) const;

  const NeverDone& never() const { return never_; }

 private:
  const std::vector<Sighting>& sightings_;
  const EarlierRuns* earlier_;
  ComponentStore* known_;
  NeverDone never_;
};

}  // namespace btcheck
