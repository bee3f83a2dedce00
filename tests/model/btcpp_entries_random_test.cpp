// SPDX-License-Identifier: MIT
//
// Random scripts on random values: what the engine does is among what their
// meaning allows, and where all is known the meaning is exact.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "btcpp_text.hpp"
#include "model/btcpp/entries/meaning.hpp"
#include "model/btcpp/script/script.hpp"
#include "random_script.hpp"
#include "script_engine.hpp"

namespace btcheck::btcpp::btcpp_entries_random_test {
namespace {

using script_engine::Blackboard;
using script_engine::Script;
using script_engine::text_of;
using script_engine::Thrown;
using script_engine::Value;
using script_engine::Writer;

std::string escaped(std::string_view script) {
  std::string all;
  for (const char c : script) {
    if (c == '<') {
      all += "&lt;";
    } else if (c == '&') {
      all += "&amp;";
    } else {
      all += c;
    }
  }
  return all;
}

// Values from outside are taken to be of the kind that the tree gives an entry:
// in a wild script they may not be.
bool stands_for(const ScriptValue& value, const Value* concrete, bool is_wild) {
  const bool is_absent = concrete == nullptr || concrete->index() == 0;
  if (value.kind == ScriptKind::Unknown) return true;
  if (value.is_nothing()) return is_absent;
  if (is_absent) return false;
  if (value.kind == ScriptKind::Any) return true;
  if (value.kind == ScriptKind::AnyText) {
    return script_engine::is_text(*concrete);
  }
  if (value.kind == ScriptKind::Text) {
    return script_engine::is_text(*concrete) &&
           std::get<std::string>(*concrete) == value.text;
  }
  if (!script_engine::is_number(*concrete)) return false;
  const bool is_integer = concrete->index() == 1;
  if (!is_wild && value.type != NumberType::Either &&
      is_integer != (value.type == NumberType::Integer)) {
    return false;
  }
  const double number = script_engine::as_double(*concrete);
  if (std::isnan(number)) {
    return value.is_any_number() || value.kind == ScriptKind::NotANumber;
  }
  if (value.kind == ScriptKind::NotANumber) return false;
  if (value.kind == ScriptKind::Number) {
    const bool has_sign =
        number == 0 && !is_integer && value.type != NumberType::Either;
    return number == value.number &&
           (!has_sign || std::signbit(number) == value.is_minus_zero);
  }
  return value.kind == ScriptKind::AtLeast ? number >= value.number
                                           : number <= value.number;
}

struct Counts {
  int runs = 0;
  int thrown = 0;
  int assigned = 0;
  int known = 0;  // entries afterwards that are not unknown
  int decided = 0;
  int exact = 0;
  int small = 0;  // of those, one short statement over few values
  int exact_small = 0;
};

// One tree of some scripts, run in a random order.
class Trial {
 public:
  Trial(std::mt19937& random, bool is_wild, Counts& counts)
      : random_(random), is_wild_(is_wild), counts_(counts) {
    Writer writer(random, is_wild);
    std::string leaves;
    for (int i = 0; i < 4; ++i) {
      scripts_.push_back(i == 0 ? writer.first() : writer.statements());
      leaves += "<Script code=\"" + escaped(text_of(scripts_.back())) + "\"/>";
    }
    tree_ = good_tree(tree4("<Sequence>" + leaves + "</Sequence>"));
    world_ = script_world(tree_.expansion);
    for (const StateVariable& each : world_.variables) {
      state_.push_back(each.initial);
    }
  }

  void run() {
    preset();
    if (random_() % 4 != 0 && !is_run(scripts_.front())) return;
    for (int step = 0; step < 8; ++step) {
      const auto& statements = scripts_[random_() % scripts_.size()];
      if (!is_run(statements)) return;
    }
  }

 private:
  // What a program may put into the entries before the first tick: what is of
  // the kind that the tree puts there.
  void preset() {
    for (const auto& [entry, variable] : world_.of) {
      if (is_wild_ || random_() % 4 == 0) continue;
      const ScriptDomain& domain = world_.domains[index(variable)];
      const bool takes_texts = domain.values.back().kind == ScriptKind::Text;
      if (takes_texts) {
        board_[entry.name] = std::string(random_() % 2 == 0 ? "idle" : "x");
      }
    }
    if (random_() % 4 != 0) board_["free"] = std::int64_t{1};
  }

  std::int64_t evaluated(const Expression& expression) const {
    return expression.evaluate([&](const Term& term) {
      return state_[static_cast<std::size_t>(term.operand)];
    });
  }

  const Value* concrete(const EntryName& entry) const {
    const auto found = board_.find(entry.name);
    return found == board_.end() ? nullptr : &found->second;
  }

  bool is_known(const ScriptSyntax& syntax) const {
    for (const ScriptName& name : syntax.names) {
      const auto found = world_.of.find({0, name.name});
      if (found == world_.of.end()) return false;
      const auto id = index(found->second);
      const auto state = static_cast<std::size_t>(state_[id]);
      const ScriptKind kind = world_.domains[id].values[state].kind;
      if (kind != ScriptKind::Number && kind != ScriptKind::Text) return false;
    }
    return true;
  }

