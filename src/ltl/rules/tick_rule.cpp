// SPDX-License-Identifier: MIT
//
// Rules about whole ticks are rules about single states, those in which a tick
// ends: there every node that was asked has its answer, and time has not passed
// yet.
#include <fmt/format.h>

#include <utility>

#include "ltl/rules/parser.hpp"

namespace btcheck {
namespace {

constexpr std::string_view kTickEnds = "tick.ends";

// `every tick`, `no tick`, `some tick`; not a name with `tick nodes` below it.
std::optional<TickWords> ticks_at(const PropertyParser& in, std::size_t ahead) {
  constexpr std::pair<std::string_view, TickWords> kWords[] = {
      {"every", TickWords::Every},
      {"no", TickWords::No},
      {"some", TickWords::Some}};
  const bool is_tick =
      in.at_word("tick", ahead + 1) && (!in.peek(ahead + 1).is_first_on_line ||
                                        in.at(TokenKind::Colon, ahead + 2));
  if (!is_tick) return std::nullopt;
  for (const auto& [word, ticks] : kWords) {
    if (in.at_word(word, ahead)) return ticks;
  }
  return std::nullopt;
}

Atom tick_end() {
  return {.kind = AtomKind::Keyword, .word = std::string(kTickEnds)};
}

}  // namespace

bool at_ticks(const PropertyParser& in, std::size_t ahead) {
  return in.at_word("in", ahead) && ticks_at(in, ahead + 1);
}

std::optional<TickWords> read_tick_words(PropertyParser& in) {
  const std::size_t preposition = in.at_word("in") ? 1 : 0;
  const auto ticks = ticks_at(in, preposition);
  if (!ticks || (preposition == 0 && *ticks != TickWords::Every)) {
    return std::nullopt;
  }
  for (std::size_t i = 0; i < preposition + 2; ++i) in.take();
  return ticks;
}

FormulaId at_tick_ends(PropertyParser& in, TickWords ticks, SourceSpan words,
                       FormulaId condition) {
  Atom atom = tick_end();
  atom.text = kTickEnds;
  atom.span = words;
  const std::uint32_t number = in.number_of(std::move(atom));
  in.used_atoms.insert(number);
  FormulaPool& pool = in.formulas();
  const FormulaId end = pool.atom(number);
  if (ticks != TickWords::Every) {
    return pool.binary(FormulaKind::And, end, condition);
  }
  // `P => Q` is asked where P holds.
  const FormulaNode asked = pool[condition];
  if (asked.kind != FormulaKind::Implies) {
    return pool.binary(FormulaKind::Implies, end, condition);
  }
  return pool.binary(FormulaKind::Implies,
                     pool.binary(FormulaKind::And, end, asked.left),
                     asked.right);
}

bool at_tick_end(const PropertyParser& in) {
  return in.at_word("tick") && in.at(TokenKind::Dot, 1) &&
         in.at_word("ends", 2);
}

std::optional<Phrase> read_tick_end(PropertyParser& in) {
  const std::size_t first = in.position();
  for (int i = 0; i < 3; ++i) in.take();
  return finish_atom(in, first, tick_end());
}

std::optional<Phrase> read_answered(PropertyParser& in, const Side& side) {
  if (!in.at_name() || in.at_item()) {
    return in.unexpected(
        "what was answered is missing",
        "expected `success`, `failure` and so on",
        fmt::format("write `{} success`", in.text(side.first, side.end)));
  }
  Atom atom{.kind = AtomKind::Comparison, .left = side.operand};
  atom.left.name = "answer";
  atom.right.name = in.peek().text;
  atom.right.span = in.here();
  in.take();
  return finish_atom(in, side.first, std::move(atom));
}

}  // namespace btcheck
