// SPDX-License-Identifier: MIT
//
// All that decides what comes of a check, as one text: where nothing of it has
// changed, neither has the result.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "check/check.hpp"

namespace btcheck {

class Content {
 public:
  // Each part with its length, so that no two lists of parts look the same.
  void add(std::string_view part);
  void add(const std::vector<InputFile>& files);
  // The tree, and all that it was read with.
  void add(const TreeInput& tree);

  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

}  // namespace btcheck
