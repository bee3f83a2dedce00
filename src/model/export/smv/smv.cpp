// SPDX-License-Identifier: MIT
//
// The network as a model for NuSMV (Cimatti et al., CAV 2002) and nuXmv.
//
// One module over global variables: locations, callers and statuses are
// enumerations with names, clocks are bounded integers. A claim about single
// states becomes an INVARSPEC, one in LTL an LTLSPEC, one in CTL a CTLSPEC. SMV
// looks at infinite runs only, which hides nothing here: no run ends.
#include "model/export/smv/smv.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <utility>

#include "model/export/language.hpp"
#include "model/export/layout.hpp"
#include "model/export/names.hpp"
#include "model/export/steps.hpp"

namespace btcheck {
namespace {

constexpr std::string_view kAnd = " & ";
constexpr std::string_view kOr = " | ";
constexpr const char* kTimeStep = "time_passes";

// Broken into lines after & and |; lines but the first begin with `indent`
// blanks.
std::string lines(std::string_view text, std::size_t indent) {
  return filled(text, indent, "", {kAnd, kOr});
}

// An enumeration of SMV has no order and is no number: where a number is asked
// for, it is told case by case.
class SmvLanguage final : public ExportLanguage {
 public:
  // Both must outlive it.
  SmvLanguage(const Network& network, const ExportNames& names)
      : ExportLanguage(
            network, names,
            {"SMV", kAnd, kOr, "!", " = ", " != ", " mod ", "TRUE", "FALSE"}) {}

  std::string number_of(VariableId id) const override {
    return by_case(id, names().variable(id), true);
  }
  std::string value_of(VariableId id,
                       const std::string& number) const override {
    return by_case(id, "(" + number + ")", false);
  }

