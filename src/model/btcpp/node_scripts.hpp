// SPDX-License-Identifier: MIT
//
// The scripts of a tree, over its state variables.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "model/btcpp/expansion.hpp"
#include "model/btcpp/script_domain.hpp"
#include "model/btcpp/script_meaning.hpp"
#include "model/tree.hpp"

namespace btcheck::btcpp {

class NodeScripts {
 public:
  // The expansion must outlive this.
  NodeScripts(const BtcppExpansion& expansion,
              const ContractScripts& contracts);

  // The entries that become state variables; they change where a script says.
  std::vector<StateVariable> variables() const;

  // A condition, or a script whose value does not matter.
  Script condition(std::uint32_t subtree, std::string_view code) const;
  Script action(std::uint32_t subtree, std::string_view code) const;
  // Whether two ports are equal, each a literal or an entry `{name}`. One that
  // cannot be read equals none.
  Script equality(std::uint32_t subtree, std::string_view one,
                  std::string_view other) const;
  Script set_blackboard(const BtcppInstance& node) const;
  Script unset_blackboard(const BtcppInstance& node) const;

  // Why the entry that a name means has no state variable; nothing when it has.
  std::optional<std::string> why_abstracted(std::uint32_t subtree,
                                            std::string_view name) const;

 private:
  const BtcppExpansion& expansion_;
  ScriptWorld world_;
};

}  // namespace btcheck::btcpp
