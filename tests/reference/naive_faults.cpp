// SPDX-License-Identifier: MIT
#include "reference/naive_faults.hpp"

#include <algorithm>
#include <functional>
#include <map>
#include <memory>
#include <stdexcept>
#include <utility>

#include "model/tree/node_types.hpp"
#include "reference/naive_engine.hpp"
#include "reference/tick_interpreter.hpp"

namespace btcheck::reference {
namespace {

struct TooMuch : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// All ways through something that chooses: each is a list of numbers.
class Ways {
 public:
  // The first choice of this way is the first again.
  void begin() { at_ = 0; }
  int choose(int of) {
    if (at_ == taken_.size()) {
      taken_.push_back(0);
      of_.push_back(of);
    }
    return taken_[at_++];
  }
  // To the next way; false: there is none.
  bool next() {
    while (!taken_.empty() && taken_.back() + 1 == of_.back()) {
      taken_.pop_back();
      of_.pop_back();
    }
    if (taken_.empty()) return false;
    ++taken_.back();
    return true;
  }

 private:
  std::vector<int> taken_;
  std::vector<int> of_;
  std::size_t at_ = 0;
};

bool is_action(const Node& node) {
  return node.type == NodeType::Action && node.contract.may_run;
}

bool is_below(const BehaviorTree& tree, NodeId at, NodeId above) {
  while (at != above && !tree.node(at).is_root()) at = tree.node(at).parent;
  return at == above;
}

// A Timeout bounds what works below it: the nearest one, in equal parts. By
// node: the most ticks that it runs; -1: any number.
std::vector<int> bounds(const BehaviorTree& tree) {
  std::vector<int> most(tree.nodes.size(), -1);
  for (std::uint32_t n = 0; n < tree.nodes.size(); ++n) {
    if (!is_action(tree.nodes[n])) continue;
    for (NodeId at{n}; !tree.node(at).is_root(); at = tree.node(at).parent) {
      const Node& node = tree.node(at);
      if (node.type != NodeType::Timeout || !node.duration ||
          node.duration->max == 0) {
        continue;
      }
      if (node.duration->max > 60) throw TooMuch("it takes too long");
      int count = 0;
      for (std::uint32_t other = 0; other < tree.nodes.size(); ++other) {
        count +=
            is_action(tree.nodes[other]) && is_below(tree, NodeId{other}, at);
      }
      most[n] = std::max(node.duration->min - 1, 0) / count;
      break;
    }
  }
  return most;
}

enum class End : std::uint8_t { None, Success, Failure, Exception };

// What a leaf does beside what the engine knows of it.
struct LeafState {
  int phase = 0;   // of its fault: 0 not yet, 1 there, 2 over
  int late = 0;    // ticks for which it has run too long
  int since = -1;  // ticks for which it runs already
  bool succeeded = false;
  bool has_found = false;  // what it looks for: it never fails again
};

struct State {
  explicit State(NaiveEngine from) : engine(std::move(from)) {}
  NaiveEngine engine;
  std::vector<LeafState> leaves;  // by node
  End end = End::None;
  int tick = 0;
};

class Mission {
 public:
  Mission(const BehaviorTree& tree, std::span<const NaiveFault> faults)
      : tree_(tree), faults_(faults), most_(bounds(tree)) {}

  State initial() {
    State state(NaiveEngine(
        tree_, [this](NodeId node) { return answer(node); },
        [this](NodeId node, const std::string& what) { told(node, what); }));
    state.engine.called = [this](NodeId node) { called(node); };
    state.leaves.resize(tree_.nodes.size());
    return state;
  }

  // Calls found(state behind the tick) for each way in which it may go.
  template <class Found>
  void for_each_tick(const State& from, int tick, Found found) {
    Ways ways;
    do {
      if (++tried_ > kMostTicks) throw TooMuch("so many ways");
      ways.begin();
      ways_ = &ways;
      auto next = std::make_unique<State>(from);
      now_ = next.get();
      asks_ = 0;
      heard.clear();
      asked.clear();
      for (LeafState& leaf : next->leaves) {
        if (leaf.since >= 0) ++leaf.since;
      }
      try {
        switch (next->engine.tick_root(tick)) {
          case EngineStatus::Success:
            next->end = End::Success;
            break;
          case EngineStatus::Running:
            break;
          default:
            next->end = End::Failure;
        }
      } catch (const EngineThrows&) {
        next->end = End::Exception;
      }
      found(*next);
    } while (ways.next());
  }

