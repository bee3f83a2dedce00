// SPDX-License-Identifier: MIT
//
// The texts of a tree's files, and edits made to them: as a person would make
// them, with the indentation of the file and all else left as it stands.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "text/diagnostic.hpp"
#include "text/input_file.hpp"
#include "text/repair.hpp"

namespace btcheck {

class EditedFiles {
 public:
  explicit EditedFiles(std::vector<InputFile> files);

  // Makes all edits. False where one does not fit: there is no such node, or it
  // has no such attribute.
  bool apply(const Repair& repair);

  const std::vector<InputFile>& originals() const { return originals_; }
  const std::vector<InputFile>& files() const { return files_; }

  // Where what stood there before all edits stands now.
  std::optional<SourcePlace> moved(const SourcePlace& before) const;

 private:
  friend class EditPen;

  // A stretch of one file that was replaced, in the order in which it was done.
  struct Change {
    std::size_t file = 0;
    TextStretch part;
    std::size_t new_size = 0;
  };

  std::optional<std::size_t> file_named(std::string_view name) const;
  // Where the byte is that a place named before all edits.
  std::optional<std::size_t> offset(std::size_t file,
                                    const SourcePlace& place) const;
  void replace(std::size_t file, TextStretch part, const std::string& text);

  std::vector<InputFile> originals_;
  std::vector<InputFile> files_;
  std::vector<Change> changes_;
};

}  // namespace btcheck
