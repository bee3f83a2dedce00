// SPDX-License-Identifier: MIT
//
// Any bytes as a property file: an answer or errors, never both, never a crash.
#include <string_view>

#include "fuzzed.hpp"
#include "ltl/formula/formula.hpp"
#include "ltl/rules/property.hpp"

namespace btcheck {
namespace {

void check_formula(const PropertyFile& file, FormulaId formula) {
  require(index(formula) < file.formulas.size());
  const auto atoms = file.formulas.atoms(formula);
  require(atoms.size() <= 64);
  for (const std::uint32_t atom : atoms) require(atom < file.atoms.size());
  const auto text = file.formulas.text(
      formula, [&](std::uint32_t atom) { return file.atoms[atom].text; });
  require(!text.empty());
}

// A condition on single states.
void check_state_formula(const PropertyFile& file, FormulaId formula) {
  check_formula(file, formula);
  require(file.formulas.is_state_formula(formula));
}

void check_timed(const PropertyFile& file, const TimedClaim& claim) {
  check_state_formula(file, claim.answer);
  for (const auto& part : {claim.trigger, claim.opening, claim.closing}) {
    if (part) check_state_formula(file, *part);
  }
  require(0 <= claim.from && claim.from <= claim.to);
}

void check_property(const PropertyFile& file, const Property& property) {
  require(!property.name.empty());
  require(!property.text.empty());
  require(property.span.line > 0);
  check_formula(file, property.formula);
  switch (property.form) {
    case PropertyForm::Ltl:
      return require(!file.formulas.is_branching(property.formula));
    case PropertyForm::Branching:
      return require(!first_non_ctl(file.formulas, property.formula));
    case PropertyForm::Timed:
      return check_timed(file, property.timed);
    default:
      return check_state_formula(file, property.formula);
  }
}

void check_assumption(const PropertyFile& file, const Assumption& assumption) {
  require(!assumption.name.empty());
  check_formula(file, assumption.formula);
  require(!file.formulas.is_branching(assumption.formula));
}

}  // namespace

void check_bytes(std::string_view text) {
  const auto result = read_properties("fuzz.ltl", text);
  require_sound(result);
  require(result.diagnostics.size() <= 40);
  if (!result.value) return;
  require(!result.value->properties.empty());
  for (const Property& property : result.value->properties) {
    check_property(*result.value, property);
  }
  for (const Assumption& assumption : result.value->assumptions) {
    check_assumption(*result.value, assumption);
  }
}

}  // namespace btcheck
