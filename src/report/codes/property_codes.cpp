// SPDX-License-Identifier: MIT
//
// What is wrong with a property file, alone or together with its tree.
#include "report/codes/codes.hpp"

namespace btcheck {
namespace {

constexpr std::string_view kMeasuresX =
    "(defsv x :max 99)\n(BehaviorTree :name t (SetSV :ID measure :sv x))";

constexpr CodeRow kPropertyCodes[] = {
    {.code = "BT1101",
     .summary = "no node, variable or symbol of this name",
     .description = "A property names something that the tree does not have.",
     .help = "Take the name that is suggested. A node is called by its `:name` "
             "or `:ID`, a variable as `defsv` calls it.",
     .example = rules_on_action("property p: never b.failure")},
    {.code = "BT1102",
     .summary = "the name fits several nodes",
     .description = "Several nodes have this name, and a property has to say "
                    "which it means.",
     .help = "Write NAME@LINE, or the path from a node above it: PARENT/NAME.",
     .example = {.tree = R"((BehaviorTree :name t
  (Sequence
    (Action :ID land)
    (Action :ID land))))",
                 .rules = "property p: never land.failure"}},
    {.code = "BT1103",
     .summary = "no process of this number, or another component's name",
     .description =
         "`TREE/NUMBER/state` is the paper's way to name a node, by the number "
         "of its process from 1 on and the name of the tree.",
     .help = "Write the node's name instead.",
     .example = rules_on_action("property p: never t/99/state done")},
    {.code = "BT1104",
     .summary = "no such location of the process, or variable of the node",
     .description = "The automaton of this node has no location or status of "
                    "this name: a Condition for instance is never halted.",
     .help = "Take one that the message names; `btcheck export --to automata` "
             "draws "
             "the automata.",
     .example = rules_on_action("property p: never root.halted")},
    {.code = "BT1105",
     .summary = "the sides of a comparison do not fit",
     .description =
         "A variable is compared with a value of another kind: a state that it "
         "does not have, a number where it has states. Of a blackboard entry "
         "only those numbers are told apart that the scripts compare it with.",
     .help = "Compare it with one of its own values.",
     .example = {.tree =
                     R"((defsv battery :states (Good Low) :transitions :all)
(BehaviorTree :name t (Action :ID a)))",
                 .rules = "property p: never battery == Full"}},
    {.code = "BT1106",
     .summary = "a condition is always true or always false",
     .description = "The tree cannot make a difference to it, so a rule about "
                    "it says nothing: the value is out of the variable's "
                    "range, or the node never has the status.",
     .help = "Check whether the right node or value is named.",
     .severity = Severity::Warning,
     .example = {.tree = R"((defsv fls :max 3)
(BehaviorTree :name t (Action :ID a)))",
                 .rules = "property p: possible not (fls == 4)"}},
    {.code = "BT1107",
     .summary = "a name in another case than declared",
     .description = "A property writes a name in another case than the tree. "
                    "It is taken for the same name.",
     .help = "Write it as the tree does.",
     .severity = Severity::Warning,
     .example = {.tree =
                     R"((defsv battery :states (Good Low) :transitions :all)
(BehaviorTree :name t (Action :ID a)))",
                 .rules = "property p: possible battery == low"}},
    {.code = "BT1108",
     .summary = "a time under `tick none`, where no time passes",
     .description = "The property asks for an answer within some ticks. Under "
                    "`tick none` the tree is ticked on and on without any time "
                    "in between, so there is nothing to count.",
     .help = "Check it under another tick semantics.",
     .example = {.tree = kOneAction,
                 .rules = "property p: a.ticked leadsto a.success within [0,2]",
                 .command = "tree.btf --prop rules.ltl --tick none"}},
    {.code = "BT1109",
     .summary = "a property or the assumptions too large to be checked",
     .description =
         "The automaton that would follow the property has too many states.",
     .help = "Split the property into several.",
     .example =
         {.tree = kMeasuresX,
          .command =
              "$ { echo 'assume'; seq -f '<> x == %g and' 40; echo 'true'; "
              "echo 'property p:'; seq -f '<> x == %g and' 41 80; echo true; } "
              "> rules.ltl\ntree.btf --prop rules.ltl"}},
    {.code = "BT1110",
     .summary = "branching time under an assumption that is a formula of LTL",
     .description = "A property of CTL asks what can still happen in each "
                    "state; an assumption that is a formula speaks of runs as "
                    "a whole, and leaves states in which neither is decided.",
     .help = "Assume fairness by `assume every action eventually ends`, or "
             "write the property in LTL.",
     .example = rules_on_action(R"(assume [] (a.ticked => <> a.success)
property p: AG (EF a.success))")},
    {.code = "BT1111",
     .summary = "nothing is known of the argument of a node",
     .description = "It is handed over by the program around the tree, or it "
                    "is a list that is no expression. So no rule can ask for "
                    "it.",
     .help = "Declare what `$name` stands for with `defsv`.",
     .example = {.tree = R"((BehaviorTree :name t
  (Action :ID plan :args (goal $goal))))",
                 .rules = "property p: never plan.goal > 3"}},
    {.code = "BT1112",
     .summary = "decided by a node that has not been given its arguments",
     .description =
         "A comparison with an argument of a node is false while the node has "
         "none: it is not ticked, and does not run. In a formula of LTL or CTL "
         "that alone makes what stands behind `[]` false, or what stands "
         "behind `<>` true.",
     .help = "Write `always x.z <= 6` or `never x.z > 6`, which speak of the "
             "values that x is given, or `x.ticked => x.z <= 6`.",
     .severity = Severity::Warning,
     .example = {.tree = R"((defsv v :max 9)
(BehaviorTree :name t
  (Action :ID go :args (z $v))))",
                 .rules = "property p: <> [] go.z <= 6"}},
    {.code = "BT1113",
     .summary = "the end of a tick, or the root's answer, of several trees",
     .description = "Trees that run in parallel tick side by side, and their "
                    "ticks do not end together.",
     .help = "Name the tree that is meant: `a.answer == success` of the tree "
             "`a`, `a.answer != none` where its tick ends.",
     .example = {.tree = R"((Trees one two)
(BehaviorTree :name one (Action :ID a))
(BehaviorTree :name two (Action :ID b)))",
                 .rules = "property p: in no tick: a.answer == failure"}},
    {.code = "BT1114",
     .summary = "`dead` or `stuck` under an operator of the past",
     .description = "Nothing comes after a dead state, so nothing can look "
                    "back to it.",
     .help = "Leave `once`, `since` or `previously` out.",
     .example = {.tree = "(BehaviorTree :name t (Action :ID a))",
                 .rules = "property p: never once dead"}},
    {.code = "BT1201",
     .summary = "a word or symbol that cannot stand where it stands",
     .description = "The reader expected something else here. It goes on with "
                    "the next property, so one run shows every mistake.",
     .help = "See docs/properties.md for the forms there are.",
     .example = rules_on_action("property p: never (a.failure")},
    {.code = "BT1202",
     .summary = "a property's name is used again",
     .description = "Reports call the second one `NAME#2`.",
     .help = "Give each property a name of its own.",
     .severity = Severity::Warning,
     .example = rules_on_action(R"(property p: possible a.success
property p: possible a.failure)")},
    {.code = "BT1203",
     .summary = "`[]` or `always` covers less or more than it seems to",
     .description = "Operators with one operand bind closer than `=>`: `[] P "
                    "=> Q` is `([] P) => Q`, which is rarely what is meant, "
                    "and is true of every run on which P fails once.",
     .help = "Write `[] (P => Q)`, or `([] P) => Q` if that is meant.",
     .severity = Severity::Warning,
     .example = rules_on_action("property p: [] a.ticked => <> a.running")},
    {.code = "BT1204",
     .summary = "X is about one step of the composed automata",
     .description =
         "A step is one move of one automaton, not a tick of the tree: what "
         "comes next depends on how the automata are interleaved.",
     .help = "Use ticks: `whenever P then Q within 1 tick`.",
     .severity = Severity::Warning,
     .example = rules_on_action(R"(property p: possible a.running
property q expect violated: [] (a.ticked => X a.success))")},
    {.code = "BT1205",
     .summary = "operators that tools group in different ways",
     .description = "U, W and R beside `and` or `or`, and chains of `=>`, are "
                    "read one way by one tool and another way by the next.",
     .help = "Write the parentheses that you mean.",
     .example =
         rules_on_action("property p: a.success => a.ticked => a.running")},
    {.code = "BT1206",
     .summary = "`F` is read as the constant false",
     .description =
         "Where an operand stands and none follows, `F` is the constant, as in "
         "some tools' languages, and not `eventually`.",
     .help = "Write `false`, or an operand after F.",
     .severity = Severity::Warning,
     .example =
         rules_on_action("property p expect violated: ltl a.success => F")},
    {.code = "BT1207",
     .summary = "a name or comment that is never closed, an empty name",
     .description = "A quote or a comment has no end.",
     .help = "Close it on the same line; a comment ends with `*/`.",
     .example = rules_on_action(R"(property p: never "a.failure)")},
    {.code = "BT1208",
     .summary = "a character that means nothing",
     .description = "The language of properties does not have this character, "
                    "`&` alone for instance.",
     .help = "Write `and`, `or`, `not`; there is no arithmetic in properties.",
     .example = rules_on_action("property p: never a.failure & a.success")},
    {.code = "BT1209",
     .summary = "a number out of range, an empty range",
     .description = "The number does not fit into 32 bits, or a range ends "
                    "before it begins.",
     .help = "Write the smaller number first.",
     .example = {.tree = R"((defsv fls :max 3)
(BehaviorTree :name t (Action :ID a)))",
                 .rules = "property p: never fls in 3..1"}},
    {.code = "BT1210",
     .summary = "a formula or file too large, or nested too deeply",
     .description =
         "What is read ends at 500 nested operators, 10,000 operators in a "
         "formula with every `let` written out, and a file of 4 MiB.",
     .help = "Use `let` for parts, and several properties.",
     .example = {.tree = kOneAction,
                 .command =
                     "$ { echo 'property p: never'; yes not | head -n 501; "
                     "echo dead; } > rules.ltl\ntree.btf --prop rules.ltl"}},
    {.code = "BT1211",
     .summary = "more than 64 different conditions in one property",
     .description = "The set of conditions true in a state is kept in one word "
                    "of 64 bits.",
     .help = "Split the property.",
     .example = {.tree = "(defsv x :max 99)\n(BehaviorTree :name t (SetSV :ID "
                         "measure :sv x))",
                 .command =
                     "$ { echo 'property p: never'; seq -f 'x == %g or' 65; "
                     "echo dead; } > rules.ltl\ntree.btf --prop rules.ltl"}},
    {.code = "BT1212",
     .summary = "a name with neither an event nor a comparison",
     .description =
         "A node's name alone says nothing that is true or false in a state.",
     .help = "Write an event after it, such as `land.ticked`, or compare the "
             "variable.",
     .example = rules_on_action("property p: never a")},
    {.code = "BT1213",
     .summary = "no such event",
     .description = "The word after the dot is no event of a node, or it is "
                    "`status`, which has to be compared.",
     .help = "Take the one that is suggested: ticked, done, success, failure, "
             "running, halted, active.",
     .example = rules_on_action("property p: never a.tickd")},
    {.code = "BT1214",
     .summary = "a temporal operator where a condition on one state belongs",
     .description =
         "`never`, `possible` and the parts of patterns take a condition on a "
         "single state; what happens before or after belongs outside.",
     .help = "Write the formula itself: [] (P => <> Q).",
     .example = rules_on_action("property p: never <> a.failure")},
    {.code = "BT1215",
     .summary = "a bound or interval that makes no sense",
     .description =
         "The interval is empty, negative, or beyond a million ticks.",
     .help = "Write for instance `within [0,5]` or `within 5 ticks`.",
     .example = rules_on_action(
         "property p: a.ticked leadsto a.success within [2,1]")},
    {.code = "BT1216",
     .summary = "a `let` used before its line, or defined twice",
     .description =
         "A `let` names a part for the lines below it, and only for these.",
     .help = "Move it up.",
     .example = rules_on_action(R"(property p: never bad
let bad = a.failure)")},
    {.code = "BT1217",
     .summary = "an `expect` without a property, or two that contradict",
     .description = "`expect holds` and `expect violated` belong to the one "
                    "property that follows or stands on their line.",
     .help = "Keep one of them.",
     .example = rules_on_action(R"(expect holds
property p expect violated: never a.failure)")},
    {.code = "BT1218",
     .summary = "`tree` or `tick` twice, or with a word they do not know",
     .description = "A property file is about one tree, under one tick "
                    "semantics: root, leaves, nodes or none.",
     .help = "Write each once.",
     .example = rules_on_action(R"(tick all
property p: possible a.success)")},
    {.code = "BT1219",
     .summary = "`assert` of a property that does not exist",
     .description =
         "`assert NAME` asks for a property that is defined above it.",
     .help = "Take the name of a property in the file.",
     .example = rules_on_action(R"(property p: possible a.success
assert q)")},
    {.code = "BT1220",
     .summary = "no property in the file",
     .description = "There is nothing to check: the file is empty, or has only "
                    "comments and assumptions.",
     .help = "Write a property: `property NAME: never CONDITION`.",
     .example = rules_on_action("# to be written")},
    {.code = "BT1221",
     .summary = "a keyword used as a name without quotes",
     .description =
         "The word is an operator of the language and is read as one.",
     .help = "Put the name in quotes: \"F\".done.",
     .example = rules_on_action("property p: never F.done")},
    {.code = "BT1222",
     .summary = "a scope or a time where the pattern takes none",
     .description = "Not every pattern can be limited to a part of the run "
                    "(`after`, `before`, `between`) or to a time.",
     .help = "Leave it out, or write the rule with another pattern.",
     .example =
         rules_on_action("property p: possible a.success after a.failure")},
    {.code = "BT1223",
     .summary = "branching and linear time mixed",
     .description = "A property is either about runs (LTL) or about what can "
                    "happen in states (CTL); their mixture, CTL*, is not "
                    "checked. Nor can CTL ask for events of steps.",
     .help = "Write A or E in front of every temporal operator, or of none.",
     .example = rules_on_action("property p: AG (a.ticked => <> a.success)")},
    {.code = "BT1224",
     .summary = "Fiacre's tags and port events, which trees do not have",
     .description = "`TREE/NUMBER/event` and `tag` exist in Fiacre's language. "
                    "The automata of a tree have neither ports nor tags.",
     .help = "Name the node's locations: `state`.",
     .example = rules_on_action("property p: never t/1/tag x")},
    {.code = "BT1225",
     .summary = "an assumption that is not about runs",
     .description =
         "An assumption leaves runs out. What is `possible`, or branching "
         "time, is no condition on a single run, and a time cannot be assumed.",
     .help = "Assume a formula of LTL, or `every action eventually ends`.",
     .example = rules_on_action(R"(assume possible a.success
property p: <> a.success)")},
    {.code = "BT1226",
     .summary = "a condition that is about the first state only",
     .description = "A formula without a temporal operator is about the state "
                    "in which the run begins, where nothing has been ticked.",
     .help = "Write `always` or `never` in front of it.",
     .severity = Severity::Warning,
     .example = rules_on_action("property p expect violated: a.success")}};

}  // namespace

std::span<const CodeRow> property_codes() { return kPropertyCodes; }

}  // namespace btcheck
