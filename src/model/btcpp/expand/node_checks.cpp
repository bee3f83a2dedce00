// SPDX-License-Identifier: MIT
//
// BehaviorTree.CPP finds unknown ports, literals of the wrong type and broken
// scripts when it loads a tree; missing ports and wrong thresholds only when it
// ticks the node, which may be long after.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "model/btcpp/attributes.hpp"
#include "model/btcpp/enumerators.hpp"
#include "model/btcpp/expand/checks.hpp"
#include "model/btcpp/known_types.hpp"
#include "model/btcpp/script/script.hpp"
#include "model/tree/releases.hpp"

namespace btcheck::btcpp {
namespace {

// The names of all ports the node can have; nothing when they are not known.
std::optional<std::vector<std::string>> port_names(
    const BtcppDocument& document, const BtcppNode& node) {
  std::vector<std::string> names;
  if (const auto* type = builtin_type(document.release, node.id)) {
    for (const PortRow& row : type->ports) {
      if (row.in.has(document.engine())) names.emplace_back(row.name);
    }
    return names;
  }
  const BtcppModel* model = document.model(node.id);
  if (model == nullptr) return std::nullopt;
  for (const BtcppPort& port : model->ports) names.push_back(port.name);
  return names;
}

// Ports that models do not have. The engine takes them from the program, not
// from models; so that a model lacks them is one thing to say, however many
// they are.
class StaleModels {
 public:
  explicit StaleModels(const BtcppDocument& document) : document_(document) {}

  void add(const BtcppNode& node, const BtcppAttribute& port) {
    if (!told_.insert({node.id, port.name}).second) return;
    if (ports_.empty()) first_ = port.name_place;
    ports_.push_back(fmt::format("`{}` of `{}`", port.name, node.id));
    // One without any port says nothing of ports.
    says_something_ =
        says_something_ || !document_.model(node.id)->ports.empty();
  }

  void tell(FileFindings& findings) const {
    if (ports_.empty()) return;
    constexpr std::size_t kMostShown = 3;
    const std::size_t shown = std::min(ports_.size(), kMostShown);
    const bool is_one = ports_.size() == 1;
    const std::string list = fmt::format(
        "{}", fmt::join(ports_.begin(), ports_.begin() + shown, ", "));
    Finding finding{
        "BT1626",
        is_one ? fmt::format("no model has the port {}", list)
               : fmt::format("no model has {} of the ports that are used: {}{}",
                             ports_.size(), list,
                             shown < ports_.size() ? ", …" : ""),
        is_one ? "its model does not have it" : "the first of them",
        fmt::format("if the program provides {0}, add {0} to the model; "
                    "otherwise BehaviorTree.CPP refuses the tree",
                    is_one ? "it" : "them")};
    if (says_something_) {
      findings.warning(first_, std::move(finding));
    } else {
      findings.note(first_, std::move(finding));
    }
  }

 private:
  const BtcppDocument& document_;
  std::set<std::pair<std::string, std::string>> told_;  // node type and port
  std::vector<std::string> ports_;
  BtcppPlace first_;
  bool says_something_ = false;
};

class NodeCheck {
 public:
  NodeCheck(const BtcppDocument& document, const BtcppNode& node,
            StaleModels& models, FileFindings& findings)
      : document_(document),
        node_(node),
        models_(models),
        findings_(findings) {}

  void check() {
    for (const BtcppAttribute& script : node_.conditions) check_script(script);
    if (node_.kind == BtcppKind::SubTree) return;
    for (const BtcppAttribute& port : node_.ports) check_port(port);
    check_mandatory_ports();
    check_thresholds();
  }

 private:
  bool is_of_py_trees() const {
    return document_.release == BtcppRelease::PyTrees;
  }

  bool is_in(const Releases& releases) const {
    return releases.has(document_.engine());
  }