  bool has_struck(const State& state) const {
    return std::ranges::all_of(faults_, [&](const NaiveFault& fault) {
      return state.leaves[index(fault.leaf)].phase != 0;
    });
  }

  std::vector<int> key(const State& state) const {
    std::vector<int> words = state.engine.words();
    for (std::uint32_t n = 0; n < tree_.nodes.size(); ++n) {
      if (!is_leaf(tree_.nodes[n].type)) continue;
      const LeafState& leaf = state.leaves[n];
      words.push_back(leaf.phase);
      words.push_back(leaf.late);
      words.push_back(leaf.has_found ? 1 : 0);
      words.push_back(most_[n] < 0 ? 0 : std::min(leaf.since, most_[n]));
    }
    words.push_back(static_cast<int>(state.end));
    return words;
  }

  // Of the last tick: what nodes but `left_out` have answered; and leaves that
  // were asked once all faults had struck.
  std::string heard;
  std::set<NodeId> asked;
  std::optional<NodeId> left_out;

 private:
  const NaiveFault* fault_of(NodeId node) const {
    const auto found = std::ranges::find(faults_, node, &NaiveFault::leaf);
    return found == faults_.end() ? nullptr : &*found;
  }
  LeafState& leaf(NodeId node) { return now_->leaves[index(node)]; }

  void called(NodeId node) {
    const NaiveFault* fault = fault_of(node);
    if (is_leaf(tree_.node(node).type) && has_struck(*now_)) {
      asked.insert(node);
    }
    if (fault == nullptr || fault->kind != FaultKind::Halted) return;
    if (leaf(node).phase != 0 ||
        now_->engine.status(node) != EngineStatus::Running) {
      return;
    }
    if (ways_->choose(2) == 0) return;
    strike(node, 2);
    if (has_struck(*now_)) asked.insert(node);
    now_->engine.halt_from_outside(node);
  }

  void told(NodeId node, const std::string& what) {
    if (what == "halted") {
      leaf(node).late = 0;
      leaf(node).since = -1;
      return;
    }
    if (what != "running") leaf(node).since = -1;
    if (what == "success" &&
        tree_.node(node).contract.memory == LeafMemory::SuccessStays) {
      leaf(node).has_found = true;
    }
    if (node == left_out) {
      leaf(node).succeeded = what == "success";
    } else {
      heard += std::to_string(index(node)) + what.substr(0, 2) + ' ';
    }
  }

  std::string answer(NodeId node) {
    if (++asks_ > 300) throw TooMuch("a tick goes round");
    const Node& asking = tree_.node(node);
    if (now_->engine.asks_script()) {
      return ways_->choose(2) == 0 ? "true" : "false";
    }
    if (asking.type != NodeType::Action && asking.type != NodeType::Condition) {
      throw TooMuch("it asks for more");
    }
    const EngineStatus before = now_->engine.status(node);
    const bool is_over =
        before == EngineStatus::Success || before == EngineStatus::Failure;
    if (asking.contract.memory == LeafMemory::Unknown && is_over &&
        ways_->choose(2) == 0) {
      return "has ended already";
    }
    const NaiveFault* fault = fault_of(node);
    if (fault == nullptr) return well(node);
    return ill(node, *fault);
  }

  std::string one_of(const std::vector<std::string>& answers) {
    return answers[static_cast<std::size_t>(
        ways_->choose(static_cast<int>(answers.size())))];
  }

  std::string well(NodeId node) {
    const Node& asked_one = tree_.node(node);
    const LeafContract& contract = asked_one.contract;
    std::vector<std::string> answers;
    if (contract.may_succeed) answers.emplace_back("success");
    const bool must_succeed =
        asked_one.type == NodeType::Action && contract.may_succeed;
    LeafState& state = leaf(node);
    if (contract.may_fail && !must_succeed && !state.has_found) {
      answers.emplace_back("failure");
    }
    const int most = most_[index(node)];
    if (most == 0) return one_of(answers);
    if (state.since < 0) state.since = 0;
    if (contract.may_run && (most < 0 || state.since < most)) {
      answers.emplace_back("running");
    }
    return one_of(answers);
  }

  void strike(NodeId node, int phase) { leaf(node).phase = phase; }

