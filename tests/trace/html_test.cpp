// SPDX-License-Identifier: MIT
//
// The page of a run: whole, small, the same every time, and shut against what
// names and sources may have in them. What it looks like is tests/viewer's.
#include "trace/viewer/html.hpp"
#include "trace/viewer/packed.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "trace/example_runs.hpp"
#include "trace/hand_made_drone.hpp"
#include "trace/hand_made_extremes.hpp"

namespace btcheck::html_test {
namespace {

using nlohmann::json;

std::size_t count(std::string_view text, std::string_view part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string_view::npos;
       at = text.find(part, at + part.size())) {
    ++found;
  }
  return found;
}

// What stands between the two.
std::string between(const std::string& text, std::string_view open,
                    std::string_view close) {
  const std::size_t from = text.find(open);
  REQUIRE(from != std::string::npos);
  const std::size_t to = text.find(close, from + open.size());
  REQUIRE(to != std::string::npos);
  return text.substr(from + open.size(), to - from - open.size());
}

// A source as long as the one of examples/drone3.btf.
const std::string kSource(2300, 'x');

// A text of steps or locations with the keys of nodes written out.
std::string spelled(const json& run, const std::string& text, std::size_t own) {
  std::string result;
  for (std::size_t at = 0; at < text.size(); ++at) {
    if (text[at] != '~') {
      result += text[at];
      continue;
    }
    if (at + 1 < text.size() && text[at + 1] == '~') {
      result += '~';
      ++at;
      continue;
    }
    std::size_t end = at + 1;
    while (end < text.size() && ((text[end] >= '0' && text[end] <= '9') ||
                                 (text[end] >= 'a' && text[end] <= 'z'))) {
      ++end;
    }
    const std::string digits = text.substr(at + 1, end - at - 1);
    const std::size_t node =
        digits.empty() ? own : std::stoul(digits, nullptr, 36);
    const json& key = run["nodes"].at(node)[0];
    result += key == 0 ? run["nodes"][node][2].get<std::string>() + "_btn" +
                             std::to_string(node)
                       : key.get<std::string>();
    at = end - 1;
  }
  return result;
}

// The numbers of the changes, one for each state.
std::vector<std::size_t> changes_of(const json& run) {
  std::vector<std::size_t> numbers;
  for (std::size_t i = 0; i < run["states"].size(); i += 2) {
    const std::size_t first = run["states"][i];
    const std::size_t many = run["states"][i + 1];
    for (std::size_t k = 0; k < many; ++k) numbers.push_back(first + k);
  }
  return numbers;
}

json part(const json& change, std::size_t i) {
  return i < change.size() ? change[i] : json(0);
}

// Reads the packed states as src/trace/viewer/run.js does.
class Unpacker {
 public:
  Unpacker(const json& packed, const RecordedRun& run) : packed_(packed) {
    now_.phases.resize(run.nodes.size(), Phase::Unvisited);
    now_.is_stale.resize(run.nodes.size());
    now_.statuses.resize(run.nodes.size());
    now_.locations.resize(run.nodes.size());
    now_.values.resize(run.variables.size());
    now_.atoms.resize(run.atoms.size());
  }

  const RecordedState& after(const json& change) {
    now_.mover.reset();
    if (part(change, 1) != 0) now_.mover = part(change, 1).get<unsigned>() - 1;
    now_.step = spelled(packed_, text(part(change, 0)), now_.mover.value_or(0));
    now_.event = text(part(change, 4));
    now_.is_chosen = part(change, 5) == 1;
    now_.tick += part(change, 7).get<int>();
    now_.time += part(change, 8).get<int>();
    for (const json& phase : list(change, 2)) {
      const auto number = phase.get<std::size_t>();
      now_.phases[number / 32] = static_cast<Phase>(number % 32 / 2);
      now_.is_stale[number / 32] = number % 2 == 1;
    }
    fill(now_.locations, list(change, 3), true);
    fill(now_.statuses, list(change, 6), false);
    fill(now_.values, list(change, 9), false);
    for (const json& atom : list(change, 10)) {
      now_.atoms[atom.get<std::size_t>()].flip();
    }
    return now_;
  }

 private:
  std::string text(const json& number) const {
    return packed_["texts"].at(number.get<std::size_t>()).get<std::string>();
  }
  static json list(const json& change, std::size_t i) {
    const json found = part(change, i);
    return found.is_array() ? found : json::array();
  }
  void fill(std::vector<std::string>& into, const json& pairs, bool is_coded) {
    for (std::size_t k = 0; k < pairs.size(); k += 2) {
      const std::size_t at = pairs[k];
      into[at] = text(pairs[k + 1]);
      if (is_coded) into[at] = spelled(packed_, into[at], at);
    }
  }

