// SPDX-License-Identifier: MIT
//
// The words and the grammar of BehaviorTree.CPP 4.10 (src/script_tokenizer.cpp,
// src/script_parser.cpp): operands joined by operators that bind by strength,
// statements one after another with or without semicolons. An assignment or a
// `?` ends the expression it stands in, and inside a stronger operator it
// cannot follow.
//
// Up to 4.8 the grammar is another (include/behaviortree_cpp/scripting/
// operators.hpp): operators come in groups, and those of two groups do not mix
// in one scope, which is a statement, what stands in brackets, or between `?`
// and `:`.
#include "model/btcpp/script/script.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <utility>

#include "model/tree/releases.hpp"
#include "text/utf8.hpp"

namespace btcheck::btcpp {
namespace {

bool is_hexadecimal(char c) {
  return is_digit(c) || (c >= 'a' && c <= 'f') || (c >= 'A' && c <= 'F');
}
bool begins_name(char c) { return is_letter(c) || c == '_' || c == '@'; }
bool continues_name(char c) {
  return (begins_name(c) && c != '@') || is_digit(c);
}

class Tokens {
 public:
  Tokens(std::string_view script, int release)
      : script_(script), is_old_(releases::kHasOldGrammar.has(release)) {
    if (releases::kNewlineEndsScript.has(release)) end_at_newline();
  }

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

  // The first one that is not in brackets, whatever stands behind.
  void end_at_newline() {
    int depth = 0;
    for (std::size_t i = 0; i < script_.size(); ++i) {
      depth += (script_[i] == '(') - (script_[i] == ')');
      const bool is_escaped = i > 0 && script_[i - 1] == '\\';
      if (script_[i] != '\n' || is_escaped || depth > 0) continue;
      script_ = script_.substr(0, i);
      return;
    }
  }

  // Before 4.9 a newline with a backslash before it is one, too.
  void skip_blanks() {
    do {
      pass([](char c) {
        return c == ' ' || c == '\t' || c == '\n' || c == '\r';
      });
    } while (is_old_ && here() == '\\' && here(1) == '\n' && ++at_ > 0);
  }