  std::string ill(NodeId node, const NaiveFault& fault) {
    LeafState& state = leaf(node);
    const bool may_strike = state.phase == 0;
    switch (fault.kind) {
      case FaultKind::Fails:
        strike(node, 1);
        return "failure";
      case FaultKind::Succeeds:
        strike(node, 1);
        return "success";
      case FaultKind::FailsOnce:
        if (!may_strike || ways_->choose(2) == 0) return well(node);
        strike(node, 2);
        return "failure";
      case FaultKind::FailsOn:
      case FaultKind::NeverEnds:
        if (may_strike && ways_->choose(2) == 0) return well(node);
        strike(node, 1);
        return fault.kind == FaultKind::FailsOn ? "failure" : "running";
      case FaultKind::Throws:
        if (ways_->choose(2) == 0) return well(node);
        strike(node, 2);
        throw EngineThrows("the fault");
      case FaultKind::EndsLate: {
        strike(node, 1);
        const int most = fault.late + std::max(most_[index(node)], 0);
        if (state.late < most) {
          ++state.late;
          return "running";
        }
        state.late = 0;
        return one_of(tree_.node(node).contract.may_succeed
                          ? std::vector<std::string>{"success"}
                          : std::vector<std::string>{"failure"});
      }
      case FaultKind::Halted:
        return well(node);
      default:
        throw TooMuch("no such fault here");
    }
  }

  const BehaviorTree& tree_;
  std::span<const NaiveFault> faults_;
  std::vector<int> most_;  // by node: ticks that it may run; -1: any number
  Ways* ways_ = nullptr;
  State* now_ = nullptr;
  int asks_ = 0;
  std::size_t tried_ = 0;
  static constexpr std::size_t kMostTicks = 8000;
};

}  // namespace

namespace {

// All states behind ticks, and what follows from them.
template <class Mission>
std::optional<NaiveEffect> explored(Mission& mission, std::size_t most_states) {
  auto first = mission.initial();
  using Each = decltype(first);
  std::vector<std::unique_ptr<Each>> states;
  std::vector<std::vector<std::size_t>> sources;
  std::map<std::vector<int>, std::size_t> known;
  NaiveEffect effect;
  const auto number_of = [&](const Each& state) {
    const auto [place, is_new] =
        known.emplace(mission.key(state), states.size());
    if (is_new) {
      states.push_back(std::make_unique<Each>(state));
      sources.emplace_back();
    }
    return place->second;
  };
  number_of(first);
  for (std::size_t i = 0; i < states.size(); ++i) {
    if (states.size() > most_states) return std::nullopt;
    if (states[i]->end != End::None) continue;
    // Timers know how long they run, not when they began.
    const int tick = states[i]->tick + 1;
    const Each from = *states[i];
    mission.for_each_tick(from, tick, [&](Each& next) {
      next.tick = tick;
      sources[number_of(next)].push_back(i);
      effect.asked.insert(mission.asked.begin(), mission.asked.end());
    });
  }
  std::vector<bool> can_end(states.size(), false);
  std::vector<std::size_t> open;
  for (std::size_t i = 0; i < states.size(); ++i) {
    if (states[i]->end == End::None) continue;
    can_end[i] = true;
    open.push_back(i);
  }
  while (!open.empty()) {
    const std::size_t here = open.back();
    open.pop_back();
    for (const std::size_t source : sources[here]) {
      if (can_end[source]) continue;
      can_end[source] = true;
      open.push_back(source);
    }
  }
  for (std::size_t i = 0; i < states.size(); ++i) {
    if (!mission.has_struck(*states[i])) continue;
    effect.strikes = true;
    effect.succeeds |= states[i]->end == End::Success;
    effect.fails |= states[i]->end == End::Failure;
    effect.throws |= states[i]->end == End::Exception;
    effect.hangs |= !can_end[i];
  }
  effect.states = states.size();
  return effect;
}

// The same of a .btf tree, of which the interpreter is copied.
struct BtfState {
  explicit BtfState(TickInterpreter from) : tree(std::move(from)) {}
  TickInterpreter tree;
  std::vector<LeafState> leaves;
  End end = End::None;
  int tick = 0;
};

class BtfMission {
 public:
  BtfMission(const BehaviorTree& tree, std::span<const NaiveFault> faults)
      : tree_(tree), faults_(faults) {
    const std::vector<int> most = bounds(tree);
    for (std::uint32_t n = 0; n < most.size(); ++n) {
      auto& duration = tree_.nodes[n].duration;
      if (most[n] >= 0 && !duration) duration = Duration{0, most[n]};
    }
  }

