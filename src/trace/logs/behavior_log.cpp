// SPDX-License-Identifier: MIT
//
// Nothing in a file is believed: nodes must form trees, and records must be
// about them. Only a last record that is cut off is forgiven, with a warning.
#include "trace/logs/behavior_log.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <map>
#include <utility>

#include "model/btcpp/xml_text.hpp"
#include "text/utf8.hpp"
#include "trace/logs/flaws.hpp"
#include "trace/logs/ros_log.hpp"
#include "trace/run/little_endian.hpp"

namespace btcheck {
namespace {

Diagnostic other_log(std::string message) {
  return flaw(
      "BT1302", std::move(message),
      "logs of FileLogger2 (.btlog), of BehaviorTree.CPP 3's FileLogger "
      "(.fbl) and recordings of ROS 2 (.mcap, .db3) can be read");
}

// --- Nodes and records -------------------------------------------------------

// Puts the nodes in the order of their uids and finds out how deep they stand.
void order(std::vector<LogNode>& nodes, const std::string& place) {
  std::ranges::stable_sort(nodes, {}, &LogNode::uid);
  const auto twice = std::ranges::adjacent_find(nodes, {}, &LogNode::uid);
  if (twice != nodes.end()) {
    throw damage(fmt::format("{}two nodes have the uid {}", place, twice->uid));
  }
  std::multimap<std::uint16_t, LogNode*> children;
  std::vector<const LogNode*> reached;
  for (LogNode& node : nodes) {
    if (node.parent) {
      children.emplace(*node.parent, &node);
    } else {
      reached.push_back(&node);
    }
  }
  for (std::size_t i = 0; i < reached.size(); ++i) {
    const auto [begin, end] = children.equal_range(reached[i]->uid);
    for (auto child = begin; child != end; ++child) {
      child->second->depth = reached[i]->depth + 1;
      reached.push_back(child->second);
    }
  }
  if (reached.size() != nodes.size()) {
    throw damage(place + "a node is below itself");
  }
}

// One record, as both formats have them.
struct LogRecord {
  std::int64_t time = 0;
  std::uint16_t uid = 0;
  std::optional<int> before;  // else: the status that was logged last
  int after = 0;
};

// Adds the records of so many bytes that begin at a byte. `read` reads the one
// at a byte.
template <class Read>
Result<BehaviorLog> with_records(BehaviorLog log, std::string_view bytes,
                                 std::size_t at, std::size_t size,
                                 const Read& read) {
  std::map<std::uint16_t, LogStatus> last;
  std::size_t number = 0;
  for (; bytes.size() - at >= size; at += size) {
    const LogRecord record = read(bytes, at);
    const std::string where = fmt::format("record {} (byte {})", ++number, at);
    for (const int status : {record.before.value_or(0), record.after}) {
      if (status < 0 || status > static_cast<int>(LogStatus::Skipped)) {
        throw damage(fmt::format("{} has the status {}", where, status));
      }
    }
    if (log.find(record.uid) == nullptr) {
      throw damage(
          fmt::format("{} is about node {}, which the tree does not "
                      "have",
                      where, record.uid));
    }
    LogStatus& status = last[record.uid];
    const LogStatus before =
        record.before ? static_cast<LogStatus>(*record.before) : status;
    status = static_cast<LogStatus>(record.after);
    log.transitions.push_back({record.time, record.uid, before, status});
  }
  Result<BehaviorLog> result{std::move(log), {}};
  if (at < bytes.size()) {
    result.diagnostics.push_back(flaw(
        "BT1304", fmt::format("the last record is cut off: {} of {} bytes are "
                              "there",
                              bytes.size() - at, size)));
    result.diagnostics.back().severity = Severity::Warning;
  }
  return result;
}

// --- BehaviorTree.CPP 4 ------------------------------------------------------

constexpr std::size_t kBtlogRecord = 9;

// The heading of a .btlog is an XML with a _uid on each node. Trees below a
// SubTree stand beside the main one; the same _fullpath on both says which
// belongs where.
class XmlTree {
 public:
  void read(std::string_view xml, BehaviorLog& log) {
    const btcpp::ParsedXml parsed{std::string(xml)};
    if (!parsed.value) {
      const Diagnostic& why = parsed.diagnostics.front();
      throw damaged(why.span.line, why.label);
    }
    inside_.resize(parsed.value->size());
    for (std::size_t i = 1; i < inside_.size(); ++i) {
      take((*parsed.value)[i], inside_[i]);
    }
    if (nodes_.empty()) throw damaged(0, "there is no node with a _uid");
    order(nodes_, "in its XML, ");
    log.nodes = std::move(nodes_);
    log.tree = std::move(tree_);
  }

