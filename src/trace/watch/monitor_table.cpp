// SPDX-License-Identifier: MIT
//
// What `src/btcheck/monitor.hpp` reads: words, numbers and texts in quotes,
// with the fingerprint of all at its end.
#include "trace/watch/monitor_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <utility>
#include <vector>

#include "btcheck/monitor.hpp"
#include "trace/logs/btcpp_tree.hpp"
#include "trace/run/shown_text.hpp"
#include "trace/watch/entry_regions.hpp"
#include "trace/watch/recorded_watch.hpp"

namespace btcheck {
namespace {

std::string_view sign_of(Operation operation) {
  switch (operation) {
    case Operation::Add:
      return "+";
    case Operation::Subtract:
      return "-";
    case Operation::Negate:
      return "neg";
    case Operation::Multiply:
      return "*";
    case Operation::Divide:
      return "/";
    case Operation::Modulo:
      return "%";
    case Operation::Equal:
      return "==";
    case Operation::NotEqual:
      return "!=";
    case Operation::Less:
      return "<";
    case Operation::LessEqual:
      return "<=";
    case Operation::Greater:
      return ">";
    case Operation::GreaterEqual:
      return ">=";
    case Operation::And:
      return "&&";
    case Operation::Or:
      return "||";
    case Operation::Not:
      return "!";
    case Operation::Constant:
      return "c";
    case Operation::Variable:
      return "v";
    case Operation::Status:
      break;
  }
  return "";
}

constexpr std::array<std::string_view, 6> kSlotNames = {
    "location", "last_status", "called", "answer", "remembered", "entry"};

// `"a \042quoted\042 text"`
std::string table_text(std::string_view text) {
  std::string result = "\"";
  for (const char c : text) {
    const bool is_plain = c >= ' ' && c <= '~' && c != '"' && c != '\\';
    result += is_plain ? std::string(1, c)
                       : fmt::format("\\{:03o}", static_cast<unsigned char>(c));
  }
  return result + '"';
}

class TableWriter {
 public:
  TableWriter(const BehaviorTree& tree, const RecordedRun& nodes,
              const RecordedWatch& watch)
      : tree_(tree), nodes_(nodes), watch_(watch) {}

  std::string write() {
    const std::string automata = automata_text();
    const std::string past = past_text();
    const std::string slots = slots_text();  // now that all are known
    std::string text =
        fmt::format("{}\ntree {}\nrules {}\n", monitor::Table::kHeading,
                    table_text(one_line(nodes_.tree)),
                    table_text(one_line(watch_.rules_file())));
    text += nodes_text() + entries_text() + slots;
    text += fmt::format("conditions {}\n{}", conditions_.size(),
                        fmt::join(conditions_, ""));
    text += past + automata;
    return text + fmt::format("end {:016x}\n", monitor::fingerprint(text));
  }

 private:
  // Nodes of XML trees are registered under the names that the tree has; who
  // builds a .btf tree in BehaviorTree.CPP calls its leaves as it likes.
  std::string nodes_text() const {
    const LoggedTree engine = btcpp_tree(nodes_);
    std::vector<std::string> rows{
        fmt::format("0 0 {} \"\" \"\"\n", table_text(nodes_.nodes[0].name))};
    for (const LoggedNode& logged : engine.nodes) {
      const NodeId id{*logged.recorded};
      assert(index(id) == rows.size());
      const Node& node = tree_.node(id);
      const bool is_leaf = node.children.empty();
      const bool is_tree = logged.kind == BtcppKind::SubTree;
      const bool is_xml = is_engine(tree_.profile);
      const std::string& called =
          is_xml || (is_leaf && !node.id.empty()) ? node.id : logged.id;
      const std::string type = is_tree              ? "SubTree"
                               : is_leaf && !is_xml ? ""
                                                    : called;
      rows.push_back(fmt::format("{} {:d} {} {} {}\n",
                                 nodes_.nodes[index(id)].parent.value_or(0),
                                 is_leaf, table_text(node.name),
                                 table_text(called), table_text(type)));
    }
    return fmt::format("nodes {}\n{}", rows.size(), fmt::join(rows, ""));
  }

  std::string entries_text() const {
    std::string text = fmt::format("entries {}\n", nodes_.variables.size());
    for (std::size_t v = 0; v < nodes_.variables.size(); ++v) {
      const std::string& name = nodes_.variables[v];
      const auto home =
          std::ranges::find(tree_.entry_homes, name, &EntryHome::name);
      const auto number =
          static_cast<std::size_t>(home - tree_.entry_homes.begin());
      const StateVariable& entry = watch_.entry(v);
      text +=
          fmt::format("{} {} {} {}", table_text(name), index(home->node),
                      table_text(tree_.entries[number]), entry.states.size());
      for (std::size_t state = 0; state < entry.states.size(); ++state) {
        text += region(entry, state);
      }
      text += "\n";
    }
    return text;
  }

