// SPDX-License-Identifier: MIT
//
// A run that grows, as the pages that follow it are told of it.
//
// What is told is a list of messages, each written once and never changed.
// Whoever listens has a place in the list, and nothing more: who is slow, or
// comes late, or has been away, is behind in the list and delays nobody.
//
// A list has an end. A run that is longer than a page can well show is told in
// chapters: a new one begins with the state that is reached then, and what was
// before is dropped.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "text/json.hpp"
#include "trace/run/recorded_run.hpp"
#include "trace/viewer/packed.hpp"

namespace btcheck {

// A rule, and what the run so far says of it.
struct LiveVerdict {
  std::string name;
  std::string text;
  std::string verdict;           // OPEN, SATISFIED, VIOLATED, EXCLUDED
  std::string moment = {};       // when it was decided, or why it is not
  std::size_t state = kNoState;  // that decided it, from the run's first, 0
  bool is_expected = false;      // to be violated

  friend bool operator==(const LiveVerdict&, const LiveVerdict&) = default;
};

class LiveRun {
 public:
  // Whether one run goes on, or runs that are over take each other's place.
  enum class Kind : std::uint8_t { Growing, Replaced };

  // The run as it begins, with at least one state. A chapter has no more than
  // `most_cells` states times nodes, but for its last piece.
  explicit LiveRun(RecordedRun beginning, std::size_t most_cells = kMostCells)
      : LiveRun(std::move(beginning), Kind::Growing, most_cells) {}
  LiveRun(RecordedRun beginning, Kind kind,
          std::size_t most_cells = kMostCells);

  // The run has gone on. At the last state `words` are said of it, once it is
  // over; after that nothing is added.
  void add(std::span<const RecordedState> states);
  void end(std::string_view words);
  // All rules that are asked of the run, in their order, once what is said of
  // one of them has changed. States that they name have been added before.
  void judge(std::vector<LiveVerdict> rules);
  // Another run in the place of this one.
  void begin_anew(RecordedRun beginning);
  // Called after each of these, by the thread that has added.
  void on_news(std::function<void()> hear);

  // Of somebody who listens.
  struct Place {
    std::uint64_t chapter = 0;
    std::size_t heard = 0;  // messages of it
  };
  // As the text of a place: "3-17".
  static std::optional<Place> place_of(std::string_view text);

  // A server-sent event; null where there is none yet, or none any more.
  using Message = std::shared_ptr<const std::string>;
  // The message at a place, which moves on. A place of another chapter hears
  // `event: anew`, and then nothing.
  Message next(Place& place) const;
  // Whether nothing will follow there.
  bool is_told(const Place& place) const;

  // The page of the present chapter; it listens from its beginning on.
  std::string page(std::string_view nonce) const;

 private:
  // 64 MB in a page.
  static constexpr std::size_t kMostCells = std::size_t{1} << 26;

  void open_chapter(RecordedRun beginning);
  Json told_rules() const;
  void push(std::string_view event, std::string_view data);
  void tell() const;

  const Kind kind_;
  const std::size_t most_cells_;
  mutable std::mutex mutex_;
  std::uint64_t chapter_ = 0;
  std::shared_ptr<const RecordedRun> beginning_;  // of the chapter
  std::string packed_;                            // the same
  std::unique_ptr<RunPacker> packer_;
  std::vector<Message> messages_;  // of the chapter
  std::size_t states_ = 0;         // of the chapter
  std::size_t before_ = 0;         // states of the run before the chapter
  std::vector<LiveVerdict> rules_;
  bool is_over_ = false;
  std::function<void()> hear_;
};

}  // namespace btcheck
