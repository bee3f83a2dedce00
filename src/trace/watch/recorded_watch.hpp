// SPDX-License-Identifier: MIT
//
// Rules asked of a run that has been recorded, while it is read.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "check/bind/bound_property.hpp"
#include "check/monitor/rule_monitor.hpp"
#include "ltl/rules/property.hpp"
#include "text/diagnostic.hpp"
#include "trace/logs/log_run.hpp"
#include "trace/run/recorded_run.hpp"
#include "trace/watch/recorded_network.hpp"

namespace btcheck {

// Where a run comes from: what there is to be seen in it.
enum class Recording : std::uint8_t {
  Run,       // every step: an ITF file
  Log,       // the changes of statuses alone
  MarkedLog  // and all ticks, answers and entries
};

// What is known of a condition on states.
enum class Truth : std::uint8_t { No, Yes, Unknown };

// A run and the rules of one file. What rules say of ticks and of the past is
// remembered here, as a network would.
class RecordedWatch {
 public:
  // Or why the rules cannot be asked of such a run: what it does not show is
  // refused by name (BT1805). Rules and source must outlive the result.
  static Result<std::unique_ptr<RecordedWatch>> make(const RecordedRun& run,
                                                     Recording recording,
                                                     const PropertyFile& rules,
                                                     const SourceText& source);

  // The next state of the run, the first one included; `unseen(node)` says what
  // else may have happened in it. Of states that are `possible`, one behind the
  // other, all may have been left out, or have come several times over.
  template <class Unseen_>
  void see(const RecordedState& state, Unseen_&& unseen,
           bool is_possible = false) {
    begin(state);
    for (const std::size_t n : asked_) note_unseen(n, unseen(n), state);
    finish(is_possible);
  }
  void see(const RecordedState& state) {
    see(state, [](std::size_t) { return Unseen::Nothing; });
  }

  struct Seen {
    const BoundProperty* rule = nullptr;
    MonitorRun run;
    std::optional<std::size_t> decided;  // number of the state
    bool has_unknown = false;            // something was not known
    bool has_ways = false;               // something may have been left out
  };
  const std::vector<Seen>& rules() const { return seen_; }
  std::size_t states() const { return states_; }

  // An atom of the past and the bit that remembers it.
  struct Past {
    AtomKind kind{};
    VariableId bit{};
    Expression held;
    Expression began;
    Truth now = Truth::No;
  };

  // What it is made of, for who writes it down.
  const std::vector<RuleMonitor>& monitors() const { return monitors_; }
  const std::vector<Past>& past() const { return past_; }
  const std::string& rules_file() const { return rules_.file; }
  // What a variable of the network is, in the order of btcheck/monitor.hpp, and
  // of which node; of an entry, the variable of the run.
  enum class SlotKind : std::uint8_t {
    Location,
    LastStatus,
    Called,
    Answer,
    Remembered,
    Entry
  };
  std::pair<SlotKind, std::size_t> meaning(VariableId variable) const;
  // An entry of a log, as far as the rules tell its values apart.
  const StateVariable& entry(std::size_t variable) const {
    return network_.tree().variables[variable];
  }

  // The propositions of a rule in the present state, with their texts.
  std::vector<std::string> texts(std::size_t rule) const;
  std::vector<bool> truths(std::size_t rule) const;

 private:
  RecordedWatch(const RecordedRun& run, const PropertyFile& rules)
      : network_(run, rules), rules_(rules), nodes_(run.nodes.size()) {}

  // A state, as the network has it.
  struct Moment {
    std::vector<int> values;                                // by variable
    std::vector<std::pair<VariableId, int>> others = {};    // or these
    std::vector<std::pair<std::size_t, int>> answers = {};  // by node, new
    bool has_passed = false;              // a unit of time, before it
    std::vector<std::size_t> ended = {};  // roots, in the state before
    bool ends_tick = false;
  };

  void bind_memory(const SourceText& source);
  void find_asked();
  void begin(const RecordedState& state);
  void note_unseen(std::size_t node, Unseen unseen, const RecordedState& state);
  void note_anything(std::size_t node);
  void finish(bool is_possible);
  void note_answers(const RecordedState& state);
  bool take(const Moment& moment, bool is_possible);
  bool take_answers(const Moment& moment, bool is_possible);
  bool note_past(bool is_tick_end, bool is_possible);
  bool remembers(const Expression& condition) const;
  bool read(std::size_t rule, bool has_passed, bool is_possible);
  void may_be(VariableId variable, int value);
  Truth truth(const Expression& expression) const;

  RecordedNetwork network_;
  const PropertyFile& rules_;
  std::size_t nodes_ = 0;
  BoundFile bound_;
  std::vector<RuleMonitor> monitors_;
  std::vector<Past> past_;
  std::vector<std::size_t> root_of_;  // by node
  // Nodes that some rule asks for, and roots: of others nothing is kept.
  std::vector<std::size_t> asked_;
  std::vector<Seen> seen_;
  Moment moment_;                  // that is seen
  std::vector<Moment> loop_;       // that may have been left out
  std::vector<unsigned> answers_;  // by node: a bit for each it may have
  Valuation valuation_;
  // By variable: what else it may be; and those that have such values.
  std::vector<std::vector<int>> others_;
  std::vector<VariableId> open_;
  std::vector<std::string> locations_;  // of the state before
  std::vector<bool> has_ended_tick_;    // by node, of roots: in that state
  bool has_doubts_ = false;  // what is remembered depends on what may not be
  int time_ = 0;
  std::size_t states_ = 0;
};

}  // namespace btcheck
