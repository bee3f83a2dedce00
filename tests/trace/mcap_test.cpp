// SPDX-License-Identifier: MIT
//
// A recording, read back by a reader that knows no more than the format.
#include "trace/formats/recordings.hpp"

#include <doctest/doctest.h>

#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <vector>

#include "trace/example_runs.hpp"
#include "trace/recorded_run_maker.hpp"
#include "trace/run/little_endian.hpp"
#include "trace/run/recorded_run.hpp"

namespace btcheck::mcap_test {
namespace {

using nlohmann::json;

// Takes one field after the other from the body of a record.
class Fields {
 public:
  explicit Fields(std::string_view bytes) : bytes_(bytes) {}

  std::uint64_t number(std::size_t count) {
    REQUIRE(count <= bytes_.size());
    const std::uint64_t value = number_at(bytes_, 0, count);
    bytes_.remove_prefix(count);
    return value;
  }
  std::string text() {
    const std::uint64_t size = number(4);
    REQUIRE(size <= bytes_.size());
    const std::string value(bytes_.substr(0, size));
    bytes_.remove_prefix(size);
    return value;
  }
  std::map<std::string, std::string> map() {
    const std::string inside = text();
    Fields fields(inside);
    std::map<std::string, std::string> pairs;
    while (!fields.rest().empty()) {
      const std::string key = fields.text();
      pairs[key] = fields.text();
    }
    return pairs;
  }
  std::string_view rest() const { return bytes_; }

