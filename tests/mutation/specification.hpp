// SPDX-License-Identifier: MIT
//
// The specification of one node type as it lies in properties/: small trees
// and what is asked of them, ready to be asked of other tables as well.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "check/bind/bound_property.hpp"
#include "ltl/rules/property.hpp"
#include "model/automata/network.hpp"

namespace btcheck::mutation {

// One property file with its tree, lowered and bound.
struct Harness {
  std::string file;  // name of the property file
  BehaviorTree tree;
  PropertyFile properties;
  Network network;
  std::vector<BoundFile> questions;  // one property each
  // Every automaton of the folder's type, and those of them that the
  // properties are about: of the node called `it`, or all when there is none.
  std::vector<AutomatonId> of_type;
  std::vector<AutomatonId> subjects;
};

struct Specification {
  std::string name;  // of the folder
  std::vector<std::unique_ptr<Harness>> harnesses;
};

// The folder of a node type: `keep_running_until_failure`.
std::string folder_of(NodeType type);
// The folder of the automata of enumerated state variables.
inline constexpr std::string_view kStateVariableFolder = "state_variable";

// Reads every property file of a folder. A mistake in one is thrown as
// runtime_error.
Specification read_specification(const std::filesystem::path& folder);

// A property, by the places of its harness and in it.
struct Question {
  std::size_t harness = 0;
  std::size_t question = 0;
};
// All of them, in the order of the files and in them.
std::vector<Question> questions_of(const Specification& specification);

// Whether the network answers as the property file expects; false when no
// answer is found among the first 200,000 states.
bool is_met(const Harness& harness, std::size_t question,
            const Network& network);

}  // namespace btcheck::mutation
