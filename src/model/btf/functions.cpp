// SPDX-License-Identifier: MIT
//
// A function has no types of its own: it is read anew for each call, with the
// operands of the call in place of its parameters, so that a mistake is told
// with the line of the call. One that calls itself has no end, and a few short
// ones that call each other twice can become larger than any memory: the calls
// of a file are counted.
#include "model/btf/functions.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace btcheck::btf {
namespace {

constexpr std::size_t kMostCalls = 100'000;
constexpr int kDeepestCall = 100;

constexpr std::string_view kHelp = "write `(defun twice (x) (* 2 x))`";

void refuse(const Reading& reading, SourceSpan span, std::string message) {
  reading.error(span, "BT1022", std::move(message), "", std::string(kHelp));
}

// The keys of the parameters; nothing after an error.
std::optional<std::vector<std::string>> read_parameters(const Reading& reading,
                                                        const Form& list) {
  if (!list.is_list()) {
    refuse(reading, list.span, "the parameters must stand in a list");
    return std::nullopt;
  }
  std::vector<std::string> keys;
  for (const FormId item : list.items) {
    const Form& word = reading.form(item);
    if (!word.is_word() || !is_name(word.text)) {
      refuse(reading, word.span, "a parameter is a name");
      return std::nullopt;
    }
    if (std::ranges::find(keys, name_key(word.text)) != keys.end()) {
      refuse(reading, word.span,
             fmt::format("two parameters are called `{}`", word.text));
      return std::nullopt;
    }
    keys.push_back(name_key(word.text));
  }
  return keys;
}

}  // namespace

void Functions::declare(const Reading& reading, FormId form) {
  const std::vector<FormId>& items = reading.form(form).items;
  const Form& head = *reading.forms.head(form);
  if (items.size() != 4) {
    return refuse(reading, head.span,
                  "`defun` takes a name, parameters and an expression");
  }
  const Form& name = reading.form(items[1]);
  if (!name.is_word() || !is_name(name.text) || find_operator(name.text)) {
    return refuse(reading, name.span,
                  "a function needs a name that is no operator");
  }
  auto parameters = read_parameters(reading, reading.form(items[2]));
  if (!parameters) return;
  const auto [entry, is_new] = by_key_.emplace(
      name_key(name.text), Function{std::string(name.text), name.span,
                                    *std::move(parameters), items[3]});
  if (is_new) return;
  reading.error(
      name.span, "BT1011",
      fmt::format("two functions are called `{}`", name.text),
      "declared again here",
      fmt::format("the first is on line {}", entry->second.span.line));
}

const Function* Functions::find(std::string_view word) const {
  const auto found = by_key_.find(name_key(word));
  return found == by_key_.end() ? nullptr : &found->second;
}

std::vector<std::string> Functions::names() const {
  std::vector<std::string> names;
  for (const auto& [key, function] : by_key_) names.push_back(function.name);
  return names;
}

bool Functions::begin_call(const Scope& scope, const Function& called,
                           const Form& head) {
  const Reading& reading = scope.reading;
  by_key_.find(name_key(called.name))->second.is_used = true;
  int depth = 0;
  for (const Bindings* each = scope.bindings; each; each = each->outer) {
    if (each->function == &called) {
      reading.error(head.span, "BT1022",
                    fmt::format("`{}` calls itself", called.name),
                    fmt::format("it is defined on line {}", called.span.line),
                    "a function stands for its expression; count with a "
                    "variable and `Repeat`");
      return false;
    }
    ++depth;
  }
  reading.findings.case_warning(head.span, head.text, called.name);
  if (depth < kDeepestCall && calls_++ < kMostCalls) return true;
  reading.error(head.span, "BT1002", "the functions are too large together",
                fmt::format("at most {} calls, {} inside each other",
                            kMostCalls, kDeepestCall));
  return false;
}

void Functions::report_unused(const Scope& scope) {
  for (const auto& [key, function] : by_key_) {
    if (function.is_used) continue;
    scope.reading.findings.warning(
        function.span,
        {"BT1021", fmt::format("the function `{}` is not used", function.name),
         "nothing that runs calls it", ""});
    Bindings bindings{{}, function.span.line, &function};
    for (const std::string& parameter : function.parameters) {
      bindings.by_key[parameter] = {};
    }
    Scope inside = scope;
    inside.functions = this;
    inside.bindings = &bindings;
    read_operand(inside, function.body);
  }
}

}  // namespace btcheck::btf
