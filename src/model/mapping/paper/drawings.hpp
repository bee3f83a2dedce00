// SPDX-License-Identifier: MIT
//
// What each node type of .btf files does (docs/semantics.md, section 4).
#pragma once

#include "model/automata/builder.hpp"

namespace btcheck::mapping {

Family leaf_drawings();
Family control_drawings();
Family decorator_drawings();

}  // namespace btcheck::mapping