  ScriptTokenKind pass_token() {
    if (here() == '\'' || (is_old_ && here() == '"')) return pass_string();
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
    const std::size_t close = script_.find(here(), at_ + 1);
    const std::size_t begin =
        std::exchange(at_, close == script_.npos ? script_.size() : close + 1);
    const bool is_ascii = std::ranges::all_of(
        script_.substr(begin, at_ - begin),
        [](char c) { return static_cast<unsigned char>(c) < 0x80; });
    const bool is_good = close != script_.npos && (is_ascii || !is_old_);
    return is_good ? ScriptTokenKind::Text : ScriptTokenKind::Bad;
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
  bool is_old_;
  std::size_t at_ = 0;
};

bool begins_hexadecimal(std::string_view written) {
  return written.starts_with("0x") || written.starts_with("0X");
}

bool is_integer_literal(std::string_view written) {
  return begins_hexadecimal(written) ||
         written.find_first_of(".eE") == written.npos;
}

// The value of a number as the engine reads it: integers have 64 bits. Nothing
// when a double cannot hold it exactly.
std::optional<double> script_number(std::string_view written) {
  const char* end = written.data() + written.size();
  if (!is_integer_literal(written)) {
    double value = 0;
    const auto read = std::from_chars(written.data(), end, value);
    if (read.ec != std::errc() || !std::isfinite(value)) return std::nullopt;
    return value;
  }
  const bool is_hexadecimal = begins_hexadecimal(written);
  if (is_hexadecimal) written.remove_prefix(2);
  std::int64_t value = 0;
  const auto read =
      std::from_chars(written.data(), end, value, is_hexadecimal ? 16 : 10);
  const auto real = static_cast<double>(value);
  constexpr double kLargestExact = 9007199254740991;  // 2^53 - 1
  if (read.ec != std::errc() || real > kLargestExact) return std::nullopt;
  return real;
}

constexpr int kAssignment = 2;
constexpr int kTernary = 4;
constexpr int kOr = 6;
constexpr int kComparison = 10;
constexpr int kPrefix = 20;
constexpr int kMostNested = 200;

// An operator between two operands; stronger ones bind tighter.
struct Sign {
  std::string_view text;
  int strength;
  ScriptOperation operation;
  ScriptComparison comparison = {};
};

const Sign* sign_of(const ScriptToken& token) {
  using enum ScriptOperation;
  using By = ScriptComparison;
  static constexpr std::array kSigns = {
      Sign{":=", kAssignment, Create},
      Sign{"=", kAssignment, Set},
      Sign{"+=", kAssignment, SetSum},
      Sign{"-=", kAssignment, SetDifference},
      Sign{"*=", kAssignment, SetProduct},
      Sign{"/=", kAssignment, SetQuotient},
      Sign{"?", kTernary, Choose},
      Sign{"||", kOr, Or},
      Sign{"&&", 8, And},
      Sign{"==", kComparison, Compare, By::Equal},
      Sign{"!=", kComparison, Compare, By::NotEqual},
      Sign{"<", kComparison, Compare, By::Less},
      Sign{">", kComparison, Compare, By::Greater},
      Sign{"<=", kComparison, Compare, By::LessEqual},
      Sign{">=", kComparison, Compare, By::GreaterEqual},
      Sign{"|", 12, BitOr},
      Sign{"^", 12, BitXor},
      Sign{"&", 14, BitAnd},
      Sign{"+", 16, Add},
      Sign{"-", 16, Subtract},
      Sign{"..", 16, Join},
      Sign{"*", 18, Multiply},
      Sign{"/", 18, Divide}};
  if (token.kind != ScriptTokenKind::Operator) return nullptr;
  const auto found = std::ranges::find(kSigns, token.text, &Sign::text);
  return found == kSigns.end() ? nullptr : &*found;
}

bool is_arithmetic(ScriptOperation operation) {
  using enum ScriptOperation;
  return operation == Add || operation == Subtract || operation == Multiply ||
         operation == Divide || operation == Negate;
}

// Of the grammar up to 4.8.
enum class Group : std::uint8_t { None, Arithmetic, Joining, Comparing, Bits };

std::string_view group_name(Group group) {
  switch (group) {
    case Group::None:
      return "";
    case Group::Arithmetic:
      return "arithmetic";
    case Group::Joining:
      return "`..`";
    case Group::Comparing:
      return "a comparison";
    case Group::Bits:
      return "`!`, `~`, `&`, `|` or `^`";
  }
  return "";
}

class ScriptParser {
 public:
  ScriptParser(std::string_view script, int release,
               std::shared_ptr<const ScriptEnums> enums, bool is_of_contract)
      : release_(release),
        is_of_contract_(is_of_contract),
        tokens_(tokens_of(script, release)) {
    syntax_.tree.enums = std::move(enums);
    syntax_.tree.compares_with_itself = is_in(releases::kComparesWithItself);
    syntax_.tree.compares_no_mixture = is_in(releases::kComparesNoMixture);
    syntax_.tree.numbers_refuse_texts = is_in(releases::kNumbersRefuseTexts);
    syntax_.tree.texts_are_true = is_in(releases::kTextsAreTrue);
    syntax_.tree.converts_unchecked = is_in(releases::kConvertsUnchecked);
  }

  ScriptSyntax parse() {
    if (here().kind == ScriptTokenKind::End) refuse("the script is empty");
    while (is_good() && here().kind != ScriptTokenKind::End) {
      syntax_.tree.statements.push_back(
          in_scope([&] { return pass_expression(0); }));
      pass_end_of_statement();
    }
    return std::move(syntax_);
  }

 private:
  using Index = std::uint32_t;  // of a term

  const ScriptToken& here() const { return tokens_[at_]; }
  bool is_good() const { return syntax_.flaw.empty(); }
  bool is_in(const Releases& releases) const { return releases.has(release_); }
  bool is_old() const { return is_in(releases::kHasOldGrammar); }

