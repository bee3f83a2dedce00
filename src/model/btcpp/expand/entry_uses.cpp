// SPDX-License-Identifier: MIT
#include "model/btcpp/expand/entry_uses.hpp"

#include <set>

#include "model/btcpp/attributes.hpp"
#include "model/btcpp/expand/checks.hpp"
#include "model/btcpp/known_types.hpp"
#include "model/btcpp/script/script.hpp"
#include "model/tree/releases.hpp"

namespace btcheck::btcpp {
namespace {

class UseGathering {
 public:
  explicit UseGathering(const BtcppExpansion& expansion)
      : expansion_(expansion) {}

  UsesOfEntries all() {
    for (number_ = 0; number_ < expansion_.nodes.size(); ++number_) {
      for (const auto& script : node().conditions) add_script(script);
      if (node().kind == BtcppKind::SubTree) {
        add_passed_keys();
        add_literals();
        continue;
      }
      for (const auto& port : node().ports) add_port(port);
      add_defaults();
    }
    return std::move(uses_);
  }

 private:
  const BtcppDocument& document() const { return *expansion_.document; }
  const BtcppInstance& instance() const { return expansion_.nodes[number_]; }
  const BtcppNode& node() const { return *instance().node; }

  EntryUses& mention(std::string_view name, const BtcppPlace& place) {
    const EntryName entry = entry_of(expansion_, instance().subtree, name);
    EntryUses& uses = uses_.of[entry];
    last_ = {place, std::string(name), number_};
    is_own_name_ = entry.name == name;
    if (++uses.mentions == 1) uses.first = last_;
    return uses;
  }

  void note(std::optional<EntryUse>& kind) const {
    if (!kind) kind = last_;
  }
  void note_write(EntryUses& uses) const {
    note(uses.write);
    uses.is_written_by_name |= is_own_name_;
  }

  // A remapping mentions a key of the blackboard around the subtree; in version
  // 3 without braces.
  void add_passed_keys() {
    if (instance().children.empty()) return;
    for (const BtcppRemapping& each : inside().remappings) {
      const BtcppAttribute* port = find_attribute(node().ports, each.inner);
      if (port != nullptr && !each.is_literal) mention(each.outer, port->place);
    }
  }
  // The subtree that is called here.
  const BtcppSubtree& inside() const {
    return expansion_.subtrees[inside_number()];
  }
  std::uint32_t inside_number() const {
    return expansion_.nodes[instance().children.front()].subtree;
  }

  void add_literals() {
    if (instance().children.empty()) return;
    for (const BtcppRemapping& each : inside().remappings) {
      if (!each.is_literal) continue;
      uses_.of[{inside_number(), each.inner}].has_other_writer = true;
    }
  }

  void add_script(const BtcppAttribute& script) {
    std::set<std::string> own;  // what this script has created itself
    const ScriptSyntax syntax = parse_script(script.value, document());
    if (!syntax.flaw.empty()) return;  // said elsewhere
    for (const ScriptName& name : syntax.names) {
      EntryUses& uses =
          mention(name.name, place_in(script, name.at, name.name.size()));
      if (name.use == ScriptUse::Read) uses.may_be_read = true;
      if (name.use == ScriptUse::Create) {
        note_write(uses);
        own.insert(name.name);
      } else if (!own.contains(name.name)) {
        note(uses.needed);
        note(uses.read);
      }
    }
  }

  void add_port(const BtcppAttribute& port) {
    const KeyedEntry keyed = keyed_by(document().release, node().id);
    if (keyed == KeyedEntry::IsSet && port.name == "output_key") {
      return add_set_key(port);
    }
    const auto facts = facts_of(document(), node(), port.name);
    const auto key = remapped_key(document().engine(), port.name, port.value);
    if (facts && facts->type == PortType::Script && !key) {
      return add_script(port);
    }
    if (key) return add_key(port.name, *key, port.place, facts);
    // Older releases write the entry that is named without braces.
    const bool is_written = facts && facts->direction == BtcppDirection::Output;
    if (is_written && releases::kOutputsNameEntries.has(document().engine())) {
      add_key(port.name, port.value, port.place, facts);
    } else if (keyed == KeyedEntry::IsUnset && port.name == "key") {
      mention(port.value, port.place);
    } else if (known_type(document().release, node().id) == nullptr) {
      add_names_inside(port);
    }
  }

  // `{object}_frame`: the engine leaves it as it stands, and so do its nodes; a
  // node of the program may well look for the entry.
  void add_names_inside(const BtcppAttribute& port) {
    const std::string_view text = port.value;
    for (std::size_t open = text.find('{'); open != text.npos;
         open = text.find('{', open + 1)) {
      const std::size_t close = text.find_first_of("{}", open + 1);
      if (close == text.npos || text[close] != '}') continue;
      const std::string_view name = text.substr(open + 1, close - open - 1);
      if (!is_port_name(name)) continue;
      mention(name, port.place).may_be_read = true;
    }
  }

  // The value of `output_key` is the key: of "{x}" it is what x holds.
  void add_set_key(const BtcppAttribute& port) {
    const auto key = remapped_key(document().engine(), port.name, port.value);
    EntryUses& uses = mention(key.value_or(port.value), port.place);
    if (!key) return note_write(uses);
    uses.may_be_read = true;
    note(uses.read);
    uses_.may_any_be_written = true;
  }

  void add_key(std::string_view port, std::string_view key,
               const BtcppPlace& place, const std::optional<PortFacts>& facts) {
    EntryUses& uses = mention(key, place);
    if (!facts || facts->direction != BtcppDirection::Output) {
      uses.may_be_read = true;
    }
    if (!facts || facts->direction != BtcppDirection::Input) {
      uses.has_other_writer = true;
      note_write(uses);
    } else if (!default_of(port)) {
      note(uses.read);
    }
  }

  std::optional<std::string> default_of(std::string_view port) const {
    const BtcppModel* model = document().model(node().id);
    const BtcppPort* declared = model ? model->port(port) : nullptr;
    return declared ? declared->default_value : std::nullopt;
  }

  // Ports that only the model remaps.
  void add_defaults() {
    const BtcppModel* model = document().model(node().id);
    if (model == nullptr) return;
    for (const BtcppPort& port : model->ports) {
      if (!port.default_value) continue;
      if (find_attribute(node().ports, port.name) != nullptr) continue;
      const auto key =
          remapped_key(document().engine(), port.name, *port.default_value);
      if (!key) continue;
      add_key(port.name, *key, node().place,
              facts_of(document(), node(), port.name));
    }
  }

  const BtcppExpansion& expansion_;
  std::uint32_t number_ = 0;  // of the current node
  EntryUse last_;
  bool is_own_name_ = false;  // it is called on its blackboard as there
  UsesOfEntries uses_;
};

}  // namespace

UsesOfEntries uses_of_entries(const BtcppExpansion& expansion) {
  return UseGathering(expansion).all();
}

}  // namespace btcheck::btcpp
