// SPDX-License-Identifier: MIT
//
// To add a command: a row here, before the hidden ones, its name in `Command`,
// and what it does in commands.cpp. To add an option: a row here, and what it
// means in options.cpp.
#include "cli/options/tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>

namespace btcheck {
namespace {

using enum Command;

constexpr CommandRow kCommands[] = {
    {.command = Check,
     .word = "check",
     .argument = ArgumentKind::Tree,
     .shown = "TREE",
     .missing = "no tree",
     .example = "btcheck TREE",
     .summary = "check rules, or find what is wrong without any",
     .description =
         "Without rules, finds what is wrong with the tree and shows it by "
         "runs. With --prop, checks each rule over every run and shows one "
         "that breaks it. TREE is a .btf file, XML of BehaviorTree.CPP (.xml, "
         ".btproj), or a file of rules that names its tree; a folder, or "
         "several trees, are checked as by `btcheck batch`; `-`, the tree on "
         "standard input. The word `check` may be left out."},
    {.command = Batch,
     .word = "batch",
     .argument = ArgumentKind::Batches,
     .shown = "FOLDER|TREE|MANIFEST...",
     .missing = "no folder, tree or manifest",
     .example = "btcheck batch FOLDER",
     .summary = "many trees and rules, several at a time",
     .description =
         "Checks every tree of a folder with the rules that belong to it, or "
         "what a manifest (.toml) names, and reports the result of each. XML "
         "trees of one folder know each other; one that another one uses is "
         "not checked by itself."},
    {.command = Lint,
     .word = "lint",
     .argument = ArgumentKind::Trees,
     .shown = "FOLDER|TREE...",
     .missing = "no folder and no tree",
     .example = "btcheck lint FOLDER",
     .summary = "find mistakes without a search",
     .description = "Reads trees and rules and reports what is wrong with "
                    "them: names, numbers of children, case, options without "
                    "effect. Nothing is searched."},
    {.command = Space,
     .word = "space",
     .argument = ArgumentKind::Tree,
     .shown = "TREE",
     .missing = "no tree",
     .example = "btcheck space TREE",
     .summary = "build and measure the state space",
     .description = "Builds every state of the tree and tells how many there "
                    "are, how deep they lie, and which parts multiply them."},
    {.command = Export,
     .word = "export",
     .argument = ArgumentKind::Tree,
     .shown = "TREE",
     .missing = "no tree",
     .example = "btcheck export TREE --to svg",
     .summary = "draw the tree, or write it as a model for another tool",
     .description =
         "Writes the tree to standard output: as a drawing, in the other "
         "language of trees, or its automata as a model for SPIN, nuXmv or "
         "TINA."},
    {.command = Trace,
     .word = "trace",
     .argument = ArgumentKind::Run,
     .shown = "RUN",
     .missing = "no file",
     .example = "btcheck trace RUN.itf.json --to html",
     .summary = "a run that was kept, as a picture, page or log, or its rules",
     .description =
         "Converts a run that --trace-dir or `simulate -o` has "
         "kept, or prints a log of BehaviorTree.CPP or Nav2. With "
         "--prop, asks rules of either and tells the first moment that "
         "breaks one."},
    {.command = Conform,
     .word = "conform",
     .argument = ArgumentKind::Logs,
     .shown = "LOG... [TREE]",
     .missing = "no log",
     .example = "btcheck conform robot.btlog",
     .summary = "logs against the tree: could it have written them?",
     .description =
         "Follows each log of BehaviorTree.CPP or Nav2 in the model of its "
         "tree and tells the first record that no run can take. The tree is "
         "the one that the log brings along, where none is named."},
    {.command = Simulate,
     .word = "simulate",
     .argument = ArgumentKind::Tree,
     .shown = "TREE",
     .missing = "no tree",
     .example = "btcheck simulate TREE",
     .summary = "step through a tree, at random or by a script",
     .description = "Goes through one run of the tree: by hand, at random, or "
                    "as a script of leaf results says."},
    {.command = Tests,
     .word = "tests",
     .argument = ArgumentKind::Tree,
     .shown = "TREE",
     .missing = "no tree",
     .example = "btcheck tests TREE -o DIRECTORY",
     .summary = "tests for your engine that reach all that is possible",
     .description =
         "Writes scripted runs of the tree, as tests of GoogleTest for "
         "BehaviorTree.CPP, of pytest, and as lines of JSON: fakes answer for "
         "the leaves, and each tick has what every node does then. Together "
         "they reach every answer and every halt that a search of all runs "
         "proves possible, but for what cannot be forced, which is named."},
    {.command = Run,
     .word = "run",
     .argument = ArgumentKind::Tree,
     .shown = "TREE",
     .missing = "no tree",
     .example = "btcheck run TREE --leaves-exec 'python3 leaves.py'",
     .summary = "execute a tree, with leaves of your own",
     .description =
         "Executes the very automata that are checked. A process answers for "
         "the leaves, in lines of JSON; an answer that the model does not "
         "allow is a breach. --script and --seed run without a robot."},
    {.command = Monitor,
     .word = "monitor",
     .argument = ArgumentKind::Tree,
     .shown = "TREE",
     .missing = "no tree",
     .example = "btcheck monitor TREE --prop RULES.ltl <EVENTS.jsonl",
     .summary = "rules watched while the robot runs, event by event",
     .description =
         "Reads a line of JSON for each message of Nav2's /behavior_tree_log "
         "and answers it with a verdict, in the form of ROSMonitoring's "
         "oracles."},
    {.command = Watch,
     .word = "watch",
     .argument = ArgumentKind::Robots,
     .shown = "groot2://HOST[:PORT]...",
     .missing = "no robot",
     .example = "btcheck watch groot2://robot --prop RULES.ltl",
     .summary = "a robot that runs, watched through its Groot2 publisher",
     .description =
         "Connects to the Groot2Publisher of a program with BehaviorTree.CPP "
         "4, as Groot2 does, at port 1667 unless the address says another. "
         "Tells the verdict of each rule at the moment that decides it, shows "
         "the run in a browser, and keeps it as a log, until Ctrl-C or "
         "--timeout. What the robot does is left alone, but for --inject and "
         "--break."},
    {.command = WhatIf,
     .word = "whatif",
     .argument = ArgumentKind::Tree,
     .shown = "TREE",
     .missing = "no tree",
     .example = "btcheck whatif TREE",
     .summary = "what the mission does when something breaks",
     .description =
         "Puts each fault into each leaf and searches all runs: what the "
         "mission does then, who notices, how it gets on, and what is never "
         "noticed. All other leaves do what they are for. --order 2 looks at "
         "pairs of faults as well."},
    {.command = Command::Diff,
     .word = "diff",
     .argument = ArgumentKind::Trees,
     .shown = "TREE TREE",
     .missing = "no trees",
     .example = "btcheck diff OLD.xml NEW.xml",
     .summary = "whether two trees do the same, else a run that one has alone",
     .description =
         "Compares all runs of two trees, whoever ticks them and whatever "
         "their leaves answer: either they are equivalent, or a shortest run "
         "is "
         "shown that one has and the other has not, and what else a check "
         "finds "
         "in one of them only. Leaves are the same by name and place. Two "
         "folders are compared tree by tree; with --git, one tree or folder "
         "with what it was; with --against, with itself under another "
         "profile, or the second of two trees under that one."},
    {.command = Explain,
     .word = "explain",
     .argument = ArgumentKind::CodeOrRun,
     .shown = "[CODE|LOG]",
     .summary = "why a run ended so, or what the code of a message means",
     .description =
         "Of a log of BehaviorTree.CPP or Nav2, or a run that was kept: tells "
         "which answers decided how it ended, from when on it could not have "
         "ended well, and which fault of which leaf it shows. The tree is the "
         "one that the log brings along, where --tree names none. Of a code "
         "such as BT1014: tells what it means, what to do about it, and the "
         "smallest example. Without either, lists all codes."},
    {.command = Demo,
     .word = "demo",
     .summary = "a drone mission, and the hole in it",
     .description =
         "Checks a published drone mission, shows the run in which nobody "
         "watches the battery, and proves the tree that mends it."},
    {.command = Init,
     .word = "init",
     .argument = ArgumentKind::Tree,
     .shown = "TREE",
     .missing = "no tree",
     .example = "btcheck init TREE -o RULES.ltl",
     .summary = "write rules to begin with",
     .description =
         "Proposes rules from what the tree looks like, and checks them: what "
         "holds is written as a rule, what does not as a question, with the "
         "run that raises it."},
    {.command = Leaves,
     .word = "leaves",
     .argument = ArgumentKind::Batches,
     .shown = "FOLDER|TREE...",
     .missing = "no folder and no tree",
     .example = "btcheck leaves FOLDER -o nodes.xml",
     .summary = "begin a file that describes the leaves of a project",
     .description =
         "Writes an entry for each type of leaf of which nothing is known: its "
         "kind, the ports that are seen, and where it stands. As XML it is "
         "read by --models, and of itself beside the trees; as contracts by "
         "--leaves."},
    {.command = Command::Answer,
     .word = "answer",
     .argument = ArgumentKind::Batches,
     .shown = "FOLDER|TREE...",
     .missing = "no folder and no tree",
     .example = "btcheck answer FOLDER",
     .summary = "answer the questions of the findings, for a whole project",
     .description =
         "Asks what a check could not know, question by question, and keeps "
         "the answers as contracts of leaves, in the file of --leaves or in "
         "answers.leaves. What fits an answer is not asked again, in no tree "
         "of the project; what does not is a warning."},
    {.command = Fmt,
     .word = "fmt",
     .argument = ArgumentKind::Files,
     .shown = "FOLDER|FILE...",
     .missing = "no folder and no file",
     .example = "btcheck fmt FOLDER",
     .summary = "write trees, contracts and rules in one style",
     .description =
         "Formats XML of BehaviorTree.CPP, .btf, leaf contracts and rules, and "
         "names the files that it has changed. Blanks, line breaks and the "
         "order of attributes change; comments, values and what is checked do "
         "not. `-` formats standard input to standard output."},
    {.command = Serve,
     .word = "serve",
     .summary = "a process that stays, for editors and other programs",
     .description =
         "Answers requests of JSON-RPC 2.0 on standard input and output, each "
         "behind a Content-Length: check, lint, describe, simulate, init, "
         "leaves and explain, several at a time. A request has its own limits "
         "and can be cancelled."},
    {.command = Mcp,
     .word = "mcp",
     .summary = "tools for agents, by the Model Context Protocol",
     .description =
         "Answers an agent on standard input and output: check_tree, "
         "explain_finding, propose_repair, apply_repair, simulate and "
         "list_node_types. Reads what lies in --root, and writes nothing."},
    {.command = Lsp,
     .word = "lsp",
     .summary = "what editors ask while you type",
     .description =
         "Answers an editor on standard input and output, by the Language "
         "Server Protocol: what is wrong as you type, what a search finds and "
         "what repairs it, hover, completion, definitions, names changed in "
         "all "
         "files. docs/editors.md says how editors start it."},
    {.command = Completions,
     .word = "completions",
     .argument = ArgumentKind::Shell,
     .shown = "bash|zsh|fish",
     .missing = "no shell",
     .example = "btcheck completions bash",
     .summary = "what a shell needs to complete words",
     .description = "Prints the completions for one shell.",
     .is_hidden = true},
    {.command = Man,
     .word = "man",
     .summary = "the man page, as troff",
     .description = "Prints the man page, as troff.",
     .is_hidden = true}};

constexpr CommandSet kReadsTrees = {
    Check,   Batch,           Lint,   Space,   Export,       Simulate, Init,
    Conform, Command::Answer, WhatIf, Explain, Command::Diff};
constexpr CommandSet kReadsModels = {Check,   Batch,           Lint,   Space,
                                     Export,  Simulate,        Init,   Conform,
                                     Leaves,  Command::Answer, WhatIf, Tests,
                                     Explain, Command::Diff};
// An XML tree has an executor of its own.
constexpr CommandSet kReadsBtf = {
    Check,   Batch, Lint,   Space, Export,  Simulate,     Init,
    Conform, Run,   WhatIf, Tests, Explain, Command::Diff};
constexpr CommandSet kHasSettings = {
    Check,   Batch,  Lint,   Space,           Export,       Simulate, Init,
    Conform, Run,    Leaves, Command::Answer, Serve,        Mcp,      Lsp,
    Fmt,     WhatIf, Tests,  Explain,         Command::Diff};
constexpr CommandSet kFinds = {Check, Batch, Lint};
constexpr CommandSet kSearches = {Check, Batch, Space,
                                  Demo,  Init,  Command::Answer};
constexpr CommandSet kChecks = {Check, Batch, Demo, Init, Command::Answer};
constexpr CommandSet kKeepsParts = {Check, Batch, Init,  Command::Answer, Serve,
                                    Mcp,   Lsp,   Tests, Command::Diff};
constexpr CommandSet kCountsStates = {
    Check,           Batch, Space, Demo, Init,  Conform,
    Command::Answer, Serve, Mcp,   Lsp,  Tests, Command::Diff};
constexpr CommandSet kLimited = {
    Check,        Batch, Lint, Space,   Export, Trace,           Demo,
    Simulate,     Init,  Run,  Conform, Leaves, Command::Answer, Serve,
    Mcp,          Lsp,   Fmt,  Watch,   WhatIf, Tests,           Explain,
    Command::Diff};
constexpr CommandSet kEvery = {
    Check,        Batch,       Lint, Space,  Export,          Trace,
    Simulate,     Explain,     Demo, Init,   Conform,         Run,
    Monitor,      Completions, Man,  Leaves, Command::Answer, Serve,
    Mcp,          Lsp,         Fmt,  Watch,  WhatIf,          Tests,
    Command::Diff};

constexpr std::string_view kProfileNames =
    "paper btcpp-3.5.1 btcpp-3.5 btcpp-3.6 btcpp-3.7 btcpp-3.8 btcpp-4.0 "
    "btcpp-4.1 btcpp-4.2 btcpp-4.3 btcpp-4.4 btcpp-4.5 btcpp-4.6 btcpp-4.7 "
    "btcpp-4.8 "
    "btcpp-4.9 btcpp-4.10 btcpp-4 py_trees "
    "nav2-galactic nav2-humble nav2-iron nav2-jazzy "
    "nav2-kilted nav2-lyrical nav2-main";

constexpr OptionRow kOptions[] = {
    {.name = "--prop",
     .value = "FILE",
     .names = ValueKind::File,
     .help = "a file of properties",
     .commands = {Check, Lint, Export, Trace, Monitor, Run, Watch, WhatIf,
                  Command::Diff},
     .is_repeatable = true,
     .first = {Check, Export, Trace, Run, Monitor, Watch, WhatIf},
     .example = "btcheck TREE --prop RULES.ltl"},
    {.name = "-e",
     .value = "RULE",
     .help = "a rule, as in a file of properties; its name may be left out",
     .commands = {Check, Lint, Export, Trace, Monitor, Run, Watch, WhatIf,
                  Command::Diff},
     .is_repeatable = true,
     .first = {Check, Trace},
     .example = "btcheck TREE -e 'never land.failure'"},
    {.name = "--tick",
     .value = "SEMANTICS",
     .choices = "root leaves nodes none",
     .fallback = "what the property file says, else root",
     .help = "where time passes",
     .commands = {Check, Batch, Space, Export, Simulate, Demo, Init, Conform,
                  WhatIf, Explain, Command::Diff}},
    {.name = "--profile",
     .value = "PROFILE",
     .choices = kProfileNames,
     .fallback = "paper for .btf; an XML tree says it",
     .help = "the engine and version whose nodes the tree has",
     .commands = kReadsModels,
     .first = {Check, Batch, Init, Conform},
     .example = "btcheck TREE.xml --profile nav2-humble"},
    {.name = "--against",
     .value = "PROFILE",
     .choices = kProfileNames,
     .help = "only what is otherwise under this profile: verdicts, findings, "
             "and what nodes can do; diff: a run that the tree has under one "
             "alone",
     .commands = {Check, Command::Diff},
     .example = "btcheck TREE.xml --profile nav2-jazzy --against nav2-lyrical"},
    {.name = "--tick-ms",
     .value = "MILLISECONDS",
     .fallback = "100",
     .help = "how long one tick takes: for rates and durations in time",
     .commands = kReadsBtf,
     .example = "btcheck TREE.xml --tick-ms 10"},
    {.name = "--tick-ms",
     .value = "MILLISECONDS",
     .fallback = "100",
     .help = "how long one tick takes, in a log with --prop or --view",
     .commands = {Trace, Monitor, Watch},
     .first = {Monitor},
     .example = "btcheck trace robot.btlog --prop RULES.ltl --tick-ms 10"},
    {.name = "--tick-gap",
     .value = "MILLISECONDS",
     .fallback = "where ticks begin is not known",
     .help = "logs without ticks: a pause as long or longer parts two "
             "ticks, a "
             "shorter one does not",
     .commands = {Check, Space, Trace, Simulate, Conform, Watch, Explain},
     .example = "btcheck trace robot.btlog --prop RULES.ltl --tick-gap 5"},
    {.name = "--models",
     .value = "FILE",
     .names = ValueKind::File,
     .help = "XML trees: a file with TreeNodesModel",
     .commands = kReadsModels,
     .is_repeatable = true,
     .example = "btcheck TREE.xml --models nav2_tree_nodes.xml"},
    {.name = "--leaves",
     .value = "FILE",
     .names = ValueKind::File,
     .help = "XML trees: a file of leaf contracts",
     .commands = kReadsModels,
     .is_repeatable = true,
     .first = {Check, Batch, Init, Conform},
     .example = "btcheck TREE.xml --leaves robot.leaves"},
    {.name = "--main-tree",
     .value = "ID",
     .help = "XML trees: the tree that runs",
     .commands = kReadsTrees,
     .example = "btcheck TREE.xml --main-tree Patrol"},
    {.name = "--root",
     .value = "DIRECTORY",
     .names = ValueKind::Directory,
     .fallback = "the repository, that of .git or btcheck.toml",
     .help = "what trees, rules, settings and links lead to is read in there "
             "only",
     .commands = kHasSettings,
     .is_repeatable = true,
     .example = "btcheck TREE.xml --root ."},
    {.name = "--config",
     .value = "FILE",
     .names = ValueKind::File,
     .fallback = "the btcheck.toml next above the tree",
     .help = "settings: profile, models, levels of findings",
     .commands = kHasSettings,
     .example = "btcheck TREE.xml --config robot.toml"},
    {.name = "--no-config",
     .help = "look for no btcheck.toml",
     .commands = kHasSettings,
     .example = "btcheck TREE.xml --no-config"},
    {.name = "--loop",
     .help = "tick the tree again after it has ended",
     .commands = kReadsBtf,
     .example = "btcheck TREE.xml --loop"},
    {.name = "--wake-ups",
     .help = "XML trees: tick as tickOnce does, not tickExactlyOnce",
     .commands = {Check, Batch, Lint, Space, Export, Simulate, Init, Conform,
                  Command::Answer},
     .example = "btcheck TREE.xml --wake-ups"},
    {.name = "--from",
     .value = "RUN[@TICK]",
     .names = ValueKind::File,
     .fallback = "the beginning of the tree",
     .help = "begin where this log or kept run ends, or where its tick does",
     .commands = {Check, Space, Simulate},
     .first = {Simulate},
     .example = "btcheck TREE --from robot.btlog@12"},
    {.name = "--topic",
     .value = "NAME",
     .fallback = "the only one that logs a tree",
     .help = "the topic that is read of a recording of ROS 2",
     .commands = {Check, Space, Trace, Simulate, Conform, Explain},
     .example = "btcheck conform robot.mcap TREE.xml --topic "
                "/behavior_tree_log"},
    {.name = "--assume",
     .value = "ASSUMPTION",
     .choices = "actions-end",
     .fallback = "it may run for ever",
     .help = "actions-end: an action ticked again and again ends again "
             "and again",
     .commands = {Check, Batch, Export, Demo},
     .is_repeatable = true,
     .also = "; property files may have `assume` lines"},
    {.name = "--any-count",
     .help = "also tell for which numbers of attempts and rounds each verdict "
             "stands",
     .commands = {Check},
     .example = "btcheck TREE --prop RULES --any-count"},
    {.name = "--search",
     .value = "ORDER",
     .choices = "bfs dfs",
     .fallback = "bfs",
     .help = "bfs: shortest runs; dfs: deep first",
     .commands = kSearches},
    {.name = "--reduce",
     .value = "REDUCTION",
     .choices = "none live full",
     .fallback = "full",
     .help = "none: every interleaving and every value; live: values that "
             "nothing reads any more count as one; full: independent steps "
             "are "
             "not interleaved either",
     .commands = kChecks},
    {.name = "--reduce",
     .value = "REDUCTION",
     .choices = "none live full bisimulation strong",
     .fallback = "none",
     .help = "live, full: as of a check; bisimulation: beside all states, how "
             "many can be told apart by what --observe says; strong: by "
             "every step",
     .commands = {Space},
     .example = "btcheck space TREE --reduce bisimulation"},
    {.name = "--observe",
     .value = "NODES",
     .choices = "root leaves all",
     .fallback = "all; of --export alone: every step",
     .help = "whose answers are seen, beside time: what else happens is "
             "hidden",
     .commands = {Space},
     .example = "btcheck space TREE --reduce bisimulation --observe root"},
    {.name = "--threads",
     .value = "NUMBER",
     .fallback = "one for each core",
     .help = "how many threads search",
     .commands = {Check, Batch, Space, Demo, Init, Command::Answer, WhatIf,
                  Explain}},
    {.name = "--store",
     .value = "STORE",
     .choices = "exact compressed",
     .fallback = "compressed",
     .help = "exact: states as pairs of halves; compressed: the same in half "
             "the memory",
     .commands = {Space},
     .example = "btcheck space TREE --store exact"},
    {.name = "--max-states",
     .value = "NUMBER",
     .fallback = "no limit",
     .help = "stop after about this many states",
     .commands = kCountsStates,
     .first = {Space}},
    {.name = "--max-states",
     .value = "NUMBER",
     .fallback = "300000",
     .help = "stop each search after about this many states",
     .commands = {WhatIf}},
    {.name = "--memory",
     .value = "SIZE",
     .fallback = "three quarters of what there is",
     .help = "stop at this much memory, e.g. 4G",
     .commands = kLimited,
     .first = {Space}},
    {.name = "--on-disk",
     .value = "DIRECTORY",
     .names = ValueKind::Directory,
     .fallback = "stop there",
     .help = "at the limit of --memory, go on in this directory: space, and "
             "rules about single states",
     .commands = kSearches},
    {.name = "--cache",
     .value = "DIRECTORY",
     .names = ValueKind::Directory,
     .fallback = "forget it",
     .help = "keep what is found out of parts of large trees in this "
             "directory, for the next time",
     .commands = kKeepsParts,
     .example = "btcheck TREE --cache .btcheck-cache"},
    {.name = "--timeout",
     .value = "SECONDS",
     .fallback = "never",
     .help = "stop after this many seconds",
     .commands = kLimited,
     .first = {Check, Batch, Space, Watch}},
    {.name = "--watch",
     .help = "check again whenever a file is saved, until Ctrl-C",
     .commands = {Check, Batch},
     .first = {Check},
     .example = "btcheck --watch FOLDER"},
    {.name = "--format",
     .value = "FORMAT",
     .names = ValueKind::Target,
     .choices = "text json jsonl sarif junit github gitlab",
     .fallback = "text",
     .help = "how results are written",
     .commands = {Check, Batch},
     .is_repeatable = true,
     .first = {Check, Batch},
     .example = "btcheck TREE --format json"},
    {.name = "--format",
     .value = "FORMAT",
     .names = ValueKind::Target,
     .choices = "text json sarif github gitlab",
     .fallback = "text",
     .help = "how findings are written",
     .commands = {Lint},
     .is_repeatable = true,
     .first = {Lint}},
    {.name = "--format",
     .value = "FORMAT",
     .names = ValueKind::Target,
     .choices = "text json csv html dot svg opsa",
     .fallback = "text",
     .help = "how faults are told: text, JSON, a sheet for the risk "
             "assessment, a page with all runs, and fault trees in "
             "Graphviz's "
             "language, as a picture or for Open-PSA",
     .commands = {WhatIf},
     .is_repeatable = true,
     .first = {WhatIf},
     .example = "btcheck whatif TREE --format html=faults.html"},
    {.name = "--format",
     .value = "FORMAT",
     .names = ValueKind::Target,
     .choices = "text json markdown html",
     .fallback = "text",
     .help = "how the comparison is told: side by side as text, JSON, Markdown "
             "for a pull request, a page with both trees",
     .commands = {Command::Diff},
     .is_repeatable = true,
     .first = {Command::Diff},
     .example = "btcheck diff OLD.xml NEW.xml --format html=diff.html"},
    {.name = "--format",
     .value = "FORMAT",
     .names = ValueKind::Target,
     .choices = "text json",
     .fallback = "text",
     .help = "how the explanation is written",
     .commands = {Explain},
     .is_repeatable = true,
     .example = "btcheck explain robot.btlog --format json"},
    {.name = "--deny",
     .value = "CODE",
     .fallback = "none",
     .help = "take findings of this code for errors, exit code 1; `warnings` "
             "for all of them",
     .commands = kFinds,
     .is_repeatable = true,
     .first = {Batch, Lint},
     .example = "btcheck TREE --deny warnings"},
    {.name = "--no-repairs",
     .help = "try no repairs: findings tell what to do in words",
     .commands = {Check, Batch}},
    {.name = "--baseline",
     .value = "FILE",
     .names = ValueKind::File,
     .help = "leave out the findings that this file has",
     .commands = kFinds,
     .first = {Batch},
     .example = "btcheck TREE --baseline baseline.json"},
    {.name = "--write-baseline",
     .value = "FILE",
     .names = ValueKind::File,
     .help = "write the findings of now to this file",
     .commands = kFinds,
     .example = "btcheck TREE --write-baseline baseline.json"},
    {.name = "--trace-dir",
     .value = "DIRECTORY",
     .names = ValueKind::Directory,
     .help = "write the run of each finding and each rule to this directory, "
             "as ITF JSON and as a page for a browser",
     .commands = {Check, Batch, Demo, Trace},
     .first = {Check, Batch, Demo},
     .example = "btcheck TREE --prop RULES.ltl --trace-dir runs"},
    {.name = "--trace-dir",
     .value = "DIRECTORY",
     .names = ValueKind::Directory,
     .help = "write the run of each fault that strikes to this directory, as "
             "ITF JSON and as a page for a browser",
     .commands = {WhatIf},
     .example = "btcheck whatif TREE --trace-dir runs"},
    {.name = "--stats",
     .value = "FORMAT",
     .choices = "table json",
     .fallback = "table",
     .help = "how the figures are written",
     .commands = {Space},
     .example = "btcheck space TREE --stats json"},
    {.name = "--export",
     .value = "GRAPH",
     .names = ValueKind::Target,
     .choices = "aut dot",
     .help = "the states and steps of the space, or of its quotient",
     .commands = {Space},
     .first = {Space},
     .example = "btcheck space TREE --export aut"},
    {.name = "--to",
     .value = "FORMAT",
     .choices = "dot svg mermaid automata promela smv fiacre hfiacre xml btf "
                "monitor monitor-cpp ltsmin",
     .help = "the tree as a drawing (dot, svg, mermaid), its automata in "
             "Graphviz's language, a model with the rules of --prop, the "
             "tree in the other language, the rules as a table for "
             "btcheck::observer or as a header in C++, or the command lines "
             "of LTSmin",
     .commands = {Export},
     .is_required = true,
     .first = {Export},
     .example = "btcheck export TREE --to svg"},
    {.name = "--namespace",
     .value = "NAME",
     .fallback = "btcheck_monitor",
     .help = "the C++ namespace of --to monitor-cpp",
     .commands = {Export},
     .example = "btcheck export TREE --prop RULES.ltl --to monitor-cpp "
                "--namespace robot::rules"},
    {.name = "--to",
     .value = "FORMAT",
     .choices = "text html itf svg strip dot mermaid btlog chrome chrome-stack "
                "mcap substitution",
     .help = "what the run is converted to",
     .commands = {Trace},
     .is_required = true,
     .first = {Trace},
     .instead = "--prop -e --view",
     .example = "btcheck trace RUN.itf.json --to html"},
    {.name = "--to",
     .value = "FORMAT",
     .choices = "xml leaves",
     .fallback = "leaves for -o FILE.leaves, else xml",
     .help = "as <TreeNodesModel>, or as contracts",
     .commands = {Leaves},
     .first = {Leaves},
     .example = "btcheck leaves FOLDER --to leaves"},
    {.name = "--to",
     .value = "FORMAT",
     .choices = "googletest pytest jsonl",
     .fallback = "all of them",
     .help = "how the tests are written",
     .commands = {Tests},
     .is_repeatable = true,
     .first = {Tests},
     .example = "btcheck tests TREE -o DIRECTORY --to googletest"},
    {.name = "-o",
     .value = "DIRECTORY",
     .names = ValueKind::Directory,
     .help = "the folder that the files are written into",
     .commands = {Tests},
     .first = {Tests},
     .example = "btcheck tests TREE -o DIRECTORY"},
    {.name = "--force",
     .help = "replace files of these names, whoever has written them",
     .commands = {Tests},
     .first = {Tests},
     .example = "btcheck tests TREE -o DIRECTORY --force"},
    {.name = "-o",
     .value = "FILE",
     .names = ValueKind::File,
     .fallback = "standard output",
     .help = "the file to write",
     .commands = {Trace, Init, Leaves},
     .first = {Trace, Init, Leaves}},
    {.name = "-o",
     .value = "FILE",
     .names = ValueKind::File,
     .fallback = "that of --leaves, else answers.leaves",
     .help = "the file of contracts in which the answers are kept",
     .commands = {Command::Answer},
     .first = {Command::Answer}},
    {.name = "-o",
     .value = "FILE",
     .names = ValueKind::File,
     .help = "keep the run in this file, as ITF JSON",
     .commands = {Simulate, Run},
     .first = {Simulate, Run}},
    {.name = "-o",
     .value = "FILE",
     .names = ValueKind::File,
     .help = "keep what is recorded in this file, as a log for Groot2; the "
             "next recording, after a new start of the program, in FILE-2",
     .commands = {Watch},
     .first = {Watch},
     .example = "btcheck watch groot2://robot -o robot.btlog"},
    {.name = "--tree",
     .value = "FILE",
     .names = ValueKind::File,
     .help = "the tree, or the .btpins file, of a trace of LTSmin",
     .commands = {Trace},
     .example = "btcheck trace run.csv --tree TREE --to html"},
    {.name = "--tree",
     .value = "FILE",
     .names = ValueKind::File,
     .fallback = "the one that the log brings along",
     .help = "the tree that has written the log",
     .commands = {Explain},
     .first = {Explain},
     .example = "btcheck explain robot.btlog --tree TREE"},
    {.name = "--at",
     .value = "TICK",
     .fallback = "the last",
     .help = "the tick that svg, dot and mermaid draw",
     .commands = {Trace},
     .example = "btcheck trace RUN.itf.json --to svg --at 2"},
    {.name = "--seed",
     .value = "NUMBER",
     .fallback = "stepping by hand",
     .help = "a random run, the same for the same number",
     .commands = {Simulate},
     .first = {Simulate},
     .example = "btcheck simulate TREE --seed 7"},
    {.name = "--script",
     .value = "FILE",
     .names = ValueKind::File,
     .help = "the run in which the leaves answer what this file says",
     .commands = {Simulate, Run},
     .first = {Simulate},
     .example = "btcheck simulate TREE --script FILE"},
    {.name = "--ticks",
     .value = "NUMBER",
     .fallback = "100",
     .help = "stop a random or scripted run after this many ticks",
     .commands = {Simulate},
     .first = {Simulate},
     .example = "btcheck simulate TREE --seed 7 --ticks 20"},
    {.name = "--leaves-exec",
     .value = "COMMAND",
     .help = "the process that answers for the leaves",
     .commands = {Run},
     .first = {Run},
     .example = "btcheck run TREE --leaves-exec 'python3 leaves.py'"},
    {.name = "--seed",
     .value = "NUMBER",
     .help = "leaves that answer at random, the same for the same number; with "
             "--leaves-exec, a number that the process is told",
     .commands = {Run},
     .example = "btcheck run TREE --seed 7"},
    {.name = "--ticks",
     .value = "NUMBER",
     .fallback = "when the tree has ended",
     .help = "stop after this many ticks",
     .commands = {Run},
     .first = {Run},
     .example = "btcheck run TREE --seed 7 --ticks 20"},
    {.name = "--no-wait",
     .help = "one tick after the other, without waiting for --tick-ms",
     .commands = {Run},
     .example = "btcheck run TREE --seed 7 --no-wait"},
    {.name = "--answer-ms",
     .value = "MILLISECONDS",
     .fallback = "1000",
     .help = "how long a leaf may take to answer",
     .commands = {Run},
     .example = "btcheck run TREE --leaves-exec ./leaves --answer-ms 50"},
    {.name = "--on-breach",
     .value = "POLICY",
     .choices = "stop fail go-on",
     .fallback = "stop",
     .help = "after an answer that the model does not allow: stop; the leaf "
             "fails; or it goes on, where the model lets it",
     .commands = {Run},
     .example = "btcheck run TREE --leaves-exec ./leaves --on-breach fail"},
    {.name = "--btlog",
     .value = "FILE",
     .names = ValueKind::File,
     .help = "keep the run in this file, as a log for Groot2",
     .commands = {Run},
     .example = "btcheck run TREE --seed 7 --btlog run.btlog"},
    {.name = "--view",
     .value = "PORT",
     .fallback = "any port that is free",
     .help = "show the run while it goes on, to the browsers of this machine; "
             "the address is printed",
     .commands = {Run},
     .may_stand_alone = true,
     .first = {Run},
     .example = "btcheck run TREE --seed 7 --view"},
    {.name = "--view",
     .value = "PORT",
     .fallback = "any port that is free",
     .help = "show a log while it is written, to the browsers of this machine; "
             "the address is printed",
     .commands = {Trace},
     .may_stand_alone = true,
     .first = {Trace},
     .example = "btcheck trace robot.btlog --view"},
    {.name = "--view",
     .value = "PORT",
     .fallback = "any port that is free",
     .help = "with --watch: show the run of what is wrong to the browsers of "
             "this machine; the address is printed",
     .commands = {Check, Batch},
     .may_stand_alone = true,
     .example = "btcheck --watch FOLDER --view"},
    {.name = "--view",
     .value = "PORT",
     .fallback = "any port that is free",
     .help = "show the robots while they run, to the browsers of this machine; "
             "the address is printed",
     .commands = {Watch},
     .may_stand_alone = true,
     .first = {Watch},
     .example = "btcheck watch groot2://robot --view"},
    {.name = "--inject",
     .value = "FAULT",
     .help = "have a node answer instead of what it does, for a test: `NODE "
             "fails` or `succeeds`, then `once` (the default) or `always`, "
             "then `from tick N`",
     .commands = {Watch},
     .is_repeatable = true,
     .example = "btcheck watch groot2://robot --inject 'dock fails' "
                "--allow-inject"},
    {.name = "--break",
     .value = "NODE",
     .help = "stop the tree where this node is about to be ticked, until Enter",
     .commands = {Watch},
     .is_repeatable = true,
     .example = "btcheck watch groot2://robot --break dock --allow-inject"},
    {.name = "--break-for",
     .value = "MILLISECONDS",
     .fallback = "until Enter",
     .help = "with --break: how long the tree stops",
     .commands = {Watch},
     .example = "btcheck watch groot2://robot --break dock --break-for 500 "
                "--allow-inject"},
    {.name = "--allow-inject",
     .help = "allow --inject and --break: the robot does what it would not",
     .commands = {Watch},
     .example = "btcheck watch groot2://robot --inject 'dock fails' "
                "--allow-inject"},
    {.name = "--learn-leaves",
     .value = "FILE",
     .names = ValueKind::File,
     .help = "write what the leaves did in the logs to this file, as contracts",
     .commands = {Conform},
     .first = {Conform},
     .example = "btcheck conform robot.btlog --learn-leaves robot.leaves"},
    {.name = "--coverage",
     .help = "list what nodes can do and have done in no log",
     .commands = {Conform},
     .first = {Conform}},
    {.name = "--jobs",
     .value = "NUMBER",
     .fallback = "one for each core",
     .help = "how many entries are checked at a time",
     .commands = {Batch},
     .example = "btcheck batch FOLDER --jobs 4"},
    {.name = "--jobs",
     .value = "NUMBER",
     .fallback = "one for each core",
     .help = "how many requests are worked on at a time",
     .commands = {Serve, Mcp},
     .first = {Serve, Mcp},
     .example = "btcheck serve --stdio --jobs 4"},
    {.name = "--stdio",
     .help = "on standard input and output; there is no other way yet",
     .commands = {Serve, Lsp},
     .first = {Serve},
     .example = "btcheck serve --stdio"},
    {.name = "--shard",
     .value = "I/N",
     .fallback = "all of it",
     .help = "the i-th of n parts",
     .commands = {Batch},
     .example = "btcheck batch FOLDER --shard 1/4"},
    {.name = "--fail-fast",
     .help = "stop at the first entry that is not as expected",
     .commands = {Batch},
     .example = "btcheck batch FOLDER --fail-fast"},
    {.name = "--resume",
     .help = "take results of an earlier run where nothing has changed; with "
             "--results, retry what has failed there",
     .commands = {Batch},
     .first = {Batch},
     .example = "btcheck batch FOLDER --resume"},
    {.name = "--results",
     .value = "DIRECTORY",
     .names = ValueKind::Directory,
     .help = "keep each result as a file in this directory, and share the work "
             "with all who do the same, on any machine",
     .commands = {Batch},
     .example = "btcheck batch FOLDER --results /mnt/results"},
    {.name = "--no-wait",
     .help = "with --results: end when there is nothing left to begin, though "
             "others are seen at work",
     .commands = {Batch},
     .example = "btcheck batch FOLDER --results DIRECTORY --no-wait"},
    {.name = "--lease",
     .value = "SECONDS",
     .fallback = "60",
     .help = "with --results: take over the work of who has shown no sign of "
             "life for so long",
     .commands = {Batch},
     .example = "btcheck batch FOLDER --results DIRECTORY --lease 300"},
    {.name = "--join",
     .value = "DIRECTORY",
     .names = ValueKind::Directory,
     .help = "report what --results has left in this directory, and check "
             "nothing",
     .commands = {Batch},
     .example = "btcheck batch FOLDER --join /mnt/results"},
    {.name = "--report",
     .value = "FILE",
     .names = ValueKind::File,
     .help = "write the results to this file, as an HTML page",
     .commands = {Batch},
     .first = {Batch},
     .example = "btcheck batch FOLDER --report report.html"},
    {.name = "--check",
     .help = "change nothing: list the files that are in another style, exit "
             "code 1",
     .commands = {Fmt},
     .first = {Fmt},
     .example = "btcheck fmt --check FOLDER"},
    {.name = "--diff",
     .help = "change nothing: show what would change, as a unified diff",
     .commands = {Fmt},
     .first = {Fmt},
     .example = "btcheck fmt --diff FILE"},
    {.name = "--verify",
     .help = "read and lower each tree before and after, and leave it as it is "
             "unless the networks are equal",
     .commands = {Fmt},
     .first = {Fmt},
     .example = "btcheck fmt --verify FOLDER"},
    {.name = "--stdin-name",
     .value = "NAME",
     .help = "what the file on standard input is called: its ending says of "
             "which kind it is",
     .commands = {Fmt},
     .first = {Fmt},
     .example = "btcheck fmt - --stdin-name TREE.xml <FILE >FORMATTED"},
    {.name = "--order",
     .value = "NUMBER",
     .choices = "1 2",
     .fallback = "1",
     .help = "how many faults at once: 2 for pairs as well, where both can "
             "strike",
     .commands = {WhatIf},
     .first = {WhatIf},
     .example = "btcheck whatif TREE --order 2"},
    {.name = "--faults",
     .value = "KIND",
     .choices = "fails fails-once fails-for-ever says-yes never-ends late "
                "inverted flips-once halted writes-nothing writes-other throws",
     .fallback = "all",
     .help = "faults of this kind only",
     .commands = {WhatIf},
     .is_repeatable = true,
     .example = "btcheck whatif TREE --faults never-ends --faults throws"},
    {.name = "--only",
     .value = "NODE",
     .fallback = "all leaves",
     .help = "faults of this leaf, or of those below this node",
     .commands = {WhatIf},
     .example = "btcheck whatif TREE --only NODE"},
    {.name = "--late",
     .value = "TICKS",
     .fallback = "10",
     .help = "by how much a leaf ends too late",
     .commands = {WhatIf},
     .example = "btcheck whatif TREE --late 50"},
    {.name = "--others",
     .value = "HOW",
     .choices = "work contract",
     .fallback = "work",
     .help = "what the leaves without a fault do: work, actions succeed and "
             "conditions answer either way; contract, all that their contracts "
             "allow",
     .commands = {WhatIf},
     .example = "btcheck whatif TREE --others contract"},
    {.name = "--against",
     .value = "FILE",
     .names = ValueKind::File,
     .help = "exit code 1 only for faults that are worse than in this result, "
             "kept by --format json",
     .commands = {WhatIf},
     .first = {WhatIf},
     .example = "btcheck whatif TREE --against faults.json"},
    {.name = "--observe",
     .value = "WHAT",
     .fallback = "leaves",
     .help =
         "what is seen of a run beside its ticks and what the tree answers: "
         "leaves; root, nothing else; or a node",
     .commands = {Command::Diff},
     .is_repeatable = true,
     .first = {Command::Diff},
     .example = "btcheck diff OLD.xml NEW.xml --observe root"},
    {.name = "--caller",
     .value = "CALLER",
     .choices = "any once",
     .fallback = "any",
     .help = "any: ticks the trees again when they have ended, and may halt "
             "them; once: until they have ended",
     .commands = {Command::Diff},
     .first = {Command::Diff},
     .example = "btcheck diff OLD.xml NEW.xml --caller once"},
    {.name = "--git",
     .value = "REVISION",
     .help = "compare one tree, or folder, with what it was then",
     .commands = {Command::Diff},
     .first = {Command::Diff},
     .example = "btcheck diff --git main TREE.xml"},
    {.name = "--color",
     .value = "MODE",
     .choices = "auto always never",
     .fallback = "auto",
     .help = "colours in messages and reports",
     .commands = kEvery},
    {.name = "-q", .help = "no progress and no statistics", .commands = kEvery},
    {.name = "-v",
     .help = "show every run, step by step",
     .commands = {Check, Batch, Trace, Demo},
     .first = {Check}},
    {.name = "-v",
     .help = "tell of every fault, and name the btcheck.toml that is used",
     .commands = {WhatIf}},
    {.name = "-v",
     .help = "name the btcheck.toml that is used",
     .commands = {Lint, Space, Export, Simulate, Conform, Run, Explain,
                  Command::Diff}},
    {.name = "--help",
     .help = "a screen of help; COMMAND --help: of one command; --help all: "
             "every option",
     .commands = kEvery},
    {.name = "--version", .help = "print the version", .commands = kEvery},
    {.name = "--licenses",
     .help = "print the licences of btcheck and of what it is linked with",
     .commands = kEvery}};

}  // namespace

std::span<const CommandRow> command_rows() { return kCommands; }

std::span<const CommandRow> shown_commands() {
  return {kCommands,
          std::ranges::find(kCommands, true, &CommandRow::is_hidden)};
}

const CommandRow& row_of(Command command) {
  const CommandRow* row =
      std::ranges::find(kCommands, command, &CommandRow::command);
  assert(row != std::end(kCommands));
  return *row;
}

const CommandRow* command_named(std::string_view word) {
  const CommandRow* row = std::ranges::find(kCommands, word, &CommandRow::word);
  return row == std::end(kCommands) ? nullptr : row;
}

std::span<const OptionRow> option_rows() { return kOptions; }

const OptionRow* option_of(Command command, std::string_view name) {
  const OptionRow* row =
      std::ranges::find_if(kOptions, [&](const OptionRow& known) {
        return known.name == name && known.commands.contains(command);
      });
  return row == std::end(kOptions) ? nullptr : row;
}

std::vector<std::string> words_of(std::string_view text) {
  std::vector<std::string> words;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(' '), text.size());
    words.emplace_back(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return words;
}

std::vector<std::string> choices_of(const OptionRow& option) {
  return words_of(option.choices);
}

std::string commands_with(std::string_view name) {
  std::vector<std::string> words;
  for (const CommandRow& row : shown_commands()) {
    if (option_of(row.command, name) != nullptr) words.emplace_back(row.word);
  }
  return listed(words, "and");
}

std::string listed(const std::vector<std::string>& words,
                   std::string_view last_joint) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (i > 0 && i + 1 < words.size()) text += ", ";
    if (i > 0 && i + 1 == words.size()) text += fmt::format(" {} ", last_joint);
    text += words[i];
  }
  return text;
}

}  // namespace btcheck