  void pass_end_of_statement() {
    const bool has_separator = is_good() && here().text == ";";
    if (!is_old()) {
      while (is_good() && here().text == ";") ++at_;
      return;
    }
    if (has_separator) ++at_;
    const bool is_end = here().kind == ScriptTokenKind::End;
    if (has_separator && is_end) refuse_old("`;` cannot stand at the end");
    if (!has_separator && !is_end) refuse_old("`;` is missing");
  }

  void refuse_old(std::string_view flaw) {
    refuse(fmt::format("{} before BehaviorTree.CPP 4.9", flaw));
  }

  // What `pass` reads has groups of its own.
  template <class Pass>
  Index in_scope(Pass pass) {
    const Group around = std::exchange(group_, Group::None);
    const bool was_chained = std::exchange(is_chained_, false);
    const Index result = pass();
    group_ = around;
    is_chained_ = was_chained;
    return result;
  }

  Group group_of(ScriptOperation operation) const {
    using enum ScriptOperation;
    if (is_arithmetic(operation)) return Group::Arithmetic;
    if (operation == Join) {
      return is_in(releases::kJoinStandsAlone) ? Group::Joining
                                               : Group::Arithmetic;
    }
    if (operation == Compare) {
      return is_in(releases::kComparisonsStandAlone) ? Group::Comparing
                                                     : Group::None;
    }
    const bool is_of_bits = operation == Not || operation == Complement ||
                            operation == BitAnd || operation == BitOr ||
                            operation == BitXor;
    return is_of_bits ? Group::Bits : Group::None;
  }

  void note_group(ScriptOperation operation) {
    if (!is_old()) return;
    const Group group = group_of(operation);
    if (group == Group::None) return;
    if (group_ != Group::None && group_ != group) {
      refuse_old(fmt::format("{} and {} need brackets between them",
                             group_name(group_), group_name(group)));
    }
    group_ = group;
  }

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

  // It recurses as deeply as brackets nest, which is bounded.
  Index pass_expression(int weakest) {
    if (++nested_ > kMostNested) refuse("this is nested too deeply");
    const std::size_t first_name = syntax_.names.size();
    const std::size_t begin = at_;
    Index left = is_good() ? pass_operand() : 0;
    while (is_good()) {
      const Sign* sign = sign_of(here());
      if (sign == nullptr || strength_of(*sign) < weakest) break;
      note_group(sign->operation);
      if (sign->strength == kAssignment) {
        left = pass_assignment(*sign, left, first_name, at_ == begin + 1);
        break;
      }
      if (sign->strength == kTernary) {
        left = pass_choice(left);
        break;
      }
      left = sign->strength == kComparison ? pass_comparisons(left)
                                           : pass_binary(*sign, left);
    }
    --nested_;
    return left;
  }

  int strength_of(const Sign& sign) const {
    const bool is_and = sign.operation == ScriptOperation::And;
    return is_and && is_old() ? kOr : sign.strength;
  }

  Index pass_binary(const Sign& sign, Index left) {
    if (sign.operation == ScriptOperation::Join &&
        is_in(releases::kHasNoRootEntries)) {
      return refuse("`..` came with BehaviorTree.CPP 4.6"), 0;
    }
    ++at_;
    const bool goes_right = is_in(releases::kArithmeticIsRightAssociative) &&
                            is_arithmetic(sign.operation);
    const Index right =
        pass_expression(strength_of(sign) + (goes_right ? 0 : 1));
    return is_good() ? add(sign.operation, {left, right}) : 0;
  }

  Index pass_comparisons(Index first) {
    ScriptTerm chain;
    chain.operation = ScriptOperation::Compare;
    chain.operands.push_back(first);
    while (is_good()) {
      const Sign* sign = sign_of(here());
      if (sign == nullptr || sign->strength != kComparison) break;
      ++at_;
      chain.comparisons.push_back(sign->comparison);
      chain.operands.push_back(pass_expression(kComparison + 1));
    }
    return is_good() ? add(std::move(chain)) : 0;
  }

