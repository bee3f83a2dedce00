// SPDX-License-Identifier: MIT
//
// The observer on nodes of every kind that the engine has, one case after
// another: what it says of rules, and that `btcheck trace` says the same of the
// log that it has written.
//
//     observer_kinds BTCHECK DIR
//
// DIR is where trees, rules, tables and logs go. Exit code 1 where something is
// not as expected; each such thing is told.
#include "btcheck/observer.hpp"
#include "scripted_leaves.hpp"

#include <atomic>
#include <chrono>
#include <cstdlib>
#include <functional>
#include <iostream>
#include <map>
#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace {

using BT::NodeStatus;
using std::chrono::milliseconds;

int failures = 0;

template <class Seen, class Wanted>
void expect(const std::string& what, const Seen& seen, const Wanted& wanted) {
  if (seen == wanted) return;
  ++failures;
  std::cout << "  " << what << " is " << seen << ", not " << wanted << "\n";
}

// --- Leaves ----------------------------------------------------------------

// Answers one after another, the last for ever.
class Stateful : public BT::StatefulActionNode {
 public:
  Stateful(const std::string& name, const Config& config)
      : BT::StatefulActionNode(name, config) {}
  static BT::PortsList providedPorts() { return {BT::InputPort<int>("runs")}; }

 private:
  NodeStatus onStart() override {
    left_ = getInput<int>("runs").value();
    return next();
  }
  NodeStatus onRunning() override { return next(); }
  void onHalted() override {}
  NodeStatus next() {
    return left_-- > 0 ? NodeStatus::RUNNING : NodeStatus::SUCCESS;
  }

  int left_ = 0;
};

// Release 3 has coroutines where Boost is installed only.
#if ENGINE_4
class Coroutine : public BT::CoroActionNode {
 public:
  Coroutine(const std::string& name, const Config& config)
      : BT::CoroActionNode(name, config) {}
  static BT::PortsList providedPorts() { return {BT::InputPort<int>("runs")}; }

 private:
  NodeStatus tick() override {
    for (int left = getInput<int>("runs").value(); left > 0; --left) {
      setStatusRunningAndYield();
    }
    return NodeStatus::SUCCESS;
  }
};
#else
class Coroutine : public Stateful {
 public:
  using Stateful::Stateful;
};
#endif

#if ENGINE_4
using AnyThreaded = BT::ThreadedAction;
#else
using AnyThreaded = BT::AsyncActionNode;
#endif
class Threaded : public AnyThreaded {
 public:
  Threaded(const std::string& name, const Config& config)
      : AnyThreaded(name, config) {}
  static BT::PortsList providedPorts() { return {}; }

 private:
  NodeStatus tick() override {
    std::this_thread::sleep_for(milliseconds(30));
    return NodeStatus::SUCCESS;
  }
};

// --- Cases -----------------------------------------------------------------

class Case {
 public:
  Case(std::string name, const std::string& tree, const std::string& rules)
      : file_((folder / name).string()), rules_(rules) {
    std::cout << name << "\n";
    const std::string format = ENGINE_4 ? "4" : "3";
    xml_ = "<root BTCPP_format=\"" + format +
           "\" main_tree_to_execute=\"Main\">\n" + tree + models() +
           "</root>\n";
    write(".xml", xml_);
    write(".ltl", rules);
    const std::string profile = ENGINE_4 ? "btcpp-4" : "btcpp-3.8";
    const std::string command = btcheck + " export " + file_ + ".xml --prop " +
                                file_ + ".ltl --profile " + profile +
                                " --to monitor > " + file_ + ".monitor 2> " +
                                file_ + ".complaints";
    expect("exit code of: " + command, std::system(command.c_str()), 0);
    table_ = btcheck::read_table(file_ + ".monitor");
    factory_.registerNodeType<Stateful>("Stateful");
    factory_.registerNodeType<Coroutine>("Coroutine");
    factory_.registerNodeType<Threaded>("Threaded");
    factory_.registerSimpleAction(
        "Do", [this](BT::TreeNode& node) { return act(node); });
  }

  // What a `Do` does.
  std::function<NodeStatus(BT::TreeNode&)> act = [](BT::TreeNode&) {
    return NodeStatus::SUCCESS;
  };

