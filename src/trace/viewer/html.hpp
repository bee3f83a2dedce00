// SPDX-License-Identifier: MIT
//
// A run as a page that anyone can open: the trace viewer.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "trace/run/recorded_run.hpp"

namespace btcheck {

// One file without anything outside it: the viewer (src/trace/viewer/) and the
// run, packed. It opens from disk in any browser, asks no network, and gives
// the run back as itf_text writes it. Equal runs give equal pages; bytes that
// are no UTF-8 are replaced.
std::string html_text(const RecordedRun& run);

// The page with gaps, {{title}} and {{run}}: for a document of its own runs,
// as packed.hpp makes them, that a script fills in.
std::string viewer_form(bool has_long_runs);

// The same page for a run that grows: it holds the beginning, packed with a
// member "live", and listens to the server that it comes from for the rest
// (src/run/view). `nonce` is that of the header Content-Security-Policy.
std::string live_page(const RecordedRun& run, std::string packed,
                      std::string_view nonce);

// A page is a form with gaps, `{{title}}` for instance. Each must occur, in
// this order. What goes into a gap is not searched for gaps: a run may well
// have a gap's name in its source.
using Gaps = std::vector<std::pair<std::string_view, std::string>>;
std::string filled(std::string_view form, const Gaps& gaps);
// A text for a gap, with names in backquotes as code.
std::string with_code(std::string_view text);
// Runs of more states are long ones.
inline constexpr std::size_t kLongRun = 1000;

// The files of this folder, compiled in without what only their readers need;
// together, one style sheet and one script.
extern const std::string_view kViewerPage;
extern const std::array<std::string_view, 2> kViewerStyles;
extern const std::array<std::string_view, 7> kViewerScripts;
extern const std::string_view kViewerLongStyle;
extern const std::string_view kViewerLong;  // of long runs, behind them
extern const std::string_view kViewerLiveStyle;
extern const std::string_view kViewerLive;  // of live pages only, behind them

}  // namespace btcheck
