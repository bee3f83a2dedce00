// SPDX-License-Identifier: MIT
#include "model/btcpp/unknown_leaves.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "model/btcpp/attributes.hpp"
#include "model/tree/leaf_names.hpp"
#include "model/tree/releases.hpp"
#include "text/utf8.hpp"
#include "text/wildcards.hpp"

namespace btcheck {
namespace {

// Whether a value can only be read. In older releases an output port may be
// given the name of an entry without braces.
bool is_literal(int engine, const BtcppAttribute& port) {
  if (btcpp::remapped_key(engine, port.name, port.value)) return false;
  return !releases::kOutputsNameEntries.has(engine) ||
         !btcpp::is_port_name(port.value);
}

void add_ports(int engine, const BtcppNode& node, UnknownLeaf& leaf) {
  for (const BtcppAttribute& port : node.ports) {
    auto at = std::ranges::find(leaf.ports, port.name,
                                [](const auto& known) { return known.first; });
    if (at == leaf.ports.end()) {
      at = leaf.ports.insert(at, {port.name, false});
    }
    at->second |= is_literal(engine, port);
  }
}

// "main.xml:9, 12; dock.xml:7", shortened.
std::string places_of(const UnknownLeaf& leaf) {
  constexpr int kMostShown = 6;
  std::string text;
  std::string_view file;
  int count = 0;
  for (const auto& [name, line] : leaf.uses) {
    if (count++ == kMostShown) {
      const std::size_t others = leaf.uses.size() - kMostShown;
      return text + fmt::format(" and {} more", others);
    }
    text += name == file
                ? fmt::format(", {}", line)
                : fmt::format("{}{}:{}", text.empty() ? "" : "; ", name, line);
    file = name;
  }
  return text;
}

// A comment is one line, and in XML has no `--` in it.
std::string in_comment(std::string text) {
  std::ranges::replace_if(
      text, [](char c) { return static_cast<unsigned char>(c) < ' '; }, ' ');
  return text;
}
std::string in_xml_comment(std::string text) {
  text = in_comment(std::move(text));
  for (std::size_t at; (at = text.find("--")) != text.npos;) {
    text.insert(at + 1, " ");
  }
  return text;
}

std::string reason_of(const UnknownLeaf& leaf) {
  if (leaf.is_told) return {};
  return leaf.kind == BtcppKind::Condition ? "by its name; " : "guessed; ";
}

std::string port_text(const std::pair<std::string, bool>& port) {
  return fmt::format("      <{} name=\"{}\"/>\n",
                     port.second ? "input_port" : "inout_port",
                     with_entities(port.first));
}

}  // namespace

bool is_described(const BtcppNode& node,
                  std::span<const std::string> patterns) {
  return node.children.empty() &&
         std::ranges::any_of(patterns, [&](const std::string& name) {
           return matches_wildcard(name, node.id) ||
                  matches_wildcard(name, node.name);
         });
}

void UnknownLeaves::add(const BtcppDocument& document,
                        std::span<const std::string> described) {
  release_ = std::max(release_, document.release);
  for (const BtcppTree& tree : document.trees) {
    for (const BtcppNode& node : tree.nodes) {
      if (node.is_known || !node.children.empty()) continue;
      if (is_described(node, described)) continue;
      UnknownLeaf& leaf = types_[node.id];
      leaf.uses.emplace(document.files[node.place.file].name,
                        node.place.span.line);
      add_ports(document.engine(), node, leaf);
      if (leaf.is_told) continue;
      leaf.is_told = node.is_explicit;
      leaf.kind = node.is_explicit                 ? node.kind
                  : sounds_like_condition(node.id) ? BtcppKind::Condition
                                                   : BtcppKind::Action;
    }
  }
}

std::string UnknownLeaves::xml() const {
  std::string text = fmt::format(
      "<root BTCPP_format=\"{}\">\n"
      "  <!-- Leaves that nothing describes yet, by `btcheck leaves`. Read it "
      "before you\n"
      "       rely on it. Behind `guessed` a Condition may be meant; an "
      "inout_port may\n"
      "       be an input_port or an output_port. -->\n"
      "  <TreeNodesModel>\n",
      release_ == BtcppRelease::V4 ? 4 : 3);
  for (const auto& [id, leaf] : types_) {
    const std::string_view kind = kind_name(leaf.kind);
    text += fmt::format("    <!-- {} -->\n",
                        in_xml_comment(reason_of(leaf) + places_of(leaf)));
    text += fmt::format("    <{} ID=\"{}\"", kind, with_entities(id));
    if (leaf.ports.empty()) {
      text += "/>\n";
      continue;
    }
    text += ">\n";
    for (const auto& port : leaf.ports) text += port_text(port);
    text += fmt::format("    </{}>\n", kind);
  }
  return text + "  </TreeNodesModel>\n</root>\n";
}

std::string UnknownLeaves::contracts() const {
  std::string text =
      "; Leaves that nothing describes yet, by `btcheck leaves`: each contract "
      "says what\n"
      "; is taken for granted without it. Leave out what a leaf never answers; "
      "write\n"
      "; `defcondition` for what only asks. For an action,\n"
      ";   :answers anew    it runs again when it is ticked again "
      "(SyncActionNode)\n"
      ";   :answers once    it answers the same (StatefulActionNode)\n";
  for (const auto& [id, leaf] : types_) {
    const auto name = contract_name(id);
    const bool is_action = leaf.kind == BtcppKind::Action;
    text +=
        fmt::format("\n; {}\n", in_comment(reason_of(leaf) + places_of(leaf)));
    text +=
        name ? fmt::format("({} {}\n  :returns (success failure{}))\n",
                           is_action ? "defaction" : "defcondition", *name,
                           is_action ? " running" : "")
             : fmt::format("; {}: no contract can name it\n", in_comment(id));
  }
  return text;
}

}  // namespace btcheck
