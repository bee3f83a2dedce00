// SPDX-License-Identifier: MIT
//
// SMV as src/model/export/smv/smv.cpp writes it, read and explored.
//
// Of the language: one module with VAR, IVAR, INIT (a conjunction of
// equations), DEFINE, TRANS (`step = S -> condition`, or `next(v) = value`),
// JUSTICE, and specifications, of which INVARSPEC is evaluated and the others
// are stepped over. Nothing is known of networks.
#include <algorithm>
#include <stdexcept>

#include "reference/model_text.hpp"
#include "reference/read_model.hpp"

namespace btcheck::reference {
namespace {

using Code = ReadExpression::Code;

const OperatorWords& smv_operators() {
  static const OperatorWords words{{{"&", Code::And},
                                    {"|", Code::Or},
                                    {"->", Code::Implies},
                                    {"=", Code::Equal},
                                    {"!=", Code::NotEqual},
                                    {"<", Code::Less},
                                    {"<=", Code::LessEqual},
                                    {">", Code::Greater},
                                    {">=", Code::GreaterEqual},
                                    {"+", Code::Add},
                                    {"-", Code::Subtract},
                                    {"*", Code::Multiply},
                                    {"/", Code::Divide},
                                    {"mod", Code::Modulo}},
                                   {{"!", Code::Not}, {"-", Code::Negate}}};
  return words;
}

struct Domain {
  int low = 0;
  int high = 0;
};

class SmvModel {
 public:
  explicit SmvModel(const std::string& text)
      : words_(words_of(text, {":=", "->", "!=", "<=", ">=", ".."}, "--")) {
    names_["TRUE"] = {NameKind::Constant, 1};
    names_["FALSE"] = {NameKind::Constant, 0};
    words_.expect("MODULE");
    words_.expect("main");
    while (!words_.at_end()) section(words_.take());
    if (next_.size() != domains_.size()) {
      throw std::runtime_error("a variable without a next value");
    }
  }

  std::optional<ReadSpace> explored(std::size_t most) {
    ReadSpace space;
    for (const auto& [name, claim] : invariants_) space.always[name] = true;
    std::map<std::vector<int>, bool> known;
    std::vector<std::vector<int>> found{initial_};
    known[initial_] = true;
    for (std::size_t i = 0; i < found.size(); ++i) {
      if (found.size() > most) return std::nullopt;
      const std::vector<int> state = found[i];
      enter(state);
      for (const auto& [name, claim] : invariants_) {
        space.always[name] = space.always[name] && value(claim) != 0;
      }
      for (int step = 0; step < step_count_; ++step) {
        if (!may(step)) continue;
        const std::vector<int> next = after(step);
        if (step == 0 && next == state) continue;  // idle
        ++space.transitions;
        if (known.emplace(next, true).second) found.push_back(next);
      }
    }
    space.states = found.size();
    return space;
  }

 private:
  // --- reading ---

  void section(const std::string& keyword) {
    if (keyword == "VAR") {
      while (words_.peek(1) == ":") declaration();
    } else if (keyword == "IVAR") {
      input();
    } else if (keyword == "INIT") {
      initial_values();
    } else if (keyword == "DEFINE") {
      while (words_.peek(1) == ":=") definition();
    } else if (keyword == "TRANS") {
      constraint();
    } else if (keyword == "INVARSPEC") {
      const std::string name = specification();
      invariants_[name] = expression();
      words_.expect(";");
    } else if (keyword == "LTLSPEC" || keyword == "CTLSPEC" ||
               keyword == "JUSTICE") {
      while (words_.take() != ";") {
      }
    } else {
      throw std::runtime_error("no section " + keyword);
    }
  }

  std::string specification() {
    words_.expect("NAME");
    const std::string name = words_.take();
    words_.expect(":=");
    return name;
  }

  ReadExpression expression() {
    return read_expression(words_, smv_operators(), names_);
  }

  // `low..high`, `boolean` or `{a, b}`, whose names become constants.
  Domain domain() {
    if (words_.accept("boolean")) return {0, 1};
    if (!words_.accept("{")) {
      const int low = words_.number();
      words_.expect("..");
      return {low, words_.number()};
    }
    int count = 0;
    do {
      const std::string name = words_.take();
      const NamedThing constant{NameKind::Constant, count++};
      const auto known = names_.emplace(name, constant).first;
      if (known->second.kind != NameKind::Constant ||
          known->second.number != constant.number) {
        throw std::runtime_error("two meanings of " + name);
      }
    } while (words_.accept(","));
    words_.expect("}");
    return {0, count - 1};
  }

