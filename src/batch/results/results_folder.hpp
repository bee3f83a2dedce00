// SPDX-License-Identifier: MIT
//
// A folder that any number of processes fill with results: KEY.result for each
// entry, written as a whole and then renamed, so that it is there or it is not.
// leases.hpp has who checks what.
//
// What has failed, for want of memory for instance, is kept as well: others do
// not try the same, and a report can be made of the folder alone.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>

#include "batch/results/kept_results.hpp"
#include "batch/results/leases.hpp"
#include "batch/results/seal.hpp"

namespace btcheck {

class ResultsFolder : public KeptResults {
 public:
  // Whether what is missing is checked, or only told.
  enum class Role { Works, Joins };
  // The folder must be there. Where nothing can be written into it, `complaint`
  // says so, and everything is checked here.
  ResultsFolder(std::string folder, Role role, double patience_seconds,
                std::string secret);

  Found find(const std::string& key) const override;
  void use(const std::string& key) override;
  void add(const std::string& key, const ReportedTree& tree) override;

  Claim claim(const std::string& key) override;
  void leave(const std::string& key) override { leases_.release(key); }
  Holder holder_of(const std::string& key) override {
    return leases_.holder_of(key);
  }
  void keep_alive() override { leases_.keep_alive(); }

  std::string why_missing(const std::string& entry,
                          const std::string& key) const override;
  double seconds_of(const std::string& entry) const override;

  // Drops what had failed before, so that it is tried again.
  void drop_failed();

 private:
  // What results say of an entry that may have been another one since.
  struct Earlier {
    double seconds = 0;
    bool is_of_this_build = false;
  };

  std::string file_of(const std::string& key) const;
  std::vector<std::filesystem::path> files() const;
  void take_up(std::string_view head);

  std::string folder_;
  Role role_;
  Leases leases_;
  Seal seal_;
  std::map<std::string, Earlier> earlier_;  // by the entry's name as one line
};

}  // namespace btcheck
