// SPDX-License-Identifier: MIT
//
// The steps of a network as constraints of an SMV module.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "model/automata/network.hpp"
#include "model/export/promela/names.hpp"

namespace btcheck {

// Whether the variable `progress` tells the moves of free variables from all
// other steps.
enum class SmvProgress : std::uint8_t { Untold, Told };

// The value of the input variable `step` that stands for an edge.
std::string smv_step(std::uint32_t edge);
inline constexpr const char* kSmvTimeStep = "time_passes";

// The condition `step in {…}`; FALSE when there is none.
std::string smv_step_among(const std::vector<std::uint32_t>& edges);

// The numbers of all moves of free variables.
std::vector<std::uint32_t> free_moves(const Network& network);

// The declaration of `step`, the definitions that say when each step may be
// taken, and for each variable what it is afterwards.
std::string smv_steps(const Network& network, const PromelaNames& names,
                      SmvProgress progress);

// The definition of `is_dead`: no step but an idle one leads from the state.
std::string smv_death(const Network& network, const PromelaNames& names);

}  // namespace btcheck
