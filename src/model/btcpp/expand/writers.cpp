// SPDX-License-Identifier: MIT
//
// A leaf may write by its output ports when it is ticked or halted; a port of
// unknown direction, or of any other node, may write at any time. A port that a
// node has by default counts only when a model has it, and a leaf that writes
// entries without a port is known only by its contract. What a contract says of
// an entry is all that the leaf does with it, whatever ports point there.
#include "model/btcpp/expand/writers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "model/btcpp/attributes.hpp"
#include "model/btcpp/known_types.hpp"
#include "model/tree/node_types.hpp"
#include "text/budget.hpp"
#include "text/numbers.hpp"

namespace btcheck::btcpp {
namespace {

EntryType type_of_port(PortType type) {
  switch (type) {
    case PortType::Any:
      return EntryType::Free;
    case PortType::Int:
    case PortType::Unsigned:
      return EntryType::Integer;
    case PortType::Double:
      return EntryType::Real;
    case PortType::String:
    case PortType::Script:
      return EntryType::Text;
    case PortType::Bool:
    case PortType::Status:
      break;
  }
  return EntryType::Other;
}

// The key that a port names without braces, or nullptr.
const std::string* plain_key(const BtcppExpansion& expansion,
                             const BtcppInstance& node, std::string_view port) {
  const BtcppAttribute* found = find_attribute(node.node->ports, port);
  const bool is_plain =
      found != nullptr &&
      !remapped_key(expansion.document->engine(), port, found->value);
  return is_plain ? &found->value : nullptr;
}

// Whether a SubTree remaps the key to `@x`. Blackboard::set (4.10,
// blackboard.h) finds no entry by such a key, and makes one that nothing can
// read.
bool is_lost_when_set(const BtcppExpansion& expansion, std::uint32_t subtree,
                      std::string_view key) {
  if (key.starts_with('@')) return false;
  EntryName at{subtree, std::string(key)};
  while (at.subtree != 0) {
    const BtcppSubtree& around = expansion.subtrees[at.subtree];
    at.subtree = around.parent;
    if (around.is_shared) continue;
    const auto remapping =
        std::ranges::find(around.remappings, at.name, &BtcppRemapping::inner);
    if (remapping == around.remappings.end()) {
      if (around.is_autoremapped) continue;
      return false;
    }
    if (remapping->is_literal) return false;
    if (remapping->outer.starts_with('@')) return true;
    at.name = remapping->outer;
  }
  return false;
}

class WriterGathering {
 public:
  WriterGathering(const BtcppExpansion& expansion,
                  const ContractScripts& contracts)
      : expansion_(expansion), contracts_(contracts) {}

  ScriptWriters all() {
    for (std::uint32_t i = 1; i < expansion_.subtrees.size(); ++i) {
      for (const auto& each : expansion_.subtrees[i].remappings) {
        if (!each.is_literal) continue;
        writers_.literals[{i, each.inner}] = passes_texts(expansion_)
                                                 ? ScriptValue::of(each.outer)
                                                 : literal_value(each.outer);
      }
    }
    for (const auto& [entry, value] : contracts_.initial) {
      writers_.literals[entry] = value;
    }
    for (std::uint32_t i = 0; i < expansion_.nodes.size(); ++i) {
      ask_budget();
      const BtcppInstance& node = expansion_.nodes[i];
      number_ = i;
      for (const auto& script : node.node->conditions) {
        add_script(node, script.value);
      }
      add_contract(i);
      if (node.node->kind != BtcppKind::SubTree) add_node(node);
    }
    for (auto& [leaf, writes] : writers_.port_writes) {
      for (PortWrite& each : writes) {
        each.value = ScriptValue::outside().as(noted_after(each));
      }
    }
    return std::move(writers_);
  }

 private:
  void add_script(const BtcppInstance& node, std::string_view code) {
    PlacedScript placed{node.subtree, parse_script(code, *expansion_.document),
                        false, number_};
    if (placed.syntax.flaw.empty()) {
      writers_.scripts.push_back(std::move(placed));
    }
  }

  void add_contract(std::uint32_t instance) {
    told_.clear();
    const auto found = contracts_.of.find(instance);
    if (found == contracts_.of.end()) return;
    const BtcppInstance& node = expansion_.nodes[instance];
    for (const std::string* code :
         {&found->second.requirement, &found->second.decision,
          &found->second.on_success, &found->second.on_failure}) {
      if (code->empty()) continue;
      PlacedScript placed{node.subtree,
                          parse_contract_script(*code, *expansion_.document),
                          true, instance};
      assert(placed.syntax.flaw.empty());
      for (const ScriptName& name : placed.syntax.names) {
        told_.insert(entry_of(expansion_, node.subtree, name.name));
        if (name.use != ScriptUse::Read) open_where_lost(node, name.name);
      }
      writers_.scripts.push_back(std::move(placed));
    }
  }

