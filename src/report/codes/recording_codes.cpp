// SPDX-License-Identifier: MIT
//
// What is wrong where rules, a tree and a recorded run are put together.
#include "report/codes/codes.hpp"

namespace btcheck {
namespace {

// Writes a run of one action and goes on with it.
constexpr CodeExample on_a_run(std::string_view tree, std::string_view script,
                               std::string_view rules,
                               std::string_view command) {
  return {.tree = tree, .rules = rules, .script = script, .command = command};
}

constexpr std::string_view kRun = "a: success";

constexpr CodeRow kRecordingCodes[] = {
    {.code = "BT1801",
     .summary = "a rule that no single run shows or breaks",
     .description =
         "A rule of branching time, such as AG EF P, speaks of all that could "
         "happen from each moment on. A monitor sees the one run that happens.",
     .help = "Check the tree: btcheck TREE --prop RULES.",
     .example =
         on_a_run(kOneAction, kRun, "property p: AG EF a.success",
                  "simulate tree.btf --script script.txt -o run.itf.json\n"
                  "trace run.itf.json --prop rules.ltl")},
    {.code = "BT1802",
     .summary = "a rule about events of steps",
     .description =
         "`enter P`, `leave P`, `x.moves` and `time.passes` are about the step "
         "that is taken next. A monitor is told of states.",
     .help = "Say it by events of nodes, or by the past: `P and not "
             "previously P`.",
     .example =
         on_a_run(kOneAction, kRun, "property p: [] (a.moves => <> a.success)",
                  "simulate tree.btf --script script.txt -o run.itf.json\n"
                  "trace run.itf.json --prop rules.ltl")},
    {.code = "BT1803",
     .summary = "a rule whose monitor would be too large",
     .description =
         "The automaton that watches the rule would have more than a million "
         "entries: it joins more than ten conditions, or counts very long.",
     .help = "Split the rule, or take shorter times.",
     .example = on_a_run(
         kOneAction, kRun,
         "property p: whenever a.ticked then a.success within 500000 ticks",
         "simulate tree.btf --script script.txt -o run.itf.json\n"
         "trace run.itf.json --prop rules.ltl")},
    {.code = "BT1804",
     .summary = "a rule that no beginning of a run shows or breaks",
     .description =
         "The rule asks what happens in the end, as `always eventually P` "
         "does: whatever has happened, both is still possible. Its monitor "
         "stays open for ever.",
     .help = "Give it a time: `whenever P then Q within 10 ticks`.",
     .severity = Severity::Warning,
     .example =
         on_a_run(kOneAction, kRun, "property p: always eventually a.success",
                  "simulate tree.btf --script script.txt -o run.itf.json\n"
                  "trace run.itf.json --prop rules.ltl")},
    {.code = "BT1805",
     .summary = "a rule about what a recorded run does not show",
     .description =
         "A log of BehaviorTree.CPP has changes of status: no variables, no "
         "arguments, no counters of nodes, nothing of what is skipped, and "
         "not each step. No recording says why it ends.",
     .help = "Ask for events, statuses and answers of nodes.",
     .example =
         on_a_run(kOneAction, kRun, "property p: never stuck",
                  "simulate tree.btf --script script.txt -o run.itf.json\n"
                  "trace run.itf.json --prop rules.ltl")},
    {.code = "BT1806",
     .summary = "a log of another tree",
     .description =
         "Nodes of the log and of the tree are compared one by one, by name "
         "and place. The message names the first that differs.",
     .help = "Name the tree that the robot ran, with its --main-tree.",
     .example = {.tree = kOneAction,
                 .script = kRun,
                 .other_name = "other.btf",
                 .other = "(BehaviorTree :name t (Action :ID b))",
                 .command =
                     "simulate tree.btf --script script.txt -o run.itf.json\n"
                     "trace run.itf.json --to btlog -o robot.btlog\n"
                     "conform robot.btlog other.btf"}},
    {.code = "BT1807",
     .summary = "a log that does not bring its tree along",
     .description =
         "A .fbl has names of nodes and no XML, and a recording of ROS 2 not "
         "even their places, so that the tree has to be named.",
     .help = "btcheck conform LOG TREE; or in the file of rules: tree "
             "\"nav.xml\".",
     .example =
         {.command =
              R"($ printf '(\0\0\0\14\0\0\0\10\0\10\0\0\0\4\0\10\0\0\0\4)"
              R"(\0\0\0\1\0\0\0\12\0\0\0\6\0\6\0\4\0\6\0\0\0\1\0' > robot.fbl)"
              "\nconform robot.fbl"}},
    {.code = "BT1808",
     .summary = "a recorded run that the tree does not have",
     .description =
         "--from begins where a recorded run has come to, so the run has to be "
         "one of the tree as it is read now, with the same options.",
     .help = "Record the run again, or ask `btcheck conform` about a log.",
     .example = {.tree = kOneAction,
                 .script = kRun,
                 .other_name = "other.btf",
                 .other = "(BehaviorTree :name t (Action :ID b))",
                 .command =
                     "simulate tree.btf --script script.txt -o run.itf.json\n"
                     "other.btf --from run.itf.json"}},
    {.code = "BT1809",
     .summary = "a recorded run that leaves open where the tree is",
     .description =
         "A log does not show variables and counters, so the tree may be in "
         "several states behind it. Rules are checked from each of them, up to "
         "64; everything else needs to know the one.",
     .help = "Ask rules, begin at another tick, or keep the run as ITF.",
     .example = {.tree =
                     R"((defsv weather :states (Calm Storm))
(BehaviorTree :name t
  (Fallback (Eval (= weather Storm)) (Action :ID a))))",
                 .script = kRun,
                 .command = "simulate tree.btf --script script.txt -o "
                            "run.itf.json\ntrace run.itf.json --to btlog -o "
                            "robot.btlog\ntree.btf --from robot.btlog"}},
    {.code = "BT1810",
     .summary = "a tree that cannot be checked from there",
     .description =
         "Where a node is counting time, for a duration, a delay or a rate, "
         "runs cannot begin. And what scripts have written into the blackboard "
         "decides what the engine does; no recording has all of it.",
     .help = "Begin at another tick, or check the tree from its beginning.",
     .example = {.tree =
                     "(BehaviorTree :name t (Action :ID a :duration [2,3]))",
                 .script = "a: running running success",
                 .command = "simulate tree.btf --script script.txt -o "
                            "run.itf.json\ntree.btf --from run.itf.json@2"}},
    {.code = "BT1811",
     .summary = "a recording with several topics that log a tree",
     .description =
         "Each robot of a fleet has a topic of its own, and each has its own "
         "run. Or --topic names one that is not there.",
     .help = "Take one of the topics that the message names: --topic NAME.",
     .example =
         {.command =
              R"($ printf '\211MCAP0\15\12\3#\0\0\0\0\0\0\0\1\0\35\0\0\0)"
              R"(nav2_msgs/msg/BehaviorTreeLog)"
              R"(\4\21\0\0\0\0\0\0\0\1\0\1\0\2\0\0\0/a\3\0\0\0cdr)"
              R"(\4\21\0\0\0\0\0\0\0\2\0\1\0\2\0\0\0/b\3\0\0\0cdr')"
              " > robot.mcap\ntrace robot.mcap --to text"}},
    {.code = "BT1812",
     .summary = "nodes that a recording does not tell apart",
     .description =
         "Until Jazzy, Nav2 logs a node by its name alone. Where several nodes "
         "have the same name, what they did is left out: rules that ask for it "
         "are open, and `conform` lets them do anything.",
     .help = "Give the nodes names, <Wait name=\"wait outside\"/>, or record "
             "with a Nav2 that logs uids.",
     .severity = Severity::Warning,
     .example = {.body = "<Sequence><Grab/><Grab/></Sequence>",
                 .models = "<Action ID=\"Grab\"/>",
                 .rules = "property p: never root.failure",
                 .other_name = "events.txt",
                 .other =
                     R"({"event_log": [{"timestamp": {"sec": 0, "nanosec": 0},)"
                     R"( "node_name": "Grab", "previous_status": "IDLE",)"
                     R"( "current_status": "RUNNING"}]})",
                 .command = "monitor tree.xml --prop rules.ltl < events.txt"}},
    {.code = "BT1813",
     .summary = "a line of events that is not understood",
     .description =
         "`btcheck monitor` reads a JSON object from each line. Changes of "
         "status stand in its `event_log`, as ROS writes a message of "
         "nav2_msgs/msg/BehaviorTreeLog. The line is passed over, and answered "
         "with the verdict as it stands and the reason.",
     .help = "Write one object to a line, with nodes of the tree that is "
             "watched.",
     .severity = Severity::Warning,
     .example = {.tree = kOneAction,
                 .rules = "property p: never a.failure",
                 .other_name = "events.txt",
                 .other = "a has failed",
                 .command = "monitor tree.btf --prop rules.ltl < events.txt"}},
    {.code = "BT1814",
     .summary = "a tick of a log that does not show its ticks",
     .description =
         "BehaviorTree.CPP logs changes of status. Which of them are of one "
         "tick it does not log, and where that decides something it is not "
         "guessed.",
     .help = "Attach btcheck::observer to the tree, or say --tick-gap.",
     .example = {
         .body = "<Grab/>",
         .models = "<Action ID=\"Grab\"/>",
         .command = "$ echo "
                    "QlRDUFA0LUZpbGVMb2dnZXIyAUgAAAA8cm9vdD48QmVoYXZpb3JUcmVlIE"
                    "lEPSJNYWluVHJlZSI+PEdyYWIgX3VpZD0iMSIvPjwvQmVoYXZpb3JUcmVl"
                    "Pjwvcm9vdD4AAAAAAAAAAAAAAAAAAAEAAQ=="
                    " | base64 -d >robot.btlog\n"
                    "tree.xml --from robot.btlog@1"}}};

}  // namespace

std::span<const CodeRow> recording_codes() { return kRecordingCodes; }

}  // namespace btcheck
