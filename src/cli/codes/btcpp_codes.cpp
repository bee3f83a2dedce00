// SPDX-License-Identifier: MIT
//
// What is found in BehaviorTree.CPP's XML.
#include <array>

#include "cli/codes/codes.hpp"

namespace btcheck {
namespace {

constexpr std::array kCodes = {
    CodeRow{
        .code = "BT1600",
        .summary = "a file is not XML",
        .description =
            "The file cannot be read as XML. tinyxml2 reads it, as in "
            "BehaviorTree.CPP: a raw `&` or `<` in an attribute "
            "passes, but every tag must be closed by its own name, and "
            "every attribute have one quoted value.",
        .help = "Close the tag or quote the attribute in that line.",
        .severity = Severity::Error,
    },
    CodeRow{
        .code = "BT1601",
        .summary = "the first element is not `<root>`",
        .description =
            "Trees of BehaviorTree.CPP stand inside one element called "
            "root.",
        .help = "Put the trees into `<root BTCPP_format=\"4\">` and "
                "`</root>`.",
        .severity = Severity::Error,
    },
    CodeRow{
        .code = "BT1602",
        .summary = "XML that is too large",
        .description =
            "Tags nested more than 100 deep, more than 65535 nodes with all "
            "subtrees in their places, paths of nodes of more than 64 MiB "
            "together, more than 1000 files, or a file of more than 16 MiB.",
        .help = "Move a part into a tree of its own, or use fewer subtrees.",
        .severity = Severity::Error,
    },
    CodeRow{
        .code = "BT1603",
        .summary = "a file that cannot be included",
        .description = "The file of an `<include>` does not exist, cannot be "
                       "read, or includes itself. BehaviorTree.CPP would read "
                       "such a circle until its memory is gone.",
        .help = "Correct the path: it counts from the folder of the file "
                "that includes.",
        .severity = Severity::Error,
    },
    CodeRow{
        .code = "BT1604",
        .summary = "a missing or misplaced ID",
        .description =
            "`<Action>`, `<Condition>`, `<Control>`, `<Decorator>` and "
            "`<SubTree>` need the attribute `ID`, and so does a tree "
            "that is not alone in its file. A tag that is the node "
            "type itself takes none. Ports in models need a `name`.",
        .help = "Write `ID=\"…\"`, or delete it where the tag says the "
                "type.",
        .severity = Severity::Error,
    },
    CodeRow{
        .code = "BT1605",
        .summary = "a name that BehaviorTree.CPP does not allow",
        .description =
            "IDs of trees and node types and the names of ports have "
            "no blanks, control characters or any of `< > & \" ' / \\ "
            ": * ? | .`, are not empty, and are not `root`. A port "
            "begins with no digit, and is no attribute of the engine. "
            "Version 3 allows more.",
        .help = "Use letters, digits and `_`.",
        .severity = Severity::Error,
    },
    CodeRow{
        .code = "BT1606",
        .summary = "a name that is taken",
        .description =
            "A tree has the ID of a node type, two SubTrees under one "
            "parent tree have one name, or a file has two lists of "
            "models.",
        .help = "Give one of them another name; make one list of two.",
        .severity = Severity::Error,
    },
    CodeRow{
        .code = "BT1607",
        .summary = "wrong number of children",
        .description =
            "Decorators have one child, leaves none, IfThenElse and "
            "WhileDoElse two or three, a Switch one more than it has "
            "cases, RecoveryNode two, TryCatch at least two. Some of "
            "this BehaviorTree.CPP only finds when it ticks the node.",
        .help = "Add or delete children; several children of a decorator "
                "stand in a Sequence or Fallback.",
        .severity = Severity::Error,
    },
    CodeRow{
        .code = "BT1608",
        .summary = "a way of version 3 in a tree of version 4",
        .description =
            "`<SubTreePlus>`, and the ID of a tree used as a tag, are "
            "known to BehaviorTree.CPP 3 only.",
        .help = "Write `<SubTree ID=\"…\"/>`, with `_autoremap=\"true\"` "
                "for SubTreePlus.",
        .severity = Severity::Error,
    },
    CodeRow{
        .code = "BT1609",
        .summary = "a port that the node does not have",
        .description =
            "BehaviorTree.CPP refuses a tree in which a node of its "
            "own has an attribute that is none of its ports. Version "
            "3's `success_threshold` and `failure_threshold` of "
            "Parallel are `success_count` and `failure_count` in "
            "version 4.",
        .help = "Correct the name, or delete the attribute.",
        .severity = Severity::Error,
    },
    CodeRow{
        .code = "BT1610",
        .summary = "a port's value of the wrong type",
        .description =
            "A value without braces must be one of the port's type: a "
            "number, a Boolean, or a status like SUCCESS.",
        .help = "Correct the value; an entry of the blackboard is written "
                "in braces.",
        .severity = Severity::Error,
    },
    CodeRow{
        .code = "BT1611",
        .summary = "it is open which tree runs",
        .description =
            "There is no tree, none of the name that is asked for, or "
            "there are several and nothing says which one runs.",
        .help = "Write `<root main_tree_to_execute=\"…\">`.",
        .severity = Severity::Error,
    },
    CodeRow{
        .code = "BT1612",
        .summary = "a subtree that does not exist",
        .description =
            "No file that is read has a tree of the ID that a SubTree "
            "names.",
        .help = "Correct the ID, or include the file that has the tree.",
        .severity = Severity::Error,
    },
    CodeRow{
        .code = "BT1613",
        .summary = "a tree that contains itself",
        .description = "A SubTree names a tree that it stands in, directly or "
                       "through others. Such a tree would never end.",
        .help = "Repeat by Repeat, RetryUntilSuccessful or "
                "KeepRunningUntilFailure.",
        .severity = Severity::Error,
    },
    CodeRow{
        .code = "BT1614",
        .summary = "a port of a subtree is not remapped",
        .description =
            "The subtree's model in `<TreeNodesModel>` has a port "
            "without a default, and the SubTree neither remaps it nor "
            "has `_autoremap`.",
        .help = "Remap the port, or give it a default in the model.",
        .severity = Severity::Error,
    },
    CodeRow{
        .code = "BT1615",
        .summary = "a script that is none",
        .description = "A pre- or postcondition, or the code of a Script, does "
                       "not follow the language: an operand or bracket is "
                       "missing, the script is empty, or a character means "
                       "nothing.",
        .help = "Complete the script; strings stand in single quotes.",
        .severity = Severity::Error,
    },
    CodeRow{
        .code = "BT1616",
        .summary = "a blackboard entry of two types",
        .description = "Two ports of different types name one entry. The first "
                       "one decides its type, and BehaviorTree.CPP refuses the "
                       "other.",
        .help = "Use two entries.",
        .severity = Severity::Error,
    },
    CodeRow{
        .code = "BT1617",
        .summary = "a mandatory port is missing",
        .description =
            "The node cannot run without this port. BehaviorTree.CPP "
            "says so only when it ticks the node, by an exception.",
        .help = "Write the port.",
        .severity = Severity::Error,
    },
    CodeRow{
        .code = "BT1618",
        .summary = "a threshold above the number of children",
        .description =
            "A Parallel waits for more children than it has. "
            "BehaviorTree.CPP says so only when it ticks the node, by "
            "an exception.",
        .help = "Lower the threshold, or write -1 for all children.",
        .severity = Severity::Error,
    },
    CodeRow{
        .code = "BT1619",
        .summary = "children that a ReactiveSequence refuses",
        .description =
            "BehaviorTree.CPP 4.7 to 4.10 do not know the explicit "
            "form, `<Condition ID=\"…\"/>`, directly under a "
            "ReactiveSequence, and refuse a second AsyncSequence there.",
        .help = "Write the node type as the tag; put the second "
                "AsyncSequence elsewhere.",
        .severity = Severity::Error,
    },
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
    },
    CodeRow{
        .code = "BT1622",
        .summary = "a file that does not say its version",
        .description =
            "`<root>` has no `BTCPP_format`. The file is read as one "
            "of version 3, unless version 4 is asked for.",
        .help = "Write `<root BTCPP_format=\"4\">` for version 4.",
        .severity = Severity::Warning,
    },
    CodeRow{
        .code = "BT1623",
        .summary = "a tag that contradicts the node's kind",
        .description =
            "The explicit tag is not the kind that the node type has. "
            "BehaviorTree.CPP goes by the node type.",
        .help = "Write the node type as the tag.",
        .severity = Severity::Warning,
    },
    CodeRow{
        .code = "BT1624",
        .summary = "two trees of one ID",
        .description =
            "The one that is read last takes the place of the other, "
            "silently in BehaviorTree.CPP.",
        .help = "Give one of them another ID.",
        .severity = Severity::Warning,
    },
    CodeRow{
        .code = "BT1625",
        .summary = "something that BehaviorTree.CPP ignores",
        .description = "An element that stands where nothing reads it, or an "
                       "attribute that looks like a misspelt condition.",
        .help = "Correct the name, or delete it.",
        .severity = Severity::Warning,
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
    },
    CodeRow{
        .code = "BT1630",
        .summary = "an output port that points at no entry",
        .description = "An output port has a value without braces. "
                       "BehaviorTree.CPP fails when the node writes it.",
        .help = "Write the name of an entry in braces.",
        .severity = Severity::Warning,
    },
    CodeRow{
        .code = "BT1631",
        .summary = "a threshold of 0",
        .description =
            "With 0, a Parallel decides after its first child, and a "
            "ParallelAll always fails.",
        .help = "Count from 1.",
        .severity = Severity::Warning,
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
    },
    CodeRow{
        .code = "BT1633",
        .summary = "a number of rounds that is left open",
        .description =
            "A Repeat or RetryUntilSuccessful reads from the blackboard how "
            "often it goes round. It may then stop after any round.",
        .help = "Write the number to have just that one checked.",
        .severity = Severity::Note,
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
    },
    CodeRow{
        .code = "BT1635",
        .summary = "a duration that is left open",
        .description =
            "A duration is missing or read from the blackboard. The node may "
            "take any number of ticks.",
        .help = "Write the duration to have just that one checked.",
        .severity = Severity::Note,
    },
    CodeRow{
        .code = "BT1636",
        .summary = "a profile of the other language",
        .description =
            "The profile `paper` gives .btf trees their meaning, and those of "
            "BehaviorTree.CPP and Nav2 XML trees.",
        .help = "Leave --profile out, or name one of the file's language.",
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
    }};

}  // namespace

std::span<const CodeRow> btcpp_codes() { return kCodes; }

}  // namespace btcheck
