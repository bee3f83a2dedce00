// SPDX-License-Identifier: MIT
//
// A tree as an engine of LTSmin has it: integers, groups, labels. Knows nothing
// of LTSmin's headers; module.cpp does.
#pragma once

#include <algorithm>
#include <boost/container/small_vector.hpp>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "check/check.hpp"
#include "check/export/export_model.hpp"
#include "check/export/ltsmin.hpp"
#include "explore/partition/groups.hpp"
#include "explore/partition/guards.hpp"
#include "explore/partition/slots.hpp"
#include "explore/reduce/labels.hpp"
#include "explore/reduce/live_variables.hpp"
#include "pins/words.hpp"

namespace btcheck {

// Immutable: several threads may ask it.
class PinsModel {
 public:
  PinsModel(TreeInput input, LtsminModel model, const PinsChoices& choices);
  PinsModel(const PinsModel&) = delete;
  PinsModel& operator=(const PinsModel&) = delete;

  const TreeInput& input() const { return input_; }
  const BehaviorTree& tree() const { return *model_.tree; }
  // As it was lowered, and as it is searched.
  const Network& network() const { return *model_.network; }
  const CompiledNetwork& system() const { return *system_; }
  // By VariableId: whether its value may differ in what is searched.
  const std::vector<bool>& forgotten() const { return forgotten_; }

  const PinsChoices& choices() const { return choices_; }
  const Slots& slots() const { return *slots_; }
  const Groups& groups() const { return *groups_; }
  const Guards* guards() const { return guards_ ? &*guards_ : nullptr; }

  std::string slot_name(std::size_t slot) const;
  // Of the values that count from 0; empty for numbers.
  std::vector<std::string> value_names(std::size_t slot) const;
  std::vector<int> initial() const;

  const std::vector<LtsminLabel>& labels() const { return labels_; }
  bool label(std::size_t number, const int* state) const;
  bool guard(std::uint32_t number, const int* state) const;
  SlotSet slots_of_label(std::size_t number) const;

  // Who takes the steps of a group: a number among mover_names.
  std::size_t mover(std::uint32_t group) const;
  // False for a move of a free variable.
  bool is_progress(std::uint32_t group) const;

  // Calls told(group, target) for each step, of all groups or of one; tells
  // how many there were. Targets die with the call. Where there are guards,
  // groups come in order: partial-order reduction asks for that.
  template <class Told>
  int steps(const int* state, Told&& told) const {
    const Buffers at(*this, state);
    Integers target(state, state + slots_->size());
    int count = 0;
    std::vector<std::pair<std::uint32_t, StateVector>> waiting;
    system_->successors(at.view(), [&](StateView to, const Step& step) {
      if (guards_) {
        waiting.emplace_back(groups_->of(step),
                             StateVector(to.begin(), to.end()));
      } else {
        count += tell(groups_->of(step), at, to, target, told);
      }
    });
    std::ranges::sort(waiting);
    for (const auto& [group, to] : waiting) {
      count += tell(group, at, to, target, told);
    }
    return count;
  }
  template <class Told>
  int steps_of(std::uint32_t group, const int* state, Told&& told) const {
    const Buffers at(*this, state);
    WordBuffer next(system_->word_count());
    if (!groups_->step(group, at.view(), {next.data(), next.size()})) return 0;
    Integers target(state, state + slots_->size());
    return tell(group, at, view_of(next), target, told);
  }

 private:
  using WordBuffer = boost::container::small_vector<Word, 16>;
  using Integers = boost::container::small_vector<int, 512>;

  struct Buffers {
    Buffers(const PinsModel& model, const int* state)
        : words(model.system_->word_count()) {
      model.slots_->pack(state, words.data());
    }
    StateView view() const { return view_of(words); }
    WordBuffer words;
  };

  template <class Told>
  int tell(std::uint32_t group, const Buffers& at, StateView to,
           Integers& target, Told& told) const {
    const bool is_idle =
        group == groups_->time() && std::ranges::equal(at.view(), to);
    if (is_idle && !choices_.tells_idle) return 0;
    slots_->unpack_changes(at.words.data(), to.data(), target.data());
    told(group, target.data());
    slots_->unpack_changes(to.data(), at.words.data(), target.data());
    return 1;
  }

  TreeInput input_;
  LtsminModel model_;
  PinsChoices choices_;
  std::vector<LtsminLabel> labels_;
  std::optional<LiveNetwork> live_;
  std::vector<bool> forgotten_;
  std::optional<CompiledNetwork> system_;
  std::optional<LabelledNetwork> labelled_;
  std::optional<Slots> slots_;
  std::optional<Groups> groups_;
  std::optional<Guards> guards_;
};

// What the environment variable BTCHECK_PINS says, "" for nothing.
std::string words_of_environment();

// Reads what `file` names, a tree or a .btpins, with more words of `also`, and
// makes a model of it; or shows what is wrong.
std::unique_ptr<PinsModel> load_model(const std::string& file,
                                      const std::string& also);

}  // namespace btcheck
