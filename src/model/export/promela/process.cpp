// SPDX-License-Identifier: MIT
//
// The steps of a network as the loop of one Promela process.
//
// Each edge is one option, a d_step: SPIN then stores a state at the head of
// the loop and nowhere else. Time is one option more. What the semantics say of
// all edges at once (a timer that is due goes first, time waits for what is
// urgent) stands before the loop in macros, one for each automaton, grouped by
// location. Nobody reads some variables; SPIN would leave those out of its
// states, so an option that is never taken reads them.
#include "model/export/promela/process.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "model/export/clock_bound.hpp"
#include "model/export/filled_lines.hpp"
#include "model/export/promela/expression.hpp"
#include "model/export/tree_comment.hpp"

namespace btcheck {
namespace {

constexpr std::string_view kAnd = " && ";
constexpr std::string_view kOr = " || ";

std::string filled(std::string_view text, std::size_t indent,
                   std::string_view line_end) {
  return btcheck::filled(text, indent, line_end, {kAnd, kOr});
}

class Process {
 public:
  Process(const Network& network, const PromelaNames& names,
          PromelaProgress progress)
      : network_(network), names_(names), progress_(progress) {}

  std::string text() {
    std::string text = "\n";
    text += due_macro();
    text += move_macro();
    text += urgency_macros();
    text += "\nactive proctype network() {\n  do\n";
    for (std::uint32_t a = 0; a < network_.automata.size(); ++a) {
      for (const Edge& edge : network_.automata[a].edges) {
        text += edge_option(AutomatonId{a}, edge);
      }
    }
    return text + time_options() + unread_option() + "  od\n}\n";
  }

 private:
  std::string of(const Expression& expression) const {
    return promela_expression(network_, names_, expression).text;
  }

  int value_at(const Automaton& automaton, LocationId location) const {
    return network_.variable(automaton.location).min +
           static_cast<int>(index(location));
  }

  std::string location_name(const Automaton& automaton,
                            LocationId location) const {
    return names_.value(automaton.location, value_at(automaton, location));
  }

  std::string is_at(const Automaton& automaton, LocationId location) const {
    return names_.variable(automaton.location) +
           " == " + location_name(automaton, location);
  }

  // The clock has the value; nothing where no clock runs: there it is 0.
  std::string clock_is(AutomatonId id, LocationId location, int value) const {
    if (clock_bound(network_.automaton(id), location) == 0) return {};
    return fmt::format("{} == {}", names_.clock(id), value);
  }

  // --- what is said of all edges at once ---

  std::string due_macro() {
    std::string due;
    for (std::uint32_t a = 0; a < network_.automata.size(); ++a) {
      const Automaton& automaton = network_.automata[a];
      if (automaton.kind != AutomatonKind::Timer) continue;
      for (const Edge& edge : automaton.edges) {
        if (!can_be_late(automaton, edge)) continue;
        std::string one = is_at(automaton, edge.source);
        append(one, kAnd,
               clock_is(AutomatonId{a}, edge.source, edge.when.upper));
        append(due, kOr, "(" + one + ")");
      }
    }
    if (due.empty()) return {};
    has_timers_ = true;
    return "/* goes before every other step */\n" +
           promela_macro("timer_is_due", due);
  }

  std::string move_macro() {
    if (network_.fault) may_move_ = "!fault";
    if (has_timers_) append(may_move_, kAnd, "!timer_is_due");
    if (may_move_.empty()) return {};
    const std::string text = promela_macro("may_move", may_move_);
    may_move_ = "may_move";
    return text;
  }

  std::string urgency_at(AutomatonId id, LocationId location) const {
    std::vector<std::string> ways;
    const Automaton& automaton = network_.automaton(id);
    for (const Edge& edge : automaton.edges) {
      if (edge.source != location) continue;
      if (!is_binding(network_.ticks, automaton, edge)) continue;
      std::string way = edge.guard.is_true() ? "" : of(edge.guard);
      if (network_.ticks != TickSemantics::None) {
        append(way, kAnd, clock_is(id, location, edge.when.upper));
      }
      if (std::ranges::find(ways, way) == ways.end()) ways.push_back(way);
    }
    if (ways.empty()) return {};
    std::string urgent = is_at(automaton, location);
    if (std::ranges::find(ways, "") != ways.end()) return urgent;
    std::string either;
    for (const std::string& way : ways) {
      append(either, kOr, ways.size() == 1 ? way : "(" + way + ")");
    }
    append(urgent, kAnd, ways.size() == 1 ? either : "(" + either + ")");
    return urgent;
  }

  std::string urgency_macros() {
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
      text += promela_macro(names_.urgency(AutomatonId{a}), urgent);
      append(any, kOr, names_.urgency(AutomatonId{a}));
    }
    return text + promela_macro("is_urgent", any.empty() ? "0" : any);
  }

  // --- the options of the loop ---

