// SPDX-License-Identifier: MIT
//
// What is kept of a batch, wherever that is: in a file of its own
// (results_file), or in a folder that it shares with others (results_folder).
// Either holds sealed lines (seal), of which damaged ones are not believed.
//
// Results are idempotent. A key stands for everything that decides a result, so
// whoever checks an entry finds the same, and one result may take the place of
// another at any time. Who shares a folder agrees on who checks what for one
// reason only: that no work is done twice.
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <string>

#include "report/formats/reported.hpp"

namespace btcheck {

class KeptResults {
 public:
  struct Found {
    std::optional<ReportedTree> tree;
    bool is_damaged = false;  // something is there, and not as it was written
  };
  // Who is to check an entry of which nothing is kept.
  enum class Claim { Ours, Others, Nobodys };
  // Who is at work on an entry, as far as can be seen. Unclear: somebody was,
  // and may be gone.
  enum class Holder { Nobody, Unclear, Alive };

  virtual ~KeptResults() = default;
  KeptResults(const KeptResults&) = delete;
  KeptResults& operator=(const KeptResults&) = delete;

  // The results under this key, where there are any.
  virtual Found find(const std::string& key) const = 0;
  // They are told in this run.
  virtual void use(const std::string& key) = 0;
  virtual void add(const std::string& key, const ReportedTree& tree) = 0;

  // Drops what was neither used nor added: the results of entries that have
  // changed since, or are no longer there.
  virtual void drop_unused() {}

  // What is claimed is ours until it is added, or left.
  virtual Claim claim(const std::string& /*key*/) { return Claim::Ours; }
  virtual void leave(const std::string& /*key*/) {}
  virtual Holder holder_of(const std::string& /*key*/) {
    return Holder::Nobody;
  }
  // Called now and then, so that others see that this process lives.
  virtual void keep_alive() {}

  // Why nothing is told of an entry that others hold, or that nobody checks.
  virtual std::string why_missing(const std::string& /*entry*/,
                                  const std::string& /*key*/) const {
    return {};
  }
  // How long the entry of that name took the last time; infinity for one that
  // nobody has seen.
  virtual double seconds_of(const std::string& /*entry*/) const {
    return std::numeric_limits<double>::infinity();
  }

  // How many results were not as they were written, and are made again.
  std::size_t damaged() const { return damaged_; }
  void count_damaged() { ++damaged_; }

  // Why nothing is kept; "" where it is.
  const std::string& complaint() const { return complaint_; }

 protected:
  KeptResults() = default;

  std::size_t damaged_ = 0;
  std::string complaint_;
};

}  // namespace btcheck
