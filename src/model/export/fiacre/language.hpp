// SPDX-License-Identifier: MIT
//
// Names, types and expressions of a network as Fiacre writes them.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "model/export/promela/names.hpp"
#include "model/export/typed_expression.hpp"

namespace btcheck {

// Where the location of an automaton is kept.
enum class LocationPlace : std::uint8_t {
  State,    // the states of its process
  Variable  // a shared variable, as another automaton reads or writes it
};

// What the parts of a model have to know of each other.
class FiacreLanguage final : public TypedLanguage {
 public:
  // Both must outlive it.
  FiacreLanguage(const Network& network, const PromelaNames& names);

  Signs signs() const override {
    return {" and ", " or ", "not ", "", " % ", "true", "false"};
  }
  std::string variable(VariableId id) const override {
    return names_.variable(id);
  }
  bool is_enumeration(VariableId id) const override {
    return names_.has_named_values(id);
  }
  std::string value(VariableId id, int value) const override {
    return names_.value(id, value);
  }
  std::string number_of(VariableId id) const override {
    return "($ " + variable(id) + ")";
  }
  std::string value_of(VariableId, const std::string& number) const override {
    return "($ (" + number + "))";
  }

  const Network& network() const { return network_; }
  const PromelaNames& names() const { return names_; }
  LocationPlace place(AutomatonId id) const { return places_[index(id)]; }
  // The name of a state of its process; that of a process with its location
  // in a variable is kOnlyState.
  std::string state(AutomatonId id, LocationId location) const;
  static constexpr std::string_view kOnlyState = "here";

  std::string type(VariableId id) const;
  // The variables that a process has to itself, and those it shares: what its
  // edges read and write, ascending. A location kept in its states is neither.
  const std::vector<VariableId>& own(AutomatonId id) const {
    return own_[index(id)];
  }
  const std::vector<VariableId>& shared(AutomatonId id) const {
    return shared_[index(id)];
  }
  // The variables of the component: all but those.
  std::vector<VariableId> global() const;

  std::string condition(const Expression& expression) const {
    return typed_condition(network_, *this, expression).text;
  }
  std::string assigned(const Expression& expression, VariableId to) const {
    return typed_value(network_, *this, expression, to).text;
  }

 private:
  void find_users();
  void place_locations();
  void divide_variables();

  const Network& network_;
  const PromelaNames& names_;
  std::vector<std::vector<std::uint32_t>> users_;  // automata, by VariableId
  std::vector<LocationPlace> places_;              // by AutomatonId, like these
  std::vector<std::vector<VariableId>> own_;
  std::vector<std::vector<VariableId>> shared_;
};

// An identifier that is no word of Fiacre.
std::string fiacre_identifier(std::string_view text);

}  // namespace btcheck
