// SPDX-License-Identifier: MIT
//
// Small formulas give small automata, and rewriting a formula is cheaper than
// reducing an automaton. The laws are those of Somenzi and Bloem (CAV 2000)
// and Etessami and Holzmann (CONCUR 2000), and, as in Spot, suspendable
// formulas (`[] <> a`) are pulled out. The laws for Or and Release
// are the duals of those for And and Until and are not written down. All
// rewriting takes place in a pool of its own: the caller's gets only the
// result. Rewriting recurses where a law makes new formulas, at most kDeepest
// levels; the next round goes on from there.
#include "ltl/formula/normal_form.hpp"

#include <algorithm>
#include <optional>

namespace btcheck {

namespace {

// Brings one node into normal form, its operands being so already.
FormulaId normalised(NormalPool& to, const FormulaNode& node, FormulaId left,
                     FormulaId right) {
  const auto negation = [&](FormulaId id) { return to.negation(id); };
  const auto make = [&](FormulaKind kind, FormulaId l, FormulaId r) {
    return to.make(kind, l, r);
  };
  switch (node.kind) {
    case FormulaKind::True:
    case FormulaKind::False:
      return to.constant(node.kind == FormulaKind::True);
    case FormulaKind::Atom:
      return to.atom(node.atom);
    case FormulaKind::Not:
      return negation(left);
    case FormulaKind::Implies:
      return make(FormulaKind::Or, negation(left), right);
    case FormulaKind::Equivalent:
      return make(FormulaKind::Or, make(FormulaKind::And, left, right),
                  make(FormulaKind::And, negation(left), negation(right)));
    case FormulaKind::Eventually:
      return make(FormulaKind::Until, to.constant(true), left);
    case FormulaKind::Always:
      return make(FormulaKind::Release, to.constant(false), left);
    case FormulaKind::WeakUntil:
      return make(FormulaKind::Release, right,
                  make(FormulaKind::Or, left, right));
    default:
      return make(node.kind, left, right);
  }
}

// Goes through a formula, operands first, and makes one node of each:
// `make(id, node, left, right)` gets the operands as they were made.
template <class Pool, class Make>
FormulaId remade(const Pool& from, FormulaId root, Make make) {
  std::vector<FormulaId> made(index(root) + 1);
  for (const FormulaId id : from.nodes(root)) {
    const FormulaNode node = from[id];
    made[index(id)] =
        make(id, node, made[index(node.left)], made[index(node.right)]);
  }
  return made[index(root)];
}

FormulaId into_normal_pool(NormalPool& to, const FormulaPool& from,
                           FormulaId root) {
  return remade(from, root, [&](FormulaId, auto... node_and_operands) {
    return normalised(to, node_and_operands...);
  });
}

// The nodes of a normal pool as they are, in another pool.
FormulaId out_of_normal_pool(FormulaPool& to, const NormalPool& from,
                             FormulaId root) {
  const auto copy = [&](FormulaId id, const FormulaNode& node, FormulaId left,
                        FormulaId right) {
    if (node.kind == FormulaKind::Atom) return to.atom(node.atom);
    if (is_leaf(node.kind)) return id;
    return is_unary(node.kind) ? to.unary(node.kind, left)
                               : to.binary(node.kind, left, right);
  };
  return remade(from, root, copy);
}

class Rewriting {
 public:
  explicit Rewriting(NormalPool& pool) : pool_(pool) {}

  // An equivalent formula to which no law applies, if found in kMostRounds.
  FormulaId rewrite(FormulaId root) {
    for (int round = 0; round < kMostRounds; ++round) {
      const FormulaId next = rewrite_once(root);
      if (next == root) break;
      root = next;
    }
    return root;
  }

 private:
  using Operands = std::vector<FormulaId>;

  static constexpr int kMostRounds = 16;
  static constexpr int kDeepest = 64;
  static constexpr std::size_t kMostOperandsCompared = 64;

  const FormulaId true_{0};
  const FormulaId false_{1};

  bool is(FormulaId id, FormulaKind kind) const {
    return pool_[id].kind == kind;
  }
  bool is_eventually(FormulaId id) const {
    return is(id, FormulaKind::Until) && pool_[id].left == true_;
  }
  bool is_always(FormulaId id) const {
    return is(id, FormulaKind::Release) && pool_[id].left == false_;
  }

  FormulaId rewrite_once(FormulaId root) {
    return remade(pool_, root,
                  [&](auto... parts) { return rebuilt(parts...); });
  }

  FormulaId rebuilt(FormulaId id, const FormulaNode& node, FormulaId left,
                    FormulaId right) {
    switch (node.kind) {
      case FormulaKind::And:
      case FormulaKind::Or:
        return combine(node.kind, {left, right});
      case FormulaKind::Next:
        return next(left);
      case FormulaKind::Until:
        return until(left, right);
      case FormulaKind::Release:
        return release(left, right);
      default:
        return id;
    }
  }