  BT::Tree tree() { return factory_.createTreeFromText(xml_); }
  BT::Tree tree(const std::string& xml) {
    return factory_.createTreeFromText(xml);
  }
  const std::string& xml() const { return xml_; }
  const std::string& table() const { return table_; }
  btcheck::ObserverOptions logged() const {
    btcheck::ObserverOptions options;
    options.log = file_ + ".btlog";
    return options;
  }

  // What the log says, once the observer is gone.
  void expect_same(const std::map<std::string, std::string>& verdicts) {
    const std::string command = btcheck + " trace " + file_ + ".btlog --prop " +
                                file_ + ".ltl > " + file_ + ".traced 2>&1";
    std::ignore = std::system(command.c_str());
    const std::string traced = text_of(file_ + ".traced");
    for (const auto& [rule, verdict] : verdicts) {
      const std::string word = verdict.substr(0, verdict.find(' '));
      const std::string line = word + std::string(11 - word.size(), ' ') + rule;
      const bool is_there =
          ("\n" + traced).find("\n" + line) != std::string::npos;
      expect("`btcheck trace` of " + rule + " (" + file_ + ".traced)",
             is_there ? word : "something else", word);
    }
  }

  static std::string btcheck;
  static fs::path folder;

 private:
  static std::string models() {
    return "<TreeNodesModel>\n<Action ID=\"Do\"/>\n"
           "<Action ID=\"Stateful\"><input_port name=\"runs\"/></Action>\n"
           "<Action ID=\"Coroutine\"><input_port name=\"runs\"/></Action>\n"
           "<Action ID=\"Threaded\"/>\n</TreeNodesModel>\n";
  }
  void write(const char* extension, const std::string& text) const {
    std::ofstream(file_ + extension) << text;
  }

  std::string file_;
  std::string rules_;
  std::string xml_;
  std::string table_;
  BT::BehaviorTreeFactory factory_;
};
std::string Case::btcheck;
fs::path Case::folder;

// "VIOLATED 3" of each rule, in which tick.
class Verdicts {
 public:
  explicit Verdicts(btcheck::Observer& observer) {
    for (std::size_t r = 0; r < observer.rule_count(); ++r) {
      told[observer.rule_name(r)] = "OPEN";
    }
    observer.call("*", [this](const btcheck::Decision& decided) {
      told[decided.name] =
          std::string(btcheck::monitor::verdict_name(decided.verdict)) + " " +
          std::to_string(decided.tick);
    });
  }
  void expect_all(const std::map<std::string, std::string>& wanted) const {
    for (const auto& [rule, verdict] : wanted) {
      const auto place = told.find(rule);
      expect(rule, place == told.end() ? "unknown" : place->second, verdict);
    }
  }

  std::map<std::string, std::string> told;
};

using Wanted = std::map<std::string, std::string>;

std::string main_tree(const std::string& inside) {
  return "<BehaviorTree ID=\"Main\">\n" + inside + "\n</BehaviorTree>\n";
}

// So many ticks, then what they say and what the log says.
void run(Case& one, int ticks, const Wanted& wanted,
         milliseconds between = milliseconds(0)) {
  std::map<std::string, std::string> told;
  {
    BT::Tree tree = one.tree();
    btcheck::Observer observer(tree, one.table(), one.logged());
    const Verdicts verdicts(observer);
    for (int t = 0; t < ticks; ++t) {
      try {
        tick(observer);
      } catch (const std::exception&) {
      }
      std::this_thread::sleep_for(between);
    }
    told = verdicts.told;
    verdicts.expect_all(wanted);
  }
  one.expect_same(told);
}

void simple_actions() {
  Case one("simple",
           main_tree("<Sequence name=\"s\"><Do name=\"a\"/></Sequence>"),
           "property running: never a.running\n"
           "property set: possible a.status == running\n"
           "property each: every tick: a.answered success\n"
           "property order: s.ticked precedes a.ticked\n"
           "property once: a.success forbids a.ticked within [0,0]\n"
           "property done: in no tick: root.answer == success\n");
  run(one, 3,
      {{"running", "OPEN"},
       {"set", "SATISFIED 1"},
       {"each", "OPEN"},
       {"order", "SATISFIED 1"},
       {"once", "OPEN"},
       {"done", "VIOLATED 1"}});
}

