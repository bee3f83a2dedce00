// SPDX-License-Identifier: MIT
//
// A property file from its first line to its last: items, names, titles.
//
// An item opens with a word of its own (property, prove, let, …). An item with
// an error is dropped, reading goes on at the next such word that begins a
// line, and at the end one error is enough to withhold the file. The chapters
// below this one: property_body (what is claimed), property_timed (with a
// time), property_tail (scopes and times), property_macro (their macro names),
// property_formula (operators), property_atom, property_event and
// property_operand (conditions), property_words and property_lexer.
//
// Codes of the property language:
//   BT1201  a word or symbol that cannot stand where it stands
//   BT1202  a property's name is used again (warning)
//   BT1203  `[]` or `always` covers less or more than it seems to (warning)
//   BT1204  X speaks of one step of the composed automata (warning)
//   BT1205  operators that tools group in different ways need parentheses
//   BT1206  `F` is read as the constant false (warning)
//   BT1207  a name or comment that is never closed, an empty name
//   BT1208  a character that means nothing
//   BT1209  a number out of range, an empty range
//   BT1210  a formula or file that is too large, or nested too deeply
//   BT1211  more than 64 different conditions in one property
//   BT1212  a name with neither an event nor a comparison
//   BT1213  no such event
//   BT1214  a temporal operator where a condition on one state is needed
//   BT1215  a bound or interval that makes no sense
//   BT1216  a `let` used before its line, or defined twice
//   BT1217  an `expect` without a property, or two that contradict
//   BT1218  `tree` or `tick` twice, or with a word they do not know
//   BT1219  `assert` of a property that does not exist
//   BT1220  no property in the file
//   BT1221  a keyword used as a name without quotes
//   BT1222  a scope or time where the pattern takes none, or a second one
//   BT1223  branching and linear time mixed
//   BT1224  Fiacre's tags and port events, which trees have not
//   BT1225  an assumption that does not speak of runs
//   BT1226  a condition that speaks of the first state only (warning)
#include <fmt/format.h>

#include <algorithm>

#include "ltl/rules/parser.hpp"

namespace btcheck {
namespace {

constexpr std::size_t kMaxFileSize = std::size_t{4} << 20;

struct NameInUse {
  int line = 0;  // of the first property of that name
  int uses = 1;
};

struct Assertion {
  std::string name;
  SourceSpan span;
};

class FileReader {
 public:
  explicit FileReader(PropertyParser& in) : in_(in) {}

  void read();

 private:
  bool read_item();
  bool read_tree();
  bool read_tick();
  bool read_let();
  bool define(const Token& name, Definition definition);
  bool read_expect();
  bool read_verdict(Expectation& expectation);
  bool read_property();
  bool read_tags(Property& property);
  bool read_inline_expect(Property& property);
  bool read_prove();
  bool read_assert();
  bool read_assume();
  bool at_assumption_name() const;
  bool read_assumption(Assumption& assumption);
  bool refuse_item();
  bool keep(Property property);
  void open_item();
  void drop_expect();
  void check_assertions();
  void warn_of_conditions_alone();
  std::string unused_name(const std::string& name);
  std::optional<Token> read_name(std::string_view what);

