// SPDX-License-Identifier: MIT
#include "batch/entries/manifest.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "settings/key_reader.hpp"
#include "settings/toml.hpp"

namespace btcheck {
namespace {

const Words kEntryKeys = {"name",   "tree",    "properties",
                          "folder", "exclude", "expect"};

constexpr auto by_place = [](const Diagnostic& one) {
  return std::pair(one.span.line, one.span.column);
};

// A verdict for each property that a table names.
std::vector<ExpectedVerdict> expectations_in(KeyReader in, Mistakes& mistakes) {
  std::vector<ExpectedVerdict> expected;
  const TomlNode* table =
      in.table("properties and verdicts", "{ watched = \"violated\" }");
  if (table == nullptr) return expected;
  for (const TomlMember& member : table->members) {
    const auto value = KeyReader(mistakes, member)
                           .one_of({"holds", "violated"},
                                   {Expectation::Holds, Expectation::Violated});
    if (!value) continue;
    expected.push_back({member.key, *value,
                        mistakes.source.diagnostic(Severity::Error, "BT1506",
                                                   member.span, {})});
  }
  return expected;
}

class ManifestReader {
 public:
  ManifestReader(const std::string& name, const SourceText& source)
      : name_(name), source_(source) {}

  Manifest read(const TomlNode& file) {
    if (const TomlNode* defaults = member_of(file, "defaults")) {
      read_defaults(*defaults);
    }
    for (const TomlMember& member : file.members) {
      if (member.key == "entry") {
        read_entries(member.value);
      } else if (member.key != "defaults") {
        mistakes_.add_unknown(member, {"defaults", "entry"});
      }
    }
    if (has_error(manifest_.diagnostics)) {
      manifest_.entries.clear();
    } else if (manifest_.entries.empty()) {
      manifest_.diagnostics.push_back(source_.diagnostic(
          Severity::Error, "BT1507", {0, 0, 1}, "no entry in this manifest", {},
          "write `[[entry]]`, and below it `tree = \"TREE\"`"));
    }
    return std::move(manifest_);
  }

 private:
  void read_defaults(const TomlNode& node) {
    if (node.kind != TomlNode::Kind::Table) {
      mistakes_.add_other_kind(node, "`defaults` is a table",
                               "write `[defaults]`");
      return;
    }
    for (const TomlMember& member : node.members) {
      if (!read_choice({mistakes_, member}, name_, defaults_)) {
        mistakes_.add_unknown(member, kChoiceKeys);
      }
    }
  }

  void read_entries(const TomlNode& node) {
    if (!node.is_list_of_tables()) {
      mistakes_.add_other_kind(node, "`entry` is a list of tables",
                               "write `[[entry]]`");
      return;
    }
    for (const TomlNode& one : node.items) read_entry(one);
  }

  void read_entry(const TomlNode& table) {
    ManifestEntry entry;
    entry.choices = defaults_;
    Mistakes mistakes{source_, entry.diagnostics};
    for (const TomlMember& member : table.members) {
      const KeyReader in(mistakes, member);
      if (read_choice(in, name_, entry.choices)) continue;
      if (read_key(in, mistakes, entry)) continue;
      Words known = kEntryKeys;
      known.insert(known.end(), kChoiceKeys.begin(), kChoiceKeys.end());
      mistakes.add_unknown(member, known);
    }
    refuse_mismatch(mistakes, table, entry);
    std::ranges::sort(entry.diagnostics, {}, by_place);
    manifest_.entries.push_back(std::move(entry));
  }

  static bool read_key(KeyReader in, Mistakes& mistakes, ManifestEntry& entry) {
    const std::string_view key = in.key();
    if (key == "name") {
      entry.name = in.text("\"by nodes\"").value_or("");
    } else if (key == "tree") {
      entry.tree = in.text("\"robot.btf\"").value_or("");
    } else if (key == "properties") {
      entry.properties = in.texts("[\"robot.ltl\"]").value_or(Words());
    } else if (key == "folder") {
      entry.folder = in.text("\"trees\"").value_or("");
    } else if (key == "exclude") {
      entry.exclude = in.texts("[\"draft.btf\"]").value_or(Words());
    } else if (key == "expect") {
      entry.expected = expectations_in(in, mistakes);
    } else {
      return false;
    }
    return true;
  }

  static void refuse_mismatch(Mistakes& mistakes, const TomlNode& table,
                              const ManifestEntry& entry) {
    if (has_error(entry.diagnostics)) return;
    const auto mismatch = [&](const char* key, const char* message,
                              const char* help) {
      const TomlNode* node = member_of(table, key);
      mistakes.add("BT1505", node == nullptr ? table.span : node->span, message,
                   {}, help);
    };
    const bool has_folder = !entry.folder.empty();
    if (!has_folder && entry.tree.empty() && entry.properties.empty()) {
      mismatch("", "an entry without a tree",
               "write `tree = \"TREE\"`, `properties = \"RULES.ltl\"` or "
               "`folder = \"TREES\"`");
    } else if (has_folder && !entry.tree.empty()) {
      mismatch("tree", "an entry is a tree or a folder, not both",
               "write two entries");
    } else if (has_folder && !entry.properties.empty()) {
      mismatch("properties", "a folder's property files are found by name",
               "leave `properties` out, or name a tree instead of a folder");
    } else if (has_folder && !entry.name.empty()) {
      mismatch("name", "what is found in a folder has names of its own",
               "leave `name` out");
    } else if (!has_folder && !entry.exclude.empty()) {
      mismatch("exclude", "`exclude` belongs to `folder`", "leave it out");
    } else if (!entry.expected.empty() && entry.properties.empty()) {
      mismatch("expect", "`expect` needs `properties`",
               has_folder ? "write an entry of its own for that tree"
                          : "the default report has no named properties");
    }
  }

  const std::string& name_;
  const SourceText& source_;
  Manifest manifest_;
  Mistakes mistakes_{source_, manifest_.diagnostics};
  OptionChoices defaults_;
};

}  // namespace

Manifest read_manifest(const std::string& name, std::string_view text) {
  const SourceText source(name, text);
  const auto file = read_toml(source);
  if (!file.value) return {{}, file.diagnostics};
  return ManifestReader(name, source).read(*file.value);
}

}  // namespace btcheck
