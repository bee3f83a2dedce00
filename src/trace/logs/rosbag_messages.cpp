// SPDX-License-Identifier: MIT
//
// A .db3 of rosbag2 has the tables `topics` and `messages`. A database is also
// a program: a view, a virtual table or a generated column is computed when it
// is read. So SQLite reads it out of memory, read-only, and these two must be
// plain tables, whose rows are taken as they stand: nothing in the file is
// executed. What is read is no longer than the file, in each row and in all.
#include <fmt/format.h>
#include <sqlite3.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <memory>
#include <utility>

#include "text/utf8.hpp"
#include "trace/logs/flaws.hpp"
#include "trace/logs/ros_recording.hpp"
#include "trace/run/shown_text.hpp"

namespace btcheck {
namespace {

// After so many instructions of SQLite it is asked whether to go on.
constexpr int kInstructionsAtOnce = 1000;
// So many times for one file.
constexpr int kMostRounds = 200'000;

// Reads the columns of the two tables, and looks up what they are; uses no
// function.
int allow(void*, int action, const char* what, const char*, const char*,
          const char* within) {
  if (within != nullptr) return SQLITE_DENY;
  if (action == SQLITE_SELECT) return SQLITE_OK;
  if (what == nullptr) return SQLITE_DENY;
  const std::string_view name = what;
  if (action == SQLITE_PRAGMA && name == "table_xinfo") return SQLITE_OK;
  const bool is_known =
      name == "topics" || name == "messages" || name == "sqlite_master";
  return action == SQLITE_READ && is_known ? SQLITE_OK : SQLITE_DENY;
}

// The memory of all of SQLite; while one of these is there.
class HeapLimit {
 public:
  explicit HeapLimit(sqlite3_int64 bytes)
      : before_(sqlite3_hard_heap_limit64(bytes)) {}
  ~HeapLimit() { sqlite3_hard_heap_limit64(before_); }
  HeapLimit(const HeapLimit&) = delete;
  HeapLimit& operator=(const HeapLimit&) = delete;

 private:
  sqlite3_int64 before_;
};

// A table, and what is read of it.
struct Columns {
  const char* table;
  std::array<const char*, 4> names;
};
constexpr Columns kTopics = {"topics",
                             {"id", "name", "type", "serialization_format"}};
constexpr Columns kMessages = {"messages",
                               {"id", "topic_id", "timestamp", "data"}};

Diagnostic no_recording(const std::string& why) {
  return flaw("BT1302", "this database is no recording of rosbag2: " + why,
              "its tables would be `topics` and `messages`");
}

class Database {
 public:
  Database(std::string_view bytes, const Limits& limits)
      : bytes_(bytes),
        limits_(limits),
        heap_(static_cast<sqlite3_int64>(2 * bytes.size() + kOwnMemory)) {
    // A journal that is written ahead lies in a file beside it, and none is
    // read: the database is taken as it stands.
    if (bytes_.size() >= 20) bytes_[18] = bytes_[19] = '\x01';
    sqlite3* opened = nullptr;
    const int code =
        sqlite3_open_v2(":memory:", &opened,
                        SQLITE_OPEN_READWRITE | SQLITE_OPEN_MEMORY, nullptr);
    base_.reset(opened);
    const auto size = static_cast<sqlite3_int64>(bytes_.size());
    if (code != SQLITE_OK ||
        sqlite3_deserialize(
            opened, "main", reinterpret_cast<unsigned char*>(bytes_.data()),
            size, size, SQLITE_DESERIALIZE_READONLY) != SQLITE_OK) {
      throw damage("SQLite cannot open it");
    }
    disarm();
    sqlite3_progress_handler(
        opened, kInstructionsAtOnce,
        [](void* self) {
          return int{!static_cast<Database*>(self)->goes_on()};
        },
        this);
    sqlite3_set_authorizer(opened, allow, nullptr);
    for (const Columns& columns : {kTopics, kMessages}) {
      refuse_unless_plain(columns);
    }
  }

  // The bytes of a column. Each stands in the file once, a number shorter than
  // its digits; where they come to more, pages lead in a circle.
  std::string column(sqlite3_stmt* row, int number) {
    const void* bytes = sqlite3_column_blob(row, number);
    const int size = sqlite3_column_bytes(row, number);
    if (bytes == nullptr || size <= 0) return {};
    read_ += static_cast<std::size_t>(size);
    if (read_ > 4 * bytes_.size()) throw damage("its pages lead in a circle");
    return {static_cast<const char*>(bytes), static_cast<std::size_t>(size)};
  }

  // Calls `take` for each row of the answer.
  template <class Take>
  void ask(const char* question, std::int64_t parameter, const Take& take) {
    sqlite3_stmt* made = nullptr;
    const int code =
        sqlite3_prepare_v2(base_.get(), question, -1, &made, nullptr);
    const std::unique_ptr<sqlite3_stmt, decltype(&sqlite3_finalize)> statement(
        made, &sqlite3_finalize);
    if (code != SQLITE_OK) throw said();
    if (sqlite3_bind_parameter_count(made) > 0) {
      sqlite3_bind_int64(made, 1, parameter);
    }
    for (;;) {
      const int step = sqlite3_step(made);
      if (step == SQLITE_DONE) return;
      if (step != SQLITE_ROW) throw said();
      take(made);
    }
  }

 private:
  static constexpr std::size_t kOwnMemory = std::size_t{8} << 20;

