// SPDX-License-Identifier: MIT
#include "model/btcpp/entries/guard.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

namespace btcheck::btcpp {
namespace {

// Nodes in one guard, shared ones counted each time. It also bounds the
// recursion over them.
constexpr std::size_t kMostNodes = 600;

thread_local std::uint64_t work_done = 0;
thread_local std::uint64_t guards_given_up = 0;

Expression compared(Operation operation, StateVariableId variable,
                    std::size_t value) {
  return Expression::binary(
      operation, Expression::variable(static_cast<std::int32_t>(variable)),
      Expression::constant(static_cast<std::int32_t>(value)));
}

std::size_t runs_in(const ScriptGuard::Among& values, bool of) {
  std::size_t runs = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (values[i] == of && (i == 0 || values[i - 1] != of)) ++runs;
  }
  return runs;
}

// Whether the variable's value is in the runs of `of`.
Expression in_runs(StateVariableId variable, const ScriptGuard::Among& values,
                   bool of) {
  Expression all;
  for (std::size_t begin = 0; begin < values.size(); ++begin) {
    if (values[begin] != of) continue;
    std::size_t end = begin;
    while (end < values.size() && values[end] == of) ++end;
    Expression run;
    if (end == begin + 1) {
      run = compared(Operation::Equal, variable, begin);
    } else {
      if (begin > 0) run = compared(Operation::GreaterEqual, variable, begin);
      if (end < values.size()) {
        run = both(std::move(run),
                   compared(Operation::LessEqual, variable, end - 1));
      }
    }
    all = all.is_true() ? std::move(run)
                        : Expression::binary(Operation::Or, std::move(all),
                                             std::move(run));
    begin = end;
  }
  return all;
}

Expression membership(StateVariableId variable,
                      const ScriptGuard::Among& values) {
  if (runs_in(values, false) >= runs_in(values, true)) {
    return in_runs(variable, values, true);
  }
  return Expression::unary(Operation::Not, in_runs(variable, values, false));
}

}  // namespace

struct ScriptGuard::Node {
  Operation operation = Operation::Constant;  // Variable, And, Or; or true
  StateVariableId variable{};
  Among values;  // of a Variable: some are, some are not
  ScriptGuard left;
  ScriptGuard right;
  std::size_t size = 1;

  // Two guards as one that is not larger than both.
  static std::optional<ScriptGuard> merged(Operation operation,
                                           const ScriptGuard& left,
                                           const ScriptGuard& right) {
    const Node& one = *left.node_;
    const Node& other = *right.node_;
    if (one.operation != other.operation) return std::nullopt;
    if (one.operation == Operation::Variable &&
        one.variable == other.variable) {
      Among values = one.values;
      if (operation == Operation::And) {
        values &= other.values;
      } else {
        values |= other.values;
      }
      return is_among(one.variable, std::move(values));
    }
    if (one.operation != Operation::And || operation != Operation::Or) {
      return std::nullopt;
    }
    if (are_same(one.left, other.left)) {
      return both(one.left, either(one.right, other.right));
    }
    if (are_same(one.right, other.right)) {
      return both(either(one.left, other.left), one.right);
    }
    return std::nullopt;
  }

  static bool are_same(const ScriptGuard& left, const ScriptGuard& right) {
    if (left.node_ == right.node_) return true;
    const Node* one = left.values();
    const Node* other = right.values();
    return one != nullptr && other != nullptr &&
           one->variable == other->variable && one->values == other->values;
  }

  // The guard in states where `known` is true, a condition on one variable:
  // what that decides is left out.
  static ScriptGuard beside(const Node& known, const ScriptGuard& guard) {
    if (guard.is_never() || guard.is_always()) return guard;
    const Node& node = *guard.node_;
    ++work_done;
    if (node.operation == Operation::Variable) {
      if (node.variable != known.variable) return guard;
      work_done += node.values.num_blocks();
      const bool may_hold = known.values.intersects(node.values);
      const bool may_fail = !known.values.is_subset_of(node.values);
      if (!may_fail) return always();
      return may_hold ? guard : ScriptGuard();
    }
    const ScriptGuard left = beside(known, node.left);
    const ScriptGuard right = beside(known, node.right);
    if (left.node_ == node.left.node_ && right.node_ == node.right.node_) {
      return guard;
    }
    return node.operation == Operation::And ? both(left, right)
                                            : either(left, right);
  }

