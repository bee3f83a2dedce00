// SPDX-License-Identifier: MIT
//
// The automata of the formulas of the literature, beside SPIN's never claims.
//
// Prints a table in Markdown for the formulas, or with the argument `negations`
// for their negations, which is what checking a property translates. Three
// automata of each: ours, with acceptance sets on transitions; ours with
// acceptance on states, which is the form of a never claim; and what `spin -f`
// prints. Both programs read the same formula, written out from one syntax
// tree with every parenthesis. SPIN has no W: it is given each of the two usual
// ways to write it, and the smaller claim counts.
#include <fmt/format.h>

#include <array>
#include <cassert>
#include <compare>
#include <cstddef>
#include <cstdio>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>

#include "ltl/buchi/translate.hpp"
#include "ltl/formula_list.hpp"
#include "ltl/formula_text.hpp"
#include "reference/spin.hpp"
#include "reference/state_based.hpp"

namespace btcheck {
namespace {

struct Size {
  std::size_t states = 0;
  std::size_t transitions = 0;

  Size& operator+=(const Size& other) {
    states += other.states;
    transitions += other.transitions;
    return *this;
  }
  friend auto operator<=>(const Size&, const Size&) = default;
};

struct Row {
  std::string formula;
  Size ours;
  Size on_states;
  std::optional<Size> spin;
};

std::string output_of(const std::string& command) {
  std::string text;
  FILE* pipe = ::popen(command.c_str(), "r");
  if (pipe == nullptr) return text;
  std::array<char, 4096> block;
  while (std::fgets(block.data(), block.size(), pipe) != nullptr) {
    text += block.data();
  }
  ::pclose(pipe);
  return text;
}

// States are labels, of which several in a row are one state; transitions are
// the lines `:: guard -> …`, also those that end in accept_all by an assert.
// The `skip` of accept_all is one transition, `false;` is none.
Size size_of_never_claim(const std::string& claim) {
  Size size;
  bool follows_label = false;
  std::istringstream lines(claim);
  for (std::string line; std::getline(lines, line);) {
    const bool is_label = !line.empty() && line.back() == ':';
    if (is_label && !follows_label) ++size.states;
    follows_label = is_label;
    if (line.starts_with("\t::") || line == "\tskip") ++size.transitions;
  }
  return size;
}

// Nothing when SPIN takes more than 20 seconds.
std::optional<Size> size_by_spin(const FormulaPool& pool, FormulaId id) {
  const std::string claim = output_of(
      "timeout 20 spin -f '" + reference::spin_text(pool, id) + "' 2>&1");
  if (!claim.starts_with("never") || !claim.ends_with("}\n")) {
    return std::nullopt;
  }
  return size_of_never_claim(claim);
}

// The formula with `[] a || (a U b)` for each a W b.
FormulaId without_weak_until(FormulaPool& pool, FormulaId id) {
  std::map<FormulaId, FormulaId> rewritten;
  for (const FormulaId part : pool.nodes(id)) {
    const FormulaNode node = pool[part];
    FormulaId& to = rewritten[part];
    to = part;
    if (is_leaf(node.kind)) continue;
    const FormulaId left = rewritten.at(node.left);
    if (is_unary(node.kind)) {
      to = pool.unary(node.kind, left);
      continue;
    }
    const FormulaId right = rewritten.at(node.right);
    to = node.kind == FormulaKind::WeakUntil
             ? pool.binary(FormulaKind::Or,
                           pool.unary(FormulaKind::Always, left),
                           pool.binary(FormulaKind::Until, left, right))
             : pool.binary(node.kind, left, right);
  }
  return rewritten.at(id);
}

// Nothing for formulas with X, which SPIN as Debian builds it does not know.
// The smaller claim of the two ways to write W (the other is spin_text's V).
std::optional<Size> best_by_spin(FormulaPool& pool, FormulaId id) {
  if (pool.has_next(id)) return std::nullopt;
  const std::optional<Size> one = size_by_spin(pool, id);
  const FormulaId other_id = without_weak_until(pool, id);
  if (other_id == id) return one;
  const std::optional<Size> other = size_by_spin(pool, other_id);
  if (!one || !other) return one ? one : other;
  return *other < *one ? other : one;
}

Row row_of(std::string_view text, std::string_view sign) {
  FormulaPool pool;
  FormulaId id = parse(pool, text);
  if (!sign.empty()) id = pool.unary(FormulaKind::Not, id);
  Row row;
  row.formula = sign.empty() ? std::string(text) : fmt::format("!({})", text);
  const auto automaton = translate(pool, id);
  assert(automaton);
  row.ours.states = automaton->state_count();
  for (const auto& some : automaton->transitions) {
    row.ours.transitions += some.size();
  }
  const BuchiAutomaton on_states = reference::state_based(*automaton);
  row.on_states.states = on_states.state_count();
  row.on_states.transitions = reference::connected_pairs(on_states);
  row.spin = best_by_spin(pool, id);
  return row;
}

std::string text_of(const std::optional<Size>& size) {
  return size ? fmt::format("{}, {}", size->states, size->transitions) : "–";
}

// In a table of Markdown a bar ends the column, even inside back quotes.
std::string in_table(std::string text) {
  for (std::size_t at = 0; (at = text.find('|', at)) != std::string::npos;) {
    text.insert(at, "\\");
    at += 2;
  }
  return "`" + text + "`";
}

void print(const std::string& formula, const Row& row) {
  std::printf("%s",
              fmt::format("| {} | {} | {} | {} |\n", formula, text_of(row.ours),
                          text_of(row.on_states), text_of(row.spin))
                  .c_str());
  std::fflush(stdout);
}

void print_table(std::string_view sign) {
  std::printf(
      "| formula | ours: states, transitions | ours, acceptance on states | "
      "`spin -f`: states, transitions |\n|---|--:|--:|--:|\n");
  Row total;
  total.spin = Size{};
  int compared = 0;
  for (const ListedFormula& listed : kFormulas) {
    const Row row = row_of(listed.text, sign);
    print(in_table(row.formula), row);
    if (!row.spin) continue;
    ++compared;
    total.ours += row.ours;
    total.on_states += row.on_states;
    *total.spin += *row.spin;
  }
  print(fmt::format("**total of the {} that both have**", compared), total);
}

}  // namespace
}  // namespace btcheck

int main(int count, char** words) {
  const bool negates = count == 2 && std::string_view(words[1]) == "negations";
  if (count > 1 && !negates) {
    std::fprintf(stderr, "usage: automata_sizes [negations]\n");
    return 2;
  }
  btcheck::print_table(negates ? "!" : "");
  return 0;
}
