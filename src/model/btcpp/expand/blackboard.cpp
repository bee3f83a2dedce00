// SPDX-License-Identifier: MIT
//
// An entry that nothing in the tree writes is no error on the blackboard of the
// root: the program around the tree may set it before the first tick. It cannot
// on that of a subtree. A name in capitals, like RED, is taken for a registered
// enumeration.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "model/btcpp/attributes.hpp"
#include "model/btcpp/expand/checks.hpp"
#include "model/btcpp/expand/entry_uses.hpp"
#include "model/btcpp/expand/writers.hpp"
#include "model/btcpp/known_types.hpp"
#include "model/tree/releases.hpp"
#include "text/budget.hpp"

namespace btcheck::btcpp {
namespace {

// Of each entry the type of the port that is created first, as a release has
// it; and what it refuses of the others.
class EntryTypes {
 public:
  // A port whose type is not that of its entry.
  struct Conflict {
    const BtcppAttribute* port = nullptr;
    bool is_told_by_model = false;  // one of the types is
    Finding finding;
  };

  EntryTypes(const BtcppExpansion& expansion, int engine)
      : expansion_(expansion), engine_(engine) {}

  std::vector<Conflict> conflicts() {
    for (const BtcppInstance& instance : expansion_.nodes) {
      ask_budget();
      if (instance.node->kind == BtcppKind::SubTree) {
        if (!releases::kPassesTexts.has(engine_)) take_literals(instance);
        continue;
      }
      for (const auto& port : instance.node->ports) check(instance, port);
    }
    return std::move(conflicts_);
  }

 private:
  struct Type {
    PortType type = PortType::Any;
    BtcppPlace place;
    bool is_of_model = false;  // as a <TreeNodesModel> has it
  };

  const BtcppDocument& document() const { return *expansion_.document; }

  // From 4.9.1 on a number gives its entry a type, before any node inside.
  void take_literals(const BtcppInstance& instance) {
    if (instance.children.empty()) return;
    const std::uint32_t inside =
        expansion_.nodes[instance.children.front()].subtree;
    for (const auto& remapping : expansion_.subtrees[inside].remappings) {
      if (!remapping.is_literal) continue;
      const BtcppAttribute* written =
          find_attribute(instance.node->ports, remapping.inner);
      types_[{inside, remapping.inner}] = {
          type_of_literal(remapping.outer),
          written != nullptr ? written->place : instance.node->place};
    }
  }

  static PortType type_of_literal(const std::string& text) {
    const ScriptValue value = literal_value(text);
    if (!value.is_number()) return PortType::Any;
    return value.type == NumberType::Integer ? PortType::Int : PortType::Double;
  }

  // The first port that names an entry decides its type, or that it has none.
  void check(const BtcppInstance& instance, const BtcppAttribute& port) {
    const auto key = remapped_key(engine_, port.name, port.value);
    if (!key) return;
    const auto facts = facts_of(document(), *instance.node, port.name);
    PortType type = facts.value_or(PortFacts{}).type;
    if (type == PortType::Script) type = PortType::String;
    const auto [found, is_new] =
        types_.try_emplace(entry_of(expansion_, instance.subtree, *key),
                           Type{type, port.place, is_of_model(*instance.node)});
    const Type& before = found->second;
    const bool keeps_texts = releases::kTextsAreNoOtherType.has(engine_);
    const bool is_free = before.type == PortType::Any ||
                         (before.type == PortType::String && !keeps_texts) ||
                         type == PortType::Any;
    // What reads a text is given what the text says; what writes one throws.
    const bool writes_text = before.type == PortType::String &&
                             type != PortType::Any && facts &&
                             facts->direction == BtcppDirection::Output;
    if (is_new || before.type == type || (is_free && !writes_text)) return;
    const bool is_told_by_model =
        before.is_of_model || is_of_model(*instance.node);
    Finding finding{
        "BT1616",
        is_free
            ? fmt::format("the entry `{}` is one of texts, and the port "
                          "`{}` of {} writes {}",
                          *key, port.name, instance.node->id,
                          port_type_name(type))
            : fmt::format("the entry `{}` has two types, {} and {}", *key,
                          port_type_name(before.type), port_type_name(type)),
        fmt::format("{} here", port_type_name(type)),
        fmt::format("it is {} in line {}; use two entries",
                    port_type_name(before.type), before.place.span.line)};
    if (is_told_by_model) {
      finding.help += fmt::format(
          ", or correct the model: BehaviorTree.CPP {} if the port has this "
          "type in C++",
          is_free ? "throws when it is written" : "refuses the tree");
    }
    conflicts_.push_back({&port, is_told_by_model, std::move(finding)});
  }

