// SPDX-License-Identifier: MIT
#include "model/btcpp/tree/engine_tree.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "model/btcpp/findings.hpp"
#include "model/btcpp/literals.hpp"
#include "model/btcpp/tree/engine_types.hpp"
#include "model/btcpp/tree/leaf_contract.hpp"
#include "model/btcpp/tree/leaf_rules.hpp"
#include "model/btcpp/tree/node_scripts.hpp"
#include "model/tree/answers.hpp"
#include "model/tree/node_types.hpp"

namespace btcheck {
namespace {

// What a type of node decides by something that is not modelled: each way is
// allowed. "" for types that do exactly what their code says.
std::string_view left_open(const Node& node) {
  switch (node.type) {
    case NodeType::PersistentSequence:
      return "its index, which an entry holds, may be any in each tick";
    case NodeType::PauseResumeController:
      return "it may be asked to pause and to resume before each tick";
    case NodeType::WhenDue:
      return "its child may be due in each tick";
    case NodeType::PathLongerOnApproach:
      return "the path may have become longer in each tick";
    case NodeType::GoalUpdater:
      return "what it writes is not known";
    case NodeType::WhenUpdated:
      return "the entry may have been written before each tick";
    case NodeType::Loop:
      return node.repetitions == kOpenRounds
                 ? "its queue, which an entry holds, may be empty in each tick"
                 : "";
    case NodeType::Action:
      return node.id == "WasEntryUpdated"
                 ? "the entry may have been written before each tick"
                 : "";
    default:
      return "";
  }
}

class Conversion {
 public:
  Conversion(const BtcppExpansion& expansion, const EngineOptions& options)
      : expansion_(expansion),
        options_(options),
        findings_(*expansion.document),
        rules_(expansion, options.leaves),
        scripts_(expansion, rules_.scripts(), options.detail) {}

  Result<BehaviorTree> run() {
    Result<BehaviorTree> result;
    const std::vector<BtcppFile>& files = expansion_.document->files;
    tree_.file = files.at(0).name;
    for (std::size_t f = 1; f < files.size(); ++f) {
      tree_.included.push_back(files[f].name);
    }
    tree_.profile = options_.profile;
    tree_.variables = scripts_.variables();
    rules_.check_first_values(scripts_);
    add_root();
    for (std::uint32_t i = 0; i < expansion_.nodes.size(); ++i) add(i);
    tree_.programs = scripts_.take_programs();
    tree_.open_entries = scripts_.open_entries();
    for (const OpenEntry& entry : tree_.open_entries) tell_open(entry);
    for (const NeverTicked& found : never_ticked(tree_)) tell_dead(found);
    const bool is_valid = !findings_.has_error() && !rules_.has_error();
    if (is_valid) result.value = std::move(tree_);
    findings_.add(rules_.take());
    result.diagnostics = findings_.take();
    return result;
  }

 private:
  // BT1627 tells of entries that nothing writes.
  void tell_open(const OpenEntry& entry) {
    if (entry.reason == btcpp::kNothingWrites) return;
    findings_.note(
        {entry.included, entry.span},
        {"BT1640",
         fmt::format("`{}` is left open: {}", entry.name, entry.reason), "",
         entry.is_rough ? "every value is allowed; what is found is executed "
                          "with the real ones"
                        : "every value is allowed, at any time; a contract of "
                          "the leaf that writes it says more (--leaves)"});
  }

  void tell_dead(const NeverTicked& found) {
    const Node& node = tree_.node(found.node);
    findings_.warning({node.included, node.span},
                      {"BT1629", fmt::format("`{}` is never ticked", node.id),
                       found.why, "delete it, or mend what stands before it"});
  }

  // Once for each type.
  void tell_left_open(const Node& node) {
    const std::string_view what = left_open(node);
    if (what.empty() || !told_open_.insert(node.id).second) return;
    findings_.note(
        {node.included, node.span},
        {"BT1641", fmt::format("{} is not modelled exactly: {}", node.id, what),
         "", "every way is checked"});
  }

