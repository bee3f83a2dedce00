// SPDX-License-Identifier: MIT
//
// Tells when files change, without looking at them: by inotify, see inotify(7).
//
// What is watched is folders. A file that is written anew, renamed over,
// deleted or made has its name in an event of its folder, so it does not matter
// how an editor saves, and a file may be watched that is not there yet. Each
// folder above is watched for the name of the next one below, so folders may
// come and go as well, and links are watched beside what they lead to.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "cli/inputs/files.hpp"
#include "cli/inputs/looked_at.hpp"

namespace btcheck {

class FileChanges {
 public:
  // Where it cannot watch at all, `flaw` says why.
  FileChanges();

  // These are watched from now on, and nothing else. Of a folder the files
  // count that a project may consist of, and folders. True where a folder is
  // watched that was not before: what has changed there in between is not
  // known.
  bool watch(const LookedAt& names);

  // For poll(2): something may have happened.
  int number() const { return inotify_.number(); }

  // Takes what has happened, without waiting: the names of what has changed, as
  // they were given. Where events were lost, all names.
  std::set<std::string> take();

  // Waits for changes, and for more of them until none has come for a moment.
  // None where an interrupt comes first.
  std::set<std::string> wait();
  // The same for changes that have begun.
  void settle(std::set<std::string>& changed);

  // Why something cannot be watched, and what: "" where everything is.
  const std::string& flaw() const { return flaw_; }

 private:
  // What counts of a folder, by its name.
  struct Folder {
    bool is_listed = false;
    // By the name of a file in it, those that it is known by.
    std::map<std::string, std::set<std::string>, std::less<>> names;
  };
  using Folders = std::map<std::string, Folder>;

  static void add_file(Folders& to, const std::string& name,
                       const std::string& shown);
  static void add_above(Folders& to);
  void note_flaw(const std::string& folder, int reason, std::size_t& failed);
  void take_event(int number, std::uint32_t kind, std::string_view name,
                  std::set<std::string>& changed);
  bool await(std::chrono::milliseconds patience, bool hears_interrupts) const;

  OpenFile inotify_;
  Folders folders_;
  std::map<int, std::vector<std::string>> watched_;  // folders, by descriptor
  std::string flaw_;
};

}  // namespace btcheck
