// SPDX-License-Identifier: MIT
//
// The network as a model for SPIN (Holzmann, "The SPIN Model Checker", 2004).
//
// One process with one loop and global variables. A process for each automaton
// would read better, but would add its own program counter to the state; so
// locations are named values of a variable. No run ends: idle steps are written
// out, and no verdict depends on how SPIN extends finite runs.
//
// Each edge is one option, a d_step: SPIN then stores a state at the head of
// the loop and nowhere else. Time is one more option. Rules about all edges (a
// timer that is due goes first, time waits for urgent edges) are macros before
// the loop, one for each automaton, grouped by location. SPIN leaves variables
// that are never read out of its states; so an option that is never taken reads
// them.
#include "model/export/promela/promela.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <utility>

#include "model/export/layout.hpp"
#include "model/export/names.hpp"
#include "model/export/steps.hpp"

namespace btcheck {
namespace {

constexpr std::string_view kAnd = kPromelaSigns.conjunction;
constexpr std::string_view kOr = kPromelaSigns.disjunction;

std::string lines(std::string_view text, std::size_t indent,
                  std::string_view line_end = {}) {
  return filled(text, indent, line_end, {kAnd, kOr});
}

std::string macro(std::string_view name, std::string_view body) {
  return fmt::format("#define {} \\\n  ({})\n", name, lines(body, 3, " \\"));
}

std::string_view type_for(std::int64_t min, std::int64_t max) {
  if (min >= 0 && max <= 1) return "bit";
  if (min >= 0 && max <= 255) return "byte";
  return min >= -32768 && max <= 32767 ? "short" : "int";
}

std::string constants_text(const std::vector<ExportNames::Constant>& all) {
  std::string text;
  for (const auto& constant : all) {
    text += fmt::format("#define {} {}\n", constant.name, constant.value);
  }
  return text;
}

class Model {
 public:
  Model(const BehaviorTree& tree, const Network& network,
        const std::vector<ExportClaim>& claims)
      : tree_(tree),
        network_(network),
        claims_(claims),
        names_(network),
        language_(network, names_, kPromelaSigns),
        conditions_(language_),
        is_progress_told_(has_free_moves(network) && !claims.empty()),
        due_(conditions_.timer_is_due()) {}

  Result<std::string> text() {
    Result<std::string> result;
    result.diagnostics = language_.refusals(tree_, claims_);
    if (!result.diagnostics.empty()) return result;
    std::string text =
        model_heading(tree_, network_.ticks, "/* ", " * ") + " */\n\n";
    text += declarations();
    add_process(text);
    for (const ExportClaim& claim : claims_) text += claim_text(claim);
    result.value = std::move(text);
    return result;
  }

 private:
  std::string variable_text(VariableId id) const {
    const Variable& variable = network_.variable(id);
    return constants_text(names_.constants(id)) +
           fmt::format("{} {} = {};\n", type_for(variable.min, variable.max),
                       names_.variable(id), names_.value(id, variable.initial));
  }

  std::string automaton_text(AutomatonId id) const {
    const Automaton& automaton = network_.automaton(id);
    std::string text;
    if (!moves_freely(automaton)) {
      text += fmt::format("\n/* process {}: {} */\n", index(id) + 1,
                          comment_text(automaton.name));
    }
    for (const VariableId own : declared_variables(network_, automaton)) {
      text += variable_text(own);
    }
    const int bound = clock_bound(automaton);
    if (bound > 0) {
      text += fmt::format("{} {} = 0;\n", type_for(0, bound), names_.clock(id));
    }
    return text;
  }

  std::string declarations() const {
    std::string text = "/* the values of every rstatus */\n" +
                       constants_text(names_.statuses());
    for (const VariableId id : network_.state_variable) {
      text += fmt::format("\n/* state variable {} */\n",
                          comment_text(network_.variable(id).name)) +
              variable_text(id);
    }
    for (std::uint32_t a = 0; a < network_.automata.size(); ++a) {
      text += automaton_text(AutomatonId{a});
    }
    if (network_.fault) {
      text += "\n/* an assignment has left its range */\n" +
              variable_text(*network_.fault);
    }
    if (is_progress_told_) {
      text +=
          "\n/* the last step was not the move of a free variable */\n"
          "bit progress = 1;\n";
    }
    return text;
  }

