// SPDX-License-Identifier: MIT
//
// Conditions without operators: constants, names and comparisons.
//
// Events (event.cpp) and comparisons begin with the same references: names
// joined by `/`, then perhaps `@` and a line, then perhaps `.` and a word:
// `battery`, `land@23.ticked`, `fail/land.status`, `drone/8`. The paper's
// `btnode[x].rstatus` is the same as `x.status`; `self` in it is the process
// whose `value (...)` it stands in. Only lets are looked up here, the rest when
// the property is bound to a tree. A name with neither an event nor a
// comparison is the commonest mistake, so it gets the longest help.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <limits>

#include "ltl/rules/parser.hpp"

namespace btcheck {
namespace {

// --- a side of a comparison

bool read_line(PropertyParser& in, std::string& node) {
  in.take();
  if (!in.at(TokenKind::Number)) {
    return in.unexpected("a line number is missing",
                         "expected a number behind `@`",
                         "`land@23` is the node that line 23 of the tree "
                         "file declares");
  }
  const auto line = read_number(in);
  if (line) node += fmt::format("@{}", *line);
  return line.has_value();
}

bool read_member(PropertyParser& in, Side& side) {
  in.take();
  if (!in.at_name()) {
    return in.unexpected("an event is missing",
                         "expected `ticked`, `success` and so on");
  }
  const std::string_view word = in.take().text;
  const bool is_status = equal_ignoring_case(word, "rstatus") ||
                         equal_ignoring_case(word, "status");
  side.operand.name = is_status ? "status" : word;
  return true;
}

// btnode[localization_ok_btn18].rstatus
bool read_btnode(PropertyParser& in, Side& side) {
  in.take();
  in.accept(TokenKind::LeftBracket);
  if (!in.at_name() || !in.at(TokenKind::RightBracket, 1)) {
    return in.unexpected("`btnode[...]` takes the name of one node",
                         "expected a name and `]`",
                         "write `btnode[takeoff].rstatus`");
  }
  // `self` is the process of the scope: its own field, so no node is named.
  const bool is_self = in.scope && in.at_word("self");
  if (!is_self) side.operand.node = in.peek().text;
  in.take();
  in.take();
  side.node_end = in.position();
  if (!in.at(TokenKind::Dot)) {
    return in.unexpected("`btnode[...]` is a record", "expected `.rstatus`",
                         "write `btnode[takeoff].rstatus`");
  }
  if (!read_member(in, side)) return false;
  if (is_self) side.operand.name = "rstatus";
  return true;
}

bool read_reference(PropertyParser& in, Side& side) {
  if (!in.at_name()) {
    return in.unexpected("a name or a number is missing",
                         "expected what to compare with");
  }
  if (in.at_word("btnode") && (in.at(TokenKind::LeftBracket, 1) ||
                               in.at_symbol(FormulaKind::Always, 1))) {
    return read_btnode(in, side);
  }
  std::string node(in.take().text);
  bool is_node = false;
  while (in.at(TokenKind::Slash) &&
         (in.at_name(1) || in.at(TokenKind::Number, 1))) {
    in.take();
    node += '/';
    node += in.take().text;
    is_node = true;
  }
  if (in.at(TokenKind::At)) {
    if (!read_line(in, node)) return false;
    is_node = true;
  }
  side.node_end = in.position();
  const bool has_member = in.at(TokenKind::Dot);
  (is_node || has_member ? side.operand.node : side.operand.name) =
      std::move(node);
  return !has_member || read_member(in, side);
}

// A number with its sign, `-0.25`: three tokens, or four, without a gap.
std::optional<Decimal> read_decimal(PropertyParser& in) {
  const std::size_t first = in.position();
  const bool is_negative = in.accept(TokenKind::Minus);
  if (!in.at(TokenKind::Number)) {
    return in.unexpected("a number is missing", "expected a number");
  }
  std::string digits(is_negative ? "-" : "");
  const Token& whole = in.take();
  digits += whole.text;
  const bool has_point = in.at(TokenKind::Dot) && in.at(TokenKind::Number, 1) &&
                         whole.end == in.peek().begin &&
                         in.peek().end == in.peek(1).begin;
  if (has_point) {
    in.take();
    digits += '.';
    digits += in.take().text;
  }
  if (const auto number = decimal_number(digits)) return number;
  return in.error("BT1209", in.span(first, in.position()),
                  "this number is out of range", {},
                  has_point
                      ? "without its point it lies between -2147483648 and "
                        "2147483647, with nine decimals at most"
                      : "numbers lie between -2147483648 and 2147483647");
}

// A name or a number.
std::optional<Side> read_plain_side(PropertyParser& in) {
  Side side;
  side.first = in.position();
  if (in.at(TokenKind::Number) || in.at(TokenKind::Minus)) {
    const auto number = read_decimal(in);
    if (!number) return std::nullopt;
    side.operand.is_number = true;
    side.operand.number = *number;
  } else if (!read_reference(in, side)) {
    return std::nullopt;
  }
  side.end = in.position();
  side.operand.span = in.span(side.first, side.end);
  return side;
}

// `2 * x + (y - 1)`, by recursion on parentheses, of which there are few.
class SideReader {
 public:
  explicit SideReader(PropertyParser& in) : in_(in) {}

