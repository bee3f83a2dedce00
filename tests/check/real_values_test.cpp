// SPDX-License-Identifier: MIT
//
// What is found in trees of scripts is what the scripts' own arithmetic does:
// random trees, run once more by a naive engine that shares nothing but the
// text.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <optional>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "check/check.hpp"
#include "model/script_engine.hpp"

namespace btcheck::real_values_test {
namespace {

using script_engine::Blackboard;
using script_engine::joined;
using script_engine::literal;
using script_engine::named;
using script_engine::Script;
using script_engine::Thrown;
using script_engine::Value;

// A node, and how it is told in XML.
struct Node {
  std::string id;  // Sequence, Fallback, Inverter, ForceSuccess, Script, …
  std::string name;
  Script script;  // of a Script or ScriptCondition
  std::vector<Node> children;
};

std::string escaped(const std::string& script) {
  std::string all;
  for (const char c : script) {
    all += c == '<' ? "&lt;" : c == '&' ? "&amp;" : std::string(1, c);
  }
  return all;
}

std::string xml_of(const Node& node) {
  std::string text = "<" + node.id + " name=\"" + node.name + "\"";
  if (node.children.empty()) {
    return text + " code=\"" + escaped(node.script.text()) + "\"/>\n";
  }
  text += ">\n";
  for (const Node& child : node.children) text += xml_of(child);
  return text + "</" + node.id + ">\n";
}

// `never a < 3`, and what the values of the entries make of it.
struct ValueRule {
  std::string condition;
  bool holds(const Blackboard& board) const {
    const auto one = board.find(left);
    const auto other = board.find(right);
    const bool is_entry = right[0] < '0' || right[0] > '9';
    const bool are_there =
        one != board.end() && (!is_entry || other != board.end());
    if (!are_there) return sign == "!=";
    const double value = number_of(one->second);
    const double limit = is_entry ? number_of(other->second) : std::stod(right);
    if (sign == "<") return value < limit;
    if (sign == ">=") return value >= limit;
    return (value == limit) == (sign == "==");
  }

  std::string left;
  std::string sign;
  std::string right;

 private:
  // Also of an integer that a script may not read.
  static double number_of(const Value& value) {
    const auto* integer = std::get_if<std::int64_t>(&value);
    return integer ? static_cast<double>(*integer) : std::get<double>(value);
  }
};

class Writer {
 public:
  explicit Writer(unsigned seed) : random_(seed) {}

  // What is executed once, at the beginning.
  std::vector<Script> first() {
    std::vector<Script> all;
    for (const char* name : {"a", "b", "c"}) {
      all.push_back(joined(":=", {named(name), constant()}));
    }
    return all;
  }

  Node body() { return inner(0); }

  // Over entries of these names; what is written in a rule is an integer.
  std::vector<ValueRule> rules(const std::vector<std::string>& entries) {
    std::vector<ValueRule> all;
    for (const std::string& left : entries) {
      for (int i = 0; i < 3; ++i) {
        const bool is_entry = entries.size() > 1 && below(4) == 0;
        const std::string right =
            is_entry ? entries[static_cast<std::size_t>(
                           below(static_cast<int>(entries.size())))]
                     : std::to_string(below(one_of({5, 12, 40, 300})));
        const auto sign = one_of<std::string>({"==", "==", "!=", "<", ">="});
        all.push_back({left + " " + sign + " " + right, left, sign, right});
      }
    }
    return all;
  }

 private:
  int below(int end) {
    return static_cast<int>(random_() % static_cast<unsigned>(end));
  }
  template <class T>
  T one_of(std::initializer_list<T> all) {
    return *(all.begin() + below(static_cast<int>(all.size())));
  }

  Script constant() {
    if (below(12) == 0) return literal(one_of({0.5, 2.5, 7.0}));
    const int most = one_of({3, 10, 40, 300});
    return literal(std::int64_t{below(most + 1)});
  }
  Script name() { return named(one_of<std::string>({"a", "b", "c"})); }
  Script operand() { return below(3) == 0 ? constant() : name(); }

  Script number(int depth) {
    if (depth == 0 || below(3) == 0) return operand();
    if (below(6) == 0) {
      return joined(one_of<std::string>({"*", "/"}),
                    {number(depth - 1), literal(std::int64_t{below(5)})});
    }
    return joined(one_of<std::string>({"+", "-"}),
                  {number(depth - 1), operand()});
  }

  Script statement() {
    switch (below(6)) {
      case 0:
      case 1:
        return joined(one_of<std::string>({"+=", "-="}),
                      {name(), literal(std::int64_t{1 + below(4)})});
      case 2:
        return joined(
            one_of<std::string>({"+=", "-=", "*=", "/="}),
            {name(), below(2) == 0 ? literal(std::int64_t{2}) : operand()});
      case 3:
        return joined("?", {condition(0), assignment(), assignment()});
      default:
        return assignment();
    }
  }
  Script assignment() { return joined(":=", {name(), number(1)}); }

