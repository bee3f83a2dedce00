// SPDX-License-Identifier: MIT
//
// The network as a model for SPIN (Holzmann, "The SPIN Model Checker", 2004).
//
// One process with one loop and global variables. A process for each automaton
// would read better, but each would add the places in its own text to the
// state; so its locations are values of a variable, with names. No run ends:
// idle steps are written out, and no verdict hangs on how SPIN extends finite
// runs. The steps stand in promela_process.cpp.
#include "model/export/promela.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <string_view>
#include <utility>

#include "model/export/promela_expression.hpp"
#include "model/export/promela_names.hpp"
#include "model/export/promela_process.hpp"

namespace btcheck {
namespace {

std::string tree_text(const BehaviorTree& tree, TickSemantics ticks) {
  std::string text = fmt::format("/* {}, tick {}; made by btcheck\n *\n",
                                 comment_text(tree.file), tick_name(ticks));
  std::vector<std::size_t> depth(tree.nodes.size(), 0);
  for (std::uint32_t n = 0; n < tree.nodes.size(); ++n) {
    const Node& node = tree.nodes[n];
    if (!node.is_root()) depth[n] = depth[index(node.parent)] + 1;
    text += fmt::format(" * line {:<4}{:{}}{} {}\n", node.span.line, "",
                        1 + 2 * depth[n], type_name(node.type),
                        comment_text(unique_name(tree, NodeId{n})));
  }
  return text + " */\n\n";
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

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_of_name(char c) {
  return is_digit(c) || c == '_' || (c >= 'a' && c <= 'z') ||
         (c >= 'A' && c <= 'Z');
}

// The formula with the claim's own name before each p0, p1, …
std::string renamed(const PromelaClaim& claim) {
  std::string text;
  for (std::size_t i = 0; i < claim.formula.size(); ++i) {
    const char c = claim.formula[i];
    const bool begins = i == 0 || !is_of_name(claim.formula[i - 1]);
    if (c == 'p' && begins && i + 1 < claim.formula.size() &&
        is_digit(claim.formula[i + 1])) {
      text += claim.name + "_";
    }
    text += c;
  }
  return text;
}

std::string claim_text(const Network& network, const PromelaNames& names,
                       const PromelaClaim& claim, PromelaProgress progress) {
  std::string text = "\n";
  for (std::size_t i = 0; i < claim.propositions.size(); ++i) {
    text += promela_macro(
        fmt::format("{}_p{}", claim.name, i),
        promela_expression(network, names, claim.propositions[i]).text);
  }
  const std::string formula = renamed(claim);
  return text + (progress == PromelaProgress::Told
                     ? fmt::format("ltl {} {{ ([] (<> (progress == 1))) -> "
                                   "({}) }}\n",
                                   claim.name, formula)
                     : fmt::format("ltl {} {{ {} }}\n", claim.name, formula));
}

Diagnostic refusal(const BehaviorTree& tree, const Network& network,
                   const Expression& expression, std::string_view owner) {
  constexpr std::size_t kLongest = 100;
  std::string shown = expression_text(network, expression);
  if (shown.size() > kLongest) shown = shown.substr(0, kLongest) + "…";
  Diagnostic finding;
  finding.code = "BT0005";
  finding.message = fmt::format(
      "`{}`, in {}, may leave the 32 bits of Promela's int", shown, owner);
  finding.file = tree.file;
  finding.help = "give its variables smaller ranges";
  return finding;
}

std::string owner_text(const BehaviorTree& tree, const Automaton& automaton) {
  if (automaton.kind == AutomatonKind::StateVariable) {
    return fmt::format("`{}`", automaton.name);
  }
  return fmt::format("`{}` on line {}", automaton.name,
                     tree.node(automaton.node).span.line);
}

// The first expression of each automaton and claim that Promela cannot say.
std::vector<Diagnostic> refusals(const BehaviorTree& tree,
                                 const Network& network,
                                 const PromelaNames& names,
                                 const std::vector<PromelaClaim>& claims) {
  std::vector<Diagnostic> found;
  auto ask = [&](const std::vector<Expression>& expressions,
                 const std::string& owner) {
    for (const Expression& expression : expressions) {
      if (promela_expression(network, names, expression).is_exact) continue;
      found.push_back(refusal(tree, network, expression, owner));
      return;
    }
  };
  for (const Automaton& automaton : network.automata) {
    std::vector<Expression> expressions;
    for (const Edge& edge : automaton.edges) {
      expressions.push_back(edge.guard);
      for (const Assignment& update : edge.updates) {
        expressions.push_back(update.value);
      }
    }
    ask(expressions, owner_text(tree, automaton));
  }
  for (const PromelaClaim& claim : claims) {
    ask(claim.propositions, "`" + claim.name + "`");
  }
  return found;
}

PromelaProgress progress_of(const Network& network,
                            const std::vector<PromelaClaim>& claims) {
  const bool moves_freely =
      std::ranges::any_of(network.automata, [](const Automaton& automaton) {
        return automaton.kind == AutomatonKind::StateVariable &&
               !automaton.edges.empty();
      });
  return moves_freely && !claims.empty() ? PromelaProgress::Told
                                         : PromelaProgress::Untold;
}

}  // namespace

Result<std::string> promela_text(const BehaviorTree& tree,
                                 const Network& network,
                                 const std::vector<PromelaClaim>& claims) {
  const PromelaNames names(network);
  Result<std::string> result;
  result.diagnostics = refusals(tree, network, names, claims);
  if (!result.diagnostics.empty()) return result;
  const PromelaProgress progress = progress_of(network, claims);
  std::string text = tree_text(tree, network.ticks) +
                     declarations(network, names, progress) +
                     promela_process(network, names, progress);
  for (const PromelaClaim& claim : claims) {
    text += claim_text(network, names, claim, progress);
  }
  result.value = std::move(text);
  return result;
}

}  // namespace btcheck
