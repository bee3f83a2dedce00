// SPDX-License-Identifier: MIT
//
// The tags of an XML text, one after the other: as much XML as a log needs.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace btcheck {

struct XmlTag {
  std::string name;
  std::vector<std::pair<std::string, std::string>> attributes;
  bool opens = false;   // <a> and <a/>
  bool closes = false;  // </a> and <a/>

  // The value of an attribute, or null.
  const std::string* find(std::string_view attribute) const;
};

// Owns nothing: the text must live as long as the scanner does. As lenient as
// tinyxml2, whose files it reads: unknown entities stand for themselves, and
// whether tags match is left to the caller.
class XmlScanner {
 public:
  explicit XmlScanner(std::string_view text) : text_(text) {}

  // The next tag. Nothing at the end, and where the text is no XML: then
  // `flaw` says why.
  std::optional<XmlTag> next();
  const std::string& flaw() const { return flaw_; }

  // The line, from 1, in which the last tag begins.
  std::size_t line() const;

 private:
  bool at_end() const { return at_ >= text_.size(); }
  char here() const { return text_[at_]; }
  std::optional<XmlTag> refuse(std::string_view why);
  bool skip_past(std::string_view end);
  void skip_blanks();
  std::string_view word();
  bool read_attribute(XmlTag& tag);
  bool skip_other();

  std::string_view text_;
  std::size_t at_ = 0;
  std::size_t begin_ = 0;  // of the last tag
  std::string flaw_;
};

}  // namespace btcheck
