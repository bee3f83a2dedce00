// SPDX-License-Identifier: MIT
//
// Properties of Fiacre, read as strictly as its compiler frac 2.3.0 does:
//
//   PROPERTY ::= deadlockfree | ltl A | infinitelyoften O | mortal O
//              | always O [SCOPE] | O precedes O [SCOPE]
//              | present O [SCOPE] [TIME] | absent O [SCOPE] [TIME]
//              | O leadsto O [SCOPE] [TIME]
//   O ::= observation | ( E )             and, or, not: inside of ( ) only
//   E ::= O | not E | E and E | E or E
//   A ::= observation | not A | [] A | <> A | ( L )
//   L ::= A | L and L | L or L | L => L | L until L | L release L
//
// A scope stands before a time, an interval is closed and has an end, and only
// some patterns have a time in some scopes. There are no constants, no W and no
// <=>. Of the language, but never written: properties joined to one, => between
// conditions, events, the next state.
#include "reference/fiacre_property.hpp"

#include <algorithm>
#include <iterator>
#include <stdexcept>

namespace btcheck::reference {
namespace {

using Words = std::vector<std::string_view>;

const Words kReserved = {
    "absent",  "after",        "always",   "and",     "any",
    "append",  "array",        "assert",   "before",  "begin",
    "between", "bool",         "by",       "case",    "channel",
    "const",   "deadlockfree", "dequeue",  "do",      "component",
    "else",    "elsif",        "empty",    "end",     "enqueue",
    "enter",   "event",        "extern",   "false",   "first",
    "for",     "foreach",      "from",     "full",    "function",
    "if",      "in",           "init",     "int",     "infinitelyoften",
    "is",      "lasting",      "leadsto",  "leave",   "live",
    "loop",    "ltl",          "mortal",   "nat",     "none",
    "not",     "of",           "on",       "or",      "out",
    "par",     "port",         "precedes", "present", "priority",
    "process", "property",     "prove",    "queue",   "read",
    "record",  "release",      "return",   "select",  "start",
    "state",   "states",       "sync",     "tag",     "then",
    "to",      "true",         "type",     "union",   "unless",
    "until",   "value",        "var",      "wait",    "where",
    "while",   "within",       "write"};

// What joins and what stands in front in a formula.
struct Operators {
  Words prefixes;
  Words infixes;
};
const Operators kOfStates = {{"not"}, {"and", "or"}};
const Operators kOfRuns = {{"not", "[]", "<>"},
                           {"and", "or", "=>", "until", "release"}};

// Which pattern has which time in which scope.
struct PatternTime {
  std::string_view form;
  std::string_view scope;
  std::string_view word;
};
constexpr PatternTime kTimes[] = {
    {"present", "", "within"},      {"present", "", "lasting"},
    {"present", "after", "within"}, {"absent", "", "within"},
    {"absent", "after", "within"},  {"absent", "before", "for"},
    {"leadsto", "", "within"},      {"leadsto", "before", "within"},
    {"leadsto", "after", "within"},
};

bool is_among(const Words& all, std::string_view word) {
  return std::ranges::find(all, word) != all.end();
}

class PropertyReader {
 public:
  PropertyReader(WordReader& words,
                 const std::function<std::string()>& observation)
      : words_(words), observation_(observation) {}

  ReadProperty run() {
    ReadProperty made;
    made.name = fiacre_name(words_);
    words_.expect("is");
    body(made);
    words_.expect("assert");
    words_.expect(made.name);
    return made;
  }

 private:
  void body(ReadProperty& made) {
    if (words_.accept("deadlockfree")) return;
    if (words_.accept("ltl")) {
      prefixes(kOfRuns);
      formula(kOfRuns);
      return;
    }
    std::string form = words_.peek();
    const bool is_of_one = is_among(
        {"always", "absent", "present", "infinitelyoften", "mortal"}, form);
    if (is_of_one) words_.take();
    std::vector<std::string> condition = formula(kOfStates);
    if (!is_of_one) {
      form = words_.take();
      if (form != "leadsto" && form != "precedes") {
        throw std::runtime_error("no pattern " + form);
      }
      formula(kOfStates);
    }
    const std::string_view where = scope(form);
    if (time(form, where) || !where.empty()) return;
    if (form != "always" && form != "absent") return;
    made.form = std::move(form);
    made.condition = std::move(condition);
  }

  void prefixes(const Operators& operators) {
    while (is_among(operators.prefixes, words_.peek())) words_.take();
  }

  // An observation, or a formula in parentheses: its words.
  std::vector<std::string> formula(const Operators& operators) {
    std::vector<std::string> taken;
    int open = 0;
    bool wants_operand = true;
    do {
      const std::string& next = words_.peek();
      if (wants_operand) {
        const bool is_prefix = open > 0 && is_among(operators.prefixes, next);
        wants_operand = is_prefix || next == "(";
        open += next == "(" ? 1 : 0;
        taken.push_back(wants_operand ? words_.take() : observation_());
      } else {
        wants_operand = is_among(operators.infixes, next);
        if (!wants_operand) {
          words_.expect(")");
          --open;
        }
        taken.push_back(wants_operand ? words_.take() : ")");
      }
    } while (wants_operand || open > 0);
    return taken;
  }

  std::string_view scope(std::string_view form) {
    if (form == "infinitelyoften" || form == "mortal") return "";
    if (words_.accept("before")) {
      formula(kOfStates);
      return "before";
    }
    const bool is_between = words_.accept("between");
    if (!is_between && !words_.accept("after")) return "";
    formula(kOfStates);
    if (is_between) {
      words_.expect("and");
    } else if (!words_.accept("until")) {
      return "after";
    }
    formula(kOfStates);
    return is_between ? "between" : "until";
  }

  bool time(std::string_view form, std::string_view where) {
    const std::string word = words_.peek();
    const auto fits = [&](const PatternTime& time) {
      return time.form == form && time.scope == where && time.word == word;
    };
    if (std::ranges::none_of(kTimes, fits)) return false;
    words_.take();
    if (word != "within") {
      words_.number();
      return true;
    }
    words_.expect("[");
    words_.number();
    words_.expect(",");
    words_.number();
    words_.expect("]");
    return true;
  }

  WordReader& words_;
  const std::function<std::string()>& observation_;
};

}  // namespace

ReadProperty read_fiacre_property(
    WordReader& words, const std::function<std::string()>& observation) {
  return PropertyReader(words, observation).run();
}

std::string fiacre_name(WordReader& words) {
  std::string name = words.take();
  const bool is_name = name[0] == '_' || (name[0] >= 'a' && name[0] <= 'z') ||
                       (name[0] >= 'A' && name[0] <= 'Z');
  if (!is_name || is_among(kReserved, name)) {
    throw std::runtime_error("no name: " + name);
  }
  return name;
}

}  // namespace btcheck::reference
