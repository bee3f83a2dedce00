// SPDX-License-Identifier: MIT
#include "settings/key_reader.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "text/numbers.hpp"
#include "trace/run/shown_text.hpp"

namespace btcheck {

void Mistakes::add(std::string_view code, const SourceSpan& span,
                   std::string message, std::string label, std::string help) {
  if (is_full()) return;
  found.push_back(source.diagnostic(Severity::Error, code, span,
                                    std::move(message), std::move(label),
                                    std::move(help)));
}

void Mistakes::add_unknown(const TomlMember& member, const Words& known) {
  if (is_full()) return;
  add("BT1503", member.span,
      fmt::format("unknown key `{}`", one_line(member.key)), {},
      did_you_mean(member.key, known,
                   fmt::format("there are: {}", fmt::join(known, ", "))));
}

void Mistakes::add_other_kind(const TomlNode& node, std::string message,
                              std::string help) {
  add("BT1504", node.span, std::move(message),
      fmt::format("this is {}", kind_of(node)), std::move(help));
}

std::optional<std::string> KeyReader::text(std::string_view example) {
  return text_in(node_, example);
}

std::optional<Words> KeyReader::texts(std::string_view example) {
  Words words;
  const bool is_list = node_.kind == TomlNode::Kind::List;
  for (std::size_t i = 0; i < (is_list ? node_.items.size() : 1); ++i) {
    auto one = text_in(is_list ? node_.items[i] : node_, example);
    if (!one) return std::nullopt;
    words.push_back(std::move(*one));
  }
  return words;
}

std::optional<bool> KeyReader::flag() {
  if (node_.kind == TomlNode::Kind::Flag) return node_.flag;
  return refuse(node_, "true or false", "true");
}

std::optional<std::uint64_t> KeyReader::count(std::uint64_t most) {
  const bool is_fit = node_.kind == TomlNode::Kind::Integer &&
                      node_.integer >= 1 &&
                      static_cast<std::uint64_t>(node_.integer) <= most;
  if (is_fit) return static_cast<std::uint64_t>(node_.integer);
  return refuse(node_,
                most == UINT64_MAX ? "a number from 1 on"
                                   : fmt::format("a number from 1 to {}", most),
                "4");
}

std::optional<std::uint64_t> KeyReader::size() {
  const auto bytes =
      node_.kind == TomlNode::Kind::Text ? bytes_in(node_.text) : std::nullopt;
  if (bytes) return bytes;
  return refuse(node_, "a size", "\"4G\"");
}

std::optional<double> KeyReader::seconds() {
  const bool is_number = node_.kind == TomlNode::Kind::Integer ||
                         node_.kind == TomlNode::Kind::Decimal;
  if (is_number && std::isfinite(node_.decimal) && node_.decimal >= 0) {
    return node_.decimal;
  }
  return refuse(node_, "a number of seconds, 0 for no limit", "60");
}

const TomlNode* KeyReader::table(std::string_view of,
                                 std::string_view example) {
  if (node_.kind == TomlNode::Kind::Table) return &node_;
  refuse(node_, fmt::format("a table of {}", of), example);
  return nullptr;
}

std::optional<std::string> KeyReader::text_in(const TomlNode& node,
                                              std::string_view example) {
  if (node.kind == TomlNode::Kind::Text && !node.text.empty()) return node.text;
  return refuse(node, "a text that is not empty", example);
}

std::optional<std::size_t> KeyReader::place_in(const Words& words) {
  if (node_.kind != TomlNode::Kind::Text) {
    return refuse(node_, "a word", fmt::format("\"{}\"", words[0]));
  }
  const auto found = std::ranges::find(words, node_.text);
  if (found != words.end()) {
    return static_cast<std::size_t>(found - words.begin());
  }
  if (mistakes_.is_full()) return std::nullopt;
  mistakes_.add(
      "BT1504", node_.span,
      fmt::format("`{}` is one of: {}", one_line(key_), fmt::join(words, ", ")),
      "not one of them", did_you_mean(node_.text, words));
  return std::nullopt;
}

std::nullopt_t KeyReader::refuse(const TomlNode& node, std::string_view wanted,
                                 std::string_view example) {
  mistakes_.add_other_kind(
      node, fmt::format("`{}` is {}", one_line(key_), wanted),
      fmt::format("write for instance `{} = {}`", key_, example));
  return std::nullopt;
}

}  // namespace btcheck
