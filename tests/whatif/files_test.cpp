// SPDX-License-Identifier: MIT
//
// What other programs read of faults.
#include "report/whatif/files.hpp"

#include <doctest/doctest.h>

#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "mission.hpp"
#include "trace/run/itf.hpp"

namespace btcheck::whatif_files_test {
namespace {

using Document = nlohmann::json;

std::vector<std::string> found_in(const std::string& text, const char* what) {
  const std::regex pattern(what);
  std::vector<std::string> all;
  for (std::sregex_iterator at(text.begin(), text.end(), pattern), end;
       at != end; ++at) {
    all.push_back((*at)[1]);
  }
  return all;
}

// The cells of each line, by RFC 4180.
std::vector<std::vector<std::string>> cells_of(const std::string& text) {
  std::vector<std::vector<std::string>> lines(1, {""});
  bool is_quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    std::string& cell = lines.back().back();
    if (is_quoted) {
      if (c == '"' && i + 1 < text.size() && text[i + 1] == '"') {
        cell += text[++i];
      } else if (c == '"') {
        is_quoted = false;
      } else {
        cell += c;
      }
    } else if (c == '"') {
      is_quoted = true;
    } else if (c == ',') {
      lines.back().emplace_back();
    } else if (c == '\n') {
      lines.push_back({""});
    } else if (c != '\r') {
      cell += c;
    }
  }
  lines.pop_back();  // behind the last line end
  return lines;
}

// The JSON in the script of a page.
Document data_of(const std::string& page) {
  const std::string begin = "<script type=\"application/json\" id=\"data\">";
  const std::size_t at = page.find(begin) + begin.size();
  return Document::parse(page.substr(at, page.find("</script>", at) - at));
}

}  // namespace

TEST_CASE("JSON has each row with its run") {
  SearchedMission mission(kPictures, with_pairs());
  const Document document = Document::parse(what_if_json(mission.report()));
  const WhatIf& result = mission.result();
  REQUIRE(document["rows"].size() == result.rows.size());
  REQUIRE(document["pairs"].size() == result.pairs.size());
  CHECK(document["score"]["silent"] == 3);
  CHECK(document["healthy"] == Document{"success"});
  for (std::size_t i = 0; i < result.rows.size(); ++i) {
    const Document& row = document["rows"][i];
    CHECK(row["number"] == i + 1);
    CHECK(row["harm"] == std::string(facts_of(result.rows[i].harm).word));
    CHECK(row["run"].is_null() == result.rows[i].steps.empty());
    if (row["run"].is_null()) continue;
    // The run shows that the leaf is asked.
    std::string events;
    for (const Document& tick : row["run"]["ticks"]) {
      for (const Document& event : tick["events"]) {
        events += event.get<std::string>() + '\n';
      }
    }
    CAPTURE(row["told"].get<std::string>());
    const bool is_thrown = row["faults"][0]["kind"] == "throws";
    CHECK((is_thrown ||
           events.find(row["faults"][0]["leaf"].get<std::string>()) !=
               std::string::npos));
  }
  const std::size_t silent = mission.number("TakePicture", FaultKind::Fails);
  const Document& row = document["rows"][silent - 1];
  CHECK(row["faults"][0]["path"] == "Main/Sequence/ForceSuccess/TakePicture");
  CHECK(row["notice"].is_null());
  CHECK(row["outcomes"] == Document{"success"});
  // A cut set is the number of a row.
  for (const Document& cut : document["cut_sets"]) {
    for (const Document& number : cut["sets"]) {
      CHECK(number.get<std::size_t>() <=
            result.rows.size() + result.pairs.size());
    }
  }
}

TEST_CASE("a run of a row is one that other commands read") {
  SearchedMission mission(kPictures);
  const WhatIfReport report = mission.report();
  std::size_t shown = 0;
  for (std::size_t n = 1; n <= mission.result().rows.size(); ++n) {
    const FaultRow& row = row_numbered(mission.result(), n);
    const auto run = run_of_row(report, n);
    CHECK(run.has_value() == !row.steps.empty());
    if (!run) continue;
    ++shown;
    const auto read = read_itf("run.itf.json", itf_text(*run));
    REQUIRE(read.value.has_value());
    CHECK(*read.value == *run);
    REQUIRE(run->trigger != kNoState);
    CHECK(run->states[run->trigger].tick == row.struck_in);
    // Where it goes round, the state that it returns to is told once.
    if (run->loop == kNoState) {
      CHECK(run->states.back().tick == row.ended_in);
    }
    if (row.harm == Harm::NeverEnds) CHECK(run->loop != kNoState);
  }
  CHECK(shown > 20);
}

TEST_CASE("the sheet has a line for each fault") {
  SearchedMission mission(kPictures);
  const auto lines = cells_of(what_if_csv(mission.report()));
  REQUIRE(lines.size() == mission.result().rows.size() + 1);
  for (const auto& line : lines) CHECK(line.size() == lines[0].size());
  CHECK(lines[1][0] == "1");
  CHECK(lines[1][1] == "TakePicture");
  CHECK(lines[1][8] ==
        "the mission succeeds, what `TakePicture` is for was not done, and "
        "nobody notices");
  CHECK(lines[1][11] == "nobody");
}

