// SPDX-License-Identifier: MIT
//
// Enough of an XML reader to say that a text is well-formed and what is in it:
// elements, attributes, character data and the five entities. Anything else is
// refused.
#pragma once

#include <doctest/doctest.h>

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace btcheck {

struct XmlElement {
  std::string name;
  std::map<std::string, std::string> attributes;
  std::vector<XmlElement> children;
  std::string text;

  const XmlElement* child(std::string_view called) const {
    for (const XmlElement& element : children) {
      if (element.name == called) return &element;
    }
    return nullptr;
  }
};

class XmlReader {
 public:
  explicit XmlReader(std::string_view text) : text_(text) {}

  XmlElement document() {
    take("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n");
    XmlElement root = element();
    skip_space();
    CHECK(at_ == text_.size());
    return root;
  }

 private:
  void take(std::string_view wanted) {
    INFO(text_.substr(at_, 40));
    REQUIRE(text_.substr(at_, wanted.size()) == wanted);
    at_ += wanted.size();
  }
  bool sees(std::string_view wanted) const {
    return text_.substr(at_, wanted.size()) == wanted;
  }
  void skip_space() {
    while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\n')) {
      ++at_;
    }
  }
  std::string name() {
    std::string read;
    while (at_ < text_.size() && (std::isalpha(text_[at_]) != 0 ||
                                  text_[at_] == '-' || text_[at_] == '_')) {
      read += text_[at_++];
    }
    REQUIRE(!read.empty());
    return read;
  }

  // A character that XML allows, or what an entity stands for.
  std::string character() {
    REQUIRE(at_ < text_.size());
    const char c = text_[at_];
    CHECK(c != '<');
    const bool is_control =
        static_cast<unsigned char>(c) < 0x20 && c != '\n' && c != '\t';
    CHECK(!is_control);
    if (c != '&') return std::string(1, text_[at_++]);
    static const std::map<std::string_view, std::string> kEntities = {
        {"&amp;", "&"},  {"&lt;", "<"},   {"&gt;", ">"}, {"&quot;", "\""},
        {"&apos;", "'"}, {"&#10;", "\n"}, {"&#9;", "\t"}};
    const std::size_t end = text_.find(';', at_);
    REQUIRE(end != std::string_view::npos);
    const auto entity = kEntities.find(text_.substr(at_, end + 1 - at_));
    REQUIRE(entity != kEntities.end());
    at_ = end + 1;
    return entity->second;
  }

  XmlElement element() {
    take("<");
    XmlElement read;
    read.name = name();
    while (sees(" ")) {
      skip_space();
      const std::string key = name();
      take("=\"");
      std::string value;
      while (!sees("\"")) value += character();
      take("\"");
      CHECK(read.attributes.emplace(key, value).second);
    }
    if (sees("/>")) {
      take("/>");
      return read;
    }
    take(">");
    while (!sees("</")) {
      if (sees("<")) {
        read.children.push_back(element());
      } else {
        read.text += character();
      }
    }
    take("</");
    CHECK(name() == read.name);
    take(">");
    return read;
  }

  std::string_view text_;
  std::size_t at_ = 0;
};

inline XmlElement read_xml(std::string_view text) {
  return XmlReader(text).document();
}

}  // namespace btcheck
