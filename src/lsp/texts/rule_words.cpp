// SPDX-License-Identifier: MIT
#include "lsp/texts/rule_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "ltl/rules/parser.hpp"

namespace btcheck::lsp {
namespace {

using Of = RuleWordKind;

constexpr auto kRuleWords = std::to_array<RuleHelp>({
    {"property", Of::Item, "`property NAME: BODY`, a rule with a name"},
    {"prove", Of::Item, "`prove BODY`, a rule without a name"},
    {"assert", Of::Item, "`assert NAME`, as the paper writes it"},
    {"let", Of::Item, "`let NAME = P`, a name for a condition"},
    {"expect", Of::Item,
     "`expect violated`: what the answer should be; without it, that it "
     "holds"},
    {"assume", Of::Item,
     "`assume F`: runs that do not satisfy F are not searched"},
    {"tree", Of::Item, "`tree \"drone3.btf\"`, the tree of these rules"},
    {"never", Of::Body, "`never P`: no reachable state satisfies P"},
    {"absent", Of::Body, "`absent P`: no reachable state satisfies P"},
    {"always", Of::Body, "`always P`: every reachable state satisfies P"},
    {"possible", Of::Body, "`possible P`: some run reaches P"},
    {"eventually", Of::Body, "`eventually F`: every run reaches F"},
    {"present", Of::Body, "`present F`: every run reaches F"},
    {"infinitelyOften", Of::Body,
     "`infinitelyOften F`: every run satisfies F again and again"},
    {"mortal", Of::Body,
     "`mortal F`: every run has had enough of F at some point"},
    {"whenever", Of::Body,
     "`whenever F then G`: each time F holds, G holds then or later; with "
     "`within N ticks` by then"},
    {"every", Of::Body, "`every tick: F`: F at the end of every tick"},
    {"in", Of::Body,
     "`in no tick: P`, `in some tick: P`: P where a tick ends; `x in 0..5`"},
    {"live", Of::Body, "`live P`: from every state P can still be reached"},
    {"deadlockfree", Of::Body, "`deadlockfree`: no reachable state is dead"},
    {"ltl", Of::Body, "`ltl F`: F holds on every run"},
    {"after", Of::Body, "`after Q`: from each Q on"},
    {"then", Of::Join, "`whenever F then G`"},
    {"leadsto", Of::Join,
     "`F leadsto G`: each time F holds, G holds then or later"},
    {"precedes", Of::Join, "`F precedes G`: there is no G before the first F"},
    {"requires", Of::Join, "`G requires F`: there is no G before the first F"},
    {"forbids", Of::Join, "`F forbids G`: after an F there is no G any more"},
    {"causes", Of::Join, "`F causes G`"},
    {"within", Of::Join,
     "`within 2 ticks`, `within [1,3] ticks`: no later, and no earlier"},
    {"for", Of::Join, "`for 3 ticks`: so long"},
    {"lasting", Of::Join, "`lasting 3 ticks`: when it has lasted so long"},
    {"before", Of::Join, "`before R`: up to the first R"},
    {"between", Of::Join,
     "`between Q and R`: from each Q up to the R that follows"},
    {"globally", Of::Join, "`globally`: on the whole run"},
    {"until", Of::Join, "`F until G`: G comes, and F holds until then"},
    {"release", Of::Join, "`F release G`"},
    {"since", Of::Join,
     "`P since Q`: Q held some time before, and P ever since"},
    {"and", Of::Join, "both"},
    {"or", Of::Join, "one of the two, or both"},
    {"not", Of::Other, "the opposite"},
    {"once", Of::Other, "`once P`: P holds now, or held some time before"},
    {"previously", Of::Other,
     "`previously P`: P held where the tick before this one ended"},
    {"enter", Of::Other, "`enter P`: the step that makes P true"},
    {"leave", Of::Other, "`leave P`: the step that makes P false"},
    {"true", Of::Other, "holds always"},
    {"false", Of::Other, "holds never"},
    {"dead", Of::Other,
     "no step but an idle one is possible, and the root is unfinished"},
    {"stuck", Of::Other, "nothing can go on, and the root is unfinished"},
    {"ticked", Of::Event, "`x.ticked`: it has been called and not yet decided"},
    {"success", Of::Event, "`x.success`: it answers success"},
    {"failure", Of::Event, "`x.failure`: it answers failure"},
    {"running", Of::Event, "`x.running`: it answers running"},
    {"skipped", Of::Event, "`x.skipped`: it is skipped; XML trees only"},
    {"halted", Of::Event, "`x.halted`: it is halted; that is no failure"},
    {"done", Of::Event, "`x.done`: after any of its answers"},
    {"active", Of::Event,
     "`x.active`: it has been called and not given control back, or it runs"},
    {"ended", Of::Event, "`root.ended`: every root has succeeded or failed"},
    {"status", Of::Event,
     "`x.status == success`: the last answer, also long ago"},
    {"answer", Of::Event,
     "`x.answer == success`: the last answer in this tick; `none` before"},
    {"answered", Of::Event, "`x.answered success`: its answer in this tick"},
    {"moves", Of::Event, "`x.moves`: the automaton of x takes the step"},
    {"ends", Of::Event,
     "`tick.ends`: the root has answered and the tick is over"},
    {"passes", Of::Event, "`time.passes`: the step is one of time"},
});

// The tokens of a text, which they point into.
struct Tokens {
  explicit Tokens(const FileText& text)
      : source("", text.text()), list(tokenize(source).tokens) {}

