// SPDX-License-Identifier: MIT
//
// Files of leaf contracts beside an XML tree. The forms are those of .btf files
// and read by the same readers; but what a contract says of blackboard entries
// becomes a script at the leaf, so that names are followed, and values found,
// as in any other: `(and (> level 2) (= mode "auto"))` is
// `((level > 2) && (mode == 'auto'))`. Every list goes into parentheses, so
// that no precedence has to be known.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <string_view>
#include <utility>

#include "model/btcpp/script/script.hpp"
#include "model/btcpp/tree/leaf_rules.hpp"
#include "model/btf/contracts.hpp"
#include "model/btf/expression.hpp"
#include "model/declared_entries.hpp"
#include "model/tree/node_types.hpp"
#include "model/tree_file.hpp"
#include "text/findings.hpp"
#include "text/numbers.hpp"

namespace btcheck::btf {
namespace {

// The operator's sign in scripts, or "" when they have none like it.
std::string_view sign_in_scripts(const Operator& known) {
  using enum Operation;
  using Sign = std::pair<Operation, std::string_view>;
  constexpr std::array<Sign, 6> kOthers = {{{Equal, "=="},
                                            {NotEqual, "!="},
                                            {And, "&&"},
                                            {Or, "||"},
                                            {Not, "!"},
                                            {Modulo, ""}}};
  const auto other = std::ranges::find(kOthers, known.operation, &Sign::first);
  return other == kOthers.end() ? known.sign : other->second;
}

// Writes conditions and assignments as one script.
class ScriptWriter {
 public:
  explicit ScriptWriter(const Reading& reading) : reading_(reading) {}

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
      error(span, "BT1002", "lists are nested too deep for a script");
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
    const std::string_view sign = known ? sign_in_scripts(*known) : "";
    if (sign.empty()) return report_operator(form, head);
    const std::size_t operands = form.items.size() - 1;
    if (operands < known->least || operands > known->most) {
      return error(head->span, "BT1009",
                   fmt::format("`{}` does not take {} operand{}", head->text,
                               operands, operands == 1 ? "" : "s"));
    }
    add("(");
    if (operands == 1 && (sign == "!" || sign == "-")) add(sign);
    open_.push_back({id, sign});
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
                   fmt::format("`{}` is not part of an expression", form.text));
    }
    if (looks_numeric(form.text)) return number(form);
    if (form.text == "true" || form.text == "false") return add(form.text);
    entry(form);
  }

  void text(const Form& form) {
    const std::string_view inside = form.text.substr(1, form.text.size() - 2);
    if (inside.find('\'') != inside.npos) {
      return error(form.span, "BT1008",
                   "scripts cannot write a text with a single quote in it");
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
                   fmt::format("`{}` is no number", form.text));
    }
    add(form.text.starts_with('-') ? fmt::format("(-{})", digits)
                                   : std::string(digits));
  }

  void entry(const Form& form) {
    std::string_view name = form.text;
    if (name.starts_with('$')) name.remove_prefix(1);
    if (name.ends_with(".rstatus")) {
      return error(
          form.span, "BT1014",
          "contracts for XML trees cannot ask what a node has answered",
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
             std::string help = {}) {
    is_broken_ = true;
    reading_.error(span, code, std::move(message), "", std::move(help));
  }

  const Reading& reading_;
  btcpp::ContractScript script_;
  std::vector<Open> open_;
  bool is_broken_ = false;
};

btcpp::ContractScript condition_script(const Reading& reading, FormId form) {
  ScriptWriter writer(reading);
  writer.condition(form);
  return writer.take(reading.form(form).span);
}

// Of assignments `(:= level 3)`, in their order.
btcpp::ContractScript effect_script(const Reading& reading,
                                    const std::vector<FormId>& effects) {
  if (effects.empty()) return {};
  ScriptWriter writer(reading);
  for (const FormId effect : effects) writer.assignment(effect);
  return writer.take(reading.form(effects[0]).span);
}

class FormReader {
 public:
  FormReader(const Reading& reading, std::uint32_t file,
             btcpp::LeafContracts& to)
      : reading_(reading), file_(file), to_(to) {}

  void read() {
    for (const FormId id : reading_.forms.top_level) {
      const Form* head = reading_.forms.head(id);
      const std::string_view word = head ? head->text : "";
      if (equal_ignoring_case(word, "defaction")) {
        read_contract(id, NodeType::Action);
      } else if (equal_ignoring_case(word, "defcondition")) {
        read_contract(id, NodeType::Condition);
      } else if (equal_ignoring_case(word, "defsv")) {
        read_entry(id);
      } else if (equal_ignoring_case(word, "defenum")) {
        read_enumerators(id);
      } else if (reading_.forms.is_balanced) {
        refuse(head ? *head : reading_.form(id));
      }
    }
  }

 private:
  void read_contract(FormId form, NodeType leaf) {
    auto draft =
        read_contract_draft(reading_, form, leaf, ContractPlace::SideFile);
    if (!draft) return;
    btcpp::LeafRule& rule = to_.rules.emplace_back();
    rule.file = file_;
    rule.leaf = leaf;
    rule.name = std::move(draft->name);
    rule.span = draft->span;
    if (draft->has_returns) rule.results = std::move(draft->results);
    rule.has_behavior =
        draft->has_behavior() || draft->meaning == LeafMeaning{};
    rule.meaning = std::move(draft->meaning);
    rule.memory = draft->memory;
    rule.duration = draft->duration;
    if (draft->requirement) {
      rule.requirement = condition_script(reading_, *draft->requirement);
    }
    if (draft->decision) {
      rule.decision = condition_script(reading_, *draft->decision);
    }
    rule.on_success = effect_script(reading_, draft->on_success);
    rule.on_failure = effect_script(reading_, draft->on_failure);
  }

  void read_entry(FormId form) {
    auto entry = declared_entry(reading_, form);
    if (!entry) return;
    entry->file = file_;
    to_.entries.push_back(std::move(*entry));
  }

  // `(defenum RED 1)`, `(defenum RED 1 GREEN 2)`.
  void read_enumerators(FormId id) {
    const std::vector<FormId>& items = reading_.form(id).items;
    for (std::size_t i = 1; i < items.size() || i == 1; i += 2) {
      const Form* name = i < items.size() ? &reading_.form(items[i]) : nullptr;
      const Form* number =
          i + 1 < items.size() ? &reading_.form(items[i + 1]) : nullptr;
      const bool is_name =
          name != nullptr && name->is_word() && is_entry_name(name->text);
      const auto value = number != nullptr ? as_number<int>(number->text)
                                           : std::optional<int>();
      if (!is_name || !value) {
        const Form* wrong = !is_name ? name : number;
        return reading_.error(
            wrong != nullptr ? wrong->span : reading_.forms.head(id)->span,
            "BT1010", "an enumerator is a name and a whole number", "",
            "write `(defenum RED 1 GREEN 2)`");
      }
      to_.enumerators.push_back(
          {file_, name->span, std::string(name->text), *value});
    }
  }

  void refuse(const Form& form) {
    reading_.error(form.span, "BT1004",
                   form.is_list() ? std::string("this is no contract of a leaf")
                                  : fmt::format("`{}` is no contract of a leaf",
                                                form.text),
                   "",
                   "there are `defaction`, `defcondition`, `defsv` and "
                   "`defenum`");
  }

  const Reading& reading_;
  std::uint32_t file_;
  btcpp::LeafContracts& to_;
};

std::vector<Diagnostic> read_file(const InputFile& file, std::uint32_t number,
                                  int tick_ms, btcpp::LeafContracts& to) {
  const SourceText source(file.name, file.text);
  if (auto refusal = source.refuse_binary()) return {std::move(*refusal)};
  const auto parsed = file.text.parsed<ParsedForms>();
  const Forms& forms = parsed->forms;
  Findings findings(source, parsed->findings);
  const Reading reading{forms, findings, {}, tick_ms};
  if (forms.is_complete) FormReader(reading, number, to).read();
  return findings.take();
}

}  // namespace
}  // namespace btcheck::btf

namespace btcheck {

Result<btcpp::LeafContracts> read_leaf_files(
    const std::vector<InputFile>& files, int tick_ms) {
  Result<btcpp::LeafContracts> result;
  btcpp::LeafContracts all;
  for (std::uint32_t i = 0; i < files.size(); ++i) {
    std::ranges::move(btf::read_file(files[i], i, tick_ms, all),
                      std::back_inserter(result.diagnostics));
  }
  if (has_error(result.diagnostics)) return result;
  all.files = files;
  result.value = std::move(all);
  return result;
}

}  // namespace btcheck
