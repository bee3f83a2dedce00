// SPDX-License-Identifier: MIT
//
// First all mentions of entries are gathered: by ports, whose direction comes
// from the engine or a model, and by scripts. An unknown port may write. Then
// each entry is judged.
//
// An entry that nothing in the tree writes is no error: the program around the
// tree may set it before the first tick. A name in capitals, like RED, is taken
// for a registered enumeration.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "model/btcpp/attributes.hpp"
#include "model/btcpp/expand/checks.hpp"
#include "model/btcpp/expand/writers.hpp"
#include "model/btcpp/known_types.hpp"
#include "model/btcpp/script/script.hpp"
#include "text/utf8.hpp"

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
  std::size_t mentions = 0;
  Mention first;                      // in the order of the tree
  std::optional<Mention> first_read;  // by a script that needs a value
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
    if (instance.children.empty()) return;
    const std::uint32_t inside =
        expansion_.nodes[instance.children.front()].subtree;
    for (const auto& remapping : expansion_.subtrees[inside].remappings) {
      if (!remapping.is_literal) continue;
      Entry& entry = entries_[{inside, remapping.inner}];
      entry.may_be_written = true;
      if (document().release != BtcppRelease::V4) continue;
      entry.type = type_of_literal(remapping.outer);
      const BtcppAttribute* written =
          find_attribute(instance.node->ports, remapping.inner);
      entry.type_place =
          written != nullptr ? written->place : instance.node->place;
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
    if (++entry.mentions == 1) entry.first = {place, std::string(name)};
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
      const BtcppPlace place = place_in(script, use.at, use.name.size());
      Entry& entry = mention(instance, use.name, place);
      if (use.use == ScriptUse::Create) {
        entry.may_be_written = true;
        own.insert(use.name);
      } else if (!own.contains(use.name) && !entry.first_read) {
        entry.first_read = {place, use.name};
      }
    }
  }

  static bool is_capitals(std::string_view name) {
    return std::ranges::none_of(name,
                                [](char c) { return c >= 'a' && c <= 'z'; });
  }

  void report_undefined(const EntryName& name, const Entry& entry) {
    if (entry.may_be_written || !entry.first_read) return;
    if (is_capitals(name.name)) return;
    std::vector<std::string> others;
    if (entry.mentions == 1) others = written_beside(name);
    findings_.warning(
        entry.first_read->place,
        {"BT1627",
         fmt::format("nothing in the tree writes `{}`",
                     entry.first_read->written),
         "this script needs its value",
         did_you_mean(name.name, others,
                      "create it by `:=` first; no fault if the program around "
                      "the tree sets it")});
  }

  // The entries of the same blackboard that something writes. Only so many
  // searches are made: each looks at the whole blackboard, and few findings are
  // shown anyway.
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
    if (entry.mentions != 1 || name.name.starts_with('_')) return;
    for (const EntryName& other :
         alike_.at({name.subtree, folded_name(name.name)})) {
      if (other == name) continue;
      // Of two that are mentioned once, the second is reported.
      const bool is_second = entries_.at(other).mentions == 1;
      if (is_second && other > name) continue;
      return report_near(entry.first, other.name);
    }
    if (entry.may_be_written || entry.first_read) return;
    for (const std::string& other : written_beside(name)) {
      if (!is_one_slip(name.name, other)) continue;
      return report_near(entry.first, other);
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

constexpr std::size_t kShortest = 5;

// How many bytes two names have in common from their beginning.
std::size_t common_beginning(std::string_view left, std::string_view right) {
  const std::size_t end = std::min(left.size(), right.size());
  std::size_t length = 0;
  while (length < end && left[length] == right[length]) ++length;
  return length;
}

// `left` is not the shorter one, and they part at `at`.
bool is_mended_at(std::string_view left, std::string_view right,
                  std::size_t at) {
  const std::string_view rest = left.substr(at);
  const std::string_view other = right.substr(at);
  if (left.size() > right.size()) {
    return !is_digit(rest[0]) && rest.substr(1) == other &&
           !(rest == "s" && other.empty());
  }
  const bool is_swapped = rest.size() > 1 && rest[0] == other[1] &&
                          rest[1] == other[0] &&
                          rest.substr(2) == other.substr(2);
  const bool is_replaced = rest.substr(1) == other.substr(1) &&
                           !is_digit(rest[0]) && !is_digit(other[0]);
  return is_swapped || is_replaced;
}

}  // namespace

std::string folded_name(std::string_view name) {
  std::string letters;
  for (const char c : name) {
    if (c == '_' || c == '-') continue;
    letters += lowered(c);
  }
  return letters;
}

bool is_one_slip(std::string_view left, std::string_view right) {
  if (left.size() < right.size()) std::swap(left, right);
  if (right.size() < kShortest || left.size() > right.size() + 1) return false;
  const std::size_t at = common_beginning(left, right);
  return at < left.size() && is_mended_at(left, right, at);
}

void check_blackboard(const BtcppExpansion& expansion, FileFindings& findings) {
  Blackboard(expansion, findings).check();
}

}  // namespace btcheck::btcpp