  const Token* at(std::size_t number) const {
    return number < list.size() ? &list[number] : nullptr;
  }

  SourceText source;
  std::vector<Token> list;
};

bool is_item_word(const Token& token) {
  return token.is_first_on_line && token.kind == TokenKind::Identifier &&
         std::ranges::any_of(kRuleWords, [&](const RuleHelp& each) {
           return each.kind == Of::Item &&
                  equal_ignoring_case(each.word, token.text);
         });
}

bool joins_paths(const Token& one, const Token& other) {
  return one.end == other.begin;
}

TextStretch part_of(const Token& token) {
  const std::size_t quote = token.kind == TokenKind::Quoted ? 1 : 0;
  return {token.begin + quote, token.end - quote};
}

}  // namespace

std::span<const RuleHelp> rule_words() { return kRuleWords; }

std::string rule_help(std::string_view word) {
  const auto found = std::ranges::find_if(kRuleWords, [&](const auto& each) {
    return equal_ignoring_case(each.word, word);
  });
  return found == kRuleWords.end()
             ? std::string()
             : fmt::format("**{}** {}", found->word, found->about);
}

RuleWordHere rule_word_at(const FileText& text, std::size_t at) {
  const Tokens tokens(text);
  RuleWordHere here;
  here.word = here.node = {at, at};
  std::size_t number = tokens.list.size();
  for (std::size_t i = 0; i + 1 < tokens.list.size(); ++i) {
    const Token& token = tokens.list[i];
    if (token.begin > at) break;
    if (is_item_word(token)) {
      here.item = text.text().substr(0, 0);
      here.item = std::string_view(text.text())
                      .substr(token.begin, token.end - token.begin);
    }
    if (at <= token.end && token.is_name()) number = i;
  }
  if (number == tokens.list.size()) return here;
  const Token& word = tokens.list[number];
  here.word = part_of(word);
  here.is_quoted = word.kind == TokenKind::Quoted;
  if (number > 0) {
    const Token& before = tokens.list[number - 1];
    here.is_behind_dot = before.kind == TokenKind::Dot;
    here.is_item_name = is_item_word(before);
  }
  // The path before it, and the line behind it.
  std::size_t first = number;
  while (first >= 2 && tokens.list[first - 1].kind == TokenKind::Slash &&
         joins_paths(tokens.list[first - 1], tokens.list[first]) &&
         joins_paths(tokens.list[first - 2], tokens.list[first - 1]) &&
         tokens.list[first - 2].is_name()) {
    first -= 2;
  }
  std::size_t last = number;
  const Token* mark = tokens.at(number + 1);
  const Token* line = tokens.at(number + 2);
  if (mark != nullptr && line != nullptr && mark->kind == TokenKind::At &&
      line->kind == TokenKind::Number && joins_paths(word, *mark)) {
    last = number + 2;
  }
  here.node = {
      part_of(tokens.list[first]).begin,
      std::max(part_of(word).end,
               last == number ? part_of(word).end : tokens.list[last].end)};
  return here;
}

std::vector<TextStretch> rule_names(const FileText& text,
                                    std::string_view name) {
  const Tokens tokens(text);
  std::vector<TextStretch> all;
  for (std::size_t i = 0; i + 1 < tokens.list.size(); ++i) {
    const Token& token = tokens.list[i];
    if (!token.is_name() || !equal_ignoring_case(token.text, name)) continue;
    const bool is_event = i > 0 && tokens.list[i - 1].kind == TokenKind::Dot;
    if (!is_event) all.push_back(part_of(token));
  }
  return all;
}

std::vector<NamedLet> lets_of(const FileText& text) {
  const Tokens tokens(text);
  std::vector<NamedLet> all;
  for (std::size_t i = 0; i + 2 < tokens.list.size(); ++i) {
    const Token& token = tokens.list[i];
    if (!is_item_word(token) || !equal_ignoring_case(token.text, "let") ||
        !tokens.list[i + 1].is_name()) {
      continue;
    }
    const TextStretch part = part_of(tokens.list[i + 1]);
    all.push_back({part.in(text.text()), part});
  }
  return all;
}

}  // namespace btcheck::lsp
