// SPDX-License-Identifier: MIT
//
// A tree is made at random, run, and thrown away when something other than the
// script would decide about its run: an entry that is read before it is
// written, most of the time. Scripts can name an entry only where it may have
// been written: those of the main tree, and of a subtree what it is given and
// what it writes first.
#include "btcpp_random/scripted_tree.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <vector>

#include "btcpp_random/random_bt_script.hpp"
#include "btcpp_random/scripted_run.hpp"
#include "model/btcpp/document.hpp"
#include "model/btcpp/entries/world.hpp"
#include "model/btcpp/expand/expansion.hpp"
#include "model/btcpp/known_types.hpp"
#include "model/btcpp/tree/leaf_rules.hpp"
#include "model/tree/node_types.hpp"
#include "model/tree/releases.hpp"
#include "model/tree_file.hpp"
#include "reference/random_tree.hpp"
#include "reference/random_xml_nodes.hpp"

namespace btcheck::reference {
namespace {

constexpr int kMostAttempts = 1000;
constexpr std::array<std::string_view, 2> kSubtrees = {"S1", "S2"};

// Those that tick a child again that has ended and was not reset.
bool leaves_children(std::string_view id) {
  return id == "IfThenElse" || id == "WhileDoElse" ||
         id == "PipelineSequence" || id == "NonblockingSequence" ||
         id == "RoundRobin";
}

class TreeWriter {
 public:
  TreeWriter(std::uint64_t seed, Profile profile, World world)
      : random_(seed),
        has_scripts_(!is_release_3(profile)),
        is_early_(releases::kNeedsElse.has(engine_release(profile))),
        has_root_entries_(
            !releases::kHasNoRootEntries.has(engine_release(profile))),
        has_clock_(world == World::Clocked),
        inner_(inner_nodes(profile, world)) {
    for (const InnerNode& inner : inner_) {
      if (leaves_children(inner.id)) leaving_.push_back(inner);
      if (inner.most == 1) decorators_.push_back(inner);
    }
  }

  std::string text() {
    std::string trees = main_tree();
    for (std::size_t i = 0; i < kSubtrees.size(); ++i) trees += subtree(i);
    return fmt::format(
        "<root BTCPP_format=\"{}\" main_tree_to_execute=\"T\">\n{}"
        "<TreeNodesModel>\n{}</TreeNodesModel>\n</root>\n",
        has_scripts_ ? 4 : 3, trees, models_);
  }

  // One line for each action and condition.
  const std::string& script() const { return script_; }
  // One for each action.
  const std::string& leaves() const { return contracts_; }

 private:
  std::string main_tree() {
    scope_ = {{"x1", "x2", "x3", "y1", "y2"},
              {"b1", "b2"},
              {"z1", "z2"},
              {"t1", "t2"},
              {"s1"}};
    written_ = {"y1", "y2"};
    switched_ = {"x1", "b1", "t1", "t2"};
    untyped_ = {"x2", "x3"};
    budget_ =
        random_.percent(40) ? 3 + random_.below(3) : 3 + random_.below(12);
    if (!has_scripts_) return main_tree_of_release_3();
    const std::string x1 = digit();
    const std::string x2 = digit();
    std::string begin =
        leaf_with(fmt::format("Script code=\"x1:={}; x2:={}; x3:=0; y1:=0; "
                              "y2:=1; b1:=0; b2:=true; t1:='a'; t2:='b'; "
                              "z1:=-3; z1:=-1; z2:=0.5\"",
                              x1, x2));
    begin += leaf_with(setting("a", "s1"));
    // What is kept from one run of the tree to the next, or is not.
    if (random_.percent(50))
      begin = around("RunOnce", around("Sequence", begin));
    return tree("T", around("Sequence", begin + node(0)));
  }

  std::string main_tree_of_release_3() {
    std::string begin = leaf_with(setting(old_value(), "v1"));
    begin += leaf_with(setting(old_value(), "v2"));
    return tree("T", around("Sequence", begin + node(0)));
  }
  std::string old_value() {
    return one_of(random_, {"1", "2", "a", "true", " 1x", "2.00", "{v1}"});
  }

