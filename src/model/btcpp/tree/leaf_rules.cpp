// SPDX-License-Identifier: MIT
//
// A contract takes precedence over the leaf's type; what it does not say stays
// as the type has it (known_types).
#include "model/btcpp/tree/leaf_rules.hpp"

#include <fmt/format.h>

#include <set>
#include <utility>

#include "model/btcpp/enumerators.hpp"
#include "model/btcpp/known_types.hpp"
#include "model/btcpp/tree/node_scripts.hpp"
#include "model/tree/node_types.hpp"
#include "text/choice.hpp"
#include "text/wildcards.hpp"

namespace btcheck::btcpp {
namespace {

bool is_matched(std::string_view name, const BtcppInstance& leaf) {
  return name == leaf.node->id ||
         (!leaf.node->name.empty() && name == leaf.node->name) ||
         matches_wildcard(name, leaf.path);
}

// Whether a contract for a `leaf` may be about this node. A node without a
// model is taken for an action because it has no children; it may be a
// condition. py_trees does not tell the two apart.
bool is_open_leaf(BtcppRelease release, const BtcppNode& node, NodeType leaf) {
  const NodeType type = engine_type(release, node);
  const bool is_guessed =
      type == NodeType::Action && !node.is_known &&
      (!node.is_explicit || release == BtcppRelease::PyTrees);
  return (type == leaf || (is_guessed && leaf == NodeType::Condition)) &&
         builtin_type(release, node.id) == nullptr;
}

// Whether a leaf can give the answers that its memory is about.
bool has_answers_of(const LeafContract& contract) {
  switch (contract.memory) {
    case LeafMemory::FirstTickFails:
    case LeafMemory::FirstTickOfLifeFails:
      return contract.may_fail;
    case LeafMemory::FirstTickOfLifeSucceeds:
      return contract.may_succeed;
    case LeafMemory::SuccessStays:
      return contract.may_succeed && contract.may_fail;
    default:
      return true;
  }
}

void take_results(const LeafContract& results, LeafContract& contract) {
  contract.may_succeed = results.may_succeed;
  contract.may_fail = results.may_fail;
  contract.may_run = results.may_run;
  contract.may_skip = results.may_skip;
  if (!has_answers_of(contract)) contract.memory = LeafMemory::None;
}

// A condition decides what it answers, and not how often it has been asked.
void take_decision(LeafContract& contract) {
  const bool is_kept = contract.memory == LeafMemory::Latched ||
                       contract.memory == LeafMemory::Unknown;
  if (!is_kept) contract.memory = LeafMemory::None;
}

}  // namespace

LeafRules::LeafRules(const BtcppExpansion& expansion,
                     const LeafContracts& contracts)
    : expansion_(expansion),
      contracts_(contracts),
      findings_(contracts.files),
      chosen_(expansion.nodes.size()),
      is_used_(contracts.rules.size()),
      before_(contracts.rules.size()) {
  for (const DeclaredEntry& declared : contracts.entries) declare(declared);
  choose();
}

// It stands on the root's blackboard, which the program fills.
void LeafRules::declare(const DeclaredEntry& declared) {
  const EntryName entry = entry_of(expansion_, 0, declared.entry.name);
  const bool is_known =
      scripts_.initial.contains(entry) || scripts_.declared.contains(entry);
  if (is_known) {
    findings_.error(
        {declared.file, declared.entry.span},
        {"BT1011", fmt::format("`{}` is declared twice", declared.entry.name),
         "declared again here", "delete one of them"});
    return;
  }
  if (declared.initial) scripts_.initial.emplace(entry, *declared.initial);
  if (declared.declaration) {
    scripts_.declared.emplace(entry, *declared.declaration);
  }
}

void LeafRules::choose() {
  const BtcppRelease release = expansion_.document->release;
  for (std::uint32_t i = 0; i < expansion_.nodes.size(); ++i) {
    const BtcppInstance& node = expansion_.nodes[i];
    if (!node.children.empty()) continue;
    for (std::size_t k = 0; k < contracts_.rules.size(); ++k) {
      const LeafRule& rule = contracts_.rules[k];
      if (!is_matched(rule.name, node) ||
          !is_open_leaf(release, *node.node, rule.leaf)) {
        continue;
      }
      if (rule.meaning != LeafMeaning{}) {
        meant_[i].push_back(&rule);
        is_used_[k] = true;
      }
      if (!rule.has_behavior) continue;
      if (chosen_[i] != nullptr) {
        if (before_[k] == nullptr) before_[k] = chosen_[i];
        continue;
      }
      chosen_[i] = &rule;
      is_used_[k] = true;
      scripts_.of[i] = {rule.requirement.code, rule.decision.code,
                        rule.on_success.code, rule.on_failure.code};
    }
  }
}

void LeafRules::apply(std::uint32_t instance, NodeScripts& scripts,
                      Node& leaf) {
  const LeafRule* rule = chosen_[instance];
  LeafContract& contract = leaf.contract;
  if (const auto meant = meant_.find(instance); meant != meant_.end()) {
    for (const LeafRule* each : meant->second) {
      add_meaning(each->meaning, contract.meaning);
    }
  }
  if (rule == nullptr) return;
  leaf.is_guessed = false;
  if (leaf.type != rule->leaf) {
    leaf.type = rule->leaf;
    contract.may_run = false;
    contract.memory = LeafMemory::None;
  }
  if (rule->results) take_results(*rule->results, contract);
  if (rule->memory) contract.memory = *rule->memory;
  if (!rule->decision.code.empty()) take_decision(contract);
  leaf.duration = rule->duration;
  check(*rule, leaf);
  const std::uint32_t subtree = expansion_.nodes[instance].subtree;
  for (const ContractScript* script : {&rule->requirement, &rule->decision,
                                       &rule->on_success, &rule->on_failure}) {
    check_entries(rule->file, script->entries, subtree, scripts);
  }
  const auto set_condition = [&](const ContractScript& script,
                                 Expression& holds, Expression& fails,
                                 std::int32_t& program) {
    if (script.code.empty()) return;
    Script asked =
        scripts.script(ScriptRole::Requirement, subtree, script.code);
    program = asked.program;
    fails = Expression::binary(
        Operation::Or, std::move(asked.may_fail),
        Expression::unary(Operation::Not, Expression(asked.may_hold)));
    holds = std::move(asked.may_hold);
  };
  set_condition(rule->requirement, contract.requirement, contract.unmet,
                contract.requirement_program);
  set_condition(rule->decision, contract.decision, contract.decided_against,
                contract.decision_program);
  const auto set_effect = [&](const ContractScript& script, auto& assignments,
                              Expression& leaves, std::int32_t& program) {
    if (script.code.empty()) return;
    Script effect = scripts.script(ScriptRole::Effect, subtree, script.code);
    assignments = std::move(effect.assignments);
    if (effect.may_leave) leaves = std::move(*effect.may_leave);
    program = effect.program;
  };
  set_effect(rule->on_success, contract.on_success, contract.success_leaves,
             contract.success_program);
  set_effect(rule->on_failure, contract.on_failure, contract.failure_leaves,
             contract.failure_program);
}

void LeafRules::check(const LeafRule& rule, const Node& leaf) {
  const LeafContract& contract = leaf.contract;
  const auto contradiction = [&](std::string message, std::string help) {
    findings_.error({rule.file, rule.span},
                    {"BT1020", std::move(message), "", std::move(help)});
  };
  const bool may_end = contract.may_succeed || contract.may_fail;
  if (leaf.duration && leaf.duration->max > 0 && !contract.may_run) {
    contradiction(
        fmt::format("`{}` takes time but never answers running", leaf.name),
        "delete the `:duration`, or write `:returns (... running)`");
  } else if (leaf.duration && !may_end) {
    contradiction(fmt::format("`{}` ends, but without an answer", leaf.name),
                  "delete the `:duration`, or let it return something else");
  }
  if (!contract.may_succeed && !rule.on_success.code.empty()) {
    contradiction(fmt::format("`{}` never succeeds", leaf.name),
                  "delete the `:on-success`, or let it return `success`");
  }
  if (!contract.may_succeed && !rule.decision.code.empty()) {
    contradiction(fmt::format("`{}` never succeeds", leaf.name),
                  "delete the `:succeeds-when`, or let it return `success`");
  }
  const BtcppRelease release = expansion_.document->release;
  if (contract.may_skip && release != BtcppRelease::V4) {
    contradiction(fmt::format("`{}` cannot answer skipped", leaf.name),
                  release == BtcppRelease::V3
                      ? "nothing is skipped in version 3"
                      : "nothing is skipped in py_trees");
  }
  if (contract.memory == LeafMemory::Latched &&
      release == BtcppRelease::PyTrees) {
    contradiction(fmt::format("`{}` cannot keep its answer", leaf.name),
                  "py_trees runs a behaviour that has ended anew when it is "
                  "ticked again: delete the `:answers once`");
  }
}

// A program can put no number into an entry of texts, and no such text into one
// of numbers: neither before the tree is made nor after that.
void LeafRules::check_type(const DeclaredEntry& declared,
                           const NodeScripts& scripts) {
  const EntryType type = scripts.type_by_ports(0, declared.entry.name);
  const auto& given = declared.declaration;
  const bool has_numbers =
      given ? given->domain.are_numbers() : declared.initial->is_number();
  const bool is_of_texts = type == EntryType::Text;
  const bool is_of_numbers =
      type == EntryType::Integer || type == EntryType::Real;
  if (has_numbers ? !is_of_texts : !is_of_numbers) return;
  findings_.warning(
      {declared.file, declared.entry.span},
      {"BT1659",
       fmt::format("`{}` is declared with {}, and a port makes it one of {}",
                   declared.entry.name, has_numbers ? "numbers" : "texts",
                   has_numbers ? "texts" : "numbers"),
       "BehaviorTree.CPP throws where it is set so",
       has_numbers ? "declare texts: `:init \"3\"`, `:states (\"3\" \"4\")`"
                   : "declare numbers"});
}

void LeafRules::check_declared(const NodeScripts& scripts) {
  for (const DeclaredEntry& declared : contracts_.entries) {
    check_entries(declared.file, {&declared.entry, 1}, 0, scripts);
    check_type(declared, scripts);
    const std::string& name = declared.entry.name;
    std::string reason = scripts.why_too_large(0, name);
    if (reason.empty()) continue;
    findings_.error(
        {declared.file, declared.entry.span},
        {"BT1008", fmt::format("`{}` has too many values", name),
         std::move(reason),
         "give it a smaller range, or compare it with numbers only"});
  }
}

void LeafRules::check_ports(std::uint32_t instance,
                            const NodeScripts& scripts) {
  for (const EntryName& entry : scripts.written_by_open_ports(instance)) {
    const BtcppNode& leaf = *expansion_.nodes[instance].node;
    if (!told_ports_.emplace(entry, leaf.id).second) continue;
    const auto declared =
        std::ranges::find_if(contracts_.entries, [&](const auto& each) {
          return entry_of(expansion_, 0, each.entry.name) == entry;
        });
    if (declared == contracts_.entries.end()) continue;
    findings_.warning(
        {declared->file, declared->entry.span},
        {"BT1638",
         fmt::format("{} may write `{}`: no model says which way its port goes",
                     leaf.id, entry.name),
         "after which it has any of these values",
         fmt::format("declare the port in a file for {}, or give the leaf a "
                     "contract that names the entry",
                     word(Choice::Models))});
  }
}

// What a contract says of an entry without a state variable is lost.
void LeafRules::check_entries(std::uint32_t file,
                              std::span<const NamedEntry> entries,
                              std::uint32_t subtree,
                              const NodeScripts& scripts) {
  for (const NamedEntry& entry : entries) {
    const auto enums = enumerators_of(*expansion_.document);
    if (enums && enums->contains(entry.name)) continue;
    const auto reason = scripts.why_abstracted(subtree, entry.name);
    if (!reason) continue;
    findings_.warning(
        {file, entry.span},
        {"BT1638",
         fmt::format("`{}` may have any value at any time: {}", entry.name,
                     *reason),
         "",
         "write a text in quotes, or give each leaf that may write the entry a "
         "contract that names it"});
  }
}

std::vector<Diagnostic> LeafRules::take() {
  for (std::size_t i = 0; i < contracts_.rules.size(); ++i) {
    if (!is_used_[i]) report_unused(i);
  }
  return findings_.take();
}

void LeafRules::report_unused(std::size_t number) {
  const LeafRule& rule = contracts_.rules[number];
  const BtcppPlace place{rule.file, rule.span};
  if (const LeafRule* first = before_[number]) {
    findings_.warning(
        place,
        {"BT1021", fmt::format("`{}` comes too late", rule.name),
         "the leaves that it matches have a contract already",
         fmt::format("the first that matches counts: write this one before "
                     "{}:{}",
                     contracts_.files[first->file].name, first->span.line)});
    return;
  }
  if (is_of_other_tree(rule)) return;
  const std::string help = nearest(rule);
  // What leaves mean is said for a whole project: here it may have none such.
  if (!rule.has_behavior && help.empty()) return;
  findings_.warning(place, {"BT1021",
                            fmt::format("no {} is called `{}`",
                                        type_name(rule.leaf), rule.name),
                            "this contract is not used", help});
}

// Whether no leaf of this tree has the name, and one of another tree has.
bool LeafRules::is_of_other_tree(const LeafRule& rule) const {
  const std::string name = rule.name.substr(rule.name.rfind('/') + 1);
  return std::ranges::none_of(expansion_.nodes,
                              [&](const BtcppInstance& node) {
                                return is_matched(rule.name, node);
                              }) &&
         std::ranges::any_of(contracts_.elsewhere,
                             [&](const std::string& leaf) {
                               return matches_wildcard(name, leaf);
                             });
}

// Help for a contract that is not used: the node that it names although it
// cannot have a contract, or names that are near; of one that says what a leaf
// does, else all names.
std::string LeafRules::nearest(const LeafRule& rule) const {
  const BtcppRelease release = expansion_.document->release;
  const NodeType other =
      rule.leaf == NodeType::Action ? NodeType::Condition : NodeType::Action;
  std::set<std::string> names;
  for (const BtcppInstance& node : expansion_.nodes) {
    if (is_matched(rule.name, node)) {
      if (!is_open_leaf(release, *node.node, other)) {
        return fmt::format(
            "contracts are for leaves of your program and of Nav2, and what {} "
            "does is known",
            node.node->id);
      }
      return fmt::format("`{}` is {}", node.node->id,
                         other == NodeType::Action
                             ? "an action: write `defaction`"
                             : "a condition: write `defcondition`");
    }
    if (!is_open_leaf(release, *node.node, rule.leaf)) continue;
    names.insert({node.node->id, node.path});
    if (!node.node->name.empty()) names.insert(node.node->name);
  }
  const std::vector<std::string> known(names.begin(), names.end());
  const bool lists_all = rule.has_behavior && !known.empty();
  return did_you_mean(rule.name, known,
                      lists_all ? "there are " + listed(known) : "");
}

}  // namespace btcheck::btcpp
