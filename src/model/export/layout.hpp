// SPDX-License-Identifier: MIT
//
// Exported models as texts: comments, long lines broken, and formulas in which
// p0, p1, … stand for propositions.
#pragma once

#include <cstddef>
#include <functional>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "model/automata/network.hpp"
#include "model/tree/tree.hpp"

namespace btcheck {

// The text as it may stand within a comment of C, or in one that ends with its
// line: control characters and backslashes become blanks.
std::string comment_text(std::string_view text);

// How the numbers of state variables are counted, a line for each that has
// steps; each begins with `margin`.
std::string scale_lines(const BehaviorTree& tree, std::string_view margin);

// A comment of several lines without its end: the file, the tick semantics,
// and a line for each node, indented by its depth, with the line where it was
// written, its type and its unique name. `begin` stands before the first line,
// `margin` before all others.
std::string model_heading(const BehaviorTree& tree, TickSemantics ticks,
                          std::string_view begin, std::string_view margin);
// A comment for each of the remarks.
std::string remark_lines(const std::vector<std::string>& remarks,
                         std::string_view begin, std::string_view end);
// The automaton's step: "c: start_ -> tick_node, is called".
std::string edge_remark(const Automaton& automaton, const Edge& edge);

// The formula with each p0, p1, … replaced by what `text` makes of its number.
// Only a whole word counts: `xp0` stays.
std::string with_propositions(
    std::string_view formula,
    const std::function<std::string(std::size_t)>& text);

// The text in lines of at most 78 characters, broken after any of these joints.
// A joint ends with a blank, which is left out at a break. Each line but the
// last ends with `line_end`; each but the first begins with `indent` blanks.
std::string filled(std::string_view text, std::size_t indent,
                   std::string_view line_end,
                   std::initializer_list<std::string_view> joints);

// Appends `more`, with the joint in between if neither text is empty.
void append(std::string& text, std::string_view joint, std::string_view more);

}  // namespace btcheck
