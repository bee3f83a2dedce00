// SPDX-License-Identifier: MIT
//
// The heading of a .btlog is an XML of BehaviorTree.CPP with a _uid on each
// node. Trees below a SubTree stand beside the main one; the same _fullpath on
// both says which belongs where.
#include <fmt/format.h>

#include <charconv>
#include <map>
#include <utility>

#include "model/btcpp/xml_text.hpp"
#include "trace/logs/behavior_log.hpp"
#include "trace/logs/btlog.hpp"
#include "trace/logs/log_tree.hpp"
#include "trace/run/little_endian.hpp"

namespace btcheck {
namespace {

constexpr std::size_t kRecordSize = 9;

class TreeReader {
 public:
  // What is wrong with the XML, or "".
  std::string read(std::string_view xml, std::vector<LogNode>& nodes) {
    const SourceText source("", xml);
    const auto parsed = btcpp::parse_xml(source);
    if (!parsed.value) {
      const Diagnostic& why = parsed.diagnostics.front();
      return at_line(why.span.line, why.label);
    }
    inside_.resize(parsed.value->size());
    for (std::size_t i = 1; i < inside_.size(); ++i) {
      take((*parsed.value)[i], inside_[i]);
      if (!flaw_.empty()) return at_line((*parsed.value)[i].span.line, flaw_);
    }
    if (nodes_.empty()) return "there is no node with a _uid";
    nodes = std::move(nodes_);
    return ordered_nodes(nodes);
  }

 private:
  // What the elements inside one are.
  struct Inside {
    bool are_nodes = false;
    std::optional<std::uint16_t> parent;  // theirs
  };

  static std::string at_line(int line, std::string_view flaw) {
    return line == 0 ? std::string(flaw)
                     : fmt::format("line {}: {}", line, flaw);
  }

  void take(const btcpp::XmlElement& element, Inside& inside) {
    const Inside& outer = inside_[element.parent];
    if (outer.are_nodes) {
      inside = {true, add_node(element, outer.parent)};
    } else if (element.parent == 0 && element.name == "BehaviorTree") {
      const std::string* path = element.value("_fullpath");
      const auto owner = subtrees_.find(path != nullptr ? *path : "");
      inside.are_nodes = true;
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
    if (name == nullptr) name = id;
    if (name != nullptr) node.name = *name;
    // <Action ID="Fly"/> is the long form of <Fly/>.
    if (id != nullptr && element.name != "SubTree") node.type = *id;
    if (uid == nullptr || !read_uid(*uid, node.uid)) {
      flaw_ = fmt::format("<{}> has no _uid", element.name);
    } else if (path != nullptr && element.name == "SubTree" &&
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

  std::vector<Inside> inside_;  // by element
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
  const std::string flaw =
      TreeReader().read(bytes.substr(at, length), log.nodes);
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
