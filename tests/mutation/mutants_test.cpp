// SPDX-License-Identifier: MIT
//
// What makes wrong tables, and what judges them.
#include "mutation/mutants.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>
#include <string>
#include <vector>

#include "model/btf_text.hpp"
#include "model/lowering.hpp"
#include "mutation/same_runs.hpp"
#include "temporary_folder.hpp"

namespace btcheck::mutation::mutants_test {
namespace {

Network network_of(const std::string& node, TickSemantics ticks) {
  const std::string text = "((BehaviorTree :name t :loop 1 (" + node + ")))";
  return lower(tree_of(text), ticks);
}

std::vector<Mutation> mutations_of_it(const std::string& node,
                                      TickSemantics ticks) {
  const std::string text = "((BehaviorTree :name t :loop 1 (" + node + ")))";
  const BehaviorTree tree = tree_of(text);
  const Network network = lower(tree, ticks);
  return mutations_of(tree, network, network.node_automaton[1]);
}

bool has(const std::vector<Mutation>& mutations, Operator which,
         const std::string& text) {
  return std::any_of(mutations.begin(), mutations.end(),
                     [&](const Mutation& mutation) {
                       return mutation.which == which && mutation.text == text;
                     });
}

TEST_CASE("every kind of mistake is made in the table of a Sequence") {
  const auto mutations =
      mutations_of_it("Sequence :name it (Action :name a) (Action :name b)",
                      TickSemantics::Nodes);
  std::set<Operator> kinds;
  std::set<std::string> texts;
  for (const Mutation& mutation : mutations) {
    kinds.insert(mutation.which);
    texts.insert(mutation.text);
    CHECK(mutation.edges.size() ==
          (mutation.which == Operator::SwapTargets ? 2 : 1));
  }
  CHECK(kinds.size() == kOperatorCount);
  CHECK(texts.size() == mutations.size());
  const std::string resets =
      "halt -> halted when child 1.rstatus ~= running and child 2.rstatus ~= "
      "running do self.next_seq := 1";
  CHECK(has(mutations, Operator::DropUpdate,
            resets + ": does not do self.next_seq := 1"));
  CHECK(has(mutations, Operator::OtherTarget, resets + ": leads to done"));
  CHECK(has(mutations, Operator::UpdateChild,
            "child 1 -> child 1_done do child 1.caller := self: calls child 2 "
            "instead of child 1"));
  CHECK(
      has(mutations, Operator::Interval, "tick_node -> evaluate: takes [1,2]"));
}

TEST_CASE("a sample gives every kind of mistake its turn") {
  std::vector<Mutant> mutants;
  for (int i = 0; i < 10; ++i) {
    mutants.push_back({Operator::OtherTarget, "t" + std::to_string(i), {}});
  }
  mutants.push_back({Operator::DropUpdate, "u", {}});
  std::vector<std::string> texts;
  for (const Mutant& mutant : sample_of(mutants, 4)) {
    texts.push_back(mutant.text);
  }
  CHECK(texts == std::vector<std::string>{"t0", "t3", "t6", "u"});
  CHECK(sample_of(mutants, 100).size() == 11);
}

TEST_CASE("different tables may have the same runs, or others") {
  const auto same = [](const std::string& one, const std::string& other,
                       TickSemantics ticks) {
    return have_same_runs(network_of(one, ticks), network_of(other, ticks));
  };
  const std::string child = " :name it (Action :name a)";
  for (const TickSemantics ticks :
       {TickSemantics::Root, TickSemantics::Nodes}) {
    CHECK(same("Sequence" + child, "Fallback" + child, ticks));
    CHECK(same("Sequence" + child, "Repeat :repeat 1" + child, ticks));
    CHECK(!same("Sequence" + child, "Inverter" + child, ticks));
    CHECK(!same("Sequence" + child, "Repeat :repeat 2" + child, ticks));
  }
  const Network timed = network_of("Sequence" + child, TickSemantics::Nodes);
  CHECK(!have_same_runs(timed,
                        network_of("Sequence" + child, TickSemantics::Root)));
}

TEST_CASE("a weak specification lets wrong tables live") {
  const TemporaryFolder root;
  const auto folder = root.path() / "inverter";
  std::filesystem::create_directory(folder);
  std::ofstream(folder / "i.btf") << "((BehaviorTree :name t :loop 1 (Inverter "
                                     ":name it (Action :name a))))";
  std::ofstream(folder / "i.ltl")
      << "tree \"i.btf\"\n"
         "property p: whenever a.success then it.failure within 0 ticks\n"
         "property wrong: never it.running\n";
  Specification specification = read_specification(folder);
  Judge judge(specification);
  CHECK(judge.wrong_from_the_start() ==
        std::vector<std::string>{"i.ltl: wrong"});
  specification.harnesses[0]->questions.pop_back();
  Judge milder(specification);
  const std::string edge =
      "child 1_done -> failure when child 1.caller = None and child 1.rstatus "
      "= success";
  std::vector<std::string> fates;
  for (const Mutant& mutant : mutants_of(specification)) {
    const Judgement judgement = milder.judge(mutant);
    if (mutant.text == edge + ": leads to success") {
      CHECK(judgement.fate == Fate::Killed);
      CHECK(judgement.killer == "i.ltl: p");
    }
    if (mutant.text ==
        "running -> done do self.rstatus := running: leads to success") {
      CHECK(judgement.fate == Fate::Survives);
    }
    // Nobody halts it here.
    if (mutant.text.starts_with("halted -> done")) {
      CHECK(judgement.fate == Fate::NeverTaken);
    }
    fates.push_back(mutant.text);
  }
  CHECK(std::find(fates.begin(), fates.end(), edge + ": leads to success") !=
        fates.end());
}

}  // namespace
}  // namespace btcheck::mutation::mutants_test
