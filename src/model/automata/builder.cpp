// SPDX-License-Identifier: MIT
//
// The frame of a node and the moves every family shares: calling a child,
// reading its answer, halting the children that run. Drawn after figure 5 and
// the listings of the paper's appendices; where a listing leaves something
// open the choice stands in docs/semantics.md.
#include "model/automata/builder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <stdexcept>

#include "model/automata/kept_arguments.hpp"
#include "text/budget.hpp"

namespace btcheck::mapping {
namespace {

// The names of the locations that every family draws.
LocationRole role_of(std::string_view name) {
  struct Named {
    std::string_view name;
    LocationRole role;
  };
  static constexpr std::array<Named, 11> kNamed = {
      {{"start_", LocationRole::Start},
       {"tick_node", LocationRole::Tick},
       {"evaluate", LocationRole::Evaluate},
       {"success", LocationRole::Success},
       {"failure", LocationRole::Failure},
       {"running", LocationRole::Running},
       {"skipped", LocationRole::Skipped},
       {"error", LocationRole::Error},
       {"halt", LocationRole::Halt},
       {"halted", LocationRole::Halted},
       {"done", LocationRole::Done}}};
  const auto known = std::ranges::find(kNamed, name, &Named::name);
  return known == kNamed.end() ? LocationRole::Inner : known->role;
}

}  // namespace

Expression negated(Expression of) {
  return Expression::unary(Operation::Not, std::move(of));
}

Expression either(Expression left, Expression right) {
  return Expression::binary(Operation::Or, std::move(left), std::move(right));
}

Assignment set(VariableId variable, int value) {
  return {variable, Expression::constant(value)};
}

Assignment set(VariableId variable, NodeStatus status) {
  return set(variable, static_cast<int>(status));
}

Expression is_defined(const Expression& over_network) {
  Expression defined;
  for (Expression& divisor : over_network.divisors()) {
    defined = both(std::move(defined),
                   Expression::binary(Operation::NotEqual, std::move(divisor),
                                      Expression::constant(0)));
  }
  return defined;
}

VariableId Context::add_variable(Variable variable) const {
  network.variables.push_back(std::move(variable));
  return VariableId{static_cast<std::uint32_t>(network.variables.size() - 1)};
}

Expression Context::over_network(const Expression& expression) const {
  return btcheck::over_network(network, expression);
}

std::vector<Assignment> Context::over_network(
    const std::vector<StateAssignment>& effects) const {
  std::vector<Assignment> updates;
  for (const StateAssignment& effect : effects) {
    updates.push_back({network.state_variable[index(effect.variable)],
                       over_network(effect.value)});
  }
  return updates;
}

VariableId Context::wake() {
  if (!wake_up) {
    wake_up = add_variable({VariableRole::Local, "wake", 0, 1, 0, {}});
  }
  return *wake_up;
}

std::vector<int> Context::sampled(StateVariableId variable) const {
  if (index(variable) < samples.size() && !samples[index(variable)].empty()) {
    return samples[index(variable)];
  }
  const StateVariable& of = tree.variable(variable);
  std::vector<int> all;
  for (std::int64_t value = of.min; value <= of.max; ++value) {
    all.push_back(static_cast<int>(value));
  }
  return all;
}

VariableId Context::fault() const {
  if (!network.fault) {
    network.fault = add_variable(
        {VariableRole::Fault, "fault", 0, 1, 0, {"false", "true"}});
  }
  return *network.fault;
}

Drawings::Drawings(In language, std::initializer_list<Family> families)
    : draws_(kNodeTypeCount, nullptr) {
  const auto refuse = [](NodeType type, std::string_view why) {
    throw std::logic_error(fmt::format("{} {}", type_name(type), why));
  };
  for (const Family family : families) {
    for (const auto& [type, draw] : family) {
      if (of(type) != nullptr) refuse(type, "is drawn twice");
      draws_[static_cast<std::size_t>(type)] = draw;
    }
  }
  for (const NodeTypeInfo& info : kNodeTypes) {
    const bool is_drawn = of(info.type) != nullptr;
    if (is_drawn == has(info.in, language)) continue;
    refuse(info.type,
           is_drawn ? "is drawn for a language without it" : "has no drawing");
  }
}

NodeBuilder::NodeBuilder(Context& context, NodeId node)
    : context_(context), id_(node), node_(context.tree.node(node)) {}

Automaton& NodeBuilder::automaton() {
  Network& network = context_.network;
  return network.automata[index(network.node_automaton[index(id_)])];
}

LocationId NodeBuilder::at(std::string_view name) {
  return at(name, role_of(name), {});
}

LocationId NodeBuilder::at(std::string_view name, LocationRole role,
                           NodeId child) {
  auto& locations = automaton().locations;
  const LocationId next{static_cast<std::uint32_t>(locations.size())};
  const auto [place, is_new] = places_.emplace(name, next);
  if (is_new) locations.push_back({place->first, role, child});
  return place->second;
}

std::string NodeBuilder::name_of(std::size_t i,
                                 std::string_view occasion) const {
  return unique_name(context_.tree, child(i)) + std::string(occasion);
}

LocationId NodeBuilder::calling(std::size_t i, std::string_view occasion) {
  return at(name_of(i, occasion), LocationRole::Call, child(i));
}

LocationId NodeBuilder::called(std::size_t i, std::string_view occasion) {
  return at(name_of(i, occasion) + "_done", LocationRole::Called, child(i));
}

bool NodeBuilder::calls(std::size_t i, std::string_view occasion) {
  return knows(name_of(i, occasion));
}

bool NodeBuilder::knows(std::string_view name) {
  return places_.contains(std::string(name));
}

bool NodeBuilder::has_edge(LocationId source, LocationId target) {
  return std::ranges::any_of(automaton().edges, [&](const Edge& edge) {
    return edge.source == source && edge.target == target;
  });
}

LocationId NodeBuilder::waiting_beside(LocationId location) {
  return at(automaton().locations[index(location)].name + "_wait");
}

VariableId NodeBuilder::local(std::string_view name, int min, int max,
                              int initial) {
  VariableId made = context_.add_variable(
      {VariableRole::Local, std::string(name), min, max, initial, {}});
  automaton().locals.push_back(made);
  return made;
}

VariableId NodeBuilder::rounds(std::string_view name, int most) {
  const VariableId made = local(name, 0, most, 0);
  context_.network.variables.back().local = LocalRole::Rounds;
  return made;
}

VariableId NodeBuilder::fault_phase() {
  if (!fault_phase_) {
    fault_phase_ = local("injected", 0, 2, 0);
    context_.network.variables.back().local = LocalRole::Fault;
  }
  return *fault_phase_;
}

void NodeBuilder::edge(LocationId source, LocationId target, Expression guard,
                       std::vector<Assignment> updates, std::string label) {
  ask_budget();
  Interval when =
      context_.network.ticks == TickSemantics::None ? kAnyTime : kAtOnce;
  automaton().edges.push_back({source, target, std::move(guard),
                               std::move(updates), when, std::move(label)});
}

void NodeBuilder::choice(LocationId source, LocationId target, Expression guard,
                         std::vector<Assignment> updates, std::string label) {
  edge(source, target, std::move(guard), std::move(updates), std::move(label));
  automaton().edges.back().asks_world = true;
}

void NodeBuilder::tells_why() { automaton().edges.back().tells_why = true; }

void NodeBuilder::is_like_time() {
  automaton().edges.back().is_like_time = true;
}

void NodeBuilder::executes(std::int32_t program, ScriptOutcomeKind outcome) {
  if (program == kNoProgram) return;
  automaton().edges.back().scripts.push_back({program, outcome});
}

void NodeBuilder::timed_edge(LocationId source, LocationId target,
                             Interval when, std::string label) {
  if (context_.network.ticks == TickSemantics::None) when = kAnyTime;
  automaton().edges.push_back({source, target, {}, {}, when, std::move(label)});
}

void NodeBuilder::status_edges(bool may_run) {
  const auto returns = [&](std::string_view word, NodeStatus status) {
    edge(at(word), at("done"), {}, {set(context_.status(id_), status)},
         "returns " + std::string(word));
  };
  returns("success", NodeStatus::Success);
  returns("failure", NodeStatus::Failure);
  if (may_run) {
    returns("running", NodeStatus::Running);
    edge(at("halted"), at("done"), {},
         {set(context_.status(id_), NodeStatus::Failure)}, "has been halted");
  }
  edge(at("done"), at("start_"), {}, {set(context_.caller(id_), 0)},
       "gives control back");
}

// A node that runs has its arguments; another one is given them now, and where
// one divides by zero the run ends.
void NodeBuilder::is_called_when(const Expression& called) {
  const VariableId status = context_.status(id_);
  Expression defined;
  for (const Argument& each : node_.arguments) {
    if (!each.known) continue;
    defined = both(std::move(defined),
                   is_defined(context_.over_network(each.known->value)));
  }
  if (!defined.is_true()) {
    defined = either(equals(status, NodeStatus::Running), std::move(defined));
    edge(at("start_"), at(kNoArguments, LocationRole::Error, {}),
         both(called, negated(defined)), {set(context_.fault(), 1)},
         "is given a division by zero");
  }
  edge(at("start_"), at("tick_node"), both(called, std::move(defined)),
       {set(status, NodeStatus::NoRetStatus)}, "is called");
}

void NodeBuilder::frame() {
  for (std::string_view location : {"start_", "tick_node", "success", "failure",
                                    "running", "halt", "halted", "done"}) {
    at(location);
  }
  const Expression is_called = differs(context_.caller(id_), 0);
  VariableId status = context_.status(id_);
  edge(at("start_"), at("halt"),
       both(is_called, equals(status, NodeStatus::HaltMe)), {},
       "is asked to halt");
  is_called_when(
      both(is_called, differs(status, static_cast<int>(NodeStatus::HaltMe))));
  status_edges(true);
}

void NodeBuilder::frame_without_running() {
  for (std::string_view location :
       {"start_", "tick_node", "success", "failure", "done"}) {
    at(location);
  }
  is_called_when(differs(context_.caller(id_), 0));
  status_edges(false);
}

bool NodeBuilder::is_timed() const {
  const TickSemantics ticks = context_.network.ticks;
  return ticks == TickSemantics::Nodes ||
         (ticks == TickSemantics::Leaves && is_leaf(node_.type));
}

LocationId NodeBuilder::decide() {
  if (!is_timed()) return at("tick_node");
  timed_edge(at("tick_node"), at("evaluate"), {1, 1});
  return at("evaluate");
}

LocationId NodeBuilder::call(std::size_t i) {
  const bool is_new = !calls(i);
  const LocationId from = calling(i);
  if (is_new) {
    edge(from, called(i), {}, {set(caller(i), 1)},
         "calls " + unique_name(context_.tree, child(i)));
  }
  return from;
}

Expression NodeBuilder::answered(std::size_t i, NodeStatus status) const {
  return both(equals(caller(i), 0), equals(context_.status(child(i)), status));
}

void NodeBuilder::on_answer(std::size_t i, NodeStatus status, LocationId target,
                            std::vector<Assignment> updates, Expression guard) {
  call(i);
  edge(called(i), target, both(answered(i, status), std::move(guard)),
       std::move(updates));
}

void NodeBuilder::halt_children(LocationId from, LocationId then,
                                std::vector<Assignment> updates) {
  LocationId waiting = waiting_beside(from);
  Expression none_runs;
  for (std::size_t i = 0; i < child_count(); ++i) {
    VariableId status = context_.status(child(i));
    VariableId caller = context_.caller(child(i));
    edge(from, waiting,
         both(several_children_may_run() ? none_runs : Expression{},
              equals(status, NodeStatus::Running)),
         {set(status, NodeStatus::HaltMe), set(caller, 1)},
         "halts " + unique_name(context_.tree, child(i)));
    none_runs = both(std::move(none_runs),
                     differs(status, static_cast<int>(NodeStatus::Running)));
  }
  edge(waiting, from, all_children_are_back());
  edge(from, then, none_runs, std::move(updates));
}

bool NodeBuilder::several_children_may_run() const {
  return info_of(node_.type).beside != Beside::None;
}

void NodeBuilder::on_halt(std::vector<Assignment> updates) {
  halt_children(at("halt"), at("halted"), std::move(updates));
}

void NodeBuilder::halted_by_caller(LocationId start,
                                   std::vector<Assignment> updates) {
  if (!node_.option) return;
  choice(at("running"), at("halt"), {}, {}, "is halted by its caller");
  halt_children(at("halt"), at("halted"), std::move(updates));
  edge(at("halted"), start);
}

Expression NodeBuilder::some_child_runs() const {
  Expression runs;
  for (const NodeId each : node_.children) {
    Expression this_runs = equals(context_.status(each), NodeStatus::Running);
    runs = runs.is_true() ? std::move(this_runs)
                          : either(std::move(runs), std::move(this_runs));
  }
  return runs;
}

Expression NodeBuilder::all_children_are_back() const {
  Expression back;
  for (const NodeId each : node_.children) {
    back = both(std::move(back), equals(context_.caller(each), 0));
  }
  return back;
}

bool NodeBuilder::takes_time() const {
  return node_.duration && node_.duration->max > 0;
}

Timer NodeBuilder::add_timer() {
  static_assert(kEndless == kUnbounded);
  return add_timer({node_.duration->min, node_.duration->max});
}

Timer NodeBuilder::add_timer(Interval duration) {
  Network& network = context_.network;
  VariableId location = context_.add_variable(
      {VariableRole::Location, "location", 0, 2, Timer::kIdle, {}});
  if (network.ticks == TickSemantics::None) duration = kAnyTime;
  Automaton timer;
  timer.kind = AutomatonKind::Timer;
  timer.name = unique_name(context_.tree, id_) + "_timer";
  timer.node = id_;
  timer.location = location;
  timer.locations = {{"idle"}, {"counting"}, {"due"}};
  Edge& due = timer.edges.emplace_back();
  due.source = LocationId{Timer::kCounting};
  due.target = LocationId{Timer::kDue};
  due.when = duration;
  due.label = "is due";
  network.automata.push_back(std::move(timer));
  return {location};
}

}  // namespace btcheck::mapping
