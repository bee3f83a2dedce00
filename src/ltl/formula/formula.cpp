// SPDX-License-Identifier: MIT
//
// Formulas, each stored once.
//
// Nodes live in one vector and are found again by an open-addressing table of
// their numbers. As an operand is stored before its operator, every pass over
// a formula is a loop over ascending (or, from the root, descending) ids with
// one mark for each node; nothing recurses.
#include "ltl/formula/formula.hpp"

#include <algorithm>
#include <cassert>
#include <queue>
#include <string_view>
#include <utility>

namespace btcheck {

namespace {

constexpr std::uint32_t kFree = 0xffffffff;

std::uint64_t hash(const FormulaNode& node) {
  std::uint64_t value = static_cast<std::uint64_t>(node.kind);
  for (const std::uint32_t part :
       {node.atom, index(node.left), index(node.right)}) {
    value = (value ^ part) * 0x9e3779b97f4a7c15u;
    value ^= value >> 29;
  }
  return value;
}

// By FormulaKind.
constexpr std::string_view kSymbols[] = {
    "true", "false", "",    "not ", " and ", " or ", " => ", " <=> ",
    "X ",   "<> ",   "[] ", " U ",  " W ",   " R ",  "E ",   "A "};

std::string_view symbol(FormulaKind kind) {
  return kSymbols[static_cast<std::size_t>(kind)];
}

// True when `inner` needs no parentheses as an operand of `outer`. Tools agree
// that unary operators bind tightest and an implication less tightly than `and`
// and `or`; on everything else they differ.
bool stands_bare(FormulaKind outer, FormulaKind inner, bool is_left) {
  if (is_leaf(inner) || is_unary(inner)) return true;
  if (inner != FormulaKind::And && inner != FormulaKind::Or) return false;
  if (outer == inner) return is_left;
  return outer == FormulaKind::Implies || outer == FormulaKind::Equivalent;
}

// An atom of several words, `fls > 3`, stands in parentheses below these.
bool sets_off_atom(FormulaKind outer) {
  return is_unary(outer) || is_temporal(outer);
}

// Writes a formula piece by piece; a stack holds the pieces that follow.
class Writer {
 public:
  Writer(const FormulaPool& pool,
         const std::function<std::string(std::uint32_t)>& atom)
      : pool_(pool), atom_(atom) {}

  std::string write(FormulaId id) {
    stack_.push_back({.id = id});
    while (!stack_.empty()) {
      const Piece piece = stack_.back();
      stack_.pop_back();
      if (piece.literal.empty()) {
        write_formula(piece);
      } else {
        out_ += piece.literal;
      }
    }
    return std::move(out_);
  }

 private:
  struct Piece {
    std::string_view literal = {};  // instead of the formula if not empty
    FormulaId id{};
    bool sets_off_atom = false;
  };

  void push_literal(std::string_view literal) { stack_.push_back({literal}); }

  void write_formula(const Piece& piece) {
    const FormulaNode& node = pool_[piece.id];
    if (node.kind == FormulaKind::Atom) {
      const std::string word = atom_(node.atom);
      const bool apart =
          piece.sets_off_atom && word.find(' ') != std::string::npos;
      out_ += apart ? "(" + word + ")" : word;
    } else if (is_leaf(node.kind)) {
      out_ += symbol(node.kind);
    } else if (is_path_quantifier(node.kind) &&
               is_path_operator(pool_[node.left].kind) &&
               is_unary(pool_[node.left].kind)) {
      write_quantified(node.kind, pool_[node.left]);
    } else if (is_unary(node.kind)) {
      push_operand(node.kind, node.left, false);
      push_literal(symbol(node.kind));
    } else {
      push_operand(node.kind, node.right, false);
      push_literal(symbol(node.kind));
      push_operand(node.kind, node.left, true);
    }
  }

  // AG p, EF p, AX p: two letters and no blank between them.
  void write_quantified(FormulaKind quantifier, const FormulaNode& path) {
    out_ += quantifier == FormulaKind::ExistsPath ? 'E' : 'A';
    out_ += path.kind == FormulaKind::Always       ? "G "
            : path.kind == FormulaKind::Eventually ? "F "
                                                   : "X ";
    push_operand(path.kind, path.left, false);
  }

  void push_operand(FormulaKind outer, FormulaId operand, bool is_left) {
    const bool bare = stands_bare(outer, pool_[operand].kind, is_left);
    if (!bare) push_literal(")");
    stack_.push_back({.id = operand, .sets_off_atom = sets_off_atom(outer)});
    if (!bare) push_literal("(");
  }

