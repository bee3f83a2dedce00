// SPDX-License-Identifier: MIT
//
// The network as a model in Fiacre, the language that the paper translates to.
//
// Names are the paper's: processes are nodes, in its order, so drone/8 is the
// same process here and there; states are start_, tick_node, success, …;
// caller and rstatus are shared by reference. What is preserved: a step of the
// network is one transition, atomic, with the same guard, updates and interval;
// due timers go first. What is Fiacre's own: time is dense (bounds are closed
// and whole, so the same markings are reached, and LTL without X and `within
// [0,b]` agree); there are no idle steps (where nothing can happen any more
// selt stutters, but it sees no run on which free variables rest for ever while
// they could move, and knows no built-in justice); after a fault nothing moves.
#include "model/export/fiacre/fiacre.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string_view>
#include <utility>

#include "model/export/exact_arithmetic.hpp"
#include "model/export/fiacre/language.hpp"
#include "model/export/fiacre/observation.hpp"
#include "model/export/fiacre/process.hpp"
#include "model/export/filled_lines.hpp"
#include "model/export/formula_pattern.hpp"
#include "model/export/tree_comment.hpp"

namespace btcheck {
namespace {

class Program {
 public:
  Program(const BehaviorTree& tree, const Network& network)
      : tree_(tree),
        network_(network),
        names_(network),
        language_(network, names_),
        time_(language_),
        component_(fiacre_identifier(tree.node(tree.roots[0]).name)) {}

  Result<std::string> text(const std::vector<FiacreClaim>& claims) const {
    Result<std::string> result;
    result.diagnostics = refusals(claims);
    if (!result.diagnostics.empty()) return result;
    std::string text = heading() + types();
    for (std::uint32_t a = 0; a < network_.automata.size(); ++a) {
      text += fiacre_process(language_, time_, AutomatonId{a});
    }
    text += component() + "\n" + component_ + "\n";
    for (const FiacreClaim& claim : claims) {
      text += property(claim, result.diagnostics);
    }
    result.value = std::move(text);
    return result;
  }

 private:
  std::vector<Diagnostic> refusals(
      const std::vector<FiacreClaim>& claims) const {
    std::vector<NamedPredicates> asked;
    for (const FiacreClaim& claim : claims) {
      asked.push_back({claim.name, claim.propositions});
    }
    return inexpressible(
        tree_, network_, asked,
        [&](const Expression& expression) {
          return typed_condition(network_, language_, expression).is_exact;
        },
        "Fiacre");
  }

  std::string heading() const {
    return fmt::format("/* {}, tick {}; made by btcheck\n *\n{} */\n\n",
                       comment_text(tree_.file), tick_name(network_.ticks),
                       tree_lines(tree_, " * "));
  }

  static std::string type_text(const std::string& type, int min,
                               const std::vector<PromelaNames::Constant>& of) {
    std::string text = fmt::format("type {} is {}..{}\n", type, min,
                                   min + static_cast<int>(of.size()) - 1);
    for (const auto& constant : of) {
      text += fmt::format("const {} : {} is {}\n", constant.name, type,
                          constant.value);
    }
    return text;
  }

  std::string types() const {
    std::string text = "/* the values of every rstatus */\n" +
                       type_text("status", 0, names_.statuses());
    for (const VariableId id : language_.global()) {
      const auto constants = names_.constants(id);
      if (constants.empty()) continue;
      text +=
          fmt::format("\n/* {} */\n",
                      comment_text(qualified_name(network_, id))) +
          type_text(language_.type(id), network_.variable(id).min, constants);
    }
    return text;
  }

  std::string variables() const {
    std::string text;
    for (const VariableId id : language_.global()) {
      append(text, ",\n  ",
             fmt::format("{} : {} := {}", language_.variable(id),
                         language_.type(id),
                         language_.value(id, network_.variable(id).initial)));
    }
    return text.empty() ? text : "var\n  " + text + "\n";
  }

  std::string ports() const {
    std::string declared;
    std::string first;
    std::string others;
    for (const FiacrePort& port : time_.ports()) {
      append(declared, ",\n  ", port.name + " : sync");
      if (port.when != kAnyTime) {
        declared += " in " + fiacre_interval(port.when);
      }
      append(port.goes_first ? first : others, " | ", port.name);
    }
    if (declared.empty()) return {};
    std::string text = "port\n  " + declared + "\n";
    if (first.empty() || others.empty()) return text;
    return text + "priority\n  " +
           filled(first + " > " + others, 4, "", {" | ", " > "}) + "\n";
  }

  std::string instance(AutomatonId id) const {
    std::string text = names_.process(id);
    std::string used;
    for (const std::string& port : time_.ports_of(id)) {
      append(used, ", ", port);
    }
    if (!used.empty()) text += " [" + used + "]";
    std::string shared;
    for (const VariableId variable : language_.shared(id)) {
      append(shared, ", ", "&" + language_.variable(variable));
    }
    if (!shared.empty()) text += " (" + shared + ")";
    return filled(text, 5, "", {", "});
  }

  std::string component() const {
    std::string text = fmt::format("\ncomponent {} is\n", component_) +
                       variables() + ports() + "par\n";
    for (std::uint32_t a = 0; a < network_.automata.size(); ++a) {
      text += (a == 0 ? "   " : "|| ") + instance(AutomatonId{a}) + "\n";
    }
    return text + "end\n";
  }

  // --- properties ---

  std::string property(const FiacreClaim& claim,
                       std::vector<Diagnostic>& findings) const {
    std::vector<std::string> observed;
    for (const Expression& proposition : claim.propositions) {
      auto text = fiacre_observation(language_, component_, proposition);
      if (!text) return left_out(claim, findings);
      observed.push_back("(" + std::move(*text) + ")");
    }
    const std::string formula = with_propositions(
        claim.formula,
        [&](std::size_t proposition) { return observed.at(proposition); });
    std::string text = "\n";
    for (const std::string& remark : claim.remarks) {
      text += "/* " + comment_text(remark) + " */\n";
    }
    return text + fmt::format("property {0} is {1}\nassert {0}\n", claim.name,
                              filled(formula, 2, "", {" and ", " or "}));
  }

  std::string left_out(const FiacreClaim& claim,
                       std::vector<Diagnostic>& findings) const {
    const std::string message = fmt::format(
        "`{}` is not exported: it compares what no process of Fiacre sees "
        "together",
        claim.name);
    Diagnostic finding;
    finding.severity = Severity::Warning;
    finding.code = "BT0006";
    finding.message = message;
    finding.file = tree_.file;
    findings.push_back(std::move(finding));
    return "\n/* " + comment_text(message) + " */\n";
  }

  const BehaviorTree& tree_;
  const Network& network_;
  PromelaNames names_;
  FiacreLanguage language_;
  FiacreTime time_;
  std::string component_;
};

}  // namespace

Result<std::string> fiacre_text(const BehaviorTree& tree,
                                const Network& network,
                                const std::vector<FiacreClaim>& claims) {
  return Program(tree, network).text(claims);
}

}  // namespace btcheck
