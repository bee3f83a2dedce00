// SPDX-License-Identifier: MIT
#include "model/btcpp/node_scripts.hpp"

namespace btcheck::btcpp {

NodeScripts::NodeScripts(const BtcppExpansion&) {}
std::vector<StateVariable> NodeScripts::variables() const { return {}; }
Script NodeScripts::script(std::uint32_t, std::string_view) const { return {}; }
Script NodeScripts::equality(std::uint32_t, std::string_view,
                             std::string_view) const {
  return {};
}
Script NodeScripts::assignment(std::uint32_t, std::string_view,
                               std::string_view) const {
  return {};
}
Script NodeScripts::removal(std::uint32_t, std::string_view) const {
  return {};
}

}  // namespace btcheck::btcpp