  // A later one may stand in an earlier one.
  std::string subtree(std::size_t number) {
    first_subtree_ = number + 1;
    budget_ = 2 + random_.below(5);
    if (!has_scripts_) return tree(kSubtrees[number], node(0));
    // What it is given is there before it begins.
    scope_ =
        has_root_entries_
            ? ScriptScope{{"p", "q", "@x1"}, {"@b1"}, {"@z1"}, {"r"}, {"r"}}
            : ScriptScope{{"p", "q"}, {"p"}, {"p"}, {"r"}, {"r"}};
    const std::string root =
        random_.percent(70) || is_early_
            ? "Sequence"
            : one_of(random_, {"ReactiveSequence", "SequenceWithMemory",
                               "AsyncSequence"});
    std::string text = fmt::format("<{}{}{}>\n", root, name(), conditions());
    set_scope_of_subtree();
    std::string begin = leaf_with(
        fmt::format("Script code=\"l:={}; k:=0; f:=false; m:='b'; z:=-3; "
                    "z:={}\"",
                    digit(), one_of(random_, {"0.5", "-1", "0.0"})));
    // So that all its children may be skipped, and it as well.
    if (random_.percent(40)) begin = around("RunOnce", begin);
    text += begin + node(0);
    return tree(kSubtrees[number], text + fmt::format("</{}>\n", root));
  }

  void set_scope_of_subtree() {
    if (has_root_entries_) {
      scope_ = {{"p", "q", "l", "k", "@x1", "@x3", "@y1"},
                {"f", "@b1"},
                {"z", "@z1"},
                {"r", "m"},
                {"@s1"}};
      written_ = {"k", "@y1"};
      untyped_ = {"l", "@x3"};
    } else {
      scope_ = {{"p", "q", "l", "k"}, {"f"}, {"z"}, {"r", "m"}, {"r"}};
      written_ = {"k"};
      untyped_ = {"l"};
    }
    switched_ = {"f", "r", "m"};
  }

  static std::string tree(std::string_view id, const std::string& inside) {
    return fmt::format("<BehaviorTree ID=\"{}\">\n{}</BehaviorTree>\n", id,
                       inside);
  }
  std::string around(std::string_view id, const std::string& inside) {
    return fmt::format("<{0}{1}>\n{2}</{0}>\n", id, name(), inside);
  }
  std::string leaf_with(const std::string& tag) {
    return fmt::format("<{}{}/>\n", tag, name());
  }

  std::string name() { return fmt::format(" name=\"n{}\"", ++names_); }
  std::string number() { return one_of(random_, scope_.numbers); }
  std::string text_entry() { return one_of(random_, scope_.texts); }

  std::string node(int depth, bool is_left = false) {
    is_left_ = is_left;
    --budget_;
    if (is_left && has_scripts_ && may_use_subtree() && random_.percent(15)) {
      return leaf_with(use_of_subtree() + conditions());
    }
    if (depth > 0 && (budget_ <= 0 || depth >= 6 || random_.percent(25))) {
      return leaf();
    }
    const InnerNode& inner = inner_node();
    const int clocks = keeps_clocks_out(inner) ? 1 : 0;
    clocks_above_ += clocks;
    std::string text = fmt::format("<{}{}", inner.id, name());
    text += ports(inner.ports);
    text += conditions() + ">\n";
    const int count = inner.least + random_.below(inner.most - inner.least + 1);
    for (int i = 0; i < count; ++i) {
      text += node(depth + 1, leaves_children(inner.id));
    }
    clocks_above_ -= clocks;
    return text + fmt::format("</{}>\n", inner.id);
  }

  // No clock below a clock: where both are up in one tick, microseconds decide
  // which was first. None below a WhileDoElse, which leaves a branch running
  // and does not tick it while its condition runs: docs/btcpp.md.
  bool keeps_clocks_out(const InnerNode& inner) const {
    return has_clock_ &&
           (inner.world == World::Clocked || inner.id == "WhileDoElse");
  }
  const InnerNode& inner_node() {
    while (true) {
      const std::vector<InnerNode>& some = is_left_ && random_.percent(50)
                                               ? decorators_
                                           : random_.percent(30) ? leaving_
                                                                 : inner_;
      const InnerNode& inner = some[static_cast<std::size_t>(
          random_.below(static_cast<int>(some.size())))];
      if (clocks_above_ == 0 || inner.world != World::Clocked) return inner;
    }
  }

