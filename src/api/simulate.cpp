// SPDX-License-Identifier: MIT
//
// One run of a tree, told as `btcheck simulate` tells it.
#include <cstdint>
#include <utility>

#include "api/call.hpp"
#include "api/told.hpp"
#include "check/simulate/course.hpp"
#include "explore/state/spent.hpp"
#include "report/formats/reported.hpp"
#include "trace/formats/text.hpp"
#include "trace/run/itf.hpp"
#include "trace/run/record.hpp"
#include "trace/viewer/html.hpp"

namespace btcheck::v1 {

// What the run is told by when it is over.
struct Simulation::Whole : LoweredInput {
  Whole(LoweredInput from, TreeInput read)
      : LoweredInput(std::move(from)), input(std::move(read)) {}

  TreeInput input;
  btcheck::Run run;
  std::string how;
};

namespace {

Ending ending_of(const btcheck::Simulation& simulation, const Plan& plan) {
  switch (simulation.end()) {
    case RunEnd::Ended:
      return Ending::Ended;
    case RunEnd::Fault:
      return Ending::Fault;
    case RunEnd::Stuck:
      return Ending::Stuck;
    case RunEnd::None:
      break;
  }
  return most_ticks(simulation) >= plan.ticks ? Ending::Ticks : Ending::Stopped;
}

void tell_state(const Simulation::Whole& whole, const Valuation& state,
                Simulation& told) {
  const BehaviorTree& tree = whole.tree;
  const Network& network = whole.network;
  for (std::uint32_t i = 0; i < tree.variables.size(); ++i) {
    const VariableId variable = network.state_variable[i];
    told.variables.push_back(
        {tree.variables[i].name,
         tree.variables[i].value_name(state.variables[index(variable)])});
  }
  const auto words = status_names(tree.profile);
  for (std::uint32_t i = 0; i < tree.nodes.size(); ++i) {
    const VariableId status = network.node_status[i];
    const auto word = static_cast<std::size_t>(state.variables[index(status)]);
    told.statuses.push_back(
        {unique_name(tree, NodeId{i}), std::string(words[word])});
  }
}

class Simulating {
 public:
  Simulating(const Plan& plan, CallSources& sources, Call& call,
             std::vector<Diagnostic>& found, Simulation& told)
      : plan_(plan),
        sources_(sources),
        call_(call),
        found_(found),
        told_(told) {}

  void simulate(Inputs inputs) {
    auto lowered = lowered_input(inputs.tree, inputs.judgement,
                                 inputs.ticks.value_or(TickSemantics::Root));
    add(lowered.diagnostics);
    if (!lowered.value) return;
    auto whole = std::make_shared<Simulation::Whole>(std::move(*lowered.value),
                                                     std::move(inputs.tree));
    TickLines lines(whole->tree, whole->network);
    auto [run, refused] = run_of_plan(*whole, lines);
    add(refused);
    if (!run) return;
    tell(*run, lines, *whole);
    if (has_error(refused)) told_.ending = Ending::Refused;
    told_.whole = std::move(whole);
  }

 private:
  void add(const std::vector<Diagnostic>& more) {
    found_.insert(found_.end(), more.begin(), more.end());
  }

  Result<btcheck::Simulation> run_of_plan(Simulation::Whole& whole,
                                          TickLines& lines) {
    const Course course{plan_.ticks,
                        [&] { return stopped() == Spent::Nothing; },
                        [&](const Valuation&, const RunStep& step) {
                          std::string line = lines.take(step);
                          if (!line.empty())
                            told_.lines.push_back(std::move(line));
                        }};
    // It ends between two steps, and what there is of it is told.
    const BudgetScope own_way(nullptr);
    if (plan_.seed) {
      whole.how = "seed " + std::to_string(*plan_.seed);
      return simulated_at_random(whole.tree, whole.network, *plan_.seed,
                                 course);
    }
    whole.how =
        plan_.script.empty() ? "first answers" : "script " + plan_.script;
    const auto script = plan_.script.empty()
                            ? Result<InputFile>{InputFile{}, {}}
                            : sources_.text(plan_.script);
    if (!script.value) return {std::nullopt, script.diagnostics};
    return simulated_by_script(whole.tree, whole.network,
                               {script.value->name, script.value->text},
                               course);
  }

  // To tell of a run takes as long as to make it: it has half of the time.
  Spent stopped() {
    if (spent_ == Spent::Nothing) spent_ = call_.look();
    if (spent_ == Spent::Nothing && !call_.has_spare()) spent_ = Spent::Time;
    return spent_;
  }

  void tell(const btcheck::Simulation& simulation, const TickLines& lines,
            Simulation::Whole& whole) {
    std::string rest = lines.rest(simulation.state());
    for (std::size_t end; (end = rest.find('\n')) != rest.npos;) {
      told_.lines.push_back(rest.substr(0, end));
      rest.erase(0, end + 1);
    }
    whole.run = simulation.run();
    told_.run =
        run_of(told_run(whole.tree, whole.network, whole.run, RunHeading()));
    told_.profile = profile_name(whole.tree.profile);
    told_.ending = ending_of(simulation, plan_);
    told_.end = ending_text(simulation, plan_.ticks);
    told_.ticks = most_ticks(simulation);
    tell_state(whole, simulation.state(), told_);
    if (spent_ != Spent::Nothing) {
      told_.outcome = Outcome::Undecided;
    } else {
      told_.outcome = whole.is_denied ? Outcome::Missed : Outcome::Met;
    }
  }

  const Plan& plan_;
  CallSources& sources_;
  Call& call_;
  std::vector<Diagnostic>& found_;
  Simulation& told_;
  Spent spent_ = Spent::Nothing;
};

}  // namespace

namespace {

RecordedRun recorded_of(const Simulation::Whole& whole) {
  return recorded_simulation(whole.tree, whole.network, whole.input, whole.run,
                             whole.how);
}

}  // namespace

std::string Simulation::itf() const {
  return whole ? itf_text(recorded_of(*whole)) : std::string();
}

std::string Simulation::html() const {
  return whole ? html_text(recorded_of(*whole)) : std::string();
}

Simulation simulated(const Request& request, const Plan& plan,
                     CallSources& sources, Monitor* monitor) {
  Call call(request, monitor);
  const BudgetScope budget(&call);
  Simulation told;
  std::vector<Diagnostic> found;
  try {
    auto inputs = inputs_of_tree(request, sources, found);
    if (inputs) {
      Simulating(plan, sources, call, found, told).simulate(std::move(*inputs));
    }
    if (!told.run || has_error(found)) told.outcome = Outcome::BadInput;
  } catch (const BudgetSpent& spent) {
    told = {};
    told.outcome = Outcome::Undecided;
    found = {spent_diagnostic(spent, request.tree)};
  }
  told.tree = request.tree;
  const BudgetScope telling(nullptr);
  for (const Diagnostic& each : found) {
    told.findings.push_back(finding_of(btcheck::finding_of(each)));
  }
  return told;
}

Simulation simulate(const Request& request, const Plan& plan, Sources& sources,
                    Monitor* monitor) {
  AskedSources asked(sources, request.is_one_program);
  return simulated(request, plan, asked, monitor);
}

}  // namespace btcheck::v1
