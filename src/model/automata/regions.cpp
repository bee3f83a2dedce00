// SPDX-License-Identifier: MIT
//
// All that a network asks of its numbers, for the partition of their values:
// conditions in guards, values that are assigned, and what rules ask.
#include "model/automata/regions.hpp"

#include <algorithm>
#include <utility>

#include "model/tree/partition.hpp"

namespace btcheck {
namespace {

// A numeric state variable, or what a node keeps of one as its argument.
struct Number {
  VariableId variable{};
  std::optional<VariableId> beside = std::nullopt;
};

template <class Value>
void add_new(std::vector<Value>& to, Value value) {
  if (std::ranges::find(to, value) == to.end()) to.push_back(std::move(value));
}

constexpr bool joins_conditions(Operation operation) {
  return operation == Operation::And || operation == Operation::Or ||
         operation == Operation::Not;
}

// The greatest parts of a condition that are no conjunction, disjunction or
// negation.
template <class Visit>
void each_atom(std::span<const Term> terms, Visit visit) {
  struct Part {
    std::size_t begin = 0;
    std::size_t end = 0;
    bool is_joined = false;
  };
  std::vector<Part> stack;
  const auto take = [&] {
    const Part part = stack.back();
    stack.pop_back();
    return part;
  };
  const auto tell = [&](const Part& part) {
    if (part.is_joined) return;
    visit(terms.subspan(part.begin, part.end - part.begin));
  };
  for (std::size_t i = 0; i < terms.size(); ++i) {
    const Operation operation = terms[i].operation;
    const bool joins = joins_conditions(operation);
    Part whole{i, i + 1, joins};
    for (int operands = arity(operation); operands > 0; --operands) {
      const Part operand = take();
      if (joins) tell(operand);
      whole.begin = operand.begin;
    }
    stack.push_back(whole);
  }
  if (!stack.empty()) tell(stack.back());
}

class Collection {
 public:
  Collection(const Network& network, std::span<const Expression> asked)
      : network_(network), number_at_(network.variables.size()) {
    find_numbers();
    for (const Expression& condition : asked) take_condition(condition);
    for (const Automaton& automaton : network.automata) {
      for (const Edge& edge : automaton.edges) {
        take_condition(edge.guard);
        for (const Assignment& update : edge.updates) take_update(update);
      }
    }
  }

  std::size_t number_at(StateVariableId id) const {
    return *number_at_[index(network_.state_variable[index(id)])];
  }
  const Number& number(std::size_t at) const { return numbers_[at]; }
  std::vector<PartitionedNumber> take() { return std::move(partitioned_); }

 private:
  void find_numbers() {
    for (const VariableId id : network_.state_variable) add_number(id);
    for (const KeptArgument& each : network_.arguments) {
      add_number(each.variable);
    }
  }

  void add_number(VariableId id) {
    const Variable& variable = network_.variable(id);
    if (!variable.value_names.empty()) return;
    number_at_[index(id)] = numbers_.size();
    numbers_.push_back({id});
    partitioned_.push_back({{variable.min, variable.max}, variable.initial});
  }

  PartitionedNumber* number_of(VariableId variable) {
    const auto at = number_at_[index(variable)];
    return at ? &partitioned_[*at] : nullptr;
  }

  // The number that the terms are about; nullptr where they are about none, or
  // about several variables, and then the values of all of them matter.
  PartitionedNumber* only_number(std::span<const Term> terms) {
    std::vector<VariableId> read;
    for (const Term& term : terms) {
      if (term.operation != Operation::Variable) continue;
      add_new(read, VariableId{static_cast<std::uint32_t>(term.operand)});
    }
    if (read.size() == 1) return number_of(read.front());
    for (const VariableId variable : read) {
      PartitionedNumber* number = number_of(variable);
      if (number == nullptr) continue;
      number->is_whole = true;
      numbers_[*number_at_[index(variable)]].beside =
          read.front() == variable ? read.back() : read.front();
    }
    return nullptr;
  }

  void take_condition(const Expression& condition) {
    each_atom(condition.terms(), [&](std::span<const Term> terms) {
      PartitionedNumber* number = only_number(terms);
      if (number != nullptr) number->add_atom(terms);
    });
  }

  void take_update(const Assignment& update) {
    const auto terms = update.value.terms();
    // Its parts decide what comes out of it.
    if (!terms.empty() && joins_conditions(terms.back().operation)) {
      return take_condition(update.value);
    }
    const Variable& target = network_.variable(update.variable);
    PartitionedNumber* read = only_number(terms);
    if (read != nullptr) {
      read->add_move({number_at_[index(update.variable)],
                      {target.min, target.max},
                      {terms.begin(), terms.end()}});
    }
    PartitionedNumber* written = number_of(update.variable);
    const auto constant = update.value.only(Operation::Constant);
    if (written != nullptr && constant) {
      add_new(written->constants, std::int64_t{*constant});
    }
  }

  const Network& network_;
  std::vector<Number> numbers_;
  std::vector<PartitionedNumber> partitioned_;         // of each
  std::vector<std::optional<std::size_t>> number_at_;  // by VariableId
};

}  // namespace

Regions regions_of(const Network& network,
                   std::span<const StateVariableId> numbers,
                   std::span<const Expression> asked) {
  Collection collection(network, asked);
  std::vector<std::size_t> wanted;
  for (const StateVariableId id : numbers) {
    wanted.push_back(collection.number_at(id));
  }
  auto values = representatives(collection.take(), wanted);
  Regions found;
  found.samples.resize(network.state_variable.size());
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (values[wanted[i]]) {
      found.samples[index(numbers[i])] = std::move(*values[wanted[i]]);
    } else {
      found.unsplit.push_back(
          {numbers[i], collection.number(wanted[i]).beside});
    }
  }
  return found;
}

}  // namespace btcheck