  bool is_of_model(const BtcppNode& node) const {
    return document().model(node.id) != nullptr &&
           builtin_type(document().release, node.id) == nullptr;
  }

  const BtcppExpansion& expansion_;
  int engine_;
  std::map<EntryName, Type> types_;
  std::vector<Conflict> conflicts_;
};

// The engine knows the types of the program, and reads no model: what only a
// model says is a warning.
void check_types(const BtcppExpansion& expansion, FileFindings& findings) {
  const int engine = expansion.document->engine();
  auto conflicts = EntryTypes(expansion, engine).conflicts();
  if (conflicts.empty()) return;
  std::map<int, std::set<const BtcppAttribute*>> known;
  const auto refused_by = [&](int release) -> const auto& {
    const auto [at, is_new] = known.try_emplace(release);
    if (is_new) {
      for (const auto& each : EntryTypes(expansion, release).conflicts()) {
        at->second.insert(each.port);
      }
    }
    return at->second;
  };
  for (auto& [port, is_told_by_model, finding] : conflicts) {
    const auto* const of = port;
    finding.refused_by = releases::those(
        engine, [&](int release) { return refused_by(release).contains(of); });
    finding.is_doubtful = is_told_by_model;
    if (is_told_by_model) {
      findings.warning(port->place, std::move(finding));
    } else {
      findings.error(port->place, std::move(finding));
    }
  }
}

class Blackboard {
 public:
  Blackboard(const BtcppExpansion& expansion, FileFindings& findings)
      : expansion_(expansion),
        findings_(findings),
        uses_(uses_of_entries(expansion)) {
    inside_.resize(expansion.subtrees.size());
    for (std::uint32_t s = 1; s < expansion.subtrees.size(); ++s) {
      inside_[expansion.subtrees[s].parent].push_back(s);
    }
    for (const std::string& name : expansion.given) {
      uses_.of[entry_of(expansion, 0, name)].has_other_writer = true;
    }
  }

  void check() {
    for (const auto& [name, entry] : uses_.of) {
      alike_[{name.subtree, folded_name(name.name)}].push_back(name);
    }
    for (const auto& [name, entry] : uses_.of) {
      ask_budget();
      if (report_misspelt(name, entry)) continue;
      if (is_never_passed(name, entry)) {
        report_not_passed(name, entry);
      } else if (const auto inside = written_inside(name, entry)) {
        report_not_passed_on(*inside, entry);
      } else if (is_undefined(name, entry)) {
        undefined_.push_back(*entry.needed);
      } else if (is_unread(entry)) {
        unread_names_.push_back(name);
      }
    }
    report_values_as_names();
    report_undefined();
    // What another was probably meant to be is not unread.
    for (const EntryName& name : unread_names_) {
      if (!meant_.contains(name)) unread_.push_back(*uses_.of.at(name).write);
    }
    report_unread();
  }

 private:
  const BtcppDocument& document() const { return *expansion_.document; }
  const BtcppNode& node_of(const EntryUse& use) const {
    return *expansion_.nodes[use.node].node;
  }
  std::string who(const EntryUse& use) const {
    const BtcppNode& node = node_of(use);
    return fmt::format("`{}`", node.name.empty() ? node.id : node.name);
  }

  static bool is_capitals(std::string_view name) {
    return std::ranges::none_of(name,
                                [](char c) { return c >= 'a' && c <= 'z'; });
  }

