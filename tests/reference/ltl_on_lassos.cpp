// SPDX-License-Identifier: MIT
//
// Linear temporal logic on ultimately periodic words, from its definition.
//
// A lasso has finitely many positions that differ, and from each the whole
// rest of the word is seen within as many steps as there are positions. So
// each operator is its definition with "at some later position" read as "at
// one of the next size() positions"; no fixpoints, no rewriting, no automata.
#include "reference/ltl_on_lassos.hpp"

#include "reference/fair_graph.hpp"

namespace btcheck::reference {

namespace {

using Truth = std::vector<bool>;  // by position

// `left` until `right` at a position; `at_end` is the answer when `right` does
// not come and `left` does not end.
bool until(const LassoWord& word, const Truth& left, const Truth& right,
           std::size_t position, bool at_end) {
  for (std::size_t i = 0; i < word.size(); ++i) {
    if (right[position]) return true;
    if (!left[position]) return false;
    position = word.after(position);
  }
  return at_end;
}

Truth negated(Truth truth) {
  truth.flip();
  return truth;
}

bool holds_at(const FormulaNode& node, const LassoWord& word, std::size_t at,
              const Truth& left, const Truth& right) {
  const Truth everywhere(word.size(), true);
  const Truth nowhere(word.size(), false);
  switch (node.kind) {
    case FormulaKind::True:
      return true;
    case FormulaKind::False:
      return false;
    case FormulaKind::Atom:
      return (word.at(at) >> node.atom & 1) != 0;
    case FormulaKind::Not:
      return !left[at];
    case FormulaKind::And:
      return left[at] && right[at];
    case FormulaKind::Or:
      return left[at] || right[at];
    case FormulaKind::Implies:
      return !left[at] || right[at];
    case FormulaKind::Equivalent:
      return left[at] == right[at];
    case FormulaKind::Next:
      return left[word.after(at)];
    case FormulaKind::Eventually:
      return until(word, everywhere, left, at, false);
    case FormulaKind::Always:
      return until(word, left, nowhere, at, true);
    case FormulaKind::Until:
      return until(word, left, right, at, false);
    case FormulaKind::WeakUntil:
      return until(word, left, right, at, true);
    case FormulaKind::Release:
      return !until(word, negated(left), negated(right), at, false);
    case FormulaKind::ExistsPath:
    case FormulaKind::ForAllPaths:
      break;  // not a question about one word
  }
  return false;
}

}  // namespace

PropositionSet LassoWord::at(std::size_t position) const {
  return position < prefix.size() ? prefix[position]
                                  : cycle[position - prefix.size()];
}

std::size_t LassoWord::after(std::size_t position) const {
  return position + 1 < size() ? position + 1 : prefix.size();
}

bool holds(const FormulaPool& pool, FormulaId id, const LassoWord& word) {
  std::vector<Truth> truth(index(id) + 1, Truth(word.size()));
  for (const FormulaId inner : pool.nodes(id)) {
    const FormulaNode& node = pool[inner];
    for (std::size_t at = 0; at < word.size(); ++at) {
      truth[index(inner)][at] = holds_at(
          node, word, at, truth[index(node.left)], truth[index(node.right)]);
    }
  }
  return truth[index(id)][0];
}

bool accepts(const BuchiAutomaton& automaton, const LassoWord& word) {
  if (automaton.is_empty()) return false;
  FairGraph graph;
  graph.steps.resize(automaton.state_count() * word.size());
  graph.all_sets = automaton.all_sets();
  for (std::size_t state = 0; state < automaton.state_count(); ++state) {
    for (std::size_t at = 0; at < word.size(); ++at) {
      for (const BuchiTransition& t : automaton.transitions[state]) {
        if (!t.reads(word.at(at))) continue;
        graph.steps[state * word.size() + at].push_back(
            {t.target * word.size() + word.after(at), t.accepting});
      }
    }
  }
  return states_with_fair_run(graph)[automaton.initial * word.size()];
}

}  // namespace btcheck::reference
