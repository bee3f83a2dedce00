// SPDX-License-Identifier: MIT
#include "explore/components/cut_part.hpp"

#include <algorithm>

namespace btcheck {

CutPart::CutPart(const ComponentTable& all, AutomatonId root, PartSide side,
                 const std::vector<PartMember>& members)
    : all_(all),
      network_(all.network_),
      root_(root),
      side_(side),
      members_(members),
      timers_(all.timers_[index(members[0].automaton)]),
      is_called_(side == PartSide::Inside && all.protocol_.parent(root)),
      waits_instantly_(side == PartSide::Outside &&
                       all.known(root, PartSide::Inside).shape->is_instant) {
  const Automaton& top = network_.automaton(root);
  status_ = number(network_.node_status[index(top.node)]);
  if (top.gate) gate_ = number(*top.gate);
  put_automaton(members_[0].automaton);
  put(timers_.size());
  for (const AutomatonId timer : timers_) put_automaton(timer);
  put(members_.size());
  for (const PartMember& member : members_) {
    if (member.component != nullptr) put_component(member);
  }
  location_ =
      number(side == PartSide::Inside ? top.location : all.outside_of(root));
  memory_ = number(all.memory_of(root));
  collect_changes();
  if (is_called_ && all.entries_[index(root)]) {
    entry_ = &*all.entries_[index(root)];
  }
  collect_own();
  const std::size_t entered = entry_ == nullptr ? SIZE_MAX : entry_->entered;
  for (const auto value :
       {static_cast<std::size_t>(network_.ticks),
        static_cast<std::size_t>(side_), std::size_t{is_called_},
        std::size_t{waits_instantly_}, std::size_t{gate_.has_value()},
        entered >> 32, entered & 0xffffffff, all.limits_.states,
        all.limits_.inner_edges}) {
    put(value);
  }
}

VariableId CutPart::number(VariableId name) {
  const auto [known, is_new] = numbers_.try_emplace(
      index(name), VariableId{static_cast<std::uint32_t>(names_.size())});
  if (is_new) names_.push_back(name);
  return known->second;
}

void CutPart::put_automaton(AutomatonId id) {
  append(
      network_.automaton(id), [&](VariableId name) { return number(name); },
      content_);
}

void CutPart::put_component(const PartMember& member) {
  const Component& shape = *member.component->shape;
  put(static_cast<std::size_t>(member.side));
  for (const std::uint64_t half : {shape.content.low, shape.content.high}) {
    put(half >> 32);
    put(half & 0xffffffff);
  }
  for (const VariableId each : shape.spoken_of) {
    put(index(number(member.component->name(each))));
  }
}

void CutPart::collect_changes() {
  const VariableId status = names_[index(status_)];
  const Variable& range = network_.variable(status);
  for (const AutomatonId writer : all_.accesses_.writers[index(status)]) {
    const bool is_inside = all_.is_below(writer, root_);
    if (is_inside == (side_ == PartSide::Inside)) continue;
    for (const Edge& edge : network_.automaton(writer).edges) {
      for (const Assignment& update : edge.updates) {
        if (update.variable != status) continue;
        const auto value = constant_value(update);
        for (int to = range.min; to <= range.max; ++to) {
          if (value && *value != to) continue;
          for (int from = range.min; from <= range.max; ++from) {
            if (excludes(edge.guard, status, from)) continue;
            changes_.emplace(from, to);
          }
        }
      }
    }
  }
  put(changes_.size());
  for (const auto& [from, to] : changes_) {
    put(from);
    put(to);
  }
}

// First where the components stand; then what nobody else touches, in the order
// of the numbers; then clocks.
void CutPart::collect_own() {
  variables_.resize(names_.size());
  std::vector<bool> is_own(names_.size(), false);
  const auto add = [&](VariableId number, const Variable& range) {
    variables_[index(number)] = range;
    is_own[index(number)] = true;
    own_.push_back(number);
  };
  for (const PartMember& member : members_) {
    if (member.component == nullptr) continue;
    const PlacedComponent& component = *member.component;
    const Component& shape = *component.shape;
    add(known_number(component.name(shape.location_id)), shape.location);
    if (member.side == PartSide::Outside) continue;
    add(known_number(component.name(shape.memory_id)), shape.memory);
  }
  for (std::uint32_t n = 0; n < names_.size(); ++n) {
    const VariableId number{n};
    if (is_own[n] || is_behind(number)) continue;
    const Variable& variable = network_.variable(names_[n]);
    variables_[n] = variable;
    const bool is_call = gate_ && (number == status_ || number == gate_);
    if (!is_call && all_.is_only_in(root_, side_, names_[n])) {
      add(number, variable);
    }
  }
  add_clock(members_[0].automaton);
  for (const AutomatonId timer : timers_) add_clock(timer);
  put(names_.size());
  for (std::uint32_t n = 0; n < names_.size(); ++n) {
    put(variables_[n].min);
    put(variables_[n].max);
    put(variables_[n].initial);
    put(std::size_t{is_behind(VariableId{n})});
  }
  for (const VariableId each : own_) put(index(each));
}

void CutPart::add_clock(AutomatonId id) {
  Variable clock;
  for (const Edge& edge : network_.automaton(id).edges) {
    clock.max = std::max(clock.max, edge.when.greatest_clock());
  }
  if (clock.max == 0) return;
  own_.push_back(number(all_.clock_of(id)));
  variables_.push_back(std::move(clock));
}

CutPart::Moving CutPart::numbered(AutomatonId id) const {
  const auto known = [&](VariableId name) { return known_number(name); };
  Moving moving{with_names(network_.automaton(id), known),
                nullptr,
                PartSide::Inside,
                {},
                {}};
  const auto clock = numbers_.find(index(all_.clock_of(id)));
  if (clock != numbers_.end()) moving.clock = clock->second;
  return moving;
}

std::vector<CutPart::Moving> CutPart::members() const {
  std::vector<Moving> all = {numbered(members_[0].automaton)};
  for (const PartMember& member : members_) {
    if (member.component == nullptr) continue;
    const Component& shape = *member.component->shape;
    const auto known = [&](VariableId own) {
      return known_number(member.component->name(own));
    };
    all.push_back({with_names(shape.automaton, known),
                   &shape,
                   member.side,
                   known(shape.memory_id),
                   {}});
  }
  return all;
}

std::vector<CutPart::Moving> CutPart::timers() const {
  std::vector<Moving> all;
  for (const AutomatonId timer : timers_) all.push_back(numbered(timer));
  return all;
}

}  // namespace btcheck
