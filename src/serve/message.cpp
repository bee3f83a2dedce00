// SPDX-License-Identifier: MIT
#include "serve/message.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <nlohmann/json.hpp>

#include "text/diagnostic.hpp"
#include "text/numbers.hpp"

namespace btcheck {
namespace {

constexpr std::size_t kMostDepth = 64;
constexpr std::size_t kMostValues = 1'000'000;
constexpr std::size_t kMostMembers = 10'000;

// Builds the value while its text is read.
class Builder {
 public:
  using Kind = JsonValue::Kind;

  bool null() { return add({}); }
  bool boolean(bool value) {
    return add({Kind::Flag, value ? "true" : "false", {}, {}});
  }
  bool number_integer(std::int64_t value) { return add_number(value); }
  bool number_unsigned(std::uint64_t value) { return add_number(value); }
  bool number_float(double, const std::string& text) {
    return add({Kind::Number, text, {}, {}});
  }
  bool string(std::string& text) {
    return add({Kind::Text, std::move(text), {}, {}});
  }
  bool binary(nlohmann::json::binary_t&) { return false; }
  bool start_object(std::size_t) { return open(Kind::Object); }
  bool start_array(std::size_t) { return open(Kind::List); }
  bool end_object() { return close(); }
  bool end_array() { return close(); }
  bool key(std::string& name) {
    auto& names = open_.back().names;
    if (names.size() == kMostMembers) {
      return refuse(fmt::format("more than {} members", kMostMembers));
    }
    if (std::ranges::count(names, name) > 0) {
      return refuse(fmt::format("`{}` is there twice", name.substr(0, 80)));
    }
    names.push_back(std::move(name));
    return true;
  }
  bool parse_error(std::size_t at, const std::string&,
                   const nlohmann::json::exception&) {
    return refuse(fmt::format("no JSON from byte {} on", at));
  }

  JsonValue read;
  std::string fault;

 private:
  template <class Number>
  bool add_number(Number number) {
    return add({Kind::Number, std::to_string(number), {}, {}});
  }
  bool add(JsonValue item) {
    if (++count_ > kMostValues) {
      return refuse(fmt::format("more than {} values", kMostValues));
    }
    (open_.empty() ? read : open_.back().items.emplace_back()) =
        std::move(item);
    return true;
  }
  bool open(Kind kind) {
    if (open_.size() == kMostDepth) {
      return refuse(fmt::format("nested deeper than {}", kMostDepth));
    }
    open_.push_back({kind, {}, {}, {}});
    return true;
  }
  bool close() {
    JsonValue done = std::move(open_.back());
    open_.pop_back();
    return add(std::move(done));
  }
  bool refuse(std::string why) {
    if (fault.empty()) fault = std::move(why);
    return false;
  }

  std::vector<JsonValue> open_;
  std::size_t count_ = 0;
};

// The id as JSON text; only texts and numbers are ids.
std::string id_of(const JsonValue& message) {
  const JsonValue* id = message.member("id");
  if (id == nullptr) return {};
  if (id->is(JsonValue::Kind::Number)) return id->text;
  if (id->is(JsonValue::Kind::Text)) return Json(id->text).text();
  throw RpcError(rpc::kInvalidRequest, "an `id` is a text or a number");
}

}  // namespace

const JsonValue* JsonValue::member(std::string_view name) const {
  const auto at = std::ranges::find(names, name);
  return at == names.end() ? nullptr : &items[at - names.begin()];
}

std::string JsonValue::word(std::string_view name) const {
  const JsonValue* found = member(name);
  return found == nullptr ? std::string() : found->text;
}

RpcMessage read_message(std::string_view text, std::string& id) {
  Builder builder;
  if (!nlohmann::json::sax_parse(text.begin(), text.end(), &builder)) {
    throw RpcError(rpc::kParseError,
                   "the message is refused: " + builder.fault);
  }
  JsonValue& value = builder.read;
  if (value.is(JsonValue::Kind::List)) {
    throw RpcError(
        rpc::kInvalidRequest,
        "several requests at once are sent as messages of their own");
  }
  if (!value.is(JsonValue::Kind::Object)) {
    throw RpcError(rpc::kInvalidRequest, "a message is a JSON object");
  }
  RpcMessage message;
  message.id = id = id_of(value);
  if (value.word("jsonrpc") != "2.0") {
    throw RpcError(rpc::kInvalidRequest, "`jsonrpc` has to be \"2.0\"");
  }
  const JsonValue* method = value.member("method");
  if (method == nullptr && !message.id.empty() &&
      (value.member("result") != nullptr || value.member("error") != nullptr)) {
    message.is_answer = true;
    return message;
  }
  if (method == nullptr || !method->is(JsonValue::Kind::Text)) {
    throw RpcError(rpc::kInvalidRequest, "a request has a `method`, a text");
  }
  message.method = method->text;
  if (const JsonValue* params = value.member("params")) {
    if (!params->is(JsonValue::Kind::Object)) {
      throw RpcError(rpc::kInvalidParams, "`params` has to be an object");
    }
    message.params = *params;
  }
  return message;
}

std::string result_text(const std::string& id, const std::string& result) {
  return fmt::format(R"({{"jsonrpc":"2.0","id":{},"result":{}}})", id, result);
}

std::string error_text(const std::string& id, const RpcError& error) {
  return fmt::format(
      R"({{"jsonrpc":"2.0","id":{},"error":{}}})", id.empty() ? "null" : id,
      Json{{"code", error.code()}, {"message", std::string(error.what())}}
          .text());
}

std::string notification_text(std::string_view method, const Json& params) {
  return Json{{"jsonrpc", "2.0"}, {"method", method}, {"params", params}}
      .text();
}

std::string needed_text(const JsonValue& params, std::string_view name) {
  const JsonValue* found = params.member(name);
  if (found == nullptr || !found->is(JsonValue::Kind::Text)) {
    throw RpcError(rpc::kInvalidParams,
                   fmt::format("`{}` is needed, a text", name));
  }
  return found->text;
}

long number_or(const JsonValue& params, std::string_view name, long least,
               long otherwise) {
  const JsonValue* found = params.member(name);
  if (found == nullptr) return otherwise;
  const auto number = found->is(JsonValue::Kind::Number)
                          ? as_number<long>(found->text)
                          : std::nullopt;
  if (!number || *number < least) {
    throw RpcError(
        rpc::kInvalidParams,
        fmt::format("`{}` has to be a whole number from {} on", name, least));
  }
  return *number;
}

void refuse_others(const JsonValue& params,
                   const std::vector<std::string>& known) {
  for (const std::string& name : params.names) {
    if (std::ranges::count(known, name) > 0) continue;
    const std::string shown = name.substr(0, 80);
    throw RpcError(
        rpc::kInvalidParams,
        fmt::format("there is no `{}` here; {}", shown,
                    did_you_mean(
                        shown, known,
                        fmt::format("there are: {}", fmt::join(known, ", ")))));
  }
}

}  // namespace btcheck
