// SPDX-License-Identifier: MIT
//
// Operators: precedence parsing with two stacks, after Dijkstra's shunting
// yard, so that nothing recurses on the depth of a formula.
//
// Unary operators bind tightest, then and, or, implication, equivalence. frac,
// selt, SPIN and Spot group U, W, R and chains of => in different ways, so such
// a text is read to its end, then refused with both readings. To know them,
// every finished operand remembers its outermost operator unless parentheses
// close it off. The same memory finds `[] P => Q`, which all tools read as
// `([] P) => Q` and most authors do not.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "ltl/rules/parser.hpp"

namespace btcheck {
namespace {

// How tightly an infix operator binds. U, W and R get a place, but never in a
// formula that is accepted.
std::ptrdiff_t binding(FormulaKind kind) {
  using enum FormulaKind;
  static constexpr std::array kLoosestFirst = {Equivalent, Implies, Or, And};
  return std::ranges::find(kLoosestFirst, kind) - kLoosestFirst.begin() + 1;
}

// Tools disagree on `a inner b outer c` without parentheses.
bool is_disputed(FormulaKind outer, FormulaKind inner) {
  return is_temporal(outer) || is_temporal(inner) ||
         (outer == FormulaKind::Implies && inner == FormulaKind::Implies);
}

// A BracketGroup is the `[p U q]` behind a path quantifier.
enum class Role : std::uint8_t {
  Group,
  BracketGroup,
  ValueGroup,
  Prefix,
  Infix
};

struct Waiting {
  Role role = Role::Group;
  FormulaKind kind = FormulaKind::True;
  std::size_t token = 0;
};

// AG, EF, …: the quantifier and the operator in one word.
struct PathPrefix {
  FormulaKind quantifier = FormulaKind::ForAllPaths;
  FormulaKind kind = FormulaKind::Always;
};

FormulaKind quantifier_of(char letter) {
  return letter == 'A' ? FormulaKind::ForAllPaths : FormulaKind::ExistsPath;
}

std::optional<PathPrefix> path_prefix_here(const PropertyParser& in) {
  const std::string_view text = in.peek().text;
  if (!in.at(TokenKind::Identifier) || text.size() != 2 ||
      in.continues_name() || !in.starts_operand(1) ||
      (text[0] != 'A' && text[0] != 'E')) {
    return std::nullopt;
  }
  const FormulaKind kind = operation_of(text.substr(1));
  if (!is_unary(kind)) return std::nullopt;
  return PathPrefix{quantifier_of(text[0]), kind};
}

// The A or E of `A [p U q]`.
std::optional<FormulaKind> path_quantifier_here(const PropertyParser& in) {
  const std::string_view text = in.peek().text;
  const TokenKind next = in.peek(1).kind;
  if (!in.at(TokenKind::Identifier) || (text != "A" && text != "E") ||
      (next != TokenKind::LeftBracket && next != TokenKind::LeftParen)) {
    return std::nullopt;
  }
  return quantifier_of(text[0]);
}

class FormulaReader {
 public:
  explicit FormulaReader(PropertyParser& in) : in_(in) { in_.scope.reset(); }

  // A single operand ends with its atom, or with its last parenthesis.
  std::optional<Phrase> read(bool is_single) {
    for (;;) {
      if (!read_operand() || !close_groups()) return std::nullopt;
      const bool is_whole = is_single && groups_ == 0;
      while (!is_whole && in_.at_word("since")) {
        if (!add_since() || !close_groups()) return std::nullopt;
      }
      const auto infix = in_.infix_here();
      const bool is_stop_word =
          !in_.stop_word.empty() && in_.at_word(in_.stop_word);
      const bool is_stopped = groups_ == 0 && (is_single || is_stop_word);
      if (!infix || is_stopped) return finish();
      if (!allow(*infix) || !reduce_down_to(binding(*infix))) {
        return std::nullopt;
      }
      waiting_.push_back({Role::Infix, *infix, in_.position()});
      in_.take();
    }
  }

 private:
  // Everything up to the end of one atom.
  bool read_operand() {
    for (;;) {
      const std::size_t token = in_.position();
      if (in_.at(TokenKind::LeftParen) && !at_calculation(in_)) {
        if (!open(Role::Group, FormulaKind::True, token)) return false;
        in_.take();
      } else if (const auto path = path_prefix_here(in_)) {
        if (!open_path_prefix(*path)) return false;
      } else if (const auto quantifier = path_quantifier_here(in_)) {
        if (!open_path_group(*quantifier)) return false;
      } else if (is_prefix()) {
        const FormulaKind kind = in_.peek().operation;
        if (!allow(kind) || !open(Role::Prefix, kind, token)) return false;
        note_next(kind);
        in_.take();
      } else if (!in_.scope && (in_.scope = read_value_opening(in_))) {
        if (!open(Role::ValueGroup, FormulaKind::True, token)) return false;
      } else {
        break;
      }
    }
    const auto atom = read_atom(in_);
    if (!atom) return false;
    operands_.push_back(*atom);
    apply_prefixes();
    return true;
  }

