// SPDX-License-Identifier: MIT
//
// The heading of a .btlog is an XML of BehaviorTree.CPP with a _uid on each
// node. Trees below a SubTree stand beside the main one; the same _fullpath on
// both says which belongs where.
#include <fmt/format.h>

#include <charconv>
#include <map>
#include <utility>

#include "trace/logs/behavior_log.hpp"
#include "trace/logs/btlog.hpp"
#include "trace/logs/log_tree.hpp"
#include "trace/logs/xml_scanner.hpp"
#include "trace/run/little_endian.hpp"

namespace btcheck {
namespace {

constexpr std::size_t kRecordSize = 9;

class TreeReader {
 public:
  explicit TreeReader(std::string_view xml) : scanner_(xml) {}

  // What is wrong with the XML, or "".
  std::string read(std::vector<LogNode>& nodes) {
    while (flaw_.empty()) {
      const auto tag = scanner_.next();
      if (!tag) break;
      take(*tag);
    }
    if (flaw_.empty()) flaw_ = scanner_.flaw();
    if (flaw_.empty() && !open_.empty()) {
      flaw_ = fmt::format("<{}> does not end", open_.back().name);
    }
    if (flaw_.empty() && nodes_.empty()) flaw_ = "there is no node with a _uid";
    nodes = std::move(nodes_);
    return flaw_.empty() ? ordered_nodes(nodes)
                         : fmt::format("line {}: {}", scanner_.line(), flaw_);
  }

 private:
  struct Open {
    std::string name;
    std::optional<std::uint16_t> parent;  // of the elements in it
  };

  void take(const XmlTag& tag) {
    if (tag.opens) open(tag);
    if (!flaw_.empty() || !tag.closes) return;
    if (open_.empty() || open_.back().name != tag.name) {
      flaw_ = fmt::format("</{}> ends nothing", tag.name);
      return;
    }
    open_.pop_back();
  }

  void open(const XmlTag& tag) {
    Open element{tag.name, std::nullopt};
    const bool is_tree = tag.name == "BehaviorTree" && open_.size() == 1;
    const bool is_in_tree = open_.size() > 1 && open_[1].name == "BehaviorTree";
    if (is_tree) {
      const std::string* path = tag.find("_fullpath");
      const auto owner = subtrees_.find(path != nullptr ? *path : "");
      if (owner != subtrees_.end()) element.parent = owner->second;
    } else if (is_in_tree) {
      element.parent = add_node(tag);
    }
    open_.push_back(std::move(element));
  }

  std::uint16_t add_node(const XmlTag& tag) {
    LogNode node;
    node.type = tag.name;
    node.parent = open_.back().parent;
    const std::string* uid = tag.find("_uid");
    const std::string* name = tag.find("name");
    const std::string* id = tag.find("ID");
    const std::string* path = tag.find("_fullpath");
    if (name == nullptr) name = id;
    if (name != nullptr) node.name = *name;
    // <Action ID="Fly"/> is the long form of <Fly/>.
    if (id != nullptr && tag.name != "SubTree") node.type = *id;
    if (uid == nullptr || !read_uid(*uid, node.uid)) {
      flaw_ = fmt::format("<{}> has no _uid", tag.name);
    } else if (path != nullptr && tag.name == "SubTree" &&
               !subtrees_.emplace(*path, node.uid).second) {
      flaw_ = fmt::format("two SubTrees have the path `{}`", *path);
    }
    const std::uint16_t made = node.uid;
    nodes_.push_back(std::move(node));
    return made;
  }

  static bool read_uid(const std::string& text, std::uint16_t& uid) {
    const char* end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, uid);
    return error == std::errc() && stop == end;
  }

  XmlScanner scanner_;
  std::vector<Open> open_;
  std::vector<LogNode> nodes_;
  std::map<std::string, std::uint16_t> subtrees_;  // by path
  std::string flaw_;
};

LogRecord read_record(std::string_view bytes, std::size_t at) {
  return {static_cast<std::int64_t>(number_at(bytes, at, 6)),
          static_cast<std::uint16_t>(number_at(bytes, at + 6, 2)), std::nullopt,
          static_cast<int>(number_at(bytes, at + 8, 1))};
}

Result<BehaviorLog> other_log(std::string_view file, std::string message) {
  return {std::nullopt,
          {log_finding(Severity::Error, "BT1302", file, std::move(message),
                       "logs of FileLogger2 (.btlog) and of BehaviorTree.CPP "
                       "3's FileLogger (.fbl) can be read")}};
}

}  // namespace

Result<BehaviorLog> read_btlog(std::string_view file, std::string_view bytes) {
  const std::string_view magic = bytes.substr(0, kBtlogMagic.size());
  if (magic.empty()) return other_log(file, "the file is empty");
  if (!kBtlogMagic.starts_with(magic)) {
    return other_log(file, "this is no log of BehaviorTree.CPP 4");
  }
  std::size_t at = kBtlogMagic.size();
  if (bytes.size() < at + 5) return damaged_log(file, "its heading is cut off");
  if (const auto version = number_at(bytes, at, 1); version != kBtlogVersion) {
    return other_log(
        file,
        fmt::format("the log's format has version {}; version {} is known",
                    version, kBtlogVersion));
  }
  const std::uint64_t length = number_at(bytes, at + 1, 4);
  at += 5;
  if (length > bytes.size() - at) {
    return damaged_log(file, fmt::format("its XML should have {} bytes, {} are "
                                         "there",
                                         length, bytes.size() - at));
  }
  BehaviorLog log;
  const std::string flaw = TreeReader(bytes.substr(at, length)).read(log.nodes);
  if (!flaw.empty()) return damaged_log(file, "in its XML, " + flaw);
  at += length;
  if (bytes.size() - at < 8) {
    return damaged_log(file, "the time of its beginning is cut off");
  }
  log.begin = static_cast<std::int64_t>(number_at(bytes, at, 8));
  return with_records(std::move(log), file, bytes, at + 8, kRecordSize,
                      read_record);
}

Result<BehaviorLog> read_log(std::string_view file, std::string_view bytes) {
  const bool is_fbl = file.ends_with(".fbl") && !bytes.starts_with(kBtlogMagic);
  return is_fbl ? read_fbl(file, bytes) : read_btlog(file, bytes);
}

}  // namespace btcheck
