// SPDX-License-Identifier: MIT
#include "model/btcpp/tree/engine_tree.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "model/btcpp/attributes.hpp"
#include "model/btcpp/findings.hpp"
#include "model/btcpp/known_types.hpp"
#include "model/btcpp/tree/entry_uses.hpp"
#include "model/btcpp/tree/leaf_rules.hpp"
#include "model/btcpp/tree/node_scripts.hpp"
#include "model/tree/answers.hpp"
#include "model/tree/granted.hpp"
#include "model/tree/releases.hpp"
#include "text/budget.hpp"
#include "text/choice.hpp"
#include "text/numbers.hpp"

namespace btcheck {
namespace btcpp {
namespace {

// ControllerSelector and its like fail only where nothing has been selected and
// no default is written
// (nav2_behavior_tree/plugins/action/*_selector_node.cpp).
bool has_literal_default(const BtcppNode& leaf) {
  if (!leaf.id.ends_with("Selector")) return false;
  for (const BtcppAttribute& port : leaf.ports) {
    if (port.name.starts_with("default_")) {
      return !port.value.empty() && port.value[0] != '{';
    }
  }
  return false;
}

// A leaf of the user's program is an action that may run, and whose result may
// stand until it is reset, or a condition that answers anew on every tick.
LeafContract leaf_contract(BtcppRelease release, const BtcppNode& leaf) {
  LeafContract contract;
  if (const NodeTypeRow* row = known_type(release, leaf)) {
    const LeafAnswers& answers = row->answers;
    contract.may_succeed = answers.may_succeed;
    contract.may_fail = answers.may_fail && !has_literal_default(leaf);
    contract.may_run = answers.may_run;
    contract.memory = answers.memory;
  } else {
    contract.may_run = leaf.kind == BtcppKind::Action;
    const bool may_keep = contract.may_run && release != BtcppRelease::PyTrees;
    contract.memory = may_keep ? LeafMemory::Unknown : LeafMemory::None;
  }
  return contract;
}

class Conversion final : PortReader {
 public:
  Conversion(const BtcppExpansion& expansion, const EngineOptions& options)
      : expansion_(expansion),
        options_(options),
        findings_(expansion.document->files),
        rules_(expansion, options.leaves),
        scripts_(expansion, rules_.scripts(), options.detail) {}

  Result<BehaviorTree> run() {
    Result<BehaviorTree> result;
    const std::vector<InputFile>& files = expansion_.document->files;
    tree_.file = files.at(0).name;
    for (std::size_t f = 1; f < files.size(); ++f) {
      tree_.included.push_back(files[f].name);
    }
    tree_.profile = options_.profile;
    tree_.variables = scripts_.variables();
    rules_.check_declared(scripts_);
    add_root();
    for (std::uint32_t i = 0; i < expansion_.nodes.size(); ++i) {
      ask_budget();
      add(i);
    }
    note_entry_uses(expansion_, scripts_.entries(), tree_);
    tree_.programs = scripts_.programs();
    tree_.open_entries = scripts_.open_entries();
    tell_open_entries();
    for (const NeverTicked& found : never_ticked(tree_)) tell_dead(found);
    if (is_in(releases::kTellsFewHalts)) refuse_halts();
    if (is_in(releases::kSkipsOtherwise)) refuse_skipped();
    const bool is_valid = !findings_.has_error() && !rules_.has_error();
    if (is_valid) result.value = std::move(tree_);
    findings_.add(rules_.take());
    result.diagnostics = findings_.take();
    return result;
  }

 private:
  void refuse(const BtcppPlace& place, Wording finding) override {
    findings_.error(place, std::move(finding));
  }

  void refuse_unmodelled(std::string_view port, std::string message) override {
    refuse_unmodelled(place_of(port), std::move(message));
  }

  void refuse_unmodelled(const BtcppPlace& place, std::string message) {
    findings_.error(place,
                    {"BT1655", std::move(message),
                     fmt::format("what {} does then is not modelled",
                                 profile_name(options_.profile)),
                     fmt::format("check it as a newer release runs it, by {}",
                                 word(Choice::Profile, "btcpp-4.3"))});
  }

  void refuse_halts() {
    for (const BtcppInstance& each : expansion_.nodes) {
      const auto* halted = find_attribute(each.node->conditions, "_onHalted");
      if (halted == nullptr) continue;
      return refuse_unmodelled(halted->name_place,
                               "a postcondition of a node that is halted");
    }
  }

  void refuse_skipped() {
    const std::vector<Answers> answers = possible_answers(tree_);
    for (std::size_t i = 0; i < expansion_.nodes.size(); ++i) {
      // The deepest: its parents are skipped because it is.
      const auto& children = expansion_.nodes[i].children;
      const bool is_first = std::ranges::none_of(
          children,
          [&](std::uint32_t child) { return answers[child + 1].skipped; });
      if (!answers[i + 1].skipped || !is_first) continue;
      const BtcppNode& node = *expansion_.nodes[i].node;
      return refuse_unmodelled(
          node.place, fmt::format("`{}` may be skipped",
                                  node.name.empty() ? node.id : node.name));
    }
  }

