// SPDX-License-Identifier: MIT
//
// Recordings of /behavior_tree_log as ROS 2 makes them, and wrong ones: CDR,
// MCAP, and rosbag2's database.
#pragma once

#include <doctest/doctest.h>
#include <lz4frame.h>
#include <sqlite3.h>
#include <zstd.h>

#include <boost/crc.hpp>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "trace/logs/behavior_log.hpp"
#include "trace/run/little_endian.hpp"

namespace btcheck {

inline constexpr std::string_view kLogType = "nav2_msgs/msg/BehaviorTreeLog";

// What the robot says in one message.
struct TreeEvents {
  std::uint64_t time = 0;  // nanoseconds
  std::vector<LogTransition> events;
};

// How messages are written.
struct RosForm {
  bool has_uids = true;
  bool is_big_endian = false;
};

// One message; names by uid.
class CdrWriter {
 public:
  explicit CdrWriter(RosForm form) : form_(form) {}

  std::string write(const TreeEvents& message, const BehaviorLog& log) {
    stamp(static_cast<std::int64_t>(message.time / 1000));
    number(message.events.size(), 4);
    for (const LogTransition& event : message.events) {
      stamp(log.begin + event.time);
      text(log.find(event.uid)->name);
      if (form_.has_uids) number(event.uid, 2);
      text(kLogStatusNames[static_cast<std::size_t>(event.before)]);
      text(kLogStatusNames[static_cast<std::size_t>(event.after)]);
    }
    const char order = form_.is_big_endian ? '\0' : '\x01';
    return std::string{'\0', order, '\0', '\0'} + bytes_;
  }

 private:
  void number(std::uint64_t value, std::size_t size) {
    while (bytes_.size() % size != 0) bytes_ += '\0';
    std::string bytes;
    append_number(bytes, value, size);
    if (form_.is_big_endian) bytes.assign(bytes.rbegin(), bytes.rend());
    bytes_ += bytes;
  }
  void text(std::string_view text) {
    number(text.size() + 1, 4);
    bytes_ += text;
    bytes_ += '\0';
  }
  void stamp(std::int64_t time) {
    number(static_cast<std::uint64_t>(time / 1'000'000), 4);
    number(static_cast<std::uint64_t>(time % 1'000'000) * 1000, 4);
  }

