// SPDX-License-Identifier: MIT
//
// The forms are those of .btf files and read by the same readers. What a
// contract does not say is as the leaf's type has it; what it says counts more
// than the type, whose rows are what the engine's and Nav2's own nodes do.
#include "model/btcpp/leaf_rules.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <set>
#include <utility>

#include "model/btcpp/engine_types.hpp"
#include "model/btcpp/leaf_types.hpp"
#include "model/btcpp/wildcard.hpp"

namespace btcheck::btcpp {
namespace {

using btf::ContractDraft;
using btf::Reading;

std::string_view head_for(NodeType leaf) {
  return leaf == NodeType::Action ? "defaction" : "defcondition";
}

bool is_matched(std::string_view name, const BtcppInstance& leaf) {
  return name == leaf.node->id ||
         (!leaf.node->name.empty() && name == leaf.node->name) ||
         matches_wildcard(name, leaf.path);
}

bool is_kind_of_leaf(const BtcppNode& node) {
  return node.kind == BtcppKind::Action || node.kind == BtcppKind::Condition;
}

// What a contract may be about.
bool is_open_leaf(BtcppRelease release, const BtcppNode& node, NodeType leaf) {
  return engine_type(node) == leaf && builtin_leaf(release, node.id) == nullptr;
}

// What a leaf remembers means nothing when it cannot give the answers of it.
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

}  // namespace

LeafRules::File::File(const BtcppFile& read)
    : source(read.name, read.text),
      findings(source),
      forms(btf::read_forms(btf::split_words(read.text, findings), findings)) {}

LeafRules::LeafRules(const BtcppExpansion& expansion,
                     std::span<const BtcppFile> files)
    : expansion_(expansion), chosen_(expansion.nodes.size()) {
  for (const BtcppFile& file : files) {
    const SourceText source(file.name, file.text);
    if (auto refusal = source.refuse_binary()) {
      refusals_.push_back(std::move(*refusal));
    } else {
      read(files_.emplace_back(file));
    }
  }
  choose();
}

void LeafRules::read(File& file) {
  for (const btf::FormId id : file.forms.top_level) {
    const btf::Form* head = file.forms.head(id);
    if (head != nullptr && equal_ignoring_case(head->text, "defaction")) {
      read_contract(file, id, NodeType::Action);
    } else if (head != nullptr &&
               equal_ignoring_case(head->text, "defcondition")) {
      read_contract(file, id, NodeType::Condition);
    } else if (file.forms.is_balanced) {
      const btf::Form& form = head == nullptr ? file.forms[id] : *head;
      file.findings.error(
          form.span,
          {"BT1004",
           head == nullptr
               ? std::string("this is no contract of a leaf")
               : fmt::format("`{}` is no contract of a leaf", head->text),
           "",
           "a file of contracts has `(defaction ...)` and "
           "`(defcondition ...)`"});
    }
  }
}

void LeafRules::read_contract(File& file, btf::FormId form, NodeType leaf) {
  const Reading reading{file.forms, file.findings};
  auto contract = btf::read_contract_draft(reading, form, leaf,
                                           btf::ContractPlace::SideFile);
  if (!contract) return;
  Rule& rule = rules_.emplace_back();
  rule.file = &file;
  rule.leaf = leaf;
  if (contract->requirement) {
    rule.requirement = condition_script(reading, *contract->requirement);
  }
  rule.on_success = effect_script(reading, contract->on_success);
  rule.on_failure = effect_script(reading, contract->on_failure);
  rule.contract = std::move(*contract);
}

void LeafRules::choose() {
  for (std::uint32_t i = 0; i < expansion_.nodes.size(); ++i) {
    const BtcppInstance& node = expansion_.nodes[i];
    if (!is_kind_of_leaf(*node.node)) continue;
    for (Rule& rule : rules_) {
      if (!is_open_leaf(expansion_.document->release, *node.node, rule.leaf) ||
          !is_matched(rule.contract.name, node)) {
        continue;
      }
      if (chosen_[i] != nullptr) {
        rule.before = chosen_[i];
        continue;
      }
      chosen_[i] = &rule;
      rule.contract.is_used = true;
      scripts_[i] = {rule.requirement.code, rule.on_success.code,
                     rule.on_failure.code};
    }
  }
}

void LeafRules::apply(std::uint32_t instance, const NodeScripts& scripts,
                      Node& leaf) {
  const Rule* rule = chosen_[instance];
  if (rule == nullptr) return;
  const ContractDraft& draft = rule->contract;
  LeafContract& contract = leaf.contract;
  if (draft.has_returns) take_results(draft.results, contract);
  if (draft.memory) contract.memory = *draft.memory;
  leaf.duration = draft.duration;
  check(*rule, leaf);
  const std::uint32_t subtree = expansion_.nodes[instance].subtree;
  check_entries(*rule, subtree, scripts);
  if (!rule->requirement.code.empty()) {
    Script needed = scripts.condition(subtree, rule->requirement.code);
    contract.unmet = Expression::binary(
        Operation::Or, std::move(needed.may_fail),
        Expression::unary(Operation::Not, Expression(needed.may_hold)));
    contract.requirement = std::move(needed.may_hold);
  }
  contract.on_success =
      scripts.condition(subtree, rule->on_success.code).assignments;
  contract.on_failure =
      scripts.condition(subtree, rule->on_failure.code).assignments;
}

void LeafRules::check(const Rule& rule, const Node& leaf) {
  const LeafContract& contract = leaf.contract;
  const auto contradiction = [&](std::string message, std::string help) {
    rule.file->findings.error(rule.contract.span, {"BT1020", std::move(message),
                                                   "", std::move(help)});
  };
  const bool may_end =
      contract.may_succeed || contract.may_fail || contract.may_skip;
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
  if (contract.may_skip && expansion_.document->release == BtcppRelease::V3) {
    contradiction(fmt::format("`{}` cannot answer skipped", leaf.name),
                  "nothing is skipped in version 3");
  }
}

// What is said of an entry without a state variable is lost.
void LeafRules::check_entries(const Rule& rule, std::uint32_t subtree,
                              const NodeScripts& scripts) {
  for (const ContractScript* script :
       {&rule.requirement, &rule.on_success, &rule.on_failure}) {
    for (const NamedEntry& entry : script->entries) {
      const auto reason = scripts.why_abstracted(subtree, entry.name);
      if (!reason) continue;
      rule.file->findings.warning(
          entry.span,
          {"BT1638",
           fmt::format("`{}` may have any value at any time: {}", entry.name,
                       *reason),
           "",
           "a text is written in quotes; an entry needs a contract or "
           "script that writes it, and no port without one"});
    }
  }
}

bool LeafRules::has_error() const {
  return !refusals_.empty() ||
         std::any_of(files_.begin(), files_.end(), [](const File& file) {
           return file.findings.has_error();
         });
}

std::vector<Diagnostic> LeafRules::take() {
  for (const Rule& rule : rules_) {
    if (!rule.contract.is_used) report_unused(rule);
  }
  std::vector<Diagnostic> all = std::move(refusals_);
  for (File& file : files_) {
    std::vector<Diagnostic> some = file.findings.take();
    std::move(some.begin(), some.end(), std::back_inserter(all));
  }
  return all;
}

void LeafRules::report_unused(const Rule& rule) const {
  const ContractDraft& contract = rule.contract;
  if (rule.before != nullptr) {
    rule.file->findings.warning(
        contract.span,
        {"BT1021", fmt::format("`{}` comes too late", contract.name),
         "the leaves that it matches have a contract already",
         fmt::format("the first that matches counts: write this one before "
                     "{}:{}",
                     rule.before->file->source.name(),
                     rule.before->contract.span.line)});
    return;
  }
  rule.file->findings.warning(
      contract.span,
      {"BT1021",
       fmt::format("no {} is called `{}`", type_name(rule.leaf), contract.name),
       "this contract is not used", nearest(rule)});
}

// The node that the contract is about after all, or what it may be meant to be.
std::string LeafRules::nearest(const Rule& rule) const {
  const BtcppRelease release = expansion_.document->release;
  const NodeType other =
      rule.leaf == NodeType::Action ? NodeType::Condition : NodeType::Action;
  std::set<std::string> names;
  for (const BtcppInstance& node : expansion_.nodes) {
    if (is_matched(rule.contract.name, node)) {
      return is_open_leaf(release, *node.node, other)
                 ? fmt::format(
                       "`{}` is {}: write `{}`", node.node->id,
                       other == NodeType::Action ? "an action" : "a condition",
                       head_for(other))
                 : fmt::format(
                       "contracts are for leaves of your program and "
                       "of Nav2, and what {} does is known",
                       node.node->id);
    }
    if (!is_open_leaf(release, *node.node, rule.leaf)) continue;
    names.insert({node.node->id, node.path});
    if (!node.node->name.empty()) names.insert(node.node->name);
  }
  const std::vector<std::string> known(names.begin(), names.end());
  const std::string guess = btf::did_you_mean(rule.contract.name, known);
  if (!guess.empty() || known.empty()) return guess;
  return fmt::format("there are {}", btf::listed(known));
}

}  // namespace btcheck::btcpp
