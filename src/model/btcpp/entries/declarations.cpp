// SPDX-License-Identifier: MIT
#include "model/btcpp/entries/declarations.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <optional>

namespace btcheck::btcpp {
namespace {

// As the ports that are remapped to it say; else as a program makes it.
EntryType type_of(const DeclaredDomain& domain, const EntryName& entry,
                  const ScriptWriters& writers) {
  const auto found = writers.declared.find(entry);
  if (found != writers.declared.end() && found->second != EntryType::Free) {
    return found->second;
  }
  if (!domain.are_numbers()) return EntryType::Free;
  const bool is_whole =
      std::ranges::all_of(domain.states, &ScriptValue::is_whole);
  return is_whole ? EntryType::Integer : EntryType::Real;
}

// One that moves begins with its first value, unless it says with which.
void set_initial(const EntryName& entry, const EntryDeclaration& declaration,
                 ScriptWriters& writers) {
  const DeclaredDomain& domain = declaration.domain;
  const auto literal = writers.literals.find(entry);
  if (literal != writers.literals.end()) {
    literal->second = domain.held(literal->second).value_or(ScriptValue{});
  } else if (*declaration.is_free) {
    writers.literals[entry] = domain.is_range()
                                  ? domain.number(domain.min)
                                  : domain.as_held(domain.states[0]);
  }
}

}  // namespace

void Declarations::settle(const BtcppExpansion& expansion,
                          const std::set<EntryName>& written,
                          const ScriptDetail& detail, ScriptWriters& writers) {
  for (auto& [entry, declaration] : all_) {
    declaration.domain.type = type_of(declaration.domain, entry, writers);
    if (!declaration.is_free) {
      declaration.is_free =
          !declaration.domain.is_range() && !written.contains(entry);
    }
    set_initial(entry, declaration, writers);
  }
  told_apart_ = told_apart(expansion, writers, all_, detail);
}

std::vector<ScriptValue> Declarations::values_of(
    const EntryName& entry, const EntryDeclaration& declared) {
  const DeclaredDomain& domain = declared.domain;
  std::vector<ScriptValue> values;
  for (const ScriptValue& state : domain.states) {
    values.push_back(domain.as_held(state));
  }
  if (!domain.is_range()) return values;
  const ToldApart& told = told_apart_.at(entry);
  const std::size_t most = *declared.is_free ? kMostMoving : kMostDeclared;
  const std::size_t count =
      told.samples ? told.samples->size()
                   : static_cast<std::size_t>(domain.max - domain.min + 1);
  if (count > most) {
    too_large_[entry] = fmt::format(
        "{} values, of which at most {} can be told apart{}: {}", count, most,
        *declared.is_free ? " while it moves by itself" : "",
        told.why_all.empty() ? "scripts and rules ask too much of it"
                             : told.why_all);
    return {domain.number(domain.min)};
  }
  if (told.samples) {
    for (const int value : *told.samples) {
      values.push_back(domain.number(value));
    }
    return values;
  }
  for (std::int64_t value = domain.min; value <= domain.max; ++value) {
    values.push_back(domain.number(value));
  }
  return values;
}

bool Declarations::limit(const EntryName& entry, const ScriptWriters& writers,
                         ScriptDomain& domain) {
  const auto found = all_.find(entry);
  if (found == all_.end()) return false;
  domain.limits = found->second.domain;
  domain.declared = found->second.domain.type;
  for (ScriptValue& value : values_of(entry, found->second)) {
    if (domain.index_of(value) != 0) continue;
    domain.measured.push_back(value);
    domain.values.push_back(std::move(value));
  }
  return writers.literals.contains(entry);
}

// From what is none of its values, an entry comes to any of them.
void Declarations::set_moves(const EntryName& entry, const ScriptDomain& domain,
                             StateVariable& variable) const {
  const auto found = all_.find(entry);
  if (found == all_.end()) return;
  const EntryDeclaration& declaration = found->second;
  const auto state_of = [&](const ScriptValue& value) {
    return static_cast<int>(domain.index_of(value));
  };
  variable.moves = *declaration.is_free ? Moves::Free : Moves::Sampled;
  variable.is_declared_range = domain.limits->is_range();
  for (const ScriptValue& value : domain.measured) {
    variable.measured.push_back(state_of(value));
  }
  std::ranges::sort(variable.measured);
  // Any number may be measured after any other.
  if (variable.is_declared_range && !*declaration.is_free) return;
  std::set<int> listed;
  if (declaration.transitions) {
    const auto held = [&](std::size_t state) {
      return state_of(domain.limits->as_held(domain.limits->states[state]));
    };
    for (const auto& [from, to] : *declaration.transitions) {
      variable.transitions.emplace_back(held(from), held(to));
    }
    listed.insert(variable.measured.begin(), variable.measured.end());
  }
  for (int from = 0; from < static_cast<int>(domain.values.size()); ++from) {
    if (listed.contains(from)) continue;
    for (const int to : variable.measured) {
      // A number may move within its region.
      if (from == to && !variable.is_declared_range) continue;
      variable.transitions.emplace_back(from, to);
    }
  }
}

}  // namespace btcheck::btcpp
