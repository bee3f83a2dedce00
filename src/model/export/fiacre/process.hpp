// SPDX-License-Identifier: MIT
//
// A network as Fiacre writes it: names and types, which variables each process
// sees, how processes keep time, and their text.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "model/export/fiacre/links.hpp"
#include "model/export/language.hpp"

namespace btcheck {

// A process of Fiacre knows only its own states. So an automaton whose location
// another one reads or writes keeps it in a shared variable; all others keep it
// in the states of their processes.
class FiacreLanguage final : public ExportLanguage {
 public:
  // All must outlive it. With links it is H-Fiacre.
  FiacreLanguage(const Network& network, const ExportNames& names,
                 const FiacreLinks& links);

  std::string number_of(VariableId id) const override {
    return "($ " + names().variable(id) + ")";
  }
  std::string value_of(VariableId, const std::string& number) const override {
    return "($ (" + number + "))";
  }

  // Whether the automaton's location is kept in the states of its process.
  bool is_kept_in_states(AutomatonId id) const {
    return is_kept_in_states_[index(id)];
  }
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
  // How the process of a leaf is linked, or nothing.
  const std::optional<FiacreLink>& link(AutomatonId id) const {
    return links_.of[index(id)];
  }
  // The variables of the component: all but those.
  std::vector<VariableId> global() const;

 private:
  void find_users();
  void divide_variables();
  void name_states();

  const FiacreLinks& links_;
  std::vector<std::vector<std::uint32_t>> users_;  // automata, by VariableId
  std::vector<bool> is_kept_in_states_;            // by AutomatonId, like these
  std::vector<std::vector<VariableId>> own_;
  std::vector<std::vector<VariableId>> shared_;
  std::vector<std::vector<std::string>> states_;  // by location
};

// An identifier that is no keyword of Fiacre: `wait` becomes `wait_`.
std::string fiacre_identifier(std::string_view text);

// A port of the component: it carries the interval of the transitions that
// use it.
struct FiacrePort {
  std::string name;  // "" where there are no ports
  Interval when;
  bool goes_first = false;  // before every port that does not
};

// How the processes of a network keep time. Where a timer has to go before
// other steps each transition goes through a port, as only ports have
// priorities; elsewhere it says `wait [a,b]`, and there are no ports.
class FiacreTime {
 public:
  explicit FiacreTime(const FiacreLanguage& language);

  // For each transition of an edge its interval and port; a timer's edge with a
  // deadline beyond its lower bound has two, of which the second is its
  // deadline.
  std::vector<FiacrePort> firings(AutomatonId id, const Edge& edge) const;

  const std::vector<FiacrePort>& ports() const { return ports_; }
  // The names of those that a process uses, in their order.
  std::vector<std::string> ports_of(AutomatonId id) const;

 private:
  const FiacreLanguage& language_;
  bool has_ports_ = false;
  std::vector<FiacrePort> ports_;
};

// `[1,1]`, `[2,...[`.
std::string fiacre_interval(const Interval& when);

// The declaration of the process of an automaton.
std::string fiacre_process(const FiacreLanguage& language,
                           const FiacreTime& time, AutomatonId id);

}  // namespace btcheck
