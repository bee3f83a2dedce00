// SPDX-License-Identifier: MIT
//
// The automata of a network as processes of Fiacre.
#pragma once

#include <string>
#include <vector>

#include "model/export/fiacre/language.hpp"

namespace btcheck {

// A port of the component: it carries the interval of the transitions that
// use it.
struct FiacrePort {
  std::string name;
  Interval when;
  bool goes_first = false;  // before every port that does not
};

// How the processes of a network keep time. Where a timer has to go before
// other steps each transition goes through a port, as only ports have
// priorities; elsewhere it says `wait [a,b]`, and there are no ports.
class FiacreTime {
 public:
  explicit FiacreTime(const FiacreLanguage& language);

  // One transition of an edge; a timer's edge with a deadline beyond its lower
  // bound has two, of which the second is its deadline.
  struct Firing {
    Interval when;
    std::string port;  // "" where there are no ports
  };
  std::vector<Firing> firings(AutomatonId id, const Edge& edge) const;

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
