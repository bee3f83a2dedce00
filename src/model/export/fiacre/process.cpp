// SPDX-License-Identifier: MIT
//
// An edge is one alternative of the transition from its state: guard, time,
// updates, target. Fiacre is urgent only where an interval ends, so [0,0] is
// written out. A timer with the interval [a,b] has two alternatives: one from a
// on, which competes with every other step, and one at b, whose port has
// priority over all others; time cannot pass b. `wait` would be shorter than a
// port, but has no priority.
//
// Shared locations are those of timers, which their nodes start and stop, and
// of state variables. Named values are constants of an interval type, not of a
// union: values of a union have no order and cannot be compared with numbers.
#include "model/export/fiacre/process.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>

#include "model/export/layout.hpp"
#include "model/export/steps.hpp"

namespace btcheck {
namespace {

// With `status` and `here`, which the model uses itself.
constexpr std::string_view kWords =
    " absent after always and any append array assert before begin between"
    " bool by case channel component const deadlockfree dequeue do else elsif"
    " empty end enqueue enter event extern false first for foreach from full"
    " function here if in infinitelyoften init int is lasting leadsto leave"
    " live loop ltl mortal nat none not of on or out par port precedes"
    " present priority process property prove queue read record release"
    " return select start state states status sync tag then to true type"
    " union unless until value var wait where while within write ";

void add(std::vector<std::uint32_t>& users, std::uint32_t automaton) {
  if (users.empty() || users.back() != automaton) users.push_back(automaton);
}

std::string port_name(const Interval& when) {
  if (when == kAtOnce) return "at_once";
  if (when == kAnyTime) return "at_any_time";
  if (when.upper == kUnbounded) return fmt::format("from_{}", when.lower);
  return when.lower == when.upper
             ? fmt::format("after_{}", when.lower)
             : fmt::format("from_{}_to_{}", when.lower, when.upper);
}

class Process {
 public:
  Process(const FiacreLanguage& language, const FiacreTime& time,
          AutomatonId id)
      : language_(language),
        network_(language.network()),
        names_(language.names()),
        time_(time),
        id_(id),
        automaton_(network_.automaton(id)) {}

  std::string text() const {
    std::string text = fmt::format("\n/* process {}: {} */\n{}", index(id_) + 1,
                                   comment_text(automaton_.name), header());
    if (!language_.is_kept_in_states(id_)) {
      return text + transition(std::nullopt);
    }
    for (const LocationId location : locations()) {
      text += transition(location);
    }
    return text;
  }

 private:
  // The locations, the initial one first: Fiacre begins there.
  std::vector<LocationId> locations() const {
    const Variable& location = network_.variable(automaton_.location);
    std::vector<LocationId> all{LocationId{
        static_cast<std::uint32_t>(location.initial - location.min)}};
    for (std::uint32_t i = 0; i < automaton_.locations.size(); ++i) {
      if (LocationId{i} != all[0]) all.push_back(LocationId{i});
    }
    return all;
  }

  std::string states() const {
    if (!language_.is_kept_in_states(id_)) {
      return std::string(FiacreLanguage::kOnlyState);
    }
    std::string names;
    for (const LocationId location : locations()) {
      append(names, ", ", language_.state(id_, location));
    }
    return names;
  }

  std::string header() const {
    std::string ports;
    for (const std::string& port : time_.ports_of(id_)) {
      append(ports, ", ", port + " : sync");
    }
    std::string shared;
    for (const VariableId variable : language_.shared(id_)) {
      append(shared, ", ",
             fmt::format("&{} : {}", names_.variable(variable),
                         language_.type(variable)));
    }
    std::string text = "process " + names_.process(id_);
    if (!ports.empty()) {
      text += "\n  [" + filled(ports, 3, "", {", "}) + "]";
    }
    if (!shared.empty()) {
      text += "\n  (" + filled(shared, 3, "", {", "}) + ")";
    }
    text += " is\nstates " + filled(states(), 7, "", {", "}) + "\n";
    return text + own_variables();
  }

  std::string own_variables() const {
    std::string text;
    for (const VariableId id : language_.own(id_)) {
      const Variable& variable = network_.variable(id);
      append(text, ",\n    ",
             fmt::format("{} : {} := {} /* {}..{} */", names_.variable(id),
                         language_.type(id), names_.value(id, variable.initial),
                         variable.min, variable.max));
    }
    return text.empty() ? text : "var " + text + "\n";
  }

