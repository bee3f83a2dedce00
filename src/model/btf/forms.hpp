// SPDX-License-Identifier: MIT
//
// A .btf file as nested lists, before it means anything: `(defsv x :max 3)` is
// a list of the words `defsv` and `x`, a keyword and another word (forms.cpp).
// Then a list taken apart: its `:keyword value` pairs, what the values may be,
// and the items that belong to no keyword (keywords.cpp).
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "model/tree/tree.hpp"
#include "text/diagnostic.hpp"
#include "text/findings.hpp"

namespace btcheck::btf {

enum class FormKind : unsigned char {
  List,      // ( and what follows up to its )
  Close,     // ) — a word of the text, never a form
  Keyword,   // :name, with its colon
  Interval,  // [2,5], with its brackets
  Quoted,    // "any text", with its quotes
  Word       // everything else: names, numbers, operators, :=
};

// One word of the text.
struct Token {
  FormKind kind = FormKind::Word;
  std::string_view text;  // a piece of the source
  SourceSpan span;
};

// Index into Forms::all.
enum class FormId : std::uint32_t {};

struct Form {
  FormKind kind = FormKind::Word;
  std::string_view text;  // "" for a list
  SourceSpan span;        // a list's is its opening parenthesis
  std::vector<FormId> items;
  std::uint32_t first_token = 0;
  std::uint32_t end_token = 0;

  bool is_list() const { return kind == FormKind::List; }
  bool is_word() const { return kind == FormKind::Word; }
};

struct Forms {
  std::vector<Token> tokens;
  std::vector<Form> all;
  std::vector<FormId> top_level;
  bool is_balanced = true;
  bool is_complete = true;  // false when reading stopped at a limit

  const Form& operator[](FormId id) const {
    return all[static_cast<std::uint32_t>(id)];
  }
  // The word a list begins with; null when there is none.
  const Form* head(FormId id) const;
  // The form in one line, one blank between words.
  std::string written(FormId id) const;
};

// The forms of a text: at most 500 levels and a million words. What is
// wrong with a word or a parenthesis is reported, and what follows is read on.
// A list that encloses the whole file is opened: its items are the top level.
struct ParsedForms {
  explicit ParsedForms(const std::string& text);

  SourceText source;  // of a file without a name
  Findings findings{source};
  Forms forms;
};

// The forms of a file, and where to say what is wrong with them.
struct Reading {
  const Forms& forms;
  Findings& findings;
  // Of what is read anew for each use: "as used on line 12".
  std::string_view use = {};
  int tick_ms = 100;  // what a tick takes

  const Form& form(FormId id) const { return forms[id]; }
  void error(SourceSpan span, std::string_view code, std::string message,
             std::string label = {}, std::string help = {}) const {
    if (!use.empty()) message.append(" (").append(use).append(")");
    findings.error(
        span, {code, std::move(message), std::move(label), std::move(help)});
  }
};

// What may follow a keyword: nothing (or 0 or 1), nothing (or yes or no), one
// word, a list or a word.
enum class Takes : unsigned char { Flag, YesNo, Word, List };

// Of a variable or an entry whose values are named.
inline constexpr std::size_t kMostDeclaredStates = 256;

struct KeywordRule {
  std::string_view name;  // without the colon
  Takes takes = Takes::Word;
  std::uint64_t types = ~std::uint64_t{0};  // of nodes: a bit for each NodeType
  std::uint64_t needed_by = 0;              // likewise
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
  // Reports every keyword that is not in `rules`. True if there is one.
  bool report_unknown(std::span<const KeywordRule> rules,
                      std::string_view of) const;
  // Null when there is none.
  const Form* first_item() const;

  // The value of a clause that has one; nothing after an error.
  const Form& value(const Clause& clause) const;
  std::optional<int> integer(const Clause& clause, int min, int max) const;
  std::optional<std::string> name(const Clause& clause) const;
  std::optional<Duration> duration(const Clause& clause) const;
  // `(key value key value …)`; what is wrong is left out.
  std::vector<Argument> arguments(const Clause& clause) const;
  // `:halt`, `:halt 1`.
  bool flag(std::string_view name) const;
  // `:may-be-lost`, `:may-be-lost no`; nothing where it is not given.
  std::optional<bool> yes_or_no(std::string_view name) const;

  // The name of a keyword as written, `:halt`.
  std::string_view text(const Clause& clause) const;
  // That the value is none of the keyword's.
  void report_value(const Clause& clause, std::string expected,
                    std::string help = {}) const;

 private:
  std::optional<int> integer_between(const Clause& clause, int min,
                                     int max) const;
  bool is_before_list(const Form& keyword) const;

  const Reading& reading_;
  std::span<const KeywordRule> rules_;
};

bool is_keyword(const Form& form, std::string_view name);

// `n`, `[min,max]` or `(min max)`, in ticks; `500ms`, `[0.5s,2.5s]`, where
// parts of a tick count as a whole one; `inf` for max. Nothing after an error,
// which calls it `what`.
std::optional<Duration> read_duration(const Reading& reading, FormId form,
                                      std::string_view what);

// Numbers in a .btf file, up and down.
inline constexpr int kLargest = std::numeric_limits<int>::max();
// With decimals, counted in the last one: so that a number of a rule that is
// far out of range can be told from all of them (check/bind/comparison.cpp).
inline constexpr int kLargestScaled = 1'000'000'000;
// What `NODE.rstatus` ends with.
inline constexpr std::string_view kStatusSuffix = ".rstatus";
// A whole number as text; nothing when it is none or beyond 18 digits.
std::optional<long long> whole_number(std::string_view text);
// True for anything that begins like a number.
bool looks_numeric(std::string_view text);
// The name in `$name`, or the word as it is.
std::string_view without_dollar(std::string_view word);
// The words that open a form of a .btf file, and the keywords that its nodes,
// variables and contracts have: for who colours or completes them.
std::vector<std::string> definition_words();
std::span<const KeywordRule> node_keywords();
std::span<const KeywordRule> variable_keywords();
std::span<const KeywordRule> contract_keywords();

// True for a word that can name something: no number, no operator, no `$`.
bool is_name(std::string_view word);
// A word in lower case: two names are the same when their keys are.
std::string name_key(std::string_view word);

// The candidate nearest to a word, "did you mean `level`?", or all of them:
// "its states are `Low` and `High`".
std::string nearest_or_all(std::string_view word,
                           const std::vector<std::string>& candidates,
                           std::string_view introduction = "there are");

}  // namespace btcheck::btf
