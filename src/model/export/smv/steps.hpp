// SPDX-License-Identifier: MIT
//
// The steps of a network as constraints of an SMV module.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "model/automata/network.hpp"
#include "model/export/language.hpp"
#include "model/export/names.hpp"
#include "model/export/steps.hpp"

namespace btcheck {

// An enumeration of SMV has no order and is no number: where a number is asked
// for, it is told case by case.
class SmvLanguage final : public ExportLanguage {
 public:
  // Both must outlive it.
  SmvLanguage(const Network& network, const ExportNames& names)
      : ExportLanguage(network, names,
                       {"SMV", " & ", " | ", "!", " = ", " != ", " mod ",
                        "TRUE", "FALSE"}) {}

  std::string number_of(VariableId id) const override;
  std::string value_of(VariableId id, const std::string& number) const override;
};

// Broken into lines after & and |; lines but the first begin with `indent`
// blanks.
std::string smv_lines(std::string_view text, std::size_t indent);

inline constexpr const char* kSmvTimeStep = "time_passes";

// The condition that one of these automata takes the step; FALSE when none can.
std::string smv_step_by(const Network& network,
                        const std::vector<AutomatonId>& movers);

// The declaration of `step`, the definitions that say when each step may be
// taken, and for each variable what it is afterwards.
std::string smv_steps(const SmvLanguage& language, Progress progress);

// The definition of `is_dead`: no step but an idle one leads from the state.
std::string smv_death(const SmvLanguage& language);

}  // namespace btcheck
