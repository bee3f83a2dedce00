// SPDX-License-Identifier: MIT
//
// Only for entries of which the script asks more than one question: how they
// compare with literals, and whether they are true. What is computed with a
// value would cut other regions. Of each entry some value is among those taken
// that does not make the script throw.
#include "model/btcpp/entries/regions.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "text/numbers.hpp"

namespace btcheck::btcpp {
namespace {

// What a script asks of an entry.
struct Questions {
  bool is_judged = true;  // nothing else is done with it
  bool may_be_nan = false;
  std::size_t count = 0;
  bool for_truth = false;
  std::set<double> numbers;
  std::set<std::string> texts;
};

std::optional<double> number_literal(const ScriptTree& tree,
                                     const ScriptTerm& term) {
  if (term.operation == ScriptOperation::Number) return term.number;
  if (term.operation != ScriptOperation::Negate) return std::nullopt;
  const ScriptTerm& of = tree.terms[term.operands[0]];
  if (of.operation != ScriptOperation::Number || !of.number)
    return std::nullopt;
  return -*of.number;
}

class Asking {
 public:
  Asking(const BtcppExpansion& expansion, std::uint32_t subtree,
         const ScriptTree& tree)
      : expansion_(expansion), subtree_(subtree), tree_(tree) {}

  std::map<EntryName, Questions> all() {
    for (const std::uint32_t statement : tree_.statements) {
      ask_truth(tree_.terms[statement]);
    }
    for (const ScriptTerm& term : tree_.terms) ask(term);
    return std::move(questions_);
  }

 private:
  // Nothing where the term is no name.
  Questions* of(const ScriptTerm& term) {
    if (term.operation != ScriptOperation::Name) return nullptr;
    return &questions_[entry_of(expansion_, subtree_, term.text)];
  }

  void ask_truth(const ScriptTerm& term) {
    if (Questions* entry = of(term)) ask_truth(*entry);
  }
  static void ask_truth(Questions& entry) {
    entry.for_truth = true;
    ++entry.count;
  }

  void ask(const ScriptTerm& term) {
    const ScriptOperation by = term.operation;
    const bool are_truths = by == ScriptOperation::And ||
                            by == ScriptOperation::Or ||
                            by == ScriptOperation::Not;
    for (std::size_t i = 0; i < term.operands.size(); ++i) {
      const ScriptTerm& operand = tree_.terms[term.operands[i]];
      Questions* entry = of(operand);
      if (entry == nullptr) continue;
      if (by == ScriptOperation::Compare) {
        compare(*entry, term, i);
      } else if (are_truths || (by == ScriptOperation::Choose && i == 0)) {
        ask_truth(*entry);
      } else {
        entry->is_judged = false;
      }
    }
  }

  // The entry that stands at `place`, with all the others.
  void compare(Questions& entry, const ScriptTerm& term, std::size_t place) {
    entry.count += term.comparisons.size();
    for (std::size_t i = 0; i < term.operands.size(); ++i) {
      if (i == place) continue;
      const ScriptTerm& other = tree_.terms[term.operands[i]];
      if (const auto number = number_literal(tree_, other)) {
        entry.numbers.insert(*number);
      } else if (other.operation == ScriptOperation::Text) {
        entry.texts.insert(other.text);
      } else {
        entry.is_judged = false;
      }
    }
  }

