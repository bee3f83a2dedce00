// SPDX-License-Identifier: MIT
//
// What each node type of .btf files does (docs/semantics.md, section 4).
#pragma once

#include "model/automata/builder.hpp"

namespace btcheck::mapping {

extern const Family kLeafDrawings;
extern const Family kControlDrawings;
extern const Family kDecoratorDrawings;

}  // namespace btcheck::mapping
