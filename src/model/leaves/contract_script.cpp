// SPDX-License-Identifier: MIT
//
// From prefix to infix, in one walk with an explicit stack: every list goes
// into parentheses, so that no precedence has to be known.
#include "model/leaves/contract_script.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "model/btcpp/literals.hpp"
#include "model/btcpp/script/script.hpp"
#include "text/findings.hpp"

namespace btcheck::btf {
namespace {

constexpr std::size_t kMany = 1 << 20;

struct Operator {
  std::string_view sign;
  std::string_view in_scripts;
  std::size_t least;
  std::size_t most;  // operands
};
constexpr std::array<Operator, 16> kOperators = {{
    {"=", "==", 2, 2},
    {"~=", "!=", 2, 2},
    {"/=", "!=", 2, 2},
    {"!=", "!=", 2, 2},
    {"<", "<", 2, 2},
    {"<=", "<=", 2, 2},
    {">", ">", 2, 2},
    {">=", ">=", 2, 2},
    {"and", "&&", 1, kMany},
    {"or", "||", 1, kMany},
    {"~", "!", 1, 1},
    {"not", "!", 1, 1},
    {"+", "+", 1, kMany},
    {"-", "-", 1, 2},
    {"*", "*", 1, kMany},
    {"/", "/", 2, 2},
}};

const Operator* find_operator(std::string_view sign) {
  const auto found = std::find_if(
      kOperators.begin(), kOperators.end(), [&](const Operator& known) {
        return equal_ignoring_case(known.sign, sign);
      });
  return found == kOperators.end() ? nullptr : &*found;
}

bool is_entry_name(std::string_view word) {
  const auto tokens = btcpp::tokens_of(word);
  return tokens.size() == 2 && tokens[0].kind == btcpp::ScriptTokenKind::Name &&
         tokens[0].text == word;
}

class Writer {
 public:
  explicit Writer(const Reading& reading) : reading_(reading) {}

  void condition(FormId form) {
    open_.clear();
    enter(form);
    while (!open_.empty()) {
      Open& last = open_.back();
      const std::vector<FormId>& items = reading_.form(last.form).items;
      if (last.next == items.size()) {
        add(")");
        open_.pop_back();
        continue;
      }
      if (last.next > 1) add(fmt::format(" {} ", last.sign));
      enter(items[last.next++]);
    }
  }

  void assignment(FormId form) {
    const std::vector<FormId>& items = reading_.form(form).items;
    if (items.size() != 3 || !reading_.form(items[1]).is_word()) {
      return error(reading_.forms.head(form)->span, "BT1009",
                   "`:=` takes an entry and a value",
                   "write `(:= level (+ level 1))`");
    }
    if (!script_.code.empty()) add("; ");
    entry(reading_.form(items[1]));
    add(" := ");
    condition(items[2]);
  }

  // Of a form at this place.
  btcpp::ContractScript take(SourceSpan span) {
    if (!is_broken_ && !btcpp::parse_script(script_.code).flaw.empty()) {
      error(span, "BT1002", "lists are nested too deep for a script", "");
    }
    if (is_broken_) script_ = {};
    return std::move(script_);
  }

 private:
  struct Open {
    FormId form{};
    std::string_view sign;
    std::size_t next = 1;  // operand
  };

  void enter(FormId id) {
    const Form& form = reading_.form(id);
    if (!form.is_list()) return atom(form);
    const Form* head = reading_.forms.head(id);
    const Operator* known = head ? find_operator(head->text) : nullptr;
    if (!known) return report_operator(form, head);
    const std::size_t operands = form.items.size() - 1;
    if (operands < known->least || operands > known->most) {
      return error(head->span, "BT1009",
                   fmt::format("`{}` does not take {} operand{}", head->text,
                               operands, operands == 1 ? "" : "s"),
                   "");
    }
    add("(");
    const bool is_prefix =
        operands == 1 && (known->in_scripts == "!" || known->in_scripts == "-");
    if (is_prefix) add(known->in_scripts);
    open_.push_back({id, known->in_scripts});
  }

  void report_operator(const Form& form, const Form* head) {
    if (head == nullptr) {
      return error(form.span, "BT1004", "an operator must stand here",
                   "write `(= battery \"low\")`, operator first");
    }
    error(head->span, "BT1004",
          fmt::format("`{}` is no operator of contracts for XML trees",
                      head->text),
          "there are `= ~= < <= > >= and or ~ + - * /`");
  }

