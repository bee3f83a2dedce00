// SPDX-License-Identifier: MIT
//
// What a document is made of: symbols, what can be folded, and stretches that
// grow around a place.
#include <algorithm>
#include <functional>

#include "lsp/features.hpp"
#include "lsp/words.hpp"
#include "ltl/rules/parser.hpp"
#include "model/btf/forms.hpp"

namespace btcheck::lsp {
namespace {

// SymbolKind of the protocol.
namespace symbols_of {
constexpr int kModule = 2;
constexpr int kClass = 5;
constexpr int kMethod = 6;
constexpr int kFunction = 12;
constexpr int kVariable = 13;
constexpr int kConstant = 14;
constexpr int kKey = 20;
constexpr int kEvent = 24;
}  // namespace symbols_of

Json symbol(const View& view, std::string_view name, std::string_view detail,
            int of, TextStretch whole, TextStretch word) {
  return {{"name", name.empty() ? std::string_view("?") : name},
          {"detail", detail},
          {"kind", of},
          {"range", json_of(view.range(whole))},
          {"selectionRange", json_of(view.range(word))}};
}

// --- XML -------------------------------------------------------------------

Json xml_symbol(const View& view, const XmlScan& scan, std::size_t i) {
  const ScannedElement& element = scan[i];
  const std::string_view tag = scan.name(i);
  const std::string_view id = scan.value(i, "ID");
  const std::string_view name = scan.value(i, "name");
  const bool is_tree = tag == "BehaviorTree";
  std::string_view shown = !name.empty() ? name : !id.empty() ? id : tag;
  const int of = is_tree                    ? symbols_of::kClass
                 : is_subtree(scan, i)      ? symbols_of::kModule
                 : element.children.empty() ? symbols_of::kFunction
                                            : symbols_of::kMethod;
  std::string detail(tag);
  if (!id.empty() && id != shown) detail += ' ' + std::string(id);
  if (shown == tag) detail.clear();
  Json json = symbol(view, shown, detail, of, element.whole(), element.name);
  Json children = Json::array();
  for (const std::size_t child : element.children) {
    children.push(xml_symbol(view, scan, child));
  }
  if (!children.is_empty()) json.add("children", children);
  return json;
}

// A document is no deeper than this for those who draw it.
constexpr std::size_t kMostDepth = 400;

bool is_too_deep(const XmlScan& scan) {
  std::vector<std::size_t> depth(scan.elements().size(), 0);
  for (std::size_t i = 0; i < depth.size(); ++i) {
    if (scan[i].parent != kNone) depth[i] = depth[scan[i].parent] + 1;
    if (depth[i] > kMostDepth) return true;
  }
  return false;
}

Json xml_symbols(const View& view) {
  const auto scan = view.document.text.parsed<XmlScan>();
  Json all = Json::array();
  if (scan->elements().empty() || is_too_deep(*scan)) return all;
  const bool has_root = scan->name(0) == "root";
  for (std::size_t i = 0; i < scan->elements().size(); ++i) {
    const std::size_t parent = (*scan)[i].parent;
    if (parent == kNone ? !has_root || i > 0 : has_root && parent == 0) {
      all.push(xml_symbol(view, *scan, i));
    }
  }
  return all;
}

// --- .btf and contracts ----------------------------------------------------

struct FormsOf {
  explicit FormsOf(const FileText& text)
      : parsed(text.parsed<btf::ParsedForms>()), lines(text.parsed<Lines>()) {}

  const btf::Forms& forms() const { return parsed->forms; }
  TextStretch stretch(const SourceSpan& span) const {
    return lines->stretch(span);
  }
  TextStretch of(const btf::Token& token) const { return stretch(token.span); }
  TextStretch whole(const btf::Form& form) const {
    const auto& tokens = forms().tokens;
    if (form.end_token <= form.first_token || tokens.empty()) {
      return stretch(form.span);
    }
    const std::size_t last =
        std::min<std::size_t>(form.end_token, tokens.size()) - 1;
    return {of(tokens[form.first_token]).begin, of(tokens[last]).end};
  }

