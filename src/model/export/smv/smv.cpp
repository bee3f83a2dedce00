// SPDX-License-Identifier: MIT
//
// The network as a model for NuSMV (Cimatti et al., CAV 2002) and nuXmv.
//
// One module over global variables: locations, callers and statuses are
// enumerations with names, clocks are bounded integers. The steps stand in
// steps.cpp. A claim about single states becomes an INVARSPEC, one in LTL an
// LTLSPEC, one in CTL a CTLSPEC. SMV looks at infinite runs only, which hides
// nothing here: no run ends.
#include "model/export/smv/smv.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <utility>

#include "model/export/layout.hpp"
#include "model/export/names.hpp"
#include "model/export/smv/steps.hpp"
#include "model/export/steps.hpp"

namespace btcheck {
namespace {

class Module {
 public:
  Module(const BehaviorTree& tree, const Network& network)
      : tree_(tree),
        network_(network),
        names_(network),
        language_(network, names_) {}

  Result<std::string> text(const std::vector<SmvClaim>& claims) const {
    Result<std::string> result;
    result.diagnostics = refusals(claims);
    if (!result.diagnostics.empty()) return result;
    const Progress progress = progress_of(claims);
    result.value = model_heading(tree_, network_.ticks, "-- ", "-- ") +
                   "MODULE main\n" + variables(progress) +
                   initial_values(progress) + smv_steps(language_, progress) +
                   claims_text(claims, progress);
    return result;
  }

 private:
  std::vector<Diagnostic> refusals(const std::vector<SmvClaim>& claims) const {
    std::vector<ExportClaim> asked;
    for (const SmvClaim& claim : claims) {
      std::vector<Expression>& conditions =
          asked.emplace_back(ExportClaim{claim.name, {}, {}}).propositions;
      for (const SmvProposition& proposition : claim.propositions) {
        conditions.push_back(proposition.condition);
        if (!proposition.when_dead) continue;
        conditions.push_back(*proposition.when_dead);
      }
    }
    return language_.refusals(tree_, asked);
  }

  Progress progress_of(const std::vector<SmvClaim>& claims) const {
    const bool asks_runs =
        std::ranges::any_of(claims, [](const SmvClaim& claim) {
          return claim.kind != SmvClaim::Kind::Invariant;
        });
    return asks_runs && has_free_moves(network_) ? Progress::Told
                                                 : Progress::Untold;
  }

  std::string type_of(VariableId id) const {
    const Variable& variable = network_.variable(id);
    if (!language_.is_enumeration(id)) {
      return fmt::format("{}..{}", variable.min, variable.max);
    }
    std::string values;
    for (int value = variable.min; value <= variable.max; ++value) {
      append(values, ", ", names_.value(id, value));
    }
    return "{" + filled(values, 4, "", {", "}) + "}";
  }

  std::string variable_text(VariableId id) const {
    return fmt::format("  {} : {};\n", names_.variable(id), type_of(id));
  }

  std::string variables(Progress progress) const {
    std::string text = "\nVAR\n";
    for (const VariableId id : network_.state_variable) {
      text += fmt::format("  -- state variable {}\n",
                          comment_text(network_.variable(id).name)) +
              variable_text(id);
    }
    for (std::uint32_t a = 0; a < network_.automata.size(); ++a) {
      const Automaton& automaton = network_.automata[a];
      const int bound = greatest_clock_bound(automaton);
      if (!moves_freely(automaton)) {
        text += fmt::format("  -- process {}: {}\n", a + 1,
                            comment_text(automaton.name));
      }
      for (const VariableId id : declared_variables(network_, automaton)) {
        text += variable_text(id);
      }
      if (bound == 0) continue;
      text +=
          fmt::format("  {} : 0..{};\n", names_.clock(AutomatonId{a}), bound);
    }
    if (network_.fault) {
      text += "  -- an assignment has left its range\n" +
              variable_text(*network_.fault);
    }
    if (progress == Progress::Told) {
      text +=
          "  -- the last step was not the move of a free variable\n"
          "  progress : boolean;\n";
    }
    return text;
  }

  std::string initial_values(Progress progress) const {
    std::string text = "\nINIT\n";
    std::string_view joint = "  ";
    for (std::uint32_t v = 0; v < network_.variables.size(); ++v) {
      const VariableId id{v};
      text += fmt::format("{}{} = {}", joint, names_.variable(id),
                          names_.value(id, network_.variable(id).initial));
      joint = " &\n  ";
    }
    for (std::uint32_t a = 0; a < network_.automata.size(); ++a) {
      if (greatest_clock_bound(network_.automata[a]) == 0) continue;
      text += fmt::format("{}{} = 0", joint, names_.clock(AutomatonId{a}));
    }
    if (progress == Progress::Told) text += " &\n  progress";
    return text + ";\n";
  }

  // --- what is to be checked ---

  std::string proposition_text(const SmvProposition& proposition) const {
    if (proposition.kind == SmvProposition::Kind::Passes) {
      return fmt::format("step = {}", kSmvTimeStep);
    }
    if (proposition.kind == SmvProposition::Kind::Moves) {
      return smv_step_by(network_, proposition.movers);
    }
    const std::string alive = language_.condition(proposition.condition);
    if (!proposition.when_dead) return alive;
    return fmt::format("(is_dead ? {} : {})",
                       language_.condition(*proposition.when_dead), alive);
  }

  std::string claim_text(const SmvClaim& claim) const {
    const auto name = [&](std::size_t proposition) {
      return fmt::format("{}_p{}", claim.name, proposition);
    };
    std::string text = "\n" + remark_lines(claim.remarks, "-- ", "");
    if (!claim.propositions.empty()) text += "DEFINE\n";
    for (std::size_t i = 0; i < claim.propositions.size(); ++i) {
      text += fmt::format("  {} := {};\n", name(i),
                          filled(proposition_text(claim.propositions[i]), 4, "",
                                 {", ", " & ", " | "}));
    }
    return text + fmt::format("{} NAME {} := {};\n", keyword(claim.kind),
                              claim.name,
                              with_propositions(claim.formula, name));
  }

  static std::string_view keyword(SmvClaim::Kind kind) {
    switch (kind) {
      case SmvClaim::Kind::Linear:
        return "LTLSPEC";
      case SmvClaim::Kind::Branching:
        return "CTLSPEC";
      default:
        return "INVARSPEC";
    }
  }

  std::string claims_text(const std::vector<SmvClaim>& claims,
                          Progress progress) const {
    std::string texts;
    bool asks_death = false;
    for (const SmvClaim& claim : claims) {
      for (const SmvProposition& proposition : claim.propositions) {
        asks_death |= proposition.when_dead.has_value();
      }
      texts += claim_text(claim);
    }
    return (asks_death ? "\nDEFINE\n" + smv_death(language_) : "") +
           (progress == Progress::Told ? "\nJUSTICE progress;\n" : "") + texts;
  }

  const BehaviorTree& tree_;
  const Network& network_;
  ExportNames names_;
  SmvLanguage language_;
};

}  // namespace

Result<std::string> smv_text(const BehaviorTree& tree, const Network& network,
                             const std::vector<SmvClaim>& claims) {
  return Module(tree, network).text(claims);
}

}  // namespace btcheck