  // Only a name can be assigned to: with anything else on the left, the engine
  // would refuse the script at its first run.
  Index pass_assignment(const Sign& sign, Index left, std::size_t first_name,
                        bool is_alone) {
    if (!is_alone || syntax_.names.size() != first_name + 1) {
      return refuse("only a name can be assigned to"), 0;
    }
    syntax_.names.back().use = sign.operation == ScriptOperation::Create
                                   ? ScriptUse::Create
                                   : ScriptUse::Change;
    if (is_old() && is_chained_) refuse_old("assignments cannot be chained");
    const bool was_chained = std::exchange(is_chained_, true);
    ++at_;
    const Index right = pass_expression(0);
    is_chained_ = was_chained;
    return is_good() ? add(sign.operation, {left, right}) : 0;
  }

  Index pass_choice(Index condition) {
    ++at_;
    const Index one = in_scope([&] { return pass_expression(0); });
    if (!is_good()) return 0;
    if (here().text != ":") return refuse("`:` is missing after `?`"), 0;
    ++at_;
    const Index other = pass_expression(is_old() ? kTernary + 1 : kTernary);
    if (is_old() && here().text == "?") refuse_old("`?` cannot be chained");
    return is_good() ? add(ScriptOperation::Choose, {condition, one, other})
                     : 0;
  }

  Index pass_operand() {
    const ScriptToken& token = here();
    ScriptTerm term;
    switch (token.kind) {
      case ScriptTokenKind::Name:
        if (token.text.starts_with('@') && is_in(releases::kHasNoRootEntries)) {
          return refuse("names with `@` came with BehaviorTree.CPP 4.6"), 0;
        }
        if (const auto number = enumerator_at(at_)) {
          term.number = *number;
          term.is_integer = is_of_contract_;
          break;
        }
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
        term.is_integer = is_old();
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

  // What is assigned to is an entry, whatever it is called.
  std::optional<int> enumerator_at(std::size_t at) const {
    const auto& enums = syntax_.tree.enums;
    if (!enums) return std::nullopt;
    const Sign* next = sign_of(tokens_[at + 1]);
    if (next != nullptr && next->strength == kAssignment) return std::nullopt;
    const auto found = enums->find(tokens_[at].text);
    return found == enums->end() ? std::nullopt : std::optional(found->second);
  }

  Index pass_prefix() {
    const std::string_view sign = here().text;
    if (sign == "(") {
      ++at_;
      const Index inside = in_scope([&] { return pass_expression(0); });
      if (is_good() && here().text != ")") refuse("`)` is missing");
      if (is_good()) ++at_;
      return inside;
    }
    if (sign == "+" && is_old() &&
        tokens_[at_ + 1].kind == ScriptTokenKind::Number) {
      ++at_;
      return pass_operand();
    }
    if (sign != "-" && sign != "~" && sign != "!") {
      return refuse("an operand is missing"), 0;
    }
    const ScriptOperation operation = sign == "-" ? ScriptOperation::Negate
                                      : sign == "~"
                                          ? ScriptOperation::Complement
                                          : ScriptOperation::Not;
    note_group(operation);
    ++at_;
    const Index of = pass_expression(kPrefix);
    return is_good() ? add(operation, {of}) : 0;
  }

  int release_;
  bool is_of_contract_;
  std::vector<ScriptToken> tokens_;
  std::size_t at_ = 0;
  int nested_ = 0;
  Group group_ = Group::None;  // of the operators of this scope so far
  bool is_chained_ = false;    // on the right of an assignment
  ScriptSyntax syntax_;
};

}  // namespace

std::vector<ScriptToken> tokens_of(std::string_view script, int release) {
  return Tokens(script, release).all();
}

ScriptSyntax parse_script(std::string_view script, int release,
                          std::shared_ptr<const ScriptEnums> enums) {
  return ScriptParser(script, release, std::move(enums), false).parse();
}

ScriptSyntax parse_script(std::string_view script,
                          const BtcppDocument& document) {
  return parse_script(script, document.engine(), enumerators_of(document));
}

ScriptSyntax parse_contract_script(std::string_view script,
                                   const BtcppDocument& document) {
  return ScriptParser(script, kNewestRelease, enumerators_of(document), true)
      .parse();
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
