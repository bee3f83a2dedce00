// SPDX-License-Identifier: MIT
//
// What only some releases of BehaviorTree.CPP do. Whether a file loads was
// tried on 3.8.8 itself, with an action A of one port, `p`, an int.
#include <doctest/doctest.h>

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "model/btcpp/script/script.hpp"
#include "model/tree/node_types.hpp"
#include "model/tree_file.hpp"

namespace btcheck::btcpp_releases_test {
namespace {

constexpr const char* kModels =
    "<root><TreeNodesModel><Action ID=\"A\"><input_port name=\"p\" "
    "type=\"int\" default=\"1\"/></Action></TreeNodesModel></root>";

std::vector<Diagnostic> said_of(const std::string& text,
                                std::optional<Profile> profile) {
  TreeReading reading;
  reading.profile = profile;
  reading.models = {{"m.xml", kModels}};
  return read_tree("t.xml", text, reading).diagnostics;
}

bool loads(const std::string& text, std::optional<Profile> profile) {
  return !has_error(said_of(text, profile));
}

std::string tree3(const std::string& inside, const std::string& beside = "") {
  return "<root main_tree_to_execute=\"M\"><BehaviorTree ID=\"M\">" + inside +
         "</BehaviorTree>" + beside + "</root>";
}

std::string tree4(const std::string& inside, const std::string& beside = "") {
  return "<root BTCPP_format=\"4\" main_tree_to_execute=\"M\">"
         "<BehaviorTree ID=\"M\">" +
         inside + "</BehaviorTree>" + beside + "</root>";
}

const std::string kTree = "<BehaviorTree ID=\"T\"><A/></BehaviorTree>";

TEST_CASE("3.8 loads what it loads, and refuses what it refuses") {
  struct File {
    std::string text;
    bool is_loaded;
  };
  const std::string two = "<SubTree ID=\"T\" name=\"n\"/>";
  for (const File& file : std::vector<File>{
           {tree3("<T/>", kTree), false},
           {tree3("<Sequence _skipIf=\"x\"><A/></Sequence>"), false},
           {tree3("<Sequence _foo=\"x\"><A/></Sequence>"), false},
           {tree3("<Sequence _autoremap=\"1\"><A/></Sequence>"), false},
           {tree3("<Sequence _description=\"x\"><A/></Sequence>"), true},
           {tree3("<SubTree ID=\"T\" _skipIf=\"x\"/>", kTree), true},
           {tree3("<Sequence>" + two + two + "</Sequence>", kTree), true},
           {tree3("<SubTree ID=\"Sequence\"/>",
                  "<BehaviorTree ID=\"Sequence\"><A/></BehaviorTree>"),
            true},
           {tree3("<A/>",
                  "<BehaviorTree><A/></BehaviorTree>"
                  "<BehaviorTree><A/></BehaviorTree>"),
            true},
           {tree3("<Sequence ID=\"x\"><A ID=\"q\"/></Sequence>"), true},
           {tree3("<A><AlwaysFailure/></A>"), true},
           {tree3("<Action ID=\"A\"><AlwaysFailure/></Action>"), false},
           {tree3("<ReactiveSequence/>"), true},
           {tree3("<ReactiveFallback/>"), true},
           {tree3("<Control ID=\"ReactiveSequence\"/>"), false},
           {tree3("<BlackboardCheckInt value_A=\"1\" value_B=\"2\" "
                  "return_on_mismatch=\"\"><A/></BlackboardCheckInt>"),
            true},
           {tree3("<Sequence/>"), false},
           {tree3("<SequenceStar/>"), false},
           {tree3("<Action ID=\"T\"/>", kTree), true},
           {tree3("<Action ID=\"T\" name=\"foo\"/>", kTree), false},
           {tree3("<SubTreePlus ID=\"T\"><A/></SubTreePlus>", kTree), true},
           {tree3("<SubTree ID=\"T\"><A/></SubTree>", kTree), false},
           {tree3("<SubTree ID=\"T.1\"/>",
                  "<BehaviorTree ID=\"T.1\"><A/></BehaviorTree>"),
            true}}) {
    CAPTURE(file.text);
    CHECK(loads(file.text, Profile::Btcpp38) == file.is_loaded);
  }
}

// 4.10 makes an int of the 5, which is no unsigned int.
TEST_CASE("a file with types that only older releases take is read for them") {
  const std::string text =
      tree4("<SubTree ID=\"T\" time=\"5\"/>",
            "<BehaviorTree ID=\"T\"><Sleep msec=\"{time}\"/></BehaviorTree>");
  CHECK(!loads(text, Profile::Btcpp410));
  CHECK(loads(text, Profile::Btcpp48));
  const auto found = said_of(text, {});
  CHECK(!has_error(found));
  REQUIRE(!found.empty());
  CHECK(found[0].code == "BT1651");
  CHECK(found[0].help == "releases up to 4.8 take it: checked as `btcpp-4.8`");
  // Two types in all releases.
  CHECK(!loads(tree4("<Sequence><Sleep msec=\"{time}\"/>"
                     "<Repeat num_cycles=\"{time}\"><A/></Repeat></Sequence>"),
               {}));
}

TEST_CASE("an entry whose type only a model tells is a warning") {
  const std::string text =
      tree4("<Sequence><Sleep msec=\"{time}\"/><A p=\"{time}\"/></Sequence>");
  for (const auto profile :
       {std::optional<Profile>(), std::optional(Profile::Btcpp410)}) {
    const auto found = said_of(text, profile);
    CHECK(!has_error(found));
    const auto warning = std::ranges::find(found, "BT1616", &Diagnostic::code);
    REQUIRE(warning != found.end());
    CHECK(warning->severity == Severity::Warning);
  }
  // It hides nothing else.
  CHECK(!loads(tree4("<Sequence><Sleep msec=\"{time}\"/><A p=\"{time}\"/>"
                     "<Sleep/></Sequence>"),
               {}));
}

TEST_CASE("an empty Script does nothing, and succeeds") {
  TreeReading reading;
  const auto read =
      read_tree("t.xml", tree4("<Script name=\"s\" code=\"\"/>"), reading);
  REQUIRE(read.value);
  const auto script = std::ranges::find(read.value->nodes, "s", &Node::name);
  REQUIRE(script != read.value->nodes.end());
  CHECK(script->contract.may_succeed);
  CHECK(!script->contract.may_fail);
  CHECK(!script->contract.may_run);
}

TEST_CASE("a newline behind a backslash is a blank before 4.9") {
  const std::string text = tree4("<Script code=\"x := 1 +\\\n 2\"/>");
  CHECK(!loads(text, Profile::Btcpp49));
  CHECK(loads(text, Profile::Btcpp48));
  CHECK(loads(text, Profile::Btcpp42));  // where another one ends the script
  CHECK(loads(text, {}));
  CHECK(!loads(tree4("<Script code=\"x := 1 + \\ 2\"/>"), Profile::Btcpp48));
}

TEST_CASE("a node of version 3 is one's own, if only version 4 has it") {
  const std::string models =
      "<TreeNodesModel><Action ID=\"Sleep\"><input_port name=\"seconds\"/>"
      "</Action></TreeNodesModel>";
  TreeReading reading;
  for (const std::string& beside : {models, std::string()}) {
    const auto read = read_tree(
        "t.xml", tree3("<Action ID=\"Sleep\" seconds=\"1\"/>", beside),
        reading);
    REQUIRE(read.value);
    CHECK(std::ranges::count(read.value->nodes, NodeType::Action,
                             &Node::type) == 1);
  }
}

TEST_CASE("of two trees with one ID version 3 keeps the first") {
  TreeReading reading;
  reading.profile = Profile::Btcpp38;
  const auto tree =
      read_tree("t.xml",
                tree3("<SubTree ID=\"T\"/>",
                      "<BehaviorTree ID=\"T\"><AlwaysFailure/></BehaviorTree>"
                      "<BehaviorTree ID=\"T\"><AlwaysSuccess/></BehaviorTree>"),
                reading);
  REQUIRE(tree.value);
  CHECK(tree.value->nodes.back().name == "AlwaysFailure");
}

TEST_CASE("nodes that stand below a leaf are none") {
  TreeReading reading;
  reading.profile = Profile::Btcpp38;
  reading.models = {{"m.xml", kModels}};
  const auto tree = read_tree(
      "t.xml",
      tree3("<Sequence><A><Sequence><A/></Sequence></A><A/></Sequence>"),
      reading);
  REQUIRE(tree.value);
  CHECK(tree.value->nodes.size() == 4);
}

TEST_CASE("what one release refuses another one loads") {
  struct File {
    std::string text;
    Profile last;   // that loads it, or the first
    Profile other;  // that does not
  };
  const std::string two = "<SubTree ID=\"T\" name=\"n\"/>";
  for (const File& file : std::vector<File>{
           {tree3("<T/>", kTree), Profile::Btcpp37, Profile::Btcpp38},
           {tree3("<Sequence _description=\"x\"><A/></Sequence>"),
            Profile::Btcpp38, Profile::Btcpp37},
           {tree3("<Parallel success_threshold=\"-1\" failure_threshold=\"1\">"
                  "<A/><A/></Parallel>"),
            Profile::Btcpp38, Profile::Btcpp37},
           {tree3("<RetryUntilSuccessful num_attempts=\"2\"><A/>"
                  "</RetryUntilSuccessful>"),
            Profile::Btcpp36, Profile::Btcpp35},
           {tree4("<A/>", "<BehaviorTree><A/></BehaviorTree>"),
            Profile::Btcpp45, Profile::Btcpp46},
           {tree4("<A/>", "<BehaviorTree ID=\"Sequence\"><A/></BehaviorTree>"),
            Profile::Btcpp45, Profile::Btcpp46},
           {tree4("<A><A/></A>"), Profile::Btcpp46, Profile::Btcpp47},
           {tree4("<Sequence>" + two + two + "</Sequence>", kTree),
            Profile::Btcpp47, Profile::Btcpp48},
           {tree4("<TryCatch><A/><A/></TryCatch>"), Profile::Btcpp49,
            Profile::Btcpp48},
           {tree4("<SkipUnlessUpdated entry=\"{x}\"><A/></SkipUnlessUpdated>"),
            Profile::Btcpp46, Profile::Btcpp45},
           {tree4("<A p=\"abc\"/>"), Profile::Btcpp44, Profile::Btcpp45},
           {tree4("<UnsetBlackboard key=\"x\"/>"), Profile::Btcpp44,
            Profile::Btcpp43},
           {tree4("<Sleep msec=\"1\"/>"), Profile::Btcpp43, Profile::Btcpp42},
           {tree4("<WhileDoElse><A/><A/></WhileDoElse>"), Profile::Btcpp43,
            Profile::Btcpp42},
           {tree4("<A _onHalted=\"x := 1\"/>"), Profile::Btcpp43,
            Profile::Btcpp42},
           {tree4("<RunOnce><A/></RunOnce>"), Profile::Btcpp42,
            Profile::Btcpp41},
           {tree4("<A _skipIf=\"true\"/>"), Profile::Btcpp41, Profile::Btcpp40},
           {tree4("<ScriptCondition code=\"i &gt; -1\"/>"), Profile::Btcpp47,
            Profile::Btcpp46}}) {
    CAPTURE(file.text);
    CHECK(loads(file.text, file.last));
    CHECK(!loads(file.text, file.other));
  }
}

TEST_CASE(
    "a file that does not say its version is of the one it is written in") {
  const auto said = [](const std::string& inside) {
    std::string all;
    for (const Diagnostic& each : said_of(tree3(inside), {})) {
      if (each.code == "BT1622") all += each.label;
    }
    return all;
  };
  CHECK(said("<A/>") == "read as version 3");
  CHECK(said("<A _skipIf=\"1\"/>") == "read as version 4");
  CHECK(said("<Script code=\"x := 1\"/>") == "read as version 4");
  CHECK(said("<Sleep/>") == "read as version 3");  // may be the program's
}

// What the first Script or SetBlackboard does on the way to the leaf.
Script first_script(const std::string& text, Profile profile) {
  TreeReading reading;
  reading.profile = profile;
  const auto tree = read_tree("t.xml", text, reading);
  REQUIRE(tree.value);
  for (const Node& node : tree.value->nodes) {
    if (!node.own_scripts.empty()) return node.own_scripts[0];
  }
  return {};
}

TEST_CASE("a SetBlackboard throws where it finds nothing to copy, up to 3.7") {
  const std::string copy =
      "<Sequence><SetBlackboard value=\"{x}\" output_key=\"y\"/>"
      "<SetBlackboard value=\"1\" output_key=\"x\"/></Sequence>";
  const auto may_lack = [](const std::string& text, Profile profile) {
    return first_script(text, profile).may_lack.has_value();
  };
  for (const Profile profile :
       {Profile::Btcpp35, Profile::Btcpp36, Profile::Btcpp37}) {
    CHECK(may_lack(tree3(copy), profile));
  }
  CHECK(!may_lack(tree3(copy), Profile::Btcpp38));
  CHECK(!may_lack(tree4(copy), Profile::Btcpp44));
  CHECK(!may_lack(tree4(copy), Profile::Btcpp47));
}

TEST_CASE("a script gives no text to a number in 4.4 and 4.5") {
  const std::string gives = "<Script code=\"x := 1; x := '2'; y := x\"/>";
  const auto may_end = [&](Profile profile) {
    return !is_never(first_script(tree4(gives), profile).may_hold);
  };
  CHECK(!may_end(Profile::Btcpp44));
  CHECK(!may_end(Profile::Btcpp45));
  CHECK(may_end(Profile::Btcpp46));
}

// `safe_any.hpp`: isType looked at the type that is held, up to 4.4.
TEST_CASE("a text before a question mark is true up to 4.4") {
  const auto told = [](const std::string& text, Profile profile) {
    const Script script = first_script(
        tree4("<ScriptCondition code=\"'" + text + "' ? true : false\"/>"),
        profile);
    return std::string(is_never(script.may_hold) ? "" : "T") +
           (is_never(script.may_fail) ? "" : "F");
  };
  for (const Profile profile : {Profile::Btcpp43, Profile::Btcpp44}) {
    CHECK(told("idle", profile) == "T");
    CHECK(told("0", profile) == "T");
    CHECK(told("", profile) == "");
  }
  for (const Profile profile : {Profile::Btcpp45, Profile::Btcpp4}) {
    CHECK(told("idle", profile) == "");
    CHECK(told("0", profile) == "F");
    CHECK(told("2x", profile) == "T");
  }
}

// `convert_impl.hpp`: before 4.7 only what a double cannot hold is refused.
TEST_CASE("an integer of more than 53 bits is a number up to 4.6") {
  const auto may_end = [](const std::string& code, Profile profile) {
    const Script script = first_script(
        tree4("<ScriptCondition code=\"" + code + "\"/>"), profile);
    return !is_never(script.may_hold) || !is_never(script.may_fail);
  };
  for (const std::string code :
       {"x := 1; x := 9007199254740992.0; (x + 1) > 2", "(~ 1e300) > 2"}) {
    CHECK(may_end(code, Profile::Btcpp46));
    CHECK(!may_end(code, Profile::Btcpp47));
    CHECK(!may_end(code, Profile::Btcpp4));
  }
}

// How many entries of a name the tree has; all names, in order.
std::vector<std::string> entries_of(const std::string& text, Profile profile) {
  TreeReading reading;
  reading.profile = profile;
  const auto tree = read_tree("t.xml", text, reading);
  REQUIRE(tree.value);
  std::vector<std::string> names = tree.value->entries;
  std::ranges::sort(names);
  return names;
}

TEST_CASE("an equal sign in braces is an entry before 4.5.2") {
  const std::string same = "<A p=\"{=}\"/>";
  using Names = std::vector<std::string>;
  CHECK(entries_of(tree4(same), Profile::Btcpp44) == Names{"="});
  CHECK(entries_of(tree4(same), Profile::Btcpp45) == Names{"p"});
  CHECK(entries_of(tree4(same), Profile::Btcpp4) == Names{"p"});
  CHECK(entries_of(tree3(same), Profile::Btcpp38) == Names{"="});
  const std::string passed =
      "<BehaviorTree ID=\"T\"><A p=\"{x}\"/>"
      "</BehaviorTree>";
  const std::string passes = "<SubTree ID=\"T\" x=\"{=}\"/>";
  CHECK(entries_of(tree4(passes, passed), Profile::Btcpp45) == Names{"="});
  CHECK(entries_of(tree4(passes, passed), Profile::Btcpp46) == Names{"x"});
}

TEST_CASE("__autoremap is about the ports of the tree up to 3.8.3") {
  const std::string inside =
      "<BehaviorTree ID=\"T\"><Sequence><A p=\"{x}\"/>"
      "<SetBlackboard output_key=\"y\" value=\"1\"/></Sequence>"
      "</BehaviorTree>";
  const std::string text = tree3(
      "<Sequence><SubTreePlus ID=\"T\" __autoremap=\"1\"/>"
      "<A p=\"{x}\"/><A p=\"{y}\"/></Sequence>",
      inside);
  CHECK(entries_of(text, Profile::Btcpp38).size() == 2);
  CHECK(entries_of(text, Profile::Btcpp37).size() == 3);  // y twice
}

TEST_CASE("up to 3.5.1 Parallel has one threshold") {
  const std::string old =
      tree3("<Parallel threshold=\"2\"><A/><A/><A/></Parallel>");
  const std::string late = tree3(
      "<Parallel success_threshold=\"2\" failure_threshold=\"1\"><A/><A/><A/>"
      "</Parallel>");
  CHECK(loads(old, Profile::Btcpp351));
  CHECK(!loads(late, Profile::Btcpp351));
  CHECK(loads(late, Profile::Btcpp35));
  CHECK(!loads(old, Profile::Btcpp35));
  CHECK(!loads(old, Profile::Btcpp38));
  CHECK(
      !loads(tree3("<Delay delay_msec=\"9\"><A/></Delay>"), Profile::Btcpp351));
  CHECK(!loads(tree3("<Parallel threshold=\"4\"><A/><A/><A/></Parallel>"),
               Profile::Btcpp351));
  CHECK(!loads(tree3("<Parallel threshold=\"-1\"><A/></Parallel>"),
               Profile::Btcpp351));
}

TEST_CASE("the retry node of 3.5 is known as it is spelt there") {
  TreeReading reading;
  for (const Profile profile :
       {Profile::Btcpp351, Profile::Btcpp35, Profile::Btcpp36}) {
    reading.profile = profile;
    const auto read = read_tree(
        "t.xml",
        tree3("<RetryUntilSuccesful num_attempts=\"2\"><AlwaysFailure/>"
              "</RetryUntilSuccesful>"),
        reading);
    REQUIRE(read.value);
    const auto retry = std::ranges::find(
        read.value->nodes, NodeType::RetryUntilSuccessful, &Node::type);
    REQUIRE(retry != read.value->nodes.end());
    CHECK(retry->repetitions == 2);
    CHECK(std::ranges::count(read.diagnostics, "BT1643", &Diagnostic::code) ==
          (profile == Profile::Btcpp36));
  }
}

TEST_CASE("a negative threshold is not below none of the children in 3.8") {
  const auto with = [](const std::string& count) {
    return tree3("<Parallel success_threshold=\"" + count +
                 "\" failure_threshold=\"1\"><A/><A/><A/></Parallel>");
  };
  CHECK(loads(with("-4"), Profile::Btcpp38));
  CHECK(!loads(with("-5"), Profile::Btcpp38));
  CHECK(loads(tree4("<Parallel success_count=\"-5\"><A/><A/><A/></Parallel>"),
              Profile::Btcpp4));
  for (const std::string& text :
       {with("-4"), with("0"),
        tree4("<Parallel success_count=\"-9\"><A/><A/><A/></Parallel>")}) {
    const auto found = said_of(text, {});
    CHECK(std::ranges::count(found, "BT1631", &Diagnostic::code) == 1);
  }
}

TEST_CASE("a file is read for the newest release that takes all of it") {
  // Until 4.8; from 4.9 on and in 4.6; from 4.7 on.
  const std::string old = "x == &quot;a&quot;";
  const std::string joined = "x := a .. b + 1";
  const std::string compared = "!a == b";
  const auto read = [](const std::vector<std::string>& scripts) {
    std::string nodes;
    for (const std::string& script : scripts) {
      nodes += "<ScriptCondition code=\"" + script + "\"/>";
    }
    return read_tree("t.xml", tree4("<Sequence>" + nodes + "</Sequence>"), {});
  };
  const auto profile_for = [&](const std::vector<std::string>& scripts) {
    const auto found = read(scripts);
    return found.value ? std::optional(found.value->profile) : std::nullopt;
  };
  CHECK(profile_for({joined}) == Profile::Btcpp4);
  CHECK(profile_for({old}) == Profile::Btcpp48);
  CHECK(profile_for({old, joined}) == Profile::Btcpp46);
  CHECK(profile_for({joined, old}) == Profile::Btcpp46);
  CHECK(profile_for({old, compared}) == Profile::Btcpp48);
  CHECK(profile_for({old, joined, compared}) == std::nullopt);
  // A mistake is told as the release has it that takes the rest.
  const auto mistaken = read({old, joined, "x := ("});
  CHECK_FALSE(mistaken.value);
  CHECK(std::ranges::count(mistaken.diagnostics, Severity::Error,
                           &Diagnostic::severity) == 1);
  CHECK(std::ranges::count(mistaken.diagnostics, "BT1651", &Diagnostic::code) ==
        1);
}

TEST_CASE("a file with such a Parallel is read for 3.5.1, and that is said") {
  const auto thresholds = [](const std::string& text) {
    TreeReading reading;
    reading.models = {{"m.xml", kModels}};
    const auto read = read_tree("t.xml", text, reading);
    REQUIRE(read.value);
    CHECK(read.value->profile == Profile::Btcpp351);
    CHECK(std::ranges::count(read.diagnostics, "BT1651", &Diagnostic::code) ==
          1);
    std::vector<int> found;
    for (const Node& node : read.value->nodes) {
      if (node.type != NodeType::Parallel) continue;
      found.push_back(node.threshold);
      found.push_back(node.failure_threshold);
    }
    return found;
  };
  CHECK(thresholds(tree3("<Sequence><Parallel threshold=\"1\"><A/><A/><A/>"
                         "</Parallel><Parallel threshold=\"3\"><A/><A/><A/>"
                         "</Parallel></Sequence>")) == std::vector{1, 3, 3, 1});
  // A node that may be one of Nav2 makes no difference.
  CHECK(thresholds(tree3("<Parallel threshold=\"1\"><A/>"
                         "<Wait duration=\"3\"/></Parallel>")) ==
        std::vector{1, 2});
  // What no release takes is refused as before.
  CHECK(!loads(
      tree3(
          "<Parallel threshold=\"1\"><A/><AlwaysSuccess q=\"1\"/></Parallel>"),
      std::nullopt));
  CHECK(
      !loads(tree4("<Parallel threshold=\"1\"><A/></Parallel>"), std::nullopt));
}

TEST_CASE("before 3.7 each file says which of its trees runs") {
  const std::string two =
      "<root><BehaviorTree ID=\"M\"><A/></BehaviorTree>" + kTree + "</root>";
  TreeReading reading;
  reading.models = {{"m.xml", kModels}};
  reading.main_tree = "M";
  const auto is_read = [&](Profile profile) {
    reading.profile = profile;
    return !has_error(read_tree("t.xml", two, reading).diagnostics);
  };
  CHECK(!is_read(Profile::Btcpp35));
  CHECK(!is_read(Profile::Btcpp36));
  CHECK(is_read(Profile::Btcpp37));
}

// "" where the release reads it.
std::string flaw(std::string_view script, int release) {
  return btcpp::parse_script(script, release).flaw;
}

TEST_CASE("operators of two groups do not mix before 4.9") {
  const auto is_script = [](std::string_view script, int release) {
    return flaw(script, release).empty();
  };
  for (const std::string_view script :
       {"i > -1", "i + 1 < n", "!a && b == 1", "x := !y && z > 0"}) {
    CAPTURE(script);
    CHECK(!is_script(script, 40602));
    CHECK(is_script(script, 40502));
    CHECK(is_script(script, 41000));
  }
  for (const std::string_view script :
       {"i > 1 && j < 2", "(i + 1) < n", "x := -1", "a && !b"}) {
    CAPTURE(script);
    CHECK(is_script(script, 40602));
  }
  for (const std::string_view script : {"!a && i > -1", "x + y & 1"}) {
    CAPTURE(script);
    CHECK(!is_script(script, 40502));
    CHECK(!is_script(script, 40804));
    CHECK(is_script(script, 40901));
  }
  CHECK(is_script("!a && (i > -1)", 40804));
  CHECK(!is_script("'a' .. b + 1", 40703));
  CHECK(is_script("'a' .. (b + 1)", 40703));
}

TEST_CASE("the grammar before 4.9") {
  CHECK(flaw("x == \"a\"", 40804) == "");
  CHECK(flaw("x == \"a\"", 40901) != "");
  CHECK(flaw("x := 1;", 40804) ==
        "`;` cannot stand at the end before BehaviorTree.CPP 4.9");
  CHECK(flaw("x := 1;", 40901) == "");
  CHECK(flaw("x := 1 y := 2", 40804) != "");
  CHECK(flaw("x := 1; y := 2", 40804) == "");
  CHECK(flaw("x := y := 1", 40804) != "");
  CHECK(flaw("x := y := 1", 40901) == "");
  CHECK(flaw("x := (y := 1)", 40804) == "");
  CHECK(flaw("a ? 1 : b ? 2 : 3", 40804) != "");
  CHECK(flaw("a ? 1 : b ? 2 : 3", 40901) == "");
  CHECK(flaw("x := +5", 40804) == "");
  CHECK(flaw("x := +5", 40901) != "");
  CHECK(flaw("@x == 1", 40502) != "");
  CHECK(flaw("@x == 1", 40602) == "");
  CHECK(flaw("'a' .. 'b'", 40502) != "");
  CHECK(flaw("x == 'ä'", 40804) != "");
}

TEST_CASE("a newline ends a script up to 4.3.7") {
  CHECK(flaw("x := 1\n?", 40201) == "");
  CHECK(flaw("x := 1\n?", 40308) != "");
  CHECK(flaw("x := (1\n+ 2)", 40201) == "");
  CHECK(flaw("x := 1;\ny := 2", 40201) != "");
  CHECK(flaw("\nx := 1", 40201) != "");
}

// "(- (- 10 3) 2)" by the operands' places: whether the left one is a number.
bool is_left_first(std::string_view script, int release) {
  const auto tree = btcpp::parse_script(script, release).tree;
  const auto& top = tree.terms[tree.statements.at(0)];
  return !tree.terms[top.operands.at(0)].operands.empty();
}

TEST_CASE("arithmetic groups to the right in 4.7 and 4.8") {
  for (const std::string_view script :
       {"10-3-2", "10-3+2", "12/3/2", "2*3/4"}) {
    CAPTURE(script);
    CHECK(is_left_first(script, 40602));
    CHECK(!is_left_first(script, 40703));
    CHECK(!is_left_first(script, 40804));
    CHECK(is_left_first(script, 40901));
  }
  CHECK(is_left_first("2*3+4", 40804));  // which still binds less
  CHECK(is_left_first("a || b && c", 40804));
  CHECK(!is_left_first("a || b && c", 40901));
}

TEST_CASE("each profile has a name, and its release a text") {
  for (std::size_t i = 0; i < kProfiles.size(); ++i) {
    const auto profile = static_cast<Profile>(i);
    CHECK(profile_named(profile_name(profile)) == profile);
  }
  CHECK(engine_release(Profile::Btcpp4) == kNewestRelease);
  CHECK(engine_release(Profile::Btcpp38) == kNewestRelease3);
  CHECK(release_text(40803) == "4.8.3");
  CHECK(!profile_named("btcpp-4.11"));
}

}  // namespace
}  // namespace btcheck::btcpp_releases_test
