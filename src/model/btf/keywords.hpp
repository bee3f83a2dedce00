// SPDX-License-Identifier: MIT
//
// The `:keyword value` pairs of a form, and the values they take.
#pragma once

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

// The forms of a file, and where to say what is wrong with them.
struct Reading {
  const Forms& forms;
  Findings& findings;

  const Form& form(FormId id) const { return forms[id]; }
};

// What may follow a keyword: nothing (or 0 or 1), one word, a list or a word.
enum class Takes : unsigned char { Flag, Word, List };

struct KeywordRule {
  std::string_view name;  // without the colon
  Takes takes = Takes::Word;
};

struct Clause {
  FormId keyword{};
  std::optional<FormId> value;
};

// A list taken apart: its keywords in order, and the items that belong to
// none. The head is in neither.
struct Parts {
  std::vector<Clause> clauses;
  std::vector<FormId> items;
};

// Takes a list apart. Of a keyword that is not in `rules` one word is taken.
Parts take_apart(const Reading& reading, FormId list,
                 std::span<const KeywordRule> rules);

// The clause with that keyword. Errors: a second one (BT1006); a clause
// without its value (BT1006) counts as absent.
const Clause* find_clause(const Reading& reading, const Parts& parts,
                          std::string_view name);

// Reports every keyword that is not in `rules` (BT1005). True if there is one.
bool report_unknown_keywords(const Reading& reading, const Parts& parts,
                             std::span<const KeywordRule> rules,
                             std::string_view of);

// The name of a keyword, as `:halt`.
std::string keyword_text(const Reading& reading, const Clause& clause);
bool is_keyword(const Form& form, std::string_view name);

// A whole number as text; nothing when it is none or beyond 18 digits.
std::optional<long long> whole_number(std::string_view text);
// True for anything that begins like a number.
bool looks_numeric(std::string_view text);
// True for a word that can name something: no number, no operator, no `$`.
bool is_name(std::string_view word);

// The value of a clause, or an error (BT1008) and nothing.
std::optional<int> read_integer(const Reading& reading, const Clause& clause,
                                int min, int max);
std::optional<bool> read_switch(const Reading& reading, const Clause& clause);
std::optional<std::string> read_name(const Reading& reading,
                                     const Clause& clause);
std::optional<double> read_rate(const Reading& reading, FormId value);
// `n`, `[min,max]` or `(min max)`, in ticks.
std::optional<Duration> read_duration(const Reading& reading,
                                      const Clause& clause);
// `(key value key value …)`; what is wrong is left out with an error.
std::vector<Argument> read_arguments(const Reading& reading,
                                     const Clause& clause);

}  // namespace btcheck::btf