  FormulaId negation(FormulaId id) const { return pool_.negation(id); }
  FormulaId eventually(FormulaId id) { return until(true_, id); }
  FormulaId release(FormulaId left, FormulaId right) {
    return negation(until(negation(left), negation(right)));
  }
  FormulaId disjunction(Operands operands) {
    for (FormulaId& operand : operands) operand = negation(operand);
    return negation(conjunction(std::move(operands)));
  }

  // The operands of nested binary operators of one kind, from left to right.
  Operands operands(FormulaId id, FormulaKind kind) const {
    Operands found;
    Operands stack{id};
    while (!stack.empty()) {
      const FormulaId top = stack.back();
      stack.pop_back();
      if (!is(top, kind)) {
        found.push_back(top);
        continue;
      }
      stack.push_back(pool_[top].right);
      stack.push_back(pool_[top].left);
    }
    return found;
  }

  // Moves the operands that satisfy `taken` out of the list.
  template <class Taken>
  static Operands take(Operands& from, Taken&& taken) {
    const auto rest = std::stable_partition(
        from.begin(), from.end(), [&](FormulaId id) { return !taken(id); });
    Operands out(rest, from.end());
    from.erase(rest, from.end());
    return out;
  }

  // ---- X a

  FormulaId next(FormulaId of) {
    if (pool_.is_suspendable(of)) return of;
    for (const FormulaKind kind : {FormulaKind::And, FormulaKind::Or}) {
      Operands inner = operands(of, kind);
      Operands outer =
          take(inner, [&](FormulaId id) { return pool_.is_suspendable(id); });
      if (outer.empty()) continue;
      outer.push_back(next(combine(kind, inner)));
      return combine(kind, std::move(outer));
    }
    return pool_.make(FormulaKind::Next, of, FormulaId{});
  }

  FormulaId combine(FormulaKind kind, Operands of) {
    return kind == FormulaKind::And ? conjunction(std::move(of))
                                    : disjunction(std::move(of));
  }

  // ---- a U b

  FormulaId until(FormulaId left, FormulaId right) {
    if (pool_.is_eventual(right) || pool_.implies(left, right)) return right;
    if (++depth_ > kDeepest) {
      --depth_;
      return pool_.make(FormulaKind::Until, left, right);
    }
    left = relevant_before(left, right);
    std::optional<FormulaId> found;
    if (left == false_) found = right;
    if (!found) found = until_of_until(left, right);
    if (!found) found = until_of_next(left, right);
    if (!found) found = until_of_parts(left, right);
    if (!found) found = eventually_always(left, right);
    --depth_;
    return found ? *found : pool_.make(FormulaKind::Until, left, right);
  }

  // Before the first b, what implies b is false and what not-b implies true.
  FormulaId relevant_before(FormulaId left, FormulaId right) {
    if (pool_.implies(negation(right), left)) return true_;
    Operands all = operands(left, FormulaKind::And);
    const Operands always = take(
        all, [&](FormulaId id) { return pool_.implies(negation(right), id); });
    if (!always.empty()) left = conjunction(all);
    Operands any = operands(left, FormulaKind::Or);
    const Operands never =
        take(any, [&](FormulaId id) { return pool_.implies(id, right); });
    return never.empty() ? left : disjunction(any);
  }

  // a U (c U d) where a and c are comparable.
  std::optional<FormulaId> until_of_until(FormulaId left, FormulaId right) {
    if (!is(right, FormulaKind::Until)) return std::nullopt;
    const FormulaNode inner = pool_[right];
    if (pool_.implies(left, inner.left)) return right;
    if (pool_.implies(inner.left, left)) return until(left, inner.right);
    return std::nullopt;
  }

  // X a U X b = X (a U b); true is X true.
  std::optional<FormulaId> until_of_next(FormulaId left, FormulaId right) {
    const bool is_next = is(left, FormulaKind::Next);
    if (!is(right, FormulaKind::Next) || (!is_next && left != true_)) {
      return std::nullopt;
    }
    return next(until(is_next ? pool_[left].left : left, pool_[right].left));
  }

  // a U (b or e) = a U b or e, if e is eventual;
  // a U (b and s) = a U b and s, if s is suspendable.
  std::optional<FormulaId> until_of_parts(FormulaId left, FormulaId right) {
    Operands any = operands(right, FormulaKind::Or);
    Operands eventual =
        take(any, [&](FormulaId id) { return pool_.is_eventual(id); });
    if (!eventual.empty()) {
      eventual.push_back(until(left, disjunction(any)));
      return disjunction(std::move(eventual));
    }
    Operands all = operands(right, FormulaKind::And);
    Operands suspendable =
        take(all, [&](FormulaId id) { return pool_.is_suspendable(id); });
    if (suspendable.empty()) return std::nullopt;
    suspendable.push_back(until(left, conjunction(all)));
    return conjunction(std::move(suspendable));
  }

