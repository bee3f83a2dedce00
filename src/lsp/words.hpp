// SPDX-License-Identifier: MIT
//
// What can be written in a tree and its rules: node types and their ports, the
// nodes of a tree, its entries.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "lsp/texts/xml_scan.hpp"
#include "lsp/workbench.hpp"
#include "model/tree/tree.hpp"

namespace btcheck::lsp {

struct PortWord {
  std::string name;
  std::string direction;  // "input", "output", "inout"; "" where nobody tells
  std::string type;       // "int"; "" where nobody tells
  std::string preset;
  std::string about;
  bool is_needed = false;
  std::string in;        // the releases that have it; "" for all
  bool is_there = true;  // in that of the document
};

struct TypeWord {
  std::string id;
  std::string kind;  // "Control", ...
  std::string about;
  std::string since;  // "from BehaviorTree.CPP 4.2 on"; "" for all
  std::vector<PortWord> ports;

  const PortWord* port(std::string_view name) const;
};

// The profile that a document is read with, as far as it is known.
Profile profile_of(const View& view);

// The types that can be used in an XML document: those of its profile, of
// models in the files, and what other trees use.
std::vector<TypeWord> all_types(const View& view);
std::optional<TypeWord> type_named(const View& view, std::string_view id);

// Of files that have trees: path, scan.
struct ScannedFile {
  std::string path;
  std::shared_ptr<const XmlScan> scan;
};
std::vector<ScannedFile> tree_files(const View& view);

// The type of an element of a tree, "Drive" of <Action ID="Drive"/>; "" of what
// is no node.
std::string_view type_of(const XmlScan& scan, std::size_t element);
bool is_subtree(const XmlScan& scan, std::size_t element);

// A node of a look.
struct NodeHere {
  const Look* look = nullptr;
  std::size_t number = 0;            // in its description
  const v1::Node* proven = nullptr;  // null where nothing is known

  const v1::DescribedNode& node() const {
    return look->description->nodes[number];
  }
};
// Those that stand in a file, where their type's word begins at this byte. A
// subtree that is used twice has its nodes twice.
std::vector<NodeHere> nodes_at(const View& view, const std::string& path,
                               std::size_t begin);
// Those that a word of a rule names: a label, a unique name, a path.
std::vector<NodeHere> nodes_named(const View& view, std::string_view word);

// The entry that a node of a tree calls so, a number in its description: by its
// name in the trees above it where a SubTree has remapped it. kNone for none.
std::size_t entry_of(const NodeHere& here, std::string_view name);

// The description of the first look that has one, or nullptr.
const Look* described_look(const View& view);
// The look whose findings are those of the document.
const Look* checked_look(const View& view);

// "{goal}" → "goal", where the byte is inside.
struct EntryHere {
  std::string name;
  TextStretch part;  // of the name
};
std::optional<EntryHere> entry_at(std::string_view value,
                                  std::size_t value_begin, std::size_t at);

// The word around a byte, of letters, digits and `_`.
TextStretch word_at(std::string_view text, std::size_t at);
bool is_word_letter(char c);

}  // namespace btcheck::lsp