  // Once for each reason. For entries that nothing writes, there is BT1627.
  void tell_open_entries() {
    std::vector<const OpenEntry*> firsts;
    for (const OpenEntry& entry : tree_.open_entries) {
      const bool is_told = std::ranges::any_of(firsts, [&](const auto* first) {
        return first->reason == entry.reason;
      });
      if (is_told || entry.reason == kNothingWrites ||
          entry.reason == kNothingCreates) {
        continue;
      }
      firsts.push_back(&entry);
    }
    for (const OpenEntry* first : firsts) tell_open(*first);
  }

  void tell_open(const OpenEntry& first) {
    std::vector<std::string> names;
    for (const OpenEntry& entry : tree_.open_entries) {
      if (entry.reason == first.reason) names.push_back(entry.name);
    }
    findings_.note(
        {first.included, first.span},
        {"BT1640",
         fmt::format("{} {} left open: {}", listed(names),
                     names.size() == 1 ? "is" : "are", first.reason),
         "",
         first.reason.ends_with(kMayBeEnumerator)
             ? fmt::format(
                   "what rests on it is undecided; declare it as it is "
                   "registered: `enums = {{ RED = 1 }}` in btcheck.toml, "
                   "`(defenum RED 1)` in a file for {}, or `<ScriptingEnum "
                   "name=\"RED\" value=\"1\"/>` in a TreeNodesModel",
                   word(Choice::Leaves))
         : first.is_rough
             ? "every value is allowed; a run that is found is "
               "executed again with real values"
             : fmt::format("every value is allowed, at any time; a model that "
                           "says which way a port goes, or a contract of the "
                           "leaf, says more ({}, {})",
                           word(Choice::Models), word(Choice::Leaves))});
  }

  void tell_dead(const NeverTicked& found) {
    const Node& node = tree_.node(found.node);
    findings_.warning({node.included, node.span},
                      {"BT1629", fmt::format("`{}` is never ticked", node.id),
                       found.why, "delete it, or mend what stands before it"});
  }

  // Once for each type.
  void leave_open(std::string_view why) override {
    const std::string& type = element().id;
    if (!told_open_.insert(type).second) return;
    findings_.note(
        element().place,
        {"BT1641", fmt::format("{} is not modelled exactly: {}", type, why), "",
         "every way is checked"});
  }

  void add_root() {
    Node root;
    root.type = NodeType::BehaviorTree;
    root.name = expansion_.subtrees.at(0).tree->id;
    root.id = root.name;
    root.span = expansion_.subtrees[0].tree->place.span;
    root.included = expansion_.subtrees[0].tree->place.file;
    root.children = {NodeId{1}};
    root.loop = options_.loops || is_of_py_trees();
    root.wakes = options_.wakes && !is_of_py_trees();
    tree_.nodes.push_back(std::move(root));
    tree_.roots = {NodeId{0}};
  }

  void add(std::uint32_t instance) {
    at_ = &expansion_.nodes[instance];
    const BtcppNode& element = *at_->node;
    Node node;
    node.type = engine_type(expansion_.document->release, element);
    node.id = element.id;
    node.name = element.name.empty() ? element.id : element.name;
    node.path = at_->path;
    node.span = element.place.span;
    node.included = element.place.file;
    node.parent = NodeId{instance == 0 ? 0 : at_->parent + 1};
    for (std::uint32_t child : at_->children) {
      node.children.push_back(NodeId{child + 1});
    }
    if (element.kind != BtcppKind::SubTree) {
      for (const BtcppAttribute& port : element.ports) {
        node.arguments.push_back({port.name, port.value});
      }
    }
    for (std::size_t time = 0; time < kScriptTimes; ++time) {
      const BtcppAttribute* written =
          find_attribute(element.conditions, kBtcppConditionNames[time]);
      if (written != nullptr) {
        // The first four are conditions.
        node.scripts.emplace(
            static_cast<ScriptTime>(time),
            script(time < 4 ? ScriptRole::Condition : ScriptRole::Action,
                   written->value));
      }
    }
    node.is_guessed =
        element.children.empty() && !element.is_known && !element.is_explicit;
    set_ports(node);
    rules_.apply(instance, scripts_, node);
    scripts_.add_port_writes(instance, node.contract);
    rules_.check_ports(instance, scripts_);
    tree_.nodes.push_back(std::move(node));
  }

  Profile profile() const override { return options_.profile; }
  const BtcppNode& element() const override { return *at_->node; }
  bool is_of_py_trees() const {
    return expansion_.document->release == BtcppRelease::PyTrees;
  }
  const BtcppNode* first_child() const override {
    const auto& children = at_->children;
    return children.empty() ? nullptr : expansion_.nodes[children[0]].node;
  }

  Script script(ScriptRole role, std::string_view code) {
    return scripts_.script(role, at_->subtree, code);
  }

  Script condition(std::string_view port) override {
    return script(ScriptRole::Condition, text(port));
  }
  Script action(std::string_view port) override {
    return script(ScriptRole::Action, text(port));
  }
  Script set_blackboard() override { return scripts_.set_blackboard(*at_); }
  Script unset_blackboard() override { return scripts_.unset_blackboard(*at_); }

