// SPDX-License-Identifier: MIT
#include "cli/settings/choices.hpp"

#include <optional>
#include <utility>

#include "cli/options/tables.hpp"
#include "model/tree_file.hpp"

namespace btcheck {
namespace {

template <class Member, class Value>
void set(OptionChoices& to, std::string_view key, Member Options::*member,
         const std::optional<Value>& value) {
  if (!value) return;
  to.push_back(
      {"--" + std::string(key), [member, chosen = *value](Options& options) {
         options.*member = static_cast<Member>(chosen);
       }});
}

// The same as an option of `btcheck batch` has it.
template <class Enum>
std::optional<Enum> choice(KeyReader& in, std::string_view option) {
  return in.one_of<Enum>(choices_of(*option_of(Command::Batch, option)));
}

// Files of contracts; enumerators stay.
void set_leaves(const Words& files, OptionChoices& to) {
  to.push_back({"--leaves", [files](Options& options) {
                  std::erase_if(options.leaves, [](const std::string& name) {
                    return !name.starts_with('(');
                  });
                  options.leaves.insert(options.leaves.begin(), files.begin(),
                                        files.end());
                }});
}

void add_enumerators(const std::string& contract, OptionChoices& to) {
  to.push_back({"--enums", [contract](Options& options) {
                  options.leaves.push_back(contract);
                }});
}

// Those of the search.
bool read_search(KeyReader in, OptionChoices& to) {
  const std::string_view key = in.key();
  if (key == "tick") {
    set(to, key, &Options::ticks, choice<TickSemantics>(in, "--tick"));
  } else if (key == "search") {
    set(to, key, &Options::search, choice<SearchOrder>(in, "--search"));
  } else if (key == "reduce") {
    set(to, key, &Options::reduce,
        in.one_of({"full", "live", "none"},
                  {Reduction::Full, Reduction::Live, Reduction::None}));
  } else if (key == "assume") {
    set(to, key, &Options::assume,
        in.one_of({"actions-end", "nothing"},
                  {ExtraAssumption::ActionsEnd, ExtraAssumption::None}));
  } else if (key == "threads") {
    set(to, key, &Options::threads, in.count(kMostThreads));
  } else if (key == "max-states") {
    set(to, key, &Options::max_states, in.count());
  } else if (key == "memory") {
    set(to, key, &Options::max_bytes, in.size());
  } else if (key == "timeout") {
    set(to, key, &Options::timeout, in.seconds());
  } else {
    return false;
  }
  return true;
}

}  // namespace

const Words kChoiceKeys = {"tick",    "search",     "reduce",    "assume",
                           "threads", "max-states", "memory",    "timeout",
                           "profile", "tick-ms",    "loop",      "wake-ups",
                           "models",  "leaves",     "main-tree", "enums"};

Options applied(Options options, const OptionChoices& choices) {
  for (const OptionChoice& choice : choices) {
    choice.make(options);
    options.given.insert(choice.option);
  }
  return options;
}

Options applied_below(Options options, const OptionChoices& choices) {
  for (const OptionChoice& choice : choices) {
    if (!options.given.contains(choice.option)) choice.make(options);
  }
  return options;
}

OptionChoices option_choices(const ReadingChoices& reading) {
  OptionChoices choices;
  set(choices, "profile", &Options::profile, reading.profile);
  set(choices, "tick-ms", &Options::tick_ms, reading.tick_ms);
  set(choices, "loop", &Options::loops, reading.loops);
  set(choices, "wake-ups", &Options::wakes, reading.wakes);
  set(choices, "main-tree", &Options::main_tree, reading.main_tree);
  set(choices, "models", &Options::models, reading.models);
  if (reading.leaves) set_leaves(*reading.leaves, choices);
  if (!reading.enums.empty()) add_enumerators(reading.enums, choices);
  return choices;
}

bool read_choice(KeyReader in, const std::string& file, OptionChoices& to) {
  ReadingChoices reading;
  if (!read_reading_choice(in, file, reading)) return read_search(in, to);
  for (OptionChoice& made : option_choices(reading)) {
    to.push_back(std::move(made));
  }
  return true;
}

Options settled(const Options& options, const Settings& settings,
                std::string_view tree, std::string_view text) {
  Options all = applied_below(
      options, option_choices(fitting(settings.reading, is_xml(tree, text))));
  add_judgement(settings, all.judgement);
  return all;
}

ReadingChoices reading_choices(const Options& options) {
  ReadingChoices choices;
  choices.profile = options.profile;
  choices.ticks = options.ticks;
  choices.tick_ms = options.tick_ms;
  choices.loops = options.loops;
  choices.wakes = options.wakes;
  choices.main_tree = options.main_tree;
  choices.models = options.models;
  choices.leaves.emplace();
  for (const std::string& name : options.leaves) {
    if (name.starts_with('(')) {
      choices.enums += name + '\n';
    } else {
      choices.leaves->push_back(name);
    }
  }
  return choices;
}

}  // namespace btcheck