  void add_node(const BtcppInstance& node) {
    const KeyedEntry keyed =
        keyed_by(expansion_.document->release, node.node->id);
    const bool sets = keyed == KeyedEntry::IsSet;
    const bool unsets = keyed == KeyedEntry::IsUnset;
    for (const auto& port : node.node->ports) {
      add_port(node, port, !sets && !unsets);
    }
    add_compared(node);
    if (!sets && !unsets) return add_defaults(node);
    if (is_open(node, sets ? "output_key" : "key")) return;
    if (unsets) {
      if (const auto entry = unset_by(expansion_, node)) add_unset(*entry);
    } else if (auto setting = setting_of(expansion_, node)) {
      setting->node = number_;
      open_where_lost(node, *plain_key(expansion_, node, "output_key"));
      if (!is_release_3()) {
        writers_.typed_by_leaves.insert(setting->entry);
        if (setting->source) writers_.typed_by_leaves.insert(*setting->source);
      }
      writers_.settings.push_back(std::move(*setting));
    }
  }

  void add_compared(const BtcppInstance& node) {
    const NodeType type = engine_type(expansion_.document->release, *node.node);
    if (type == NodeType::BlackboardCheck) {
      add_pair(node, "value_A", "value_B");
    }
    if (type != NodeType::Switch) return;
    for (std::size_t i = 1; i < node.node->children.size(); ++i) {
      add_pair(node, "variable", fmt::format("case_{}", i));
    }
  }

  void add_pair(const BtcppInstance& node, std::string_view one,
                std::string_view other) {
    PortPair pair;
    for (const std::string_view name : {one, other}) {
      const BtcppAttribute* port = find_attribute(node.node->ports, name);
      if (port == nullptr) continue;
      if (const auto key = key_of(*port)) {
        pair.entries.push_back(entry_of(expansion_, node.subtree, *key));
        continue;
      }
      pair.texts.push_back(port->value);
      const auto number = as_number<double>(port->value);
      if (number && std::isfinite(*number)) pair.numbers.push_back(*number);
    }
    if (!pair.entries.empty()) writers_.compared.push_back(std::move(pair));
  }

  std::optional<std::string_view> key_of(const BtcppAttribute& port) const {
    return remapped_key(expansion_.document->engine(), port.name, port.value);
  }

  // Whether the blackboard decides what this port says.
  bool is_open(const BtcppInstance& node, std::string_view port) {
    const BtcppAttribute* found = find_attribute(node.node->ports, port);
    if (found == nullptr || !key_of(*found)) return false;
    writers_.all_foreign = fmt::format(
        "the {} of {} is read from the blackboard", port, node.node->id);
    return true;
  }

  // Once a literal is unset, `_autoremap` makes its name mean another entry.
  void add_unset(const EntryName& entry) {
    writers_.unset.push_back(entry);
    const BtcppSubtree& subtree = expansion_.subtrees[entry.subtree];
    if (!subtree.is_autoremapped || !writers_.literals.contains(entry)) return;
    for (const EntryName& each :
         {entry, entry_of(expansion_, subtree.parent, entry.name)}) {
      writers_.foreign[each] = "UnsetBlackboard uncovers another of its name";
    }
  }

  // An entry is made for each port that is remapped, and has the type of the
  // first (XMLParser::createNodeFromXML).
  void add_port(const BtcppInstance& node, const BtcppAttribute& port,
                bool may_write) {
    const auto facts = facts_of(*expansion_.document, *node.node, port.name);
    const auto key = key_of(port);
    if (key) {
      writers_.declared.emplace(
          entry_of(expansion_, node.subtree, *key),
          facts ? type_given(node, port.name, facts->type) : EntryType::Other);
    }
    if (!may_write) return;
    if (facts && facts->type == PortType::Script) {
      if (!is_open(node, port.name)) add_script(node, port.value);
    } else if (key) {
      add_key(node, port.name, *key, facts);
    }
  }

  void add_key(const BtcppInstance& node, std::string_view port,
               std::string_view key, const std::optional<PortFacts>& facts) {
    const EntryName entry = entry_of(expansion_, node.subtree, key);
    const bool may_write = !facts || facts->direction != BtcppDirection::Input;
    if (!may_write) return;
    open_where_lost(node, key);
    if (told_.contains(entry)) return;
    std::string reason =
        fmt::format("the port `{}` of {} may write it", port, node.node->id);
    const bool is_declared = contracts_.declared.contains(entry);
    if (!is_leaf(node) || (!facts && !is_declared)) {
      writers_.foreign[entry] = std::move(reason);
      return;
    }
    const EntryType type =
        facts ? type_given(node, port, facts->type) : EntryType::Other;
    writers_.port_writes[number_].push_back(
        {entry, type, {}, std::move(reason), !facts});
  }

