// SPDX-License-Identifier: MIT
//
// A contract narrows what a leaf may answer (:returns), says when it can only
// fail (:requires) and what decides its answer (:succeeds-when), what it
// changes (:on-success, :on-failure) and how long it takes (:duration); and
// what it means to its owner (leaf_meaning.hpp). What the node itself says
// comes on top: :SF takes running away, its own :duration wins. Contracts of
// XML trees stand in files beside them, whose forms are read here as well.
#include "model/btf/contracts.hpp"

#include <fmt/format.h>

#include <array>

#include "model/tree/node_types.hpp"

namespace btcheck::btf {
namespace {

constexpr std::size_t kMostContractWords = 2'000'000;

// What only actions have, then what both have, then what only conditions have.
constexpr std::array kContractRules = {
    KeywordRule{"answers"},  // in side files
    KeywordRule{"duration", Takes::List},
    KeywordRule{"may-be-cut-off", Takes::YesNo},
    KeywordRule{"may-stay", Takes::YesNo},
    KeywordRule{"idempotent", Takes::YesNo},
    KeywordRule{"tells-only", Takes::YesNo},
    KeywordRule{"undone-by", Takes::List},
    KeywordRule{"returns", Takes::List},
    KeywordRule{"on-success", Takes::List},
    KeywordRule{"on-failure", Takes::List},
    KeywordRule{"requires", Takes::List},
    KeywordRule{"succeeds-when", Takes::List},
    KeywordRule{"may-be-lost", Takes::YesNo},
    KeywordRule{"asked-once", Takes::YesNo},
    KeywordRule{"holds-while", Takes::List},
};
constexpr std::span<const KeywordRule> kActionRules =
    std::span(kContractRules).first(13);
constexpr std::span<const KeywordRule> kTreeRules = kActionRules.subspan(1);
constexpr std::span<const KeywordRule> kConditionRules =
    std::span(kContractRules).subspan(7);

class ContractReader {
 public:
  ContractReader(const Reading& reading, FormId form, NodeType leaf,
                 ContractPlace place)
      : reading_(reading),
        leaf_(leaf),
        is_beside_(place == ContractPlace::SideFile),
        clauses_(reading, form, kContractRules) {
    contract_.form = form;
  }

  std::optional<ContractDraft> read() {
    if (!read_leaf_name()) return std::nullopt;
    clauses_.report_unknown(rules(), reading_.forms.head(contract_.form)->text);
    read_returns();
    if (const Clause* clause = clauses_.find("requires")) {
      contract_.requirement = clause->value;
    }
    read_decision();
    contract_.on_success = effects("on-success");
    contract_.on_failure = effects("on-failure");
    read_meaning();
    if (!is_action()) return std::move(contract_);
    if (const Clause* duration = clauses_.find("duration")) {
      contract_.duration = clauses_.duration(*duration);
    }
    if (is_beside_) read_memory();
    return std::move(contract_);
  }

 private:
  bool is_action() const { return leaf_ == NodeType::Action; }

  std::span<const KeywordRule> rules() const {
    if (!is_action()) return kConditionRules;
    return is_beside_ ? kActionRules : kTreeRules;
  }

  // In a side file a word or a text in quotes, as paths may have any character.
  bool is_leaf_name(const Form& name) const {
    if (!is_beside_) return name.is_word() && is_name(name.text);
    return name.is_word() ||
           (name.kind == FormKind::Quoted && name.text.size() > 2);
  }

  bool read_leaf_name() {
    const Form& head = *reading_.forms.head(contract_.form);
    const Form* name = clauses_.first_item();
    if (!name || !is_leaf_name(*name)) {
      const std::string_view needed =
          is_beside_ ? "name or path of a leaf" : ":ID of a leaf";
      error(name ? name->span : head.span,
            fmt::format("`{}` needs the {}", head.text, needed),
            fmt::format("write `({} land :returns (success running))`",
                        head.text));
      return false;
    }
    if (clauses_.items.size() > 1) {
      error(reading_.form(clauses_.items[1]).span, "this belongs to no keyword",
            "write `:keyword value`");
    }
    contract_.name = unquoted(*name);
    contract_.span = name->span;
    return true;
  }

