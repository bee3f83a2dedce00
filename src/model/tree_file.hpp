// SPDX-License-Identifier: MIT
//
// A file with a tree, in either of the two languages.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "model/btcpp/document.hpp"
#include "model/btcpp/expand/expansion.hpp"
#include "model/tree/tree.hpp"
#include "text/diagnostic.hpp"

namespace btcheck {

namespace btcpp {
struct LeafContracts;
}

class UnknownLeaves;

// How a tree is read. All but `profile`, `tick_ms` and `loops` is for XML
// trees.
struct TreeReading {
  // Nothing: `paper` for a .btf, else by the version of the file and the nodes
  // in it.
  std::optional<Profile> profile;
  bool is_guess = false;            // the profile: nobody has named it
  int tick_ms = 100;                // what one tick of the root takes
  bool loops = false;               // ticked again after it has ended
  bool wakes = false;               // ticked by tickOnce
  std::string main_tree;            // its ID; "": as the file says
  std::vector<InputFile> models;    // more <TreeNodesModel>
  std::vector<InputFile> leaves;    // leaf contracts
  std::vector<InputFile> included;  // what <include> may ask for, by its name
  // The share folders of ROS packages, by their names.
  std::map<std::string, std::string, std::less<>> packages;
  // Files around the tree's: their trees may be used without an <include>, and
  // their models count where nothing else has the type.
  std::vector<InputFile> neighbours;
  // Of trees that are taken from one of these, another file that has one, and
  // is as near; by the tree's ID.
  std::map<std::string, std::string, std::less<>> as_near;
  // Names and types of leaves of the trees around it, which contracts may be
  // about.
  std::set<std::string> other_leaves;
  btcpp::ScriptDetail detail;  // of blackboard entries
  // Entries that nothing in the tree reads: no rule or contract reads any.
  bool tells_unread = false;
};

// "patrol.xml", "robot.btproj".
bool is_xml_name(std::string_view name);
// The same of a tree whose name need not say it, that of standard input for
// instance: XML begins with `<`, and .btf never does.
bool is_xml(std::string_view name, std::string_view text);
// One of these, or a .btf.
bool is_tree_name(std::string_view name);

// The name of a file that `from` includes as `path`.
std::string included_name(std::string_view from, std::string_view path);
// The same where it lies in the share folder of a ROS package.
std::string packaged_name(std::string_view folder, std::string_view path);

// Reads a .btf file, or XML of BehaviorTree.CPP.
Result<BehaviorTree> read_tree(const std::string& name, const FileText& text,
                               const TreeReading& reading);

// An XML tree and all that it includes as it was written, by the same reading.
Result<BtcppDocument> read_tree_document(const std::string& name,
                                         const FileText& text,
                                         const TreeReading& reading);

// Reads an XML tree and all that it includes, and adds the leaves of which
// nothing is known.
std::vector<Diagnostic> add_unknown_leaves(const std::string& name,
                                           const FileText& text,
                                           const TreeReading& reading,
                                           UnknownLeaves& to);

// Reads files of leaf contracts beside an XML tree, in their order.
Result<btcpp::LeafContracts> read_leaf_files(
    const std::vector<InputFile>& files, int tick_ms = 100);

}  // namespace btcheck