  void add_root() {
    Node root;
    root.type = NodeType::BehaviorTree;
    root.name = expansion_.subtrees.at(0).tree->id;
    root.id = root.name;
    root.span = expansion_.subtrees[0].tree->place.span;
    root.included = expansion_.subtrees[0].tree->place.file;
    root.children = {NodeId{1}};
    root.loop = options_.loops;
    root.wakes = options_.wakes;
    tree_.nodes.push_back(std::move(root));
    tree_.roots = {NodeId{0}};
  }

  void add(std::uint32_t instance) {
    const BtcppInstance& written = expansion_.nodes[instance];
    const BtcppNode& element = *written.node;
    Node node;
    node.type = btcpp::engine_type(element);
    node.id = element.id;
    node.name = element.name.empty() ? element.id : element.name;
    node.path = written.path;
    node.span = element.place.span;
    node.included = element.place.file;
    node.parent = NodeId{instance == 0 ? 0 : written.parent + 1};
    for (std::uint32_t child : written.children) {
      node.children.push_back(NodeId{child + 1});
    }
    if (element.kind != BtcppKind::SubTree) {
      for (const BtcppAttribute& port : element.ports) {
        node.arguments.push_back({port.name, port.value});
      }
    }
    for (std::size_t time = 0; time < kScriptTimes; ++time) {
      const BtcppAttribute* script =
          find_attribute(element.conditions, kBtcppConditionNames[time]);
      if (script != nullptr) {
        // The first four are conditions.
        node.scripts[time] =
            time < 4 ? scripts_.condition(written.subtree, script->value)
                     : scripts_.action(written.subtree, script->value);
      }
    }
    set_ports(written, node);
    tell_left_open(node);
    rules_.apply(instance, scripts_, node);
    tree_.nodes.push_back(std::move(node));
  }

  // A port's value: written, or the default of its model.
  std::optional<std::string> port(const BtcppNode& element,
                                  std::string_view name) const {
    if (const auto* written = find_attribute(element.ports, name)) {
      return written->value;
    }
    if (const BtcppModel* model = expansion_.document->model(element.id)) {
      if (const BtcppPort* declared = model->port(name)) {
        return declared->default_value;
      }
    }
    return std::nullopt;
  }

  const BtcppPlace& place_of(const BtcppNode& element,
                             std::string_view name) const {
    const auto* written = find_attribute(element.ports, name);
    return written != nullptr ? written->place : element.place;
  }

  // A whole number that is known before the run, or nothing.
  std::optional<int> number(const BtcppNode& element, std::string_view name,
                            int otherwise) const {
    const auto value = port(element, name);
    if (!value) return otherwise;
    const auto parsed = btcpp::parse_integer(*value);
    if (!parsed) return std::nullopt;
    return static_cast<int>(
        std::clamp<long long>(*parsed, -kAnyNumber, kAnyNumber));
  }

  int known_number(const BtcppNode& element, std::string_view name,
                   int otherwise) {
    const auto value = number(element, name, otherwise);
    if (value) return *value;
    findings_.error(
        place_of(element, name),
        {"BT1632",
         fmt::format("`{}` of {} is `{}`: it has to be a number here", name,
                     element.id, *port(element, name)),
         "",
         "what a blackboard entry holds is not known before the run; write "
         "the number"});
    return otherwise;
  }

  // Rounds are counted, or left open where the number is an entry.
  int rounds(const BtcppNode& element, std::string_view name) {
    const auto value = number(element, name, 1);
    if (!value) {
      findings_.note(place_of(element, name),
                     {"BT1633",
                      fmt::format("how often {} goes round is left open: `{}` "
                                  "is read while it runs",
                                  element.id, *port(element, name)),
                      "", "every number of rounds is checked"});
      return kOpenRounds;
    }
    return *value < 0 ? kEndlessRounds : *value;
  }

