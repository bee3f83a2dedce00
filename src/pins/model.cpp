// SPDX-License-Identifier: MIT
#include "pins/model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <string_view>
#include <utility>
#include <variant>

#include "cli/console/console.hpp"
#include "cli/inputs/files.hpp"
#include "cli/inputs/inputs.hpp"
#include "cli/options/options.hpp"
#include "explore/state/accesses.hpp"

namespace btcheck {
namespace {

std::vector<StatePredicate> predicates_of(
    const std::vector<LtsminLabel>& labels) {
  std::vector<StatePredicate> predicates;
  for (const LtsminLabel& label : labels) predicates.push_back(label.of);
  return predicates;
}

LiveNetwork live_network(const Network& network,
                         const std::vector<LtsminLabel>& labels) {
  Observed observed(network);
  for (const LtsminLabel& label : labels) observed.add(label.of);
  return forget_dead_values(network, observed);
}

std::optional<Options> options_of(const std::vector<std::string>& words) {
  std::vector<const char*> line = {"btcheck", "export", "--to", "ltsmin"};
  for (const std::string& word : words) line.push_back(word.c_str());
  auto parsed = parse_options(static_cast<int>(line.size()), line.data());
  if (auto* options = std::get_if<Options>(&parsed)) return std::move(*options);
  tell(std::get<Answer>(parsed).text);
  return std::nullopt;
}

// What is wrong with the words, where none is read by itself.
std::string_view complaint_about(const PinsWords& words) {
  if (words.choices.has_guards && words.choices.tells_idle) {
    return "--guards and --idle do not go together";
  }
  const bool says_format =
      std::ranges::any_of(words.others, [](std::string_view word) {
        return word == "--to" || word.starts_with("--to=");
      });
  return says_format ? "--to belongs to `btcheck export`: leave it out" : "";
}

// The words of the file, if it is one of words, and those beside it.
Result<PinsWords> words_for(const std::string& file, const std::string& also) {
  std::vector<std::string> words = {file};
  if (file.ends_with(".btpins")) {
    auto read = read_file(file);
    if (!read.value) return {std::nullopt, std::move(read.diagnostics)};
    auto split = split_words(file, read.value->text);
    if (!split.value) return {std::nullopt, std::move(split.diagnostics)};
    words = std::move(*split.value);
  }
  auto more = split_words("BTCHECK_PINS", also);
  if (!more.value) return {std::nullopt, std::move(more.diagnostics)};
  words.insert(words.end(), more.value->begin(), more.value->end());
  return {sorted_pins_words(std::move(words)), {}};
}

}  // namespace

PinsModel::PinsModel(TreeInput input, LtsminModel model,
                     const PinsChoices& choices)
    : input_(std::move(input)),
      model_(std::move(model)),
      choices_(choices),
      labels_(labels_of(model_.claims)),
      forgotten_(model_.network->variables.size(), false) {
  if (choices.forgets) {
    live_ = live_network(*model_.network, labels_);
    forgotten_ = live_->forgotten;
  }
  system_.emplace(live_ ? live_->network : *model_.network);
  labelled_.emplace(*system_, predicates_of(labels_));
  slots_.emplace(*system_, choices.slots);
  groups_.emplace(*system_, *slots_);
  if (choices.has_guards) guards_.emplace(*system_, *slots_, *groups_);
}

std::string PinsModel::slot_name(std::size_t number) const {
  const Slot& slot = (*slots_)[number];
  if (slot.variable) {
    return qualified_name(system_->network(), *slot.variable);
  }
  if (slot.clock) return system_->network().automaton(*slot.clock).name + ".t";
  return fmt::format("slot{}", number);
}

std::vector<std::string> PinsModel::value_names(std::size_t number) const {
  const Slot& slot = (*slots_)[number];
  if (!slot.variable) return {};
  return system_->network().variable(*slot.variable).value_names;
}

std::vector<int> PinsModel::initial() const {
  std::vector<int> state(slots_->size());
  system_->initial_states(
      [&](StateView first) { slots_->unpack(first.data(), state.data()); });
  return state;
}

bool PinsModel::label(std::size_t number, const int* state) const {
  const Buffers at(*this, state);
  const bool is_dead =
      labels_[number].of.when_dead && !system_->enabled(at.view()).any;
  return labelled_->holds(number, at.view(), is_dead);
}

bool PinsModel::guard(std::uint32_t number, const int* state) const {
  return guards_->holds(number, Buffers(*this, state).view());
}

SlotSet PinsModel::slots_of_label(std::size_t number) const {
  const StatePredicate& of = labels_[number].of;
  SlotSet read = slots_->none();
  if (of.when_dead) return read.set();
  for_each_read(of.expression, [&](VariableId variable, std::optional<int>) {
    slots_->add(system_->layout().fields[index(variable)], read);
  });
  return read;
}

std::size_t PinsModel::mover(std::uint32_t group) const {
  return group == groups_->time() ? system_->network().automata.size()
                                  : index(groups_->edge(group).automaton);
}

bool PinsModel::is_progress(std::uint32_t group) const {
  return group == groups_->time() ||
         system_->network().automata[mover(group)].kind !=
             AutomatonKind::StateVariable;
}

std::string words_of_environment() {
  const char* words = std::getenv("BTCHECK_PINS");
  return words == nullptr ? "" : words;
}

std::unique_ptr<PinsModel> load_model(const std::string& file,
                                      const std::string& also) {
  const auto words = words_for(file, also);
  tell(shown(words.diagnostics));
  if (!words.value) return nullptr;
  const std::string_view complaint = complaint_about(*words.value);
  if (!complaint.empty()) {
    complain("BT0001", complaint);
    return nullptr;
  }
  const auto options = options_of(words.value->others);
  if (!options) return nullptr;
  std::vector<Diagnostic> found;
  auto inputs = read_inputs(*options, found);
  if (!inputs) return nullptr;
  auto model = ltsmin_model(inputs->tree, inputs->properties,
                            {options->format, options->ticks, options->assume});
  show(*options, model.diagnostics);
  if (!model.value) return nullptr;
  return std::make_unique<PinsModel>(
      std::move(inputs->tree), std::move(*model.value), words.value->choices);
}

}  // namespace btcheck
