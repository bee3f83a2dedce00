// SPDX-License-Identifier: MIT
//
// Recordings of Nav2's log, by ROS 2: read as they were told, and nothing in
// them is believed.
#include "trace/logs/ros_log.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "check/check.hpp"
#include "model/lowering.hpp"
#include "model/tree_file.hpp"
#include "trace/conform/conform.hpp"
#include "trace/conform/start.hpp"
#include "trace/formats/recordings.hpp"
#include "trace/log_files.hpp"
#include "trace/logs/ros_recording.hpp"
#include "trace/oracle/oracle.hpp"
#include "trace/recorded_run_maker.hpp"
#include "trace/ros_recordings.hpp"
#include "trace/run/record.hpp"
#include "trace/watch/watched_run.hpp"

namespace btcheck::ros_log_test {
namespace {

// A log that BehaviorTree.CPP has written, and what ROS would have recorded.
BehaviorLog sample() {
  return *read_log("sample.btlog", data_file("btcpp4.10_sample.btlog")).value;
}

std::string finding(const Result<BehaviorLog>& result) {
  REQUIRE(result.diagnostics.size() == 1);
  return result.diagnostics[0].code + " " + result.diagnostics[0].message;
}

// The tree of a log, and what a log of it is held against.
struct Model {
  explicit Model(const std::string& xml, const std::string& main = "")
      : input("t.xml", xml) {
    input.reading.main_tree = main;
    auto read = read_tree(input.name, input.text, input.reading);
    REQUIRE(read.value);
    tree = std::move(*read.value);
    run = recorded_tree(tree, input);
  }

  Result<BehaviorLog> with_places(const BehaviorLog& log) const {
    return placed(log, tree, run);
  }

