// SPDX-License-Identifier: MIT
//
// What can go on here. The text is half written as a rule: what is before the
// cursor counts.
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "lsp/features.hpp"
#include "lsp/names.hpp"
#include "lsp/texts/rule_words.hpp"
#include "lsp/words.hpp"
#include "model/btf/forms.hpp"
#include "model/tree/node_types.hpp"
#include "text/utf8.hpp"

namespace btcheck::lsp {
namespace {

// CompletionItemKind of the protocol.
namespace items_of {
constexpr int kFunction = 3;
constexpr int kVariable = 6;
constexpr int kClass = 7;
constexpr int kModule = 9;
constexpr int kProperty = 10;
constexpr int kValue = 12;
constexpr int kKeyword = 14;
constexpr int kFile = 17;
constexpr int kEvent = 23;
}  // namespace items_of

class Items {
 public:
  Items(const View& view, TextStretch replaced, bool takes_snippets)
      : range_(view.range(replaced)), takes_snippets_(takes_snippets) {}

  bool takes_snippets() const { return takes_snippets_; }

  void add(std::string_view label, int kind, std::string_view detail,
           std::string_view about = {}, std::string_view text = {},
           bool is_snippet = false) {
    if (label.empty() || !labels_.insert(std::string(label)).second) return;
    Json item{{"label", label},
              {"kind", kind},
              {"textEdit", text_edit(range_, text.empty() ? label : text)}};
    if (!detail.empty()) item.add("detail", detail);
    if (!about.empty()) item.add("documentation", about);
    if (is_snippet) item.add("insertTextFormat", 2);
    all_.push(item);
  }

  Json list() const { return {{"isIncomplete", false}, {"items", all_}}; }

