// SPDX-License-Identifier: MIT
//
// What the files of a repository were at some time, as git keeps it.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "text/diagnostic.hpp"

namespace btcheck {

// A folder of its own with all files of a repository as a revision has them,
// which goes with it.
class Revision {
 public:
  // Of the repository that `input`, a file or folder, lies in. Says why not
  // where there is none, or git does not know the revision.
  static Result<Revision> with(const std::string& revision,
                               const std::string& input);
  ~Revision();
  Revision(Revision&& other) noexcept;
  Revision& operator=(Revision&&) = delete;

  // The folder, and in it what the input was.
  const std::string& folder() const { return files_; }
  const std::string& input() const { return input_; }
  // The name of a file of this folder as one of the revision,
  // "main:trees/patrol.xml"; any other name as it is.
  std::string shown(const std::string& name) const;

 private:
  Revision() = default;

  std::string revision_;
  std::filesystem::path folder_;  // made for this; empty: none
  std::string files_;
  std::string input_;
};

}  // namespace btcheck