  bool is_never_written(const EntryUses& entry) const {
    return !entry.may_be_written() && !uses_.may_any_be_written;
  }
  // Something needs it, and has nothing.
  bool is_missing(const EntryName& name, const EntryUses& entry) const {
    return entry.read && is_never_written(entry) && !is_capitals(name.name);
  }
  // Only scripts write it, and nothing looks.
  static bool is_unread(const EntryUses& entry) {
    return entry.write && !entry.has_other_writer && !entry.may_be_read;
  }

  // The program around the tree fills the blackboard of the root alone. What
  // begins with `_` cannot be passed.
  bool is_never_passed(const EntryName& name, const EntryUses& entry) const {
    return name.subtree != 0 && is_missing(name, entry) &&
           is_port_name(name.name);
  }

  void report_not_passed(const EntryName& name, const EntryUses& entry) {
    const BtcppSubtree& subtree = expansion_.subtrees[name.subtree];
    const BtcppNode& call = *expansion_.nodes[subtree.first_node - 1].node;
    const EntryUse& reader = *entry.read;
    const BtcppPlace& there = node_of(reader).place;
    const std::string line =
        there.file == call.place.file
            ? fmt::format("line {}", there.span.line)
            : fmt::format("{}, line {}",
                          expansion_.document->files[there.file].name,
                          there.span.line);
    findings_.warning(
        call.place,
        {"BT1644",
         fmt::format("`{}` is not passed to `{}`", name.name, call.id),
         fmt::format("{} ({}) reads it there, and nothing inside writes it",
                     who(reader), line),
         advice_to_pass(name, call), repairs_to_pass(name, call)});
  }

  // What no one would call an entry.
  static bool looks_like_value(const std::string& text) {
    const bool is_name = is_port_name(text) || text.starts_with('_');
    return !is_name || parse_bool(text);
  }

  // Where the SubTree of version 3 is given what others are given: `{key}`, or
  // a value.
  void report_values_as_names() {
    for (const BtcppInstance& instance : expansion_.nodes) {
      const BtcppNode& call = *instance.node;
      const bool is_call = call.kind == BtcppKind::SubTree &&
                           passes_names(document(), call) &&
                           !instance.children.empty();
      if (!is_call || !told_calls_.insert(&call).second) continue;
      const auto inside = expansion_.nodes[instance.children[0]].subtree;
      std::vector<const BtcppAttribute*> values;
      for (const BtcppAttribute& port : call.ports) {
        if (is_value_as_name(port, inside)) values.push_back(&port);
      }
      if (!values.empty()) report_values_as_names(call, values);
    }
  }

  // Something inside uses it, and nothing around writes what it says.
  bool is_value_as_name(const BtcppAttribute& port,
                        std::uint32_t inside) const {
    if (!looks_like_value(port.value)) return false;
    const auto found = uses_.of.find(entry_of(expansion_, inside, port.name));
    if (found == uses_.of.end() || found->first.name != port.value) {
      return false;
    }
    const EntryUses& uses = found->second;
    return (uses.may_be_read || uses.write) && !uses.is_written_by_name &&
           !uses_.may_any_be_written;
  }

  void report_values_as_names(
      const BtcppNode& call, const std::vector<const BtcppAttribute*>& values) {
    const bool have_braces = std::ranges::all_of(values, [&](const auto* port) {
      return blackboard_key(document().engine(), port->value).has_value();
    });
    const BtcppAttribute& first = *values.front();
    std::string others;
    for (std::size_t i = 1; i < values.size(); ++i) {
      others += fmt::format("{}`{}`", i == 1 ? "; and so do " : ", ",
                            values[i]->name);
    }
    findings_.warning(
        first.place,
        {"BT1657",
         fmt::format("`{}` of `{}` names an entry `{}`, which nothing writes{}",
                     first.name, call.id, first.value, others),
         "a SubTree of version 3 is given names, without braces, and no values",
         have_braces
             ? fmt::format("write `{}=\"{}\"`, without braces", first.name,
                           key_in(first))
             : fmt::format("write `<SubTreePlus ID=\"{}\" …>`, which takes "
                           "values, and names in braces",
                           call.id),
         have_braces ? without_braces(call, values) : as_plus(call)});
  }

