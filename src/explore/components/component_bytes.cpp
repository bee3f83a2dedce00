// SPDX-License-Identifier: MIT
//
// Numbers of seven bits to a byte, the lowest first, so that most take one, and
// behind them a seal: a hash of all of them and of what they belong to. It
// finds damage, not malice. So whatever is read is looked at all the same: a
// number that leads out of a component would be worse than an answer that is
// wrong.
//
// Structures are taken apart by name here: one that has a new member does not
// compile until it has a place in the bytes.
#include "explore/components/component_bytes.hpp"

#define XXH_INLINE_ALL
#include <xxhash.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "explore/components/component.hpp"

namespace btcheck {
namespace {

constexpr std::uint64_t kFormat = 1;
constexpr std::size_t kSealBytes = 16;

// The seal of some bytes, which belong to a content.
std::string seal_of(std::string_view bytes, const ContentHash& made_of) {
  XXH3_state_t state;
  XXH3_128bits_reset(&state);
  std::string owner;
  for (const std::uint64_t half : {made_of.low, made_of.high}) {
    for (int shift = 0; shift < 64; shift += 8) {
      owner += static_cast<char>(half >> shift & 0xff);
    }
  }
  XXH3_128bits_update(&state, owner.data(), owner.size());
  XXH3_128bits_update(&state, bytes.data(), bytes.size());
  XXH128_canonical_t seal;
  XXH128_canonicalFromHash(&seal, XXH3_128bits_digest(&state));
  static_assert(sizeof seal.digest == kSealBytes);
  return {reinterpret_cast<const char*>(seal.digest), kSealBytes};
}

class ByteWriter {
 public:
  void put(std::uint64_t value) {
    for (; value >= 0x80; value >>= 7) {
      bytes_ += static_cast<char>(value | 0x80);
    }
    bytes_ += static_cast<char>(value);
  }
  // Small ones of either sign are short.
  void put_signed(std::int32_t value) {
    const auto wide = static_cast<std::int64_t>(value);
    put(value < 0 ? static_cast<std::uint64_t>(-2 * wide - 1)
                  : static_cast<std::uint64_t>(2 * wide));
  }
  void put(VariableId id) { put(std::uint64_t{index(id)}); }
  void put(const std::string& text) {
    put(text.size());
    bytes_ += text;
  }
  // What no component has is not written.
  void leave_out(bool is_as_ever) { is_whole_ = is_whole_ && is_as_ever; }

  bool is_whole() const { return is_whole_; }
  std::string take() && { return std::move(bytes_); }

 private:
  std::string bytes_;
  bool is_whole_ = true;
};

// Behind the first number that cannot be, all are 0, and `is_sound` is false.
class ByteReader {
 public:
  explicit ByteReader(std::string_view bytes) : rest_(bytes) {}

  std::uint64_t number(
      std::uint64_t most = std::numeric_limits<std::uint64_t>::max()) {
    std::uint64_t value = 0;
    for (int shift = 0; shift < 64; shift += 7) {
      if (!require(!rest_.empty())) return 0;
      const auto byte = static_cast<unsigned char>(rest_.front());
      rest_.remove_prefix(1);
      const std::uint64_t part = byte & 0x7f;
      if (!require(part <= (most - value) >> shift)) return 0;
      value |= part << shift;
      if (byte < 0x80) return require(part != 0 || shift == 0) ? value : 0;
    }
    require(false);
    return 0;
  }
  std::uint32_t number32(
      std::uint32_t most = std::numeric_limits<std::uint32_t>::max()) {
    return static_cast<std::uint32_t>(number(most));
  }
  int signed_number() {
    const std::uint64_t value =
        number(std::numeric_limits<std::uint32_t>::max());
    const auto half = static_cast<std::int64_t>(value / 2);
    return static_cast<int>(value % 2 == 0 ? half : -half - 1);
  }
  int signed_number(int least, int most) {
    const int value = signed_number();
    return require(least <= value && value <= most) ? value : least;
  }
  bool flag() { return number(1) != 0; }
  VariableId variable() {
    return VariableId{number32(std::numeric_limits<std::int32_t>::max())};
  }
  // Of things that take a byte each, at least.
  std::size_t count() { return number(rest_.size()); }
  std::string text() {
    const std::size_t size = count();
    if (!require(size <= rest_.size())) return {};
    std::string text(rest_.substr(0, size));
    rest_.remove_prefix(size);
    return text;
  }

