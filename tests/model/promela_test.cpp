// SPDX-License-Identifier: MIT
//
// Models for SPIN, as text. That they mean what the network means is compared
// with SPIN itself in reference/spin_cross_check_test.cpp.
#include "model/export/promela/promela.hpp"

#include <doctest/doctest.h>

#include <string>

#include "model/automata/network.hpp"
#include "model/btf_text.hpp"
#include "model/export/layout.hpp"
#include "model/export/names.hpp"
#include "model/exported_text.hpp"
#include "model/lowering.hpp"

namespace btcheck::promela_test {
namespace {

std::string model_of(std::string_view text, TickSemantics ticks,
                     const std::vector<ExportClaim>& claims = {}) {
  const BehaviorTree tree = tree_of(text);
  auto model = promela_text(tree, lower(tree, ticks), claims);
  REQUIRE(model.value);
  return *model.value;
}

constexpr std::string_view kCondition =
    "(BehaviorTree :name t (Condition :ID c))";

// A network of two variables, x in -3..3 and y in 0..60000, and no automata.
Network two_numbers() {
  Network network;
  network.variables.push_back({VariableRole::State, "x", -3, 3, 0, {}});
  network.variables.push_back({VariableRole::State, "y", 0, 60000, 0, {}});
  network.state_variable = {VariableId{0}, VariableId{1}};
  return network;
}

Expression x() { return Expression::variable(0); }
Expression y() { return Expression::variable(1); }
Expression number(int value) { return Expression::constant(value); }

struct Shown {
  std::string text;
  bool is_exact = true;
};

Shown shown(const Expression& expression) {
  const Network network = two_numbers();
  const ExportNames names(network);
  const ExportLanguage promela(network, names, kPromelaSigns);
  std::string text = promela.condition(expression);
  const bool is_exact = !text.empty();
  return {std::move(text), is_exact};
}

TEST_CASE("a model without time is its edges and an idle step") {
  const std::string model = model_of(kCondition, TickSemantics::None);
  CHECK(model == R"(/* t.btf, tick none; made by btcheck
 *
 * line 1    BehaviorTree t_btn0
 * line 1      Condition c_btn1
 */

/* the values of every rstatus */
#define status_no_ret_status 0
#define status_success 1
#define status_failure 2
#define status_running 3
#define status_halt_me 4

/* process 1: c_btn1 */
#define c_btn1_at_start_ 0
#define c_btn1_at_tick_node 1
#define c_btn1_at_success 2
#define c_btn1_at_failure 3
#define c_btn1_at_done 4
byte c_btn1_location = c_btn1_at_start_;
bit c_btn1_caller = 0;
byte c_btn1_rstatus = status_no_ret_status;
)" + model.substr(model.find("\n/* process 2")));
  CHECK(has(model, R"(
  /* c_btn1: start_ -> tick_node, is called */
  :: d_step {
       c_btn1_location == c_btn1_at_start_ && c_btn1_caller != 0 ->
       c_btn1_rstatus = status_no_ret_status;
       c_btn1_location = c_btn1_at_tick_node
     }
)"));
  CHECK(has(model, R"(
  /* a step of time */
  :: !is_urgent
  /* never: without it SPIN leaves these out of its states */
  :: false && (t_btn0_rstatus)
  od
}
)"));
  CHECK(!has(model, "clock"));
  CHECK(!has(model, "may_move"));
}

TEST_CASE("time moves the clocks up to what their edges can tell apart") {
  const std::string model =
      model_of("(BehaviorTree :name t (Wait :name w :duration [2,3]))",
               TickSemantics::Root);
  CHECK(has(model, "byte w_btn1_timer_clock = 0;\n"));
  CHECK(has(model, "bit t_btn0_clock = 0;\n"));
  CHECK(has(model, R"(#define timer_is_due \
  ((w_btn1_timer_location == w_btn1_timer_at_counting && \
   w_btn1_timer_clock == 3))
#define may_move \
  (!timer_is_due)
)"));
  CHECK(has(model, R"(
  /* w_btn1_timer: counting -> due, is due */
  :: d_step {
       (w_btn1_timer_clock == 3 || !timer_is_due) &&
       w_btn1_timer_location == w_btn1_timer_at_counting &&
       w_btn1_timer_clock >= 2 ->
       w_btn1_timer_location = w_btn1_timer_at_due;
       w_btn1_timer_clock = 0
     }
)"));
  CHECK(has(model,
            "(w_btn1_timer_location == w_btn1_timer_at_counting &&\n"
            "         w_btn1_timer_clock < 3)"));
}

TEST_CASE("whoever starts a timer starts its clock") {
  const std::string model = model_of(
      "(BehaviorTree :name t (Wait :name w :duration 2))", TickSemantics::Root);
  CHECK(has(model, R"(
       w_btn1_timer_location = w_btn1_timer_at_counting;
       w_btn1_timer_clock = 0;
       w_btn1_location = w_btn1_at_look
)"));
}

TEST_CASE("a fault leaves one idle step and nothing else") {
  const std::string model = model_of(
      "(defsv n :min 0 :max 2) (BehaviorTree :name t (Eval (:= n (+ n 1))))",
      TickSemantics::Root);
  CHECK(has(model, "#define may_move \\\n  (!fault)\n"));
  CHECK(has(model, "       fault = 1;\n"));
  CHECK(has(model, "  :: fault\n"));
}

constexpr std::string_view kWeather =
    "(defsv sky :states (Dry Wet) :transitions :all)"
    "(BehaviorTree :name t (Condition :ID c))";

TEST_CASE("progress is told only where a claim needs it") {
  const ExportClaim claim{"dry", "[] <> p0", {Expression::variable(0)}};
  CHECK(!has(model_of(kWeather, TickSemantics::Root), "progress"));
  CHECK(!has(model_of(kCondition, TickSemantics::Root, {claim}), "progress"));
  const std::string model = model_of(kWeather, TickSemantics::Root, {claim});
  CHECK(has(model, "bit progress = 1;\n"));
  CHECK(has(model, R"(
       sv_sky == sv_sky_Dry ->
       progress = 0;
       sv_sky = sv_sky_Wet
)"));
  CHECK(has(model, R"(
#define dry_p0 \
  (sv_sky)
ltl dry { ([] (<> (progress == 1))) -> ([] <> dry_p0) }
)"));
}

TEST_CASE("each claim has its own propositions") {
  const std::string model =
      model_of(kCondition, TickSemantics::Root,
               {{"one", "p0 U p1", {Expression::variable(0), number(1)}},
                {"two", "<> (p0 && xp0)", {number(0)}}});
  CHECK(has(model, "ltl one { one_p0 U one_p1 }\n"));
  CHECK(has(model, "ltl two { <> (two_p0 && xp0) }\n"));
}

TEST_CASE("names become identifiers and stay apart") {
  const std::string model = model_of(
      "(defsv a-b :states (x) ) (defsv a_b :states (x))"
      "(BehaviorTree :name t (Condition :name é))",
      TickSemantics::Root);
  CHECK(has(model, "sv_a_b = sv_a_b_x;"));
  CHECK(has(model, "sv_a_b_2 = sv_a_b_x_2;"));
  CHECK(has(model, "byte ___btn1_location = ___btn1_at_start_;"));
  CHECK(has(model, "/* é_btn1: start_ -> tick_node, is called */"));
  CHECK(comment_text("a*/b**/\n\\") == "a* /b** /  ");
}

TEST_CASE("expressions keep their meaning in Promela") {
  using enum Operation;
  const auto two = [](Operation operation, Expression a, Expression b) {
    return Expression::binary(operation, std::move(a), std::move(b));
  };
  CHECK(shown({}).text == "1");
  CHECK(shown(two(Subtract, x(), two(Subtract, y(), number(-1)))).text ==
        "sv_x - (sv_y - -1)");
  CHECK(shown(Expression::unary(Negate, number(-2))).text == "-(-2)");
  CHECK(shown(two(Or, two(And, x(), y()), two(Or, x(), y()))).text ==
        "(sv_x && sv_y) || (sv_x || sv_y)");
  CHECK(shown(two(Divide, y(), number(2))).text == "sv_y / 2");
  CHECK(shown(two(Divide, y(), x())).text ==
        "sv_y / (sv_x + (sv_x == 0)) * (sv_x != 0)");
  CHECK(shown(two(Modulo, y(), x())).text == "sv_y % (sv_x + (sv_x == 0))");
  CHECK(shown(Expression::unary(Not, two(Less, x(), y()))).text ==
        "!(sv_x < sv_y)");
}

TEST_CASE("what could leave 32 bits is refused") {
  using enum Operation;
  const Expression square = Expression::binary(Multiply, y(), y());
  CHECK(!shown(square).is_exact);
  CHECK(shown(Expression::binary(Multiply, y(), number(30000))).is_exact);
  const BehaviorTree tree = tree_of(
      "(defsv x :min 0 :max 50000)"
      "(BehaviorTree :name t (Eval (< (* x x) 100)))");
  const auto model = promela_text(tree, lower(tree, TickSemantics::Root));
  CHECK(!model.value);
  REQUIRE(model.diagnostics.size() == 1);
  CHECK(render(model.diagnostics[0]) ==
        "error[BT0005]: `x * x < 100`, in `Eval1_btn1` on line 1, may leave "
        "the 32 bits of Promela's int\n  --> t.btf\n"
        "  = help: give its variables smaller ranges\n");
}

TEST_CASE("divisors nested without end are refused, not written down") {
  Expression nested = x();
  for (int i = 0; i < 60; ++i) {
    nested = Expression::binary(Operation::Divide, number(1), nested);
  }
  CHECK(!shown(nested).is_exact);
}

}  // namespace
}  // namespace btcheck::promela_test
