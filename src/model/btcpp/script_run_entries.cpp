// SPDX-License-Identifier: MIT
//
// How a script reads entries and assigns to them.
#include "model/btcpp/script_run.hpp"

#include <cmath>
#include <utility>

namespace btcheck::btcpp {

namespace {

using Operation = ScriptOperation;

// Whether an entry of one value may refuse another: an integer refuses a
// fraction. What the program around the tree put there is taken to be of the
// kind that fits.
bool may_refuse(const ScriptValue& held, const ScriptValue& value) {
  if (value.kind == ScriptKind::Unknown) return true;
  if (held.is_text()) return !value.is_text();
  if (held.is_number() && !value.is_number()) return true;
  if (held.kind == ScriptKind::Unset) return false;
  return value.kind == ScriptKind::Number &&
         value.number != std::nearbyint(value.number);
}

// An entry of such a value may not be there.
bool may_be_absent(const ScriptValue& value) {
  return value.kind <= ScriptKind::AnyText;
}

}  // namespace

ScriptResult ScriptRun::assignment(const ScriptTree& tree,
                                   const ScriptTerm& term) {
  const EntryName entry =
      entry_of(expansion_, subtree_, tree.terms[term.operands[0]].text);
  const auto found = world_.of.find(entry);
  const bool is_known = found != world_.of.end();
  // That the entry exists is asked before the value is computed.
  ScriptGuard present = ScriptGuard::always();
  if (is_known && term.operation != Operation::Create) {
    present = presence(found->second);
  }
  const ScriptResult value = evaluate(tree, term.operands[1]);
  if (!is_known) return foreign_assignment(term, value);
  ScriptResult kept = term.operation > Operation::Set
                          ? changed(found->second, term.operation, value)
                          : replaced(found->second, value);
  if (!present.is_always()) {
    kept = {under(present, kept.options), both(present, kept.yields)};
  }
  keep(found->second, kept);
  return kept;
}

ScriptGuard ScriptRun::presence(StateVariableId entry) {
  const ScriptOptions held = values_of(entry);
  may_throw(anywhere(
      held, [](const ScriptValue& each) { return may_be_absent(each); }));
  return anywhere(held, [](const ScriptValue& each) {
    return each.kind != ScriptKind::Unset;
  });
}

ScriptResult ScriptRun::replaced(StateVariableId entry,
                                 const ScriptResult& value) {
  const ScriptDomain& domain = world_.domains[index(entry)];
  const ScriptOptions held = values_of(entry);
  ScriptResult result{{}, value.yields};
  for (const auto& [each, where] : value.options) {
    const bool is_text = each.is_text();
    const bool is_lost = is_text && !domain.is_text;
    if (is_lost && on_keep_) on_keep_(entry, each);
    const bool may_clash = domain.takes_texts && !domain.is_text;
    if (may_clash || (is_text && domain.may_be_empty)) may_throw(where);
    may_throw(both(where, anywhere(held, [&, &by = each](const auto& now) {
                     return may_refuse(now, by);
                   })));
    add_option(result.options, is_lost ? ScriptValue{} : each, where);
  }
  return result;
}

ScriptResult ScriptRun::changed(StateVariableId entry,
                                ScriptOperation operation,
                                const ScriptResult& by) {
  const ScriptDomain& domain = world_.domains[index(entry)];
  CollectedOutcomes all;
  all.add_pairs(values_of(entry), by.options,
                [&](const ScriptValue& held, const ScriptValue& value) {
                  auto outcome = apply_change(operation, held, value);
                  if (domain.may_be_empty && held.is_text()) {
                    outcome.may_throw = true;
                  }
                  for (ScriptValue& each : outcome.values) {
                    if (!each.is_text() || domain.is_text) continue;
                    if (on_keep_) on_keep_(entry, each);
                    each = {};
                  }
                  return outcome;
                });
  may_throw(all.throws);
  return std::move(all.result);
}

// To an entry that is not modelled: a number stays one, or is refused.
ScriptResult ScriptRun::foreign_assignment(const ScriptTerm& term,
                                           const ScriptResult& value) {
  may_throw(value.yields);
  ScriptResult result{{}, value.yields};
  for (const auto& [each, where] : value.options) {
    const bool is_kept =
        each.is_number() && term.operation <= ScriptOperation::Set;
    add_option(result.options, is_kept ? each : ScriptValue{}, where);
  }
  return result;
}

ScriptResult ScriptRun::reading(const EntryName& entry) {
  ScriptResult result{read(entry), {}};
  result.yields =
      anywhere(result.options, [](const ScriptValue&) { return true; });
  return result;
}

ScriptOptions ScriptRun::read(const EntryName& entry) {
  const auto found = world_.of.find(entry);
  if (found == world_.of.end()) {
    may_throw(ScriptGuard::always());
    return {{ScriptValue{}, ScriptGuard::always()}};
  }
  ScriptOptions options = values_of(found->second);
  const bool may_be_empty = world_.domains[index(found->second)].may_be_empty;
  for (const auto& [value, where] : options) {
    if (may_be_absent(value) || (value.is_text() && may_be_empty)) {
      may_throw(where);
    }
  }
  options.erase(ScriptValue::unset());
  return options;
}

// What the entry holds now; before it is assigned to, each value where the
// variable has it. What is unknown in an entry of texts is one.
ScriptOptions ScriptRun::values_of(StateVariableId entry) const {
  const auto assigned = entries_.find(entry);
  ScriptOptions options =
      assigned != entries_.end() ? assigned->second : at_first(entry);
  if (!world_.domains[index(entry)].is_text) return options;
  auto unknown = options.extract(ScriptValue{});
  if (!unknown.empty()) {
    add_option(options, ScriptValue::any_text(), unknown.mapped());
  }
  return options;
}

ScriptOptions ScriptRun::at_first(StateVariableId entry) const {
  const auto& values = world_.domains[index(entry)].values;
  ScriptOptions options;
  for (std::size_t i = 0; i < values.size(); ++i) {
    std::vector<bool> only(values.size());
    only[i] = true;
    add_option(options, values[i],
               ScriptGuard::is_among(entry, std::move(only)));
  }
  return options;
}

void ScriptRun::keep(StateVariableId entry, const ScriptResult& values) {
  const ScriptDomain& domain = world_.domains[index(entry)];
  ++kept_;
  ScriptOptions kept;
  for (const auto& [value, where] : values.options) {
    const ScriptValue each = domain.kept(value);
    if (on_keep_) on_keep_(entry, each);
    const bool is_known = domain.index_of(each) != 0;
    add_option(kept, is_known ? each : ScriptValue{}, where);
  }
  entries_[entry] = std::move(kept);
}

void ScriptRun::set(StateVariableId entry, const Setting& setting) {
  const ScriptResult value =
      setting.source
          ? reading(*setting.source)
          : ScriptResult{
                {{ScriptValue::of(setting.text), ScriptGuard::always()}},
                ScriptGuard::always()};
  keep(entry, replaced(entry, value));
}

void ScriptRun::join(const ScriptGuard& where, const Entries& one,
                     const ScriptGuard& elsewhere, const Entries& other) {
  const auto values_in = [&](const Entries& entries, StateVariableId id) {
    const auto found = entries.find(id);
    return found != entries.end() ? found->second : at_first(id);
  };
  Entries joined = one;
  joined.insert(other.begin(), other.end());
  for (auto& [entry, options] : joined) {
    options = under(where, values_in(one, entry));
    for (const auto& [value, guard] :
         under(elsewhere, values_in(other, entry))) {
      add_option(options, value, guard);
    }
  }
  entries_ = std::move(joined);
}

}  // namespace btcheck::btcpp
