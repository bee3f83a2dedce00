// SPDX-License-Identifier: MIT
//
// A tree asks for a file by its path, or for a tree that nobody has read yet by
// its ID; both answers are kept in the reading.
#include "project/sources.hpp"

#include <algorithm>
#include <utility>

#include "ltl/rules/property.hpp"
#include "model/tree_file.hpp"

namespace btcheck {

InputFile typed_rules(const std::vector<std::string>& rules) {
  std::string text;
  for (const std::string& rule : rules) {
    text += (begins_item(rule) ? "" : "prove ") + rule + '\n';
  }
  return {"<-e>", std::move(text)};
}

namespace {

void add_neighbour(const ProjectFile& file, TreeReading& reading) {
  const bool is_there = std::ranges::any_of(
      reading.neighbours,
      [&](const InputFile& other) { return other.name == file.file.name; });
  if (!is_there) reading.neighbours.push_back(file.file);
}

IncludedFile file_with_tree(const IncludeRequest& request,
                            const std::string& own, Sources& sources,
                            TreeReading& reading) {
  const NearestFile near =
      sources.with_tree(request.tree, std::string(request.from));
  if (near.file == nullptr || near.file->file.name == own) return {};
  add_neighbour(*near.file, reading);
  if (near.other != nullptr) {
    reading.as_near.emplace(request.tree, near.other->file.name);
  }
  return {near.file->file.name, near.file->file.text, ""};
}

IncludedFile included_file(const IncludeRequest& request, Sources& sources,
                           TreeReading& reading,
                           std::vector<Diagnostic>& found) {
  IncludedFile file{included_name(request.from, request.path), {}, {}};
  if (!request.ros_package.empty()) {
    const std::string folder =
        sources.package(request.ros_package, std::string(request.from));
    if (folder.empty()) return file;
    reading.packages[std::string(request.ros_package)] = folder;
    file.name = packaged_name(folder, request.path);
  }
  auto read = sources.text(file.name);
  if (!read.value) {
    if (read.diagnostics[0].code == "BT0009") {
      found.insert(found.end(), read.diagnostics.begin(),
                   read.diagnostics.end());
    }
    return file;
  }
  file.text = read.value->text;
  reading.included.push_back({file.name, std::move(read.value->text)});
  return file;
}

// A file that is looked at by itself has the models of files beside it that
// hold nothing else.
void add_models_around(const InputFile& tree, const Sources& sources,
                       TreeReading& reading) {
  for (const ProjectFile& file : sources.project().files()) {
    const bool has_only_models = file.outline.trees.empty();
    if (file.outline.has_node_models &&
        (has_only_models || sources.is_of_one_program()) &&
        file.file.name != tree.name) {
      add_neighbour(file, reading);
    }
  }
}

}  // namespace

void add_asked_files(const InputFile& tree, Sources& sources,
                     TreeReading& reading, std::vector<Diagnostic>& found) {
  ask_for_files(tree.name, tree.text, [&](const IncludeRequest& request) {
    return request.tree.empty()
               ? included_file(request, sources, reading, found)
               : file_with_tree(request, tree.name, sources, reading);
  });
  if (!reading.leaves.empty()) {
    if (const auto own = outline_of(tree.text)) {
      reading.other_leaves = own->leaves;
    }
    for (const ProjectFile& file : sources.project().files()) {
      reading.other_leaves.insert(file.outline.leaves.begin(),
                                  file.outline.leaves.end());
    }
  }
  add_models_around(tree, sources, reading);
}

}  // namespace btcheck
