// SPDX-License-Identifier: MIT
//
// Records are read from the first to the last, without the index: a file whose
// recorder was killed has none. A record is its kind, the length of what
// follows, and that; chunks hold records of their own.
#include <fmt/format.h>

#include <algorithm>
#include <boost/crc.hpp>
#include <map>
#include <optional>
#include <utility>

#include "text/choice.hpp"
#include "trace/logs/flaws.hpp"
#include "trace/logs/ros_recording.hpp"
#include "trace/run/little_endian.hpp"
#include "trace/run/mcap_records.hpp"
#include "trace/run/shown_text.hpp"

namespace btcheck {
namespace {

constexpr std::size_t kRecordHead = 9;

// The fields of a record, one after another.
class Fields {
 public:
  explicit Fields(std::string_view bytes) : bytes_(bytes) {}

  std::uint64_t number(std::size_t count) {
    return number_at(take(count), 0, count);
  }
  std::string_view text() { return take(number(4)); }
  std::string_view take(std::uint64_t count) {
    if (count > bytes_.size()) {
      throw damage("a record is shorter than its fields");
    }
    const std::string_view taken = bytes_.substr(0, count);
    bytes_.remove_prefix(count);
    return taken;
  }
  std::string_view rest() const { return bytes_; }

 private:
  std::string_view bytes_;
};

class McapReader {
 public:
  explicit McapReader(const Limits& limits) : limits_(limits) {}

  RosMessages read(std::string_view bytes, std::string_view topic) {
    RosMessages result;
    if (!bytes.starts_with(kMcapMagic)) {
      throw flaw("BT1302",
                 bytes.empty() ? "the file is empty" : "this is no MCAP file");
    }
    result.is_cut_off = !read_records(bytes.substr(kMcapMagic.size()), false);
    const std::uint16_t channel = chosen(topic);
    result.topic = channels_.at(channel).topic;
    for (auto& [of, message] : messages_) {
      if (channels_.at(of).topic == result.topic) {
        result.messages.push_back(std::move(message));
      }
    }
    std::ranges::stable_sort(result.messages, {}, &RosMessage::time);
    return result;
  }

 private:
  struct Channel {
    std::string topic;
    std::string encoding;
    bool is_tree_log = false;
  };

  // False where the last record breaks off.
  bool read_records(std::string_view bytes, bool is_chunk) {
    while (!bytes.empty()) {
      if (bytes.size() < kRecordHead) return false;
      const auto kind =
          static_cast<McapRecord>(static_cast<unsigned char>(bytes[0]));
      const std::uint64_t length = number_at(bytes, 1, 8);
      bytes.remove_prefix(kRecordHead);
      if (length > bytes.size()) return false;
      if (kind == McapRecord{}) throw damage("a record has the kind 0");
      // Behind it stands what repeats channels and schemas.
      if (kind == McapRecord::DataEnd || kind == McapRecord::Footer)
        return true;
      read_record(kind, bytes.substr(0, length), is_chunk);
      bytes.remove_prefix(length);
    }
    return is_chunk;
  }

  void read_record(McapRecord kind, std::string_view bytes, bool is_chunk) {
    Fields fields(bytes);
    switch (kind) {
      case McapRecord::Header:
        fields.text();
        is_own_ = fields.text() == "btcheck";
        break;
      case McapRecord::Schema: {
        const auto id = fields.number(2);
        types_[static_cast<std::uint16_t>(id)] = fields.text();
        break;
      }
      case McapRecord::Channel:
        read_channel(fields);
        break;
      case McapRecord::Message:
        read_message(fields);
        break;
      case McapRecord::Chunk:
        if (is_chunk) throw damage("a chunk is within a chunk");
        read_chunk(fields);
        break;
      default:
        break;
    }
  }

  void read_channel(Fields& fields) {
    const auto id = static_cast<std::uint16_t>(fields.number(2));
    const auto type = static_cast<std::uint16_t>(fields.number(2));
    Channel channel;
    channel.topic = fields.text();
    channel.encoding = fields.text();
    const auto known = types_.find(type);
    if (known == types_.end() && type != 0) {
      throw damage(
          fmt::format("channel {} has a schema that is not there", id));
    }
    channel.is_tree_log =
        known != types_.end() && known->second == kTreeLogType;
    channels_[id] = std::move(channel);
  }

  void read_message(Fields& fields) {
    const auto id = static_cast<std::uint16_t>(fields.number(2));
    const auto channel = channels_.find(id);
    if (channel == channels_.end()) {
      throw damage(
          fmt::format("a message is of channel {}, which is not there", id));
    }
    fields.number(4);
    const std::uint64_t time = fields.number(8);
    fields.number(8);
    if (!channel->second.is_tree_log) return;
    messages_.emplace_back(id, RosMessage{time, std::string(fields.rest())});
  }