  // Whole ticks, at least one where there is any time at all.
  Duration ticks(const BtcppNode& element, std::string_view name,
                 double milliseconds) {
    const double ticks = std::ceil(milliseconds / options_.tick_ms - 1e-9);
    if (ticks > kMostTicks) {
      findings_.warning(
          place_of(element, name),
          {"BT1634",
           fmt::format("`{}` of {} is {:.0f} ticks of {} ms: taken as {}", name,
                       element.id, ticks, options_.tick_ms, kMostTicks),
           "", "a longer tick makes it fewer: --tick-ms"});
    }
    const int whole = static_cast<int>(std::min<double>(ticks, kMostTicks));
    return {whole, whole};
  }

  Duration milliseconds(const BtcppNode& element, std::string_view name) {
    const auto value = port(element, name);
    const auto parsed = value ? btcpp::parse_number(*value) : std::nullopt;
    if (parsed) return ticks(element, name, *parsed);
    findings_.note(
        place_of(element, name),
        {"BT1635", fmt::format("how long {} takes is left open", element.id),
         "", "every number of ticks is checked"});
    return {0, kUnboundedTicks};
  }

  NodeStatus status(const BtcppNode& element, std::string_view name,
                    NodeStatus otherwise) const {
    const auto value = port(element, name);
    if (!value) return otherwise;
    if (*value == "SUCCESS") return NodeStatus::Success;
    if (*value == "FAILURE") return NodeStatus::Failure;
    if (*value == "RUNNING") return NodeStatus::Running;
    if (*value == "SKIPPED") return NodeStatus::Skipped;
    return otherwise;
  }

  bool flag(const BtcppNode& element, std::string_view name,
            bool otherwise) const {
    const auto value = port(element, name);
    return value ? btcpp::parse_bool(*value).value_or(otherwise) : otherwise;
  }

  void set_ports(const BtcppInstance& written, Node& node) {
    const BtcppNode& element = *written.node;
    const bool is_3 = is_release_3(options_.profile);
    switch (node.type) {
      case NodeType::Parallel: {
        const std::string_view successes =
            is_3 ? "success_threshold" : "success_count";
        node.threshold = known_number(element, successes, -1);
        node.counts_skipped = node.threshold < 0;
        node.failure_threshold = known_number(
            element, is_3 ? "failure_threshold" : "failure_count", 1);
        break;
      }
      case NodeType::ParallelAll:
        node.failure_threshold = known_number(element, "max_failures", 1);
        break;
      case NodeType::Repeat:
        node.repetitions = rounds(element, "num_cycles");
        break;
      case NodeType::RetryUntilSuccessful:
        node.repetitions = rounds(element, "num_attempts");
        break;
      case NodeType::Recovery: {
        // Read into an unsigned number: what does not fit is silently 1.
        const int retries = known_number(element, "number_of_retries", 1);
        node.repetitions = retries < 0 ? 1 : retries;
        break;
      }
      case NodeType::RoundRobin:
        node.option = options_.profile != Profile::Nav2Main ||
                      flag(element, "wrap_around", false);
        break;
      case NodeType::RunOnce:
        node.option = flag(element, "then_skip", true);
        break;
      case NodeType::TryCatch:
        node.option = flag(element, "catch_on_halt", false);
        break;
      case NodeType::Timeout:
      case NodeType::Wait:
        node.duration = milliseconds(element, "msec");
        break;
      case NodeType::Delay:
        node.duration = milliseconds(element, "delay_msec");
        break;
      case NodeType::RateController:
        node.duration = period(element);
        break;
      case NodeType::WhenDue:
        node.contract.may_fail = element.id == "DistanceController";
        break;
      case NodeType::WhenUpdated:
        node.otherwise = element.id == "SkipUnlessUpdated"
                             ? NodeStatus::Skipped
                             : NodeStatus::Running;
        break;
      case NodeType::Loop:
        set_loop(element, node);
        break;
      case NodeType::Precondition:
        node.otherwise = status(element, "else", NodeStatus::Failure);
        node.own_scripts = {scripts_.condition(
            written.subtree, port(element, "if").value_or(""))};
        break;
      case NodeType::BlackboardCheck:
        node.otherwise =
            status(element, "return_on_mismatch", NodeStatus::Failure);
        node.own_scripts = {
            scripts_.equality(written.subtree, comparison_of(element.id),
                              port(element, "value_A").value_or(""),
                              port(element, "value_B").value_or(""))};
        break;
      case NodeType::Switch:
        for (std::size_t i = 1; i < element.children.size(); ++i) {
          node.own_scripts.push_back(scripts_.equality(
              written.subtree,
              is_3 ? btcpp::PortComparison::Text
                   : btcpp::PortComparison::Switch,
              port(element, "variable").value_or(""),
              port(element, fmt::format("case_{}", i)).value_or("")));
        }
        break;
      case NodeType::Script:
        set_script(written, node);
        break;
      case NodeType::Action:
      case NodeType::Condition:
        node.contract = btcpp::leaf_contract(
            is_3 ? BtcppRelease::V3 : BtcppRelease::V4, element);
        break;
      default:
        break;
    }
  }

