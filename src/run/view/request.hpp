// SPDX-License-Identifier: MIT
//
// Who may see a run that is served, and what is answered to whom.
//
// The server is for the user of this machine, who has the address with its
// token from the terminal. Against other users and other programs there is the
// token. Against pages of strangers in the user's own browser, which can send
// requests to any address, there are the headers Host (a name of theirs that
// leads to 127.0.0.1 says theirs) and Origin (a script of theirs says where it
// is from).
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "trace/live/live_run.hpp"

namespace btcheck {

// Where a run is served.
struct LiveAddress {
  std::uint16_t port = 0;
  std::string token;

  // "http://127.0.0.1:4711/?token=…"
  std::string text() const;
};

// 128 bits that nobody guesses, as 32 digits. Throws std::exception where the
// system has none.
std::string random_token();

// What counts of a request. All headers of a name, in their order.
struct LiveRequest {
  std::string_view method;
  std::string_view target;
  std::vector<std::string_view> hosts;
  std::vector<std::string_view> origins;
  std::string_view last_event_id;  // "" where there is none
};

// What is answered: an error (403, 404, 405), the page of a run, its events
// from a place on, or the list of runs.
struct LiveAnswer {
  unsigned status = 200;
  std::optional<LiveRun::Place> events;
  std::optional<std::size_t> run = {};  // none: the list
};
// Of several runs each has a folder, "/1/" the first; one alone has none.
LiveAnswer answer_to(const LiveRequest& request, const LiveAddress& address,
                     std::size_t runs = 1);

}  // namespace btcheck
