// SPDX-License-Identifier: MIT
#include "cli/outputs/open_view.hpp"

#include <fmt/format.h>

#include <csignal>
#include <string>

#include "cli/console/console.hpp"
#include "cli/inputs/inputs.hpp"

namespace btcheck {

// Signals are for the thread that waits for them, and not for that of the
// server.
bool open_view(const Options& options, LiveServer& server) {
  sigset_t all;
  sigset_t before;
  ::sigfillset(&all);
  ::pthread_sigmask(SIG_BLOCK, &all, &before);
  const std::string fault = server.open(*options.view);
  ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
  if (!fault.empty()) {
    show(options,
         {file_error("BT1705", "",
                     fmt::format("the run cannot be shown on port {}: {}",
                                 *options.view, fault),
                     "--view alone takes a port that is free")});
    return false;
  }
  tell(fmt::format("view: {}\n", server.address()));
  return true;
}

}  // namespace btcheck