  // <> [] (a or u) = <> [] a or <> u, if u is universal.
  std::optional<FormulaId> eventually_always(FormulaId left, FormulaId right) {
    if (left != true_ || !is_always(right)) return std::nullopt;
    Operands any = operands(pool_[right].right, FormulaKind::Or);
    Operands universal =
        take(any, [&](FormulaId id) { return pool_.is_universal(id); });
    if (universal.empty()) return std::nullopt;
    for (FormulaId& id : universal) id = eventually(id);
    universal.push_back(eventually(release(false_, disjunction(any))));
    return disjunction(std::move(universal));
  }

  // ---- a and b and …

  FormulaId conjunction(Operands of) {
    Operands all = flat(of);
    if (++depth_ <= kDeepest && all.size() <= kMostOperandsCompared) {
      drop_implied(all);
      while (resolve_some(all) || join_some_pair(all)) drop_implied(all);
      join_next(all);
    }
    --depth_;
    return chain(all);
  }

  Operands flat(const Operands& of) const {
    Operands all;
    for (const FormulaId id : of) {
      const Operands inner = operands(id, FormulaKind::And);
      all.insert(all.end(), inner.begin(), inner.end());
    }
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    if (!all.empty() && all.front() == true_) all.erase(all.begin());
    if (!all.empty() && all.front() == false_) all = {false_};
    return all;
  }

  FormulaId chain(const Operands& all) {
    if (all.empty()) return true_;
    FormulaId formula = all.back();
    for (std::size_t i = all.size() - 1; i-- > 0;) {
      formula = pool_.make(FormulaKind::And, all[i], formula);
    }
    return formula;
  }

  // Leaves only operands of which none implies another, or false alone.
  void drop_implied(Operands& all) const {
    all = flat(all);
    for (std::size_t i = 0; i < all.size(); ++i) {
      for (std::size_t j = 0; j < all.size(); ++j) {
        if (i == j) continue;
        if (pool_.implies(all[i], negation(all[j]))) {
          all = {false_};
          return;
        }
        if (!pool_.implies(all[i], all[j])) continue;
        all.erase(all.begin() + static_cast<std::ptrdiff_t>(j));
        i -= j < i;
        --j;
      }
    }
  }

  // a and (b or c) = a and c, if a implies not-b.
  bool resolve_some(Operands& all) {
    for (FormulaId& operand : all) {
      const auto is_refuted = [&](FormulaId id) {
        return std::any_of(all.begin(), all.end(), [&](FormulaId other) {
          return other != operand && pool_.implies(other, negation(id));
        });
      };
      Operands any = operands(operand, FormulaKind::Or);
      if (take(any, is_refuted).empty()) continue;
      operand = disjunction(any);
      return true;
    }
    return false;
  }

  bool join_some_pair(Operands& all) {
    for (std::size_t i = 0; i < all.size(); ++i) {
      for (std::size_t j = 0; j < all.size(); ++j) {
        if (i == j) continue;
        const std::optional<FormulaId> joined = join(all[i], all[j]);
        if (!joined) continue;
        all[i] = *joined;
        all.erase(all.begin() + static_cast<std::ptrdiff_t>(j));
        return true;
      }
    }
    return false;
  }

  // One temporal formula for `a and b`, if a law gives it.
  std::optional<FormulaId> join(FormulaId a, FormulaId b) {
    const FormulaNode first = pool_[a];
    const FormulaNode second = pool_[b];
    if (first.kind == FormulaKind::Release && is_eventually(b) &&
        first.left == second.right) {
      return until(first.right, conjunction({first.left, first.right}));
    }
    if (first.kind != second.kind) return std::nullopt;
    if (first.kind == FormulaKind::Release && first.left == second.left &&
        !(pool_.is_suspendable(a) && pool_.is_suspendable(b))) {
      return release(first.left, conjunction({first.right, second.right}));
    }
    if (first.kind != FormulaKind::Until) return std::nullopt;
    if (first.right == second.right) {
      return until(conjunction({first.left, second.left}), first.right);
    }
    if (is_eventually(a) && is_eventually(b) &&
        pool_.is_universal(first.right) && pool_.is_universal(second.right)) {
      return eventually(conjunction({first.right, second.right}));
    }
    return std::nullopt;
  }

  // X a and X b = X (a and b).
  void join_next(Operands& all) {
    Operands nexts =
        take(all, [&](FormulaId id) { return is(id, FormulaKind::Next); });
    if (nexts.empty()) return;
    if (nexts.size() == 1) {
      all.push_back(nexts[0]);
    } else {
      for (FormulaId& id : nexts) id = pool_[id].left;
      all.push_back(next(conjunction(std::move(nexts))));
    }
    all = flat(all);
  }

  NormalPool& pool_;
  int depth_ = 0;
};

}  // namespace

FormulaId negation_normal_form(FormulaPool& pool, FormulaId id) {
  NormalPool normal;
  const FormulaId root = into_normal_pool(normal, pool, id);
  return out_of_normal_pool(pool, normal, root);
}

FormulaId simplify(FormulaPool& pool, FormulaId id) {
  NormalPool normal;
  const FormulaId root = into_normal_pool(normal, pool, id);
  return out_of_normal_pool(pool, normal, Rewriting(normal).rewrite(root));
}

}  // namespace btcheck
