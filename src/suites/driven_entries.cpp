// SPDX-License-Identifier: MIT
#include "suites/driven_entries.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>
#include <vector>

#include "model/btcpp/tree/entry_programs.hpp"

namespace btcheck {
namespace {

using btcpp::EntryNumber;
using btcpp::EntryProgram;
using btcpp::ScriptOperation;
using btcpp::ScriptTerm;

constexpr std::size_t kMostValues = 8;
constexpr double kMostNumber = 1'000'000;

// What is asked of one entry.
struct AskedEntry {
  std::set<long> numbers;
  std::set<std::string> texts;
  bool is_written = false;  // by a script or a node of the engine
  bool is_made = false;     // by `:=`, or such a node: it need not be there

  std::vector<std::string> values() const {
    std::vector<std::string> values;
    if (!texts.empty()) {
      for (const std::string& text : texts) {
        values.push_back(fmt::format("\"{}\"", text));
      }
      std::string other = "other";
      while (texts.contains(other)) other += '_';
      values.push_back(fmt::format("\"{}\"", other));
    } else {
      for (const long number : numbers) {
        values.push_back(fmt::format("{}", number));
      }
      if (values.empty()) values = {"0", "1"};
    }
    if (values.size() > kMostValues) values.resize(kMostValues);
    return values;
  }
};

bool is_plain(const std::string& text) {
  return std::ranges::none_of(text, [](char c) {
    return c == '"' || c == '\\' || static_cast<unsigned char>(c) < ' ';
  });
}

class Asking {
 public:
  explicit Asking(const btcpp::EntryPrograms& programs)
      : entries_(programs.entries.size()) {
    for (const EntryProgram& program : programs.programs) look_at(program);
  }

  const AskedEntry& entry(EntryNumber number) const { return entries_[number]; }

 private:
  void look_at(const EntryProgram& program) {
    if (program.kind == EntryProgram::Kind::Script) {
      return look_at_script(program);
    }
    if (program.kind == EntryProgram::Kind::Equality) {
      note_text(program.left, program.right);
      return note_text(program.right, program.left);
    }
    if (program.left.entry && program.kind != EntryProgram::Kind::Reading) {
      entries_[*program.left.entry].is_written = true;
      entries_[*program.left.entry].is_made = true;
    }
  }

  void note_text(const btcpp::ProgramOperand& entry,
                 const btcpp::ProgramOperand& literal) {
    if (!entry.entry || literal.entry || !is_plain(literal.text)) return;
    entries_[*entry.entry].texts.insert(literal.text);
  }

  void look_at_script(const EntryProgram& program) {
    const std::vector<ScriptTerm>& terms = program.tree.terms;
    for (const ScriptTerm& term : terms) {
      if (is_assignment(term.operation)) {
        const std::uint32_t name = term.operands[0];
        AskedEntry& entry = entries_[program.names[name]];
        entry.is_written = true;
        if (term.operation == ScriptOperation::Create) entry.is_made = true;
      }
      if (term.operation != ScriptOperation::Compare) continue;
      for (const std::uint32_t one : term.operands) {
        if (terms[one].operation != ScriptOperation::Name) continue;
        for (const std::uint32_t other : term.operands) {
          note_literal(entries_[program.names[one]], terms, other);
        }
      }
    }
  }

  static void note_literal(AskedEntry& entry,
                           const std::vector<ScriptTerm>& terms,
                           std::uint32_t number) {
    const ScriptTerm* term = &terms[number];
    double sign = 1;
    if (term->operation == ScriptOperation::Negate) {
      term = &terms[term->operands[0]];
      sign = -1;
    }
    if (term->operation == ScriptOperation::Text && is_plain(term->text)) {
      entry.texts.insert(term->text);
    }
    if (term->operation != ScriptOperation::Number || !term->number) return;
    const double value = sign * *term->number;
    if (std::abs(value) > kMostNumber) return;
    const long low = static_cast<long>(std::floor(value));
    for (const long near : {low - 1, low, low + 1}) entry.numbers.insert(near);
  }

  std::vector<AskedEntry> entries_;
};

// The declarations, one for each entry of the root.
std::vector<std::string> declarations(const BehaviorTree& tree) {
  std::vector<std::string> forms;
  if (!tree.programs) return forms;
  const Asking asking(*tree.programs);
  std::set<std::string> by_ports;
  for (const EntryUse& use : tree.entry_uses) {
    if (use.is_port && use.writes) {
      by_ports.insert(tree.entry_homes[use.entry].name);
    }
  }
  std::set<std::string> known;
  for (EntryNumber i = 0; i < tree.programs->entries.size(); ++i) {
    const btcpp::ProgramEntry& entry = tree.programs->entries[i];
    const AskedEntry& asked = asking.entry(i);
    const bool is_open = entry.subtree == 0 && !entry.limits &&
                         entry.initial.kind == btcpp::ScriptKind::Unknown &&
                         !asked.is_made && !entry.is_enumerator &&
                         is_plain(entry.key) && known.insert(entry.key).second;
    if (!is_open) continue;
    const std::vector<std::string> values = asked.values();
    // What scripts change has the values that they make of the first.
    const std::string states =
        asked.is_written ? ""
                         : fmt::format(" :states ({})", fmt::join(values, " "));
    const bool is_free = !asked.is_written && !by_ports.contains(entry.name);
    forms.push_back(fmt::format("(defsv {}{} :init {}{})\n", entry.key, states,
                                values[0], is_free ? " :moves free" : ""));
  }
  return forms;
}

std::optional<DrivenTree> read(const TreeInput& input,
                               const std::string& contracts,
                               TickSemantics ticks) {
  DrivenTree driven{input, {}, contracts};
  driven.input.reading.leaves.push_back({"entries of the tests", contracts});
  auto lowered = lowered_input(driven.input, {}, ticks);
  if (!lowered.value || has_error(lowered.diagnostics)) return std::nullopt;
  driven.lowered = std::move(*lowered.value);
  return driven;
}

}  // namespace

std::optional<DrivenTree> driven_tree(const TreeInput& input,
                                      const BehaviorTree& tree,
                                      TickSemantics ticks) {
  const std::vector<std::string> forms = declarations(tree);
  if (forms.empty()) return std::nullopt;
  std::string all;
  for (const std::string& form : forms) all += form;
  auto driven = read(input, all, ticks);
  if (!driven) {
    // Without those that are refused.
    std::string taken;
    for (const std::string& form : forms) {
      if (read(input, taken + form, ticks)) taken += form;
    }
    if (!taken.empty()) driven = read(input, taken, ticks);
  }
  if (driven && driven->lowered.tree.nodes.size() != tree.nodes.size()) {
    return std::nullopt;
  }
  return driven;
}

}  // namespace btcheck
