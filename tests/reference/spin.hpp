// SPDX-License-Identifier: MIT
//
// SPIN, if it is installed, asked for its opinion.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "ltl/formula/formula.hpp"
#include "temporary_folder.hpp"

namespace btcheck::reference {

// Whether `spin` and `gcc` can be called.
bool spin_is_installed();

// A formula without X in SPIN's syntax, atom i being `pi`. a W b, on which
// versions of SPIN differ, is written b V (a || b).
std::string spin_text(const FormulaPool& pool, FormulaId id);

// What a verifier is made for.
enum class SpinUse { CountAndDecide, Count };

// The verifier that SPIN makes of one model, in a directory of its own.
class SpinVerifier {
 public:
  explicit SpinVerifier(const std::string& model,
                        SpinUse use = SpinUse::CountAndDecide);

  // What spin and gcc complained of; empty when there is nothing.
  const std::string& complaints() const { return complaints_; }
  // States stored and steps taken when no claim is checked. Nothing when pan
  // does not say that it has seen them all.
  struct Space {
    std::uint64_t states = 0;
    std::uint64_t transitions = 0;
  };
  std::optional<Space> space() const;
  // Whether the claim with this name holds on every run.
  std::optional<bool> holds(const std::string& claim) const;

 private:
  std::string called(const std::string& command) const;

  TemporaryFolder folder_;
  std::string complaints_;
};

}  // namespace btcheck::reference
