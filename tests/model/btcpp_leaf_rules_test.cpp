// SPDX-License-Identifier: MIT
//
// Leaf contracts beside an XML tree: which leaf has which, and what is wrong
// with them, to the letter.
#include <doctest/doctest.h>

#include <string>
#include <string_view>
#include <vector>

#include "model/btcpp/tree/leaf_rules.hpp"
#include "model/btcpp_text.hpp"
#include "model/tree/node_types.hpp"
#include "model/tree_file.hpp"
#include "text/wildcards.hpp"

namespace btcheck::btcpp_leaf_rules_test {
namespace {

// A tree and what is said of its contracts, but not of its nodes.
struct Contracted {
  std::optional<BehaviorTree> tree;
  std::string codes;  // "BT1021 1:12"
  std::string shown;

  const Node& node(std::string_view path) const {
    REQUIRE(tree.has_value());
    for (const Node& each : tree->nodes) {
      if (each.path == path) return each;
    }
    FAIL("no node " << path);
    return tree->nodes[0];
  }
  const LeafContract& leaf(std::string_view path) const {
    return node(path).contract;
  }
};

Contracted contracted(const std::string& xml,
                      const std::vector<std::string>& files,
                      Profile profile = Profile::Btcpp4) {
  TreeReading reading;
  reading.profile = profile;
  for (std::size_t i = 0; i < files.size(); ++i) {
    reading.leaves.push_back(
        {std::string(1, static_cast<char>('a' + i)) + ".leaves", files[i]});
  }
  auto read = read_tree("t.xml", xml, reading);
  Contracted result;
  std::vector<Diagnostic> found;
  for (Diagnostic& each : read.diagnostics) {
    if (!each.file.ends_with(".leaves")) continue;
    result.shown += render(each);
    found.push_back(std::move(each));
  }
  result.codes = codes_of(found);
  result.tree = std::move(read.value);
  return result;
}

const std::string kTree =
    "<root BTCPP_format=\"4\" main_tree_to_execute=\"Main\">"
    "<BehaviorTree ID=\"Main\"><Sequence>"
    "<Grasp name=\"grasp_cup\"/><SubTree ID=\"Move\" name=\"first\"/>"
    "<SubTree ID=\"Move\"/><AlwaysSuccess/>"
    "</Sequence></BehaviorTree>"
    "<BehaviorTree ID=\"Move\"><Sequence name=\"legs\">"
    "<Condition ID=\"IsFree\"/><Drive name=\"there\"/><Drive name=\"back\"/>"
    "</Sequence></BehaviorTree>"
    "<TreeNodesModel><Action ID=\"Grasp\"/><Action ID=\"Drive\"/>"
    "<Condition ID=\"IsFree\"/></TreeNodesModel></root>";

// Codes of one file of contracts for that tree.
std::string codes_for(const std::string& text,
                      Profile profile = Profile::Btcpp4) {
  return contracted(kTree, {text}, profile).codes;
}

bool matches_by_definition(std::string_view pattern, std::string_view text) {
  if (pattern.empty()) return text.empty();
  const std::string_view rest = pattern.substr(1);
  if (pattern[0] == '*') {
    for (std::size_t i = 0; i <= text.size(); ++i) {
      if (matches_by_definition(rest, text.substr(i))) return true;
    }
    return false;
  }
  return !text.empty() && (pattern[0] == '?' || pattern[0] == text[0]) &&
         matches_by_definition(rest, text.substr(1));
}

// The i-th word over the letters.
std::string word(std::size_t i, std::string_view letters) {
  std::string made;
  for (; i > 0; i /= letters.size() + 1) {
    const std::size_t letter = i % (letters.size() + 1);
    if (letter > 0) made += letters[letter - 1];
  }
  return made;
}

TEST_CASE("a pattern matches what its definition says, for all short ones") {
  for (std::size_t i = 0; i < 5 * 5 * 5 * 5 * 5; ++i) {
    const std::string pattern = word(i, "ab*?");
    for (std::size_t k = 0; k < 3 * 3 * 3 * 3 * 3; ++k) {
      const std::string text = word(k, "ab");
      const bool expected = matches_by_definition(pattern, text);
      if (matches_wildcard(pattern, text) == expected) continue;
      FAIL_CHECK(pattern << " on " << text);
    }
  }
  CHECK(matches_wildcard("prefix/*", "prefix/suffix"));
  CHECK(matches_wildcard("*/suffix", "a/b/suffix"));
  CHECK(!matches_wildcard("prefix/*", "my_prefix/suffix"));
  CHECK(!matches_wildcard("*/suff", "prefix/suffix"));
}

TEST_CASE("a contract is for a type, a name, or a path with wildcards") {
  const auto has_it = [&](const std::string& name, std::string_view path) {
    const auto read =
        contracted(kTree, {"(defaction " + name + " :returns (success))"});
    CAPTURE(name);
    CHECK(read.codes == "");
    return !read.leaf(path).may_fail && !read.leaf(path).may_run;
  };
  CHECK(has_it("Drive", "first/there"));
  CHECK(has_it("Drive", "first/back"));
  CHECK(has_it("there", "first/there"));
  CHECK(!has_it("there", "first/back"));
  CHECK(has_it("first/back", "first/back"));
  CHECK(!has_it("first/back", "first/there"));
  CHECK(has_it("first/*", "first/back"));
  CHECK(!has_it("first/*", "grasp_cup"));
  CHECK(has_it("\"Move::?/back\"", "Move::8/back"));
  CHECK(!has_it("Move::*", "first/back"));
  CHECK(has_it("*", "grasp_cup"));
}

TEST_CASE("what the engine brings along keeps doing what it does") {
  const auto read = contracted(kTree, {"(defaction * :returns (failure))"});
  CHECK(read.codes == "");
  CHECK(!read.leaf("grasp_cup").may_succeed);
  CHECK(read.leaf("AlwaysSuccess::13").may_succeed);
  CHECK(read.leaf("first/IsFree::5").may_succeed);  // no action
}

TEST_CASE("the first contract that matches counts, in the order of files") {
  const auto read =
      contracted(kTree, {"(defaction there :returns (failure))",
                         "(defaction Drive :returns (success))\n"
                         "(defaction first/* :returns (running))"});
  CHECK(!read.leaf("first/there").may_succeed);
  CHECK(!read.leaf("Move::8/there").may_succeed);
  CHECK(read.leaf("first/back").may_succeed);
  CHECK(read.shown ==
        "warning[BT1021]: `first/*` comes too late\n"
        "  --> b.leaves:2:12\n"
        "  |\n"
        "2 | (defaction first/* :returns (running))\n"
        "  |            ^^^^^^^ the leaves that it matches have a contract "
        "already\n"
        "  |\n"
        "  = help: the first that matches counts: write this one before "
        "a.leaves:1\n");
}

TEST_CASE("a contract that no leaf has is told with what is near") {
  CHECK(contracted(kTree, {"(defaction Dirve)"}).shown ==
        "warning[BT1021]: no Action is called `Dirve`\n"
        "  --> a.leaves:1:12\n"
        "  |\n"
        "1 | (defaction Dirve)\n"
        "  |            ^^^^^ this contract is not used\n"
        "  |\n"
        "  = help: did you mean `Drive`?\n");
  const auto help = [&](const std::string& text) {
    const std::string shown = contracted(kTree, {text}).shown;
    const std::size_t at = shown.find("  = help: ");
    return at == shown.npos ? "" : shown.substr(at + 10);
  };
  CHECK(help("(defaction IsFree)") ==
        "`IsFree` is a condition: write `defcondition`\n");
  CHECK(help("(defcondition first/there)") ==
        "`Drive` is an action: write `defaction`\n");
  CHECK(help("(defaction AlwaysSuccess)") ==
        "contracts are for leaves of your program and of Nav2, and what "
        "AlwaysSuccess does is known\n");
  CHECK(help("(defcondition \"elsewhere/*\")") ==
        "there are `IsFree`, `Move::8/IsFree::10` and `first/IsFree::5`\n");
}

TEST_CASE("results, memory and duration come from the contract") {
  const auto read = contracted(
      kTree, {"(defaction there :returns (success skipped) :answers anew)"
              "(defaction back :answers once :duration [2,5])"
              "(defcondition IsFree :returns (failure skipped))"});
  CHECK(read.codes == "");
  const LeafContract& there = read.leaf("first/there");
  CHECK(there.may_succeed);
  CHECK(!there.may_fail);
  CHECK(!there.may_run);
  CHECK(there.may_skip);
  CHECK(there.memory == LeafMemory::None);
  const Node& back = read.node("first/back");
  CHECK(back.contract.may_fail);
  CHECK(back.contract.may_run);
  CHECK(!back.contract.may_skip);
  CHECK(back.contract.memory == LeafMemory::Latched);
  REQUIRE(back.duration.has_value());
  CHECK(back.duration->min == 2);
  CHECK(back.duration->max == 5);
  CHECK(read.leaf("first/IsFree::5").may_skip);
  CHECK(!read.leaf("first/IsFree::5").may_succeed);
  CHECK(read.leaf("grasp_cup").memory == LeafMemory::Unknown);
}

TEST_CASE("what a contract does not say is as the type has it") {
  const std::string tree = tree4("<Sequence><Spin/><GoalUpdated/></Sequence>");
  const auto plain = contracted(tree, {}, Profile::Nav2Main);
  CHECK(plain.leaf("Spin::2").memory == LeafMemory::Latched);
  CHECK(plain.leaf("GoalUpdated::3").memory == LeafMemory::FirstTickFails);
  const auto read = contracted(tree,
                               {"(defaction Spin :returns (success running))"
                                "(defcondition GoalUpdated)"},
                               Profile::Nav2Main);
  CHECK(read.leaf("Spin::2").memory == LeafMemory::Latched);
  CHECK(read.leaf("GoalUpdated::3").memory == LeafMemory::FirstTickFails);
  // One that never fails cannot fail at first.
  const auto always =
      contracted(tree, {"(defcondition GoalUpdated :returns (success))"},
                 Profile::Nav2Main);
  CHECK(always.leaf("GoalUpdated::3").memory == LeafMemory::None);
}

TEST_CASE("a leaf that is only guessed to be an action may be a condition") {
  const std::string tree =
      tree4("<Sequence><IsFree/><Action ID=\"IsShut\"/></Sequence>");
  const auto read = contracted(tree, {"(defcondition IsFree)"});
  CHECK(read.codes == "");
  CHECK(read.node("IsFree::2").type == NodeType::Condition);
  CHECK(!read.leaf("IsFree::2").may_run);
  CHECK(contracted(tree, {"(defcondition IsShut)"}).codes == "BT1021 1:15");
}

TEST_CASE("mistakes are told where they stand") {
  CHECK(codes_for("(defaction)") == "BT1020 1:2");
  CHECK(codes_for("(defaction Drive") == "BT1001 1:1");
  CHECK(codes_for("(defaction Drive :returns (sucess))") == "BT1020 1:28");
  CHECK(codes_for("(defcondition IsFree :returns (running))") == "BT1020 1:32");
  CHECK(codes_for("(defaction Drive :returns success)") == "BT1020 1:27");
  CHECK(codes_for("(defaction Drive :answers twice)") == "BT1020 1:27");
  CHECK(codes_for("(defaction Drive :anwsers once)") == "BT1005 1:18");
  CHECK(codes_for("(defcondition IsFree :answers once)") == "BT1005 1:22");
  CHECK(codes_for("(defcondition IsFree :duration 3)") == "BT1005 1:22");
  CHECK(codes_for("(defaction Drive :duration [5,2])") == "BT1008 1:28");
  CHECK(codes_for("(BehaviorTree (Action :ID a))") == "BT1004 1:2");
  CHECK(codes_for("defaction") == "BT1004 1:1");
  CHECK(codes_for(std::string("a\0", 2)) == "BT1000 1:2");
}

TEST_CASE("a contract that contradicts itself or its leaf is an error") {
  CHECK(contracted(kTree, {"(defaction Drive :returns (success) :duration 2)"})
            .shown ==
        "error[BT1020]: `there` takes time but never answers running\n"
        "  --> a.leaves:1:12\n"
        "  |\n"
        "1 | (defaction Drive :returns (success) :duration 2)\n"
        "  |            ^^^^^\n"
        "  |\n"
        "  = help: delete the `:duration`, or write `:returns (... "
        "running)`\n"
        "error[BT1020]: `back` takes time but never answers running\n"
        "  --> a.leaves:1:12\n"
        "  |\n"
        "1 | (defaction Drive :returns (success) :duration 2)\n"
        "  |            ^^^^^\n"
        "  |\n"
        "  = help: delete the `:duration`, or write `:returns (... "
        "running)`\n");
  CHECK(codes_for("(defaction Grasp :returns (running) :duration 2)") ==
        "BT1020 1:12");
  CHECK(codes_for("(defaction Grasp :returns (running skipped) :duration 2)") ==
        "BT1020 1:12");
  CHECK(codes_for("(defaction Grasp :returns (failure) "
                  ":on-success ((:= x 1)))") == "BT1020 1:12");
  const std::string three =
      "<root><BehaviorTree ID=\"M\"><Grasp/></BehaviorTree></root>";
  CHECK(contracted(three, {"(defaction Grasp :returns (skipped))"},
                   Profile::Btcpp38)
            .codes == "BT1020 1:12");
  CHECK(codes_for("(defaction Grasp :returns (skipped))") == "");
}

TEST_CASE("no tree is made of contracts with an error") {
  const auto read = contracted(kTree, {"(defaction Drive :returns ())"});
  CHECK(!read.tree.has_value());
  TreeReading reading;
  reading.leaves = {{"a.leaves", ""}};
  const auto btf =
      read_tree("t.btf", "(BehaviorTree :name t (Action :ID a))", reading);
  CHECK(!btf.value.has_value());
  CHECK(codes_of(btf.diagnostics) == "BT1639 0:0");
}

TEST_CASE("effects make state variables of entries") {
  const std::string tree = tree4(
      "<Sequence><Read level=\"{level}\"/><Use _skipIf=\"level == 2\"/>"
      "</Sequence>");
  const auto plain = contracted(tree, {});
  REQUIRE(plain.tree.has_value());
  CHECK(plain.tree->variables.empty());  // the port may write it
  const auto read = contracted(
      tree, {"(defaction Read :on-success ((:= level 3) (:= mode \"auto\"))"
             " :on-failure (:= level (- level 1)))"});
  CHECK(read.codes == "");
  REQUIRE(read.tree.has_value());
  REQUIRE(read.tree->variables.size() == 2);
  CHECK(read.tree->variables[0].name == "level");
  CHECK(read.tree->variables[1].name == "mode");
  CHECK(read.tree->variables[1].states ==
        std::vector<std::string>{"unknown", "auto"});
  CHECK(read.leaf("Read::2").on_success.size() == 2);
  CHECK(read.leaf("Read::2").on_failure.size() == 1);
}

TEST_CASE("an entry of the root may have a first value") {
  const std::string tree =
      tree4("<Sequence><A _skipIf=\"level > 2\"/><B y=\"{y}\"/></Sequence>");
  const auto read =
      contracted(tree, {"(defsv level :init 5)(defsv mode :init \"a\")"
                        "(defaction A :on-success (:= level 0))"});
  CHECK(read.codes == "");
  REQUIRE(read.tree.has_value());
  REQUIRE(read.tree->variables.size() == 2);
  const StateVariable& level = read.tree->variables[0];
  CHECK(level.name == "level");
  CHECK(level.value_name(level.initial) == "5");
  const StateVariable& mode = read.tree->variables[1];
  CHECK(mode.value_name(mode.initial) == "a");
  const auto codes = [&](const std::string& text) {
    return contracted(tree, {text}).codes;
  };
  CHECK(codes("(defsv y :init 1)") == "BT1638 1:8");
  CHECK(codes("(defsv x :init 1)(defsv @x :init 2)") == "BT1011 1:25");
  CHECK(codes("(defsv x :max 1)").empty());
  CHECK(codes("(defsv x)") == "BT1006 1:8");
  CHECK(codes("(defsv x :init a)") == "BT1008 1:16");
  CHECK(codes("(defsv x :init nan)") == "BT1008 1:16");
  CHECK(codes("(defsv x :init (1))") == "BT1006 1:10 BT1010 1:16");
  CHECK(codes("(defsv a-b :init 1)") == "BT1010 1:8");
  CHECK(codes("(defsv x 3 :init 1)") == "BT1010 1:10");
  CHECK(codes("(defsv)") == "BT1010 1:2");
}

TEST_CASE("an entry that something else may write is said to be lost") {
  const std::string tree = tree4(
      "<Sequence><Read level=\"{level}\"/><Other level=\"{level}\"/>"
      "</Sequence>");
  CHECK(contracted(tree, {"(defaction Read :on-success ((:= level low)))"})
            .shown ==
        "warning[BT1638]: `level` may have any value at any time: the port "
        "`level` of Other may write it\n"
        "  --> a.leaves:1:34\n"
        "  |\n"
        "1 | (defaction Read :on-success ((:= level low)))\n"
        "  |                                  ^^^^^\n"
        "  |\n"
        "  = help: write a text in quotes, or give each leaf that may write "
        "the entry a contract that names it\n"
        "warning[BT1638]: `low` may have any value at any time: nothing in "
        "the tree writes it\n"
        "  --> a.leaves:1:40\n"
        "  |\n"
        "1 | (defaction Read :on-success ((:= level low)))\n"
        "  |                                        ^^^\n"
        "  |\n"
        "  = help: write a text in quotes, or give each leaf that may write "
        "the entry a contract that names it\n");
  // A contract that names the entry says that its leaf does not write it.
  CHECK(contracted(tree, {"(defaction Read :on-success ((:= level 1)))"
                          "(defaction Other :requires (> level 0))"})
            .codes == "");
}

TEST_CASE("enumerators are declared by name and number") {
  CHECK(codes_for("(defenum RED 1 GREEN -2)") == "");
  CHECK(codes_for("(defenum RED 1 RED 1)") == "");
  CHECK(codes_for("(defenum RED 1) (defenum RED 2)") == "BT1658 1:26");
  for (const char* wrong : {"(defenum)", "(defenum RED)", "(defenum 1 RED)",
                            "(defenum RED 1.5)", "(defenum RED 5000000000)",
                            "(defenum RED 1 GREEN)", "(defenum (RED 1))"}) {
    CAPTURE(wrong);
    CHECK(codes_for(wrong).starts_with("BT1010"));
  }
}

TEST_CASE("requirements are nested as deep as scripts can be") {
  const auto codes = [](int depth) {
    std::string text = "x";
    for (int i = 0; i < depth; ++i) text = "(~ " + text + ")";
    return codes_for("(defaction grasp_cup :requires " + text + ")");
  };
  CHECK(codes(2) == "BT1638 1:38");
  CHECK(codes(90) == "BT1638 1:302");
  CHECK(codes(300) == "BT1002 1:32");
}

TEST_CASE("what scripts cannot say is refused where it stands") {
  const auto codes = [](const std::string& requirement) {
    return codes_for("(defaction Drive :requires " + requirement + ")");
  };
  CHECK(codes("(>= x 1 2)") == "BT1009 1:29");
  CHECK(codes("(mod x 2)") == "BT1004 1:29");
  CHECK(codes("((= x 1))") == "BT1004 1:28");
  CHECK(codes("(= x \"it's\")") == "BT1008 1:33");
  CHECK(codes("(= x 1a)") == "BT1008 1:33");
  CHECK(codes("(= x a-b)") == "BT1003 1:33");
  CHECK(codes("(= x [1,2])") == "BT1003 1:33");
  CHECK(codes("(= there.rstatus success)") == "BT1014 1:31");
  CHECK(codes_for("(defaction Drive :on-success ((= x 1)))") == "BT1020 1:31");
  CHECK(codes_for("(defaction Drive :on-success ((:= x)))") == "BT1009 1:32");
}

TEST_CASE("what a leaf means is put together from all that is said of it") {
  const auto read = contracted(
      kTree, {"(defaction Drive :returns (success running) :may-be-lost no)",
              "(defaction \"Move::*/back\" :may-be-lost :may-stay)"
              "(defaction Drive :idempotent :undone-by (Park \"Main/*\"))"
              "(defcondition IsFree :asked-once no :holds-while Drive)"});
  CHECK(read.shown == "");
  const LeafContract& back = read.leaf("Move::8/back");
  CHECK(!back.may_fail);
  CHECK(back.meaning.may_be_lost == false);
  CHECK(back.meaning.may_stay == true);
  CHECK(back.meaning.idempotent == true);
  CHECK(!back.meaning.tells_only);
  CHECK(back.meaning.undone_by == std::vector<std::string>{"Park", "Main/*"});
  CHECK(!read.leaf("first/there").meaning.may_stay);
  const LeafContract& free = read.leaf("first/IsFree::5");
  CHECK(free.meaning.asked_once == false);
  CHECK(free.meaning.holds_while == std::vector<std::string>{"Drive"});
  // It does not say what a leaf answers, nor that nothing else may say it: what
  // no model tells of is what it was.
  const std::string open =
      "<root BTCPP_format=\"4\"><BehaviorTree ID=\"T\"><Look/></BehaviorTree>"
      "</root>";
  const Contracted meant =
      contracted(open, {"(defcondition Look :asked-once)"});
  CHECK(meant.shown == "");
  CHECK(meant.leaf("Look::1").may_run);
  CHECK(meant.leaf("Look::1").meaning.asked_once == true);
  CHECK(meant.node("Look::1").is_guessed);
  CHECK(!contracted(open, {"(defcondition Look)"}).leaf("Look::1").may_run);
  CHECK(contracted(kTree, {"(defaction Drive :may-be-lost)",
                           "(defaction Drive :returns (success))"})
            .shown == "");
  CHECK(codes_for("(defaction Dive :may-be-lost)") == "BT1021 1:12");
  CHECK(codes_for("(defaction Unheard :may-be-lost)") == "");
  // Nor where no leaf of its kind is there at all.
  CHECK(contracted("<root BTCPP_format=\"4\"><BehaviorTree ID=\"T\"><Sequence>"
                   "<AlwaysSuccess/></Sequence></BehaviorTree></root>",
                   {"(defaction Unheard :may-be-lost)"})
            .shown == "");
  CHECK(codes_for("(defaction Drive :asked-once)") == "BT1005 1:18");
  CHECK(codes_for("(defcondition IsFree :may-stay)") == "BT1005 1:22");
  CHECK(codes_for("(defaction Drive :may-stay perhaps)") == "BT1020 1:28");
  CHECK(codes_for("(defaction Drive :undone-by ((a)))") == "BT1020 1:30");
}

}  // namespace
}  // namespace btcheck::btcpp_leaf_rules_test
