// SPDX-License-Identifier: MIT
//
// XML as tinyxml2 reads it, with the column of every tag and attribute.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "text/diagnostic.hpp"

namespace btcheck::btcpp {

struct XmlAttribute {
  std::string name;
  std::string value;  // entities decoded; of a name unbroken
  SourceSpan name_span;
  SourceSpan value_span;  // without the quotes
  TextStretch name_part;
  TextStretch value_part;
};

struct XmlElement {
  std::string name;
  SourceSpan span;  // of the name in the start tag
  std::vector<XmlAttribute> attributes;
  std::string text;       // the first text inside, "" when there is none
  TextStretch start_tag;  // <name ...>
  TextStretch end_tag;    // </name>; empty behind <name ... />
  std::size_t parent = 0;
  std::vector<std::size_t> children;  // in the order of the text

  // The value of an attribute, or nullptr.
  const std::string* value(std::string_view name) const;
  std::string value_or_empty(std::string_view name) const;
  const XmlAttribute* attribute(std::string_view name) const;
};

// The elements of a text in the order of their start tags; the first is the
// root. Without a value there is one error, of a file without a name.
struct ParsedXml : Result<std::vector<XmlElement>> {
  explicit ParsedXml(const std::string& text);
};

}  // namespace btcheck::btcpp
