// SPDX-License-Identifier: MIT
//
// What the tests of the exports ask of a model's text.
#pragma once

#include <string_view>

namespace btcheck {

// Whether the part stands in the text, letter by letter.
inline bool has(std::string_view model, std::string_view part) {
  return model.find(part) != std::string_view::npos;
}

}  // namespace btcheck
