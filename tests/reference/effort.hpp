// SPDX-License-Identifier: MIT
//
// How many random cases a cross-check draws, and which: BTCHECK_LONG asks for
// more of them, BTCHECK_SEED for others.
#pragma once

#include <cstdint>
#include <cstdlib>

namespace btcheck::reference {

inline bool is_long_run() { return std::getenv("BTCHECK_LONG") != nullptr; }

template <class Number>
Number by_effort(Number normal, Number in_long_run) {
  return is_long_run() ? in_long_run : normal;
}

// The seed asked for, else `otherwise`.
inline std::uint64_t seed_or(std::uint64_t otherwise) {
  const char* text = std::getenv("BTCHECK_SEED");
  return text == nullptr ? otherwise : std::strtoull(text, nullptr, 10);
}

// A test's own seed, moved by the one asked for.
inline unsigned shifted_seed(unsigned own) {
  return own + static_cast<unsigned>(seed_or(0));
}

}  // namespace btcheck::reference

// That the random cases have what is looked for. Known of the suite's own
// seeds; with others it is only told. For files that include doctest.
#define CHECK_COVERED(condition)                  \
  do {                                            \
    if (std::getenv("BTCHECK_SEED") == nullptr) { \
      CHECK(condition);                           \
    } else {                                      \
      WARN(condition);                            \
    }                                             \
  } while (false)
