// SPDX-License-Identifier: MIT
//
// Models for NuSMV, as text. That they mean what the network means is compared
// in reference/export_cross_check_test.cpp.
#include "model/export/smv/smv.hpp"

#include <doctest/doctest.h>

#include <string>

#include "model/automata/network.hpp"
#include "model/btf_text.hpp"
#include "model/exported_text.hpp"
#include "model/lowering.hpp"

namespace btcheck::smv_test {
namespace {

std::string model_of(std::string_view text, TickSemantics ticks,
                     const std::vector<SmvClaim>& claims = {}) {
  const BehaviorTree tree = tree_of(text);
  auto model = smv_text(tree, lower(tree, ticks), claims);
  REQUIRE(model.value);
  return *model.value;
}

constexpr std::string_view kWeather =
    "(defsv sky :states (Dry Wet) :transitions :all)"
    "(BehaviorTree :name t (Condition :ID c))";

TEST_CASE("an edge of SMV is a value of step, its guard and its effects") {
  const std::string model = model_of(kWeather, TickSemantics::None);
  CHECK(
      model.starts_with("-- t.btf, tick none; made by btcheck\n--\n"
                        "-- line 1    BehaviorTree t_btn0\n"
                        "-- line 1      Condition c_btn1\nMODULE main\n"));
  CHECK(has(model, "  sky : ") == false);
  CHECK(has(model, "  sv_sky : {sv_sky_Dry, sv_sky_Wet};\n"));
  CHECK(has(model, R"(
  -- c_btn1: start_ -> tick_node, is called
  edge_2_may :=
    c_btn1_location = c_btn1_at_start_ & c_btn1_caller != 0;
)"));
  CHECK(has(model, "\nTRANS step = edge_2 -> edge_2_may;\n"));
  CHECK(has(model, "\nTRANS step = time_passes -> !is_urgent;\n"));
  CHECK(has(model, R"(
TRANS next(sv_sky) =
  case
    step = edge_0 :
      sv_sky_Wet;
    step = edge_1 :
      sv_sky_Dry;
    TRUE : sv_sky;
  esac;
)"));
  CHECK(!has(model, "clock"));
  CHECK(!has(model, "progress"));
}

TEST_CASE("a timer of SMV has a clock and goes first") {
  const std::string model =
      model_of("(BehaviorTree :name t (Wait :name w :duration [2,3]))",
               TickSemantics::Root);
  CHECK(has(model, "  w_btn1_timer_clock : 0..3;\n"));
  CHECK(has(model, R"(  timer_is_due :=
    (w_btn1_timer_location = w_btn1_timer_at_counting &
    w_btn1_timer_clock = 3);
)"));
  CHECK(has(model,
            "    w_btn1_timer_clock >= 2 & (w_btn1_timer_clock = 3 | "
            "!timer_is_due);\n"));
}

TEST_CASE("what an update reads is what an earlier one of the edge wrote") {
  const std::string model = model_of(
      "(defsv a :min 0 :max 9) (defsv b :min 0 :max 9)"
      "(defaction x :returns (success) :on-success ((:= a (+ b 1)) (:= b a)))"
      "(BehaviorTree :name t (Action :ID x))",
      TickSemantics::Root);
  CHECK(has(model, "TRANS next(sv_b) =\n  case\n"));
  const std::size_t next = model.find("TRANS next(sv_b)");
  CHECK(model.substr(next, 120).find("sv_b + 1;") != std::string::npos);
}

TEST_CASE("progress is told and asked for where runs are asked about") {
  const Expression wet = Expression::binary(
      Operation::Equal, Expression::variable(0), Expression::constant(1));
  SmvClaim claim;
  claim.name = "rain";
  claim.formula = "!p0";
  claim.propositions.push_back({SmvProposition::Kind::State, wet, {}, {}});
  claim.remarks = {"it stays dry"};
  const std::string single = model_of(kWeather, TickSemantics::Root, {claim});
  CHECK(
      single.ends_with("\n-- it stays dry\nDEFINE\n"
                       "  rain_p0 := sv_sky = sv_sky_Wet;\n"
                       "INVARSPEC NAME rain := !rain_p0;\n"));
  CHECK(!has(single, "progress"));
  claim.kind = SmvClaim::Kind::Linear;
  claim.formula = "G (F p0)";
  const std::string runs = model_of(kWeather, TickSemantics::Root, {claim});
  CHECK(has(runs, "  progress : boolean;\n"));
  CHECK(has(runs, "TRANS next(progress) = !(step in {edge_0, edge_1});\n"));
  CHECK(has(runs, "JUSTICE progress;\n"));
  CHECK(runs.ends_with("LTLSPEC NAME rain := G (F rain_p0);\n"));
}

TEST_CASE("numbers that SMV cannot hold are refused") {
  const BehaviorTree tree = tree_of(
      "(defsv x :min 0 :max 50000)"
      "(BehaviorTree :name t (Eval (< (* x x) 100)))");
  const auto model = smv_text(tree, lower(tree, TickSemantics::Root));
  CHECK(!model.value);
  REQUIRE(model.diagnostics.size() == 1);
  CHECK(model.diagnostics[0].code == "BT0005");
}

}  // namespace
}  // namespace btcheck::smv_test