  // `from STATE` and all alternatives; nothing where nothing leads on. Where
  // the location is in a variable, there is one state, and all edges lead from
  // it.
  std::string transition(std::optional<LocationId> from) const {
    std::vector<std::string> ways;
    for (const Edge& edge : automaton_.edges) {
      if (from && edge.source != *from) continue;
      for (const FiacrePort& firing : time_.firings(id_, edge)) {
        ways.push_back(alternative(edge, firing));
      }
    }
    if (ways.empty()) return {};
    std::string text = fmt::format(
        "from {}\n", language_.state(id_, from.value_or(LocationId{})));
    if (ways.size() == 1) return text + "     " + ways[0];
    for (std::size_t i = 0; i < ways.size(); ++i) {
      text += (i == 0 ? "  select\n     " : "  [] ") + ways[i];
    }
    return text + "  end\n";
  }

  std::string guard(const Edge& edge) const {
    constexpr std::string_view kAnd = " and ";
    const StepConditions conditions(language_);
    std::string when = network_.fault ? "fault = 0" : "";
    if (!language_.is_kept_in_states(id_)) {
      append(when, kAnd, conditions.is_at(automaton_, edge.source));
    }
    append(when, kAnd, conditions.guard(edge));
    return when;
  }

  std::string alternative(const Edge& edge, const FiacrePort& firing) const {
    std::string text = comment(edge);
    const auto add = [&](const std::string& statement) {
      text += "     " + statement + ";\n";
    };
    const std::string when = guard(edge);
    if (!when.empty()) {
      add("on " + filled(when, 8, "", {" and ", " or "}));
    }
    if (!firing.name.empty()) {
      add(firing.name);
    } else if (firing.when != kAnyTime) {
      add("wait " + fiacre_interval(firing.when));
    }
    for (const Assignment& update : edge.updates) {
      add(names_.variable(update.variable) +
          " := " + language_.assigned(update.value, update.variable));
    }
    if (!language_.is_kept_in_states(id_)) {
      add(names_.variable(automaton_.location) + " := " +
          names_.value(automaton_.location,
                       location_value(network_, automaton_, edge.target)));
    }
    return text + "     to " + language_.state(id_, edge.target) + "\n";
  }

  std::string comment(const Edge& edge) const {
    const std::string told =
        edge.label.empty() ? "to " + automaton_.target(edge).name : edge.label;
    return "/* " + comment_text(told) + " */\n";
  }

  const FiacreLanguage& language_;
  const Network& network_;
  const ExportNames& names_;
  const FiacreTime& time_;
  AutomatonId id_;
  const Automaton& automaton_;
};

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
    is_kept_in_states_.push_back(network.variable(automaton.location).role !=
                                     VariableRole::State &&
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

FiacreTime::FiacreTime(const FiacreLanguage& language) : language_(language) {
  const std::vector<Automaton>& automata = language.network().automata;
  has_ports_ = std::ranges::any_of(automata, [](const Automaton& automaton) {
    return std::ranges::any_of(automaton.edges, [&](const Edge& edge) {
      return is_due_first(automaton, edge);
    });
  });
  if (!has_ports_) return;
  for (std::uint32_t a = 0; a < automata.size(); ++a) {
    for (const Edge& edge : automata[a].edges) {
      for (const FiacrePort& port : firings(AutomatonId{a}, edge)) {
        const auto known =
            std::ranges::find(ports_, port.name, &FiacrePort::name);
        if (known == ports_.end()) ports_.push_back(port);
      }
    }
  }
}

std::vector<FiacrePort> FiacreTime::firings(AutomatonId id,
                                            const Edge& edge) const {
  if (!has_ports_) return {{"", edge.when}};
  const Automaton& automaton = language_.network().automaton(id);
  const auto port = [&](const std::string& name, Interval when) {
    const bool is_timer = automaton.kind == AutomatonKind::Timer;
    return FiacrePort{name, when, is_timer && when.lower == when.upper};
  };
  const auto [lower, upper] = edge.when;
  if (upper == kUnbounded || !is_due_first(automaton, edge)) {
    return {port(port_name(edge.when), edge.when)};
  }
  const std::string& name = language_.names().process(id);
  const FiacrePort last = port(name + "_must_end", {upper, upper});
  if (lower == upper) return {last};
  return {port(name + "_may_end", {lower, kUnbounded}), last};
}

std::vector<std::string> FiacreTime::ports_of(AutomatonId id) const {
  std::vector<std::string> names;
  const std::vector<Edge>& edges = language_.network().automaton(id).edges;
  for (const FiacrePort& port : ports_) {
    const bool is_used = std::ranges::any_of(edges, [&](const Edge& edge) {
      const std::vector<FiacrePort> own = firings(id, edge);
      return std::ranges::find(own, port.name, &FiacrePort::name) != own.end();
    });
    if (is_used) names.push_back(port.name);
  }
  return names;
}

std::string fiacre_interval(const Interval& when) {
  return when.upper == kUnbounded
             ? fmt::format("[{},...[", when.lower)
             : fmt::format("[{},{}]", when.lower, when.upper);
}

std::string fiacre_process(const FiacreLanguage& language,
                           const FiacreTime& time, AutomatonId id) {
  return Process(language, time, id).text();
}

}  // namespace btcheck
