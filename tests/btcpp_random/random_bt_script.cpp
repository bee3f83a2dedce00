// SPDX-License-Identifier: MIT
//
// All that entries get stays between -3 and 3, so that none counts for ever and
// btcheck keeps each value apart. Types are seldom mixed, and numbers seldom
// taken for truth values, since the engine throws then as a rule, and the run
// is over.
#include "btcpp_random/random_bt_script.hpp"

#include <initializer_list>

namespace btcheck::reference {
namespace {

// Braces, unlike a call's parentheses, have an order of evaluation.
std::string joined(std::initializer_list<std::string> parts) {
  std::string text;
  for (const std::string& part : parts) text += part;
  return text;
}

class Writer {
 public:
  Writer(SplitMix64& random, const ScriptScope& scope)
      : random_(random), scope_(scope) {}

  std::string condition(int depth) {
    if (random_.percent(3)) return mixed_condition();
    if (random_.percent(5)) return condition_of_doubles();
    switch (random_.below(depth > 1 ? 8 : 11)) {
      case 0:
      case 1:
      case 2:
        return joined({number(), comparison(), digit()});
      case 3:
        return joined({number(), comparison(), number()});
      case 4:
        return joined({read_text(), equality(), literal()});
      case 5:
        return joined({text(), equality(), read_text()});
      case 6:
        return random_.percent(50) ? flag() : "!" + number();
      case 7:
        return random_.percent(50) ? "true" : "false";
      case 8:
        return joined({"!(", condition(depth + 1), ")"});
      case 9:
        return joined(
            {"(", condition(depth + 1), ") && ", condition(depth + 1)});
      default:
        return joined(
            {condition(depth + 1), " || (", condition(depth + 1), ")"});
    }
  }

  // What is negative is no truth value, but for `!` and `? :`.
  std::string condition_of_doubles() {
    switch (random_.below(9)) {
      case 0:
        return real();
      case 1:
        return joined({"(", number(), " - ", digit(), ") || ", flag()});
      case 2:
        return joined({"(", real(), ") && ", flag()});
      case 3:
        return joined({"(", number(), " - ", number(), ")"});
      case 4:
        return joined({"(", real(), " / 2) || false"});
      case 5:
        return joined({"!(", number(), " - ", digit(), ")"});
      case 6:
        return joined({"((", real(), ") ? ", flag(), " : true)"});
      case 7:
        return "!" + real();
      default:
        return joined({real(), comparison(), digit()});
    }
  }

  // A number where a truth value is needed, texts beside numbers.
  std::string mixed_condition() {
    switch (random_.below(4)) {
      case 0:
        return number();
      case 1:
        return joined({number(), " && ", flag()});
      case 2:
        return joined({text(), " == ", digit()});
      default:
        return joined({"'1' ", comparison(), number()});
    }
  }

  std::string mixed_value() {
    switch (random_.below(5)) {
      case 0:
        return "0.5";
      case 1:
        return "'2'";
      case 2:
        return number() + " / 2";
      case 3:
        return joined({text(), " .. 'b' == 'ab'"});
      default:
        return "1.0";
    }
  }

  std::string statement() {
    if (random_.percent(5)) {
      return joined(
          {random_.percent(70) ? number() : text(), " := ", mixed_value()});
    }
    const std::string assign = random_.percent(60) ? " := " : " = ";
    if (random_.percent(8)) return joined({real(), assign, double_value()});
    if (random_.percent(30)) return joined({text(), assign, text_value()});
    if (random_.percent(20)) return joined({flag(), assign, condition(1)});
    const std::string to = number();
    return joined({to, assign, number_value(to)});
  }

 private:
  std::string number_value(const std::string& to) {
    switch (random_.below(8)) {
      case 0:
        return digit();
      case 1:
        return number();
      case 2:
        return joined({"(", to, " < 3) ? ", to, " + 1 : 0"});
      case 3:
        return "3 - " + number();
      case 4:
        return "!" + number();
      case 5:
        return condition(1);
      case 6:
        return joined({number(), bitwise(), digit()});
      default:
        return joined({"(", condition(1), ") ? ", digit(), " : ", number()});
    }
  }

  // Never the negative zero, which has a name of its own.
  std::string double_value() {
    switch (random_.below(6)) {
      case 0:
        return "-" + std::to_string(1 + random_.below(3));
      case 1:
        return "0.5";
      case 2:
        return "0 - " + real();
      case 3:
        return joined({number(), " - ", number()});
      case 4:
        return joined({"0 - (", number(), " / 2)"});
      default:
        return joined({"(", condition(1), ") ? -1 : ", real()});
    }
  }

  std::string text_value() {
    switch (random_.below(3)) {
      case 0:
        return text();
      case 1:
        return joined({"(", condition(1), ") ? ", literal(), " : ", text()});
      default:
        return literal();
    }
  }

  std::string number() { return one_of(random_, scope_.numbers); }
  std::string real() { return one_of(random_, scope_.doubles); }
  std::string flag() { return one_of(random_, scope_.flags); }
  std::string text() { return one_of(random_, scope_.texts); }
  std::string digit() { return std::to_string(random_.below(4)); }
  std::string read_text() {
    return random_.percent(50) ? text() : one_of(random_, scope_.read_texts);
  }
  std::string literal() { return random_.percent(50) ? "'a'" : "'b'"; }
  std::string equality() { return random_.percent(60) ? " == " : " != "; }
  std::string comparison() {
    return one_of(random_, {" == ", " != ", " < ", " > ", " <= ", " >= "});
  }
  std::string bitwise() { return one_of(random_, {" & ", " | ", " ^ "}); }

  SplitMix64& random_;
  const ScriptScope& scope_;
};

std::string as_attribute(const std::string& script) {
  std::string text;
  for (const char c : script) {
    text += c == '<' ? "&lt;" : c == '&' ? "&amp;" : std::string(1, c);
  }
  return text;
}

}  // namespace

std::string one_of(SplitMix64& random, const std::vector<std::string>& words) {
  return words[static_cast<std::size_t>(
      random.below(static_cast<int>(words.size())))];
}

std::string random_condition(SplitMix64& random, const ScriptScope& scope) {
  return as_attribute(Writer(random, scope).condition(0));
}

std::string random_statements(SplitMix64& random, const ScriptScope& scope) {
  Writer writer(random, scope);
  std::string text = writer.statement();
  if (random.percent(30)) text += "; " + writer.statement();
  return as_attribute(text);
}

}  // namespace btcheck::reference
