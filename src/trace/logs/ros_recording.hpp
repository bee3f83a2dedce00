// SPDX-License-Identifier: MIT
//
// Recordings of ROS 2: the messages of one topic out of a file of rosbag2, as
// MCAP or as an SQLite database. Nothing in a file is believed: no length
// written in it is allocated before so many bytes are there, and what is packed
// is unpacked as far as it was announced and no further than kMostUnpacked.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "explore/state/limits.hpp"

namespace btcheck {

// What SQLite databases begin with.
inline constexpr std::string_view kSqliteMagic{"SQLite format 3\0", 16};

// The type of Nav2's /behavior_tree_log.
inline constexpr std::string_view kTreeLogType =
    "nav2_msgs/msg/BehaviorTreeLog";

// Of one file, in bytes.
inline constexpr std::size_t kMostUnpacked = std::size_t{1} << 30;

struct RosMessage {
  std::uint64_t time = 0;  // nanoseconds since 1970: when it was recorded
  std::string bytes;       // as ROS serializes it (CDR)
};

struct RosMessages {
  std::string topic;
  std::vector<RosMessage> messages;  // by time
  bool is_cut_off = false;           // the file breaks off within a record
};

// The messages of the one topic of that type, or of `topic` where it is not "".
// Both throw a Diagnostic: BT1302 for what is not read, BT1303 for damage,
// BT1311 where a limit is reached, BT1811 where it is open which topic is
// meant.
RosMessages mcap_messages(std::string_view bytes, std::string_view topic,
                          const Limits& limits);
RosMessages rosbag_messages(std::string_view bytes, std::string_view topic,
                            const Limits& limits);

// Of the topics of kTreeLogType the place of the one that is meant; throws
// BT1811.
std::size_t chosen_topic(const std::vector<std::string>& topics,
                         std::string_view asked);

// Throws BT1302 where the messages of the topic are in another encoding.
void refuse_unless_cdr(const std::string& topic, const std::string& encoding);

// Frames of zstd or of LZ4 unpacked: at most `most` bytes, else damage.
std::string zstd_unpacked(std::string_view packed, std::size_t most,
                          const Limits& limits);
std::string lz4_unpacked(std::string_view packed, std::size_t most,
                         const Limits& limits);
// True for what zstd has packed.
bool is_zstd(std::string_view bytes);

}  // namespace btcheck