 private:
  // What the elements inside one are.
  struct Inside {
    bool are_nodes = false;
    std::optional<std::uint16_t> parent;  // theirs
  };

  static Diagnostic damaged(int line, std::string_view flaw) {
    const std::string place = line == 0 ? "" : fmt::format("line {}: ", line);
    return damage(fmt::format("in its XML, {}{}", place, flaw));
  }

  void take(const btcpp::XmlElement& element, Inside& inside) {
    const Inside& outer = inside_[element.parent];
    if (outer.are_nodes) {
      inside = {true, add_node(element, outer.parent)};
    } else if (element.parent == 0 && element.name == "BehaviorTree") {
      const std::string* path = element.value("_fullpath");
      const auto owner = subtrees_.find(path != nullptr ? *path : "");
      inside.are_nodes = true;
      const std::string* id = element.value("ID");
      if (owner == subtrees_.end() && tree_.empty() && id != nullptr) {
        tree_ = *id;
      }
      if (owner != subtrees_.end()) inside.parent = owner->second;
    }
  }

  std::uint16_t add_node(const btcpp::XmlElement& element,
                         std::optional<std::uint16_t> parent) {
    LogNode node;
    node.type = element.name;
    node.parent = parent;
    const std::string* uid = element.value("_uid");
    const std::string* name = element.value("name");
    const std::string* id = element.value("ID");
    const std::string* path = element.value("_fullpath");
    const bool is_subtree = element.name == "SubTree";
    if (name == nullptr) name = id;
    if (name != nullptr) node.name = *name;
    // <Action ID="Fly"/> is the long form of <Fly/>.
    if (id != nullptr && !is_subtree) node.type = *id;
    if (uid == nullptr || !read_uid(*uid, node.uid)) {
      throw damaged(element.span.line,
                    fmt::format("<{}> has no _uid", element.name));
    }
    if (path != nullptr && is_subtree && element.value("name") == nullptr) {
      node.name = instance_in(*path, *uid);
    }
    if (path != nullptr && is_subtree &&
        !subtrees_.emplace(*path, node.uid).second) {
      throw damaged(element.span.line,
                    fmt::format("two SubTrees have the path `{}`", *path));
    }
    nodes_.push_back(std::move(node));
    return nodes_.back().uid;
  }

  // "outer/inner" is the path of the instance `inner`; one that its author has
  // not named has the name of its tree and its uid, "outer/Tree::7"
  // (src/xml_parsing.cpp of 4.10).
  static std::string instance_in(std::string_view path, std::string_view uid) {
    path.remove_prefix(path.rfind('/') + 1);
    const std::string number = fmt::format("::{}", uid);
    if (path.ends_with(number)) path.remove_suffix(number.size());
    return std::string(path);
  }

  static bool read_uid(const std::string& text, std::uint16_t& uid) {
    const char* end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, uid);
    return error == std::errc() && stop == end;
  }

