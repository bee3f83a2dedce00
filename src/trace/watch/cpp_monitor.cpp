// SPDX-License-Identifier: MIT
#include "trace/watch/cpp_monitor.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <string>

#include "btcheck/monitor.hpp"
#include "trace/run/shown_text.hpp"

namespace btcheck {
namespace {

constexpr std::string_view kAbout = R"text(//
//   {0}::Monitor monitor;
//   monitor.on_verdict = [](std::size_t rule, {0}::Verdict verdict) {{...}};
//   monitor.require_tree(nodes);          // once: is it the tree of the rules?
//   monitor.begin_tick();                 // before each tick of the tree
//   monitor.change(node, before, after);  // each change of a node's status
//   monitor.end_tick();                   // after it
//
// Nodes are numbered as the tree has them in pre-order, the tree itself is 0.
)text";

constexpr std::string_view kMonitor = R"text(
using core::RunningNode;
using core::Status;
using core::Verdict;
using core::WrongTree;

inline const core::Table& table_of_rules() {
  static const core::Table kTable = core::Table::read(kText);
  return kTable;
}

class Monitor : public core::Monitor {
 public:
  Monitor() : core::Monitor(table_of_rules()) {}

  // The nodes of the tree that runs, in pre-order: the first is number 1.
  // Throws WrongTree at the first that the tree of the rules does not have.
  static void require_tree(const std::vector<RunningNode>& nodes) {
    table_of_rules().require(nodes);
  }
  static std::size_t rule_count() { return table_of_rules().automata.size(); }
  static std::size_t node_count() { return table_of_rules().nodes.size(); }
  static const char* name(std::size_t rule) {
    return table_of_rules().automata[rule].name.c_str();
  }
  static const char* text(std::size_t rule) {
    return table_of_rules().automata[rule].text.c_str();
  }
  static const char* node_name(std::size_t node) {
    return table_of_rules().nodes[node].name.c_str();
  }
};

// For BehaviorTree.CPP 4 and 3.8: #include its headers first, and define
// BTCHECK_MONITOR_BTCPP. BtcppLogger logger(tree, monitor);
// logger.begin_tick(); tree.tickExactlyOnce(); logger.end_tick();
#ifdef BTCHECK_MONITOR_BTCPP
class BtcppLogger : public BT::StatusChangeLogger {
 public:
  // Throws WrongTree. The monitor must outlive it.
  BtcppLogger(const BT::Tree& tree, Monitor& monitor)
      : BT::StatusChangeLogger(tree.rootNode()), monitor_(monitor) {
    std::vector<RunningNode> nodes;
    std::map<const BT::TreeNode*, std::size_t> parents;
    BT::applyRecursiveVisitor(
        static_cast<const BT::TreeNode*>(tree.rootNode()),
        [&](const BT::TreeNode* node) {
          nodes.push_back(
              {parents[node], node->name(), node->registrationName()});
          const std::size_t number = nodes.size();
          numbers_[node] = number;
          if (auto* control = dynamic_cast<const BT::ControlNode*>(node)) {
            for (const auto* child : control->children()) {
              parents[child] = number;
            }
          }
          if (auto* above = dynamic_cast<const BT::DecoratorNode*>(node)) {
            parents[above->child()] = number;
          }
        });
    Monitor::require_tree(nodes);
  }
  // A tick that was begun is over, unless it has thrown.
  ~BtcppLogger() override {
    if (std::uncaught_exceptions() == thrown_) monitor_.end_tick();
  }

  void begin_tick(std::uint64_t units = 1) { monitor_.begin_tick(units); }
  void end_tick() { monitor_.end_tick(); }

  void callback(BT::Duration, const BT::TreeNode& node, BT::NodeStatus before,
                BT::NodeStatus after) override {
    const auto number = numbers_.find(&node);
    if (number == numbers_.end()) return;
    monitor_.change(number->second, static_cast<Status>(before),
                    static_cast<Status>(after));
  }
  void flush() override {}

 private:
  Monitor& monitor_;
  std::map<const BT::TreeNode*, std::size_t> numbers_;
  int thrown_ = std::uncaught_exceptions();
};
#endif
)text";

// A line as C++ has it, whatever its characters are.
std::string literal(std::string_view line) {
  std::string result = "    \"";
  for (const char c : line) {
    if (c == '"' || c == '\\') result += '\\';
    result += c;
  }
  return result + "\\n\"\n";
}

// "of_demo_for_drone3": the rules' file and the tree's, as a namespace.
std::string space_name(std::string_view rules, std::string_view tree) {
  const auto stem = [](std::string_view file) {
    return plain_word(std::filesystem::path(file).stem().string());
  };
  std::string name;
  for (const char c : "of_" + stem(rules) + "_for_" + stem(tree)) {
    if (c != '_' || !name.ends_with('_')) name += c;  // `__` is the compiler's
  }
  return name;
}

// What stands between two lines.
std::string_view between(std::string_view text, std::string_view first,
                         std::string_view last) {
  const std::size_t begin = text.find(first) + first.size();
  return text.substr(begin, text.find(last, begin) - begin);
}

}  // namespace

// Several in one program must not be taken for one another: each has a
// namespace that names its files and, within, one of its contents.
std::string cpp_monitor(std::string_view table, std::string_view space) {
  const monitor::Table read = monitor::Table::read(table);
  const std::string mark = fmt::format("m{:016x}", monitor::fingerprint(table));
  const std::string outer =
      space.empty() ? "btcheck_monitor" : std::string(space);
  const std::string named =
      space.empty() ? space_name(read.rules, read.tree) : mark + "_rules";
  std::string text = fmt::format(
      "// Monitors of the rules of {}, for the tree {}.\n"
      "// Generated by btcheck; docs/monitors.md tells how to use it.\n",
      read.rules, read.tree);
  text += fmt::format(kAbout, outer);
  text += fmt::format(
      "#ifndef BTCHECK_MONITOR_{0}\n#define BTCHECK_MONITOR_{0}\n", mark);
  text += between(kMonitorCore, "begins here.\n", "\nnamespace btcheck {");
  text += fmt::format(
      "#include <exception>\n#include <map>\n\nnamespace {} {{\n"
      "inline namespace {} {{\ninline namespace {} {{\nnamespace core {{\n",
      outer, named, mark);
  text +=
      between(kMonitorCore, "namespace monitor {\n", "}  // namespace monitor");
  text += "}  // namespace core\n\ninline constexpr char kText[] =\n";
  while (!table.empty()) {
    const std::size_t end = std::min(table.find('\n'), table.size() - 1);
    text += literal(table.substr(0, end));
    table.remove_prefix(end + 1);
  }
  text.insert(text.size() - 1, ";");
  text += kMonitor;
  return text + fmt::format(
                    "}}  // namespace {}\n}}  // namespace {}\n"
                    "}}  // namespace {}\n#endif\n",
                    mark, named, outer);
}

}  // namespace btcheck
