// SPDX-License-Identifier: MIT
//
// One row for each kind. Codes are part of the interface: a row may be reworded
// but never mean something else, and new ones get new codes.
#include "cli/report_formats/rules.hpp"

#include <algorithm>
#include <array>

namespace btcheck {
namespace {

constexpr std::array<Rule, 16> kRules = {{
    {rule::kViolated, "PropertyViolated", "A property is violated.",
     "Some run of the tree breaks the property. The run is the code flow of "
     "the "
     "result: what the leaves answered, tick by tick, up to the step that "
     "breaks it. It was executed again on the tree, and is one that can happen "
     "if actions and conditions answer as shown.",
     "Follow the run: each step marked as chosen is an answer of the world "
     "outside. Change the tree so that it copes with it, or, if the world "
     "cannot answer so, say so by an `assume` line or a contract of the leaf. "
     "A property that is known to be violated is marked `expect violated`.",
     Severity::Error},
    {rule::kHolds, "PropertyHolds",
     "A property holds that was expected to be violated.",
     "The property is marked `expect violated`, and no run breaks it any more.",
     "If the tree was mended, write `expect holds`. Otherwise look whether the "
     "property still says what it should.",
     Severity::Error},
    {rule::kUndecided, "Undecided", "A question is left open.",
     "The search stopped before it was done: at a limit, or because it was "
     "interrupted. What it has seen neither answers yes nor no.",
     "Allow more by --memory, --max-states or --timeout, or give variables "
     "smaller ranges. `btcheck space` on a part of the tree tells what "
     "multiplies its states.",
     Severity::Warning},
    {rule::kVacuous, "HoldsVacuously", "A property holds vacuously.",
     "What the property asks about never happens, so nothing was asked.",
     "Look at the condition named in the message: it may be misspelt, or name "
     "the wrong node.",
     Severity::Warning},
    {rule::kFault, "Fault",
     "An assignment leaves its variable's range, or a division is by zero.",
     "On some run a node assigns its variable a value that it cannot have, or "
     "divides by zero. What would follow is not defined.",
     "Guard the assignment by a condition, or widen the range of the variable.",
     Severity::Error},
    {rule::kZeroTimeLoop, "ZeroTimeLoop", "A tick does not return.",
     "On some run the tree goes round in a loop in which no time passes: the "
     "executor would hang.",
     "Let some leaf of the loop answer running, or bound the repetitions.",
     Severity::Error},
    {rule::kStuck, "Stuck", "The tree can get stuck.",
     "Some run ends in a state in which nothing can happen any more, although "
     "the tree has not ended.",
     "Follow the run to its last state and see what each node waits for.",
     Severity::Error},
    {rule::kCannotEnd, "CannotEnd", "The tree can lose every way to an end.",
     "From some state on no answer of the leaves lets the tree succeed or "
     "fail any more.",
     "Follow the run to its last state. A tree that is meant to run for ever "
     "is written with `:loop 1`.",
     Severity::Error},
    {rule::kCannotSucceed, "CannotSucceed", "The tree can never succeed.",
     "However the leaves answer, the root never returns success.",
     "See in the table of `btcheck TREE` which nodes can succeed, from the "
     "leaves upwards.",
     Severity::Warning},
    {rule::kNeverTicked, "NeverTicked", "A node can never be ticked.",
     "However the leaves answer, the node is not reached.",
     "Delete it, or look at the node before it: it never lets the tick pass.",
     Severity::Warning},
    {rule::kNeverSucceeds, "NeverSucceeds", "A Parallel can never succeed.",
     "More of its children would have to succeed than can.",
     "Lower `:success`, or mend the children that cannot succeed.",
     Severity::Warning},
    {rule::kAlwaysTrue, "AlwaysTrue",
     "A condition is always true when it is ticked.",
     "The Eval is ticked and never fails: what it guards is not guarded.",
     "Delete it, or look whether it asks for the right value.",
     Severity::Warning},
    {rule::kNeverTrue, "NeverTrue",
     "A condition is never true when it is ticked.",
     "The Eval is ticked and always fails: what it guards is never reached.",
     "Look whether it asks for the right value.", Severity::Warning},
    {rule::kStaleGuards, "StaleGuards",
     "A guard is not ticked again while its action runs.",
     "The node above resumes its running child. The conditions and "
     "measurements before it are not looked at again until it is done, "
     "whatever becomes of them meanwhile.",
     "Where that matters, use a reactive node, or tick the guard beside the "
     "action in a Parallel.",
     Severity::Note},
    {rule::kLeftRunning, "LeftRunning",
     "A leaf is left running when a node above it has decided.",
     "A node has succeeded or failed and given control back while a leaf below "
     "it still has the status running.",
     "Give the node `:halt 1`, or see to it that the action is stopped.",
     Severity::Note},
    {rule::kInternal, "InternalError", "An internal error of btcheck.",
     "A run that was found could not be executed again. The verdict is not to "
     "be relied on.",
     "This is a mistake in btcheck; please report it with the tree and the "
     "property.",
     Severity::Error},
}};

struct Summary {
  std::string_view code;
  std::string_view words;
};

// As in docs/properties.md, section 10.
constexpr Summary kDiagnostics[] = {
    {"BT0002", "an input file cannot be read"},
    {"BT0003", "a property file that names no tree was given alone"},
    {"BT0004", "an output that cannot be written"},
    {"BT0005", "a tree that cannot be exported"},
    {"BT0006", "a property that is not exported"},
    {"BT0007", "a state space too large for a graph"},
    {"BT1000", "the file is not text"},
    {"BT1001", "a parenthesis is missing or too many"},
    {"BT1002", "too large: nesting, words, nodes, transitions"},
    {"BT1003", "a word, list, bracket, quote or character that means nothing"},
    {"BT1004", "unknown form, node type or operator"},
    {"BT1005", "unknown keyword, or one that the form does not take"},
    {"BT1006", "a keyword is missing, given twice, or has no value"},
    {"BT1007", "upper and lower case differ from the declaration"},
    {"BT1008", "a value is of the wrong kind or out of its bounds"},
    {"BT1009", "wrong number of children or operands"},
    {"BT1010", "a state variable's declaration contradicts itself"},
    {"BT1011", "a name is declared twice"},
    {"BT1012", "unknown state variable"},
    {"BT1013", "unknown state or return status"},
    {"BT1014", "unknown or ambiguous node"},
    {"BT1015", "an expression's types do not fit, or it divides by zero"},
    {"BT1016", "an assignment out of range, or where there can be none"},
    {"BT1017", "a comparison is always true or always false"},
    {"BT1018", "unknown subtree, or one that contains itself"},
    {"BT1019", "no tree, or it is open which trees run"},
    {"BT1020", "a contract contradicts itself or its leaf"},
    {"BT1021", "a tree or contract that nothing uses"},
    {"BT1101", "no node, variable or symbol of this name"},
    {"BT1102", "the name fits several nodes"},
    {"BT1103", "no process of this number, or another component's name"},
    {"BT1104", "no such location of the process, or variable of the node"},
    {"BT1105", "the sides of a comparison do not fit"},
    {"BT1106", "a condition is always true or always false"},
    {"BT1107", "another case than declared"},
    {"BT1108", "a time under `tick none`, where no time passes"},
    {"BT1109", "a property or the assumptions too large to be checked"},
    {"BT1110", "branching time under an assumption that is a formula of LTL"},
    {"BT1201", "a word or symbol that cannot stand where it stands"},
    {"BT1202", "a property's name is used again"},
    {"BT1203", "`[]` or `always` covers less or more than it seems to"},
    {"BT1204", "X speaks of one step of the composed automata"},
    {"BT1205", "operators that tools group in different ways"},
    {"BT1206", "`F` is read as the constant false"},
    {"BT1207", "a name or comment that is never closed, an empty name"},
    {"BT1208", "a character that means nothing"},
    {"BT1209", "a number out of range, an empty range"},
    {"BT1210", "a formula or file too large, or nested too deeply"},
    {"BT1211", "more than 64 different conditions in one property"},
    {"BT1212", "a name with neither an event nor a comparison"},
    {"BT1213", "no such event"},
    {"BT1214", "a temporal operator where one state is spoken of"},
    {"BT1215", "a bound or interval that makes no sense"},
    {"BT1216", "a `let` used before its line, or defined twice"},
    {"BT1217", "an `expect` without a property, or two that contradict"},
    {"BT1218", "`tree` or `tick` twice, or with a word they do not know"},
    {"BT1219", "`assert` of a property that does not exist"},
    {"BT1220", "no property in the file"},
    {"BT1221", "a keyword used as a name without quotes"},
    {"BT1222", "a scope or a time where the pattern takes none"},
    {"BT1223", "branching and linear time mixed"},
    {"BT1224", "Fiacre's tags and port events, which trees have not"},
    {"BT1225", "an assumption that does not speak of runs"},
    {"BT1226", "a condition that speaks of the first state only"},
    {"BT1501", "neither a folder nor a manifest"},
    {"BT1502", "the manifest is not TOML"},
    {"BT1503", "a key that manifests do not have"},
    {"BT1504", "a value of the wrong kind, or a word that is not known"},
    {"BT1505", "an entry without a tree, or keys that do not go together"},
    {"BT1506", "a verdict is expected of a property that does not exist"},
    {"BT1507", "nothing to check"},
    {"BT1508", "kept results are damaged"},
    {"BT1509", "results cannot be kept"},
    {"BT9001", "out of memory"},
};

}  // namespace

std::span<const Rule> rules() { return kRules; }

const Rule* rule_of(std::string_view code) {
  const auto found =
      std::find_if(kRules.begin(), kRules.end(),
                   [&](const Rule& rule) { return rule.code == code; });
  return found == kRules.end() ? nullptr : &*found;
}

std::string_view diagnostic_summary(std::string_view code) {
  for (const Summary& known : kDiagnostics) {
    if (known.code == code) return known.words;
  }
  return "something is wrong with an input";
}

}  // namespace btcheck
