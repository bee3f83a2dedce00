// SPDX-License-Identifier: MIT
//
// Where the texts come from that a tree and its rules ask for. The command line
// has one over the file system, which confines what may be read; programs have
// theirs by btcheck/check.hpp.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "check/check.hpp"
#include "project/xml_project.hpp"
#include "text/diagnostic.hpp"

namespace btcheck {

class Sources {
 public:
  Sources() = default;
  virtual ~Sources() = default;
  Sources(const Sources&) = delete;
  Sources& operator=(const Sources&) = delete;

  // The text of a file, by a name as a user or a file gives it.
  virtual Result<InputFile> text(const std::string& name) = 0;
  // The same where the user or a file of settings names it, and not the tree.
  virtual Result<InputFile> named(const std::string& name) {
    return text(name);
  }

  // The file that has a tree which none of those read so far has; `from` asks
  // for it.
  virtual NearestFile with_tree(std::string_view tree,
                                const std::string& from) = 0;

  // The folder of a ROS package; "" where there is none.
  virtual std::string package(std::string_view name,
                              const std::string& from) = 0;

  // The files around a tree, and whether the program that runs it has them all.
  virtual const XmlProject& project() const = 0;
  virtual bool is_of_one_program() const = 0;
};

// Rules that are typed, as a file of rules: each on a line of its own, and one
// without a name behind `prove`.
InputFile typed_rules(const std::vector<std::string>& rules);

// Reads what an XML tree asks for, wherever it is named, and what lies around
// it, into `reading`: so reading the tree again opens nothing. What may not be
// read is added to `found`.
void add_asked_files(const InputFile& tree, Sources& sources,
                     TreeReading& reading, std::vector<Diagnostic>& found);

}  // namespace btcheck
