// SPDX-License-Identifier: MIT
//
// The engine as other people's programs have it: what stands behind
// btcheck/run.hpp.
#include <fmt/format.h>

#include <atomic>
#include <charconv>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <system_error>
#include <utility>
#include <vector>

#include "btcheck/run.hpp"
#include "check/bind/node_names.hpp"
#include "check/check.hpp"
#include "check/simulate/simulation.hpp"
#include "model/sampling.hpp"
#include "model/tree/node_types.hpp"
#include "model/tree_file.hpp"
#include "run/engine/tick_clock.hpp"
#include "run/engine/tree_engine.hpp"
#include "run/leaves/function_leaves.hpp"
#include "run/record/event_teller.hpp"
#include "run/record/recorder.hpp"
#include "trace/logs/behavior_log.hpp"
#include "trace/run/itf.hpp"

namespace btcheck::run {
namespace {

[[noreturn]] void throw_error(std::span<const Diagnostic> diagnostics) {
  std::string text;
  for (const Diagnostic& found : diagnostics) {
    if (found.severity == Severity::Error) text += render(found);
  }
  throw Error(text);
}

BehaviorTree tree_of(const TreeInput& input) {
  auto read = read_tree(input.name, input.text, input.reading);
  if (!read.value) throw_error(read.diagnostics);
  if (is_engine(read.value->profile)) {
    throw Error(input.name +
                ": a tree for BehaviorTree.CPP keeps its own executor; btcheck "
                "runs trees in .btf");
  }
  return std::move(*read.value);
}

Network network_of(const TreeInput& input, const BehaviorTree& tree) {
  auto lowered = lower_values(tree, SourceText(input.name, input.text),
                              TickSemantics::Root);
  if (!lowered.value) throw_error(lowered.diagnostics);
  return std::move(*lowered.value);
}

// The tree's file, and how it is read: rates count by the period of a tick.
TreeInput input_of(std::string name, std::string text, const Options& options) {
  if (options.period.count() < 1) throw Error("a tick takes 1 ms at least");
  if (options.period > std::chrono::hours(1)) {
    throw Error("a tick takes an hour at most");
  }
  TreeInput input(std::move(name), std::move(text));
  input.reading.tick_ms = static_cast<int>(options.period.count());
  return input;
}

bool is_number(std::string_view text, double& number) {
  const char* end = text.data() + text.size();
  const auto [stop, fault] = std::from_chars(text.data(), end, number);
  return fault == std::errc() && stop == end;
}

}  // namespace

// --- Values --------------------------------------------------------------

double Call::number(std::string_view key) const {
  for (const Argument& argument : arguments_) {
    if (argument.key != key) continue;
    double written = 0;
    if (argument.kind == Argument::Kind::Number) return argument.number;
    if (argument.kind == Argument::Kind::Written &&
        is_number(argument.text, written)) {
      return written;
    }
  }
  throw std::out_of_range("no argument `" + std::string(key) +
                          "` that is a number");
}

std::string_view Call::text(std::string_view key) const {
  for (const Argument& argument : arguments_) {
    if (argument.key == key && argument.kind != Argument::Kind::Number) {
      return argument.text;
    }
  }
  throw std::out_of_range("no argument `" + std::string(key) +
                          "` that is a text");
}

std::string Value::text() const {
  return is_word_ ? word_ : fmt::format("{}", number_);
}

// --- The parts -----------------------------------------------------------

class Engine::Parts : public EngineObserver {
 public:
  Parts(std::string name, std::string text, Options options)
      : options_(options),
        input_(input_of(std::move(name), std::move(text), options)),
        tree_(tree_of(input_)),
        network_(network_of(input_, tree_)),
        system_(network_),
        leaves_(tree_, options.answer_within),
        engine_(tree_, system_, leaves_,
                static_cast<btcheck::OnBreach>(options.on_breach)),
        clock_(options.pace == Pace::AtOnce ? TickPace::AtOnce
                                            : TickPace::RealTime,
               options.period),
        fitting_(tree_.nodes.size(), std::numeric_limits<std::size_t>::max()) {}

