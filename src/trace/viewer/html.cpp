// SPDX-License-Identifier: MIT
//
// The page is a form with gaps: {{policy}}, {{title}}, {{style}}, {{run}},
// {{nonce}} and {{script}}.
#include "trace/viewer/html.hpp"

#include <fmt/format.h>

#include <cstddef>
#include <utility>

#include "model/tree/node_types.hpp"
#include "text/utf8.hpp"
#include "trace/viewer/packed.hpp"

namespace btcheck {
namespace {

// Text as HTML; what cannot be shown is replaced.
std::string escaped(std::string_view text) {
  std::string result;
  for (std::size_t at = 0; at < text.size();) {
    const CodePoint point = decode(text, at);
    result += !point.is_valid      ? "\ufffd"
              : point.value < 0x20 ? " "
                                   : text.substr(at, point.length);
    at += point.length;
  }
  return with_entities(result);
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
  for (const NodeTypeInfo& type : kNodeTypes) {
    if (type.sign.empty()) continue;
    text += fmt::format("{}{}: \"{}\"", text.empty() ? "" : ", ", type.name,
                        type.sign);
  }
  return fmt::format("const CONTROL_SIGNS = {{ {} }};\n", text);
}

}  // namespace

std::string filled(std::string_view form, const Gaps& gaps) {
  std::string page;
  for (const auto& [gap, text] : gaps) {
    const std::size_t at = form.find(gap);
    page += form.substr(0, at);
    page += text;
    form.remove_prefix(at + gap.size());
  }
  page += form;
  return page;
}

namespace {

// What a page that is served has beside the others; nothing in those.
struct Served {
  std::string policy = {};
  std::string style = {};
  std::string nonce = {};  // an attribute of the script
  std::string script = "begin(Viewer);";
  // Of long runs, and of those that go on, the lanes show a window.
  bool is_long = false;
};

std::string title_of(const RecordedRun& run) {
  return escaped(
      fmt::format("{} {} · {}", run.verdict, run.property, run.tree));
}

std::string page(std::string title, std::string packed, const Served& served) {
  return filled(
      kViewerPage,
      {{"{{policy}}", served.policy},
       {"{{title}}", std::move(title)},
       {"{{style}}",
        fmt::format("{}{}{}", joined(kViewerStyles),
                    served.is_long ? kViewerLongStyle : "", served.style)},
       {"{{run}}", std::move(packed)},
       {"{{nonce}}", served.nonce},
       {"{{script}}",
        fmt::format("{}{}{}{}", control_signs(), joined(kViewerScripts),
                    served.is_long ? kViewerLong : "", served.script)}});
}

}  // namespace

std::string html_text(const RecordedRun& run) {
  return page(title_of(run), packed_run(run),
              {.is_long = run.states.size() > kLongRun});
}

std::string viewer_form(bool has_long_runs) {
  return page("{{title}}", "{{run}}", {.is_long = has_long_runs});
}

std::string live_page(const RecordedRun& run, std::string packed,
                      std::string_view nonce) {
  return page(
      title_of(run), std::move(packed),
      {"; connect-src 'self'", std::string(kViewerLiveStyle),
       fmt::format(" nonce=\"{}\"", nonce), std::string(kViewerLive), true});
}

std::string with_code(std::string_view text) {
  std::string result;
  bool is_code = false;
  for (const char c : with_entities(unbroken(harmless(text)))) {
    if (c != '`') {
      result += c;
      continue;
    }
    result += is_code ? "</code>" : "<code>";
    is_code = !is_code;
  }
  return is_code ? result + "</code>" : result;
}

}  // namespace btcheck
