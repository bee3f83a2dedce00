// SPDX-License-Identifier: MIT
//
// The steps of a network as constraints of an SMV module.
//
// SMV has no processes that take turns (its keyword `process` is gone), so an
// input variable `step` says who moves: one value for each edge, and one for
// time. A definition for each edge says when it may, a constraint for each
// variable what the steps make of it. Updates are executed in order here and
// all at once there: what an update reads that an earlier one wrote is replaced
// by what was written. The next values are constraints (TRANS), not assignments
// (ASSIGN): of those NuSMV wants to see that no value leaves its range without
// looking at the guard.
#include "model/export/smv/steps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "model/export/clock_bound.hpp"
#include "model/export/filled_lines.hpp"
#include "model/export/smv/language.hpp"
#include "model/export/tree_comment.hpp"

namespace btcheck {
namespace {

constexpr std::string_view kAnd = " & ";
constexpr std::string_view kOr = " | ";

// A value that some steps give to a variable.
struct Change {
  std::string value;
  std::vector<std::uint32_t> edges;
};
using Changes = std::vector<Change>;

void add_change(Changes& changes, std::string value, std::uint32_t edge) {
  const auto same = std::ranges::find(changes, value, &Change::value);
  if (same == changes.end()) {
    changes.push_back({std::move(value), {edge}});
  } else {
    same->edges.push_back(edge);
  }
}

// What the updates of an edge come to, each value over the state before.
std::vector<Assignment> at_once(const Edge& edge) {
  std::vector<Assignment> result;
  for (const Assignment& update : edge.updates) {
    Expression value = update.value.replaced([&](const Term& term) {
      for (const Assignment& earlier : result) {
        const auto number = static_cast<std::int32_t>(index(earlier.variable));
        if (term.operand == number) return earlier.value;
      }
      return Expression::variable(term.operand);
    });
    const auto same =
        std::ranges::find(result, update.variable, &Assignment::variable);
    if (same == result.end()) {
      result.push_back({update.variable, std::move(value)});
    } else {
      same->value = std::move(value);
    }
  }
  return result;
}

class Steps {
 public:
  Steps(const Network& network, const PromelaNames& names)
      : network_(network), names_(names), language_(network, names) {}

  std::string text(SmvProgress progress) {
    collect_changes();
    std::string text = input() + "\nDEFINE\n" + due_definition();
    each_edge([&](AutomatonId id, const Edge& edge, std::uint32_t number) {
      text += edge_definition(id, edge, number);
    });
    text += urgency_definition() + "\n-- when each step may be taken\n";
    each_edge([&](AutomatonId, const Edge&, std::uint32_t number) {
      text += fmt::format("TRANS step = {0} -> {0}_may;\n", smv_step(number));
    });
    text += fmt::format("TRANS step = {} -> !is_urgent;\n", kSmvTimeStep);
    return text + next_values() + next_clocks() + next_progress(progress);
  }

  std::string death() const {
    std::string may;
    each_edge([&](AutomatonId, const Edge&, std::uint32_t number) {
      append(may, kOr, smv_step(number) + "_may");
    });
    for (std::uint32_t a = 0; a < network_.automata.size(); ++a) {
      append(may, kOr, runs(AutomatonId{a}));
    }
    return "  is_dead :=\n    " +
           smv_lines("!(" + (may.empty() ? "FALSE" : may) + ")", 6) + ";\n";
  }

 private:
  template <class Told>
  void each_edge(Told told) const {
    for (std::uint32_t a = 0; a < network_.automata.size(); ++a) {
      const Automaton& automaton = network_.automata[a];
      for (std::uint32_t e = 0; e < automaton.edges.size(); ++e) {
        told(AutomatonId{a}, automaton.edges[e], automaton.first_edge + e);
      }
    }
  }

  std::string no_fault() const { return network_.fault ? "fault = 0" : ""; }

  // The clock has the value; nothing where no clock runs: there it is 0.
  std::string clock_is(AutomatonId id, const Edge& edge, int value) const {
    if (clock_bound(network_.automaton(id), edge.source) == 0) return {};
    return fmt::format("{} = {}", names_.clock(id), value);
  }

