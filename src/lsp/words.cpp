// SPDX-License-Identifier: MIT
#include "lsp/words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "lsp/diagnostics.hpp"
#include "model/btcpp/known_types.hpp"
#include "report/text/type_list.hpp"
#include "text/utf8.hpp"

namespace btcheck::lsp {
namespace {

using btcpp::NodeTypeRow;
using btcpp::PortRow;

std::string direction_word(BtcppDirection direction) {
  if (direction == BtcppDirection::Input) return "input";
  return direction == BtcppDirection::Output ? "output" : "inout";
}

PortWord word_of(const PortRow& row) {
  PortWord word;
  word.name = row.name;
  word.direction = direction_word(row.direction);
  if (!row.type_word.empty()) {
    word.type = row.type_word;
  } else if (row.type != btcpp::PortType::Any) {
    word.type = btcpp::port_type_name(row.type);
  }
  word.preset = row.preset;
  word.about = row.about;
  word.is_needed = row.need == btcpp::Need::Mandatory;
  return word;
}

// "4.4 and later", "before 4.0"; "" for all.
std::string releases_text(const Releases& in) {
  const auto text = [](int release) {
    // The patch of a first release is none.
    std::string all = release_text(release);
    return all.ends_with(".0") ? all.substr(0, all.size() - 2) : all;
  };
  if (in.first > 0 && in.end < kNoRelease) {
    return fmt::format("from {} to before {}", text(in.first), text(in.end));
  }
  if (in.first > 0) return fmt::format("from {} on", text(in.first));
  return in.end < kNoRelease ? fmt::format("before {}", text(in.end))
                             : std::string();
}

// "humble, jazzy"; "" for all.
std::string branches_text(btcpp::Nav2Branches branches) {
  std::string text;
  bool are_all = true;
  for (const btcpp::Nav2Branch each :
       {btcpp::Nav2Branch::Galactic, btcpp::Nav2Branch::Humble,
        btcpp::Nav2Branch::Iron, btcpp::Nav2Branch::Jazzy,
        btcpp::Nav2Branch::Kilted, btcpp::Nav2Branch::Lyrical}) {
    if (!branches.has(each)) {
      are_all = false;
      continue;
    }
    // "nav2-humble"
    const std::string_view name =
        profile_name(btcpp::profile_of_branch(each)).substr(5);
    text += text.empty() ? name : fmt::format(", {}", name);
  }
  return are_all ? std::string() : text;
}

TypeWord word_of(const NodeTypeRow& row, Profile profile) {
  TypeWord word;
  word.id = row.id;
  word.kind = kind_name(row.kind);
  word.about = about_type(row, profile);
  const int first = btcpp::first_release(row.id);
  if (first > 0) {
    word.since =
        fmt::format("from BehaviorTree.CPP {} on", release_text(first));
  }
  const bool is_nav2 = btcpp::nav2_type(row.id) == &row;
  if (is_nav2) {
    const std::string in = branches_text(row.branches);
    if (!in.empty()) word.since = fmt::format("Nav2 {}", in);
  }
  for (const PortRow& port : row.ports) {
    PortWord each = word_of(port);
    each.in = is_nav2
                  ? branches_text(btcpp::branches_with_port(row.id, port.name))
                  : releases_text(port.in);
    each.is_there = port.in.has(engine_release(profile));
    word.ports.push_back(std::move(each));
  }
  if (!is_nav2) return word;
  for (const std::string_view port : btcpp::ports_of_branches(row.id)) {
    if (word.port(port) != nullptr) continue;
    const btcpp::Nav2Branches in = btcpp::branches_with_port(row.id, port);
    PortWord each;
    each.name = port;
    each.in = branches_text(in);
    each.is_there = !has_nav2(profile) || in.has(btcpp::branch_of(profile));
    word.ports.push_back(std::move(each));
  }
  return word;
}

// Of <Action ID="Dock"> below <TreeNodesModel>.
TypeWord word_of(const XmlScan& scan, std::size_t element) {
  TypeWord word;
  word.id = scan.value(element, "ID");
  word.kind = scan.name(element);
  for (const std::size_t child : scan[element].children) {
    const std::string_view tag = scan.name(child);
    if (tag == "description" || tag == "Metadata") continue;
    if (!tag.ends_with("_port")) continue;
    PortWord port;
    port.name = scan.value(child, "name");
    port.direction = tag.substr(0, tag.size() - 5);
    port.type = scan.value(child, "type");
    port.preset = scan.value(child, "default");
    const TextStretch inside{scan[child].start_tag.end,
                             scan[child].end_tag.begin};
    if (scan[child].end_tag.size() > 0 && inside.begin <= inside.end) {
      port.about = scan.text(inside);
    }
    word.ports.push_back(std::move(port));
  }
  return word;
}

bool is_model_list(const XmlScan& scan, std::size_t element) {
  const std::size_t parent = scan[element].parent;
  return parent != kNone && scan.name(parent) == "TreeNodesModel";
}

}  // namespace

const PortWord* TypeWord::port(std::string_view wanted) const {
  const auto found = std::ranges::find(ports, wanted, &PortWord::name);
  return found == ports.end() ? nullptr : &*found;
}

Profile profile_of(const View& view) {
  if (const Look* look = described_look(view)) {
    const auto profile = profile_named(look->description->profile);
    if (profile) return *profile;
  }
  const auto scan = view.document.text.parsed<XmlScan>();
  const bool is_4 = !scan->elements().empty() &&
                    scan->value(0, "BTCPP_format").starts_with('4');
  return is_4 ? Profile::Btcpp4 : Profile::Btcpp38;
}

std::vector<ScannedFile> tree_files(const View& view) {
  std::vector<ScannedFile> all;
  for (const auto& [path, text] : *view.texts) {
    if (kind_of(path, text.text()) != FileKind::Xml) continue;
    all.push_back({path, text.parsed<XmlScan>()});
  }
  return all;
}

bool is_subtree(const XmlScan& scan, std::size_t element) {
  return scan.name(element).starts_with("SubTree");
}

std::string_view type_of(const XmlScan& scan, std::size_t element) {
  const std::string_view tag = scan.name(element);
  const std::size_t tree = scan.tree_of(element);
  if (tree == kNone || tree == element) return {};
  return kind_named(tag) || is_subtree(scan, element)
             ? scan.value(element, "ID")
             : tag;
}

std::vector<TypeWord> all_types(const View& view) {
  std::map<std::string, TypeWord, std::less<>> all;
  const Profile profile = profile_of(view);
  const BtcppRelease release = btcpp::dialect_of(profile);
  const auto add = [&](TypeWord word) {
    if (!word.id.empty()) all.try_emplace(word.id, std::move(word));
  };
  for (const std::string& name : btcpp::builtin_names(release)) {
    const NodeTypeRow* row = btcpp::builtin_type(release, name);
    if (row->since <= engine_release(profile)) add(word_of(*row, profile));
  }
  const auto files = tree_files(view);
  for (const ScannedFile& file : files) {
    const XmlScan& scan = *file.scan;
    for (std::size_t i = 0; i < scan.elements().size(); ++i) {
      const bool is_model = is_model_list(scan, i) &&
                            kind_named(scan.name(i)) &&
                            scan.name(i) != "SubTree";
      if (is_model) add(word_of(scan, i));
    }
  }
  if (has_nav2(profile)) {
    const btcpp::Nav2Branch branch = btcpp::branch_of(profile);
    for (const NodeTypeRow& row : btcpp::nav2_types()) {
      if (row.branches.has(branch)) add(word_of(row, profile));
    }
  }
  // What is used and nobody tells of.
  for (const ScannedFile& file : files) {
    const XmlScan& scan = *file.scan;
    for (std::size_t i = 0; i < scan.elements().size(); ++i) {
      const std::string id(type_of(scan, i));
      if (id.empty() || is_subtree(scan, i) || !scan[i].is_closed) continue;
      TypeWord word;
      word.id = id;
      const auto kind = kind_named(scan.name(i));
      word.kind = kind                           ? kind_name(*kind)
                  : scan[i].children.empty()     ? "Action"
                  : scan[i].children.size() == 1 ? "Decorator"
                                                 : "Control";
      for (const ScannedAttribute& each : scan[i].attributes) {
        const std::string name(scan.text(each.name));
        if (name == "ID" || name == "name" || name.starts_with('_')) continue;
        PortWord port;
        port.name = name;
        word.ports.push_back(std::move(port));
      }
      add(std::move(word));
    }
  }
  std::vector<TypeWord> list;
  for (auto& [id, word] : all) list.push_back(std::move(word));
  return list;
}

std::optional<TypeWord> type_named(const View& view, std::string_view id) {
  for (TypeWord& word : all_types(view)) {
    if (word.id == id) return std::move(word);
  }
  return std::nullopt;
}

// --- Nodes -----------------------------------------------------------------

const Look* described_look(const View& view) {
  const auto found = std::ranges::find_if(
      view.looks, [](const Look& look) { return look.description != nullptr; });
  return found == view.looks.end() ? nullptr : &*found;
}

const Look* checked_look(const View& view) {
  const auto found = std::ranges::find_if(view.looks, [](const Look& look) {
    return look.subject.rules.empty() && look.is_checked();
  });
  return found == view.looks.end() ? nullptr : &*found;
}

namespace {

NodeHere node_here(const Look& look, std::size_t number) {
  NodeHere here{&look, number, nullptr};
  if (!look.is_checked()) return here;
  const auto& nodes = look.check.report->nodes;
  const auto found =
      std::ranges::find(nodes, here.node().name, &v1::Node::name);
  if (found != nodes.end()) here.proven = &*found;
  return here;
}

}  // namespace

std::vector<NodeHere> nodes_at(const View& view, const std::string& path,
                               std::size_t begin) {
  std::vector<NodeHere> all;
  for (const Look& look : view.looks) {
    if (!look.description) continue;
    const auto& nodes = look.description->nodes;
    Movement moved(*look.described, *view.texts);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      if (nodes[i].where.file != path) continue;
      const auto at = moved(nodes[i].where);
      if (at && at->begin == begin) all.push_back(node_here(look, i));
    }
  }
  return all;
}

