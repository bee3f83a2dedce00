// SPDX-License-Identifier: MIT
//
// Messages of JSON-RPC 2.0, read within bounds and written.
//
// A message may come from anybody: nesting and the number of values are bounded
// while it is read, before anything is kept of it.
#pragma once

#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "text/json.hpp"

namespace btcheck {

// A value as it was read.
struct JsonValue {
  enum class Kind : unsigned char { Null, Flag, Number, Text, List, Object };

  Kind kind = Kind::Null;
  std::string text;              // of a text; of a flag and a number as written
  std::vector<JsonValue> items;  // of a list, and values of an object
  std::vector<std::string> names;  // of an object, one for each item

  bool is(Kind of) const { return kind == of; }
  // The member of an object, nullptr where there is none or this is no object.
  const JsonValue* member(std::string_view name) const;
  // Its text, flag or number; "" for everything else.
  std::string word(std::string_view name) const;
};

// What is answered instead of a result.
class RpcError : public std::runtime_error {
 public:
  RpcError(int code, const std::string& text)
      : std::runtime_error(text), code_(code) {}
  int code() const { return code_; }

 private:
  int code_;
};
// Codes of JSON-RPC 2.0, and of the Language Server Protocol behind them.
namespace rpc {
inline constexpr int kParseError = -32700;
inline constexpr int kInvalidRequest = -32600;
inline constexpr int kMethodNotFound = -32601;
inline constexpr int kInvalidParams = -32602;
inline constexpr int kInternalError = -32603;
inline constexpr int kOverload = -32000;
inline constexpr int kOutOfMemory = -32001;
inline constexpr int kNotFound = -32002;
inline constexpr int kCancelled = -32800;
}  // namespace rpc

// A request, or a notification where it has no id.
struct RpcMessage {
  std::string id;  // as JSON text, "7" or "\"a\""; "" for none
  std::string method;
  JsonValue params;        // an object, or Null
  bool is_answer = false;  // to a request of this side
};

// Throws RpcError, with `id` set where one could be read.
RpcMessage read_message(std::string_view text, std::string& id);

// `result` is JSON text.
std::string result_text(const std::string& id, const std::string& result);
std::string error_text(const std::string& id, const RpcError& error);
std::string notification_text(std::string_view method, const Json& params);

// A member of `params`, which has to be there as a text.
std::string needed_text(const JsonValue& params, std::string_view name);
// A whole number of at least `least`, `otherwise` where there is none.
long number_or(const JsonValue& params, std::string_view name, long least,
               long otherwise);

// Refuses members that are not among these words, by name.
void refuse_others(const JsonValue& params,
                   const std::vector<std::string>& known);

}  // namespace btcheck
