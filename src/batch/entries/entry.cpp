// SPDX-License-Identifier: MIT
#include "batch/entries/entry.hpp"

namespace btcheck {
namespace {

template <class Value>
void complete(std::optional<Value>& value, const std::optional<Value>& by) {
  if (!value) value = by;
}

template <class Value, class Chosen>
void apply(Value& value, const std::optional<Chosen>& chosen) {
  if (chosen) value = *chosen;
}

}  // namespace

EntryChoices completed(EntryChoices choices, const EntryChoices& by) {
  complete(choices.profile, by.profile);
  complete(choices.tick_ms, by.tick_ms);
  complete(choices.loops, by.loops);
  complete(choices.wakes, by.wakes);
  complete(choices.main_tree, by.main_tree);
  complete(choices.leaves, by.leaves);
  complete(choices.ticks, by.ticks);
  complete(choices.search, by.search);
  complete(choices.reduce, by.reduce);
  complete(choices.assume, by.assume);
  complete(choices.threads, by.threads);
  complete(choices.max_states, by.max_states);
  complete(choices.max_bytes, by.max_bytes);
  complete(choices.timeout, by.timeout);
  return choices;
}

Options applied(Options options, const EntryChoices& choices) {
  apply(options.profile, choices.profile);
  apply(options.tick_ms, choices.tick_ms);
  apply(options.loops, choices.loops);
  apply(options.wakes, choices.wakes);
  apply(options.main_tree, choices.main_tree);
  apply(options.leaves, choices.leaves);
  apply(options.ticks, choices.ticks);
  apply(options.search, choices.search);
  apply(options.reduce, choices.reduce);
  apply(options.assume, choices.assume);
  apply(options.threads, choices.threads);
  apply(options.max_states, choices.max_states);
  apply(options.max_bytes, choices.max_bytes);
  apply(options.timeout, choices.timeout);
  return options;
}

}  // namespace btcheck