  void check_port(const BtcppAttribute& port) {
    const auto facts = facts_of(document_, node_, port.name);
    if (!facts) return check_unknown_port(port);
    if (points_at_entry(port, facts->type)) return check_set_key(port);
    if (facts->type == PortType::Script) return check_script(port);
    const bool is_output = facts->direction == BtcppDirection::Output;
    // Whatever way a port goes, the engine reads its literal as it loads; but
    // no status.
    if (is_output && (document_.release != BtcppRelease::V4 ||
                      facts->type == PortType::Status ||
                      is_literal_of(facts->type, port.value) ||
                      is_in(releases::kReadsLiteralsLate))) {
      // Older releases take the text for the name of the entry.
      if (document_.release == BtcppRelease::V4 &&
          !is_in(releases::kOutputsNameEntries)) {
        report_output_literal(port);
      }
      return;
    }
    if (is_literal_of(facts->type, port.value)) {
      return warn_of_rest(port, facts->type);
    }
    Finding finding{
        "BT1610",
        fmt::format("`{}` is not a value of the port `{}`", port.value,
                    port.name),
        fmt::format("type {} is expected", port_type_name(facts->type)),
        is_of_py_trees() ? "write it as docs/pytrees.md has it"
        : is_output      ? output_help(port.value)
                         : "for an entry of the blackboard, write its name in "
                           "braces"};
    // What a leaf of the program makes of it then, only the program knows;
    // these ports are as if they were not there.
    const bool has_default =
        port.name == "return_on_mismatch" || port.name == "then_skip";
    const bool is_read_late =
        is_in(releases::kReadsLiteralsLate) &&
        (has_default || known_type(document_.release, node_) == nullptr);
    if (is_read_late) {
      findings_.warning(port.place, std::move(finding));
    } else {
      findings_.error(port.place, std::move(finding));
    }
  }

  // The value of `output_key` is the name of the entry, not the entry; older
  // releases write the entry, but look first what it says.
  void check_set_key(const BtcppAttribute& port) {
    const KeyedEntry keyed = keyed_by(document_.release, node_.id);
    if (keyed != KeyedEntry::IsSet || port.name != "output_key") return;
    const std::string key(
        *remapped_key(document_.engine(), port.name, port.value));
    const bool writes_it = releases::copies_text(document_.engine());
    findings_.warning(
        port.place,
        {"BT1646",
         writes_it
             ? fmt::format("SetBlackboard reads `{}` before it writes it", key)
             : fmt::format(
                   "SetBlackboard writes the entry that `{}` names, not `{}`",
                   key, key),
         fmt::format("throws unless `{}` holds a text", key),
         fmt::format("write `output_key=\"{}\"`, without braces", key)});
  }

  // "3abc", "0x10", "1e3": of a number the engine reads what it begins with.
  void warn_of_rest(const BtcppAttribute& port, PortType type) {
    if (type != PortType::Int && type != PortType::Unsigned &&
        type != PortType::Double) {
      return;
    }
    const std::string_view rest = text_after_number(port.value, type);
    if (rest.empty()) return;
    const std::string_view number(port.value.data(),
                                  port.value.size() - rest.size());
    findings_.warning(
        port.place,
        {"BT1642", fmt::format("`{}` is read as {}", port.value, number),
         fmt::format("`{}` means nothing in a number of the port `{}`", rest,
                     port.name),
         fmt::format("write `{}`, or the number that is meant", number)});
  }

  // When it loads a tree, the engine takes a typed port for a literal if blanks
  // stand around the braces, or `=` without them.
  bool points_at_entry(const BtcppAttribute& port, PortType type) const {
    if (!remapped_key(document_.engine(), port.name, port.value)) return false;
    const bool is_strict =
        port.value.front() != ' ' && port.value.ends_with('}');
    return is_strict || document_.release == BtcppRelease::V3 ||
           is_literal_of(type, "");
  }

  void check_unknown_port(const BtcppAttribute& port) {
    const auto names = port_names(document_, node_);
    if (!names) return;
    Finding finding{"BT1609",
                    fmt::format("`{}` has no port `{}`", node_.id, port.name),
                    "unknown port",
                    did_you_mean(port.name, *names,
                                 names->empty() ? "it has none; delete it"
                                                : "it has " + listed(*names))};
    if (const auto* type = builtin_type(document_.release, node_.id)) {
      finding.refused_by =
          releases::those(document_.engine(), [&](int release) {
            return std::ranges::none_of(type->ports, [&](const PortRow& row) {
              return row.name == port.name && row.in.has(release);
            });
          });
      return findings_.error(port.name_place, std::move(finding));
    }
    const auto near = closest_match(port.name, *names);
    if (!near) return models_.add(node_, port);
    finding.code = "BT1626";
    finding.label = "its model does not have it";
    findings_.warning(port.name_place, std::move(finding));
  }