  void read_returns() {
    const Clause* clause = clauses_.find("returns");
    LeafContract& results = contract_.results;
    results.may_run = is_action();
    if (!clause) return;
    const Form& list = clauses_.value(*clause);
    if (!list.is_list() || list.items.empty()) {
      error(list.span, "a list of results is needed",
            "write `:returns (success failure)`");
      return;
    }
    contract_.has_returns = true;
    results.may_succeed = results.may_fail = results.may_run = false;
    for (const FormId item : list.items) {
      if (!add_result(reading_.form(item))) report_result(reading_.form(item));
    }
  }

  void read_decision() {
    const Clause* clause = clauses_.find("succeeds-when");
    if (!clause) return;
    contract_.decision = clause->value;
    const LeafContract& results = contract_.results;
    if (!contract_.has_returns || is_beside_ || results.may_succeed) return;
    error(contract_.span, fmt::format("`{}` never succeeds", contract_.name),
          "delete the `:succeeds-when`, or let it return `success`");
  }

  bool add_result(const Form& word) {
    const auto is = [&](std::string_view answer) {
      return equal_ignoring_case(word.text, answer);
    };
    LeafContract& results = contract_.results;
    if (is("success")) return results.may_succeed = true;
    if (is("failure")) return results.may_fail = true;
    if (is("running") && is_action()) return results.may_run = true;
    if (is("skipped") && is_beside_) return results.may_skip = true;
    return false;
  }

  void report_result(const Form& word) {
    std::vector<std::string> results = {"success", "failure"};
    if (is_action()) results.push_back("running");
    if (is_beside_) results.push_back("skipped");
    error(word.span,
          fmt::format("{} is not a result of {}",
                      word.is_list() ? std::string("a list")
                                     : fmt::format("`{}`", word.text),
                      is_action() ? "an action" : "a condition"),
          fmt::format("there are {}", listed(results)));
  }

  void read_memory() {
    const Clause* clause = clauses_.find("answers");
    if (!clause) return;
    const Form& word = clauses_.value(*clause);
    if (equal_ignoring_case(word.text, "once")) {
      contract_.memory = LeafMemory::Latched;
    } else if (equal_ignoring_case(word.text, "anew")) {
      contract_.memory = LeafMemory::None;
    } else {
      error(word.span,
            fmt::format("`{}` is not a value of `:answers`", word.text),
            "`once`: what it has answered stands until it is reset; `anew`: "
            "ticked again, it begins again");
    }
  }

  void read_meaning() {
    for (const MeaningFlag& flag : kMeaningFlags) {
      contract_.meaning.*flag.value = clauses_.yes_or_no(flag.keyword);
    }
    for (const MeaningList& list : kMeaningLists) {
      contract_.meaning.*list.names = leaf_names(list.keyword);
    }
  }

  // `(Drive "line/*")`, or a single name: leaves, as contracts name them.
  std::vector<std::string> leaf_names(std::string_view keyword) {
    const Clause* clause = clauses_.find(keyword);
    if (!clause) return {};
    const Form& value = clauses_.value(*clause);
    std::vector<std::string> names;
    const auto add = [&](const Form& name) {
      const bool is_quoted =
          name.kind == FormKind::Quoted && name.text.size() > 2;
      if (is_quoted || (name.is_word() && is_name(name.text))) {
        names.push_back(unquoted(name));
      } else {
        error(name.span, "the name of a leaf is needed",
              fmt::format("write `:{} (Drive)`", keyword));
      }
    };
    if (!value.is_list()) add(value);
    for (const FormId item : value.items) add(reading_.form(item));
    return names;
  }

  static std::string unquoted(const Form& name) {
    return std::string(name.kind == FormKind::Quoted
                           ? name.text.substr(1, name.text.size() - 2)
                           : name.text);
  }

  // `((:= v e) (:= w f))`, or a single `(:= v e)`.
  std::vector<FormId> effects(std::string_view keyword) {
    const Clause* clause = clauses_.find(keyword);
    if (!clause) return {};
    if (is_assignment(reading_, *clause->value)) return {*clause->value};
    const Form& list = clauses_.value(*clause);
    std::vector<FormId> assignments;
    if (!list.is_list()) report_effect(list);
    for (const FormId item : list.items) {
      if (is_assignment(reading_, item)) {
        assignments.push_back(item);
      } else {
        report_effect(reading_.form(item));
      }
    }
    return assignments;
  }

  void report_effect(const Form& form) {
    error(form.span, "an effect is an assignment",
          "write `:on-success ((:= altitude 0))`");
  }