  // Most of the text: it is made in its place.
  void add_process(std::string& text) {
    text += "\n";
    if (!due_.empty()) {
      text +=
          "/* goes before every other step */\n" + macro("timer_is_due", due_);
    }
    text += move_macro() + urgency_macros() +
            "\nactive proctype network() {\n  do\n";
    for (std::uint32_t a = 0; a < network_.automata.size(); ++a) {
      for (const Edge& edge : network_.automata[a].edges) {
        text += edge_option(AutomatonId{a}, edge);
      }
    }
    text += time_options() + unread_option() + "  od\n}\n";
  }

  std::string no_fault() const { return network_.fault ? "!fault" : ""; }

  std::string move_macro() {
    may_move_ = no_fault();
    if (!due_.empty()) append(may_move_, kAnd, "!timer_is_due");
    if (may_move_.empty()) return {};
    const std::string text = macro("may_move", may_move_);
    may_move_ = "may_move";
    return text;
  }

  std::string urgency_at(AutomatonId id, LocationId location) const {
    std::vector<std::string> ways;
    const Automaton& automaton = network_.automaton(id);
    for (const Edge& edge : automaton.edges) {
      if (edge.source != location) continue;
      if (!is_binding(network_.ticks, automaton, edge)) continue;
      std::string way =
          edge.guard.is_true() ? "" : language_.condition(edge.guard);
      if (network_.ticks != TickSemantics::None) {
        append(way, kAnd, conditions_.is_last_moment(id, edge));
      }
      if (std::ranges::find(ways, way) == ways.end()) ways.push_back(way);
    }
    if (ways.empty()) return {};
    std::string urgent = conditions_.is_at(automaton, location);
    if (std::ranges::find(ways, "") != ways.end()) return urgent;
    std::string either;
    for (const std::string& way : ways) {
      append(either, kOr, ways.size() == 1 ? way : "(" + way + ")");
    }
    append(urgent, kAnd, ways.size() == 1 ? either : "(" + either + ")");
    return urgent;
  }

  std::string urgency_macros() const {
    std::string text = "\n/* what must happen before time passes */\n";
    std::string any;
    for (std::uint32_t a = 0; a < network_.automata.size(); ++a) {
      const Automaton& automaton = network_.automata[a];
      std::string urgent;
      for (std::uint32_t i = 0; i < automaton.locations.size(); ++i) {
        const std::string here = urgency_at(AutomatonId{a}, LocationId{i});
        append(urgent, kOr, here.empty() ? "" : "(" + here + ")");
      }
      if (urgent.empty()) continue;
      text += macro(names_.urgency(AutomatonId{a}), urgent);
      append(any, kOr, names_.urgency(AutomatonId{a}));
    }
    return text + macro("is_urgent", any.empty() ? "0" : any);
  }

  std::string when_to_fire(AutomatonId id, const Edge& edge) const {
    std::string when = may_move_;
    const bool is_timer = network_.automaton(id).kind == AutomatonKind::Timer;
    if (is_timer && !due_.empty()) {
      when = no_fault();
      append(when, kAnd, conditions_.turn(id, edge));
    }
    append(when, kAnd, conditions_.is_ready(id, edge));
    return when;
  }

  // Whoever changes the location of an automaton starts its clock anew.
  std::string assigned(VariableId variable, const std::string& value) const {
    std::string text =
        fmt::format("       {} = {};\n", names_.variable(variable), value);
    const auto moved = automaton_at(network_, variable);
    if (moved && clock_bound(network_.automaton(*moved)) > 0) {
      text += fmt::format("       {} = 0;\n", names_.clock(*moved));
    }
    return text;
  }

