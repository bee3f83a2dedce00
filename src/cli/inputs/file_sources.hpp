// SPDX-License-Identifier: MIT
//
// The files of the file system, as far as they may be read.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cli/inputs/packages.hpp"
#include "cli/options/options.hpp"
#include "project/sources.hpp"

namespace btcheck {

// Adds an XML file of at most a mebibyte, unless it was looked at. `roots` as
// read_file_in has them.
void add_file(XmlProject& project, const std::vector<std::string>& roots,
              const std::string& name);
// Those in the folder that holds the file; not below it.
void add_beside(XmlProject& project, const std::vector<std::string>& roots,
                const std::string& file);

// Texts that take the place of files, an editor's for instance; by their
// absolute names, as `buffer_name` makes them.
using Buffers = std::map<std::string, FileText>;
std::string buffer_name(const std::string& file);

// What one tree asks for, in the roots of a command.
class FileSources final : public Sources {
 public:
  // The options and the buffers must outlive it.
  FileSources(const InputFile& tree, const Options& options,
              const Buffers* buffers = nullptr);

  Result<InputFile> text(const std::string& name) override;
  Result<InputFile> named(const std::string& name) override;
  NearestFile with_tree(std::string_view tree,
                        const std::string& from) override;
  std::string package(std::string_view name, const std::string& from) override;
  const XmlProject& project() const override;
  bool is_of_one_program() const override {
    return options_.project != nullptr;
  }

 private:
  // As read_file_in, but for what is in a buffer.
  Result<InputFile> read(const std::vector<std::string>& roots,
                         const std::string& name) const;
  void add_buffers_beside();

  const std::string tree_;
  const Options& options_;
  const Buffers* buffers_;
  std::vector<std::string> roots_;
  // Folders of packages that ROS has installed.
  std::vector<std::string> installed_;
  XmlProject beside_;
  XmlProject around_;
  bool has_folder_ = false;
  std::optional<FilesAround> files_around_;  // made when a tree is missing
};

}  // namespace btcheck
