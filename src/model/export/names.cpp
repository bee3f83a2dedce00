// SPDX-License-Identifier: MIT
//
// Names in a tree may have any letter; those of Promela, SMV and Fiacre only
// the letters of C. All others become `_`, and names that are then equal get
// numbers. Every name begins with a node's unique name or a prefix, so none is
// a keyword of these languages, or of the C that SPIN makes of a model.
#include "model/export/names.hpp"

#include "text/budget.hpp"
#include "text/numbers.hpp"
#include "text/utf8.hpp"

namespace btcheck {
namespace {

std::vector<ExportNames::Constant> numbered(
    const std::vector<std::string>& names, int first) {
  std::vector<ExportNames::Constant> constants;
  for (const std::string& name : names) constants.push_back({name, first++});
  return constants;
}

}  // namespace

std::string as_identifier(std::string_view text) {
  std::string identifier;
  for (const char c : text) identifier += is_letter(c) || is_digit(c) ? c : '_';
  const bool begins_badly = identifier.empty() || (is_digit(identifier[0]));
  return begins_badly ? "n_" + identifier : identifier;
}

ExportNames::ExportNames(const Network& network)
    : network_(network),
      variables_(network.variables.size()),
      values_(network.variables.size()) {
  for (const char* taken : {"fault", "progress", "network", "may_move",
                            "is_urgent", "timer_is_due"}) {
    used_.insert(taken);
  }
  for (const std::string_view status : kStatusNames) {
    statuses_.push_back(unique("status_" + std::string(status)));
  }
  if (network.fault) variables_[index(*network.fault)] = "fault";
  for (const VariableId id : network.state_variable) {
    const std::string stem = "sv_" + network.variable(id).name;
    variables_[index(id)] = unique(stem);
    name_values(id, stem);
  }
  for (const Automaton& automaton : network.automata) {
    ask_budget();
    name_automaton(automaton);
  }
  for (const Automaton& automaton : network.automata) {
    const bool is_variable = automaton.kind == AutomatonKind::StateVariable;
    processes_.push_back(
        unique(is_variable ? "world_" + automaton.name : automaton.name));
  }
}

std::string ExportNames::unique(std::string_view wanted) {
  return unused_name(used_, as_identifier(wanted));
}

void ExportNames::name_values(VariableId id, const std::string& stem) {
  for (const std::string& value : network_.variable(id).value_names) {
    values_[index(id)].push_back(unique(stem + "_" + value));
  }
}

void ExportNames::name_automaton(const Automaton& automaton) {
  const bool is_variable = automaton.kind == AutomatonKind::StateVariable;
  const bool is_value =
      network_.variable(automaton.location).role == VariableRole::State;
  const std::string stem = (is_variable ? "sv_" : "") + automaton.name;
  clocks_.push_back(unique(stem + "_clock"));
  urgencies_.push_back(unique(stem + "_is_urgent"));
  auto name = [&](VariableId id) {
    variables_[index(id)] = unique(stem + "_" + network_.variable(id).name);
  };
  if (!is_value) {
    name(automaton.location);
    name_values(automaton.location, stem + "_at");
  }
  if (automaton.gate) name(*automaton.gate);
  if (automaton.kind == AutomatonKind::Node) {
    const VariableId status = network_.node_status[index(automaton.node)];
    name(status);
    values_[index(status)] = statuses_;
  }
  for (const VariableId local : automaton.locals) name(local);
}

std::string ExportNames::value(VariableId id, std::int64_t value) const {
  const std::int64_t at = value - network_.variable(id).min;
  const std::vector<std::string>& names = values_[index(id)];
  return at >= 0 && at < static_cast<std::int64_t>(names.size())
             ? names[static_cast<std::size_t>(at)]
             : std::to_string(value);
}

std::vector<ExportNames::Constant> ExportNames::constants(VariableId id) const {
  const Variable& variable = network_.variable(id);
  if (variable.role == VariableRole::Status) return {};
  return numbered(values_[index(id)], variable.min);
}

std::vector<ExportNames::Constant> ExportNames::statuses() const {
  return numbered(statuses_, 0);
}

}  // namespace btcheck
