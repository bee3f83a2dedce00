// SPDX-License-Identifier: MIT
//
// The files that a run is kept in while it goes on.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "cli/inputs/files.hpp"

namespace btcheck {

// Files that a run will be written to: claimed at its beginning, so that two
// engines do not keep their runs in one.
class ClaimedFiles {
 public:
  // Returns what is wrong with the file, or "". A name that is "" claims none.
  std::string claim(const std::string& name);
  // Takes away what it has made and nobody has written to.
  ~ClaimedFiles();
  ClaimedFiles() = default;
  ClaimedFiles(const ClaimedFiles&) = delete;
  ClaimedFiles& operator=(const ClaimedFiles&) = delete;

 private:
  struct Claimed {
    std::string name;
    std::unique_ptr<OpenFile> file;
    bool is_new = false;
  };
  std::vector<Claimed> files_;
};

}  // namespace btcheck
