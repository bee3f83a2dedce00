// SPDX-License-Identifier: MIT
//
// Property files read and written down again, for the tests.
#pragma once

#include <doctest/doctest.h>

#include <string>
#include <utility>

#include "ltl/rules/property.hpp"

namespace btcheck::test {

inline Result<PropertyFile> read(const std::string& text) {
  return read_properties("p.ltl", text);
}

// All diagnostics as they are shown.
inline std::string findings(const std::string& text) {
  std::string shown;
  for (const Diagnostic& diagnostic : read(text).diagnostics) {
    shown += render(diagnostic);
  }
  return shown;
}

// "BT1201 BT1250", in the order of the text.
inline std::string codes(const std::string& text) {
  std::string all;
  for (const Diagnostic& diagnostic : read(text).diagnostics) {
    all += (all.empty() ? "" : " ") + diagnostic.code;
  }
  return all;
}

inline PropertyFile accepted(const std::string& text) {
  INFO(text);
  INFO(findings(text));
  Result<PropertyFile> result = read(text);
  REQUIRE(result.value.has_value());
  return std::move(*result.value);
}

inline std::string text_of(const PropertyFile& file, FormulaId formula) {
  return file.formulas.text(
      formula, [&](std::uint32_t atom) { return file.atoms[atom].text; });
}

// `response [0,2]: P ~> Q after R`; without a trigger the part up to ~> fails.
inline std::string timed_text(const PropertyFile& file,
                              const TimedClaim& claim) {
  const char* const words[] = {"response", "first response", "absence",
                               "lasting"};
  std::string text = words[static_cast<int>(claim.demand)];
  text += " [" + std::to_string(claim.from) + "," +
          (claim.to == kNoEnd ? "inf" : std::to_string(claim.to)) + "]: ";
  if (claim.trigger) text += text_of(file, *claim.trigger) + " ~> ";
  text += text_of(file, claim.answer);
  if (claim.opening) text += " after " + text_of(file, *claim.opening);
  if (claim.closing) text += " before " + text_of(file, *claim.closing);
  return text + (claim.must_open ? " at least once" : "");
}

// The form and its formulas in one line: `response [0,2]: P ~> Q`.
inline std::string meaning(const PropertyFile& file, const Property& property) {
  const std::string formula = text_of(file, property.formula);
  switch (property.form) {
    case PropertyForm::Never:
      return "never: " + formula;
    case PropertyForm::Invariant:
      return "invariant: " + formula;
    case PropertyForm::Possible:
      return "possible: " + formula;
    case PropertyForm::DeadlockFree:
      return "deadlock free";
    case PropertyForm::Ltl:
      return "ltl: " + formula;
    case PropertyForm::Branching:
      return "branching: " + formula;
    case PropertyForm::Timed:
      return timed_text(file, property.timed);
  }
  return "";
}

// What `prove BODY` means.
inline std::string proves(const std::string& body) {
  const PropertyFile file = accepted("prove " + body + "\n");
  REQUIRE(file.properties.size() == 1);
  return meaning(file, file.properties[0]);
}

// The only atom of `prove BODY`.
inline Atom atom_of(const std::string& body) {
  const PropertyFile file = accepted("prove " + body + "\n");
  REQUIRE(file.atoms.size() == 1);
  return file.atoms[0];
}

struct Row {
  std::string text;
  std::string expected;
};

}  // namespace btcheck::test
