// SPDX-License-Identifier: MIT
//
// Conditions without operators: constants, names and comparisons.
//
// Constants, lets, comparisons and ranges are read here, events in
// property_event.cpp. The paper compares in `drone/5/value (battery = Low)`,
// naming a component and the number of a process in it; elsewhere the variable
// stands alone. Events and comparisons meet in one reference grammar: names
// joined by `/`, then perhaps `@line`, then perhaps `.word`; what follows
// decides which of them was read. Nothing is looked up here except lets.
// A name with neither an event nor a comparison is the commonest mistake, so
// it gets the longest help.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "ltl/rules/parser.hpp"

namespace btcheck {
namespace {

constexpr std::array<std::string_view, 3> kWords = {"tick", "dead", "stuck"};

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
  std::optional<Phrase> read_comparison(Side left);
  std::optional<Phrase> read_range(Side left);
  std::optional<Phrase> fail_alone(const Side& side);
  void fail_undefined(const Side& side, int line);
  std::string alone_help(const std::string& name) const;
  bool require_comparable(const Side& side);
  Phrase finish(Atom atom) const;
  Phrase phrase(FormulaId id, std::uint32_t size = 1) const;

  PropertyParser& in_;
  const ProcessScope* scope_;
  std::size_t first_;
};

std::optional<Phrase> AtomReader::read() {
  if (const auto constant = read_constant()) return constant;
  if (refuse()) return std::nullopt;
  if (at_event(in_, scope_)) return read_event(in_, scope_);
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
  return is_event ? read_node_event(in_, *side) : fail_alone(*side);
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
  const auto word = entry_of(kWords, token.text);
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

Phrase AtomReader::finish(Atom atom) const {
  return finish_atom(in_, scope_, first_, std::move(atom));
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

Phrase finish_atom(PropertyParser& in, const ProcessScope* scope,
                   std::size_t first, Atom atom) {
  atom.span = in.span(first, in.position());
  atom.text = in.text(first, in.position());
  if (scope != nullptr) {
    atom.component = scope->component;
    atom.process = scope->process;
    atom.text = fmt::format("{} ({})", scope->text, atom.text);
  }
  const bool is_event = is_step_event(atom.kind);
  const std::uint32_t number = in.number_of(std::move(atom));
  in.use_atoms({&number, 1});
  Phrase result;
  result.id = in.formulas().atom(number);
  result.first = first;
  result.end = in.position();
  if (is_event) result.temporal = first;
  return result;
}

}  // namespace btcheck
