// SPDX-License-Identifier: MIT
//
// How a script reads entries and assigns to them.
#include "model/btcpp/entries/run.hpp"

#include <cmath>
#include <utility>

namespace btcheck::btcpp {

namespace {

using Operation = ScriptOperation;

// All values that an entry treats alike when it is assigned to.
ScriptValue likeness(const ScriptValue& value) {
  if (value.is_text()) return ScriptValue::any_text().as(value.noted);
  if (!value.is_number()) return value;
  ScriptValue zero = ScriptValue::integer(0).as(value.noted);
  zero.type = value.type == NumberType::Whole ? NumberType::Real : value.type;
  return zero;
}

// And when SetBlackboard writes it.
ScriptValue type_alone(const ScriptValue& value) {
  const bool may_be_none =
      value.kind == ScriptKind::Unset || value.kind == ScriptKind::Unknown;
  return may_be_none ? value : ScriptValue::any().as(value.noted);
}

ScriptOptions grouped(const ScriptOptions& options,
                      ScriptValue (*group)(const ScriptValue&)) {
  ScriptOptions groups;
  for (const auto& [value, where] : options) {
    add_option(groups, group(value), where);
  }
  return groups;
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
  if (is_known && term.operation != Operation::Create && !is_of_contract_) {
    present = presence(found->second, term.operation);
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

ScriptGuard ScriptRun::presence(StateVariableId entry,
                                ScriptOperation operation) {
  const ScriptOptions now = held(entry);
  const auto is_absent = [](const ScriptValue& each) {
    return each.kind == ScriptKind::Unset;
  };
  may_throw(anywhere(now, is_absent));
  const bool needs_value = operation > Operation::Set;
  if (needs_value || !world_.domains[index(entry)].exists) {
    may_lack(anywhere(now, [](const ScriptValue& each) {
      return each.kind == ScriptKind::Unknown;
    }));
  }
  return anywhere(now,
                  [&](const ScriptValue& each) { return !is_absent(each); });
}

// What the entry holds now, with the type that it has before the tree has
// written it.
ScriptOptions ScriptRun::held(StateVariableId entry) const {
  ScriptOptions options = values_of(entry);
  auto unknown = options.extract(ScriptValue{});
  if (!unknown.empty()) {
    const EntryType type = world_.domains[index(entry)].declared;
    add_option(options, ScriptValue{}.as(type), unknown.mapped());
  }
  return options;
}

ScriptResult ScriptRun::replaced(StateVariableId entry,
                                 const ScriptResult& value) {
  if (is_of_contract_) return value;
  return paired(grouped(held(entry), likeness), value.options,
                apply_assignment);
}

ScriptResult ScriptRun::changed(StateVariableId entry,
                                ScriptOperation operation,
                                const ScriptResult& by) {
  return paired(held(entry), by.options,
                [&](const ScriptValue& now, const ScriptValue& value) {
                  return apply_change(operation, now, value);
                });
}

// To an entry that is not modelled: a number stays one, or is refused.
ScriptResult ScriptRun::foreign_assignment(const ScriptTerm& term,
                                           const ScriptResult& value) {
  may_throw(value.yields);
  ScriptResult result{{}, value.yields};
  for (const auto& [each, where] : value.options) {
    const bool is_kept =
        each.is_number() && term.operation <= ScriptOperation::Set;
    add_option(result.options, is_kept ? each : ScriptValue::any(), where);
  }
  return result;
}

// What can be read: a read of an entry that is not there throws.
ScriptResult ScriptRun::reading(const EntryName& entry) {
  ScriptResult result;
  const auto found = world_.of.find(entry);
  if (found == world_.of.end()) {
    may_throw(ScriptGuard::always());
    return {{{ScriptValue::any(), ScriptGuard::always()}},
            ScriptGuard::always()};
  }
  for (const auto& [value, where] : values_of(found->second)) {
    if (value.kind == ScriptKind::Unset) {
      may_throw(where);
    } else if (value.kind == ScriptKind::Unknown) {
      may_lack(where);
      add_option(result.options, ScriptValue::any(), where);
    } else {
      add_option(result.options, value.as(EntryType::Free), where);
    }
  }
  result.yields =
      anywhere(result.options, [](const ScriptValue&) { return true; });
  return result;
}

// What the entry holds now; before it is assigned to, each value where the
// variable has it.
ScriptOptions ScriptRun::values_of(StateVariableId entry) const {
  const auto assigned = entries_.find(entry);
  return assigned != entries_.end() ? assigned->second : at_first(entry);
}

ScriptOptions ScriptRun::at_first(StateVariableId entry) const {
  const auto& values = world_.domains[index(entry)].values;
  ScriptOptions options;
  const std::size_t first = entry == restricted_ ? first_value_ : 0;
  for (std::size_t i = first; i < values.size(); ++i) {
    ScriptGuard::Among only(values.size());
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
    const bool is_known = on_keep_ || domain.index_of(each) != 0;
    add_option(kept, is_known ? each : merged({{each, where}}), where);
  }
  entries_[entry] = std::move(kept);
}

// What SetBlackboard copies, or writes.
ScriptRun::Source ScriptRun::source_of(const Setting& setting) {
  if (!setting.source) {
    // A new entry becomes one of texts.
    return {{{ScriptValue::of(setting.text).as(EntryType::Text),
              ScriptGuard::always()}},
            {}};
  }
  const auto found = world_.of.find(*setting.source);
  if (found == world_.of.end()) {
    return {{{ScriptValue::any(), ScriptGuard::always()}},
            ScriptGuard::always()};
  }
  Source source;
  for (const auto& [value, where] : held(found->second)) {
    if (value.kind == ScriptKind::Unset) {
      may_throw(where);
    } else if (value.kind == ScriptKind::Empty && !is_release_3()) {
      source.fails = either(source.fails, where);
    } else {
      const bool may_be_empty = value.kind == ScriptKind::Unknown;
      if (may_be_empty) source.fails = either(source.fails, where);
      add_option(source.values, value, where);
    }
  }
  if (is_release_3()) source.fails = {};
  return source;
}

// Of an entry that is written in release 3 the value is replaced as a whole.
ScriptResult ScriptRun::stored(StateVariableId entry,
                               const ScriptOptions& values, bool is_own) {
  if (is_release_3()) {
    ScriptResult whole{values, {}};
    whole.yields = anywhere(values, [](const ScriptValue&) { return true; });
    return whole;
  }
  const bool exists = world_.domains[index(entry)].exists;
  return paired(grouped(held(entry), type_alone), values,
                [&](const ScriptValue& now, const ScriptValue& value) {
                  const bool is_there = now.kind == ScriptKind::Unknown
                                            ? exists
                                            : now.kind != ScriptKind::Unset;
                  return apply_setting(now, {is_there, is_own}, value);
                });
}

ScriptRun::SettingGuards ScriptRun::set(StateVariableId entry,
                                        const Setting& setting) {
  const Source source = source_of(setting);
  const ScriptResult result = stored(entry, source.values, setting.is_own);
  keep(entry, result);
  return {result.yields, source.fails};
}

ScriptRun::SettingGuards ScriptRun::set_unknown(const Setting& setting) {
  const Source source = source_of(setting);
  may_throw(ScriptGuard::always());
  return {anywhere(source.values, [](const ScriptValue&) { return true; }),
          source.fails};
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
