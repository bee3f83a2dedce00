// SPDX-License-Identifier: MIT
//
// toml++ reads; what the keys mean is said here, one function for each kind of
// value. A mistake in an entry is that entry's own.
#include "cli/batch/manifest.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

// toml++ 3.3 asserts of `[[ =` what it checks right after, and in release
// builds lets clang rely on it. Without its assertions that is the error it
// should be.
#pragma push_macro("NDEBUG")
#undef NDEBUG
#define TOML_ASSERT(condition) static_assert(true)
#define TOML_HEADER_ONLY 1
#define TOML_EXCEPTIONS 0
#include <toml++/toml.h>
#pragma pop_macro("NDEBUG")

#include "cli/sizes.hpp"
#include "trace/shown_text.hpp"

namespace btcheck {
namespace {

using Words = std::vector<std::string>;

const Words kChoiceKeys = {"tick",    "search",     "reduce", "assume",
                           "threads", "max-states", "memory", "timeout"};
const Words kEntryKeys = {"name",   "tree",    "properties",
                          "folder", "exclude", "expect"};

std::string_view kind_of(const toml::node& node) {
  if (node.is_string()) return "a text";
  if (node.is_boolean()) return "true or false";
  if (node.is_number()) return "a number";
  if (node.is_array()) return "a list";
  return node.is_table() ? "a table" : "a date or time";
}

SourceSpan span_of(const toml::source_region& region) {
  SourceSpan span;
  span.line = static_cast<int>(region.begin.line);
  span.column = std::max(1, static_cast<int>(region.begin.column));
  if (region.begin.line == region.end.line) {
    const int end = static_cast<int>(region.end.column);
    span.length = std::max(1, end - span.column);
  }
  return span;
}

// Reads the values of one table. Errors go to the list it is given.
class TableReader {
 public:
  TableReader(const SourceText& source, std::vector<Diagnostic>& found)
      : source_(source), found_(found) {}

  void error(std::string_view code, const toml::source_region& region,
             std::string message, std::string label, std::string help) {
    found_.push_back(source_.diagnostic(Severity::Error, code, span_of(region),
                                        std::move(message), std::move(label),
                                        std::move(help)));
  }

  Diagnostic place(const toml::source_region& region) const {
    return source_.diagnostic(Severity::Error, "BT1506", span_of(region), {});
  }

  void refuse_key(const toml::key& key, const Words& known) {
    const auto near = closest_match(key.str(), known);
    error("BT1503", key.source(),
          fmt::format("unknown key `{}`", one_line(key.str())), {},
          near ? fmt::format("did you mean `{}`?", *near)
               : fmt::format("there are: {}", fmt::join(known, ", ")));
  }

  bool refuse(const toml::node& node, std::string_view key,
              std::string_view wanted, std::string_view example) {
    error("BT1504", node.source(),
          fmt::format("`{}` is {}", one_line(key), wanted),
          fmt::format("this is {}", kind_of(node)),
          fmt::format("write for instance `{} = {}`", key, example));
    return false;
  }

  bool text(const toml::node& node, std::string_view key,
            std::string_view example, std::string& to) {
    const auto value = node.value<std::string>();
    if (!node.is_string() || value->empty()) {
      return refuse(node, key, "a text that is not empty", example);
    }
    to = *value;
    return true;
  }

  // A text, or a list of them.
  bool texts(const toml::node& node, std::string_view key,
             std::string_view example, Words& to) {
    const toml::array* list = node.as_array();
    if (list == nullptr) return text(node, key, example, to.emplace_back());
    for (const toml::node& part : *list) {
      if (!text(part, key, example, to.emplace_back())) return false;
    }
    return true;
  }

  // One of several words; its number among them.
  std::optional<std::size_t> word(const toml::node& node, std::string_view key,
                                  const Words& known) {
    const auto value = node.value<std::string>();
    for (std::size_t i = 0; i < known.size(); ++i) {
      if (node.is_string() && *value == known[i]) return i;
    }
    if (!node.is_string()) {
      refuse(node, key, "a word", fmt::format("\"{}\"", known[0]));
      return std::nullopt;
    }
    const auto near = closest_match(*value, known);
    error("BT1504", node.source(),
          fmt::format("`{}` is one of: {}", one_line(key),
                      fmt::join(known, ", ")),
          "not one of them",
          near ? fmt::format("did you mean `{}`?", *near) : "");
    return std::nullopt;
  }

