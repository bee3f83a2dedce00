// SPDX-License-Identifier: MIT
#include "trace/pictures/written.hpp"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

namespace btcheck {
namespace {

constexpr std::string_view kBlanks = " \t\r\n";

void append_word(std::string& words, std::string_view word) {
  if (word.empty()) return;
  if (!words.empty()) words += ' ';
  words += word;
}

// The blanks of several lines are one.
std::string on_one_line(std::string_view text) {
  std::string words;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t begin = text.find_first_not_of(kBlanks, at);
    if (begin == text.npos) break;
    at = std::min(text.find_first_of(kBlanks, begin), text.size());
    append_word(words, text.substr(begin, at - begin));
  }
  return words;
}

std::string without_entities(std::string text) {
  constexpr std::array<std::pair<std::string_view, char>, 5> kEntities = {
      {{"&lt;", '<'},
       {"&gt;", '>'},
       {"&quot;", '"'},
       {"&apos;", '\''},
       {"&amp;", '&'}}};
  for (const auto& [entity, letter] : kEntities) {
    for (std::size_t at = 0; (at = text.find(entity, at)) != text.npos; ++at) {
      text.replace(at, entity.size(), 1, letter);
    }
  }
  return text;
}

// The attributes of an element, from behind its type.
std::string attributes(std::string_view text) {
  std::string words;
  for (;;) {
    const std::size_t begin = text.find_first_not_of(kBlanks);
    if (begin == text.npos || text[begin] == '>' || text[begin] == '/') break;
    const std::size_t equals = text.find('=', begin);
    const std::size_t open = text.find_first_of("\"'", equals);
    if (equals == text.npos || open == text.npos) break;
    const std::size_t close = text.find(text[open], open + 1);
    if (close == text.npos) break;
    const std::string name = on_one_line(text.substr(begin, equals - begin));
    if (name != "ID" && name != "name") {
      const std::string_view value = text.substr(open + 1, close - open - 1);
      append_word(words, name + '=' + without_entities(on_one_line(value)));
    }
    text.remove_prefix(close + 1);
  }
  return words;
}

// Of a list in a .btf file, what is there from behind its type to its end or to
// its first child, comments left out.
std::string list_items(std::string_view text, std::string_view child) {
  std::string kept;
  int depth = 0;
  for (std::size_t at = 0; at < text.size(); ++at) {
    const char c = text[at];
    if (c == ';') {
      at = std::min(text.find('\n', at), text.size());
      kept += ' ';
      continue;
    }
    const bool is_child =
        c == '(' && !child.empty() && text.data() + at == child.data();
    if (is_child || (c == ')' && depth-- == 0)) break;
    if (c == '(') ++depth;
    kept += c;
  }
  std::string words;
  const std::string items = on_one_line(kept);
  for (std::size_t at = 0; at < items.size();) {
    const std::size_t end = std::min(items.find(' ', at), items.size());
    const std::string word = items.substr(at, end - at);
    at = end + 1;
    if (word == ":ID" || word == ":name") {  // its value goes with it
      at = std::min(items.find(' ', at), items.size() - 1) + 1;
    } else {
      append_word(words, word);
    }
  }
  return words;
}

}  // namespace

WrittenNodes::WrittenNodes(const RecordedRun& run) : run_(run) {
  files_.try_emplace("", "", run.source);
  for (const IncludedText& each : run.included) {
    files_.insert_or_assign(each.file, SourceText(each.file, each.text));
  }
}

std::string_view WrittenNodes::text_from(std::size_t number) const {
  if (number >= run_.nodes.size()) return {};
  const RecordedNode& node = run_.nodes[number];
  const auto file = files_.find(node.file);
  if (file == files_.end()) return {};
  const auto at = file->second.offset(static_cast<int>(node.line),
                                      static_cast<int>(node.column));
  return at && *at > 0 ? file->second.text().substr(*at - 1)
                       : std::string_view();
}

std::string WrittenNodes::at(std::size_t node) const {
  const std::string_view text = text_from(node);
  const std::size_t end = text.find_first_of(" \t\r\n/>()", 1);
  if (end == text.npos) return {};
  const std::string_view behind = text.substr(end);
  // The next node is the first child, or stands behind the end of this one.
  return text.front() == '<' ? attributes(behind)
                             : list_items(behind, text_from(node + 1));
}

}  // namespace btcheck