  const json& packed_;
  RecordedState now_;
};

void check_unpacks(const RecordedRun& run) {
  const json packed = json::parse(packed_run(run));
  const auto numbers = changes_of(packed);
  REQUIRE(numbers.size() == run.states.size());
  Unpacker unpacker(packed, run);
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    CAPTURE(i);
    const RecordedState& state = unpacker.after(packed["changes"][numbers[i]]);
    const RecordedState& wanted = run.states[i];
    CHECK(state.step == wanted.step);
    CHECK(state.event == wanted.event);
    CHECK(state.is_chosen == wanted.is_chosen);
    CHECK(state.mover == wanted.mover);
    CHECK(state.tick == wanted.tick);
    CHECK(state.time == wanted.time);
    CHECK(state.phases == wanted.phases);
    CHECK(state.is_stale == wanted.is_stale);
    CHECK(state.statuses == wanted.statuses);
    CHECK(state.locations == wanted.locations);
    CHECK(state.values == wanted.values);
    CHECK(state.atoms == wanted.atoms);
  }
}

TEST_CASE("what is packed unpacks to the same states") {
  check_unpacks(drone_lasso(kSource));
  check_unpacks(drone_watched(kSource));
  check_unpacks(drone_survey(kSource, 600));
  check_unpacks(large_run(60, 4));
}

TEST_CASE("so is every run of the examples") {
  for (const RecordedRun& run : example_runs()) {
    CAPTURE(run.tree);
    CAPTURE(run.property);
    check_unpacks(run);
  }
}

TEST_CASE("keys that begin alike, or look like references, stay apart") {
  RecordedRun run;
  for (const char* key : {"a", "a_btn1", "a_btn12", "~2", "", "Z"}) {
    run.nodes.push_back({key, "Action", key, 1, 1, std::nullopt});
  }
  RecordedState state;
  state.phases.resize(6, Phase::Unvisited);
  state.is_stale.resize(6);
  state.statuses.resize(6, "a");
  state.locations = {"a_btn1_done", "a_btn12", "~2", "~~", "az", "Z~"};
  for (const char* step : {"a_btn1: a -> a_btn12", "a_btn123", "~~2~",
                           "Za a~ ~a", "a_btn1a", "Z", "~", "aa_btn1", ""}) {
    state.step = step;
    for (std::uint32_t mover = 0; mover < 6; ++mover) {
      state.mover = mover;
      run.states.push_back(state);
    }
  }
  check_unpacks(run);
}

TEST_CASE("the heading of the run is in the page") {
  const RecordedRun run = drone_watched(kSource);
  const std::string page = html_text(run);
  CHECK(between(page, "<title>", "</title>") ==
        "VIOLATED watched · drone3.btf");
  const json packed = json::parse(between(
      page, R"(<script type="application/json" id="run">)", "</script>"));
  CHECK(packed["tree"] == run.tree);
  CHECK(packed["source"] == run.source);
  CHECK(packed["ticks"] == run.ticks);
  CHECK(packed["property"] == run.property);
  CHECK(packed["formula"] == run.formula);
  CHECK(packed["verdict"] == run.verdict);
  CHECK(packed["why"] == run.why);
  CHECK(packed["atoms"] == run.atoms);
  CHECK(packed["variables"] == run.variables);
  CHECK(packed["numbers"] == json::parse("[1, 0]"));
  CHECK(packed["trigger"] == run.trigger);
  CHECK(packed["lost"] == run.lost);
  CHECK(!packed.contains("loop"));
  CHECK(packed["nodes"][16] ==
        json::parse(R"([0, "Action", "goto_waypoint", 27, 7, 14])"));
  const RecordedRun lasso = drone_lasso(kSource);
  const json looping = json::parse(packed_run(lasso));
  CHECK(looping["loop"] == lasso.loop);
  CHECK(looping["back"]["step"] == lasso.back.step);
  CHECK(looping["back"]["chosen"] == false);
  CHECK(!looping.contains("lost"));
}