  std::optional<std::uint64_t> count(const toml::node& node,
                                     std::string_view key, std::uint64_t most) {
    const auto value = node.value<std::int64_t>();
    const bool is_fit = node.is_integer() && *value >= 1 &&
                        static_cast<std::uint64_t>(*value) <= most;
    if (is_fit) return static_cast<std::uint64_t>(*value);
    refuse(node, key,
           most == UINT64_MAX ? "a number from 1 on"
                              : fmt::format("a number from 1 to {}", most),
           "4");
    return std::nullopt;
  }

  std::optional<double> seconds(const toml::node& node, std::string_view key) {
    const auto value = node.value<double>();
    const bool is_number = node.is_integer() || node.is_floating_point();
    if (is_number && std::isfinite(*value) && *value >= 0) return value;
    refuse(node, key, "a number of seconds, 0 for no limit", "60");
    return std::nullopt;
  }

  // True when the key is one of those for choices, whatever its value.
  bool choice(const toml::key& key, const toml::node& node, EntryChoices& to) {
    const std::string_view name = key.str();
    if (name == "tick") {
      static const Words kTicks = {"root", "leaves", "nodes", "none"};
      if (const auto i = word(node, name, kTicks)) {
        to.ticks = tick_semantics(kTicks[*i]);
      }
    } else if (name == "search") {
      if (const auto i = word(node, name, {"bfs", "dfs"})) {
        to.search =
            *i == 0 ? SearchOrder::BreadthFirst : SearchOrder::DepthFirst;
      }
    } else if (name == "reduce") {
      static const Words kReductions = {"full", "live", "none"};
      if (const auto i = word(node, name, kReductions)) {
        to.reduce = reduction_named(kReductions[*i]);
      }
    } else if (name == "assume") {
      if (const auto i = word(node, name, {"actions-end", "nothing"})) {
        to.assume =
            *i == 0 ? ExtraAssumption::ActionsEnd : ExtraAssumption::None;
      }
    } else {
      return limit(name, node, to);
    }
    return true;
  }

  // `expect`: a verdict for each property it names.
  void expectations(const toml::node& node, std::vector<ExpectedVerdict>& to) {
    const toml::table* table = node.as_table();
    if (table == nullptr) {
      refuse(node, "expect", "a table of properties and verdicts",
             "{ watched = \"violated\" }");
      return;
    }
    for (const auto& [key, verdict] : *table) {
      const auto i = word(verdict, key.str(), {"holds", "violated"});
      if (!i) continue;
      to.push_back({std::string(key.str()),
                    *i == 0 ? Expectation::Holds : Expectation::Violated,
                    place(key.source())});
    }
    in_order_of_lines(to);
  }

 private:
  bool limit(std::string_view name, const toml::node& node, EntryChoices& to) {
    if (name == "threads") {
      if (const auto value = count(node, name, kMostThreads)) {
        to.threads = static_cast<unsigned>(*value);
      }
    } else if (name == "max-states") {
      if (const auto value = count(node, name, UINT64_MAX)) {
        to.max_states = *value;
      }
    } else if (name == "memory") {
      const auto value = node.value<std::string>();
      if (node.is_string()) to.max_bytes = bytes_in(*value);
      if (!to.max_bytes) refuse(node, name, "a size", "\"4G\"");
    } else if (name == "timeout") {
      to.timeout = seconds(node, name);
    } else {
      return false;
    }
    return true;
  }

  // toml++ keeps a table in the order of its keys.
  static void in_order_of_lines(std::vector<ExpectedVerdict>& expected) {
    std::sort(expected.begin(), expected.end(),
              [](const ExpectedVerdict& one, const ExpectedVerdict& other) {
                const SourceSpan& a = one.place.span;
                const SourceSpan& b = other.place.span;
                return a.line != b.line ? a.line < b.line : a.column < b.column;
              });
  }

  const SourceText& source_;
  std::vector<Diagnostic>& found_;
};

class ManifestReader {
 public:
  explicit ManifestReader(const SourceText& source) : source_(source) {}

  Manifest read(const toml::table& file) {
    read_top(file);
    if (has_error(manifest_.diagnostics)) manifest_.entries.clear();
    return std::move(manifest_);
  }

