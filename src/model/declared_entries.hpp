// SPDX-License-Identifier: MIT
//
// `defsv` in files of leaf contracts: what a blackboard entry holds at first,
// and what it may hold.
#pragma once

#include <optional>
#include <string_view>

#include "model/btcpp/tree/leaf_rules.hpp"
#include "model/btf/forms.hpp"

namespace btcheck::btf {

// A name as scripts write it, `level` or `@level`.
bool is_entry_name(std::string_view word);

// Reads `(defsv …)`; nothing after an error.
std::optional<btcpp::DeclaredEntry> declared_entry(const Reading& reading,
                                                   FormId form);

}  // namespace btcheck::btf
