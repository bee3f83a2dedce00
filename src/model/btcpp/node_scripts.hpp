// SPDX-License-Identifier: MIT
//
// The scripts of a tree, over its state variables.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "model/btcpp/expansion.hpp"
#include "model/tree.hpp"

namespace btcheck::btcpp {

// Entries that scripts alone write are state variables; what is said of others
// may go either way.
class NodeScripts {
 public:
  // The expansion must outlive this.
  explicit NodeScripts(const BtcppExpansion& expansion);

  std::vector<StateVariable> variables() const;

  Script script(std::uint32_t subtree, std::string_view code) const;
  // Whether two ports are equal, each a literal or an entry `{name}`.
  Script equality(std::uint32_t subtree, std::string_view one,
                  std::string_view other) const;
  // An entry is set to a literal or a copy of `{name}`; is removed.
  Script assignment(std::uint32_t subtree, std::string_view entry,
                    std::string_view value) const;
  Script removal(std::uint32_t subtree, std::string_view entry) const;
};

}  // namespace btcheck::btcpp