void stateful_actions() {
  Case one("stateful",
           main_tree("<Sequence name=\"s\"><Stateful name=\"a\" runs=\"3\"/>"
                     "<Do name=\"b\"/></Sequence>"),
           "property runs: possible a.running\n"
           "property soon: whenever b.success then a.running within 1 ticks\n"
           "property late: present a.success within 2 ticks\n"
           "property three: present a.success within 3 ticks\n"
           "property again: in no tick: a.answered running and previously "
           "a.answered running\n");
  run(one, 9,
      {{"runs", "SATISFIED 1"},
       {"soon", "OPEN"},
       {"late", "VIOLATED 3"},
       {"three", "SATISFIED 4"},
       {"again", "VIOLATED 2"}});
}

void coroutines() {
  Case one("coroutine",
           main_tree("<Sequence name=\"s\"><Coroutine name=\"c\" runs=\"2\"/>"
                     "</Sequence>"),
           "property runs: possible c.running\n"
           "property status: possible c.status == running\n"
           "property ends: present c.success within 2 ticks\n"
           "property early: present c.success within 1 ticks\n");
  run(one, 4,
      {{"runs", "SATISFIED 1"},
       {"status", "SATISFIED 1"},
       {"ends", "SATISFIED 3"},
       {"early", "VIOLATED 2"}});
}

void threaded_actions() {
  Case one("threaded",
           main_tree("<Sequence name=\"s\"><Threaded name=\"t\"/>"
                     "<Do name=\"b\"/></Sequence>"),
           "property status: possible t.status == running\n"
           "property fails: never t.failure\n"
           "property order: t.success precedes b.ticked\n"
           "property first: present t.success within 0 ticks\n");
  run(one, 30,
      {{"status", "SATISFIED 1"},
       {"fails", "OPEN"},
       {"order", "OPEN"},
       {"first", "VIOLATED 1"}},
      milliseconds(0));
  Case slow("threaded_slow",
            main_tree("<Sequence name=\"s\"><Threaded name=\"t\"/>"
                      "<Do name=\"b\"/></Sequence>"),
            "property succeeds: possible t.success\n"
            "property order: t.success precedes b.ticked\n"
            "property goes_on: possible b.success\n");
  BT::Tree tree = slow.tree();
  btcheck::Observer observer(tree, slow.table(), slow.logged());
  const Verdicts verdicts(observer);
  while (tick(observer) == NodeStatus::RUNNING) {
    std::this_thread::sleep_for(milliseconds(5));
  }
  expect("succeeds",
         observer.verdict("succeeds") == btcheck::monitor::Verdict::Satisfied,
         true);
  expect("order",
         observer.verdict("order") == btcheck::monitor::Verdict::Satisfied,
         true);
  expect("goes_on",
         observer.verdict("goes_on") == btcheck::monitor::Verdict::Satisfied,
         true);
}

void exceptions() {
  Case one("exception",
           main_tree("<Sequence name=\"s\"><Do name=\"a\"/><Do name=\"b\"/>"
                     "</Sequence>"),
           "property answers: whenever b.ticked then b.done within 0 ticks\n"
           "property later: whenever b.ticked then b.done within 1 ticks\n"
           "property inside: never b.active and tick.ends\n"
           "property three: in no tick: previously (a.answered success and "
           "b.answer == none)\n");
  int calls = 0;
  one.act = [&](BT::TreeNode& node) {
    if (node.name() == "b" && ++calls == 2)
      throw std::runtime_error("on purpose");
    return NodeStatus::SUCCESS;
  };
  run(one, 4,
      {{"answers", "VIOLATED 2"},
       {"later", "OPEN"},
       {"inside", "OPEN"},
       {"three", "OPEN"}});
}

