// SPDX-License-Identifier: MIT
//
// Pieces of a range are halved until interval arithmetic knows how each comes
// out of every comparison, and in which region each assignment puts it: a
// threshold is found in as many steps as its number has bits. Pieces that come
// out alike are one region; this is repeated until no region falls apart.
#include "model/automata/regions.hpp"

#include <algorithm>
#include <cassert>
#include <iterator>
#include <limits>
#include <map>
#include <tuple>
#include <utility>

#include "model/tree/value_range.hpp"

namespace btcheck {
namespace {

// Pieces looked at before a number's values are all told apart.
constexpr std::uint64_t kMostWork = 300'000;

using Terms = std::vector<Term>;

// A stretch of values that belong to one region.
struct Piece {
  ValueRange values;
  std::size_t region = 0;
};

struct Move {
  VariableId to{};
  Terms value;

  friend bool operator==(const Move&, const Move&) = default;
};

// A numeric state variable, or what a node keeps of one as its argument, and
// all that is asked of it alone.
struct Number {
  VariableId variable{};
  std::vector<Terms> atoms;
  std::vector<Move> moves;
  std::vector<int> constants;  // it is assigned
  bool is_whole = false;       // all its values are told apart
  std::optional<VariableId> beside = std::nullopt;
  std::vector<Piece> pieces = {};  // ascending, without gaps
  std::size_t regions = 1;
  std::uint64_t work = 0;  // pieces looked at
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

class Splitting {
 public:
  Splitting(const Network& network, std::span<const Expression> asked)
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

  // Until these numbers are split, or given up, and all that they are assigned
  // to.
  void run(std::span<const StateVariableId> numbers) {
    leave_out_others(numbers);
    while (!is_stable()) {
      std::ranges::max_element(numbers_, {}, &Number::work)->is_whole = true;
    }
  }

  const Number& number(StateVariableId id) const {
    return numbers_[*number_at_[index(network_.state_variable[index(id)])]];
  }

  std::vector<int> samples(const Number& number) const {
    using Rank = std::tuple<int, std::int64_t, std::int64_t>;
    std::map<std::size_t, Rank> best;
    const std::int64_t initial = network_.variable(number.variable).initial;
    const auto offer = [&](std::size_t region, int kind, std::int64_t value) {
      const Rank rank{kind, std::max(value - initial, initial - value), value};
      const auto [known, is_new] = best.emplace(region, rank);
      if (!is_new) known->second = std::min(known->second, rank);
    };
    for (const Piece& piece : number.pieces) {
      const auto& [low, high] = piece.values;
      const std::int64_t nearest = std::clamp(initial, low, high);
      offer(piece.region, nearest == initial ? 0 : 2, nearest);
    }
    for (const int value : number.constants) {
      const Piece* piece = piece_with(number, value);
      if (piece != nullptr) offer(piece->region, 1, value);
    }
    std::vector<int> values;
    for (const auto& [region, rank] : best) {
      values.push_back(static_cast<int>(std::get<2>(rank)));
    }
    std::ranges::sort(values);
    return values;
  }

 private:
  void find_numbers() {
    for (const VariableId id : network_.state_variable) add_number(id);
    for (const KeptArgument& each : network_.arguments) {
      add_number(each.variable);
    }
  }

  void add_number(VariableId id) {
    if (!network_.variable(id).value_names.empty()) return;
    number_at_[index(id)] = numbers_.size();
    numbers_.push_back({id, {}, {}, {}});
  }

  Number* number_of(VariableId variable) {
    const auto at = number_at_[index(variable)];
    return at ? &numbers_[*at] : nullptr;
  }

  // The number that the terms are about; nullptr where they are about none, or
  // about several variables, and then the values of all of them matter.
  Number* only_number(std::span<const Term> terms) {
    std::vector<VariableId> read;
    for (const Term& term : terms) {
      if (term.operation != Operation::Variable) continue;
      add_new(read, VariableId{static_cast<std::uint32_t>(term.operand)});
    }
    if (read.size() == 1) return number_of(read.front());
    for (const VariableId variable : read) {
      Number* number = number_of(variable);
      if (number == nullptr) continue;
      number->is_whole = true;
      number->beside = read.front() == variable ? read.back() : read.front();
    }
    return nullptr;
  }

  void take_condition(const Expression& condition) {
    each_atom(condition.terms(), [&](std::span<const Term> terms) {
      Number* number = only_number(terms);
      if (number == nullptr) return;
      add_new(number->atoms, Terms(terms.begin(), terms.end()));
    });
  }

  void take_update(const Assignment& update) {
    const auto terms = update.value.terms();
    // Its parts decide what comes out of it.
    if (!terms.empty() && joins_conditions(terms.back().operation)) {
      return take_condition(update.value);
    }
    Number* read = only_number(terms);
    if (read != nullptr) {
      add_new(read->moves,
              {update.variable, Terms(terms.begin(), terms.end())});
    }
    Number* written = number_of(update.variable);
    const auto constant = update.value.only(Operation::Constant);
    if (written != nullptr && constant) add_new(written->constants, *constant);
  }