  void declaration() {
    const std::string name = words_.take();
    words_.expect(":");
    const int place = static_cast<int>(domains_.size());
    if (!names_.emplace(name, NamedThing{NameKind::Variable, place}).second) {
      throw std::runtime_error("declared twice: " + name);
    }
    domains_.push_back(domain());
    words_.expect(";");
  }

  // The first value of the input variable is the step of time.
  void input() {
    const std::string name = words_.take();
    words_.expect(":");
    step_count_ = domain().high + 1;
    words_.expect(";");
    names_[name] = {NameKind::Variable, static_cast<int>(domains_.size())};
    may_.resize(static_cast<std::size_t>(step_count_));
  }

  std::size_t place_of(const std::string& name) const {
    const NamedThing& named = names_.at(name);
    if (named.kind != NameKind::Variable) {
      throw std::runtime_error("no variable " + name);
    }
    return static_cast<std::size_t>(named.number);
  }

  void initial_values() {
    initial_.assign(domains_.size(), 0);
    std::size_t given = 0;
    do {
      const std::size_t place = place_of(words_.take());
      if (!words_.accept("=")) {
        initial_[place] = 1;  // a truth value
      } else if (names_.count(words_.peek()) > 0) {
        initial_[place] = names_.at(words_.take()).number;
      } else {
        initial_[place] = words_.number();
      }
      ++given;
    } while (words_.accept("&"));
    words_.expect(";");
    if (given != domains_.size()) {
      throw std::runtime_error("a variable without an initial value");
    }
  }

  void definition() {
    const std::string name = words_.take();
    words_.expect(":=");
    definitions_.push_back(expression());
    words_.expect(";");
    const int place = static_cast<int>(definitions_.size()) - 1;
    if (!names_.emplace(name, NamedThing{NameKind::Definition, place}).second) {
      throw std::runtime_error("defined twice: " + name);
    }
  }

  void constraint() {
    if (words_.accept("next")) {
      words_.expect("(");
      const std::size_t place = place_of(words_.take());
      words_.expect(")");
      words_.expect("=");
      if (!next_.emplace(place, expression()).second) {
        throw std::runtime_error("two next values of one variable");
      }
    } else {
      words_.expect("step");
      words_.expect("=");
      const int step = names_.at(words_.take()).number;
      words_.expect("->");
      may_.at(static_cast<std::size_t>(step)).push_back(expression());
    }
    words_.expect(";");
  }

  // --- meaning ---

  void enter(const std::vector<int>& state) {
    present_ = state;
    present_.push_back(0);  // the step
    known_.assign(definitions_.size(), std::nullopt);
  }

  std::int64_t value(const ReadExpression& of) {
    return of.value(
        [this](int place) { return present_[static_cast<std::size_t>(place)]; },
        [this](int place) { return defined(place); });
  }

  // Definitions only use earlier ones, so this goes a few calls deep.
  std::int64_t defined(int place) {
    const auto at = static_cast<std::size_t>(place);
    if (!known_[at]) known_[at] = value(definitions_[at]);
    return *known_[at];
  }

  bool may(int step) {
    present_.back() = step;
    return std::ranges::all_of(may_[static_cast<std::size_t>(step)],
                               [this](const ReadExpression& condition) {
                                 return value(condition) != 0;
                               });
  }

  std::vector<int> after(int step) {
    present_.back() = step;
    std::vector<int> next(domains_.size());
    for (const auto& [place, expression] : next_) {
      next[place] = static_cast<int>(value(expression));
      if (next[place] < domains_[place].low ||
          next[place] > domains_[place].high) {
        throw std::runtime_error("a next value out of its range");
      }
    }
    return next;
  }

  WordReader words_;
  NameTable names_;
  std::vector<Domain> domains_;
  int step_count_ = 0;
  std::vector<int> initial_;
  std::vector<ReadExpression> definitions_;
  std::vector<std::vector<ReadExpression>> may_;  // by step
  std::map<std::size_t, ReadExpression> next_;    // by variable
  std::map<std::string, ReadExpression> invariants_;

  std::vector<int> present_;  // the state, then the step
  std::vector<std::optional<std::int64_t>> known_;
};

}  // namespace

std::optional<ReadSpace> read_smv_space(const std::string& text,
                                        std::size_t most) {
  return SmvModel(text).explored(most);
}

}  // namespace btcheck::reference
