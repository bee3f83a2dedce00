// SPDX-License-Identifier: MIT
#include "groot2/wire.hpp"

#include <doctest/doctest.h>

#include <string>

#include "groot2/entries.hpp"
#include "groot2/faults.hpp"

namespace btcheck::groot2::wire_test {
namespace {

using namespace std::string_literals;

constexpr std::uint32_t kNumber = 0x01020304;

std::string reply_head(char kind = 'T') {
  return "\x02"s + kind + "\x04\x03\x02\x01"s + "0123456789abcdef";
}

std::string change(const std::string& time, char uid, char status) {
  return time + uid + '\0' + status;
}

std::string flaw_of(const std::string& address) {
  const ReadAddress read = address_in(address);
  CHECK(!read.address);
  return read.flaw;
}

}  // namespace

TEST_CASE("addresses of robots") {
  CHECK(address_in("groot2://robot").address == Address{"robot", 1667});
  CHECK(address_in("groot2://10.0.0.7:1700/").address ==
        Address{"10.0.0.7", 1700});
  CHECK(address_in("groot2://[fe80::1%eth0]:1668").address ==
        Address{"[fe80::1%eth0]", 1668});
  CHECK(flaw_of("robot:1667") ==
        "an address of a robot begins with `groot2://`");
  CHECK(flaw_of("groot2://") == "it names no machine");
  CHECK(flaw_of("groot2://a b") == "it names no machine");
  CHECK(flaw_of("groot2://a;b") == "it names no machine");
  CHECK(flaw_of("groot2://[::1") == "there is no `]`");
  CHECK(flaw_of("groot2://a:") == "`` is no port");
  CHECK(flaw_of("groot2://a:0") == "`0` is no port");
  CHECK(flaw_of("groot2://a:65535") == "`65535` is no port");
  CHECK(flaw_of("groot2://a:1667x") == "`1667x` is no port");
}

TEST_CASE("a request is six bytes") {
  CHECK(request_head(Request::Changes, kNumber) == "\x02t\x04\x03\x02\x01");
}

TEST_CASE("replies") {
  const auto read = [](const Parts& parts) {
    return reply_in(parts, Request::Tree, kNumber);
  };
  const Reply good = read({reply_head(), "<root/>"});
  CHECK(good.kind == Reply::Kind::Good);
  CHECK(good.text == "<root/>");
  CHECK(std::string(good.tree.begin(), good.tree.end()) == "0123456789abcdef");
  CHECK(read({reply_head()}).text.empty());
  const Reply refused = read({"error", "no\nsuch\x01thing"});
  CHECK(refused.kind == Reply::Kind::Refused);
  CHECK(refused.text.find('\n') == std::string::npos);
  for (const Parts& parts :
       {Parts{}, Parts{""}, Parts{"error"}, Parts{"error", "a", "b"},
        Parts{reply_head().substr(1)}, Parts{reply_head() + "x"},
        Parts{reply_head('S'), ""}, Parts{"\x03" + reply_head().substr(1)},
        Parts{"\x02T\x05\x03\x02\x01" + std::string(16, 'x'), ""},
        Parts{reply_head(), "", ""}}) {
    const Reply foreign = read(parts);
    CHECK(foreign.kind == Reply::Kind::Foreign);
    CHECK(!foreign.text.empty());
  }
}

TEST_CASE("statuses, and what they were before") {
  const StatusesRead read =
      statuses_in("\x01\x00\x01\x02\x00\x0C\x03\x01\x04"s);
  REQUIRE(read.flaw.empty());
  REQUIRE(read.statuses.size() == 3);
  CHECK(read.statuses[0].status == LogStatus::Running);
  CHECK(read.statuses[1].status == LogStatus::Idle);  // after SUCCESS
  CHECK(read.statuses[2].uid == 259);
  CHECK(read.statuses[2].status == LogStatus::Skipped);
  CHECK(statuses_in("").flaw.empty());
  CHECK(!statuses_in("\x01\x00"s).flaw.empty());
  for (const char status : {'\x05', '\x09', '\x0F', '\x14', '\x7F', '\xFF'}) {
    CHECK(!statuses_in("\x01\x00"s + status).flaw.empty());
  }
}

TEST_CASE("changes") {
  const ChangesRead read = changes_in(change("\x10\x27\0\0\0\0"s, 2, 1) +
                                      change("\xFF\xFF\xFF\xFF\xFF\xFF", 3, 0));
  REQUIRE(read.flaw.empty());
  REQUIRE(read.changes.size() == 2);
  CHECK(read.changes[0].time == 10'000);
  CHECK(read.changes[0].uid == 2);
  CHECK(read.changes[0].after == LogStatus::Running);
  CHECK(read.changes[1].time == 0);  // just before the recording began
  CHECK(!changes_in("12345678").flaw.empty());
  CHECK(!changes_in(change("\0\0\0\0\0\0"s, 2, 5)).flaw.empty());
  CHECK(!changes_in(std::string(9 * (kMostKept + 1), '\0')).flaw.empty());
  CHECK(changes_in(std::string(9 * kMostKept, '\0')).flaw.empty());
}

TEST_CASE("hooks as JSON") {
  CHECK(insert_text({7, false, true, LogStatus::Failure}) ==
        R"({"enabled":true,"uid":7,"mode":1,"once":true,)"
        R"("desired_status":"FAILURE","position":0})");
  CHECK(insert_text({7, true, false, LogStatus::Failure}) ==
        R"({"enabled":true,"uid":7,"mode":0,"once":false,)"
        R"("desired_status":"SKIPPED","position":0})");
  CHECK(remove_text(7) == R"({"uid":7,"position":0})");
  CHECK(unlock_text(7) == R"({"uid":7,"position":0,)"
                          R"("desired_status":"SKIPPED",)"
                          R"("remove_when_done":false})");
  CHECK(reached_in({"\x02N\0\0\0\0"s, "12"}) == 12);
  CHECK(!reached_in({"\x02N\0\0\0\0"s, "70000"}));
  CHECK(!reached_in({"\x02N\0\0\0\0"s}));
  CHECK(!reached_in({"\x02S\0\0\0\0"s, "12"}));
}

TEST_CASE("entries from MessagePack") {
  // {"Main": {"b": 76, "f": 0.5, "i": -3, "n": nil, "p": {"x": 1, "l": [true,
  // "q"]}, "s": "at \"dock\""}, "arm::4": {}}
  const EntriesRead read = entries_in(
      "\x82\xA4Main\x86\xA1"
      "b\x4C\xA1"
      "f\xCB\x3F\xE0\0\0\0\0\0\0\xA1"
      "i\xFD\xA1n\xC0\xA1p\x82\xA1x\x01\xA1l\x92\xC3\xA1q\xA1s\xA9"
      "at \"dock\""
      "\xA6"
      "arm::4\x80"s);
  CHECK(read.flaw.empty());
  REQUIRE(read.boards.size() == 2);
  const auto& main = read.boards.at("Main");
  CHECK(main.at("b") == "76");
  CHECK(main.at("f") == "0.5");
  CHECK(main.at("i") == "-3");
  CHECK(main.at("n") == "null");
  CHECK(main.at("p") == R"({"x":1,"l":[true,"q"]})");
  CHECK(main.at("s") == "at \"dock\"");
  CHECK(entries_in("\xC0"s).flaw.empty());
}

TEST_CASE("every kind of number") {
  const auto value = [](const std::string& packed) {
    const EntriesRead read = entries_in("\x81\xA1m\x81\xA1v"s + packed);
    REQUIRE(read.flaw.empty());
    return read.boards.at("m").at("v");
  };
  CHECK(value("\xCC\xFF"s) == "255");
  CHECK(value("\xCD\x01\x00"s) == "256");
  CHECK(value("\xCE\0\1\0\0"s) == "65536");
  CHECK(value("\xCF\xFF\xFF\xFF\xFF\xFF\xFF\xFF\xFF"s) ==
        "18446744073709551615");
  CHECK(value("\xD0\x80"s) == "-128");
  CHECK(value("\xD1\x80\x00"s) == "-32768");
  CHECK(value("\xD2\x80\0\0\0"s) == "-2147483648");
  CHECK(value("\xD3\x80\0\0\0\0\0\0\0"s) == "-9223372036854775808");
  CHECK(value("\xCA\x40\x20\0\0"s) == "2.5");
  CHECK(value("\xC4\x03"
              "abc"s) == "(3 bytes)");
  CHECK(value("\xD4\x01x"s) == "(1 bytes)");
  CHECK(value("\xC7\x02\x01xy"s) == "(2 bytes)");
  CHECK(value("\xDC\0\2\1\2"s) == "[1,2]");
}

TEST_CASE("MessagePack that is made to harm") {
  CHECK(!entries_in("").flaw.empty());
  CHECK(!entries_in("\x93\1\2\3"s).flaw.empty());  // no map
  CHECK(!entries_in("\xDF\xFF\xFF\xFF\xFF"s).flaw.empty());
  CHECK(!entries_in("\x81\xA1m\x81\xA1v\xDD\xFF\xFF\xFF\xFF"s).flaw.empty());
  CHECK(!entries_in("\x81\xA1m\x81\xA1v\xDB\xFF\xFF\xFF\xFFx"s).flaw.empty());
  CHECK(!entries_in("\x81\xA1m\x81\xA1v\xC1"s).flaw.empty());
  CHECK(!entries_in("\x80\x80"s).flaw.empty());  // more behind its end
  CHECK(!entries_in("\x81\xA1m\x81\xA1v"s + std::string(1'000'000, '\x91') +
                    "\xC0")
             .flaw.empty());
  // Half a million numbers: the text is cut, and names are shown as one line.
  std::string many = "\x81\xA1m\x81\xA3\xFF\n\x01"s;
  many += "\xDD\x00\x07\xA1\x20"s;
  many += std::string(500'000, '\x07');
  const EntriesRead cut = entries_in(many);
  REQUIRE(cut.flaw.empty());
  const auto& [name, text] = *cut.boards.at("m").begin();
  CHECK(name.find('\n') == std::string::npos);
  CHECK(text.size() < 300);
  // Every beginning of a good message is a flaw, and no crash.
  const std::string good =
      "\x81\xA1m\x82\xA1v\x92\xC3\xA1q\xA1w\xCB\1\2\3\4\5\6\7\x08"s;
  CHECK(entries_in(good).flaw.empty());
  for (std::size_t n = 0; n < good.size(); ++n) {
    CHECK(!entries_in(good.substr(0, n)).flaw.empty());
  }
}

TEST_CASE("faults as they are written") {
  const auto fault = [](const std::string& text) {
    const ReadFault read = fault_in(text);
    REQUIRE(read.fault);
    return *read.fault;
  };
  CHECK(fault("dock fails").node == "dock");
  CHECK(fault("dock fails").answer == LogStatus::Failure);
  CHECK(fault("dock fails").is_once);
  CHECK(fault("dock fails").from_tick == 1);
  CHECK(fault("mission/dock succeeds always").answer == LogStatus::Success);
  CHECK(!fault("mission/dock succeeds always").is_once);
  CHECK(fault("\"Dock the robot\"  fails once from tick 12").node ==
        "Dock the robot");
  CHECK(fault("dock fails from tick 12").from_tick == 12);
  for (const char* text :
       {"", "dock", "fails", "dock breaks", "dock fails twice", "a b fails",
        "\"\" fails", "dock fails from tick 0", "dock fails from tick x",
        "dock fails from tick", "dock fails always once"}) {
    CAPTURE(text);
    CHECK(!fault_in(text).fault);
    CHECK(!fault_in(text).flaw.empty());
  }
  CHECK(break_in("dock from tick 3").fault->from_tick == 3);
  CHECK(break_in("dock").fault->is_break);
  CHECK(!break_in("dock fails").fault);
}

}  // namespace btcheck::groot2::wire_test
