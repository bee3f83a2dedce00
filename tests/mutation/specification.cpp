// SPDX-License-Identifier: MIT
//
// Reading is that of the program. Answering asks the same searches for nothing
// but the verdict: no run is told, no vacuity is looked for.
#include "mutation/specification.hpp"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <set>
#include <sstream>
#include <stdexcept>

#include "check/bind/remembered.hpp"
#include "check/search/engine.hpp"
#include "check/search/searched_network.hpp"
#include "check/search/searches.hpp"
#include "explore/state/step.hpp"
#include "model/lowering.hpp"
#include "model/tree/node_types.hpp"

namespace btcheck::mutation {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kMostStates = 200'000;

std::string text_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw std::runtime_error("cannot read " + file.string());
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

template <class Value>
Value value_of(Result<Value> read) {
  if (read.value) return std::move(*read.value);
  std::string what;
  for (const Diagnostic& found : read.diagnostics) what += render(found);
  throw std::runtime_error(what);
}

std::vector<AutomatonId> automata_of(const Harness& harness,
                                     const std::string& folder) {
  std::vector<AutomatonId> found;
  for (std::uint32_t i = 0; i < harness.network.automata.size(); ++i) {
    const Automaton& automaton = harness.network.automata[i];
    const std::string owner =
        automaton.kind == AutomatonKind::StateVariable
            ? std::string(kStateVariableFolder)
            : folder_of(harness.tree.node(automaton.node).type);
    if (owner == folder) found.push_back(AutomatonId{i});
  }
  return found;
}

std::vector<AutomatonId> subjects_among(const Harness& harness,
                                        const std::vector<AutomatonId>& all) {
  std::vector<AutomatonId> subjects;
  for (const AutomatonId id : all) {
    const Automaton& automaton = harness.network.automaton(id);
    if (automaton.kind != AutomatonKind::StateVariable &&
        harness.tree.node(automaton.node).name == "it") {
      subjects.push_back(id);
    }
  }
  return subjects.empty() ? all : subjects;
}

std::unique_ptr<Harness> read_harness(const fs::path& file,
                                      const std::string& folder) {
  auto harness = std::make_unique<Harness>();
  harness->file = file.filename().string();
  const std::string text = text_of(file);
  harness->properties = value_of(read_properties(file.string(), text));
  const fs::path tree = file.parent_path() / harness->properties.tree;
  harness->tree = value_of(read_btf(tree.string(), text_of(tree)));
  harness->network = lower(
      harness->tree, tick_semantics(harness->properties.ticks.value_or("root"))
                         .value_or(TickSemantics::Root));
  remember_for(harness->tree, harness->properties, harness->network);
  BoundFile bound = value_of(
      bind_properties(harness->tree, harness->network, harness->properties,
                      SourceText(file.string(), text), ExtraAssumption::None));
  for (BoundProperty& property : bound.properties) {
    BoundFile alone;
    alone.properties.push_back(std::move(property));
    alone.assumptions = bound.assumptions;
    harness->questions.push_back(std::move(alone));
  }
  harness->of_type = automata_of(*harness, folder);
  harness->subjects = subjects_among(*harness, harness->of_type);
  return harness;
}

Verdict verdict_of(SearchOutcome outcome) {
  switch (outcome) {
    case SearchOutcome::Empty:
      return Verdict::Holds;
    case SearchOutcome::Found:
      return Verdict::Violated;
    default:
      return Verdict::Undecided;
  }
}

// Of never, always and possible.
Verdict verdict_on_states(const CompiledNetwork& system,
                          const BoundProperty& bound, const Limits& limits) {
  StatePredicate sought = bound.predicate;
  if (bound.form == PropertyForm::Invariant) {
    sought.expression =
        Expression::unary(Operation::Not, std::move(sought.expression));
  }
  const SearchedNetwork searched(system);
  const StateAnswers answers =
      search_states(searched.system(), {sought}, {}, {}, limits);
  const bool wants_it = bound.form == PropertyForm::Possible;
  if (answers.met[0]) return wants_it ? Verdict::Holds : Verdict::Violated;
  if (!answers.result.is_complete) return Verdict::Undecided;
  return wants_it ? Verdict::Violated : Verdict::Holds;
}

Verdict verdict_of(const CompiledNetwork& system, const BoundFile& file) {
  const Limits limits{.max_states = kMostStates};
  const BoundProperty& bound = file.properties[0];
  const bool is_plain = file.assumptions.empty() && !bound.predicate.when_dead;
  if (is_plain && bound.form == PropertyForm::Ltl) {
    const SearchedNetwork searched(system);
    return verdict_of(
        exists_run_against(searched.system(), bound.formula, {}, limits));
  }
  if (is_plain && bound.form == PropertyForm::Timed) {
    const SearchedNetwork searched(system);
    return verdict_of(
        find_run_against(searched.system(), bound.timed, limits).outcome);
  }
  if (is_plain && asks_of_states(bound.form) &&
      bound.form != PropertyForm::DeadlockFree) {
    return verdict_on_states(system, bound, limits);
  }
  return verify(system, file, {.reduction = Reduction::None}, limits)
      .verdicts[0]
      .verdict;
}

}  // namespace

std::string folder_of(NodeType type) {
  const std::string_view name = type_name(type);
  std::string folder;
  for (std::size_t i = 0; i < name.size(); ++i) {
    const auto letter = static_cast<unsigned char>(name[i]);
    const bool follows_small =
        i > 0 && std::islower(static_cast<unsigned char>(name[i - 1])) != 0;
    if (std::isupper(letter) != 0 && follows_small) folder += '_';
    folder += static_cast<char>(std::tolower(letter));
  }
  return folder;
}

Specification read_specification(const fs::path& folder) {
  std::set<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() == ".ltl") files.insert(entry.path());
  }
  Specification specification;
  specification.name = folder.filename().string();
  for (const fs::path& file : files) {
    specification.harnesses.push_back(read_harness(file, specification.name));
  }
  return specification;
}

std::vector<Question> questions_of(const Specification& specification) {
  std::vector<Question> questions;
  for (std::size_t h = 0; h < specification.harnesses.size(); ++h) {
    const Harness& harness = *specification.harnesses[h];
    for (std::size_t q = 0; q < harness.questions.size(); ++q) {
      questions.push_back({h, q});
    }
  }
  return questions;
}

bool is_met(const Harness& harness, std::size_t question,
            const Network& network) {
  const CompiledNetwork system(network);
  const BoundFile& file = harness.questions[question];
  const Verdict expected =
      file.properties[0].property->expectation == Expectation::Violated
          ? Verdict::Violated
          : Verdict::Holds;
  return verdict_of(system, file) == expected;
}

}  // namespace btcheck::mutation
