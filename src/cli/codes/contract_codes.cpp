// SPDX-License-Identifier: MIT
//
// What is found in leaf contracts beside XML trees, and in none of .btf trees.
#include <array>

#include "cli/codes/codes.hpp"

namespace btcheck {
namespace {

constexpr std::array kCodes = {
    CodeRow{
        .code = "BT1638",
        .summary = "a contract names an entry whose values are not known",
        .description =
            "What a contract requires of a blackboard entry, or puts into it, "
            "is followed only where scripts and contracts alone write the "
            "entry. This one may have any value at any time, and what is "
            "required of it may be met or not.",
        .help = "Write a text in quotes, or give the leaves whose ports may "
                "write the entry a contract that names it.",
        .severity = Severity::Warning,
        .example = {.tree = R"(<root BTCPP_format="4">
<BehaviorTree ID="T">
<Fly/>
</BehaviorTree>
<TreeNodesModel><Action ID="Fly"/></TreeNodesModel>
</root>)",
                    .other_name = "robot.leaves",
                    .other = "(defaction Fly :requires (= battery full))",
                    .command = "lint tree.xml --leaves robot.leaves"},
    },
    CodeRow{
        .code = "BT1639",
        .summary = "files of leaf contracts for a .btf tree",
        .description = "--leaves, or `leaves` in a manifest, names contracts "
                       "for XML trees. A .btf tree has its own.",
        .help = "Write the contracts into the file of the tree, and leave the "
                "option out.",
        .severity = Severity::Error,
        .example = {.tree = "(BehaviorTree :name t (Action :ID a))",
                    .other_name = "robot.leaves",
                    .other = "(defaction a :returns (success))",
                    .command = "tree.btf --leaves robot.leaves"},
    }};

}  // namespace

std::span<const CodeRow> contract_codes() { return kCodes; }

}  // namespace btcheck
