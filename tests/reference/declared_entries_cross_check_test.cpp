// SPDX-License-Identifier: MIT
//
// Declared blackboard entries: told apart by region against all their values,
// and both against the scripts as they are executed on real values.
//
// Random XML trees have contracts beside them that declare numbers. Each is
// read twice: with one value for each region, and with all of them. What both
// can reach must be the same but for the numbers; so must verdicts and
// findings, and nothing may be left undecided. In every state that can be
// reached along random walks, exactly those edges may be taken whose scripts
// come out so on the values that the entries have there, and the entries have
// them.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "check/check.hpp"
#include "model/btcpp/tree/entry_programs.hpp"
#include "model/lowering.hpp"
#include "reference/effort.hpp"
#include "reference/naive_network.hpp"
#include "reference/random_tree.hpp"

namespace btcheck::reference::declared_entries_cross_check_test {
namespace {

constexpr std::size_t kMostStates = 4000;
constexpr std::int64_t kAll = 1'000'000;

// --- Cases -------------------------------------------------------------------

struct Case {
  std::string xml;
  std::string leaves;
  std::string rules;
  std::vector<std::string> numbers;  // entries that are declared so
};

class CaseMaker {
 public:
  explicit CaseMaker(std::uint64_t seed) : random_(seed) {}

  Case make() {
    count_ = 1 + random_.below(2);
    for (int i = 0; i < count_; ++i) declare(i);
    if (random_.percent(40)) {
      made_.leaves += random_.percent(50)
                          ? "(defsv mode :states (\"auto\" \"hand\" \"off\"))\n"
                          : "(defsv mode :states (\"auto\" \"hand\" \"off\") "
                            ":transitions ((\"auto\" \"hand\") (\"hand\" "
                            "\"off\")) :moves sampled)\n";
      has_mode_ = true;
    }
    std::string nodes;
    const int children = 2 + random_.below(3);
    for (int i = 0; i < children; ++i) nodes += "      " + node(2) + "\n";
    constexpr const char* kRoots[] = {"Sequence", "ReactiveSequence",
                                      "Fallback", "ReactiveFallback"};
    const std::string root = kRoots[random_.below(4)];
    made_.xml = fmt::format(
        "<root BTCPP_format=\"4\">\n  <BehaviorTree ID=\"T\">\n    <{0}>\n{1}"
        "    </{0}>\n  </BehaviorTree>\n  <TreeNodesModel>\n{2}"
        "  </TreeNodesModel>\n</root>\n",
        root, nodes, models_);
    for (int i = 0; i < 4; ++i) {
      made_.rules += fmt::format("property p{}: {}\n", i, rule());
    }
    return std::move(made_);
  }

 private:
  void declare(int i) {
    const std::string name(1, static_cast<char>('a' + i));
    const int low = -random_.below(3);
    const int high = low + 3 + random_.below(9);
    low_.push_back(low);
    high_.push_back(high);
    std::string text =
        fmt::format("(defsv {} :min {} :max {}", name, low, high);
    if (random_.percent(75)) text += fmt::format(" :init {}", value(i));
    if (random_.percent(40)) text += " :moves free";
    made_.leaves += text + ")\n";
    made_.numbers.push_back(name);
  }

  int entry() { return random_.below(count_); }
  static std::string name_of(int i) {
    return std::string(1, static_cast<char>('a' + i));
  }
  int value(int i) {
    const auto at = static_cast<std::size_t>(i);
    return low_[at] + random_.below(high_[at] - low_[at] + 1);
  }

  std::string comparison() {
    constexpr const char* kSigns[] = {"<", "<=", ">", ">=", "==", "!="};
    const int i = entry();
    std::string left = name_of(i);
    if (random_.percent(15)) left = fmt::format("{} * 2", left);
    if (random_.percent(15)) left = fmt::format("{} + 1", left);
    const std::string number = random_.percent(15)
                                   ? fmt::format("{}.5", value(i))
                                   : fmt::format("{}", value(i));
    if (has_mode_ && random_.percent(15)) return "mode == 'hand'";
    if (count_ > 1 && random_.percent(8)) {
      return fmt::format("a {} b", kSigns[random_.below(6)]);
    }
    return fmt::format("{} {} {}", left, kSigns[random_.below(6)], number);
  }

  std::string condition() {
    std::string text = comparison();
    if (random_.percent(30)) {
      text += (random_.percent(50) ? " && " : " || ") + comparison();
    }
    return text;
  }