  // AG, EF and so on.
  bool open_path_prefix(const PathPrefix& path) {
    const std::size_t token = in_.position();
    note_next(path.kind);
    in_.take();
    return allow_path(token) && open(Role::Prefix, path.quantifier, token) &&
           open(Role::Prefix, path.kind, token);
  }

  // The A and the bracket of `A [p U q]`.
  bool open_path_group(FormulaKind quantifier) {
    const std::size_t token = in_.position();
    in_.take();
    const Role group =
        in_.at(TokenKind::LeftBracket) ? Role::BracketGroup : Role::Group;
    in_.take();
    return allow_path(token) && open(Role::Prefix, quantifier, token) &&
           open(group, FormulaKind::True, token + 1);
  }

  void note_next(FormulaKind kind) {
    if (kind != FormulaKind::Next) return;
    in_.first_next = std::min(in_.first_next, in_.position());
  }

  bool open(Role role, FormulaKind kind, std::size_t token) {
    if (nesting_ == kMaxNesting) {
      return in_.error(
          "BT1210", in_.token(token).span,
          fmt::format("this is nested more than {} deep", kMaxNesting), {},
          "name a part of it with `let`");
    }
    ++nesting_;
    groups_ += role != Role::Prefix;
    waiting_.push_back({role, kind, token});
    return true;
  }

  // A unary operator, not the sign of a number, a name or the constant F.
  bool is_prefix() const {
    if (!is_unary(in_.peek().operation)) return false;
    if (in_.at(TokenKind::Minus)) return !in_.at(TokenKind::Number, 1);
    if (!in_.at(TokenKind::Identifier)) return true;
    if (in_.continues_name()) return false;
    return !in_.at_word("F") || in_.starts_operand(1);
  }

  bool allow(FormulaKind kind) {
    return !is_temporal(kind) || allow_path(in_.position());
  }

  // A temporal operator, outside of `value (...)`.
  bool allow_path(std::size_t token) {
    if (!in_.scope) return true;
    return in_.error("BT1214", in_.token(token).span,
                     fmt::format("`{}` cannot stand inside `value (...)`",
                                 in_.token(token).text),
                     "a value belongs to one state",
                     "write it in front of the process path");
  }

  // `P since Q` of two operands; beside `and` it needs parentheses, as `until`
  // does.
  bool add_since() {
    Phrase& held = operands_.back();
    const bool is_beside =
        !waiting_.empty() && waiting_.back().role == Role::Infix;
    const SourceSpan span = in_.here();
    if (in_.scope) return allow_path(in_.position());
    const auto since = read_since(in_, held);
    if (!since) return false;
    if (is_beside || in_.infix_here() || in_.at_word("since")) {
      return in_.error("BT1205", span,
                       "`since` beside another operator needs parentheses",
                       "tools disagree on what this means",
                       fmt::format("write `({})`", in_.text(*since)));
    }
    held = *since;
    return true;
  }

  bool close_groups() {
    while (groups_ > 0 &&
           (in_.at(TokenKind::RightParen) || in_.at(TokenKind::RightBracket))) {
      if (!reduce_down_to(0)) return false;
      const Waiting group = waiting_.back();
      const bool wants_bracket = group.role == Role::BracketGroup;
      if (wants_bracket != in_.at(TokenKind::RightBracket)) break;
      waiting_.pop_back();
      in_.take();
      --groups_;
      --nesting_;
      if (group.role == Role::ValueGroup) in_.scope.reset();
      Phrase& phrase = operands_.back();
      phrase.first = group.token;
      phrase.end = in_.position();
      phrase.join = phrase.always = kNoToken;
      apply_prefixes();
    }
    return true;
  }

  void apply_prefixes() {
    Phrase& phrase = operands_.back();
    while (!waiting_.empty() && waiting_.back().role == Role::Prefix) {
      const Waiting prefix = waiting_.back();
      waiting_.pop_back();
      --nesting_;
      const bool is_always = prefix.kind == FormulaKind::Always;
      phrase.id = in_.formulas().unary(prefix.kind, phrase.id);
      ++phrase.size;
      phrase.first = prefix.token;
      // AG is read as A in front of G, at one token, and covers the same.
      const bool is_same_word =
          is_path_quantifier(prefix.kind) && phrase.always == prefix.token;
      if (!is_same_word) {
        phrase.always = is_always ? prefix.token : kNoToken;
        phrase.always_end = phrase.end;
      }
      if (is_temporal(prefix.kind)) phrase.temporal = prefix.token;
    }
  }

