// SPDX-License-Identifier: MIT
#include "pins/words.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "check/export/ltsmin.hpp"

namespace btcheck {
namespace {

constexpr std::string_view kBlanks = " \t\r\n";

class WordReader {
 public:
  WordReader(const std::string& file, std::string_view text)
      : source_(file, text), text_(text) {}

  Result<std::vector<std::string>> read() {
    while (skip_blanks()) {
      if (!read_word()) return {std::nullopt, {std::move(found_)}};
    }
    return {std::move(words_), {}};
  }

 private:
  bool skip_blanks() {
    for (;;) {
      at_ = std::min(text_.find_first_not_of(kBlanks, at_), text_.size());
      if (at_ == text_.size()) return false;
      if (text_[at_] != '#') return true;
      at_ = std::min(text_.find('\n', at_), text_.size());
    }
  }

  bool read_word() {
    std::string word;
    while (at_ < text_.size() && kBlanks.find(text_[at_]) == kBlanks.npos) {
      const char mark = text_[at_];
      if (mark != '\'' && mark != '"') {
        word += text_[at_++];
        continue;
      }
      const std::size_t end = text_.find(mark, at_ + 1);
      if (end == text_.npos) return refuse_open();
      word += text_.substr(at_ + 1, end - at_ - 1);
      at_ = end + 1;
    }
    words_.push_back(std::move(word));
    return true;
  }

  bool refuse_open() {
    const auto line = static_cast<int>(
        1 + std::count(text_.begin(),
                       text_.begin() + static_cast<std::ptrdiff_t>(at_), '\n'));
    const std::size_t start = text_.rfind('\n', at_) + 1;
    const auto column = static_cast<int>(1 + at_ - start);
    found_ = source_.diagnostic(Severity::Error, "BT1308", {line, column, 1},
                                "a quotation has no end", "it begins here",
                                "close it with the mark that it begins with");
    return false;
  }

  SourceText source_;
  std::string_view text_;
  std::size_t at_ = 0;
  std::vector<std::string> words_;
  Diagnostic found_;
};

}  // namespace

Result<std::vector<std::string>> split_words(const std::string& file,
                                             std::string_view text) {
  return WordReader(file, text).read();
}

std::string as_word(const std::string& word) {
  if (!word.empty() && word.find_first_of(" \t\r\n'\"#") == word.npos) {
    return word;
  }
  // What has one of the marks stands in the other.
  std::string text;
  for (const char c : word) {
    text += c == '\'' ? "\"'\"" : '\'' + std::string(1, c) + '\'';
  }
  for (std::size_t at = 0; (at = text.find("''", at)) != text.npos;) {
    text.erase(at, 2);
  }
  return text.empty() ? "''" : text;
}

PinsWords sorted_pins_words(std::vector<std::string> words) {
  PinsWords sorted;
  PinsChoices& choices = sorted.choices;
  for (std::string& word : words) {
    if (word == "--packed") {
      choices.slots = SlotKind::Packed;
    } else if (word == "--forget") {
      choices.forgets = true;
    } else if (word == kTellsIdle) {
      choices.tells_idle = true;
    } else if (word == "--names") {
      choices.tells_names = true;
    } else if (word == "--guards") {
      choices.has_guards = true;
    } else {
      sorted.others.push_back(std::move(word));
    }
  }
  return sorted;
}

std::string words_of_export(std::vector<std::string> words) {
  constexpr std::array<std::string_view, 3> kOfTheTerminal = {"export", "-q",
                                                              "-v"};
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const std::string& word = words[i];
    if (word == "--to" || word == "--color") {
      ++i;
      continue;
    }
    if (std::ranges::find(kOfTheTerminal, word) != kOfTheTerminal.end() ||
        word.starts_with("--to=") || word.starts_with("--color=")) {
      continue;
    }
    text += (text.empty() ? "" : " ") + as_word(word);
  }
  return text;
}

}  // namespace btcheck