  static std::string region(const StateVariable& entry, std::size_t state) {
    const EntryValue& value = entry.values[state];
    if (value.numbers) {
      return fmt::format(" numbers {} {}", value.numbers->least,
                         value.numbers->greatest);
    }
    if (value.text == kOtherText) return " any_text";
    if (value.text) return " text " + table_text(*value.text);
    const std::string& name = entry.states[state];
    return name == "unset" || name == "no_value" ? " " + name : " other";
  }

  // The place of a network's variable among those that are kept up to date.
  std::size_t slot_of(VariableId variable) {
    const auto known = std::ranges::find(slots_, variable);
    if (known != slots_.end()) {
      return static_cast<std::size_t>(known - slots_.begin());
    }
    slots_.push_back(variable);
    return slots_.size() - 1;
  }
  std::string slots_text() const {
    std::string text = fmt::format("slots {}\n", slots_.size());
    for (const VariableId slot : slots_) {
      const auto [kind, of] = watch_.meaning(slot);
      text += fmt::format("{} {}\n", kSlotNames[static_cast<std::size_t>(kind)],
                          of);
    }
    return text;
  }

  std::size_t condition(const Expression& expression) {
    std::string text = fmt::format("{}", expression.terms().size());
    for (const Term& term : expression.terms()) {
      text += fmt::format(" {}", sign_of(term.operation));
      if (term.operation == Operation::Constant) {
        text += fmt::format(" {}", term.operand);
      } else if (term.operation == Operation::Variable) {
        text += fmt::format(
            " {}",
            slot_of(VariableId{static_cast<std::uint32_t>(term.operand)}));
      }
    }
    conditions_.push_back(text + "\n");
    return conditions_.size() - 1;
  }

  std::string past_text() {
    constexpr std::array<std::string_view, 3> kKinds = {"once", "since",
                                                        "previously"};
    std::string text = fmt::format("past {}\n", watch_.past().size());
    for (const RecordedWatch::Past& each : watch_.past()) {
      const auto kind = static_cast<std::size_t>(each.kind) -
                        static_cast<std::size_t>(AtomKind::Once);
      const std::size_t held = condition(each.held);
      text += fmt::format("{} {} {} {}\n", kKinds[kind], slot_of(each.bit),
                          held, condition(each.began));
    }
    return text;
  }

  std::string automata_text() {
    std::string text = fmt::format("automata {}\n", watch_.monitors().size());
    for (const RuleMonitor& rule : watch_.monitors()) {
      const std::size_t first = conditions_.size();
      for (const StatePredicate& each : rule.propositions) {
        condition(each.expression);
      }
      const Monitor& automaton = rule.monitor;
      const Property& property = *rule.rule->property;
      text += fmt::format("{} {} {}", table_text(one_line(property.name)),
                          table_text(one_line(property.text)),
                          automaton.reads.size());
      for (const PropositionSet read : automaton.reads) {
        if (read == rule.elapsed) {
          text += " -1";
        } else {
          text += fmt::format(
              " {}", first + static_cast<std::size_t>(std::countr_zero(read)));
        }
      }
      text += fmt::format("\n{}", automaton.outlook.size());
      for (const Outlook each : automaton.outlook) {
        text += fmt::format(" {}", static_cast<int>(each));
      }
      text += "\n";
      for (const auto& row : automaton.next) {
        text += fmt::format("{}\n", fmt::join(row, " "));
      }
    }
    return text;
  }

  const BehaviorTree& tree_;
  const RecordedRun& nodes_;
  const RecordedWatch& watch_;
  std::vector<VariableId> slots_;
  std::vector<std::string> conditions_;
};

}  // namespace

namespace {

bool names_entry(const PropertyFile& rules, std::string_view name) {
  return std::ranges::any_of(rules.atoms, [&](const Atom& atom) {
    bool is_named = false;
    visit_leaves(atom, [&](const Operand& side) {
      is_named |= side.node.empty() && equal_ignoring_case(side.name, name);
    });
    return is_named;
  });
}

}  // namespace

Result<std::string> monitor_table(const BehaviorTree& tree, RecordedRun nodes,
                                  const PropertyFile& rules,
                                  const SourceText& source) {
  nodes.states.clear();
  nodes.variables.clear();
  for (const EntryHome& home : tree.entry_homes) {
    if (names_entry(rules, home.name)) nodes.variables.push_back(home.name);
  }
  nodes.is_number.assign(nodes.variables.size(), false);
  nodes.has_entries = true;
  auto watch = RecordedWatch::make(nodes, Recording::MarkedLog, rules, source);
  Result<std::string> result{std::nullopt, std::move(watch.diagnostics)};
  if (watch.value) {
    result.value = TableWriter(tree, nodes, **watch.value).write();
  }
  return result;
}

}  // namespace btcheck
