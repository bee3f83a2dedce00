// SPDX-License-Identifier: MIT
//
// The page of `--watch --view`: the run of what is wrong with the tree that was
// checked last.
#pragma once

#include <string>

#include "cli/options/options.hpp"
#include "cli/outputs/open_view.hpp"
#include "report/formats/reported.hpp"
#include "run/view/server.hpp"
#include "trace/live/live_run.hpp"

namespace btcheck {

class CheckView {
 public:
  // Makes a folder for the runs, where `options` name none, and writes its name
  // there. Throws std::exception where that is not possible.
  explicit CheckView(Options& options);
  ~CheckView();
  CheckView(const CheckView&) = delete;
  CheckView& operator=(const CheckView&) = delete;

  // On the port of --view. False, once it is said why, where it cannot.
  bool open(const Options& options) { return open_view(options, server_); }

  // Whether a run can be shown of what is wrong with the tree.
  static bool has_run(const ReportedTree& tree);
  // That run; or that there is none.
  void show(const ReportedTree& tree);
  // Nothing is shown any more.
  void end();

 private:
  std::string own_folder_;  // "" where the user has named one
  LiveRun run_;
  LiveServer server_;
};

}  // namespace btcheck
