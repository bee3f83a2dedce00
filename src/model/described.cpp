// SPDX-License-Identifier: MIT
#include "model/described.hpp"

#include <algorithm>
#include <span>
#include <string_view>
#include <unordered_map>
#include <utility>

#include "model/btcpp/attributes.hpp"
#include "model/btcpp/expand/expansion.hpp"
#include "model/btcpp/known_types.hpp"
#include "model/tree/node_types.hpp"
#include "model/tree/reads.hpp"

namespace btcheck {
namespace {

// --- Ports -----------------------------------------------------------------

std::optional<std::string> unless_empty(std::string_view text) {
  return text.empty() ? std::nullopt : std::optional(std::string(text));
}

DescribedPort port_of(const btcpp::PortRow& row) {
  DescribedPort port;
  port.name = row.name;
  port.direction = row.direction;
  if (!row.type_word.empty()) {
    port.type = row.type_word;
  } else if (row.type != btcpp::PortType::Any) {
    port.type = btcpp::port_type_name(row.type);
  }
  port.preset = unless_empty(row.preset);
  port.about = row.about;
  return port;
}

DescribedPort port_of(const BtcppPort& from) {
  DescribedPort port;
  port.name = from.name;
  port.direction = from.direction;
  port.type = from.type;
  port.preset = from.default_value;
  port.about = from.description;
  return port;
}

// The type of a node: what a model says of it, or the engine's own.
class NodeDescriber {
 public:
  NodeDescriber(const BtcppDocument& document, const BtcppNode& node)
      : document_(document), node_(node) {}

  DescribedNode describe() {
    described_.type = node_.id;
    described_.kind = kind_name(node_.kind);
    if (const BtcppModel* model = model_of_node()) {
      take_model(*model);
    } else if (const auto* row = row_of_node()) {
      for (const btcpp::PortRow& port : row->ports) {
        if (port.in.has(document_.engine())) {
          described_.ports.push_back(port_of(port));
        }
      }
    }
    for (const BtcppAttribute& written : node_.ports) take_written(written);
    return std::move(described_);
  }

 private:
  // The engine's own types are what they are, whatever a model says.
  const BtcppModel* model_of_node() const {
    if (node_.kind == BtcppKind::SubTree) {
      return document_.subtree_model(node_.id);
    }
    const bool is_builtin =
        btcpp::builtin_type(document_.release, node_.id) != nullptr;
    return is_builtin ? nullptr : document_.model(node_.id);
  }
  const btcpp::NodeTypeRow* row_of_node() const {
    return node_.kind == BtcppKind::SubTree
               ? nullptr
               : btcpp::known_type(document_.release, node_);
  }

  void take_model(const BtcppModel& model) {
    for (const BtcppPort& port : model.ports) {
      described_.ports.push_back(port_of(port));
    }
    const auto told =
        std::ranges::find(model.metadata, "description",
                          &std::pair<std::string, std::string>::first);
    if (told != model.metadata.end()) described_.about = told->second;
  }

  void take_written(const BtcppAttribute& written) {
    auto found =
        std::ranges::find(described_.ports, written.name, &DescribedPort::name);
    if (found == described_.ports.end()) {
      described_.ports.push_back(unlisted(written.name));
      found = described_.ports.end() - 1;
    }
    found->value = written.value;
    found->file = document_.files[written.place.file].name;
    found->span = written.place.span;
    const auto key =
        btcpp::remapped_key(document_.engine(), written.name, written.value);
    if (key) found->entry = *key;
  }

  // Of another library, or of nobody that is known.
  DescribedPort unlisted(const std::string& name) const {
    DescribedPort port;
    port.name = name;
    if (node_.kind == BtcppKind::SubTree) return port;
    if (const auto facts = btcpp::facts_of(document_, node_, name)) {
      port.direction = facts->direction;
      if (facts->type != btcpp::PortType::Any) {
        port.type = btcpp::port_type_name(facts->type);
      }
    }
    return port;
  }