  std::string ports(std::string_view pattern) {
    std::string text;
    for (const char c : pattern) {
      if (c == '#') {
        text += static_cast<char>('1' + random_.below(2));
      } else if (c == '?') {
        text += random_condition(random_, scope_);
      } else if (c == '$') {
        text += one_of(random_, switched_);
      } else {
        text += c;
      }
    }
    return text;
  }

  bool may_use_subtree() const {
    return clocks_above_ == 0 &&
           std::max(first_subtree_, unused_) < kSubtrees.size();
  }

  std::string leaf() {
    const int kind = random_.below(has_scripts_ ? 21 : 12);
    if (kind < 6) return scripted_leaf("Action", "a");
    if (kind < 9) return scripted_leaf("Condition", "c");
    const bool is_subtree = kind < 11 && may_use_subtree();
    if (is_subtree && !has_scripts_) return use_in_release_3();
    std::string tag = is_subtree ? use_of_subtree() : leaf_of_the_engine(kind);
    tag += conditions();
    return leaf_with(tag);
  }

  std::string leaf_of_the_engine(int kind) {
    const bool is_later = kind == 15 || kind == 16 || kind > 18;
    if (is_early_ && is_later) kind = 12;
    switch (kind) {
      case 12:
      case 13:
      case 14:
        return fmt::format("Script code=\"{}\"",
                           random_statements(random_, scope_));
      case 15:
      case 16:
        return fmt::format("ScriptCondition code=\"{}\"",
                           random_condition(random_, scope_));
      case 17:
      case 18:
        return set_blackboard();
      case 19:
        if (random_.percent(50)) return "Sleep msec=\"0\"";
        return fmt::format("UnsetBlackboard key=\"{}\"", number());
      case 20:
        return has_clock_ && clocks_above_ == 0 ? "Sleep msec=\"150\""
                                                : "Sleep msec=\"3600000\"";
      default:
        break;
    }
    if (!has_scripts_ && first_subtree_ == 0 && random_.percent(60)) {
      return setting(old_value(), random_.percent(50) ? "v1" : "v2");
    }
    return random_.percent(50) ? "AlwaysSuccess" : "AlwaysFailure";
  }

  // A literal, or an entry in braces.
  std::string value(bool is_number) {
    if (random_.percent(50)) return is_number ? digit() : "a";
    return fmt::format("{{{}}}", is_number ? number() : text_entry());
  }

  // Texts seldom go to an entry that a script has made: it is left empty. What
  // a leaf writes has the type that the leaf gives it, which no contract tells.
  std::string set_blackboard() {
    if (random_.percent(15)) {
      const std::string entry = random_.percent(50) ? number() : text_entry();
      const bool is_typed =
          std::find(written_.begin(), written_.end(), entry) != written_.end();
      return setting(one_of(random_, {"1", "a", "{x2}", "{t1}"}),
                     is_typed ? scope_.read_texts[0] : entry);
    }
    if (random_.percent(50)) return setting(value(false), scope_.read_texts[0]);
    const std::string source = fmt::format("{{{}}}", one_of(random_, untyped_));
    return setting(source, one_of(random_, untyped_));
  }
  static std::string setting(std::string_view value, std::string_view key) {
    return fmt::format("SetBlackboard value=\"{}\" output_key=\"{}\"", value,
                       key);
  }

