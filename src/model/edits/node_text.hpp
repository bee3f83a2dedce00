// SPDX-License-Identifier: MIT
//
// Where the parts of a node stand in its file, XML or .btf, byte by byte.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "text/diagnostic.hpp"
#include "text/input_file.hpp"

namespace btcheck {

struct AttributeText {
  std::string name;
  TextStretch whole;  // name="value", :name value
  TextStretch value;  // without quotes
};

struct NodeText {
  TextStretch whole;                    // with all that is below it
  TextStretch type;                     // the word
  std::optional<TextStretch> end_type;  // in an end tag
  std::vector<AttributeText> attributes;
  std::size_t next_attribute = 0;     // where another one goes
  std::optional<TextStretch> inside;  // its children

  const AttributeText* attribute(std::string_view name) const;
};

// The node whose type begins at the byte; nothing where there is none, or the
// file cannot be read.
std::optional<NodeText> xml_node_at(const FileText& file, std::size_t at);
std::optional<NodeText> btf_node_at(const FileText& file, std::size_t at);

}  // namespace btcheck
