// SPDX-License-Identifier: MIT
//
// JSON as it is written: a value is its text.
#pragma once

#include <concepts>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace btcheck {

// The text, with U+FFFD for what is no UTF-8.
std::string valid_utf8(std::string_view text);

// An object from its members, `Json{{"tick", 2}, {"event", "a -> success"}}`,
// or a plain value. Members stay in the order in which they are given.
class Json {
 public:
  Json(std::initializer_list<std::pair<std::string_view, Json>> members);
  template <std::integral Number>
  Json(Number number) : text_(std::to_string(number)) {}
  Json(bool value) : text_(value ? "true" : "false") {}
  template <class Text>
  requires std::convertible_to<const Text&, std::string_view> Json(
      const Text& text) {
    append_quoted(text);
  }

  // Of the text of a number, "1.5".
  static Json number(std::string_view text) { return raw(text); }
  static Json null() { return raw("null"); }
  static Json object() { return raw("{}"); }
  static Json array() { return raw("[]"); }
  // One with the elements of a range.
  template <class Range>
  static Json array(const Range& range) {
    Json all = array();
    for (const auto& element : range) all.push(element);
    return all;
  }

  // One more element of an array; one more member of an object, whose name must
  // be new.
  Json& push(const Json& element);
  Json& add(std::string_view name, const Json& value);
  bool is_empty() const { return text_.size() == 2; }  // array or object

  // On one line, without blanks; valid UTF-8.
  const std::string& text() const { return text_; }
  // A line for each element and member, nested ones further right.
  std::string indented(std::size_t by) const;

  friend bool operator==(const Json&, const Json&) = default;

 private:
  Json() = default;
  static Json raw(std::string_view text);
  void append_quoted(std::string_view text);
  void reopen();

  std::string text_;
};

}  // namespace btcheck
