// SPDX-License-Identifier: MIT
//
// What a check finds, and what `lint` finds besides the warnings of the
// readers. Codes are part of the interface: a row may be reworded but never
// mean something else, and new ones get new codes.
#include "report/codes/codes.hpp"

namespace btcheck {
namespace {

constexpr CodeRow kVerdicts[] = {
    {.code = "BT2001",
     .name = "PropertyViolated",
     .summary = "A property is violated.",
     .description =
         "Some run of the tree breaks the property. The run is the code flow "
         "of the result: what the leaves answered, tick by tick, up to the "
         "step that breaks it. It was executed again on the tree, and is one "
         "that can happen if actions and conditions answer as shown.",
     .help = "Follow the run: each step marked as chosen is an answer of the "
             "world outside. Change the tree so that it copes with it, or, if "
             "the world cannot answer so, say so by an `assume` line or a "
             "contract of the leaf. A property that is known to be violated is "
             "marked `expect violated`.",
     .example = rules_on_action("property p: never a.failure")},
    {.code = "BT2002",
     .name = "PropertyHolds",
     .summary = "A property holds that was expected to be violated.",
     .description = "The property is marked `expect violated`, and no run "
                    "breaks it any more.",
     .help = "If the tree was mended, write `expect holds`. Otherwise check "
             "whether the property still says what it should.",
     .example =
         rules_on_action("property p expect violated: possible a.failure")},
    {.code = "BT2003",
     .name = "Undecided",
     .summary = "A question is left open.",
     .description =
         "The search stopped before it was done: at a limit, or because it was "
         "interrupted. What it has seen is no answer yet.",
     .help = "Allow more by --memory, --max-states or --timeout, or give "
             "variables smaller ranges. `btcheck space` on a part of the tree "
             "tells what multiplies its states.",
     .severity = Severity::Warning,
     .example = {.tree = kOneAction,
                 .rules = "property p: never a.halted",
                 .command = "tree.btf --prop rules.ltl --max-states 1"}},
    {.code = "BT2004",
     .name = "HoldsVacuously",
     .summary = "A property holds vacuously.",
     .description =
         "What the property asks about never happens, so nothing was asked.",
     .help = "Look at the condition named in the message: it may be misspelt, "
             "or name the wrong node.",
     .severity = Severity::Warning,
     .example = {.tree = R"((BehaviorTree :name t
  (Sequence
    (Action :ID c)
    (Action :ID a))))",
                 .rules = "property p: a.halted leadsto c.ticked"}},
    {.code = "BT2101",
     .name = "Fault",
     .summary =
         "An assignment leaves its variable's range, or a division is by zero.",
     .description =
         "On some run a node assigns its variable a value that it cannot have, "
         "or divides by zero. What would follow is not defined.",
     .help = "Guard the assignment by a condition, or widen the range of the "
             "variable.",
     .example = {.tree = R"((defsv k :max 1)
(BehaviorTree :name t
  (Sequence
    (SetSV :ID look :sv k)
    (Eval (:= k (+ k 1))))))"}},
    {.code = "BT2102",
     .name = "ZeroTimeLoop",
     .summary = "A tick does not return.",
     .description = "On some run the tree goes round in a loop in which no "
                    "time passes: the executor would hang. That the client of "
                    "an action server reaches its goal in no time, over and "
                    "over, is not counted.",
     .help = "Let some leaf of the loop answer running, or bound the "
             "repetitions; of an action that takes time say so by :duration."},
    {.code = "BT2103",
     .name = "Stuck",
     .summary = "The tree can get stuck.",
     .description = "Some run ends in a state in which nothing can happen any "
                    "more, although the tree has not ended.",
     .help =
         "Follow the run to its last state and see what each node waits for."},
    {.code = "BT2104",
     .name = "CannotEnd",
     .summary = "The tree can lose every way to an end.",
     .description = "From some state on no answer of the leaves lets the tree "
                    "succeed or fail any more.",
     .help = "Follow the run to its last state. A tree that is meant to run "
             "for ever is written with `:loop 1`.",
     .example = {.tree = R"((BehaviorTree :name t
  (Fallback
    (Action :ID a)
    ; btcheck: allow BT2215
    (KeepRunningUntilFailure
      (ForceSuccess (Action :ID b))))))"}},
    {.code = "BT2105",
     .name = "CannotSucceed",
     .summary = "The tree can never succeed.",
     .description =
         "However the leaves answer, the root never returns success.",
     .help = "See in the table of `btcheck TREE` which nodes can succeed, from "
             "the leaves upwards.",
     .severity = Severity::Warning,
     .example = {.tree =
                     "(BehaviorTree :name t (ForceFailure (Action :ID a)))"}},
    {.code = "BT2201",
     .name = "NeverTicked",
     .summary = "A node can never be ticked.",
     .description = "However the leaves answer, the node is not reached.",
     .help = "Delete it, or look at the node before it: it never lets the tick "
             "pass.",
     .severity = Severity::Warning,
     .example = {.tree = R"((BehaviorTree :name t
  (Fallback
    (ForceSuccess (Action :ID a))
    (Action :ID b))))"}},
    {.code = "BT2202",
     .name = "NeverSucceeds",
     .summary = "A Parallel can never succeed.",
     .description = "More of its children would have to succeed than can.",
     .help = "Lower `:success`, or mend the children that cannot succeed.",
     .severity = Severity::Warning,
     .example = {.tree = R"((BehaviorTree :name t
  (Fallback
    (Parallel :success 2
      (Action :ID a :SF)
      (ForceFailure (Action :ID b :SF)))
    (Action :ID c))))"}},
    {.code = "BT2203",
     .name = "AlwaysTrue",
     .summary = "A condition is always true when it is ticked.",
     .description =
         "The Eval is ticked and never fails: what it guards is not guarded.",
     .help = "Delete it, or check whether it asks for the right value.",
     .severity = Severity::Warning,
     .example = {.tree = R"((defsv k :max 1)
(BehaviorTree :name t
  (Sequence
    (Eval (:= k 1))
    (Eval (= k 1)))))"}},
    {.code = "BT2204",
     .name = "NeverTrue",
     .summary = "A condition is never true when it is ticked.",
     .description = "The Eval is ticked and always fails: what it guards is "
                    "never reached.",
     .help = "Check whether it asks for the right value.",
     .severity = Severity::Warning,
     .example = {.tree = R"((defsv k :max 1)
(BehaviorTree :name t
  (Sequence
    (Eval (:= k 1))
    (Fallback
      (Eval (= k 0))
      (Action :ID a)))))"}},
    {.code = "BT2205",
     .name = "StaleGuards",
     .summary = "A guard is not ticked again while its action runs.",
     .description = "The node above resumes its running child. The conditions "
                    "and measurements before it are not looked at again until "
                    "it is done, whatever becomes of them meanwhile.",
     .help = "Where that matters, use a reactive node, or tick the guard "
             "beside the action in a Parallel.",
     .severity = Severity::Warning,
     .example = {.tree = R"((BehaviorTree :name t
  (Sequence
    (Condition :ID c)
    (Action :ID a))))"}},
    {.code = "BT2206",
     .name = "LeftRunning",
     .summary = "A leaf is left running when a node above it has decided.",
     .description = "A node has succeeded or failed and given control back "
                    "while a leaf below it still has the status running.",
     .help =
         "Give the node `:halt 1`, or see to it that the action is stopped.",
     .severity = Severity::Warning,
     .example = {.tree = R"((BehaviorTree :name t
  (ReactiveSequence
    (Condition :ID c)
    (Action :ID a))))"}},
    {.code = "BT2207",
     .name = "FailureLost",
     .summary = "A failure or a warning is lost, and the mission goes on.",
     .description =
         "On the run shown something fails, or a condition tells of trouble, "
         "and what relies on it goes on as if all were well.",
     .help = "Let the failure through: a ForceFailure around what only notes "
             "it, a reactive node for a warning.",
     .severity = Severity::Warning,
     .example = {.body = R"(<Sequence>
  <Fallback>
    <Localize/>
    <Script code="warnings := 1"/>
  </Fallback>
  <Drive/>
</Sequence>)",
                 .models = R"(<Action ID="Localize"/><Action ID="Drive"/>)"}},
    {.code = "BT2208",
     .name = "FailsDespiteSuccess",
     .summary = "A node fails although what is below it succeeds.",
     .description = "On the run shown all that was done succeeds, and the node "
                    "answers failure all the same.",
     .help = "See in the run which rule of the node decides it.",
     .severity = Severity::Warning,
     .example = {.body = R"(<RoundRobin>
  <Spin/>
  <BackUp/>
</RoundRobin>)",
                 .command = "tree.xml --profile nav2-main"}},
    {.code = "BT2209",
     .name = "GuardWithoutEffect",
     .summary = "A guard cannot interrupt what it guards.",
     .description = "The condition is not asked while the action runs, or its "
                    "answer cannot change there.",
     .help = "Ask it before the action, under a ReactiveSequence.",
     .severity = Severity::Warning,
     .example = {.body = R"(<ReactiveSequence>
  <Pipette/>
  <IsHoodOpen/>
</ReactiveSequence>)",
                 .models = R"(<Action ID="Pipette"/>
<Condition ID="IsHoodOpen"/>)"}},
    {.code = "BT2210",
     .name = "InterruptsItself",
     .summary = "A branch changes what it is guarded by, and is halted.",
     .description = "What the branch does makes its own guard answer "
                    "otherwise; in the next tick the branch is halted.",
     .help = "Ask once, before the branch begins, in a plain Sequence.",
     .severity = Severity::Warning,
     .example = {.body = R"(<Sequence>
  <Script code="arm := 'stowed'"/>
  <ReactiveSequence>
    <ScriptCondition code="arm == 'stowed'"/>
    <Sequence>
      <Script code="arm := 'moving'"/>
      <Reach/>
    </Sequence>
  </ReactiveSequence>
</Sequence>)",
                 .models = R"(<Action ID="Reach"/>)"}},
    {.code = "BT2211",
     .name = "DoneInEveryTick",
     .summary = "Something is done again in every tick.",
     .description = "A reactive node begins with its first child in each tick; "
                    "what is done there is done as long as another child runs.",
     .help = "Make the node a Sequence, or put both actions into one below it.",
     .severity = Severity::Warning,
     .example = {.body = R"(<ReactiveSequence>
  <ClearMap/>
  <Follow/>
</ReactiveSequence>)",
                 .models = R"(<Action ID="ClearMap"/><Action ID="Follow"/>)"}},
    {.code = "BT2212",
     .name = "AlwaysSkipped",
     .summary = "A node is skipped on every run.",
     .description =
         "Whenever the tick gets to the node, its _skipIf is true or its "
         "_while is false.",
     .help = "Look what sets the entries that it asks for.",
     .severity = Severity::Warning,
     .example = {.body = R"(<Sequence>
  <Script code="tool := 'driver'"/>
  <Fetch _skipIf="tool == 'driver'"/>
</Sequence>)",
                 .models = R"(<Action ID="Fetch"/>)"}},
    {.code = "BT2213",
     .name = "OneAnswer",
     .summary = "A node has one answer, where its parent waits for the other.",
     .description =
         "A child that always fails ends a Sequence whatever was done before "
         "it; one that never fails makes of a Fallback a question that "
         "nothing comes of.",
     .help = "Move that child to where it is meant, or take it away.",
     .severity = Severity::Warning,
     .example = {.body = R"(<Sequence>
  <Fallback>
    <IsHeld/>
    <AlwaysSuccess/>
  </Fallback>
  <Lift/>
</Sequence>)",
                 .models = R"(<Condition ID="IsHeld"/><Action ID="Lift"/>)"}},
    {.code = "BT2214",
     .name = "CutOff",
     .summary = "A Parallel halts a task that has not ended.",
     .description = "As many children as are asked for have succeeded; the "
                    "others are halted in the midst of what they do.",
     .help = "Ask for all children, or say by a Timeout what is a race.",
     .severity = Severity::Warning,
     .example = {.body = R"(<Parallel success_count="1">
  <Drive/>
  <Lift/>
</Parallel>)",
                 .models = R"(<Action ID="Drive"/><Action ID="Lift"/>)"}},
    {.code = "BT2215",
     .name = "NoWayOut",
     .summary = "A loop has no way out.",
     .description = "A failure that lasts, or a success, keeps the mission in "
                    "the loop; what stands behind it is never reached.",
     .help = "Bound the attempts, or let the failure through.",
     .severity = Severity::Warning,
     .example = {.body = R"(<Fallback>
  <RetryUntilSuccessful num_attempts="-1">
    <OpenDoor/>
  </RetryUntilSuccessful>
  <CallPorter/>
</Fallback>)",
                 .models =
                     R"(<Action ID="OpenDoor"/><Action ID="CallPorter"/>)"}},
    {.code = "BT2216",
     .name = "NeverReset",
     .summary = "An entry is changed in a loop and never set back.",
     .description = "What is asked of the entry has the same answer in every "
                    "later round.",
     .help = "Set it at the beginning of each round.",
     .severity = Severity::Warning,
     .example = {.body = R"(<Sequence>
  <Script code="urgent := false"/>
  <Repeat num_cycles="3">
    <Sequence>
      <ForceSuccess>
        <Sequence>
          <Ask/>
          <Script code="urgent := true"/>
        </Sequence>
      </ForceSuccess>
      <Fast _skipIf="!urgent"/>
      <Drive/>
    </Sequence>
  </Repeat>
</Sequence>)",
                 .models = R"(<Condition ID="Ask"/><Action ID="Fast"/>
<Action ID="Drive"/>)"}},
    {.code = "BT2217",
     .name = "ReadBeforeWritten",
     .summary = "A port is read before anything has written its entry.",
     .description = "On the run shown none of the nodes that write the entry "
                    "has been ticked. The node finds nothing, and fails or "
                    "throws.",
     .help = "Write it on every way that leads there.",
     .severity = Severity::Warning,
     .example = {.body = R"(<Sequence>
  <Fallback>
    <IsNear/>
    <Detect pose="{pose}"/>
  </Fallback>
  <Reach pose="{pose}"/>
</Sequence>)",
                 .models = R"(<Condition ID="IsNear"/>
<Action ID="Detect"><output_port name="pose" type="std::string"/></Action>
<Action ID="Reach"><input_port name="pose" type="std::string"/></Action>)"}},
    {.code = "BT2501",
     .name = "AskedOnce",
     .summary = "A condition is asked once, before an action that may last.",
     .description = "Its node resumes the action and does not come past the "
                    "condition meanwhile. That is right where the answer "
                    "cannot change, or does not matter any more.",
     .help = "If it may change, put both under a reactive node.",
     .severity = Severity::Note,
     .example = {.body = R"(<Sequence>
  <IsNurseThere/>
  <Drive/>
</Sequence>)",
                 .models =
                     R"(<Condition ID="IsNurseThere"/><Action ID="Drive"/>)"}},
    {.code = "BT2502",
     .name = "MayBeCutOff",
     .summary = "A Parallel halts one child when another one has ended.",
     .description = "The first of its children to fail, or as many successes "
                    "as it asks for, end what the others do.",
     .help = "Ask for all children, or put a ForceSuccess around the one that "
             "may fail without harm.",
     .severity = Severity::Note,
     .example = {.body = R"(<Parallel>
  <Sequence>
    <Brush/>
    <Rinse/>
  </Sequence>
  <Report/>
</Parallel>)",
                 .models = R"(<Action ID="Brush"/><Action ID="Rinse"/>
<Action ID="Report"/>)"}},
    {.code = "BT2503",
     .name = "Forgiven",
     .summary = "A failure is turned into success, and the mission goes on.",
     .description = "What stands around it, such as a retry or a recovery, "
                    "never hears of the failure.",
     .help = "Take the ForceSuccess away, if the failure matters.",
     .severity = Severity::Note,
     .example = {.body = R"(<RetryUntilSuccessful num_attempts="3">
  <ForceSuccess>
    <Follow/>
  </ForceSuccess>
</RetryUntilSuccessful>)",
                 .models = R"(<Action ID="Follow"/>)"}},
    {.code = "BT2504",
     .name = "LimitDecides",
     .summary = "A limit decides in each tick between two that last.",
     .description = "A number that is measured while either runs crosses the "
                    "limit, and the other one begins: near the limit neither "
                    "gets on.",
     .help = "Let the first go on up to a second limit.",
     .severity = Severity::Note,
     .example = {.body = R"(<ReactiveSequence>
  <ReadBattery level="{level}"/>
  <ReactiveFallback>
    <ReactiveSequence>
      <ScriptCondition code="level &lt; 20"/>
      <Charge/>
    </ReactiveSequence>
    <Patrol/>
  </ReactiveFallback>
</ReactiveSequence>)",
                 .models = R"(<Condition ID="ReadBattery">
<output_port name="level" type="int"/></Condition>
<Action ID="Charge"/><Action ID="Patrol"/>)"}},
    {.code = "BT2505",
     .name = "NoTimeInLoop",
     .summary = "Nothing in a loop without end has to take time.",
     .description = "Ticked by tickOnce(), such a loop wakes the tree for its "
                    "next round, and the call never returns.",
     .help = "Put a Sleep into the loop, or say by a contract which leaf takes "
             "time.",
     .severity = Severity::Note,
     .example = {.body = R"(<Repeat num_cycles="-1">
  <Publish/>
</Repeat>)",
                 .models = R"(<Action ID="Publish"/>)"}},
    {.code = "BT2506",
     .name = "CalledOff",
     .summary = "An answer calls work off, and counts as its success.",
     .description = "A ReactiveFallback halts what runs when a child before it "
                    "succeeds, and succeeds itself: what follows goes on as if "
                    "the work had been done.",
     .help = "Where that is not meant, let the node fail then: the opposite "
             "condition under a ReactiveSequence.",
     .severity = Severity::Note,
     .example = {.body = R"(<Sequence>
  <ReactiveFallback>
    <IsNurseThere/>
    <Drive/>
  </ReactiveFallback>
  <Unload/>
</Sequence>)",
                 .models = R"(<Condition ID="IsNurseThere"/>
<Action ID="Drive"/><Action ID="Unload"/>)"}},
    {.code = "BT2507",
     .name = "TakenForAnAnswer",
     .summary = "A failure of work is taken for the answer to a question.",
     .description = "An Inverter around an action makes its failure a success; "
                    "a Fallback goes on as if a condition had failed when what "
                    "is done about it does.",
     .help = "Retry what may fail, or end the mission when it does.",
     .severity = Severity::Note,
     .example = {.body = R"(<Sequence>
  <Inverter>
    <FindPerson/>
  </Inverter>
  <CrossRoom/>
</Sequence>)",
                 .models =
                     R"(<Action ID="FindPerson"/><Action ID="CrossRoom"/>)"}},
    {.code = "BT2508",
     .name = "MayBeDoneAgain",
     .summary = "Something that may do no harm is done again in every tick.",
     .description = "A reactive node begins with its first child in each tick. "
                    "What only looks, or sets what is set already, may well be "
                    "done so.",
     .help = "If once is enough, make the node a Sequence.",
     .severity = Severity::Note,
     .example = {.body = R"(<ReactiveSequence>
  <IsMode mode="tour" value="on"/>
  <PubMode mode="tour" value="on"/>
  <Drive/>
</ReactiveSequence>)",
                 .models = R"(<Condition ID="IsMode">
<input_port name="mode"/><input_port name="value"/></Condition>
<Condition ID="PubMode">
<input_port name="mode"/><input_port name="value"/></Condition>
<Action ID="Drive"/>)"}},
    {.code = "BT2509",
     .name = "TwoCommands",
     .summary = "Two branches may do the same at once, with different values.",
     .description = "Both children of a Parallel have a leaf of one type, and "
                    "give it different values. On a robot the second command "
                    "often takes the device from the first.",
     .help = "Let one side wait for the other, if both command one device.",
     .severity = Severity::Note,
     .example = {.body = R"(<Parallel>
  <MoveArm to="shelf"/>
  <MoveArm to="table"/>
</Parallel>)",
                 .models = R"(<Action ID="MoveArm">
<input_port name="to"/></Action>)"}},
    {.code = "BT2510",
     .name = "GuardMayRun",
     .summary =
         "What is asked in every tick halts the work when it runs itself.",
     .description = "A reactive node ticks its first child in each tick. While "
                    "that answers running, what stands behind it is halted.",
     .help = "If it always answers at once, say it by a contract: `:returns "
             "(success failure)`.",
     .severity = Severity::Note,
     .example = {.body = R"(<ReactiveFallback>
  <Sequence>
    <LookAround found="{found}"/>
    <IsTargetThere found="{found}"/>
  </Sequence>
  <Explore/>
</ReactiveFallback>)",
                 .models = R"(<Action ID="LookAround">
<output_port name="found"/></Action>
<Condition ID="IsTargetThere"><input_port name="found"/></Condition>
<Action ID="Explore"/>)"}},
    {.code = "BT2511",
     .name = "FailedRound",
     .summary = "A loop ends for good with its first failed round.",
     .description = "A Repeat fails when its child does, and nothing around it "
                    "tries again.",
     .help = "Put a ForceSuccess around what may fail in a round.",
     .severity = Severity::Note,
     .example = {.body = R"(<Repeat num_cycles="8">
  <VisitShelf/>
</Repeat>)",
                 .models = R"(<Action ID="VisitShelf"/>)"}},
    {.code = "BT2512",
     .name = "NothingElse",
     .summary = "A Fallback has one child, and nothing to fall back to.",
     .description = "It fails as its child does.",
     .help = "Give it a second child, or take it away.",
     .severity = Severity::Note,
     .example = {.body = R"(<Fallback>
  <BringBack/>
</Fallback>)",
                 .models = R"(<Action ID="BringBack"/>)"}},
    {.code = "BT2513",
     .name = "LeftAtAValue",
     .summary = "A failure leaves something as it was set on the way.",
     .description = "A leaf is given a value, and later the one that it had "
                    "before; or its script sets an entry that the script of a "
                    "later leaf sets back. A failure in between leaves out the "
                    "second.",
     .help = "Set it back on the way out of a failure, too.",
     .severity = Severity::Note,
     .example = {.body = R"(<Sequence>
  <Gripper action="open"/>
  <Gripper action="close"/>
  <MoveArm/>
  <Gripper action="open"/>
</Sequence>)",
                 .models = R"(<Action ID="Gripper">
<input_port name="action"/></Action><Action ID="MoveArm"/>)"}},
    {.code = "BT2514",
     .name = "ReadFromOutside",
     .summary = "A port reads an entry that nothing in the tree writes.",
     .description = "Another leaf of the same type reads by the same port what "
                    "the tree has written. The program may write this one; or "
                    "the other was meant.",
     .help = "Write the entry that was meant, if the program does not write "
             "this one.",
     .severity = Severity::Note,
     .example = {.body = R"(<Sequence>
  <Plan way="{way_there}"/>
  <Follow way="{way_there}"/>
  <Follow way="{way}"/>
</Sequence>)",
                 .models =
                     R"(<Action ID="Plan"><output_port name="way"/></Action>
<Action ID="Follow"><input_port name="way"/></Action>)"}},
    {.code = "BT9002",
     .name = "InternalError",
     .summary = "An internal error of btcheck.",
     .description = "A run that was found could not be executed again. Do not "
                    "rely on the verdict.",
     .help = "This is a mistake in btcheck; please report it with the tree and "
             "the property."}};

