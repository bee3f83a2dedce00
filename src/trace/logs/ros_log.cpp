// SPDX-License-Identifier: MIT
//
// nav2_msgs/msg/BehaviorTreeLog in CDR: four bytes that say in which order
// bytes stand, then the fields, each at a multiple of its size.
//
//   BehaviorTreeLog           Time timestamp, BehaviorTreeStatusChange[] events
//   BehaviorTreeStatusChange  Time timestamp, string node_name, uint16 uid,
//                             string previous_status, string current_status
//
// `uid` is there since Jazzy, and may lie where a text before it is filled up,
// so that a single message can be read both ways. All of a recording can not:
// with uids, each has one name.
#include "trace/logs/ros_log.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <optional>
#include <utility>

#include "text/utf8.hpp"
#include "trace/logs/flaws.hpp"
#include "trace/logs/ros_recording.hpp"
#include "trace/run/mcap_records.hpp"
#include "trace/run/shown_text.hpp"

namespace btcheck {
namespace {

constexpr std::size_t kHead = 4;
// Up to three bytes fill the last word.
constexpr std::size_t kMostFilling = 3;

struct Event {
  std::int64_t time = 0;  // microseconds since 1970
  std::string name;
  std::uint16_t uid = 0;
  LogStatus before{};
  LogStatus after{};
};

// Reads as long as all is well; what follows a flaw is 0 and "".
class Cdr {
 public:
  explicit Cdr(std::string_view bytes) : bytes_(bytes.substr(kHead)) {
    is_little_ = bytes[1] == 1;
  }

  std::uint32_t number(std::size_t size) {
    at_ = (at_ + size - 1) / size * size;
    if (at_ > bytes_.size() || size > bytes_.size() - at_) is_well_ = false;
    if (!is_well_) return 0;
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < size; ++i) {
      const std::size_t place = is_little_ ? size - 1 - i : i;
      value = value << 8 | static_cast<unsigned char>(bytes_[at_ + place]);
    }
    at_ += size;
    return value;
  }

  // Its length counts the zero at its end.
  std::string_view text() {
    const std::uint32_t size = number(4);
    if (size > bytes_.size() - at_ || !is_well_) return flawed();
    const std::string_view text = bytes_.substr(at_, size);
    at_ += size;
    if (size == 0) return text;
    return text.back() == '\0' ? text.substr(0, size - 1) : flawed();
  }

  std::int64_t time() {
    const auto seconds = static_cast<std::int32_t>(number(4));
    return std::int64_t{seconds} * 1'000'000 + number(4) / 1000;
  }

  std::string_view flawed() {
    is_well_ = false;
    return {};
  }
  bool is_well() const { return is_well_; }
  bool is_at_end() const { return bytes_.size() - at_ <= kMostFilling; }

