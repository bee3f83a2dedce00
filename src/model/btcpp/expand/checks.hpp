// SPDX-License-Identifier: MIT
//
// Checks of an expanded tree: its ports, scripts and blackboards.
#pragma once

#include <string>
#include <string_view>

#include "model/btcpp/expand/expansion.hpp"
#include "model/btcpp/findings.hpp"

namespace btcheck::btcpp {

// Ports and scripts of each node. A tree that nothing uses is not checked;
// BehaviorTree.CPP does not check it either.
void check_nodes(const BtcppExpansion& expansion, FileFindings& findings);

// Entries of two types, without a writer or a reader, or with a name that looks
// misspelt.
void check_blackboard(const BtcppExpansion& expansion, FileFindings& findings);

// Whether the attributes of a SubTree name entries around it, whatever they
// look like: that of version 3, but not its SubTreePlus
// (XMLParser::recursivelyCreateTree of BehaviorTree.CPP 3.8.8).
bool passes_names(const BtcppDocument& document, const BtcppNode& node);

// A name without its capitals and underscores.
std::string folded_name(std::string_view name);

// Whether the names differ by one slip of the finger: a letter too many, too
// few or wrong, or two in the wrong order. Digits and a plural `s` tell names
// apart on purpose, and names below five letters are too short to judge.
bool is_one_slip(std::string_view left, std::string_view right);

// Whether the names look as if one was meant for the other, where something
// speaks for that already: up to two slips, or one begins or ends with the
// other. Digits, and words of up to three letters (min and max), tell apart.
bool is_similar(std::string_view left, std::string_view right);

}  // namespace btcheck::btcpp
