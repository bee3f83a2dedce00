// SPDX-License-Identifier: MIT
//
// The XML files of BehaviorTree.CPP that lie together. A program that loads a
// folder registers all of them, so a tree may use what any of them has.
#pragma once

#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "model/btcpp/document.hpp"
#include "model/btcpp/outline.hpp"

namespace btcheck {

struct ProjectFile {
  InputFile file;
  XmlOutline outline;
};

struct NearestFile {
  const ProjectFile* file = nullptr;
  const ProjectFile* other = nullptr;  // as near, with other text
};

class XmlProject {
 public:
  // Whether a file of this name was never looked at, and may be one of these.
  // From now on it was.
  bool is_new(const std::string& name);
  // Adds a file that is new, unless it is none of BehaviorTree.CPP.
  void add(const std::string& name, FileText text);

  // Files of rules about its trees, which somebody has read already.
  void add_rules(InputFile file) { rules_.push_back(std::move(file)); }

  const std::vector<ProjectFile>& files() const { return files_; }
  // The file of this name, or nullptr.
  const ProjectFile* file(std::string_view name) const;
  // A file of these or of the rules, or nullptr.
  const InputFile* read_file(std::string_view name) const;
  // Which file a tree that `from` names is taken from: itself, or the one that
  // is nearest by its folders, and of several the first by name.
  NearestFile with_tree(std::string_view id, const std::string& from) const;

  // Trees that nobody in the project uses, of a file that nobody includes: what
  // a program runs. "" stands for what the file itself names.
  std::vector<std::string> entries_of(const ProjectFile& file) const;
  // The same by their IDs.
  std::vector<std::string> roots_of(const ProjectFile& file) const;

 private:
  bool is_included(const std::string& name) const;

  std::vector<ProjectFile> files_;  // ascending by name
  std::size_t bytes_ = 0;           // of their texts
  std::vector<InputFile> rules_;
  std::set<std::string> looked_at_;
};

}  // namespace btcheck
