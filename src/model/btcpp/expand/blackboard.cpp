// SPDX-License-Identifier: MIT
//
// Every mention of an entry is gathered first: by ports, whose direction the
// engine or a model tells, and by scripts. A port of which nothing is known may
// write. Then each entry is judged.
//
// The program around a tree may set entries before the first tick, so that an
// entry nobody writes is no error; and a name of capitals alone is taken for a
// registered enumeration.
#include "model/btcpp/expand/blackboard.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "model/btcpp/expand/entries.hpp"
#include "model/btcpp/expand/ports.hpp"
#include "model/btcpp/expand/spelling.hpp"
#include "model/btcpp/expand/writers.hpp"
#include "model/btcpp/names.hpp"
#include "model/btcpp/script/script.hpp"

namespace btcheck::btcpp {
namespace {

struct Mention {
  BtcppPlace place;
  std::string written;  // the name as it stands there
};

struct Entry {
  std::optional<PortType> type;  // of the port that is created first
  BtcppPlace type_place;
  bool may_be_written = false;
  std::vector<Mention> mentions;      // in the order of the tree
  std::vector<Mention> script_reads;  // and of these, what needs a value
};

class Blackboard {
 public:
  Blackboard(const BtcppExpansion& expansion, FileFindings& findings)
      : expansion_(expansion), findings_(findings) {}

  void check() {
    gather();
    for (const auto& [name, entry] : entries_) {
      alike_[{name.subtree, folded_name(name.name)}].push_back(name);
    }
    for (const auto& [name, entry] : entries_) {
      report_undefined(name, entry);
      report_misspelt(name, entry);
    }
  }

 private:
  const BtcppDocument& document() const { return *expansion_.document; }

  void gather() {
    for (const BtcppInstance& instance : expansion_.nodes) {
      for (const auto& script : instance.node->conditions) {
        gather_script(instance, script);
      }
      if (instance.node->kind == BtcppKind::SubTree) {
        gather_outer_keys(instance);
        gather_literals(instance);
        continue;
      }
      for (const auto& port : instance.node->ports) {
        gather_port(instance, port);
      }
    }
  }

  // In version 4 a number gives its entry a type, before any node inside.
  void gather_literals(const BtcppInstance& instance) {
    for (std::uint32_t i = 1; i < expansion_.subtrees.size(); ++i) {
      if (instance.children.empty() ||
          expansion_.subtrees[i].first_node != instance.children.front()) {
        continue;
      }
      for (const auto& remapping : expansion_.subtrees[i].remappings) {
        if (!remapping.is_literal) continue;
        Entry& entry = entries_[{i, remapping.inner}];
        entry.may_be_written = true;
        if (document().release != BtcppRelease::V4) continue;
        entry.type = type_of_literal(remapping.outer);
        const BtcppAttribute* written =
            find_attribute(instance.node->ports, remapping.inner);
        entry.type_place =
            written != nullptr ? written->place : instance.node->place;
      }
    }
  }

  static PortType type_of_literal(const std::string& text) {
    const ScriptValue value = literal_value(text);
    if (!value.is_number()) return PortType::Any;
    return value.type == NumberType::Integer ? PortType::Int : PortType::Double;
  }

  Entry& mention(const BtcppInstance& instance, std::string_view name,
                 const BtcppPlace& place) {
    Entry& entry = entries_[entry_of(expansion_, instance.subtree, name)];
    entry.mentions.push_back({place, std::string(name)});
    return entry;
  }

  // A remapping mentions a key of the blackboard around the subtree.
  void gather_outer_keys(const BtcppInstance& instance) {
    for (const auto& port : instance.node->ports) {
      const auto key = remapped_key(document().release, port.name, port.value);
      if (key) mention(instance, *key, port.place);
    }
  }

  void gather_port(const BtcppInstance& instance, const BtcppAttribute& port) {
    const auto facts = facts_of(document(), *instance.node, port.name);
    if (facts && facts->type == PortType::Script) {
      gather_script(instance, port);
    }
    auto key = remapped_key(document().release, port.name, port.value);
    const bool points_at_it = key.has_value();
    if (!key && names_an_entry(*instance.node, port)) key = port.value;
    if (!key) return;
    Entry& entry = mention(instance, *key, port.place);
    entry.may_be_written |= !facts || facts->direction != BtcppDirection::Input;
    if (!points_at_it) return;
    check_type(entry, *key, facts.value_or(PortFacts{}).type, port);
  }