  void atom(const Form& form) {
    if (form.kind == FormKind::Quoted) return text(form);
    if (!form.is_word()) {
      return error(form.span, "BT1003",
                   fmt::format("`{}` is not part of an expression", form.text),
                   "");
    }
    if (looks_numeric(form.text)) return number(form);
    if (form.text == "true" || form.text == "false") return add(form.text);
    entry(form);
  }

  void text(const Form& form) {
    const std::string_view inside = form.text.substr(1, form.text.size() - 2);
    if (inside.find('\'') != inside.npos) {
      return error(form.span, "BT1008",
                   "a text with a single quote is none that scripts can have",
                   "");
    }
    add(fmt::format("'{}'", inside));
  }

  void number(const Form& form) {
    std::string_view digits = form.text;
    if (digits.starts_with('+') || digits.starts_with('-')) {
      digits.remove_prefix(1);
    }
    const auto tokens = btcpp::tokens_of(digits);
    if (tokens.size() != 2 ||
        tokens[0].kind != btcpp::ScriptTokenKind::Number) {
      return error(form.span, "BT1008",
                   fmt::format("`{}` is no number", form.text), "");
    }
    add(form.text.starts_with('-') ? fmt::format("(-{})", digits)
                                   : std::string(digits));
  }

  void entry(const Form& form) {
    std::string_view name = form.text;
    if (name.starts_with('$')) name.remove_prefix(1);
    if (name.ends_with(".rstatus")) {
      return error(form.span, "BT1014",
                   "what nodes have answered is not known to XML trees",
                   "a contract can look at blackboard entries");
    }
    if (!is_entry_name(name)) {
      return error(form.span, "BT1003",
                   fmt::format("`{}` is no name of an entry", form.text),
                   "a text stands in quotes");
    }
    script_.entries.push_back({std::string(name), form.span});
    add(name);
  }

  void add(std::string_view more) { script_.code += more; }

  void error(SourceSpan span, std::string_view code, std::string message,
             std::string help) {
    is_broken_ = true;
    reading_.findings.error(span,
                            {code, std::move(message), "", std::move(help)});
  }

  const Reading& reading_;
  btcpp::ContractScript script_;
  std::vector<Open> open_;
  bool is_broken_ = false;
};

}  // namespace

btcpp::ContractScript condition_script(const Reading& reading, FormId form) {
  Writer writer(reading);
  writer.condition(form);
  return writer.take(reading.form(form).span);
}

btcpp::ContractScript effect_script(const Reading& reading,
                                    const std::vector<FormId>& effects) {
  if (effects.empty()) return {};
  Writer writer(reading);
  for (const FormId effect : effects) writer.assignment(effect);
  return writer.take(reading.form(effects[0]).span);
}

std::optional<btcpp::FirstValue> first_value(const Reading& reading,
                                             FormId form) {
  constexpr std::array<KeywordRule, 1> kRules = {{{"init"}}};
  const Parts parts = take_apart(reading, form, kRules);
  const auto error = [&](SourceSpan span, std::string_view code,
                         std::string message) {
    reading.findings.error(
        span, {code, std::move(message), "", "write `(defsv level :init 3)`"});
    return std::nullopt;
  };
  const bool is_unknown =
      report_unknown_keywords(reading, parts, kRules, "defsv");
  const Form& head = *reading.forms.head(form);
  const Form* name =
      parts.items.empty() ? nullptr : &reading.form(parts.items.front());
  if (!name || !name->is_word() || !is_entry_name(name->text)) {
    return error(name ? name->span : head.span, "BT1010",
                 "an entry needs a name");
  }
  if (parts.items.size() > 1) {
    return error(reading.form(parts.items[1]).span, "BT1010",
                 "this belongs to no keyword");
  }
  const Clause* init = find_clause(reading, parts, "init");
  if (is_unknown) return std::nullopt;
  if (!init) {
    return error(name->span, "BT1006",
                 fmt::format("`{}` needs `:init`", name->text));
  }
  const Form& value = reading.form(*init->value);
  btcpp::FirstValue first;
  first.entry = {std::string(name->text), name->span};
  if (value.kind == FormKind::Quoted) {
    first.value = btcpp::ScriptValue::of(
        std::string(value.text.substr(1, value.text.size() - 2)));
  } else if (const auto number = btcpp::parse_number(value.text);
             number && looks_numeric(value.text)) {
    const bool is_integer = value.text.find_first_of(".eE") == value.text.npos;
    first.value = is_integer ? btcpp::ScriptValue::integer(*number)
                             : btcpp::ScriptValue::real(*number);
  } else {
    return error(
        value.span, "BT1008",
        fmt::format("`{}` is no number and no text in quotes", value.text));
  }
  return first;
}

}  // namespace btcheck::btf
