// SPDX-License-Identifier: MIT
//
// What a contract says of blackboard entries, in the words of a script at the
// leaf: so names are followed, and values found, as in any other.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "diagnostic.hpp"
#include "model/btf_keywords.hpp"

namespace btcheck::btcpp {

struct NamedEntry {
  std::string name;  // as scripts write it, "level", "@level"
  SourceSpan span;
};

struct ContractScript {
  std::string code;  // "" for none
  std::vector<NamedEntry> entries;
};

// `(and (> level 2) (= mode "auto"))` is `level > 2 && mode == 'auto'`. What
// scripts cannot say is an error, BT1003, BT1004, BT1008, BT1009 or BT1014.
ContractScript condition_script(const btf::Reading& reading, btf::FormId form);

// Of assignments `(:= level 3)`, in their order.
ContractScript effect_script(const btf::Reading& reading,
                             const std::vector<btf::FormId>& effects);

}  // namespace btcheck::btcpp
