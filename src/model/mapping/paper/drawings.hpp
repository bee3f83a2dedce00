// SPDX-License-Identifier: MIT
//
// What each node type of .btf files does (docs/semantics.md, section 4).
#pragma once

#include "model/automata/builder.hpp"

namespace btcheck::mapping {

// One per family; each draws the automaton of one node, frame included.
void draw_action(NodeBuilder& draw);
void draw_condition(NodeBuilder& draw);
void draw_set_state_variable(NodeBuilder& draw);
void draw_eval(NodeBuilder& draw);
void draw_wait(NodeBuilder& draw);
void draw_sequence(NodeBuilder& draw);
void draw_reactive(NodeBuilder& draw);
void draw_parallel(NodeBuilder& draw);
void draw_decorator(NodeBuilder& draw);
void draw_counting_decorator(NodeBuilder& draw);
void draw_rate_controller(NodeBuilder& draw);
void draw_recovery(NodeBuilder& draw);
void draw_round_robin(NodeBuilder& draw);
void draw_pipeline_sequence(NodeBuilder& draw);
void draw_root(NodeBuilder& draw);
// The automaton of an enumerated state variable.
void draw_state_variable(Context& context, StateVariableId variable);

}  // namespace btcheck::mapping
