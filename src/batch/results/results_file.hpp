// SPDX-License-Identifier: MIT
//
// The results of a batch so far, kept in a file beside it: one line for each
// entry that is done, written at once, with a seal. However the program ends,
// at most the last line is lost.
#pragma once

#include <map>
#include <string>
#include <string_view>

#include "batch/results/kept_results.hpp"
#include "batch/results/seal.hpp"

namespace btcheck {

class ResultsFile : public KeptResults {
 public:
  // Takes up the results in the file, or starts over without them. The file is
  // made when there is something to keep. Where it cannot be written, nothing
  // is kept, and `complaint` says so. Lines that another secret has sealed
  // count as damaged. They are gone from the file. Without a name, memory alone
  // has them.
  enum class Start { Over, TakeUp };
  ResultsFile(std::string file, Start start, std::string secret = {});

  Found find(const std::string& key) const override;
  void use(const std::string& key) override;
  // What may be another time is not kept.
  void add(const std::string& key, const ReportedTree& tree) override;
  // And what is left is unused from then on.
  void drop_unused() override;

 private:
  struct Kept {
    std::string tree;  // as text
    bool is_used = false;
  };

  void take_up(std::string_view text);
  // False for a line that is not as it was written.
  bool take_up_line(std::string_view line);
  std::string lines() const;

  std::string file_;
  Seal seal_;
  std::map<std::string, Kept> kept_;  // by key
};

}  // namespace btcheck
