// SPDX-License-Identifier: MIT
//
// Properties of Fiacre, read as strictly as its compiler reads them.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "reference/model_text.hpp"

namespace btcheck::reference {

struct ReadProperty {
  std::string name;
  // `always F` and `absent F` of every state: F and which of the two; for
  // other properties both are empty.
  std::string form;
  std::vector<std::string> condition;
};

// Reads from the name on, its assertion included. `observation` takes the words
// of `C/k/state S` or `C/k/value (E)` and gives the word that stands for them
// in a condition. What frac would refuse is thrown as runtime_error.
ReadProperty read_fiacre_property(
    WordReader& words, const std::function<std::string()>& observation);

// Takes a name that is about to be declared; words of the language are none.
std::string fiacre_name(WordReader& words);

}  // namespace btcheck::reference
