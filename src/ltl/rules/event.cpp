// SPDX-License-Identifier: MIT
//
// Conditions on what a process is doing, and on steps.
//
// The paper names a process by its component and its number there:
// `drone/5/state done`, and compares in `drone/5/value (battery = Low)`. The
// other spelling names a node and one of its events, `land@23.ticked`.
// `enter P`, `leave P`, `.moves` and `time.passes` are true of a step, not of a
// state: their phrases count as temporal, so that no property of single states
// can use them. `once P`, `P since Q` and `previously P` are conditions on
// states, which remember.
#include <fmt/format.h>

#include <charconv>

#include "ltl/rules/parser.hpp"

namespace btcheck {
namespace {

// drone/5/
bool at_process_path(const PropertyParser& in) {
  return in.at_name() && in.at(TokenKind::Slash, 1) &&
         in.at(TokenKind::Number, 2) && in.at(TokenKind::Slash, 3);
}

// enter P, leave P
bool at_step_condition(const PropertyParser& in) {
  return in.starts_operand(1) &&
         (in.at_keyword("enter") || in.at_keyword("leave"));
}

// once P, previously P
bool at_past_condition(const PropertyParser& in) {
  return in.starts_operand(1) &&
         (in.at_keyword("once") || in.at_keyword("previously"));
}

bool at_time_passes(const PropertyParser& in) {
  return in.at_word("time") && in.at(TokenKind::Dot, 1) &&
         in.at_word("passes", 2);
}

std::optional<Phrase> read_step_condition(PropertyParser& in) {
  const std::size_t first = in.position();
  const Token& word = in.take();
  if (in.is_inside_event) {
    return in.error("BT1214", word.span,
                    fmt::format("`{}` inside `enter` or `leave`", word.text),
                    "these take a condition on single states");
  }
  in.is_inside_event = true;
  const auto of = read_single_operand(in);
  in.is_inside_event = false;
  if (!of || !require_state_predicate(in, *of, fmt::format("`{}`", word.text),
                                      "write the formula out")) {
    return std::nullopt;
  }
  const bool is_enter = equal_ignoring_case(word.text, "enter");
  return finish_atom(
      in, first,
      {.kind = is_enter ? AtomKind::Enter : AtomKind::Leave, .of = of->id});
}

// What `once`, `previously` or `since`, at this token, takes.
std::optional<Phrase> read_past_operand(PropertyParser& in, const Token& word) {
  constexpr std::size_t kMostInside = 20;
  if (in.past_depth == kMostInside) {
    return in.error("BT1210", word.span,
                    fmt::format("more than {} operators of the past inside "
                                "each other",
                                kMostInside),
                    {}, "name a part of it with `let`");
  }
  ++in.past_depth;
  auto of = read_single_operand(in);
  --in.past_depth;
  const bool is_state =
      of && require_state_predicate(
                in, *of, fmt::format("`{}`", word.text),
                "the past is a memory of single states; write `<> (... once "
                "...)` the other way round");
  return is_state ? of : std::nullopt;
}

std::optional<Phrase> read_past_condition(PropertyParser& in) {
  const std::size_t first = in.position();
  const Token& word = in.take();
  const auto of = read_past_operand(in, word);
  if (!of) return std::nullopt;
  const bool is_once = equal_ignoring_case(word.text, "once");
  return finish_atom(
      in, first,
      {.kind = is_once ? AtomKind::Once : AtomKind::Previously, .of = of->id});
}

// The `state` of `drone/5/state done`, whose path begins at token `first`.
bool read_state_word(PropertyParser& in, std::size_t first) {
  if (in.scope) {
    return in.error("BT1201", in.span(first, first + 4),
                    "inside `value (...)` only comparisons can stand", {},
                    "close the parenthesis before it");
  }
  if (in.accept_word("state")) return true;
  if (in.at_word("value")) {
    return in.error("BT1201", in.here(),
                    "`value` takes a comparison in parentheses", {},
                    "write `value (battery = Low)`");
  }
  if (in.at_word("tag") || in.at_word("event")) {
    return in.error(
        "BT1224", in.here(),
        fmt::format("behavior trees have no `/{}`", in.peek().text),
        "their automata have neither ports nor tags",
        "name the state that is entered: `enter (drone/5/state done)`");
  }
  return in.unexpected("a process has a `state` and a `value`",
                       "neither of the two",
                       "write `drone/5/state done` or "
                       "`drone/5/value (battery = Low)`");
}

// drone/5/state done. (`value` with its parenthesis never comes here.)
std::optional<Phrase> read_process_path(PropertyParser& in) {
  const std::size_t first = in.position();
  Atom atom;
  atom.kind = AtomKind::ProcessState;
  atom.component = in.take().text;
  in.take();
  atom.process = read_number(in);
  if (!atom.process) return std::nullopt;
  atom.node_span = in.span(first, in.position());
  in.take();
  if (!read_state_word(in, first)) return std::nullopt;
  if (!in.at_name() && !in.at(TokenKind::Number)) {
    return in.unexpected("the name of a state is missing",
                         "expected a state of the process",
                         "write `state tick_node`, `state done` and so on");
  }
  atom.word = in.peek().text;
  atom.word_span = in.here();
  in.take();
  return finish_atom(in, first, std::move(atom));
}

// The event of a node that a word names, in lower case, or "".
std::string event_of(std::string_view word) {
  for (const char* const event :
       {"ticked", "success", "failure", "running", "halted", "done", "active",
        "ended", "moves", "skipped"}) {
    if (equal_ignoring_case(word, event)) return event;
  }
  return "";
}

std::string event_help(std::string_view word) {
  static const std::vector<std::string> kEvents = {
      "ticked", "success", "failure", "running", "halted", "done",
      "active", "ended",   "status",  "moves",   "answer", "answered"};
  if (equal_ignoring_case(word, "tick_node")) return "write `.ticked`";
  return did_you_mean(word, kEvents,
                      "events are .ticked, .success, .failure, .running, "
                      ".halted, .done and .active");
}

// drone/8.ticked
void name_process(const PropertyParser& in, Atom& atom, const Side& side) {
  const bool is_process = side.node_end == side.first + 3 &&
                          in.token(side.first + 1).kind == TokenKind::Slash &&
                          in.token(side.first + 2).kind == TokenKind::Number;
  if (!is_process) return;
  const std::string_view digits = in.token(side.first + 2).text;
  std::int32_t number = 0;
  const auto [end, status] =
      std::from_chars(digits.data(), digits.data() + digits.size(), number);
  if (status != std::errc()) return;
  atom.component = in.token(side.first).text;
  atom.process = number;
}

}  // namespace

bool at_event(const PropertyParser& in) {
  return at_process_path(in) ||
         (!in.scope && (at_step_condition(in) || at_past_condition(in) ||
                        at_time_passes(in) || at_tick_end(in)));
}

std::optional<Phrase> read_event(PropertyParser& in) {
  if (at_process_path(in)) return read_process_path(in);
  if (at_step_condition(in)) return read_step_condition(in);
  if (at_past_condition(in)) return read_past_condition(in);
  if (at_tick_end(in)) return read_tick_end(in);
  const std::size_t first = in.position();
  for (int i = 0; i < 3; ++i) in.take();
  return finish_atom(in, first, {.kind = AtomKind::Passes});
}

std::optional<Phrase> read_since(PropertyParser& in, const Phrase& held) {
  const Token& word = in.take();
  if (!require_state_predicate(in, held, "`since`",
                               "the past is a memory of single states")) {
    return std::nullopt;
  }
  const auto began = read_past_operand(in, word);
  if (!began) return std::nullopt;
  return finish_atom(
      in, held.first,
      {.kind = AtomKind::Since, .of = held.id, .since = began->id});
}

std::optional<Phrase> read_node_event(PropertyParser& in, const Side& side) {
  const Token& word = in.token(side.end - 1);
  if (equal_ignoring_case(word.text, "answered")) {
    return read_answered(in, side);
  }
  if (side.operand.name == "status" ||
      equal_ignoring_case(word.text, "answer")) {
    return in.error(
        "BT1213", word.span, fmt::format("`.{}` has to be compared", word.text),
        {},
        fmt::format("write `{} == success`", in.text(side.first, side.end)));
  }
  Atom atom;
  atom.word = event_of(word.text);
  if (atom.word.empty()) {
    return in.error("BT1213", word.span,
                    fmt::format("`{}` is not an event", word.text),
                    "a node has no such event", event_help(word.text));
  }
  atom.kind = atom.word == "moves" ? AtomKind::Moves : AtomKind::NodeEvent;
  atom.node = side.operand.node;
  name_process(in, atom, side);
  atom.node_span = in.span(side.first, side.node_end);
  atom.word_span = word.span;
  return finish_atom(in, side.first, std::move(atom));
}

std::optional<ProcessScope> read_value_opening(PropertyParser& in) {
  const bool is_here = at_process_path(in) && in.peek(2).text.size() < 10 &&
                       in.at_word("value", 4) && in.at(TokenKind::LeftParen, 5);
  if (!is_here) return std::nullopt;
  const std::size_t first = in.position();
  ProcessScope scope;
  scope.component = in.take().text;
  in.take();
  scope.process = read_number(in).value_or(0);  // nine digits are in range
  in.take();
  in.take();
  scope.text = in.text(first, in.position());
  in.take();
  return scope;
}

Phrase finish_atom(PropertyParser& in, std::size_t first, Atom atom) {
  atom.span = in.span(first, in.position());
  atom.text = in.text(first, in.position());
  if (atom.kind == AtomKind::Since) atom.text = "(" + atom.text + ")";
  if (in.scope) {
    atom.component = in.scope->component;
    atom.process = in.scope->process;
    atom.text = fmt::format("{} ({})", in.scope->text, atom.text);
  }
  const bool is_event = is_step_event(atom.kind);
  const std::uint32_t number = in.number_of(std::move(atom));
  in.used_atoms.insert(number);
  return {.id = in.formulas().atom(number),
          .first = first,
          .end = in.position(),
          .temporal = is_event ? first : kNoToken};
}

}  // namespace btcheck