  std::string key_in(const BtcppAttribute& port) const {
    return std::string(
        blackboard_key(document().engine(), port.value).value_or(port.value));
  }
  std::vector<Repair> without_braces(
      const BtcppNode& call,
      const std::vector<const BtcppAttribute*>& values) const {
    Repair repair;
    for (const BtcppAttribute* port : values) {
      repair.emplace_back(
          SetAttribute{place_of(call.place), port->name, key_in(*port)});
    }
    return {repair};
  }
  // What was a name gets its braces.
  std::vector<Repair> as_plus(const BtcppNode& call) const {
    if (call.tag != "SubTree") return {};
    Repair repair = {
        ReplaceWord{place_of(call.place), call.tag, "SubTreePlus"}};
    for (const BtcppAttribute& port : call.ports) {
      if (looks_like_value(port.value)) continue;
      repair.emplace_back(SetAttribute{place_of(call.place), port.name,
                                       "{" + port.value + "}"});
    }
    return {repair};
  }

  // What a SubTree writes for itself, where the tree around it reads an entry
  // of the same name that nothing writes.
  std::optional<EntryName> written_inside(const EntryName& name,
                                          const EntryUses& entry) const {
    if (!is_missing(name, entry) || !is_port_name(name.name)) {
      return std::nullopt;
    }
    for (const std::uint32_t s : inside_[name.subtree]) {
      const auto found = uses_.of.find(EntryName{s, name.name});
      const bool is_unread = found != uses_.of.end() && found->second.write &&
                             !found->second.may_be_read;
      if (is_unread) return found->first;
    }
    return std::nullopt;
  }

  void report_not_passed_on(const EntryName& inside, const EntryUses& around) {
    const BtcppSubtree& subtree = expansion_.subtrees[inside.subtree];
    const BtcppNode& call = *expansion_.nodes[subtree.first_node - 1].node;
    const EntryUse& writer = *uses_.of.at(inside).write;
    findings_.warning(
        call.place,
        {"BT1644",
         fmt::format("`{}` is not passed to `{}`", inside.name, call.id),
         fmt::format("{} writes it there, and what {} reads here nothing "
                     "writes",
                     who(writer), who(*around.read)),
         advice_to_pass(inside, call), repairs_to_pass(inside, call)});
  }

  SourcePlace place_of(const BtcppPlace& place) const {
    return {expansion_.document->files[place.file].name, place.span.line,
            place.span.column};
  }

  // The value of the attribute that passes the key.
  std::string passed(const BtcppNode& call, const std::string& key) const {
    return passes_names(document(), call) ? key : "{" + key + "}";
  }

  std::string advice_to_pass(const EntryName& name,
                             const BtcppNode& call) const {
    const std::string key = key_to_pass(name);
    if (key.empty()) {
      return fmt::format("pass it, `{}=\"{}\"`, or write it inside", name.name,
                         passed(call, "…"));
    }
    return fmt::format("pass it: `{}=\"{}\"`", name.name, passed(call, key));
  }

  std::vector<Repair> repairs_to_pass(const EntryName& name,
                                      const BtcppNode& call) const {
    const std::string key = key_to_pass(name);
    if (key.empty()) return {};
    return {{SetAttribute{place_of(call.place), name.name, passed(call, key)}}};
  }

  // What another SubTree beside it passes under this name, or an entry of this
  // name around it, or one that is near.
  std::string key_to_pass(const EntryName& name) const {
    const std::uint32_t around = expansion_.subtrees[name.subtree].parent;
    for (const BtcppSubtree& other : expansion_.subtrees) {
      if (&other == &expansion_.subtrees[0] || other.parent != around) continue;
      for (const BtcppRemapping& each : other.remappings) {
        if (each.inner == name.name && !each.is_literal) return each.outer;
      }
    }
    const EntryName same = entry_of(expansion_, around, name.name);
    if (uses_.of.contains(same)) return name.name;
    std::vector<std::string> near;
    for (const std::string& each : written_in(around)) {
      if (is_similar(name.name, each)) near.push_back(each);
    }
    return near.empty() ? "" : near.front();
  }

