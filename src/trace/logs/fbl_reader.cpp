// SPDX-License-Identifier: MIT
//
// A .fbl begins with the tree as a flatbuffer (BehaviorTree.CPP 3,
// flatbuffers/BT_logger.fbs). A flatbuffer is tables, strings and lists that
// refer to one another by offsets, and a table's fields stand where its vtable
// says; so every offset is looked at before it is followed. What leads out of
// the buffer reads as zero and marks the buffer as broken.
#include <fmt/format.h>

#include <map>
#include <utility>

#include "trace/logs/behavior_log.hpp"
#include "trace/logs/log_tree.hpp"
#include "trace/run/little_endian.hpp"

namespace btcheck {
namespace {

constexpr std::size_t kRecordSize = 12;
// In bytes; a buffer may refer to one long text from everywhere.
constexpr std::size_t kLongestName = 1000;

class FlatBuffer {
 public:
  explicit FlatBuffer(std::string_view bytes) : bytes_(bytes) {}

  bool is_broken() const { return is_broken_; }

  // The unsigned number of so many bytes at a place.
  std::size_t number(std::size_t at, std::size_t count) {
    if (at > bytes_.size() || count > bytes_.size() - at) {
      is_broken_ = true;
      return 0;
    }
    return static_cast<std::size_t>(number_at(bytes_, at, count));
  }

  // The place that the offset at a place leads to.
  std::size_t followed(std::size_t at) { return at + number(at, 4); }

  // The place of a table's field, 0 where the table does not have it.
  std::size_t field(std::size_t table, std::size_t index) {
    const auto back = static_cast<std::int32_t>(number(table, 4));
    const std::int64_t vtable = static_cast<std::int64_t>(table) - back;
    if (vtable < 0) {
      is_broken_ = true;
      return 0;
    }
    const auto start = static_cast<std::size_t>(vtable);
    const std::size_t slot = 4 + 2 * index;
    if (slot + 2 > number(start, 2)) return 0;
    const std::size_t offset = number(start + slot, 2);
    return offset == 0 ? 0 : table + offset;
  }

  // The list that a field refers to; an empty one where there is no field.
  struct List {
    std::size_t begin = 0;  // the place of the first element
    std::size_t count = 0;
  };
  List list(std::size_t field, std::size_t element_size) {
    if (field == 0) return {};
    const std::size_t place = followed(field);
    const std::size_t count = number(place, 4);
    if (is_broken_ || count > (bytes_.size() - place - 4) / element_size) {
      is_broken_ = true;
      return {};
    }
    return {place + 4, count};
  }

  std::string text(std::size_t field) {
    const List letters = list(field, 1);
    is_broken_ |= letters.count > kLongestName;
    if (is_broken_) return "";
    return std::string(bytes_.substr(letters.begin, letters.count));
  }

 private:
  std::string_view bytes_;
  bool is_broken_ = false;
};

// The fields of TreeNode and BehaviorTree in BT_logger.fbs, by their place.
enum TreeNodeField : std::size_t {
  kUid = 0,
  kChildrenUid = 1,
  kInstanceName = 3,
  kRegistrationName = 4
};
constexpr std::size_t kNodesField = 1;

std::uint16_t uid_at(FlatBuffer& buffer, std::size_t place) {
  return static_cast<std::uint16_t>(place == 0 ? 0 : buffer.number(place, 2));
}

class TreeReader {
 public:
  explicit TreeReader(std::string_view bytes) : buffer_(bytes) {}

  // What is wrong with the buffer, or "".
  std::string read(std::vector<LogNode>& nodes) {
    const std::size_t tree = buffer_.followed(0);
    const auto tables = buffer_.list(buffer_.field(tree, kNodesField), 4);
    for (std::size_t i = 0; i < tables.count; ++i) {
      add_node(buffer_.followed(tables.begin + 4 * i));
      if (buffer_.is_broken()) flaw_ = "an offset leads astray";
      if (!flaw_.empty()) return flaw_;
    }
    if (buffer_.is_broken()) return "an offset leads astray";
    if (nodes_.empty()) return "there is no node";
    for (const auto& [child, parent] : parents_) {
      const auto node = nodes_.find(child);
      if (node == nodes_.end()) {
        return fmt::format("node {} has a child {}, which is not there", parent,
                           child);
      }
      node->second.parent = parent;
    }
    for (auto& [uid, node] : nodes_) nodes.push_back(std::move(node));
    return ordered_nodes(nodes);
  }

 private:
  void add_node(std::size_t table) {
    LogNode node;
    node.uid = uid_at(buffer_, buffer_.field(table, kUid));
    node.name = buffer_.text(buffer_.field(table, kInstanceName));
    node.type = buffer_.text(buffer_.field(table, kRegistrationName));
    const auto children = buffer_.list(buffer_.field(table, kChildrenUid), 2);
    for (std::size_t i = 0; i < children.count; ++i) {
      const std::uint16_t child = uid_at(buffer_, children.begin + 2 * i);
      if (!parents_.emplace(child, node.uid).second) {
        flaw_ = fmt::format("node {} has two parents", child);
        return;
      }
    }
    const std::uint16_t uid = node.uid;
    if (!nodes_.emplace(uid, std::move(node)).second) {
      flaw_ = fmt::format("two nodes have the uid {}", uid);
    }
  }

  FlatBuffer buffer_;
  std::map<std::uint16_t, LogNode> nodes_;          // by uid
  std::map<std::uint16_t, std::uint16_t> parents_;  // by uid
  std::string flaw_;
};

LogRecord read_record(std::string_view bytes, std::size_t at) {
  const auto status = [&](std::size_t offset) {
    return static_cast<int>(
        static_cast<std::int8_t>(number_at(bytes, at + offset, 1)));
  };
  return {static_cast<std::int64_t>(number_at(bytes, at, 4)) * 1'000'000 +
              static_cast<std::int64_t>(number_at(bytes, at + 4, 4)),
          static_cast<std::uint16_t>(number_at(bytes, at + 8, 2)), status(10),
          status(11)};
}

}  // namespace

Result<BehaviorLog> read_fbl(std::string_view file, std::string_view bytes) {
  if (bytes.size() < 4) return damaged_log(file, "its heading is cut off");
  const std::uint64_t length = number_at(bytes, 0, 4);
  if (length > bytes.size() - 4) {
    return damaged_log(file, fmt::format("its tree should have {} bytes, {} "
                                         "are there",
                                         length, bytes.size() - 4));
  }
  BehaviorLog log;
  log.version = 3;
  const std::string flaw = TreeReader(bytes.substr(4, length)).read(log.nodes);
  if (!flaw.empty()) return damaged_log(file, "in its tree, " + flaw);
  auto result = with_records(std::move(log), file, bytes, 4 + length,
                             kRecordSize, read_record);
  if (!result.value || result.value->transitions.empty()) return result;
  // Records have the time of day; a log begins with the first.
  result.value->begin = result.value->transitions.front().time;
  for (LogTransition& transition : result.value->transitions) {
    transition.time -= result.value->begin;
  }
  return result;
}

}  // namespace btcheck
