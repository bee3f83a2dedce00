// SPDX-License-Identifier: MIT
//
// (defsv …): the declarations of state variables.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "model/btf/forms.hpp"
#include "model/tree/tree.hpp"

namespace btcheck::btf {

struct Declared {
  StateVariable variable;
  // The states of an enumeration by their keys.
  std::map<std::string, int, std::less<>> states;
  // Its declaration has an error in it: its values are not known, and nothing
  // should be said about them.
  bool is_broken = false;
};

// The declared variables, in order, and where to find them by name.
class Variables {
 public:
  // Reads one (defsv …). Of two variables of one name the first counts.
  void declare(const Reading& reading, FormId form);

  // The variable named by a word, with or without `$`. A difference in case
  // is warned about, an unknown name an error.
  std::optional<StateVariableId> find(const Reading& reading,
                                      const Form& word) const;
  // The value of an enumeration that a word names, if it names one.
  std::optional<int> find_state(const Reading& reading,
                                StateVariableId variable,
                                const Form& word) const;
  // The same two questions without a word about case or unknown names.
  std::optional<StateVariableId> declared(const Form& word) const;
  std::optional<StateVariableId> declared(std::string_view word) const;
  bool has_state(StateVariableId variable, const Form& word) const;
  std::vector<std::string> names() const;

  bool is_broken(StateVariableId id) const { return all_[index(id)].is_broken; }
  const StateVariable& operator[](StateVariableId id) const {
    return all_[index(id)].variable;
  }
  std::vector<StateVariable> take();

 private:
  std::vector<Declared> all_;
  std::map<std::string, StateVariableId, std::less<>> by_name_;
  std::size_t transitions_ = 0;
};

// The error for a word that is none of a variable's states.
void report_unknown_state(const Reading& reading, const Form& word,
                          const StateVariable& variable);

}  // namespace btcheck::btf
