// SPDX-License-Identifier: MIT
//
// BehaviorTree.CPP's XML: mistakes, what is left open, and contracts of leaves
// beside it.
#include "report/codes/codes.hpp"

namespace btcheck {
namespace {

constexpr CodeRow kBtcppCodes[] = {
    {.code = "BT1600",
     .summary = "a file is not XML",
     .description = "The file cannot be read as XML. tinyxml2 reads it, as in "
                    "BehaviorTree.CPP: a raw `&` or `<` in an attribute "
                    "passes, but every tag must be closed by its own name, and "
                    "every attribute have one quoted value.",
     .help = "Close the tag or quote the attribute in that line.",
     .example = {.tree = R"(<root BTCPP_format="4">
<BehaviorTree ID="T"><AlwaysSuccess>)"}},
    {.code = "BT1601",
     .summary = "the first element is not `<root>`",
     .description =
         "Trees of BehaviorTree.CPP stand inside one element called root.",
     .help = "Put the trees into `<root BTCPP_format=\"4\">` and `</root>`.",
     .example =
         {.tree = R"(<BehaviorTree ID="T"><AlwaysSuccess/></BehaviorTree>)"}},
    {.code = "BT1602",
     .summary = "XML that is too large",
     .description =
         "Tags nested more than 100 deep, more than 1000 attributes in a tag, "
         "more than 65535 nodes with all "
         "subtrees in their places, paths of nodes of more than 64 MiB "
         "together, more than 1000 files, or a file of more than 16 MiB.",
     .help = "Move a part into a tree of its own, or use fewer subtrees.",
     .example = {.command =
                     "$ yes '<Inverter>' | head -n 1000 > tree.xml\ntree.xml"}},
    {.code = "BT1603",
     .summary = "a file that cannot be included",
     .description = "An `<include>` names no file, or its file does not exist, "
                    "cannot be read, or includes itself. BehaviorTree.CPP "
                    "would read such a circle until it runs out of memory.",
     .help = "Correct the path: it counts from the folder of the file that "
             "includes.",
     .example = {.tree = R"(<root BTCPP_format="4">
<include path="other.xml"/>
<BehaviorTree ID="T"><AlwaysSuccess/></BehaviorTree>
</root>)"}},
    {.code = "BT1604",
     .summary = "a missing or misplaced ID",
     .description = "`<Action>`, `<Condition>`, `<Control>`, `<Decorator>` and "
                    "`<SubTree>` need the attribute `ID`, and so does a tree "
                    "that is not alone in its file. A tag that is the node "
                    "type itself takes none. Ports in models need a `name`.",
     .help = "Write `ID=\"…\"`, or delete it where the tag says the type.",
     .example = {.body = "<SubTree/>"}},
    {.code = "BT1605",
     .summary = "a name that BehaviorTree.CPP does not allow",
     .description =
         "IDs of trees and node types and the names of ports have no blanks, "
         "control characters or any of `< > & \" ' / \\ : * ? | .`, are not "
         "empty, and are not `root`. A port begins with no digit, and is no "
         "attribute of the engine. Version 3 allows more, and version 4 looks "
         "at IDs since 4.8.4: without --profile a file is not refused for "
         "them (BT1651).",
     .help = "Use letters, digits and `_`.",
     .example = {.tree = R"(<root BTCPP_format="4">
<BehaviorTree ID="my tree"><AlwaysSuccess/></BehaviorTree>
</root>)",
                 .command = "tree.xml --profile btcpp-4"}},
    {.code = "BT1606",
     .summary = "a name that is taken",
     .description =
         "A tree has the ID of a node type, two SubTrees under one parent tree "
         "have one name, or a file has two lists of models. The first two are "
         "refused since 4.6.2 and 4.8.4: without --profile BT1651 says so.",
     .help = "Give one of them another name; make one list of two.",
     .example = {.tree = R"(<root BTCPP_format="4">
<BehaviorTree ID="Sequence"><AlwaysSuccess/></BehaviorTree>
</root>)",
                 .command = "tree.xml --profile btcpp-4"}},
    {.code = "BT1607",
     .summary = "wrong number of children",
     .description =
         "Decorators have one child, leaves none, IfThenElse and WhileDoElse "
         "two or three, a Switch one more than it has cases, RecoveryNode two, "
         "TryCatch at least two. A tree has one node at its top. Some of this "
         "BehaviorTree.CPP only finds when it ticks the node.",
     .help = "Add or delete children; several children of a decorator stand in "
             "a Sequence or Fallback.",
     .example = {.body = R"(<Inverter>
  <AlwaysSuccess/>
  <AlwaysFailure/>
</Inverter>)"}},
    {.code = "BT1608",
     .summary = "a form of version 3 in a tree of version 4",
     .description = "`<SubTreePlus>`, the ID of a tree used as a tag, "
                    "BlackboardCheckInt and its like, and RetryUntilSuccesful "
                    "are known to BehaviorTree.CPP 3 only.",
     .help = "Write `<SubTree ID=\"…\"/>`, with `_autoremap=\"true\"` for "
             "SubTreePlus; Precondition or ScriptCondition for a check.",
     .example = {.tree = R"(<root BTCPP_format="4" main_tree_to_execute="T">
<BehaviorTree ID="T"><SubTreePlus ID="S"/></BehaviorTree>
<BehaviorTree ID="S"><AlwaysSuccess/></BehaviorTree>
</root>)"}},
    {.code = "BT1609",
     .summary = "a port that the node does not have",
     .description =
         "BehaviorTree.CPP refuses a tree in which a node of its own has an "
         "attribute that is none of its ports. Version 3's `success_threshold` "
         "and `failure_threshold` of Parallel are `success_count` and "
         "`failure_count` in version 4.",
     .help = "Correct the name, or delete the attribute.",
     .example =
         {.body =
              R"(<Repeat num_cycles="3" times="3"><AlwaysSuccess/></Repeat>)"}},
    {.code = "BT1610",
     .summary = "a port's value of the wrong type",
     .description = "A value without braces must be one of the port's type: a "
                    "number, a Boolean, or a status like SUCCESS. That of an "
                    "output port is read as well, when the tree is loaded.",
     .help =
         "Correct the value; an entry of the blackboard is written in braces.",
     .example =
         {.body = R"(<Repeat num_cycles="often"><AlwaysSuccess/></Repeat>)"}},
    {.code = "BT1611",
     .summary = "no tree to run, or nothing says which",
     .description = "There is no tree, none of the name that is asked for, or "
                    "there are several and nothing says which one runs.",
     .help = "Name it by --main-tree, or write `<root "
             "main_tree_to_execute=\"…\">`. A check without rules is of each.",
     .example = {.tree = R"(<root BTCPP_format="4">
<BehaviorTree ID="T"><AlwaysSuccess/></BehaviorTree>
<BehaviorTree ID="S"><AlwaysSuccess/></BehaviorTree>
</root>)",
                 .command = "space tree.xml"}},
    {.code = "BT1612",
     .summary = "a subtree that does not exist",
     .description =
         "No file that is read has a tree of the ID that a SubTree names.",
     .help = "Correct the ID, or include the file that has the tree. Where "
             "another package has it, describe it as a leaf in --leaves.",
     .example = {.body = R"(<SubTree ID="S"/>)"}},
    {.code = "BT1613",
     .summary = "a tree that contains itself",
     .description = "A SubTree names a tree that it stands in, directly or "
                    "through others. Such a tree would never end.",
     .help =
         "Repeat by Repeat, RetryUntilSuccessful or KeepRunningUntilFailure.",
     .example = {.body = R"(<SubTree ID="T"/>)"}},
    {.code = "BT1614",
     .summary = "a port of a subtree is not remapped",
     .description =
         "The subtree's model in `<TreeNodesModel>` has a port without a "
         "default, and the SubTree neither remaps it nor has `_autoremap`.",
     .help = "Remap the port, or give it a default in the model.",
     .example = {.tree = R"(<root BTCPP_format="4" main_tree_to_execute="T">
<BehaviorTree ID="T"><SubTree ID="S"/></BehaviorTree>
<BehaviorTree ID="S"><AlwaysSuccess/></BehaviorTree>
<TreeNodesModel>
  <SubTree ID="S"><input_port name="goal"/></SubTree>
</TreeNodesModel>
</root>)"}},
    {.code = "BT1615",
     .summary = "a script that cannot be read",
     .description =
         "A pre- or postcondition, or the code of a Script, does not follow "
         "the language: an operand or bracket is missing, the script is empty, "
         "or a character means nothing.",
     .help = "Complete the script; strings stand in single quotes.",
     .example = {.body = R"(<Script code="x := "/>)"}},
    {.code = "BT1616",
     .summary = "a blackboard entry of two types",
     .description =
         "Two ports of different types name one entry. The first one decides "
         "its type, and BehaviorTree.CPP refuses the other. It reads no "
         "models: "
         "where one of the types stands only there, this is a warning.",
     .help = "Use two entries, or correct the model.",
     .example = {.body = R"(<Sequence>
  <Sleep msec="{x}"/>
  <Repeat num_cycles="{x}"><AlwaysSuccess/></Repeat>
</Sequence>)"}},
    {.code = "BT1617",
     .summary = "a mandatory port is missing",
     .description = "The node cannot run without this port. BehaviorTree.CPP "
                    "says so only when it ticks the node, by an exception.",
     .help = "Write the port.",
     .example = {.body = "<Repeat><AlwaysSuccess/></Repeat>"}},
    {.code = "BT1618",
     .summary = "a threshold above the number of children",
     .description =
         "A Parallel waits for more children than it has. BehaviorTree.CPP "
         "says so only when it ticks the node, by an exception.",
     .help = "Lower the threshold, or write -1 for all children (from 3.8 on).",
     .example =
         {.body =
              R"(<Parallel success_count="2"><AlwaysSuccess/></Parallel>)"}},
    {.code = "BT1619",
     .summary = "children that a ReactiveSequence refuses",
     .description =
         "BehaviorTree.CPP 4.7 to 4.10 do not know the explicit form, "
         "`<Condition ID=\"…\"/>`, directly under a ReactiveSequence, and "
         "refuse a second AsyncSequence there. Without --profile a file is not "
         "refused for it (BT1651).",
     .help = "Write the node type as the tag; put the second AsyncSequence "
             "elsewhere.",
     .example = {.body = R"(<ReactiveSequence>
  <Condition ID="Ready"/>
</ReactiveSequence>)",
                 .models = R"(<Condition ID="Ready"/>)",
                 .command = "tree.xml --profile btcpp-4"}},

    // What is left open, or probably meant otherwise; contracts of leaves.
    {.code = "BT1620",
     .summary = "leaves that no model has",
     .description =
         "Neither BehaviorTree.CPP nor Nav2 nor a `<TreeNodesModel>` has these "
         "node types. Each is taken as an Action, which may run, unless its "
         "tag says otherwise. Some may be conditions, by their names.",
     .help = "Describe them in `<TreeNodesModel>`, or by --leaves: `btcheck "
             "leaves` begins either file. Nothing, if they are Actions.",
     .severity = Severity::Note,
     .example = {.body = "<Go/>"}},
    {.code = "BT1621",
     .summary = "an inner node that no model has",
     .description =
         "Neither BehaviorTree.CPP nor Nav2 nor a `<TreeNodesModel>` has this "
         "node type. How it ticks its children is not known. A warning where "
         "the name is near to one of theirs, an error where it is one in "
         "another case.",
     .help = "Correct its name; the case of letters counts.",
     .severity = Severity::Note,
     .example = {.body = "<Twice><AlwaysSuccess/></Twice>"}},
    {.code = "BT1622",
     .summary = "a file that does not say its version",
     .description =
         "`<root>` has no `BTCPP_format`. The file is read as one of version "
         "3, unless version 4 is asked for, or the trees have what version 3 "
         "refuses, such as `_skipIf`. Or what it has is neither 3 nor 4: read "
         "as version 4.",
     .help = "Write `<root BTCPP_format=\"4\">` for version 4.",
     .severity = Severity::Note,
     .example = {.tree = R"(<root>
<BehaviorTree ID="T"><AlwaysSuccess/></BehaviorTree>
</root>)"}},
    {.code = "BT1623",
     .summary = "a tag that contradicts the node's kind",
     .description = "The explicit tag is not the kind that the node type has. "
                    "BehaviorTree.CPP goes by the node type.",
     .help = "Write the node type as the tag.",
     .severity = Severity::Warning,
     .example = {.body = R"(<Action ID="Sequence"><AlwaysSuccess/></Action>)"}},
    {.code = "BT1624",
     .summary = "two trees of one ID",
     .description = "The one that is read last takes the place of the other, "
                    "silently in BehaviorTree.CPP.",
     .help = "Give one of them another ID.",
     .severity = Severity::Warning,
     .example = {.tree = R"(<root BTCPP_format="4" main_tree_to_execute="T">
<BehaviorTree ID="T"><AlwaysSuccess/></BehaviorTree>
<BehaviorTree ID="T"><AlwaysFailure/></BehaviorTree>
</root>)"}},
    {.code = "BT1625",
     .summary = "something that BehaviorTree.CPP ignores",
     .description = "An element that stands where nothing reads it, or an "
                    "attribute that looks like a misspelt condition.",
     .help = "Correct the name, or delete it.",
     .severity = Severity::Warning,
     .example = {.tree = R"(<root BTCPP_format="4">
<BehaviorTree ID="T"><AlwaysSuccess/></BehaviorTree>
<Notes/>
</root>)"}},
    {.code = "BT1626",
     .summary = "a port that the model does not have",
     .description = "The node's entry in `<TreeNodesModel>` has no such port. "
                    "BehaviorTree.CPP reads ports from the program, not from "
                    "models, and refuses the tree if the program's node has "
                    "none either. All that no name is near are told at once; "
                    "where no model of them lists any port, it is a note.",
     .help = "Correct the name, or add the port to the model.",
     .severity = Severity::Warning,
     .example = {.tree = R"(<root BTCPP_format="4">
<BehaviorTree ID="T"><Go speed="3"/></BehaviorTree>
<TreeNodesModel>
  <Action ID="Go"><input_port name="goal"/></Action>
</TreeNodesModel>
</root>)"}},
    {.code = "BT1627",
     .summary = "entries that nothing in the tree writes",
     .description =
         "Scripts need the values of entries that no node of the tree "
         "writes. Without a value, BehaviorTree.CPP stops with an exception "
         "when it runs the script. The program around the tree may set it.",
     .help = "Create the entry by `:=` first, or see that the program sets it.",
     .severity = Severity::Note,
     .example = {.body = R"(<ScriptCondition code="x == 1"/>)"}},
    {.code = "BT1628",
     .summary = "a key that looks misspelt",
     .description =
         "Two entries of one blackboard differ in capitals and underscores "
         "alone, and one is named once. Or their names are near, one is read "
         "and never written, and the other written; or scripts write one that "
         "nothing reads, and the other is read.",
     .help = "Write both the same way.",
     .severity = Severity::Warning,
     .example = {.body = R"(<Sequence>
  <Plan path="{path}"/>
  <Follow path="{Path}"/>
</Sequence>)",
                 .models = R"(
  <Action ID="Plan"><output_port name="path"/></Action>
  <Action ID="Follow"><input_port name="path"/></Action>
)"}},
    {.code = "BT1629",
     .summary = "a branch that is never ticked",
     .description =
         "The children before it can only return what ends the round, the "
         "cases of a Switch are equal, or a loop has no rounds.",
     .help = "Delete the branch, or mend what stands before it.",
     .severity = Severity::Warning,
     .example = {.body = R"(<Fallback>
  <AlwaysSuccess/>
  <AlwaysFailure/>
</Fallback>)",
                 .command = "lint tree.xml"}},
    {.code = "BT1630",
     .summary = "an output port that points at no entry",
     .description =
         "An output port has a value without braces. "
         "BehaviorTree.CPP 4 fails when the node writes it, and does "
         "not load the tree where the value is not one of the "
         "port's type (BT1610); 3 takes the value for the name of "
         "the entry.",
     .help = "Write the name of an entry in braces.",
     .severity = Severity::Warning,
     .example = {.tree = R"(<root BTCPP_format="4">
<BehaviorTree ID="T"><Plan path="way"/></BehaviorTree>
<TreeNodesModel>
  <Action ID="Plan"><output_port name="path"/></Action>
</TreeNodesModel>
</root>)"}},
    {.code = "BT1631",
     .summary = "a threshold of 0",
     .description = "With 0, a Parallel decides after its first child, and a "
                    "ParallelAll always fails.",
     .help = "Count from 1.",
     .severity = Severity::Warning,
     .example =
         {.body =
              R"(<Parallel success_count="0"><AlwaysSuccess/></Parallel>)"}},
    {.code = "BT1632",
     .summary = "a number that is not known before the run",
     .description =
         "A threshold of a Parallel or ParallelAll, or the retries of a "
         "RecoveryNode, is read from the blackboard. What the node does "
         "depends on it in a way that cannot be left open.",
     .help = "Write the number into the tree that is checked.",
     .example =
         {.body =
              R"(<Parallel success_count="{n}"><AlwaysSuccess/></Parallel>)"}},
    {.code = "BT1633",
     .summary = "a number of rounds that is left open",
     .description =
         "A Repeat or RetryUntilSuccessful reads from the blackboard how often "
         "it goes round. It may then stop after any round; where the tree has "
         "written what is no such number, it throws.",
     .help = "Write the number to have just that one checked.",
     .severity = Severity::Note,
     .example = {.body =
                     R"(<Repeat num_cycles="{n}"><AlwaysSuccess/></Repeat>)"}},
    {.code = "BT1634",
     .summary = "a duration of too many ticks",
     .description =
         "Time is counted in ticks of the root, and a duration of more than "
         "1000 would make the state space as much larger. It is taken as 1000.",
     .help = "Let a tick take longer: --tick-ms.",
     .severity = Severity::Note,
     .example = {.body = R"(<Sleep msec="3600000"/>)"}},
    {.code = "BT1635",
     .summary = "a duration that is left open",
     .description = "A duration is missing or read from the blackboard. The "
                    "node may take any number of ticks.",
     .help = "Write the duration to have just that one checked.",
     .severity = Severity::Note,
     .example = {.body = R"(<Sleep msec="{pause}"/>)"}},
    {.code = "BT1636",
     .summary = "what only trees of the other language have",
     .description = "The profile `paper` gives .btf trees their meaning, and "
                    "those of BehaviorTree.CPP and Nav2 XML trees. Of XML "
                    "trees time passes at ticks of the root only: `--tick "
                    "leaves` and `--tick nodes`, also where a file of rules "
                    "says so, are for .btf trees; --models, --main-tree and "
                    "--wake-ups are for XML trees.",
     .help = "Leave the option out, or name a profile or tick semantics of the "
             "file's language.",
     .example = {.tree = kOneAction, .command = "tree.btf --profile btcpp-4"}},
    {.code = "BT1637",
     .summary = "Nav2's branch is guessed",
     .description = "The tree has nodes of Nav2, and nothing says for which of "
                    "its branches: the oldest that has its nodes and ports is "
                    "taken, of version 3 humble rather than galactic. Some "
                    "nodes mean different things in them, "
                    "RoundRobin for one.",
     .help = "Name the branch that runs: --profile nav2-humble, nav2-jazzy or "
             "nav2-main.",
     .severity = Severity::Note,
     .example = {.body =
                     "<PipelineSequence><AlwaysSuccess/></PipelineSequence>"}},
    {.code = "BT1638",
     .summary = "a contract names an entry whose values are not known",
     .description = "What a contract requires of a blackboard entry, or puts "
                    "into it, is followed only where nothing but scripts, "
                    "contracts and leaves writes the entry. This one may have "
                    "any value at any "
                    "time, and what is required of it may be met or not. Or a "
                    "leaf has a port to an entry that is declared, and no "
                    "model says which way it goes: it is taken to write.",
     .help = "Write a text in quotes, or give the leaves whose ports may write "
             "the entry a contract that names it.",
     .severity = Severity::Warning,
     .example = {.body = "<Fly/>",
                 .models = R"(<Action ID="Fly"/>)",
                 .other_name = "robot.leaves",
                 .other = "(defaction Fly :requires (= battery full))",
                 .command = "lint tree.xml --leaves robot.leaves"}},
    {.code = "BT1639",
     .summary = "files of leaf contracts for a .btf tree",
     .description = "--leaves, or `leaves` in a manifest, names contracts for "
                    "XML trees. A .btf tree has its own.",
     .help = "Write the contracts into the file of the tree, and leave the "
             "option out.",
     .example = {.tree = kOneAction,
                 .other_name = "robot.leaves",
                 .other = "(defaction a :returns (success))",
                 .command = "tree.btf --leaves robot.leaves"}},
    {.code = "BT1640",
     .summary = "a blackboard entry is left open",
     .description =
         "The values that scripts can give an entry are computed before the "
         "search. For this entry they are not: a node that is no leaf, or a "
         "port of unknown direction, may write it, it takes too many values, "
         "or its numbers are told apart only as "
         "far as the scripts compare them. Any value is allowed then: a rule "
         "that holds does so for the real values, too, and every run that is "
         "shown has been executed with them. Where that does not succeed the "
         "verdict is UNDECIDED, with the reason.",
     .help = "Say in a model which way the port goes, or write a contract for "
             "the leaf; let counters stop at a bound.",
     .severity = Severity::Note,
     .example = {.body = R"(<Sequence>
<Script code="battery := 100000"/>
<Script code="battery -= 1"/>
<ScriptCondition code="battery > 5"/>
</Sequence>)"}},
    {.code = "BT1641",
     .summary = "a type of node that is not modelled exactly",
     .description =
         "What nodes of this type do depends on something that is outside the "
         "tree, or that is not kept: a pose, a path, a request, when an entry "
         "was written. Whatever can come of it is allowed: a rule that holds "
         "does so for the real node, too, but a run that is shown may need "
         "something that never happens.",
     .help = "Check whether the run that is shown can happen.",
     .severity = Severity::Note,
     .example = {.body = R"(<LoopInt queue="{waypoints}" value="{next}">
<AlwaysSuccess/>
</LoopInt>)"}},
    {.code = "BT1642",
     .summary = "a number with something behind it",
     .description =
         "The engine reads the number that a value begins with and drops the "
         "rest: `3abc` is 3, `1e3` and `1,000` are 1 for a whole number.",
     .help = "Write the number that is meant.",
     .severity = Severity::Warning,
     .example = {.body = R"(<RetryUntilSuccessful num_attempts="1e3">
<AlwaysFailure/></RetryUntilSuccessful>)"}},
    {.code = "BT1643",
     .summary = "a node type under a name of older releases",
     .description = "BehaviorTree.CPP up to 3.6.0 has `RetryUntilSuccesful`, "
                    "misspelt. It is read as RetryUntilSuccessful. Later "
                    "releases refuse the old name.",
     .help = "Write RetryUntilSuccessful.",
     .severity = Severity::Warning,
     .example = {.tree = R"(<root BTCPP_format="3">
<BehaviorTree ID="T"><RetryUntilSuccesful num_attempts="3">
<AlwaysFailure/></RetryUntilSuccesful></BehaviorTree>
</root>)"}},
    {.code = "BT1644",
     .summary = "an entry that is not passed to a subtree",
     .description =
         "A node inside a subtree reads an entry that nothing inside writes "
         "and that the SubTree does not pass. A subtree has a blackboard of "
         "its own, so the node finds nothing on any run.",
     .help = "Pass it, `inner=\"{outer}\"`, or all by `_autoremap`.",
     .severity = Severity::Warning,
     .example = {.tree = R"(<root BTCPP_format="4" main_tree_to_execute="T">
<BehaviorTree ID="T"><Sequence>
  <Plan path="{path}"/>
  <SubTree ID="S"/>
</Sequence></BehaviorTree>
<BehaviorTree ID="S"><Follow path="{path}"/></BehaviorTree>
<TreeNodesModel>
  <Action ID="Plan"><output_port name="path"/></Action>
  <Action ID="Follow"><input_port name="path"/></Action>
</TreeNodesModel>
</root>)"}},
    {.code = "BT1645",
     .summary = "an entry that scripts write and nothing reads",
     .description = "Only scripts and SetBlackboard write these entries, and "
                    "no port, script or condition of the tree reads them. The "
                    "program, or a rule, may. Only lint says so, where neither "
                    "rules nor contracts are given.",
     .help = "Delete what writes them, if nothing needs them.",
     .severity = Severity::Note,
     .example = {.body = R"(<Script code="done := true"/>)",
                 .command = "lint tree.xml"}},
    {.code = "BT1646",
     .summary = "a SetBlackboard whose key is in braces",
     .description =
         "The value of `output_key` is the name of the entry that is written. "
         "`{x}` stands for the value of `x`: the entry that `x` names is "
         "written, and BehaviorTree.CPP throws where `x` holds no text.",
     .help = "Write the key without braces.",
     .severity = Severity::Warning,
     .example = {.body = R"(<SetBlackboard value="1" output_key="{x}"/>)"}},
    {.code = "BT1647",
     .summary = "a tree that the main tree does not use",
     .description = "The file has a tree that no SubTree of the main tree "
                    "leads to: nothing that is said here is about it.",
     .help = "Check it by itself: --main-tree ID.",
     .severity = Severity::Note,
     .example = {.tree = R"(<root BTCPP_format="4" main_tree_to_execute="Work">
  <BehaviorTree ID="Work"><AlwaysSuccess/></BehaviorTree>
  <BehaviorTree ID="Rest"><AlwaysFailure/></BehaviorTree>
</root>)"}},
    {.code = "BT1648",
     .summary = "a main tree that the file does not name",
     .description =
         "The file does not say which of its trees runs. One is used "
         "by no other; it is the one that is checked.",
     .help = "Name it: main_tree_to_execute, or --main-tree ID.",
     .severity = Severity::Note,
     .example = {.tree = R"(<root BTCPP_format="4">
  <BehaviorTree ID="Work"><SubTree ID="Part"/></BehaviorTree>
  <BehaviorTree ID="Part"><AlwaysSuccess/></BehaviorTree>
</root>)"}},
    {.code = "BT1649",
     .summary = "a tree of another file",
     .description =
         "A SubTree names a tree that neither this file nor one that it "
         "includes has. A file beside it, or in the workspace around its ROS "
         "package, has one: programs that load a folder register all of them. "
         "The nearest is taken; where two are equally near and not the same, "
         "the first by name, and that is a warning. The others are one note.",
     .help = "Nothing, if the program registers that file; else include it.",
     .severity = Severity::Note,
     .example = {.tree = R"(<root BTCPP_format="4" main_tree_to_execute="T">
  <BehaviorTree ID="T"><SubTree ID="Dock"/></BehaviorTree>
</root>)",
                 .other_name = "dock.xml",
                 .other = R"(<root BTCPP_format="4">
  <BehaviorTree ID="Dock"><AlwaysSuccess/></BehaviorTree>
</root>)"}},
    {.code = "BT1651",
     .summary = "a file that newer releases refuse",
     .description =
         "BehaviorTree.CPP has become stricter: names with blanks are refused "
         "since 4.8.4, the explicit form below a ReactiveSequence since 4.7, "
         "some scripts since 4.9, and a number that is passed to a SubTree and "
         "read there as another type since 4.9.1. Without --profile a file is "
         "not refused for what only some releases refuse.",
     .help = "Mend it before you upgrade.",
     .severity = Severity::Note,
     .example = {.tree = R"(<root BTCPP_format="4">
  <BehaviorTree ID="Go home"><AlwaysSuccess/></BehaviorTree>
</root>)"}},
    {.code = "BT1653",
     .summary = "attributes that are not read",
     .description =
         "Attributes of other tools: on the root, on a tree, or on a node, "
         "where the engine takes them for no port and no condition. So the "
         "guards of MoVe4BT on leaves say nothing here. What editors note for "
         "themselves is not told.",
     .help = "Say what counts in the engine's words, or by --leaves.",
     .severity = Severity::Note,
     .example = {.tree = R"(<root BTCPP_format="4" specification="G safe">
  <BehaviorTree ID="T"><AlwaysSuccess/></BehaviorTree>
 </root>)"}},
    {.code = "BT1654",
     .summary = "a node that the branch of Nav2 does not have",
     .description =
         "The branch was named by --profile, and the node is one of another "
         "branch. The program may register one of this name itself: so it is "
         "taken as that other one. A port that only another branch has is "
         "refused (BT1609).",
     .help = "Name the branch that you run, or describe the node in "
             "`<TreeNodesModel>`.",
     .severity = Severity::Warning,
     .example = {.body = "<Sequence><ArePosesNear/><Wait/></Sequence>",
                 .command = "tree.xml --profile nav2-humble"}},
    {.code = "BT1655",
     .summary = "what an old release does not run, or is not modelled of it",
     .description =
         "Before 4.3.4 `skipped` was a status that a node kept. Some of what "
         "followed from that is not modelled: under btcpp-4.0 that a node is "
         "skipped at all, and up to btcpp-4.2 the postcondition _onHalted, "
         "which a halt executed or not, by whom it came from. Those releases "
         "crash where _autoremap stands beside a name, and read no queue that "
         "is written in the tree for LoopString.",
     .help = "Check the tree as a newer release runs it: --profile btcpp-4.3.",
     .severity = Severity::Error,
     .example = {.body = R"(<AlwaysSuccess _onHalted="x := 1"/>)",
                 .command = "tree.xml --profile btcpp-4.2"}},
    {.code = "BT1656",
     .summary = "a tree of another package, taken as a leaf",
     .description =
         "No file that is read has the tree that a SubTree names, but MoveIt "
         "Pro brings one of this name along, or a contract of --leaves has it. "
         "It is checked as an action: it may run, succeed and fail, unless the "
         "contract says more. With `_autoremap` it is an error (BT1612): such "
         "a tree could change any entry.",
     .help = "Name the folder that has the tree as well, to check what it "
             "does.",
     .severity = Severity::Note,
     .example = {.body = R"(<SubTree ID="CreateVector" vector="{v}"/>)"}},
    {.code = "BT1657",
     .summary = "a value where a SubTree of version 3 takes a name",
     .description =
         "In version 3 an attribute of a SubTree names an entry of the tree "
         "around it, whatever it looks like: `speed=\"500\"` is the entry "
         "called 500, and `spot=\"{shelf}\"` one called {shelf}, braces and "
         "all. Nothing writes these, so the nodes inside find nothing.",
     .help = "Write a name without braces; or use SubTreePlus, which takes "
             "names in braces, and values without.",
     .severity = Severity::Warning,
     .example = {.tree = R"(<root BTCPP_format="3" main_tree_to_execute="T">
<BehaviorTree ID="T"><SubTree ID="S" spot="{shelf}"/></BehaviorTree>
<BehaviorTree ID="S"><Drive spot="{spot}"/></BehaviorTree>
<TreeNodesModel>
  <Action ID="Drive"><input_port name="spot"/></Action>
</TreeNodesModel>
</root>)"}},
    {.code = "BT1658",
     .summary = "an enumerator with two numbers",
     .description =
         "Enumerators that a program registers for its scripts are declared in "
         "`enums` of a btcheck.toml, by `defenum` in a file for --leaves, or "
         "by ScriptingEnum in a TreeNodesModel. Two of these disagree; "
         "BehaviorTree.CPP refuses to register a name twice as well.",
     .help = "Delete the declaration that is not the program's.",
     .example = {.tree = R"(<root BTCPP_format="4">
<BehaviorTree ID="T"><AlwaysSuccess/></BehaviorTree>
<TreeNodesModel>
  <ScriptingEnum name="RED" value="1"/>
  <ScriptingEnum name="RED" value="2"/>
</TreeNodesModel>
</root>)"}},
    {.code = "BT1659",
     .summary = "an entry that is declared with values of another type",
     .description =
         "A file of contracts says by `defsv` that an entry holds numbers, and "
         "a port of the tree makes it one of texts, as those of a Switch do; "
         "or the other way round. BehaviorTree.CPP throws where the program "
         "sets the entry so, and refuses the tree where it is set before.",
     .help = "Declare values of the type that the port has.",
     .severity = Severity::Warning,
     .example = {.body = R"(<Switch2 variable="{mode}" case_1="1" case_2="2">
  <AlwaysSuccess/><AlwaysFailure/><AlwaysSuccess/>
</Switch2>)",
                 .other_name = "robot.leaves",
                 .other = "(defsv mode :init 1)",
                 .command = "lint tree.xml --leaves robot.leaves"}},
    {.code = "BT1660",
     .summary = "not a tree that py_trees has",
     .description =
         "A tree of py_trees has the composites, decorators and behaviours of "
         "py_trees, and leaves of yours. What another composite or decorator "
         "does is not known, preconditions and the like are of "
         "BehaviorTree.CPP, and no other engine runs such a tree.",
     .help = "Write it with nodes of py_trees, and export it again; "
             "docs/pytrees.md lists them.",
     .severity = Severity::Error,
     .example = {.tree = R"(<root BTCPP_format="4" py_trees="2.2.3">
  <BehaviorTree ID="T">
    <ReactiveSequence><Success/><Running/></ReactiveSequence>
  </BehaviorTree>
</root>)"}}};

}  // namespace

std::span<const CodeRow> btcpp_codes() { return kBtcppCodes; }

}  // namespace btcheck