  std::optional<std::string> port(std::string_view name) const override {
    if (const auto* written = find_attribute(element().ports, name)) {
      return written->value;
    }
    if (const BtcppModel* model = expansion_.document->model(element().id)) {
      if (const BtcppPort* declared = model->port(name)) {
        return declared->default_value;
      }
    }
    return std::nullopt;
  }

  Script equality(PortComparison how, std::string_view one,
                  std::string_view other) override {
    return scripts_.equality(at_->subtree, how, text(one), text(other));
  }

  const BtcppPlace& place_of(std::string_view name) const {
    const auto* written = find_attribute(element().ports, name);
    return written != nullptr ? written->place : element().place;
  }

  // A whole number that is known before the run, or nothing.
  std::optional<int> number(std::string_view name, int otherwise) const {
    const auto value = port(name);
    if (!value) return otherwise;
    const auto parsed = parse_integer(*value);
    if (!parsed) return std::nullopt;
    return static_cast<int>(
        std::clamp<long long>(*parsed, -kAnyNumber, kAnyNumber));
  }

  int known_number(std::string_view name, int otherwise) override {
    const auto value = number(name, otherwise);
    if (value) return *value;
    findings_.error(
        place_of(name),
        {"BT1632",
         fmt::format("`{}` of {} is `{}`: it has to be a number here", name,
                     element().id, *port(name)),
         "",
         "what a blackboard entry holds is not known before the run; write "
         "the number"});
    return otherwise;
  }

  // Rounds are counted, or left open where the number is an entry.
  int rounds(std::string_view name) override {
    const auto value = number(name, 1);
    if (!value) {
      findings_.note(place_of(name),
                     {"BT1633",
                      fmt::format("how often {} goes round is left open: `{}` "
                                  "is read while it runs",
                                  element().id, *port(name)),
                      "", "every number of rounds is checked"});
      return kOpenRounds;
    }
    return *value < 0 ? kEndlessRounds : *value;
  }

  // Whole ticks, at least one where there is any time at all.
  Duration whole_ticks(std::string_view name, double milliseconds) {
    const double ticks = std::ceil(milliseconds / options_.tick_ms - 1e-9);
    if (ticks > kMostTicks) {
      findings_.note(
          place_of(name),
          {"BT1634",
           fmt::format("`{}` of {} is {:.0f} ticks of {} ms: taken as {}", name,
                       element().id, ticks, options_.tick_ms, kMostTicks),
           "",
           fmt::format("a longer tick makes it fewer: {}",
                       word(Choice::TickMs))});
    }
    const int whole = static_cast<int>(std::min<double>(ticks, kMostTicks));
    return {whole, whole};
  }

  Duration ticks(std::string_view name, double unit_ms) override {
    const auto value = port(name);
    const auto parsed = value ? as_number<double>(*value) : std::nullopt;
    if (parsed) return whole_ticks(name, std::max(0.0, *parsed * unit_ms));
    return open_ticks(name, "long", "takes");
  }

  // A literal was read before; what an entry holds may suit or not.
  void read_at_tick(Node& node, PortType type, std::string_view name) override {
    auto reading = scripts_.reading(at_->subtree, type, name, text(name));
    if (reading) node.readings.push_back(std::move(*reading));
  }

  Duration period(std::string_view name) override {
    const auto value = port(name);
    const auto hz = value ? as_number<double>(*value) : std::optional(10.0);
    if (!hz || !(*hz > 0)) return open_ticks(name, "often", "ticks");
    const int whole = std::max(1, whole_ticks(name, 1000.0 / *hz).min);
    return {whole, whole};
  }

  Duration open_ticks(std::string_view name, std::string_view how,
                      std::string_view does) {
    findings_.note(place_of(name), {"BT1635",
                                    fmt::format("how {} {} {} is left open",
                                                how, element().id, does),
                                    "", "every number of ticks is checked"});
    return {0, kUnboundedTicks};
  }

  void set_ports(Node& node) {
    if (node.type == NodeType::Action || node.type == NodeType::Condition) {
      node.contract = leaf_contract(expansion_.document->release, element());
    }
    const auto* row = engine_row(expansion_.document->release, element());
    if (row == nullptr) return;
    if (row->read != nullptr) row->read(*this, node);
    if (!row->left_open.empty()) leave_open(row->left_open);
  }

  static constexpr int kMostTicks = 1000;

  const BtcppExpansion& expansion_;
  const EngineOptions& options_;
  FileFindings findings_;
  LeafRules rules_;
  NodeScripts scripts_;
  std::set<std::string> told_open_;
  BehaviorTree tree_;
  const BtcppInstance* at_ = nullptr;  // the node that is converted
};

}  // namespace
}  // namespace btcpp

Result<BehaviorTree> engine_tree(const BtcppExpansion& expansion,
                                 const EngineOptions& options) {
  return btcpp::Conversion(expansion, options).run();
}

}  // namespace btcheck