  void leave_out_others(std::span<const StateVariableId> numbers) {
    std::vector<VariableId> open;
    for (const StateVariableId id : numbers) {
      open.push_back(network_.state_variable[index(id)]);
    }
    std::vector<bool> is_needed(numbers_.size());
    while (!open.empty()) {
      const auto at = number_at_[index(open.back())];
      open.pop_back();
      if (!at || is_needed[*at]) continue;
      is_needed[*at] = true;
      for (const Move& move : numbers_[*at].moves) open.push_back(move.to);
    }
    for (std::size_t i = 0; i < numbers_.size(); ++i) {
      numbers_[i].is_whole = numbers_[i].is_whole || !is_needed[i];
    }
  }

  // From one region each until none falls apart; false where that is too much
  // work.
  bool is_stable() {
    work_ = 0;
    for (Number& each : numbers_) {
      const Variable& variable = network_.variable(each.variable);
      each.pieces.clear();
      each.regions = 1;
      each.work = 0;
      if (each.is_whole) continue;
      each.pieces.push_back({{variable.min, variable.max}, 0});
    }
    for (bool falls_apart = true; falls_apart;) {
      falls_apart = false;
      for (Number& each : numbers_) {
        if (each.is_whole) continue;
        const std::size_t before = each.regions;
        if (!refine(each)) return false;
        falls_apart = falls_apart || each.regions != before;
      }
    }
    return true;
  }

  bool refine(Number& number) {
    std::vector<Piece> refined;
    std::map<std::vector<std::int64_t>, std::size_t> regions;
    for (const Piece& piece : number.pieces) {
      std::vector<ValueRange> open = {piece.values};
      while (!open.empty()) {
        ++number.work;
        if (++work_ > kMostWork) return false;
        const ValueRange values = open.back();
        open.pop_back();
        std::vector<std::int64_t> outcome = {
            static_cast<std::int64_t>(piece.region)};
        if (!add_outcome(number, values, outcome)) {
          assert(!values.is_one());
          const std::int64_t middle =
              values.low + (values.high - values.low) / 2;
          open.push_back({middle + 1, values.high});
          open.push_back({values.low, middle});
          continue;
        }
        const std::size_t region =
            regions.emplace(std::move(outcome), regions.size()).first->second;
        if (!refined.empty() && refined.back().region == region) {
          refined.back().values.high = values.high;
        } else {
          refined.push_back({values, region});
        }
      }
    }
    number.pieces = std::move(refined);
    number.regions = regions.size();
    return true;
  }

  // How these values come out of each comparison and assignment; false where
  // not all come out alike, or it is not known.
  bool add_outcome(const Number& number, ValueRange values,
                   std::vector<std::int64_t>& outcome) const {
    for (const Terms& atom : number.atoms) {
      const ValueRange truth = range_of(atom, values);
      const bool is_true = !truth.has(0);
      if (!is_true && !truth.is_one()) return false;
      outcome.push_back(is_true);
    }
    return std::ranges::all_of(number.moves, [&](const Move& move) {
      const auto target = place_of(move.to, range_of(move.value, values));
      if (target) outcome.push_back(*target);
      return target.has_value();
    });
  }

  // The region of these values of a variable, or the only value; one number for
  // all that lie out of its range, which ends the run.
  std::optional<std::int64_t> place_of(VariableId id, ValueRange values) const {
    constexpr auto kOutside = std::numeric_limits<std::int64_t>::min();
    const Variable& variable = network_.variable(id);
    if (values.high < variable.min || values.low > variable.max) {
      return kOutside;
    }
    const auto at = number_at_[index(id)];
    if (!at || numbers_[*at].is_whole) {
      return values.is_one() ? std::optional(values.low) : std::nullopt;
    }
    const Piece* piece = piece_with(numbers_[*at], values.low);
    if (piece == nullptr || !piece->values.has(values.high))
      return std::nullopt;
    return static_cast<std::int64_t>(piece->region);
  }

  static const Piece* piece_with(const Number& number, std::int64_t value) {
    const auto found = std::ranges::lower_bound(
        number.pieces, value, {},
        [](const Piece& piece) { return piece.values.high; });
    const bool is_there =
        found != number.pieces.end() && found->values.has(value);
    return is_there ? &*found : nullptr;
  }

  const Network& network_;
  std::vector<Number> numbers_;
  std::vector<std::optional<std::size_t>> number_at_;  // by VariableId
  std::uint64_t work_ = 0;
};

}  // namespace

Regions regions_of(const Network& network,
                   std::span<const StateVariableId> numbers,
                   std::span<const Expression> asked) {
  Splitting splitting(network, asked);
  splitting.run(numbers);
  Regions found;
  found.samples.resize(network.state_variable.size());
  for (const StateVariableId id : numbers) {
    const Number& number = splitting.number(id);
    if (number.is_whole) {
      found.unsplit.push_back({id, number.beside});
    } else {
      found.samples[index(id)] = splitting.samples(number);
    }
  }
  return found;
}

}  // namespace btcheck
