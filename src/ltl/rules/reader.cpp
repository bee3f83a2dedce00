// SPDX-License-Identifier: MIT
//
// The items of a property file (property, prove, let, …), names and titles. An
// item with an error is dropped, and reading goes on at the next word of an
// item that begins a line.
#include <fmt/format.h>

#include <algorithm>

#include "ltl/rules/parser.hpp"
#include "text/budget.hpp"

namespace btcheck {
namespace {

constexpr std::size_t kMaxFileSize = std::size_t{4} << 20;

struct NameInUse {
  int line = 0;  // of the first property of that name
  int uses = 1;
};

class FileReader {
 public:
  explicit FileReader(PropertyParser& in) : in_(in) {}

  void read() {
    while (!in_.at_end() && !in_.is_full()) {
      if (read_item()) continue;
      expectation_ = Expectation::None;
      expect_span_.reset();
      in_.skip_to_item();
    }
    if (expect_span_) {
      in_.error("BT1217", *expect_span_, "this `expect` belongs to no property",
                {}, "write it before a property");
    }
    check_assertions();
    warn_of_conditions_alone();
    if (names_.empty() && !in_.has_errors()) {
      in_.error("BT1220", {0, 0, 1}, "no property in this file", {},
                "write one: `property NAME: never some_node.failure`");
    }
  }

 private:
  bool read_item() {
    if (in_.accept_word("tree")) return read_tree();
    if (in_.accept_word("tick")) return read_tick();
    if (in_.accept_word("let")) return read_let();
    if (in_.accept_word("assert")) return read_assert();
    if (in_.accept_word("assume")) return read_assume();
    if (in_.at_word("expect")) return read_expect();
    if (in_.at_word("property")) return read_property();
    if (in_.at_word("prove")) return read_prove();
    return refuse_item();
  }

  bool read_tree() {
    const Token& name = in_.peek();
    if (name.kind != TokenKind::Quoted) {
      return in_.unexpected("`tree` takes the name of a file in quotes",
                            "expected a quoted name",
                            "write `tree \"drone.btf\"`");
    }
    if (!in_.file().tree.empty()) {
      return in_.error(
          "BT1218", name.span, "a second tree", {},
          fmt::format("this file is about `{}` already", in_.file().tree));
    }
    in_.file().tree = in_.take().text;
    return true;
  }

  bool read_tick() {
    static const std::vector<std::string> words = {"root", "leaves", "nodes",
                                                   "none"};
    const Token& word = in_.peek();
    const auto found = std::ranges::find_if(
        words, [&](const std::string& known) { return in_.at_word(known); });
    if (found == words.end()) {
      if (word.kind == TokenKind::Unknown) return false;
      return in_.error(
          "BT1218", word.span, "`tick` says which nodes take a tick of time",
          "expected root, leaves, nodes or none",
          did_you_mean(word.text, words, "write `tick root`, the default"));
    }
    if (in_.file().ticks) {
      return in_.error(
          "BT1218", word.span, "a second `tick`", {},
          fmt::format("this file says `tick {}` already", *in_.file().ticks));
    }
    in_.file().ticks = *found;
    in_.take();
    return true;
  }

  std::optional<Token> read_name(std::string_view what) {
    const Token& name = in_.peek();
    if (!in_.at_name() && name.kind != TokenKind::Number) {
      return in_.unexpected(fmt::format("{} needs a name", what),
                            "expected a name");
    }
    if (name.kind == TokenKind::Identifier && is_reserved(name.text)) {
      return in_.error(
          "BT1221", name.span, fmt::format("`{}` is a keyword", name.text),
          fmt::format("{} needs a name", what),
          fmt::format("write it in double quotes: `\"{}\"`", name.text));
    }
    return in_.take();
  }

