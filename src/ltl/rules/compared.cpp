// SPDX-License-Identifier: MIT
#include "ltl/rules/compared.hpp"

#include "text/utf8.hpp"

namespace btcheck {
namespace {

// A truth is a number, too.
void add(const Operand& other, std::set<double>& to) {
  if (other.is_number) to.insert(other.number.nearest());
  const std::string word = lowered(other.name);
  if (word == "true") to.insert(1);
  if (word == "false") to.insert(0);
}

}  // namespace

void add_compared(const PropertyFile& rules, ComparedNumbers& to) {
  const auto numbers_of = [&](const Operand& operand) -> std::set<double>* {
    if (operand.name.empty() || !operand.node.empty()) return nullptr;
    return &to[lowered(operand.name)];
  };
  for (const Atom& atom : rules.atoms) {
    if (atom.kind == AtomKind::Comparison) {
      if (auto* left = numbers_of(atom.left)) add(atom.right, *left);
      if (auto* right = numbers_of(atom.right)) add(atom.left, *right);
    } else if (atom.kind == AtomKind::Range) {
      if (auto* of = numbers_of(atom.left))
        of->insert({atom.low.nearest(), atom.high.nearest()});
    }
  }
}

}  // namespace btcheck