  bool is_undefined(const EntryName& name, const EntryUses& entry) const {
    return entry.needed && is_missing(name, entry);
  }

  static std::vector<std::string> names_of(const std::vector<EntryUse>& uses) {
    std::vector<std::string> names;
    for (const EntryUse& use : uses) names.push_back(use.written);
    return names;
  }
  static const EntryUse& first_of(const std::vector<EntryUse>& uses) {
    const auto key = [](const EntryUse& use) { return use.node; };
    return *std::ranges::min_element(uses, {}, key);
  }

  void report_undefined() {
    if (undefined_.empty()) return;
    const std::size_t count = undefined_.size();
    findings_.note(
        first_of(undefined_).place,
        {"BT1627",
         count == 1
             ? fmt::format("nothing in the tree writes {}",
                           listed(names_of(undefined_)))
             : fmt::format("nothing in the tree writes {} entries that scripts "
                           "need: {}",
                           count, listed(names_of(undefined_))),
         count == 1 ? "this script needs its value" : "the first of them",
         fmt::format("no fault if your program sets {} before the first tick; "
                     "else create {} by `:=`",
                     count == 1 ? "it" : "them", count == 1 ? "it" : "them")});
  }

  void report_unread() {
    if (unread_.empty()) return;
    const std::size_t count = unread_.size();
    findings_.note(
        first_of(unread_).place,
        {"BT1645",
         fmt::format("nothing in the tree reads {}, which {} write{}",
                     listed(names_of(unread_)),
                     count == 1 ? who(unread_[0]) : "scripts",
                     count == 1 ? "s" : ""),
         "",
         fmt::format("no fault if your program or a rule reads {}; else delete "
                     "what writes {}",
                     count == 1 ? "it" : "them", count == 1 ? "it" : "them")});
  }

  // The entries of one blackboard that something writes.
  std::vector<std::string> written_in(std::uint32_t subtree) const {
    std::vector<std::string> written;
    for (auto at = uses_.of.lower_bound({subtree, ""});
         at != uses_.of.end() && at->first.subtree == subtree; ++at) {
      if (at->second.may_be_written()) written.push_back(at->first.name);
    }
    return written;
  }

  bool report_misspelt(const EntryName& name, const EntryUses& entry) {
    if (entry.mentions == 0 || name.name.starts_with('_')) return false;
    const auto other = meant_by(name, entry);
    if (other) {
      meant_.insert(*other);
      report_near(name, entry, *other);
    }
    return other.has_value();
  }

  std::optional<EntryName> meant_by(const EntryName& name,
                                    const EntryUses& entry) {
    if (entry.mentions == 1) {
      if (auto alike = alike_to(name)) return alike;
    }
    const bool is_missing_here = is_missing(name, entry);
    if (!is_missing_here && !is_unread(entry)) return std::nullopt;
    // Each search looks at the whole blackboard.
    if (--searches_left_ < 0) return std::nullopt;
    std::optional<EntryName> best;
    std::size_t least = 0;
    for (auto at = uses_.of.lower_bound({name.subtree, ""});
         at != uses_.of.end() && at->first.subtree == name.subtree; ++at) {
      const auto& [other, uses] = *at;
      if (other == name) continue;
      if (is_missing_here ? !may_be_meant(name, entry, other, uses)
                          : !may_be_read_instead(name, other, uses)) {
        continue;
      }
      const std::size_t distance = edit_distance(name.name, other.name);
      if (best && distance >= least) continue;
      best = other;
      least = distance;
    }
    return best;
  }