  // Ports that hold the name of an entry, without braces.
  static bool names_an_entry(const BtcppNode& node,
                             const BtcppAttribute& port) {
    return (node.id == "SetBlackboard" && port.name == "output_key") ||
           (node.id == "UnsetBlackboard" && port.name == "key");
  }

  // The first port that names an entry decides its type, or that it has none.
  void check_type(Entry& entry, std::string_view name, PortType type,
                  const BtcppAttribute& port) {
    if (type == PortType::Script) type = PortType::String;
    if (!entry.type) {
      entry.type = type;
      entry.type_place = port.place;
      return;
    }
    const bool is_free = *entry.type == PortType::Any ||
                         *entry.type == PortType::String ||
                         type == PortType::Any;
    if (is_free || *entry.type == type) return;
    findings_.error(
        port.place,
        {"BT1616",
         fmt::format("the entry `{}` has two types, {} and {}", name,
                     port_type_name(*entry.type), port_type_name(type)),
         fmt::format("{} here", port_type_name(type)),
         fmt::format("it is {} in line {}; use two entries",
                     port_type_name(*entry.type), entry.type_place.span.line)});
  }

  void gather_script(const BtcppInstance& instance,
                     const BtcppAttribute& script) {
    std::set<std::string> own;  // what this script has created itself
    const ScriptSyntax syntax = parse_script(script.value);
    if (!syntax.flaw.empty()) return;  // said elsewhere
    for (const ScriptName& use : syntax.names) {
      Entry& entry = mention(instance, use.name,
                             place_in(script, use.at, use.name.size()));
      if (use.use == ScriptUse::Create) {
        entry.may_be_written = true;
        own.insert(use.name);
      } else if (!own.contains(use.name)) {
        entry.script_reads.push_back(entry.mentions.back());
      }
    }
  }

  static bool is_capitals(std::string_view name) {
    return std::none_of(name.begin(), name.end(),
                        [](char c) { return c >= 'a' && c <= 'z'; });
  }

  void report_undefined(const EntryName& name, const Entry& entry) {
    if (entry.may_be_written || entry.script_reads.empty()) return;
    if (is_capitals(name.name)) return;
    const Mention& read = entry.script_reads.front();
    std::string help;
    if (entry.mentions.size() == 1) {
      help = did_you_mean(name.name, written_beside(name));
    }
    if (help.empty()) {
      help =
          "create it by `:=` first; no fault if the program around the tree "
          "sets it";
    }
    findings_.warning(
        read.place,
        {"BT1627", fmt::format("nothing in the tree writes `{}`", read.written),
         "this script needs its value", std::move(help)});
  }

  // The entries of the same blackboard that something writes. Both who asks
  // and what is shown is few: beyond that, none is looked for.
  std::vector<std::string> written_beside(const EntryName& name) {
    std::vector<std::string> written;
    if (--searches_left_ < 0) return written;
    for (auto at = entries_.lower_bound({name.subtree, ""});
         at != entries_.end() && at->first.subtree == name.subtree; ++at) {
      if (at->second.may_be_written) written.push_back(at->first.name);
    }
    return written;
  }

  void report_misspelt(const EntryName& name, const Entry& entry) {
    if (entry.mentions.size() != 1 || name.name.starts_with('_')) return;
    for (const EntryName& other :
         alike_.at({name.subtree, folded_name(name.name)})) {
      if (other == name) continue;
      // Of two that are mentioned once, the second is reported.
      const bool is_second = entries_.at(other).mentions.size() == 1;
      if (is_second && other > name) continue;
      return report_near(entry.mentions.front(), other.name);
    }
    if (entry.may_be_written || !entry.script_reads.empty()) return;
    for (const std::string& other : written_beside(name)) {
      if (!is_one_slip(name.name, other)) continue;
      return report_near(entry.mentions.front(), other);
    }
  }

  void report_near(const Mention& mention, std::string_view other) {
    findings_.warning(
        mention.place,
        {"BT1628",
         fmt::format("`{}` and `{}` are two entries", mention.written, other),
         "this one is named nowhere else",
         fmt::format("did you mean `{}`?", other)});
  }

  const BtcppExpansion& expansion_;
  FileFindings& findings_;
  std::map<EntryName, Entry> entries_;
  std::map<std::pair<std::uint32_t, std::string>, std::vector<EntryName>>
      alike_;  // by subtree and folded name
  int searches_left_ = 200;
};

}  // namespace

void check_blackboard(const BtcppExpansion& expansion, FileFindings& findings) {
  Blackboard(expansion, findings).check();
}

}  // namespace btcheck::btcpp
