// SPDX-License-Identifier: MIT
//
// What BehaviorTree.CPP's XML and the contracts of its leaves leave open or
// probably mean otherwise, and what cannot be checked.
#include <array>

#include "cli/codes/codes.hpp"

namespace btcheck {
namespace {

constexpr std::array kCodes = {
    CodeRow{
        .code = "BT1620",
        .summary = "a leaf that no model has",
        .description = "Neither BehaviorTree.CPP nor Nav2 nor a "
                       "`<TreeNodesModel>` has this node type. It is taken as "
                       "an Action, unless its tag says otherwise.",
        .help = "Describe it in `<TreeNodesModel>`; or nothing, if it is an "
                "Action.",
        .severity = Severity::Note,
        .example = {.body = "<Go/>"},
    },
    CodeRow{
        .code = "BT1621",
        .summary = "an inner node that no model has",
        .description =
            "Neither BehaviorTree.CPP nor Nav2 nor a `<TreeNodesModel>` has "
            "this node type. How it ticks its children is not known.",
        .help = "Correct its name; the case of letters counts.",
        .severity = Severity::Warning,
        .example = {.body = "<inverter><AlwaysSuccess/></inverter>"},
    },
    CodeRow{
        .code = "BT1622",
        .summary = "a file that does not say its version",
        .description = "`<root>` has no `BTCPP_format`. The file is read as "
                       "one of version 3, unless version 4 is asked for.",
        .help = "Write `<root BTCPP_format=\"4\">` for version 4.",
        .severity = Severity::Warning,
        .example = {.tree = R"(<root>
<BehaviorTree ID="T"><AlwaysSuccess/></BehaviorTree>
</root>)"},
    },
    CodeRow{
        .code = "BT1623",
        .summary = "a tag that contradicts the node's kind",
        .description = "The explicit tag is not the kind that the node type "
                       "has. BehaviorTree.CPP goes by the node type.",
        .help = "Write the node type as the tag.",
        .severity = Severity::Warning,
        .example = {.body =
                        R"(<Action ID="Sequence"><AlwaysSuccess/></Action>)"},
    },
    CodeRow{
        .code = "BT1624",
        .summary = "two trees of one ID",
        .description = "The one that is read last takes the place of the "
                       "other, silently in BehaviorTree.CPP.",
        .help = "Give one of them another ID.",
        .severity = Severity::Warning,
        .example = {.tree = R"(<root BTCPP_format="4" main_tree_to_execute="T">
<BehaviorTree ID="T"><AlwaysSuccess/></BehaviorTree>
<BehaviorTree ID="T"><AlwaysFailure/></BehaviorTree>
</root>)"},
    },
    CodeRow{
        .code = "BT1625",
        .summary = "something that BehaviorTree.CPP ignores",
        .description = "An element that stands where nothing reads it, or an "
                       "attribute that looks like a misspelt condition.",
        .help = "Correct the name, or delete it.",
        .severity = Severity::Warning,
        .example = {.tree = R"(<root BTCPP_format="4">
<BehaviorTree ID="T"><AlwaysSuccess/></BehaviorTree>
<Notes/>
</root>)"},
    },
    CodeRow{
        .code = "BT1626",
        .summary = "a port that the model does not have",
        .description = "The node's entry in `<TreeNodesModel>` has no such "
                       "port. BehaviorTree.CPP refuses the tree if the "
                       "program's node has none either.",
        .help = "Correct the name, or add the port to the model.",
        .severity = Severity::Warning,
        .example = {.tree = R"(<root BTCPP_format="4">
<BehaviorTree ID="T"><Go speed="3"/></BehaviorTree>
<TreeNodesModel><Action ID="Go"/></TreeNodesModel>
</root>)"},
    },
    CodeRow{
        .code = "BT1627",
        .summary = "an entry that nothing in the tree writes",
        .description =
            "A script needs the value of an entry that no node of the tree "
            "writes. Without a value, BehaviorTree.CPP stops with an exception "
            "when it runs the script. The program around the tree may set it.",
        .help =
            "Create the entry by `:=` first, or see that the program sets it.",
        .severity = Severity::Warning,
        .example = {.body = R"(<ScriptCondition code="x == 1"/>)"},
    },
    CodeRow{
        .code = "BT1628",
        .summary = "a key that looks misspelt",
        .description =
            "Two entries of one blackboard differ in capitals and underscores "
            "alone, or by one letter where this one is read and nothing in the "
            "tree writes it; and this one is named nowhere else.",
        .help = "Write both the same way.",
        .severity = Severity::Warning,
        .example = {.body = R"(<Sequence>
  <Plan path="{path}"/>
  <Follow path="{Path}"/>
</Sequence>)",
                    .models = R"(
  <Action ID="Plan"><output_port name="path"/></Action>
  <Action ID="Follow"><input_port name="path"/></Action>
)"},
    },
    CodeRow{
        .code = "BT1629",
        .summary = "a branch that is never ticked",
        .description =
            "The children before it can only return what ends the round, the "
            "cases of a Switch are equal, or a loop has no rounds.",
        .help = "Delete the branch, or mend what stands before it.",
        .severity = Severity::Warning,
        .example = {.body = R"(<Fallback>
  <AlwaysSuccess/>
  <AlwaysFailure/>
</Fallback>)"},
    },
    CodeRow{
        .code = "BT1630",
        .summary = "an output port that points at no entry",
        .description = "An output port has a value without braces. "
                       "BehaviorTree.CPP fails when the node writes it.",
        .help = "Write the name of an entry in braces.",
        .severity = Severity::Warning,
        .example = {.tree = R"(<root BTCPP_format="4">
<BehaviorTree ID="T"><Plan path="way"/></BehaviorTree>
<TreeNodesModel>
  <Action ID="Plan"><output_port name="path"/></Action>
</TreeNodesModel>
</root>)"},
    },
    CodeRow{
        .code = "BT1631",
        .summary = "a threshold of 0",
        .description = "With 0, a Parallel decides after its first child, and "
                       "a ParallelAll always fails.",
        .help = "Count from 1.",
        .severity = Severity::Warning,
        .example =
            {.body =
                 R"(<Parallel success_count="0"><AlwaysSuccess/></Parallel>)"},
    },
    CodeRow{
        .code = "BT1632",
        .summary = "a number that is not known before the run",
        .description =
            "A threshold of a Parallel or ParallelAll, or the retries of a "
            "RecoveryNode, is read from the blackboard. What the node does "
            "depends on it in a way that cannot be left open.",
        .help = "Write the number into the tree that is checked.",
        .example =
            {.body =
                 R"(<Parallel success_count="{n}"><AlwaysSuccess/></Parallel>)"},
    },
    CodeRow{
        .code = "BT1633",
        .summary = "a number of rounds that is left open",
        .description =
            "A Repeat or RetryUntilSuccessful reads from the blackboard how "
            "often it goes round. It may then stop after any round.",
        .help = "Write the number to have just that one checked.",
        .severity = Severity::Note,
        .example =
            {.body = R"(<Repeat num_cycles="{n}"><AlwaysSuccess/></Repeat>)"},
    },
    CodeRow{
        .code = "BT1634",
        .summary = "a duration of too many ticks",
        .description = "Time is counted in ticks of the root, and a duration "
                       "of more than 1000 would make the state space as much "
                       "larger. It is taken as 1000.",
        .help = "Let a tick take longer: --tick-ms.",
        .severity = Severity::Warning,
        .example = {.body = R"(<Sleep msec="3600000"/>)"},
    },
    CodeRow{
        .code = "BT1635",
        .summary = "a duration that is left open",
        .description = "A duration is missing or read from the blackboard. The "
                       "node may take any number of ticks.",
        .help = "Write the duration to have just that one checked.",
        .severity = Severity::Note,
        .example = {.body = R"(<Sleep msec="{pause}"/>)"},
    },
    CodeRow{
        .code = "BT1636",
        .summary = "a profile or tick semantics of the other language",
        .description = "The profile `paper` gives .btf trees their meaning, "
                       "and those of BehaviorTree.CPP and Nav2 XML trees. Of "
                       "XML trees time passes at ticks of the root only: "
                       "`--tick leaves` and `--tick nodes` are for .btf trees.",
        .help = "Leave --profile or --tick out, or name one of the file's "
                "language.",
        .example = {.tree = kOneAction,
                    .command = "tree.btf --profile btcpp-4"},
    },
    CodeRow{
        .code = "BT1637",
        .summary = "Nav2's branch is guessed",
        .description =
            "The tree has nodes of Nav2, and nothing says for which of its "
            "branches: XML of version 3 is taken for humble, a node or "
            "attribute that only main has for main, anything else for jazzy. "
            "Some nodes mean different things in them.",
        .help = "Name the branch that runs: --profile nav2-humble, nav2-jazzy "
                "or nav2-main.",
        .severity = Severity::Note,
        .example =
            {.body = "<PipelineSequence><AlwaysSuccess/></PipelineSequence>"},
    },
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
        .example = {.body = "<Fly/>",
                    .models = R"(<Action ID="Fly"/>)",
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
        .example = {.tree = kOneAction,
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
        .example = {.body = R"(<Sequence>
<Script code="battery := 100000"/>
<Script code="battery -= 1"/>
<ScriptCondition code="battery > 5"/>
</Sequence>)"},
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
        .example = {.body = R"(<LoopInt queue="{waypoints}" value="{next}">
<AlwaysSuccess/>
</LoopInt>)"},
    }};

}  // namespace

std::span<const CodeRow> btcpp_finding_codes() { return kCodes; }

}  // namespace btcheck