  static ScriptGuard joined(Operation operation, const ScriptGuard& left,
                            const ScriptGuard& right) {
    if (const auto one = merged(operation, left, right)) return *one;
    ++work_done;
    if (operation == Operation::And) {
      const Node* known = left.values() ? left.values() : right.values();
      const ScriptGuard& other = left.values() ? right : left;
      if (known != nullptr) {
        const ScriptGuard rest = beside(*known, other);
        const ScriptGuard& one = left.values() ? left : right;
        if (rest.node_ != other.node_) return both(one, rest);
      }
    }
    // The operand that was joined last may absorb the new one.
    const Node& under = *left.node_;
    if (under.operation == operation) {
      if (const auto one = merged(operation, under.right, right)) {
        return operation == Operation::And ? both(under.left, *one)
                                           : either(under.left, *one);
      }
    }
    Node node;
    node.operation = operation;
    node.size = left.node_->size + right.node_->size + 1;
    if (node.size > kMostNodes) {
      ++guards_given_up;
      return always();
    }
    node.left = left;
    node.right = right;
    return ScriptGuard(std::make_shared<const Node>(std::move(node)));
  }

  // Guards of one variable; nothing where they speak of others.
  static std::optional<bool> are_apart_in_one(
      std::span<const ScriptGuard> guards) {
    const Node* first = guards.front().values();
    if (first == nullptr) return std::nullopt;
    Among seen(first->values.size());
    for (const ScriptGuard& each : guards) {
      const Node* node = each.values();
      if (node == nullptr || node->variable != first->variable) {
        return std::nullopt;
      }
      if (seen.intersects(node->values)) return false;
      seen |= node->values;
    }
    return true;
  }

  // A disjunction is apart from what all its parts are apart from, a
  // conjunction from what one of them is.
  static bool are_disjoint(const ScriptGuard& left, const ScriptGuard& right) {
    ++work_done;
    if (left.is_never() || right.is_never()) return true;
    if (left.is_always() || right.is_always()) return false;
    const Node& one = *left.node_;
    const Node& other = *right.node_;
    if (one.operation == Operation::Or) {
      return are_disjoint(one.left, right) && are_disjoint(one.right, right);
    }
    if (other.operation == Operation::Or) return are_disjoint(right, left);
    if (one.operation == Operation::And) {
      return are_disjoint(one.left, right) || are_disjoint(one.right, right);
    }
    if (other.operation == Operation::And) return are_disjoint(right, left);
    return one.variable == other.variable &&
           !one.values.intersects(other.values);
  }
};

ScriptGuard ScriptGuard::always() {
  static const auto node = std::make_shared<const Node>();
  return ScriptGuard(node);
}

ScriptGuard ScriptGuard::is_among(StateVariableId variable, Among values) {
  if (values.none()) return {};
  if (values.all()) return always();
  Node node;
  node.operation = Operation::Variable;
  node.variable = variable;
  node.values = std::move(values);
  return ScriptGuard(std::make_shared<const Node>(std::move(node)));
}

ScriptGuard ScriptGuard::is(StateVariableId variable, std::size_t value,
                            std::size_t count) {
  Among only(count);
  only[value] = true;
  return is_among(variable, std::move(only));
}

bool ScriptGuard::is_always() const {
  return node_ != nullptr && node_->operation == Operation::Constant;
}

const ScriptGuard::Node* ScriptGuard::values() const {
  const bool is_leaf =
      node_ != nullptr && node_->operation == Operation::Variable;
  return is_leaf ? node_.get() : nullptr;
}

ScriptGuard both(const ScriptGuard& left, const ScriptGuard& right) {
  if (left.is_never() || right.is_always()) return left;
  if (right.is_never() || left.is_always()) return right;
  if (left.node_ == right.node_) return left;
  return ScriptGuard::Node::joined(Operation::And, left, right);
}

ScriptGuard either(const ScriptGuard& left, const ScriptGuard& right) {
  if (left.is_never() || right.is_always()) return right;
  if (right.is_never() || left.is_always()) return left;
  if (left.node_ == right.node_) return left;
  return ScriptGuard::Node::joined(Operation::Or, left, right);
}

Expression ScriptGuard::expression() const {
  if (is_never()) return Expression::constant(0);
  if (is_always()) return Expression::constant(1);
  if (values() != nullptr) return membership(node_->variable, node_->values);
  return Expression::binary(node_->operation, node_->left.expression(),
                            node_->right.expression());
}

std::uint64_t ScriptGuard::work() { return work_done; }
std::uint64_t ScriptGuard::given_up() { return guards_given_up; }

