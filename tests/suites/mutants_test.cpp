// SPDX-License-Identifier: MIT
//
// Wrong trees: each has to fail a test of the suite of the right one. A tree is
// made at random, all its nodes have names; a mutant has one type for another,
// two children in each other's place, or another number. It counts where some
// of many random scripts tells it from the right one. BTCHECK_MUTANTS says how
// many trees there are, of five mutants each.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <sstream>
#include <string>
#include <vector>

#include "explore/state/split_mix.hpp"
#include "model/tree/node_types.hpp"
#include "suites/made_suite.hpp"

namespace mutants_test {

using namespace btcheck;
using namespace btcheck::suite_tests;

constexpr int kMutantsOfTree = 5;
constexpr int kScripts = 300;
constexpr int kTicks = 12;

struct Part {
  std::string type;
  std::string attributes;
  int number = 0;  // of the name; of leaves, too
  std::vector<Part> children;
};

const std::vector<std::string> kControls = {
    "Sequence",           "Fallback", "ReactiveSequence", "ReactiveFallback",
    "SequenceWithMemory", "Parallel", "IfThenElse",       "WhileDoElse"};
const std::vector<std::string> kDecorators = {
    "Inverter",     "ForceSuccess",
    "ForceFailure", "RetryUntilSuccessful",
    "Repeat",       "KeepRunningUntilFailure"};

std::size_t below(SplitMix64& random, std::size_t count) {
  return static_cast<std::size_t>(random.next() % count);
}

std::string attributes_of(const std::string& type, SplitMix64& random) {
  const auto number = 2 + below(random, 2);
  if (type == "RetryUntilSuccessful") {
    return fmt::format(" num_attempts=\"{}\"", number);
  }
  if (type == "Repeat") return fmt::format(" num_cycles=\"{}\"", number);
  if (type == "Parallel") {
    return fmt::format(" success_count=\"{}\" failure_count=\"1\"",
                       1 + below(random, 2));
  }
  return "";
}

class TreeMaker {
 public:
  explicit TreeMaker(std::uint64_t seed) : random_(seed) {}

  Part make() { return control(0); }

 private:
  Part named(std::string type) {
    Part part{std::move(type), "", ++count_, {}};
    part.attributes = attributes_of(part.type, random_);
    return part;
  }
  Part leaf() { return {below(random_, 3) == 0 ? "c" : "a", "", ++count_, {}}; }
  Part any(int depth) {
    const std::size_t dice = below(random_, 10);
    if (depth >= 3 || dice < 5) return leaf();
    if (dice < 7) {
      Part part = named(kDecorators[below(random_, kDecorators.size())]);
      part.children.push_back(below(random_, 2) == 0 ? leaf()
                                                     : control(depth + 1));
      return part;
    }
    return control(depth + 1);
  }
  Part control(int depth) {
    Part part = named(kControls[below(random_, kControls.size())]);
    const std::size_t children =
        part.type == "IfThenElse" || part.type == "WhileDoElse"
            ? 3
            : 2 + below(random_, 2);
    for (std::size_t i = 0; i < children; ++i) {
      // What decides does not run.
      part.children.push_back(part.type == "WhileDoElse" && i == 0
                                  ? Part{"c", "", ++count_, {}}
                                  : any(depth + 1));
    }
    return part;
  }