  const FormulaPool& pool_;
  const std::function<std::string(std::uint32_t)>& atom_;
  std::vector<Piece> stack_;
  std::string out_;
};

// True when a node of the formula is of such a kind.
bool has_kind(const FormulaPool& pool, FormulaId id,
              bool (*is_such)(FormulaKind)) {
  return std::ranges::any_of(
      pool.nodes(id), [&](FormulaId node) { return is_such(pool[node].kind); });
}

// Pushes the operands of a node, the left one on top.
void push_operands(const FormulaNode& node, std::vector<FormulaId>& stack) {
  if (is_leaf(node.kind)) return;
  if (!is_unary(node.kind)) stack.push_back(node.right);
  stack.push_back(node.left);
}

Polarity joined(Polarity one, Polarity other) {
  return static_cast<Polarity>(static_cast<std::uint8_t>(one) |
                               static_cast<std::uint8_t>(other));
}

Polarity flipped(Polarity of) {
  if (of == Polarity::Positive) return Polarity::Negative;
  return of == Polarity::Negative ? Polarity::Positive : of;
}

}  // namespace

FormulaPool::FormulaPool() : slots_(16, kFree) {
  intern({.kind = FormulaKind::True});
  intern({.kind = FormulaKind::False});
}

FormulaId FormulaPool::atom(std::uint32_t number) {
  return intern({.kind = FormulaKind::Atom, .atom = number});
}

FormulaId FormulaPool::unary(FormulaKind kind, FormulaId of) {
  assert(is_unary(kind));
  return intern({.kind = kind, .left = of});
}

FormulaId FormulaPool::binary(FormulaKind kind, FormulaId left,
                              FormulaId right) {
  assert(!is_unary(kind) && !is_leaf(kind));
  return intern({.kind = kind, .left = left, .right = right});
}

FormulaId FormulaPool::intern(FormulaNode node) {
  const std::size_t mask = slots_.size() - 1;
  std::size_t slot = hash(node) & mask;
  for (; slots_[slot] != kFree; slot = (slot + 1) & mask) {
    if (nodes_[slots_[slot]] == node) return FormulaId{slots_[slot]};
  }
  const auto number = static_cast<std::uint32_t>(nodes_.size());
  slots_[slot] = number;
  nodes_.push_back(node);
  if (nodes_.size() * 2 > slots_.size()) grow();
  return FormulaId{number};
}

void FormulaPool::grow() {
  slots_.assign(slots_.size() * 2, kFree);
  const std::size_t mask = slots_.size() - 1;
  for (std::uint32_t number = 0; number < nodes_.size(); ++number) {
    std::size_t slot = hash(nodes_[number]) & mask;
    while (slots_[slot] != kFree) slot = (slot + 1) & mask;
    slots_[slot] = number;
  }
}

std::vector<FormulaId> FormulaPool::nodes(FormulaId id) const {
  // Each stands behind its parts: the last one first. What a formula among
  // thousands has does not depend on the others.
  std::priority_queue<std::uint32_t> wanted;
  wanted.push(index(id));
  std::vector<FormulaId> found;
  while (!wanted.empty()) {
    const std::uint32_t i = wanted.top();
    while (!wanted.empty() && wanted.top() == i) wanted.pop();
    found.push_back(FormulaId{i});
    if (is_leaf(nodes_[i].kind)) continue;
    wanted.push(index(nodes_[i].left));
    if (!is_unary(nodes_[i].kind)) wanted.push(index(nodes_[i].right));
  }
  std::ranges::reverse(found);
  return found;
}

bool FormulaPool::is_state_formula(FormulaId id) const {
  return !has_kind(*this, id, is_temporal);
}

bool FormulaPool::is_branching(FormulaId id) const {
  return has_kind(*this, id, is_path_quantifier);
}

bool FormulaPool::has_next(FormulaId id) const {
  return has_kind(*this, id,
                  [](FormulaKind kind) { return kind == FormulaKind::Next; });
}

std::vector<std::uint32_t> FormulaPool::atoms(FormulaId id) const {
  std::vector<std::uint32_t> found;
  for (const FormulaId node : nodes(id)) {
    if ((*this)[node].kind == FormulaKind::Atom) {
      found.push_back((*this)[node].atom);
    }
  }
  std::sort(found.begin(), found.end());
  return found;
}

std::string FormulaPool::text(
    FormulaId id, const std::function<std::string(std::uint32_t)>& atom) const {
  return Writer(*this, atom).write(id);
}

std::optional<FormulaId> first_non_ctl(const FormulaPool& formulas,
                                       FormulaId formula) {
  std::vector<bool> seen(index(formula) + 1);
  std::vector<FormulaId> waiting{formula};
  while (!waiting.empty()) {
    const FormulaId id = waiting.back();
    waiting.pop_back();
    if (seen[index(id)]) continue;
    seen[index(id)] = true;
    const FormulaNode& node = formulas[id];
    if (is_path_operator(node.kind)) return id;
    if (is_path_quantifier(node.kind)) {
      const FormulaNode& path = formulas[node.left];
      if (!is_path_operator(path.kind)) return id;
      push_operands(path, waiting);
    } else {
      push_operands(node, waiting);
    }
  }
  return std::nullopt;
}

// One pass from operators to operands; the left side of an implication counts
// as negated, both sides of an equivalence as both.
std::vector<Polarity> polarities(const FormulaPool& pool, FormulaId whole) {
  std::vector<Polarity> found(index(whole) + 1, Polarity::None);
  found[index(whole)] = Polarity::Positive;
  for (std::uint32_t i = index(whole) + 1; i-- > 0;) {
    const FormulaNode& node = pool[FormulaId{i}];
    if (found[i] == Polarity::None || is_leaf(node.kind)) continue;
    Polarity left = found[i];
    if (node.kind == FormulaKind::Not || node.kind == FormulaKind::Implies) {
      left = flipped(left);
    }
    Polarity right = found[i];
    if (node.kind == FormulaKind::Equivalent) left = right = Polarity::Both;
    found[index(node.left)] = joined(found[index(node.left)], left);
    if (is_unary(node.kind)) continue;
    found[index(node.right)] = joined(found[index(node.right)], right);
  }
  return found;
}

}  // namespace btcheck
