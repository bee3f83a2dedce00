// SPDX-License-Identifier: MIT
#include "model/automata/faults.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <string>
#include <utility>

namespace btcheck::mapping {
namespace {

constexpr int value_of(FaultPhase phase) { return static_cast<int>(phase); }

}  // namespace

Asked draw_strike(NodeBuilder& draw, LocationId asked, Expression guard) {
  const auto& fault = draw.node().fault;
  if (!fault) return {asked, std::nullopt};
  const FaultFacts& facts = facts_of(fault->kind);
  const VariableId phase = draw.fault_phase();
  const LocationId struck = draw.at("struck");
  const std::string label = "the fault: it " + std::string(facts.told);
  using enum FaultPhase;
  if (facts.strikes == Strikes::Always) {
    draw.edge(asked, struck, std::move(guard), {set(phase, value_of(There))},
              label);
    return {std::nullopt, struck};
  }
  const LocationId well = draw.at("well");
  const bool lasts = facts.strikes == Strikes::FromThenOn;
  const Expression has_struck = equals(phase, value_of(There));
  draw.edge(asked, well, lasts ? negated(has_struck) : Expression{});
  draw.choice(asked, struck,
              both(equals(phase, value_of(NotYet)), std::move(guard)),
              {set(phase, value_of(lasts ? There : Over))}, label);
  if (lasts) draw.edge(asked, struck, has_struck);
  return {well, struck};
}

void draw_other_values(NodeBuilder& draw, LocationId from, LocationId then,
                       const std::vector<Assignment>& effects) {
  const Network& network = draw.context().network;
  for (std::size_t i = 0; i < effects.size(); ++i) {
    const Assignment& effect = effects[i];
    const Variable& variable = network.variable(effect.variable);
    const LocationId next =
        i + 1 == effects.size()
            ? then
            : draw.at(fmt::format("writes_other_{}", i + 1));
    for (int value = variable.min; value <= variable.max; ++value) {
      draw.choice(from, next,
                  Expression::binary(Operation::NotEqual, effect.value,
                                     Expression::constant(value)),
                  {set(effect.variable, value)},
                  fmt::format("the fault: {} := {}", variable.name,
                              variable.value_name(value)));
    }
    from = next;
  }
}

}  // namespace btcheck::mapping
