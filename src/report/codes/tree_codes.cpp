// SPDX-License-Identifier: MIT
//
// What is wrong with a .btf tree.
#include "report/codes/codes.hpp"

namespace btcheck {
namespace {

constexpr CodeRow kTreeCodes[] = {
    {.code = "BT1000",
     .summary = "the file is not text",
     .description = "A tree or a property file is UTF-8 text. This file has a "
                    "byte that is not, or a NUL byte: it may be a picture, a "
                    "program, or text in another encoding.",
     .help = "Save the file as UTF-8.",
     .example = {.command = "$ printf '\\377' > tree.btf\ntree.btf"}},
    {.code = "BT1001",
     .summary = "a missing or an extra parenthesis",
     .description =
         "The lists of a tree file do not close as they open. The message "
         "names the one that is never closed, or the one that closes nothing.",
     .help = "Count from the line that is named; an editor that shows matching "
             "parentheses helps.",
     .example = {.tree = "(BehaviorTree :name t (Action :ID a)))"}},
    {.code = "BT1002",
     .summary = "too large: nesting, words, nodes, transitions",
     .description =
         "The file, or the tree with its subtrees expanded, is larger than "
         "what is read: 500 nested lists, 20,000 nodes, 16 MiB. Without a "
         "limit a small file could ask for any amount of memory.",
     .help = "Check the parts of the tree one by one.",
     .example = {.command = "$ yes '(' | head -n 1000 > tree.btf\ntree.btf"}},
    {.code = "BT1003",
     .summary = "a word, list, bracket, quote or character that means nothing",
     .description = "Something stands where nothing of its kind can stand, "
                    "such as a word between the children of a node.",
     .help = "Delete it, or check whether a keyword before it is missing.",
     .example = {.tree = R"((BehaviorTree :name t
  (Sequence (Action :ID a) b)))"}},
    {.code = "BT1004",
     .summary = "unknown form, node type or operator",
     .description = "The first word of a list names what it is, and this word "
                    "names nothing.",
     .help =
         "Take the name that is suggested; docs/btf.md lists all there are.",
     .example = {.tree = R"((BehaviorTree :name t
  (Sequnce (Action :ID a))))"}},
    {.code = "BT1005",
     .summary = "unknown keyword, or one that the form does not take",
     .description =
         "A word with a colon in front belongs to the node types that know it. "
         "Ignoring it would check another tree than the one you mean.",
     .help = "Take the keyword that is suggested, or delete it.",
     .example = {.tree = R"((BehaviorTree :name t
  (Sequence :repeat 3 (Action :ID a))))"}},
    {.code = "BT1006",
     .summary = "a keyword is missing, given twice, or has no value",
     .description =
         "A node type needs the keyword, or its value does not follow it.",
     .help = "Write the keyword with its value, once.",
     .example = {.tree = R"((BehaviorTree :name t
  (Repeat (Action :ID a))))"}},
    {.code = "BT1007",
     .summary = "upper and lower case differ from the declaration",
     .description = "Names are compared without regard to case, as in the "
                    "published trees. The other spelling is taken for the same "
                    "name, and may be a mistake.",
     .help = "Write the name as it is declared.",
     .severity = Severity::Warning,
     .example = {.tree = R"((BehaviorTree :name t
  (sequence (Action :ID a))))"}},
    {.code = "BT1008",
     .summary = "a value is of the wrong kind or out of its bounds",
     .description =
         "The keyword takes another kind of value, or smaller or larger ones.",
     .help = "Write a value that the message names.",
     .example = {.tree = R"((BehaviorTree :name t
  (Repeat :repeat 0 (Action :ID a))))"}},
    {.code = "BT1009",
     .summary = "wrong number of children or operands",
     .description = "Each node type and operator takes a number of children or "
                    "operands: a decorator one, a leaf none.",
     .help = "Put several children under a Sequence or a Fallback.",
     .example = {.tree = R"((BehaviorTree :name t
  (Inverter (Condition :ID c) (Action :ID a))))"}},
    {.code = "BT1010",
     .summary = "a state variable's declaration contradicts itself",
     .description = "The range of the variable is empty, its states are no "
                    "list of names, or it has no name.",
     .help = "Write `:min` and `:max`, or `:states (A B C)`.",
     .example = {.tree = R"((defsv fls :min 2 :max 1)
(BehaviorTree :name t (Action :ID a)))"}},
    {.code = "BT1011",
     .summary = "a name is declared twice",
     .description = "Two variables, states, trees or contracts have the same "
                    "name but for case, so it is not clear which is meant.",
     .help = "Rename one of them.",
     .example = {.tree = R"((defsv fls :max 3)
(defsv Fls :max 4)
(BehaviorTree :name t (Action :ID a)))"}},
    {.code = "BT1012",
     .summary = "unknown state variable",
     .description = "An expression names a variable that no `defsv` declares.",
     .help = "Take the name that is suggested, or declare it.",
     .example = {.tree = R"((defsv battery :max 3)
(BehaviorTree :name t (Eval (> batery 1))))"}},
    {.code = "BT1013",
     .summary = "unknown state or return status",
     .description = "An enumeration is compared with a word that is none of "
                    "its states, or a status with one that is no status.",
     .help = "Take one of the states that are declared.",
     .example = {.tree =
                     R"((defsv battery :states (Good Low) :transitions :all)
(BehaviorTree :name t (Eval (= battery Bad))))"}},
    {.code = "BT1014",
     .summary = "unknown or ambiguous node",
     .description = "An expression asks for the status of a node that does not "
                    "exist, or by a name that several nodes have.",
     .help = "Give the node a `:name` of its own.",
     .example = {.tree = R"((BehaviorTree :name t
  (Sequence
    (Action :ID land)
    (Eval (= lnd.rstatus success)))))"}},
    {.code = "BT1015",
     .summary = "an expression's types do not fit, or it divides by zero",
     .description =
         "Numbers, enumerations, statuses and truth values are not mixed, and "
         "an Eval asks for something that is true or false.",
     .help = "Compare the variable with a value of its own kind.",
     .example = {.tree =
                     R"((defsv battery :states (Good Low) :transitions :all)
(BehaviorTree :name t (Eval (= battery 1))))"}},
    {.code = "BT1016",
     .summary = "an assignment out of range, or where there can be none",
     .description = "The variable can never hold the value, or `:=` stands "
                    "inside another expression.",
     .help = "Widen the range, or assign in an Eval of its own.",
     .example = {.tree = R"((defsv fls :max 3)
(BehaviorTree :name t (Eval (:= fls 4))))"}},
    {.code = "BT1017",
     .summary = "a comparison is always true or always false",
     .description = "No value of the variable's range makes a difference, so "
                    "the Eval asks nothing.",
     .help = "Compare with a value inside the range.",
     .severity = Severity::Warning,
     .example = {.tree = R"((defsv fls :max 3)
(BehaviorTree :name t (Eval (>= fls 4))))",
                 .command = "lint tree.btf"}},
    {.code = "BT1018",
     .summary = "unknown subtree, or one that contains itself",
     .description = "A SubTree names a tree that is not in the file, or one "
                    "that it is a part of: the tree would have no end.",
     .help = "Name another tree; to run a tree again, use Repeat.",
     .example = {.tree = "(BehaviorTree :name t (SubTree :ID t))"}},
    {.code = "BT1019",
     .summary = "no tree, or nothing says which trees run",
     .description = "A file has one BehaviorTree that runs. Where there are "
                    "several and none is the subtree of another, `Trees` says "
                    "which run, and in which order.",
     .help = "Write `(Trees a b)`.",
     .example = {.tree = R"((BehaviorTree :name a (Action :ID x))
(BehaviorTree :name b (Action :ID y)))"}},
    {.code = "BT1020",
     .summary = "a contract contradicts itself or its leaf",
     .description =
         "What `defaction` or `defcondition` says of a leaf cannot be meant, "
         "such as an action that has a duration and never runs.",
     .help = "Make the contract say what the leaf does.",
     .example = {.tree = R"((defaction a :returns (success) :duration 2)
(BehaviorTree :name t (Action :ID a)))"}},
    {.code = "BT1021",
     .summary = "a tree, contract or function that nothing uses",
     .description = "No node refers to it, or an earlier contract fits the "
                    "same leaves, so nothing that it says is checked.",
     .help = "Check whether a name is misspelt, or delete it.",
     .severity = Severity::Warning,
     .example = {.tree = R"((defaction b :returns (success))
(BehaviorTree :name t (Action :ID a)))"}},
    {.code = "BT1022",
     .summary = "a function that is not one, or calls itself",
     .description = "`(defun name (parameters) expression)` is a name for the "
                    "expression, which is put in the place of each call. So "
                    "a function that calls itself has no end.",
     .help = "Count with a state variable and Repeat instead.",
     .example = {.tree = R"((defun f (n) (+ 1 (f n)))
(BehaviorTree :name t (Eval (= 2 (f 1)))))"}},
    {.code = "BT1023",
     .summary = "an argument that may get out of range",
     .description = "Values from -2,147,483,647 to 2,147,483,647 can be handed "
                    "over, those with n decimals from -1,000,000,000 to "
                    "1,000,000,000 when multiplied by 10^n. What the variables "
                    "range over decides, not their values in a run.",
     .help = "Use a coarser unit or fewer decimals.",
     .example = {.tree = R"((defsv x :max 2000000)
(BehaviorTree :name t (Action :ID a :args (z (* 2000 $x)))))"}},
    {.code = "BT1024",
     .summary = "an argument of a SubTree that hides a state variable",
     .description = "In the nodes of the subtree the name stands for the "
                    "argument, not for the variable.",
     .help = "Give one of the two another name.",
     .severity = Severity::Warning,
     .example = {.tree = R"((defsv x :max 3)
(BehaviorTree :name t (Sequence (SetSV :ID m :sv x)
  (SubTree :ID s :args (x 1))))
(BehaviorTree :name s (Condition :ID c :args (z x))))"}},
    {.code = "BT1025",
     .summary = "a duration that is not a whole number of ticks",
     .description = "What is over between two ticks is noticed by the next "
                    "one, so parts of a tick count as a whole one. How long a "
                    "tick is says `--tick-ms`, else it is 100 ms.",
     .help = "Nothing needs to be done; a shorter tick tells more apart.",
     .severity = Severity::Note,
     .example = {.tree = R"((BehaviorTree :name t (Wait :duration 250ms)))"}},
    {.code = "BT1652",
     .summary = "a file of another format",
     .description =
         "The file is none that btcheck reads: JSON (of behavior3, for "
         "instance), YAML, a Python program, SCXML, a scene of Godot, a tree "
         "of "
         "BehaVerify, or XML under a name that does not say so. In a folder "
         "such files are no trees, and nothing is said.",
     .help = "Write the tree as XML of BehaviorTree.CPP, or in .btf.",
     .example = {.other_name = "tree.json",
                 .other = "{\"root\": \"1\", \"nodes\": {}}",
                 .command = "tree.json"}}};

}  // namespace

std::span<const CodeRow> tree_codes() { return kTreeCodes; }

}  // namespace btcheck