  std::optional<Side> read() {
    auto sum = read_product();
    while (sum && (in_.at(TokenKind::Plus) || in_.at(TokenKind::Minus))) {
      const bool is_sum = in_.take().kind == TokenKind::Plus;
      sum = joined(is_sum ? Arithmetic::Add : Arithmetic::Subtract,
                   std::move(*sum), read_product());
    }
    return sum;
  }

 private:
  static constexpr std::size_t kMostOperands = 64;

  std::optional<Side> read_product() {
    auto product = read_factor();
    while (product && in_.accept(TokenKind::Times)) {
      product =
          joined(Arithmetic::Multiply, std::move(*product), read_factor());
    }
    return product;
  }

  std::optional<Side> read_factor() {
    if (++operands_ > kMostOperands) {
      return in_.error("BT1210", in_.here(),
                       fmt::format("this calculation has more than {} operands",
                                   kMostOperands));
    }
    const std::size_t first = in_.position();
    if (operands_ > 1 && in_.at_item()) {
      return in_.unexpected("a name or a number is missing",
                            "expected what to calculate with");
    }
    if (!in_.accept(TokenKind::LeftParen)) return read_plain_side(in_);
    auto inside = read();
    if (!inside) return std::nullopt;
    if (!in_.accept(TokenKind::RightParen)) {
      return in_.unexpected("this parenthesis is never closed",
                            "expected `)`, or more to calculate with");
    }
    inside->first = first;
    inside->end = in_.position();
    inside->operand.span = in_.span(first, inside->end);
    return inside;
  }

  std::optional<Side> joined(Arithmetic calculation, Side left,
                             std::optional<Side> right) {
    if (!right) return std::nullopt;
    Side side;
    side.first = left.first;
    side.end = right->end;
    side.operand.calculation = calculation;
    side.operand.span = in_.span(side.first, side.end);
    side.operand.parts.push_back(std::move(left.operand));
    side.operand.parts.push_back(std::move(right->operand));
    return side;
  }

