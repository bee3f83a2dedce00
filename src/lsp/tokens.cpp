// SPDX-License-Identifier: MIT
//
// What words are, for editors that colour them by it.
#include <algorithm>
#include <array>

#include "lsp/features.hpp"
#include "lsp/texts/rule_words.hpp"
#include "lsp/words.hpp"
#include "ltl/rules/parser.hpp"
#include "model/btf/forms.hpp"

namespace btcheck::lsp {
namespace {

// In the order of the legend.
enum class Colour : unsigned char {
  Namespace,  // subtrees
  Class,      // controls and decorators
  Function,   // leaves
  Property,   // ports
  Variable,   // entries
  Keyword,
  Event,
  Number,
  Operator,
  Comment
};
constexpr std::array<std::string_view, 10> kColours = {
    "namespace", "class", "function", "property", "variable",
    "keyword",   "event", "number",   "operator", "comment"};

struct Coloured {
  TextStretch part;
  Colour colour;
};

void add_xml(const View& view, std::vector<Coloured>& all) {
  const auto scan = view.document.text.parsed<XmlScan>();
  for (std::size_t i = 0; i < scan->elements().size(); ++i) {
    if (scan->tree_of(i) == kNone || scan->tree_of(i) == i) continue;
    const ScannedElement& element = (*scan)[i];
    const Colour colour = is_subtree(*scan, i)       ? Colour::Namespace
                          : element.children.empty() ? Colour::Function
                                                     : Colour::Class;
    all.push_back({element.name, colour});
    if (element.end_name.size() > 0) all.push_back({element.end_name, colour});
    for (const ScannedAttribute& each : element.attributes) {
      all.push_back({each.name, Colour::Property});
      const std::string_view value = scan->text(each.value);
      for (std::size_t at = value.find('{'); at != value.npos;
           at = value.find('{', at + 1)) {
        const std::size_t end = value.find('}', at);
        if (end == value.npos) break;
        all.push_back({{each.value.begin + at, each.value.begin + end + 1},
                       Colour::Variable});
      }
    }
  }
}

void add_rules(const View& view, std::vector<Coloured>& all) {
  const SourceText source("", view.document.text.text());
  const TokenList list = tokenize(source);
  for (std::size_t i = 0; i + 1 < list.tokens.size(); ++i) {
    const Token& token = list.tokens[i];
    const TextStretch part{token.begin, token.end};
    const bool is_event = i > 0 && list.tokens[i - 1].kind == TokenKind::Dot;
    if (is_event && token.is_name()) {
      all.push_back({part, Colour::Event});
    } else if (token.kind == TokenKind::Identifier) {
      all.push_back({part, rule_help(token.text).empty() ? Colour::Variable
                                                         : Colour::Keyword});
    } else if (token.kind == TokenKind::Quoted) {
      all.push_back({part, Colour::Variable});
    } else if (token.kind == TokenKind::Number) {
      all.push_back({part, Colour::Number});
    } else if (token.kind == TokenKind::Operator ||
               token.kind == TokenKind::Relation) {
      all.push_back({part, Colour::Operator});
    }
  }
}

void add_forms(const View& view, std::vector<Coloured>& all) {
  const auto parsed = view.document.text.parsed<btf::ParsedForms>();
  bool is_head = false;
  for (const btf::Token& token : parsed->forms.tokens) {
    const TextStretch part = view.lines->stretch(token.span);
    if (token.kind == btf::FormKind::Keyword) {
      all.push_back({part, Colour::Property});
    } else if (token.kind == btf::FormKind::Word) {
      all.push_back({part, is_head                          ? Colour::Keyword
                           : btf::looks_numeric(token.text) ? Colour::Number
                           : token.text.starts_with('$')    ? Colour::Variable
                                                         : Colour::Function});
    }
    is_head = token.kind == btf::FormKind::List;
  }
}

}  // namespace

Json token_legend() {
  return {{"tokenTypes", Json::array(kColours)},
          {"tokenModifiers", Json::array()}};
}

Json tokens(const View& view) {
  std::vector<Coloured> all;
  if (view.document.kind == FileKind::Xml) {
    add_xml(view, all);
  } else if (view.document.kind == FileKind::Rules) {
    add_rules(view, all);
  } else if (view.document.kind != FileKind::Other) {
    add_forms(view, all);
  }
  std::ranges::stable_sort(
      all, {}, [](const Coloured& each) { return each.part.begin; });
  Json data = Json::array();
  Position last;
  std::size_t before = 0;  // where the one before begins, in its line
  for (const Coloured& each : all) {
    const Range range = view.range(each.part);
    // Of one line each, none within another.
    if (range.begin.line != range.end.line ||
        range.begin.character == range.end.character) {
      continue;
    }
    const bool is_behind = range.begin.line > last.line ||
                           (range.begin.line == last.line &&
                            range.begin.character >= last.character);
    if (!is_behind) continue;
    const std::size_t lines = range.begin.line - last.line;
    if (lines > 0) before = 0;
    data.push(lines)
        .push(range.begin.character - before)
        .push(range.end.character - range.begin.character)
        .push(static_cast<int>(each.colour))
        .push(0);
    before = range.begin.character;
    last = range.end;
  }
  return data;
}

}  // namespace btcheck::lsp