std::vector<NodeHere> nodes_named(const View& view, std::string_view word) {
  std::vector<NodeHere> all;
  const std::size_t slash = word.rfind('/');
  if (slash != word.npos) word.remove_prefix(slash + 1);
  const std::string_view label = word.substr(0, word.find('@'));
  for (const Look& look : view.looks) {
    if (!look.description) continue;
    const auto& nodes = look.description->nodes;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      if (nodes[i].name == word || equal_ignoring_case(nodes[i].label, label)) {
        all.push_back(node_here(look, i));
      }
    }
    if (!all.empty()) break;
  }
  return all;
}

std::size_t entry_of(const NodeHere& here, std::string_view name) {
  const v1::Description& tree = *here.look->description;
  std::string known(name);
  const auto find = [&](const std::vector<std::size_t>& numbers) {
    const auto found = std::ranges::find_if(numbers, [&](std::size_t each) {
      return tree.entries[each].name == known;
    });
    return found == numbers.end() ? kNone : *found;
  };
  for (std::size_t at = here.number; tree.nodes[at].parent != at;) {
    at = tree.nodes[at].parent;
    if (tree.nodes[at].kind != "SubTree") continue;
    const auto& ports = tree.nodes[at].ports;
    const auto port = std::ranges::find(ports, known, &v1::Port::name);
    if (port != ports.end() && !port->entry.empty()) known = port->entry;
  }
  for (const auto* list : {&here.node().reads, &here.node().writes}) {
    const std::size_t found = find(*list);
    if (found != kNone) return found;
  }
  const auto found = std::ranges::find(tree.entries, known, &v1::Entry::name);
  return found == tree.entries.end()
             ? kNone
             : static_cast<std::size_t>(found - tree.entries.begin());
}

// --- Words -----------------------------------------------------------------

bool is_word_letter(char c) {
  return is_letter(c) || is_digit(c) || c == '_' ||
         (static_cast<unsigned char>(c) & 0x80U) != 0;
}

TextStretch word_at(std::string_view text, std::size_t at) {
  std::size_t begin = at;
  while (begin > 0 && is_word_letter(text[begin - 1])) --begin;
  std::size_t end = at;
  while (end < text.size() && is_word_letter(text[end])) ++end;
  return {begin, end};
}

std::optional<EntryHere> entry_at(std::string_view value,
                                  std::size_t value_begin, std::size_t at) {
  const std::size_t here = at - value_begin;
  const std::size_t open = value.rfind('{', here == 0 ? 0 : here - 1);
  if (open == value.npos) return std::nullopt;
  std::size_t close = value.find('}', open);
  if (close == value.npos) close = value.size();
  if (here <= open || here > close) return std::nullopt;
  return EntryHere{std::string(value.substr(open + 1, close - open - 1)),
                   {value_begin + open + 1, value_begin + close}};
}

}  // namespace btcheck::lsp