void subtrees() {
#if ENGINE_4
  const std::string tree =
      main_tree(
          "<Sequence name=\"s\"><Script name=\"i\" code=\"x:=0\"/>"
          "<SubTree ID=\"Sub\" name=\"first\" p=\"{x}\"/>"
          "<SubTree ID=\"Sub\" name=\"second\" p=\"7\"/></Sequence>") +
      "<BehaviorTree ID=\"Sub\"><Sequence name=\"q\">"
      "<Script name=\"u\" code=\"p:=p+2; n:='go home'\"/>"
      "<Script name=\"v\" code=\"n:='there'\"/></Sequence></BehaviorTree>\n";
  Case one("subtrees", tree,
           "property grows: never x > 1\n"
           "property own: possible second_n == go_home\n"
           "property both: never first_n == there and second_n == there\n"
           "property unset: always first_n != there\n"
           "property early: possible first_n == go_home and second_n == unset\n"
           "property real: possible x == 2\n");
  run(one, 2,
      {{"grows", "VIOLATED 1"},
       {"own", "SATISFIED 1"},
       {"both", "VIOLATED 1"},
       {"unset", "VIOLATED 1"},
       {"early", "SATISFIED 1"},
       {"real", "SATISFIED 1"}});
#else
  const std::string tree =
      main_tree(
          "<Sequence name=\"s\">"
          "<SetBlackboard name=\"i\" output_key=\"x\" value=\"a\"/>"
          "<SubTree ID=\"Sub\" p=\"x\"/></Sequence>") +
      "<BehaviorTree ID=\"Sub\"><Sequence name=\"q\">"
      "<SetBlackboard name=\"u\" output_key=\"p\" value=\"b\"/>"
      "<SetBlackboard name=\"v\" output_key=\"n\" value=\"c\"/>"
      "</Sequence></BehaviorTree>\n";
  Case one("subtrees", tree,
           "property changes: always x != b\n"
           "property own: possible n == c\n"
           "property first: possible x == a and n == unset\n");
  run(one, 2,
      {{"changes", "VIOLATED 1"},
       {"own", "SATISFIED 1"},
       {"first", "SATISFIED 1"}});
#endif
}

void wake_ups() {
#if ENGINE_4
  Case one("wake_up",
           main_tree("<Sequence name=\"s\"><Stateful name=\"a\" runs=\"2\"/>"
                     "<Do name=\"b\"/></Sequence>"),
           "property soon: present b.success within 1 ticks\n"
           "property units: present b.success within 2 ticks\n"
           "property ends: possible root.success\n");
  std::map<std::string, std::string> told;
  {
    BT::Tree tree = one.tree();
    btcheck::Observer observer(tree, one.table(), one.logged());
    const Verdicts verdicts(observer);
    BT::TreeNode* leaf = nullptr;
    tree.applyVisitor([&](BT::TreeNode* node) {
      if (node->name() == "a") leaf = node;
    });
    int woken = 0;
    const auto listening = leaf->subscribeToStatusChange(
        [&](BT::TimePoint, const BT::TreeNode&, NodeStatus, NodeStatus after) {
          if (after == NodeStatus::RUNNING) {
            ++woken;
            leaf->emitWakeUpSignal();
          }
        });
    // Woken up once: two ticks. Then the third.
    expect("first call", observer.tickOnce() == NodeStatus::RUNNING, true);
    expect("second call", observer.tickOnce() == NodeStatus::SUCCESS, true);
    expect("wake-ups", woken, 1);
    verdicts.expect_all({{"soon", "VIOLATED 2"},
                         {"units", "SATISFIED 3"},
                         {"ends", "SATISFIED 3"}});
    told = verdicts.told;
  }
  one.expect_same(told);
#endif
}

void several_trees() {
  Case one("one_tree",
           main_tree("<Sequence name=\"s\"><Do name=\"a\"/></Sequence>"),
           "property fails: never a.failure\n"
           "property twice: in no tick: previously a.answered success\n");
  Case other("other_tree",
             main_tree("<Fallback name=\"f\"><Do name=\"a\"/><Do name=\"b\"/>"
                       "</Fallback>"),
             "property fails: never a.failure\n");
  other.act = [](BT::TreeNode& node) {
    return node.name() == "a" ? NodeStatus::FAILURE : NodeStatus::SUCCESS;
  };
  {
    BT::Tree tree = one.tree();
    BT::Tree second = other.tree();
    BT::Tree third = one.tree();
    btcheck::Observer observer(tree, one.table(), one.logged());
    btcheck::Observer beside(second, other.table(), other.logged());
    btcheck::Observer last(third, one.table());
    const Verdicts verdicts(observer);
    const Verdicts of_second(beside);
    const Verdicts of_third(last);
    for (int t = 0; t < 3; ++t) {
      tick(observer);
      tick(beside);
      if (t == 2) tick(last);
    }
    verdicts.expect_all({{"fails", "OPEN"}, {"twice", "VIOLATED 2"}});
    of_second.expect_all({{"fails", "VIOLATED 1"}});
    of_third.expect_all({{"fails", "OPEN"}, {"twice", "OPEN"}});
  }
  one.expect_same({{"fails", "OPEN"}, {"twice", "VIOLATED"}});
  other.expect_same({{"fails", "VIOLATED"}});
}