  const BtcppExpansion& expansion_;
  std::uint32_t subtree_;
  const ScriptTree& tree_;
  std::map<EntryName, Questions> questions_;
};

bool may_be_open(const ScriptDomain* domain) {
  return domain == nullptr ||
         std::ranges::any_of(domain->values, [](const ScriptValue& value) {
           return value.kind == ScriptKind::Any;
         });
}

// NaN is less than a number and greater, too. What comes from outside is taken
// to be none.
bool may_be_nan(const ScriptWorld& world, const EntryName& entry,
                const ScriptDomain* domain) {
  if (domain == nullptr) return world.lost.contains(entry);
  return std::ranges::any_of(domain->values, [](const ScriptValue& value) {
    return value.kind == ScriptKind::Any && !value.is_outside();
  });
}

// All of one type, or Free.
EntryType type_of(const ScriptDomain* domain) {
  if (domain == nullptr) return EntryType::Free;
  const EntryType type = domain->outside;
  const bool are_alike =
      std::ranges::all_of(domain->values, [&](const ScriptValue& value) {
        return value.kind != ScriptKind::Any || value.noted == type;
      });
  const bool is_told = type == EntryType::Text || type == EntryType::Integer ||
                       type == EntryType::Real;
  return are_alike && is_told ? type : EntryType::Free;
}

// Whether the texts and the numbers that it is asked about can be its own.
bool is_fit(const Questions& asked, EntryType type) {
  if (!asked.is_judged || asked.count < 2) return false;
  if (asked.texts.empty()) return !asked.for_truth || type != EntryType::Text;
  return !asked.for_truth &&
         (type == EntryType::Text || type == EntryType::Free);
}

// Where the regions of numbers meet. A text may be read as a number.
std::set<double> cuts_of(const Questions& asked) {
  std::set<double> cuts = asked.numbers;
  if (asked.for_truth || cuts.empty()) cuts.insert(0);
  if (asked.for_truth) cuts.insert(1);
  for (const std::string& text : asked.texts) {
    if (const auto number = begun_number<double>(text)) cuts.insert(*number);
    if (text == "true") cuts.insert(1);
    if (text == "false") cuts.insert(0);
  }
  return cuts;
}

void add_integers(const std::set<double>& cuts, std::set<ScriptValue>& values) {
  for (const double cut : cuts) {
    const double below = std::floor(cut);
    const double above = std::ceil(cut);
    for (const double each : {below - 1, below, above, above + 1}) {
      values.insert(ScriptValue::integer(each));
    }
  }
}

// Numbers that lie next to a cut are the same for ==, but not for <.
void add_reals(const std::set<double>& cuts, std::set<ScriptValue>& values) {
  constexpr double kNear = std::numeric_limits<float>::epsilon();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  std::set<double> ends;
  for (const double cut : cuts) {
    values.insert(ScriptValue::real(cut));
    ends.insert({cut - kNear, cut, cut + kNear});
  }
  for (auto end = ends.begin(); std::next(end) != ends.end(); ++end) {
    values.insert(ScriptValue::real((*end + *std::next(end)) / 2));
  }
  for (const double end : {-kInfinity, kInfinity}) {
    values.insert(ScriptValue::real(end));
  }
}

// Beside numbers another text may count as any of them; among texts, what comes
// before the first and right behind each stands for what lies between.
void add_texts(const Questions& asked, std::set<ScriptValue>& values) {
  const bool are_alone = asked.numbers.empty() && !asked.for_truth;
  values.insert(are_alone ? ScriptValue::of(std::string())
                          : ScriptValue::any_text());
  for (const std::string& text : asked.texts) {
    values.insert(ScriptValue::of(text));
    if (are_alone) values.insert(ScriptValue::of(text + '\0'));
  }
}

std::set<ScriptValue> values_of(const Questions& asked, EntryType type) {
  std::set<ScriptValue> values;
  const std::set<double> cuts = cuts_of(asked);
  if (type == EntryType::Integer) {
    add_integers(cuts, values);
  } else if (type != EntryType::Text || asked.texts.empty()) {
    add_reals(cuts, values);  // a text that meets numbers alone is one of them
  }
  if (!asked.texts.empty()) add_texts(asked, values);
  if (asked.may_be_nan) {
    values.insert(ScriptValue::real(std::numeric_limits<double>::quiet_NaN()));
  }
  return values;
}

std::vector<ScriptCase> told_apart(const std::vector<ScriptCase>& cases,
                                   const EntryName& entry,
                                   const std::set<ScriptValue>& values) {
  std::vector<ScriptCase> all;
  for (const ScriptCase& each : cases) {
    for (const ScriptValue& value : values) {
      all.push_back(each);
      all.back().emplace(entry, value);
    }
  }
  return all;
}

}  // namespace

std::vector<ScriptCase> cases_of(const BtcppExpansion& expansion,
                                 const ScriptWorld& world,
                                 std::uint32_t subtree,
                                 const ScriptTree& tree) {
  constexpr std::size_t kMostCases = 256;
  constexpr std::size_t kMostWork = 40'000;
  std::size_t size = 1;
  std::map<EntryName, std::set<ScriptValue>> asked;
  for (auto& [entry, questions] : Asking(expansion, subtree, tree).all()) {
    const auto variable = world.variable_of(entry);
    const ScriptDomain* domain = variable ? &world.domain(*variable) : nullptr;
    if (domain != nullptr) size += domain->values.size();
    const EntryType type = type_of(domain);
    questions.may_be_nan = may_be_nan(world, entry, domain);
    if (may_be_open(domain) && is_fit(questions, type)) {
      asked[entry] = values_of(questions, type);
    }
  }
  const std::size_t most = std::min(kMostCases, kMostWork / size);
  std::vector<ScriptCase> cases(1);
  for (const auto& [entry, values] : asked) {
    if (cases.size() * values.size() > most) continue;
    cases = told_apart(cases, entry, values);
  }
  return cases;
}

}  // namespace btcheck::btcpp
