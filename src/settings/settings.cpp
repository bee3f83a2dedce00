// SPDX-License-Identifier: MIT
#include "settings/settings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <optional>
#include <utility>

#include "model/tree_file.hpp"
#include "report/codes/codes.hpp"
#include "settings/key_reader.hpp"
#include "settings/toml.hpp"
#include "text/wildcards.hpp"
#include "trace/run/shown_text.hpp"

namespace btcheck {
namespace {

// Those that say how a tree is read, as far as that is the same for all trees
// of a project.
const Words kTreeKeys = {"profile", "tick-ms", "loop", "wake-ups",
                         "models",  "leaves",  "enums"};
const Words kKeys = {"profile", "tick-ms", "loop",    "wake-ups",
                     "models",  "leaves",  "enums",   "deny",
                     "levels",  "paths",   "excludes"};

template <class Value, class Read>
void take(std::optional<Value>& to, const std::optional<Read>& read) {
  if (read) to = static_cast<Value>(*read);
}

Words profile_names() {
  Words names;
  for (const ProfileRow& row : kProfiles) names.emplace_back(row.name);
  return names;
}

// Names of files beside the one that names them.
std::optional<Words> files_in(KeyReader in, const std::string& file,
                              std::string_view example) {
  auto files = in.texts(example);
  if (!files) return files;
  for (std::string& name : *files) name = included_name(file, name);
  return files;
}

// As what a file of contracts says of them.
std::optional<std::string> enumerators_in(KeyReader in) {
  const TomlNode* const table =
      in.table("enumerators and their numbers", "{ RED = 1, GREEN = 2 }");
  if (table == nullptr) return std::nullopt;
  std::string contract = "(defenum";
  for (const TomlMember& member : table->members) {
    const bool is_number = member.value.kind == TomlNode::Kind::Integer;
    contract += fmt::format(
        " {} {}", member.key,
        is_number ? std::to_string(member.value.integer) : member.value.text);
  }
  return contract + ")";
}

class SettingsReader {
 public:
  SettingsReader(const std::string& directory, const std::string& name,
                 const SourceText& source)
      : name_(name),
        folder_(folder_of(directory, name)),
        mistakes_{source, found_} {}

  Result<Settings> read(const TomlNode& file) {
    for (const TomlMember& member : file.members) {
      if (!read_key(member)) mistakes_.add_unknown(member, kKeys);
    }
    if (!found_.empty()) return {std::nullopt, std::move(found_)};
    auto& levels = settings_.levels;
    levels = std::move(denied_);
    std::ranges::move(everywhere_, std::back_inserter(levels));
    std::ranges::move(by_path_, std::back_inserter(levels));
    return {std::move(settings_), {}};
  }

 private:
  using Rules = std::vector<LevelRule>;

  bool read_key(const TomlMember& member) {
    const KeyReader in(mistakes_, member);
    if (member.key == "deny") {
      read_deny(in, member.value);
    } else if (member.key == "excludes") {
      read_excludes(in);
    } else if (member.key == "levels") {
      read_levels(in, "", everywhere_);
    } else if (member.key == "paths") {
      read_paths(member.value);
    } else {
      return std::ranges::count(kTreeKeys, member.key) > 0 &&
             read_reading_choice(in, name_, settings_.reading);
    }
    return true;
  }

  // `drafts/` is the folder `drafts`.
  void read_excludes(KeyReader in) {
    settings_.excludes = {folder_, in.texts("[\"vendor\"]").value_or(Words())};
    for (std::string& pattern : settings_.excludes.patterns) {
      if (pattern.ends_with('/')) pattern.pop_back();
    }
  }

  void read_deny(KeyReader in, const TomlNode& node) {
    const auto words = in.texts("[\"warnings\"]");
    if (!words) return;
    for (std::size_t i = 0; i < words->size(); ++i) {
      const TomlNode& place = node.items.empty() ? node : node.items[i];
      const auto code = code_in((*words)[i], place.span);
      if (!code) continue;
      if (*code == kWarnings) {
        settings_.denied.push_back(*code);
      } else {
        denied_.push_back({*code, Level::Error, folder_, ""});
      }
    }
  }

