// SPDX-License-Identifier: MIT
//
// Conditions on what a process is doing, and on steps.
//
// The paper names a process by its component and its number there:
// `drone/5/state done`. The other spelling names a node and one of its events,
// `land@23.ticked`. `enter P`, `leave P`, `.moves` and `time.passes` are true
// of a step, not of a state: their phrases count as temporal, so that nobody
// asks them of a single state (see is_step_event). Which process or node is
// meant is looked up when the property is bound to a tree.
#include <fmt/format.h>

#include <array>
#include <charconv>

#include "ltl/rules/parser.hpp"

namespace btcheck {
namespace {

constexpr std::array<std::string_view, 10> kEvents = {
    "ticked", "success", "failure", "running", "halted",
    "done",   "active",  "ended",   "moves",   "skipped"};

std::string event_help(std::string_view word) {
  static const std::vector<std::string> events = {
      "ticked", "success", "failure", "running", "halted",
      "done",   "active",  "ended",   "status",  "moves"};
  if (equal_ignoring_case(word, "tick_node")) return "write `.ticked`";
  return suggestion(word, events,
                    "events are .ticked, .success, .failure, .running, "
                    ".halted, .done and .active");
}

// Events that do not begin with the reference to a node.
class EventReader {
 public:
  EventReader(PropertyParser& in, const ProcessScope* scope)
      : in_(in), scope_(scope), first_(in.position()) {}

  std::optional<Phrase> read();

 private:
  std::optional<Phrase> read_step_condition();
  std::optional<Phrase> read_time_passes();
  std::optional<Phrase> read_process_path();
  bool check_process_path(std::size_t what);
  Phrase finish(Atom atom) const;

  PropertyParser& in_;
  const ProcessScope* scope_;
  std::size_t first_;
};

bool at_process_path(const PropertyParser& in) {
  return is_name(in.peek()) && in.peek(1).kind == TokenKind::Slash &&
         in.peek(2).kind == TokenKind::Number &&
         in.peek(3).kind == TokenKind::Slash;
}

// enter P, leave P
bool at_step_condition(const PropertyParser& in) {
  return in.starts_operand(1) &&
         (in.at_keyword("enter") || in.at_keyword("leave"));
}

bool at_time_passes(const PropertyParser& in) {
  return in.at_word("time") && in.peek(1).kind == TokenKind::Dot &&
         in.at_word("passes", 2);
}

std::optional<Phrase> EventReader::read() {
  if (at_process_path(in_)) return read_process_path();
  if (at_step_condition(in_)) return read_step_condition();
  return read_time_passes();
}

std::optional<Phrase> EventReader::read_step_condition() {
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

std::optional<Phrase> EventReader::read_time_passes() {
  for (int i = 0; i < 3; ++i) in_.take();
  Atom atom;
  atom.kind = AtomKind::Passes;
  return finish(std::move(atom));
}

// drone/5/state done. (`value` with its parenthesis never comes here.)
std::optional<Phrase> EventReader::read_process_path() {
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

bool EventReader::check_process_path(std::size_t what) {
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

Phrase EventReader::finish(Atom atom) const {
  return finish_atom(in_, scope_, first_, std::move(atom));
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

bool at_event(const PropertyParser& in, const ProcessScope* scope) {
  return at_process_path(in) ||
         (scope == nullptr && (at_step_condition(in) || at_time_passes(in)));
}

std::optional<Phrase> read_event(PropertyParser& in,
                                 const ProcessScope* scope) {
  return EventReader(in, scope).read();
}

std::optional<Phrase> read_node_event(PropertyParser& in, const Side& side) {
  const std::size_t last = side.end - 1;
  const Token& word = in.token(last);
  const auto event = entry_of(kEvents, word.text);
  if (side.operand.name == "status") {
    in.error(
        "BT1213", word.span, fmt::format("`.{}` has to be compared", word.text),
        {},
        fmt::format("write `{} == success`", in.text(side.first, side.end)));
    return std::nullopt;
  }
  if (!event) {
    in.error("BT1213", word.span,
             fmt::format("`{}` is not an event", word.text),
             "a node has no such event", event_help(word.text));
    return std::nullopt;
  }
  Atom atom;
  atom.kind = *event == "moves" ? AtomKind::Moves : AtomKind::NodeEvent;
  atom.node = side.operand.node;
  atom.word = *event;
  name_process(in, atom, side);
  atom.node_span = in.span(side.first, side.node_end);
  atom.word_span = word.span;
  return finish_atom(in, nullptr, side.first, std::move(atom));
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
