// SPDX-License-Identifier: MIT
#include "run/process/message.hpp"

#include <nlohmann/json.hpp>

#include "trace/run/shown_text.hpp"

namespace btcheck {
namespace {

using Read = nlohmann::json;

constexpr std::size_t kMostQuoted = 60;  // letters of a line

NonsenseMessage nonsense(std::string_view line, std::string_view why) {
  return {"`" + shortened(one_line(line), kMostQuoted) + "` " +
          std::string(why)};
}

std::optional<run::Value> value_in(const Read& object) {
  const auto value = object.find("value");
  if (value == object.end()) return std::nullopt;
  if (value->is_number()) return run::Value(value->get<double>());
  if (value->is_string()) return run::Value(value->get<std::string>());
  return std::nullopt;
}

bool has_text(const Read& object, const char* name) {
  return object.contains(name) && object[name].is_string();
}

}  // namespace

LeafMessage read_message(std::string_view line) {
  const Read object = Read::parse(line, nullptr, false);
  if (object.is_discarded()) return nonsense(line, "is no JSON");
  if (!object.is_object()) return nonsense(line, "is no object");
  const auto value = value_in(object);
  if (has_text(object, "get")) return GetMessage{object["get"]};
  if (has_text(object, "set")) {
    if (!value) return nonsense(line, "sets no value, a text or a number");
    return SetMessage{object["set"], *value};
  }
  if (!object.contains("id") || !object["id"].is_number_unsigned()) {
    return nonsense(line, "has no `id`, `set` or `get`");
  }
  const auto id = object["id"].get<std::uint64_t>();
  if (has_text(object, "answer")) return AnswerMessage{id, object["answer"]};
  if (value) return ValueMessage{id, *value};
  return nonsense(line, "has neither `answer` nor `value`");
}

}  // namespace btcheck
