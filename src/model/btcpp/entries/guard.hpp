// SPDX-License-Identifier: MIT
//
// When something may happen: conditions on entries that are modelled.
#pragma once

#include <boost/dynamic_bitset.hpp>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "model/tree/expression.hpp"
#include "model/tree/tree.hpp"

namespace btcheck::btcpp {

// A formula of conjunctions and disjunctions over `the variable has one of
// these values`, without negation. So whatever makes it weaker is sound: one
// that grows beyond a bound becomes true. Copies are cheap.
class ScriptGuard {
 public:
  // Some of a variable's values: a bit for each it can have.
  using Among = boost::dynamic_bitset<std::uint64_t>;

  // Never true.
  ScriptGuard() = default;
  static ScriptGuard always();
  // Whether the variable has one of the values.
  static ScriptGuard is_among(StateVariableId variable, Among values);

  bool is_always() const;
  bool is_never() const { return node_ == nullptr; }

  // How much was done with guards of several variables so far, in this thread:
  // nodes looked at. Who has enough of it may know less instead.
  static std::uint64_t work();
  // How many guards have become true so far, in this thread, for their size.
  static std::uint64_t given_up();

  // Over the state variables; never the empty expression.
  Expression expression() const;

  // The variable that it speaks of, and which of its values; nothing where it
  // speaks of none or of several.
  struct Values {
    StateVariableId variable{};
    const Among* among = nullptr;
  };
  std::optional<Values> of_one_variable() const;

  // Whether no two can be true at once; false where that is not easily seen.
  static bool are_apart(std::span<const ScriptGuard> guards);

  friend ScriptGuard both(const ScriptGuard& left, const ScriptGuard& right);
  friend ScriptGuard either(const ScriptGuard& left, const ScriptGuard& right);

 private:
  struct Node;
  explicit ScriptGuard(std::shared_ptr<const Node> node)
      : node_(std::move(node)) {}

  static std::optional<ScriptGuard> merged(Operation operation,
                                           const ScriptGuard& left,
                                           const ScriptGuard& right);
  static bool are_disjoint(const ScriptGuard& left, const ScriptGuard& right);
  static std::optional<bool> are_apart_in_one(
      std::span<const ScriptGuard> guards);
  static bool are_same(const ScriptGuard& left, const ScriptGuard& right);
  static ScriptGuard beside(const Node& known, const ScriptGuard& guard);
  static ScriptGuard joined(Operation operation, const ScriptGuard& left,
                            const ScriptGuard& right);
  const Node* values() const;  // nullptr when it is none of `is_among`

  std::shared_ptr<const Node> node_;
};

ScriptGuard both(const ScriptGuard& left, const ScriptGuard& right);
ScriptGuard either(const ScriptGuard& left, const ScriptGuard& right);

}  // namespace btcheck::btcpp
