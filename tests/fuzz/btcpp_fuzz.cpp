// SPDX-License-Identifier: MIT
//
// Fuzzes read_btcpp and expand_btcpp: any bytes give either a tree whose parts
// fit together, or an error.
#include <string>
#include <string_view>

#include "../model/btcpp_consistency.hpp"
#include "fuzzed.hpp"

namespace btcheck {

void check_bytes(std::string_view text) {
  int expanded = 0;
  require_none(flaw_of_reading(text, expanded));
}

}  // namespace btcheck