std::optional<ScriptGuard::Values> ScriptGuard::of_one_variable() const {
  const Node* node = values();
  if (node == nullptr) return std::nullopt;
  return Values{node->variable, &node->values};
}

bool ScriptGuard::are_apart(std::span<const ScriptGuard> guards) {
  constexpr std::size_t kMostPairwise = 24;
  if (guards.size() <= 1) return true;
  if (const auto known = Node::are_apart_in_one(guards)) return *known;
  if (guards.size() > kMostPairwise) return false;
  std::size_t size = 0;
  for (const ScriptGuard& each : guards) {
    size += each.node_ ? each.node_->size : 0;
  }
  if (size > kMostNodes) return false;
  for (std::size_t i = 0; i < guards.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      if (!Node::are_disjoint(guards[i], guards[k])) return false;
    }
  }
  return true;
}

void add_option(ScriptOptions& options, const ScriptValue& value,
                const ScriptGuard& where) {
  if (where.is_never()) return;
  ScriptGuard& guard = options[value];
  guard = either(guard, where);
}

ScriptOptions under(const ScriptGuard& where, const ScriptOptions& options) {
  ScriptOptions all;
  for (const auto& [value, guard] : options) {
    add_option(all, value, both(where, guard));
  }
  return all;
}

ScriptOptions grouped(const ScriptOptions& options,
                      ScriptValue (*group)(const ScriptValue&)) {
  ScriptOptions groups;
  for (const auto& [value, where] : options) {
    add_option(groups, group(value), where);
  }
  return groups;
}

ScriptGuard anywhere(const ScriptOptions& options) {
  return anywhere(options, [](const ScriptValue&) { return true; });
}

bool is_open(const ScriptValue& value) {
  return value.kind == ScriptKind::Unknown || value.kind == ScriptKind::Any ||
         value.kind == ScriptKind::AnyText;
}

bool is_ambiguous(const ScriptOptions& options) {
  std::vector<ScriptGuard> guards;
  for (const auto& [value, where] : options) guards.push_back(where);
  return !ScriptGuard::are_apart(guards);
}

namespace {

// Of values that the tree does not know.
ScriptValue merged_outside(const ScriptOptions& options) {
  if (options.empty()) return ScriptValue::lost();
  const ScriptValue& first = options.begin()->first;
  const auto all = [&](auto wanted) {
    return std::ranges::all_of(
        options, [&](const auto& option) { return wanted(option.first); });
  };
  const bool are_written =
      all([](const ScriptValue& value) { return value.is_outside(); });
  const bool are_alike =
      all([&](const ScriptValue& value) { return value.noted == first.noted; });
  return (are_written ? ScriptValue::outside() : ScriptValue::any())
      .as(are_alike ? first.noted : EntryType::Other);
}

}  // namespace

ScriptValue merged(const ScriptOptions& options) {
  std::vector<ScriptValue> values;
  for (const auto& [value, where] : options) {
    const bool is_outside = value.kind == ScriptKind::Unknown ||
                            (value.kind == ScriptKind::Any && !value.is_lost());
    if (!is_outside) values.push_back(value);
  }
  if (values.empty()) return merged_outside(options);
  const auto all = [&](auto wanted) {
    return std::ranges::all_of(values, wanted);
  };
  ScriptValue any = ScriptValue::lost();
  if (all([](const ScriptValue& value) { return value.is_number(); })) {
    const bool are_integers = all([](const ScriptValue& value) {
      return value.type == NumberType::Integer;
    });
    const bool are_doubles = all([](const ScriptValue& value) {
      return value.type == NumberType::Whole || value.type == NumberType::Real;
    });
    // That none is negative is kept: those are no truth values.
    const bool are_from_0 = all([](const ScriptValue& value) {
      return value.number >= 0 && (value.kind == ScriptKind::Number ||
                                   value.kind == ScriptKind::AtLeast);
    });
    const NumberType type = are_integers  ? NumberType::Integer
                            : are_doubles ? NumberType::Real
                                          : NumberType::Either;
    any = are_from_0 ? ScriptValue::range(ScriptKind::AtLeast, 0, type)
                     : ScriptValue::any_number(type);
  } else if (all([](const ScriptValue& value) { return value.is_text(); })) {
    any = ScriptValue::any_text();
  }
  const bool are_alike = all([&](const ScriptValue& value) {
    return value.noted == values.front().noted;
  });
  return any.as(are_alike ? values.front().noted : EntryType::Other);
}

}  // namespace btcheck::btcpp
