// SPDX-License-Identifier: MIT
//
// Conditions without operators, in the two spellings they have.
//
// The paper writes `drone/5/state done` and `drone/5/value (battery = Low)`: a
// component, the number of a process in it, and what to look at. The other
// spelling names a node and one of its events, `land@23.ticked`, or compares a
// variable. Both meet in one reference grammar: names joined by `/`, then
// perhaps `@line`, then perhaps `.word`; what follows decides whether an event
// or one side of a comparison was read. Nothing is looked up here except lets.
// A name with neither an event nor a comparison is the commonest mistake, so
// it gets the longest help.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>

#include "ltl/property_parser.hpp"

namespace btcheck {
namespace {

constexpr std::array<std::string_view, 9> kEvents = {
    "ticked", "success", "failure", "running", "halted",
    "done",   "active",  "ended",   "moves"};
constexpr std::array<std::string_view, 3> kWords = {"tick", "dead", "stuck"};

std::optional<std::string_view> known(std::string_view word,
                                      std::span<const std::string_view> list) {
  const auto found = std::find_if(
      list.begin(), list.end(),
      [&](std::string_view entry) { return equal_ignoring_case(word, entry); });
  if (found == list.end()) return std::nullopt;
  return *found;
}

std::string event_help(std::string_view word) {
  static const std::vector<std::string> events = {
      "ticked", "success", "failure", "running", "halted",
      "done",   "active",  "ended",   "status",  "moves"};
  if (equal_ignoring_case(word, "tick_node")) return "write `.ticked`";
  return suggestion(word, events,
                    "events are .ticked, .success, .failure, .running, "
                    ".halted, .done and .active");
}

class AtomReader {
 public:
  AtomReader(PropertyParser& in, const ProcessScope* scope)
      : in_(in), scope_(scope), first_(in.position()) {}

  std::optional<Phrase> read();

 private:
  bool refuse();
  bool refuse_nested_word();
  std::optional<Phrase> read_constant();
  std::optional<Phrase> read_bare_word();
  std::optional<Phrase> read_let(const Definition& definition);
  bool at_step_condition() const;
  std::optional<Phrase> read_step_condition();
  bool at_time_passes() const;
  std::optional<Phrase> read_time_passes();
  bool at_process_path() const;
  std::optional<Phrase> read_process_path();
  bool check_process_path(std::size_t what);
  std::optional<Phrase> read_event(const Side& side);
  std::optional<Phrase> read_comparison(Side left);
  std::optional<Phrase> read_range(Side left);
  std::optional<Phrase> fail_alone(const Side& side);
  void fail_undefined(const Side& side, int line);
  std::string alone_help(const std::string& name) const;
  void name_process(Atom& atom, const Side& side) const;
  bool require_comparable(const Side& side);
  std::optional<Phrase> finish(Atom atom);
  Phrase phrase(FormulaId id, std::uint32_t size = 1) const;