  void read_chunk(Fields& fields) {
    fields.number(8);
    fields.number(8);
    const std::uint64_t size = fields.number(8);
    const auto sum = static_cast<std::uint32_t>(fields.number(4));
    const std::string_view packing = fields.text();
    const std::string_view records = fields.take(fields.number(8));
    std::string bytes;
    if (packing == "zstd" || packing == "lz4") {
      if (size > kMostUnpacked - unpacked_) {
        throw flaw("BT1302",
                   fmt::format("the chunks of the recording unpack to more "
                               "than {} bytes",
                               kMostUnpacked),
                   "record the topic alone");
      }
      bytes = packing == "lz4" ? lz4_unpacked(records, size, limits_)
                               : zstd_unpacked(records, size, limits_);
      unpacked_ += size;
    } else if (packing.empty()) {
      bytes = records;
    } else {
      throw flaw("BT1302",
                 fmt::format("the chunks of the recording are packed by `{}`, "
                             "which is not read",
                             shortened(one_line(packing), 20)),
                 "pack them by zstd: mcap compress IN.mcap -o OUT.mcap");
    }
    if (bytes.size() != size) {
      throw damage(fmt::format("a chunk should have {} bytes, {} are there",
                               size, bytes.size()));
    }
    boost::crc_32_type found;
    found.process_bytes(bytes.data(), bytes.size());
    if (sum != 0 && found.checksum() != sum) {
      throw damage("the checksum of a chunk is another");
    }
    if (!read_records(bytes, true)) {
      throw damage("a record goes beyond its chunk");
    }
  }

  std::uint16_t chosen(std::string_view asked) const {
    std::vector<std::string> topics;
    std::vector<std::uint16_t> ids;
    for (const auto& [id, channel] : channels_) {
      if (!channel.is_tree_log) continue;
      // Each node that publishes on a topic may have a channel of its own.
      if (std::ranges::count(topics, channel.topic) > 0) continue;
      topics.push_back(channel.topic);
      ids.push_back(id);
    }
    if (topics.empty() && is_own_) {
      throw flaw("BT1302",
                 "btcheck has written this recording: it has phases to look at "
                 "and no log of the tree",
                 fmt::format("take the run itself (.itf.json), or write {}",
                             word(Choice::Format, "btlog")));
    }
    const std::uint16_t id = ids[chosen_topic(topics, asked)];
    refuse_unless_cdr(channels_.at(id).topic, channels_.at(id).encoding);
    return id;
  }

  const Limits& limits_;
  bool is_own_ = false;
  std::size_t unpacked_ = 0;  // bytes, so far
  std::map<std::uint16_t, std::string> types_;
  std::map<std::uint16_t, Channel> channels_;
  std::vector<std::pair<std::uint16_t, RosMessage>> messages_;
};

}  // namespace

RosMessages mcap_messages(std::string_view bytes, std::string_view topic,
                          const Limits& limits) {
  return McapReader(limits).read(bytes, topic);
}

std::size_t chosen_topic(const std::vector<std::string>& topics,
                         std::string_view asked) {
  constexpr std::size_t kMostNamed = 8;
  std::string names;
  for (std::size_t i = 0; i < topics.size() && i < kMostNamed; ++i) {
    names += fmt::format("{}`{}`", i == 0 ? "" : ", ", one_line(topics[i]));
  }
  if (topics.empty()) {
    throw flaw(
        "BT1302",
        fmt::format("the recording has no topic of the type {}", kTreeLogType),
        "ros2 bag record /behavior_tree_log");
  }
  if (asked.empty() && topics.size() == 1) return 0;
  const auto found = std::ranges::find(topics, asked);
  if (found != topics.end()) {
    return static_cast<std::size_t>(found - topics.begin());
  }
  throw flaw("BT1811",
             asked.empty()
                 ? fmt::format("the recording has several topics that log a "
                               "tree: {}",
                               names)
                 : fmt::format("the recording has no topic `{}` that logs a "
                               "tree, but {}",
                               one_line(asked), names),
             fmt::format("write {}", word(Choice::Topic, one_line(topics[0]))));
}

void refuse_unless_cdr(const std::string& topic, const std::string& encoding) {
  if (encoding == "cdr") return;
  throw flaw(
      "BT1302",
      fmt::format("the messages of `{}` are encoded as `{}`; cdr is read",
                  one_line(topic), shortened(one_line(encoding), 20)));
}

}  // namespace btcheck
