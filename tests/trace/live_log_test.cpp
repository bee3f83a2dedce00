// SPDX-License-Identifier: MIT
//
// A run that is packed piece by piece, and a log that grows.
#include <doctest/doctest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "text/json.hpp"
#include "trace/hand_made_drone.hpp"
#include "trace/live/live_log.hpp"
#include "trace/log_files.hpp"
#include "trace/viewer/packed.hpp"

namespace btcheck::live_log_test {
namespace {

using nlohmann::json;

// The numbers of changes, one for each state.
void add_states(const json& pairs, std::vector<int>& numbers) {
  for (std::size_t i = 0; i < pairs.size(); i += 2) {
    for (int k = 0; k < pairs[i + 1].get<int>(); ++k) {
      numbers.push_back(pairs[i].get<int>() + k);
    }
  }
}

// All that has been told of a run, as a page puts it together.
struct Told {
  json texts = json::array();
  json changes = json::array();
  std::vector<int> states;
  bool is_over = false;
  bool is_anew = false;

  void add(const json& piece) {
    for (const json& text : piece["texts"]) texts.push_back(text);
    for (const json& change : piece["changes"]) changes.push_back(change);
    add_states(piece["states"], states);
  }
  void hear(const LiveRun& run, LiveRun::Place& place) {
    while (const auto message = run.next(place)) {
      is_anew |= message->find("event: anew") != std::string::npos;
      is_over |= message->find("event: end") != std::string::npos;
      if (message->find("\nevent: ") != std::string::npos || is_anew) continue;
      add(json::parse(message->substr(message->find("data: ") + 6)));
    }
  }
};

// What the page begins with.
Told begun(const LiveRun& run) {
  const std::string page = run.page("nonce");
  const std::string open = "<script type=\"application/json\" id=\"run\">";
  const std::size_t at = page.find(open) + open.size();
  Told told;
  told.add(json::parse(page.substr(at, page.find("</script>", at) - at)));
  return told;
}

Told all_of(const LiveRun& run, std::uint64_t chapter = 1) {
  Told told = begun(run);
  LiveRun::Place place{chapter, 0};
  told.hear(run, place);
  return told;
}

bool is_same(const Told& a, const Told& b) {
  return a.texts == b.texts && a.changes == b.changes && a.states == b.states;
}

}  // namespace

TEST_CASE("pieces of a run are together what the whole is packed as") {
  const RecordedRun run = drone_survey("", 1000);
  Told whole;
  whole.add(json::parse(packed_run(run)));
  for (const std::size_t piece : {1u, 7u, 400u}) {
    RunPacker packer(run);
    Told told;
    for (std::size_t at = 0; at < run.states.size(); at += piece) {
      Json document = Json::object();
      packer.add(std::span(run.states)
                     .subspan(at, std::min(piece, run.states.size() - at)),
                 document);
      told.add(json::parse(document.text()));
    }
    CHECK(is_same(told, whole));
  }
}

TEST_CASE("a log that grows by any bytes is the run of the whole log") {
  for (const char* name : {"btcpp4.10_sample.btlog", "bt_trace1.fbl"}) {
    CAPTURE(name);
    const std::string bytes = data_file(name);
    LiveLog whole(name, {});
    REQUIRE(whole.take(bytes).empty());
    const Told expected = all_of(whole.run());
    REQUIRE(expected.states.size() > 10);
    LiveLog growing(name, {});
    std::size_t refused = 0;
    LiveRun::Place place{1, 0};
    Told told;
    bool has_begun = false;
    const std::size_t step = bytes.size() / 200 + 1;
    for (std::size_t size = 0;; size = std::min(size + step, bytes.size())) {
      // A heading that is not whole is refused, a record is waited for.
      const auto flaws = growing.take(std::string_view(bytes).substr(0, size));
      if (!flaws.empty()) {
        CHECK(!has_begun);
        ++refused;
      } else {
        if (!has_begun) told = begun(growing.run());
        has_begun = true;
        told.hear(growing.run(), place);
      }
      if (size == bytes.size()) break;
    }
    CHECK(refused > 0);
    CHECK(!told.is_anew);
    CHECK(told.states.size() == expected.states.size());
    growing.end("over");
    whole.end("over");
    told.hear(growing.run(), place);
    CHECK(told.is_over);
    CHECK(is_same(told, all_of(growing.run())));
    CHECK(is_same(all_of(growing.run()), all_of(whole.run())));
  }
}

TEST_CASE("a log that is begun anew is a run that begins anew") {
  const std::string bytes = data_file("btcpp4.10_sample.btlog");
  LiveLog log("a.btlog", {});
  REQUIRE(log.take(bytes).empty());
  LiveRun::Place place{1, 0};
  Told told;
  told.hear(log.run(), place);
  // Shorter than before: written again, and not far yet.
  REQUIRE(
      log.take(std::string_view(bytes).substr(0, bytes.size() - 90)).empty());
  told.hear(log.run(), place);
  CHECK(told.is_anew);
  CHECK(all_of(log.run(), 2).states.size() > 10);
}

TEST_CASE("a pause of an hour is one state") {
  std::string bytes = data_file("btcpp4.10_sample.btlog");
  LiveLog log("a.btlog", {});
  REQUIRE(log.take(bytes).empty());
  const std::size_t before = all_of(log.run()).states.size();
  // The last record comes an hour later: 36,000 ticks.
  std::int64_t time = 3'600'000'000;
  for (std::size_t i = 0; i < 6; ++i, time >>= 8) {
    bytes[bytes.size() - 9 + i] = static_cast<char>(time & 0xff);
  }
  LiveLog paused("a.btlog", {});
  REQUIRE(paused.take(bytes).empty());
  const std::size_t after = all_of(paused.run()).states.size();
  CHECK(after >= before);
  CHECK(after < before + 10);
}

TEST_CASE("a log that is damaged stays as it was") {
  const std::string bytes = data_file("btcpp4.10_sample.btlog");
  LiveLog log("a.btlog", {});
  REQUIRE(log.take(bytes).empty());
  const Told before = all_of(log.run());
  const auto flaws = log.take(bytes + std::string(9, '\xff'));
  REQUIRE(flaws.size() == 1);
  CHECK(flaws[0].code == "BT1303");
  CHECK(is_same(all_of(log.run()), before));
  CHECK(log.take(bytes).empty());
}

}  // namespace btcheck::live_log_test
