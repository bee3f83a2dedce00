// SPDX-License-Identifier: MIT
//
// Runs suites of `btcheck tests --to jsonl` in BehaviorTree.CPP, 4 or 3.8: what
// the generated files of GoogleTest do, compiled once for all of them.
//   run_suites [-v] [-m TREE.xml] SUITE.tests.jsonl...
// Writes a line for each: of how many bytes it is, how many tests pass, and how
// many of the answers and halts that the suite reaches the engine has reached.
// With -v, what each test that fails expected and found. A tree that the engine
// does not load, for nodes that nobody has registered, is not run. With -m, the
// tests are run in another tree, whose nodes have the same names, in whatever
// places (script/compare-mutants). Exit code 1 where a test fails.
#if defined(SUITE_RELEASE_3)
#define BTCHECK_SUITE_RELEASE 3
#endif
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "btcheck/scripted_suite.hpp"
#include "nav2_nodes.hpp"

namespace {

using btcheck::suite::Cell;
using btcheck::suite::ScriptedRun;
using btcheck::suite::Tree;
using nlohmann::json;

struct Outcome {
  std::string
      refusal;  // why the engine does not load the tree: "" where it does
  int tests = 0;
  int failed = 0;
  std::size_t reached = 0;
  std::size_t proven = 0;
  std::size_t reachable = 0;
};

Tree tree_of(const json& line) {
  Tree tree;
  tree.xml = line["xml"];
  for (const json& leaf : line["leaves"]) {
    tree.leaves.push_back({leaf["id"], leaf["is_condition"], {}});
    for (const json& port : leaf["ports"]) {
      tree.leaves.back().ports.push_back(
          {port["name"], std::string(port["direction"])[0], port["type"]});
    }
  }
  for (const json& node : line["nodes"]) {
    tree.nodes.push_back({node["key"], node["type"], node["keeps"]});
  }
  return tree;
}

// Calls written(value) with the type that the value has.
template <class Written>
void with_value(const json& value, Written written) {
  if (value.is_string()) {
    written(value.get<std::string>());
  } else if (value.is_number_integer()) {
    written(value.get<int>());
  } else {
    written(value.get<double>());
  }
}

void set_all(ScriptedRun& run, const json& writes) {
  for (const json& write : writes) {
    with_value(write["value"], [&](const auto& value) {
      run.set(write["home"], write["entry"], value);
    });
  }
}

std::string expected(const json& tick) {
  if (tick["root"] == "throws") return "throws";
  std::string text = "root=" + tick["root"].get<std::string>();
  for (const json& node : tick["nodes"]) {
    text += " " + node["node"].get<std::string>() + "=" +
            node["answers"].get<std::string>();
  }
  return text;
}

// In what order the words of a tick stand hangs on the places of the nodes.
std::vector<std::string> sorted_words(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> words{std::istream_iterator<std::string>(stream),
                                 {}};
  std::sort(words.begin(), words.end());
  return words;
}

// "" where all is as it should be.
std::string fault_of(const Tree& tree, const json& initial, const json& test,
                     bool is_other_tree) {
  ScriptedRun run(tree);
  set_all(run, initial);
  for (const json& leaf : test["leaves"]) {
    const std::string key = leaf["leaf"];
    std::size_t number = 0;
    for (const json& answer : leaf["answers"]) {
      run.leaf(key, answer["answer"]);
      ++number;
      for (const json& write : answer["writes"]) {
        with_value(write["value"], [&](const auto& value) {
          run.writes(key, number, write["home"], write["entry"], value);
        });
      }
    }
  }
  int number = 0;
  for (const json& tick : test["ticks"]) {
    ++number;
    set_all(run, tick["before"]);
    const std::string told = run.tick();
    const std::string wanted = expected(tick);
    if (told == wanted) continue;
    if (is_other_tree && sorted_words(told) == sorted_words(wanted)) continue;
    return "tick " + std::to_string(number) + "\n    expected " + wanted +
           "\n    found    " + told + "  " + run.why();
  }
  return "";
}

void add_nodes(const BT::TreeNode& node, const Tree& right, Tree& other) {
  const auto same =
      std::find_if(right.nodes.begin(), right.nodes.end(),
                   [&](const auto& each) { return each.key == node.name(); });
  if (same == right.nodes.end()) {
    throw std::runtime_error("the suite has no node " + node.name());
  }
  other.nodes.push_back({same->key, node.registrationName(), same->keeps});
  if (auto* control = dynamic_cast<const BT::ControlNode*>(&node)) {
    for (const auto* child : control->children()) {
      add_nodes(*child, right, other);
    }
  } else if (auto* decorator = dynamic_cast<const BT::DecoratorNode*>(&node)) {
    if (const auto* child = decorator->child()) add_nodes(*child, right, other);
  }
}

// The tree of a file, with the leaves and the keys of a suite.
Tree other_tree(const Tree& right, const std::string& file) {
  std::ifstream in(file);
  std::stringstream text;
  text << in.rdbuf();
  Tree other = right;
  other.xml = text.str();
  other.nodes.clear();
  BT::BehaviorTreeFactory factory;
  register_nav2_nodes(factory);
  for (const auto& leaf : right.leaves) {
    if (leaf.is_condition) {
      btcheck::suite::register_leaf<btcheck::suite::FakeCondition>(factory,
                                                                   leaf);
    } else {
      btcheck::suite::register_leaf<btcheck::suite::FakeAction>(factory, leaf);
    }
  }
  BT::Tree tree = factory.createTreeFromText(other.xml);
  add_nodes(*tree.rootNode(), right, other);
  return other;
}

Outcome outcome_of(const std::string& file, bool is_verbose,
                   const std::string& mutant) {
  std::ifstream in(file);
  std::string text;
  if (!std::getline(in, text)) throw std::runtime_error("cannot read " + file);
  const json suite = json::parse(text);
  Tree tree = tree_of(suite);
  Outcome outcome;
  outcome.proven = suite["proven"];
  btcheck::suite::reached().clear();
  try {
    if (!mutant.empty()) tree = other_tree(tree, mutant);
    const ScriptedRun trial(tree);
  } catch (const std::exception& refusal) {
    outcome.refusal = refusal.what();
    return outcome;
  }
  while (std::getline(in, text)) {
    const json test = json::parse(text);
    ++outcome.tests;
    std::string fault;
    try {
      fault = fault_of(tree, suite["initial"], test, !mutant.empty());
    } catch (const std::exception& refusal) {
      fault = std::string("the engine refuses: ") + refusal.what();
    }
    if (fault.empty()) continue;
    ++outcome.failed;
    if (is_verbose) {
      std::cout << file << ": " << test["name"].get<std::string>() << ": "
                << fault << '\n';
    }
  }
  std::map<std::string, std::size_t> numbers;
  for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
    numbers[tree.nodes[i].key] = i;
  }
  for (const json& cell : suite["reached"]) {
    ++outcome.reachable;
    outcome.reached += btcheck::suite::reached().count(
        Cell{numbers.at(cell["node"]), cell["answer"]});
  }
  return outcome;
}

}  // namespace

