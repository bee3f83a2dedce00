// SPDX-License-Identifier: MIT
//
// A .db3 of rosbag2 has the tables `topics` and `messages`. SQLite reads it out
// of memory, read-only, and may look at these two tables and do nothing else: a
// view or a trigger in a stranger's file is not executed.
#include <fmt/format.h>
#include <sqlite3.h>

#include <array>
#include <cstring>
#include <memory>
#include <utility>

#include "trace/logs/flaws.hpp"
#include "trace/logs/ros_recording.hpp"
#include "trace/run/shown_text.hpp"

namespace btcheck {
namespace {

// So many times a thousand instructions of SQLite for one file.
constexpr int kMostRounds = 200'000;

// Reads columns of the two tables, from no view.
int allow(void*, int action, const char* table, const char*, const char*,
          const char* within) {
  if (within != nullptr) return SQLITE_DENY;
  if (action == SQLITE_SELECT) return SQLITE_OK;
  if (action != SQLITE_READ || table == nullptr) return SQLITE_DENY;
  const std::string_view name = table;
  return name == "topics" || name == "messages" ? SQLITE_OK : SQLITE_DENY;
}

class Database {
 public:
  explicit Database(std::string_view bytes) : bytes_(bytes) {
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
    sqlite3_db_config(opened, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
    sqlite3_db_config(opened, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
    sqlite3_db_config(opened, SQLITE_DBCONFIG_ENABLE_TRIGGER, 0, nullptr);
    sqlite3_db_config(opened, SQLITE_DBCONFIG_ENABLE_VIEW, 0, nullptr);
    sqlite3_progress_handler(
        opened, 1000,
        [](void* rounds) -> int {
          return ++*static_cast<int*>(rounds) > kMostRounds;
        },
        &rounds_);
    sqlite3_set_authorizer(opened, allow, nullptr);
  }

  // Calls `take` for each row of the answer.
  template <class Take>
  void ask(const char* question, std::int64_t parameter, const Take& take) {
    sqlite3_stmt* made = nullptr;
    const int code =
        sqlite3_prepare_v2(base_.get(), question, -1, &made, nullptr);
    const std::unique_ptr<sqlite3_stmt, decltype(&sqlite3_finalize)> statement(
        made, &sqlite3_finalize);
    if (code == SQLITE_ERROR || code == SQLITE_AUTH) {
      throw flaw("BT1302",
                 fmt::format("this database is no recording of rosbag2: {}",
                             message()),
                 "its tables would be `topics` and `messages`");
    }
    if (code != SQLITE_OK) throw damage("SQLite says: " + message());
    if (sqlite3_bind_parameter_count(made) > 0) {
      sqlite3_bind_int64(made, 1, parameter);
    }
    for (;;) {
      const int step = sqlite3_step(made);
      if (step == SQLITE_DONE) return;
      if (step != SQLITE_ROW) throw damage("SQLite says: " + message());
      take(made);
    }
  }

 private:
  std::string message() const {
    return shortened(one_line(sqlite3_errmsg(base_.get())), 100);
  }

  std::string bytes_;  // must outlive the base
  int rounds_ = 0;
  std::unique_ptr<sqlite3, decltype(&sqlite3_close)> base_{nullptr,
                                                           &sqlite3_close};
};

std::string column(sqlite3_stmt* row, int number) {
  const void* bytes = sqlite3_column_blob(row, number);
  const int size = sqlite3_column_bytes(row, number);
  if (bytes == nullptr || size <= 0) return {};
  return {static_cast<const char*>(bytes), static_cast<std::size_t>(size)};
}

}  // namespace

RosMessages rosbag_messages(std::string_view bytes, std::string_view topic) {
  if (bytes.empty()) throw flaw("BT1302", "the file is empty");
  if (!bytes.starts_with(kSqliteMagic)) {
    throw flaw("BT1302", "this is no SQLite database",
               "a .db3 of rosbag2 is one");
  }
  Database base(bytes);
  std::vector<std::string> topics;
  std::vector<std::string> formats;
  std::vector<std::int64_t> ids;
  base.ask(
      "SELECT id, name, type, serialization_format FROM topics ORDER BY id", 0,
      [&](sqlite3_stmt* row) {
        if (column(row, 2) != kTreeLogType) return;
        ids.push_back(sqlite3_column_int64(row, 0));
        topics.push_back(column(row, 1));
        formats.push_back(column(row, 3));
      });
  const std::size_t chosen = chosen_topic(topics, topic);
  refuse_unless_cdr(topics[chosen], formats[chosen]);
  RosMessages result;
  result.topic = topics[chosen];
  std::size_t whole = 0;
  base.ask(
      "SELECT timestamp, data FROM messages WHERE topic_id = ?1 "
      "ORDER BY timestamp, id",
      ids[chosen], [&](sqlite3_stmt* row) {
        std::string data = column(row, 1);
        // rosbag2 can pack each message for itself.
        if (is_zstd(data)) data = zstd_unpacked(data, kMostUnpacked - whole);
        whole += data.size();
        result.messages.push_back(
            {static_cast<std::uint64_t>(sqlite3_column_int64(row, 0)),
             std::move(data)});
      });
  return result;
}

}  // namespace btcheck