  // What such an entry holds is left open.
  void open_where_lost(const BtcppInstance& node, std::string_view key) {
    if (!is_lost_when_set(expansion_, node.subtree, key)) return;
    writers_.foreign.emplace(
        entry_of(expansion_, node.subtree, key),
        fmt::format("what {} writes to `{}`, which a SubTree remaps to `@`, "
                    "may be lost",
                    node.node->id, key));
  }

  bool is_leaf(const BtcppInstance& node) const {
    const NodeType type = engine_type(expansion_.document->release, *node.node);
    return node.children.empty() &&
           (type == NodeType::Action || type == NodeType::Condition);
  }

  // An entry keeps the type that it was made with; one that has none, or was
  // unset, takes that of the port.
  EntryType noted_after(const PortWrite& write) const {
    const auto& unset = writers_.unset;
    if (std::ranges::find(unset, write.entry) != unset.end()) {
      return EntryType::Other;
    }
    const auto found = writers_.declared.find(write.entry);
    const bool is_typed =
        found != writers_.declared.end() && found->second != EntryType::Free;
    return is_typed ? found->second : write.type;
  }

  // BehaviorTree.CPP writes the types of ports into the models it makes, so a
  // port without one is taken for generic.
  EntryType type_given(const BtcppInstance& node, std::string_view port,
                       PortType type) const {
    const BtcppDocument& document = *expansion_.document;
    const bool is_builtin =
        builtin_type(document.release, node.node->id) != nullptr;
    const BtcppModel* model = document.model(node.node->id);
    if (type != PortType::Any || is_builtin || model == nullptr) {
      return type_of_port(type);
    }
    const std::string& written = model->port(port)->type;
    const bool is_generic = written.empty() || written == "BT::AnyTypeAllowed";
    return is_generic ? EntryType::Free : EntryType::Other;
  }
  bool is_release_3() const {
    return expansion_.document->release == BtcppRelease::V3;
  }

  // Ports that only the model remaps.
  void add_defaults(const BtcppInstance& node) {
    const BtcppDocument& document = *expansion_.document;
    const BtcppModel* model = document.model(node.node->id);
    if (model == nullptr) return;
    for (const BtcppPort& port : model->ports) {
      if (find_attribute(node.node->ports, port.name) != nullptr) continue;
      if (!port.default_value) continue;
      const auto key =
          remapped_key(document.engine(), port.name, *port.default_value);
      if (!key) continue;
      add_key(node, port.name, *key, facts_of(document, *node.node, port.name));
    }
  }

  const BtcppExpansion& expansion_;
  const ContractScripts& contracts_;
  std::set<EntryName> told_;  // that the node's contract names
  std::uint32_t number_ = 0;  // of the current node
  ScriptWriters writers_;
};

}  // namespace

// As XMLParser::recursivelyCreateSubtree of BehaviorTree.CPP 4.10 stores what
// a SubTree's attribute says.
ScriptValue literal_value(const std::string& text) {
  const bool is_real = text.find_first_of(".eE") != text.npos;
  if (const auto integer = as_number<std::int64_t>(text); integer && !is_real) {
    return ScriptValue::integer(static_cast<double>(*integer))
        .as(EntryType::Integer);
  }
  if (const auto number = as_number<double>(text)) {
    return ScriptValue::real(*number).as(EntryType::Real);
  }
  return ScriptValue::of(text);
}

std::optional<Setting> setting_of(const BtcppExpansion& expansion,
                                  const BtcppInstance& node) {
  const std::string* key = plain_key(expansion, node, "output_key");
  const BtcppAttribute* value = find_attribute(node.node->ports, "value");
  if (key == nullptr || value == nullptr) return std::nullopt;
  Setting setting;
  setting.entry = entry_of(expansion, node.subtree, *key);
  setting.is_own = is_own_name(setting.entry, node.subtree, *key);
  if (const auto source =
          blackboard_key(expansion.document->engine(), value->value)) {
    setting.source = entry_of(expansion, node.subtree, *source);
  } else {
    setting.text = value->value;
  }
  return setting;
}

std::optional<EntryName> unset_by(const BtcppExpansion& expansion,
                                  const BtcppInstance& node) {
  const std::string* key = plain_key(expansion, node, "key");
  if (key == nullptr) return std::nullopt;
  EntryName own{node.subtree, *key};
  if (entry_of(expansion, own.subtree, own.name) != own) return std::nullopt;
  return own;
}

ScriptWriters script_writers(const BtcppExpansion& expansion,
                             const ContractScripts& contracts) {
  return WriterGathering(expansion, contracts).all();
}

}  // namespace btcheck::btcpp
