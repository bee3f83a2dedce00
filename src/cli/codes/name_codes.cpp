// SPDX-License-Identifier: MIT
//
// What is wrong between a property and its tree.
#include "cli/codes/codes.hpp"

#include <array>

namespace btcheck {
namespace {

constexpr std::array kCodes = {
    CodeRow{
        .code = "BT1101",
        .summary = "no node, variable or symbol of this name",
        .description =
            "A property names something that the tree does not have.",
        .help = "Take the name that is suggested. A node is called by its"
                " `:name` or `:ID`, a variable as `defsv` calls it.",
        .example = {.tree = R"((BehaviorTree :name t (Action :ID a)))",
                    .rules = R"(property p: never b.failure)"},
    },
    CodeRow{
        .code = "BT1102",
        .summary = "the name fits several nodes",
        .description =
            "Several nodes have this name, and a property has to say "
            "which it means.",
        .help = "Write NAME@LINE, or the path from a node above it: "
                "PARENT/NAME.",
        .example = {.tree = R"((BehaviorTree :name t
  (Sequence
    (Action :ID land)
    (Action :ID land))))",
                    .rules = R"(property p: never land.failure)"},
    },
    CodeRow{
        .code = "BT1103",
        .summary = "no process of this number, or another component's name",
        .description =
            "`TREE/NUMBER/state` is the paper's way to name a node, by "
            "the number of its process from 1 on and the name of the "
            "tree.",
        .help = "Write the node's name instead.",
        .example = {.tree = R"((BehaviorTree :name t (Action :ID a)))",
                    .rules = R"(property p: never t/99/state done)"},
    },
    CodeRow{
        .code = "BT1104",
        .summary = "no such location of the process, or variable of the node",
        .description =
            "The automaton of this node has no location or status of this"
            " name: a Condition for instance is never halted.",
        .help = "Take one that the message names; `btcheck export --to "
                "dot` draws the automata.",
        .example = {.tree = R"((BehaviorTree :name t (Action :ID a)))",
                    .rules = R"(property p: never root.halted)"},
    },
    CodeRow{
        .code = "BT1105",
        .summary = "the sides of a comparison do not fit",
        .description =
            "A variable is compared with a value of another kind: a state"
            " that it does not have, a number where it has states.",
        .help = "Compare it with one of its own values.",
        .example = {.tree =
                        R"((defsv battery :states (Good Low) :transitions :all)
(BehaviorTree :name t (Action :ID a)))",
                    .rules = R"(property p: never battery == Full)"},
    },
    CodeRow{
        .code = "BT1106",
        .summary = "a condition is always true or always false",
        .description =
            "The tree cannot make a difference to it, so a rule about it "
            "says nothing: the value is out of the variable's range, or "
            "the node never has the status.",
        .help = "Look whether the right node or value is named.",
        .example = {.tree = R"((defsv fls :max 3)
(BehaviorTree :name t (Action :ID a)))",
                    .rules = R"(property p: possible not (fls == 4))"},
    },
    CodeRow{
        .code = "BT1107",
        .summary = "another case than declared",
        .description =
            "A property writes a name in another case than the tree. It "
            "is taken for the same name.",
        .help = "Write it as the tree does.",
        .example = {.tree =
                        R"((defsv battery :states (Good Low) :transitions :all)
(BehaviorTree :name t (Action :ID a)))",
                    .rules = R"(property p: possible battery == low)"},
    },
    CodeRow{
        .code = "BT1108",
        .summary = "a time under `tick none`, where no time passes",
        .description =
            "The property asks for an answer within some ticks. Under "
            "`tick none` the tree is ticked on and on without any time in"
            " between, so there is nothing to count.",
        .help = "Check it under another tick semantics.",
        .example =
            {.tree = R"((BehaviorTree :name t (Action :ID a)))",
             .rules = R"(property p: a.ticked leadsto a.success within [0,2])",
             .command = "tree.btf --prop rules.ltl --tick none"},
    },
    CodeRow{
        .code = "BT1109",
        .summary = "a property or the assumptions too large to be checked",
        .description =
            "The automaton that would follow the property has too many "
            "states.",
        .help = "Split the property into several.",
    },
    CodeRow{
        .code = "BT1110",
        .summary =
            "branching time under an assumption that is a formula of LTL",
        .description =
            "A property of CTL asks what can still happen in each state; "
            "an assumption that is a formula speaks of runs as a whole, "
            "and leaves states in which neither is decided.",
        .help = "Assume fairness by `assume every action eventually ends`, or "
                "write "
                "the property in LTL.",
        .example = {.tree = R"((BehaviorTree :name t (Action :ID a)))",
                    .rules = R"(assume [] (a.ticked => <> a.success)
property p: AG (EF a.success))"},
    }};

}  // namespace

std::span<const CodeRow> name_codes() { return kCodes; }

}  // namespace btcheck
