// SPDX-License-Identifier: MIT
//
// Fiacre is the language that the paper translates to. Names are the paper's:
// processes are nodes, in its order, so drone/8 is the same process here and
// there; states are start_, tick_node, success, …; caller and rstatus are
// shared by reference. What is preserved: a step of the network is one
// transition, atomic, with the same guard, updates and interval; due timers go
// first. What is Fiacre's own: time is dense (bounds are closed and whole, so
// the same markings are reached, and LTL without X and `within [0,b]` agree);
// there are no idle steps (where nothing can happen any more selt stutters, but
// it sees no run on which free variables rest for ever while they could move,
// and knows no built-in justice); after a fault nothing moves.
#include "model/export/fiacre/fiacre.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string_view>
#include <utility>

#include "model/export/fiacre/process.hpp"
#include "model/export/layout.hpp"
#include "model/export/steps.hpp"

namespace btcheck {
namespace {

constexpr std::size_t kLongestClaim = 200'000;  // characters

// A property of Fiacre looks into one process at a time: at its state, or at an
// expression over the variables it sees. So a condition is taken apart down to
// its comparisons, each is asked of a process that sees what it reads, and
// and, or, not join them again, as in the paper's properties.
//
// A part of it: written already, or still an expression.
struct ClaimPart {
  Expression expression;
  std::optional<std::string> told;
};

// The condition in terms of `COMPONENT/k/state S` and `COMPONENT/k/value (E)`,
// k being a process's number. Nothing when a comparison reads variables that no
// single process sees, or calculates with what is kept in states.
class Observer {
 public:
  Observer(const FiacreLanguage& language, std::string_view component)
      : language_(language),
        network_(language.network()),
        component_(component) {}

  std::optional<std::string> run(const Expression& condition) {
    if (condition.is_true()) return constant(true);
    for (const Term& term : condition.terms()) {
      auto made = next(term);
      if (!made || (made->told && made->told->size() > kLongestClaim))
        return {};
      stack_.push_back(std::move(*made));
    }
    return told(stack_.back());
  }

 private:
  std::optional<ClaimPart> next(const Term& term) {
    switch (arity(term.operation)) {
      case 0:
        return ClaimPart{term.operation == Operation::Constant
                             ? Expression::constant(term.operand)
                             : Expression::variable(term.operand),
                         {}};
      case 1:
        return unary(term.operation, pop());
      default: {
        ClaimPart right = pop();
        ClaimPart left = pop();
        return binary(term.operation, std::move(left), std::move(right));
      }
    }
  }

  ClaimPart pop() {
    ClaimPart top = std::move(stack_.back());
    stack_.pop_back();
    return top;
  }

  std::optional<ClaimPart> unary(Operation operation, ClaimPart of) const {
    if (operation == Operation::Not) {
      const auto inner = told(of);
      if (!inner) return std::nullopt;
      return ClaimPart{{}, "not (" + *inner + ")"};
    }
    if (of.told) return std::nullopt;
    return ClaimPart{Expression::unary(operation, std::move(of.expression)),
                     {}};
  }

  std::optional<ClaimPart> binary(Operation operation, ClaimPart left,
                                  ClaimPart right) const {
    if (operation == Operation::And || operation == Operation::Or) {
      return joined(operation == Operation::And ? "and" : "or", left, right);
    }
    if (is_equality(operation) && (left.told || right.told)) {
      return equivalent(operation, left, right);
    }
    if (left.told || right.told) return std::nullopt;
    if (!is_comparison(operation)) {
      return ClaimPart{Expression::binary(operation, std::move(left.expression),
                                          std::move(right.expression)),
                       {}};
    }
    auto observed = compared(operation, left.expression, right.expression);
    if (!observed) return std::nullopt;
    return ClaimPart{{}, std::move(observed)};
  }

  std::optional<ClaimPart> joined(std::string_view word, const ClaimPart& left,
                                  const ClaimPart& right) const {
    const auto a = told(left);
    const auto b = told(right);
    if (!a || !b) return std::nullopt;
    return ClaimPart{{}, fmt::format("({}) {} ({})", *a, word, *b)};
  }

  // Among observations there are no constants: any process sees one.
  std::string constant(bool value) const {
    return fmt::format("{}/1/value ({})", component_, value);
  }

  // Truth beside truth, or beside a number that it may be equal to.
  std::optional<ClaimPart> equivalent(Operation operation,
                                      const ClaimPart& left,
                                      const ClaimPart& right) const {
    for (const ClaimPart* side : {&left, &right}) {
      if (side->told) continue;
      const auto number = side->expression.only(Operation::Constant);
      if (!number) return std::nullopt;
      if (*number == 0 || *number == 1) continue;
      return ClaimPart{{}, constant(operation != Operation::Equal)};
    }
    const auto a = told(left);
    const auto b = told(right);
    if (!a || !b) return std::nullopt;
    const std::string_view beside = operation == Operation::Equal ? "" : "not ";
    const std::string_view otherwise =
        operation == Operation::Equal ? "not " : "";
    return ClaimPart{
        {},
        fmt::format("(({0}) and {2}({1})) or (not ({0}) and {3}({1}))", *a, *b,
                    beside, otherwise)};
  }

  // A part as a truth value.
  std::optional<std::string> told(const ClaimPart& part) const {
    if (part.told) return part.told;
    if (const auto value = part.expression.only(Operation::Constant)) {
      return constant(*value != 0);
    }
    return compared(Operation::NotEqual, part.expression,
                    Expression::constant(0));
  }