  const BtcppDocument& document_;
  const BtcppNode& node_;
  DescribedNode described_;
};

std::string_view kind_of(const Node& node) {
  if (node.is_root()) return "Tree";
  if (node.type == NodeType::SubTree) return kind_name(BtcppKind::SubTree);
  if (node.type == NodeType::Condition) return kind_name(BtcppKind::Condition);
  const NodeTypeInfo& info = info_of(node.type);
  if (info.max_children == 0) return kind_name(BtcppKind::Action);
  return kind_name(info.max_children == 1 ? BtcppKind::Decorator
                                          : BtcppKind::Control);
}

// As the tree alone tells it.
DescribedNode plain_node(const BehaviorTree& tree, NodeId id) {
  const Node& node = tree.node(id);
  DescribedNode described;
  described.type =
      node.is_root() || node.id.empty() ? type_name(node.type) : node.id;
  described.kind = kind_of(node);
  for (const Argument& argument : node.arguments) {
    DescribedPort port;
    port.name = argument.key;
    port.value = argument.value;
    port.file = tree.file_of(id);
    port.span = argument.span;
    described.ports.push_back(std::move(port));
  }
  return described;
}

// --- Entries ---------------------------------------------------------------

bool reads_in(const std::vector<StateAssignment>& assignments,
              StateVariableId variable) {
  return std::ranges::any_of(assignments, [&](const StateAssignment& each) {
    return reads(each.value, variable);
  });
}

// Of a .btf tree.
bool reads(const Node& node, StateVariableId variable) {
  const LeafContract& contract = node.contract;
  return reads(node.expression, variable) ||
         (node.assignment && reads(node.assignment->value, variable)) ||
         reads(contract.requirement, variable) ||
         reads(contract.decision, variable) ||
         reads_in(contract.on_success, variable) ||
         reads_in(contract.on_failure, variable) ||
         std::ranges::any_of(node.arguments, [&](const Argument& argument) {
           return argument.known && reads(argument.known->value, variable);
         });
}

void add_once(std::vector<NodeId>& nodes, NodeId node) {
  if (nodes.empty() || nodes.back() != node) nodes.push_back(node);
}

DescribedEntry entry_of_variable(const BehaviorTree& tree,
                                 StateVariableId variable) {
  DescribedEntry entry{
      tree.variable(variable).name, tree.variable(variable).states, {}, {}};
  for (std::uint32_t i = 0; i < tree.nodes.size(); ++i) {
    if (writes(tree.nodes[i], variable)) entry.writers.push_back(NodeId{i});
    if (reads(tree.nodes[i], variable)) entry.readers.push_back(NodeId{i});
  }
  return entry;
}

}  // namespace

std::vector<DescribedNode> described_nodes(const BehaviorTree& tree,
                                           const FileText& text,
                                           TreeReading reading) {
  std::vector<DescribedNode> nodes;
  for (std::uint32_t i = 0; i < tree.nodes.size(); ++i) {
    nodes.push_back(plain_node(tree, NodeId{i}));
  }
  if (!is_engine(tree.profile)) return nodes;
  // As it was read in the end, whatever had been asked for.
  reading.profile = tree.profile;
  const auto document = read_tree_document(tree.file, text, reading);
  if (!document.value) return nodes;
  const auto expansion = expand_btcpp(*document.value, reading.main_tree);
  if (!expansion.value) return nodes;
  const auto& instances = expansion.value->nodes;
  // The root of the tree comes before them.
  for (std::size_t i = 0; i < instances.size() && i + 1 < nodes.size(); ++i) {
    nodes[i + 1] =
        NodeDescriber(*document.value, *instances[i].node).describe();
  }
  return nodes;
}

std::vector<DescribedEntry> described_entries(const BehaviorTree& tree) {
  std::vector<DescribedEntry> entries;
  if (!is_engine(tree.profile)) {
    for (std::uint32_t i = 0; i < tree.variables.size(); ++i) {
      entries.push_back(entry_of_variable(tree, StateVariableId{i}));
    }
    return entries;
  }
  for (const std::string& name : tree.entries)
    entries.push_back({name, {}, {}, {}});
  for (const EntryUse& use : tree.entry_uses) {
    if (use.writes) add_once(entries[use.entry].writers, use.node);
    if (use.reads) add_once(entries[use.entry].readers, use.node);
  }
  std::unordered_map<std::string_view, std::size_t> count;
  std::unordered_map<std::string_view, const StateVariable*> variables;
  for (const std::string& name : tree.entries) ++count[name];
  for (const StateVariable& each : tree.variables) {
    variables.try_emplace(each.name, &each);
  }
  for (DescribedEntry& entry : entries) {
    const auto variable = variables.find(entry.name);
    if (count[entry.name] == 1 && variable != variables.end()) {
      entry.values = variable->second->states;
    }
  }
  return entries;
}

}  // namespace btcheck
