// SPDX-License-Identifier: MIT
//
// (defsv …): the declarations of state variables.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "model/btf/keywords.hpp"
#include "model/tree/tree.hpp"

namespace btcheck::btf {

// A word in lower case: two names are the same when their keys are.
std::string name_key(std::string_view word);

// The declared variables, in order, and where to find them by name.
class Variables {
 public:
  // Reads one (defsv …). Of two variables of one name the first counts.
  void declare(const Reading& reading, FormId form);

  // The variable named by a word, with or without `$`. A difference in case
  // is warned about; an unknown name is not an error here.
  std::optional<StateVariableId> find(const Reading& reading,
                                      const Form& word) const;
  // The value of an enumeration that a word names, likewise.
  std::optional<int> find_state(const Reading& reading,
                                StateVariableId variable,
                                const Form& word) const;
  // The same two questions without a word about case.
  std::optional<StateVariableId> declared(const Form& word) const;
  bool is_declared(const Form& word) const {
    return declared(word).has_value();
  }
  bool has_state(StateVariableId variable, const Form& word) const;
  // BT1012, with the nearest name.
  void report_unknown(const Reading& reading, const Form& word) const;

  // True when its declaration has an error in it, so that its values are not
  // known and nothing should be said about them.
  bool is_broken(StateVariableId id) const { return is_broken_[index(id)]; }

  const StateVariable& operator[](StateVariableId id) const {
    return declared_[index(id)];
  }
  std::vector<StateVariable> take() { return std::move(declared_); }

 private:
  std::vector<StateVariable> declared_;
  std::map<std::string, StateVariableId, std::less<>> by_name_;
  std::vector<std::map<std::string, int, std::less<>>> states_;
  std::vector<bool> is_broken_;
  std::size_t transitions_ = 0;
};

}  // namespace btcheck::btf