  PropertyParser& in_;
  Expectation expectation_ = Expectation::None;  // of the next property
  std::optional<SourceSpan> expect_span_;
  std::string title_;  // of the next property
  int unnamed_ = 0;
  std::unordered_map<std::string, NameInUse> names_;
  std::vector<Assertion> assertions_;
};

void FileReader::read() {
  while (!in_.at_end() && !in_.is_full()) {
    if (read_item()) continue;
    expectation_ = Expectation::None;
    expect_span_.reset();
    in_.skip_to_item();
  }
  drop_expect();
  check_assertions();
  warn_of_conditions_alone();
  if (names_.empty() && !in_.has_errors()) {
    in_.error("BT1220", {0, 0, 1}, "no property in this file", {},
              "write one: `property NAME: never some_node.failure`");
  }
}

bool FileReader::read_item() {
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

bool FileReader::read_tree() {
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

bool FileReader::read_tick() {
  static const std::vector<std::string> words = {"root", "leaves", "nodes",
                                                 "none"};
  const Token& word = in_.peek();
  const auto found = std::find_if(
      words.begin(), words.end(),
      [&](const std::string& known) { return in_.at_word(known); });
  if (found == words.end()) {
    if (word.kind == TokenKind::Unknown) return false;
    return in_.error(
        "BT1218", word.span, "`tick` says which nodes take a tick of time",
        "expected root, leaves, nodes or none",
        suggestion(word.text, words, "write `tick root`, the default"));
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

std::optional<Token> FileReader::read_name(std::string_view what) {
  const Token& name = in_.peek();
  if (!is_name(name) && name.kind != TokenKind::Number) {
    in_.unexpected(fmt::format("{} needs a name", what), "expected a name");
    return std::nullopt;
  }
  if (name.kind == TokenKind::Word && is_reserved(name.text)) {
    in_.error("BT1221", name.span, fmt::format("`{}` is a keyword", name.text),
              fmt::format("{} needs a name", what),
              fmt::format("write it in double quotes: `\"{}\"`", name.text));
    return std::nullopt;
  }
  return in_.take();
}

bool FileReader::read_let() {
  const auto name = read_name("a `let`");
  if (!name) return false;
  if (!in_.accept(TokenKind::Equal)) {
    return in_.unexpected("a `let` names a condition", "expected `=`",
                          in_.at(TokenKind::Minus)
                              ? "a name with `-` in it is written in double "
                                "quotes"
                              : "write `let low = battery == Low`");
  }
  in_.take_used_atoms();
  const auto phrase = read_formula(in_);
  if (!phrase ||
      !require_state_predicate(in_, *phrase, "a `let`",
                               "write the formula out in the property") ||
      !(in_.at_end() || in_.at_item() || refuse_leftover(in_))) {
    return false;
  }
  return define(*name, {phrase->id, phrase->size, in_.take_used_atoms(),
                        name->span.line});
}

bool FileReader::define(const Token& name, Definition definition) {
  const auto [entry, is_new] = in_.definitions.try_emplace(
      std::string(name.text), std::move(definition));
  if (is_new) return true;
  return in_.error("BT1216", name.span,
                   fmt::format("`{}` is defined twice", name.text), {},
                   fmt::format("line {} defines it already; choose another "
                               "name",
                               entry->second.line));
}

// `expect holds`, for the property that follows.
bool FileReader::read_expect() {
  open_item();
  if (expect_span_) {
    return in_.error("BT1217", in_.here(), "a second `expect`", {},
                     "write one before each property");
  }
  expect_span_ = in_.take().span;
  return read_verdict(expectation_);
}

bool FileReader::read_verdict(Expectation& expectation) {
  static const std::vector<std::string> words = {"holds", "violated"};
  if (in_.accept_word("holds")) {
    expectation = Expectation::Holds;
    return true;
  }
  if (in_.accept_word("violated")) {
    expectation = Expectation::Violated;
    return true;
  }
  return in_.unexpected("`expect` takes a verdict",
                        "expected `holds` or `violated`",
                        suggestion(in_.peek().text, words));
}

// Titles stand above the first line of an item, its `expect` included.
void FileReader::open_item() {
  const int line = in_.here().line;
  if (!expect_span_ || !in_.title_above(line).empty()) {
    title_ = in_.title_above(line);
  }
}

bool FileReader::read_property() {
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
bool FileReader::read_tags(Property& property) {
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

bool FileReader::read_inline_expect(Property& property) {
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

bool FileReader::read_prove() {
  open_item();
  Property property;
  property.span = in_.take().span;
  property.name = fmt::format("prove{}", ++unnamed_);
  property.expectation = expectation_;
  return read_body(in_, property) && keep(std::move(property));
}

bool FileReader::keep(Property property) {
  const auto used = names_.find(property.name);
  if (used == names_.end()) {
    names_.emplace(property.name, NameInUse{property.span.line});
  } else {
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

std::string FileReader::unused_name(const std::string& name) {
  for (;;) {
    const int number = ++names_.at(name).uses;
    std::string candidate = fmt::format("{}#{}", name, number);
    if (names_.emplace(candidate, NameInUse{names_.at(name).line}).second) {
      return candidate;
    }
  }
}

// assert NAME -true "shown when it holds" -false "…": the texts are left alone.
bool FileReader::read_assert() {
  if (!is_name(in_.peek())) {
    return in_.unexpected("`assert` takes the name of a property",
                          "expected a name",
                          "write `prove ...` for a property without a name");
  }
  const Token& name = in_.take();
  assertions_.push_back({std::string(name.text), name.span});
  while (in_.at(TokenKind::Minus) && in_.peek(1).kind == TokenKind::Word &&
         in_.peek(2).kind == TokenKind::Quoted) {
    for (int i = 0; i < 3; ++i) in_.take();
  }
  if (in_.at_end() || in_.at_item()) return true;
  return in_.unexpected("`assert` takes the name of a property",
                        "expected the next item",
                        "write `prove ...` for a property without a name");
}

// NAME: or NAME is, in front of what is assumed.
bool FileReader::at_assumption_name() const {
  return is_name(in_.peek()) &&
         (in_.peek(1).kind == TokenKind::Colon || in_.at_word("is", 1));
}

bool FileReader::read_assume() {
  Assumption assumption;
  assumption.span = in_.token(in_.position() - 1).span;
  assumption.name =
      in_.at_word("every")
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
bool FileReader::read_assumption(Assumption& assumption) {
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
  if (claim.form == PropertyForm::Never) {
    assumption.formula = pool.unary(FormulaKind::Not, claim.formula);
  }
  if (claim.form == PropertyForm::Never ||
      claim.form == PropertyForm::Invariant) {
    assumption.formula = pool.unary(FormulaKind::Always, assumption.formula);
    return true;
  }
  if (claim.form == PropertyForm::Ltl) return true;
  const bool is_timed = claim.form == PropertyForm::Timed;
  return in_.error("BT1225", assumption.span,
                   "an assumption is a formula of LTL",
                   is_timed ? "a time cannot be assumed"
                            : "a single run cannot be said to satisfy this",
                   "write for instance `assume: [] <> goto_waypoint.success`");
}

void FileReader::drop_expect() {
  if (!expect_span_) return;
  in_.error("BT1217", *expect_span_, "this `expect` belongs to no property", {},
            "write it before a property");
}

void FileReader::check_assertions() {
  if (in_.has_errors()) return;  // the property may be one of those dropped
  std::vector<std::string> names;
  for (const Property& property : in_.file().properties) {
    names.push_back(property.name);
  }
  for (const Assertion& assertion : assertions_) {
    if (names_.contains(assertion.name)) continue;
    in_.error("BT1219", assertion.span,
              fmt::format("no property is called `{}`", assertion.name), {},
              suggestion(assertion.name, names));
  }
}

// `prove P`: true or false before anything has happened.
void FileReader::warn_of_conditions_alone() {
  if (in_.has_errors()) return;  // one thing after the other
  for (const Phrase& phrase : in_.conditions_alone) {
    if (phrase.temporal != kNoToken) {
      in_.warn("BT1226", in_.span(phrase.first, phrase.end),
               "a part of this speaks of the first state only",
               "no temporal operator stands above it",
               fmt::format("write `[] ({})` if it is to hold throughout",
                           in_.text(phrase)));
      continue;
    }
    in_.warn("BT1226", in_.span(phrase.first, phrase.end),
             "this speaks of the first state only",
             "no word says when it is to be so",
             fmt::format("write `always {0}`, `never {0}` or `eventually {0}`",
                         phrase.join == kNoToken
                             ? in_.text(phrase)
                             : fmt::format("({})", in_.text(phrase))));
  }
}

bool FileReader::refuse_item() {
  static const std::vector<std::string> words = {
      "property", "prove", "assert", "let", "expect", "tree", "tick", "assume"};
  const Token& token = in_.peek();
  in_.unexpected(fmt::format("`{}` begins no item", token.text),
                 "expected `property`, `prove`, `let` and so on",
                 suggestion(token.text, words,
                            "a formula stands behind `prove` or "
                            "`property NAME:`"));
  in_.take();
  return false;
}

}  // namespace

Result<PropertyFile> read_properties(std::string_view file_name,
                                     std::string_view text) {
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
  FileReader(in).read();
  const bool is_refused = in.has_errors();
  Result<PropertyFile> result{std::nullopt, in.take_findings()};
  if (!is_refused) result.value = std::move(file);
  return result;
}

}  // namespace btcheck
