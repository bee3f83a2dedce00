// SPDX-License-Identifier: MIT
//
// The two languages, compared by verdicts.
//
// Random .btf trees of the types that section 7 of docs/semantics.md calls the
// same are written as XML, and that as .btf again. Under one tick of the root
// for one of the other, rules about the root and the leaves, about their ticks
// and about time must have the same verdict on all three. The two have nothing
// in common but the searches: other drawings, after another author's text.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "check/check.hpp"
#include "model/export/conversion.hpp"
#include "model/tree_file.hpp"
#include "reference/effort.hpp"
#include "reference/random_tree.hpp"

namespace btcheck::reference::conversion_cross_check_test {
namespace {

class TreeMaker {
 public:
  explicit TreeMaker(SplitMix64& random) : random_(random) {}

  std::string text(bool loops) {
    return fmt::format("(BehaviorTree :name t{} {})\n", loops ? " :loop 1" : "",
                       control(2 + random_.below(6), 4));
  }
  const std::vector<std::string>& actions() const { return actions_; }
  const std::vector<std::string>& conditions() const { return conditions_; }

 private:
  std::string node(int budget, int depth) {
    return budget <= 1 || depth == 0 ? leaf() : control(budget, depth);
  }

  std::string control(int budget, int depth) {
    constexpr std::array<const char*, 9> kTypes = {
        "Sequence",     "Fallback",     "PipelineSequence",        "Inverter",
        "ForceSuccess", "ForceFailure", "KeepRunningUntilFailure", "Timeout",
        "Recovery"};
    const auto kind = static_cast<std::size_t>(random_.below(9));
    std::string text = fmt::format("({}", kTypes[kind]);
    int children = 1;
    if (kind < 3) children = 1 + random_.below(std::min(3, budget));
    if (kind == 7) text += fmt::format(" :duration {}", 1 + random_.below(3));
    if (kind == 8) {
      children = 2;
      text += fmt::format(" :num_retries {}", random_.below(3));
    }
    for (int i = 0; i < children; ++i) {
      text += " " + node((budget - 1) / children, depth - 1);
    }
    return text + ")";
  }

  std::string leaf() {
    const int kind = random_.below(10);
    if (kind == 0) return fmt::format("(Wait :duration {})", random_.below(3));
    auto& names = kind < 4 ? conditions_ : actions_;
    names.push_back(fmt::format("{}{}", kind < 4 ? "C" : "A", ++leaves_));
    return fmt::format("({} :ID {})", kind < 4 ? "Condition" : "Action",
                       names.back());
  }