  std::string input() const {
    std::string steps = kSmvTimeStep;
    each_edge([&](AutomatonId, const Edge&, std::uint32_t number) {
      steps += ", " + smv_step(number);
    });
    return "\n-- who takes the next step\nIVAR\n  step : {" +
           filled(steps, 4, "", {", "}) + "};\n";
  }

  bool is_due_first(AutomatonId id, const Edge& edge) const {
    const Automaton& automaton = network_.automaton(id);
    return automaton.kind == AutomatonKind::Timer &&
           can_be_late(automaton, edge);
  }

  std::string due_definition() {
    std::string due;
    each_edge([&](AutomatonId id, const Edge& edge, std::uint32_t) {
      if (!is_due_first(id, edge)) return;
      std::string one = language_.is_at(network_.automaton(id), edge.source);
      append(one, kAnd, clock_is(id, edge, edge.when.upper));
      append(due, kOr, "(" + one + ")");
    });
    has_timers_ = !due.empty();
    if (due.empty()) return {};
    return "  -- goes before every other step\n  timer_is_due :=\n    " +
           smv_lines(due, 4) + ";\n";
  }

  std::string edge_definition(AutomatonId id, const Edge& edge,
                              std::uint32_t number) const {
    const Automaton& automaton = network_.automaton(id);
    std::string may = no_fault();
    append(may, kAnd, language_.is_at(automaton, edge.source));
    for (const Expression& conjunct : edge.guard.conjuncts()) {
      const bool is_loose = conjunct.terms().back().operation == Operation::Or;
      const std::string part = language_.condition(conjunct);
      append(may, kAnd, is_loose ? "(" + part + ")" : part);
    }
    if (edge.when.lower > 0) {
      append(may, kAnd,
             fmt::format("{} >= {}", names_.clock(id), edge.when.lower));
    }
    append(may, kAnd, turn(id, edge));
    return fmt::format("  -- {}: {} -> {}{}{}\n  {}_may :=\n    {};\n",
                       comment_text(automaton.name),
                       comment_text(automaton.source(edge).name),
                       comment_text(automaton.target(edge).name),
                       edge.label.empty() ? "" : ", ", comment_text(edge.label),
                       smv_step(number), smv_lines(may, 4));
  }

  // No timer is due, or it is this one.
  std::string turn(AutomatonId id, const Edge& edge) const {
    if (!has_timers_) return {};
    if (!is_due_first(id, edge)) return "!timer_is_due";
    const std::string now = clock_is(id, edge, edge.when.upper);
    return now.empty() ? "" : "(" + now + " | !timer_is_due)";
  }

  std::string urgency_definition() const {
    std::string urgent;
    each_edge([&](AutomatonId id, const Edge& edge, std::uint32_t number) {
      if (!is_binding(network_.ticks, network_.automaton(id), edge)) return;
      std::string one = smv_step(number) + "_may";
      if (network_.ticks != TickSemantics::None) {
        append(one, kAnd, clock_is(id, edge, edge.when.upper));
      }
      append(urgent, kOr, one.find(kAnd) == one.npos ? one : "(" + one + ")");
    });
    return "  -- it must happen before time passes\n  is_urgent :=\n    " +
           smv_lines(urgent.empty() ? "FALSE" : urgent, 4) + ";\n";
  }

  // What each step makes of each variable, and whose clocks it starts anew.
  void collect_changes() {
    changes_.resize(network_.variables.size());
    resets_.resize(network_.automata.size());
    each_edge([&](AutomatonId id, const Edge& edge, std::uint32_t number) {
      const Automaton& automaton = network_.automaton(id);
      std::vector<Assignment> updates = at_once(edge);
      std::erase_if(updates, [&](const Assignment& update) {
        return update.variable == automaton.location;
      });
      updates.push_back(
          {automaton.location,
           Expression::constant(network_.variable(automaton.location).min +
                                static_cast<int>(index(edge.target)))});
      for (const Assignment& update : updates) {
        add_change(changes_[index(update.variable)],
                   language_.assigned(update.value, update.variable), number);
        for (std::uint32_t a = 0; a < network_.automata.size(); ++a) {
          if (network_.automata[a].location != update.variable) continue;
          resets_[a].push_back(number);
        }
      }
    });
  }

