// SPDX-License-Identifier: MIT
//
// Conditions on a network's states as Fiacre observes them.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "model/export/fiacre/language.hpp"

namespace btcheck {

// The condition in terms of `COMPONENT/k/state S` and `COMPONENT/k/value (E)`,
// k being a process's number. Nothing when a comparison reads variables that no
// single process sees, or calculates with what is kept in states.
std::optional<std::string> fiacre_observation(const FiacreLanguage& language,
                                              std::string_view component,
                                              const Expression& condition);

}  // namespace btcheck