 private:
  const Range range_;
  const bool takes_snippets_;
  std::set<std::string> labels_;
  Json all_ = Json::array();
};

// --- XML -------------------------------------------------------------------

// In a snippet these mean something.
std::string escaped(std::string_view text) {
  std::string all;
  for (const char c : text) {
    if (c == '$' || c == '}' || c == '\\') all += '\\';
    all += c;
  }
  return all;
}

// The tag with what it needs, and places to fill in.
std::string tag_snippet(const TypeWord& type) {
  std::string text = type.id;
  int place = 0;
  for (const PortWord& port : type.ports) {
    if (!port.is_needed || !port.is_there) continue;
    text += fmt::format(" {}=\"${{{}:{}}}\"", port.name, ++place,
                        escaped(port.preset));
  }
  const bool has_children = type.kind == "Control" || type.kind == "Decorator";
  return has_children ? fmt::format("{0}>\n\t$0\n</{1}>", text, type.id)
                      : text + "/>";
}

void add_tree_ids(const View& view, Items& items, bool as_subtree) {
  for (const ScannedFile& file : tree_files(view)) {
    for (std::size_t i = 0; i < file.scan->elements().size(); ++i) {
      if (file.scan->name(i) != "BehaviorTree") continue;
      const std::string id(file.scan->value(i, "ID"));
      const std::string where =
          file.path.substr(file.path.find_last_of('/') + 1);
      if (as_subtree) {
        items.add("SubTree " + id, items_of::kModule, where, {},
                  fmt::format("SubTree ID=\"{}\"/>", id));
      } else {
        items.add(id, items_of::kModule, where);
      }
    }
  }
}

void add_tags(const View& view, const XmlScan& scan, std::size_t at,
              std::size_t begin, Items& items) {
  // What is around the tag that is being written.
  std::size_t around = scan.around(at);
  while (around != kNone && scan[around].start_tag.begin >= begin) {
    around = scan[around].parent;
  }
  if (around == kNone) {
    items.add("root", items_of::kClass, {}, {},
              "root BTCPP_format=\"4\">\n\t\n</root>");
    return;
  }
  const std::string_view tag = scan.name(around);
  if (tag == "root") {
    for (const char* each : {"BehaviorTree", "TreeNodesModel", "include"}) {
      items.add(each, items_of::kClass, {});
    }
    return;
  }
  if (tag == "TreeNodesModel") {
    for (const std::string_view each : kBtcppKindNames) {
      items.add(each, items_of::kClass, {});
    }
    return;
  }
  if (scan.tree_of(around) == kNone) {
    for (const char* each : {"input_port", "output_port", "inout_port"}) {
      items.add(each, items_of::kProperty, {});
    }
    return;
  }
  for (const TypeWord& type : all_types(view)) {
    const bool is_leaf = type.kind == "Action" || type.kind == "Condition";
    const std::string snippet = tag_snippet(type);
    items.add(type.id, is_leaf ? items_of::kFunction : items_of::kClass,
              type.kind, type.about,
              items.takes_snippets() ? snippet : std::string_view(type.id),
              items.takes_snippets());
  }
  add_tree_ids(view, items, true);
}

void add_closing(const XmlScan& scan, std::size_t at, Items& items) {
  for (std::size_t i = scan.around(at); i != kNone; i = scan[i].parent) {
    if (scan[i].end_tag.size() > 0 && scan[i].end_tag.end <= at) continue;
    items.add("/" + std::string(scan.name(i)), items_of::kClass, "close", {},
              fmt::format("/{}>", scan.name(i)));
    return;
  }
}

void add_attributes(const View& view, const XmlScan& scan, std::size_t element,
                    Items& items) {
  const std::string_view tag = scan.name(element);
  std::set<std::string_view> written;
  for (const ScannedAttribute& each : scan[element].attributes) {
    if (each.has_value) written.insert(scan.text(each.name));
  }
  const auto add = [&](std::string_view name, std::string_view detail,
                       std::string_view about = {}) {
    if (written.contains(name)) return;
    items.add(name, items_of::kProperty, detail, about,
              items.takes_snippets() ? fmt::format("{}=\"$1\"", name)
                                     : fmt::format("{}=\"\"", name),
              items.takes_snippets());
  };
  const std::string_view id = type_of(scan, element);
  if (scan.tree_of(element) == element || kind_named(tag)) add("ID", {});
  if (is_subtree(scan, element)) {
    // What the tree reads and writes: its entries by the names in its text.
    for (const ScannedFile& file : tree_files(view)) {
      for (std::size_t i = 0; i < file.scan->elements().size(); ++i) {
        const std::size_t tree = file.scan->tree_of(i);
        if (tree == kNone || file.scan->value(tree, "ID") != id) continue;
        for (const ScannedAttribute& each : (*file.scan)[i].attributes) {
          const std::string_view value = file.scan->text(each.value);
          if (value.starts_with('{') && value.ends_with('}') &&
              !value.starts_with("{@") && value != "{=}") {
            add(value.substr(1, value.size() - 2), "entry of the subtree");
          }
        }
      }
    }
    add("_autoremap", "bool", "all entries of one name are the same");
  } else if (const auto type = type_named(view, id)) {
    for (const PortWord& port : type->ports) {
      if (!port.is_there) continue;
      add(port.name,
          port.type.empty() ? port.direction
                            : fmt::format("{} {}", port.direction, port.type),
          port.about);
    }
  }
  if (id.empty()) return;
  add("name", "of this node");
  if (is_release_3(profile_of(view))) return;
  for (const std::string_view each : kBtcppConditionNames) add(each, "script");
}

void add_entries(const View& view, const XmlScan& scan, Items& items,
                 bool in_braces) {
  std::set<std::string> names;
  if (const Look* look = described_look(view)) {
    for (const v1::Entry& each : look->description->entries) {
      names.insert(each.name);
    }
  }
  for (const ScannedElement& element : scan.elements()) {
    for (const ScannedAttribute& each : element.attributes) {
      const std::string_view value = scan.text(each.value);
      if (value.size() > 2 && value.starts_with('{') && value.ends_with('}')) {
        names.insert(std::string(value.substr(1, value.size() - 2)));
      }
    }
  }
  for (const std::string& name : names) {
    if (!std::ranges::all_of(name, [](char c) {
          return is_word_letter(c) || c == '@' || c == '.' || c == '/';
        })) {
      continue;
    }
    items.add(in_braces ? "{" + name + "}" : name, items_of::kVariable,
              "entry");
  }
}

Json complete_value(const View& view, const XmlScan& scan, std::size_t element,
                    const ScannedAttribute& attribute, std::size_t at,
                    bool takes_snippets) {
  const std::string_view name = scan.text(attribute.name);
  const std::string_view tag = scan.name(element);
  const TextStretch before{attribute.value.begin, at};
  const std::string_view written = scan.text(before);
  const bool is_tree_id = name == "main_tree_to_execute" ||
                          (name == "ID" && is_subtree(scan, element));
  const bool is_script =
      name == "code" || name == "if" || name.starts_with('_');
  const std::size_t open = written.rfind('{');
  const bool is_in_braces =
      open != written.npos && written.find('}', open) == written.npos;
  TextStretch replaced = before;
  if (is_script && !is_in_braces) {
    replaced.begin =
        word_at(scan.text(before), written.size()).begin + before.begin;
  } else if (is_in_braces) {
    replaced.begin = before.begin + open;
    if (view.document.text.text().substr(at).starts_with('}')) {
      replaced.end = at + 1;
    }
  }
  Items items(view, replaced, takes_snippets);
  if (is_tree_id) {
    add_tree_ids(view, items, false);
    return items.list();
  }
  if (name == "ID" && kind_named(tag)) {
    for (const TypeWord& type : all_types(view)) {
      if (type.kind == tag) items.add(type.id, items_of::kFunction, type.kind);
    }
    return items.list();
  }
  if (tag == "include" && name == "path") {
    for (const ScannedFile& file : tree_files(view)) {
      if (file.path == view.document.path) continue;
      const std::string folder = view.document.path.substr(
          0, view.document.path.find_last_of('/') + 1);
      if (file.path.starts_with(folder)) {
        items.add(file.path.substr(folder.size()), items_of::kFile, {});
      }
    }
    return items.list();
  }
  if (is_script && !is_in_braces) {
    add_entries(view, scan, items, false);
    return items.list();
  }
  const auto type = type_named(view, type_of(scan, element));
  const PortWord* port = type ? type->port(name) : nullptr;
  if (port != nullptr && !is_in_braces) {
    if (port->type == "bool") {
      items.add("true", items_of::kValue, {});
      items.add("false", items_of::kValue, {});
    }
    if (port->type.find("tatus") != std::string::npos) {
      for (const char* each : {"SUCCESS", "FAILURE", "RUNNING", "SKIPPED"}) {
        items.add(each, items_of::kValue, {});
      }
    }
    if (!port->preset.empty()) {
      items.add(port->preset, items_of::kValue, "the default");
    }
  }
  if (name != "name" && name != "ID") add_entries(view, scan, items, true);
  return items.list();
}

Json complete_xml(const View& view, std::size_t at, bool takes_snippets) {
  const auto scan = view.document.text.parsed<XmlScan>();
  const std::string_view text = view.document.text.text();
  const Items none(view, {at, at}, takes_snippets);
  if (scan->is_in_comment(at)) return none.list();
  std::size_t element = kNone;
  for (std::size_t i = 0; i < scan->elements().size(); ++i) {
    const TextStretch tag = (*scan)[i].start_tag;
    const bool is_open_end = at == tag.end && !(*scan)[i].is_closed;
    if (tag.begin < at && (at < tag.end || is_open_end)) element = i;
  }
  if (element == kNone) {
    const std::size_t open = text.substr(0, at).rfind('<');
    const bool is_tag = open != text.npos &&
                        text.substr(open, at - open).find('>') == text.npos;
    Items items(view, {is_tag ? open + 1 : at, at}, takes_snippets);
    if (is_tag && text.substr(open).starts_with("</")) {
      add_closing(*scan, open, items);
    } else if (is_tag) {
      add_tags(view, *scan, at, open, items);
    }
    return items.list();
  }
  const ScannedElement& found = (*scan)[element];
  if (at <= found.name.end) {
    Items items(view, {found.name.begin, at}, takes_snippets);
    add_tags(view, *scan, at, found.start_tag.begin, items);
    if (found.name.size() == 0) {
      add_closing(*scan, found.start_tag.begin, items);
    }
    return items.list();
  }
  for (const ScannedAttribute& each : found.attributes) {
    if (each.has_value && each.value.begin <= at && at <= each.value.end) {
      return complete_value(view, *scan, element, each, at, takes_snippets);
    }
  }
  const TextStretch word = word_at(text, at);
  Items items(view, {word.begin, at}, takes_snippets);
  add_attributes(view, *scan, element, items);
  return items.list();
}

// --- Rules -----------------------------------------------------------------

Json complete_rules(const View& view, std::size_t at, bool takes_snippets) {
  const std::string_view text = view.document.text.text();
  const std::size_t begin = word_at(text, at).begin;
  const std::size_t line =
      begin == 0 ? 0 : text.rfind('\n', begin - 1) + 1;  // npos + 1 is 0
  const std::string_view before = text.substr(line, begin - line);
  Items items(view, {begin, at}, takes_snippets);
  const std::size_t mark = before.find_first_not_of(" \t");
  if (mark != before.npos &&
      std::string_view("#;").find(before[mark]) != std::string_view::npos) {
    return items.list();
  }
  const auto add_words = [&](RuleWordKind which, int as) {
    for (const RuleHelp& each : rule_words()) {
      if (each.kind == which) items.add(each.word, as, {}, each.about);
    }
  };
  if (before.ends_with('.')) {
    add_words(RuleWordKind::Event, items_of::kEvent);
    return items.list();
  }
  const std::size_t quote = before.rfind('"');
  const bool is_tree = mark != before.npos &&
                       before.substr(mark).starts_with("tree") &&
                       quote != before.npos;
  if (is_tree) {
    const std::string folder =
        view.document.path.substr(0, view.document.path.find_last_of('/') + 1);
    Items files(view, {line + quote + 1, at}, takes_snippets);
    for (const auto& [path, known] : *view.texts) {
      const FileKind of = kind_of(path, {});
      if ((of == FileKind::Xml || of == FileKind::Btf) &&
          path.starts_with(folder)) {
        files.add(path.substr(folder.size()), items_of::kFile, {});
      }
    }
    return files.list();
  }
  if (mark == before.npos) add_words(RuleWordKind::Item, items_of::kKeyword);
  add_words(RuleWordKind::Body, items_of::kKeyword);
  add_words(RuleWordKind::Join, items_of::kKeyword);
  add_words(RuleWordKind::Other, items_of::kKeyword);
  if (const Look* look = described_look(view)) {
    for (const v1::DescribedNode& each : look->description->nodes) {
      const bool is_plain = std::ranges::all_of(each.label, is_word_letter);
      items.add(each.label, items_of::kFunction, each.type, each.about,
                is_plain ? std::string() : fmt::format("\"{}\"", each.label));
    }
    for (const v1::Entry& each : look->description->entries) {
      items.add(each.name, items_of::kVariable, "entry");
    }
  }
  for (const NamedLet& each : lets_of(view.document.text)) {
    items.add(each.name, items_of::kVariable, "let");
  }
  for (const char* each : {"success", "failure", "running", "skipped"}) {
    items.add(each, items_of::kValue, {});
  }
  return items.list();
}

// --- .btf and contracts ----------------------------------------------------

// Those that the file defines: (defun charge (level) ...).
void add_functions(const View& view, Items& items) {
  const auto parsed = view.document.text.parsed<btf::ParsedForms>();
  const btf::Forms& forms = parsed->forms;
  for (const btf::FormId id : forms.top_level) {
    const btf::Form* head = forms.head(id);
    if (head == nullptr || forms[id].items.size() < 2 ||
        !equal_ignoring_case(head->text, "defun")) {
      continue;
    }
    items.add(forms[forms[id].items[1]].text, items_of::kFunction, "defun");
  }
}

Json complete_forms(const View& view, std::size_t at, bool takes_snippets) {
  const std::string_view text = view.document.text.text();
  std::size_t begin = at;
  while (begin > 0 &&
         (is_word_letter(text[begin - 1]) || text[begin - 1] == '-')) {
    --begin;
  }
  const std::size_t line = begin == 0 ? 0 : text.rfind('\n', begin - 1) + 1;
  Items items(view, {begin, at}, takes_snippets);
  if (text.substr(line, begin - line).find(';') != std::string_view::npos) {
    return items.list();
  }
  const char mark = begin == 0 ? ' ' : text[begin - 1];
  const bool is_tree = view.document.kind == FileKind::Btf;
  if (mark == '(') {
    if (!is_tree) {
      for (const char* each :
           {"defaction", "defcondition", "defsv", "defenum"}) {
        items.add(each, items_of::kKeyword, {});
      }
      return items.list();
    }
    for (const std::string& each : btf::definition_words()) {
      items.add(each, items_of::kKeyword, {});
    }
    add_functions(view, items);
    for (const NodeTypeInfo& info : kNodeTypes) {
      if (has(info.in, In::Btf)) {
        items.add(info.name, items_of::kClass, {}, info.about);
      }
    }
  } else if (mark == ':') {
    const auto add = [&](std::span<const btf::KeywordRule> rules) {
      for (const btf::KeywordRule& each : rules) {
        items.add(each.name, items_of::kProperty, {});
      }
    };
    if (is_tree) add(btf::node_keywords());
    add(btf::contract_keywords());
    add(btf::variable_keywords());
  } else if (const Look* look = described_look(view)) {
    for (const v1::Entry& each : look->description->entries) {
      items.add(each.name, items_of::kVariable, {});
    }
    for (const v1::DescribedNode& each : look->description->nodes) {
      items.add(each.label, items_of::kFunction, each.type);
    }
  }
  return items.list();
}

}  // namespace

Json completions(const View& view, Position place, bool takes_snippets) {
  const std::size_t at = view.lines->offset(place, view.encoding);
  switch (view.document.kind) {
    case FileKind::Xml:
      return complete_xml(view, at, takes_snippets);
    case FileKind::Rules:
      return complete_rules(view, at, takes_snippets);
    case FileKind::Btf:
    case FileKind::Leaves:
      return complete_forms(view, at, takes_snippets);
    case FileKind::Other:
      break;
  }
  return Items(view, {at, at}, takes_snippets).list();
}

}  // namespace btcheck::lsp
