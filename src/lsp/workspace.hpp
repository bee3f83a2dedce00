// SPDX-License-Identifier: MIT
//
// The files of the folders that an editor has open: trees, rules, contracts;
// and which trees are asked about when one of them is edited.
#pragma once

#include <compare>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "cli/inputs/file_sources.hpp"
#include "lsp/documents.hpp"
#include "project/xml_project.hpp"

namespace btcheck::lsp {

// What is checked: a tree, alone or against a file of rules. Absolute paths.
struct Subject {
  std::string tree;
  std::string main_tree;  // its ID; "": as the file says
  std::string rules;      // "": none, the findings are asked for

  auto operator<=>(const Subject&) const = default;
};

class Workspace {
 public:
  // Forgets all others, and reads what lies in these folders: at most
  // kMostFiles, none of more than a mebibyte. Left out are names that begin
  // with a dot, links, and what builds and package managers make.
  void read(const std::vector<std::string>& folders);

  // The text of a file is another one now, or it is gone. Whether other files
  // may have to do with that: its trees, what it uses or models have changed.
  bool put(const std::string& path, const FileText& text);
  bool remove(const std::string& path);

  // All that are known, those that are open as they are there.
  const std::map<std::string, FileText>& files() const { return files_; }

  // What is asked about while a document is open; the first concerns it most.
  std::vector<Subject> subjects_of(const Document& document) const;
  // Files of rules about a tree.
  std::vector<std::string> rules_of(const std::string& tree) const;
  // The tree that a file of rules is about, "" where there is none.
  std::string tree_of(const std::string& rules) const;

  static constexpr std::size_t kMostFiles = 5000;

 private:
  const XmlProject& project() const;
  std::vector<Subject> entries_of(const ProjectFile& file) const;
  // Those that use trees of the file, directly or not, and are used by none.
  std::vector<Subject> users_of(const ProjectFile& file) const;

  std::map<std::string, FileText> files_;
  // Made anew when the outline of a file is another.
  mutable std::optional<XmlProject> project_;
};

}  // namespace btcheck::lsp
