// SPDX-License-Identifier: MIT
//
// Node types that libraries beside BehaviorTree.CPP and Nav2 bring along: what
// is public of them. Nobody has told what they answer. A program may have a
// type of its own under such a name; so they count where nothing else has the
// type.
#pragma once

#include <span>
#include <string_view>

namespace btcheck::btcpp {

// Names of ports with blanks between them. A port in none of the columns may be
// either.
struct LibraryType {
  std::string_view id;
  std::string_view kind;  // the tag of the explicit form, "Action"
  std::string_view inputs = {};
  std::string_view outputs = {};
  std::string_view both = {};
};

// Those of MoveIt Pro count in the explicit form only, `<Action
// ID="GetImage">`: its editor writes no other.
enum class TypeForm : unsigned char { Compact, Explicit };
const LibraryType* library_type(std::string_view id, TypeForm form);

// Whether one of these columns has the word.
bool has_port(std::string_view column, std::string_view port);

// By library.
std::span<const LibraryType> behaviortree_ros2_types();
std::span<const LibraryType> moveit_pro_data();
std::span<const LibraryType> moveit_pro_motion();
std::span<const LibraryType> moveit_pro_trees();

}  // namespace btcheck::btcpp
