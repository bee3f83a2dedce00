// SPDX-License-Identifier: MIT
//
// The grammar of BehaviorTree.CPP 4.10 (src/script_parser.cpp): operands joined
// by operators that bind by strength, statements one after another with or
// without semicolons. An assignment or a `?` ends the expression it stands in,
// and inside a stronger operator it cannot follow.
#include "model/btcpp/script/script.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

#include "model/btcpp/script/tokens.hpp"
#include "text/utf8.hpp"

namespace btcheck::btcpp {
namespace {

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

int strength_of(const ScriptToken& token) {
  if (token.kind != ScriptTokenKind::Operator) return -1;
  for (const Strength& row : kStrengths) {
    if (row.operation == token.text) return row.strength;
  }
  return -1;
}

class ScriptParser {
 public:
  explicit ScriptParser(std::string_view script) : tokens_(tokens_of(script)) {}

  ScriptSyntax parse() {
    if (here().kind == ScriptTokenKind::End) refuse("the script is empty");
    while (is_good() && here().kind != ScriptTokenKind::End) {
      syntax_.tree.statements.push_back(pass_expression(0));
      while (is_good() && here().text == ";") ++at_;
    }
    return std::move(syntax_);
  }

 private:
  using Index = std::uint32_t;  // of a term

  const ScriptToken& here() const { return tokens_[at_]; }
  bool is_good() const { return syntax_.flaw.empty(); }

  void refuse(std::string flaw) {
    if (!is_good()) return;
    syntax_.flaw = std::move(flaw);
    syntax_.flaw_at = here().at;
  }

  Index add(ScriptTerm term) {
    auto& terms = syntax_.tree.terms;
    for (const Index each : term.operands) {
      term.depth = std::max(term.depth, terms[each].depth + 1);
    }
    terms.push_back(std::move(term));
    return static_cast<Index>(terms.size() - 1);
  }

  Index add(ScriptOperation operation, std::vector<Index> operands) {
    return add({operation, {}, {}, false, std::move(operands), {}, 0});
  }

  // Nesting is what the brackets of a script give, and bounded.
  Index pass_expression(int weakest) {
    if (++nested_ > kMostNested) refuse("this is nested too deeply");
    const std::size_t first_name = syntax_.names.size();
    const std::size_t begin = at_;
    Index left = is_good() ? pass_operand() : 0;
    while (is_good()) {
      const int strength = strength_of(here());
      if (strength < 0 || strength < weakest) break;
      if (strength == kAssignment) {
        left = pass_assignment(left, first_name, at_ == begin + 1);
        break;
      }
      if (strength == kTernary) {
        left = pass_choice(left);
        break;
      }
      left =
          strength == kComparison ? pass_comparisons(left) : pass_binary(left);
    }
    --nested_;
    return left;
  }

  Index pass_binary(Index left) {
    const int strength = strength_of(here());
    const auto operation = binary_operation(tokens_[at_++].text);
    const Index right = pass_expression(strength + 1);
    return is_good() ? add(*operation, {left, right}) : 0;
  }

  Index pass_comparisons(Index first) {
    ScriptTerm chain;
    chain.operation = ScriptOperation::Compare;
    chain.operands.push_back(first);
    while (is_good() && strength_of(here()) == kComparison) {
      chain.comparisons.push_back(*comparison_named(tokens_[at_++].text));
      chain.operands.push_back(pass_expression(kComparison + 1));
    }
    return is_good() ? add(std::move(chain)) : 0;
  }

  // What stands on the left is a name alone, or the script fails at its first
  // run: nothing but a name can be assigned to.
  Index pass_assignment(Index left, std::size_t first_name, bool is_alone) {
    if (!is_alone || syntax_.names.size() != first_name + 1) {
      return refuse("only a name can be assigned to"), 0;
    }
    syntax_.names.back().use =
        here().text == ":=" ? ScriptUse::Create : ScriptUse::Change;
    const auto operation = binary_operation(tokens_[at_++].text);
    const Index right = pass_expression(0);
    return is_good() ? add(*operation, {left, right}) : 0;
  }

  Index pass_choice(Index condition) {
    ++at_;
    const Index one = pass_expression(0);
    if (!is_good()) return 0;
    if (here().text != ":") return refuse("`:` is missing after `?`"), 0;
    ++at_;
    const Index other = pass_expression(kTernary);
    return is_good() ? add(ScriptOperation::Choose, {condition, one, other})
                     : 0;
  }

  Index pass_operand() {
    const ScriptToken& token = here();
    ScriptTerm term;
    switch (token.kind) {
      case ScriptTokenKind::Name:
        syntax_.names.push_back(
            {std::string(token.text), ScriptUse::Read, token.at});
        term.operation = ScriptOperation::Name;
        term.text = token.text;
        break;
      case ScriptTokenKind::Text:
        term.operation = ScriptOperation::Text;
        term.text = token.text.substr(1, token.text.size() - 2);
        break;
      case ScriptTokenKind::Truth:
        term.number = token.text == "true" ? 1 : 0;
        break;
      case ScriptTokenKind::Number:
        term.number = script_number(token.text);
        term.is_integer = is_integer_literal(token.text);
        break;
      case ScriptTokenKind::Bad:
        return refuse(fmt::format("`{}` means nothing here", token.text)), 0;
      default:
        return pass_prefix();
    }
    ++at_;
    return add(std::move(term));
  }

  Index pass_prefix() {
    const std::string_view sign = here().text;
    if (sign == "(") {
      ++at_;
      const Index inside = pass_expression(0);
      if (is_good() && here().text != ")") refuse("`)` is missing");
      if (is_good()) ++at_;
      return inside;
    }
    if (sign != "-" && sign != "~" && sign != "!") {
      return refuse("an operand is missing"), 0;
    }
    ++at_;
    const Index of = pass_expression(kPrefix);
    if (!is_good()) return 0;
    return add(sign == "-"   ? ScriptOperation::Negate
               : sign == "~" ? ScriptOperation::Complement
                             : ScriptOperation::Not,
               {of});
  }

  std::vector<ScriptToken> tokens_;
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
