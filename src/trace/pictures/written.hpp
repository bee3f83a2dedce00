// SPDX-License-Identifier: MIT
//
// What stands beside a node's name in its file, for drawings of the tree alone.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <string_view>

#include "text/diagnostic.hpp"
#include "trace/run/recorded_run.hpp"

namespace btcheck {

class WrittenNodes {
 public:
  explicit WrittenNodes(const RecordedRun& run);

  // On one line: `num_attempts=3 _skipIf=docked`, `:args (x -3 y -3 z 5)`, the
  // expression of an Eval. Without the node's name and ID; "" where there is no
  // more, or the run does not have the text.
  std::string at(std::size_t node) const;

 private:
  // The file's text from the bracket before the node's type on.
  std::string_view text_from(std::size_t node) const;

  const RecordedRun& run_;
  std::map<std::string_view, SourceText> files_;  // "" is the tree's own
};

}  // namespace btcheck
