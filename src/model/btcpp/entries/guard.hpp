// SPDX-License-Identifier: MIT
//
// Guards: conditions on the values of modelled entries. Options: the values
// that something may have, each with its guard.
#pragma once

#include <boost/dynamic_bitset.hpp>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "model/btcpp/script/value.hpp"
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
  // Whether it has this one of so many.
  static ScriptGuard is(StateVariableId variable, std::size_t value,
                        std::size_t count);

  bool is_always() const;
  bool is_never() const { return node_ == nullptr; }

  // How many nodes of guards over several variables this thread has visited so
  // far: a measure of work, by which a caller can choose to know less.
  static std::uint64_t work();
  // How many guards this thread has replaced by `true` so far, as too large.
  static std::uint64_t given_up();

  // Over the state variables; never the empty expression.
  Expression expression() const;

  // The only variable in it, and which of its values; nothing where there is
  // none, or there are several.
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

  const Node* values() const;  // nullptr when it is none of `is_among`

  std::shared_ptr<const Node> node_;
};

// The values that something may come to, and where: several guards may be true
// at once. Where none is, it throws.
using ScriptOptions = std::map<ScriptValue, ScriptGuard>;

void add_option(ScriptOptions& options, const ScriptValue& value,
                const ScriptGuard& where);

// The options in states where the guard is true, too.
ScriptOptions under(const ScriptGuard& where, const ScriptOptions& options);

// The options with the values replaced by what `group` makes of them.
ScriptOptions grouped(const ScriptOptions& options,
                      ScriptValue (*group)(const ScriptValue&));

// Where any value is possible.
ScriptGuard anywhere(const ScriptOptions& options);
// Where one of those is possible that are asked for.
template <class Wanted>
ScriptGuard anywhere(const ScriptOptions& options, Wanted wanted) {
  ScriptGuard all;
  for (const auto& [value, guard] : options) {
    if (wanted(value)) all = either(all, guard);
  }
  return all;
}

// Whether nothing is known of the value but, perhaps, that there is one.
bool is_open(const ScriptValue& value);
// Whether several of the values may be possible in one state.
bool is_ambiguous(const ScriptOptions& options);
// What is known of all of them; what comes from outside is of the same kind.
ScriptValue merged(const ScriptOptions& options);

struct ScriptResult {
  ScriptOptions options;
  ScriptGuard yields;  // where there is an option
};

}  // namespace btcheck::btcpp