  bool require(bool holds) {
    is_sound_ = is_sound_ && holds;
    if (!is_sound_) rest_ = {};
    return is_sound_;
  }
  bool is_sound() const { return is_sound_; }
  bool is_at_end() const { return rest_.empty(); }

 private:
  std::string_view rest_;
  bool is_sound_ = true;
};

// --- Parts of a component ---------------------------------------------------

void put(ByteWriter& to, const Variable& variable) {
  const auto& [role, name, min, max, initial, names, owner, scale, local] =
      variable;
  to.put(static_cast<std::uint64_t>(role));
  to.put(name);
  for (const int each : {min, max, initial}) to.put_signed(each);
  to.leave_out(names.empty() && !owner && scale == Scale{} &&
               local == LocalRole::Inner);
}

Variable variable_in(ByteReader& from) {
  Variable variable;
  variable.role = static_cast<VariableRole>(
      from.number(static_cast<std::uint64_t>(VariableRole::Fault)));
  variable.name = from.text();
  variable.min = from.signed_number();
  variable.max = from.signed_number();
  variable.initial = from.signed_number();
  from.require(variable.min <= variable.initial &&
               variable.initial <= variable.max);
  return variable;
}

void put(ByteWriter& to, const Expression& expression) {
  to.put(expression.terms().size());
  for (const auto& [operation, operand] : expression.terms()) {
    to.put(static_cast<std::uint64_t>(operation));
    if (arity(operation) == 0) {
      to.put_signed(operand);
    } else {
      to.leave_out(operand == 0);
    }
  }
}

Expression expression_in(ByteReader& from) {
  std::vector<Expression> stack;
  for (std::size_t left = from.count(); left > 0; --left) {
    const auto operation = static_cast<Operation>(
        from.number(static_cast<std::uint64_t>(Operation::Or)));
    const auto taken = static_cast<std::size_t>(arity(operation));
    if (!from.require(operation != Operation::Status &&
                      taken <= stack.size())) {
      return {};
    }
    if (taken == 0) {
      const int operand = from.signed_number();
      const bool is_constant = operation == Operation::Constant;
      if (!from.require(is_constant || operand >= 0)) return {};
      stack.push_back(is_constant ? Expression::constant(operand)
                                  : Expression::variable(operand));
      continue;
    }
    Expression right = std::move(stack.back());
    stack.pop_back();
    if (taken == 1) {
      stack.push_back(Expression::unary(operation, std::move(right)));
      continue;
    }
    Expression& last = stack.back();
    last = Expression::binary(operation, std::move(last), std::move(right));
  }
  if (stack.empty() || !from.require(stack.size() == 1)) return {};
  return std::move(stack[0]);
}

void put(ByteWriter& to, const Location& location) {
  const auto& [name, role, child] = location;
  to.put(name);
  to.put(static_cast<std::uint64_t>(role));
  to.leave_out(child == NodeId{});
}

Location location_in(ByteReader& from) {
  Location location;
  location.name = from.text();
  location.role = static_cast<LocationRole>(
      from.number(static_cast<std::uint64_t>(LocationRole::Done)));
  return location;
}

void put(ByteWriter& to, const Edge& edge) {
  const auto& [source, target, guard, updates, when, label, asks_world,
               tells_why, is_like_time, scripts] = edge;
  const auto& [lower, upper] = when;
  to.put(std::uint64_t{index(source)});
  to.put(std::uint64_t{index(target)});
  put(to, guard);
  to.put(updates.size());
  for (const auto& [variable, value] : updates) {
    to.put(variable);
    put(to, value);
  }
  to.put_signed(lower);
  to.put_signed(upper);
  to.put(std::uint64_t{is_like_time});
  to.leave_out(label.empty() && !asks_world && !tells_why && scripts.empty());
}

Edge edge_in(ByteReader& from, std::uint32_t last_location) {
  constexpr int kMost = std::numeric_limits<int>::max();
  Edge edge;
  edge.source = LocationId{from.number32(last_location)};
  edge.target = LocationId{from.number32(last_location)};
  edge.guard = expression_in(from);
  for (std::size_t left = from.count(); left > 0; --left) {
    const VariableId variable = from.variable();
    edge.updates.push_back({variable, expression_in(from)});
  }
  edge.when.lower = from.signed_number(0, kMost);
  edge.when.upper = from.signed_number(edge.when.lower, kMost);
  edge.is_like_time = from.flag();
  return edge;
}

void put(ByteWriter& to, const Automaton& automaton) {
  const auto& [kind, name, node, state_variable, location, gate, locations,
               edges, locals, first_edge] = automaton;
  to.leave_out(kind == AutomatonKind::Node && name.empty() &&
               node == NodeId{} && state_variable == StateVariableId{} &&
               first_edge == 0);
  to.put(location);
  to.put(std::uint64_t{gate.has_value()});
  if (gate) to.put(*gate);
  to.put(locations.size());
  for (const Location& each : locations) put(to, each);
  to.put(edges.size());
  for (const Edge& each : edges) put(to, each);
  to.put(locals.size());
  for (const VariableId each : locals) to.put(each);
}

Automaton automaton_in(ByteReader& from) {
  Automaton automaton;
  automaton.location = from.variable();
  if (from.flag()) automaton.gate = from.variable();
  for (std::size_t left = from.count(); left > 0; --left) {
    automaton.locations.push_back(location_in(from));
  }
  if (!from.require(!automaton.locations.empty())) return automaton;
  const auto last = static_cast<std::uint32_t>(automaton.locations.size() - 1);
  for (std::size_t left = from.count(); left > 0; --left) {
    automaton.edges.push_back(edge_in(from, last));
  }
  for (std::size_t left = from.count(); left > 0; --left) {
    automaton.locals.push_back(from.variable());
  }
  return automaton;
}

}  // namespace

// --- A component ------------------------------------------------------------

class ComponentBytes {
 public:
  static void put(ByteWriter& to, const Component& component);
  static std::shared_ptr<const Component> read(ByteReader& from);