  BtfState initial() {
    Script script;
    script.action = [this](NodeId leaf, std::span<const NodeStatus> allowed) {
      return well(leaf, allowed);
    };
    script.set_sv = [this](NodeId leaf, std::span<const int> allowed) {
      return found(leaf, allowed);
    };
    script.due = [this](NodeId, int) { return ways_->choose(2) == 1; };
    script.ill = [this](NodeId leaf, const auto& allowed) {
      return ill(leaf, allowed);
    };
    script.writes = [this](NodeId leaf, StateVariableId variable, int present,
                           int value) {
      return written(leaf, variable, present, value);
    };
    script.halted = [this](NodeId leaf) { of(leaf).late = 0; };
    BtfState state(TickInterpreter(tree_, script));
    state.leaves.resize(tree_.nodes.size());
    return state;
  }

  template <class Found>
  void for_each_tick(const BtfState& from, int, Found found) {
    Ways ways;
    do {
      if (++tried_ > kMostTicks) throw TooMuch("so many ways");
      ways.begin();
      ways_ = &ways;
      auto next = std::make_unique<BtfState>(from);
      now_ = next.get();
      asked.clear();
      const TickResult result = next->tree.tick();
      if (result.fault) {
        next->end = End::Exception;
      } else if (result.root == NodeStatus::Success) {
        next->end = End::Success;
      } else if (result.root == NodeStatus::Failure) {
        next->end = End::Failure;
      }
      found(*next);
    } while (ways.next());
  }

  bool has_struck(const BtfState& state) const {
    return std::ranges::all_of(faults_, [&](const NaiveFault& fault) {
      return state.leaves[index(fault.leaf)].phase != 0;
    });
  }

  std::vector<int> key(const BtfState& state) const {
    const TickResult all = state.tree.state();
    std::vector<int> words = all.variables;
    for (const NodeStatus status : all.statuses) {
      words.push_back(static_cast<int>(status));
    }
    for (const LocalValue& local : all.locals) words.push_back(local.value);
    for (const TimerValue& timer : all.timers) {
      words.push_back(static_cast<int>(timer.phase));
      words.push_back(timer.elapsed);
    }
    for (const LeafState& leaf : state.leaves) {
      words.push_back(leaf.phase);
      words.push_back(leaf.late);
    }
    words.push_back(static_cast<int>(state.end));
    return words;
  }

  std::set<NodeId> asked;

 private:
  const NaiveFault* fault_of(NodeId node) const {
    const auto found = std::ranges::find(faults_, node, &NaiveFault::leaf);
    return found == faults_.end() ? nullptr : &*found;
  }
  bool has(NodeId node, FaultKind kind) const {
    const NaiveFault* fault = fault_of(node);
    return fault != nullptr && fault->kind == kind;
  }
  LeafState& of(NodeId leaf) { return now_->leaves[index(leaf)]; }
  bool has_begun(NodeId leaf) const {
    const TickResult all = now_->tree.state();
    return std::ranges::any_of(all.timers, [&](const TimerValue& timer) {
      return timer.node == leaf && timer.phase != TimerPhase::Idle;
    });
  }

  NodeStatus well(NodeId leaf, std::span<const NodeStatus> allowed) {
    std::vector<NodeStatus> answers(allowed.begin(), allowed.end());
    const bool can_succeed =
        std::ranges::find(answers, NodeStatus::Success) != answers.end();
    if (tree_.node(leaf).type == NodeType::Action && can_succeed) {
      std::erase(answers, NodeStatus::Failure);
    }
    return answers[static_cast<std::size_t>(
        ways_->choose(static_cast<int>(answers.size())))];
  }

  int found(NodeId leaf, std::span<const int> allowed) {
    if (has_struck(*now_)) asked.insert(leaf);
    if (has(leaf, FaultKind::WritesNothing)) {
      of(leaf).phase = 1;
      return allowed[0];
    }
    return allowed[static_cast<std::size_t>(
        ways_->choose(static_cast<int>(allowed.size())))];
  }

  std::optional<int> written(NodeId leaf, StateVariableId variable, int present,
                             int value) {
    const bool is_nothing = has(leaf, FaultKind::WritesNothing);
    if (!is_nothing && !has(leaf, FaultKind::WritesOther)) return std::nullopt;
    of(leaf).phase = 1;
    if (is_nothing) return present;
    const StateVariable& written = tree_.variable(variable);
    std::vector<int> others;
    for (int v = written.min; v <= written.max; ++v) {
      if (v != value) others.push_back(v);
    }
    return others[static_cast<std::size_t>(
        ways_->choose(static_cast<int>(others.size())))];
  }