  void give(const std::string& name, std::vector<NodeType> types,
            const LeafFunction& function) {
    refuse_late();
    const NodeNames names(tree_);
    const std::vector<NodeId> called = names.called(name);
    std::size_t given = 0;
    for (const NodeId node : called) {
      if (std::ranges::find(types, tree_.node(node).type) == types.end()) {
        continue;
      }
      ++given;
      if (called.size() > fitting_[index(node)]) continue;
      fitting_[index(node)] = called.size();
      leaves_.give(node, function);
    }
    if (given > 0) return;
    if (!called.empty()) {
      throw Error(fmt::format("`{}` is a {}", name,
                              type_name(tree_.node(called[0]).type)));
    }
    const std::string help = names.nearest_help(name);
    throw Error(fmt::format("no leaf `{}` in {}{}{}", name, input_.name,
                            help.empty() ? "" : "; ", help));
  }

  void tell_events(std::function<void(const Event&)> told) {
    refuse_late();
    tellers_.push_back(
        std::make_unique<EventTeller>(tree_, system_, std::move(told)));
  }
  void tell_breaches(std::function<void(const Breach&)> told) {
    refuse_late();
    told_of_breaches_ = std::move(told);
  }

  End tick() {
    begin();
    if (end() != End::None) return end();
    clock_.begin_tick();
    engine_.tick();
    clock_.end_tick();
    if (engine_.state() != EngineState::Ready) engine_.stop();
    return end();
  }

  Report run(int most) {
    begin();
    while (end() == End::None && (most == 0 || engine_.ticks() < most) &&
           clock_.wait([&] { return is_stopped_.load(); })) {
      tick();
    }
    engine_.stop();
    return report();
  }

  Report report() const {
    return {end(),
            engine_.ticks(),
            engine_.breaches(),
            clock_.overruns(),
            clock_.longest(),
            engine_end_text(engine_)};
  }

  void stop() noexcept { is_stopped_ = true; }

  void set(const std::string& name, const Value& value) {
    const StateVariableId id = variable_called(name);
    const StateVariable& variable = tree_.variable(id);
    if (!moves_freely(tree_, id)) {
      throw Error(fmt::format("`{}` does not move by itself", name));
    }
    const auto wanted = value_of(variable, value);
    if (!wanted) {
      throw Error(fmt::format("`{}` has no value {}", name, value.text()));
    }
    leaves_.set({id, *wanted});
  }

  Value value(const std::string& name) const {
    const StateVariableId id = variable_called(name);
    const StateVariable& variable = tree_.variable(id);
    const auto now = static_cast<int>(
        system_.value(engine_.now(), network_.state_variable[index(id)]));
    if (variable.is_enumeration()) return variable.value_name(now);
    return number_of(variable, now);
  }

  RecordedRun kept() const {
    if (options_.keep == Options::Keep::Nothing) {
      throw Error("the run was not kept: Options::keep");
    }
    auto run = kept_run(tree_, network_, input_, recorder_, "run by an engine");
    if (!run) throw std::logic_error("a step cannot be executed again");
    return std::move(*run);
  }

  bool end_tasks() { return leaves_.end(); }

  void breached(const btcheck::Breach& breach) override {
    if (!told_of_breaches_) return;
    told_of_breaches_({breach.tick,
                       breach.node ? short_name(tree_, *breach.node) : "",
                       std::string(breach_name(breach.kind)), breach.text});
  }

 private:
  void refuse_late() const {
    if (has_begun_) throw Error("the run has begun");
  }