  void error(SourceSpan span, std::string message, std::string help) {
    reading_.error(span, "BT1020", std::move(message), "", std::move(help));
  }

  const Reading& reading_;
  NodeType leaf_;
  bool is_beside_;
  Clauses clauses_;
  ContractDraft contract_;
};

std::vector<StateAssignment> read_effects(const Scope& scope,
                                          const std::vector<FormId>& forms) {
  std::vector<StateAssignment> effects;
  for (const FormId form : forms) {
    if (auto effect = read_assignment(scope, form)) {
      effects.push_back(*std::move(effect));
    }
  }
  return effects;
}

// The contract with its expressions, as they read from the scope's node.
LeafContract read_contract(const Scope& scope, const ContractDraft& draft) {
  LeafContract contract = draft.results;
  contract.meaning = draft.meaning;
  if (draft.requirement) {
    contract.requirement =
        read_condition(scope, *draft.requirement).value_or(Expression{});
  }
  if (draft.decision) {
    contract.decision =
        read_condition(scope, *draft.decision).value_or(Expression{});
  }
  contract.on_success = read_effects(scope, draft.on_success);
  contract.on_failure = read_effects(scope, draft.on_failure);
  return contract;
}

// What :SF, :returns and :duration say together.
void check_results(const Scope& scope, const Node& leaf) {
  const LeafContract& contract = leaf.contract;
  const auto contradiction = [&](std::string message, std::string help) {
    scope.reading.error(leaf.span, "BT1020", std::move(message), "",
                        std::move(help));
  };
  if (!contract.may_succeed && !contract.may_fail && !contract.may_run) {
    contradiction(fmt::format("`{}` can answer nothing at all", leaf.name),
                  "`:SF` takes `running` away; let it return something else");
  }
  if (leaf.duration && leaf.duration->max > 0 && !contract.may_run) {
    contradiction(
        fmt::format("`{}` takes time but never answers running", leaf.name),
        "delete its `:duration`, or its `:SF`, or let it return `running`");
  }
}

}  // namespace

std::span<const KeywordRule> contract_keywords() { return kContractRules; }

bool ContractDraft::has_behavior() const {
  return has_returns || memory || duration || requirement || decision ||
         !on_success.empty() || !on_failure.empty();
}

std::optional<ContractDraft> read_contract_draft(const Reading& reading,
                                                 FormId form, NodeType leaf,
                                                 ContractPlace place) {
  return ContractReader(reading, form, leaf, place).read();
}

void Contracts::declare(const Reading& reading, FormId form, NodeType leaf) {
  auto contract = read_contract_draft(reading, form, leaf, ContractPlace::Tree);
  if (!contract) return;
  const Key key(leaf, name_key(contract->name));
  const auto [entry, is_new] = by_leaf_.emplace(key, *contract);
  if (is_new) return;
  reading.error(
      contract->span, "BT1011",
      fmt::format("`{}` has two contracts", contract->name),
      "declared again here",
      fmt::format("the first is on line {}", entry->second.span.line));
}

void Contracts::apply(const Scope& scope, Node& leaf) {
  const std::string& name = leaf.id.empty() ? leaf.name : leaf.id;
  const auto found = by_leaf_.find(Key(leaf.type, name_key(name)));
  if (found != by_leaf_.end()) {
    ContractDraft& draft = found->second;
    draft.is_used = true;
    scope.reading.findings.case_warning(draft.span, draft.name, name);
    const Form& form = scope.reading.form(draft.form);
    words_ += form.end_token - form.first_token;
    if (words_ > kMostContractWords) {
      scope.reading.error(draft.span, "BT1002",
                          "the contracts of all leaves are too large together",
                          "", "shorten this contract, or name fewer leaves so");
      return;
    }
    const bool may_run = leaf.contract.may_run;
    leaf.contract = read_contract(scope, draft);
    leaf.contract.may_run &= may_run;
    if (!leaf.duration) leaf.duration = draft.duration;
  }
  check_results(scope, leaf);
}

void Contracts::report_unused(const Scope& scope) {
  for (const auto& [key, draft] : by_leaf_) {
    if (draft.is_used) continue;
    scope.reading.findings.warning(
        draft.span,
        {"BT1021",
         fmt::format("no {} is called `{}`", type_name(key.first), draft.name),
         "this contract is not used", ""});
    read_contract(scope, draft);
  }
}

}  // namespace btcheck::btf