  Script::Ill ill(NodeId node,
                  const std::function<std::vector<NodeStatus>()>& allowed) {
    if (has_struck(*now_)) asked.insert(node);
    const NaiveFault* fault = fault_of(node);
    if (fault == nullptr) return {};
    LeafState& state = of(node);
    const auto inverted = [&] {
      const auto answers = allowed();
      return std::ranges::find(answers, NodeStatus::Success) == answers.end()
                 ? NodeStatus::Success
                 : NodeStatus::Failure;
    };
    using enum FaultKind;
    switch (fault->kind) {
      case Fails:
        state.phase = 1;
        return {NodeStatus::Failure};
      case Succeeds:
        state.phase = 1;
        return {NodeStatus::Success};
      case FailsOnce:
        if (state.phase != 0 || ways_->choose(2) == 0) return {};
        state.phase = 2;
        return {NodeStatus::Failure};
      case FailsOn:
      case NeverEnds:
        if (state.phase == 0 && ways_->choose(2) == 0) return {};
        state.phase = 1;
        return {fault->kind == FailsOn ? NodeStatus::Failure
                                       : NodeStatus::Running};
      case Inverted:
        state.phase = 1;
        return {inverted()};
      case FlipsOnce:
        if (state.phase != 0 || ways_->choose(2) == 0) return {};
        state.phase = 2;
        return {inverted()};
      case EndsLate: {
        state.phase = 1;
        const auto& duration = tree_.node(node).duration;
        const bool ends = duration && duration->max != kEndless;
        const int most = fault->late + (ends ? duration->max : 0);
        if (state.late < most) {
          ++state.late;
          return {NodeStatus::Running};
        }
        state.late = 0;
        auto answers = allowed();
        std::erase(answers, NodeStatus::Running);
        return {well(node, answers)};
      }
      case Halted:
        if (state.phase != 0 || !has_begun(node) || ways_->choose(2) == 0) {
          return {};
        }
        state.phase = 2;
        return {{}, true};
      default:
        return {};
    }
  }

  BehaviorTree tree_;
  std::span<const NaiveFault> faults_;
  Ways* ways_ = nullptr;
  BtfState* now_ = nullptr;
  std::size_t tried_ = 0;
  static constexpr std::size_t kMostTicks = 20'000;
};

}  // namespace

std::optional<NaiveEffect> naive_effect(const BehaviorTree& tree,
                                        std::span<const NaiveFault> faults,
                                        std::size_t most_states) {
  try {
    if (tree.profile == Profile::Paper) {
      BtfMission mission(tree, faults);
      return explored(mission, most_states);
    }
    Mission mission(tree, faults);
    return explored(mission, most_states);
  } catch (const TooMuch&) {
    return std::nullopt;
  }
}

std::optional<std::set<SeenRun>> naive_successes(
    const BehaviorTree& tree, std::span<const NaiveFault> faults, NodeId leaf,
    int most_ticks, std::size_t most_runs) {
  try {
    Mission mission(tree, faults);
    mission.left_out = leaf;
    struct Open {
      State state;
      std::string heard;
    };
    std::vector<Open> open;
    open.push_back({mission.initial(), ""});
    std::set<SeenRun> seen;
    for (int tick = 1; tick <= most_ticks; ++tick) {
      std::vector<Open> next;
      // Runs that look the same and are in the same state are one.
      std::set<std::pair<std::vector<int>, std::string>> known;
      for (const Open& each : open) {
        mission.for_each_tick(each.state, tick, [&](State& state) {
          const std::string heard = each.heard + mission.heard;
          if (state.end == End::Success) {
            seen.insert({heard, state.leaves[index(leaf)].succeeded,
                         mission.has_struck(state)});
          }
          if (state.end != End::None) return;
          std::vector<int> key = mission.key(state);
          key.push_back(state.leaves[index(leaf)].succeeded ? 1 : 0);
          if (!known.emplace(std::move(key), heard).second) return;
          next.push_back({state, heard});
          if (next.size() > most_runs) throw TooMuch("so many runs");
        });
      }
      open = std::move(next);
    }
    return seen;
  } catch (const TooMuch&) {
    return std::nullopt;
  }
}

}  // namespace btcheck::reference
