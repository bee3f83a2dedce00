// SPDX-License-Identifier: MIT
//
// The properties of the examples, exported and decided by others.
//
// SPIN gets the model with its claims from the same function as the command
// line. For the other two languages the readers decide what is asked of single
// states. A claim that says `possible` turned around is violated exactly when
// the property holds.
#include <doctest/doctest.h>

#include <map>
#include <string>

#include "check/check.hpp"
#include "check/export/export_model.hpp"
#include "model/btf_text.hpp"
#include "model/exported_text.hpp"
#include "reference/effort.hpp"
#include "reference/read_model.hpp"
#include "reference/spin.hpp"

namespace btcheck::reference::exported_claims_cross_check_test {
namespace {

InputFile example_file(const std::string& name) {
  return {name, example(name)};
}

// Every verdict of the engine, by the name of the property.
struct Decided {
  bool holds = false;
  bool is_turned = false;  // `possible`, which SPIN is asked the other way
};
std::map<std::string, Decided> verdicts(const InputFile& tree,
                                        const InputFile& rules) {
  const CheckResult result = check(tree, {rules}, {});
  REQUIRE(result.files.size() == 1);
  std::map<std::string, Decided> all;
  for (const PropertyVerdict& verdict : result.files[0].verdicts) {
    REQUIRE(verdict.verdict != Verdict::Undecided);
    all[verdict.property->name] = {
        verdict.verdict == Verdict::Holds,
        verdict.property->form == PropertyForm::Possible};
  }
  return all;
}

std::string model_of(const InputFile& tree, const InputFile& rules,
                     ExportFormat format) {
  ExportOptions options;
  options.format = format;
  const auto model = export_model(tree, {rules}, options);
  REQUIRE(model.value);
  return *model.value;
}

int compare_spin(const InputFile& tree, const InputFile& rules) {
  const std::string model = model_of(tree, rules, ExportFormat::Promela);
  const SpinVerifier spin(model);
  REQUIRE(spin.complaints() == "");
  int compared = 0;
  for (const auto& entry : verdicts(tree, rules)) {
    const std::string& name = entry.first;
    const Decided& ours = entry.second;
    if (!has(model, "\nltl rule_" + name + " {")) continue;
    CAPTURE(name);
    const auto theirs = spin.holds("rule_" + name);
    REQUIRE(theirs.has_value());
    CHECK(*theirs == (ours.holds != ours.is_turned));
    ++compared;
  }
  return compared;
}

// What the readers decide, `prefix` standing before a property's name.
int compare_states(const InputFile& tree, const InputFile& rules,
                   const ReadSpace& theirs, const std::string& prefix) {
  int compared = 0;
  for (const auto& entry : verdicts(tree, rules)) {
    const std::string& name = entry.first;
    const Decided& ours = entry.second;
    const auto found = theirs.always.find(prefix + name);
    if (found == theirs.always.end()) continue;
    CAPTURE(name);
    CHECK(found->second == (ours.holds != ours.is_turned));
    ++compared;
  }
  return compared;
}

constexpr std::size_t kMostStates = 100'000;

const InputFile kWeather{
    "weather.btf",
    "(defsv weather :states (Dry Wet) :transitions :all)"
    "(BehaviorTree :name t (Action :ID look :duration [2,3]))"};
const InputFile kRules{
    "weather.ltl",
    "property dry is [] (weather = Wet => <> weather = Dry)\n"
    "property ends is <> (t.success or t.failure)\n"
    "property runs is [] (look.ticked => <> look.running)\n"
    "property calm is never (weather = Wet and look.failure)\n"
    "property kept is always look.status != halt_me\n"
    "property last is possible t.success\n"
    "property none is possible (t.success and t.failure)\n"
    "property late is (not t.success) W look.success\n"};
// One assumption: with several SPIN takes minutes to translate a claim.
const InputFile kAssumed{
    "assumed.ltl",
    "assume every action eventually ends\n"
    "property dry is [] (weather = Wet => <> weather = Dry)\n"
    "property wet is <> (weather = Wet)\n"
    "property calm is never (weather = Wet and look.failure)\n"
    "property last is possible t.success\n"};

int compare_read(const InputFile& tree, const InputFile& rules) {
  const auto smv =
      read_smv_space(model_of(tree, rules, ExportFormat::Smv), kMostStates);
  REQUIRE(smv.has_value());
  const auto fiacre = read_fiacre_space(
      model_of(tree, rules, ExportFormat::Fiacre), kMostStates);
  REQUIRE(fiacre.has_value());
  return compare_states(tree, rules, *smv, "rule_") +
         compare_states(tree, rules, *fiacre, "");
}

}  // namespace

TEST_CASE("SPIN decides the exported properties as the engine does") {
  if (!spin_is_installed()) {
    MESSAGE("spin is not installed: nothing compared");
    return;
  }
  int compared = compare_spin(kWeather, kRules) +
                 compare_spin(kWeather, kAssumed) +
                 compare_spin(example_file("mars_rover.btf"),
                              example_file("mars_rover.ltl"));
  if (is_long_run()) {
    compared += compare_spin(example_file("recovery.btf"),
                             example_file("recovery.ltl"));
    compared +=
        compare_spin(example_file("train.btf"), example_file("train.ltl"));
  }
  MESSAGE(compared << " claims");
  CHECK(compared >= 14);
}

TEST_CASE("the readers decide the exported conditions as the engine does") {
  int compared = compare_read(kWeather, kRules);
  for (const std::string name :
       {"mars_rover", "recovery", "train", "roundrobin"}) {
    CAPTURE(name);
    compared +=
        compare_read(example_file(name + ".btf"), example_file(name + ".ltl"));
  }
  MESSAGE(compared << " claims");
  CHECK(compared >= 12);
}

}  // namespace btcheck::reference::exported_claims_cross_check_test
