// SPDX-License-Identifier: MIT
//
// The grammar of BehaviorTree.CPP 4.10 (src/script_tokenizer.cpp and
// src/script_parser.cpp): operands joined by operators that bind by strength,
// statements one after another with or without semicolons. Nothing is computed
// here: what a reader can say before a tick is whether a script is one, and
// which names it speaks of.
//
// The strengths decide nothing about what is a script but one: an assignment or
// a `?` ends the expression it stands in, and inside a stronger operator it
// cannot follow. So they are kept.
#include "model/btcpp/script.hpp"

#include <fmt/format.h>

#include <array>
#include <utility>

#include "utf8.hpp"

namespace btcheck::btcpp {
namespace {

enum class TokenKind : unsigned char {
  Name,
  Literal,
  Operator,
  Bad,  // an unfinished string or number, a character of no operator
  End
};

struct Token {
  TokenKind kind = TokenKind::End;
  std::string_view text;
  std::size_t at = 0;
};

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_hexadecimal(char c) {
  return is_digit(c) || (c >= 'a' && c <= 'f') || (c >= 'A' && c <= 'F');
}
bool begins_name(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' ||
         c == '@';
}
bool continues_name(char c) {
  return (begins_name(c) && c != '@') || is_digit(c);
}

class Tokens {
 public:
  explicit Tokens(std::string_view script) : script_(script) {}

  std::vector<Token> all() {
    std::vector<Token> tokens;
    for (skip_blanks(); at_ < script_.size(); skip_blanks()) {
      const std::size_t begin = at_;
      const TokenKind kind = pass_token();
      tokens.push_back({kind, script_.substr(begin, at_ - begin), begin});
    }
    tokens.push_back({TokenKind::End, {}, script_.size()});
    return tokens;
  }

 private:
  char here(std::size_t ahead = 0) const {
    return at_ + ahead < script_.size() ? script_[at_ + ahead] : '\0';
  }

  template <class Belongs>
  std::size_t pass(Belongs belongs) {
    const std::size_t begin = at_;
    while (at_ < script_.size() && belongs(script_[at_])) ++at_;
    return at_ - begin;
  }

  void skip_blanks() {
    pass(
        [](char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; });
  }

  TokenKind pass_token() {
    if (here() == '\'') return pass_string();
    if (is_digit(here())) return pass_number();
    if (begins_name(here())) {
      const std::size_t begin = at_++;
      pass(continues_name);
      const std::string_view word = script_.substr(begin, at_ - begin);
      return word == "true" || word == "false" ? TokenKind::Literal
                                               : TokenKind::Name;
    }
    return pass_operator();
  }

  TokenKind pass_string() {
    const std::size_t close = script_.find('\'', at_ + 1);
    at_ = close == script_.npos ? script_.size() : close + 1;
    return close == script_.npos ? TokenKind::Bad : TokenKind::Literal;
  }

  TokenKind pass_number() {
    const bool is_good = here() == '0' && (here(1) == 'x' || here(1) == 'X')
                             ? pass_hexadecimal()
                             : pass_decimal();
    const auto goes_on = [](char c) { return continues_name(c) || c == '@'; };
    const bool ends_well = is_good && !goes_on(here());
    if (!ends_well) {
      pass([&](char c) { return goes_on(c) || c == '.'; });
    }
    return ends_well ? TokenKind::Literal : TokenKind::Bad;
  }

  bool pass_hexadecimal() {
    at_ += 2;
    return pass(is_hexadecimal) > 0 && here() != '.';
  }

  bool pass_decimal() {
    pass(is_digit);
    if (here() == '.' && here(1) != '.') {
      ++at_;
      if (pass(is_digit) == 0) return false;
    }
    if (here() == 'e' || here() == 'E') {
      ++at_;
      if (here() == '+' || here() == '-') ++at_;
      return pass(is_digit) > 0;
    }
    return true;
  }

  TokenKind pass_operator() {
    constexpr std::array<std::string_view, 12> kPairs = {
        "..", "&&", "||", "==", "!=", "<=", ">=", ":=", "+=", "-=", "*=", "/="};
    for (const std::string_view pair : kPairs) {
      if (script_.substr(at_, 2) != pair) continue;
      at_ += 2;
      return TokenKind::Operator;
    }
    constexpr std::string_view kSingle = "+-*/&|^~!<>=?:();";
    return kSingle.find(script_[at_++]) == kSingle.npos ? TokenKind::Bad
                                                        : TokenKind::Operator;
  }