  std::vector<Inside> inside_;  // by element
  std::vector<LogNode> nodes_;
  std::map<std::string, std::uint16_t> subtrees_;  // by path
  std::string tree_;                               // the main one
};

LogRecord btlog_record(std::string_view bytes, std::size_t at) {
  return {static_cast<std::int64_t>(number_at(bytes, at, 6)),
          static_cast<std::uint16_t>(number_at(bytes, at + 6, 2)), std::nullopt,
          static_cast<int>(number_at(bytes, at + 8, 1))};
}

Result<BehaviorLog> read_btlog(std::string_view bytes) {
  const std::string_view magic = bytes.substr(0, kBtlogMagic.size());
  if (magic.empty()) throw other_log("the file is empty");
  if (!kBtlogMagic.starts_with(magic)) {
    throw other_log("this is no log of BehaviorTree.CPP 4");
  }
  std::size_t at = kBtlogMagic.size();
  if (bytes.size() < at + 5) throw damage("its heading is cut off");
  if (const auto version = number_at(bytes, at, 1); version != kBtlogVersion) {
    throw other_log(
        fmt::format("the log's format has version {}; version {} is known",
                    version, kBtlogVersion));
  }
  const std::uint64_t length = number_at(bytes, at + 1, 4);
  at += 5;
  if (length > bytes.size() - at) {
    throw damage(fmt::format("its XML should have {} bytes, {} are there",
                             length, bytes.size() - at));
  }
  BehaviorLog log;
  log.xml = bytes.substr(at, length);
  XmlTree().read(log.xml, log);
  at += length;
  if (bytes.size() - at < 8) {
    throw damage("the time of its beginning is cut off");
  }
  log.begin = static_cast<std::int64_t>(number_at(bytes, at, 8));
  return with_records(std::move(log), bytes, at + 8, kBtlogRecord,
                      btlog_record);
}

// --- BehaviorTree.CPP 3 ------------------------------------------------------

constexpr std::size_t kFblRecord = 12;
// In bytes; a buffer may refer to one long text from everywhere.
constexpr std::size_t kLongestName = 1000;

Diagnostic astray() { return damage("in its tree, an offset leads astray"); }

// A .fbl begins with the tree as a flatbuffer (flatbuffers/BT_logger.fbs):
// tables, strings and lists that refer to one another by offsets, and a table's
// fields stand where its vtable says; so every offset is looked at before it is
// followed.
class FlatBuffer {
 public:
  explicit FlatBuffer(std::string_view bytes) : bytes_(bytes) {}

  // The unsigned number of so many bytes at a place.
  std::size_t number(std::size_t at, std::size_t count) const {
    if (at > bytes_.size() || count > bytes_.size() - at) throw astray();
    return static_cast<std::size_t>(number_at(bytes_, at, count));
  }

  // The place that the offset at a place leads to.
  std::size_t followed(std::size_t at) const { return at + number(at, 4); }

