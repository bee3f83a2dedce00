// SPDX-License-Identifier: MIT
//
// As src/script_tokenizer.cpp of BehaviorTree.CPP 4.10.
#include "model/btcpp/script/tokens.hpp"

#include <array>

namespace btcheck::btcpp {
namespace {

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

  std::vector<ScriptToken> all() {
    std::vector<ScriptToken> tokens;
    for (skip_blanks(); at_ < script_.size(); skip_blanks()) {
      const std::size_t begin = at_;
      const ScriptTokenKind kind = pass_token();
      tokens.push_back({kind, script_.substr(begin, at_ - begin), begin});
    }
    tokens.push_back({ScriptTokenKind::End, {}, script_.size()});
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

  ScriptTokenKind pass_token() {
    if (here() == '\'') return pass_string();
    if (is_digit(here())) return pass_number();
    if (begins_name(here())) {
      const std::size_t begin = at_++;
      pass(continues_name);
      const std::string_view word = script_.substr(begin, at_ - begin);
      return word == "true" || word == "false" ? ScriptTokenKind::Truth
                                               : ScriptTokenKind::Name;
    }
    return pass_operator();
  }

  ScriptTokenKind pass_string() {
    const std::size_t close = script_.find('\'', at_ + 1);
    at_ = close == script_.npos ? script_.size() : close + 1;
    return close == script_.npos ? ScriptTokenKind::Bad : ScriptTokenKind::Text;
  }

  ScriptTokenKind pass_number() {
    const bool is_good = here() == '0' && (here(1) == 'x' || here(1) == 'X')
                             ? pass_hexadecimal()
                             : pass_decimal();
    const auto goes_on = [](char c) { return continues_name(c) || c == '@'; };
    const bool ends_well = is_good && !goes_on(here());
    if (!ends_well) {
      pass([&](char c) { return goes_on(c) || c == '.'; });
    }
    return ends_well ? ScriptTokenKind::Number : ScriptTokenKind::Bad;
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

  ScriptTokenKind pass_operator() {
    constexpr std::array<std::string_view, 12> kPairs = {
        "..", "&&", "||", "==", "!=", "<=", ">=", ":=", "+=", "-=", "*=", "/="};
    for (const std::string_view pair : kPairs) {
      if (script_.substr(at_, 2) != pair) continue;
      at_ += 2;
      return ScriptTokenKind::Operator;
    }
    constexpr std::string_view kSingle = "+-*/&|^~!<>=?:();";
    return kSingle.find(script_[at_++]) == kSingle.npos
               ? ScriptTokenKind::Bad
               : ScriptTokenKind::Operator;
  }

  std::string_view script_;
  std::size_t at_ = 0;
};

}  // namespace

std::vector<ScriptToken> tokens_of(std::string_view script) {
  return Tokens(script).all();
}

}  // namespace btcheck::btcpp