 private:
  // The value's number where `read` is its name, or the other way round.
  std::string by_case(VariableId id, const std::string& read,
                      bool is_name) const {
    const auto told = [&](int value, bool as_name) {
      return as_name ? names().value(id, value) : std::to_string(value);
    };
    const Variable& variable = network().variable(id);
    std::string text = "(case ";
    for (int value = variable.min; value < variable.max; ++value) {
      text += fmt::format("{} = {} : {}; ", read, told(value, is_name),
                          told(value, !is_name));
    }
    return text + "TRUE : " + told(variable.max, !is_name) + "; esac)";
  }
};

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

// The condition that one of these automata takes the step.
std::string step_by(const Network& network,
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

// What the updates of an edge come to, each value over the state before: they
// are executed in order here and all at once in SMV, so what one reads that an
// earlier one wrote is replaced by what was written.
std::vector<Assignment> at_once(const std::vector<Assignment>& updates) {
  std::vector<Assignment> result;
  for (const Assignment& update : updates) {
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

// The steps of a network as constraints. SMV has no processes that take turns
// (its keyword `process` is gone), so an input variable `step` says who moves:
// one value for each edge, and one for time. The next values are constraints
// (TRANS), not assignments (ASSIGN): of those NuSMV wants to see that no value
// leaves its range without looking at the guard.
class Steps {
 public:
  explicit Steps(const SmvLanguage& language)
      : network_(language.network()),
        names_(language.names()),
        language_(language),
        conditions_(language),
        due_(conditions_.timer_is_due()) {}

  // The declaration of `step`, the definitions that say when each step may be
  // taken, and for each variable what it is afterwards.
  std::string text(Progress progress) {
    collect_changes();
    std::string text = input() + "\nDEFINE\n";
    if (!due_.empty()) {
      text += "  -- goes before every other step\n  timer_is_due :=\n    " +
              lines(due_, 4) + ";\n";
    }
    each_edge([&](AutomatonId id, const Edge& edge, std::uint32_t number) {
      text += edge_definition(id, edge, number);
    });
    text += urgency_definition() + "\n-- when each step may be taken\n";
    each_edge([&](AutomatonId, const Edge&, std::uint32_t number) {
      text += fmt::format("TRANS step = {0} -> {0}_may;\n", step_of(number));
    });
    text += fmt::format("TRANS step = {} -> !is_urgent;\n", kTimeStep);
    text += next_values();
    text += next_clocks() + next_progress(progress);
    return text;
  }

  // The definition of `is_dead`: no step but an idle one leads from the state.
  std::string death() const {
    std::string may;
    each_edge([&](AutomatonId, const Edge&, std::uint32_t number) {
      append(may, kOr, step_of(number) + "_may");
    });
    for (std::uint32_t a = 0; a < network_.automata.size(); ++a) {
      append(may, kOr, runs(AutomatonId{a}));
    }
    return "  is_dead :=\n    " +
           lines("!(" + (may.empty() ? "FALSE" : may) + ")", 6) + ";\n";
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
    std::string steps = kTimeStep;
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
                       step_of(number), lines(may, 4));
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
           lines(urgent.empty() ? "FALSE" : urgent, 4) + ";\n";
  }

  // What each step makes of each variable, and whose clocks it starts anew.
  void collect_changes() {
    changes_.resize(network_.variables.size());
    resets_.resize(network_.automata.size());
    each_edge([&](AutomatonId id, const Edge& edge, std::uint32_t number) {
      const Automaton& automaton = network_.automaton(id);
      std::vector<Assignment> updates = edge.updates;
      updates.push_back(
          {automaton.location, Expression::constant(location_value(
                                   network_, automaton, edge.target))});
      for (const Assignment& update : at_once(updates)) {
        add_change(changes_[index(update.variable)],
                   language_.assigned(update.value, update.variable), number);
        if (const auto moved = automaton_at(network_, update.variable)) {
          resets_[index(*moved)].push_back(number);
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
                       lines(value, 6));
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
      text += next_value(
          clock, one_case(step_among(resets_[a]), "0") +
                     one_case(fmt::format("step = {} & ({})", kTimeStep, when),
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
           filled(step_by(network_, free), 2, "", {", "}) + ");\n";
  }

  const Network& network_;
  const ExportNames& names_;
  const SmvLanguage& language_;
  StepConditions conditions_;
  std::string due_;               // when a timer goes before every other step
  std::vector<Changes> changes_;  // by VariableId
  std::vector<std::vector<std::uint32_t>> resets_;  // by AutomatonId
};

class Module {
 public:
  Module(const BehaviorTree& tree, const Network& network)
      : tree_(tree),
        network_(network),
        names_(network),
        language_(network, names_) {}

  Result<std::string> text(const std::vector<SmvClaim>& claims) const {
    Result<std::string> result;
    result.diagnostics = refusals(claims);
    if (!result.diagnostics.empty()) return result;
    const Progress progress = progress_of(claims);
    result.value = model_heading(tree_, network_.ticks, "-- ", "-- ") +
                   "MODULE main\n" + variables(progress) +
                   initial_values(progress) + Steps(language_).text(progress) +
                   claims_text(claims, progress);
    return result;
  }

 private:
  std::vector<Diagnostic> refusals(const std::vector<SmvClaim>& claims) const {
    std::vector<ExportClaim> asked;
    for (const SmvClaim& claim : claims) {
      std::vector<Expression>& conditions =
          asked.emplace_back(ExportClaim{claim.name, {}, {}}).propositions;
      for (const SmvProposition& proposition : claim.propositions) {
        conditions.push_back(proposition.condition);
        if (!proposition.when_dead) continue;
        conditions.push_back(*proposition.when_dead);
      }
    }
    return language_.refusals(tree_, asked);
  }

  Progress progress_of(const std::vector<SmvClaim>& claims) const {
    const bool asks_runs =
        std::ranges::any_of(claims, [](const SmvClaim& claim) {
          return claim.kind != SmvClaim::Kind::Invariant;
        });
    return asks_runs && has_free_moves(network_) ? Progress::Told
                                                 : Progress::Untold;
  }

  std::string type_of(VariableId id) const {
    const Variable& variable = network_.variable(id);
    if (!language_.is_enumeration(id)) {
      return fmt::format("{}..{}", variable.min, variable.max);
    }
    std::string values;
    for (int value = variable.min; value <= variable.max; ++value) {
      append(values, ", ", names_.value(id, value));
    }
    return "{" + filled(values, 4, "", {", "}) + "}";
  }

  std::string variable_text(VariableId id) const {
    return fmt::format("  {} : {};\n", names_.variable(id), type_of(id));
  }

  std::string variables(Progress progress) const {
    std::string text = "\nVAR\n";
    for (const VariableId id : network_.state_variable) {
      text += fmt::format("  -- state variable {}\n",
                          comment_text(network_.variable(id).name)) +
              variable_text(id);
    }
    for (std::uint32_t a = 0; a < network_.automata.size(); ++a) {
      const Automaton& automaton = network_.automata[a];
      const int bound = clock_bound(automaton);
      if (!moves_freely(automaton)) {
        text += fmt::format("  -- process {}: {}\n", a + 1,
                            comment_text(automaton.name));
      }
      for (const VariableId id : declared_variables(network_, automaton)) {
        text += variable_text(id);
      }
      if (bound == 0) continue;
      text +=
          fmt::format("  {} : 0..{};\n", names_.clock(AutomatonId{a}), bound);
    }
    if (network_.fault) {
      text += "  -- an assignment has left its range\n" +
              variable_text(*network_.fault);
    }
    if (progress == Progress::Told) {
      text +=
          "  -- the last step was not the move of a free variable\n"
          "  progress : boolean;\n";
    }
    return text;
  }

  std::string initial_values(Progress progress) const {
    std::string text = "\nINIT\n";
    std::string_view joint = "  ";
    for (std::uint32_t v = 0; v < network_.variables.size(); ++v) {
      const VariableId id{v};
      text += fmt::format("{}{} = {}", joint, names_.variable(id),
                          names_.value(id, network_.variable(id).initial));
      joint = " &\n  ";
    }
    for (std::uint32_t a = 0; a < network_.automata.size(); ++a) {
      if (clock_bound(network_.automata[a]) == 0) continue;
      text += fmt::format("{}{} = 0", joint, names_.clock(AutomatonId{a}));
    }
    if (progress == Progress::Told) text += " &\n  progress";
    return text + ";\n";
  }

  std::string proposition_text(const SmvProposition& proposition) const {
    if (proposition.kind == SmvProposition::Kind::Passes) {
      return fmt::format("step = {}", kTimeStep);
    }
    if (proposition.kind == SmvProposition::Kind::Moves) {
      return step_by(network_, proposition.movers);
    }
    const std::string alive = language_.condition(proposition.condition);
    if (!proposition.when_dead) return alive;
    return fmt::format("(is_dead ? {} : {})",
                       language_.condition(*proposition.when_dead), alive);
  }

  std::string claim_text(const SmvClaim& claim) const {
    const auto name = [&](std::size_t proposition) {
      return fmt::format("{}_p{}", claim.name, proposition);
    };
    std::string text = "\n" + remark_lines(claim.remarks, "-- ", "");
    if (!claim.propositions.empty()) text += "DEFINE\n";
    for (std::size_t i = 0; i < claim.propositions.size(); ++i) {
      text += fmt::format("  {} := {};\n", name(i),
                          filled(proposition_text(claim.propositions[i]), 4, "",
                                 {", ", " & ", " | "}));
    }
    return text + fmt::format("{} NAME {} := {};\n", keyword(claim.kind),
                              claim.name,
                              with_propositions(claim.formula, name));
  }

  static std::string_view keyword(SmvClaim::Kind kind) {
    switch (kind) {
      case SmvClaim::Kind::Linear:
        return "LTLSPEC";
      case SmvClaim::Kind::Branching:
        return "CTLSPEC";
      default:
        return "INVARSPEC";
    }
  }

  std::string claims_text(const std::vector<SmvClaim>& claims,
                          Progress progress) const {
    std::string texts;
    bool asks_death = false;
    for (const SmvClaim& claim : claims) {
      for (const SmvProposition& proposition : claim.propositions) {
        asks_death |= proposition.when_dead.has_value();
      }
      texts += claim_text(claim);
    }
    return (asks_death ? "\nDEFINE\n" + Steps(language_).death() : "") +
           (progress == Progress::Told ? "\nJUSTICE progress;\n" : "") + texts;
  }

  const BehaviorTree& tree_;
  const Network& network_;
  ExportNames names_;
  SmvLanguage language_;
};

}  // namespace

Result<std::string> smv_text(const BehaviorTree& tree, const Network& network,
                             const std::vector<SmvClaim>& claims) {
  return Module(tree, network).text(claims);
}

}  // namespace btcheck