  bool read_let() {
    const auto name = read_name("a `let`");
    if (!name) return false;
    if (!in_.at(TokenKind::Relation) ||
        in_.peek().relation != Relation::Equal) {
      return in_.unexpected("a `let` names a condition", "expected `=`",
                            in_.at(TokenKind::Minus)
                                ? "a name with `-` in it is written in double "
                                  "quotes"
                                : "write `let low = battery == Low`");
    }
    in_.take();
    in_.used_atoms.clear();
    const auto phrase = read_formula(in_);
    if (!phrase ||
        !require_state_predicate(in_, *phrase, "a `let`",
                                 "write the formula out in the property") ||
        !require_end(in_)) {
      return false;
    }
    const auto [entry, is_new] = in_.definitions.try_emplace(
        std::string(name->text),
        Definition{phrase->id, phrase->size, in_.used_atoms, name->span.line});
    if (is_new) return true;
    return in_.error("BT1216", name->span,
                     fmt::format("`{}` is defined twice", name->text), {},
                     fmt::format("line {} defines it already; choose another "
                                 "name",
                                 entry->second.line));
  }

  // `expect holds`, for the property that follows.
  bool read_expect() {
    open_item();
    if (expect_span_) {
      return in_.error("BT1217", in_.here(), "a second `expect`", {},
                       "write one before each property");
    }
    expect_span_ = in_.take().span;
    return read_verdict(expectation_);
  }

  bool read_verdict(Expectation& expectation) {
    static const std::vector<std::string> words = {"holds", "violated"};
    for (const Expectation one : {Expectation::Holds, Expectation::Violated}) {
      if (!in_.accept_word(words[one == Expectation::Violated])) continue;
      expectation = one;
      return true;
    }
    return in_.unexpected(
        "`expect` takes a verdict", "expected `holds` or `violated`",
        did_you_mean(in_.peek().text, words, "write it without quotes"));
  }

  // Titles stand above the first line of an item, its `expect` included.
  void open_item() {
    const int line = in_.here().line;
    if (!expect_span_ || !in_.title_above(line).empty()) {
      title_ = in_.title_above(line);
    }
  }

  bool read_property() {
    open_item();
    in_.take();
    const auto name = read_name("a property");
    if (!name) return false;
    Property property;
    property.name = name->text;
    property.span = name->span;
    if (!read_tags(property) || !read_inline_expect(property)) return false;
    if (!in_.accept(TokenKind::Colon) && !in_.accept_word("is")) {
      return in_.unexpected("a property's name is followed by its body",
                            "expected `:` or `is`",
                            in_.at(TokenKind::Minus) || in_.at(TokenKind::Dot)
                                ? "a name with `-` or `.` in it is written in "
                                  "double quotes"
                                : "write `property NAME: never ...`");
    }
    return read_body(in_, property) && keep(std::move(property));
  }

  // [safety, req=SR-12]
  bool read_tags(Property& property) {
    if (!in_.accept(TokenKind::LeftBracket)) return true;
    for (;;) {
      const std::size_t first = in_.position();
      while (!in_.at(TokenKind::Comma) && !in_.at(TokenKind::RightBracket)) {
        if (in_.at_end() || in_.peek().is_first_on_line ||
            in_.at(TokenKind::Unknown)) {
          return in_.unexpected("this list of tags is never closed",
                                "expected `]`");
        }
        in_.take();
      }
      if (first == in_.position()) {
        return in_.unexpected("a tag is missing", "expected a word");
      }
      property.tags.push_back(in_.text(first, in_.position()));
      if (in_.take().kind == TokenKind::RightBracket) return true;
    }
  }

  bool read_inline_expect(Property& property) {
    property.expectation = expectation_;
    if (!in_.at_word("expect")) return true;
    const std::size_t first = in_.position();
    in_.take();
    if (!read_verdict(property.expectation)) return false;
    if (!expect_span_ || property.expectation == expectation_) return true;
    return in_.error("BT1217", in_.span(first, in_.position()),
                     "two expectations contradict each other", {},
                     fmt::format("drop this one or the `expect` of line {}",
                                 expect_span_->line));
  }