TEST_CASE("a name is no formula to a spreadsheet, and ends no line") {
  SearchedMission mission(R"xml(<root BTCPP_format="4"><BehaviorTree ID="M">
    <Sequence><Action ID="Go" name="=HYPERLINK(&quot;a&quot;,&quot;b&quot;)"/>
    <Action ID="Go" name="x&#10;y"/></Sequence></BehaviorTree>
    <TreeNodesModel><Action ID="Go"/></TreeNodesModel></root>)xml");
  const auto lines = cells_of(what_if_csv(mission.report()));
  REQUIRE(lines.size() == mission.result().rows.size() + 1);
  bool is_seen = false;
  for (const auto& line : lines) {
    REQUIRE(line.size() == lines[0].size());
    is_seen |= line[1] == "'=HYPERLINK(\"a\",\"b\")";
    for (const std::string& cell : line) {
      CHECK(cell.substr(0, 1).find_first_of("=+-@") == std::string::npos);
    }
  }
  CHECK(is_seen);
  // Nor does it end an element.
  SearchedMission other(R"xml(<root BTCPP_format="4"><BehaviorTree ID="M">
    <Action ID="Go" name="&lt;/script&gt;&lt;img src=x&gt;{{run}}"/>
    </BehaviorTree><TreeNodesModel><Action ID="Go"/></TreeNodesModel>
    </root>)xml");
  const std::string page = what_if_page(other.report());
  CHECK(page.find("<img") == std::string::npos);
  CHECK(data_of(page)["runs"].size() > 3);
  CHECK(fault_tree_svg(other.report()).find("<img") == std::string::npos);
  CHECK(fault_tree_xml(other.report()).find("<img") == std::string::npos);
}

TEST_CASE("Open-PSA has an event for each fault of a cut set") {
  SearchedMission mission(kPictures, with_pairs());
  const std::string text = fault_tree_xml(mission.report());
  const auto defined = found_in(text, "define-basic-event name=\"([^\"]*)\"");
  const auto used = found_in(text, "<basic-event name=\"([^\"]*)\"");
  const std::set<std::string> once(defined.begin(), defined.end());
  CHECK(once.size() == defined.size());
  CHECK(once == std::set<std::string>(used.begin(), used.end()));
  const std::regex identifier("[A-Za-z_][A-Za-z0-9_]*(-[A-Za-z0-9_]+)*");
  for (const std::string& name : defined) {
    CAPTURE(name);
    CHECK(std::regex_match(name, identifier));
  }
  const auto gates = found_in(text, "define-gate name=\"([^\"]*)\"");
  CHECK(std::set(gates.begin(), gates.end()).size() == gates.size());
  std::size_t sets = 0;
  std::size_t pairs = 0;
  for (const CutSets& cut : mission.result().cut_sets) {
    sets += cut.sets.size();
    for (const auto& set : cut.sets) pairs += set.size() == 2;
  }
  REQUIRE(sets > 0);
  CHECK(used.size() == sets + pairs);
}

TEST_CASE("drawings have each event, and gates for pairs") {
  SearchedMission mission(kPictures, with_pairs());
  for (const std::string& text :
       {fault_tree_dot(mission.report()), fault_tree_svg(mission.report())}) {
    CHECK(text.find("the mission never ends") != std::string::npos);
    CHECK(text.find("OR") != std::string::npos);
    CHECK(text.find("AND") != std::string::npos);
    CHECK(text.find("DockFront") != std::string::npos);
  }
}

TEST_CASE("the page has all runs, and what they share once") {
  SearchedMission mission(kPictures, with_pairs());
  const std::string page = what_if_page(mission.report());
  const Document data = data_of(page);
  std::size_t runs = 0;
  std::size_t states = 0;
  std::size_t changes = 0;
  for (std::size_t n = 1; n <= row_count(mission.result()); ++n) {
    runs += !row_numbered(mission.result(), n).steps.empty();
  }
  CHECK(data["runs"].size() == runs);
  std::set<std::string> known;
  for (std::size_t n = 1; n <= row_count(mission.result()); ++n) {
    const auto found = data["runs"].find(std::to_string(n));
    if (found == data["runs"].end()) continue;
    CHECK(!found->contains("nodes"));
    for (const Document& change : (*found)["changes"]) {
      CHECK(known.insert(change.dump()).second);
      ++changes;
    }
    const Document& pairs = (*found)["states"];
    std::size_t own = 0;
    for (std::size_t i = 0; i < pairs.size(); i += 2) {
      const auto first = pairs[i].get<std::size_t>();
      const auto count = pairs[i + 1].get<std::size_t>();
      // Of changes that are there by then.
      CHECK(first + count <= changes);
      own += count;
    }
    CHECK(own == run_of_row(mission.report(), n)->states.size());
    states += own;
  }
  CHECK(changes * 3 < states);
  CHECK(page.find("Content-Security-Policy") != std::string::npos);
  CHECK(page.find("{{") > page.find("id=\"data\""));
  // Without a script it says what each fault does.
  CHECK(page.find("what <code>TakePicture</code> is for was not done") !=
        std::string::npos);
}

}  // namespace btcheck::whatif_files_test
