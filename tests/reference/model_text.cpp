// SPDX-License-Identifier: MIT
//
// What the readers of exported models share. Expressions are read with two
// stacks (Dijkstra's shunting yard, 1961), so nothing recurses; `case`, `?:`
// and parentheses are brackets on the stack of operators.
#include "reference/model_text.hpp"

#include <algorithm>
#include <stdexcept>

namespace btcheck::reference {
namespace {

using Code = ReadExpression::Code;

bool is_space(char c) { return c == ' ' || c == '\n' || c == '\t'; }
bool is_of_word(char c) {
  return c == '_' || (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') ||
         (c >= 'A' && c <= 'Z');
}

[[noreturn]] void fail(const std::string& what) {
  throw std::runtime_error(what);
}

int tightness_of(Code code) {
  switch (code) {
    case Code::Implies:
      return 0;
    case Code::Or:
      return 1;
    case Code::And:
      return 2;
    case Code::Add:
    case Code::Subtract:
      return 4;
    case Code::Multiply:
    case Code::Divide:
    case Code::Modulo:
      return 5;
    case Code::Not:
    case Code::Negate:
    case Code::Keep:
      return 6;
    default:
      return 3;
  }
}

class Yard {
 public:
  Yard(WordReader& words, const OperatorWords& operators,
       const NameTable& names)
      : words_(words), operators_(operators), names_(names) {}

  ReadExpression run() {
    while (wants_operand_ ? operand() : after_operand()) {
    }
    reduce_to_bracket();
    if (!open_.empty()) fail("not closed: " + open_.back().bracket);
    return std::move(made_);
  }

 private:
  // An operator that waits for its right side, or an open bracket.
  struct Open {
    Code code = Code::Constant;
    std::string bracket;  // "(", "?", ":", "case", "of"; "" for an operator
    int parts = 0;        // pairs of a case
  };

  bool operand() {
    const std::string word = words_.take();
    const auto unary = operators_.unary.find(word);
    if (unary != operators_.unary.end()) {
      open_.push_back({unary->second, "", 0});
      return true;
    }
    if (word == "(" || word == "case") {
      open_.push_back({Code::Constant, word, 0});
      return true;
    }
    wants_operand_ = false;
    if (word[0] >= '0' && word[0] <= '9') {
      made_.items.push_back({Code::Constant, std::stoi(word)});
      return true;
    }
    const auto named = names_.find(word);
    if (named == names_.end()) fail("unknown name " + word);
    constexpr Code kCodes[] = {Code::Constant, Code::Variable,
                               Code::Definition};
    made_.items.push_back(
        {kCodes[static_cast<int>(named->second.kind)], named->second.number});
    return true;
  }

  bool after_operand() {
    if (words_.at_end()) return false;
    const std::string& word = words_.peek();
    const auto binary = operators_.binary.find(word);
    if (binary != operators_.binary.end()) {
      reduce(tightness_of(binary->second));
      open_.push_back({binary->second, "", 0});
      words_.take();
      return wants_operand_ = true;
    }
    if (word == "in") return among();
    return bracket(word);
  }

  bool among() {
    reduce(tightness_of(Code::Equal));
    words_.expect("in");
    words_.expect("{");
    int count = 0;
    do {
      made_.items.push_back({Code::Constant, names_.at(words_.take()).number});
      ++count;
    } while (words_.accept(","));
    words_.expect("}");
    made_.items.push_back({Code::Among, count});
    return true;
  }

  // A word that closes or continues a bracket; false when there is none.
  bool bracket(const std::string& word) {
    if (word != ")" && word != "?" && word != ":" && word != ";") return false;
    reduce_to_bracket();
    if (open_.empty()) return false;
    Open& inner = open_.back();
    if (word == ")") {
      close_parenthesis();
    } else if (word == "?" && inner.bracket == "(") {
      open_.push_back({Code::Choose, "?", 0});
      wants_operand_ = true;
    } else if (word == ":" &&
               (inner.bracket == "?" || inner.bracket == "case")) {
      inner.bracket = inner.bracket == "?" ? ":" : "of";
      wants_operand_ = true;
    } else if (word == ";" && inner.bracket == "of") {
      words_.take();
      next_case(inner);
      return true;
    } else {
      return false;
    }
    words_.take();
    return true;
  }

  void close_parenthesis() {
    if (open_.back().bracket == ":") {
      made_.items.push_back({Code::Choose, 0});
      open_.pop_back();
    }
    if (open_.empty() || open_.back().bracket != "(") fail("a stray )");
    open_.pop_back();
  }

  void next_case(Open& inner) {
    ++inner.parts;
    inner.bracket = "case";
    wants_operand_ = true;
    if (!words_.accept("esac")) return;
    made_.items.push_back({Code::Case, inner.parts});
    open_.pop_back();
    wants_operand_ = false;
  }

  void reduce(int tightness) {
    while (!open_.empty() && open_.back().bracket.empty() &&
           tightness_of(open_.back().code) >= tightness) {
      made_.items.push_back({open_.back().code, 0});
      open_.pop_back();
    }
  }
  void reduce_to_bracket() { reduce(-1); }

  WordReader& words_;
  const OperatorWords& operators_;
  const NameTable& names_;
  ReadExpression made_;
  std::vector<Open> open_;
  bool wants_operand_ = true;
};

std::int64_t combined(Code code, std::int64_t a, std::int64_t b) {
  switch (code) {
    case Code::And:
      return a != 0 && b != 0;
    case Code::Or:
      return a != 0 || b != 0;
    case Code::Implies:
      return a == 0 || b != 0;
    case Code::Equal:
      return a == b;
    case Code::NotEqual:
      return a != b;
    case Code::Less:
      return a < b;
    case Code::LessEqual:
      return a <= b;
    case Code::Greater:
      return a > b;
    case Code::GreaterEqual:
      return a >= b;
    case Code::Add:
      return a + b;
    case Code::Subtract:
      return a - b;
    case Code::Multiply:
      return a * b;
    case Code::Divide:
      if (b == 0) fail("a division by zero");
      return a / b;
    case Code::Modulo:
      if (b == 0) fail("a division by zero");
      return a % b;
    default:
      fail("not an operation of two operands");
  }
}

// The last `count` values, taken off.
std::vector<std::int64_t> taken(std::vector<std::int64_t>& stack,
                                std::size_t count) {
  std::vector<std::int64_t> values(stack.end() - static_cast<int>(count),
                                   stack.end());
  stack.resize(stack.size() - count);
  return values;
}

std::int64_t first_case(const std::vector<std::int64_t>& pairs) {
  for (std::size_t i = 0; i + 1 < pairs.size(); i += 2) {
    if (pairs[i] != 0) return pairs[i + 1];
  }
  fail("no case fits");
}

std::int64_t applied(ReadExpression::Item item,
                     std::vector<std::int64_t>& stack) {
  const auto count = static_cast<std::size_t>(item.operand);
  if (item.code == Code::Case) return first_case(taken(stack, 2 * count));
  if (item.code == Code::Among) {
    const auto values = taken(stack, count + 1);
    return std::count(values.begin() + 1, values.end(), values[0]) > 0;
  }
  if (item.code == Code::Choose) {
    const auto values = taken(stack, 3);
    return values[0] != 0 ? values[1] : values[2];
  }
  const std::int64_t last = stack.back();
  stack.pop_back();
  if (item.code == Code::Not) return last == 0;
  if (item.code == Code::Negate) return -last;
  if (item.code == Code::Keep) return last;
  const std::int64_t first = stack.back();
  stack.pop_back();
  return combined(item.code, first, last);
}

}  // namespace

std::vector<std::string> words_of(std::string_view text,
                                  const std::vector<std::string>& signs,
                                  std::string_view line_comment) {
  std::vector<std::string> words;
  std::size_t at = 0;
  const auto begins = [&](std::string_view with) {
    return text.substr(at, with.size()) == with;
  };
  const auto skip_past = [&](std::string_view end) {
    const std::size_t found = text.find(end, at);
    at = found == text.npos ? text.size() : found + end.size();
  };
  while (at < text.size()) {
    if (is_space(text[at])) {
      ++at;
    } else if (begins(line_comment)) {
      skip_past("\n");
    } else if (begins("/*")) {
      skip_past("*/");
    } else if (is_of_word(text[at])) {
      const std::size_t start = at;
      while (at < text.size() && is_of_word(text[at])) ++at;
      words.emplace_back(text.substr(start, at - start));
    } else {
      const auto sign = std::find_if(signs.begin(), signs.end(), begins);
      words.emplace_back(sign == signs.end() ? text.substr(at, 1)
                                             : std::string_view(*sign));
      at += words.back().size();
    }
  }
  return words;
}

const std::string& WordReader::peek(std::size_t ahead) const {
  static const std::string nothing;
  return at_ + ahead < words_.size() ? words_[at_ + ahead] : nothing;
}

std::string WordReader::take() {
  if (at_end()) fail("the text ends too early");
  return words_[at_++];
}

void WordReader::expect(std::string_view word) {
  const std::string found = take();
  if (found == word) return;
  std::string before;
  for (std::size_t i = at_ < 12 ? 0 : at_ - 12; i < at_; ++i) {
    before += words_[i] + " ";
  }
  fail("expected " + std::string(word) + " at the end of " + before);
}

bool WordReader::accept(std::string_view word) {
  if (peek() != word) return false;
  take();
  return true;
}

int WordReader::number() {
  const int sign = accept("-") ? -1 : 1;
  return sign * std::stoi(take());
}

std::int64_t ReadExpression::value(
    const std::function<std::int64_t(int)>& variable,
    const std::function<std::int64_t(int)>& definition) const {
  std::vector<std::int64_t> stack;
  stack.reserve(items.size());
  for (const Item& item : items) {
    if (item.code == Code::Constant) {
      stack.push_back(item.operand);
    } else if (item.code == Code::Variable) {
      stack.push_back(variable(item.operand));
    } else if (item.code == Code::Definition) {
      stack.push_back(definition(item.operand));
    } else {
      const std::int64_t made = applied(item, stack);
      stack.push_back(made);
    }
  }
  if (stack.size() != 1) fail("not one value");
  return stack[0];
}

ReadExpression read_expression(WordReader& words,
                               const OperatorWords& operators,
                               const NameTable& names) {
  return Yard(words, operators, names).run();
}

}  // namespace btcheck::reference