  bool read_prove() {
    open_item();
    Property property;
    property.span = in_.take().span;
    property.name = fmt::format("prove{}", ++unnamed_);
    property.expectation = expectation_;
    return read_body(in_, property) && keep(std::move(property));
  }

  bool keep(Property property) {
    const auto [used, is_new] =
        names_.try_emplace(property.name, NameInUse{property.span.line});
    if (!is_new) {
      const int line = used->second.line;
      std::string name = unused_name(property.name);
      in_.warn("BT1202", property.span,
               fmt::format("`{}` names a property already", property.name),
               fmt::format("reports call this one `{}`", name),
               fmt::format("the first one stands on line {}", line));
      property.name = std::move(name);
    }
    property.title = std::move(title_);
    title_.clear();
    expectation_ = Expectation::None;
    expect_span_.reset();
    in_.file().properties.push_back(std::move(property));
    return true;
  }

  std::string unused_name(const std::string& name) {
    for (;;) {
      const int number = ++names_.at(name).uses;
      std::string candidate = fmt::format("{}#{}", name, number);
      if (names_.emplace(candidate, NameInUse{names_.at(name).line}).second) {
        return candidate;
      }
    }
  }

  // assert NAME -true "shown when it holds" -false "…"; the texts are skipped.
  bool read_assert() {
    const auto refuse = [&](std::string label) {
      return in_.unexpected("`assert` takes the name of a property",
                            std::move(label),
                            "write `prove ...` for a property without a name");
    };
    if (!in_.at_name()) return refuse("expected a name");
    assertions_.push_back(in_.take());
    while (in_.at(TokenKind::Minus) && in_.at(TokenKind::Identifier, 1) &&
           in_.at(TokenKind::Quoted, 2)) {
      for (int i = 0; i < 3; ++i) in_.take();
    }
    return in_.at_item_end() || refuse("expected the next item");
  }

  // NAME: or NAME is, in front of what is assumed.
  bool at_assumption_name() const {
    return in_.at_name() &&
           (in_.at(TokenKind::Colon, 1) || in_.at_word("is", 1));
  }

  bool read_assume() {
    Assumption assumption;
    assumption.span = in_.token(in_.position() - 1).span;
    assumption.name =
        in_.at_word("every") && in_.at_word("action", 1)
            ? "actions-end"
            : fmt::format("assume{}", in_.file().assumptions.size() + 1);
    if (at_assumption_name()) {
      const auto name = read_name("an assumption");
      if (!name) return false;
      assumption.name = name->text;
      assumption.span = name->span;
      in_.take();
    }
    if (!read_assumption(assumption)) return false;
    in_.file().assumptions.push_back(std::move(assumption));
    return true;
  }

  // `every action eventually ends`, or a claim that is a formula of LTL.
  bool read_assumption(Assumption& assumption) {
    if (in_.at_word("every") && in_.at_word("action", 1)) {
      const std::size_t first = in_.position();
      in_.take();
      in_.take();
      if (!in_.accept_word("eventually") || !in_.accept_word("ends")) {
        return in_.unexpected("only one thing can be assumed of every action",
                              "expected `eventually ends`",
                              "write `every action eventually ends`");
      }
      assumption.text = in_.text(first, in_.position());
      return true;
    }
    Property claim;
    claim.span = assumption.span;
    if (!read_body(in_, claim)) return false;
    FormulaPool& pool = in_.formulas();
    assumption.kind = Assumption::Kind::Formula;
    assumption.formula = claim.formula;
    assumption.text = std::move(claim.text);
    if (claim.form == PropertyForm::Ltl) return true;
    const bool is_never = claim.form == PropertyForm::Never;
    if (is_never || claim.form == PropertyForm::Invariant) {
      assumption.formula =
          pool.unary(FormulaKind::Always,
                     is_never ? pool.unary(FormulaKind::Not, claim.formula)
                              : claim.formula);
      return true;
    }
    const bool is_timed = claim.form == PropertyForm::Timed;
    return in_.error("BT1225", assumption.span,
                     "an assumption is a formula of LTL",
                     is_timed ? "a time cannot be assumed"
                              : "this is no claim about a single run",
                     "write for instance `assume [] <> P`");
  }

