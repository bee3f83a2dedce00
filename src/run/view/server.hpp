// SPDX-License-Identifier: MIT
//
// A run that grows, served to the browsers of this machine: the page, and what
// is new of the run as server-sent events (docs/run.md, "Watch it run").
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "trace/live/live_run.hpp"

namespace btcheck {

// What a client may take. The defaults are those of the program; tests have
// less patience.
struct ServerLimits {
  std::size_t connections = 8;  // more are closed unheard
  std::size_t header_bytes = 8192;
  std::chrono::milliseconds to_ask{5'000};      // the whole request
  std::chrono::milliseconds to_listen{10'000};  // to take one message
};

// Listens on 127.0.0.1 and nowhere else, on a thread of its own, from `open`
// until it is destroyed.
class LiveServer {
 public:
  // The run must outlive it, and nobody adds to it while this is destroyed.
  explicit LiveServer(LiveRun& run, const ServerLimits& limits = {});
  // Runs with names, of which none is there yet. Of several the page is a list
  // with a page for each.
  explicit LiveServer(std::vector<std::string> names,
                      const ServerLimits& limits = {});
  ~LiveServer();
  LiveServer(const LiveServer&) = delete;
  LiveServer& operator=(const LiveServer&) = delete;

  // On this port; 0: on any that is free. Returns what went wrong, or "".
  std::string open(std::uint16_t port);
  // A run by its place among the names; by any thread, once for each. Until
  // then its page waits.
  void show(std::size_t place, LiveRun& run);
  // With the token. Once it is open.
  std::string address() const;
  // Whether somebody listens, or has got the page and is about to.
  bool is_watched() const;
  // The run is over: waits until all of them have been told so, but no longer
  // than this.
  void finish(std::chrono::milliseconds patience);

 private:
  class Hall;
  std::unique_ptr<Hall> hall_;
};

}  // namespace btcheck
