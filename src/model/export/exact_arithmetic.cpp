// SPDX-License-Identifier: MIT
//
// Promela, SMV and Fiacre compute in 32 bits. A model that says something else
// than ours would be worse than none, so an expression that could leave them is
// refused; one finding for each automaton is enough.
#include "model/export/exact_arithmetic.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace btcheck {
namespace {

Diagnostic refusal(const BehaviorTree& tree, const Network& network,
                   const Expression& expression, std::string_view owner,
                   std::string_view language) {
  constexpr std::size_t kLongest = 100;
  std::string shown = expression_text(network, expression);
  if (shown.size() > kLongest) shown = shown.substr(0, kLongest) + "…";
  Diagnostic finding;
  finding.code = "BT0005";
  finding.message = fmt::format(
      "`{}`, in {}, may leave the 32 bits of {}'s int", shown, owner, language);
  finding.file = tree.file;
  finding.help = "give its variables smaller ranges";
  return finding;
}

std::string owner_text(const BehaviorTree& tree, const Automaton& automaton) {
  if (automaton.kind == AutomatonKind::StateVariable) {
    return fmt::format("`{}`", automaton.name);
  }
  return fmt::format("`{}` on line {}", automaton.name,
                     tree.node(automaton.node).span.line);
}

std::vector<Expression> expressions_of(const Automaton& automaton) {
  std::vector<Expression> expressions;
  for (const Edge& edge : automaton.edges) {
    expressions.push_back(edge.guard);
    for (const Assignment& update : edge.updates) {
      expressions.push_back(update.value);
    }
  }
  return expressions;
}

}  // namespace

std::vector<Diagnostic> inexpressible(
    const BehaviorTree& tree, const Network& network,
    const std::vector<NamedPredicates>& named,
    const std::function<bool(const Expression&)>& is_exact,
    std::string_view language) {
  std::vector<Diagnostic> found;
  auto ask = [&](const std::vector<Expression>& expressions,
                 const std::string& owner) {
    const auto first = std::ranges::find_if_not(expressions, is_exact);
    if (first == expressions.end()) return;
    found.push_back(refusal(tree, network, *first, owner, language));
  };
  for (const Automaton& automaton : network.automata) {
    ask(expressions_of(automaton), owner_text(tree, automaton));
  }
  for (const NamedPredicates& claim : named) {
    ask(claim.predicates, "`" + claim.name + "`");
  }
  return found;
}

}  // namespace btcheck
