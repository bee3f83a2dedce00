// SPDX-License-Identifier: MIT
//
// What is said of node types in several tables: that it agrees, and who is
// named where it does not.
#include <doctest/doctest.h>

#include <stdexcept>
#include <string>
#include <vector>

#include "btf_text.hpp"
#include "model/automata/builder.hpp"
#include "model/export/conversion.hpp"
#include "model/lowering.hpp"
#include "model/tree/node_types.hpp"

namespace btcheck::node_types_test {
namespace {

using mapping::Drawing;
using mapping::Drawings;

void draw_nothing(mapping::NodeBuilder&) {}

std::vector<Drawing> all_of(In language) {
  std::vector<Drawing> all;
  for (const NodeTypeInfo& info : kNodeTypes) {
    if (has(info.in, language)) all.push_back({info.type, draw_nothing});
  }
  return all;
}

TEST_CASE("a language draws each of its types once, and no other") {
  std::vector<Drawing> all = all_of(In::PyTrees);
  CHECK_NOTHROW(Drawings(In::PyTrees, {all}));
  all.push_back({NodeType::SetSV, draw_nothing});
  CHECK_THROWS_WITH_AS(Drawings(In::PyTrees, {all}),
                       "SetSV is drawn for a language without it",
                       std::logic_error);
  all.back() = {NodeType::EternalGuard, draw_nothing};
  CHECK_THROWS_WITH_AS(Drawings(In::PyTrees, {all}),
                       "EternalGuard is drawn twice", std::logic_error);
  all = all_of(In::PyTrees);
  all.pop_back();
  CHECK_THROWS_WITH_AS(Drawings(In::PyTrees, {all}),
                       "AnswerQueue has no drawing", std::logic_error);
}

TEST_CASE("every language has its drawings") {
  BehaviorTree tree = tree_of("(BehaviorTree :name t (Action :name a))");
  for (const Profile profile :
       {Profile::Paper, Profile::Btcpp4, Profile::PyTrees}) {
    tree.profile = profile;
    CHECK_NOTHROW(lower(tree, TickSemantics::Root));
  }
}

TEST_CASE("what .btf and BehaviorTree.CPP both have is converted") {
  for (const NodeTypeInfo& info : kNodeTypes) {
    CAPTURE(info.name);
    const bool have_both = has(info.in, In::Btf) && has(info.in, In::Btcpp);
    CHECK((counterpart_of(info.type) != nullptr) == have_both);
  }
}

TEST_CASE("who goes round counts that in a local of this role") {
  const Network network =
      lower(tree_of("(BehaviorTree :name t (Sequence"
                    " (Recovery :num_retries 2 (Action) (Action))"
                    " (Repeat :repeat 2 (Action))"
                    " (RetryUntilSuccessful :num_attempts 2 (Action))))"),
            TickSemantics::Root);
  const auto name = [&](std::uint32_t node) {
    const auto local = local_of(network, NodeId{node}, LocalRole::Rounds);
    return local ? network.variable(*local).name : std::string();
  };
  CHECK(name(1).empty());  // the Sequence
  CHECK(name(2) == "retry");
  CHECK(name(5) == "count");
  CHECK(name(7) == "count");
  CHECK(name(8).empty());  // an Action
}

}  // namespace
}  // namespace btcheck::node_types_test