  static std::string next_value(const std::string& name, std::string cases) {
    if (cases.empty()) return fmt::format("TRANS next({0}) = {0};\n", name);
    return fmt::format(
        "TRANS next({0}) =\n  case\n{1}    TRUE : {0};\n  esac;\n", name,
        cases);
  }

  static std::string one_case(const std::string& when, std::string_view value) {
    return fmt::format("    {} :\n      {};\n",
                       filled(when, 6, "", {", ", " & ", " | "}),
                       smv_lines(value, 6));
  }

  std::string next_values() const {
    std::string text = "\n-- what the steps make of each variable\n";
    for (std::uint32_t v = 0; v < changes_.size(); ++v) {
      std::string cases;
      for (const Change& change : changes_[v]) {
        cases += one_case(smv_step_among(change.edges), change.value);
      }
      text += next_value(names_.variable(VariableId{v}), std::move(cases));
    }
    return text;
  }

  // Where the clock runs and has not reached its end.
  std::string runs(AutomatonId id) const {
    const Automaton& automaton = network_.automaton(id);
    std::string where;
    for (std::uint32_t i = 0; i < automaton.locations.size(); ++i) {
      const int bound = clock_bound(automaton, LocationId{i});
      if (bound == 0) continue;
      append(where, kOr,
             fmt::format("({} & {} < {})",
                         language_.is_at(automaton, LocationId{i}),
                         names_.clock(id), bound));
    }
    if (where.empty() || !network_.fault) return where;
    return "(" + no_fault() + " & (" + where + "))";
  }

  std::string next_clocks() const {
    std::string text;
    for (std::uint32_t a = 0; a < network_.automata.size(); ++a) {
      const AutomatonId id{a};
      const std::string when = runs(id);
      if (when.empty()) continue;
      const std::string& clock = names_.clock(id);
      text += next_value(clock, one_case(smv_step_among(resets_[a]), "0") +
                                    one_case(fmt::format("step = {} & ({})",
                                                         kSmvTimeStep, when),
                                             clock + " + 1"));
    }
    return text.empty()
               ? text
               : "\n-- clocks, up to what intervals tell apart\n" + text;
  }

  std::string next_progress(SmvProgress progress) const {
    if (progress == SmvProgress::Untold) return {};
    return "\nTRANS next(progress) = !(" +
           filled(smv_step_among(free_moves(network_)), 2, "", {", "}) + ");\n";
  }

  const Network& network_;
  const PromelaNames& names_;
  SmvLanguage language_;
  bool has_timers_ = false;
  std::vector<Changes> changes_;                    // by VariableId
  std::vector<std::vector<std::uint32_t>> resets_;  // by AutomatonId
};

}  // namespace

std::string smv_step(std::uint32_t edge) {
  return fmt::format("edge_{}", edge);
}

std::string smv_step_among(const std::vector<std::uint32_t>& edges) {
  if (edges.empty()) return "FALSE";
  if (edges.size() == 1) return "step = " + smv_step(edges[0]);
  std::string list;
  for (const std::uint32_t edge : edges) append(list, ", ", smv_step(edge));
  return "step in {" + list + "}";
}

std::vector<std::uint32_t> free_moves(const Network& network) {
  std::vector<std::uint32_t> edges;
  for (const Automaton& automaton : network.automata) {
    if (!moves_freely(automaton)) continue;
    for (std::uint32_t e = 0; e < automaton.edges.size(); ++e) {
      edges.push_back(automaton.first_edge + e);
    }
  }
  return edges;
}

std::string smv_steps(const Network& network, const PromelaNames& names,
                      SmvProgress progress) {
  return Steps(network, names).text(progress);
}

std::string smv_death(const Network& network, const PromelaNames& names) {
  return Steps(network, names).death();
}

}  // namespace btcheck
