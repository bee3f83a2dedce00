// SPDX-License-Identifier: MIT
//
// The folder of --cache: one database, for any number of processes and builds
// of btcheck at a time. Whatever happens to it, no answer changes: what cannot
// be had is found out again.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cli/options/options.hpp"
#include "explore/components/kept_contents.hpp"

struct sqlite3;
struct sqlite3_stmt;

namespace btcheck {

class ComponentCache final : public KeptContents {
 public:
  static constexpr std::uint64_t kMostBytes = std::uint64_t{1} << 30;
  struct Counts {
    std::size_t found = 0;
    std::size_t added = 0;
    std::size_t damaged = 0;
  };

  // Of a folder that is there. Contents of another build are others. The file
  // in it is never larger than that, and is opened when it is needed first, so
  // that who forks before has not got it open twice.
  ComponentCache(const std::string& folder, const std::string& build,
                 std::uint64_t most_bytes = kMostBytes);
  ~ComponentCache() override;

  // Opens the database, mends it if need be, and closes it again. What went
  // wrong is a complaint.
  void try_out();

  std::optional<std::string> find(const ContentHash& content) override;
  void keep(const ContentHash& content, std::string bytes) override;
  void refuse(const ContentHash& content) override;
  void write() override;

  Counts counts() const;
  // Why it is not what it could be: nothing is found in it, or nothing is kept,
  // from then on; or it was damaged, and is made anew. "" where all is well.
  std::string complaint() const;

 private:
  struct CloseBase {
    void operator()(sqlite3* base) const;
  };
  struct CloseStatement {
    void operator()(sqlite3_stmt* statement) const;
  };
  using Statement = std::unique_ptr<sqlite3_stmt, CloseStatement>;

  ContentHash key_of(const ContentHash& content) const;
  bool is_open();
  bool open();
  void close();
  bool run(const char* order);
  std::optional<std::string> text_of(const char* question);
  std::int64_t number_of(const char* question);
  Statement made(const char* order);
  // True where it has the one table that it is to have, and could be made.
  bool has_table();
  bool make_table();
  bool make_anew();
  // Behind an order that has failed: whether it may be given once more.
  bool recover(int code);
  void give_up(const std::string& why);
  bool write_all();
  bool make_room(std::uint64_t bytes);

  const std::string file_;
  const std::vector<std::int32_t> build_;
  const std::uint64_t most_bytes_;
  mutable std::mutex mutex_;
  std::unique_ptr<sqlite3, CloseBase> base_;
  Statement find_;
  pid_t opened_by_ = 0;
  bool is_given_up_ = false;
  bool is_read_only_ = false;
  bool is_made_anew_ = false;
  bool was_full_ = false;  // when it was written to last
  int times_busy_ = 0;
  std::vector<std::pair<ContentHash, std::string>> gathered_;  // by key
  std::size_t gathered_bytes_ = 0;
  std::vector<std::int64_t> used_;  // numbers of rows, whose time is to be set
  Counts counts_;
  std::string complaint_;
};

// What the checks of this program keep what they know of components in.
struct OpenCache {
  std::shared_ptr<ComponentCache> cache;  // null: nothing is kept
  std::string told;                       // of what is wrong with it
};

// Has them keep it in the folder of --cache, if there is one. Complains, and
// gives nothing, where the folder cannot be made; warns of anything else.
std::optional<OpenCache> open_cache(const Options& options);
// What is still gathered is written. Warns of what went wrong, and tells with
// -v how much was known.
void close_cache(const Options& options, const OpenCache& opened);

}  // namespace btcheck
