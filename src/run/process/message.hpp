// SPDX-License-Identifier: MIT
//
// What a process of leaves says: lines of JSON (docs/run.md).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "btcheck/run.hpp"

namespace btcheck {

// {"id": 7, "answer": "running"}
struct AnswerMessage {
  std::uint64_t id = 0;
  std::string answer;
};
// {"id": 7, "value": "Low"}
struct ValueMessage {
  std::uint64_t id = 0;
  run::Value value;
};
// {"set": "weather", "value": "Storm"}
struct SetMessage {
  std::string variable;
  run::Value value;
};
// {"get": "battery"}
struct GetMessage {
  std::string variable;
};
// None of these: why not.
struct NonsenseMessage {
  std::string why;
};

using LeafMessage = std::variant<AnswerMessage, ValueMessage, SetMessage,
                                 GetMessage, NonsenseMessage>;

LeafMessage read_message(std::string_view line);

}  // namespace btcheck
