// SPDX-License-Identifier: MIT
#include "model/btcpp/tree/entry_uses.hpp"

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "model/btcpp/attributes.hpp"
#include "model/btcpp/entries/world.hpp"
#include "model/btcpp/expand/writers.hpp"
#include "model/btcpp/known_types.hpp"
#include "model/btcpp/script/script.hpp"

namespace btcheck::btcpp {
namespace {

class Noting {
 public:
  Noting(const BtcppExpansion& expansion,
         const std::map<EntryName, StateVariableId>& variables,
         BehaviorTree& tree)
      : expansion_(expansion), variables_(variables), tree_(tree) {}

  void note_all() {
    for (std::uint32_t i = 0; i < expansion_.nodes.size(); ++i) {
      at_ = &expansion_.nodes[i];
      node_ = NodeId{i + 1};
      for (std::size_t time = 0; time < kScriptTimes; ++time) {
        const BtcppAttribute* written =
            find_attribute(at_->node->conditions, kBtcppConditionNames[time]);
        if (written == nullptr) continue;
        note_script(written->value, static_cast<ScriptTime>(time));
      }
      if (at_->node->kind == BtcppKind::SubTree) continue;
      for (const auto& port : at_->node->ports) note_port(port);
      note_setting();
    }
    // What a SubTree is given as it stands may be used by nobody.
    for (const auto& [entry, variable] : variables_) number_of(entry);
    name_homes();
  }

 private:
  EntryUse& add(std::string_view key) {
    return add(entry_of(expansion_, at_->subtree, key));
  }
  EntryUse& add(const EntryName& entry) {
    return tree_.entry_uses.emplace_back(
        EntryUse{.node = node_, .entry = number_of(entry)});
  }
  std::uint32_t number_of(const EntryName& entry) {
    const auto number = static_cast<std::uint32_t>(tree_.entries.size());
    const auto [known, is_new] = numbers_.emplace(entry, number);
    if (is_new) {
      tree_.entries.push_back(entry.name);
      const auto& home = expansion_.subtrees[entry.subtree];
      tree_.entry_homes.push_back({NodeId{home.first_node + 1}, ""});
    }
    return known->second;
  }

  // Of numbers_, which is in the order that names want. A variable has the same
  // name in every rule.
  void name_homes() {
    std::vector<EntryName> entries;
    for (const auto& [entry, number] : numbers_) entries.push_back(entry);
    std::map<EntryName, std::string> known;
    for (const auto& [entry, variable] : variables_) {
      known[entry] = tree_.variable(variable).name;
    }
    const auto names = names_of_entries(expansion_, entries, known);
    for (std::size_t i = 0; i < entries.size(); ++i) {
      tree_.entry_homes[numbers_.at(entries[i])].name = names[i];
    }
  }

  void note_port(const BtcppAttribute& port) {
    const auto facts = facts_of(*expansion_.document, *at_->node, port.name);
    const int engine = expansion_.document->engine();
    const auto key = remapped_key(engine, port.name, port.value);
    if (facts && facts->type == PortType::Script && !key) {
      return note_script(port.value, std::nullopt);
    }
    if (!key) return;
    EntryUse& use = add(*key);
    use.is_port = true;
    use.reads = !facts || facts->direction != BtcppDirection::Output;
    use.writes = !facts || facts->direction != BtcppDirection::Input;
  }

  void note_setting() {
    const auto keyed = keyed_by(expansion_.document->release, at_->node->id);
    if (keyed != KeyedEntry::IsSet) return;
    const auto setting = setting_of(expansion_, *at_);
    if (!setting) return;
    EntryUse& use = add(setting->entry);
    use.writes = true;
    if (!setting->source) use.literal = "'" + setting->text + "'";
  }

  void note_script(std::string_view code, std::optional<ScriptTime> when) {
    const ScriptSyntax syntax = parse_script(code, *expansion_.document);
    if (!syntax.flaw.empty()) return;
    for (const ScriptName& name : syntax.names) {
      EntryUse& use = add(name.name);
      use.reads = name.use == ScriptUse::Read;
      use.writes = name.use != ScriptUse::Read;
      use.when = when;
      if (use.writes) use.literal = given(code, name.name);
    }
  }

  // The literal that the script's last assignment gives the name, or "".
  static std::string given(std::string_view code, std::string_view name) {
    const std::vector<ScriptToken> tokens = tokens_of(code);
    std::string literal;
    for (std::size_t i = 0; i + 1 < tokens.size(); ++i) {
      const bool is_name =
          tokens[i].kind == ScriptTokenKind::Name && tokens[i].text == name;
      if (!is_name || !tokens[i + 1].text.ends_with('=')) continue;
      if (is_comparison(tokens[i + 1].text)) continue;
      literal = literal_at(tokens, i + 2, tokens[i + 1].text);
    }
    return literal;
  }
  static bool is_comparison(std::string_view word) {
    return word == "==" || word == "!=" || word == "<=" || word == ">=";
  }
  // "" where more than a literal is assigned.
  static std::string literal_at(const std::vector<ScriptToken>& tokens,
                                std::size_t at, std::string_view assigned) {
    if (assigned != ":=" && assigned != "=") return {};
    std::string literal;
    if (at < tokens.size() && tokens[at].text == "-")
      literal = tokens[at++].text;
    if (at + 1 >= tokens.size()) return {};
    const ScriptTokenKind kind = tokens[at].kind;
    const bool is_plain = kind == ScriptTokenKind::Number ||
                          kind == ScriptTokenKind::Truth ||
                          kind == ScriptTokenKind::Text;
    const ScriptToken& behind = tokens[at + 1];
    const bool is_alone =
        behind.kind == ScriptTokenKind::End || behind.text == ";";
    if (!is_plain || !is_alone) return {};
    return literal.append(tokens[at].text);
  }

  const BtcppExpansion& expansion_;
  const std::map<EntryName, StateVariableId>& variables_;
  BehaviorTree& tree_;
  const BtcppInstance* at_ = nullptr;
  NodeId node_{};
  std::map<EntryName, std::uint32_t> numbers_;
};

}  // namespace

void note_entry_uses(const BtcppExpansion& expansion,
                     const std::map<EntryName, StateVariableId>& variables,
                     BehaviorTree& tree) {
  Noting(expansion, variables, tree).note_all();
}

}  // namespace btcheck::btcpp
