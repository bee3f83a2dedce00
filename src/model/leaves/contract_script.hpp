// SPDX-License-Identifier: MIT
//
// What a contract says of blackboard entries, in the words of a script at the
// leaf: so names are followed, and values found, as in any other.
#pragma once

#include <optional>
#include <vector>

#include "model/btcpp/tree/leaf_rules.hpp"
#include "model/btf/keywords.hpp"

namespace btcheck::btf {

// `(and (> level 2) (= mode "auto"))` is `level > 2 && mode == 'auto'`. What
// scripts cannot say is an error, BT1002, BT1003, BT1004, BT1008, BT1009 or
// BT1014.
btcpp::ContractScript condition_script(const Reading& reading, FormId form);

// Of assignments `(:= level 3)`, in their order.
btcpp::ContractScript effect_script(const Reading& reading,
                                    const std::vector<FormId>& effects);

// `(defsv level :init 3)`: what an entry holds before the first tick. Nothing
// after an error, BT1005, BT1006, BT1008 or BT1010.
std::optional<btcpp::FirstValue> first_value(const Reading& reading,
                                             FormId form);

}  // namespace btcheck::btf
