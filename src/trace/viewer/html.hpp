// SPDX-License-Identifier: MIT
//
// A run as a page that anyone can open: the trace viewer.
#pragma once

#include <string>

#include "trace/run/recorded_run.hpp"

namespace btcheck {

// One file without anything outside it: the viewer (src/trace/viewer/) and the
// run, packed. It opens from disk in any browser, asks no network, and gives
// the run back as itf_text writes it. Equal runs give equal pages; bytes that
// are no UTF-8 are replaced.
std::string html_text(const RecordedRun& run);

}  // namespace btcheck
