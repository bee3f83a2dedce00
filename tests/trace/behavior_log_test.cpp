// SPDX-License-Identifier: MIT
//
// Logs of others are read as they are, and nothing in them is believed.
#include "trace/logs/behavior_log.hpp"

#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "trace/log_files.hpp"
#include "trace/recorded_run_maker.hpp"

namespace btcheck::behavior_log_test {
namespace {

std::string node_text(const BehaviorLog& log, std::uint16_t uid) {
  const LogNode* node = log.find(uid);
  REQUIRE(node != nullptr);
  return node->type + " " + node->name + " below " +
         (node->parent ? std::to_string(*node->parent) : "none") + ", " +
         std::to_string(node->depth);
}

// The only finding, without its help.
std::string finding(const Result<BehaviorLog>& result) {
  REQUIRE(result.diagnostics.size() == 1);
  const Diagnostic& only = result.diagnostics[0];
  CHECK(has_error(result.diagnostics) != result.value.has_value());
  return only.code + " " + only.message;
}

// A .btlog with this XML and these records.
std::string made(const std::string& xml, const std::string& records = {}) {
  std::string bytes(kBtlogMagic);
  bytes += '\x01';
  for (int byte = 0; byte < 4; ++byte) {
    bytes += static_cast<char>((xml.size() >> (8 * byte)) & 0xFF);
  }
  return bytes + xml + std::string(8, '\0') + records;
}

const std::string kSmallTree =
    "<root BTCPP_format=\"4\"><BehaviorTree ID=\"m\" _fullpath=\"\">"
    "<A name=\"a\" _uid=\"1\"/></BehaviorTree></root>";

TEST_CASE("the sample of BehaviorTree.CPP 4 is read as it was logged") {
  const auto log =
      read_log("sample.btlog", data_file("btcpp4.10_sample.btlog"));
  REQUIRE(log.value);
  CHECK(log.diagnostics.empty());
  CHECK(log.value->version == 4);
  CHECK(log.value->begin == 1795223155959319);
  REQUIRE(log.value->nodes.size() == 6);
  CHECK(node_text(*log.value, 1) == "Sequence Sequence below none, 0");
  CHECK(node_text(*log.value, 2) == "Act a below 1, 1");
  CHECK(node_text(*log.value, 3) == "SubTree Sub below 1, 1");
  CHECK(node_text(*log.value, 4) == "Fallback Fallback below 3, 2");
  CHECK(node_text(*log.value, 5) == "Sync s below 4, 3");
  CHECK(node_text(*log.value, 6) == "AlwaysSuccess AlwaysSuccess below 4, 3");
  constexpr auto kIdle = LogStatus::Idle;
  constexpr auto kRunning = LogStatus::Running;
  constexpr auto kSuccess = LogStatus::Success;
  constexpr auto kFailure = LogStatus::Failure;
  CHECK(log.value->transitions ==
        std::vector<LogTransition>{{61, 1, kIdle, kRunning},
                                   {70, 2, kIdle, kRunning},
                                   {30183, 2, kRunning, kSuccess},
                                   {30193, 3, kIdle, kRunning},
                                   {30196, 4, kIdle, kRunning},
                                   {30199, 5, kIdle, kFailure},
                                   {30202, 6, kIdle, kSuccess},
                                   {30203, 5, kFailure, kIdle},
                                   {30203, 6, kSuccess, kIdle},
                                   {30203, 4, kRunning, kSuccess},
                                   {30203, 4, kSuccess, kIdle},
                                   {30204, 3, kRunning, kSuccess},
                                   {30204, 2, kSuccess, kIdle},
                                   {30205, 3, kSuccess, kIdle},
                                   {30205, 1, kRunning, kSuccess},
                                   {30205, 1, kSuccess, kIdle}});
}

TEST_CASE("the sample is printed tick by tick") {
  const auto log =
      read_log("sample.btlog", data_file("btcpp4.10_sample.btlog"));
  REQUIRE(log.value);
  CHECK(
      log_text(*log.value) ==
      R"(BehaviorTree.CPP 4: 6 nodes, 16 changes, from 2026-11-21 01:05:55.959319 UTC

    1 Sequence
    2   a (Act)
    3   Sub (SubTree)
    4     Fallback
    5       s (Sync)
    6       AlwaysSuccess

after 0.000061 s
  [0.000061]     1 Sequence          IDLE -> RUNNING
  [0.000070]     2 a                 IDLE -> RUNNING

after 0.030183 s
  [0.030183]     2 a              RUNNING -> SUCCESS
  [0.030193]     3 Sub               IDLE -> RUNNING
  [0.030196]     4 Fallback          IDLE -> RUNNING
  [0.030199]     5 s                 IDLE -> FAILURE
  [0.030202]     6 AlwaysSuccess     IDLE -> SUCCESS
  [0.030203]     5 s              FAILURE -> IDLE
  [0.030203]     6 AlwaysSuccess  SUCCESS -> IDLE
  [0.030203]     4 Fallback       RUNNING -> SUCCESS
  [0.030203]     4 Fallback       SUCCESS -> IDLE
  [0.030204]     3 Sub            RUNNING -> SUCCESS
  [0.030204]     2 a              SUCCESS -> IDLE
  [0.030205]     3 Sub            SUCCESS -> IDLE
  [0.030205]     1 Sequence       RUNNING -> SUCCESS
  [0.030205]     1 Sequence       SUCCESS -> IDLE
)");
}

TEST_CASE("a log of our own is printed with its ticks") {
  const auto log = read_log("own.btlog", btlog_bytes(looping_run(), 1));
  REQUIRE(log.value);
  CHECK(log_text(*log.value) ==
        R"(BehaviorTree.CPP 4: 3 nodes, 8 changes, written by btcheck

    1 ReactiveFallback2 (ReactiveFallback)
    2   good? (good_)
    3   go "home" (go__home_)

tick 1
      1 ReactiveFallback2     IDLE -> RUNNING
      2 good?                 IDLE -> FAILURE
      3 go "home"             IDLE -> RUNNING
      2 good?              FAILURE -> IDLE

tick 2
      2 good?                 IDLE -> FAILURE
      2 good?              FAILURE -> IDLE

tick 3
      2 good?                 IDLE -> FAILURE
      2 good?              FAILURE -> IDLE
)");
}

TEST_CASE("a log of BehaviorTree.CPP 3 is read") {
  const auto log = read_log("trace.fbl", data_file("bt_trace1.fbl"));
  REQUIRE(log.value);
  CHECK(log.diagnostics.empty());
  CHECK(log.value->version == 3);
  CHECK(log.value->transitions.size() == 102);
  CHECK(log.value->begin == 1677591001650384);
  CHECK(log.value->nodes.size() == 12);
  CHECK(node_text(*log.value, 25) ==
        "PipelineSequence NavigateWithReplanning below none, 0");
  CHECK(node_text(*log.value, 28) ==
        "ComputePathToPose ComputePathToPose below 27, 3");
  CHECK(node_text(*log.value, 36) ==
        "ClearEntireCostmap ClearLocalCostmap-Context below 34, 3");
  const auto& changes = log.value->transitions;
  CHECK(changes[0] ==
        LogTransition{0, 26, LogStatus::Idle, LogStatus::Running});
  CHECK(changes[4] ==
        LogTransition{20138, 28, LogStatus::Running, LogStatus::Success});
  CHECK(changes[9] ==
        LogTransition{30078, 26, LogStatus::Success, LogStatus::Running});
  CHECK(changes[101] ==
        LogTransition{15744571, 25, LogStatus::Running, LogStatus::Idle});
  const std::string text = log_text(*log.value);
  CHECK(
      text.starts_with("BehaviorTree.CPP 3: 12 nodes, 102 changes, from "
                       "2023-02-28 13:30:01.650384 UTC\n"));
  CHECK(text.find("\nafter 0.030078 s\n  [0.030078]    26 RateController "
                  "                    SUCCESS -> RUNNING\n") !=
        std::string::npos);
}

TEST_CASE("the reader is chosen by the first bytes, then by the name") {
  const std::string btlog = data_file("btcpp4.10_sample.btlog");
  const std::string fbl = data_file("bt_trace1.fbl");
  CHECK(read_log("a.btlog", btlog).value);
  CHECK(read_log("a.fbl", btlog).value);
  CHECK(read_log("a", btlog).value);
  CHECK(read_log("a.fbl", fbl).value);
  CHECK(finding(read_log("a.btlog", fbl)) ==
        "BT1302 this is no log of BehaviorTree.CPP 4");
}

TEST_CASE("what is no log of a known version is said to be none") {
  CHECK(finding(read_log("a", "")) == "BT1302 the file is empty");
  CHECK(finding(read_log("a", "<root/>")) ==
        "BT1302 this is no log of BehaviorTree.CPP 4");
  std::string other = data_file("btcpp4.10_sample.btlog");
  other[18] = 2;
  CHECK(finding(read_log("a", other)) ==
        "BT1302 the log's format has version 2; version 1 is known");
  CHECK(!read_log("a", other).diagnostics[0].help.empty());
  CHECK(read_log("a", other).diagnostics[0].file == "a");
}

TEST_CASE("a log is read wherever it is cut off, or refused") {
  for (const char* name : {"btcpp4.10_sample.btlog", "bt_trace1.fbl"}) {
    const std::string whole = data_file(name);
    const auto all = read_log(name, whole);
    REQUIRE(all.value);
    const bool is_btlog = std::string(name).ends_with(".btlog");
    const std::size_t size = is_btlog ? 9 : 12;
    const std::size_t count = all.value->transitions.size();
    const std::size_t heading = whole.size() - count * size;
    for (std::size_t length = 0; length < whole.size(); ++length) {
      CAPTURE(length);
      const auto log = read_log(name, whole.substr(0, length));
      REQUIRE(log.value.has_value() == (length >= heading));
      if (length < heading) {
        REQUIRE(log.diagnostics.size() == 1);
        REQUIRE(log.diagnostics[0].severity == Severity::Error);
        continue;
      }
      const std::size_t records = (length - heading) / size;
      REQUIRE(log.value->transitions.size() == records);
      const bool is_whole = (length - heading) % size == 0;
      REQUIRE(log.diagnostics.empty() == is_whole);
      if (!is_whole) REQUIRE(finding(log).starts_with("BT1304 "));
    }
  }
}

TEST_CASE("a log with any byte changed is read or refused") {
  for (const char* name : {"btcpp4.10_sample.btlog", "bt_trace1.fbl"}) {
    std::string bytes = data_file(name);
    for (std::size_t at = 0; at < bytes.size(); ++at) {
      const char before = bytes[at];
      for (const int value : {0, 0x7F, 0xFF}) {
        bytes[at] = static_cast<char>(value);
        const auto log = read_log(name, bytes);
        REQUIRE(log.value.has_value() != has_error(log.diagnostics));
        if (log.value && at % 16 == 0) REQUIRE(!log_text(*log.value).empty());
      }
      bytes[at] = before;
    }
  }
}

TEST_CASE("damage is named by its place") {
  const std::string record("\0\0\0\0\0\0\1\0\1", 9);
  CHECK(read_log("a", made(kSmallTree, record)).diagnostics.empty());
  std::string other = record;
  other[6] = 7;
  CHECK(finding(read_log("a", made(kSmallTree, record + other))) ==
        "BT1303 the log is damaged: record 2 (byte " +
            std::to_string(made(kSmallTree).size() + 9) +
            ") is about node 7, which the tree does not have");
  other = record;
  other[8] = 5;
  CHECK(finding(read_log("a", made(kSmallTree, other))) ==
        "BT1303 the log is damaged: record 1 (byte " +
            std::to_string(made(kSmallTree).size()) + ") has the status 5");
  CHECK(finding(read_log("a", made(kSmallTree, record.substr(0, 4)))) ==
        "BT1304 the last record is cut off: 4 of 9 bytes are there");
  const std::string heading = made(kSmallTree);
  CHECK(finding(read_log("a", heading.substr(0, 20))) ==
        "BT1303 the log is damaged: its heading is cut off");
  CHECK(finding(read_log("a", heading.substr(0, 30))) ==
        "BT1303 the log is damaged: its XML should have " +
            std::to_string(kSmallTree.size()) + " bytes, 7 are there");
  CHECK(finding(read_log("a", heading.substr(0, heading.size() - 1))) ==
        "BT1303 the log is damaged: the time of its beginning is cut off");
}

TEST_CASE("an XML that holds no trees is refused") {
  const auto refused = [](const std::string& inside) {
    const std::string message =
        finding(read_log("a", made("<root>\n<BehaviorTree _fullpath=\"\">" +
                                   inside + "</BehaviorTree></root>")));
    const std::string start = "BT1303 the log is damaged: in its XML, ";
    CHECK(message.starts_with(start));
    return message.substr(start.size());
  };
  CHECK(refused("") == "there is no node with a _uid");
  CHECK(refused("<A/>") == "line 2: <A> has no _uid");
  CHECK(refused("<A _uid=\"-1\"/>") == "line 2: <A> has no _uid");
  CHECK(refused("<A _uid=\"65536\"/>") == "line 2: <A> has no _uid");
  CHECK(refused("<A _uid=\"1\">\n<B _uid=\"2\"/>") ==
        "line 2: a tag is not closed, or closed by another name");
  CHECK(refused("<A _uid=\"1\"/></B>") ==
        "line 2: a tag is not closed, or closed by another name");
  CHECK(refused("<A _uid=\"1\"/><B _uid=\"1\"/>") ==
        "two nodes have the uid 1");
  CHECK(refused("<A _uid=\"1\" b/>") ==
        "line 2: an attribute has no value, no quotes, or is given twice");
  CHECK(refused("<A _uid=\"1\"/><") == "line 2: this is not XML");
  CHECK(refused("<A _uid=\"1\"/><!-- ") == "line 2: a comment has no end");
  CHECK(refused("<SubTree _uid=\"1\" _fullpath=\"\"/></BehaviorTree>"
                "<BehaviorTree _fullpath=\"\"><SubTree _uid=\"2\" "
                "_fullpath=\"\"/>") == "line 2: two SubTrees have the path ``");
  CHECK(refused("</BehaviorTree><BehaviorTree _fullpath=\"p\"><SubTree "
                "_uid=\"1\" _fullpath=\"q\"/></BehaviorTree><BehaviorTree "
                "_fullpath=\"q\"><SubTree _uid=\"2\" _fullpath=\"p\"/>"
                "</BehaviorTree><BehaviorTree _fullpath=\"p\"><SubTree "
                "_uid=\"3\" _fullpath=\"r\"/></BehaviorTree><BehaviorTree "
                "_fullpath=\"r\"><A _uid=\"3\"/>") ==
        "two nodes have the uid 3");
  CHECK(finding(read_log("a", made("<root>")))
            .ends_with("in its XML, line 1: a tag is not closed, or closed by "
                       "another name"));
  CHECK(finding(read_log("a", made("")))
            .ends_with("in its XML, nothing stands in the file"));
}

TEST_CASE("tags may stand only so deep in one another") {
  std::string tags = "<BehaviorTree>";
  for (int i = 0; i < 1000; ++i) tags += "<A _uid=\"1\">";
  CHECK(finding(read_log("a", made("<root>" + tags)))
            .ends_with(" tags in one another"));
}

TEST_CASE("a log may have all its nodes in one line, tens of thousands") {
  std::string nodes;
  for (int i = 1; i <= 30'000; ++i) {
    nodes += "<A name=\"ä\" _uid=\"" + std::to_string(i) + "\"/>";
  }
  const auto log = read_log(
      "a", made("<root><BehaviorTree>" + nodes + "</BehaviorTree></root>"));
  REQUIRE(log.value);
  CHECK(log.value->nodes.size() == 30'000);
}

TEST_CASE("a subtree cannot contain itself") {
  const auto log = read_log(
      "a", made("<root><BehaviorTree _fullpath=\"x\"><A _uid=\"1\"/>"
                "</BehaviorTree><BehaviorTree _fullpath=\"p\"><SubTree "
                "_uid=\"2\" _fullpath=\"q\"/><SubTree _uid=\"4\" "
                "_fullpath=\"p\"/></BehaviorTree><BehaviorTree "
                "_fullpath=\"p\"><B _uid=\"3\"/></BehaviorTree></root>"));
  CHECK(log.value);  // 3 is below 4, and 4 is a root
  const auto itself = read_log(
      "a", made("<root><BehaviorTree _fullpath=\"x\"><SubTree _uid=\"1\" "
                "_fullpath=\"p\"/></BehaviorTree><BehaviorTree "
                "_fullpath=\"p\"><SubTree _uid=\"1\" _fullpath=\"q\"/>"
                "</BehaviorTree></root>"));
  CHECK(finding(itself).ends_with("two nodes have the uid 1"));
}

TEST_CASE("names come out of their entities, and are harmless when printed") {
  const auto log = read_log(
      "a", made("<?xml version='1.0'?><!DOCTYPE a><root><!-- <A> --><a/>"
                "<BehaviorTree _fullpath=''>text<![CDATA[<B>]]>"
                "<Action ID='Fly' name='a&lt;b&#x20AC;&#65;&amp;\x1b"
                "[2J\n' _uid = '1' /></BehaviorTree></root>"));
  REQUIRE(log.value);
  CHECK(log.value->nodes[0].type == "Fly");
  CHECK(log.value->nodes[0].name == "a<b€A&\x1b[2J\\u{a}");
  const std::string text = log_text(*log.value);
  CHECK(text.find('\x1b') == std::string::npos);
  CHECK(text.find("    1 a<b€A&?[2J\\u{a} (Fly)\n") != std::string::npos);
}

}  // namespace
}  // namespace btcheck::behavior_log_test
