// SPDX-License-Identifier: MIT
//
// Models in Fiacre, as text. That they mean what the network means is compared
// in reference/export_cross_check_test.cpp.
#include "model/export/fiacre/fiacre.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <regex>
#include <set>
#include <string>

#include "model/automata/network.hpp"
#include "model/btf_text.hpp"
#include "model/export/fiacre/links.hpp"
#include "model/export/fiacre/process.hpp"
#include "model/exported_text.hpp"
#include "model/lowering.hpp"
#include "model/tree/node_types.hpp"

namespace btcheck::fiacre_test {
namespace {

Result<std::string> exported(std::string_view text, TickSemantics ticks,
                             const std::vector<ExportClaim>& claims = {}) {
  const BehaviorTree tree = tree_of(text);
  return fiacre_text(tree, lower(tree, ticks), claims);
}

std::string model_of(std::string_view text, TickSemantics ticks,
                     const std::vector<ExportClaim>& claims = {}) {
  auto model = exported(text, ticks, claims);
  REQUIRE(model.value);
  return *model.value;
}

constexpr std::string_view kCondition =
    "(BehaviorTree :name t (Condition :ID c))";

TEST_CASE("an automaton is a process, its edges are alternatives") {
  const std::string model = model_of(kCondition, TickSemantics::Nodes);
  CHECK(has(model, R"(
/* process 1: c_btn1 */
process c_btn1
  (&c_btn1_caller : int, &c_btn1_rstatus : status) is
states start_, tick_node, success, failure, done
from start_
     /* is called */
     on not (c_btn1_caller = 0);
     wait [0,0];
     c_btn1_rstatus := status_no_ret_status;
     to tick_node
from tick_node
  select
     /* to success */
     wait [1,1];
     to success
  [] /* to failure */
     wait [1,1];
     to failure
  end
)"));
  CHECK(model.ends_with(R"(
par
   c_btn1 (&c_btn1_caller, &c_btn1_rstatus)
|| t_btn0 (&c_btn1_caller, &c_btn1_rstatus, &t_btn0_rstatus)
end

t
)"));
}

TEST_CASE("without time nothing waits") {
  CHECK(!has(model_of(kCondition, TickSemantics::None), "wait"));
}

TEST_CASE("a timer that must go first has a port with priority") {
  const std::string model =
      model_of("(BehaviorTree :name t (Wait :name w :duration [2,3]))",
               TickSemantics::Root);
  CHECK(has(model, R"(port
  at_once : sync in [0,0],
  after_1 : sync in [1,1],
  w_btn1_timer_may_end : sync in [2,...[,
  w_btn1_timer_must_end : sync in [3,3]
priority
  w_btn1_timer_must_end > at_once | after_1 | w_btn1_timer_may_end
)"));
  CHECK(!has(model, "wait ["));
}

TEST_CASE("a local variable is its process's own") {
  const std::string model = model_of(
      "(BehaviorTree :name t (Sequence :name s (Condition :ID c)"
      " (Condition :ID d)))",
      TickSemantics::Root);
  CHECK(has(model, "var s_btn1_next_seq : int := 1 /* 1..2 */\n"));
  CHECK(!has(model, "  s_btn1_next_seq : int"));
}

TEST_CASE("a claim is observed in the processes that it speaks of") {
  const BehaviorTree tree = tree_of(kCondition);
  const Network network = lower(tree, TickSemantics::Root);
  const auto is = [](VariableId variable, int value) {
    return Expression::binary(
        Operation::Equal,
        Expression::variable(static_cast<std::int32_t>(index(variable))),
        Expression::constant(value));
  };
  const Automaton& leaf = network.automata[0];
  const Expression both_hold =
      Expression::binary(Operation::And, is(leaf.location, 4),
                         is(network.node_status[index(leaf.node)], 1));
  const std::string model =
      model_of(kCondition, TickSemantics::Root,
               {{"r", "ltl [] (not p0)", {both_hold}, {"as meant"}}});
  CHECK(model.ends_with(R"(
/* as meant */
property r is ltl [] (not ((t/1/state done) and
  (t/1/value (c_btn1_rstatus = status_success))))
assert r
)"));
}

TEST_CASE("what no process sees together is left out with a warning") {
  constexpr std::string_view kTwo =
      "(BehaviorTree :name t (Sequence :name s (Condition :ID c)"
      " (Sequence :name r (Condition :ID d) (Condition :ID e))))";
  const BehaviorTree tree = tree_of(kTwo);
  const Network network = lower(tree, TickSemantics::Root);
  std::vector<VariableId> locals;
  for (const Automaton& automaton : network.automata) {
    locals.insert(locals.end(), automaton.locals.begin(),
                  automaton.locals.end());
  }
  REQUIRE(locals.size() == 2);
  const auto read = [](VariableId id) {
    return Expression::variable(static_cast<std::int32_t>(index(id)));
  };
  const auto model = exported(
      kTwo, TickSemantics::Root,
      {{"r",
        "always p0",
        {Expression::binary(Operation::Less, read(locals[0]), read(locals[1]))},
        {}}});
  REQUIRE(model.value);
  REQUIRE(model.diagnostics.size() == 1);
  CHECK(model.diagnostics[0].code == "BT0006");
  CHECK(model.value->ends_with(
      "/* `r` is not exported: it compares what no process of Fiacre sees "
      "together */\n"));
}

TEST_CASE("a constant is observed in a process, like everything") {
  CHECK(model_of(kCondition, TickSemantics::Root,
                 {{"r", "ltl p0", {Expression::constant(1)}, {}},
                  {"s", "absent p0", {Expression::constant(0)}, {}}})
            .ends_with(R"(
property r is ltl (t/1/value (true))
assert r

property s is absent (t/1/value (false))
assert s
)"));
}

TEST_CASE("words of Fiacre are no names") {
  CHECK(fiacre_identifier("wait") == "wait_");
  CHECK(fiacre_identifier("mortal") == "mortal_");
  CHECK(fiacre_identifier("a-b") == "a_b");
  CHECK(fiacre_identifier("7up") == "n_7up");
}

// All words of a text that follow this one.
std::set<std::string> words_after(const std::string& text,
                                  const std::string& word) {
  std::set<std::string> found;
  const std::regex each("(^|\\s)" + word + "\\s+([A-Za-z0-9_]+)");
  for (std::sregex_iterator at(text.begin(), text.end(), each), end; at != end;
       ++at) {
    found.insert((*at)[2]);
  }
  return found;
}

bool is_within(const std::set<std::string>& part,
               const std::set<std::string>& all) {
  return std::ranges::includes(all, part);
}

TEST_CASE("in H-Fiacre each leaf has its function, and what is used is there") {
  std::size_t leaves = 0;
  for (const auto& entry :
       std::filesystem::directory_iterator(BTCHECK_EXAMPLES)) {
    if (entry.path().extension() != ".btf") continue;
    const BehaviorTree tree =
        tree_of(example(entry.path().filename().string()));
    CAPTURE(entry.path().string());
    const Network network = lower(tree, TickSemantics::Root);
    const auto made = hfiacre_text(tree, network);
    REQUIRE(made.value);
    const std::string& text = *made.value;
    const auto tasks = words_after(text, "task");
    const auto externs = words_after(text, "extern");
    auto waited = words_after(text, "sync");
    waited.erase("in");  // `at_once : sync in [0,0]`
    CHECK(words_after(text, "start") == waited);
    CHECK(is_within(words_after(text, "start"), tasks));
    CHECK(is_within(words_after(text, "is_halted :="), externs));
    auto asked = words_after(text, "answer :=");
    asked.erase("status_no_ret_status");
    asked.erase("0");
    CHECK(is_within(asked, externs));
    for (const FiacreLinks& links : {fiacre_links(tree, network)}) {
      for (std::size_t a = 0; a < links.of.size(); ++a) {
        const Automaton& automaton = network.automata[a];
        if (automaton.kind != AutomatonKind::Node) continue;
        const NodeType type = tree.node(automaton.node).type;
        const bool is_leaf = type == NodeType::Action ||
                             type == NodeType::Condition ||
                             type == NodeType::SetSV;
        CHECK(links.of[a].has_value() == is_leaf);
        leaves += is_leaf ? 1 : 0;
      }
    }
    // Process by process: where it goes to is a state of its own, and what it
    // waits for a port of its own.
    for (std::size_t at = text.find("\nprocess "); at != std::string::npos;
         at = text.find("\nprocess ", at + 1)) {
      const std::size_t end =
          std::min(text.find("\n/*", at), text.find("\ncomponent", at));
      const std::string body = text.substr(at, end - at);
      const std::size_t is = body.find(" is\n");
      REQUIRE(is != std::string::npos);
      std::set<std::string> states;
      const std::size_t first = body.find("states ", is) + 7;
      const std::string list = body.substr(
          first,
          std::min(body.find("\nvar ", first), body.find("\nfrom ", first)) -
              first);
      const std::regex word("[A-Za-z0-9_]+");
      for (std::sregex_iterator w(list.begin(), list.end(), word), none;
           w != none; ++w) {
        states.insert(w->str());
      }
      CHECK(is_within(words_after(body.substr(is), "to"), states));
      CHECK(is_within(words_after(body.substr(is), "from"), states));
      for (const char* port : {"at_once", "after_1"}) {
        const bool is_used =
            body.find(std::string("     ") + port + ";") != std::string::npos;
        if (is_used) CHECK(body.find(std::string(port) + " : sync") < is);
      }
    }
  }
  CHECK(leaves > 50);
}

}  // namespace
}  // namespace btcheck::fiacre_test
