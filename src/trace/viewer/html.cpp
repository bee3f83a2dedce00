// SPDX-License-Identifier: MIT
//
// The page is a form with four gaps, {{title}}, {{style}}, {{run}} and
// {{script}}. What goes into a gap is not looked at again: a run may well have
// a gap's name in its source.
#include "trace/viewer/html.hpp"

#include <fmt/format.h>

#include <array>
#include <cstddef>
#include <string_view>
#include <utility>
#include <vector>

#include "model/tree/node_types.hpp"
#include "model/tree/tree.hpp"
#include "text/utf8.hpp"
#include "trace/run/packed.hpp"
#include "trace/run/shown_text.hpp"
#include "trace/viewer/page_form.hpp"
#include "trace/viewer/sources.hpp"

namespace btcheck {
namespace {

// Text as HTML; what cannot be shown is replaced.
std::string escaped(std::string_view text) {
  std::string result;
  for (std::size_t at = 0; at < text.size();) {
    const CodePoint point = decode(text, at);
    const std::string_view entity = xml_entity(text[at]);
    if (!point.is_valid) {
      result += "\ufffd";
    } else if (!entity.empty()) {
      result += entity;
    } else if (point.value < 0x20) {
      result += ' ';
    } else {
      result += text.substr(at, point.length);
    }
    at += point.length;
  }
  return result;
}

template <std::size_t N>
std::string joined(const std::array<std::string_view, N>& parts) {
  std::string text;
  for (const std::string_view part : parts) text += part;
  return text;
}

// The signs of the node types, as the viewer's scripts know them.
std::string control_signs() {
  std::string text;
  for (const NodeTypeInfo& type : node_types()) {
    if (type.sign.empty()) continue;
    text += fmt::format("{}{}: \"{}\"", text.empty() ? "" : ", ", type.name,
                        type.sign);
  }
  return fmt::format("const CONTROL_SIGNS = {{ {} }};\n", text);
}

}  // namespace

std::string html_text(const RecordedRun& run) {
  const std::string title =
      fmt::format("{} {} · {}", run.verdict, run.property, run.tree);
  return filled(kViewerPage,
                {{"{{title}}", escaped(title)},
                 {"{{style}}", joined(kViewerStyles)},
                 {"{{run}}", packed_run(run)},
                 {"{{script}}", control_signs() + joined(kViewerScripts)}});
}

}  // namespace btcheck