constexpr CodeRow kLint[] = {
    {.code = "BT2301",
     .name = "AgainstTransitions",
     .summary = "An assignment does not follow `:transitions`.",
     .description =
         "`:=` gives an enumeration a value that `:transitions` does not lead "
         "to. The assignment is carried out: transitions say how the world "
         "moves, not what a node writes.",
     .help = "Add the pair to `:transitions`, or measure with SetSV, which "
             "follows them.",
     .severity = Severity::Warning,
     .example = {.tree = R"((defsv gate
  :states (Open Closed)
  :transitions ((Open Closed)))
(BehaviorTree :name t
  (Sequence
    (SetSV :ID look :sv gate)
    (Eval (:= gate Open)))))",
                 .command = "lint tree.btf"}},
    {.code = "BT2302",
     .name = "DeadNode",
     .summary = "A node can never be ticked, as the tree is built.",
     .description = "The node before it always succeeds under a Fallback, or "
                    "always fails under a Sequence, so the tick never gets "
                    "past it, whatever the leaves answer.",
     .help =
         "Delete the node, or the decorator before it that hides the answer.",
     .severity = Severity::Warning,
     .example = {.tree = R"((BehaviorTree :name t
  (Fallback
    (ForceSuccess (Action :ID a))
    (Action :ID b))))",
                 .command = "lint tree.btf"}},
    {.code = "BT2303",
     .name = "UnusedVariable",
     .summary = "A variable that nothing reads or writes.",
     .description = "No node of the tree and no rule that was given names it. "
                    "If it moves on its own, it still multiplies the states.",
     .help = "Delete it; or give the rules that speak of it by --prop.",
     .severity = Severity::Warning,
     .example = {.tree =
                     R"((defsv battery :states (Good Low) :transitions :all)
(BehaviorTree :name t (Action :ID a)))",
                 .command = "lint tree.btf"}},
    {.code = "BT2304",
     .name = "DeadTransitions",
     .summary = "`:transitions` without effect.",
     .description = "Only `:=` writes this variable, and `:=` does not follow "
                    "`:transitions`: they change nothing.",
     .help = "Delete `:transitions`, or measure the variable with SetSV.",
     .severity = Severity::Warning,
     .example = {.tree = R"((defsv gate
  :states (Open Closed)
  :transitions :all)
(BehaviorTree :name t
  (Sequence
    (Eval (:= gate Closed))
    (Eval (= gate Closed)))))",
                 .command = "lint tree.btf"}},
    {.code = "BT2305",
     .name = "SeveralRunning",
     .summary = "Several children of a reactive node can run.",
     .description = "A ReactiveSequence or ReactiveFallback ticks its children "
                    "from the first on, each time, and halts all others when "
                    "one runs. So one that lets the tick pass only after an "
                    "action has run begins that anew while a later one runs, "
                    "and halts it when it takes its time. Children that a "
                    "condition guards do so on purpose, and are left out. An "
                    "action of yours is taken for one that can run; where no "
                    "model has it, this is a note, once for the tree.",
     .help = "Let the last child alone run; or say what your actions answer, "
             "by --leaves.",
     .severity = Severity::Warning,
     .example = {
         .body = "<ReactiveSequence><Approach/><Grasp/></ReactiveSequence>",
         .models = R"(<Action ID="Approach"/><Action ID="Grasp"/>)",
         .command = "lint tree.xml"}}};

}  // namespace

std::span<const CodeRow> verdict_codes() { return kVerdicts; }
std::span<const CodeRow> lint_codes() { return kLint; }

}  // namespace btcheck
