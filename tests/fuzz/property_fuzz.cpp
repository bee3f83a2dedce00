// SPDX-License-Identifier: MIT
//
// Any bytes as a property file: an answer or errors, never both, never a crash.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "ltl/property.hpp"

namespace {

using btcheck::FormulaId;
using btcheck::Property;
using btcheck::PropertyFile;
using btcheck::PropertyForm;

void require(bool condition) {
  if (!condition) std::abort();
}

void check_formula(const PropertyFile& file, FormulaId formula) {
  require(index(formula) < file.formulas.size());
  const auto atoms = file.formulas.atoms(formula);
  require(atoms.size() <= 64);
  for (const std::uint32_t atom : atoms) require(atom < file.atoms.size());
  const auto text = file.formulas.text(
      formula, [&](std::uint32_t atom) { return file.atoms[atom].text; });
  require(!text.empty());
}

void check_property(const PropertyFile& file, const Property& property) {
  require(!property.name.empty());
  require(!property.text.empty());
  require(property.span.line > 0);
  check_formula(file, property.formula);
  check_formula(file, property.answer);
  if (property.form == PropertyForm::Ltl) return;
  require(file.formulas.is_state_formula(property.formula));
  require(file.formulas.is_state_formula(property.answer));
  require(0 <= property.from && property.from <= property.to);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const auto result = btcheck::read_properties("fuzz.ltl", text);
  require(btcheck::has_error(result.diagnostics) != result.value.has_value());
  require(result.diagnostics.size() <= 40);
  for (const auto& diagnostic : result.diagnostics) {
    require(!btcheck::render(diagnostic).empty());
  }
  if (!result.value) return 0;
  require(!result.value->properties.empty());
  for (const Property& property : result.value->properties) {
    check_property(*result.value, property);
  }
  return 0;
}