int main(int count, char** words) {
  btcheck::suite::more_nodes() = register_nav2_nodes;
  bool is_verbose = false;
  bool is_failed = false;
  Outcome all;
  int suites = 0;
  int refused = 0;
  std::string mutant;
  for (int i = 1; i < count; ++i) {
    const std::string word = words[i];
    if (word == "-m" && i + 1 < count) {
      mutant = words[++i];
      continue;
    }
    if (word == "-v") {
      is_verbose = true;
      continue;
    }
    const Outcome one = outcome_of(word, is_verbose, mutant);
    if (!one.refusal.empty()) {
      std::cout << word << ": not run: " << one.refusal << '\n';
      ++refused;
      continue;
    }
    std::cout << word << " (" << std::filesystem::file_size(word)
              << " bytes): " << one.tests - one.failed << " of " << one.tests
              << " tests pass, " << one.reached << " of " << one.reachable
              << " reached on the engine, " << one.proven << " proven\n"
              << std::flush;
    ++suites;
    all.tests += one.tests;
    all.failed += one.failed;
    all.reached += one.reached;
    all.reachable += one.reachable;
    all.proven += one.proven;
    is_failed = is_failed || one.failed > 0;
  }
  std::cout << suites << " suites, " << all.tests << " tests, " << all.failed
            << " fail; " << all.reached << " of " << all.reachable
            << " answers and halts reached on the engine, " << all.proven
            << " proven; " << refused << " suites not run\n";
  return is_failed ? 1 : 0;
}