TEST_CASE("nothing in names or sources ends a script, a title or a line") {
  const RecordedRun run = nasty_run();
  const std::string page = html_text(run);
  const std::string plain = html_text(drone_lasso(kSource));
  for (const char* part : {"<script", "</script", "<title", "</title", "<img",
                           "<!--", "<style", "</style"}) {
    CAPTURE(part);
    CHECK(count(page, part) == count(plain, part));
  }
  const std::string data = packed_run(run);
  CHECK(data.find('<') == std::string::npos);
  CHECK(data.find("\u2028") == std::string::npos);
  CHECK(data.find("\u2029") == std::string::npos);
  CHECK(between(page, "<title>", "</title>") ==
        "VIOLATED p&lt;i&gt;&quot;q&quot;&lt;/i&gt; · "
        "dir/&lt;b&gt;&amp;&quot;&apos;\ufffd.btf");
  const json packed = json::parse(data);  // which is UTF-8, or would not parse
  CHECK(packed["formula"] == run.formula);
  CHECK(packed["why"] == run.why);
  CHECK(packed["tree"] == "dir/<b>&\"'\ufffd.btf");
  CHECK(packed["nodes"][7][2] == std::string("nul\0nul", 7));
}

TEST_CASE("a title keeps whole characters and replaces what is none") {
  RecordedRun run = drone_lasso("");
  run.verdict = "HOLDS";
  run.property =
      "\xf0\x9f\xa4\x96 \xc3\xa9 \xe2\x82\xac \xf0\x9f\xa4 "
      "\xc0\xaf \xed\xa0\x80 \xf4\x90\x80\x80 a\nb\x01";
  run.tree = "\xc3";
  const std::string bad = "\ufffd";
  CHECK(between(html_text(run), "<title>", "</title>") ==
        "HOLDS \U0001f916 é € " + bad + bad + bad + " " + bad + bad + " " +
            bad + bad + bad + " " + bad + bad + bad + bad + " a b  · " + bad);
}

TEST_CASE("the sources of the viewer can stand in a page") {
  std::string all(kViewerPage);
  for (const std::string_view part : kViewerStyles) {
    CHECK(part.find("</style") == std::string_view::npos);
    all += part;
  }
  for (const std::string_view part : kViewerScripts) {
    CHECK(part.find("</script") == std::string_view::npos);
    CHECK(part.find("<!--") == std::string_view::npos);
    CHECK(part.find("  //") == std::string_view::npos);  // lines are joined
    all += part;
  }
  // What it names, and never asks for: the format, and what an SVG is.
  CHECK(count(all, "https:") == 1);
  CHECK(count(all, "https://apalache-mc.org") == 1);
  CHECK(count(all, "http:") == count(all, "http://www.w3.org/2000/svg"));
  CHECK(count(all, "@import") == 0);
  for (const std::string_view part : {kViewerLong, kViewerLive}) {
    CHECK(part.find("</script") == std::string_view::npos);
    CHECK(part.find("<!--") == std::string_view::npos);
    CHECK(part.find("  //") == std::string_view::npos);
  }
  for (const char* gap : {"{{policy}}", "{{title}}", "{{style}}", "{{run}}",
                          "{{nonce}}", "{{script}}"}) {
    CHECK(count(kViewerPage, gap) == 1);
  }
}

TEST_CASE("a thousand steps stay below 100 kB") {
  const RecordedRun run = drone_survey(kSource, 1000);
  REQUIRE(run.states.size() == 1000);
  const std::string page = html_text(run);
  MESSAGE("1000 steps: " << page.size() << " bytes, of which the run "
                         << packed_run(run).size());
  CHECK(page.size() < 100'000);
  // What only a longer run needs is in the page of such a one alone.
  CHECK(page.find(kViewerLong) == std::string::npos);
  const std::string longer = html_text(drone_survey(kSource, 1001));
  CHECK(longer.find(kViewerLong) != std::string::npos);
  CHECK(longer.find(kViewerLongStyle) != std::string::npos);
}

TEST_CASE("equal runs give equal pages") {
  CHECK(html_text(drone_survey(kSource, 300)) ==
        html_text(drone_survey(kSource, 300)));
}

TEST_CASE("a run without anything in it has a page") {
  RecordedRun run;
  run.nodes.push_back({"a", "Action", "a", 1, 1, std::nullopt});
  run.states.push_back({});
  run.states[0].phases = {Phase::Unvisited};
  run.states[0].is_stale = {false};
  run.states[0].statuses = {""};
  run.states[0].locations = {""};
  CHECK(json::parse(packed_run(run))["states"] == json::parse("[0, 1]"));
  CHECK(html_text(run).find("</html>") != std::string::npos);
}

}  // namespace
}  // namespace btcheck::html_test
