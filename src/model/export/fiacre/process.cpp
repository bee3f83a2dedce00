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
        automaton_(network_.automaton(id)),
        link_(language.link(id)) {}

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
    if (link_) {
      const std::string asks = language_.state(id_, link_->asks);
      if (is_task()) names += fmt::format(", {}_sync", asks);
      names += fmt::format(", {}_answer, breach", asks);
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
    if (link_) {
      append(text, ",\n    ",
             link_->kind == FiacreLinkKind::SetSV
                 ? "answer : int := 0"
                 : "answer : status := status_no_ret_status");
      if (is_task()) text += ",\n    is_halted : bool := false";
    }
    return text.empty() ? text : "var " + text + "\n";
  }

  bool is_task() const { return link_->kind == FiacreLinkKind::Action; }

  // "(20, sv_fls * 2)"
  std::string call_arguments() const {
    std::string text = fmt::format("{}", link_->node);
    for (const Expression& argument : link_->arguments) {
      text += ", " + language_.as_number(argument);
    }
    return "(" + text + ")";
  }

  // What a leaf has to say for an edge to be taken: the answer that it leads
  // to, of a SetSV the value. An edge to `error` belongs to the one before it.
  std::vector<std::string> answers() const {
    std::vector<std::string> all;
    std::string last;
    for (const Edge& edge : automaton_.edges) {
      if (edge.source != link_->asks) {
        all.emplace_back();
        continue;
      }
      const LocationRole role = automaton_.target(edge).role;
      if (link_->kind == FiacreLinkKind::SetSV) {
        const auto value = edge.updates.at(0).value.only(Operation::Constant);
        last = fmt::format("answer = {}", value.value_or(0));
      } else if (role == LocationRole::Success) {
        last = "answer = status_success";
      } else if (role == LocationRole::Failure) {
        last = "answer = status_failure";
      } else if (role == LocationRole::Running) {
        last = "answer = status_running";
      }
      all.push_back(last);
    }
    return all;
  }

  // Where a leaf may do more than fail: the condition, "" where always. Where
  // it may not it is not asked.
  std::string is_open() const {
    std::string some;
    for (const Edge& edge : automaton_.edges) {
      const LocationRole role = automaton_.target(edge).role;
      if (edge.source != link_->asks || role == LocationRole::Failure ||
          !is_answer(role)) {
        continue;
      }
      const std::string when = StepConditions(language_).guard(edge);
      if (when.empty()) return "";
      const std::string one = "(" + when + ")";
      if (some.find(one) == some.npos) append(some, " or ", one);
    }
    return some;
  }

  // The transitions of H-Fiacre in place of the choice: the leaf is asked, and
  // its answer chooses among the edges that the model has. Any other answer
  // breaks the contract.
  std::string linked(LocationId from) const {
    const std::string at = language_.state(id_, from);
    const std::string open = is_open();
    const std::vector<std::string> said = answers();
    std::string before = network_.fault ? "fault = 0" : "";
    std::vector<std::string> unasked;
    std::vector<std::string> ways;
    std::string allowed;
    for (std::size_t e = 0; e < automaton_.edges.size(); ++e) {
      const Edge& edge = automaton_.edges[e];
      if (edge.source != from) continue;
      const FiacrePort firing = time_.firings(id_, edge).front();
      const bool is_failure = said[e] == "answer = status_failure";
      const std::string when = StepConditions(language_).guard(edge);
      if (said[e].empty()) {
        unasked.push_back(alternative(edge, firing));
        continue;
      }
      if (is_failure && !open.empty()) {
        unasked.push_back(
            alternative(edge, firing, fmt::format("not ({})", open)));
      }
      ways.push_back(alternative(edge, firing, said[e]));
      std::string one = said[e];
      append(one, " and ", when);
      append(allowed, " or ", "(" + one + ")");
    }
    std::string asked = before;
    if (!open.empty()) append(asked, " and ", "(" + open + ")");
    const std::string guard_text =
        asked.empty()
            ? ""
            : "     on " + filled(asked, 8, "", {" and ", " or "}) + ";\n";
    std::string ask = "/* asks */\n" + guard_text;
    if (is_task()) {
      ask += fmt::format("     start {} {};\n     to {}_sync\n",
                         link_->function, call_arguments(), at);
    } else {
      ask +=
          at_once() + fmt::format("     answer := {} {};\n     to {}_answer\n",
                                  link_->function, call_arguments(), at);
    }
    unasked.push_back(ask);
    append(before, " and ", "not (" + allowed + ")");
    ways.push_back("/* breaks the contract */\n     on " +
                   filled(before, 8, "", {" and ", " or "}) + ";\n" +
                   at_once() + "     to breach\n");
    std::string text = from_text(at, unasked);
    if (is_task()) {
      text += fmt::format(
          "from {0}_sync\n     sync {1} answer;\n     to {0}_answer\n", at,
          link_->function);
    }
    return text + from_text(at + "_answer", ways);
  }

  // How a transition that takes no time is written here.
  std::string at_once() const {
    for (const Edge& edge : automaton_.edges) {
      if (edge.when != kAtOnce) continue;
      const FiacrePort firing = time_.firings(id_, edge).front();
      return firing.name.empty() ? "     wait [0,0];\n"
                                 : fmt::format("     {};\n", firing.name);
    }
    return "";
  }

  static std::string from_text(const std::string& state,
                               const std::vector<std::string>& ways) {
    if (ways.empty()) return {};
    std::string text = fmt::format("from {}\n", state);
    if (ways.size() == 1) return text + "     " + ways[0];
    for (std::size_t i = 0; i < ways.size(); ++i) {
      text += (i == 0 ? "  select\n     " : "  [] ") + ways[i];
    }
    return text + "  end\n";
  }

  // `from STATE` and all alternatives; nothing where nothing leads on. Where
  // the location is in a variable, there is one state, and all edges lead from
  // it.
  std::string transition(std::optional<LocationId> from) const {
    if (link_ && from == link_->asks) return linked(*from);
    std::vector<std::string> ways;
    for (const Edge& edge : automaton_.edges) {
      if (from && edge.source != *from) continue;
      for (const FiacrePort& firing : time_.firings(id_, edge)) {
        ways.push_back(alternative(edge, firing));
      }
    }
    return from_text(language_.state(id_, from.value_or(LocationId{})), ways);
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

  // `also`: a condition besides the edge's own.
  std::string alternative(const Edge& edge, const FiacrePort& firing,
                          const std::string& also = {}) const {
    std::string text = comment(edge);
    const auto add = [&](const std::string& statement) {
      text += "     " + statement + ";\n";
    };
    std::string when = guard(edge);
    append(when, " and ", also);
    if (!when.empty()) {
      add("on " + filled(when, 8, "", {" and ", " or "}));
    }
    if (!firing.name.empty()) {
      add(firing.name);
    } else if (firing.when != kAnyTime) {
      add("wait " + fiacre_interval(firing.when));
    }
    if (link_ && is_task() &&
        automaton_.locations[index(edge.source)].role == LocationRole::Halt) {
      add(fmt::format("is_halted := {} ({})", link_->halt, link_->node));
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
  const std::optional<FiacreLink>& link_;
};

}  // namespace

FiacreLanguage::FiacreLanguage(const Network& network, const ExportNames& names,
                               const FiacreLinks& links)
    : ExportLanguage(network, names,
                     {"Fiacre", " and ", " or ", "not ", " = ", "", " % ",
                      "true", "false"}),
      links_(links),
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
    if (links_.of[a]) {
      for (const Expression& argument : links_.of[a]->arguments) read(argument);
    }
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
