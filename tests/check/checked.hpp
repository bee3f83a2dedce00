// SPDX-License-Identifier: MIT
//
// Trees and properties read, lowered and bound, for the tests of the checker.
#pragma once

#include <doctest/doctest.h>

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "check/search/engine.hpp"
#include "explore/reduce/labels.hpp"
#include "explore/search/reachability.hpp"
#include "explore/state/step.hpp"
#include "ltl/rules/property.hpp"
#include "model/automata/network.hpp"
#include "model/btf_text.hpp"
#include "model/lowering.hpp"

namespace btcheck {

// A tree with its network, compiled. It stays where it is.
struct Lowered {
  explicit Lowered(std::string_view text,
                   TickSemantics ticks = TickSemantics::Root)
      : tree(tree_of(text)), network(lower(tree, ticks)), system(network) {}
  Lowered(const Lowered&) = delete;
  Lowered& operator=(const Lowered&) = delete;

  BehaviorTree tree;
  Network network;
  CompiledNetwork system;
};

inline std::string codes_of(const std::vector<Diagnostic>& findings) {
  std::string codes;
  for (const Diagnostic& found : findings) {
    codes += (codes.empty() ? "" : " ") + found.code;
  }
  return codes;
}

inline std::string shown(const std::vector<Diagnostic>& findings) {
  std::string text;
  for (const Diagnostic& found : findings) text += render(found);
  return text;
}

// The text of a predicate: `p`, or `p | q` where q counts in dead states.
inline std::string predicate_text(const Network& network,
                                  const StatePredicate& predicate) {
  std::string text = expression_text(network, predicate.expression);
  if (predicate.when_dead) {
    text += " | " + expression_text(network, *predicate.when_dead);
  }
  return text;
}

inline PropertyFile properties_of(const std::string& text) {
  auto read = read_properties("p.ltl", text);
  INFO(text);
  INFO(shown(read.diagnostics));
  REQUIRE(read.value.has_value());
  return std::move(*read.value);
}

// The only atom of `never ATOM`, bound: its predicate's text, then the codes of
// what was found.
inline std::string bound(const Lowered& model, const std::string& atom) {
  const std::string text = "prove never " + atom + "\n";
  const PropertyFile file = properties_of(text);
  REQUIRE(file.atoms.size() == 1);
  const SourceText source("p.ltl", text);
  std::vector<Diagnostic> findings;
  const auto predicate =
      Binder(model.tree, model.network, source, findings).bind(file.atoms[0]);
  CHECK(predicate.has_value() == !has_error(findings));
  std::string result =
      predicate ? predicate_text(model.network, *predicate) : "";
  if (!findings.empty()) result += " !" + codes_of(findings);
  return result;
}

// The diagnostics of the same, as they are shown.
inline std::string complaint(const Lowered& model, const std::string& atom) {
  const std::string text = "prove never " + atom + "\n";
  const PropertyFile file = properties_of(text);
  const SourceText source("p.ltl", text);
  std::vector<Diagnostic> findings;
  for (const Atom& each : file.atoms) {
    Binder(model.tree, model.network, source, findings).bind(each);
  }
  return shown(findings);
}

// A tree that waits, looks and acts, in a world that moves by itself.
inline constexpr std::string_view kWaitingTree =
    "(defsv w :states (Calm Storm))"
    "(BehaviorTree :name t (Sequence :name s (Wait :name z :duration 2)"
    " (Eval :name e (= w Calm)) (Action :ID a)))";

// The predicate of a condition on single states.
inline StatePredicate predicate(const Lowered& model, const std::string& text) {
  const PropertyFile file = properties_of("prove never " + text + "\n");
  const std::string source = "prove never " + text + "\n";
  auto made =
      bind_properties(model.tree, model.network, file,
                      SourceText("p.ltl", source), ExtraAssumption::None);
  REQUIRE(made.value.has_value());
  return made.value->properties[0].predicate;
}

// The shortest run to a state that satisfies the predicate, as searches tell
// it.
inline Lasso found_run(const Lowered& model, const StatePredicate& goal) {
  struct Goal : ReachabilityVisitor {
    Goal(const CompiledNetwork& system, const StatePredicate& goal)
        : labels(system, {goal}) {}
    GoOn expanded(StateId id, StateView state, bool is_dead) {
      if (!labels.holds(0, state, is_dead)) return GoOn::Yes;
      found = id;
      return GoOn::No;
    }
    LabelledNetwork labels;
    std::optional<StateId> found;
  };
  const Limits limits;
  BreadthFirst search(model.system, limits);
  Goal visitor(model.system, goal);
  search.run(visitor);
  REQUIRE(visitor.found.has_value());
  return {search.path_to(*visitor.found), {}, {}};
}

// A property file checked against a tree.
struct Verified {
  Verified(const Lowered& model, const std::string& text,
           SearchChoices choices = {}, const Limits& limits = {})
      : file(properties_of(text)) {
    auto made =
        bind_properties(model.tree, model.network, file,
                        SourceText("p.ltl", text), ExtraAssumption::None);
    INFO(shown(made.diagnostics));
    REQUIRE(made.value.has_value());
    bound = std::move(*made.value);
    verdicts = verify(model.system, bound, choices, limits).verdicts;
    REQUIRE(verdicts.size() == file.properties.size());
    for (const PropertyVerdict& verdict : verdicts) {
      CHECK(verdict.error == "");
    }
  }

  PropertyFile file;
  BoundFile bound;
  std::vector<PropertyVerdict> verdicts;
};

}  // namespace btcheck
