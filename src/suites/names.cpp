// SPDX-License-Identifier: MIT
#include "suites/names.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>

#include "check/simulate/simulation.hpp"

namespace btcheck {
namespace {

constexpr std::size_t kMostLetters = 90;

// "fails", for what a test shows, and "failed", for what was before.
struct Verb {
  std::string_view word;
  std::string_view now;
  std::string_view before;
};
constexpr Verb kVerbs[] = {{"success", "succeeds", "succeeded"},
                           {"failure", "fails", "failed"},
                           {"running", "runs", "ran"},
                           {"halted", "is halted", "was halted"},
                           {"skipped", "is skipped", "was skipped"}};

const Verb& verb_of(std::string_view word) {
  return *std::ranges::find(kVerbs, word, &Verb::word);
}

class Namer {
 public:
  Namer(const BehaviorTree& tree, const Network& network)
      : tree_(tree), network_(network), names_(short_names(tree)) {}

  void name(std::vector<SuiteTest>& tests) {
    for (const SuiteTest& test : tests) {
      for (const Cell& cell : test.cells) ++cells_[cell];
      for (const std::uint32_t edge : test.edges) ++edges_[edge];
    }
    for (SuiteTest& test : tests) {
      if (test.about.empty()) test.about = subject_of(test);
      if (taken_.contains(identifier(test.about))) test.about += end_of(test);
      test.name = unique(identifier(test.about));
    }
  }

 private:
  // A cell of its own, that of the highest node; else an edge of its own.
  std::string subject_of(const SuiteTest& test) const {
    for (const Cell& cell : test.cells) {
      if (cells_.at(cell) == 1) return cell_text(test, cell);
    }
    for (const std::uint32_t edge : test.edges) {
      if (edges_.at(edge) == 1) return edge_text(edge);
    }
    return cell_text(test, *test.cells.begin());
  }

  std::string cell_text(const SuiteTest& test, const Cell& cell) const {
    const auto& [node, question] = cell;
    const std::string_view word = word_of(question);
    std::string text =
        fmt::format("{} {}", names_[index(node)], verb_of(word).now);
    if (const std::string cause = cause_of(test, node, word); !cause.empty()) {
      text += " after " + cause;
    }
    return text;
  }

  // What another leaf answered in the tick in which it first happened: the
  // last one below the node, else the last one of all that answers.
  std::string cause_of(const SuiteTest& test, NodeId node,
                       std::string_view word) const {
    for (std::size_t t = 0; t < test.ticks.size(); ++t) {
      const auto& nodes = test.ticks[t].nodes;
      const auto at = std::ranges::find(
          nodes, node, [](const auto& each) { return each.first; });
      if (at == nodes.end() || !has_word(at->second, word)) continue;
      std::string cause;
      bool is_below = false;
      for (const auto& [other, answers] : nodes) {
        if (other == node || !is_scripted(tree_.node(other).type)) continue;
        const std::string last = answers.substr(answers.rfind(',') + 1);
        const auto verb = std::ranges::find(kVerbs, last, &Verb::word);
        if (verb == std::end(kVerbs)) continue;
        const bool stands_below = stands_in(other, node);
        if (is_below && !stands_below) continue;
        is_below = stands_below;
        cause = fmt::format("{} {}", names_[index(other)], verb->before);
      }
      return t == 0 || cause.empty()
                 ? cause
                 : fmt::format("{} in tick {}", cause, t + 1);
    }
    return {};
  }

  // How it ends: what the last leaf of the last tick answered.
  std::string end_of(const SuiteTest& test) const {
    if (test.ticks.empty()) return {};
    const auto& nodes = test.ticks.back().nodes;
    for (auto at = nodes.rbegin(); at != nodes.rend(); ++at) {
      const auto& [node, answers] = *at;
      if (!is_scripted(tree_.node(node).type)) continue;
      const std::string last = answers.substr(answers.rfind(',') + 1);
      const auto verb = std::ranges::find(kVerbs, last, &Verb::word);
      if (verb == std::end(kVerbs)) continue;
      return fmt::format(", {} {} in tick {}", names_[index(node)],
                         verb->before, test.ticks.size());
    }
    return {};
  }

  static bool has_word(std::string_view answers, std::string_view word) {
    for (std::size_t begin = 0; begin <= answers.size();) {
      const std::size_t end =
          std::min(answers.find(',', begin), answers.size());
      if (answers.substr(begin, end - begin) == word) return true;
      begin = end + 1;
    }
    return false;
  }

  bool stands_in(NodeId node, NodeId above) const {
    while (!tree_.node(node).is_root()) {
      node = tree_.node(node).parent;
      if (node == above) return true;
    }
    return false;
  }

  std::string edge_text(std::uint32_t number) const {
    const Automaton& automaton = network_.owner_of_edge(number);
    const Edge& edge = network_.edge(number);
    const Location& source = automaton.source(edge);
    const Location& target = automaton.target(edge);
    const std::string& node = names_[index(automaton.node)];
    std::string text = node;
    if (is_answer(target.role) || target.role == LocationRole::Halted) {
      const auto verb = std::ranges::find(kVerbs, target.name, &Verb::word);
      text += fmt::format(" {}",
                          verb == std::end(kVerbs) ? target.name : verb->now);
    } else if (target.role == LocationRole::Call ||
               target.role == LocationRole::Called) {
      text += fmt::format(" ticks {}", names_[index(target.child)]);
    } else if (target.role == LocationRole::Error) {
      text += " throws";
    } else if (target.role == LocationRole::Halt) {
      text += " is to halt";
    } else {
      text += " goes on";
    }
    if (source.role == LocationRole::Called) {
      text += fmt::format(" after {}", names_[index(source.child)]);
    } else if (!edge.label.empty()) {
      text += fmt::format(" as {}", edge.label);
    }
    return text;
  }

  std::string unique(std::string name) {
    if (name.size() > kMostLetters) name.resize(kMostLetters);
    while (name.ends_with('_')) name.pop_back();
    std::string own = name;
    for (int i = 2; !taken_.insert(own).second; ++i) {
      own = fmt::format("{}_{}", name, i);
    }
    return own;
  }

  const BehaviorTree& tree_;
  const Network& network_;
  std::vector<std::string> names_;
  std::map<Cell, int> cells_;           // in how many tests
  std::map<std::uint32_t, int> edges_;  // likewise
  std::set<std::string> taken_;
};

}  // namespace

std::string identifier(std::string_view text) {
  std::string name;
  for (const char c : text) {
    const bool is_word = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
                         (c >= '0' && c <= '9');
    if (is_word) {
      name += c;
    } else if (!name.empty() && name.back() != '_') {
      name += '_';
    }
  }
  while (name.ends_with('_')) name.pop_back();
  if (name.empty()) return "test";
  return name[0] >= '0' && name[0] <= '9' ? "t" + name : name;
}

void name_tests(const BehaviorTree& tree, const Network& network,
                std::vector<SuiteTest>& tests) {
  Namer(tree, network).name(tests);
}

}  // namespace btcheck
