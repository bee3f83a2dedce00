// SPDX-License-Identifier: MIT
//
// (defaction …) and (defcondition …): what the leaves of a name may answer, and
// what that changes.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "model/btf/expression.hpp"
#include "model/btf/forms.hpp"
#include "model/tree/tree.hpp"

namespace btcheck::btf {

// One contract as written. Its expressions are read for each leaf anew, as a
// node's name means another node in another subtree.
struct ContractDraft {
  std::string name;  // in a side file: one with wildcards, without quotes
  FormId form{};
  SourceSpan span;       // of the name
  LeafContract results;  // only what it may answer
  bool has_returns = false;
  std::optional<LeafMemory> memory;  // :answers
  std::optional<Duration> duration;
  std::optional<FormId> requirement;
  std::optional<FormId> decision;  // :succeeds-when
  LeafMeaning meaning;
  std::vector<FormId> on_success;
  std::vector<FormId> on_failure;
  bool is_used = false;

  // It changes what the leaf may do; else it only says what that means.
  bool has_behavior() const;
};

// Where a contract stands. One in a file beside an XML tree can also say that a
// leaf answers skipped, and whether an answer stands (:answers).
enum class ContractPlace : std::uint8_t { Tree, SideFile };

// Reads one form for leaves of the type, Action or Condition; nothing when it
// does not even have a name.
std::optional<ContractDraft> read_contract_draft(const Reading& reading,
                                                 FormId form, NodeType leaf,
                                                 ContractPlace place);

class Contracts {
 public:
  // Reads one form for leaves of the type, Action or Condition.
  void declare(const Reading& reading, FormId form, NodeType leaf);

  // Gives a leaf the contract of its :ID (its name when it has none).
  void apply(const Scope& scope, Node& leaf);

  // Reports contracts that no leaf has, and checks what they say.
  void report_unused(const Scope& scope);

 private:
  using Key = std::pair<NodeType, std::string>;

  std::map<Key, ContractDraft> by_leaf_;
  std::size_t words_ = 0;
};

}  // namespace btcheck::btf
