// SPDX-License-Identifier: MIT
//
// Mistakes in BehaviorTree.CPP's XML.
#include <array>

#include "cli/codes/codes.hpp"

namespace btcheck {
namespace {

constexpr std::array kCodes = {
    CodeRow{
        .code = "BT1600",
        .summary = "a file is not XML",
        .description = "The file cannot be read as XML. tinyxml2 reads it, as "
                       "in BehaviorTree.CPP: a raw `&` or `<` in an attribute "
                       "passes, but every tag must be closed by its own name, "
                       "and every attribute have one quoted value.",
        .help = "Close the tag or quote the attribute in that line.",
        .example = {.tree = R"(<root BTCPP_format="4">
<BehaviorTree ID="T"><AlwaysSuccess>)"},
    },
    CodeRow{
        .code = "BT1601",
        .summary = "the first element is not `<root>`",
        .description =
            "Trees of BehaviorTree.CPP stand inside one element called root.",
        .help = "Put the trees into `<root BTCPP_format=\"4\">` and `</root>`.",
        .example =
            {.tree = R"(<BehaviorTree ID="T"><AlwaysSuccess/></BehaviorTree>)"},
    },
    CodeRow{
        .code = "BT1602",
        .summary = "XML that is too large",
        .description =
            "Tags nested more than 100 deep, more than 65535 nodes with all "
            "subtrees in their places, paths of nodes of more than 64 MiB "
            "together, more than 1000 files, or a file of more than 16 MiB.",
        .help = "Move a part into a tree of its own, or use fewer subtrees.",
    },
    CodeRow{
        .code = "BT1603",
        .summary = "a file that cannot be included",
        .description = "The file of an `<include>` does not exist, cannot be "
                       "read, or includes itself. BehaviorTree.CPP would read "
                       "such a circle until its memory is gone.",
        .help = "Correct the path: it counts from the folder of the file that "
                "includes.",
        .example = {.tree = R"(<root BTCPP_format="4">
<include path="other.xml"/>
<BehaviorTree ID="T"><AlwaysSuccess/></BehaviorTree>
</root>)"},
    },
    CodeRow{
        .code = "BT1604",
        .summary = "a missing or misplaced ID",
        .description =
            "`<Action>`, `<Condition>`, `<Control>`, `<Decorator>` and "
            "`<SubTree>` need the attribute `ID`, and so does a tree that is "
            "not alone in its file. A tag that is the node type itself takes "
            "none. Ports in models need a `name`.",
        .help = "Write `ID=\"…\"`, or delete it where the tag says the type.",
        .example = {.body = "<SubTree/>"},
    },
    CodeRow{
        .code = "BT1605",
        .summary = "a name that BehaviorTree.CPP does not allow",
        .description =
            "IDs of trees and node types and the names of ports have no "
            "blanks, control characters or any of `< > & \" ' / \\ : * ? | .`, "
            "are not empty, and are not `root`. A port begins with no digit, "
            "and is no attribute of the engine. Version 3 allows more.",
        .help = "Use letters, digits and `_`.",
        .example = {.tree = R"(<root BTCPP_format="4">
<BehaviorTree ID="my tree"><AlwaysSuccess/></BehaviorTree>
</root>)"},
    },
    CodeRow{
        .code = "BT1606",
        .summary = "a name that is taken",
        .description =
            "A tree has the ID of a node type, two SubTrees under one parent "
            "tree have one name, or a file has two lists of models.",
        .help = "Give one of them another name; make one list of two.",
        .example = {.tree = R"(<root BTCPP_format="4">
<BehaviorTree ID="Sequence"><AlwaysSuccess/></BehaviorTree>
</root>)"},
    },
    CodeRow{
        .code = "BT1607",
        .summary = "wrong number of children",
        .description =
            "Decorators have one child, leaves none, IfThenElse and "
            "WhileDoElse two or three, a Switch one more than it has cases, "
            "RecoveryNode two, TryCatch at least two. Some of this "
            "BehaviorTree.CPP only finds when it ticks the node.",
        .help = "Add or delete children; several children of a decorator stand "
                "in a Sequence or Fallback.",
        .example = {.body = R"(<Inverter>
  <AlwaysSuccess/>
  <AlwaysFailure/>
</Inverter>)"},
    },
    CodeRow{
        .code = "BT1608",
        .summary = "a way of version 3 in a tree of version 4",
        .description = "`<SubTreePlus>`, and the ID of a tree used as a tag, "
                       "are known to BehaviorTree.CPP 3 only.",
        .help = "Write `<SubTree ID=\"…\"/>`, with `_autoremap=\"true\"` for "
                "SubTreePlus.",
        .example = {.tree = R"(<root BTCPP_format="4" main_tree_to_execute="T">
<BehaviorTree ID="T"><SubTreePlus ID="S"/></BehaviorTree>
<BehaviorTree ID="S"><AlwaysSuccess/></BehaviorTree>
</root>)"},
    },
    CodeRow{
        .code = "BT1609",
        .summary = "a port that the node does not have",
        .description =
            "BehaviorTree.CPP refuses a tree in which a node of its own has an "
            "attribute that is none of its ports. Version 3's "
            "`success_threshold` and `failure_threshold` of Parallel are "
            "`success_count` and `failure_count` in version 4.",
        .help = "Correct the name, or delete the attribute.",
        .example =
            {.body =
                 R"(<Repeat num_cycles="3" times="3"><AlwaysSuccess/></Repeat>)"},
    },
    CodeRow{
        .code = "BT1610",
        .summary = "a port's value of the wrong type",
        .description = "A value without braces must be one of the port's type: "
                       "a number, a Boolean, or a status like SUCCESS.",
        .help = "Correct the value; an entry of the blackboard is written in "
                "braces.",
        .example =
            {.body = R"(<Repeat num_cycles="often"><AlwaysSuccess/></Repeat>)"},
    },
    CodeRow{
        .code = "BT1611",
        .summary = "it is open which tree runs",
        .description = "There is no tree, none of the name that is asked for, "
                       "or there are several and nothing says which one runs.",
        .help = "Name it by --main-tree, or write `<root "
                "main_tree_to_execute=\"…\">`.",
        .example = {.tree = R"(<root BTCPP_format="4">
<BehaviorTree ID="T"><AlwaysSuccess/></BehaviorTree>
<BehaviorTree ID="S"><AlwaysSuccess/></BehaviorTree>
</root>)"},
    },
    CodeRow{
        .code = "BT1612",
        .summary = "a subtree that does not exist",
        .description =
            "No file that is read has a tree of the ID that a SubTree names.",
        .help = "Correct the ID, or include the file that has the tree.",
        .example = {.body = R"(<SubTree ID="S"/>)"},
    },
    CodeRow{
        .code = "BT1613",
        .summary = "a tree that contains itself",
        .description = "A SubTree names a tree that it stands in, directly or "
                       "through others. Such a tree would never end.",
        .help = "Repeat by Repeat, RetryUntilSuccessful or "
                "KeepRunningUntilFailure.",
        .example = {.body = R"(<SubTree ID="T"/>)"},
    },
    CodeRow{
        .code = "BT1614",
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
</root>)"},
    },
    CodeRow{
        .code = "BT1615",
        .summary = "a script that is none",
        .description =
            "A pre- or postcondition, or the code of a Script, does not follow "
            "the language: an operand or bracket is missing, the script is "
            "empty, or a character means nothing.",
        .help = "Complete the script; strings stand in single quotes.",
        .example = {.body = R"(<Script code="x := "/>)"},
    },
    CodeRow{
        .code = "BT1616",
        .summary = "a blackboard entry of two types",
        .description =
            "Two ports of different types name one entry. The first one "
            "decides its type, and BehaviorTree.CPP refuses the other.",
        .help = "Use two entries.",
        .example = {.body = R"(<Sequence>
  <Go speed="{x}"/>
  <Stop now="{x}"/>
</Sequence>)",
                    .models = R"(
  <Action ID="Go"><output_port name="speed" type="double"/></Action>
  <Action ID="Stop"><input_port name="now" type="bool"/></Action>
)"},
    },
    CodeRow{
        .code = "BT1617",
        .summary = "a mandatory port is missing",
        .description =
            "The node cannot run without this port. BehaviorTree.CPP says so "
            "only when it ticks the node, by an exception.",
        .help = "Write the port.",
        .example = {.body = "<Repeat><AlwaysSuccess/></Repeat>"},
    },
    CodeRow{
        .code = "BT1618",
        .summary = "a threshold above the number of children",
        .description =
            "A Parallel waits for more children than it has. BehaviorTree.CPP "
            "says so only when it ticks the node, by an exception.",
        .help = "Lower the threshold, or write -1 for all children.",
        .example =
            {.body =
                 R"(<Parallel success_count="2"><AlwaysSuccess/></Parallel>)"},
    },
    CodeRow{
        .code = "BT1619",
        .summary = "children that a ReactiveSequence refuses",
        .description =
            "BehaviorTree.CPP 4.7 to 4.10 do not know the explicit form, "
            "`<Condition ID=\"…\"/>`, directly under a ReactiveSequence, and "
            "refuse a second AsyncSequence there.",
        .help = "Write the node type as the tag; put the second AsyncSequence "
                "elsewhere.",
        .example = {.body = R"(<ReactiveSequence>
  <Condition ID="Ready"/>
</ReactiveSequence>)",
                    .models = R"(<Condition ID="Ready"/>)"},
    }};

}  // namespace

std::span<const CodeRow> btcpp_codes() { return kCodes; }

}  // namespace btcheck
