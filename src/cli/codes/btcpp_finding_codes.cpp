// SPDX-License-Identifier: MIT
//
// What BehaviorTree.CPP's XML leaves open, or probably means otherwise, and
// what cannot be checked.
#include <array>

#include "cli/codes/codes.hpp"

namespace btcheck {
namespace {

constexpr std::array kCodes = {
    CodeRow{
        .code = "BT1620",
        .summary = "a leaf that no model has",
        .description =
            "Neither BehaviorTree.CPP nor Nav2 nor a "
            "`<TreeNodesModel>` has this node type. It is taken as an "
            "Action, unless its tag says otherwise.",
        .help = "Describe it in `<TreeNodesModel>`; or nothing, if it is "
                "an Action.",
        .severity = Severity::Note,
        .example = {.tree = R"(<root BTCPP_format="4">
<BehaviorTree ID="T">
<Go/>
</BehaviorTree>
</root>)"},
    },
    CodeRow{
        .code = "BT1621",
        .summary = "an inner node that no model has",
        .description =
            "Neither BehaviorTree.CPP nor Nav2 nor a "
            "`<TreeNodesModel>` has this node type. How it ticks its "
            "children is not known.",
        .help = "Correct its name; the case of letters counts.",
        .severity = Severity::Warning,
        .example = {.tree = R"(<root BTCPP_format="4">
<BehaviorTree ID="T">
<inverter><AlwaysSuccess/></inverter>
</BehaviorTree>
</root>)"},
    },
    CodeRow{
        .code = "BT1622",
        .summary = "a file that does not say its version",
        .description =
            "`<root>` has no `BTCPP_format`. The file is read as one "
            "of version 3, unless version 4 is asked for.",
        .help = "Write `<root BTCPP_format=\"4\">` for version 4.",
        .severity = Severity::Warning,
        .example = {.tree = R"(<root>
<BehaviorTree ID="T"><AlwaysSuccess/></BehaviorTree>
</root>)"},
    },
    CodeRow{
        .code = "BT1623",
        .summary = "a tag that contradicts the node's kind",
        .description =
            "The explicit tag is not the kind that the node type has. "
            "BehaviorTree.CPP goes by the node type.",
        .help = "Write the node type as the tag.",
        .severity = Severity::Warning,
        .example = {.tree = R"(<root BTCPP_format="4">
<BehaviorTree ID="T">
<Action ID="Sequence"><AlwaysSuccess/></Action>
</BehaviorTree>
</root>)"},
    },
    CodeRow{
        .code = "BT1624",
        .summary = "two trees of one ID",
        .description =
            "The one that is read last takes the place of the other, "
            "silently in BehaviorTree.CPP.",
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
        .description =
            "The node's entry in `<TreeNodesModel>` has no such port. "
            "BehaviorTree.CPP refuses the tree if the program's node "
            "has none either.",
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
            "A script needs the value of an entry that no node of the "
            "tree writes. Without a value, BehaviorTree.CPP stops with "
            "an exception when it runs the script. The program around "
            "the tree may set it.",
        .help = "Create the entry by `:=` first, or see that the program "
                "sets it.",
        .severity = Severity::Warning,
        .example = {.tree = R"(<root BTCPP_format="4">
<BehaviorTree ID="T">
<ScriptCondition code="x == 1"/>
</BehaviorTree>
</root>)"},
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
        .example = {.tree = R"(<root BTCPP_format="4">
<BehaviorTree ID="T">
<Sequence>
  <Plan path="{path}"/>
  <Follow path="{Path}"/>
</Sequence>
</BehaviorTree>
<TreeNodesModel>
  <Action ID="Plan"><output_port name="path"/></Action>
  <Action ID="Follow"><input_port name="path"/></Action>
</TreeNodesModel>
</root>)"},
    },
    CodeRow{
        .code = "BT1629",
        .summary = "a branch that is never ticked",
        .description =
            "The children before it can only return what ends the "
            "round, the cases of a Switch are equal, or a loop has no "
            "rounds.",
        .help = "Delete the branch, or mend what stands before it.",
        .severity = Severity::Warning,
        .example = {.tree = R"(<root BTCPP_format="4">
<BehaviorTree ID="T">
<Fallback>
  <AlwaysSuccess/>
  <AlwaysFailure/>
</Fallback>
</BehaviorTree>
</root>)"},
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
        .description =
            "With 0, a Parallel decides after its first child, and a "
            "ParallelAll always fails.",
        .help = "Count from 1.",
        .severity = Severity::Warning,
        .example = {.tree = R"(<root BTCPP_format="4">
<BehaviorTree ID="T">
<Parallel success_count="0"><AlwaysSuccess/></Parallel>
</BehaviorTree>
</root>)"},
    },
    CodeRow{
        .code = "BT1632",
        .summary = "a number that is not known before the run",
        .description =
            "A threshold of a Parallel or ParallelAll, or the retries of a "
            "RecoveryNode, is read from the blackboard. What the node does "
            "depends on it in a way that cannot be left open.",
        .help = "Write the number into the tree that is checked.",
        .severity = Severity::Error,
        .example = {.tree = R"(<root BTCPP_format="4">
<BehaviorTree ID="T">
<Parallel success_count="{n}"><AlwaysSuccess/></Parallel>
</BehaviorTree>
</root>)"},
    },
    CodeRow{
        .code = "BT1633",
        .summary = "a number of rounds that is left open",
        .description =
            "A Repeat or RetryUntilSuccessful reads from the blackboard how "
            "often it goes round. It may then stop after any round.",
        .help = "Write the number to have just that one checked.",
        .severity = Severity::Note,
        .example = {.tree = R"(<root BTCPP_format="4">
<BehaviorTree ID="T">
<Repeat num_cycles="{n}"><AlwaysSuccess/></Repeat>
</BehaviorTree>
</root>)"},
    },
    CodeRow{
        .code = "BT1634",
        .summary = "a duration of too many ticks",
        .description =
            "Time is counted in ticks of the root, and a duration of more "
            "than 1000 would make the state space as much larger. It is "
            "taken as 1000.",
        .help = "Let a tick take longer: --tick-ms.",
        .severity = Severity::Warning,
        .example = {.tree = R"(<root BTCPP_format="4">
<BehaviorTree ID="T">
<Sleep msec="3600000"/>
</BehaviorTree>
</root>)"},
    },
    CodeRow{
        .code = "BT1635",
        .summary = "a duration that is left open",
        .description =
            "A duration is missing or read from the blackboard. The node may "
            "take any number of ticks.",
        .help = "Write the duration to have just that one checked.",
        .severity = Severity::Note,
        .example = {.tree = R"(<root BTCPP_format="4">
<BehaviorTree ID="T">
<Sleep msec="{pause}"/>
</BehaviorTree>
</root>)"},
    },
    CodeRow{
        .code = "BT1636",
        .summary = "a profile or tick semantics of the other language",
        .description =
            "The profile `paper` gives .btf trees their meaning, and those of "
            "BehaviorTree.CPP and Nav2 XML trees. Of XML trees time passes at "
            "ticks of the root only: `--tick leaves` and `--tick nodes` are "
            "for .btf trees.",
        .help = "Leave --profile or --tick out, or name one of the file's "
                "language.",
        .severity = Severity::Error,
        .example = {.tree = "(BehaviorTree :name t (Action :ID a))",
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
        .example = {.tree = R"(<root BTCPP_format="4">
<BehaviorTree ID="T">
<PipelineSequence><AlwaysSuccess/></PipelineSequence>
</BehaviorTree>
</root>)"},
    }};

}  // namespace

std::span<const CodeRow> btcpp_finding_codes() { return kCodes; }

}  // namespace btcheck
