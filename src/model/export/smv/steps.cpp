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
#include <utility>

#include "model/export/layout.hpp"

namespace btcheck {
namespace {

constexpr std::string_view kAnd = " & ";
constexpr std::string_view kOr = " | ";

// The value of the input variable `step` that stands for an edge.
std::string step_of(std::uint32_t edge) { return fmt::format("edge_{}", edge); }

// The condition that the step is one of these edges; FALSE when there is none.
std::string step_among(const std::vector<std::uint32_t>& edges) {
  if (edges.empty()) return "FALSE";
  if (edges.size() == 1) return "step = " + step_of(edges[0]);
  std::string list;
  for (const std::uint32_t edge : edges) append(list, ", ", step_of(edge));
  return "step in {" + list + "}";
}

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
  explicit Steps(const SmvLanguage& language)
      : network_(language.network()),
        names_(language.names()),
        language_(language),
        conditions_(language),
        due_(conditions_.timer_is_due()) {}

  std::string text(Progress progress) {
    collect_changes();
    std::string text = input() + "\nDEFINE\n";
    if (!due_.empty()) {
      text += "  -- goes before every other step\n  timer_is_due :=\n    " +
              smv_lines(due_, 4) + ";\n";
    }
    each_edge([&](AutomatonId id, const Edge& edge, std::uint32_t number) {
      text += edge_definition(id, edge, number);
    });
    text += urgency_definition() + "\n-- when each step may be taken\n";
    each_edge([&](AutomatonId, const Edge&, std::uint32_t number) {
      text += fmt::format("TRANS step = {0} -> {0}_may;\n", step_of(number));
    });
    text += fmt::format("TRANS step = {} -> !is_urgent;\n", kSmvTimeStep);
    return text + next_values() + next_clocks() + next_progress(progress);
  }

  std::string death() const {
    std::string may;
    each_edge([&](AutomatonId, const Edge&, std::uint32_t number) {
      append(may, kOr, step_of(number) + "_may");
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

  std::string input() const {
    std::string steps = kSmvTimeStep;
    each_edge([&](AutomatonId, const Edge&, std::uint32_t number) {
      steps += ", " + step_of(number);
    });
    return "\n-- who takes the next step\nIVAR\n  step : {" +
           filled(steps, 4, "", {", "}) + "};\n";
  }

  std::string edge_definition(AutomatonId id, const Edge& edge,
                              std::uint32_t number) const {
    std::string may = no_fault();
    append(may, kAnd, conditions_.is_ready(id, edge));
    if (!due_.empty()) append(may, kAnd, conditions_.turn(id, edge));
    return fmt::format("  -- {}\n  {}_may :=\n    {};\n",
                       edge_remark(network_.automaton(id), edge),
                       step_of(number), smv_lines(may, 4));
  }

  std::string urgency_definition() const {
    std::string urgent;
    each_edge([&](AutomatonId id, const Edge& edge, std::uint32_t number) {
      if (!is_binding(network_.ticks, network_.automaton(id), edge)) return;
      std::string one = step_of(number) + "_may";
      if (network_.ticks != TickSemantics::None) {
        append(one, kAnd, conditions_.is_last_moment(id, edge));
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
          {automaton.location, Expression::constant(location_value(
                                   network_, automaton, edge.target))});
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
        cases += one_case(step_among(change.edges), change.value);
      }
      text += next_value(names_.variable(VariableId{v}), std::move(cases));
    }
    return text;
  }

  // Where the clock runs and has not reached its end.
  std::string runs(AutomatonId id) const {
    const std::string where = conditions_.clock_runs(id);
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
      text += next_value(clock, one_case(step_among(resets_[a]), "0") +
                                    one_case(fmt::format("step = {} & ({})",
                                                         kSmvTimeStep, when),
                                             clock + " + 1"));
    }
    return text.empty()
               ? text
               : "\n-- clocks, up to what intervals tell apart\n" + text;
  }

  std::string next_progress(Progress progress) const {
    if (progress == Progress::Untold) return {};
    std::vector<AutomatonId> free;
    for (std::uint32_t a = 0; a < network_.automata.size(); ++a) {
      if (moves_freely(network_.automata[a])) free.push_back(AutomatonId{a});
    }
    return "\nTRANS next(progress) = !(" +
           filled(smv_step_by(network_, free), 2, "", {", "}) + ");\n";
  }

  const Network& network_;
  const ExportNames& names_;
  const SmvLanguage& language_;
  StepConditions conditions_;
  std::string due_;               // when a timer goes before every other step
  std::vector<Changes> changes_;  // by VariableId
  std::vector<std::vector<std::uint32_t>> resets_;  // by AutomatonId
};

}  // namespace

std::string SmvLanguage::number_of(VariableId id) const {
  const Variable& read = network().variable(id);
  std::string text = "(case ";
  for (int value = read.min; value < read.max; ++value) {
    text += fmt::format("{} = {} : {}; ", names().variable(id),
                        names().value(id, value), value);
  }
  return text + fmt::format("TRUE : {}; esac)", read.max);
}

std::string SmvLanguage::value_of(VariableId id,
                                  const std::string& number) const {
  const Variable& read = network().variable(id);
  std::string text = "(case ";
  for (int value = read.min; value < read.max; ++value) {
    text += fmt::format("({}) = {} : {}; ", number, value,
                        names().value(id, value));
  }
  return text + fmt::format("TRUE : {}; esac)", names().value(id, read.max));
}

std::string smv_lines(std::string_view text, std::size_t indent) {
  return filled(text, indent, "", {" & ", " | "});
}

std::string smv_step_by(const Network& network,
                        const std::vector<AutomatonId>& movers) {
  std::vector<std::uint32_t> edges;
  for (const AutomatonId mover : movers) {
    const Automaton& automaton = network.automaton(mover);
    for (std::uint32_t e = 0; e < automaton.edges.size(); ++e) {
      edges.push_back(automaton.first_edge + e);
    }
  }
  return step_among(edges);
}

std::string smv_steps(const SmvLanguage& language, Progress progress) {
  return Steps(language).text(progress);
}

std::string smv_death(const SmvLanguage& language) {
  return Steps(language).death();
}

}  // namespace btcheck
