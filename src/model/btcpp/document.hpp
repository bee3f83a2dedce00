// SPDX-License-Identifier: MIT
//
// Behavior trees in the XML of BehaviorTree.CPP, as their authors wrote them:
// nothing is expanded, remapped or given a meaning yet. After the readers of
// BehaviorTree.CPP 3.8.8 and 4.10.0 (src/xml_parsing.cpp).
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "text/diagnostic.hpp"
#include "text/input_file.hpp"

namespace btcheck {

// Which of the three dialects a file is read in. That of py_trees has the form
// of version 4, and node types of its own.
enum class BtcppRelease : std::uint8_t { V3, V4, PyTrees };

// The newest releases, 4.10.0 as 41000, and of version 3.
inline constexpr int kNewestRelease = 41000;
inline constexpr int kNewestRelease3 = 30808;

// Whether a file of this name is a project of Groot: it lists files with trees,
// and has none.
inline bool is_project_name(std::string_view name) {
  return name.ends_with(".btproj");
}

enum class BtcppKind : std::uint8_t {
  Action,
  Condition,
  Control,
  Decorator,
  SubTree
};
// The tags of the explicit form, indexed by BtcppKind.
inline constexpr std::array<std::string_view, 5> kBtcppKindNames = {
    "Action", "Condition", "Control", "Decorator", "SubTree"};
constexpr std::string_view kind_name(BtcppKind kind) {
  return kBtcppKindNames[static_cast<std::size_t>(kind)];
}
std::optional<BtcppKind> kind_named(std::string_view tag);

// A stretch of one of the files, an index into BtcppDocument::files.
struct BtcppPlace {
  std::uint32_t file = 0;
  SourceSpan span;
};

// name="value", with the entities of the value decoded.
struct BtcppAttribute {
  std::string name;
  std::string value;
  BtcppPlace name_place;
  BtcppPlace place;  // of the value, without its quotes
};

// Attributes that carry a script: four pre- and four postconditions.
inline constexpr std::array<std::string_view, 8> kBtcppConditionNames = {
    "_failureIf", "_successIf", "_skipIf",    "_while",
    "_onHalted",  "_onFailure", "_onSuccess", "_post"};

// One element of a tree.
struct BtcppNode {
  BtcppKind kind = BtcppKind::Action;
  std::string tag;           // "Sequence", or "Control" in the explicit form
  std::string id;            // the node type; of a SubTree, the tree
  std::string name;          // of the instance; "" when none is written
  bool is_explicit = false;  // <Control ID="Sequence">
  // Whether BehaviorTree.CPP, Nav2 or a model in the files has the type. The
  // kind of others is guessed from the number of children.
  bool is_known = false;
  std::vector<BtcppAttribute> ports;       // of a SubTree: its remapping
  std::vector<BtcppAttribute> conditions;  // kBtcppConditionNames
  std::vector<BtcppAttribute> others;      // `_autoremap`, `_description`, …
  std::uint32_t parent = 0;                // of the first node: itself
  std::vector<std::uint32_t> children;     // indices into BtcppTree::nodes
  BtcppPlace place;                        // of the name in the tag
};

// The attribute of this name, or nullptr.
const BtcppAttribute* find_attribute(
    const std::vector<BtcppAttribute>& attributes, std::string_view name);

// <BehaviorTree ID="…">: its nodes in pre-order, the first is the root.
struct BtcppTree {
  std::string id;  // "BehaviorTree_0" when none is written
  std::vector<BtcppNode> nodes;
  BtcppPlace place;
};

enum class BtcppDirection : std::uint8_t { Input, Output, InOut };

// <input_port name="…" type="…" default="…">description</input_port>
struct BtcppPort {
  BtcppDirection direction = BtcppDirection::Input;
  std::string name;
  std::string type;  // "" when none is written
  std::optional<std::string> default_value;
  std::string description;
  BtcppPlace place;
};

// One entry of <TreeNodesModel>.
struct BtcppModel {
  BtcppKind kind = BtcppKind::Action;
  std::string id;
  std::vector<BtcppPort> ports;
  std::vector<std::pair<std::string, std::string>> metadata;
  BtcppPlace place;

  const BtcppPort* port(std::string_view name) const;
};

struct BtcppDocument {
  BtcppRelease release = BtcppRelease::V4;
  std::optional<int> version;    // as BtcppOptions has it, if it is no guess
  std::optional<int> read_for;   // the same, guessed or not
  std::vector<InputFile> files;  // the one that was asked for is the first
  // The tree to run unless the user names another; nothing when the files do
  // not say.
  std::optional<std::string> main_tree;
  std::string project_name;        // of a .btproj, or ""
  std::vector<BtcppTree> trees;    // no two of one ID
  std::vector<BtcppModel> models;  // no two of one kind and ID

  // The release that the files are read for: where none is said, the newest.
  int engine() const {
    return read_for.value_or(release == BtcppRelease::V3 ? kNewestRelease3
                                                         : kNewestRelease);
  }

  // nullptr when there is none.
  const BtcppTree* tree(std::string_view id) const;
  // Of a node type; `subtree_model` finds those of SubTrees.
  const BtcppModel* model(std::string_view id) const;
  const BtcppModel* subtree_model(std::string_view id) const;
};

// <include path="…" ros_pkg="…">, found in the file `from`; or a tree that the
// files do not have, which is asked for by its ID: programs register more files
// than one.
struct IncludeRequest {
  std::string_view from;         // a name that this or the caller gave
  std::string_view path;         // as written; "" where a tree is asked for
  std::string_view ros_package;  // "" when none is written
  std::string_view tree = {};    // the ID
};

// The answer to a request. Two requests mean the same file when the names in
// their answers are equal.
struct IncludedFile {
  std::string name;
  std::optional<FileText> text;  // nothing when it cannot be read
  std::string reason;            // why, "no such file"
  // A file that has the tree as well, and is as near.
  std::string other = {};
};

using IncludeLoader = std::function<IncludedFile(const IncludeRequest&)>;

struct BtcppOptions {
  // Nothing: as `BTCPP_format` says; a file without it is of version 3.
  std::optional<BtcppRelease> release;
  // The very release, 4.8.3 is 40803. Nothing: what only some of them refuse is
  // a note that says so (Diagnostic::refused_by).
  std::optional<int> version = {};
  // The version is a guess: files are read as it reads them, but what it
  // refuses is a note all the same.
  bool is_guess = false;
  // Files of which only <TreeNodesModel> is read. A model in the files of the
  // tree replaces one of these.
  std::vector<InputFile> models;
  // Files whose models count where nothing else has the type: of them nothing
  // is said.
  std::vector<InputFile> neighbours = {};
  // Patterns of names and types of leaves that are described elsewhere.
  std::vector<std::string> described = {};
  // A value even where nodes have a wrong number of children or a wrong name,
  // to look for what else is wrong.
  bool keeps_faulty = false;
};

// Reads a file and all it includes. Without a value, at least one of the
// diagnostics is an error.
Result<BtcppDocument> read_btcpp(std::string_view name, const FileText& text,
                                 const IncludeLoader& loader,
                                 const BtcppOptions& options = {});

// Asks the loader for all that `read_btcpp` would ask it for.
void ask_for_files(std::string_view name, const FileText& text,
                   const IncludeLoader& loader);

}  // namespace btcheck
