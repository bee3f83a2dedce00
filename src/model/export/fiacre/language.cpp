// SPDX-License-Identifier: MIT
//
// Shared locations are those of timers, which their nodes start and stop, and
// of state variables. Named values are constants of an interval type, not of a
// union: values of a union have no order and cannot be compared with numbers.
#include "model/export/fiacre/language.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace btcheck {
namespace {

// With `status` and `here`, which the model uses itself.
constexpr std::string_view kWords =
    " absent after always and any append array assert before begin between bool"
    " by case channel component const deadlockfree dequeue do else elsif empty"
    " end enqueue enter event extern false first for foreach from full function"
    " here if in infinitelyoften init int is lasting leadsto leave live loop "
    "ltl"
    " mortal nat none not of on or out par port precedes present priority"
    " process property prove queue read record release return select start "
    "state"
    " states status sync tag then to true type union unless until value var "
    "wait"
    " where while within write ";

void add(std::vector<std::uint32_t>& users, std::uint32_t automaton) {
  if (users.empty() || users.back() != automaton) users.push_back(automaton);
}

}  // namespace

FiacreLanguage::FiacreLanguage(const Network& network, const ExportNames& names)
    : ExportLanguage(network, names,
                     {"Fiacre", " and ", " or ", "not ", " = ", "", " % ",
                      "true", "false"}),
      users_(network.variables.size()),
      own_(network.automata.size()),
      shared_(network.automata.size()) {
  find_users();
  for (const Automaton& automaton : network.automata) {
    is_kept_in_states_.push_back(automaton.kind !=
                                     AutomatonKind::StateVariable &&
                                 users_[index(automaton.location)].size() <= 1);
  }
  divide_variables();
  name_states();
}

void FiacreLanguage::find_users() {
  for (std::uint32_t a = 0; a < network().automata.size(); ++a) {
    auto read = [&](const Expression& expression) {
      for (const Term& term : expression.terms()) {
        if (term.operation != Operation::Variable) continue;
        add(users_[static_cast<std::size_t>(term.operand)], a);
      }
    };
    const Automaton& automaton = network().automata[a];
    add(users_[index(automaton.location)], a);
    for (const Edge& edge : automaton.edges) {
      read(edge.guard);
      if (network().fault) add(users_[index(*network().fault)], a);
      for (const Assignment& update : edge.updates) {
        add(users_[index(update.variable)], a);
        read(update.value);
      }
    }
  }
}

void FiacreLanguage::divide_variables() {
  for (std::uint32_t v = 0; v < users_.size(); ++v) {
    for (const std::uint32_t a : users_[v]) {
      const Automaton& automaton = network().automata[a];
      const VariableId id{v};
      const bool is_local =
          users_[v].size() == 1 &&
          std::ranges::find(automaton.locals, id) != automaton.locals.end();
      if (automaton.location == id && is_kept_in_states_[a]) {
        continue;
      }
      (is_local ? own_ : shared_)[a].push_back(id);
    }
  }
}

std::vector<VariableId> FiacreLanguage::global() const {
  std::vector<bool> is_kept(network().variables.size(), false);
  for (std::size_t a = 0; a < own_.size(); ++a) {
    if (is_kept_in_states_[a]) {
      is_kept[index(network().automata[a].location)] = true;
    }
    for (const VariableId id : own_[a]) is_kept[index(id)] = true;
  }
  std::vector<VariableId> others;
  for (std::uint32_t v = 0; v < is_kept.size(); ++v) {
    if (!is_kept[v]) others.push_back(VariableId{v});
  }
  return others;
}

void FiacreLanguage::name_states() {
  for (const Automaton& automaton : network().automata) {
    std::map<std::string, int> uses;
    std::vector<std::string>& names = states_.emplace_back();
    for (const Location& location : automaton.locations) {
      names.push_back(fiacre_identifier(location.name));
      ++uses[names.back()];
    }
    // Names that differ in letters Fiacre does not have get their number.
    for (std::size_t i = 0; i < names.size(); ++i) {
      if (uses.at(names[i]) > 1) names[i] += fmt::format("_at{}", i);
    }
  }
}

std::string FiacreLanguage::state(AutomatonId id, LocationId location) const {
  if (!is_kept_in_states(id)) return std::string(kOnlyState);
  return states_[index(id)][index(location)];
}

std::string FiacreLanguage::type(VariableId id) const {
  if (network().variable(id).role == VariableRole::Status) return "status";
  return is_enumeration(id) ? names().variable(id) + "_values" : "int";
}

std::string fiacre_identifier(std::string_view text) {
  const std::string name = as_identifier(text);
  const bool is_word = kWords.find(" " + name + " ") != kWords.npos;
  return is_word ? name + "_" : name;
}

}  // namespace btcheck
