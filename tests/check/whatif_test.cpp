// SPDX-License-Identifier: MIT
//
// What the mission does when something breaks, on trees where it is plain.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "check/replay/replay.hpp"
#include "check/whatif/whatif.hpp"

namespace btcheck::whatif_test {
namespace {

std::string xml(std::string_view tree, std::string_view models = "") {
  return fmt::format(
      "<root BTCPP_format=\"4\">\n<BehaviorTree ID=\"T\">\n{}\n"
      "</BehaviorTree>\n<TreeNodesModel>{}</TreeNodesModel>\n</root>\n",
      tree, models);
}

constexpr std::string_view kModels =
    "<Action ID=\"Dock\"/><Action ID=\"Undock\"/><Action ID=\"Photo\"/>"
    "<Action ID=\"Move\"/><Action ID=\"StartLamp\"/><Action ID=\"StopLamp\"/>"
    "<Condition ID=\"IsDocked\"/>";

struct Asked {
  WhatIfInput input;
  WhatIf result;
};

Asked ask(const std::string& text, const std::string& rules = "",
          WhatIfOptions options = {}, const std::string& leaves = "") {
  TreeInput tree("t.xml", FileText(text));
  if (!leaves.empty()) tree.reading.leaves = {{"t.leaves", FileText(leaves)}};
  std::vector<InputFile> files;
  if (!rules.empty()) files.push_back({"t.ltl", FileText(rules)});
  auto input = what_if_input(tree, files);
  std::string told;
  for (const Diagnostic& each : input.diagnostics) told += render(each);
  REQUIRE_MESSAGE(input.value.has_value(), told);
  auto result = what_if(*input.value, options);
  REQUIRE(result.value.has_value());
  CHECK(result.value->error.empty());
  return {std::move(*input.value), std::move(*result.value)};
}

const FaultRow& row_of(const Asked& asked, std::string_view leaf,
                       FaultKind kind) {
  const auto row =
      std::ranges::find_if(asked.result.rows, [&](const FaultRow& each) {
        return asked.input.tree.node(each.faults[0].leaf).name == leaf &&
               each.faults[0].fault.kind == kind;
      });
  REQUIRE_MESSAGE(row != asked.result.rows.end(),
                  leaf << " " << facts_of(kind).word);
  return *row;
}

std::string harm(const Asked& asked, std::string_view leaf, FaultKind kind) {
  return std::string(facts_of(row_of(asked, leaf, kind).harm).word);
}

std::string name(const Asked& asked, NodeId node) {
  return asked.input.tree.node(node).name;
}

}  // namespace

TEST_CASE("a failure that is swallowed is a silent loss") {
  const auto asked =
      ask(xml("<Sequence><Undock/><ForceSuccess><Photo/></ForceSuccess><Dock/>"
              "</Sequence>",
              kModels));
  CHECK(asked.result.healthy.succeeds);
  CHECK(!asked.result.healthy.fails);
  using enum FaultKind;
  for (const FaultKind kind : {Fails, FailsOnce, FailsOn}) {
    CHECK(harm(asked, "Photo", kind) == "silent");
    CHECK(!row_of(asked, "Photo", kind).notice);
    CHECK(harm(asked, "Dock", kind) == "fails");
  }
  CHECK(harm(asked, "Photo", NeverEnds) == "never-ends");
  CHECK(harm(asked, "Photo", Throws) == "throws");
  const FaultRow& dock = row_of(asked, "Dock", Fails);
  REQUIRE(dock.notice);
  CHECK(name(asked, dock.notice->node) == "Sequence");
  CHECK(dock.notice->ticks == 0);
  CHECK(dock.within == 0);
}

TEST_CASE("what a healthy run need not have done is no loss") {
  const auto asked = ask(
      xml("<Parallel success_count=\"1\"><Photo/><Dock/></Parallel>", kModels));
  const FaultRow& row = row_of(asked, "Photo", FaultKind::NeverEnds);
  CHECK(row.effect.succeeds);
  CHECK(row.harm != Harm::Silent);
}

TEST_CASE("a retry mends what fails once, and tells of what fails for ever") {
  const auto asked =
      ask(xml("<RetryUntilSuccessful num_attempts=\"3\"><Dock/>"
              "</RetryUntilSuccessful>",
              kModels));
  const FaultRow& once = row_of(asked, "Dock", FaultKind::FailsOnce);
  CHECK(once.harm == Harm::Survives);
  REQUIRE(once.recovery);
  CHECK(name(asked, once.recovery->caught_by) == "RetryUntilSuccessful");
  CHECK(once.recovery->is_asked_again);
  CHECK(harm(asked, "Dock", FaultKind::Fails) == "fails");
}

TEST_CASE("a fallback goes on with what no healthy run asks") {
  const auto asked = ask(xml("<Fallback><Dock/><Move/></Fallback>", kModels));
  const FaultRow& row = row_of(asked, "Dock", FaultKind::Fails);
  CHECK(row.harm == Harm::Survives);
  REQUIRE(row.recovery);
  REQUIRE(row.recovery->through.size() == 1);
  CHECK(name(asked, row.recovery->through[0]) == "Move");
  REQUIRE(row.notice);
  CHECK(name(asked, row.notice->node) == "Move");
  CHECK(harm(asked, "Move", FaultKind::Fails) == "not-asked");
}

TEST_CASE("pairs: the second way out breaks as well") {
  WhatIfOptions options;
  options.order = 2;
  const auto asked =
      ask(xml("<Fallback><Dock/><Move/></Fallback>", kModels), "", options);
  const auto fails =
      std::ranges::find_if(asked.result.cut_sets, [](const CutSets& cut) {
        return cut.event.kind == TopEvent::Kind::Fails;
      });
  REQUIRE(fails != asked.result.cut_sets.end());
  CHECK(fails->sets.size() == 9);  // each of three ways to fail, of both
  for (const auto& set : fails->sets) CHECK(set.size() == 2);
  CHECK(asked.result.pairs_searched < asked.result.pairs_in_all + 1);
}

TEST_CASE("a Timeout ends what never ends, and healthy leaves are in time") {
  const auto asked =
      ask(xml("<Fallback><Timeout msec=\"1000\"><Dock/></Timeout><Move/>"
              "</Fallback>",
              kModels));
  CHECK(!asked.result.healthy.fails);
  const FaultRow& row = row_of(asked, "Dock", FaultKind::NeverEnds);
  CHECK(row.harm == Harm::Survives);
  REQUIRE(row.notice);
  CHECK(name(asked, row.notice->node) == "Timeout");
  REQUIRE(row.recovery);
  CHECK(harm(asked, "Dock", FaultKind::EndsLate) == "survives");
  CHECK(row_of(asked, "Dock", FaultKind::EndsLate).notice);
}

TEST_CASE("what was switched on stays on") {
  const auto asked =
      ask(xml("<Sequence><StartLamp/><Move/><StopLamp/></Sequence>", kModels));
  CHECK(asked.result.healthy.left_on.empty());
  const FaultRow& row = row_of(asked, "Move", FaultKind::Fails);
  CHECK(row.harm == Harm::LeftOn);
  REQUIRE(row.effect.left_on.size() == 1);
  CHECK(name(asked, row.effect.left_on[0]) == "StartLamp");
  // That the lamp itself cannot be switched on leaves nothing on.
  CHECK(harm(asked, "StartLamp", FaultKind::Fails) == "fails");
}

TEST_CASE("rules that hold without faults, and break with one") {
  const auto asked =
      ask(xml("<Sequence><Undock/><ForceSuccess><Photo/></ForceSuccess><Dock/>"
              "</Sequence>",
              kModels),
          "property photographed: always Dock.ticked -> once Photo.success\n"
          "property never_docks: never Dock.success\n");
  REQUIRE(asked.result.rules.size() == 1);
  REQUIRE(asked.result.rules[0].properties.size() == 1);
  CHECK(asked.result.rules[0].properties[0].name == "photographed");
  CHECK(asked.result.broken_rules == std::vector<std::string>{"never_docks"});
  const FaultRow& row = row_of(asked, "Photo", FaultKind::Fails);
  REQUIRE(row.effect.broken.size() == 1);
  CHECK(row.harm == Harm::Silent);  // worse than the rule
  const bool has_event =
      std::ranges::any_of(asked.result.cut_sets, [](const CutSets& cut) {
        return cut.event.kind == TopEvent::Kind::Rule && cut.sets.size() == 3;
      });
  CHECK(has_event);
}

TEST_CASE("conditions say yes or no for ever") {
  const auto asked =
      ask(xml("<RetryUntilSuccessful num_attempts=\"-1\">"
              "<Sequence><Dock/><IsDocked/></Sequence></RetryUntilSuccessful>",
              kModels));
  CHECK(harm(asked, "IsDocked", FaultKind::Fails) == "never-ends");
  CHECK(harm(asked, "IsDocked", FaultKind::Succeeds) == "survives");
  // What the world may answer anyway is left out by name.
  const bool is_named = std::ranges::any_of(
      asked.result.possible.left_out, [&](const OmittedFaults& each) {
        return std::ranges::find(each.kinds, FaultKind::FlipsOnce) !=
                   each.kinds.end() ||
               std::ranges::find(each.kinds, FaultKind::FailsOnce) !=
                   each.kinds.end();
      });
  CHECK(is_named);
}

TEST_CASE("every run that is kept is one of the faulty tree") {
  const auto asked = ask(xml(
      "<Sequence><Undock/><RetryUntilSuccessful num_attempts=\"2\"><Move/>"
      "</RetryUntilSuccessful><Fallback><Dock/><Move name=\"M2\"/></Fallback>"
      "<IsDocked/></Sequence>",
      kModels));
  std::size_t runs = 0;
  for (const FaultRow& row : asked.result.rows) {
    if (row.steps.empty()) continue;
    const RowNetwork made =
        network_of(asked.input, asked.result, row, TickSemantics::Root);
    const NetworkInterpreter interpreter(made.network);
    Valuation state = interpreter.initial();
    for (const Step& step : row.steps) {
      const auto next = interpreter.taken(state, step);
      REQUIRE(next);
      state = *next;
    }
    ++runs;
  }
  CHECK(runs > 20);
}

TEST_CASE("without a fault that strikes there is none to tell of") {
  const auto asked = ask(xml("<AlwaysSuccess/>"));
  CHECK(asked.result.rows.empty());
  CHECK(asked.result.score().total() == 0);
}

}  // namespace btcheck::whatif_test