  // Of two that are mentioned once, the one that comes later is reported.
  std::optional<EntryName> alike_to(const EntryName& name) const {
    for (const EntryName& other :
         alike_.at({name.subtree, folded_name(name.name)})) {
      const bool is_once = uses_.of.at(other).mentions == 1;
      if (other != name && !(is_once && comes_later(other, name))) return other;
    }
    return std::nullopt;
  }

  bool comes_later(const EntryName& name, const EntryName& other) const {
    const BtcppPlace& one = uses_.of.at(name).first.place;
    const BtcppPlace& two = uses_.of.at(other).first.place;
    return std::tuple(one.file, one.span.line, one.span.column, name) >
           std::tuple(two.file, two.span.line, two.span.column, other);
  }

  // One that is written, for one that is not. One that is read as well has to
  // be nearer, unless no program can have written this one.
  bool may_be_meant(const EntryName& name, const EntryUses& entry,
                    const EntryName& other, const EntryUses& uses) const {
    if (!uses.may_be_written()) return false;
    // What it goes through, and what it has found: `masks`, `mask`.
    const bool is_of_one_node =
        entry.read && uses.write && entry.read->node == uses.write->node;
    if (is_of_one_node) return false;
    if (!uses.may_be_read) return is_similar(name.name, other.name);
    return (entry.mentions == 1 || name.subtree != 0) &&
           is_one_slip(name.name, other.name);
  }

  // One that is read, for one that scripts write and nothing reads. Where
  // nothing writes it, that is told there.
  static bool may_be_read_instead(const EntryName& name, const EntryName& other,
                                  const EntryUses& uses) {
    return uses.read && uses.may_be_written() &&
           is_similar(name.name, other.name);
  }

  void report_near(const EntryName& name, const EntryUses& entry,
                   const EntryName& other) {
    const EntryUses& meant = uses_.of.at(other);
    const bool is_read = is_missing(name, entry);
    const bool is_written = entry.write && !entry.may_be_read;
    const EntryUse& use = is_read      ? *entry.read
                          : is_written ? *entry.write
                                       : entry.first;
    std::string message =
        fmt::format("`{}` and `{}` are two entries", use.written, other.name);
    std::string doing;
    if (is_read) {
      message = fmt::format("{} reads `{}`, which nothing writes", who(use),
                            use.written);
      if (meant.write)
        doing = fmt::format(", which {} writes", who(*meant.write));
    } else if (is_written) {
      message = fmt::format("{} writes `{}`, which nothing reads", who(use),
                            use.written);
      if (meant.read) doing = fmt::format(", which {} reads", who(*meant.read));
    }
    findings_.warning(use.place,
                      {"BT1628", std::move(message),
                       entry.mentions == 1 ? "named nowhere else" : "",
                       fmt::format("did you mean `{}`{}?", other.name, doing),
                       spelt_as(use, other.name)});
  }

  // The value of a port has braces, a name in a script none.
  std::vector<Repair> spelt_as(const EntryUse& use,
                               const std::string& meant) const {
    const SourcePlace place = place_of(use.place);
    return {{ReplaceWord{place, use.written, meant}},
            {ReplaceWord{place, "{" + use.written, "{" + meant}}};
  }

  const BtcppExpansion& expansion_;
  FileFindings& findings_;
  UsesOfEntries uses_;
  std::vector<std::vector<std::uint32_t>> inside_;  // by subtree: those in it
  std::map<std::pair<std::uint32_t, std::string>, std::vector<EntryName>>
      alike_;  // by subtree and folded name
  std::vector<EntryUse> undefined_;
  std::vector<EntryName> unread_names_;
  std::vector<EntryUse> unread_;
  std::set<EntryName> meant_;              // by those that are misspelt
  std::set<const BtcppNode*> told_calls_;  // one for all uses of its tree
  int searches_left_ = 200;
};

}  // namespace

void check_blackboard(const BtcppExpansion& expansion, FileFindings& findings) {
  check_types(expansion, findings);
  Blackboard(expansion, findings).check();
}

}  // namespace btcheck::btcpp
