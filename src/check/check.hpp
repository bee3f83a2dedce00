// SPDX-License-Identifier: MIT
//
// The run on one screen: texts in, verdicts out.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "check/bind/bound_property.hpp"
#include "check/bind/verdict.hpp"
#include "check/counts.hpp"
#include "check/findings/judgement.hpp"
#include "check/questions/defaults.hpp"
#include "check/search/engine.hpp"
#include "check/tick_reading.hpp"
#include "explore/search/reachability.hpp"
#include "explore/state/limits.hpp"
#include "ltl/rules/property.hpp"
#include "model/automata/network.hpp"
#include "model/sampling.hpp"
#include "model/tree_file.hpp"
#include "text/diagnostic.hpp"
#include "text/input_file.hpp"

namespace btcheck {

// A tree, and how it is to be read.
struct TreeInput : InputFile {
  TreeInput() = default;
  TreeInput(InputFile file, TreeReading how = {})
      : InputFile(std::move(file)), reading(std::move(how)) {}
  TreeInput(std::string file, FileText content)
      : InputFile{std::move(file), std::move(content)} {}

  TreeReading reading;
};

struct CheckResult;

struct CheckOptions {
  std::optional<TickSemantics> ticks;  // overrides what property files say
  SearchChoices choices = {.components = std::make_shared<ComponentStore>()};
  ExtraAssumption extra = ExtraAssumption::None;
  Limits limits;
  Judgement judgement = {};
  bool tries_repairs = true;  // check/repairs does
  // Where runs begin, instead of where those of the tree do: has the network
  // begin there, or says why not. What is asked for changes nothing else.
  std::function<std::vector<Diagnostic>(const BehaviorTree&, Network&)> start =
      {};
  std::string start_text = {};  // "from run.itf.json"
  // Larger numbers are told apart by region (model/sampling.hpp).
  std::int64_t most_whole = kMostWhole;
  // The default report tells shortest runs where that does not cost much.
  bool wants_shortest = true;
  // Of a tree much like this one, as before an edit: what its runs show here
  // is not searched for, and where it was asked part by part the whole is not
  // tried before. No answer depends on it. Must outlive the check.
  const CheckResult* earlier = nullptr;
  // For which numbers of rounds each verdict stands, too (check/counts.hpp).
  bool any_count = false;
};

// One property file, or none at all, against the tree.
struct CheckedFile {
  std::unique_ptr<PropertyFile> properties;  // null: the default report
  std::unique_ptr<Network> network;
  BoundFile bound;  // the properties, to it
  std::vector<PropertyVerdict> verdicts;
  // By verdict: the rule that may have been meant instead.
  std::vector<std::optional<TickAdvice>> advice;
  // By verdict, with CheckOptions::any_count: of each node that counts.
  std::vector<CountClaims> counts;
  std::optional<DefaultReport> defaults;
  // Beside several files of rules, in the first: what a search of so many
  // states finds.
  std::vector<TreeFinding> findings;
  bool findings_are_whole = false;  // beside rules: of a complete search
  bool has_faults = false;  // some run ends in a fault; not set by `defaults`
  // What the user says such a fault is; nothing where it is not to be told.
  std::optional<Severity> fault_level;
  std::optional<Run> fault;  // that ends so, of an XML tree
  std::string open_fault;    // why it is not known whether there is one

  // In force for all of them.
  const std::vector<std::string>& assumptions() const {
    return bound.assumptions.names;
  }
};

struct CheckResult {
  std::vector<Diagnostic> diagnostics;
  std::unique_ptr<BehaviorTree> tree;  // null when it could not be read
  std::vector<InputFile> sources;      // the tree's files
  std::vector<CheckedFile> files;      // empty when there was any error
  bool is_broken = false;              // there was an error
  std::string start_text;              // where runs begin, "": as the tree says
  Judged judged;                       // what the user has said of all findings
};

// The tree that a property file names, "" when it names none.
Result<std::string> tree_of_properties(const InputFile& properties);

// The names of its properties, in order.
Result<std::vector<std::string>> names_of_properties(
    const InputFile& properties);

// Checks a tree against each property file, or against the default properties
// when there is none. Every input is read and every atom bound before the
// first search begins: an error never follows a verdict.
CheckResult check(const TreeInput& tree,
                  const std::vector<InputFile>& properties,
                  const CheckOptions& options);

// Reads a tree and its properties as `check` does and searches nothing: what is
// wrong with them, and what `lint` finds (check/questions/lint.hpp), stands in
// the diagnostics. `files` stays empty.
CheckResult lint_inputs(const TreeInput& tree,
                        const std::vector<InputFile>& properties,
                        const Judgement& judgement = {});

// A tree and its network, with all values of its numbers: for one run of it.
struct LoweredInput {
  BehaviorTree tree;
  Network network;
  bool is_denied = false;  // what a reader warned of is an error
};
Result<LoweredInput> lowered_input(const TreeInput& input,
                                   const Judgement& judgement,
                                   TickSemantics ticks);

// Judges what the readers have said of a tree and its rules.
Judged judge(const TreeInput& tree, const Judgement& judgement,
             std::vector<Diagnostic>& diagnostics);

}  // namespace btcheck