  std::string_view script_;
  std::size_t at_ = 0;
};

constexpr int kAssignment = 2;
constexpr int kTernary = 4;
constexpr int kComparison = 10;
constexpr int kPrefix = 20;
constexpr int kMostNested = 200;

struct Strength {
  std::string_view operation;
  int strength;
};
constexpr std::array kStrengths = {Strength{":=", kAssignment},
                                   Strength{"=", kAssignment},
                                   Strength{"+=", kAssignment},
                                   Strength{"-=", kAssignment},
                                   Strength{"*=", kAssignment},
                                   Strength{"/=", kAssignment},
                                   Strength{"?", kTernary},
                                   Strength{"||", 6},
                                   Strength{"&&", 8},
                                   Strength{"==", kComparison},
                                   Strength{"!=", kComparison},
                                   Strength{"<", kComparison},
                                   Strength{">", kComparison},
                                   Strength{"<=", kComparison},
                                   Strength{">=", kComparison},
                                   Strength{"|", 12},
                                   Strength{"^", 12},
                                   Strength{"&", 14},
                                   Strength{"+", 16},
                                   Strength{"-", 16},
                                   Strength{"..", 16},
                                   Strength{"*", 18},
                                   Strength{"/", 18}};

int strength_of(const Token& token) {
  if (token.kind != TokenKind::Operator) return -1;
  for (const Strength& row : kStrengths) {
    if (row.operation == token.text) return row.strength;
  }
  return -1;
}

class ScriptParser {
 public:
  explicit ScriptParser(std::string_view script)
      : tokens_(Tokens(script).all()) {}

  ScriptSyntax parse() {
    if (here().kind == TokenKind::End) refuse("the script is empty");
    while (is_good() && here().kind != TokenKind::End) {
      pass_expression(0);
      while (is_good() && here().text == ";") ++at_;
    }
    return std::move(syntax_);
  }

 private:
  const Token& here() const { return tokens_[at_]; }
  bool is_good() const { return syntax_.flaw.empty(); }

  void refuse(std::string flaw) {
    if (!is_good()) return;
    syntax_.flaw = std::move(flaw);
    syntax_.flaw_at = here().at;
  }

  // Nesting is what the brackets of a script give, and bounded.
  void pass_expression(int weakest) {
    if (++nested_ > kMostNested) refuse("this is nested too deeply");
    const std::size_t first_name = syntax_.names.size();
    const std::size_t begin = at_;
    if (is_good()) pass_operand();
    while (is_good()) {
      const int strength = strength_of(here());
      if (strength < 0 || strength < weakest) break;
      if (strength == kAssignment) {
        pass_assignment(first_name, at_ == begin + 1);
        break;
      }
      if (strength == kTernary) {
        pass_choice();
        break;
      }
      ++at_;
      pass_expression(strength + 1);
    }
    --nested_;
  }

  // What stands on the left is a name alone, or the script fails at its first
  // run: nothing but a name can be assigned to.
  void pass_assignment(std::size_t first_name, bool is_alone) {
    if (!is_alone || syntax_.names.size() != first_name + 1) {
      return refuse("only a name can be assigned to");
    }
    syntax_.names.back().use =
        here().text == ":=" ? ScriptUse::Create : ScriptUse::Change;
    ++at_;
    pass_expression(0);
  }

  void pass_choice() {
    ++at_;
    pass_expression(0);
    if (!is_good()) return;
    if (here().text != ":") return refuse("`:` is missing after `?`");
    ++at_;
    pass_expression(kTernary);
  }

  void pass_operand() {
    const Token& token = here();
    if (token.kind == TokenKind::Name) {
      syntax_.names.push_back(
          {std::string(token.text), ScriptUse::Read, token.at});
      ++at_;
    } else if (token.kind == TokenKind::Literal) {
      ++at_;
    } else if (token.text == "(") {
      ++at_;
      pass_expression(0);
      if (is_good() && here().text != ")") refuse("`)` is missing");
      if (is_good()) ++at_;
    } else if (token.text == "-" || token.text == "~" || token.text == "!") {
      ++at_;
      pass_expression(kPrefix);
    } else if (token.kind == TokenKind::Bad) {
      refuse(fmt::format("`{}` means nothing here", token.text));
    } else {
      refuse("an operand is missing");
    }
  }

  std::vector<Token> tokens_;
  std::size_t at_ = 0;
  int nested_ = 0;
  ScriptSyntax syntax_;
};

}  // namespace

ScriptSyntax parse_script(std::string_view script) {
  return ScriptParser(script).parse();
}

BtcppPlace place_in(const BtcppAttribute& script, std::size_t at,
                    std::size_t length) {
  BtcppPlace place = script.place;
  const std::string_view text = script.value;
  if (place.span.length != count_code_points(text)) return place;
  place.span.column += count_code_points(text.substr(0, at));
  place.span.length = count_code_points(text.substr(at, length));
  return place;
}

}  // namespace btcheck::btcpp