  std::optional<std::string> compared(Operation operation,
                                      const Expression& left,
                                      const Expression& right) const {
    for (const bool is_left : {true, false}) {
      const auto owner = kept_location(is_left ? left : right);
      const auto value = (is_left ? right : left).only(Operation::Constant);
      if (!owner || !value) continue;
      return in_states(*owner, [&](int at) {
        return is_left ? apply(operation, at, *value)
                       : apply(operation, *value, at);
      });
    }
    return seen(Expression::binary(operation, left, right));
  }

  // The automaton whose location, kept in its states, is all of this.
  std::optional<AutomatonId> kept_location(const Expression& side) const {
    const auto variable = side.only(Operation::Variable);
    if (!variable) return std::nullopt;
    for (std::uint32_t a = 0; a < network_.automata.size(); ++a) {
      if (language_.is_kept_in_states(AutomatonId{a}) &&
          index(network_.automata[a].location) ==
              static_cast<std::uint32_t>(*variable)) {
        return AutomatonId{a};
      }
    }
    return std::nullopt;
  }

  // The location is one of those with such a value.
  template <class Holds>
  std::string in_states(AutomatonId id, Holds holds) const {
    const Automaton& automaton = network_.automaton(id);
    std::string text;
    std::size_t count = 0;
    for (std::uint32_t i = 0; i < automaton.locations.size(); ++i) {
      const LocationId location{i};
      if (!holds(location_value(network_, automaton, location))) continue;
      append(text, " or ",
             fmt::format("{}/{}/state {}", component_, index(id) + 1,
                         language_.state(id, location)));
      ++count;
    }
    const bool is_constant = count == 0 || count == automaton.locations.size();
    return is_constant ? constant(count != 0) : text;
  }

  // The comparison, asked of the first process that sees all it reads.
  std::optional<std::string> seen(const Expression& comparison) const {
    for (std::uint32_t a = 0; a < network_.automata.size(); ++a) {
      const AutomatonId id{a};
      const auto sees = [&](const Term& term) {
        if (term.operation != Operation::Variable) return true;
        const VariableId read{static_cast<std::uint32_t>(term.operand)};
        const auto& own = language_.own(id);
        const auto& shared = language_.shared(id);
        return std::ranges::find(own, read) != own.end() ||
               std::ranges::find(shared, read) != shared.end();
      };
      if (!std::ranges::all_of(comparison.terms(), sees)) continue;
      return fmt::format("{}/{}/value ({})", component_, a + 1,
                         language_.condition(comparison));
    }
    return std::nullopt;
  }

  const FiacreLanguage& language_;
  const Network& network_;
  std::string_view component_;
  std::vector<ClaimPart> stack_;
};

class Program {
 public:
  Program(const BehaviorTree& tree, const Network& network, FiacreLinks links)
      : tree_(tree),
        network_(network),
        names_(network),
        links_(std::move(links)),
        language_(network, names_, links_),
        time_(language_),
        component_(fiacre_identifier(tree.node(tree.roots[0]).name)) {}

  Result<std::string> text(const std::vector<ExportClaim>& claims) const {
    Result<std::string> result;
    result.diagnostics = language_.refusals(tree_, claims);
    if (!result.diagnostics.empty()) return result;
    std::string text = model_heading(tree_, network_.ticks, "/* ", " * ") +
                       " */\n\n" + types() + links_.declarations;
    for (std::uint32_t a = 0; a < network_.automata.size(); ++a) {
      text += fiacre_process(language_, time_, AutomatonId{a});
    }
    text += component() + "\n" + component_ + "\n";
    for (const ExportClaim& claim : claims) {
      text += property(claim, result.diagnostics);
    }
    result.value = std::move(text);
    return result;
  }

 private:
  static std::string type_text(const std::string& type, int min,
                               const std::vector<ExportNames::Constant>& of) {
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
      append(
          text, ",\n  ",
          fmt::format("{} : {} := {}", names_.variable(id), language_.type(id),
                      names_.value(id, network_.variable(id).initial)));
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
      append(shared, ", ", "&" + names_.variable(variable));
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

  std::string property(const ExportClaim& claim,
                       std::vector<Diagnostic>& findings) const {
    std::vector<std::string> observed;
    for (const Expression& proposition : claim.propositions) {
      auto text = Observer(language_, component_).run(proposition);
      if (!text) return left_out(claim, findings);
      observed.push_back("(" + std::move(*text) + ")");
    }
    const std::string formula = with_propositions(
        claim.formula,
        [&](std::size_t proposition) { return observed.at(proposition); });
    return "\n" + remark_lines(claim.remarks, "/* ", " */") +
           fmt::format("property {0} is {1}\nassert {0}\n", claim.name,
                       filled(formula, 2, "", {" and ", " or "}));
  }

  std::string left_out(const ExportClaim& claim,
                       std::vector<Diagnostic>& findings) const {
    const std::string message = fmt::format(
        "`{}` is not exported: it compares what no process of Fiacre sees "
        "together",
        claim.name);
    findings.push_back(
        SourceText(tree_.file, "")
            .diagnostic(Severity::Warning, "BT0006", {}, message));
    return "\n/* " + comment_text(message) + " */\n";
  }

  const BehaviorTree& tree_;
  const Network& network_;
  ExportNames names_;
  FiacreLinks links_;
  FiacreLanguage language_;
  FiacreTime time_;
  std::string component_;
};

}  // namespace

Result<std::string> fiacre_text(const BehaviorTree& tree,
                                const Network& network,
                                const std::vector<ExportClaim>& claims) {
  FiacreLinks none;
  none.of.resize(network.automata.size());
  return Program(tree, network, std::move(none)).text(claims);
}

Result<std::string> hfiacre_text(const BehaviorTree& tree,
                                 const Network& network) {
  return Program(tree, network, fiacre_links(tree, network)).text({});
}

}  // namespace btcheck