  // What is said of all warnings comes first: what is said of a code wins.
  void read_levels(KeyReader in, const std::string& pattern, Rules& to) {
    const TomlNode* table =
        in.table("codes and levels", "{ BT2205 = \"note\" }");
    if (table == nullptr) return;
    Rules rules;
    for (const TomlMember& member : table->members) {
      if (mistakes_.is_full()) return;
      const auto code = code_in(member.key, member.span);
      const auto level =
          KeyReader(mistakes_, member)
              .one_of<Level>({"allow", "note", "warning", "error"});
      if (code && level) rules.push_back({*code, *level, folder_, pattern});
    }
    std::stable_partition(
        rules.begin(), rules.end(),
        [](const LevelRule& rule) { return rule.code == kWarnings; });
    std::ranges::move(rules, std::back_inserter(to));
  }

  void read_paths(const TomlNode& node) {
    if (!node.is_list_of_tables()) {
      mistakes_.add_other_kind(node, "`paths` is a list of tables",
                               "write `[[paths]]`");
      return;
    }
    for (const TomlNode& path : node.items) {
      if (mistakes_.is_full()) return;
      read_path(path);
    }
  }

  void read_path(const TomlNode& path) {
    const TomlNode* patterns = member_of(path, "match");
    const TomlNode* levels = member_of(path, "levels");
    for (const TomlMember& member : path.members) {
      if (member.key == "match" || member.key == "levels") continue;
      mistakes_.add_unknown(member, {"match", "levels"});
    }
    if (patterns == nullptr || levels == nullptr) {
      mistakes_.add("BT1505", path.span,
                    "`[[paths]]` needs `match` and `levels`", {},
                    "write `match = \"vendor/*\"`, and below it "
                    "`levels = { BT2205 = \"note\" }`");
      return;
    }
    const auto words =
        KeyReader(mistakes_, "match", *patterns).texts("\"vendor/*\"");
    if (!words) return;
    for (const std::string& pattern : *words) {
      read_levels({mistakes_, "levels", *levels}, pattern, by_path_);
    }
  }

  // The code as it is written everywhere, or kWarnings.
  std::optional<std::string> code_in(std::string_view word,
                                     const SourceSpan& span) {
    if (word == kWarnings) return std::string(word);
    const CodeRow* row = code_named(word);
    if (row != nullptr && has_level(*row)) return std::string(row->code);
    if (mistakes_.is_full()) return std::nullopt;
    const Objection objection = objection_to(shortened(one_line(word), 60));
    mistakes_.add("BT1510", span, objection.message, {}, objection.help);
    return std::nullopt;
  }

  const std::string& name_;
  std::string folder_;
  Settings settings_;
  std::vector<Diagnostic> found_;
  Mistakes mistakes_;
  Rules denied_;
  Rules everywhere_;
  Rules by_path_;
};

}  // namespace

Result<Settings> read_settings(const std::string& directory,
                               const std::string& name, std::string_view text) {
  const SourceText source(name, text);
  const auto file = read_toml(source);
  if (!file.value) return {std::nullopt, file.diagnostics};
  return SettingsReader(directory, name, source).read(*file.value);
}

bool Excludes::has(const std::string& path) const {
  const std::string name =
      std::filesystem::path(path).lexically_relative(folder).string();
  return std::ranges::any_of(patterns, [&](const std::string& pattern) {
    return matches_path(pattern, name);
  });
}

void add_judgement(const Settings& settings, Judgement& to) {
  to.levels = settings.levels;
  to.denied.insert(to.denied.end(), settings.denied.begin(),
                   settings.denied.end());
}

bool read_reading_choice(KeyReader in, const std::string& file,
                         ReadingChoices& to) {
  const std::string_view key = in.key();
  if (key == "profile") {
    take(to.profile, in.one_of<Profile>(profile_names()));
  } else if (key == "models") {
    take(to.models, files_in(in, file, "[\"nodes.xml\"]"));
  } else if (key == "leaves") {
    take(to.leaves, files_in(in, file, "[\"robot.leaves\"]"));
  } else if (key == "enums") {
    to.enums = enumerators_in(in).value_or("");
  } else if (key == "loop") {
    take(to.loops, in.flag());
  } else if (key == "wake-ups") {
    take(to.wakes, in.flag());
  } else if (key == "main-tree") {
    take(to.main_tree, in.text("\"Patrol\""));
  } else if (key == "tick-ms") {
    take(to.tick_ms, in.count(3'600'000));
  } else {
    return false;
  }
  return true;
}

}  // namespace btcheck