  TreeInput input;
  BehaviorTree tree;
  RecordedRun run;
};

const std::string kTwins = R"(<root BTCPP_format="4"><BehaviorTree ID="m">
<Sequence name="top"><Action ID="Go" name="go"/><Action ID="Wait"/>
<Action ID="Wait"/></Sequence></BehaviorTree></root>)";

// go runs and succeeds, the first Wait fails.
BehaviorLog twins() {
  BehaviorLog log;
  log.begin = 1'700'000'000'000'000;
  log.nodes = {{1, "top", "Sequence", {}, 0},
               {2, "go", "Go", 1, 1},
               {3, "Wait", "Wait", 1, 1},
               {4, "Wait", "Wait", 1, 1}};
  const LogStatus idle = LogStatus::Idle;
  const LogStatus running = LogStatus::Running;
  log.transitions = {{0, 1, idle, running},
                     {10, 2, idle, running},
                     {100'000, 2, running, LogStatus::Success},
                     {100'010, 3, idle, LogStatus::Failure},
                     {100'020, 2, LogStatus::Success, idle},
                     {100'030, 3, LogStatus::Failure, idle},
                     {100'040, 1, running, LogStatus::Failure}};
  return log;
}

Conformance conformed(const Model& model, const BehaviorLog& log) {
  const Network network = lower(model.tree, TickSemantics::Root);
  const CompiledNetwork system(network);
  const auto nodes = LoggedNodes::match(log, model.tree, model.run);
  REQUIRE(nodes.value);
  return conform(model.tree, system, log, *nodes.value, {});
}

}  // namespace

TEST_CASE("a recording tells what the log that it was made of tells") {
  const BehaviorLog log = sample();
  const Model model(log.xml, log.tree);
  for (const RosForm form : {RosForm{true, false}, RosForm{false, false},
                             RosForm{true, true}, RosForm{false, true}}) {
    const RosTopic topic = topic_of(log, form);
    const std::vector<std::pair<std::string, std::string>> files = {
        {"a.mcap", mcap_of({topic})},
        {"a.mcap", mcap_of({topic}, Chunks::Plain)},
        {"a", mcap_of({topic}, Chunks::Zstd)},
        {"a", mcap_of({topic}, Chunks::Lz4)},
        {"a.db3", database_of({topic})},
        {"a", database_of({topic})}};
    for (const auto& [name, bytes] : files) {
      REQUIRE(is_log(name, bytes));
      const auto read = read_log(name, bytes);
      REQUIRE_MESSAGE(read.value, finding(read));
      CHECK(read.diagnostics.empty());
      CHECK(read.value->topic == "/behavior_tree_log");
      CHECK(!read.value->has_places());
      CHECK(read.value->has_uids == form.has_uids);
      const auto found = model.with_places(*read.value);
      REQUIRE(found.value);
      CHECK(found.diagnostics.empty());
      // ROS tells no beginning but that of the first change.
      BehaviorLog expected = log;
      expected.begin += log.transitions.front().time;
      for (LogTransition& record : expected.transitions) {
        record.time -= log.transitions.front().time;
      }
      CHECK(found.value->begin == expected.begin);
      CHECK(found.value->transitions == expected.transitions);
      REQUIRE(found.value->nodes.size() == log.nodes.size());
      for (std::size_t i = 0; i < log.nodes.size(); ++i) {
        CHECK(found.value->nodes[i].name == log.nodes[i].name);
        CHECK(found.value->nodes[i].parent == log.nodes[i].parent);
        CHECK(found.value->nodes[i].depth == log.nodes[i].depth);
      }
      CHECK(conformed(model, *found.value).conforms());
    }
  }
}

TEST_CASE("messages are read in the order in which they were recorded") {
  RosTopic topic = topic_of(twins());
  std::ranges::reverse(topic.messages);
  for (const std::string& bytes : {mcap_of({topic}), database_of({topic})}) {
    const auto log = read_log("a", bytes);
    REQUIRE(log.value);
    CHECK(log.value->transitions == twins().transitions);
  }
}

TEST_CASE("messages that rosbag2 has packed one by one are unpacked") {
  RosTopic topic = topic_of(twins());
  for (auto& [time, bytes] : topic.messages) bytes = zstd_packed(bytes);
  const auto log = read_log("a.db3", database_of({topic}));
  REQUIRE(log.value);
  CHECK(log.value->transitions == twins().transitions);
}

TEST_CASE("a log is printed with the topic it comes from") {
  const auto log = read_log("a.mcap", mcap_of({topic_of(twins())}));
  const std::string text = log_text(*log.value);
  CHECK(text.starts_with("ROS 2, /behavior_tree_log: 3 nodes, 7 changes"));
  CHECK(text.find("go       IDLE -> RUNNING") != std::string::npos);
}

TEST_CASE("uids tell nodes of one name apart, and names do not") {
  const Model model(kTwins);
  const auto with = model.with_places(
      *read_log("a.mcap", mcap_of({topic_of(twins())})).value);
  REQUIRE(with.value);
  CHECK(with.diagnostics.empty());
  CHECK(with.value->transitions == twins().transitions);

  const auto without = model.with_places(
      *read_log("a.mcap", mcap_of({topic_of(twins(), {false, false})})).value);
  REQUIRE(without.value);
  CHECK(finding(without) ==
        "BT1812 several nodes of the tree have the same name: records of "
        "`Wait` are left out");
  CHECK(without.value->transitions.size() == 5);
  CHECK(without.value->nodes[2].is_silent);
  CHECK(without.value->nodes[3].is_silent);
  CHECK(!without.value->nodes[1].is_silent);
  CHECK(conformed(model, *without.value).conforms());
}

TEST_CASE("a rule about a node that was not told apart stays open") {
  const Model model(kTwins);
  const std::string text =
      "property known: never go.success\n"
      "property not_known: never Wait@3.failure\n"
      "property root_known: never root.failure\n";
  const auto rules = read_properties("r.ltl", text);
  REQUIRE(rules.value);
  const SourceText source("r.ltl", text);
  const auto outlooks = [&](RosForm form) {
    const auto log = model.with_places(
        *read_log("a.mcap", mcap_of({topic_of(twins(), form)})).value);
    const auto report = watch_log_as(model.run, "a.mcap", *log.value,
                                     {.tick_gap = 5'000}, *rules.value, source);
    REQUIRE(report.value);
    std::vector<Outlook> found;
    for (const auto& rule : report.value->rules) found.push_back(rule.outlook);
    return found;
  };
  // Nodes of one name are told apart by their lines.
  CHECK(outlooks({true, false}) ==
        std::vector{Outlook::Violated, Outlook::Open, Outlook::Violated});
  CHECK(outlooks({false, false}) ==
        std::vector{Outlook::Violated, Outlook::Open, Outlook::Violated});
}

TEST_CASE("a recording of another tree names the node that is not there") {
  const Model model(
      "<root BTCPP_format=\"4\"><BehaviorTree ID=\"m\"><Action ID=\"Go\"/>"
      "</BehaviorTree></root>");
  const auto log =
      *read_log("a.mcap", mcap_of({topic_of(twins(), {false, false})})).value;
  CHECK(finding(model.with_places(log)) ==
        "BT1806 the log is of another tree: t.xml has no node `top`");
}

TEST_CASE("of several topics one has to be named") {
  RosTopic other = topic_of(twins());
  other.name = "/robot2/behavior_tree_log";
  RosTopic image{"/image", "sensor_msgs/msg/Image", "cdr", {{1, "pixels"}}};
  const std::vector<RosTopic> one = {image, topic_of(twins())};
  const std::vector<RosTopic> two = {image, topic_of(sample()), other};
  for (const bool is_database : {false, true}) {
    const auto read = [&](const std::vector<RosTopic>& topics,
                          std::string_view topic) {
      return read_log("a", is_database ? database_of(topics) : mcap_of(topics),
                      topic);
    };
    CHECK(read(one, "").value);
    CHECK(read(one, "/behavior_tree_log").value);
    CHECK(finding(read(one, "/image")) ==
          "BT1811 the recording has no topic `/image` that logs a tree, but "
          "`/behavior_tree_log`");
    CHECK(finding(read(two, "")) ==
          "BT1811 the recording has several topics that log a tree: "
          "`/behavior_tree_log`, `/robot2/behavior_tree_log`");
    const auto chosen = read(two, "/robot2/behavior_tree_log");
    REQUIRE(chosen.value);
    CHECK(chosen.value->transitions == twins().transitions);
    CHECK(finding(read({image}, "")) ==
          "BT1302 the recording has no topic of the type "
          "nav2_msgs/msg/BehaviorTreeLog");
    RosTopic silent;
    CHECK(finding(read({silent}, "")) ==
          "BT1302 nothing was recorded of the topic `/behavior_tree_log`");
    RosTopic json = topic_of(twins());
    json.encoding = "json";
    CHECK(finding(read({json}, "")) ==
          "BT1302 the messages of `/behavior_tree_log` are encoded as `json`; "
          "cdr is read");
  }
}

TEST_CASE("what is no recording, or another one, is refused by name") {
  CHECK(finding(read_log("a.mcap", "")) == "BT1302 the file is empty");
  CHECK(finding(read_log("a.mcap", "PK")) == "BT1302 this is no MCAP file");
  CHECK(finding(read_log("a.db3", "")) == "BT1302 the file is empty");
  CHECK(finding(read_log("a.db3", "PK")) ==
        "BT1302 this is no SQLite database");
  CHECK(finding(read_log("a.db3", database_of({}, "CREATE TABLE t(x)"))) ==
        "BT1302 this database is no recording of rosbag2: no such table: "
        "topics");
  CHECK(finding(read_log("own.mcap", mcap_bytes(looping_run(), 1))) ==
        "BT1302 btcheck has written this recording: it has phases to look at "
        "and no log of the tree");
}

TEST_CASE("views of a stranger's database are not executed") {
  const std::string endless =
      "CREATE VIEW topics AS WITH RECURSIVE n(i) AS (SELECT 1 UNION ALL SELECT "
      "i + 1 FROM n) SELECT i AS id, 'a' AS name, 'b' AS type, 'cdr' AS "
      "serialization_format FROM n;"
      "CREATE TABLE messages(id, topic_id, timestamp, data)";
  const auto log = read_log("a.db3", database_of({}, endless));
  CHECK(!log.value);
  CHECK(finding(log).starts_with("BT13"));
}

const std::string kPlainTopics =
    "CREATE TABLE topics(id INTEGER PRIMARY KEY, name, type, "
    "serialization_format, qos);";
const std::string kPlainMessages =
    "CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id, timestamp, data);";

TEST_CASE("what a database computes when it is read is refused by name") {
  const auto refusal = [](const std::string& tables) {
    const auto log = read_log("a.db3", database_of({}, tables));
    CHECK(!log.value);
    const std::string found = finding(log);
    const std::string begin =
        "BT1302 this database is no recording of "
        "rosbag2: ";
    REQUIRE_MESSAGE(found.starts_with(begin), found);
    return found.substr(begin.size());
  };
  for (const std::string kind : {"VIRTUAL", "STORED"}) {
    CHECK(refusal(kPlainTopics +
                  "CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id, "
                  "timestamp, data GENERATED ALWAYS AS (hex(zeroblob(id))) " +
                  kind + ");") ==
          "the column `data` of `messages` is generated, and only plain "
          "tables are read");
    CHECK(refusal("CREATE TABLE topics(id, name, type, serialization_format "
                  "AS ('a' LIKE name) " +
                  kind + ");" + kPlainMessages) ==
          "the column `serialization_format` of `topics` is generated, and "
          "only plain tables are read");
  }
  CHECK(refusal(kPlainTopics +
                "CREATE VIEW messages AS SELECT id, id AS topic_id, id AS "
                "timestamp, name AS data FROM topics;") ==
        "`messages` is a view, and only plain tables are read");
  CHECK(refusal("CREATE VIRTUAL TABLE topics USING fts4(id, name, type, "
                "serialization_format);" +
                kPlainMessages) ==
        "`topics` is a virtual table, and only plain tables are read");
  CHECK(refusal(kPlainTopics + "CREATE TABLE messages(id, topic_id);") ==
        "`messages` has no column `timestamp`");
  // To ask a view of views for its columns takes for ever.
  std::string views = kPlainTopics +
                      "CREATE VIEW v0 AS SELECT id AS topic_id, id AS "
                      "timestamp, id, name AS data FROM topics;";
  for (int i = 1; i < 60; ++i) {
    views += fmt::format(
        "CREATE VIEW v{0} AS SELECT a.* FROM v{1} AS a, v{1} AS b;", i, i - 1);
  }
  CHECK(refusal(views + "CREATE VIEW messages AS SELECT * FROM v59;") ==
        "`messages` is a view, and only plain tables are read");
}

TEST_CASE("what a database says of its tables is not believed") {
  const auto forged = [](const std::string& word, const std::string& by) {
    std::string bytes = database_of({topic_of(twins())});
    const auto at = bytes.find(word);
    REQUIRE(at != bytes.npos);
    REQUIRE(word.size() == by.size());
    return bytes.replace(at, word.size(), by);
  };
  CHECK(read_log("a.db3", database_of({topic_of(twins())})).value);
  for (const auto& [word, by] :
       std::vector<std::pair<std::string, std::string>>{
           {"data BLOB NOT NULL", "data AS(hex(id))  "},
           {"CREATE TABLE messages(", "CREATE TABLE massages("},
           {"CREATE TABLE topics(", "CREATE TABLE sqlite("}}) {
    const std::string& forgery = by;  // Clang 14 captures no binding
    CAPTURE(forgery);
    const auto log = read_log("a.db3", forged(word, by));
    CHECK(!log.value);
    CHECK(finding(log).starts_with("BT130"));
  }
}

// Stops after so many questions.
class Impatient : public SearchMonitor {
 public:
  explicit Impatient(int patience) : patience_(patience) {}
  StopReason observe(const SearchProgress&) override {
    return --patience_ < 0 ? StopReason::Timeout : StopReason::None;
  }

 private:
  int patience_;
};

TEST_CASE("a recording is read within the limits of the command") {
  BehaviorLog log = twins();
  for (int i = 0; i < 2000; ++i) {
    log.transitions.push_back(log.transitions.back());
  }
  for (const std::string& bytes :
       {mcap_of({topic_of(log)}, Chunks::Zstd),
        mcap_of({topic_of(log)}, Chunks::Lz4), database_of({topic_of(log)})}) {
    CHECK(read_log("a", bytes).value);
    Impatient none(0);
    CHECK(finding(read_log("a", bytes, "", {.monitor = &none})) ==
          "BT1311 reading the log takes longer than --timeout allows");
  }
  Impatient once(1);
  CHECK(finding(
            read_log("a", database_of({topic_of(log)}), "", {.monitor = &once}))
            .starts_with("BT1311"));
}

TEST_CASE("what is packed is not unpacked beyond the memory there is") {
  const std::string zeros(std::size_t{8} << 20, '\0');
  const std::string magic = "\x89MCAP0\r\n";
  const Limits limits{.max_bytes = std::uint64_t{4} << 20};
  const std::string expected =
      "BT1311 reading the log takes more memory than --memory allows";
  CHECK(finding(read_log("a.mcap",
                         magic + mcap_chunk(zeros, "zstd", zstd_packed(zeros)),
                         "", limits)) == expected);
  CHECK(finding(read_log("a.mcap",
                         magic + mcap_chunk(zeros, "lz4", lz4_packed(zeros)),
                         "", limits)) == expected);
  RosTopic topic;
  topic.messages = {{0, zstd_packed(zeros)}};
  CHECK(finding(read_log("a.db3", database_of({topic}), "", limits)) ==
        expected);
}

TEST_CASE("chunks are held against what they announce") {
  const std::string records = mcap_of({topic_of(twins())});
  const std::string magic = "\x89MCAP0\r\n";
  const auto read = [&](const std::string& chunk) {
    return finding(read_log("a.mcap", magic + chunk));
  };
  CHECK(read(mcap_chunk(records, "bz2", records)) ==
        "BT1302 the chunks of the recording are packed by `bz2`, which is not "
        "read");
  CHECK(read(mcap_chunk(records, "", records + "x")) ==
        fmt::format("BT1303 the log is damaged: a chunk should have {} bytes, "
                    "{} are there",
                    records.size(), records.size() + 1));
  const std::string inner = mcap_chunk("", "", "");
  CHECK(read(mcap_chunk(inner, "", inner)) ==
        "BT1303 the log is damaged: a chunk is within a chunk");
  for (const std::string name : {"zstd", "lz4"}) {
    CAPTURE(name);
    const auto pack = name == "zstd" ? zstd_packed : lz4_packed;
    const std::string packed = pack(records);
    CHECK(read(mcap_chunk(records + "x", name, packed)) ==
          fmt::format("BT1303 the log is damaged: a chunk should have {} "
                      "bytes, {} are there",
                      records.size() + 1, records.size()));
    // A gigabyte of zeros packs into 32 kB.
    const std::string zeros = pack(std::string(64 << 20, '\0'));
    CHECK(read(mcap_chunk("short", name, zeros)) ==
          "BT1303 the log is damaged: more is packed than is announced");
    CHECK(read(mcap_chunk("0123456789", name, pack("012345678A"))) ==
          "BT1303 the log is damaged: the checksum of a chunk is another");
    CHECK(read(mcap_chunk(records, name, records))
              .starts_with("BT1303 the log is damaged: " + name));
    for (std::size_t length = 0; length < packed.size(); ++length) {
      CHECK(read(mcap_chunk(records, name, packed.substr(0, length))) ==
            "BT1303 the log is damaged: what is packed breaks off");
    }
    // One frame after another.
    const std::string inside = records.substr(magic.size());
    const std::string frames =
        pack(inside.substr(0, 100)) + pack(inside.substr(100));
    CHECK(read(mcap_chunk(inside, name, frames)).starts_with("BT1304"));
    // More than may be: it is not even tried.
    std::string huge(16, '\0');
    append_number(huge, kMostUnpacked + 1, 8);
    append_number(huge, 0, 4);
    huge += mcap_text(name);
    append_number(huge, 0, 8);
    CHECK(read(mcap_record(0x06, huge)).starts_with("BT1302 the chunks"));
  }
}

TEST_CASE("no byte of an LZ4 frame can be another unnoticed") {
  const std::string records = mcap_of({topic_of(twins())}).substr(8);
  const std::string packed = lz4_packed(records);
  for (std::size_t at = 0; at < packed.size(); ++at) {
    std::string changed = packed;
    changed[at] = static_cast<char>(changed[at] ^ 0x10);
    CAPTURE(at);
    const auto log = read_log(
        "a.mcap", "\x89MCAP0\r\n" + mcap_chunk(records, "lz4", changed));
    CHECK(finding(log).starts_with("BT1303"));
  }
}

TEST_CASE("a recording that breaks off is read as far as it goes") {
  const std::string whole = mcap_of({topic_of(twins())});
  std::size_t most = 0;
  for (std::size_t length = 0; length < whole.size(); ++length) {
    const auto log = read_log("a.mcap", whole.substr(0, length));
    REQUIRE(log.diagnostics.size() <= 1);
    if (!log.value) {
      CHECK(most == 0);
      continue;
    }
    const std::size_t count = log.value->transitions.size();
    CHECK(count >= most);
    most = count;
    const BehaviorLog all = twins();
    CHECK(std::ranges::equal(log.value->transitions,
                             std::span(all.transitions).first(count)));
    if (count < 7) CHECK(finding(log).starts_with("BT1304"));
  }
  CHECK(most == 7);
}

TEST_CASE("damaged recordings are read or refused") {
  std::mt19937 random(7);
  const std::vector<std::pair<std::string, std::string>> files = {
      {"a.mcap", mcap_of({topic_of(twins())})},
      {"a.mcap", mcap_of({topic_of(twins())}, Chunks::Zstd)},
      {"a.mcap", mcap_of({topic_of(twins())}, Chunks::Lz4)},
      {"a.db3", database_of({topic_of(twins())})}};
  const Model model(kTwins);
  int read = 0;
  for (const auto& [name, whole] : files) {
    for (int turn = 0; turn < 1500; ++turn) {
      std::string bytes = whole;
      const auto place = [&] { return random() % bytes.size(); };
      for (auto flaws = 1 + random() % 4; flaws > 0; --flaws) {
        switch (random() % 4) {
          case 0:
            bytes[place()] = static_cast<char>(random());
            break;
          case 1:
            bytes[place()] = static_cast<char>(0xFF);
            break;
          case 2:
            bytes.erase(place(), 1 + random() % 8);
            break;
          default:
            bytes.insert(place(), bytes.substr(place(), random() % 40));
        }
      }
      const auto log = read_log(name, bytes);
      REQUIRE(has_error(log.diagnostics) != log.value.has_value());
      for (const Diagnostic& found : log.diagnostics) {
        CHECK(found.code.starts_with("BT1"));
      }
      if (!log.value) continue;
      ++read;
      CHECK(log_text(*log.value).ends_with('\n'));
      const auto in_tree = model.with_places(*log.value);
      if (in_tree.value) conformed(model, *in_tree.value);
    }
  }
  CHECK(read > 100);
}

// A log as the lines that a monitor of ROSMonitoring sends, one for each tick.
std::vector<std::string> lines_of(const BehaviorLog& log, bool has_uids) {
  std::vector<std::string> lines;
  std::int64_t last = INT64_MIN / 2;
  for (const LogTransition& record : log.transitions) {
    if (record.time - last >= 5000) lines.emplace_back();
    last = record.time;
    const std::int64_t time = log.begin + record.time;
    const auto name = [](LogStatus status) {
      return kLogStatusNames[static_cast<std::size_t>(status)];
    };
    lines.back() += fmt::format(
        "{}{{\"timestamp\": {{\"sec\": {}, \"nanosec\": {}}}, \"node_name\": "
        "\"{}\", {}\"previous_status\": \"{}\", \"current_status\": \"{}\"}}",
        lines.back().empty() ? "" : ", ", time / 1'000'000,
        time % 1'000'000 * 1000, log.find(record.uid)->name,
        has_uids ? fmt::format("\"uid\": {}, ", record.uid) : "",
        name(record.before), name(record.after));
  }
  for (std::string& line : lines) {
    line =
        "{\"topic\": \"/behavior_tree_log\", \"time\": 1.5, \"event_log\": [" +
        line + "]} ";
  }
  return lines;
}

TEST_CASE("an oracle says of events what is said of their recording") {
  const Model whole(sample().xml, sample().tree);
  const Model small(kTwins);
  const std::string text =
      "property never_fails: never root.failure\n"
      "property never_succeeds: never root.success\n"
      "property ends: eventually root.ended\n"
      "property soon: whenever tick.ends then root.ended within 1 tick\n"
      "property in_order: never root.success and previously root.running\n";
  std::size_t decided = 0;
  for (const bool is_small : {false, true}) {
    const Model& model = is_small ? small : whole;
    const BehaviorLog log = is_small ? twins() : sample();
    for (const bool has_uids : {true, false}) {
      const auto recorded = model.with_places(
          *read_log("a.mcap", mcap_of({topic_of(log, {has_uids, false})}))
               .value);
      auto rules = read_properties("r.ltl", text);
      REQUIRE(rules.value);
      const SourceText source("r.ltl", text);
      // Its ticks take 10 ms; a message is a tick to an oracle.
      const auto report =
          watch_log_as(model.run, "a", *recorded.value, {10'000, true, 5'000},
                       *rules.value, source);
      REQUIRE(report.value);
      std::vector<std::string> violated;
      for (const WatchedRule& rule : report.value->rules) {
        if (rule.outlook == Outlook::Violated) violated.push_back(rule.name);
      }
      decided += violated.size();
      std::vector<OracleRules> asked;
      asked.push_back({std::move(*rules.value), source});
      auto oracle = Oracle::make(model.tree, model.run, asked, {10'000, true});
      REQUIRE(oracle.value);
      for (const std::string& line : lines_of(log, has_uids)) {
        const auto answer = (*oracle.value)->answer(line);
        CHECK(
            answer.line.starts_with("{\"topic\": \"/behavior_tree_log\", "
                                    "\"time\": 1.5, \"event_log\": [{"));
        CHECK(answer.line.find("\"verdict\": \"") != std::string::npos);
      }
      CHECK((*oracle.value)->violated() == violated);
      CHECK((*oracle.value)->changes() == log.transitions.size());
    }
  }
  CHECK(decided >= 4);
}

TEST_CASE("no line makes an oracle stop") {
  const Model model(kTwins);
  const std::string text = "property p: never root.failure\n";
  std::vector<OracleRules> rules;
  rules.push_back(
      {*read_properties("r.ltl", text).value, SourceText("r.ltl", text)});
  auto oracle = Oracle::make(model.tree, model.run, rules, {});
  REQUIRE(oracle.value);
  std::mt19937 random(3);
  std::vector<std::string> lines = lines_of(twins(), true);
  lines.push_back(std::string(100'000, '['));
  lines.push_back("{\"a\":" + std::string(100'000, '[') +
                  std::string(100'000, ']') + "}");
  for (int turn = 0; turn < 3000; ++turn) {
    std::string line = lines[random() % lines.size()];
    for (auto flaws = random() % 4; flaws > 0; --flaws) {
      const std::size_t place = random() % line.size();
      switch (random() % 3) {
        case 0:
          line[place] = static_cast<char>(random());
          break;
        case 1:
          line.erase(place, 1 + random() % 9);
          line += ' ';
          break;
        default:
          line.insert(place, line.substr(random() % line.size(), 30));
      }
    }
    const auto answer = (*oracle.value)->answer(line);
    REQUIRE(answer.line.find("\"verdict\"") != std::string::npos);
    REQUIRE(answer.line.back() == '}');
    if (turn > 50) lines.resize(std::min<std::size_t>(lines.size(), 2));
  }
}

}  // namespace btcheck::ros_log_test
