// SPDX-License-Identifier: MIT
//
// JSON as it is written, to the letter.
#include "text/json.hpp"

#include <doctest/doctest.h>

#include <cstdint>
#include <string>
#include <vector>

namespace btcheck::json_test {
namespace {

TEST_CASE("members and elements keep their order") {
  const std::vector<std::string> names = {"b", "a"};
  Json json{{"z", 1}, {"a", {{"deep", true}}}, {"names", Json::array(names)}};
  json.add("none", Json::null()).add("empty", Json::array());
  CHECK(json.text() == R"({"z":1,"a":{"deep":true},"names":["b","a"],)"
                       R"("none":null,"empty":[]})");
  CHECK(json.indented(2) == R"({
  "z": 1,
  "a": {
    "deep": true
  },
  "names": [
    "b",
    "a"
  ],
  "none": null,
  "empty": []
})");
}

TEST_CASE("numbers are whole, of any size and sign") {
  CHECK(Json(-7).text() == "-7");
  CHECK(Json(INT64_MIN).text() == "-9223372036854775808");
  CHECK(Json(UINT64_MAX).text() == "18446744073709551615");
  CHECK(Json(std::uint8_t{7}).text() == "7");
}

TEST_CASE("what has a meaning in a string is escaped") {
  CHECK(Json("\"\\\b\f\n\r\t\x01\x7f{}[],:").text() ==
        R"("\"\\\b\f\n\r\t\u0001)"
        "\x7f{}[],:\"");
  CHECK(Json{{"a\"", "{}"}}.indented(1) == "{\n \"a\\\"\": \"{}\"\n}");
}

TEST_CASE("what is no UTF-8 is replaced, the beginning of one as a whole") {
  CHECK(valid_utf8("gehöft …") == "gehöft …");
  CHECK(valid_utf8("a\xff\xfe"
                   "b") == "a\ufffd\ufffdb");
  CHECK(valid_utf8("\xe2\x80") == "\ufffd");  // cut off
  CHECK(valid_utf8("\xf0\x9f\x98z") == "\ufffdz");
  CHECK(valid_utf8("\xe0\x80") == "\ufffd\ufffd");  // begins nothing
}

}  // namespace
}  // namespace btcheck::json_test
