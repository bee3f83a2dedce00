// SPDX-License-Identifier: MIT
//
// What a word in a file is the name of, and all places where that is named.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lsp/words.hpp"

namespace btcheck::lsp {

enum class NameKind : unsigned char {
  Tree,   // of an ID, a SubTree
  Type,   // of a node
  Node,   // one of a tree, by its name
  Entry,  // of a blackboard
  Let,    // in a file of rules
  File,   // of an <include>, a `tree "…"`
  Word    // of a .btf tree: a variable, a node, a tree
};

struct Named {
  NameKind kind{};
  std::string name;
  TextStretch at;
  std::string tree;  // an entry: the ID of the tree that it is in; "@": of all
};
// Nothing where there is none.
std::optional<Named> named_at(const View& view, std::size_t at);

struct Place {
  std::string path;
  TextStretch part;
  bool is_declared = false;
  bool is_written = false;  // of an entry

  auto key() const { return std::tie(path, part.begin, part.end); }
};
// In the order of files and places, none twice.
std::vector<Place> places_of(const View& view, const Named& named);

}  // namespace btcheck::lsp