 private:
  std::string_view bytes_;
  bool is_little_ = true;
  std::size_t at_ = 0;
  bool is_well_ = true;
};

LogStatus status(Cdr& cdr) {
  const auto found = std::ranges::find(kLogStatusNames, cdr.text());
  if (found == kLogStatusNames.end()) {
    cdr.flawed();
    return {};
  }
  return static_cast<LogStatus>(found - kLogStatusNames.begin());
}

// The events of a message, with uids or without, or nothing.
std::optional<std::vector<Event>> events_in(std::string_view bytes,
                                            bool has_uids,
                                            const Limits& limits) {
  Cdr cdr(bytes);
  cdr.time();
  std::vector<Event> events;
  for (std::uint32_t left = cdr.number(4); left > 0; --left) {
    Event event;
    event.time = cdr.time();
    event.name = unbroken(cdr.text());
    if (has_uids) event.uid = static_cast<std::uint16_t>(cdr.number(2));
    event.before = status(cdr);
    event.after = status(cdr);
    if (!cdr.is_well()) return std::nullopt;
    events.push_back(std::move(event));
    if (events.size() % kPollInterval == 0) {
      keep_limits(limits, 2 * events.size() * sizeof(Event));
    }
  }
  if (!cdr.is_well() || !cdr.is_at_end()) return std::nullopt;
  return events;
}

// All events of a recording, or the first message that has no such events.
struct Decoded {
  std::vector<Event> events;
  std::optional<std::size_t> flawed;  // its number, from 1
};

Decoded decoded(const std::vector<RosMessage>& messages, bool has_uids,
                const Limits& limits) {
  Decoded all;
  for (std::size_t i = 0; i < messages.size(); ++i) {
    const std::string_view bytes = messages[i].bytes;
    const bool is_cdr = bytes.size() > kHead && bytes[0] == 0 &&
                        (bytes[1] == 0 || bytes[1] == 1);
    if (i % kPollInterval == 0) keep_limits(limits, 0);
    auto events = is_cdr ? events_in(bytes, has_uids, limits) : std::nullopt;
    if (!events) {
      all.flawed = i + 1;
      return all;
    }
    std::ranges::move(*events, std::back_inserter(all.events));
  }
  return all;
}

// The first event whose uid is that of another name, or none.
const Event* misnamed(const std::vector<Event>& events) {
  std::map<std::uint16_t, std::string_view> names;
  for (const Event& event : events) {
    const auto [place, is_new] = names.emplace(event.uid, event.name);
    if (event.uid == 0 || place->second != event.name) return &event;
  }
  return nullptr;
}

BehaviorLog log_of(const RosMessages& recorded, const Limits& limits) {
  const std::string topic = one_line(recorded.topic);
  Decoded all = decoded(recorded.messages, true, limits);
  const Event* other = all.flawed ? nullptr : misnamed(all.events);
  BehaviorLog log;
  log.topic = recorded.topic;
  log.has_uids = !all.flawed && other == nullptr;
  if (!log.has_uids) {
    Decoded without = decoded(recorded.messages, false, limits);
    if (without.flawed && other != nullptr) {
      throw damage(
          fmt::format("the uid {} has two names, `{}` is the second: "
                      "two trees on one topic",
                      other->uid, shortened(one_line(other->name), 40)));
    }
    if (without.flawed) {
      throw damage(fmt::format("message {} of `{}` is no {}",
                               std::max(*all.flawed, *without.flawed), topic,
                               kTreeLogType));
    }
    all = std::move(without);
  }
  if (all.events.empty()) {
    throw flaw("BT1302",
               fmt::format("nothing was recorded of the topic `{}`", topic),
               "record while the robot navigates");
  }
  log.begin = all.events.front().time;
  std::map<std::pair<std::uint16_t, std::string_view>, std::uint16_t> uids;
  for (const Event& event : all.events) {
    const std::size_t number = log.has_uids ? event.uid : log.nodes.size() + 1;
    if (number > UINT16_MAX) throw damage("it has more than 65,535 nodes");
    const auto [place, is_new] = uids.try_emplace(
        {event.uid, event.name}, static_cast<std::uint16_t>(number));
    if (is_new) {
      LogNode& node = log.nodes.emplace_back();
      node.uid = place->second;
      node.name = node.type = event.name;
    }
    log.transitions.push_back(
        {event.time - log.begin, place->second, event.before, event.after});
  }
  std::ranges::sort(log.nodes, {}, &LogNode::uid);
  return log;
}

}  // namespace

bool is_ros_recording(std::string_view file, std::string_view bytes) {
  return bytes.starts_with(kMcapMagic) || bytes.starts_with(kSqliteMagic) ||
         file.ends_with(".mcap") || file.ends_with(".db3");
}

Result<BehaviorLog> read_ros_log(std::string_view file, std::string_view bytes,
                                 std::string_view topic, const Limits& limits) {
  const bool is_database =
      bytes.starts_with(kSqliteMagic) ||
      (file.ends_with(".db3") && !bytes.starts_with(kMcapMagic));
  RosMessages recorded = is_database ? rosbag_messages(bytes, topic, limits)
                                     : mcap_messages(bytes, topic, limits);
  Result<BehaviorLog> result{log_of(recorded, limits), {}};
  if (recorded.is_cut_off) {
    result.diagnostics.push_back(
        flaw("BT1304", "the recording breaks off; what stands before is read"));
    result.diagnostics.back().severity = Severity::Warning;
  }
  return result;
}

}  // namespace btcheck
