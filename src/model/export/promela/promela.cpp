// SPDX-License-Identifier: MIT
//
// The network as a model for SPIN (Holzmann, "The SPIN Model Checker", 2004).
//
// One process with one loop and global variables. A process for each automaton
// would read better, but each would add the places in its own text to the
// state; so its locations are values of a variable, with names. No run ends:
// idle steps are written out, and no verdict hangs on how SPIN extends finite
// runs. The steps stand in promela_process.cpp.
#include "model/export/promela/promela.hpp"

#include <fmt/format.h>

#include <string_view>
#include <utility>

#include "model/export/clock_bound.hpp"
#include "model/export/exact_arithmetic.hpp"
#include "model/export/formula_pattern.hpp"
#include "model/export/promela/expression.hpp"
#include "model/export/promela/names.hpp"
#include "model/export/promela/process.hpp"
#include "model/export/tree_comment.hpp"

namespace btcheck {
namespace {

std::string heading(const BehaviorTree& tree, TickSemantics ticks) {
  return fmt::format("/* {}, tick {}; made by btcheck\n *\n{} */\n\n",
                     comment_text(tree.file), tick_name(ticks),
                     tree_lines(tree, " * "));
}

std::string_view type_for(std::int64_t min, std::int64_t max) {
  if (min >= 0 && max <= 1) return "bit";
  if (min >= 0 && max <= 255) return "byte";
  return min >= -32768 && max <= 32767 ? "short" : "int";
}

std::string constant_text(const PromelaNames::Constant& constant) {
  return fmt::format("#define {} {}\n", constant.name, constant.value);
}

std::string variable_text(const Network& network, const PromelaNames& names,
                          VariableId id) {
  std::string text;
  for (const auto& constant : names.constants(id)) {
    text += constant_text(constant);
  }
  const Variable& variable = network.variable(id);
  return text +
         fmt::format("{} {} = {};\n", type_for(variable.min, variable.max),
                     names.variable(id), names.value(id, variable.initial));
}

std::string automaton_text(const Network& network, const PromelaNames& names,
                           AutomatonId id) {
  const Automaton& automaton = network.automaton(id);
  std::string text;
  auto declare = [&](VariableId variable) {
    text += variable_text(network, names, variable);
  };
  if (automaton.kind != AutomatonKind::StateVariable) {
    text += fmt::format("\n/* process {}: {} */\n", index(id) + 1,
                        comment_text(automaton.name));
    declare(automaton.location);
  }
  if (automaton.gate) declare(*automaton.gate);
  if (automaton.kind == AutomatonKind::Node) {
    declare(network.node_status[index(automaton.node)]);
  }
  for (const VariableId local : automaton.locals) declare(local);
  const int bound = greatest_clock_bound(automaton);
  if (bound > 0) {
    text += fmt::format("{} {} = 0;\n", type_for(0, bound), names.clock(id));
  }
  return text;
}

std::string declarations(const Network& network, const PromelaNames& names,
                         PromelaProgress progress) {
  std::string text = "/* the values of every rstatus */\n";
  for (const auto& status : names.statuses()) text += constant_text(status);
  for (const VariableId id : network.state_variable) {
    text += fmt::format("\n/* state variable {} */\n",
                        comment_text(network.variable(id).name)) +
            variable_text(network, names, id);
  }
  for (std::uint32_t a = 0; a < network.automata.size(); ++a) {
    text += automaton_text(network, names, AutomatonId{a});
  }
  if (network.fault) {
    text += "\n/* an assignment has left its range */\n" +
            variable_text(network, names, *network.fault);
  }
  if (progress == PromelaProgress::Told) {
    text +=
        "\n/* the last step was not the move of a free variable */\n"
        "bit progress = 1;\n";
  }
  return text;
}

std::string claim_text(const Network& network, const PromelaNames& names,
                       const PromelaClaim& claim, PromelaProgress progress) {
  std::string text = "\n";
  for (const std::string& remark : claim.remarks) {
    text += "/* " + comment_text(remark) + " */\n";
  }
  for (std::size_t i = 0; i < claim.propositions.size(); ++i) {
    text += promela_macro(
        fmt::format("{}_p{}", claim.name, i),
        promela_expression(network, names, claim.propositions[i]).text);
  }
  const std::string formula =
      with_propositions(claim.formula, [&](std::size_t proposition) {
        return fmt::format("{}_p{}", claim.name, proposition);
      });
  return text + (progress == PromelaProgress::Told
                     ? fmt::format("ltl {} {{ ([] (<> (progress == 1))) -> "
                                   "({}) }}\n",
                                   claim.name, formula)
                     : fmt::format("ltl {} {{ {} }}\n", claim.name, formula));
}

PromelaProgress progress_of(const Network& network,
                            const std::vector<PromelaClaim>& claims) {
  return has_free_moves(network) && !claims.empty() ? PromelaProgress::Told
                                                    : PromelaProgress::Untold;
}

}  // namespace

Result<std::string> promela_text(const BehaviorTree& tree,
                                 const Network& network,
                                 const std::vector<PromelaClaim>& claims) {
  const PromelaNames names(network);
  Result<std::string> result;
  std::vector<NamedPredicates> asked;
  for (const PromelaClaim& claim : claims) {
    asked.push_back({claim.name, claim.propositions});
  }
  result.diagnostics = inexpressible(
      tree, network, asked,
      [&](const Expression& expression) {
        return promela_expression(network, names, expression).is_exact;
      },
      "Promela");
  if (!result.diagnostics.empty()) return result;
  const PromelaProgress progress = progress_of(network, claims);
  std::string text = heading(tree, network.ticks) +
                     declarations(network, names, progress) +
                     promela_process(network, names, progress);
  for (const PromelaClaim& claim : claims) {
    text += claim_text(network, names, claim, progress);
  }
  result.value = std::move(text);
  return result;
}

}  // namespace btcheck
