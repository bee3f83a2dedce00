// SPDX-License-Identifier: MIT
//
// What is wrong with a property file.
#include "cli/codes/codes.hpp"

#include <array>

namespace btcheck {
namespace {

constexpr std::array kCodes = {
    CodeRow{
        .code = "BT1201",
        .summary = "a word or symbol that cannot stand where it stands",
        .description =
            "The reader expected something else here. It goes on with the"
            " next property, so one run shows every mistake.",
        .help = "See docs/properties.md for the forms there are.",
        .example = {.tree = R"((BehaviorTree :name t (Action :ID a)))",
                    .rules = R"(property p: never (a.failure)"},
    },
    CodeRow{
        .code = "BT1202",
        .summary = "a property's name is used again",
        .description = "Reports tell the second one as `NAME#2`.",
        .help = "Give each property a name of its own.",
        .example = {.tree = R"((BehaviorTree :name t (Action :ID a)))",
                    .rules = R"(property p: possible a.success
property p: possible a.failure)"},
    },
    CodeRow{
        .code = "BT1203",
        .summary = "`[]` or `always` covers less or more than it seems to",
        .description =
            "Operators with one operand bind closer than `=>`: `[] P => "
            "Q` is `([] P) => Q`, which is rarely what is meant, and is "
            "true of every run on which P fails once.",
        .help = "Write `[] (P => Q)`, or `([] P) => Q` if that is meant.",
        .example = {.tree = R"((BehaviorTree :name t (Action :ID a)))",
                    .rules = R"(property p: [] a.ticked => <> a.running)"},
    },
    CodeRow{
        .code = "BT1204",
        .summary = "X speaks of one step of the composed automata",
        .description =
            "A step is one move of one automaton, not a tick of the tree:"
            " what comes next depends on how the automata are "
            "interleaved.",
        .help = "Speak of ticks: `whenever P then Q within 1 tick`.",
        .example = {.tree = R"((BehaviorTree :name t (Action :ID a)))",
                    .rules = R"(property p: possible a.running
property q expect violated: [] (a.ticked => X a.success))"},
    },
    CodeRow{
        .code = "BT1205",
        .summary = "operators that tools group in different ways",
        .description =
            "U, W and R beside `and` or `or`, and chains of `=>`, are "
            "read one way by one tool and another way by the next.",
        .help = "Write the parentheses that you mean.",
        .example = {.tree = R"((BehaviorTree :name t (Action :ID a)))",
                    .rules =
                        R"(property p: a.success => a.ticked => a.running)"},
    },
    CodeRow{
        .code = "BT1206",
        .summary = "`F` is read as the constant false",
        .description =
            "Where an operand stands and none follows, `F` is the "
            "constant, as in some tools' languages, and not `eventually`.",
        .help = "Write `false`, or an operand after F.",
        .example = {.tree = R"((BehaviorTree :name t (Action :ID a)))",
                    .rules =
                        R"(property p expect violated: ltl a.success => F)"},
    },
    CodeRow{
        .code = "BT1207",
        .summary = "a name or comment that is never closed, an empty name",
        .description = "A quote or a comment has no end.",
        .help = "Close it on the same line; a comment ends with `*/`.",
        .example = {.tree = R"((BehaviorTree :name t (Action :ID a)))",
                    .rules = R"(property p: never "a.failure)"},
    },
    CodeRow{
        .code = "BT1208",
        .summary = "a character that means nothing",
        .description =
            "The language of properties does not have this character, `&`"
            " alone for instance.",
        .help = "Write `and`, `or`, `not`; there is no arithmetic in "
                "properties.",
        .example = {.tree = R"((BehaviorTree :name t (Action :ID a)))",
                    .rules = R"(property p: never a.failure & a.success)"},
    },
    CodeRow{
        .code = "BT1209",
        .summary = "a number out of range, an empty range",
        .description =
            "The number does not fit into 32 bits, or a range ends before"
            " it begins.",
        .help = "Write the smaller number first.",
        .example = {.tree = R"((defsv fls :max 3)
(BehaviorTree :name t (Action :ID a)))",
                    .rules = R"(property p: never fls in 3..1)"},
    },
    CodeRow{
        .code = "BT1210",
        .summary = "a formula or file too large, or nested too deeply",
        .description =
            "The file or formula is beyond what is read: 500 operators in"
            " one another.",
        .help = "Use `let` for parts, and several properties.",
    },
    CodeRow{
        .code = "BT1211",
        .summary = "more than 64 different conditions in one property",
        .description =
            "The set of conditions true in a state is kept in one word of"
            " 64 bits.",
        .help = "Split the property.",
    },
    CodeRow{
        .code = "BT1212",
        .summary = "a name with neither an event nor a comparison",
        .description =
            "A node's name alone says nothing that is true or false in a "
            "state.",
        .help = "Write an event behind it, such as `land.ticked`, or "
                "compare the variable.",
        .example = {.tree = R"((BehaviorTree :name t (Action :ID a)))",
                    .rules = R"(property p: never a)"},
    },
    CodeRow{
        .code = "BT1213",
        .summary = "no such event",
        .description =
            "The word behind the dot is none of the events and statuses "
            "of nodes.",
        .help = "Take the one that is suggested: ticked, done, success, "
                "failure, running, halted, active.",
        .example = {.tree = R"((BehaviorTree :name t (Action :ID a)))",
                    .rules = R"(property p: never a.tickd)"},
    },
    CodeRow{
        .code = "BT1214",
        .summary = "a temporal operator where one state is spoken of",
        .description =
            "`never`, `possible` and the parts of patterns take a "
            "condition on a single state; what happens before or after "
            "belongs outside.",
        .help = "Write the formula itself: [] (P => <> Q).",
        .example = {.tree = R"((BehaviorTree :name t (Action :ID a)))",
                    .rules = R"(property p: never <> a.failure)"},
    },
    CodeRow{
        .code = "BT1215",
        .summary = "a bound or interval that makes no sense",
        .description =
            "The interval is empty, negative, or beyond a million ticks.",
        .help = "Write for instance `within [0,5]` or `within 5 ticks`.",
        .example =
            {.tree = R"((BehaviorTree :name t (Action :ID a)))",
             .rules = R"(property p: a.ticked leadsto a.success within [2,1])"},
    },
    CodeRow{
        .code = "BT1216",
        .summary = "a `let` used before its line, or defined twice",
        .description =
            "A `let` names a part for the lines below it, and only for "
            "these.",
        .help = "Move it up.",
        .example = {.tree = R"((BehaviorTree :name t (Action :ID a)))",
                    .rules = R"(property p: never bad
let bad = a.failure)"},
    },
    CodeRow{
        .code = "BT1217",
        .summary = "an `expect` without a property, or two that contradict",
        .description = "`expect holds` and `expect violated` belong to the one "
                       "property that follows or stands on their line.",
        .help = "Keep one of them.",
        .example = {.tree = R"((BehaviorTree :name t (Action :ID a)))",
                    .rules = R"(expect holds
property p expect violated: never a.failure)"},
    },
    CodeRow{
        .code = "BT1218",
        .summary = "`tree` or `tick` twice, or with a word they do not know",
        .description =
            "A property file is about one tree, under one tick semantics:"
            " root, leaves, nodes or none.",
        .help = "Write each once.",
        .example = {.tree = R"((BehaviorTree :name t (Action :ID a)))",
                    .rules = R"(tick all
property p: possible a.success)"},
    },
    CodeRow{
        .code = "BT1219",
        .summary = "`assert` of a property that does not exist",
        .description =
            "`assert NAME` asks for a property that is defined above it.",
        .help = "Take the name of a property in the file.",
        .example = {.tree = R"((BehaviorTree :name t (Action :ID a)))",
                    .rules = R"(property p: possible a.success
assert q)"},
    },
    CodeRow{
        .code = "BT1220",
        .summary = "no property in the file",
        .description =
            "There is nothing to check: the file is empty, or has only "
            "comments and assumptions.",
        .help = "Write a property: `property NAME: never CONDITION`.",
        .example = {.tree = R"((BehaviorTree :name t (Action :ID a)))",
                    .rules = R"(# to be written)"},
    },
    CodeRow{
        .code = "BT1221",
        .summary = "a keyword used as a name without quotes",
        .description =
            "The word is an operator of the language and is read as one.",
        .help = "Put the name in quotes: \"F\".done.",
        .example = {.tree = R"((BehaviorTree :name t (Action :ID a)))",
                    .rules = R"(property p: never F.done)"},
    },
    CodeRow{
        .code = "BT1222",
        .summary = "a scope or a time where the pattern takes none",
        .description = "Not every pattern can be limited to a part of the run "
                       "(`after`, `before`, `between`) or to a time.",
        .help = "Leave it out, or write the rule with another pattern.",
        .example = {.tree = R"((BehaviorTree :name t (Action :ID a)))",
                    .rules =
                        R"(property p: possible a.success after a.failure)"},
    },
    CodeRow{
        .code = "BT1223",
        .summary = "branching and linear time mixed",
        .description =
            "A property is either about runs (LTL) or about what can "
            "happen in states (CTL); their mixture, CTL*, is not checked.",
        .help = "Write A or E in front of every temporal operator, or of "
                "none.",
        .example = {.tree = R"((BehaviorTree :name t (Action :ID a)))",
                    .rules = R"(property p: AG (a.ticked => <> a.success))"},
    },
    CodeRow{
        .code = "BT1224",
        .summary = "Fiacre's tags and port events, which trees have not",
        .description =
            "`TREE/NUMBER/event` and `tag` exist in Fiacre's language. "
            "The automata of a tree have neither ports nor tags.",
        .help = "Speak of the node's locations: `state`.",
        .example = {.tree = R"((BehaviorTree :name t (Action :ID a)))",
                    .rules = R"(property p: never t/1/tag x)"},
    },
    CodeRow{
        .code = "BT1225",
        .summary = "an assumption that does not speak of runs",
        .description = "An assumption leaves runs out. What is `possible`, or "
                       "branching time, is no condition on a single run.",
        .help = "Assume a formula of LTL, or `every action eventually ends`.",
        .example = {.tree = R"((BehaviorTree :name t (Action :ID a)))",
                    .rules = R"(assume possible a.success
property p: <> a.success)"},
    },
    CodeRow{
        .code = "BT1226",
        .summary = "a condition that speaks of the first state only",
        .description =
            "A formula without a temporal operator is about the state in "
            "which the run begins, where nothing has been ticked.",
        .help = "Write `always` or `never` in front of it.",
        .example = {.tree = R"((BehaviorTree :name t (Action :ID a)))",
                    .rules = R"(property p expect violated: a.success)"},
    }};

}  // namespace

std::span<const CodeRow> property_codes() { return kCodes; }

}  // namespace btcheck