  SplitMix64 random_;
  int count_ = 0;
};

bool is_leaf(const Part& part) { return part.children.empty(); }

std::string text_of(const Part& part, std::string& models) {
  if (is_leaf(part)) {
    models += fmt::format("<{} ID=\"{}{}\"/>",
                          part.type == "c" ? "Condition" : "Action", part.type,
                          part.number);
    return fmt::format("<{}{}/>", part.type, part.number);
  }
  std::string text = fmt::format("<{} name=\"n{}\"{}>", part.type, part.number,
                                 part.attributes);
  for (const Part& child : part.children) text += text_of(child, models);
  return text + fmt::format("</{}>", part.type);
}

std::string xml_of(const Part& root) {
  std::string models;
  const std::string tree = text_of(root, models);
  return fmt::format(
      "<root BTCPP_format=\"4\"><BehaviorTree ID=\"T\">{}</BehaviorTree>"
      "<TreeNodesModel>{}</TreeNodesModel></root>",
      tree, models);
}

std::vector<Part*> inner_parts(Part& part) {
  std::vector<Part*> parts;
  if (is_leaf(part)) return parts;
  parts.push_back(&part);
  for (Part& child : part.children) {
    for (Part* each : inner_parts(child)) parts.push_back(each);
  }
  return parts;
}

Part mutant_of(Part root, SplitMix64& random) {
  const std::vector<Part*> parts = inner_parts(root);
  Part& part = *parts[below(random, parts.size())];
  const bool is_control = part.children.size() > 1;
  if (is_control && below(random, 3) == 0) {
    const std::size_t i = below(random, part.children.size() - 1);
    std::swap(part.children[i], part.children[i + 1]);
    return root;
  }
  const std::size_t digit = part.attributes.find_first_of("0123456789");
  if (digit != std::string::npos && below(random, 2) == 0) {
    part.attributes[digit] = part.attributes[digit] == '2' ? '3' : '2';
    return root;
  }
  const auto& types = is_control ? kControls : kDecorators;
  std::string type = part.type;
  while (type == part.type ||
         ((type == "IfThenElse" || type == "WhileDoElse") &&
          part.children.size() != 3)) {
    type = types[below(random, types.size())];
  }
  part.type = type;
  part.attributes = attributes_of(type, random);
  return root;
}

// The words of each tick in one order: in which nodes were ticked is not asked.
std::vector<std::string> sorted(const std::vector<std::string>& ticks) {
  std::vector<std::string> all;
  for (const std::string& tick : ticks) {
    std::istringstream stream(tick);
    std::vector<std::string> words;
    for (std::string word; stream >> word;) words.push_back(word);
    std::ranges::sort(words);
    all.push_back(fmt::format("{}", fmt::join(words, " ")));
  }
  return all;
}

std::string random_script(const BehaviorTree& tree, SplitMix64& random) {
  static const std::vector<std::string> kAnswers = {"success", "failure",
                                                    "running"};
  std::string script;
  for (const Node& node : tree.nodes) {
    const bool is_action = node.type == NodeType::Action;
    if (!is_action && node.type != NodeType::Condition) continue;
    script += node.name + ":";
    for (int i = 0; i < 2 * kTicks; ++i) {
      script += " " + kAnswers[below(random, is_action ? 3 : 2)];
    }
    script += '\n';
  }
  return script;
}

bool are_told_apart(const MadeSuite& right, const LoweredInput& wrong,
                    SplitMix64& random) {
  for (int i = 0; i < kScripts; ++i) {
    const std::string script = random_script(right.tree(), random);
    if (sorted(played_script(right.tree(), right.network(), script, kTicks)) !=
        sorted(played_script(wrong.tree, wrong.network, script, kTicks))) {
      return true;
    }
  }
  return false;
}

bool is_killed(const MadeSuite& right, const LoweredInput& wrong) {
  return std::ranges::any_of(right.suite.tests, [&](const SuiteTest& test) {
    const std::string script = script_text(right.described, right.tree(), test);
    return sorted(played_script(wrong.tree, wrong.network, script,
                                static_cast<int>(test.ticks.size()))) !=
           sorted(expected(right, test));
  });
}

TEST_CASE("mutants fail a test of the right tree") {
  const char* asked = std::getenv("BTCHECK_MUTANTS");
  const int trees = asked != nullptr ? std::atoi(asked) : 20;
  int told_apart = 0;
  int killed = 0;
  int alike = 0;
  std::size_t tests = 0;
  for (int seed = 1; seed <= trees; ++seed) {
    const Part root = TreeMaker(static_cast<std::uint64_t>(seed)).make();
    SplitMix64 random(static_cast<std::uint64_t>(seed) * 7919);
    const bool loops = seed % 2 == 0;
    const MadeSuite right(input_of(xml_of(root), loops));
    CHECK(right.suite.left_out.empty());
    tests += right.suite.tests.size();
    for (int i = 0; i < kMutantsOfTree; ++i) {
      const std::string xml = xml_of(mutant_of(root, random));
      const auto wrong =
          lowered_input(input_of(xml, loops), {}, TickSemantics::Root);
      if (!wrong.value) continue;
      if (is_killed(right, *wrong.value)) {
        ++told_apart;
        ++killed;
      } else if (are_told_apart(right, *wrong.value, random)) {
        ++told_apart;
        MESSAGE("survives: seed " << seed << "\n"
                                  << xml_of(root) << "\n"
                                  << xml);
      } else {
        ++alike;
      }
    }
  }
  MESSAGE(killed << " of " << told_apart << " mutants fail a test; " << alike
                 << " more are told apart by no script; " << tests
                 << " tests of " << trees << " trees");
  CHECK(killed * 100 >= told_apart * 98);
}

}  // namespace mutants_test
