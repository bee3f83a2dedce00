// SPDX-License-Identifier: MIT
//
// Names and expressions of a network as SMV writes them. An enumeration of SMV
// has no order and is no number: where a number is asked for, it is told case
// by case.
#include "model/export/smv/language.hpp"

#include <fmt/format.h>

#include "model/export/filled_lines.hpp"

namespace btcheck {

std::string SmvLanguage::number_of(VariableId id) const {
  const Variable& read = network_.variable(id);
  std::string text = "(case ";
  for (int value = read.min; value < read.max; ++value) {
    text += fmt::format("{} = {} : {}; ", names_.variable(id),
                        names_.value(id, value), value);
  }
  return text + fmt::format("TRUE : {}; esac)", read.max);
}

std::string SmvLanguage::value_of(VariableId id,
                                  const std::string& number) const {
  const Variable& read = network_.variable(id);
  std::string text = "(case ";
  for (int value = read.min; value < read.max; ++value) {
    text +=
        fmt::format("({}) = {} : {}; ", number, value, names_.value(id, value));
  }
  return text + fmt::format("TRUE : {}; esac)", names_.value(id, read.max));
}

std::string SmvLanguage::is_at(const Automaton& automaton,
                               LocationId location) const {
  const int value = network_.variable(automaton.location).min +
                    static_cast<int>(index(location));
  return names_.variable(automaton.location) + " = " +
         names_.value(automaton.location, value);
}

std::string smv_lines(std::string_view text, std::size_t indent) {
  return filled(text, indent, "", {" & ", " | "});
}

}  // namespace btcheck
