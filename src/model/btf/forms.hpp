// SPDX-License-Identifier: MIT
//
// A .btf file as nested lists, before it means anything: `(defsv x :max 3)` is
// a list of the words `defsv` and `x`, a keyword and another word.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

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

// Reads the forms of a text: at most 500 levels and a million words. What is
// wrong with a word or a parenthesis is reported, and what follows is read on.
// A list that encloses the whole file is opened: its items are the top level.
Forms read_forms(std::string_view text, Findings& findings);

}  // namespace btcheck::btf
