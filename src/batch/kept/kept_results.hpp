// SPDX-License-Identifier: MIT
//
// What a batch has found out so far, in a file beside it: a line for each entry
// that is done, added when it is, with a checksum of the line before it.
// However the program ends, at most the last line is lost.
#pragma once

#include <cstddef>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>

#include "report/formats/reported.hpp"

namespace btcheck {

// Every member may be called by several threads at once.
class KeptResults {
 public:
  // Takes the file up as it stands, or not at all: then it starts over. It is
  // made when there is something to keep; where it cannot be written to,
  // nothing is kept, and `complaint` says so.
  enum class Start { Over, TakeUp };
  KeptResults(std::string file, Start start);

  // The results under this key; nothing where there are none.
  std::optional<ReportedTree> find(const std::string& key);
  void add(const std::string& key, const ReportedTree& tree);

  // Drops what was neither found nor added: the results of entries that have
  // changed since, or are no longer there.
  void drop_unused();

  // Lines that are not as they were written, found when the file was taken up.
  // They are gone from it.
  std::size_t damaged() const { return damaged_; }

  // Why nothing is kept, "" where it is.
  std::string complaint() const;

 private:
  struct Kept {
    std::string tree;  // as text
    bool is_used = false;
  };

  void take_up(std::string_view text);
  std::string lines() const;

  std::string file_;
  std::map<std::string, Kept> kept_;  // by key
  std::size_t damaged_ = 0;
  std::string complaint_;
  mutable std::mutex mutex_;
};

}  // namespace btcheck