  static std::string escaped(std::string text) {
    for (std::size_t at = 0; at < text.size(); ++at) {
      if (text[at] == '<') text.replace(at, 1, "&lt;");
      if (text[at] == '&' && text.compare(at, 4, "&lt;") != 0) {
        text.replace(at, 1, "&amp;");
      }
    }
    return text;
  }

  std::string form() {
    constexpr const char* kSigns[] = {"<", "<=", ">", ">=", "=", "~="};
    const int i = entry();
    std::string text = fmt::format("({} {} {})", kSigns[random_.below(6)],
                                   name_of(i), value(i));
    if (random_.percent(20)) text = fmt::format("(or {} {})", text, form());
    return text;
  }

  std::string assignment() {
    const int i = entry();
    const std::string name = name_of(i);
    switch (random_.below(6)) {
      case 0:
        return fmt::format("{} := {}", name, value(i));
      case 1:
        return fmt::format("{} += 1", name);
      case 2:
        return fmt::format("{} -= 2", name);
      case 3:
        return fmt::format("{} = {} ? {} : {} - 1", name, comparison(),
                           value(i), name);
      case 4:
        return fmt::format("n := {} ? 1 : 2", condition());
      default:
        return fmt::format("{0} = {0} * 2", name);
    }
  }

  std::string effect() {
    const int i = entry();
    return random_.percent(50) ? fmt::format("(:= {} {})", name_of(i), value(i))
                               : fmt::format("(:= {0} (+ {0} 1))", name_of(i));
  }

  std::string condition_leaf() {
    const std::string id = fmt::format("C{}", ++leaves_);
    models_ += fmt::format("    <Condition ID=\"{}\"/>\n", id);
    if (random_.percent(80)) {
      made_.leaves += fmt::format(
          "(defcondition {} {} {})\n", id,
          random_.percent(65) ? ":succeeds-when" : ":requires", form());
    }
    return fmt::format("<{}/>", id);
  }

  std::string action_leaf() {
    const std::string id = fmt::format("A{}", ++leaves_);
    std::string port;
    if (random_.percent(50)) {
      const std::string name =
          has_mode_ && random_.percent(30) ? "mode" : name_of(entry());
      const bool is_told = random_.percent(80);
      models_ += fmt::format("    <Action ID=\"{}\">{}</Action>\n", id,
                             is_told ? "<output_port name=\"out\"/>" : "");
      port = fmt::format(" out=\"{{{}}}\"", name);
    } else {
      models_ += fmt::format("    <Action ID=\"{}\"/>\n", id);
    }
    if (random_.percent(60)) {
      std::string text = fmt::format("(defaction {} :answers anew", id);
      if (random_.percent(60)) text += " :returns (success failure)";
      if (port.empty() && random_.percent(50)) {
        text += fmt::format(" :on-success ({})", effect());
      }
      if (port.empty() && random_.percent(25)) {
        text += fmt::format(" :succeeds-when {}", form());
      }
      made_.leaves += text + ")\n";
    }
    return fmt::format("<{}{}/>", id, port);
  }

  std::string node(int depth) {
    const int kind = random_.below(depth > 0 ? 100 : 75);
    if (kind < 30) return condition_leaf();
    if (kind < 50) return action_leaf();
    if (kind < 70) {
      return fmt::format("<Script code=\"{}\"/>", escaped(assignment()));
    }
    if (kind < 75) {
      return fmt::format("<AlwaysSuccess _failureIf=\"{}\"/>",
                         escaped(condition()));
    }
    if (kind < 85) {
      return fmt::format("<Inverter>{}</Inverter>", node(depth - 1));
    }
    if (kind < 92) {
      const int i = entry();
      return fmt::format(
          "<Switch2 variable=\"{{{}}}\" case_1=\"{}\" case_2=\"{}\">{}{}{}"
          "</Switch2>",
          name_of(i), value(i), value(i), node(0), node(0), node(0));
    }
    return fmt::format("<Fallback>{}{}</Fallback>", node(depth - 1),
                       node(depth - 1));
  }

  std::string rule() {
    const int i = entry();
    const std::string about = fmt::format(
        "{} {} {}", name_of(i), random_.percent(50) ? "<" : ">=", value(i));
    switch (random_.below(7)) {
      case 0:
        return fmt::format("never {}", about);
      case 1:
        return fmt::format("possible root.success and {}", about);
      case 2:
        return fmt::format("[] ({} => <> root.success)", about);
      case 3:
        return fmt::format("in no tick: root.answered success and {}", about);
      case 4:
        return fmt::format("AG EF ({})", about);
      case 5:
        return "never root.failure";
      default:
        return fmt::format("always ({} or not root.success)", about);
    }
  }

