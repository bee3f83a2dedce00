// SPDX-License-Identifier: MIT
//
// What a beginning of a run says of a formula, by rewriting the formula: after
// each state it becomes what the rest of the run has to satisfy (Bacchus and
// Kabanza, 2000), and a textbook tableau says whether some rest does, and
// whether some rest does not. No automaton is made of the formula, and nothing
// of src/ltl is used.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace btcheck::reference {

// Formulas in negation normal form, each stored once.
class Obligations {
 public:
  using Id = std::uint32_t;
  using Atom = std::uint32_t;

  Obligations();
  Id yes() const { return 0; }
  Id no() const { return 1; }
  Id literal(Atom atom, bool is_positive);
  Id all(std::vector<Id> of);
  Id some(std::vector<Id> of);
  Id next(Id of);
  Id until(Id left, Id right);
  Id release(Id left, Id right);
  Id negation(Id of);

  Id eventually(Id of) { return until(yes(), of); }
  Id always(Id of) { return release(no(), of); }
  Id weak_until(Id left, Id right) {
    return release(right, some({left, right}));
  }
  Id implies(Id left, Id right) { return some({negation(left), right}); }

  // What the rest of a run has to satisfy: all formulas of one of the sets,
  // none of which holds another one.
  using Set = std::set<Id>;
  using Left = std::set<Set>;
  static Left begun(Id formula) { return {{formula}}; }
  // Behind a state with these atoms. Throws std::length_error where it would be
  // too large, as the next does.
  Left after(const Left& left, const std::vector<bool>& atoms) const;
  // Some infinite word does.
  bool is_satisfiable(const Left& left);

 private:
  enum class Kind : std::uint8_t {
    Yes,
    No,
    Literal,
    All,
    Some,
    Next,
    Until,
    Release
  };
  struct Node {
    Kind kind = Kind::Yes;
    Atom atom = 0;
    bool is_positive = false;
    std::vector<Id> of;  // ascending, of All and Some

    auto operator<=>(const Node&) const = default;
  };
  Id stored(Node node);
  Id joined(Kind kind, std::vector<Id> of);
  using Known = std::map<Id, Left>;
  const Left& after(Id formula, const std::vector<bool>& atoms,
                    Known& known) const;
  bool is_satisfiable(const Set& of);

  // A branch of what must hold now: what is then to hold from the next state
  // on, and which untils have been put off.
  struct Branch {
    Set next;
    Set put_off;

    auto operator<=>(const Branch&) const = default;
  };
  void branch(std::vector<Id> todo, Set done, Branch made,
              std::set<Branch>& found);

  std::vector<Node> nodes_;
  std::map<Node, Id> numbers_;
  std::map<Id, Id> negations_;
  std::map<Set, bool> satisfiable_;
  std::size_t branches_ = 0;
};

}  // namespace btcheck::reference
