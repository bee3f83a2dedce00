// SPDX-License-Identifier: MIT
#include "explore/reduce/contexts.hpp"

#include <bitset>
#include <numeric>
#include <optional>
#include <set>
#include <span>
#include <unordered_map>
#include <utility>

#include "explore/state/accesses.hpp"
#include "text/budget.hpp"

namespace btcheck {
namespace {

constexpr std::size_t kMostFlags = 4;
constexpr std::size_t kMostPlaces = 2;
constexpr std::size_t kMostOfPlace = 65'536;  // values
constexpr int kMostBits = 64;

// Goes along the edges of an automaton from where it begins.
class Walk {
 public:
  // With an entry, the status is the last of what is told.
  Walk(const Network& network, const Automaton& automaton,
       std::span<const VariableId> told, const CalledWith* entry)
      : automaton_(automaton),
        entry_(entry),
        leaving_(automaton.locations.size()) {
    for (std::uint32_t e = 0; e < automaton.edges.size(); ++e) {
      const Edge& edge = automaton.edges[e];
      leaving_[index(edge.source)].push_back(e);
      effects_.push_back(effect_of(network, edge, told));
    }
    find_live();
    std::uint64_t weight = automaton.locations.size();
    for (const VariableId variable : told) {
      const Variable& of = network.variable(variable);
      scales_.push_back({weight, static_cast<std::uint64_t>(of.domain_size())});
      weight *= of.domain_size();
    }
    const Variable& location = network.variable(automaton.location);
    Key first = static_cast<Key>(location.initial - location.min);
    const auto live = live_[first];
    for (std::size_t i = 0; i < told.size(); ++i) {
      if (!live[i]) continue;
      const Variable& of = network.variable(told[i]);
      first += static_cast<Key>(of.initial - of.min) * scales_[i].weight;
    }
    find(first);
  }

  // False where there are more than so many arcs.
  bool take(std::size_t most_arcs, std::vector<Contexts::Arc>& arcs) {
    for (std::uint32_t from = 0; from < keys_.size(); ++from) {
      ask_budget();
      for (const std::uint32_t edge : leaving_[index(location(from))]) {
        add_arcs(from, edge, arcs);
        if (arcs.size() > most_arcs) return false;
      }
    }
    return true;
  }

  std::vector<LocationId> locations() const {
    std::vector<LocationId> all;
    for (std::uint32_t c = 0; c < keys_.size(); ++c) all.push_back(location(c));
    return all;
  }

 private:
  using Told = std::bitset<kMostFlags + kMostPlaces + 1>;
  // The location, and each value in its turn, as one number.
  using Key = std::uint64_t;
  struct Scale {
    Key weight = 1;
    Key size = 1;
  };
  // What an edge demands of a value, counted from the lowest, and makes of it.
  struct Effect {
    std::optional<Key> demanded;
    std::uint64_t excluded = 0;  // of the first values, as bits
    std::optional<Key> given;
    bool is_open = false;   // it may be any afterwards
    bool is_asked = false;  // before that
  };

  static std::vector<Effect> effect_of(const Network& network, const Edge& edge,
                                       std::span<const VariableId> told) {
    std::vector<Effect> effects(told.size());
    for (std::size_t i = 0; i < told.size(); ++i) {
      const Variable& of = network.variable(told[i]);
      if (const auto value = demanded_value(edge.guard, told[i])) {
        effects[i].demanded = static_cast<Key>(*value - of.min);
      }
      const auto ask = [&](VariableId read, std::optional<int>) {
        effects[i].is_asked |= read == told[i];
      };
      for_each_read(edge.guard, ask);
      if (effects[i].is_asked && of.domain_size() <= kMostBits) {
        effects[i].excluded = excluded_values(network, edge.guard, told[i]);
      }
      for (const Assignment& update : edge.updates) {
        for_each_read(update.value, ask);
        if (update.variable != told[i]) continue;
        const auto value = constant_value(update);
        effects[i].is_open = !value || *value < of.min || *value > of.max;
        if (value) effects[i].given = static_cast<Key>(*value - of.min);
      }
    }
    return effects;
  }

  // A value that nobody asks for before it is given anew makes no difference.
  void find_live() {
    live_.assign(automaton_.locations.size(), {});
    std::vector<std::vector<std::uint32_t>> entering(live_.size());
    for (std::uint32_t e = 0; e < automaton_.edges.size(); ++e) {
      entering[index(automaton_.edges[e].target)].push_back(e);
    }
    const auto live_before = [&](std::uint32_t edge) {
      Told live = live_[index(automaton_.edges[edge].target)];
      for (std::size_t i = 0; i < effects_[edge].size(); ++i) {
        const Effect& effect = effects_[edge][i];
        const bool is_given = effect.given || effect.is_open;
        live[i] = effect.is_asked || (live[i] && !is_given);
      }
      return live;
    };
    std::vector<std::uint32_t> open(automaton_.edges.size());
    std::iota(open.begin(), open.end(), 0u);
    while (!open.empty()) {
      const std::uint32_t edge = open.back();
      open.pop_back();
      const std::uint32_t source = index(automaton_.edges[edge].source);
      const Told live = live_[source] | live_before(edge);
      if (live == live_[source]) continue;
      live_[source] = live;
      open.insert(open.end(), entering[source].begin(), entering[source].end());
    }
  }

  LocationId location(std::uint32_t context) const {
    return LocationId{static_cast<std::uint32_t>(keys_[context] %
                                                 automaton_.locations.size())};
  }
  std::uint32_t find(Key key) {
    const auto [known, is_new] =
        numbers_.try_emplace(key, static_cast<std::uint32_t>(keys_.size()));
    if (is_new) keys_.push_back(key);
    return known->second;
  }

