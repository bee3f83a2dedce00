// SPDX-License-Identifier: MIT
//
// What is known of the word under the pointer: what its type does, what is
// proven of this node, who writes an entry, what a code means.
#include <fmt/format.h>

#include <algorithm>

#include "api/told.hpp"
#include "lsp/diagnostics.hpp"
#include "lsp/features.hpp"
#include "lsp/texts/rule_words.hpp"
#include "lsp/words.hpp"
#include "report/codes/codes.hpp"

namespace btcheck::lsp {
namespace {

constexpr std::size_t kMostNodes = 3;  // of a subtree that is used often
constexpr std::size_t kMostNames = 8;  // of writers and readers

// Marks of Markdown in somebody's text are text.
std::string plain(std::string_view text) {
  std::string all;
  for (const char c : text) {
    if (std::string_view("\\`*_{}[]<>()#+-.!|~&").find(c) !=
        std::string_view::npos) {
      all += '\\';
    }
    all += c == '\n' || c == '\r' ? ' ' : c;
  }
  return all;
}

std::string code(std::string_view text) {
  std::string all(text);
  std::ranges::replace(all, '`', '\'');
  std::ranges::replace(all, '\n', ' ');
  return fmt::format("`{}`", all);
}

Json markdown(const View& view, const std::string& text, TextStretch part) {
  return {{"contents", Json{{"kind", "markdown"}, {"value", text}}},
          {"range", json_of(view.range(part))}};
}

// --- What is proven --------------------------------------------------------

// "can succeed", "never fails"; nothing where it cannot be asked.
void add_answer(const std::optional<v1::Verdict>& verdict, std::string_view can,
                std::string_view never, std::vector<std::string>& to) {
  if (!verdict) return;
  to.push_back(*verdict == v1::Verdict::Holds ? std::string(can)
               : *verdict == v1::Verdict::Violated
                   ? fmt::format("**{}**", never)
                   : fmt::format("{}: not known", can));
}

std::string proven_text(const NodeHere& here) {
  if (here.proven == nullptr) return {};
  std::vector<std::string> all;
  const v1::Node& node = *here.proven;
  if (node.is_ticked == v1::Verdict::Violated) {
    all.emplace_back("**is never ticked**");
  } else {
    add_answer(node.succeeds, "can succeed", "never succeeds", all);
    add_answer(node.fails, "can fail", "never fails", all);
    add_answer(node.runs, "can run", "never runs", all);
    add_answer(node.is_skipped, "can be skipped", "is never skipped", all);
    add_answer(node.is_halted, "can be halted", "is never halted", all);
  }
  if (all.empty()) return {};
  return fmt::format("Proven over all runs: {}.", fmt::join(all, ", "));
}

// --- Entries ---------------------------------------------------------------

std::string names_of(const Look& look, const std::vector<std::size_t>& nodes) {
  std::vector<std::string> all;
  for (const std::size_t each : nodes) {
    if (all.size() == kMostNames) {
      all.push_back(fmt::format("{} more", nodes.size() - kMostNames));
      break;
    }
    const v1::DescribedNode& node = look.description->nodes[each];
    all.push_back(fmt::format("{} (line {})",
                              code(node.label.empty() ? node.type : node.label),
                              node.where.line));
  }
  return all.empty() ? "nobody in the tree"
                     : fmt::format("{}", fmt::join(all, ", "));
}

std::string entry_text(const Look& look, std::size_t number) {
  const v1::Entry& entry = look.description->entries[number];
  std::string text = fmt::format(
      "**entry** {}  \nwritten by {}  \nread by {}", code(entry.name),
      names_of(look, entry.writers), names_of(look, entry.readers));
  if (!entry.values.empty()) {
    std::vector<std::string> values;
    for (const std::string& each : entry.values) values.push_back(code(each));
    if (values.size() > kMostNames) values.resize(kMostNames);
    text += fmt::format("  \nvalues told apart: {}", fmt::join(values, ", "));
  }
  return text;
}

// The entry of this name that a node has to do with, else any.
std::string entry_named(const View& view, std::string_view name,
                        const std::vector<NodeHere>& nodes) {
  if (name.starts_with('@')) name.remove_prefix(1);
  for (const NodeHere& here : nodes) {
    const std::size_t found = entry_of(here, name);
    if (found != kNone) return entry_text(*here.look, found);
  }
  const Look* look = described_look(view);
  if (look == nullptr) return {};
  const auto& entries = look->description->entries;
  const auto found = std::ranges::find(entries, name, &v1::Entry::name);
  return found == entries.end()
             ? std::string()
             : entry_text(*look,
                          static_cast<std::size_t>(found - entries.begin()));
}

// --- Types and ports -------------------------------------------------------

std::string port_line(const PortWord& port) {
  std::string text = fmt::format("- {}", code(port.name));
  std::string facts;
  const auto add = [&](const std::string& fact) {
    if (fact.empty()) return;
    facts += facts.empty() ? fact : ", " + fact;
  };
  add(port.direction);
  add(port.type);
  if (!port.preset.empty()) add("default " + code(port.preset));
  if (port.is_needed) add("needed");
  add(port.in);
  if (!facts.empty()) text += fmt::format(" ({})", facts);
  if (!port.about.empty()) text += ": " + plain(port.about);
  return text;
}

std::string type_text_of(const TypeWord& type) {
  std::string text = fmt::format("**{}** {}", plain(type.id), type.kind);
  if (!type.since.empty()) text += " · " + plain(type.since);
  if (!type.about.empty()) text += "  \n" + plain(type.about);
  return text;
}

// What findings say of the node, and what their codes mean.
std::string findings_text(const View& view, TextStretch word) {
  std::string text;
  std::vector<std::string> codes;
  for (const Look& look : view.looks) {
    for (const TimedReport* from : {&look.check, &look.lint}) {
      if (!from->report) continue;
      for (const v1::Finding& each : from->report->findings) {
        if (each.where.file != view.document.path) continue;
        const auto at = view.now(each.where, from->texts);
        if (!at || at->begin >= word.end || at->end <= word.begin) continue;
        if (std::ranges::count(codes, each.code) > 0) continue;
        codes.push_back(each.code);
        const CodeRow* row = code_named(each.code);
        if (row == nullptr) continue;
        text += fmt::format("\n\n---\n**{}** {}  \n{}", each.code,
                            plain(each.message), plain(row->description));
        if (!row->help.empty()) text += "  \n" + plain(row->help);
      }
    }
  }
  return text;
}

// --- XML -------------------------------------------------------------------

std::optional<Json> hover_attribute(const View& view, const XmlScan& scan,
                                    std::size_t element,
                                    const ScannedAttribute& attribute,
                                    std::size_t at,
                                    const std::vector<NodeHere>& nodes) {
  const std::string_view name = scan.text(attribute.name);
  const std::string_view value = scan.text(attribute.value);
  const bool is_in_value = attribute.has_value && attribute.value.begin <= at &&
                           at <= attribute.value.end;
  if (is_in_value) {
    if (const auto entry = entry_at(value, attribute.value.begin, at)) {
      const std::string text = entry_named(view, entry->name, nodes);
      if (!text.empty()) return markdown(view, text, entry->part);
    }
    const TextStretch word = word_at(view.document.text.text(), at);
    const std::string text = entry_named(
        view, view.document.text.text().substr(word.begin, word.size()), nodes);
    const bool is_script =
        name == "code" || name == "if" || name.starts_with("_");
    if (is_script && !text.empty()) return markdown(view, text, word);
  }
  const auto type = type_named(view, type_of(scan, element));
  const PortWord* port = type ? type->port(name) : nullptr;
  if (port != nullptr) {
    return markdown(view, port_line(*port).substr(2),
                    is_in_value ? attribute.value : attribute.name);
  }
  return std::nullopt;
}

Json hover_xml(const View& view, std::size_t at) {
  const auto scan = view.document.text.parsed<XmlScan>();
  const std::size_t element = scan->tag_at(at);
  if (element == kNone || scan->is_in_comment(at)) return Json::null();
  const ScannedElement& found = (*scan)[element];
  const auto nodes = nodes_at(view, view.document.path, found.name.begin);
  for (const ScannedAttribute& each : found.attributes) {
    if (at < each.name.begin || at > each.whole().end) continue;
    const std::string_view name = scan->text(each.name);
    if (name == "ID" || name == "name") break;
    if (auto json = hover_attribute(view, *scan, element, each, at, nodes)) {
      return *json;
    }
    break;
  }
  std::string text;
  const std::string_view id = type_of(*scan, element);
  const TextStretch word = found.name;
  if (is_subtree(*scan, element)) {
    text = fmt::format("**SubTree** {}", code(id));
  } else if (const auto type = type_named(view, id)) {
    text = type_text_of(*type);
    if (!nodes.empty() && !nodes[0].node().about.empty() &&
        nodes[0].node().about != type->about) {
      text += "  \n" + plain(nodes[0].node().about);
    }
    if (!type->ports.empty()) text += "\n";
    for (const PortWord& port : type->ports) text += "\n" + port_line(port);
  } else if (!nodes.empty()) {
    text = fmt::format("**{}**  \n{}", plain(nodes[0].node().type),
                       plain(nodes[0].node().about));
  }
  for (std::size_t i = 0; i < nodes.size() && i < kMostNodes; ++i) {
    const std::string proven = proven_text(nodes[i]);
    if (proven.empty()) continue;
    text += nodes.size() == 1
                ? fmt::format("\n\n{}", proven)
                : fmt::format("\n\n{}: {}", code(nodes[i].node().name), proven);
  }
  if (nodes.size() > kMostNodes) {
    text += fmt::format("\n\nThe subtree is used {} times.", nodes.size());
  }
  text += findings_text(view, word);
  return text.empty() ? Json::null() : markdown(view, text, word);
}

// --- Rules and .btf --------------------------------------------------------

std::string node_text(const NodeHere& here) {
  const v1::DescribedNode& node = here.node();
  std::string text = fmt::format(
      "**{}** {} · line {}", plain(node.label.empty() ? node.name : node.label),
      plain(node.type), node.where.line);
  if (!node.about.empty()) text += "  \n" + plain(node.about);
  const std::string proven = proven_text(here);
  if (!proven.empty()) text += "\n\n" + proven;
  return text;
}

Json hover_word(const View& view, std::size_t at) {
  const std::string& text = view.document.text.text();
  const TextStretch word =
      view.document.kind == FileKind::Rules
          ? rule_word_at(view.document.text, at).node_or_word()
          : word_at(text, at);
  if (word.size() == 0) return Json::null();
  const std::string name(word.in(text));
  std::string all;
  if (view.document.kind == FileKind::Rules) {
    const std::string about = rule_help(name);
    if (!about.empty()) all = about;
    for (const Look& look : view.looks) {
      if (look.subject.rules != view.document.path || !look.is_checked()) {
        continue;
      }
      for (const v1::Rule& rule : look.check.report->rules) {
        if (rule.name != name) continue;
        all = fmt::format("**{}** {}", plain(name),
                          v1::verdict_word(rule.verdict));
        if (!rule.note.empty()) all += "  \n" + plain(rule.note);
        if (!rule.reason.empty()) all += "  \n" + plain(rule.reason);
      }
    }
  }
  if (all.empty()) {
    // In a tree the node where it stands, in a rule all of that name.
    const auto nodes = view.document.kind == FileKind::Btf
                           ? nodes_at(view, view.document.path, word.begin)
                           : nodes_named(view, name);
    for (std::size_t i = 0; i < nodes.size() && i < kMostNodes; ++i) {
      all += (i > 0 ? "\n\n" : "") + node_text(nodes[i]);
    }
  }
  if (all.empty()) all = entry_named(view, name, {});
  all += findings_text(view, word);
  return all.empty() ? Json::null() : markdown(view, all, word);
}

}  // namespace

Json hover(const View& view, Position place) {
  const std::size_t at = view.lines->offset(place, view.encoding);
  if (view.document.kind == FileKind::Other) return Json::null();
  return view.document.kind == FileKind::Xml ? hover_xml(view, at)
                                             : hover_word(view, at);
}

}  // namespace btcheck::lsp
