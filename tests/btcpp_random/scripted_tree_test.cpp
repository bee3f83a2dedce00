// SPDX-License-Identifier: MIT
#include "btcpp_random/scripted_tree.hpp"

#include <doctest/doctest.h>

#include <set>
#include <string>
#include <string_view>

#include "btcpp_random/scripted_run.hpp"
#include "model/tree_file.hpp"

namespace btcheck::reference::scripted_tree_test {
namespace {

constexpr int kTicks = 20;

// "Sequence", "_skipIf": all tags and attributes of the text.
void add_words(const std::string& xml, std::set<std::string>& words) {
  for (std::size_t at = 0; at < xml.size(); ++at) {
    if (xml[at] != '<' && xml[at] != ' ') continue;
    const std::size_t end = xml.find_first_of("> /=\n", at + 1);
    words.insert(xml.substr(at + 1, end - at - 1));
  }
}

std::set<std::string> words_of_trees(Profile profile, World world, int count) {
  std::set<std::string> words;
  for (int seed = 1; seed <= count; ++seed) {
    add_words(random_scripted_tree(static_cast<std::uint64_t>(seed), profile,
                                   world, kTicks)
                  .xml,
              words);
  }
  return words;
}

}  // namespace

TEST_CASE("the same seed gives the same tree") {
  for (const Profile profile : {Profile::Btcpp38, Profile::Btcpp4}) {
    const ScriptedTree one =
        random_scripted_tree(7, profile, World::Scripted, kTicks);
    const ScriptedTree other =
        random_scripted_tree(7, profile, World::Scripted, kTicks);
    CHECK(one.xml == other.xml);
    CHECK(one.script == other.script);
    CHECK(one.leaves == other.leaves);
    CHECK(one.entries == other.entries);
    CHECK(one.xml !=
          random_scripted_tree(8, profile, World::Scripted, kTicks).xml);
  }
}

TEST_CASE("the script decides everything") {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const ScriptedTree made =
        random_scripted_tree(seed, Profile::Btcpp4, World::Clocked, kTicks);
    const auto tree = read_tree("t.xml", made.xml,
                                scripted_reading(Profile::Btcpp4, made.leaves));
    REQUIRE(tree.value.has_value());
    const ScriptedRun run = scripted_run(*tree.value, made.script, kTicks);
    CHECK(run.is_determined);
    CHECK(run.lines.starts_with("tick 1: root="));
  }
}

TEST_CASE("an entry that nothing has set decides, too") {
  const std::string xml =
      "<root BTCPP_format=\"4\"><BehaviorTree ID=\"T\">"
      "<Fallback><AlwaysSuccess _skipIf=\"x\"/><Script code=\"x:=1\"/>"
      "</Fallback></BehaviorTree></root>";
  const auto tree = read_tree("t.xml", xml, {});
  REQUIRE(tree.value.has_value());
  CHECK_FALSE(scripted_run(*tree.value, "", kTicks).is_determined);
}

TEST_CASE("all nodes and conditions occur") {
  for (const Profile profile : {Profile::Btcpp38, Profile::Btcpp4}) {
    const std::set<std::string> words =
        words_of_trees(profile, World::Clocked, 100);
    for (const InnerNode& node : inner_nodes(profile, World::Clocked)) {
      CAPTURE(node.id);
      CHECK(words.contains(std::string(node.id)));
    }
    for (const std::string_view node :
         {"AlwaysSuccess", "AlwaysFailure", "SubTree", "a1", "c1"}) {
      CAPTURE(node);
      CHECK(words.contains(std::string(node)));
    }
    if (profile == Profile::Btcpp38) continue;
    for (const std::string_view word :
         {"Script", "ScriptCondition", "SetBlackboard", "UnsetBlackboard",
          "Sleep", "_failureIf", "_successIf", "_skipIf", "_while", "_onHalted",
          "_onFailure", "_onSuccess", "_post", "_autoremap"}) {
      CAPTURE(word);
      CHECK(words.contains(std::string(word)));
    }
  }
}

}  // namespace btcheck::reference::scripted_tree_test
