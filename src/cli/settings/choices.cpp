// SPDX-License-Identifier: MIT
#include "cli/settings/choices.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <optional>

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

// Names of files beside the one that names them.
std::optional<Words> files_in(KeyReader in, const std::string& file,
                              std::string_view example) {
  auto files = in.texts(example);
  if (!files) return files;
  for (std::string& name : *files) name = beside(file, name);
  return files;
}

// Files of contracts; enumerators stay.
void set_leaves(const std::optional<Words>& files, OptionChoices& to) {
  if (!files) return;
  to.push_back({"--leaves", [chosen = *files](Options& options) {
                  std::erase_if(options.leaves, [](const std::string& name) {
                    return !name.starts_with('(');
                  });
                  options.leaves.insert(options.leaves.begin(), chosen.begin(),
                                        chosen.end());
                }});
}

// As what a file of contracts says of them.
void add_enumerators(KeyReader in, OptionChoices& to) {
  const TomlNode* const table =
      in.table("enumerators and their numbers", "{ RED = 1, GREEN = 2 }");
  if (table == nullptr) return;
  std::string contract = "(defenum";
  for (const TomlMember& member : table->members) {
    const bool is_number = member.value.kind == TomlNode::Kind::Integer;
    contract += fmt::format(
        " {} {}", member.key,
        is_number ? std::to_string(member.value.integer) : member.value.text);
  }
  to.push_back({"--enums", [text = contract + ")"](Options& options) {
                  options.leaves.push_back(text);
                }});
}

// Those that say how a tree is read.
bool read_reading(KeyReader in, const std::string& file, OptionChoices& to) {
  const std::string_view key = in.key();
  if (key == "profile") {
    set(to, key, &Options::profile, in.choice<Profile>("--profile"));
  } else if (key == "models") {
    set(to, key, &Options::models, files_in(in, file, "[\"nodes.xml\"]"));
  } else if (key == "leaves") {
    set_leaves(files_in(in, file, "[\"robot.leaves\"]"), to);
  } else if (key == "enums") {
    add_enumerators(in, to);
  } else if (key == "loop") {
    set(to, key, &Options::loops, in.flag());
  } else if (key == "wake-ups") {
    set(to, key, &Options::wakes, in.flag());
  } else if (key == "main-tree") {
    set(to, key, &Options::main_tree, in.text("\"Patrol\""));
  } else if (key == "tick-ms") {
    set(to, key, &Options::tick_ms, in.count(3'600'000));
  } else {
    return false;
  }
  return true;
}

// Those of the search.
bool read_search(KeyReader in, OptionChoices& to) {
  const std::string_view key = in.key();
  if (key == "tick") {
    set(to, key, &Options::ticks, in.choice<TickSemantics>("--tick"));
  } else if (key == "search") {
    set(to, key, &Options::search, in.choice<SearchOrder>("--search"));
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

bool read_choice(KeyReader in, const std::string& file, OptionChoices& to) {
  return read_reading(in, file, to) || read_search(in, to);
}

std::string beside(const std::string& file, const std::string& name) {
  return (std::filesystem::path(file).parent_path() / name)
      .lexically_normal()
      .string();
}

}  // namespace btcheck