  std::shared_ptr<const btf::ParsedForms> parsed;
  std::shared_ptr<const Lines> lines;
};

// The word behind `:name`, `:ID`, or the first one behind the head.
std::string_view name_of(const btf::Forms& forms, const btf::Form& form) {
  std::string_view found;
  for (std::size_t i = 1; i + 1 < form.items.size(); ++i) {
    const btf::Form& key = forms[form.items[i]];
    const btf::Form& value = forms[form.items[i + 1]];
    if (value.is_list()) continue;
    if (btf::is_keyword(key, "name")) return value.text;
    if (btf::is_keyword(key, "ID")) found = value.text;
  }
  if (!found.empty() || form.items.size() < 2) return found;
  const btf::Form& second = forms[form.items[1]];
  return second.is_word() || second.kind == btf::FormKind::Quoted
             ? second.text
             : std::string_view();
}

std::optional<Json> form_symbol(const View& view, const FormsOf& of,
                                btf::FormId id) {
  const btf::Form& form = of.forms()[id];
  const btf::Form* head = form.is_list() ? of.forms().head(id) : nullptr;
  if (head == nullptr) return std::nullopt;
  const std::string_view word = head->text;
  std::string_view name = name_of(of.forms(), form);
  const bool is_definition = btf::name_key(word).starts_with("def");
  const int kind = word == "BehaviorTree" ? symbols_of::kClass
                   : word == "defsv"      ? symbols_of::kVariable
                   : is_definition        ? symbols_of::kFunction
                                          : symbols_of::kMethod;
  Json json = symbol(view, name.empty() ? word : name,
                     name.empty() ? std::string_view() : word, kind,
                     of.whole(form), of.stretch(head->span));
  Json children = Json::array();
  if (!is_definition) {
    for (const btf::FormId item : form.items) {
      if (auto child = form_symbol(view, of, item)) children.push(*child);
    }
  }
  if (!children.is_empty()) json.add("children", children);
  return json;
}

Json form_symbols(const View& view) {
  const FormsOf of(view.document.text);
  Json all = Json::array();
  for (const btf::FormId id : of.forms().top_level) {
    if (auto json = form_symbol(view, of, id)) all.push(*json);
  }
  return all;
}

// --- Rules -----------------------------------------------------------------

// An item of a file of rules: from its word to the next.
struct RuleItem {
  std::string_view word;  // property, let, …
  std::string_view name;
  TextStretch whole;
  TextStretch name_part;
};

std::vector<RuleItem> rule_items(const FileText& text) {
  const SourceText source("", text.text());
  const TokenList list = tokenize(source);
  std::vector<RuleItem> items;
  constexpr std::array<std::string_view, 8> kWords = {
      "property", "prove", "assert", "let", "expect", "tree", "assume", "tick"};
  for (std::size_t i = 0; i + 1 < list.tokens.size(); ++i) {
    const Token& token = list.tokens[i];
    if (!items.empty()) items.back().whole.end = token.end;
    if (!token.is_first_on_line || token.kind != TokenKind::Identifier)
      continue;
    const auto word = std::ranges::find_if(kWords, [&](std::string_view each) {
      return equal_ignoring_case(each, token.text);
    });
    if (word == kWords.end()) continue;
    if (!items.empty() && i > 0)
      items.back().whole.end = list.tokens[i - 1].end;
    RuleItem item{
        *word, {}, {token.begin, token.end}, {token.begin, token.end}};
    const Token& next = list.tokens[i + 1];
    if (next.is_name()) {
      item.name = next.text;
      item.name_part = {next.begin, next.end};
    }
    items.push_back(item);
  }
  return items;
}

Json rule_symbols(const View& view) {
  Json all = Json::array();
  for (const RuleItem& item : rule_items(view.document.text)) {
    const int kind = item.word == "let"    ? symbols_of::kConstant
                     : item.word == "tree" ? symbols_of::kKey
                                           : symbols_of::kEvent;
    all.push(symbol(view, item.name.empty() ? item.word : item.name, item.word,
                    kind, item.whole, item.name_part));
  }
  return all;
}

// --- Stretches -------------------------------------------------------------

void add_folding(const View& view, TextStretch part, std::string_view kind,
                 Json& all, bool keeps_last = false) {
  Range range = view.range(part);
  if (keeps_last && range.end.line > 0) --range.end.line;
  if (range.begin.line >= range.end.line) return;
  Json json{{"startLine", range.begin.line}, {"endLine", range.end.line}};
  if (!kind.empty()) json.add("kind", kind);
  all.push(json);
}

// Comments that follow line by line, `;` or `#`.
void add_comment_lines(const View& view, std::string_view marks, Json& all) {
  std::size_t first = kNone;
  for (std::size_t i = 0; i <= view.lines->count(); ++i) {
    const std::string_view line =
        i < view.lines->count() ? view.lines->line(i) : std::string_view();
    const std::size_t at = line.find_first_not_of(" \t");
    const bool is_comment =
        at != line.npos && marks.find(line[at]) != marks.npos;
    if (is_comment && first == kNone) first = i;
    if (is_comment || first == kNone) continue;
    if (i - first > 1) {
      all.push(
          Json{{"startLine", first}, {"endLine", i - 1}, {"kind", "comment"}});
    }
    first = kNone;
  }
}

std::vector<TextStretch> stretches_around(const View& view, std::size_t at) {
  std::vector<TextStretch> all;
  const auto add = [&](TextStretch part) {
    if (part.begin <= at && at <= part.end && part.size() > 0) {
      all.push_back(part);
    }
  };
  const std::string& text = view.document.text.text();
  add({0, text.size()});
  if (view.document.kind == FileKind::Xml) {
    const auto scan = view.document.text.parsed<XmlScan>();
    for (const ScannedElement& element : scan->elements()) {
      add(element.whole());
      if (element.end_tag.size() > 0) {
        add({element.start_tag.end, element.end_tag.begin});
      }
      if (at < element.start_tag.end) add(element.start_tag);
      add(element.name);
      for (const ScannedAttribute& each : element.attributes) {
        add({each.name.begin, std::min(text.size(), each.whole().end)});
        add(each.name);
        add(each.value);
      }
    }
  } else if (view.document.kind == FileKind::Rules) {
    for (const RuleItem& item : rule_items(view.document.text)) add(item.whole);
  } else {
    const FormsOf of(view.document.text);
    for (const btf::Form& form : of.forms().all) add(of.whole(form));
  }
  add(word_at(text, at));
  std::ranges::stable_sort(all, std::greater(), &TextStretch::size);
  return all;
}

}  // namespace

Json symbols(const View& view) {
  if (view.document.kind == FileKind::Xml) return xml_symbols(view);
  if (view.document.kind == FileKind::Rules) return rule_symbols(view);
  return view.document.kind == FileKind::Other ? Json::array()
                                               : form_symbols(view);
}

Json foldings(const View& view) {
  Json all = Json::array();
  if (view.document.kind == FileKind::Xml) {
    const auto scan = view.document.text.parsed<XmlScan>();
    for (const ScannedElement& element : scan->elements()) {
      // The end tag stays.
      const bool has_end = element.end_tag.size() > 0;
      add_folding(view,
                  {element.start_tag.begin,
                   has_end ? element.end_tag.begin : element.end},
                  {}, all, has_end);
    }
    for (const TextStretch& comment : scan->comments()) {
      add_folding(view, comment, "comment", all);
    }
  } else if (view.document.kind == FileKind::Rules) {
    for (const RuleItem& item : rule_items(view.document.text)) {
      add_folding(view, item.whole, {}, all);
    }
    add_comment_lines(view, "#;", all);
  } else if (view.document.kind != FileKind::Other) {
    const FormsOf of(view.document.text);
    for (const btf::Form& form : of.forms().all) {
      if (form.is_list()) add_folding(view, of.whole(form), {}, all);
    }
    add_comment_lines(view, ";#", all);
  }
  return all;
}

Json selections(const View& view, const std::vector<Position>& places) {
  Json all = Json::array();
  for (const Position place : places) {
    const std::size_t at = view.lines->offset(place, view.encoding);
    std::optional<Json> nested;
    for (const TextStretch& part : stretches_around(view, at)) {
      Json json{{"range", json_of(view.range(part))}};
      if (nested) json.add("parent", *nested);
      nested = json;
    }
    if (!nested) nested = Json{{"range", json_of(Range{place, place})}};
    all.push(*nested);
  }
  return all;
}

}  // namespace btcheck::lsp
