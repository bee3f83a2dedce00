// SPDX-License-Identifier: MIT
//
// Exported models, read back from their text and explored without cleverness.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace btcheck::reference {

// What a text turned out to mean.
struct ReadSpace {
  std::uint64_t states = 0;
  std::uint64_t transitions = 0;  // steps of time back to their state left out
  // What the text asks of single states, by name: whether it is true of every
  // state that is reached.
  std::map<std::string, bool> always;
};

// Nothing when there are more than `most` states. A text that is not of the
// subset of the language that is written is thrown as runtime_error.
std::optional<ReadSpace> read_smv_space(const std::string& text,
                                        std::size_t most);
std::optional<ReadSpace> read_fiacre_space(const std::string& text,
                                           std::size_t most);

}  // namespace btcheck::reference
