// SPDX-License-Identifier: MIT
//
// Names and expressions of a network as SMV writes them.
#pragma once

#include <string>
#include <string_view>

#include "model/export/promela/names.hpp"
#include "model/export/typed_expression.hpp"

namespace btcheck {

class SmvLanguage final : public TypedLanguage {
 public:
  // Both must outlive it.
  SmvLanguage(const Network& network, const PromelaNames& names)
      : network_(network), names_(names) {}

  Signs signs() const override {
    return {" & ", " | ", "!", " != ", " mod ", "TRUE", "FALSE"};
  }
  std::string variable(VariableId id) const override {
    return names_.variable(id);
  }
  bool is_enumeration(VariableId id) const override {
    return names_.has_named_values(id);
  }
  std::string value(VariableId id, int value) const override {
    return names_.value(id, value);
  }
  std::string number_of(VariableId id) const override;
  std::string value_of(VariableId id, const std::string& number) const override;

  std::string condition(const Expression& expression) const {
    return typed_condition(network_, *this, expression).text;
  }
  std::string assigned(const Expression& expression, VariableId to) const {
    return typed_value(network_, *this, expression, to).text;
  }
  // `location = land_btn12_at_tick_node`.
  std::string is_at(const Automaton& automaton, LocationId location) const;

 private:
  const Network& network_;
  const PromelaNames& names_;
};

// Broken into lines after & and |; lines but the first begin with `indent`
// blanks.
std::string smv_lines(std::string_view text, std::size_t indent);

}  // namespace btcheck
