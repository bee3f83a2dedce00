// SPDX-License-Identifier: MIT
//
// The two sides of a comparison, and the names of nodes.
//
// A reference is names joined by `/`, then perhaps `@` and a line, then perhaps
// `.` and a word: `battery`, `land@23.ticked`, `fail/land.status`, `drone/8`.
// The paper's `btnode[x].rstatus` is the same as `x.status`; `self` in it is
// the process whose `value (...)` it stands in. A reference is kept as written,
// without quotes: which node it means is for somebody who knows the tree.
#include <fmt/format.h>

#include <charconv>
#include <limits>

#include "ltl/rules/parser.hpp"

namespace btcheck {
namespace {

class OperandReader {
 public:
  OperandReader(PropertyParser& in, const ProcessScope* scope)
      : in_(in), scope_(scope) {}

  std::optional<Side> read_side();

 private:
  bool read_reference(Side& side);
  bool read_btnode(Side& side);
  bool read_line(std::string& node);
  bool read_member(Side& side);

  PropertyParser& in_;
  const ProcessScope* scope_;
};

std::optional<Side> OperandReader::read_side() {
  Side side;
  side.first = in_.position();
  if (in_.at(TokenKind::Number) || in_.at(TokenKind::Minus)) {
    const auto number = read_number(in_);
    if (!number) return std::nullopt;
    side.operand.is_number = true;
    side.operand.number = *number;
    side.node_end = side.first;
  } else if (!read_reference(side)) {
    return std::nullopt;
  }
  side.end = in_.position();
  side.operand.span = in_.span(side.first, side.end);
  return side;
}

bool OperandReader::read_reference(Side& side) {
  if (!is_name(in_.peek())) {
    return in_.unexpected("a name or a number is missing",
                          "expected what to compare with");
  }
  const TokenKind next = in_.peek(1).kind;
  if (in_.at_word("btnode") &&
      (next == TokenKind::LeftBracket || next == TokenKind::Always)) {
    return read_btnode(side);
  }
  std::string node(in_.take().text);
  bool is_node = false;
  while (in_.at(TokenKind::Slash) &&
         (is_name(in_.peek(1)) || in_.peek(1).kind == TokenKind::Number)) {
    in_.take();
    node += '/';
    node += in_.take().text;
    is_node = true;
  }
  if (in_.at(TokenKind::At)) {
    if (!read_line(node)) return false;
    is_node = true;
  }
  side.node_end = in_.position();
  if (in_.at(TokenKind::Dot)) is_node = true;
  (is_node ? side.operand.node : side.operand.name) = std::move(node);
  return !in_.at(TokenKind::Dot) || read_member(side);
}

bool OperandReader::read_line(std::string& node) {
  in_.take();
  if (!in_.at(TokenKind::Number)) {
    return in_.unexpected("a line number is missing",
                          "expected a number behind `@`",
                          "`land@23` is the node that line 23 of the tree "
                          "file declares");
  }
  const auto line = read_number(in_);
  if (!line) return false;
  node += fmt::format("@{}", *line);
  return true;
}

// btnode[localization_ok_btn18].rstatus
bool OperandReader::read_btnode(Side& side) {
  in_.take();
  in_.accept(TokenKind::LeftBracket);
  if (!is_name(in_.peek()) || in_.peek(1).kind != TokenKind::RightBracket) {
    return in_.unexpected("`btnode[...]` takes the name of one node",
                          "expected a name and `]`",
                          "write `btnode[takeoff].rstatus`");
  }
  // `self` is the process looked at: its own field, so no node is named.
  const bool is_self = scope_ != nullptr && in_.at_word("self");
  if (!is_self) side.operand.node = in_.peek().text;
  in_.take();
  in_.take();
  side.node_end = in_.position();
  if (!in_.at(TokenKind::Dot)) {
    return in_.unexpected("`btnode[...]` is a record", "expected `.rstatus`",
                          "write `btnode[takeoff].rstatus`");
  }
  if (!read_member(side)) return false;
  if (is_self) side.operand.name = "rstatus";
  return true;
}

bool OperandReader::read_member(Side& side) {
  in_.take();
  if (!is_name(in_.peek())) {
    return in_.unexpected("an event is missing",
                          "expected `ticked`, `success` and so on");
  }
  const std::string_view word = in_.take().text;
  const bool is_status = equal_ignoring_case(word, "rstatus") ||
                         equal_ignoring_case(word, "status");
  side.operand.name = is_status ? "status" : word;
  return true;
}

}  // namespace

bool is_name(const Token& token) {
  return token.kind == TokenKind::Word || token.kind == TokenKind::Quoted;
}

std::optional<Side> read_side(PropertyParser& in, const ProcessScope* scope) {
  return OperandReader(in, scope).read_side();
}

std::optional<std::int32_t> read_number(PropertyParser& in) {
  const std::size_t first = in.position();
  const bool is_negative = in.accept(TokenKind::Minus);
  if (!in.at(TokenKind::Number)) {
    in.unexpected("a number is missing", "expected a number");
    return std::nullopt;
  }
  const std::string_view digits = in.take().text;
  std::int64_t value = 0;
  const auto [end, status] =
      std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (is_negative) value = -value;
  using Limits = std::numeric_limits<std::int32_t>;
  if (status != std::errc() || value < Limits::min() || value > Limits::max()) {
    in.error("BT1209", in.span(first, in.position()),
             "this number is out of range", {},
             "numbers lie between -2147483648 and 2147483647");
    return std::nullopt;
  }
  return static_cast<std::int32_t>(value);
}

}  // namespace btcheck
