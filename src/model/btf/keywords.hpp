// SPDX-License-Identifier: MIT
//
// A form taken apart: its `:keyword value` pairs, what the values may be, and
// the items that belong to no keyword.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "model/btf/forms.hpp"
#include "model/tree/tree.hpp"
#include "text/diagnostic.hpp"
#include "text/findings.hpp"

namespace btcheck::btf {

// Numbers in a .btf file, up and down.
inline constexpr int kLargest = 1'000'000'000;

// The forms of a file, and where to say what is wrong with them.
struct Reading {
  const Forms& forms;
  Findings& findings;

  const Form& form(FormId id) const { return forms[id]; }
  void error(SourceSpan span, std::string_view code, std::string message,
             std::string label = {}, std::string help = {}) const {
    findings.error(
        span, {code, std::move(message), std::move(label), std::move(help)});
  }
};

// What may follow a keyword: nothing (or 0 or 1), one word, a list or a word.
enum class Takes : unsigned char { Flag, Word, List };

struct KeywordRule {
  std::string_view name;  // without the colon
  Takes takes = Takes::Word;
  std::uint64_t types = ~std::uint64_t{0};  // of nodes: a bit for each NodeType
};

struct Clause {
  FormId keyword{};
  std::optional<FormId> value;
};

class Clauses {
 public:
  // Takes a list apart; its head is left out. Of a keyword that is not in
  // `rules`, which must outlive this, one word is taken.
  Clauses(const Reading& reading, FormId list,
          std::span<const KeywordRule> rules);

  std::vector<Clause> all;    // in order
  std::vector<FormId> items;  // that belong to none

  // The clause of a keyword. One that has no value counts as absent and is an
  // error, as is a second one.
  const Clause* find(std::string_view name) const;
  // True also for a keyword without its value.
  bool is_given(std::string_view name) const;
  const KeywordRule* rule_of(const Clause& clause) const;
  // Reports every keyword that is neither in `rules` nor in `others`. True if
  // there is one.
  bool report_unknown(std::span<const KeywordRule> rules, std::string_view of,
                      std::span<const KeywordRule> others = {}) const;
  // Null when there is none.
  const Form* first_item() const;

  // The value of a clause that has one; nothing after an error.
  const Form& value(const Clause& clause) const;
  std::optional<int> integer(const Clause& clause, int min, int max) const;
  std::optional<std::string> name(const Clause& clause) const;
  // `n`, `[min,max]` or `(min max)`, in ticks.
  std::optional<Duration> duration(const Clause& clause) const;
  // `(key value key value …)`; what is wrong is left out.
  std::vector<Argument> arguments(const Clause& clause) const;
  // `:halt`, `:halt 1`.
  bool flag(std::string_view name) const;

  // The name of a keyword as written, `:halt`.
  std::string_view text(const Clause& clause) const;

 private:
  void report_value(const Clause& clause, std::string expected,
                    std::string help = {}) const;
  std::optional<int> integer_between(const Clause& clause, int min,
                                     int max) const;
  std::vector<std::string_view> words_of(const Form& duration) const;

  const Reading& reading_;
  std::span<const KeywordRule> rules_;
};

bool is_keyword(const Form& form, std::string_view name);

// A whole number as text; nothing when it is none or beyond 18 digits.
std::optional<long long> whole_number(std::string_view text);
// True for anything that begins like a number.
bool looks_numeric(std::string_view text);
// True for a word that can name something: no number, no operator, no `$`.
bool is_name(std::string_view word);
// A word in lower case: two names are the same when their keys are.
std::string name_key(std::string_view word);

// Ticks per second; nothing after an error.
std::optional<double> read_rate(const Reading& reading, FormId value);

}  // namespace btcheck::btf
