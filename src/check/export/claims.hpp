// SPDX-License-Identifier: MIT
//
// Bound properties as claims of exported models.
#pragma once

#include <string>
#include <vector>

#include "check/bind/bound_property.hpp"
#include "model/export/fiacre/fiacre.hpp"
#include "model/export/promela/promela.hpp"
#include "model/export/smv/smv.hpp"
#include "text/diagnostic.hpp"

namespace btcheck {

// What LTSmin is asked. An invariant is said of each state, anything else of
// runs; over p0, p1, …, which stand for propositions[0], … of states and steps.
struct LtsminClaim {
  std::string name;
  std::string formula;
  std::vector<Proposition> propositions = {};
  bool is_invariant = false;
  std::vector<std::string> remarks = {};  // for its reader, a line each
};

template <class Claim>
struct ExportedClaims {
  std::vector<Claim> claims;
  // A warning with the reason for each property that the language cannot say or
  // its compiler cannot read.
  std::vector<Diagnostic> left_out;
};

// Every property of a file as the language says it, under the assumptions of
// the file. `source` is the text of the file. What is asked of single states
// becomes a claim of that form where there is one; `possible P` becomes the
// claim that P never holds, with a remark, where only runs can be asked about.
//
// Promela: LTL without X and events of steps. SMV: everything but real time,
// and CTL under assumptions. Fiacre: LTL as Promela, and the real-time patterns
// that its compiler frac 2.3.0 has; real time not under assumptions. LTSmin:
// all of LTL, with at most 30 propositions.
ExportedClaims<ExportClaim> promela_claims(const BoundFile& bound,
                                           const SourceText& source);
ExportedClaims<LtsminClaim> ltsmin_claims(const BoundFile& bound,
                                          const SourceText& source);
ExportedClaims<SmvClaim> smv_claims(const BoundFile& bound,
                                    const SourceText& source);
ExportedClaims<ExportClaim> fiacre_claims(const BoundFile& bound,
                                          const SourceText& source);

}  // namespace btcheck
