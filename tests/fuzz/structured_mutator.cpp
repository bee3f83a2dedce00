// SPDX-License-Identifier: MIT
//
// Mutations that mostly keep a text readable: whole units of it, lists in
// brackets, XML elements, lines, words and numbers, are dropped, doubled,
// exchanged, put into one another. Bytes alone hardly ever get behind the first
// syntax error; three of four mutations are of this kind. It serves all our
// languages, as all of them nest by brackets or tags.
#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <random>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size,
                                        std::size_t max_size);

namespace {

enum class Kind : std::uint8_t { List, Element, Line, Word, Number, String };

// A part of the text, with its brackets or tags.
struct Unit {
  Kind kind;
  std::size_t begin;
  std::size_t end;
};

bool is_in_word(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' ||
         c == ':' || c == '.';
}

// The units of a text that is perhaps not well-formed.
class Reader {
 public:
  explicit Reader(std::string_view text) : text_(text) {}

  std::vector<Unit> units() {
    for (std::size_t at = 0; at < text_.size();) at = read(at);
    lines();
    return std::move(units_);
  }

 private:
  // Returns where to go on.
  std::size_t read(std::size_t at) {
    const char c = text_[at];
    if (c == '<') return tag(at);
    if (c == '"' || c == '\'') return string(at);
    if (c == '(' || c == '[' || c == '{') open_.push_back(at);
    if ((c == ')' || c == ']' || c == '}') && !open_.empty()) {
      units_.push_back({Kind::List, open_.back(), at + 1});
      open_.pop_back();
    }
    if (!is_in_word(c)) return at + 1;
    std::size_t end = at;
    while (end < text_.size() && is_in_word(text_[end])) ++end;
    const bool is_number = std::isdigit(static_cast<unsigned char>(c)) != 0;
    units_.push_back({is_number ? Kind::Number : Kind::Word, at, end});
    return end;
  }

  // The text in quotes is read for its words as well.
  std::size_t string(std::size_t at) {
    const std::size_t end = text_.find(text_[at], at + 1);
    if (end != text_.npos) units_.push_back({Kind::String, at, end + 1});
    return at + 1;
  }

  std::size_t tag(std::size_t at) {
    const std::size_t end = text_.find('>', at);
    if (end == text_.npos) return at + 1;
    if (at + 1 < text_.size() && text_[at + 1] == '/') {
      if (tags_.empty()) return at + 1;
      units_.push_back({Kind::Element, tags_.back(), end + 1});
      tags_.pop_back();
      return end + 1;
    }
    if (text_[end - 1] == '/') {
      units_.push_back({Kind::Element, at, end + 1});
    } else {
      tags_.push_back(at);
    }
    return at + 1;
  }

  void lines() {
    for (std::size_t at = 0; at < text_.size();) {
      const std::size_t end = std::min(text_.find('\n', at), text_.size() - 1);
      units_.push_back({Kind::Line, at, end + 1});
      at = end + 1;
    }
  }

  std::string_view text_;
  std::vector<std::size_t> open_;
  std::vector<std::size_t> tags_;
  std::vector<Unit> units_;
};

class Mutator {
 public:
  Mutator(std::string text, unsigned seed)
      : text_(std::move(text)), random_(seed) {
    units_ = Reader(text_).units();
  }

  // The text changed, or "" where there is nothing to be changed.
  std::string mutated() {
    if (units_.empty()) return {};
    const Unit one = any();
    const Unit other = like(one);
    switch (below(7)) {
      case 0:
        return with(one, "");
      case 1:
        return with(one, content(one) + " " + content(one));
      case 2:
        return with(one, content(other));
      case 3:
        return exchanged(one, other);
      case 4:  // into itself, or into another
        return with(one, wrapped(content(one), other));
      default:
        return with(one, one.kind == Kind::Number ? number() : content(other));
    }
  }

 private:
  std::size_t below(std::size_t bound) { return random_() % bound; }
  const Unit& any() { return units_[below(units_.size())]; }
  Unit like(const Unit& one) {
    std::vector<Unit> alike;
    std::copy_if(units_.begin(), units_.end(), std::back_inserter(alike),
                 [&](const Unit& unit) { return unit.kind == one.kind; });
    return alike[below(alike.size())];
  }
  std::string content(const Unit& unit) const {
    return text_.substr(unit.begin, unit.end - unit.begin);
  }
  std::string with(const Unit& unit, const std::string& content) const {
    return text_.substr(0, unit.begin) + content + text_.substr(unit.end);
  }
  std::string exchanged(Unit one, Unit other) const {
    if (one.begin > other.begin) std::swap(one, other);
    if (one.end > other.begin) return with(one, content(other));
    return text_.substr(0, one.begin) + content(other) +
           text_.substr(one.end, other.begin - one.end) + content(one) +
           text_.substr(other.end);
  }
  // Between the beginning and the end of the other: "(not " and ")".
  std::string wrapped(const std::string& inside, const Unit& other) const {
    const std::string outside = content(other);
    if (other.kind == Kind::List) {
      const std::size_t head = std::min(outside.find(' '), outside.size() - 1);
      return outside.substr(0, head) + " " + inside + outside.back();
    }
    const std::size_t tag = outside.find('>');
    const std::size_t close = outside.rfind("</");
    if (other.kind == Kind::Element && close != outside.npos && tag < close) {
      return outside.substr(0, tag + 1) + inside + outside.substr(close);
    }
    return inside + outside;
  }
  std::string number() {
    constexpr std::array kNumbers = {
        "0",          "1",     "2",          "3",
        "-1",         "127",   "128",        "255",
        "1000",       "65536", "2147483647", "2147483648",
        "4294967296", "0.5",   "1e9",        "9223372036854775808",
        "007",        "0x10",  "3abc",       "1e308"};
    return kNumbers[below(kNumbers.size())];
  }

  std::string text_;
  std::minstd_rand random_;
  std::vector<Unit> units_;
};

}  // namespace

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data,
                                               std::size_t size,
                                               std::size_t max_size,
                                               unsigned seed) {
  if (seed % 4 != 0 && size > 0) {
    const std::string text =
        Mutator({reinterpret_cast<const char*>(data), size}, seed).mutated();
    if (!text.empty() && text.size() <= max_size) {
      std::memcpy(data, text.data(), text.size());
      return text.size();
    }
  }
  return LLVMFuzzerMutate(data, size, max_size);
}