void several_observers() {
  const std::string tree =
      main_tree("<Sequence name=\"s\"><Do name=\"a\"/></Sequence>");
  Case one("two_observers", tree, "property first: never a.success\n");
  Case other("two_observers_b", tree,
             "property second: present a.failure within 1 ticks\n");
  BT::Tree running = one.tree();
  auto observer =
      std::make_unique<btcheck::Observer>(running, one.table(), one.logged());
  btcheck::Observer beside(running, other.table(), other.logged());
  const Verdicts verdicts(*observer);
  const Verdicts of_other(beside);
  tick(running);
  verdicts.expect_all({{"first", "VIOLATED 1"}});
  of_other.expect_all({{"second", "OPEN"}});
  observer.reset();
  tick(running);
  of_other.expect_all({{"second", "VIOLATED 2"}});
  one.expect_same({{"first", "VIOLATED"}});
  // One that comes in the middle of a run.
  btcheck::Observer late(running, one.table());
  const Verdicts of_late(late);
  tick(running);
  of_late.expect_all({{"first", "VIOLATED 1"}});
}

// An observer that is gone before its tree, and a tree before its observer.
void orders_of_ending() {
  Case one("endings",
           main_tree("<Sequence name=\"s\"><Stateful name=\"a\" "
                     "runs=\"5\"/></Sequence>"),
           "property halts: never a.halted\n");
  {
    BT::Tree tree = one.tree();
    {
      btcheck::Observer observer(tree, one.table());
      tick(tree);
    }
    tick(tree);
    tree.haltTree();
  }
  auto tree = std::make_unique<BT::Tree>(one.tree());
  btcheck::Observer observer(*tree, one.table());
  const Verdicts verdicts(observer);
  tick(*tree);
  tree->haltTree();
  verdicts.expect_all({{"halts", "VIOLATED 1"}});
  tree.reset();
  expect("a verdict without a tree",
         observer.verdict("halts") == btcheck::monitor::Verdict::Violated,
         true);
}

void policies() {
  Case one("policies",
           main_tree("<Sequence name=\"s\"><Do name=\"a\"/>"
                     "<Stateful name=\"b\" runs=\"9\"/></Sequence>"),
           "property lost: never a.success\n"
           "property halted: never b.halted\n");
  {
    BT::Tree tree = one.tree();
    btcheck::Observer observer(tree, one.table(), one.logged());
    observer.halt("lost");
    const Verdicts verdicts(observer);
    expect("the tick that is ended", tick(observer) == NodeStatus::FAILURE,
           true);
    expect("the tree is halted", tree.rootNode()->status() == NodeStatus::IDLE,
           true);
    verdicts.expect_all({{"lost", "VIOLATED 1"}, {"halted", "VIOLATED 1"}});
  }
  one.expect_same({{"lost", "VIOLATED"}, {"halted", "VIOLATED"}});
  BT::Tree tree = one.tree();
  btcheck::Observer observer(tree, one.table());
  observer.raise("lost");
  std::string raised;
  try {
    tick(observer);
  } catch (const btcheck::RuleViolated& violated) {
    raised = violated.decision().name;
    expect("evidence", violated.decision().evidence,
           std::string("tick 1: a -> SUCCESS\n"));
  }
  expect("what is raised", raised, "lost");
}

// --- Another tree ----------------------------------------------------------

std::string replaced(std::string text, const std::string& from,
                     const std::string& to) {
  const std::size_t at = text.find(from);
  if (at == std::string::npos) {
    expect("`" + from + "` in the tree", "not there", "there");
    return text;
  }
  return text.replace(at, from.size(), to);
}