  bool is_small() const {
    return std::all_of(world_.domains.begin(), world_.domains.end(),
                       [](const auto& d) { return d.values.size() <= 9; });
  }

  // Without an assignment inside an expression, which would be read again.
  static bool is_short(const std::vector<Script>& statements) {
    if (statements.size() != 1) return false;
    const std::string text = statements.front().text();
    const auto inside = text.find('(');
    return text.size() < 40 &&
           (inside == text.npos || (text.find(":=", inside) == text.npos &&
                                    text.find("+=", inside) == text.npos));
  }

  // False when the engine throws.
  bool is_run(const std::vector<Script>& statements) {
    const std::string text = text_of(statements);
    CAPTURE(text);
    const ScriptMeaning meaning =
        compile_script(tree_.expansion, world_, 0, parse_script(text));
    const bool was_known = is_known(parse_script(text));
    const bool may_hold = evaluated(meaning.may_hold) != 0;
    const bool may_fail = evaluated(meaning.may_fail) != 0;
    const bool may_throw =
        evaluated(meaning.may_throw) != 0 || evaluated(meaning.may_lack) != 0;
    const bool may_be_none = evaluated(meaning.may_be_no_truth) != 0;
    ++counts_.runs;
    Value last;
    try {
      for (const Script& each : statements)
        last = script_engine::run(each, board_);
    } catch (const Thrown&) {
      ++counts_.thrown;
      CHECK(may_throw);
      return false;
    }
    CHECK(evaluated(meaning.may_end) != 0);
    assign(meaning);
    try {
      const bool is_true = script_engine::as_truth(last);
      CHECK((is_true ? may_hold : may_fail));
      if (!is_wild_ && was_known) {
        ++counts_.decided;
        const bool is_exact = may_hold != may_fail;
        if (is_exact) ++counts_.exact;
        if (is_small() && is_short(statements)) {
          ++counts_.small;
          if (is_exact) ++counts_.exact_small;
        }
      }
    } catch (const Thrown&) {
      CHECK(may_be_none);
    }
    check_entries(was_known);
    return true;
  }

  void assign(const ScriptMeaning& meaning) {
    for (const StateAssignment& each : meaning.assignments) {
      const auto value = evaluated(each.value);
      const StateVariable& variable = world_.variables[index(each.variable)];
      REQUIRE(value >= 0);
      REQUIRE(value <= variable.max);
      state_[index(each.variable)] = static_cast<int>(value);
    }
  }

  void check_entries(bool was_known) {
    for (const auto& [entry, variable] : world_.of) {
      const ScriptDomain& domain = world_.domains[index(variable)];
      const auto state = static_cast<std::size_t>(state_[index(variable)]);
      const Value* now = concrete(entry);
      const std::string& name = entry.name;
      CAPTURE(name);
      const std::string& value =
          world_.variables[index(variable)].states[state];
      CAPTURE(value);
      const std::string held = now == nullptr ? "none"
                               : now->index() == 0
                                   ? "empty"
                                   : script_engine::as_text(*now);
      CAPTURE(held);
      CHECK(stands_for(domain.values[state], now, is_wild_));
      if (is_wild_ || !was_known) continue;
      ++counts_.assigned;
      if (state != 0 || !is_in(domain, now)) ++counts_.known;
    }
  }

  // Whether the entry's value could have been told.
  static bool is_in(const ScriptDomain& domain, const Value* now) {
    for (const ScriptValue& each : domain.values) {
      const bool is_known =
          each.kind == ScriptKind::Number || each.kind == ScriptKind::Text;
      if (is_known && stands_for(each, now, false)) return true;
    }
    return false;
  }

  std::mt19937& random_;
  bool is_wild_;
  Counts& counts_;
  std::vector<std::vector<Script>> scripts_;
  ReadTree tree_;
  ScriptWorld world_;
  std::vector<int> state_;
  Blackboard board_;
};

Counts run_trials(int count, bool is_wild) {
  Counts counts;
  for (int seed = 0; seed < count; ++seed) {
    CAPTURE(seed);
    std::mt19937 random(static_cast<unsigned>(seed));
    Trial(random, is_wild, counts).run();
  }
  return counts;
}

TEST_CASE("what the engine does is what a wild script may do") {
  const Counts counts = run_trials(750, true);
  MESSAGE(counts.runs << " runs, of which " << counts.thrown << " throw");
  CHECK(counts.runs - counts.thrown > 500);
}

TEST_CASE("what the engine does is what a well-typed script does") {
  const Counts counts = run_trials(750, false);
  MESSAGE(counts.runs << " runs, " << counts.thrown << " throw; of "
                      << counts.decided << " from known values " << counts.exact
                      << " are decided, and " << counts.known << " of "
                      << counts.assigned << " entries known afterwards");
  CHECK(counts.decided > 500);
  CHECK(counts.small > 150);
  // A condition that grows beyond its bound says less.
  CHECK(counts.exact_small * 1000 > counts.small * 995);
  CHECK(counts.exact * 100 > counts.decided * 94);
  CHECK(counts.known * 100 > counts.assigned * 98);
}

}  // namespace
}  // namespace btcheck::btcpp::btcpp_entries_random_test