  SplitMix64 random_;
  Case made_;
  int count_ = 1;
  int leaves_ = 0;
  bool has_mode_ = false;
  std::vector<int> low_;
  std::vector<int> high_;
  std::string models_;
};

// --- Reading -----------------------------------------------------------------

TreeInput input_of(const Case& of) {
  TreeInput input("random.xml", of.xml);
  input.reading.leaves = {{"random.leaves", of.leaves}};
  input.reading.profile = Profile::Btcpp4;
  return input;
}

CheckResult checked(const Case& of, std::int64_t most_whole, bool has_rules) {
  CheckOptions options;
  options.most_whole = most_whole;
  options.tries_repairs = false;
  std::vector<InputFile> rules;
  if (has_rules) rules.push_back({"random.ltl", of.rules});
  return check(input_of(of), rules, options);
}

std::string first_error(const CheckResult& result) {
  for (const Diagnostic& each : result.diagnostics) {
    if (each.severity == Severity::Error) return each.code + each.message;
  }
  return {};
}

// --- Comparing ---------------------------------------------------------------

struct Census {
  int trees = 0;
  int skipped = 0;
  int smaller = 0;
  int verdicts = 0;
  int violated = 0;
  int faults = 0;
  int findings = 0;
  std::uint64_t states = 0;
  std::uint64_t left = 0;
  std::uint64_t edges = 0;
};

// All but the numbers that are declared.
std::set<std::vector<int>> projection(const Case& of, const BehaviorTree& tree,
                                      const Network& network,
                                      const NaiveSpace& space) {
  std::vector<bool> is_number(network.variables.size());
  for (std::size_t v = 0; v < tree.variables.size(); ++v) {
    is_number[index(network.state_variable[v])] =
        std::ranges::find(of.numbers, tree.variables[v].name) !=
        of.numbers.end();
  }
  std::set<std::vector<int>> found;
  for (const NaiveState& state : space.states) {
    std::vector<int> seen;
    for (std::size_t v = 0; v < is_number.size(); ++v) {
      if (!is_number[v]) seen.push_back(state.values[v]);
    }
    found.insert(std::move(seen));
  }
  return found;
}

// What rules and findings say, as it is told.
std::vector<std::string> told(const CheckResult& result, Census& census) {
  std::vector<std::string> all;
  for (const CheckedFile& file : result.files) {
    for (const PropertyVerdict& verdict : file.verdicts) {
      REQUIRE(verdict.error == "");
      ++census.verdicts;
      census.violated += verdict.verdict == Verdict::Violated ? 1 : 0;
      all.push_back(fmt::format("{}: {} {}", verdict.property->name,
                                static_cast<int>(verdict.verdict),
                                verdict.open));
    }
    all.push_back(
        fmt::format("faults {} {}", file.has_faults, file.open_fault));
    if (!file.defaults) continue;
    for (const TreeReport& answer : file.defaults->tree) {
      all.push_back(fmt::format("tree {} {}", static_cast<int>(answer.question),
                                static_cast<int>(answer.verdict)));
    }
    std::set<std::string> findings;
    for (const TreeFinding& finding : file.findings) {
      ++census.findings;
      findings.insert(fmt::format("{} {}", finding.code, index(finding.node)));
    }
    all.insert(all.end(), findings.begin(), findings.end());
  }
  return all;
}

// Whether entries hold along a walk what their state variables say, and each
// edge may be taken exactly where its scripts come out so.
std::string flaw_of_walk(const BehaviorTree& tree, const Network& network,
                         std::uint64_t seed, Census& census) {
  const NaiveNetwork naive(network);
  SplitMix64 random(seed);
  NaiveState state = naive.initial();
  btcpp::EntryExecution values(*tree.programs);
  for (int step = 0; step < 60; ++step) {
    std::vector<std::uint32_t> takes;
    for (const std::uint32_t edge : naive.enabled(state)) {
      ++census.edges;
      btcpp::EntryExecution after = values;
      if (after.refused(network.edge(edge).scripts) == nullptr) {
        takes.push_back(edge);
      } else {
        return fmt::format("`{}` cannot be taken on real values",
                           network.edge(edge).label);
      }
    }
    if (takes.empty()) {
      if (!naive.may_wait(state)) return {};
      state = naive.waited(state);
      continue;
    }
    const std::uint32_t edge = takes[static_cast<std::size_t>(
        random.below(static_cast<int>(takes.size())))];
    values.refused(network.edge(edge).scripts);
    state = naive.after(state, network.owner_of_edge(edge), network.edge(edge));
    if (naive.is_faulty(state)) return {};  // an assignment cut short
    for (std::size_t e = 0; e < tree.programs->entries.size(); ++e) {
      const btcpp::ProgramEntry& entry = tree.programs->entries[e];
      if (!entry.limits || !entry.variable) continue;
      const VariableId held = network.state_variable[index(*entry.variable)];
      const auto at = static_cast<std::size_t>(state.value(held));
      const EntryValue& known = tree.variable(*entry.variable).values[at];
      const btcpp::ScriptValue& real = values.values()[e];
      // It began as unknown, and what was computed with it is no more.
      const bool is_open =
          known.is_any_text ||
          (known.numbers && known.numbers->least < known.numbers->greatest);
      if (is_open) continue;
      const bool is_same = known.numbers
                               ? real.kind == btcpp::ScriptKind::Number &&
                                     known.numbers->least == real.number
                           : known.text ? known.text == real.text
                                        : !real.is_something();
      if (!is_same) {
        return fmt::format("{} is {}, and not {}", entry.name, shown(real),
                           tree.variable(*entry.variable).states[at]);
      }
    }
  }
  return {};
}

std::string flaw_of(const Case& of, std::uint64_t seed, Census& census) {
  const CheckResult by_region = checked(of, 1, false);
  const CheckResult by_value = checked(of, kAll, false);
  const std::string error = first_error(by_region);
  if (!error.empty() || !first_error(by_value).empty()) {
    return "cannot be read: " + error;
  }
  const Network& network = *by_region.files[0].network;
  const Network& whole = *by_value.files[0].network;
  const auto all = naive_space(whole, kMostStates);
  if (!all) {
    ++census.skipped;
    return {};
  }
  const auto space = naive_space(network, kMostStates);
  if (!space) return "more states than with all values";
  census.states += all->states.size();
  census.left += space->states.size();
  census.smaller += space->states.size() < all->states.size() ? 1 : 0;
  if (projection(of, *by_value.tree, whole, *all) !=
      projection(of, *by_region.tree, network, *space)) {
    return "other states can be reached";
  }
  Census other;
  if (told(by_region, census) != told(by_value, other)) {
    return "another default report";
  }
  for (std::uint64_t walk = 0; walk < 3; ++walk) {
    const std::string wrong =
        flaw_of_walk(*by_region.tree, network, seed * 3 + walk, census);
    if (!wrong.empty()) return wrong;
  }
  const CheckResult rules = checked(of, 1, true);
  const CheckResult all_rules = checked(of, kAll, true);
  if (!first_error(rules).empty()) return "rules: " + first_error(rules);
  const auto here = told(rules, census);
  const auto there = told(all_rules, other);
  census.faults += rules.files[0].has_faults ? 1 : 0;
  if (here != there) {
    return fmt::format("other verdicts: {} beside {}", fmt::join(here, "; "),
                       fmt::join(there, "; "));
  }
  return {};
}

}  // namespace

TEST_CASE("declared entries answer by region as by all their values") {
  const std::uint64_t first = seed_or(1);
  const auto trees = by_effort<std::uint64_t>(150, 5000);
  Census census;
  for (std::uint64_t i = 0; i < trees; ++i) {
    const std::uint64_t seed = first * 1'000'003 + i;
    const Case made = CaseMaker(seed).make();
    ++census.trees;
    const std::string wrong = flaw_of(made, seed, census);
    if (wrong.empty()) continue;
    FAIL("seed ", seed, "\n", made.xml, made.leaves, made.rules, wrong);
  }
  MESSAGE(census.trees << " trees, " << census.skipped << " too large; "
                       << census.smaller << " spaces smaller, " << census.left
                       << " of " << census.states << " states; "
                       << census.verdicts << " verdicts, " << census.violated
                       << " violated, " << census.faults << " with faults; "
                       << census.edges << " edges executed, " << census.findings
                       << " findings");
  CHECK_COVERED(census.smaller > census.trees / 4);
  CHECK_COVERED(census.violated > census.trees / 2);
}

}  // namespace btcheck::reference::declared_entries_cross_check_test
