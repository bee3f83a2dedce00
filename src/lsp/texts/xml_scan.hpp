// SPDX-License-Identifier: MIT
//
// The elements of an XML text that is being written: what is half there is
// taken as far as it goes. Nothing is decoded; parts are bytes of the text.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "text/diagnostic.hpp"

namespace btcheck::lsp {

inline constexpr std::size_t kNone = static_cast<std::size_t>(-1);

struct ScannedAttribute {
  TextStretch name;
  TextStretch value;       // without its quotes
  bool has_value = false;  // a quote has been opened

  TextStretch whole() const {
    return {name.begin, has_value ? value.end + 1 : name.end};
  }
};

struct ScannedElement {
  TextStretch name;
  TextStretch start_tag;  // <name ...>, as far as it goes
  TextStretch end_tag;    // </name>; empty where there is none
  TextStretch end_name;
  bool is_closed = false;  // the start tag has its `>`
  bool is_empty = false;   // <name ... />
  std::vector<ScannedAttribute> attributes;
  std::size_t parent = kNone;
  std::vector<std::size_t> children;
  std::size_t end = 0;  // behind its end tag, or where it ends without one

  TextStretch whole() const { return {start_tag.begin, end}; }
};

// What a text was parsed into (FileText::parsed).
class XmlScan {
 public:
  explicit XmlScan(const std::string& text);

  const std::vector<ScannedElement>& elements() const { return elements_; }
  const ScannedElement& operator[](std::size_t i) const { return elements_[i]; }
  const std::vector<TextStretch>& comments() const { return comments_; }
  std::string_view text(TextStretch part) const { return part.in(text_); }
  std::string_view name(std::size_t i) const { return text(elements_[i].name); }

  // The innermost element around a byte; kNone for none.
  std::size_t around(std::size_t at) const;
  // The element whose start or end tag the byte is in or right behind.
  std::size_t tag_at(std::size_t at) const;
  const ScannedAttribute* attribute(std::size_t element,
                                    std::string_view name) const;
  std::string_view value(std::size_t element, std::string_view name) const;
  // The <BehaviorTree> that an element is in, or is; kNone for none.
  std::size_t tree_of(std::size_t element) const;
  bool is_in_comment(std::size_t at) const;

 private:
  void scan_start(std::size_t at);
  void scan_end(std::size_t at);
  std::size_t skip_blanks(std::size_t at) const;
  std::size_t name_end(std::size_t at) const;
  void close_until(std::size_t depth, std::size_t at);

  const std::string_view text_;
  std::vector<ScannedElement> elements_;
  std::vector<TextStretch> comments_;
  std::vector<std::size_t> open_;
  std::size_t at_ = 0;
};

}  // namespace btcheck::lsp
