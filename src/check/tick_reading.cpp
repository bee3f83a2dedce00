// SPDX-License-Identifier: MIT
//
// An answer is given in an instant, and a status is reset in mid-tick, so
// `never a.failure and b.failure` asks for two answers at one instant: hardly
// what is meant. Its reading asks for them in one tick. It is written as a
// text, which is then bound and searched like any other rule.
#include "check/tick_reading.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <string_view>
#include <utility>

#include "check/bind/node_names.hpp"
#include "check/rules_network.hpp"
#include "ltl/formula/formula.hpp"
#include "model/automata/tick_memory.hpp"

namespace btcheck {
namespace {

bool is_answer(std::string_view word) {
  return std::ranges::any_of(kAnswers, [&](const auto& answer) {
    return equal_ignoring_case(word, answer.second);
  });
}

// An atom said of whole ticks.
struct TickAtom {
  std::string text;
  std::optional<NodeId> node = {};  // whose answer it is
  bool is_event = false;            // as written, it holds for an instant
  bool is_final = false;            // of an answer that is no longer running
  std::string level = {};           // of an event: the status that lasts then
};
using MaybeAtom = std::optional<TickAtom>;

class AtomReader {
 public:
  explicit AtomReader(const BehaviorTree& tree) : tree_(tree), names_(tree) {}

  // Nothing where it has no meaning at the end of a tick.
  MaybeAtom read(const Atom& atom) const {
    switch (atom.kind) {
      case AtomKind::NodeEvent:
        return event(atom, atom.word);
      case AtomKind::ProcessState:
        return process_state(atom);
      case AtomKind::Comparison:
        return comparison(atom);
      case AtomKind::Range:
        return TickAtom{atom.text};
      default:
        return std::nullopt;
    }
  }

 private:
  std::optional<NodeId> node(const std::string& reference) const {
    if (equal_ignoring_case(reference, "root")) return tree_.roots[0];
    const std::vector<NodeId> called = names_.called(reference);
    if (called.size() != 1) return std::nullopt;
    return called[0];
  }

  std::optional<NodeId> node_of(const Atom& atom) const {
    if (!atom.process) return node(atom.node);
    return node(fmt::format("{}/{}", atom.component, *atom.process));
  }

  std::string reference(NodeId id) const {
    if (tree_.node(id).is_root()) return "root";
    const std::string quoted = names_.references_to({id});
    return quoted.substr(1, quoted.size() - 2);
  }

  TickAtom answered(NodeId id, std::string_view relation,
                    std::string_view word) const {
    return {fmt::format("{}.answer {} {}", reference(id), relation, word), id,
            false, is_answer(word) && !equal_ignoring_case(word, "running")};
  }

  MaybeAtom event(const Atom& atom, std::string_view word) const {
    const auto of = node_of(atom);
    if (!of) return std::nullopt;
    const bool is_root = tree_.node(*of).is_root();
    if (is_root && (word == "ended" || word == "active")) {
      return TickAtom{atom.text};
    }
    const bool is_called =
        !is_root && (word == "ticked" || word == "done" || word == "active");
    if (!is_called && !is_answer(word)) return std::nullopt;
    TickAtom read =
        is_called ? answered(*of, "!=", "none") : answered(*of, "==", word);
    // What the root answers in the end it goes on to answer.
    read.is_event = word != "active" && !is_root;
    if (read.is_event && equal_ignoring_case(word, "running")) {
      read.level = fmt::format("{}.status == running", reference(*of));
    }
    return read;
  }

  MaybeAtom process_state(const Atom& atom) const {
    if (!node_of(atom)) return TickAtom{atom.text};  // a state variable's
    if (equal_ignoring_case(atom.word, "tick_node")) {
      return event(atom, "ticked");
    }
    return event(atom, atom.word);
  }

  // `x.status == success`, also with its sides exchanged.
  MaybeAtom comparison(const Atom& atom) const {
    const auto has = [](const Operand& side, std::string_view name) {
      return !side.is_number && equal_ignoring_case(side.name, name);
    };
    if (has(atom.left, "answer") || has(atom.right, "answer")) {
      return std::nullopt;
    }
    const auto is_status = [&](const Operand& side) {
      const bool has_node = !side.node.empty() || atom.process;
      return has_node && (has(side, "status") || has(side, "rstatus"));
    };
    const bool is_left = is_status(atom.left);
    if (!is_left && !is_status(atom.right)) return TickAtom{atom.text};
    const Operand& status = is_left ? atom.left : atom.right;
    const Operand& word = is_left ? atom.right : atom.left;
    const auto of = status.node.empty() ? node_of(atom) : node(status.node);
    const bool is_equation =
        atom.relation == Relation::Equal || atom.relation == Relation::NotEqual;
    if (!of || !is_equation || !word.node.empty() || !is_answer(word.name)) {
      return std::nullopt;
    }
    return answered(*of,
                    atom.relation == Relation::Equal ? "==" : "!=", word.name);
  }