  RosForm form_;
  std::string bytes_;
};

// A topic with what was said on it.
struct RosTopic {
  std::string name = "/behavior_tree_log";
  std::string type{kLogType};
  std::string encoding = "cdr";
  std::vector<std::pair<std::uint64_t, std::string>> messages = {};
};

// The log as Nav2 tells it, three changes to a message.
inline RosTopic topic_of(const BehaviorLog& log, RosForm form = {}) {
  RosTopic topic;
  for (std::size_t i = 0; i < log.transitions.size(); i += 3) {
    TreeEvents message;
    const std::size_t end = std::min(i + 3, log.transitions.size());
    message.events.assign(
        log.transitions.begin() + static_cast<std::ptrdiff_t>(i),
        log.transitions.begin() + static_cast<std::ptrdiff_t>(end));
    message.time = static_cast<std::uint64_t>(
        (log.begin + message.events.back().time) * 1000);
    topic.messages.emplace_back(message.time,
                                CdrWriter(form).write(message, log));
  }
  return topic;
}

enum class Chunks : std::uint8_t { None, Plain, Zstd, Lz4 };

inline std::string mcap_record(unsigned char kind, const std::string& body) {
  std::string bytes(1, static_cast<char>(kind));
  append_number(bytes, body.size(), 8);
  return bytes + body;
}

inline std::string mcap_text(std::string_view text) {
  std::string bytes;
  append_number(bytes, text.size(), 4);
  return bytes.append(text);
}

inline std::string mcap_chunk(const std::string& records,
                              std::string_view packing,
                              const std::string& packed) {
  boost::crc_32_type sum;
  sum.process_bytes(records.data(), records.size());
  std::string body(16, '\0');
  append_number(body, records.size(), 8);
  append_number(body, sum.checksum(), 4);
  body += mcap_text(packing);
  append_number(body, packed.size(), 8);
  return mcap_record(0x06, body + packed);
}

inline std::string zstd_packed(const std::string& bytes) {
  std::string packed(ZSTD_compressBound(bytes.size()), '\0');
  packed.resize(ZSTD_compress(packed.data(), packed.size(), bytes.data(),
                              bytes.size(), 3));
  return packed;
}

inline std::string lz4_packed(const std::string& bytes) {
  std::string packed(LZ4F_compressFrameBound(bytes.size(), nullptr), '\0');
  packed.resize(LZ4F_compressFrame(packed.data(), packed.size(), bytes.data(),
                                   bytes.size(), nullptr));
  return packed;
}

inline std::string mcap_of(const std::vector<RosTopic>& topics,
                           Chunks chunks = Chunks::None) {
  std::string records;
  std::size_t id = 0;
  for (const RosTopic& topic : topics) {
    std::string schema;
    append_number(schema, ++id, 2);
    records += mcap_record(0x03, schema + mcap_text(topic.type) +
                                     mcap_text("ros2msg") + mcap_text(""));
    std::string channel;
    append_number(channel, id, 2);
    append_number(channel, id, 2);
    records += mcap_record(0x04, channel + mcap_text(topic.name) +
                                     mcap_text(topic.encoding) + mcap_text(""));
    for (const auto& [time, bytes] : topic.messages) {
      std::string message;
      append_number(message, id, 2);
      append_number(message, 0, 4);
      append_number(message, time, 8);
      append_number(message, time, 8);
      records += mcap_record(0x05, message + bytes);
    }
  }
  if (chunks == Chunks::Plain) records = mcap_chunk(records, "", records);
  if (chunks == Chunks::Zstd) {
    records = mcap_chunk(records, "zstd", zstd_packed(records));
  }
  if (chunks == Chunks::Lz4) {
    records = mcap_chunk(records, "lz4", lz4_packed(records));
  }
  const std::string magic = "\x89MCAP0\r\n";
  return magic + mcap_record(0x01, mcap_text("ros2") + mcap_text("libmcap")) +
         records + mcap_record(0x0F, std::string(4, '\0')) +
         mcap_record(0x02, std::string(20, '\0')) + magic;
}

// A database with what `more` says as well.
inline std::string database_of(const std::vector<RosTopic>& topics,
                               const std::string& tables = "") {
  sqlite3* base = nullptr;
  REQUIRE(sqlite3_open(":memory:", &base) == SQLITE_OK);
  const auto run = [&](const std::string& words) {
    char* flaw = nullptr;
    sqlite3_exec(base, words.c_str(), nullptr, nullptr, &flaw);
    REQUIRE_MESSAGE(flaw == nullptr, words);
  };
  if (!tables.empty()) {
    run(tables);
  } else {
    run("CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT NOT NULL, type "
        "TEXT NOT NULL, serialization_format TEXT NOT NULL, "
        "offered_qos_profiles TEXT NOT NULL);"
        "CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER NOT "
        "NULL, timestamp INTEGER NOT NULL, data BLOB NOT NULL);"
        "CREATE INDEX timestamp_idx ON messages (timestamp ASC);");
  }
  std::size_t id = 0;
  for (const RosTopic& topic : topics) {
    const std::string number = std::to_string(++id);
    run("INSERT INTO topics VALUES(" + number + ",'" + topic.name + "','" +
        topic.type + "','" + topic.encoding + "','')");
    sqlite3_stmt* row = nullptr;
    sqlite3_prepare_v2(base,
                       "INSERT INTO messages(topic_id,timestamp,data) "
                       "VALUES(?1,?2,?3)",
                       -1, &row, nullptr);
    for (const auto& [time, bytes] : topic.messages) {
      sqlite3_bind_int64(row, 1, static_cast<sqlite3_int64>(id));
      sqlite3_bind_int64(row, 2, static_cast<sqlite3_int64>(time));
      sqlite3_bind_blob(row, 3, bytes.data(), static_cast<int>(bytes.size()),
                        SQLITE_TRANSIENT);
      REQUIRE(sqlite3_step(row) == SQLITE_DONE);
      sqlite3_reset(row);
    }
    sqlite3_finalize(row);
  }
  sqlite3_int64 size = 0;
  unsigned char* bytes = sqlite3_serialize(base, "main", &size, 0);
  REQUIRE(bytes != nullptr);
  const std::string text(reinterpret_cast<const char*>(bytes),
                         static_cast<std::size_t>(size));
  sqlite3_free(bytes);
  sqlite3_close(base);
  return text;
}

}  // namespace btcheck