  static btcpp::PortComparison comparison_of(std::string_view check) {
    if (check == "BlackboardCheckInt") return btcpp::PortComparison::Int;
    if (check == "BlackboardCheckDouble") return btcpp::PortComparison::Double;
    if (check == "BlackboardCheckBool") return btcpp::PortComparison::Bool;
    return btcpp::PortComparison::Text;
  }

  Duration period(const BtcppNode& element) {
    const auto value = port(element, "hz");
    const auto hz = value ? btcpp::parse_number(*value) : std::optional(10.0);
    if (hz && *hz > 0) {
      const Duration whole = ticks(element, "hz", 1000.0 / *hz);
      return {std::max(1, whole.min), std::max(1, whole.max)};
    }
    findings_.note(
        place_of(element, "hz"),
        {"BT1635", fmt::format("how often {} ticks is left open", element.id),
         "", "every number of ticks is checked"});
    return {0, kUnboundedTicks};
  }

  // "1;2;3" has three elements; a queue in an entry any number.
  void set_loop(const BtcppNode& element, Node& node) {
    node.otherwise = status(element, "if_empty", NodeStatus::Success);
    const std::string queue = port(element, "queue").value_or("");
    if (queue.starts_with("{") || queue.starts_with("json:")) {
      node.repetitions = kOpenRounds;
      return;
    }
    node.repetitions =
        queue.empty()
            ? 0
            : static_cast<int>(std::count(queue.begin(), queue.end(), ';') + 1);
  }

  void set_script(const BtcppInstance& written, Node& node) {
    const BtcppNode& element = *written.node;
    const std::string code = port(element, "code").value_or("");
    if (element.id == "SetBlackboard") {
      node.own_scripts = {scripts_.set_blackboard(written)};
    } else if (element.id == "UnsetBlackboard") {
      node.own_scripts = {scripts_.unset_blackboard(written)};
    } else if (element.id == "ScriptCondition") {
      node.answers_value = true;
      node.own_scripts = {scripts_.condition(written.subtree, code)};
    } else {
      node.own_scripts = {scripts_.action(written.subtree, code)};
    }
  }

  static constexpr int kMostTicks = 1000;

  const BtcppExpansion& expansion_;
  const EngineOptions& options_;
  btcpp::FileFindings findings_;
  btcpp::LeafRules rules_;
  btcpp::NodeScripts scripts_;
  std::set<std::string> told_open_;
  BehaviorTree tree_;
};

}  // namespace

Result<BehaviorTree> engine_tree(const BtcppExpansion& expansion,
                                 const EngineOptions& options) {
  return Conversion(expansion, options).run();
}

}  // namespace btcheck
