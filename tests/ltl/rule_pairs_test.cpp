// SPDX-License-Identifier: MIT
//
// Every form of docs/properties.md behind every other, in one file and as they
// are typed, about names that are words of the grammar elsewhere.
#include <vector>

#include "ltl/property_text.hpp"

namespace btcheck::test::rule_pairs_test {
namespace {

// P and Q are conditions on single states, N is a name.
const std::vector<std::string> kForms = {
    "never P",
    "absent P",
    "always P",
    "possible P",
    "eventually P",
    "present P",
    "always eventually P",
    "infinitelyOften P",
    "eventually always P",
    "mortal P",
    "P leadsto Q",
    "whenever P then Q",
    "P precedes Q",
    "P before Q",
    "Q requires P",
    "P forbids Q",
    "every tick: P",
    "in every tick: P",
    "in no tick: P",
    "in some tick: P",
    "deadlockfree",
    "live P",
    "ltl [] P",
    "[] P",
    "<> [] P",
    "P U Q",
    "AG EF P",
    "A [P U Q]",
    "E (P W Q)",
    "not P => <> Q",
    "never once P",
    "never (P since Q)",
    "in no tick: P and previously Q",
    "[] (enter P => <> Q)",
    "after Q, never P",
    "absent P after Q",
    "absent P before Q",
    "present P between Q and P",
    "always P after Q until P",
    "globally P leadsto Q",
    "absentAfter P Q",
    "P leadsto Q within 2 ticks",
    "P leadsto first Q within [0,2]",
    "absent P for 3",
    "present first P after Q within 1 tick",
    "present P lasting 2",
    "never N in 0..3",
    "never x == N",
    "never N > 3 and tick",
    "never N.status == success",
    "every tick: N.answered success => N.answer != failure",
    "[] (N.moves => <> time.passes)",
    "never dead",
    "in no tick: stuck",
    "always tick.ends",
};

// Items that are typed as they stand.
const std::vector<std::string> kItems = {
    "property p# [safety]: in no tick: P",
    "property p# expect violated: never P",
    "prove in some tick: P",
    "let l# = P",
    "assume a#: in every tick: P",
    "assume in no tick: P",
    "assume [] <> P",
    "assume every action eventually ends",
    "expect violated prove in no tick: P",
};

// Words of the grammar that are names where a dot is behind them, or as lets.
const std::vector<std::string> kNames = {
    "a",      "prove", "property",   "let",     "expect",   "assert", "assume",
    "tree",   "tick",  "never",      "always",  "whenever", "then",   "after",
    "within", "first", "ticks",      "every",   "no",       "some",   "once",
    "tick2",  "is",    "previously", "globally"};

// As a rule that is typed stands in the file that is made of them.
std::string as_item(const std::string& rule) {
  return (begins_item(rule) ? "" : "prove ") + rule;
}

std::string replaced(std::string text, const std::string& word,
                     const std::string& by) {
  const auto is_part = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0;
  };
  for (std::size_t at = 0; (at = text.find(word, at)) != text.npos;) {
    const bool is_word =
        (at == 0 || !is_part(text[at - 1])) &&
        (at + word.size() == text.size() || !is_part(text[at + word.size()]));
    if (is_word) text.replace(at, word.size(), by);
    at += is_word ? by.size() : word.size();
  }
  return text;
}

std::string about(const std::string& form, const std::string& name,
                  int number) {
  std::string text = replaced(form, "P", name + ".ticked");
  text = replaced(text, "Q", "b.done");
  text = replaced(text, "N", name);
  for (std::size_t at = 0; (at = text.find('#', at)) != text.npos;) {
    text.replace(at, 1, std::to_string(number));
  }
  return text;
}

std::size_t rules_in(const std::string& text) {
  const PropertyFile file = accepted(text);
  return file.properties.size() + file.assumptions.size();
}

TEST_CASE("every form follows every other, in a file and typed") {
  std::vector<std::string> all = kForms;
  all.insert(all.end(), kItems.begin(), kItems.end());
  for (const std::string& first : all) {
    for (const std::string& second : all) {
      const std::string text = as_item(about(first, "a", 1)) + '\n' +
                               as_item(about(second, "a", 2)) + '\n' +
                               as_item("in no tick: dead") + '\n';
      const std::size_t lets =
          first.starts_with("let") + second.starts_with("let");
      if (lets == 2) continue;
      CAPTURE(text);
      CHECK(rules_in(text) == 3 - lets);
    }
  }
}

TEST_CASE("names that are words of the grammar stand in every form") {
  for (const std::string& name : kNames) {
    for (const std::string& form : kForms) {
      for (const char* const next : {"in no tick: P", "never P", "P leadsto Q",
                                     "N > 2 leadsto Q", "tick => P"}) {
        const std::string text = as_item(about(form, name, 1)) + '\n' +
                                 as_item(about(next, name, 2)) + '\n' +
                                 "tick nodes\n";
        CAPTURE(text);
        CHECK(rules_in(text) == 2);
      }
    }
  }
}

TEST_CASE("a let may be called as words that a form may have") {
  for (const std::string name :
       {"first", "ticks", "every", "no", "some", "once", "previously", "inf",
        "ends", "action", "A", "E", "holds"}) {
    for (const std::string form :
         {"never N", "present N", "eventually N", "b.done leadsto N",
          "whenever N then N", "every tick: N", "N", "once N leadsto N", "[] N",
          "N leadsto N within 2 ticks"}) {
      const std::string text =
          "let " + name + " = a.ticked\n" + as_item(replaced(form, "N", name)) +
          '\n' + as_item("in no tick: a.ticked") + '\n' + "tick nodes\n";
      CAPTURE(text);
      CHECK(rules_in(text) == 2);
    }
  }
}

TEST_CASE("no help names the word that stands there") {
  for (const std::string rule : {"possible a.done then b.done",
                                 "never a.done leadsto b.done",
                                 "let x = a.done for 3",
                                 "let x = a.done lasting 3",
                                 "let x = a.done globally",
                                 "let x = a.done before b.done",
                                 "let x = a.done after b.done",
                                 "let x = a.done between b.done",
                                 "let x = a.done requires b.done",
                                 "let x = a.done forbids b.done",
                                 "let x = a.done precedes b.done",
                                 "let x = a.done in 0..3",
                                 "let x = a.done then b.done",
                                 "live a.done then b.done",
                                 "in some tick: a.done then b.done",
                                 "whenever a.done within 2 ticks",
                                 "let x = a.done within 2 ticks",
                                 "expect \"holds\" prove never a.done",
                                 "tick \"root\"",
                                 "\"prove\" never a.done"}) {
    const auto found = read(as_item(rule)).diagnostics;
    CAPTURE(rule);
    REQUIRE(!found.empty());
    const Diagnostic& first = found.front();
    CHECK(first.help.find("did you mean") == std::string::npos);
    CHECK(!first.help.empty());
  }
}

}  // namespace
}  // namespace btcheck::test::rule_pairs_test