 private:
  static void put_states(ByteWriter& to, const Component& component);
  static void read_states(ByteReader& from, Component& component);
  static bool is_sound(const Component& component);
};

void ComponentBytes::put(ByteWriter& to, const Component& component) {
  // What is spoken of, and the content, are told anew.
  const auto& [automaton, location, location_id, memory, memory_id, later,
               is_instant, spoken_of, content, own, states, first, arcs,
               place_of, places, drawn] = component;
  btcheck::put(to, automaton);
  btcheck::put(to, location);
  to.put(location_id);
  btcheck::put(to, memory);
  to.put(memory_id);
  to.put(later.size());
  for (const int each : later) to.put_signed(each);
  to.put(std::uint64_t{is_instant});
  to.put(places.size());
  for (const auto& [at, remembered] : places) {
    to.put_signed(at);
    to.put_signed(remembered);
  }
  to.leave_out(drawn.size() == automaton.edges.size());
  for (const auto& [label, source, target, is_loop] : drawn) {
    to.put(std::uint64_t{label});
    to.put(std::uint64_t{source});
    to.put(std::uint64_t{target});
    to.put(std::uint64_t{is_loop});
  }
  to.put(own.size());
  for (const VariableId each : own) to.put(each);
  put_states(to, component);
}

// By number: the values, where it stands, and the steps from there.
void ComponentBytes::put_states(ByteWriter& to, const Component& component) {
  std::vector<const Component::Values*> values(component.size(), nullptr);
  for (const auto& [of_state, number] : component.states_) {
    values[number] = &of_state;
  }
  to.put(component.size());
  for (std::uint32_t s = 0; s < component.size(); ++s) {
    to.leave_out(values[s] != nullptr);
    if (!to.is_whole()) return;
    for (const int each : *values[s]) to.put_signed(each);
    // kPassing is 0.
    to.put(std::uint64_t{component.place_of_[s] + 1});
    const auto arcs = component.arcs(s);
    to.put(arcs.size());
    for (const auto& [label, target, member] : arcs) {
      to.put(std::uint64_t{label});
      to.put(std::uint64_t{target});
      to.put(std::uint64_t{member.number});
      to.put(std::uint64_t{member.edge});
    }
  }
}

std::shared_ptr<const Component> ComponentBytes::read(ByteReader& from) {
  auto made = std::make_shared<Component>();
  made->automaton = automaton_in(from);
  made->location = variable_in(from);
  made->location_id = from.variable();
  made->memory = variable_in(from);
  made->memory_id = from.variable();
  for (std::size_t left = from.count(); left > 0; --left) {
    made->later.push_back(from.signed_number());
  }
  made->is_instant = from.flag();
  for (std::size_t left = from.count(); left > 0; --left) {
    const int location = from.signed_number();
    made->places_.push_back({location, from.signed_number()});
  }
  if (!from.require(!made->places_.empty())) return nullptr;
  const auto last_place = static_cast<std::uint32_t>(made->places_.size() - 1);
  for (std::size_t e = 0; e < made->automaton.edges.size(); ++e) {
    const std::uint32_t label = from.number32();
    const std::uint32_t source = from.number32(last_place);
    const std::uint32_t target = from.number32(last_place);
    made->drawn_.push_back({label, source, target, from.flag()});
  }
  for (std::size_t left = from.count(); left > 0; --left) {
    made->own_.push_back(from.variable());
  }
  read_states(from, *made);
  if (!from.require(from.is_at_end() && is_sound(*made))) return nullptr;
  made->tell_content();
  return made;
}

void ComponentBytes::read_states(ByteReader& from, Component& component) {
  const auto places = static_cast<std::uint32_t>(component.places_.size());
  const auto states = static_cast<std::uint32_t>(from.count());
  if (!from.require(states > 0)) return;
  component.states_.reserve(states);
  component.first_.push_back(0);
  for (std::uint32_t s = 0; s < states && from.is_sound(); ++s) {
    Component::Values values(component.own_.size());
    for (int& each : values) each = from.signed_number();
    const auto added = component.states_.emplace(std::move(values), s);
    from.require(added.second);
    component.place_of_.push_back(from.number32(places) - 1);
    for (std::size_t left = from.count(); left > 0; --left) {
      Component::Arc arc;
      arc.label = from.number32();
      arc.target = from.number32(states - 1);
      arc.member.number = from.number32();
      arc.member.edge = from.number32();
      component.arcs_.push_back(arc);
    }
    component.first_.push_back(
        static_cast<std::uint32_t>(component.arcs_.size()));
  }
}

// Of what is in range: that it is together what one component is.
bool ComponentBytes::is_sound(const Component& component) {
  const Automaton& automaton = component.automaton;
  const Variable& location = component.location;
  const Variable& memory = component.memory;
  const auto locations = static_cast<std::int64_t>(automaton.locations.size());
  const auto is_in = [](const Variable& range, int value) {
    return range.min <= value && value <= range.max;
  };
  // By its value is told what is later.
  const Variable& in_time = automaton.gate ? memory : location;
  const auto keeps_memory = [&](const Assignment& update) {
    if (update.variable != component.memory_id) return true;
    const auto value = update.value.only(Operation::Constant);
    return value && is_in(memory, *value);
  };
  return component.location_id != component.memory_id &&
         automaton.location == component.location_id && location.min == 0 &&
         location.max == locations - 1 && memory.min == 0 &&
         std::ranges::all_of(
             automaton.locals,
             [&](VariableId local) { return local == component.memory_id; }) &&
         static_cast<std::int64_t>(component.later.size()) ==
             in_time.domain_size() &&
         std::ranges::all_of(component.later,
                             [&](int to) { return is_in(in_time, to); }) &&
         std::ranges::all_of(component.places_,
                             [&](const Component::Place& place) {
                               return is_in(location, place.location) &&
                                      is_in(memory, place.memory);
                             }) &&
         std::ranges::all_of(automaton.edges, [&](const Edge& edge) {
           return std::ranges::all_of(edge.updates, keeps_memory);
         });
}

// --- The whole --------------------------------------------------------------

std::optional<std::string> bytes_of(const Component* known,
                                    const ContentHash& made_of) {
  ByteWriter to;
  to.put(kFormat);
  to.put(std::uint64_t{known != nullptr});
  if (known != nullptr) ComponentBytes::put(to, *known);
  if (!to.is_whole()) return std::nullopt;
  return sealed(std::move(to).take(), made_of);
}

std::string sealed(std::string bytes, const ContentHash& content) {
  bytes += seal_of(bytes, content);
  return bytes;
}

std::optional<std::string_view> unsealed(std::string_view bytes,
                                         const ContentHash& content) {
  if (bytes.size() < kSealBytes) return std::nullopt;
  const std::string_view inside = bytes.substr(0, bytes.size() - kSealBytes);
  const bool is_whole = bytes.substr(inside.size()) == seal_of(inside, content);
  return is_whole ? std::optional(inside) : std::nullopt;
}

std::optional<ComponentStore::Known> component_in(std::string_view bytes,
                                                  const ContentHash& made_of) {
  const auto inside = unsealed(bytes, made_of);
  if (!inside) return std::nullopt;
  ByteReader from(*inside);
  from.require(from.number() == kFormat);
  if (!from.flag()) {
    const bool is_sound = from.is_sound() && from.is_at_end();
    return is_sound ? std::optional(ComponentStore::Known()) : std::nullopt;
  }
  auto component = ComponentBytes::read(from);
  if (component == nullptr) return std::nullopt;
  return component;
}

}  // namespace btcheck