  // The place of a table's field, 0 where the table does not have it.
  std::size_t field(std::size_t table, std::size_t index) const {
    const auto back = static_cast<std::int32_t>(number(table, 4));
    const std::int64_t vtable = static_cast<std::int64_t>(table) - back;
    if (vtable < 0) throw astray();
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
  List list(std::size_t field, std::size_t element_size) const {
    if (field == 0) return {};
    const std::size_t place = followed(field);
    const std::size_t count = number(place, 4);
    if (count > (bytes_.size() - place - 4) / element_size) throw astray();
    return {place + 4, count};
  }

  std::string text(std::size_t field) const {
    const List letters = list(field, 1);
    if (letters.count > kLongestName) throw astray();
    return unbroken(bytes_.substr(letters.begin, letters.count));
  }

  std::uint16_t uid(std::size_t place) const {
    return static_cast<std::uint16_t>(place == 0 ? 0 : number(place, 2));
  }

 private:
  std::string_view bytes_;
};

// The fields of TreeNode and BehaviorTree in BT_logger.fbs, by their place.
enum TreeNodeField : std::size_t {
  kUid = 0,
  kChildrenUid = 1,
  kInstanceName = 3,
  kRegistrationName = 4
};
constexpr std::size_t kNodesField = 1;

std::vector<LogNode> flat_tree(const FlatBuffer& buffer) {
  std::map<std::uint16_t, LogNode> by_uid;
  std::map<std::uint16_t, std::uint16_t> parents;
  const std::size_t tree = buffer.followed(0);
  const auto tables = buffer.list(buffer.field(tree, kNodesField), 4);
  for (std::size_t t = 0; t < tables.count; ++t) {
    const std::size_t table = buffer.followed(tables.begin + 4 * t);
    LogNode node;
    node.uid = buffer.uid(buffer.field(table, kUid));
    node.name = buffer.text(buffer.field(table, kInstanceName));
    node.type = buffer.text(buffer.field(table, kRegistrationName));
    const auto children = buffer.list(buffer.field(table, kChildrenUid), 2);
    for (std::size_t i = 0; i < children.count; ++i) {
      const std::uint16_t child = buffer.uid(children.begin + 2 * i);
      if (!parents.emplace(child, node.uid).second) {
        throw damage(
            fmt::format("in its tree, node {} has two parents", child));
      }
    }
    if (!by_uid.emplace(node.uid, node).second) {
      throw damage(
          fmt::format("in its tree, two nodes have the uid {}", node.uid));
    }
  }
  if (by_uid.empty()) throw damage("in its tree, there is no node");
  for (const auto& [child, parent] : parents) {
    const auto node = by_uid.find(child);
    if (node == by_uid.end()) {
      throw damage(
          fmt::format("in its tree, node {} has a child {}, which is "
                      "not there",
                      parent, child));
    }
    node->second.parent = parent;
  }
  std::vector<LogNode> nodes;
  for (auto& [uid, node] : by_uid) nodes.push_back(std::move(node));
  order(nodes, "in its tree, ");
  return nodes;
}

LogRecord fbl_record(std::string_view bytes, std::size_t at) {
  const auto status = [&](std::size_t offset) {
    return static_cast<int>(
        static_cast<std::int8_t>(number_at(bytes, at + offset, 1)));
  };
  return {static_cast<std::int64_t>(number_at(bytes, at, 4)) * 1'000'000 +
              static_cast<std::int64_t>(number_at(bytes, at + 4, 4)),
          static_cast<std::uint16_t>(number_at(bytes, at + 8, 2)), status(10),
          status(11)};
}

Result<BehaviorLog> read_fbl(std::string_view bytes) {
  if (bytes.size() < 4) throw damage("its heading is cut off");
  const std::uint64_t length = number_at(bytes, 0, 4);
  if (length > bytes.size() - 4) {
    throw damage(fmt::format("its tree should have {} bytes, {} are there",
                             length, bytes.size() - 4));
  }
  BehaviorLog log;
  log.version = 3;
  log.nodes = flat_tree(FlatBuffer(bytes.substr(4, length)));
  auto result =
      with_records(std::move(log), bytes, 4 + length, kFblRecord, fbl_record);
  if (result.value->transitions.empty()) return result;
  // Records have the time of day; a log begins with the first.
  result.value->begin = result.value->transitions.front().time;
  for (LogTransition& transition : result.value->transitions) {
    transition.time -= result.value->begin;
  }
  return result;
}

}  // namespace

const LogNode* BehaviorLog::find(std::uint16_t uid) const {
  const auto found = std::ranges::lower_bound(nodes, uid, {}, &LogNode::uid);
  return found != nodes.end() && found->uid == uid ? &*found : nullptr;
}

bool is_log(std::string_view file, std::string_view bytes) {
  return bytes.starts_with(kBtlogMagic) || file.ends_with(".fbl") ||
         file.ends_with(".btlog") || is_ros_recording(file, bytes);
}

Result<BehaviorLog> read_log(std::string_view file, std::string_view bytes,
                             std::string_view topic, const Limits& limits) {
  const bool is_btlog = bytes.starts_with(kBtlogMagic);
  try {
    auto result = is_btlog ? read_btlog(bytes)
                  : is_ros_recording(file, bytes)
                      ? read_ros_log(file, bytes, topic, limits)
                  : file.ends_with(".fbl") ? read_fbl(bytes)
                                           : read_btlog(bytes);
    for (Diagnostic& found : result.diagnostics) found.file = file;
    return result;
  } catch (Diagnostic& found) {
    found.file = file;
    return {std::nullopt, {std::move(found)}};
  }
}

}  // namespace btcheck