  // Joins what binds at least as tightly as `level` within the open group.
  bool reduce_down_to(std::ptrdiff_t level) {
    while (!waiting_.empty() && waiting_.back().role == Role::Infix &&
           binding(waiting_.back().kind) >= level) {
      if (!reduce()) return false;
    }
    return true;
  }

  bool reduce() {
    const Waiting infix = waiting_.back();
    waiting_.pop_back();
    const Phrase right = operands_.back();
    operands_.pop_back();
    Phrase& left = operands_.back();
    if (!refuse_mix(left, infix.token, infix.kind, right)) return false;
    if (infix.kind == FormulaKind::Implies ||
        infix.kind == FormulaKind::Equivalent) {
      warn_of_precedence(left, infix.token, right);
    }
    if (left.size + right.size >= kMaxFormulaSize) {
      return in_.error("BT1210", in_.token(infix.token).span,
                       fmt::format("this formula has more than {} operators",
                                   kMaxFormulaSize),
                       "counted with every `let` written out",
                       "split it into several properties");
    }
    left.id = in_.formulas().binary(infix.kind, left.id, right.id);
    left.size += right.size + 1;
    left.end = right.end;
    left.join = infix.token;
    left.joined_by = infix.kind;
    const std::size_t own = is_temporal(infix.kind) ? infix.token : kNoToken;
    left.temporal = std::min({left.temporal, right.temporal, own});
    return true;
  }

  // An error when `left kind right` has a second reading; the text in order is
  // `first op1 second op2 third`.
  bool refuse_mix(const Phrase& left, std::size_t token, FormulaKind kind,
                  const Phrase& right) {
    const bool on_left =
        left.join != kNoToken && is_disputed(kind, left.joined_by);
    const bool on_right =
        right.join != kNoToken && is_disputed(kind, right.joined_by);
    if (!on_left && !on_right) return true;
    const std::size_t op1 = on_left ? left.join : token;
    const std::size_t op2 = on_left ? token : right.join;
    constexpr std::size_t kShown = 40;
    const std::string first = in_.text(left.first, op1, kShown);
    const std::string second = in_.text(op1 + 1, op2, kShown);
    const std::string third = in_.text(op2 + 1, right.end, kShown);
    const std::string_view word1 = in_.token(op1).text;
    const std::string_view word2 = in_.token(op2).text;
    return in_.error(
        "BT1205", in_.token(op2).span,
        word1 == word2
            ? fmt::format("a chain of `{}` needs parentheses", word1)
            : fmt::format("`{}` and `{}` need parentheses", word1, word2),
        "tools disagree on what this means",
        fmt::format("write `({0} {1} {2}) {3} {4}` or `{0} {1} ({2} {3} {4})`",
                    first, word1, second, word2, third));
  }

  // `[] P => Q`. The fairness shape `[] <> P => [] <> Q` means what it says.
  void warn_of_precedence(const Phrase& left, std::size_t token,
                          const Phrase& right) {
    if (left.always == kNoToken) return;
    const FormulaNode& node = in_.formulas()[left.id];
    const bool is_fairness =
        node.kind == FormulaKind::Always &&
        in_.formulas()[node.left].kind == FormulaKind::Eventually;
    if (is_fairness) return;
    in_.is_warned_of_reach = true;
    const std::string_view always = in_.token(left.always).text;
    const std::string_view arrow = in_.token(token).text;
    in_.warn(
        "BT1203", in_.span(left.always, left.always_end),
        fmt::format("`{}` does not cover the `{}` behind it", always, arrow),
        "all that it covers",
        fmt::format("write `{0} ({1} {2} {3})` to cover it,\n"
                    "or `({4}) {2} {3}` to keep this reading",
                    always, in_.text(left.always + 1, left.end, kShownText),
                    arrow, in_.text(right), in_.text(left)));
  }

  std::optional<Phrase> finish() {
    if (!reduce_down_to(0)) return std::nullopt;
    if (waiting_.empty()) return operands_.back();
    const Token& next = in_.peek();
    if (in_.at_item_end() || ends_operand(next.text)) {
      in_.error("BT1201", in_.token(waiting_.back().token).span,
                "this parenthesis is never closed",
                in_.at_end() ? "the file ends before its `)`"
                             : fmt::format("no `)` before `{}`", next.text));
    } else {
      refuse_leftover(in_);
    }
    return std::nullopt;
  }

  PropertyParser& in_;
  std::vector<Phrase> operands_;
  std::vector<Waiting> waiting_;
  std::size_t nesting_ = 0;  // how many of waiting_ are not infix
  std::size_t groups_ = 0;
};

}  // namespace

std::optional<Phrase> read_formula(PropertyParser& in) {
  return FormulaReader(in).read(false);
}

std::optional<Phrase> read_single_operand(PropertyParser& in) {
  return FormulaReader(in).read(true);
}

}  // namespace btcheck
