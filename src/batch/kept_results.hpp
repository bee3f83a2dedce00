// SPDX-License-Identifier: MIT
//
// The results of a batch so far, kept in a file beside it: one line for each
// entry that is done, written at once, with a seal. However the program ends,
// at most the last line is lost.
//
// Without a secret the seal is a checksum: it finds damage, not forgery. Who
// can write the file can then say what the results are.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "report/formats/reported.hpp"

namespace btcheck {

// 32 hexadecimal digits, the same on every machine (XXH3, 128 bits).
std::string content_hash(std::string_view text);

// Which btcheck this is: a content hash of the running program. The same for
// all of them where the system does not say where the program lies.
const std::string& build_identity();

// A tree's results as one line of text, without its end, and back. Nothing is
// lost: a report made of what was read is the report made of what was written.
// Bytes that are no UTF-8 are replaced.
std::string kept_text(const ReportedTree& tree);
// Nothing for a text that kept_text of this version does not write.
std::optional<ReportedTree> tree_from(std::string_view text);

class KeptResults {
 public:
  // Takes up the results in the file, or starts over without them. The file is
  // made when there is something to keep. Where it cannot be written, nothing
  // is kept, and `complaint` says so. Lines that another secret has sealed
  // count as damaged.
  enum class Start { Over, TakeUp };
  KeptResults(std::string file, Start start, std::string secret = {});

  // The results under this key; nothing where there are none.
  std::optional<ReportedTree> find(const std::string& key) const;
  // They are still good: drop_unused keeps them.
  void use(const std::string& key);
  void add(const std::string& key, const ReportedTree& tree);

  // Drops what was neither used nor added: the results of entries that have
  // changed since, or are no longer there.
  void drop_unused();

  // How many lines were damaged when the file was taken up. They are gone from
  // it.
  std::size_t damaged() const { return damaged_; }

  bool has_secret() const { return !secret_.empty(); }

  // Why nothing is kept; "" where it is.
  const std::string& complaint() const { return complaint_; }

 private:
  struct Kept {
    std::string tree;  // as text
    bool is_used = false;
  };

  void take_up(std::string_view text);
  // False for a line that is not as it was written.
  bool take_up_line(std::string_view line);
  std::string seal_of(std::string_view text) const;
  std::string written(const std::string& key, const std::string& tree) const;
  std::string lines() const;

  std::string file_;
  std::string secret_;
  std::map<std::string, Kept> kept_;  // by key
  std::size_t damaged_ = 0;
  std::string complaint_;
};

}  // namespace btcheck
