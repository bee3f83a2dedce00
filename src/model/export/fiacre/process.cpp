// SPDX-License-Identifier: MIT
//
// The automata of a network as processes of Fiacre.
//
// An edge is one alternative of the transition from its state: guard, time,
// updates, target. Fiacre is urgent only where an interval ends, so [0,0] is
// written out. A timer with the interval [a,b] has two alternatives: one from a
// on, which competes with every other step, and one at b, whose port has
// priority over all others; time cannot pass b. `wait` would be shorter than a
// port, but has no priority.
#include "model/export/fiacre/process.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "model/export/layout.hpp"
#include "model/export/steps.hpp"

namespace btcheck {
namespace {

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
      for (const FiacreTime::Firing& firing : time_.firings(id_, edge)) {
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

  std::string alternative(const Edge& edge,
                          const FiacreTime::Firing& firing) const {
    std::string text = comment(edge);
    const auto add = [&](const std::string& statement) {
      text += "     " + statement + ";\n";
    };
    const std::string when = guard(edge);
    if (!when.empty()) {
      add("on " + filled(when, 8, "", {" and ", " or "}));
    }
    if (!firing.port.empty()) {
      add(firing.port);
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

FiacreTime::FiacreTime(const FiacreLanguage& language) : language_(language) {
  const std::vector<Automaton>& automata = language.network().automata;
  has_ports_ = std::ranges::any_of(automata, [](const Automaton& automaton) {
    return std::ranges::any_of(automaton.edges, [&](const Edge& edge) {
      return is_due_first(automaton, edge);
    });
  });
  if (!has_ports_) return;
  for (std::uint32_t a = 0; a < automata.size(); ++a) {
    const bool is_timer = automata[a].kind == AutomatonKind::Timer;
    for (const Edge& edge : automata[a].edges) {
      for (const auto& [when, port] : firings(AutomatonId{a}, edge)) {
        const auto known = std::ranges::find(ports_, port, &FiacrePort::name);
        if (known != ports_.end()) continue;
        ports_.push_back({port, when, is_timer && when.lower == when.upper});
      }
    }
  }
}

std::vector<FiacreTime::Firing> FiacreTime::firings(AutomatonId id,
                                                    const Edge& edge) const {
  if (!has_ports_) return {{edge.when, ""}};
  if (!is_due_first(language_.network().automaton(id), edge)) {
    return {{edge.when, port_name(edge.when)}};
  }
  const std::string& name = language_.names().process(id);
  std::vector<Firing> both;
  if (edge.when.lower < edge.when.upper) {
    both.push_back({{edge.when.lower, kUnbounded}, name + "_may_end"});
  }
  both.push_back({{edge.when.upper, edge.when.upper}, name + "_must_end"});
  return both;
}

std::vector<std::string> FiacreTime::ports_of(AutomatonId id) const {
  std::vector<std::string> names;
  const std::vector<Edge>& edges = language_.network().automaton(id).edges;
  for (const FiacrePort& port : ports_) {
    const bool is_used = std::ranges::any_of(edges, [&](const Edge& edge) {
      const std::vector<Firing> own = firings(id, edge);
      return std::ranges::find(own, port.name, &Firing::port) != own.end();
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
