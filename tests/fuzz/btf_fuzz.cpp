// SPDX-License-Identifier: MIT
//
// Fuzzes read_btf: any bytes give either a consistent tree or an error.
#include <string>
#include <string_view>

#include "../model/btf_consistency.hpp"
#include "fuzzed.hpp"
#include "model/tree/tree.hpp"

namespace btcheck {

void check_bytes(std::string_view text) {
  require_none(flaw_of(read_btf("fuzz.btf", text)));
}

}  // namespace btcheck
