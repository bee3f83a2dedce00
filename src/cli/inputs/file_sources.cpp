// SPDX-License-Identifier: MIT
#include "cli/inputs/file_sources.hpp"

#include <filesystem>
#include <utility>

#include "cli/inputs/files.hpp"
#include "cli/inputs/looked_at.hpp"
#include "model/tree_file.hpp"

namespace btcheck {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostFiles = 1000;        // of one folder
constexpr std::uintmax_t kMostBytes = 1 << 20;  // a tree is smaller

// What a tree may include: a ROS workspace has several repositories, which name
// each other.
std::vector<std::string> roots_of_includes(const std::string& tree,
                                           const Options& options) {
  std::vector<std::string> roots = options.roots;
  if (roots.empty() || options.given.contains("--root") ||
      options.command == Command::Batch || is_given(tree)) {
    return roots;
  }
  const std::string workspace = workspace_of(tree);
  if (!workspace.empty()) roots.push_back(workspace);
  return roots;
}

}  // namespace

void add_file(XmlProject& project, const std::vector<std::string>& roots,
              const std::string& name) {
  if (!project.is_new(name)) return;
  std::error_code fault;
  if (!fs::is_regular_file(name, fault) ||
      fs::file_size(name, fault) > kMostBytes) {
    return;
  }
  // Any file of the folder may be of the project; whoever uses one says so.
  LookedAt::note_folder(fs::path(name).parent_path().string());
  const LookingOn aside;
  auto read = read_file_in(roots, name);
  if (read.value) project.add(name, std::move(read.value->text));
}

void add_beside(XmlProject& project, const std::vector<std::string>& roots,
                const std::string& file) {
  const fs::path folder = fs::path(file).parent_path();
  std::vector<std::string> names;
  LookedAt::note_folder(folder.string());
  std::error_code fault;
  fs::directory_iterator at(folder.empty() ? "." : folder, fault);
  for (; !fault && at != fs::directory_iterator(); at.increment(fault)) {
    // As `beside` and `included_name` write it.
    names.push_back((folder / at->path().filename()).lexically_normal());
    if (names.size() > kMostFiles) return;
  }
  for (const std::string& name : names) add_file(project, roots, name);
}

std::string buffer_name(const std::string& file) {
  std::error_code fault;
  return fs::absolute(file, fault).lexically_normal().string();
}

FileSources::FileSources(const InputFile& tree, const Options& options,
                         const Buffers* buffers)
    : tree_(tree.name),
      options_(options),
      buffers_(buffers),
      roots_(roots_of_includes(tree.name, options)),
      has_folder_(options.project == nullptr && !is_given(tree.name) &&
                  is_xml(tree.name, tree.text)) {
  if (!has_folder_) return;
  const std::string name = fs::path(tree_).lexically_normal();
  if (tree.text.size() <= kMostBytes && beside_.is_new(name)) {
    beside_.add(name, tree.text);
  }
  add_buffers_beside();
  add_beside(beside_, roots_, tree_);
}

void FileSources::add_buffers_beside() {
  if (buffers_ == nullptr) return;
  const fs::path folder = fs::path(tree_).parent_path();
  const fs::path place = fs::path(buffer_name(tree_)).parent_path();
  for (const auto& [file, text] : *buffers_) {
    const fs::path path = file;
    if (path.parent_path() != place) continue;
    const std::string name = (folder / path.filename()).lexically_normal();
    if (beside_.is_new(name)) beside_.add(name, text);
  }
}

Result<InputFile> FileSources::read(const std::vector<std::string>& roots,
                                    const std::string& name) const {
  if (buffers_ != nullptr) {
    const auto buffer = buffers_->find(buffer_name(name));
    if (buffer != buffers_->end()) return {InputFile{name, buffer->second}, {}};
  }
  return read_file_in(roots, name);
}

const XmlProject& FileSources::project() const {
  return options_.project == nullptr ? beside_ : *options_.project;
}

// A file that a ROS package has installed is no stranger's: where it lies, and
// where a link of `colcon build --symlink-install` leads, may be read from now
// on, unless the user says what may.
Result<InputFile> FileSources::text(const std::string& name) {
  for (const XmlProject* files : {&project(), &std::as_const(around_)}) {
    const InputFile* known = files->read_file(name);
    if (known == nullptr) continue;
    LookedAt::note_file(name);
    return {*known, {}};
  }
  for (const std::string& folder : installed_) {
    const std::string inside = fs::path(name).lexically_relative(folder);
    if (inside.empty() || inside.starts_with("..") || roots_.empty() ||
        options_.given.contains("--root")) {
      continue;
    }
    std::error_code fault;
    roots_.push_back(folder);
    roots_.push_back(fs::weakly_canonical(name, fault).parent_path().string());
    break;
  }
  return read(roots_, name);
}

// Of a command, or of settings: what a tree may include is no matter of theirs.
Result<InputFile> FileSources::named(const std::string& name) {
  return read(options_.roots, name);
}

NearestFile FileSources::with_tree(std::string_view tree,
                                   const std::string& from) {
  NearestFile near = project().with_tree(tree, from);
  if (near.file == nullptr) near = around_.with_tree(tree, from);
  if (has_folder_ && near.file == nullptr && !files_around_) {
    files_around_.emplace(tree_);
  }
  while (files_around_ && near.file == nullptr && files_around_->has_more()) {
    for (const std::string& name : files_around_->next()) {
      if (beside_.file(name) == nullptr) add_file(around_, roots_, name);
    }
    near = around_.with_tree(tree, from);
  }
  if (near.file != nullptr) LookedAt::note_file(near.file->file.name);
  return near;
}

std::string FileSources::package(std::string_view name,
                                 const std::string& from) {
  std::string installed = installed_package(name);
  if (installed.empty()) return package_folder(name, from);
  installed_.push_back(installed);
  return installed;
}

}  // namespace btcheck