  Script condition(int depth) {
    if (depth > 0 && below(3) == 0) {
      return joined(one_of<std::string>({"&&", "||"}),
                    {condition(depth - 1), condition(depth - 1)});
    }
    if (below(25) == 0) return name();  // no truth value, as a rule
    Script chain = joined("cmp", {number(1), number(1)});
    chain.chain.push_back(
        one_of<std::string>({"==", "!=", "<", "<=", ">", ">=", ">", "<"}));
    return chain;
  }

  Node leaf() {
    const std::string name = "n" + std::to_string(++count_);
    return below(2) == 0 ? Node{"Script", name, statement(), {}}
                         : Node{"ScriptCondition", name, condition(1), {}};
  }

  Node inner(int depth) {
    if (depth > 2 || (depth > 0 && below(3) > 0)) return leaf();
    Node node{one_of<std::string>({"Sequence", "Sequence", "Fallback",
                                   "Inverter", "ForceSuccess"}),
              "n" + std::to_string(++count_),
              {},
              {}};
    const bool is_decorator = node.id[0] == 'I' || node.id[1] == 'o';
    const int children = is_decorator ? 1 : 2 + below(2);
    for (int i = 0; i < children; ++i)
      node.children.push_back(inner(depth + 1));
    return node;
  }

  std::mt19937 random_;
  int count_ = 0;
};

// The first tick in which each leaf has answered so, of all there are.
struct Known {
  std::map<std::string, int> first_success;
  std::map<std::string, int> first_failure;
  std::map<std::string, int> first_true;  // of the rules over values
  std::optional<int> thrown;              // the tick in which the engine throws
  bool is_whole = false;                  // nothing new comes later
};

class NaiveRun {
 public:
  NaiveRun(const std::vector<Script>& first, const Node& body,
           const std::vector<ValueRule>& rules)
      : first_(first), body_(body), rules_(rules) {}

  Known run(int most_ticks) {
    std::set<Blackboard> seen;
    look();
    for (tick_ = 1; tick_ <= most_ticks; ++tick_) {
      try {
        if (tick_ == 1) {
          for (const Script& each : first_) script_engine::run(each, board_);
          look();
        }
        succeeds(body_);
      } catch (const Thrown&) {
        known_.thrown = tick_;
        known_.is_whole = true;
        return known_;
      }
      if (!seen.insert(board_).second) {
        known_.is_whole = true;
        return known_;
      }
    }
    return known_;
  }

 private:
  bool succeeds(const Node& node) {
    if (node.id == "Inverter") return !succeeds(node.children[0]);
    if (node.id == "ForceSuccess") return succeeds(node.children[0]), true;
    if (!node.children.empty()) {
      const bool is_fallback = node.id == "Fallback";
      for (const Node& child : node.children) {
        if (succeeds(child) == is_fallback) return is_fallback;
      }
      return !is_fallback;
    }
    const Value value = script_engine::run(node.script, board_);
    look();
    const bool is_true = node.id == "Script" || script_engine::as_truth(value);
    auto& answers = is_true ? known_.first_success : known_.first_failure;
    answers.emplace(node.name, tick_);
    return is_true;
  }

  void look() {
    for (std::size_t i = 0; i < rules_.size(); ++i) {
      if (!rules_[i].holds(board_)) continue;
      known_.first_true.emplace(std::to_string(i), tick_);
    }
  }

  const std::vector<Script>& first_;
  const Node& body_;
  const std::vector<ValueRule>& rules_;
  Blackboard board_;
  Known known_;
  int tick_ = 0;
};

void add_leaves(const Node& node, std::vector<std::string>& names) {
  if (node.children.empty()) names.push_back(node.name);
  for (const Node& child : node.children) add_leaves(child, names);
}

int ticks_of(const Run& run) {
  int ticks = 0;
  for (const RunStep& step : run.steps) ticks += step.step.elapsed;
  return ticks;
}

struct Counts {
  int trees = 0;
  int rules = 0;
  int violated = 0;
  int undecided = 0;
  int latest = 0;  // the greatest tick of a violation
  int thrown = 0;
};

class Trial {
 public:
  Trial(unsigned seed, Counts& counts)
      : writer_(seed),
        first_(writer_.first()),
        body_(writer_.body()),
        counts_(counts) {}

