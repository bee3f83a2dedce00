// SPDX-License-Identifier: MIT
//
// :args (key value …): what a node is given when it is ticked.
#pragma once

#include "model/btf/expression.hpp"
#include "model/btf/forms.hpp"
#include "model/tree/tree.hpp"

namespace btcheck::btf {

// Gives the arguments of a node their values. `list` is the one after :args.
// Returns what their keys stand for in a SubTree.
Bindings read_arguments(const Scope& scope, FormId list, Node& node);

// True where a word of the form is one of the names.
bool mentions(const Reading& reading, FormId form, const Bindings& bindings);

}  // namespace btcheck::btf