  PropertyParser& in_;
  std::size_t operands_ = 0;
};

std::optional<Side> read_side(PropertyParser& in) {
  return SideReader(in).read();
}

bool has_name(const Operand& operand) {
  bool found = false;
  visit_leaves(operand, [&](const Operand& leaf) { found |= !leaf.is_number; });
  return found;
}

// --- comparisons

bool require_comparable(PropertyParser& in, const Side& side) {
  const Operand* node = nullptr;
  visit_leaves(side.operand, [&](const Operand& leaf) {
    if (!leaf.is_number && leaf.name.empty()) node = &leaf;
  });
  if (node == nullptr) return true;
  return in.error("BT1212", node->span,
                  fmt::format("`{}` is a node, which has no value", node->node),
                  {},
                  fmt::format("compare its status: `{}.status`", node->node));
}

std::optional<Phrase> read_comparison(PropertyParser& in, const Side& left) {
  const Relation relation = in.take().relation;
  if (!require_comparable(in, left)) return std::nullopt;
  const auto right = read_side(in);
  if (!right || !require_comparable(in, *right)) return std::nullopt;
  if (!has_name(left.operand) && !has_name(right->operand)) {
    return in.error(
        "BT1201", in.span(left.first, in.position()),
        "two numbers are compared", "always the same",
        "compare a variable with a number, or write `true` or `false`");
  }
  if (in.at(TokenKind::Relation)) {
    return in.unexpected(
        "a comparison has two sides", "this would be a third",
        has_name(left.operand)
            ? fmt::format(
                  "write `{} in 1..3`, or join two comparisons with `and`",
                  in.text(left.first, left.end))
            : "join two comparisons with `and`");
  }
  return finish_atom(in, left.first,
                     {.kind = AtomKind::Comparison,
                      .relation = relation,
                      .left = left.operand,
                      .right = right->operand});
}

std::optional<Phrase> read_range(PropertyParser& in, const Side& left) {
  in.take();
  if (!require_comparable(in, left)) return std::nullopt;
  const std::size_t start = in.position();
  const auto refuse = [&](std::string label) {
    return in.unexpected(
        "`in` takes a range of numbers", std::move(label),
        has_name(left.operand)
            ? fmt::format("write `{} in 0..3`", in.text(left.first, left.end))
            : "write a variable in front of it");
  };
  if (!has_name(left.operand) ||
      (!in.at(TokenKind::Number) && !in.at(TokenKind::Minus))) {
    return refuse("expected two numbers");
  }
  const auto low = read_decimal(in);
  if (!low) return std::nullopt;
  if (!in.accept(TokenKind::DotDot)) return refuse("expected `..`");
  const std::size_t second = in.position();
  const auto high = read_decimal(in);
  if (!high) return std::nullopt;
  if (low->nearest() > high->nearest()) {
    return in.error(
        "BT1209", in.span(start, in.position()), "this range is empty",
        "the first number is the larger one",
        fmt::format("write `{}..{}`", in.text(second, in.position()),
                    in.text(start, second - 1)));
  }
  return finish_atom(in, left.first,
                     {.kind = AtomKind::Range,
                      .left = left.operand,
                      .low = *low,
                      .high = *high});
}

// --- names alone

// `name` as written, `bare` without quotes.
std::string alone_help(PropertyParser& in, const std::string& name,
                       const std::string& bare) {
  if (in.at(TokenKind::Minus)) {
    return "a name with `-` in it is written in double quotes";
  }
  if (in.at_symbol(FormulaKind::Eventually)) {
    return "`<>` means eventually; not equal is written `~=` or `!=`";
  }
  std::vector<std::string> candidates;
  for (const auto& [let, definition] : in.definitions) {
    candidates.push_back(let);
  }
  std::ranges::sort(candidates);
  if (in.starts_operand()) {
    candidates.insert(candidates.end(), opening_words().begin(),
                      opening_words().end());
  }
  std::string help = in.name_help ? in.name_help(bare) : std::string();
  if (help.empty()) {
    help =
        "a node has events behind its name, such as `.ticked`; a variable is "
        "compared with something";
  }
  return did_you_mean(name, candidates, std::move(help));
}

// A let without a definition so far; `line` is where its `let` stands. One that
// stands above was dropped for an error of its own, which has been reported.
Refused fail_undefined(PropertyParser& in, const Operand& operand, int line) {
  if (line < operand.span.line && in.has_errors()) return {};
  return in.error(
      "BT1216", operand.span,
      fmt::format("`{}` is used before its `let`", operand.name), {},
      line == operand.span.line
          ? "a `let` can use those above it only"
          : fmt::format("move the `let` of line {} above this line", line));
}

// A name that is neither an event nor compared.
Refused fail_alone(PropertyParser& in, const Side& side) {
  const std::string name = in.text(side.first, side.end);
  if (in.scope) {
    return in.error("BT1212", side.operand.span,
                    fmt::format("`{}` has to be compared", name), {},
                    fmt::format("write `{} = ...`", name));
  }
  if (in.at(TokenKind::Unknown)) return {};
  for (const char* const word : {"once", "previously", "enter", "leave"}) {
    if (in.at_item_end() && equal_ignoring_case(name, word)) {
      return in.unexpected("a condition is missing",
                           "expected a condition here");
    }
  }
  const auto later = in.announced.find(side.operand.name);
  if (side.operand.node.empty() && later != in.announced.end()) {
    return fail_undefined(in, side.operand, later->second);
  }
  return in.error("BT1212", side.operand.span,
                  fmt::format("`{}` alone is not a condition", name),
                  "what about it?",
                  alone_help(in, name,
                             side.operand.node.empty() ? side.operand.name
                                                       : side.operand.node));
}

// --- what may begin a condition

// Words of whole bodies, written inside a formula.
bool refuse_nested_word(PropertyParser& in) {
  constexpr std::string_view kRewrites[][2] = {{"always", "[]"},
                                               {"never", "[] not"},
                                               {"absent", "[] not"},
                                               {"eventually", "<>"},
                                               {"present", "<>"},
                                               {"next", "X"},
                                               {"infinitelyOften", "[] <>"},
                                               {"mortal", "<> [] not"},
                                               {"GF", "G F"},
                                               {"FG", "F G"}};
  for (const auto& [word, instead] : kRewrites) {
    if (!in.at_keyword(word) || !in.starts_operand(1)) continue;
    return in.error(
        "BT1201", in.here(),
        fmt::format("`{}` cannot stand inside a formula", in.peek().text),
        "only at the start of a property",
        fmt::format("write `{}` here", instead));
  }
  return true;
}

// Refuses an operator, a keyword, or nothing at all.
bool require_start(PropertyParser& in) {
  const Token& token = in.peek();
  if (token.kind == TokenKind::Identifier && in.continues_name() &&
      (!is_leaf(token.operation) || token.text == "T")) {
    return in.error("BT1221", token.span,
                    fmt::format("`{}` is an operator, not a name", token.text),
                    {},
                    fmt::format("write a name that looks like it in double "
                                "quotes: `\"{}\"`",
                                token.text));
  }
  if (token.kind == TokenKind::Minus && in.at(TokenKind::Number, 1)) {
    return true;
  }
  if (at_calculation(in)) return true;
  if (in.starts_operand()) return refuse_nested_word(in);
  return in.unexpected("a condition is missing", "expected a condition here");
}

std::optional<Phrase> read_constant(PropertyParser& in) {
  const bool is_true =
      in.at_keyword("true") || (in.at_keyword("T") && in.peek().text == "T");
  const bool is_f = in.at_keyword("F") && in.peek().text == "F";
  if (!is_true && !is_f && !in.at_keyword("false")) return std::nullopt;
  if (is_f) {
    in.warn("BT1206", in.here(), "`F` is read as the constant false here",
            "no condition follows that could eventually hold", "write `false`");
  }
  const std::size_t first = in.position();
  in.take();
  return Phrase{.id = in.formulas().constant(is_true),
                .first = first,
                .end = in.position()};
}

// tick, dead, stuck, or the name of a let.
std::optional<Phrase> read_bare_word(PropertyParser& in) {
  if (!in.at_name() || in.scope || in.continues_name()) return std::nullopt;
  const std::size_t first = in.position();
  const Token& token = in.peek();
  const auto let = in.definitions.find(std::string(token.text));
  if (let != in.definitions.end()) {
    in.take();
    in.used_atoms.insert(let->second.atoms.begin(), let->second.atoms.end());
    return Phrase{.id = let->second.formula,
                  .size = let->second.size,
                  .first = first,
                  .end = in.position()};
  }
  for (const char* const word : {"tick", "dead", "stuck"}) {
    if (!in.accept_word(word)) continue;
    return finish_atom(
        in, first,
        {.kind = AtomKind::Keyword, .word = word, .word_span = token.span});
  }
  return std::nullopt;
}

}  // namespace

bool at_calculation(const PropertyParser& in) {
  if (!in.at(TokenKind::LeftParen)) return false;
  std::size_t open = 0;
  for (std::size_t ahead = 0;; ++ahead) {
    const TokenKind kind = in.peek(ahead).kind;
    if (kind == TokenKind::End || kind == TokenKind::Operator) return false;
    if (kind == TokenKind::LeftParen) ++open;
    if (kind != TokenKind::RightParen || --open > 0) continue;
    const TokenKind next = in.peek(ahead + 1).kind;
    return next == TokenKind::Relation || next == TokenKind::Plus ||
           next == TokenKind::Minus || next == TokenKind::Times ||
           in.at_word("in", ahead + 1);
  }
}

std::optional<std::int32_t> read_number(PropertyParser& in) {
  const std::size_t first = in.position();
  const bool is_negative = in.accept(TokenKind::Minus);
  if (!in.at(TokenKind::Number)) {
    return in.unexpected("a number is missing", "expected a number");
  }
  const std::string_view digits = in.take().text;
  std::int64_t value = 0;
  const auto [end, status] =
      std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (is_negative) value = -value;
  using Int32 = std::numeric_limits<std::int32_t>;
  if (status != std::errc() || value < Int32::min() || value > Int32::max()) {
    return in.error("BT1209", in.span(first, in.position()),
                    "this number is out of range", {},
                    "numbers lie between -2147483648 and 2147483647");
  }
  return static_cast<std::int32_t>(value);
}

std::optional<Phrase> read_atom(PropertyParser& in) {
  if (const auto constant = read_constant(in)) return constant;
  if (!require_start(in)) return std::nullopt;
  if (at_event(in)) return read_event(in);
  if (const auto word = read_bare_word(in)) return word;
  const auto side = read_side(in);
  if (!side) return std::nullopt;
  if (in.at(TokenKind::Relation)) return read_comparison(in, *side);
  if (in.at_word("in")) return read_range(in, *side);
  if (side->operand.calculation != Arithmetic::None) {
    if (in.at(TokenKind::Unknown)) return std::nullopt;
    return in.error(
        "BT1212", side->operand.span, "a calculation alone is not a condition",
        "what about it?",
        "compare it: `x + y > 3`; a name with `-` in it is written in double "
        "quotes");
  }
  if (side->operand.is_number) {
    return in.unexpected("a number is no condition", "expected a comparison",
                         "compare a variable with it");
  }
  const bool is_event =
      !side->operand.node.empty() && !side->operand.name.empty() && !in.scope;
  if (is_event) return read_node_event(in, *side);
  return fail_alone(in, *side);
}

}  // namespace btcheck
