// SPDX-License-Identifier: MIT
//
// How nodes compare the values of two ports.
#pragma once

#include <cstdint>

#include "model/btcpp/script/value.hpp"

namespace btcheck::btcpp {

enum class PortComparison : std::uint8_t {
  Switch,  // of 4.10 (details::CheckStringEquality): texts, or the numbers that
           // they are
  Text,    // Switch of 3.8, BlackboardCheckString
  Int,     // BlackboardCheckInt, …: what cannot be read equals nothing
  Double,
  Bool
};

// Whether two values may be equal, and whether they may differ.
struct Equality {
  bool may_hold = false;
  bool may_fail = false;
};

// Compares the values of two entries; a literal is a text. Enumerations that
// the program registers are not known.
Equality compared(PortComparison how, const ScriptValue& one,
                  const ScriptValue& other);

}  // namespace btcheck::btcpp
