// SPDX-License-Identifier: MIT
//
// A .btf file as nested lists, before it means anything.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "model/btf/lexer.hpp"
#include "text/diagnostic.hpp"
#include "text/findings.hpp"

namespace btcheck::btf {

// Index into Forms::all.
enum class FormId : std::uint32_t {};

enum class FormKind : unsigned char { List, Keyword, Interval, Quoted, Word };

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

// Nests the words. At most 500 levels and a million words; a missing or
// surplus parenthesis is reported and what follows is read on. The list that
// may enclose the whole file is opened: its items are the top level.
Forms read_forms(std::vector<Token> tokens, Findings& findings);

}  // namespace btcheck::btf