  PropertyParser& in_;
  const ProcessScope* scope_;
  std::size_t first_;
};

std::optional<Phrase> AtomReader::read() {
  if (const auto constant = read_constant()) return constant;
  if (refuse()) return std::nullopt;
  if (at_process_path()) return read_process_path();
  if (at_step_condition()) return read_step_condition();
  if (at_time_passes()) return read_time_passes();
  if (!in_.continues_name()) {
    if (const auto word = read_bare_word()) return word;
  }
  const auto side = read_side(in_, scope_);
  if (!side) return std::nullopt;
  if (relation_here(in_)) return read_comparison(*side);
  if (in_.at_word("in")) return read_range(*side);
  if (side->operand.is_number) {
    in_.unexpected("a number is no condition", "expected a comparison",
                   "compare it: `fls > 3`");
    return std::nullopt;
  }
  const bool is_event = !side->operand.node.empty() &&
                        !side->operand.name.empty() && scope_ == nullptr;
  return is_event ? read_event(*side) : fail_alone(*side);
}

// What cannot begin a condition: nothing, an operator, or a keyword.
bool AtomReader::refuse() {
  const Token& token = in_.peek();
  const bool is_word = token.kind == TokenKind::Word;
  if (is_word && in_.continues_name() &&
      (prefix_here(in_) || infix_here(in_) || token.text == "T")) {
    in_.error("BT1221", token.span,
              fmt::format("`{}` is an operator, not a name", token.text), {},
              fmt::format("write a name that looks like it in double quotes: "
                          "`\"{}\"`",
                          token.text));
    return true;
  }
  if (token.kind == TokenKind::Minus && in_.peek(1).kind == TokenKind::Number) {
    return false;
  }
  if (in_.starts_operand() && !in_.at_item()) return refuse_nested_word();
  in_.unexpected("a condition is missing", "expected a condition here");
  return true;
}

// Words of whole bodies, written inside a formula.
bool AtomReader::refuse_nested_word() {
  struct Rewrite {
    std::string_view word;
    std::string_view instead;
  };
  static constexpr auto kRewrites =
      std::to_array<Rewrite>({{"always", "[]"},
                              {"never", "[] not"},
                              {"absent", "[] not"},
                              {"eventually", "<>"},
                              {"present", "<>"},
                              {"next", "X"},
                              {"infinitelyOften", "[] <>"},
                              {"mortal", "<> [] not"},
                              {"GF", "G F"},
                              {"FG", "F G"}});
  for (const Rewrite& rewrite : kRewrites) {
    if (!in_.at_keyword(rewrite.word) || !in_.starts_operand(1)) continue;
    in_.error(
        "BT1201", in_.here(),
        fmt::format("`{}` cannot stand inside a formula", in_.peek().text),
        "only at the start of a property",
        fmt::format("write `{}` here", rewrite.instead));
    return true;
  }
  return false;
}

std::optional<Phrase> AtomReader::read_constant() {
  const bool is_true =
      in_.at_keyword("true") || (in_.at_keyword("T") && in_.peek().text == "T");
  const bool is_f = in_.at_keyword("F") && in_.peek().text == "F";
  if (!is_true && !is_f && !in_.at_keyword("false")) return std::nullopt;
  if (is_f) {
    in_.warn("BT1206", in_.here(), "`F` is read as the constant false here",
             "no condition follows that could eventually hold",
             "write `false`");
  }
  in_.take();
  return phrase(in_.formulas().constant(is_true));
}

// tick, dead, stuck, or the name of a let.
std::optional<Phrase> AtomReader::read_bare_word() {
  const Token& token = in_.peek();
  if (!is_name(token) || scope_ != nullptr) return std::nullopt;
  const auto let = in_.definitions.find(std::string(token.text));
  if (let != in_.definitions.end()) return read_let(let->second);
  const auto word = known(token.text, kWords);
  if (token.kind != TokenKind::Word || !word) return std::nullopt;
  in_.take();
  Atom atom;
  atom.kind = AtomKind::Keyword;
  atom.word = *word;
  atom.word_span = token.span;
  return finish(std::move(atom));
}

std::optional<Phrase> AtomReader::read_let(const Definition& definition) {
  in_.take();
  in_.use_atoms(definition.atoms);
  return phrase(definition.formula, definition.size);
}

// enter P, leave P
bool AtomReader::at_step_condition() const {
  return scope_ == nullptr && in_.starts_operand(1) &&
         (in_.at_keyword("enter") || in_.at_keyword("leave"));
}

std::optional<Phrase> AtomReader::read_step_condition() {
  const Token& word = in_.take();
  if (in_.is_inside_event) {
    in_.error("BT1214", word.span,
              fmt::format("`{}` inside `enter` or `leave`", word.text),
              "these take a condition on single states");
    return std::nullopt;
  }
  in_.is_inside_event = true;
  const auto of = read_single_operand(in_);
  in_.is_inside_event = false;
  if (!of || !require_state_predicate(in_, *of, fmt::format("`{}`", word.text),
                                      "write the formula out")) {
    return std::nullopt;
  }
  Atom atom;
  atom.kind = equal_ignoring_case(word.text, "enter") ? AtomKind::Enter
                                                      : AtomKind::Leave;
  atom.of = of->id;
  return finish(std::move(atom));
}

bool AtomReader::at_time_passes() const {
  return scope_ == nullptr && in_.at_word("time") &&
         in_.peek(1).kind == TokenKind::Dot && in_.at_word("passes", 2);
}

std::optional<Phrase> AtomReader::read_time_passes() {
  for (int i = 0; i < 3; ++i) in_.take();
  Atom atom;
  atom.kind = AtomKind::Passes;
  return finish(std::move(atom));
}

bool AtomReader::at_process_path() const {
  return is_name(in_.peek()) && in_.peek(1).kind == TokenKind::Slash &&
         in_.peek(2).kind == TokenKind::Number &&
         in_.peek(3).kind == TokenKind::Slash;
}

// drone/5/state done. (`value` with its parenthesis never comes here.)
std::optional<Phrase> AtomReader::read_process_path() {
  const std::size_t what = in_.position() + 4;
  Atom atom;
  atom.kind = AtomKind::ProcessState;
  atom.component = in_.take().text;
  in_.take();
  atom.process = read_number(in_);
  if (!atom.process) return std::nullopt;
  atom.node_span = in_.span(first_, in_.position());
  in_.take();
  if (!check_process_path(what)) return std::nullopt;
  if (!is_name(in_.peek()) && !in_.at(TokenKind::Number)) {
    in_.unexpected("the name of a state is missing",
                   "expected a state of the process",
                   "write `state tick_node`, `state done` and so on");
    return std::nullopt;
  }
  atom.word = in_.peek().text;
  atom.word_span = in_.here();
  in_.take();
  return finish(std::move(atom));
}

bool AtomReader::check_process_path(std::size_t what) {
  const SourceSpan span = in_.here();
  if (scope_ != nullptr) {
    return in_.error("BT1201", in_.span(first_, what),
                     "inside `value (...)` only comparisons can stand", {},
                     "close the parenthesis before it");
  }
  if (in_.accept_word("state")) return true;
  if (in_.at_word("value")) {
    return in_.error("BT1201", span,
                     "`value` takes a comparison in parentheses", {},
                     "write `value (battery = Low)`");
  }
  if (in_.at_word("tag") || in_.at_word("event")) {
    return in_.error(
        "BT1224", span,
        fmt::format("behavior trees have no `/{}`", in_.peek().text),
        "their automata have neither ports nor tags",
        "name the state that is entered: `enter "
        "(drone/5/state done)`");
  }
  return in_.unexpected("a process has a `state` and a `value`",
                        "neither of the two",
                        "write `drone/5/state done` or "
                        "`drone/5/value (battery = Low)`");
}

std::optional<Phrase> AtomReader::read_event(const Side& side) {
  const std::size_t last = side.end - 1;
  const Token& word = in_.token(last);
  const auto event = known(word.text, kEvents);
  if (side.operand.name == "status") {
    in_.error(
        "BT1213", word.span, fmt::format("`.{}` has to be compared", word.text),
        {},
        fmt::format("write `{} == success`", in_.text(side.first, side.end)));
    return std::nullopt;
  }
  if (!event) {
    in_.error("BT1213", word.span,
              fmt::format("`{}` is not an event", word.text),
              "a node has no such event", event_help(word.text));
    return std::nullopt;
  }
  Atom atom;
  atom.kind = *event == "moves" ? AtomKind::Moves : AtomKind::NodeEvent;
  atom.node = side.operand.node;
  atom.word = *event;
  name_process(atom, side);
  atom.node_span = in_.span(side.first, side.node_end);
  atom.word_span = word.span;
  return finish(std::move(atom));
}

// drone/8.ticked
void AtomReader::name_process(Atom& atom, const Side& side) const {
  const bool is_process = side.node_end == side.first + 3 &&
                          in_.token(side.first + 1).kind == TokenKind::Slash &&
                          in_.token(side.first + 2).kind == TokenKind::Number;
  if (!is_process) return;
  const std::string_view digits = in_.token(side.first + 2).text;
  std::int32_t number = 0;
  const auto [end, status] =
      std::from_chars(digits.data(), digits.data() + digits.size(), number);
  if (status != std::errc()) return;
  atom.component = in_.token(side.first).text;
  atom.process = number;
}

bool AtomReader::require_comparable(const Side& side) {
  if (side.operand.is_number || !side.operand.name.empty()) return true;
  const std::string node = in_.text(side.first, side.end);
  return in_.error("BT1212", side.operand.span,
                   fmt::format("`{}` is a node, which has no value", node), {},
                   fmt::format("compare its status: `{}.status`", node));
}

std::optional<Phrase> AtomReader::read_comparison(Side left) {
  Atom atom;
  atom.kind = AtomKind::Comparison;
  atom.relation = *relation_here(in_);
  in_.take();
  if (!require_comparable(left)) return std::nullopt;
  const auto right = read_side(in_, scope_);
  if (!right || !require_comparable(*right)) return std::nullopt;
  if (left.operand.is_number && right->operand.is_number) {
    in_.error("BT1201", in_.span(first_, in_.position()),
              "two numbers are compared", "always the same",
              "compare a variable with a number, or write `true` or `false`");
    return std::nullopt;
  }
  if (relation_here(in_)) {
    in_.unexpected("a comparison has two sides", "this would be a third",
                   "write `fls in 1..3`, or join two comparisons with `and`");
    return std::nullopt;
  }
  atom.left = std::move(left.operand);
  atom.right = right->operand;
  return finish(std::move(atom));
}

std::optional<Phrase> AtomReader::read_range(Side left) {
  in_.take();
  if (!require_comparable(left)) return std::nullopt;
  const std::size_t start = in_.position();
  if (left.operand.is_number ||
      (!in_.at(TokenKind::Number) && !in_.at(TokenKind::Minus))) {
    in_.unexpected("`in` takes a range of numbers", "expected two numbers",
                   "write `fls in 0..3`");
    return std::nullopt;
  }
  const auto low = read_number(in_);
  if (!low) return std::nullopt;
  if (!in_.accept(TokenKind::DotDot)) {
    in_.unexpected("`in` takes a range of numbers", "expected `..`",
                   "write `fls in 0..3`");
    return std::nullopt;
  }
  const auto high = read_number(in_);
  if (!high) return std::nullopt;
  if (*low > *high) {
    in_.error("BT1209", in_.span(start, in_.position()), "this range is empty",
              "the first number is the larger one",
              fmt::format("write `{}..{}`", *high, *low));
    return std::nullopt;
  }
  Atom atom;
  atom.kind = AtomKind::Range;
  atom.left = std::move(left.operand);
  atom.low = *low;
  atom.high = *high;
  return finish(std::move(atom));
}

// A name that is neither an event nor compared.
std::optional<Phrase> AtomReader::fail_alone(const Side& side) {
  const std::string name = in_.text(side.first, side.end);
  if (scope_ != nullptr) {
    in_.error("BT1212", side.operand.span,
              fmt::format("`{}` has to be compared", name), {},
              fmt::format("write `{} = ...`", name));
    return std::nullopt;
  }
  if (in_.at(TokenKind::Unknown)) return std::nullopt;
  const auto later = in_.announced.find(side.operand.name);
  if (side.operand.node.empty() && later != in_.announced.end()) {
    fail_undefined(side, later->second);
    return std::nullopt;
  }
  in_.error("BT1212", side.operand.span,
            fmt::format("`{}` alone is not a condition", name),
            "what about it?", alone_help(name));
  return std::nullopt;
}

// A let without a definition so far; `line` is where its `let` stands. One that
// stands above was dropped for an error of its own, which has been reported.
void AtomReader::fail_undefined(const Side& side, int line) {
  const SourceSpan span = side.operand.span;
  if (line < span.line && in_.has_errors()) return;
  in_.error(
      "BT1216", span,
      fmt::format("`{}` is used before its `let`", side.operand.name), {},
      line == span.line
          ? "a `let` can use those above it only"
          : fmt::format("move the `let` of line {} above this line", line));
}

std::string AtomReader::alone_help(const std::string& name) const {
  std::vector<std::string> candidates;
  for (const auto& [let, definition] : in_.definitions) {
    candidates.push_back(let);
  }
  std::sort(candidates.begin(), candidates.end());
  if (in_.starts_operand()) {
    candidates.insert(candidates.end(), opening_words().begin(),
                      opening_words().end());
  }
  if (in_.at(TokenKind::Minus)) {
    return "a name with `-` in it is written in double quotes";
  }
  if (in_.at(TokenKind::Eventually)) {
    return "`<>` means eventually; not equal is written `~=` or `!=`";
  }
  return suggestion(
      name, candidates,
      fmt::format("write `{0}.ticked`, `{0}.success`, `{0}.running` and so on "
                  "for a node, `{0} == ...` for a variable",
                  name));
}

std::optional<Phrase> AtomReader::finish(Atom atom) {
  atom.span = in_.span(first_, in_.position());
  atom.text = in_.text(first_, in_.position());
  if (scope_ != nullptr) {
    atom.component = scope_->component;
    atom.process = scope_->process;
    atom.text = fmt::format("{} ({})", scope_->text, atom.text);
  }
  const bool is_event = is_step_event(atom.kind);
  const std::uint32_t number = in_.number_of(std::move(atom));
  in_.use_atoms({&number, 1});
  Phrase result = phrase(in_.formulas().atom(number));
  if (is_event) result.temporal = first_;
  return result;
}

Phrase AtomReader::phrase(FormulaId id, std::uint32_t size) const {
  Phrase result;
  result.id = id;
  result.size = size;
  result.first = first_;
  result.end = in_.position();
  return result;
}

}  // namespace

std::optional<Phrase> read_atom(PropertyParser& in, const ProcessScope* scope) {
  return AtomReader(in, scope).read();
}

std::optional<ProcessScope> read_value_opening(PropertyParser& in) {
  const bool is_here =
      is_name(in.peek()) && in.peek(1).kind == TokenKind::Slash &&
      in.peek(2).kind == TokenKind::Number && in.peek(2).text.size() < 10 &&
      in.peek(3).kind == TokenKind::Slash && in.at_word("value", 4) &&
      in.peek(5).kind == TokenKind::LeftParen;
  if (!is_here) return std::nullopt;
  const std::size_t first = in.position();
  ProcessScope scope;
  scope.component = in.take().text;
  in.take();
  const auto process = read_number(in);
  if (!process) return std::nullopt;
  scope.process = *process;
  in.take();
  in.take();
  scope.text = in.text(first, in.position());
  in.take();
  return scope;
}

}  // namespace btcheck
