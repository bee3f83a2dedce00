// SPDX-License-Identifier: MIT
//
// (defun name (parameters) expression): names for expressions, which are put
// in the places of their calls.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "model/btf/expression.hpp"
#include "model/btf/forms.hpp"

namespace btcheck::btf {

struct Function {
  std::string name;
  SourceSpan span;                      // of the name
  std::vector<std::string> parameters;  // their keys
  FormId body{};
  bool is_used = false;
};

class Functions {
 public:
  // Reads one (defun …). Of two functions of one name the first counts.
  void declare(const Reading& reading, FormId form);

  const Function* find(std::string_view word) const;
  std::vector<std::string> names() const;

  // False after an error: the function is being called already, or the calls
  // are too many. `head` is the word that calls it.
  bool begin_call(const Scope& scope, const Function& called, const Form& head);

  // Reports functions that nothing calls, and checks what they say.
  void report_unused(const Scope& scope);

 private:
  std::map<std::string, Function, std::less<>> by_key_;
  std::size_t calls_ = 0;
};

}  // namespace btcheck::btf
