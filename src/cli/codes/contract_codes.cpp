// SPDX-License-Identifier: MIT
//
// What is found in leaf contracts beside XML trees, and what of these trees is
// left open.
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
    },
    CodeRow{
        .code = "BT1640",
        .summary = "a blackboard entry is left open",
        .description =
            "The values that scripts can give an entry are found out before "
            "the search. Of this entry they are not: a port of some leaf may "
            "write it, it takes too many values, or its numbers are told apart "
            "only as far as the scripts compare them. Any value is allowed "
            "then: a rule that holds does so for the real values, too, and "
            "every run that is shown has been executed with them. Where that "
            "does not succeed the verdict is UNDECIDED, with the reason.",
        .help = "Write a contract for the leaf whose port writes the entry; "
                "let counters stop at a bound.",
        .severity = Severity::Note,
        .example = {.tree = R"(<root BTCPP_format="4">
<BehaviorTree ID="T">
<Sequence>
<Script code="battery := 100000"/>
<Script code="battery -= 1"/>
<ScriptCondition code="battery > 5"/>
</Sequence>
</BehaviorTree>
</root>)"},
    },
    CodeRow{
        .code = "BT1641",
        .summary = "a type of node that is not modelled exactly",
        .description =
            "What nodes of this type do depends on something that is outside "
            "the tree, or that is not kept: a pose, a path, a request, when an "
            "entry was written. Whatever can come of it is allowed: a rule "
            "that holds does so for the real node, too, but a run that is "
            "shown may need something that never happens.",
        .help = "Look whether the run that is shown can happen.",
        .severity = Severity::Note,
        .example = {.tree = R"(<root BTCPP_format="4">
<BehaviorTree ID="T">
<LoopInt queue="{waypoints}" value="{next}">
<AlwaysSuccess/>
</LoopInt>
</BehaviorTree>
</root>)"},
    }};

}  // namespace

std::span<const CodeRow> contract_codes() { return kCodes; }

}  // namespace btcheck