  void run() {
    std::string once;
    for (const Script& each : first_) once += each.text() + "; ";
    const std::string xml =
        "<root BTCPP_format=\"4\" main_tree_to_execute=\"T\">\n"
        "<BehaviorTree ID=\"T\">\n<Sequence name=\"top\">\n<RunOnce "
        "name=\"once\"><Script name=\"first\" code=\"" +
        once + "\"/></RunOnce>\n<ForceSuccess name=\"force\">\n" +
        xml_of(body_) + "</ForceSuccess>\n</Sequence>\n</BehaviorTree></root>";
    CAPTURE(xml);
    std::vector<std::string> leaves;
    add_leaves(body_, leaves);
    std::string rules;
    for (const std::string& leaf : leaves) {
      rules += "property s_" + leaf + ": never " + leaf + ".success\n";
      rules += "property f_" + leaf + ": never " + leaf + ".failure\n";
    }
    TreeInput tree("t.xml", xml);
    tree.reading.loops = true;
    const auto value_rules = writer_.rules(entries_of(tree));
    for (std::size_t i = 0; i < value_rules.size(); ++i) {
      rules += "property v_" + std::to_string(i) + ": never " +
               value_rules[i].condition + "\n";
    }
    CAPTURE(rules);
    CheckOptions options;
    options.limits.max_states = 300'000;
    const CheckResult result = check(tree, {{"t.ltl", rules}}, options);
    ++counts_.trees;
    if (result.files.empty()) {  // refused: `a` has two types, and the like
      --counts_.trees;
      return;
    }
    const Known known = NaiveRun(first_, body_, value_rules).run(2500);
    if (known.thrown) ++counts_.thrown;
    for (const PropertyVerdict& verdict : result.files[0].verdicts) {
      compare(verdict, known, result);
    }
    compare_faults(result.files[0], known);
  }

 private:
  // Those that rules can name.
  static std::vector<std::string> entries_of(const TreeInput& tree) {
    std::vector<std::string> names;
    const auto read = read_tree(tree.name, tree.text, tree.reading);
    if (!read.value) return names;
    for (const StateVariable& entry : read.value->variables) {
      names.push_back(entry.name);
    }
    return names;
  }

  void compare(const PropertyVerdict& verdict, const Known& known,
               const CheckResult& result) {
    const std::string& rule = verdict.property->name;
    CAPTURE(rule);
    ++counts_.rules;
    const auto& answers = rule[0] == 'v'   ? known.first_true
                          : rule[0] == 's' ? known.first_success
                                           : known.first_failure;
    const auto found = answers.find(rule.substr(2));
    const bool happens = found != answers.end();
    CHECK(verdict.error == "");
    switch (verdict.verdict) {
      case Verdict::Holds:
        CHECK_FALSE(happens);
        break;
      case Verdict::Violated:
        ++counts_.violated;
        REQUIRE((happens || !known.is_whole));
        if (!happens) break;
        CHECK(ticks_of(*verdict.run) == found->second);
        counts_.latest = std::max(counts_.latest, found->second);
        break;
      case Verdict::Undecided:
        ++counts_.undecided;
        if (verdict.stopped == StopReason::MaxStates) break;
        CHECK(verdict.stopped == StopReason::OpenEntries);
        CHECK(verdict.open != "");
        CHECK((names_open_entries(result) || names_comparison(verdict)));
        break;
    }
  }

  static void compare_faults(const CheckedFile& file, const Known& known) {
    if (file.has_faults) CHECK((known.thrown || !known.is_whole));
    const bool is_stopped = std::any_of(
        file.verdicts.begin(), file.verdicts.end(), [](const auto& verdict) {
          return verdict.stopped == StopReason::MaxStates;
        });
    const bool is_told = file.has_faults || !file.open_fault.empty();
    if (known.thrown && !is_stopped) CHECK(is_told);
  }

  // "whether `a < 3` is not known …".
  static bool names_comparison(const PropertyVerdict& verdict) {
    return verdict.open.find("whether `") != std::string::npos;
  }

  static bool names_open_entries(const CheckResult& result) {
    for (const Diagnostic& found : result.diagnostics) {
      if (found.code == "BT1640") return true;
    }
    return false;
  }

  Writer writer_;
  std::vector<Script> first_;
  Node body_;
  Counts& counts_;
};

TEST_CASE("no run is shown that the scripts' arithmetic refutes") {
  const auto number_in = [](const char* variable, unsigned otherwise) {
    const char* text = std::getenv(variable);
    return text ? static_cast<unsigned>(std::atoi(text)) : otherwise;
  };
  const bool is_long = std::getenv("BTCHECK_LONG") != nullptr;
  const unsigned trees = number_in("BTCHECK_TREES", is_long ? 20'000 : 100);
  const unsigned begin = number_in("BTCHECK_FIRST_SEED", 0);
  Counts counts;
  for (unsigned seed = begin; seed < begin + trees; ++seed) {
    CAPTURE(seed);
    Trial(seed, counts).run();
  }
  MESSAGE(counts.trees << " trees, " << counts.rules << " rules, "
                       << counts.violated << " violated, the last in tick "
                       << counts.latest << ", " << counts.undecided
                       << " undecided; " << counts.thrown << " throw");
  if (begin != 0) return;  // other seeds may have others
  CHECK(counts.violated > counts.rules / 10);
  CHECK(counts.undecided * 10 < counts.rules);
}

}  // namespace
}  // namespace btcheck::real_values_test
