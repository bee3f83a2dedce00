// SPDX-License-Identifier: MIT
//
// Baselines: written, read again, and compared with what is found.
#include "cli/settings/baseline.hpp"

#include <doctest/doctest.h>

#include <string>
#include <vector>

namespace btcheck::baseline_test {
namespace {

KnownFinding finding(const std::string& code, const std::string& file,
                     std::size_t count = 1) {
  return {code, file, "node", "<Node name=\"node\"/>", count};
}

std::string mistake_in(const std::string& text) {
  const auto read = read_baseline("/", "b.json", text);
  CHECK(!read.value.has_value());
  REQUIRE(read.diagnostics.size() == 1);
  return render(read.diagnostics[0]);
}

Judged judged_with(const std::vector<KnownFinding>& told) {
  Judged judged;
  judged.told = told;
  judged.is_whole = true;
  judged.files = {"t.xml"};
  return judged;
}

// "BT2205 t.xml 2": each on a line.
std::string listed(const std::vector<KnownFinding>& findings) {
  std::string text;
  for (const KnownFinding& each : findings) {
    text +=
        each.code + " " + each.file + " " + std::to_string(each.count) + "\n";
  }
  return text;
}

BaselineChange change(const std::vector<KnownFinding>& baseline,
                      const std::vector<const Judged*>& trees) {
  Judgement said;
  said.directory = "/w";
  said.baseline = baseline;
  return change_of(said, trees);
}

TEST_CASE("a baseline that is written is read, from wherever it lies") {
  const std::string text = baseline_text(
      "/w", "ci/b.json",
      {finding("BT2205", "/w/t.xml", 2), finding("BT2208", "/x")});
  CHECK(text ==
        "{\"schema\":\"btcheck-baseline/1\",\n"
        "\"findings\":[\n"
        "{\"code\":\"BT2205\",\"file\":\"../t.xml\",\"node\":\"node\","
        "\"text\":\"<Node name=\\\"node\\\"/>\",\"count\":2},\n"
        "{\"code\":\"BT2208\",\"file\":\"../../x\",\"node\":\"node\","
        "\"text\":\"<Node name=\\\"node\\\"/>\",\"count\":1}\n"
        "]}\n");
  const auto read = read_baseline("/other/ci", "b.json", text);
  REQUIRE(read.value.has_value());
  CHECK(listed(*read.value) == "BT2205 /other/t.xml 2\nBT2208 /x 1\n");
}

TEST_CASE("what is no baseline is refused") {
  CHECK(mistake_in("{\"schema\": ") ==
        "error[BT1511]: this is no JSON\n"
        "  --> b.json:1:11\n"
        "  |\n"
        "1 | {\"schema\": \n"
        "  |           ^\n"
        "  |\n"
        "  = help: write it with btcheck --write-baseline\n");
  for (const char* text :
       {"", "[]", "{}", "{\"schema\":\"btcheck/1\"}",
        "{\"schema\":\"btcheck-baseline/1\"}",
        "{\"schema\":\"btcheck-baseline/1\",\"findings\":[{}]}",
        "{\"schema\":\"btcheck-baseline/1\",\"findings\":[{\"code\":\"\","
        "\"file\":\"\",\"node\":\"\",\"text\":\"\",\"count\":-1}]}",
        "{\"schema\":1,\"findings\":[]}", "\xff"}) {
    CAPTURE(text);
    CHECK(mistake_in(text).starts_with("error[BT1511]: "));
  }
}

TEST_CASE("what occurs no more, or less often, is gone") {
  const Judged now = judged_with({finding("BT2205", "t.xml")});
  const auto changed =
      change({finding("BT2205", "/w/t.xml", 2), finding("BT2208", "/w/t.xml")},
             {&now});
  CHECK(changed.gone == 2);
  CHECK(listed(changed.now) == "BT2205 /w/t.xml 1\n");
}

TEST_CASE("notes are not kept, and known where an older file has them") {
  KnownFinding note = finding("BT2205", "t.xml");
  note.can_fail = false;
  const Judged now = judged_with({note, finding("BT2208", "t.xml")});
  CHECK(listed(change({}, {&now}).now) == "BT2208 /w/t.xml 1\n");
  const auto older = change({finding("BT2205", "/w/t.xml")}, {&now});
  CHECK(older.gone == 0);
  CHECK(listed(older.now) == "BT2208 /w/t.xml 1\n");
}

TEST_CASE("what was not looked for is not gone") {
  Judged now = judged_with({});
  const std::vector<KnownFinding> known = {finding("BT2205", "/w/t.xml"),
                                           finding("BT2205", "/w/u.xml"),
                                           finding("BT1628", "/w/t.xml")};
  const auto whole = change(known, {&now});
  CHECK(whole.gone == 2);
  CHECK(listed(whole.now) == "BT2205 /w/u.xml 1\n");
  now.is_whole = false;
  const auto brief = change(known, {&now});
  CHECK(brief.gone == 1);
  CHECK(listed(brief.now) == "BT2205 /w/t.xml 1\nBT2205 /w/u.xml 1\n");
}

TEST_CASE("a file of several trees has what one of them has most of") {
  const Judged one = judged_with({finding("BT2205", "t.xml", 2)});
  Judged other = judged_with({finding("BT2205", "t.xml")});
  other.known = {finding("BT2208", "t.xml")};
  const auto changed = change({finding("BT2208", "/w/t.xml")}, {&one, &other});
  CHECK(changed.gone == 0);
  CHECK(listed(changed.now) == "BT2205 /w/t.xml 2\nBT2208 /w/t.xml 1\n");
}

}  // namespace
}  // namespace btcheck::baseline_test