  std::string scripted_leaf(std::string_view kind, std::string_view letter) {
    const std::string id = fmt::format("{}{}", letter, ++leaves_);
    if (kind == "Condition") {
      models_ += fmt::format("<Condition ID=\"{}\"/>\n", id);
      script_ += id + ":" + results(Answers::Ended) + "\n";
      return fmt::format("<{}{}/>\n", id, conditions());
    }
    const bool keeps = random_.percent(50);
    const bool skips = has_scripts_ && !keeps && random_.percent(10);
    std::string contract =
        fmt::format("(defaction {} :answers {}", id, keeps ? "once" : "anew");
    if (skips) contract += " :returns (success failure skipped)";
    std::string port;
    if (has_scripts_ && random_.percent(40)) {
      const bool has_port = random_.percent(40);
      const std::string entry = one_of(
          random_, has_port || random_.percent(70) ? written_ : scope_.texts);
      const std::string effects =
          effect("success", entry) + effect("failure", entry);
      // A port of which the contract says nothing may write whatever it likes.
      if (has_port && !effects.empty())
        port = fmt::format(" out=\"{{{}}}\"", entry);
      contract += effects;
    }
    contracts_ += contract + ")\n";
    models_ += port.empty()
                   ? fmt::format("<Action ID=\"{}\"/>\n", id)
                   : fmt::format(
                         "<Action ID=\"{}\"><output_port name=\"out\"/>"
                         "</Action>\n",
                         id);
    script_ +=
        id + ":" + results(skips ? Answers::Skipped : Answers::All) + "\n";
    return fmt::format("<{}{}{}/>\n", id, port, conditions());
  }

  // ` :on-success ((:= y1 2))`, or nothing.
  std::string effect(std::string_view when, const std::string& entry) {
    if (random_.percent(30)) return "";
    const bool is_text = std::find(scope_.texts.begin(), scope_.texts.end(),
                                   entry) != scope_.texts.end();
    const std::string value = !is_text              ? digit()
                              : random_.percent(50) ? "\"a\""
                                                    : "\"b\"";
    return fmt::format(" :on-{} ((:= {} {}))", when, entry, value);
  }

  enum class Answers { Ended, Skipped, All };
  std::string results(Answers answers) {
    std::string text;
    const int count = 1 + random_.below(12);
    for (int i = 0; i < count; ++i) {
      text += answers != Answers::Ended && random_.percent(40)
                  ? (answers == Answers::Skipped ? " skipped" : " running")
              : random_.percent(60) ? " success"
                                    : " failure";
      if (random_.percent(15)) text += fmt::format("*{}", 2 + random_.below(3));
    }
    return text;
  }

  // There the node has no name but that of its tree: each is used once.
  std::string use_in_release_3() {
    const std::size_t id = std::max(first_subtree_, unused_);
    unused_ = id + 1;
    return fmt::format("<SubTree ID=\"{}\"/>\n", kSubtrees[id]);
  }

  std::string use_of_subtree() {
    const int others = static_cast<int>(kSubtrees.size() - first_subtree_);
    const std::size_t id =
        first_subtree_ + static_cast<std::size_t>(random_.below(others));
    std::string tag = fmt::format("SubTree ID=\"{}\"", kSubtrees[id]);
    tag += fmt::format(" p=\"{{{}}}\"", number());
    tag += fmt::format(" q=\"{}\"", value(true));
    tag += fmt::format(" r=\"{}\"", value(false));
    // Beside a name it crashes the early ones.
    if (random_.percent(25) && !is_early_) tag += " _autoremap=\"true\"";
    return tag;
  }

  std::string digit() { return std::to_string(random_.below(4)); }

  // Pre- and postconditions, as attributes.
  std::string conditions() {
    if (!has_scripts_ || !random_.percent(is_left_ ? 60 : 35)) return "";
    std::string text;
    for (std::size_t i = 0; i < kBtcppConditionNames.size(); ++i) {
      const std::string_view when = kBtcppConditionNames[i];
      if (is_early_ && when == "_onHalted") continue;
      if (!random_.percent(when == "_skipIf" || when == "_while" ? 25 : 15)) {
        continue;
      }
      text += fmt::format(
          " {}=\"{}\"", when,
          i < 4 ? precondition() : random_statements(random_, scope_));
    }
    return text;
  }

  std::string precondition() {
    if (random_.percent(70)) return random_condition(random_, scope_);
    return random_.percent(60) ? "true" : "false";
  }

