// SPDX-License-Identifier: MIT
//
// What `lint` finds beside what the readers warn of.
#include "cli/codes/codes.hpp"

#include <array>

namespace btcheck {
namespace {

constexpr std::array kCodes = {
    CodeRow{
        .code = "BT2301",
        .name = "AgainstTransitions",
        .summary = "An assignment does not follow `:transitions`.",
        .description =
            "`:=` gives an enumeration a value that `:transitions` does "
            "not lead to. The assignment is carried out: transitions say "
            "how the world moves, not what a node writes.",
        .help = "Add the pair to `:transitions`, or measure with SetSV, "
                "which follows them.",
        .severity = Severity::Warning,
        .example = {.tree = R"((defsv gate
  :states (Open Closed)
  :transitions ((Open Closed)))
(BehaviorTree :name t
  (Sequence
    (SetSV :ID look :sv gate)
    (Eval (:= gate Open)))))",
                    .command = "lint tree.btf"},
    },
    CodeRow{
        .code = "BT2302",
        .name = "DeadNode",
        .summary = "A node can never be ticked, as the tree is built.",
        .description =
            "The node before it always succeeds under a Fallback, or "
            "always fails under a Sequence, so the tick never gets past "
            "it, whatever the leaves answer.",
        .help = "Delete the node, or the decorator before it that hides "
                "the answer.",
        .severity = Severity::Warning,
        .example = {.tree = R"((BehaviorTree :name t
  (Fallback
    (ForceSuccess (Action :ID a))
    (Action :ID b))))",
                    .command = "lint tree.btf"},
    },
    CodeRow{
        .code = "BT2303",
        .name = "UnusedVariable",
        .summary = "A variable that nothing reads or writes.",
        .description =
            "No node of the tree and no rule that was given names it. If "
            "it moves on its own, it still multiplies the states.",
        .help = "Delete it; or give the rules that speak of it by --prop.",
        .severity = Severity::Warning,
        .example = {.tree =
                        R"((defsv battery :states (Good Low) :transitions :all)
(BehaviorTree :name t (Action :ID a)))",
                    .command = "lint tree.btf"},
    },
    CodeRow{
        .code = "BT2304",
        .name = "DeadTransitions",
        .summary = "`:transitions` without effect.",
        .description =
            "Only `:=` writes this variable, and `:=` does not follow "
            "`:transitions`: they change nothing.",
        .help = "Delete `:transitions`, or measure the variable with "
                "SetSV.",
        .severity = Severity::Warning,
        .example = {.tree = R"((defsv gate
  :states (Open Closed)
  :transitions :all)
(BehaviorTree :name t
  (Sequence
    (Eval (:= gate Closed))
    (Eval (= gate Closed)))))",
                    .command = "lint tree.btf"},
    },
    CodeRow{
        .code = "BT2305",
        .name = "SeveralRunning",
        .summary = "Several children of a reactive node can run.",
        .description =
            "A ReactiveSequence or ReactiveFallback ticks its children from "
            "the first on, each time, and halts all others when one runs. So "
            "the first that can run begins anew while a later one runs, and "
            "halts it when it takes its time. An action of yours is taken for "
            "one that can run.",
        .help = "Let the last child alone run; or say what your actions "
                "answer, by --leaves.",
        .severity = Severity::Warning,
        .example = {.tree = R"(<root BTCPP_format="4">
<BehaviorTree ID="T">
<ReactiveSequence><Approach/><Grasp/></ReactiveSequence>
</BehaviorTree>
<TreeNodesModel><Action ID="Approach"/><Action ID="Grasp"/></TreeNodesModel>
</root>)",
                    .command = "lint tree.xml"},
    }};

}  // namespace

std::span<const CodeRow> lint_codes() { return kCodes; }

}  // namespace btcheck
