// SPDX-License-Identifier: MIT
//
// A run in little space: JSON that src/trace/viewer/run.js unpacks.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "text/json.hpp"
#include "trace/run/recorded_run.hpp"

namespace btcheck {

// The run as one document. It has no `<` and no line separator of JavaScript,
// so it may stand in a script element as it is.
std::string packed_run(const RecordedRun& run);

// A document in such a spelling.
std::string safe_json(const Json& document);

// Writes the keys of nodes shorter.
class KeyShortener {
 public:
  // The nodes must outlive it.
  explicit KeyShortener(const std::vector<RecordedNode>& nodes);
  std::string shortened(std::string_view text,
                        std::optional<std::uint32_t> own) const;

 private:
  std::pair<std::size_t, std::uint32_t> key_at(std::string_view text,
                                               std::size_t at) const;

  std::unordered_map<std::string_view, std::uint32_t> number_of_;
  std::set<std::size_t> lengths_;
};

// Packs a run piece by piece, as it grows. The pieces one after the other are
// what packed_run makes of the whole.
class RunPacker {
 public:
  // Of the run all but its states is read; it must outlive the packer.
  explicit RunPacker(const RecordedRun& run);

  // What is told of a run beside its states: what all runs of a tree have in
  // common, and the rest.
  Json about() const;
  Json shared() const;
  void add_own(Json& document) const;
  // Goes on with the beginning of another run of the same tree. Texts and
  // changes keep their numbers; the first run must outlive the packer.
  void begin(const RecordedRun& next);
  // Adds "states", and the "texts" and "changes" that are new with them.
  void add(std::span<const RecordedState> more, Json& document);

 private:
  std::size_t number_of(const std::string& text);
  Json change_between(const RecordedState& before, const RecordedState& now);
  std::vector<std::size_t> different(const std::vector<std::string>& before,
                                     const std::vector<std::string>& now,
                                     bool has_keys = false);

  const RecordedRun* run_;
  KeyShortener keys_;
  std::unordered_map<std::string, std::size_t> number_of_;  // of texts
  std::vector<std::string> texts_;                          // that are new
  std::unordered_map<std::string, std::size_t> known_;      // changes
  RecordedState before_;
};

}  // namespace btcheck
