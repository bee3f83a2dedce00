// SPDX-License-Identifier: MIT
//
// Which files and folders are looked at, for those who want to know when one of
// them changes.
#pragma once

#include <set>
#include <string>
#include <string_view>

namespace btcheck {

// A file is one that was read, or would have been if it were there; a folder is
// one whose files were listed. Names as they were used.
struct LookedAt {
  std::set<std::string> files;
  std::set<std::string> folders;

  void add(const LookedAt& more);

  // A line for each name, folders with a slash at their end; and back.
  std::string text() const;
  static LookedAt from_text(std::string_view text);

  // Whoever looks says so.
  static void note_file(const std::string& name);
  static void note_folder(const std::string& name);
};

// From construction to destruction what this thread looks at is gathered.
class LookingOn {
 public:
  LookingOn();
  ~LookingOn();
  LookingOn(const LookingOn&) = delete;
  LookingOn& operator=(const LookingOn&) = delete;

  const LookedAt& seen() const { return seen_; }

 private:
  LookedAt seen_;
  LookedAt* before_;
};

}  // namespace btcheck
