// SPDX-License-Identifier: MIT
//
// Any bytes as a message of JSON-RPC: a request, or an error with a reason;
// what is written of either can be read again.
#include <string>
#include <string_view>

#include "fuzzed.hpp"
#include "serve/message.hpp"

namespace btcheck {
namespace {

// As many names as values, where there are names at all.
void check_value(const JsonValue& value) {
  const bool is_object = value.is(JsonValue::Kind::Object);
  require(value.names.size() == (is_object ? value.items.size() : 0));
  for (const JsonValue& each : value.items) check_value(each);
}

void check_written(const std::string& text) {
  std::string id;
  const RpcMessage again = read_message(text, id);
  require(again.is_answer || again.method == "a");
}

}  // namespace

void check_bytes(std::string_view text) {
  std::string id;
  try {
    const RpcMessage message = read_message(text, id);
    require(message.id == id);
    require(message.is_answer || message.params.is(JsonValue::Kind::Null) ||
            message.params.is(JsonValue::Kind::Object));
    check_value(message.params);
    if (!id.empty()) check_written(result_text(id, "{}"));
  } catch (const RpcError& fault) {
    require(fault.code() < 0 && *fault.what() != '\0');
    if (!id.empty()) check_written(error_text(id, fault));
  }
  check_written(notification_text("a", Json{{"text", text}}));
}

}  // namespace btcheck