  SplitMix64 random_;
  bool has_scripts_;
  bool is_early_;          // 4.0 to 4.2, which have fewer nodes
  bool has_root_entries_;  // `@x1`
  bool has_clock_;
  std::vector<InnerNode> inner_;
  std::vector<InnerNode> leaving_;     // that leave children as they are
  std::vector<InnerNode> decorators_;  // most of what stands below those
  ScriptScope scope_;
  std::vector<std::string> written_;  // numbers that leaves write
  // Entries that a Switch looks at, and numbers that SetBlackboard copies: they
  // are others, for the Switch gives them the type of its port, and so does a
  // literal to `q`; SetBlackboard throws where a type does not fit.
  std::vector<std::string> switched_;
  std::vector<std::string> untyped_;
  bool is_left_ = false;           // below a node that leaves its children
  int clocks_above_ = 0;           // nodes that keep clocks out
  std::size_t first_subtree_ = 0;  // of those that may be used
  std::size_t unused_ = 0;         // of those, the first in release 3
  int budget_ = 0;                 // of nodes
  int names_ = 0;
  int leaves_ = 0;
  std::string models_;
  std::string script_;
  std::string contracts_;
};

// "NAME PATH ENTRY" for each state variable, the path of the main tree as `/`;
// nothing where scripts read an entry that is none, or where a copy of one may
// throw.
std::optional<std::string> entries_of(const ScriptedTree& made, Profile profile,
                                      const BehaviorTree& tree) {
  BtcppOptions options;
  options.release = btcpp::dialect_of(profile);
  options.version = engine_release(profile);
  const auto document = read_btcpp(
      "t.xml", made.xml, [](const IncludeRequest&) { return IncludedFile{}; },
      options);
  const auto expansion = expand_btcpp(*document.value);
  const auto contracts = read_leaf_files({{"t.leaves", made.leaves}});
  const btcpp::LeafRules rules(*expansion.value, *contracts.value);
  const btcpp::ScriptWorld world =
      btcpp::script_world(*expansion.value, rules.scripts());
  if (!world.abstracted.empty()) return std::nullopt;
  const bool reads_copies = releases::copies_text(engine_release(profile));
  for (const btcpp::Setting& setting : world.writers.settings) {
    const bool is_known =
        !setting.source || world.variable_of(*setting.source).has_value();
    if (reads_copies && !is_known) return std::nullopt;
  }
  std::string text;
  for (const auto& [entry, variable] : world.of) {
    const std::string& path = expansion.value->subtrees[entry.subtree].path;
    text += fmt::format("{} {} {}\n", tree.variable(variable).name,
                        path.empty() ? "/" : path, entry.name);
  }
  return text;
}

// Numbers that btcheck keeps no further apart than `from_4`.
bool has_ranges(const BehaviorTree& tree) {
  for (const StateVariable& variable : tree.variables) {
    for (const std::string& state : variable.states) {
      if (state.starts_with("from_") || state.starts_with("to_")) return true;
    }
  }
  return false;
}

// A Sleep that is halted and begun again in one tick, which the engine's thread
// of the timer may end at once.
bool has_race(const BehaviorTree& tree, const std::string& lines) {
  for (const Node& node : tree.nodes) {
    if (node.type != NodeType::Wait) continue;
    const std::string name = node.name + "=";
    for (std::size_t at = lines.find(name); at != lines.npos;
         at = lines.find(name, at + 1)) {
      const std::size_t end = lines.find_first_of(" \n", at);
      const std::string answers = lines.substr(at, end - at);
      if (answers.find("halted,running") != answers.npos) return true;
    }
  }
  return false;
}

}  // namespace

ScriptedTree random_scripted_tree(std::uint64_t seed, Profile profile,
                                  World world, int ticks) {
  SplitMix64 seeds(seed);
  for (int i = 0; i < kMostAttempts; ++i) {
    TreeWriter writer(seeds.next(), profile, world);
    ScriptedTree made{writer.text(), "", "", ""};
    made.script = writer.script();
    made.leaves = writer.leaves();
    const auto tree =
        read_tree("t.xml", made.xml, scripted_reading(profile, made.leaves));
    // Two asynchronous children of a ReactiveSequence, which the engine
    // refuses.
    if (!tree.value) continue;
    const auto entries = entries_of(made, profile, *tree.value);
    if (!entries || has_ranges(*tree.value)) continue;
    const ScriptedRun run = scripted_run(*tree.value, made.script, ticks);
    if (!run.is_determined || has_race(*tree.value, run.lines)) continue;
    made.entries = *entries;
    return made;
  }
  throw std::logic_error(fmt::format("no tree for seed {}", seed));
}

}  // namespace btcheck::reference