  std::string when_to_fire(AutomatonId id, const Edge& edge) const {
    const Automaton& automaton = network_.automaton(id);
    std::string when = may_move_;
    if (automaton.kind == AutomatonKind::Timer && has_timers_) {
      when = network_.fault ? "!fault" : "";
      if (can_be_late(automaton, edge)) {
        const std::string now = clock_is(id, edge.source, edge.when.upper);
        if (!now.empty()) append(when, kAnd, "(" + now + " || !timer_is_due)");
      } else {
        append(when, kAnd, "!timer_is_due");
      }
    }
    append(when, kAnd, is_at(automaton, edge.source));
    for (const Expression& conjunct : edge.guard.conjuncts()) {
      const bool is_loose = conjunct.terms().back().operation == Operation::Or;
      append(when, kAnd, is_loose ? "(" + of(conjunct) + ")" : of(conjunct));
    }
    if (edge.when.lower > 0) {
      append(when, kAnd,
             fmt::format("{} >= {}", names_.clock(id), edge.when.lower));
    }
    return when;
  }

  // Whoever changes the location of an automaton starts its clock anew.
  std::string assigned(VariableId variable, const std::string& value) const {
    std::string text =
        fmt::format("       {} = {};\n", names_.variable(variable), value);
    for (std::uint32_t a = 0; a < network_.automata.size(); ++a) {
      const Automaton& automaton = network_.automata[a];
      if (automaton.location != variable) continue;
      if (greatest_clock_bound(automaton) == 0) continue;
      text += fmt::format("       {} = 0;\n", names_.clock(AutomatonId{a}));
    }
    return text;
  }

  std::string value_text(const Assignment& update) const {
    const auto terms = update.value.terms();
    const bool is_constant =
        terms.size() == 1 && terms[0].operation == Operation::Constant;
    return is_constant ? names_.value(update.variable, terms[0].operand)
                       : of(update.value);
  }

  std::string edge_option(AutomatonId id, const Edge& edge) const {
    const Automaton& automaton = network_.automaton(id);
    std::string text =
        fmt::format("  /* {}: {} -> {}{}{} */\n", comment_text(automaton.name),
                    comment_text(automaton.source(edge).name),
                    comment_text(automaton.target(edge).name),
                    edge.label.empty() ? "" : ", ", comment_text(edge.label));
    text += "  :: d_step {\n       " + filled(when_to_fire(id, edge), 7, "") +
            " ->\n";
    for (const Assignment& update : edge.updates) {
      text += assigned(update.variable, value_text(update));
    }
    if (progress_ == PromelaProgress::Told) {
      text += moves_freely(automaton) ? "       progress = 0;\n"
                                      : "       progress = 1;\n";
    }
    text += assigned(automaton.location, location_name(automaton, edge.target));
    text.erase(text.size() - 2);  // the last semicolon
    return text + "\n     }\n";
  }

  // The clocks one unit later, up to what the edges can tell apart.
  std::string later() const {
    std::string text;
    for (std::uint32_t a = 0; a < network_.automata.size(); ++a) {
      const Automaton& automaton = network_.automata[a];
      std::string runs;
      for (std::uint32_t i = 0; i < automaton.locations.size(); ++i) {
        const int bound = clock_bound(automaton, LocationId{i});
        if (bound == 0) continue;
        append(runs, kOr,
               fmt::format("({} && {} < {})", is_at(automaton, LocationId{i}),
                           names_.clock(AutomatonId{a}), bound));
      }
      if (runs.empty()) continue;
      const std::string& clock = names_.clock(AutomatonId{a});
      text += "       " +
              filled(fmt::format("{0} = {0} + ({1});", clock, runs), 9, "") +
              "\n";
    }
    return text;
  }

  std::string time_options() const {
    const bool is_told = progress_ == PromelaProgress::Told;
    std::string steps = later();
    if (is_told) steps += "       progress = 1;\n";
    std::string text = "  /* a step of time */\n";
    const std::string when =
        network_.fault ? "!fault && !is_urgent" : "!is_urgent";
    if (steps.empty()) {
      text += "  :: " + when + "\n";
    } else {
      steps.erase(steps.size() - 2);
      text += "  :: d_step {\n       " + when + " ->\n" + steps + "\n     }\n";
    }
    if (!network_.fault) return text;
    return text + "  /* a fault has ended the run */\n" +
           (is_told ? "  :: d_step { fault -> progress = 1 }\n"
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
    if (progress_ == PromelaProgress::Told) append(unread, kOr, "progress");
    if (unread.empty()) return {};
    return "  /* never: without it SPIN leaves these out of its states */\n"
           "  :: " +
           filled("false && (" + unread + ")", 5, "") + "\n";
  }

  const Network& network_;
  const PromelaNames& names_;
  PromelaProgress progress_;
  bool has_timers_ = false;
  std::string may_move_;  // what is asked of every edge
};

}  // namespace

std::string promela_macro(std::string_view name, std::string_view body) {
  return fmt::format("#define {} \\\n  ({})\n", name, filled(body, 3, " \\"));
}

std::string promela_process(const Network& network, const PromelaNames& names,
                            PromelaProgress progress) {
  return Process(network, names, progress).text();
}

}  // namespace btcheck