  SplitMix64& random_;
  std::vector<std::string> actions_;
  std::vector<std::string> conditions_;
  int leaves_ = 0;
};

// Of every kind, over two leaves.
std::string rules_of(const TreeMaker& tree, SplitMix64& random) {
  std::vector<std::string> leaves = tree.actions();
  leaves.insert(leaves.end(), tree.conditions().begin(),
                tree.conditions().end());
  std::vector<std::string> rules = {"possible root.success",
                                    "possible root.failure",
                                    "possible root.running",
                                    "eventually root.ended",
                                    "AG EF root.ended",
                                    "always eventually tick.ends",
                                    "never stuck",
                                    "deadlockfree",
                                    "<> root.ended or [] <> root.running"};
  const auto one = [&](const std::vector<std::string>& of) {
    return of[static_cast<std::size_t>(
        random.below(static_cast<int>(of.size())))];
  };
  for (int i = 0; i < 3 && !leaves.empty(); ++i) {
    const std::string a = one(leaves);
    const std::string b = one(leaves);
    for (const char* const form :
         {"possible {0}.failure", "never {0}.success and not {1}.done",
          "{0}.success before {1}.ticked", "{0}.failure forbids {1}.success",
          "in no tick: {0}.answered failure and {1}.answered success",
          "every tick: {0}.answer != none => {1}.answer != none",
          "in some tick: root.answered failure and {0}.answered success",
          "absent root.failure after {0}.success",
          "whenever {0}.failure then {1}.ticked within 1 tick",
          "whenever {0}.success then root.success within 0 ticks",
          "always eventually {0}.ticked"}) {
      rules.push_back(fmt::format(fmt::runtime(form), a, b));
    }
    if (tree.actions().empty()) continue;
    const std::string c = one(tree.actions());
    rules.push_back(fmt::format("possible {}.halted", c));
    rules.push_back(fmt::format(
        "in no tick: {}.answered running and {}.answered failure", c, a));
    rules.push_back(fmt::format(
        "whenever {}.running then {}.ticked or {}.halted within [1,1]", c, c,
        c));
  }
  std::string text;
  for (std::size_t i = 0; i < rules.size(); ++i) {
    text += fmt::format("property p{}: {}\n", i, rules[i]);
  }
  return text;
}

// What an action of XML has answered stands until it is reset, unless this is
// said.
std::string contracts_of(const TreeMaker& tree) {
  std::string text;
  for (const std::string& action : tree.actions()) {
    text += fmt::format("(defaction {} :answers anew)\n", action);
  }
  return text;
}

std::vector<Verdict> verdicts_of(const TreeInput& tree,
                                 const std::string& rules) {
  CheckOptions options;
  options.tries_repairs = false;
  const CheckResult result = check(tree, {{"rules.ltl", rules}}, options);
  if (result.is_broken || result.files.size() != 1) {
    const auto error = std::ranges::find(result.diagnostics, Severity::Error,
                                         &Diagnostic::severity);
    FAIL(tree.text,
         error == result.diagnostics.end() ? "no error" : render(*error));
  }
  std::vector<Verdict> verdicts;
  for (const PropertyVerdict& each : result.files[0].verdicts) {
    REQUIRE(each.error == "");
    verdicts.push_back(each.verdict);
  }
  return verdicts;
}

std::string line_of_rule(const std::string& rules, std::size_t number) {
  std::size_t at = 0;
  for (; number > 0; --number) at = rules.find('\n', at) + 1;
  return rules.substr(at, rules.find('\n', at) - at);
}

}  // namespace

TEST_CASE("a tree has the same verdicts in both languages") {
  const std::uint64_t seed = seed_or(1);
  const auto trees = by_effort<std::uint64_t>(75, 1500);
  int rules_asked = 0;
  int violated = 0;
  for (std::uint64_t i = 0; i < trees; ++i) {
    SplitMix64 random(seed * 1'000'000 + i);
    const bool loops = random.percent(50);
    TreeMaker maker(random);
    const std::string text = maker.text(loops);
    const std::string rules = rules_of(maker, random);
    const auto tree = read_btf("t.btf", text);
    REQUIRE(tree.value);
    const auto xml = xml_text(*tree.value, SourceText("t.btf", text), 100);
    REQUIRE(xml.value);
    TreeReading reading;
    reading.profile = Profile::Nav2Jazzy;
    reading.leaves = {{"t.leaves", contracts_of(maker)}};
    reading.loops = loops;
    const TreeInput converted({"t.xml", *xml.value}, reading);
    const auto engine = read_tree("t.xml", *xml.value, reading);
    REQUIRE(engine.value);
    const auto back =
        btf_text(*engine.value, SourceText("t.xml", *xml.value), 100);
    REQUIRE(back.value);
    TreeReading again;
    again.loops = loops;
    CAPTURE(text);
    CAPTURE(*xml.value);
    CAPTURE(*back.value);
    const auto expected = verdicts_of(TreeInput("t.btf", text), rules);
    const auto of_xml = verdicts_of(converted, rules);
    const auto of_back =
        verdicts_of(TreeInput({"back.btf", *back.value}, again), rules);
    for (std::size_t r = 0; r < expected.size(); ++r) {
      CAPTURE(line_of_rule(rules, r));
      REQUIRE(of_xml[r] == expected[r]);
      REQUIRE(of_back[r] == expected[r]);
      ++rules_asked;
      violated += expected[r] == Verdict::Violated;
    }
  }
  MESSAGE(trees << " trees, " << rules_asked << " rules, " << violated
                << " violated");
  CHECK_COVERED(violated * 5 > rules_asked);
}

}  // namespace btcheck::reference::conversion_cross_check_test