  const BehaviorTree& tree_;
  NodeNames names_;
};

// A part of a rule and whether it is negated there.
using Literal = std::pair<FormulaId, bool>;

// What must hold together for the part to be so; with `joining` Or: one of
// which must.
std::vector<Literal> joined(const FormulaPool& pool, Literal whole,
                            FormulaKind joining) {
  std::vector<Literal> parts;
  std::vector<Literal> waiting{whole};
  while (!waiting.empty()) {
    const auto [id, is_negated] = waiting.back();
    waiting.pop_back();
    const FormulaNode& node = pool[id];
    const bool is_and = joining == FormulaKind::And;
    const FormulaKind here =
        node.kind == FormulaKind::Implies ? FormulaKind::Or : node.kind;
    const FormulaKind seen = !is_negated                ? here
                             : here == FormulaKind::And ? FormulaKind::Or
                             : here == FormulaKind::Or  ? FormulaKind::And
                                                        : here;
    const bool splits = seen == (is_and ? FormulaKind::And : FormulaKind::Or);
    if (node.kind == FormulaKind::Not) {
      waiting.push_back({node.left, !is_negated});
    } else if (splits) {
      waiting.push_back({node.right, is_negated});
      const bool flips = node.kind == FormulaKind::Implies;
      waiting.push_back({node.left, is_negated != flips});
    } else {
      parts.push_back({id, is_negated});
    }
  }
  return parts;
}

// What a rule about single states forbids: the condition, and whether it is
// its negation.
std::optional<Literal> forbidden(const FormulaPool& pool,
                                 const Property& property) {
  FormulaId body = property.formula;
  if (property.form == PropertyForm::Never) return Literal{body, false};
  if (property.form != PropertyForm::Invariant) {
    const bool is_formula = property.form == PropertyForm::Ltl ||
                            property.form == PropertyForm::Branching;
    if (!is_formula) return std::nullopt;
    if (pool[body].kind == FormulaKind::ForAllPaths) body = pool[body].left;
    if (pool[body].kind != FormulaKind::Always) return std::nullopt;
    body = pool[body].left;
  }
  if (!pool.is_state_formula(body)) return std::nullopt;
  if (pool[body].kind == FormulaKind::Not) {
    return Literal{pool[body].left, false};
  }
  return Literal{body, true};
}

// Answers that one of the ways to break the rule has together.
void add_together(const PropertyFile& file, Literal whole,
                  const std::vector<TickAtom>& read, TickReading& reading) {
  for (const Literal& way : joined(file.formulas, whole, FormulaKind::Or)) {
    std::vector<std::string> texts[2];  // of levels, of events
    std::set<NodeId> nodes[2];
    for (const auto& [id, is_negated] :
         joined(file.formulas, way, FormulaKind::And)) {
      const FormulaNode& part = file.formulas[id];
      if (is_negated || part.kind != FormulaKind::Atom) continue;
      const TickAtom& atom = read[part.atom];
      if (!atom.node || (!atom.is_event && !atom.is_final)) continue;
      texts[atom.is_event].push_back(file.atoms[part.atom].text);
      nodes[atom.is_event].insert(*atom.node);
    }
    reading.are_events = nodes[1].size() > 1;
    if (reading.are_events || (nodes[1].empty() && nodes[0].size() > 1)) {
      reading.together = std::move(texts[reading.are_events]);
      return;
    }
  }
}

// The questions behind the advice for a rule, as a file of rules.
struct Questions {
  std::size_t verdict = 0;  // which rule it is
  TickReading reading;
  std::size_t first = 0;  // its reading; then what it forbids, and its parts
};

std::string text_of(const Questions& asked) {
  std::string text =
      fmt::format("property q{}: {}\n", asked.first, asked.reading.rule);
  if (asked.reading.together.empty()) return text;
  std::size_t number = asked.first;
  text += fmt::format("property q{}: never ({})\n", ++number,
                      fmt::join(asked.reading.together, ") and ("));
  for (const std::string& part : asked.reading.together) {
    text += fmt::format("property q{}: possible {}\n", ++number, part);
  }
  if (!asked.reading.of_levels.empty()) {
    text +=
        fmt::format("property q{}: {}\n", ++number, asked.reading.of_levels);
  }
  return text;
}

// Without the one of levels, which is the last.
std::size_t count_of_parts(const Questions& asked) {
  const std::size_t parts = asked.reading.together.size();
  return parts == 0 ? 1 : 2 + parts;
}
std::size_t count_of(const Questions& asked) {
  const bool has_levels =
      !asked.reading.together.empty() && !asked.reading.of_levels.empty();
  return count_of_parts(asked) + (has_levels ? 1 : 0);
}

// The verdicts of such a file; none where it says what cannot be asked.
std::vector<PropertyVerdict> answers(const BehaviorTree& tree,
                                     TickSemantics ticks,
                                     const std::string& text,
                                     SearchChoices choices,
                                     const Limits& limits) {
  choices.keeps_runs = false;
  const auto file = read_properties("", text);
  if (!file.value) return {};
  const auto made = network_for(tree, SourceText("", ""), *file.value,
                                SourceText("", text), ticks);
  if (!made.value) return {};
  const CompiledNetwork system(*made.value->network);
  auto verdicts = verify(system, made.value->bound, choices, limits).verdicts;
  for (PropertyVerdict& verdict : verdicts) verdict.property = nullptr;
  return verdicts;
}

}  // namespace

std::optional<TickReading> tick_reading(const BehaviorTree& tree,
                                        const PropertyFile& file,
                                        const Property& property) {
  if (tree.roots.size() != 1) return std::nullopt;
  const auto whole = forbidden(file.formulas, property);
  if (!whole) return std::nullopt;
  const AtomReader reader(tree);
  std::vector<TickAtom> read(file.atoms.size());
  std::set<NodeId> nodes;
  // An answer that must have been given, and perhaps has not been yet.
  bool is_demanded = false;
  const Polarity demanded =
      whole->second ? Polarity::Positive : Polarity::Negative;
  const auto stands = polarities(file.formulas, whole->first);
  for (const std::uint32_t number : file.formulas.atoms(whole->first)) {
    auto atom = reader.read(file.atoms[number]);
    if (!atom) return std::nullopt;
    if (atom->node) nodes.insert(*atom->node);
    for (const FormulaId part : file.formulas.nodes(whole->first)) {
      const FormulaNode& node = file.formulas[part];
      is_demanded |= atom->is_final && node.kind == FormulaKind::Atom &&
                     node.atom == number && stands[index(part)] == demanded;
    }
    read[number] = std::move(*atom);
  }
  if (nodes.size() < 2) return std::nullopt;
  TickReading reading;
  reading.rule =
      fmt::format("{} tick: {}", whole->second ? "every" : "in no",
                  file.formulas.text(whole->first, [&](std::uint32_t number) {
                    return read[number].text;
                  }));
  add_together(file, *whole, read, reading);
  const auto used = file.formulas.atoms(whole->first);
  const bool are_levels =
      reading.are_events && !whole->second &&
      std::ranges::all_of(used, [&](std::uint32_t number) {
        return !read[number].is_event || !read[number].level.empty();
      });
  if (are_levels) {
    reading.of_levels = fmt::format(
        "never ({})",
        file.formulas.text(whole->first, [&](std::uint32_t number) {
          return read[number].level.empty() ? file.atoms[number].text
                                            : read[number].level;
        }));
  }
  if (reading.together.empty() && !is_demanded) return std::nullopt;
  return reading;
}

std::vector<std::optional<TickAdvice>> tick_advice(
    const BehaviorTree& tree, const PropertyFile& file, const Network& network,
    const SearchChoices& choices, const Limits& limits,
    std::vector<PropertyVerdict>& verdicts) {
  std::vector<std::optional<TickAdvice>> advice(verdicts.size());
  std::vector<Questions> questions;
  std::string text;
  std::size_t next = 0;
  for (std::size_t i = 0; i < verdicts.size(); ++i) {
    if (verdicts[i].verdict == Verdict::Undecided) continue;
    auto reading = tick_reading(tree, file, *verdicts[i].property);
    if (!reading) continue;
    questions.push_back({i, std::move(*reading), next});
    text += text_of(questions.back());
    next += count_of(questions.back());
  }
  if (questions.empty()) return advice;
  const auto found = answers(tree, network.ticks, text, choices, limits);
  if (found.size() != next) return advice;
  // A run over entries may be none of the engine, and one without assumptions
  // none of the file's.
  const bool has_entries = tree.programs && !tree.variables.empty();
  const bool may_be_unreal = has_entries || !file.assumptions.empty();
  for (const Questions& asked : questions) {
    PropertyVerdict& verdict = verdicts[asked.verdict];
    const auto holds = [&](std::size_t question) {
      return found[asked.first + question].verdict == Verdict::Holds;
    };
    const Verdict of_reading = found[asked.first].verdict;
    const bool is_sure = !may_be_unreal || of_reading != Verdict::Violated;
    const TickAdvice told{asked.reading.rule,
                          is_sure ? of_reading : Verdict::Undecided};
    if (verdict.verdict == Verdict::Violated) {
      const bool is_meant = of_reading == Verdict::Holds &&
                            asked.reading.together.empty() &&
                            !verdict.met_expectation();
      if (is_meant) advice[asked.verdict] = told;
      continue;
    }
    bool is_apart =
        !asked.reading.together.empty() &&
        (asked.reading.are_events || of_reading == Verdict::Violated);
    for (std::size_t q = 1; q < count_of_parts(asked); ++q) {
      is_apart = is_apart && holds(q);
    }
    if (!is_apart || !verdict.idle.empty()) continue;
    verdict.idle =
        fmt::format("{}", fmt::join(asked.reading.together, " and "));
    const bool says_more =
        of_reading == Verdict::Holds &&
        count_of(asked) > count_of_parts(asked) &&
        found[asked.first + count_of_parts(asked)].verdict == Verdict::Violated;
    advice[asked.verdict] =
        says_more
            ? TickAdvice{asked.reading.of_levels,
                         may_be_unreal ? Verdict::Undecided : Verdict::Violated}
            : told;
  }
  return advice;
}

}  // namespace btcheck
