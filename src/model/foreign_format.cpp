// SPDX-License-Identifier: MIT
#include "model/foreign_format.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "model/tree_file.hpp"

namespace btcheck {
namespace {

constexpr std::string_view kBlanks = " \t\r\n";

struct Format {
  std::string_view what;  // follows the name of the file
  std::string_view help;
};

constexpr std::string_view kRewrite =
    "write the tree as XML of BehaviorTree.CPP (.xml, .btproj) or in .btf";

constexpr Format kJson = {"is JSON", kRewrite};
constexpr Format kBehavior3 = {"is a tree of behavior3 in JSON", kRewrite};
constexpr Format kYaml = {"is YAML", kRewrite};
constexpr Format kPython = {
    "is a Python program",
    "a tree that a program builds has to be written down first, as XML of "
    "BehaviorTree.CPP (.xml) or in .btf"};
constexpr Format kGodot = {"is a scene or resource of Godot", kRewrite};
constexpr Format kScxml = {"is SCXML, a state machine",
                           "btcheck reads behavior trees: XML of "
                           "BehaviorTree.CPP (.xml, .btproj), and "
                           ".btf"};
constexpr Format kBehaVerify = {"is a tree of BehaVerify", kRewrite};
constexpr Format kXml = {"is XML, and its name does not say so",
                         "trees of BehaviorTree.CPP are read from files that "
                         "end in .xml or .btproj"};

// The name of the first tag, declarations and comments left out.
std::string_view first_tag(std::string_view text) {
  for (text = without_blanks(text); text.starts_with('<');
       text = without_blanks(text)) {
    const bool is_comment = text.starts_with("<!--");
    if (!is_comment && !text.starts_with("<?") && !text.starts_with("<!")) {
      const std::size_t end = text.find_first_of(" \t\r\n/>");
      return text.substr(1, std::min(end, text.size()) - 1);
    }
    const std::string_view closing = is_comment ? "-->" : ">";
    const std::size_t end = text.find(closing);
    if (end == text.npos) return {};
    text.remove_prefix(end + closing.size());
  }
  return {};
}

bool has(std::string_view text, std::string_view part) {
  return text.find(part) != text.npos;
}

// `{"…` or `[{…`: what no other text begins with.
bool begins_json(std::string_view text) {
  if (!text.starts_with('{') && !text.starts_with('[')) return false;
  const std::string_view rest = without_blanks(text.substr(1));
  constexpr std::string_view kNext = "\"{[]}";
  return !rest.empty() && has(kNext, rest.substr(0, 1));
}

// A tree or a project of its editor.
bool is_behavior3(std::string_view text) {
  const bool has_nodes = has(text, "\"root\"") && has(text, "\"nodes\"");
  const bool is_of_editor = has(text, "\"custom_nodes\"") ||
                            has(text, "\"properties\"") ||
                            has(text, "\"title\"");
  return has_nodes && is_of_editor;
}

// Its comments are `#comment# … #end_comment#` and, newer, `#{ … }#`.
std::string_view without_behaverify_comments(std::string_view text) {
  while (text.starts_with("#comment#") || text.starts_with("#{")) {
    const std::string_view closing =
        text.starts_with("#{") ? "}#" : "#end_comment#";
    const std::size_t end = text.find(closing);
    if (end == text.npos) return {};
    text = without_blanks(text.substr(end + closing.size()));
  }
  return text;
}

bool begins_behaverify(std::string_view text) {
  constexpr std::array<std::string_view, 4> kSections = {
      "configuration", "enumerations", "constants", "variables"};
  text = without_behaverify_comments(text);
  const std::size_t end = text.find_first_of(" \t\r\n{");
  if (end == text.npos) return false;
  return std::ranges::find(kSections, text.substr(0, end)) != kSections.end() &&
         without_blanks(text.substr(end)).starts_with('{');
}

bool begins_python(std::string_view text) {
  const std::string_view line = text.substr(0, text.find('\n'));
  return text.starts_with("#!") && has(line, "python");
}

const Format* format_of_content(std::string_view text) {
  if (begins_json(text)) return is_behavior3(text) ? &kBehavior3 : &kJson;
  if (text.starts_with("[gd_")) return &kGodot;
  if (begins_behaverify(text)) return &kBehaVerify;
  if (begins_python(text)) return &kPython;
  return nullptr;
}

const Format* format_of_name(std::string_view name) {
  constexpr std::array<std::pair<std::string_view, const Format*>, 8> kEndings =
      {{{".py", &kPython},
        {".json", &kJson},
        {".yaml", &kYaml},
        {".yml", &kYaml},
        {".scxml", &kScxml},
        {".tscn", &kGodot},
        {".tres", &kGodot},
        {".gd", &kGodot}}};
  const auto found = std::ranges::find_if(
      kEndings, [&](const auto& row) { return name.ends_with(row.first); });
  return found == kEndings.end() ? nullptr : found->second;
}

const Format* format_of(std::string_view name, std::string_view text) {
  text = without_blanks(text);
  if (text.starts_with('<')) {
    if (first_tag(text) == "scxml") return &kScxml;
    const bool has_name = !name.starts_with('<');  // as <stdin> does
    return is_xml_name(name) || !has_name ? nullptr : &kXml;
  }
  // A list or a comment of .btf, whatever the file is called.
  if (text.starts_with('(') || text.starts_with(';')) return nullptr;
  if (const Format* format = format_of_content(text)) return format;
  return format_of_name(name);
}

}  // namespace

std::string_view without_blanks(std::string_view text) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(3);
  const std::size_t begin = text.find_first_not_of(kBlanks);
  return begin == text.npos ? std::string_view() : text.substr(begin);
}

std::optional<Diagnostic> refusal_of_foreign(const std::string& name,
                                             std::string_view text) {
  const Format* format = format_of(name, text);
  if (format == nullptr) return std::nullopt;
  return SourceText(name, "").diagnostic(
      Severity::Error, "BT1652", {}, fmt::format("`{}` {}", name, format->what),
      "", std::string(format->help));
}

}  // namespace btcheck