 private:
  std::string_view bytes_;
};

struct Message {
  std::string topic;
  std::uint64_t time;
  json value;
};

struct Recording {
  std::map<std::string, std::string> about;
  std::map<std::string, std::string> schema_of;  // by topic, its name
  std::vector<Message> messages;
};

Recording read(const std::string& bytes) {
  const std::string magic("\x89MCAP0\r\n", 8);
  REQUIRE(bytes.substr(0, 8) == magic);
  REQUIRE(bytes.substr(bytes.size() - 8) == magic);
  Recording recording;
  std::map<std::uint64_t, std::string> schemas;
  std::map<std::uint64_t, std::string> channels;
  std::string kinds;
  std::uint64_t sequence = 0;
  for (std::size_t at = 8; at < bytes.size() - 8;) {
    const auto kind = static_cast<char>(bytes[at]);
    const std::size_t size = number_at(bytes, at + 1, 8);
    REQUIRE(size <= bytes.size() - 8 - at - 9);
    Fields fields(std::string_view(bytes).substr(at + 9, size));
    if (kinds.empty() || kinds.back() != kind) kinds += kind;
    if (kind == 0x01) {
      CHECK(fields.text().empty());
      CHECK(fields.text() == "btcheck");
    } else if (kind == 0x03) {
      const auto id = fields.number(2);
      CHECK(id != 0);
      schemas[id] = fields.text();
      CHECK(fields.text() == "jsonschema");
      CHECK(json::parse(fields.text())["type"] == "object");
    } else if (kind == 0x04) {
      const auto id = fields.number(2);
      CHECK(!channels.contains(id));
      const auto schema = fields.number(2);
      REQUIRE(schemas.contains(schema));
      channels[id] = fields.text();
      CHECK(fields.text() == "json");
      CHECK(fields.map().empty());
      recording.schema_of[channels[id]] = schemas[schema];
    } else if (kind == 0x05) {
      const auto id = fields.number(2);
      REQUIRE(channels.contains(id));
      CHECK(fields.number(4) == sequence++);
      const auto time = fields.number(8);
      CHECK(fields.number(8) == time);
      recording.messages.push_back(
          {channels[id], time, json::parse(fields.rest())});
    } else if (kind == 0x0C) {
      CHECK(fields.text() == "btcheck");
      recording.about = fields.map();
    } else if (kind == 0x0F) {
      CHECK(fields.number(4) ==
            mcap_checksum(std::string_view(bytes).substr(0, at)));
    } else {
      REQUIRE(kind == 0x02);
      CHECK(fields.number(8) == 0);
      CHECK(fields.number(8) == 0);
      CHECK(fields.number(4) ==
            mcap_checksum(std::string_view(bytes).substr(at, 25)));
      CHECK(at + 9 + size == bytes.size() - 8);
    }
    at += 9 + size;
  }
  CHECK(kinds == "\x01\x0C\x03\x04\x05\x0F\x02");
  return recording;
}

TEST_CASE("the checksum is the usual one") {
  CHECK(mcap_checksum("") == 0);
  CHECK(mcap_checksum("123456789") == 0xCBF43926);
}

TEST_CASE("a recording says what it is of") {
  const Recording recording = read(mcap_bytes(looping_run()));
  CHECK(recording.about.at("property") == "p");
  CHECK(recording.about.at("formula") == "[] a");
  CHECK(recording.about.at("verdict") == "VIOLATED");
  CHECK(recording.about.at("why") == "nobody looks at the battery");
  CHECK(recording.schema_of ==
        std::map<std::string, std::string>{
            {"/step", "btcheck.Step"},
            {"/bt/0_BehaviorTree_main", "btcheck.Phase"},
            {"/bt/1_ReactiveFallback_ReactiveFallback2", "btcheck.Phase"},
            {"/bt/2_Condition_good_", "btcheck.Phase"},
            {"/bt/3_Action_go__home_", "btcheck.Phase"},
            {"/variables/battery", "btcheck.Value"},
            {"/variables/level", "btcheck.Value"},
            {"/property/1", "btcheck.Atom"}});
}

TEST_CASE("variables and atoms are told where they change") {
  std::vector<json> battery;
  std::vector<json> level;
  std::vector<json> atom;
  for (const Message& message : read(mcap_bytes(looping_run())).messages) {
    if (message.topic == "/variables/battery") battery.push_back(message.value);
    if (message.topic == "/variables/level") level.push_back(message.value);
    if (message.topic == "/property/1") atom.push_back(message.value);
  }
  CHECK(battery == std::vector<json>{{{"value", "Good"}, {"tick", 0}},
                                     {{"value", "Low"}, {"tick", 2}}});
  REQUIRE(level.size() == 4);
  CHECK(level[3] == json{{"value", 30}, {"tick", 3}});
  CHECK(atom ==
        std::vector<json>{
            {{"text", "battery = Good"}, {"value", true}, {"tick", 0}},
            {{"text", "battery = Good"}, {"value", false}, {"tick", 2}}});
}

// The messages give back every phase of every state, the loop `passes` times.
void check_messages(const RecordedRun& run, int passes) {
  std::map<std::string, json> last;
  std::vector<std::map<std::string, json>> seen;
  std::vector<json> steps;
  for (const Message& message : read(mcap_bytes(run, passes)).messages) {
    const auto number = (message.time - kMcapBegin) / kMcapStep;
    CHECK(message.time == kMcapBegin + number * kMcapStep);
    if (message.topic == "/step") {
      CHECK(number == steps.size());
      if (!steps.empty()) seen.push_back(last);
      steps.push_back(message.value);
    } else {
      last[message.topic] = message.value;
    }
  }
  seen.push_back(last);
  const auto passings = unrolled(run, passes);
  REQUIRE(steps.size() == passings.size());
  for (std::size_t i = 0; i < passings.size(); ++i) {
    const RecordedState& state = run.states[passings[i].state];
    CHECK(steps[i]["state"] == passings[i].state);
    CHECK(steps[i]["tick"] == passings[i].tick);
    for (std::size_t n = 0; n < run.nodes.size(); ++n) {
      const json& told = seen[i]["/bt/" + std::to_string(n) + "_" +
                                 run.nodes[n].type + "_" + run.nodes[n].name];
      const auto phase = static_cast<std::size_t>(state.phases[n]);
      REQUIRE(told["status"] == kPhaseNames[phase]);
      REQUIRE(told["stale"] == static_cast<bool>(state.is_stale[n]));
    }
  }
}

TEST_CASE("messages give back every phase of every state, loops included") {
  std::mt19937 random(10);
  for (int round = 0; round < 60; ++round) {
    CAPTURE(round);
    check_messages(random_phases(random), 1 + round % 3);
  }
}

TEST_CASE("so do those of every run of the examples") {
  for (const RecordedRun& run : example_runs()) {
    CAPTURE(run.tree);
    CAPTURE(run.property);
    check_messages(run, 2);
  }
}

TEST_CASE("where the loop closes, the step is the one that leads back") {
  RecordedRun run = looping_run();
  run.back.step = "b";
  run.back.event = "e";
  run.back.is_chosen = true;
  std::vector<json> steps;
  for (const Message& message : read(mcap_bytes(run, 2)).messages) {
    if (message.topic == "/step") steps.push_back(message.value);
  }
  REQUIRE(steps.size() == 2 * run.states.size() - run.loop);
  CHECK(steps[run.states.size()] == json{{"step", "b"},
                                         {"event", "e"},
                                         {"chosen", true},
                                         {"tick", 4},
                                         {"state", run.loop}});
  CHECK(steps[run.states.size() + 1]["step"] == run.states[run.loop + 1].step);
}

TEST_CASE("bytes that are no UTF-8 are replaced") {
  RecordedRun run = looping_run();
  run.tree = "a\xff.btf";
  run.nodes[1].name = "\xc3";
  run.states[1].step = "\xff";
  const Recording recording = read(mcap_bytes(run));
  CHECK(recording.about.at("tree") == "a\xEF\xBF\xBD.btf");
  CHECK(recording.schema_of.contains("/bt/1_ReactiveFallback__"));
}

}  // namespace
}  // namespace btcheck::mcap_test