  void check_assertions() {
    if (in_.has_errors()) return;  // the property may be one of those dropped
    std::vector<std::string> names;
    for (const Property& property : in_.file().properties) {
      names.push_back(property.name);
    }
    for (const Token& name : assertions_) {
      if (names_.contains(std::string(name.text))) continue;
      in_.error("BT1219", name.span,
                fmt::format("no property is called `{}`", name.text), {},
                did_you_mean(name.text, names));
    }
  }

  // `prove P`: true or false before anything has happened.
  void warn_of_conditions_alone() {
    if (in_.has_errors()) return;  // one thing after the other
    for (const Phrase& phrase : in_.conditions_alone) {
      const SourceSpan span = in_.span(phrase.first, phrase.end);
      const std::string text = in_.text(phrase);
      if (phrase.temporal != kNoToken) {
        in_.warn("BT1226", span,
                 "a part of this speaks of the first state only",
                 "no temporal operator stands above it",
                 fmt::format("write `[] ({})` if it must always hold", text));
        continue;
      }
      in_.warn("BT1226", span, "this speaks of the first state only",
               "no word says when it must hold",
               fmt::format(
                   "write `always {0}`, `never {0}` or `eventually {0}`",
                   phrase.join == kNoToken ? text : fmt::format("({})", text)));
    }
  }

  bool refuse_item() {
    static const std::vector<std::string> words = {
        "property", "prove", "assert", "let",
        "expect",   "tree",  "tick",   "assume"};
    const Token& token = in_.peek();
    in_.unexpected(fmt::format("`{}` begins no item", token.text),
                   "expected `property`, `prove`, `let` and so on",
                   did_you_mean(token.text, words,
                                "a formula stands behind `prove` or "
                                "`property NAME:`"));
    in_.take();
    return false;
  }

  PropertyParser& in_;
  Expectation expectation_ = Expectation::None;  // of the next property
  std::optional<SourceSpan> expect_span_;
  std::string title_;  // of the next property
  int unnamed_ = 0;
  std::unordered_map<std::string, NameInUse> names_;
  std::vector<Token> assertions_;  // the names behind `assert`
};

}  // namespace

bool is_property_file(std::string_view name) {
  return name.ends_with(".ltl") || name.ends_with(".btp");
}

bool begins_item(std::string_view text) {
  const SourceText source("", text);
  PropertyFile file;
  return PropertyParser(source, tokenize(source), file).at_item_end();
}

namespace {

// The rules of a file without a name.
struct ParsedRules : Result<PropertyFile> {
  explicit ParsedRules(const std::string& text)
      : Result(read_properties("", text, {})) {}
};

}  // namespace

Result<PropertyFile> read_properties(std::string_view file_name,
                                     const FileText& text) {
  Result<PropertyFile> read = *text.parsed<ParsedRules>();
  read.diagnostics = named(std::move(read.diagnostics), file_name);
  if (read.value) read.value->file = file_name;
  return read;
}

Result<PropertyFile> read_properties(std::string_view file_name,
                                     std::string_view text,
                                     const NameHelp& help) {
  const Stage stage("the rules were read");
  const SourceText source(file_name, text);
  if (auto refusal = source.refuse_binary()) return {std::nullopt, {*refusal}};
  if (text.size() > kMaxFileSize) {
    return {std::nullopt,
            {source.diagnostic(Severity::Error, "BT1210", {0, 0, 1},
                               "this file is larger than 4 MiB", {},
                               "split it into several files")}};
  }
  PropertyFile file;
  file.file = file_name;
  PropertyParser in(source, tokenize(source), file);
  in.name_help = help;
  FileReader(in).read();
  const bool is_refused = in.has_errors();
  Result<PropertyFile> result{std::nullopt, in.take_findings()};
  if (!is_refused) result.value = std::move(file);
  return result;
}

}  // namespace btcheck