  // Where it is called, its status is what the parent has made of it, if
  // anybody asks.
  void add_arcs(std::uint32_t from, std::uint32_t edge,
                std::vector<Contexts::Arc>& arcs) {
    const Key key = keys_[from];
    const bool begins = entry_ != nullptr && index(location(from)) == 0;
    if (!begins || !live_[0][scales_.size() - 1]) {
      return add_arcs(from, key, edge, arcs);
    }
    const auto [weight, size] = scales_.back();
    const Key value = key / weight % size;
    const std::uint64_t entered = entry_->after(std::uint64_t{1} << value);
    for (Key status = 0; status < size; ++status) {
      if ((entered >> status & 1) == 0) continue;
      add_arcs(from, key + (status - value) * weight, edge, arcs);
    }
  }
  void add_arcs(std::uint32_t from, Key key, std::uint32_t edge,
                std::vector<Contexts::Arc>& arcs) {
    const std::uint32_t target = index(automaton_.edges[edge].target);
    targets_.assign(1, target);
    for (std::size_t i = 0; i < scales_.size(); ++i) {
      const Effect& effect = effects_[edge][i];
      const auto [weight, size] = scales_[i];
      const Key value = key / weight % size;
      if (effect.demanded && *effect.demanded != value) return;
      if (value < Key{kMostBits} && (effect.excluded >> value & 1) != 0) return;
      if (!live_[target][i]) continue;
      const std::size_t known = targets_.size();
      const Key first = effect.is_open ? 0 : effect.given.value_or(value);
      for (std::size_t t = 0; t < known; ++t) {
        for (Key v = 1; effect.is_open && v < size; ++v) {
          targets_.push_back(targets_[t] + v * weight);
        }
        targets_[t] += first * weight;
      }
    }
    for (const Key each : targets_) arcs.push_back({from, find(each), edge});
  }

  const Automaton& automaton_;
  const CalledWith* entry_;
  std::vector<std::vector<std::uint32_t>> leaving_;  // by location
  std::vector<std::vector<Effect>> effects_;         // by edge
  std::vector<Told> live_;                           // by location
  std::vector<Scale> scales_;
  std::vector<Key> keys_;  // by context
  std::unordered_map<Key, std::uint32_t> numbers_;
  std::vector<Key> targets_;  // of one edge
};

// The locals whose values are told apart.
std::vector<VariableId> told_of(const Network& network,
                                const Automaton& automaton, bool with_places) {
  std::vector<VariableId> told;
  for (const VariableId local : automaton.locals) {
    const bool is_flag = network.variable(local).domain_size() == 2;
    if (is_flag && told.size() < kMostFlags) told.push_back(local);
  }
  if (!with_places) return told;
  const std::size_t most = told.size() + kMostPlaces;
  for (const VariableId local : automaton.locals) {
    const std::size_t size = network.variable(local).domain_size();
    const auto is_given = [&](const Assignment& update) {
      return update.variable != local || constant_value(update);
    };
    const bool is_place =
        size > 2 && size <= kMostOfPlace &&
        std::ranges::all_of(automaton.edges, [&](const Edge& edge) {
          return std::ranges::all_of(edge.updates, is_given);
        });
    if (is_place && told.size() < most) told.push_back(local);
  }
  return told;
}

}  // namespace

Contexts::Contexts(const Network& network, const Automaton& automaton,
                   std::size_t most_arcs,
                   const std::optional<CalledWith>& entry) {
  for (const bool is_precise : {true, false}) {
    arcs_.clear();
    told_ = told_of(network, automaton, is_precise);
    const bool has_entry = is_precise && entry;
    if (has_entry) told_.push_back(entry->status);
    Walk walk(network, automaton, told_, has_entry ? &*entry : nullptr);
    const bool is_whole = walk.take(is_precise ? most_arcs : SIZE_MAX, arcs_);
    locations_ = walk.locations();
    if (is_whole) break;
  }
  arcs_from_.resize(size());
  arcs_into_.resize(size());
  for (std::uint32_t arc = 0; arc < arcs_.size(); ++arc) {
    arcs_from_[arcs_[arc].from].push_back(arc);
    arcs_into_[arcs_[arc].to].push_back(arc);
  }
}

Mentions::Mentions(const Automaton& automaton) {
  for (std::uint32_t e = 0; e < automaton.edges.size(); ++e) {
    const Edge& edge = automaton.edges[e];
    for (const Expression& conjunct : edge.guard.conjuncts()) {
      std::set<VariableId> reads;
      for_each_read(conjunct, [&](VariableId read, std::optional<int>) {
        reads.insert(read);
      });
      for (const VariableId read : reads) {
        Expression& guard = add(e, read).guard;
        guard = both(std::move(guard), conjunct);
      }
    }
    for (const Assignment& update : edge.updates) {
      add(e, update.variable);
      for_each_read(update.value,
                    [&](VariableId read, std::optional<int>) { add(e, read); });
    }
  }
}

const std::vector<Mentions::Mention>& Mentions::of(VariableId variable) const {
  static const std::vector<Mention> kNone;
  const auto found = mentions_.find(index(variable));
  return found == mentions_.end() ? kNone : found->second;
}

Mentions::Mention& Mentions::add(std::uint32_t edge, VariableId variable) {
  std::vector<Mention>& all = mentions_[index(variable)];
  if (all.empty() || all.back().edge != edge) all.push_back({edge, {}});
  return all.back();
}

}  // namespace btcheck
