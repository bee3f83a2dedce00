// SPDX-License-Identifier: MIT
//
// The steps of a network as the loop of one Promela process.
#pragma once

#include <string>
#include <string_view>

#include "model/automata/network.hpp"
#include "model/export/promela/names.hpp"

namespace btcheck {

// Whether the variable `progress` tells the moves of free variables from all
// other steps.
enum class PromelaProgress : std::uint8_t { Untold, Told };

// The macros timer_is_due, may_move, is_urgent, …, and the process. The
// variables and clocks are declared before it.
std::string promela_process(const Network& network, const PromelaNames& names,
                            PromelaProgress progress);

// `#define NAME (BODY)`, the body broken into lines.
std::string promela_macro(std::string_view name, std::string_view body);

}  // namespace btcheck