 private:
  void read_top(const toml::table& file) {
    TableReader in(source_, manifest_.diagnostics);
    if (const toml::node* defaults = file.get("defaults")) {
      read_defaults(*defaults);
    }
    for (const auto& [key, node] : file) {
      if (key.str() == "entry") {
        read_entries(node);
      } else if (key.str() != "defaults") {
        in.refuse_key(key, {"defaults", "entry"});
      }
    }
    if (!manifest_.entries.empty() || has_error(manifest_.diagnostics)) return;
    manifest_.diagnostics.push_back(source_.diagnostic(
        Severity::Error, "BT1507", {0, 0, 1}, "no entry in this manifest", {},
        "write `[[entry]]`, and below it `tree = \"TREE.btf\"`"));
  }

  void read_defaults(const toml::node& node) {
    TableReader in(source_, manifest_.diagnostics);
    const toml::table* table = node.as_table();
    if (table == nullptr) {
      in.error("BT1504", node.source(), "`defaults` is a table",
               fmt::format("this is {}", kind_of(node)), "write `[defaults]`");
      return;
    }
    for (const auto& [key, value] : *table) {
      if (!in.choice(key, value, defaults_)) in.refuse_key(key, kChoiceKeys);
    }
  }

  void read_entries(const toml::node& node) {
    const toml::array* list = node.as_array();
    const bool are_tables =
        list != nullptr &&
        std::all_of(list->begin(), list->end(),
                    [](const toml::node& one) { return one.is_table(); });
    if (are_tables) {
      for (const toml::node& one : *list) read_entry(*one.as_table());
      return;
    }
    TableReader(source_, manifest_.diagnostics)
        .error("BT1504", node.source(), "`entry` is a list of tables",
               fmt::format("this is {}", kind_of(node)), "write `[[entry]]`");
  }

  void read_entry(const toml::table& table) {
    ManifestEntry entry;
    TableReader in(source_, entry.diagnostics);
    entry.place = in.place(table.source());
    for (const auto& [key, value] : table) {
      if (in.choice(key, value, entry.choices)) continue;
      if (!read_key(in, key.str(), value, entry)) {
        Words known = kEntryKeys;
        known.insert(known.end(), kChoiceKeys.begin(), kChoiceKeys.end());
        in.refuse_key(key, known);
      }
    }
    refuse_mismatch(in, table, entry);
    std::sort(entry.diagnostics.begin(), entry.diagnostics.end(),
              [](const Diagnostic& one, const Diagnostic& other) {
                return std::pair(one.span.line, one.span.column) <
                       std::pair(other.span.line, other.span.column);
              });
    entry.choices = completed(entry.choices, defaults_);
    manifest_.entries.push_back(std::move(entry));
  }

  static bool read_key(TableReader& in, std::string_view key,
                       const toml::node& value, ManifestEntry& entry) {
    if (key == "name") {
      in.text(value, key, "\"by nodes\"", entry.name);
    } else if (key == "tree") {
      in.text(value, key, "\"robot.btf\"", entry.tree);
    } else if (key == "properties") {
      in.texts(value, key, "[\"robot.ltl\"]", entry.properties);
    } else if (key == "folder") {
      in.text(value, key, "\"trees\"", entry.folder);
    } else if (key == "exclude") {
      in.texts(value, key, "[\"draft.btf\"]", entry.exclude);
    } else if (key == "expect") {
      in.expectations(value, entry.expected);
    } else {
      return false;
    }
    return true;
  }

  static void refuse_mismatch(TableReader& in, const toml::table& table,
                              const ManifestEntry& entry) {
    if (has_error(entry.diagnostics)) return;
    const auto mismatch = [&](const char* key, const char* message,
                              const char* help) {
      const toml::node* node = table.get(key);
      in.error("BT1505", node == nullptr ? table.source() : node->source(),
               message, {}, help);
    };
    const bool has_folder = !entry.folder.empty();
    if (!has_folder && entry.tree.empty() && entry.properties.empty()) {
      mismatch("", "an entry without a tree",
               "write `tree = \"TREE.btf\"`, `properties = \"RULES.ltl\"` or "
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

  const SourceText& source_;
  Manifest manifest_;
  EntryChoices defaults_;
};

}  // namespace

Manifest read_manifest(std::string_view name, std::string_view text) {
  const SourceText source(name, text);
  if (auto refusal = source.refuse_binary()) return {{}, {*refusal}};
  toml::parse_result parsed = toml::parse(text);
  if (parsed) return ManifestReader(source).read(parsed.table());
  const toml::parse_error& error = parsed.error();
  return {{},
          {source.diagnostic(Severity::Error, "BT1502", span_of(error.source()),
                             "this is not TOML", one_line(error.description()),
                             "values are written as in `tree = \"x.btf\"`")}};
}

}  // namespace btcheck