  // Takes from SQLite what a file could misuse.
  void disarm() {
    sqlite3* const base = base_.get();
    for (const auto& [option, value] :
         {std::pair(SQLITE_DBCONFIG_DEFENSIVE, 1),
          std::pair(SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0),
          std::pair(SQLITE_DBCONFIG_ENABLE_TRIGGER, 0),
          std::pair(SQLITE_DBCONFIG_ENABLE_VIEW, 0)}) {
      sqlite3_db_config(base, option, value, nullptr);
    }
    sqlite3_drop_modules(base, nullptr);
    constexpr int kMostSql = 100'000;
    const auto size = static_cast<int>(
        std::clamp<std::size_t>(bytes_.size(), kMostSql, INT32_MAX));
    for (const auto& [limit, value] :
         {std::pair(SQLITE_LIMIT_LENGTH, size),
          std::pair(SQLITE_LIMIT_SQL_LENGTH, kMostSql),
          std::pair(SQLITE_LIMIT_COLUMN, 100),
          std::pair(SQLITE_LIMIT_EXPR_DEPTH, 50),
          std::pair(SQLITE_LIMIT_COMPOUND_SELECT, 2),
          std::pair(SQLITE_LIMIT_VDBE_OP, 10'000),
          std::pair(SQLITE_LIMIT_FUNCTION_ARG, 3),
          std::pair(SQLITE_LIMIT_ATTACHED, 0),
          std::pair(SQLITE_LIMIT_LIKE_PATTERN_LENGTH, 100),
          std::pair(SQLITE_LIMIT_TRIGGER_DEPTH, 1),
          std::pair(SQLITE_LIMIT_WORKER_THREADS, 0)}) {
      sqlite3_limit(base, limit, value);
    }
  }

  // No exception may pass through SQLite.
  bool goes_on() {
    return limits_.reached({}) == StopReason::None && ++rounds_ <= kMostRounds;
  }

  // What kind of thing has this name, by the file's own words.
  std::string kind_of(const char* name) {
    std::string kind;
    ask("SELECT name, type, sql FROM sqlite_master", 0, [&](sqlite3_stmt* row) {
      if (!equal_ignoring_case(column(row, 0), name)) return;
      const std::string made = lowered(column(row, 2).substr(0, 15));
      kind =
          made.starts_with("create virtual") ? "virtual table" : column(row, 1);
    });
    return shortened(one_line(kind), 20);
  }

  // Before any question names it: to ask a view for its columns can take for
  // ever.
  void refuse_unless_plain(const Columns& columns) {
    for (const char* name : columns.names) {
      if (sqlite3_table_column_metadata(base_.get(), "main", columns.table,
                                        name, nullptr, nullptr, nullptr,
                                        nullptr, nullptr) == SQLITE_OK) {
        continue;
      }
      const std::string kind = kind_of(columns.table);
      if (kind.empty()) {
        throw no_recording(fmt::format("no such table: {}", columns.table));
      }
      if (kind != "table") {
        throw no_recording(
            fmt::format("`{}` is a {}, and only plain tables are read",
                        columns.table, kind));
      }
      throw no_recording(
          fmt::format("`{}` has no column `{}`", columns.table, name));
    }
    ask(fmt::format("PRAGMA main.table_xinfo({})", columns.table).c_str(), 0,
        [&](sqlite3_stmt* row) {
          constexpr int kHidden = 6;  // its column: 2 and 3 are generated
          if (sqlite3_column_int(row, kHidden) < 2) return;
          throw no_recording(fmt::format(
              "the column `{}` of `{}` is generated, and only plain tables "
              "are read",
              shortened(one_line(column(row, 1)), 40), columns.table));
        });
  }

  Diagnostic said() const {
    keep_limits(limits_, 0);
    return damage("SQLite says: " +
                  shortened(one_line(sqlite3_errmsg(base_.get())), 100));
  }

  std::string bytes_;  // must outlive the base
  const Limits& limits_;
  std::size_t read_ = 0;  // bytes, of all columns
  int rounds_ = 0;
  HeapLimit heap_;
  std::unique_ptr<sqlite3, decltype(&sqlite3_close)> base_{nullptr,
                                                           &sqlite3_close};
};

}  // namespace

RosMessages rosbag_messages(std::string_view bytes, std::string_view topic,
                            const Limits& limits) {
  if (bytes.empty()) throw flaw("BT1302", "the file is empty");
  if (!bytes.starts_with(kSqliteMagic)) {
    throw flaw("BT1302", "this is no SQLite database",
               "a .db3 of rosbag2 is one");
  }
  Database base(bytes, limits);
  std::vector<std::string> topics;
  std::vector<std::string> formats;
  std::vector<std::int64_t> ids;
  base.ask(
      "SELECT id, name, type, serialization_format FROM topics NOT INDEXED", 0,
      [&](sqlite3_stmt* row) {
        if (base.column(row, 2) != kTreeLogType) return;
        ids.push_back(sqlite3_column_int64(row, 0));
        topics.push_back(base.column(row, 1));
        formats.push_back(base.column(row, 3));
      });
  const std::size_t chosen = chosen_topic(topics, topic);
  refuse_unless_cdr(topics[chosen], formats[chosen]);
  RosMessages result;
  result.topic = topics[chosen];
  std::size_t unpacked = 0;  // bytes
  base.ask(
      "SELECT timestamp, data FROM messages NOT INDEXED WHERE topic_id = ?1",
      ids[chosen], [&](sqlite3_stmt* row) {
        std::string data = base.column(row, 1);
        // rosbag2 can pack each message for itself.
        if (is_zstd(data)) {
          data = zstd_unpacked(data, kMostUnpacked - unpacked, limits);
          unpacked += data.size();
        }
        result.messages.push_back(
            {static_cast<std::uint64_t>(sqlite3_column_int64(row, 0)),
             std::move(data)});
      });
  std::ranges::stable_sort(result.messages, {}, &RosMessage::time);
  return result;
}

}  // namespace btcheck
