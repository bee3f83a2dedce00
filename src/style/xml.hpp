// SPDX-License-Identifier: MIT
//
// The style of XML: trees, models, projects.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "model/btcpp/xml_text.hpp"

namespace btcheck::style {

// Whether a start tag stays in one line, or as it is written in several.
using KeepsLines = std::function<bool(const btcpp::XmlElement&)>;

// Of a text with these elements.
std::string styled_xml(std::string_view text,
                       const std::vector<btcpp::XmlElement>& elements,
                       const KeepsLines& keeps_lines);

// What the text says, in its order: tags, their attributes by name with their
// values as they are written, comments, sections of CDATA, texts.
std::vector<std::string> said_in_xml(
    std::string_view text, const std::vector<btcpp::XmlElement>& elements);

}  // namespace btcheck::style