  void begin() {
    if (has_begun_) return;
    std::string missing;
    for (const NodeId node : post_order(tree_)) {
      if (is_scripted(tree_.node(node).type) && !leaves_.has(node)) {
        missing += (missing.empty() ? "" : ", ") + name_and_line(tree_, node);
      }
    }
    if (!missing.empty()) throw Error("no function for " + missing);
    leaves_.begin();
    has_begun_ = true;
    if (options_.keep == Options::Keep::Run) engine_.add(recorder_);
    for (const auto& teller : tellers_) engine_.add(*teller);
    engine_.add(*this);
    engine_.begin();
  }

  End end() const {
    switch (engine_.state()) {
      case EngineState::Ready:
        return is_stopped_ ? End::Stopped : End::None;
      case EngineState::Fault:
        return End::Fault;
      case EngineState::Stuck:
        return End::Stuck;
      case EngineState::Breached:
        return End::Breached;
      case EngineState::Ended:
        break;
    }
    const bool has_succeeded =
        std::ranges::all_of(tree_.roots, [&](NodeId root) {
          return engine_.status(root) == NodeStatus::Success;
        });
    return has_succeeded ? End::Success : End::Failure;
  }

  StateVariableId variable_called(const std::string& name) const {
    for (std::uint32_t v = 0; v < tree_.variables.size(); ++v) {
      if (tree_.variables[v].name == name) return StateVariableId{v};
    }
    throw Error(fmt::format("no variable `{}` in {}", name, input_.name));
  }

  Options options_;
  TreeInput input_;
  BehaviorTree tree_;
  Network network_;
  CompiledNetwork system_;
  FunctionLeaves leaves_;
  TreeEngine engine_;
  TickClock clock_;
  RunRecorder recorder_;
  std::vector<std::unique_ptr<EventTeller>> tellers_;
  std::function<void(const Breach&)> told_of_breaches_;
  std::vector<std::size_t> fitting_;  // by node: how many its name fits
  std::atomic<bool> is_stopped_ = false;
  bool has_begun_ = false;
};

// --- The engine ----------------------------------------------------------

Engine::Engine(std::string name, std::string text, Options options)
    : parts_(
          std::make_unique<Parts>(std::move(name), std::move(text), options)) {}

// A function that does not return uses the parts still.
Engine::~Engine() {
  if (parts_ && !parts_->end_tasks()) static_cast<void>(parts_.release());
}

Engine::Engine(Engine&&) noexcept = default;

Engine& Engine::operator=(Engine&& other) noexcept {
  std::swap(parts_, other.parts_);
  return *this;
}

void Engine::action(const std::string& leaf, ActionFunction function) {
  parts_->give(leaf, {NodeType::Action}, {std::move(function)});
}
void Engine::polled(const std::string& leaf, PolledFunction function) {
  parts_->give(leaf, {NodeType::Action}, {std::move(function)});
}
void Engine::condition(const std::string& leaf, ConditionFunction function,
                       Runs where) {
  parts_->give(leaf, {NodeType::Condition}, {std::move(function), where});
}
void Engine::measure(const std::string& leaf, MeasureFunction function,
                     Runs where) {
  parts_->give(leaf, {NodeType::SetSV}, {std::move(function), where});
}
void Engine::on_event(std::function<void(const Event&)> told) {
  parts_->tell_events(std::move(told));
}
void Engine::on_breach(std::function<void(const Breach&)> told) {
  parts_->tell_breaches(std::move(told));
}
Report Engine::run(int most_ticks) { return parts_->run(most_ticks); }
End Engine::tick() { return parts_->tick(); }
Report Engine::report() const { return parts_->report(); }
void Engine::stop() noexcept { parts_->stop(); }
void Engine::set(const std::string& variable, const Value& value) {
  parts_->set(variable, value);
}
Value Engine::value(const std::string& variable) const {
  return parts_->value(variable);
}
std::string Engine::itf() const { return itf_text(parts_->kept()); }
std::string Engine::btlog() const { return btlog_bytes(parts_->kept(), 1); }

}  // namespace btcheck::run
