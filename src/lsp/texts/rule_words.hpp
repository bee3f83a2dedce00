// SPDX-License-Identifier: MIT
//
// Words of rules: what can be written, what each means, and what stands at a
// place.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "text/diagnostic.hpp"
#include "text/input_file.hpp"

namespace btcheck::lsp {

enum class RuleWordKind : unsigned char {
  Item,   // opens an item of the file: property, let
  Body,   // opens what is claimed: never, always
  Join,   // stands between conditions, or behind them
  Event,  // stands behind `node.`
  Other   // true, dead, tick
};

// docs/properties.md says more of each.
struct RuleHelp {
  std::string_view word;
  RuleWordKind kind;
  std::string_view about;
};
std::span<const RuleHelp> rule_words();
// What a word means, in a line of Markdown; "" for none of these.
std::string rule_help(std::string_view word);

// What stands at a byte of a file of rules.
struct RuleWordHere {
  TextStretch word;
  TextStretch node;  // the reference to a node that the word is in: land@23
  bool is_behind_dot = false;
  bool is_quoted = false;
  // The name of an item: `property NAME`, `let NAME`.
  bool is_item_name = false;
  std::string_view item;  // the word of the item that it is in

  TextStretch node_or_word() const {
    return node.size() > 0 && !is_behind_dot ? node : word;
  }
};
RuleWordHere rule_word_at(const FileText& text, std::size_t at);

// All words of a file that are this name and no event, keyword or comment.
std::vector<TextStretch> rule_names(const FileText& text,
                                    std::string_view name);

// The names of its lets and where they are said.
struct NamedLet {
  std::string_view name;
  TextStretch at;
};
std::vector<NamedLet> lets_of(const FileText& text);

}  // namespace btcheck::lsp
