// SPDX-License-Identifier: MIT
//
// Names are the paper's where it gives them: Fiacre_Action_takeoff_task,
// Fiacre_Action_takeoff_halt. In C they have no prefix.
#include "model/export/fiacre/links.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <string_view>
#include <utility>

#include "model/export/fiacre/process.hpp"
#include "model/export/layout.hpp"
#include "model/tree/node_types.hpp"
#include "text/numbers.hpp"

namespace btcheck {
namespace {

std::optional<FiacreLinkKind> kind_of(const Node& node) {
  if (node.type == NodeType::Action) return FiacreLinkKind::Action;
  if (node.type == NodeType::Condition) return FiacreLinkKind::Condition;
  if (node.type == NodeType::SetSV) return FiacreLinkKind::SetSV;
  return std::nullopt;
}

// The location from which edges lead to answers.
std::optional<LocationId> asking_location(const Automaton& automaton) {
  for (const Edge& edge : automaton.edges) {
    if (is_answer(automaton.target(edge).role)) return edge.source;
  }
  return std::nullopt;
}

// All leaves of one kind and :ID.
struct Function {
  FiacreLinkKind kind{};
  std::string id;
  std::vector<std::string> keys;  // of arguments, as they first come
  std::vector<AutomatonId> users;
};

class Linker {
 public:
  Linker(const BehaviorTree& tree, const Network& network)
      : tree_(tree), network_(network) {
    links_.of.resize(network.automata.size());
  }

  FiacreLinks link() {
    find_functions();
    for (const Function& function : functions_) declare(function);
    return std::move(links_);
  }

 private:
  const Node& node_of(AutomatonId id) const {
    return tree_.node(network_.automaton(id).node);
  }

  void find_functions() {
    for (std::uint32_t a = 0; a < network_.automata.size(); ++a) {
      const Automaton& automaton = network_.automata[a];
      if (automaton.kind != AutomatonKind::Node) continue;
      const Node& node = tree_.node(automaton.node);
      const auto kind = kind_of(node);
      const bool is_decided =
          kind == FiacreLinkKind::Condition &&
          (!node.contract.decision.is_true() || !node.contract.may_succeed ||
           !node.contract.may_fail);
      if (!kind || is_decided || !asking_location(automaton)) continue;
      const std::string& id = node.id.empty() ? node.name : node.id;
      auto known = std::ranges::find_if(functions_, [&](const auto& each) {
        return each.kind == *kind && each.id == id;
      });
      if (known == functions_.end()) {
        functions_.push_back({*kind, id, {}, {}});
        known = functions_.end() - 1;
      }
      known->users.push_back(AutomatonId{a});
      for (const Argument& argument : node.arguments) {
        const bool is_new = std::ranges::count(known->keys, argument.key) == 0;
        if (argument.known && is_new) known->keys.push_back(argument.key);
      }
    }
  }

  void declare(const Function& function) {
    constexpr std::string_view kWords[] = {"action", "condition", "measure"};
    constexpr std::string_view kFiacre[] = {"Action", "Condition", "SetSV"};
    const auto kind = static_cast<std::size_t>(function.kind);
    const bool is_action = function.kind == FiacreLinkKind::Action;
    const std::string name = unused_name(
        used_,
        fmt::format("Fiacre_{}_{}", kFiacre[kind], as_identifier(function.id)));
    const std::string in_c =
        fmt::format("{}_{}", kWords[kind], name.substr(name.find('_', 7) + 1));
    std::string& text = links_.declarations;
    text += fmt::format("\n/* {}: (node", comment_text(function.id));
    std::string types = "nat";
    for (const std::string& key : function.keys) {
      text += ", " + comment_text(key);
      types += ", int";
    }
    text += ")\n";
    for (const AutomatonId user : function.users) {
      text += fmt::format(" * node {}: {}{}\n", index(user) + 1,
                          comment_text(network_.automaton(user).name),
                          told(node_of(user)));
    }
    text += " */\n";
    const std::string answer =
        function.kind == FiacreLinkKind::SetSV ? "int" : "status";
    const std::string task = is_action ? name + "_task" : name;
    text +=
        fmt::format("{} {} ({}) : {} is {}{}\n", is_action ? "task" : "extern",
                    task, types, answer, in_c, is_action ? "_task" : "");
    if (is_action) {
      text +=
          fmt::format("extern {0}_halt (nat) : bool is {1}_halt\n", name, in_c);
    }
    for (const AutomatonId user : function.users) {
      FiacreLink& link = links_.of[index(user)].emplace();
      link.kind = function.kind;
      link.function = task;
      if (is_action) link.halt = name + "_halt";
      link.asks = *asking_location(network_.automaton(user));
      link.node = static_cast<int>(index(user)) + 1;
      for (const std::string& key : function.keys) {
        const auto& all = node_of(user).arguments;
        const auto own = std::ranges::find(all, key, &Argument::key);
        const bool is_known = own != all.end() && own->known.has_value();
        link.arguments.push_back(is_known
                                     ? over_network(network_, own->known->value)
                                     : Expression::constant(0));
      }
    }
  }

  // ", x = -1.5 (in units of 0.1), z = (* 2 $fls)"
  static std::string told(const Node& node) {
    std::string text;
    for (const Argument& argument : node.arguments) {
      text += fmt::format(", {} = {}", comment_text(argument.key),
                          comment_text(argument.value));
      if (!argument.known) {
        text += " (not passed)";
      } else if (argument.known->decimals > 0) {
        text += fmt::format(" (times {})",
                            "1" + std::string(argument.known->decimals, '0'));
      }
    }
    return text;
  }

  const BehaviorTree& tree_;
  const Network& network_;
  std::vector<Function> functions_;
  std::set<std::string> used_;
  FiacreLinks links_;
};

}  // namespace

FiacreLinks fiacre_links(const BehaviorTree& tree, const Network& network) {
  return Linker(tree, network).link();
}

}  // namespace btcheck
