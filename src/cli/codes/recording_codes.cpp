// SPDX-License-Identifier: MIT
//
// What is wrong where rules, a tree and a recorded run are put together.
#include "cli/codes/codes.hpp"

namespace btcheck {
namespace {

// Writes a run of one action and goes on with it.
constexpr CodeExample on_a_run(std::string_view tree, std::string_view script,
                               std::string_view rules,
                               std::string_view command) {
  return {.tree = tree, .rules = rules, .script = script, .command = command};
}

constexpr std::string_view kRun = "a: success";

constexpr CodeRow kCodes[] = {
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
     .help = "Split the rule, or take shorter times."},
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
             "\"nav.xml\"."},
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
     .help = "Ask rules, begin at another tick, or keep the run as ITF."},
    {.code = "BT1810",
     .summary = "a tree that cannot be checked from there",
     .description =
         "Where a node is counting time, for a duration, a delay or a rate, "
         "runs cannot begin. And what scripts have written into the blackboard "
         "decides what the engine does; no recording has all of it.",
     .help = "Begin at another tick, or check the tree from its beginning."},
    {.code = "BT1811",
     .summary = "a recording with several topics that log a tree",
     .description =
         "Each robot of a fleet has a topic of its own, and each has its own "
         "run. Or --topic names one that is not there.",
     .help = "Take one of the topics that the message names: --topic NAME."},
    {.code = "BT1812",
     .summary = "nodes that a recording does not tell apart",
     .description =
         "Until Jazzy, Nav2 logs a node by its name alone. Where several nodes "
         "have the same name, what they did is left out: rules that ask for it "
         "are open, and `conform` lets them do anything.",
     .help = "Give the nodes names, <Wait name=\"wait outside\"/>, or record "
             "with a Nav2 that logs uids.",
     .severity = Severity::Warning},
    {.code = "BT1813",
     .summary = "a line of events that is not understood",
     .description =
         "`btcheck monitor` reads a JSON object from each line. Changes of "
         "status stand in its `event_log`, as ROS writes a message of "
         "nav2_msgs/msg/BehaviorTreeLog. The line is passed over, and answered "
         "with the verdict as it stands and the reason.",
     .help = "Write one object to a line, with nodes of the tree that is "
             "watched.",
     .severity = Severity::Warning}};

}  // namespace

std::span<const CodeRow> recording_codes() { return kCodes; }

}  // namespace btcheck