void other_trees() {
  const std::string a = "<Do name=\"a\"/>";
  const std::string b = "<Stateful name=\"b\" runs=\"1\"/>";
  const std::string sub = "<SubTree ID=\"One\" name=\"One\"/>";
  Case one("other_trees",
           main_tree("<Sequence name=\"s\">" + a + b +
                     "<Inverter name=\"i\">"
                     "<Do name=\"c\"/></Inverter>" +
                     sub + "</Sequence>") +
               "<BehaviorTree ID=\"One\"><Fallback name=\"f\">"
               "<Do name=\"d\"/><Do name=\"e\"/></Fallback></BehaviorTree>\n"
               "<BehaviorTree ID=\"Two\"><Sequence name=\"f\">"
               "<Do name=\"d\"/><Do name=\"e\"/></Sequence></BehaviorTree>\n",
           "property r: never a.failure\n");
  struct Change {
    std::string what;
    std::string from;
    std::string to;
  };
  const std::vector<Change> changes = {
      {"another name", a, "<Do name=\"other\"/>"},
      {"another type of a leaf", b, "<Coroutine name=\"b\" runs=\"1\"/>"},
      {"another type of a control node", "<Fallback name=\"f\">",
       "<ReactiveFallback name=\"f\">"},
      {"another order", a + b, b + a},
      {"a child more at the end", b, b + "<Do name=\"more\"/>"},
      {"a child less", a, ""},
      {"a node in between", a, "<Inverter name=\"w\">" + a + "</Inverter>"},
      {"a decorator less", "<Inverter name=\"i\"><Do name=\"c\"/></Inverter>",
       "<Do name=\"c\"/>"},
      {"another subtree", sub, "<SubTree ID=\"Two\" name=\"One\"/>"},
      {"a child of the subtree more", "<Do name=\"e\"/>",
       "<Do name=\"e\"/><Do name=\"last\"/>"},
      {"a child that moves up", "<Do name=\"c\"/></Inverter>",
       "<Do name=\"c\"/></Inverter><Do name=\"d\"/>"},
      {"the last node less", "<Do name=\"d\"/><Do name=\"e\"/></Fallback>",
       "<Do name=\"d\"/></Fallback>"}};
  for (const Change& change : changes) {
    std::string xml = replaced(one.xml(), change.from, change.to);
    if (change.to == "<ReactiveFallback name=\"f\">") {
      xml = replaced(xml, "</Fallback>", "</ReactiveFallback>");
    }
    std::string said = "nothing";
    BT::Tree tree = one.tree(xml);
    try {
      const btcheck::Observer observer(tree, one.table());
    } catch (const btcheck::WrongTree& wrong) {
      said = "WrongTree";
      std::cout << "  " << change.what << ": " << wrong.what() << "\n";
    }
    expect(change.what, said, "WrongTree");
    // Refused, it has left nothing behind.
    tick(tree);
  }
  // Values of ports are not compared.
  BT::Tree tree =
      one.tree(replaced(one.xml(), b, "<Stateful name=\"b\" runs=\"2\"/>"));
  const btcheck::Observer observer(tree, one.table());
  std::string damaged = one.table();
  damaged[damaged.size() / 2] ^= 1;
  std::string said = "nothing";
  try {
    const btcheck::Observer none(tree, damaged);
  } catch (const btcheck::WrongTable&) {
    said = "WrongTable";
  }
  expect("a damaged table", said, "WrongTable");
}

}  // namespace

int main(int count, char** words) {
  if (count != 3) {
    std::cerr << "usage: observer_kinds BTCHECK DIR\n";
    return 2;
  }
  Case::btcheck = words[1];
  Case::folder = words[2];
  fs::create_directories(Case::folder);
  for (const auto run_case :
       {simple_actions, stateful_actions, coroutines, threaded_actions,
        exceptions, subtrees, wake_ups, several_trees, several_observers,
        orders_of_ending, policies, other_trees}) {
    try {
      run_case();
    } catch (const std::exception& failure) {
      expect("what was thrown", std::string(failure.what()), "nothing");
    }
  }
  std::cout << failures << " failures\n";
  return failures == 0 ? 0 : 1;
}