  std::string edge_option(AutomatonId id, const Edge& edge) const {
    const Automaton& automaton = network_.automaton(id);
    std::string text = fmt::format("  /* {} */\n  :: d_step {{\n       {} ->\n",
                                   edge_remark(automaton, edge),
                                   lines(when_to_fire(id, edge), 7));
    for (const Assignment& update : edge.updates) {
      text += assigned(update.variable,
                       language_.assigned(update.value, update.variable));
    }
    if (is_progress_told_) {
      text += moves_freely(automaton) ? "       progress = 0;\n"
                                      : "       progress = 1;\n";
    }
    text += assigned(
        automaton.location,
        names_.value(automaton.location,
                     location_value(network_, automaton, edge.target)));
    text.erase(text.size() - 2);  // the last semicolon
    return text + "\n     }\n";
  }

  // The clocks one unit later, up to what the edges can tell apart.
  std::string later() const {
    std::string text;
    for (std::uint32_t a = 0; a < network_.automata.size(); ++a) {
      const std::string runs = conditions_.clock_runs(AutomatonId{a});
      if (runs.empty()) continue;
      const std::string& clock = names_.clock(AutomatonId{a});
      text +=
          fmt::format("       {}\n",
                      lines(fmt::format("{0} = {0} + ({1});", clock, runs), 9));
    }
    return text;
  }

  std::string time_options() const {
    std::string steps = later();
    if (is_progress_told_) steps += "       progress = 1;\n";
    std::string text = "  /* a step of time */\n";
    std::string when = no_fault();
    append(when, kAnd, "!is_urgent");
    if (steps.empty()) {
      text += "  :: " + when + "\n";
    } else {
      steps.erase(steps.size() - 2);
      text += "  :: d_step {\n       " + when + " ->\n" + steps + "\n     }\n";
    }
    if (!network_.fault) return text;
    return text + "  /* a fault has ended the run */\n" +
           (is_progress_told_ ? "  :: d_step { fault -> progress = 1 }\n"
                              : "  :: fault\n");
  }

  std::vector<bool> variables_read() const {
    std::vector<bool> read(network_.variables.size(), false);
    auto mark = [&](const Expression& expression) {
      for (const Term& term : expression.terms()) {
        if (term.operation != Operation::Variable) continue;
        read[static_cast<std::size_t>(term.operand)] = true;
      }
    };
    for (const Automaton& automaton : network_.automata) {
      if (!automaton.edges.empty()) read[index(automaton.location)] = true;
      for (const Edge& edge : automaton.edges) {
        mark(edge.guard);
        for (const Assignment& update : edge.updates) mark(update.value);
      }
    }
    if (network_.fault) read[index(*network_.fault)] = true;
    return read;
  }

  std::string unread_option() const {
    const std::vector<bool> read = variables_read();
    std::string unread;
    for (std::uint32_t v = 0; v < read.size(); ++v) {
      if (!read[v]) append(unread, kOr, names_.variable(VariableId{v}));
    }
    if (is_progress_told_) append(unread, kOr, "progress");
    if (unread.empty()) return {};
    return "  /* never: without it SPIN leaves these out of its states */\n"
           "  :: " +
           lines("false && (" + unread + ")", 5) + "\n";
  }

  std::string claim_text(const ExportClaim& claim) const {
    const auto name = [&](std::size_t proposition) {
      return fmt::format("{}_p{}", claim.name, proposition);
    };
    std::string text = "\n" + remark_lines(claim.remarks, "/* ", " */");
    for (std::size_t i = 0; i < claim.propositions.size(); ++i) {
      text += macro(name(i), language_.condition(claim.propositions[i]));
    }
    const std::string formula = with_propositions(claim.formula, name);
    return text + (is_progress_told_
                       ? fmt::format("ltl {} {{ ([] (<> (progress == 1))) -> "
                                     "({}) }}\n",
                                     claim.name, formula)
                       : fmt::format("ltl {} {{ {} }}\n", claim.name, formula));
  }

  const BehaviorTree& tree_;
  const Network& network_;
  const std::vector<ExportClaim>& claims_;
  ExportNames names_;
  ExportLanguage language_;
  StepConditions conditions_;
  bool is_progress_told_;
  std::string due_;       // when a timer goes before every other step
  std::string may_move_;  // what is asked of every edge
};

}  // namespace

Result<std::string> promela_text(const BehaviorTree& tree,
                                 const Network& network,
                                 const std::vector<ExportClaim>& claims) {
  return Model(tree, network, claims).text();
}

}  // namespace btcheck