  void report_output_literal(const BtcppAttribute& port) {
    findings_.warning(
        port.place,
        {"BT1630",
         fmt::format("the output port `{}` points at no entry", port.name),
         "a value without braces", output_help(port.value)});
  }

  static std::string output_help(const std::string& value) {
    return value.empty() || !is_port_name(value)
               ? "write `{name}`, or delete the port"
               : fmt::format("write `{{{}}}`", value);
  }

  void check_script(const BtcppAttribute& script) {
    const ScriptSyntax syntax = parse_script(script.value, document_);
    if (syntax.flaw.empty()) return;
    Finding finding{
        "BT1615", fmt::format("the script of `{}` cannot be read", script.name),
        syntax.flaw,
        "scripts are expressions and assignments, `x := 1; y = x "
        "+ 1`; strings stand in single quotes"};
    finding.refused_by = releases::those(document_.engine(), [&](int release) {
      return !parse_script(script.value, release, enumerators_of(document_))
                  .flaw.empty();
    });
    findings_.error(place_in(script, syntax.flaw_at, 1), std::move(finding));
  }

  void check_mandatory_ports() {
    const NodeTypeRow* type = known_type(document_.release, node_);
    if (type == nullptr) return;
    for (const PortRow& row : type->ports) {
      if (row.need == Need::Optional || !row.in.has(document_.engine())) {
        continue;
      }
      if (find_attribute(node_.ports, row.name) != nullptr) continue;
      findings_.error(
          node_.place,
          {"BT1617", fmt::format("`{}` has no `{}`", node_.id, row.name),
           "this port is mandatory",
           is_of_py_trees()
               ? "write it as docs/pytrees.md has it"
               : "BehaviorTree.CPP says so only when it ticks the node"});
    }
  }

  void check_thresholds() {
    const auto count = static_cast<long long>(node_.children.size());
    const NodeTypeRow* type = builtin_type(document_.release, node_.id);
    if (type == nullptr) return;
    for (const PortRow& row : type->ports) {
      if (row.is_threshold) check_threshold(*type, row.name, count);
    }
  }

  void check_threshold(const NodeTypeRow& type, std::string_view name,
                       long long count) {
    const BtcppAttribute* port = find_attribute(node_.ports, name);
    if (port == nullptr || remapped_key(document_.engine(), name, port->value))
      return;
    const std::optional<long long> value = parse_integer(port->value);
    if (!value) return;
    const bool is_unsigned =
        releases::kThresholdsAreUnsigned.has(document_.engine());
    const bool wraps = releases::kThresholdsWrap.has(document_.engine()) &&
                       *value < -(count + 1);
    if (*value > count || (*value < 0 && is_unsigned) || wraps) {
      findings_.error(
          port->place,
          {"BT1618",
           fmt::format("`{}` is {}, with {} child{}", name, *value, count,
                       count == 1 ? "" : "ren"),
           wraps ? "that many are not there" : "there are fewer children",
           std::string("BehaviorTree.CPP stops with an exception when it ticks "
                       "the node; ") +
               (is_unsigned ? "from 3.8 on -1 stands for all"
                            : "-1 stands for all")});
    } else if (*value == 0 || *value < -count) {
      findings_.warning(
          port->place,
          {"BT1631", fmt::format("`{}` is {}", name, *value),
           type.type != NodeType::Parallel ? "the node always fails"
           : releases::parallel_counts_anew(document_.engine())
               ? "no number of children is that small: nothing comes of it"
               : "the node decides after its first child",
           "count from 1"});
    }
  }

  const BtcppDocument& document_;
  const BtcppNode& node_;
  StaleModels& models_;
  FileFindings& findings_;
};

}  // namespace

void check_nodes(const BtcppExpansion& expansion, FileFindings& findings) {
  StaleModels models(*expansion.document);
  std::set<const BtcppNode*> checked;
  for (const BtcppInstance& instance : expansion.nodes) {
    if (!checked.insert(instance.node).second) continue;
    NodeCheck(*expansion.document, *instance.node, models, findings).check();
  }
  models.tell(findings);
}

}  // namespace btcheck::btcpp
