// SPDX-License-Identifier: MIT
#include "ltl/rules/compared.hpp"

#include <string_view>

#include "text/numbers.hpp"
#include "text/utf8.hpp"

namespace btcheck {
namespace {

class Collection {
 public:
  Collection(ComparedNumbers& numbers, ComparedNames& names)
      : numbers_(numbers), names_(names) {}

  void add(const Atom& atom) {
    if (atom.kind == AtomKind::Comparison) {
      add(atom.left, atom.right);
      add(atom.right, atom.left);
    } else if (atom.kind == AtomKind::Range && is_variable(atom.left)) {
      numbers_[lowered(atom.left.name)].insert(
          {atom.low.nearest(), atom.high.nearest()});
    } else if (atom.kind == AtomKind::ProcessState) {
      add_value(atom.word);
    }
  }

 private:
  static bool is_variable(const Operand& operand) {
    return !operand.name.empty() && operand.node.empty();
  }

  // `drone/2/state minus_5`: which variable that is depends on the tree.
  void add_value(std::string_view word) {
    constexpr std::string_view kMinus = "minus_";
    const bool is_negative = word.starts_with(kMinus);
    if (is_negative) word.remove_prefix(kMinus.size());
    const auto number = as_number<double>(word);
    if (number) numbers_[""].insert(is_negative ? -*number : *number);
  }

  // A truth is a number, too.
  void add(const Operand& of, const Operand& other) {
    if (!is_variable(of)) return;
    std::set<double>& numbers = numbers_[lowered(of.name)];
    if (other.is_number) numbers.insert(other.number.nearest());
    const std::string word = lowered(other.name);
    if (word == "true") {
      numbers.insert(1);
    } else if (word == "false") {
      numbers.insert(0);
    } else if (!word.empty()) {
      names_[lowered(of.name)].insert(word);
    }
  }

  ComparedNumbers& numbers_;
  ComparedNames& names_;
};

}  // namespace

void add_compared(const PropertyFile& rules, ComparedNumbers& to,
                  ComparedNames& names) {
  Collection collection(to, names);
  for (const Atom& atom : rules.atoms) collection.add(atom);
}

}  // namespace btcheck
