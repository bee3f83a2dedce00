// SPDX-License-Identifier: MIT
//
// What is wrong with a command line, with files other than trees and rules, and
// with memory.
#include "report/codes/codes.hpp"

namespace btcheck {
namespace {

constexpr CodeExample manifest_example(std::string_view manifest,
                                       std::string_view tree = {}) {
  return {.tree = tree,
          .other_name = "batch.toml",
          .other = manifest,
          .command = "batch batch.toml"};
}

constexpr CodeRow kCommandCodes[] = {
    {.code = "BT0001",
     .summary = "a wrong command line",
     .description =
         "The words after `btcheck` cannot be understood: an unknown option, "
         "one of another command, a value it does not take. Nothing was read.",
     .help = "`btcheck COMMAND --help` lists what a command takes.",
     .example = {.tree = kOneAction, .command = "tree.btf --tick leaf"}},
    {.code = "BT0002",
     .summary = "an input file cannot be read",
     .description = "There is no such file, it is a directory, a pipe or a "
                    "device, it may not be read, or it is larger than 64 "
                    "MiB.",
     .help = "Look at the name: it is relative to the directory you are in.",
     .example = {.command = "nowhere.btf"}},
    {.code = "BT0003",
     .summary = "a property file that names no tree was given alone",
     .description = "A property file can stand alone on the command line only "
                    "if it says which tree it is about.",
     .help = "Write `tree \"FILE.btf\"` as its first line, or name both files: "
             "btcheck TREE --prop RULES.ltl.",
     .example = {.rules = "property p: never dead", .command = "rules.ltl"}},
    {.code = "BT0004",
     .summary = "an output cannot be written",
     .description = "The file or directory for a report, a run or a graph "
                    "cannot be written to. Where that can be known before the "
                    "check begins, nothing is checked, so no result is lost. "
                    "Of the directory of --cache it is a warning: what is "
                    "told is the same without it.",
     .help = "Make the directory, or choose another place.",
     .example = {.tree = kOneAction,
                 .command = "tree.btf --format json=nowhere/report.json"}},
    {.code = "BT0005",
     .summary = "a tree that cannot be exported",
     .description =
         "A value in a guard or an assignment may leave the 32 bits that "
         "numbers have in the other language. There it would wrap around, here "
         "it does not, so the model would be another one. Or the property "
         "files ask for different tick semantics, and a model has one. "
         "H-Fiacre is written of .btf trees with time, without rules.",
     .help = "Give the variables smaller ranges.",
     .example = {.tree = R"((defsv x :min 0 :max 50000)
(BehaviorTree :name t (Eval (< (* x x) 100))))",
                 .command = "export tree.btf --to promela"}},
    {.code = "BT0006",
     .summary = "a property that is not exported",
     .description =
         "The other language cannot say this property, or not in a way that "
         "surely means the same; a drawing has no properties at all. A model "
         "is written without it, and a comment in it says so.",
     .help = "Check the property with btcheck.",
     .severity = Severity::Warning,
     .example = {.tree = kOneAction,
                 .rules = "property p: AG (EF a.success)",
                 .command = "export tree.btf --to promela --prop rules.ltl"}},
    {.code = "BT0007",
     .summary = "a state space too large for a graph",
     .description =
         "`space --export dot` draws up to 2,000 states: more show nothing. "
         "`--export aut` writes any number. Both stop at a limit of the "
         "search, and then no file is there.",
     .help = "Write it with --export aut, or draw what can be seen of it: "
             "--reduce bisimulation.",
     .example = {.tree = R"((defsv x :max 100000)
(BehaviorTree :name t :loop 1
  (Eval (:= x (mod (+ x 1) 100000)))))",
                 .command = "space tree.btf --export dot"}},
    {.code = "BT0008",
     .summary = "a property that Fiacre's compiler does not read",
     .description =
         "Fiacre has this real-time pattern, but its compiler frac 2.3.0 knows "
         "no `first` and no interval without an end. The model is written "
         "without the property, and a comment in it says so.",
     .help = "Check the property with btcheck, or ask for less: an answer from "
             "the start on, or one until some time.",
     .severity = Severity::Warning,
     .example = {.tree = kOneAction,
                 .rules = R"(property p:
    a.ticked leadsto first a.success within [1,2])",
                 .command = "export tree.btf --to fiacre --prop rules.ltl"}},
    {.code = "BT0009",
     .summary = "an input outside of the folders that may be read",
     .description =
         "A tree, a file of rules, an included file, settings or a manifest "
         "lies outside of the repository that holds what the command line "
         "names: the folder of .git, or else of btcheck.toml. Or a name with a "
         "dot at its beginning hides it there. --root names other folders. "
         "Links are followed first. The file is not opened, so "
         "that the tree of a stranger cannot quote from yours.",
     .help = "If the file belongs to the robot, name a folder that holds them "
             "all: --root DIRECTORY.",
     .example = {.tree = kOneAction,
                 .rules = "tree \"tree.btf\"\nproperty p: never dead",
                 .command = "rules.ltl --root /usr/share"}},
    {.code = "BT0010",
     .summary = "a node that the other language does not have",
     .description =
         "`export --to xml` writes a .btf tree as XML of BehaviorTree.CPP, and "
         "`export --to btf` an XML tree as .btf. A node type, script or count "
         "that the other language cannot say ends it: nothing is written.",
     .help = "Convert a tree without it, and add by hand what stands for it.",
     .example = {.tree = R"((defsv x :max 3)
(BehaviorTree :name t (Eval (< x 2))))",
                 .command = "export tree.btf --to xml"}},
    {.code = "BT0011",
     .summary = "something that a conversion leaves out",
     .description =
         "The tree in the other language is written without it, so it allows "
         "more, or means something else there: a contract of a leaf, a name, "
         "an argument, blackboard entries.",
     .help = "Say it where the other language has a place for it: a file of "
             "leaf contracts, a declaration.",
     .severity = Severity::Warning,
     .example = {.tree = "(BehaviorTree :name t :loop 1 (Condition :ID c))",
                 .command = "export tree.btf --to xml"}},
    {.code = "BT0012",
     .summary = "a node type that means something else in the other language",
     .description =
         "Both languages have the type, and it does not do quite the same. "
         "docs/semantics.md has a table of all types.",
     .help = "Check the converted tree, too.",
     .severity = Severity::Note,
     .example = {.tree = "(BehaviorTree :name t (Repeat :repeat 2 (Action :ID "
                         "a)))",
                 .command = "export tree.btf --to xml"}},
    {.code = "BT0013",
     .summary = "a file that `fmt` leaves as it is",
     .description =
         "In the style of `btcheck fmt` the file would say something else. As "
         "a "
         "rule a comment that allows findings stands in one line with several "
         "nodes: with a line for each of them it would allow less.",
     .help = "Put the comment into a line of its own, right above the node "
             "that it is about.",
     .example = {.body = "<Sequence><AlwaysSuccess/><AlwaysFailure/>"
                         "</Sequence> <!-- btcheck: allow both -->",
                 .command = "fmt --check tree.xml"}},
    {.code = "BT0014",
     .summary = "rules name a node by a line that it has left",
     .description =
         "`btcheck fmt` has moved nodes of a tree to other lines, and rules "
         "beside it name one by its line, `land@23` or `Sequence17`.",
     .help =
         "Write the new line; or give the node a name and write that, which "
         "stays when lines move.",
     .severity = Severity::Warning,
     .example = {.tree = "\n\n(BehaviorTree :name t (Action :ID a))",
                 .rules = "tree \"tree.btf\"\nproperty p: never a@3.failure",
                 .command = "fmt --check tree.btf"}},
    {.code = "BT9001",
     .summary = "memory ran out",
     .description =
         "The system refused more memory before btcheck's own limit "
         "was reached, or ended the process for want of it. There is "
         "no verdict.",
     .help = "Set a limit that is kept, for instance --memory 4G: then btcheck "
             "reports what it has searched."},
    {.code = "BT9003",
     .summary = "the limits were reached before there was an answer",
     .description =
         "--timeout or --memory was reached, or the command was interrupted, "
         "while the stage that is named was under way: reading, drawing the "
         "automata, looking for what is suspicious, or telling. Nothing is "
         "known, and the exit code is 3. A limit that is reached in a search "
         "leaves what has been found by then.",
     .help = "Raise the limit, or ask about a part of the tree.",
     .example = {.tree = kOneAction, .command = "tree.btf --timeout 0.000001"}},
    {.code = "BT1301",
     .summary = "a file that is no run in ITF JSON, or a damaged one",
     .description =
         "`btcheck trace` reads what --trace-dir writes: ITF JSON with the "
         "tree and its nodes in `#meta`. Other programs' ITF has no nodes.",
     .help = "Let btcheck write the run again.",
     .example = {.other_name = "run.itf.json",
                 .other = "{}",
                 .command = "trace run.itf.json --to text"}},
    {.code = "BT1302",
     .summary = "a file that is no log of BehaviorTree.CPP or Nav2",
     .description =
         "The file does not begin as FileLogger2 writes it, or is of a version "
         "that is not known. Or it is a recording of ROS 2 (.mcap, .db3) "
         "without a topic of the type nav2_msgs/msg/BehaviorTreeLog, or packed "
         "in a way that is not read: chunks may be packed by zstd, by lz4 or "
         "not at all, and of a database only plain tables are read: a view, a "
         "virtual table or a generated column would be a program that runs "
         "when it is looked at.",
     .help = "Check whether the file is the one that FileLogger2 wrote "
             "(.btlog), FileLogger (.fbl) or rosbag2 (.mcap, .db3).",
     .example = {.other_name = "robot.btlog",
                 .other = "not a log",
                 .command = "trace robot.btlog --to text"}},
    {.code = "BT1303",
     .summary = "a damaged log",
     .description = "The log breaks off in its heading, or a record names a "
                    "node that the log's tree does not have.",
     .help =
         "Record it again, and let the executor end before you copy the file.",
     .example = {.other_name = "robot.btlog",
                 .other = "BTCPP4-FileLogger2",
                 .command = "trace robot.btlog --to text"}},
    {.code = "BT1304",
     .summary = "a log whose last record is cut off",
     .description = "The program that wrote it was probably killed while it "
                    "was writing. All records before the last one are printed.",
     .help = "Nothing, unless the end matters.",
     .severity = Severity::Warning,
     .example =
         {.tree = kOneAction,
          .script = "a: success",
          .command =
              "simulate tree.btf --script script.txt -o run.itf.json\ntrace "
              "run.itf.json --to btlog -o whole.btlog\n$ head -c -1 "
              "whole.btlog > robot.btlog\ntrace robot.btlog --to text"}},
    {.code = "BT1305",
     .summary = "a tick that the run does not have",
     .description = "`--at` asks for a tick after the run's last one.",
     .help = "The help of the message says which tick is the last.",
     .example = {.tree = kOneAction,
                 .rules = "property p expect violated: never a.failure",
                 .command = "tree.btf --prop rules.ltl --trace-dir runs\ntrace "
                            "runs/tree.p.itf.json --to svg --at 9"}},
    {.code = "BT1306",
     .summary = "a log that can only be printed",
     .description = "A log of BehaviorTree.CPP has the changes of statuses and "
                    "neither ticks nor answers, so it cannot become a picture "
                    "or another format. One with the marks of "
                    "btcheck::observer can, as far as it is short enough for "
                    "one run.",
     .help = "Write --to text, or log with btcheck::observer.",
     .example = {.tree = kOneAction,
                 .rules = "property p expect violated: never a.failure",
                 .command = "tree.btf --prop rules.ltl --trace-dir runs\ntrace "
                            "runs/tree.p.itf.json --to btlog -o "
                            "robot.btlog\ntrace robot.btlog --to svg"}},
    {.code = "BT1307",
     .summary = "a run that does not grow is not followed",
     .description = "--view follows a log of BehaviorTree.CPP, .btlog or .fbl, "
                    "while it is written. A run that btcheck has kept as ITF "
                    "JSON is over.",
     .help = "Write --to html, and open the page.",
     .example = {.tree = kOneAction,
                 .rules = "property p expect violated: never a.failure",
                 .command = "tree.btf --prop rules.ltl --trace-dir runs\ntrace "
                            "runs/tree.p.itf.json --view"}},
    {.code = "BT1308",
     .summary = "a quotation without an end in a .btpins file",
     .description =
         "A .btpins file, and the variable BTCHECK_PINS, hold the words of a "
         "command line. Words with blanks stand between two of the marks ' or "
         "\".",
     .help = "Close the quotation with the mark that it begins with.",
     .example = {.tree = kOneAction,
                 .other_name = "tree.btpins",
                 .other = "tree.btf -e 'never a.failure",
                 .command = "trace run.csv --tree tree.btpins --to text"}},
    {.code = "BT1309",
     .summary = "a file that is no printed trace of LTSmin, or of another tree",
     .description =
         "`btcheck trace --tree` reads what `ltsmin-printtrace RUN.gcf "
         "RUN.csv` prints of a trace that LTSmin has found with "
         "libbtcheck-pins.so. It has a column for each variable of the tree; "
         "archives of LTSmin (.gcf) are not read.",
     .help = "Name the tree, or the .btpins file, that LTSmin was given.",
     .example = {.tree = kOneAction,
                 .other_name = "run.csv",
                 .other = "battery:number\n1\n",
                 .command = "trace run.csv --tree tree.btf --to text"}},
    {.code = "BT1310",
     .summary = "a trace of LTSmin that the tree cannot take",
     .description =
         "A step of the trace is none of the tree: the trace was changed, or "
         "LTSmin and btcheck do not agree about the tree. There is no verdict, "
         "and the exit code is 4.",
     .help = "Report it, with the tree and the trace.",
     .example =
         {.tree = kOneAction,
          .other_name = "run.csv",
          .other =
              "a_btn1.location:a_btn1.location,a_btn1.caller:a_btn1.caller,"
              "a_btn1.rstatus:a_btn1.rstatus,t_btn0.location:t_btn0.location,"
              "t_btn0.rstatus:t_btn0.rstatus,t_btn0.t:number\n"
              "start_,None,no_ret_status,start_,no_ret_status,0\nstart_,None,"
              "no_ret_status,start_,no_ret_status,0",
          .command = "trace run.csv --tree tree.btf --to text"}},
    {.code = "BT1311",
     .summary = "a log that the limits do not suffice to read",
     .description =
         "A small file can unpack to much more. Reading ended when --timeout "
         "or --memory was reached, or by a signal; there is no verdict.",
     .help = "Give more time or memory, or record the topic of the tree "
             "alone."},
    {.code = "BT1312",
     .summary = "marks of another log",
     .description =
         "Beside a log lies a file of marks, which btcheck::observer writes "
         "with it. This one was written with another log: it began at another "
         "time, or its tree is another.",
     .help = "Keep a log and its marks together, or remove the marks.",
     .example =
         {.tree = kOneAction,
          .script = "a: success",
          .command =
              "simulate tree.btf --script script.txt -o run.itf.json\ntrace "
              "run.itf.json --to btlog -o robot.btlog\n"
              "$ { printf 'btcheck-marks\\1\\4'; head -c 17 /dev/zero; } > "
              "robot.btlog.marks\ntrace robot.btlog --to text"}},
    {.code = "BT1313",
     .summary = "events of a log that were lost",
     .description =
         "The disk was too slow for btcheck::observer, which never lets a "
         "robot wait. What comes later is not known to follow what was before, "
         "so the log is read up to there.",
     .help = "Write the log to a faster disk.",
     .severity = Severity::Warning,
     .example =
         {.command =
              "$ echo "
              "QlRDUFA0LUZpbGVMb2dnZXIyAVwAAAA8cm9vdCBCVENQUF9mb3JtYXQ9IjQi"
              "PjxCZWhhdmlvclRyZWUgSUQ9Ik0iIF9mdWxscGF0aD0iIj48QSBfdWlkPSIx"
              "Ii8+PC9CZWhhdmlvclRyZWU+PC9yb290PgAAAAAAAAAA"
              " | base64 -d >robot.btlog; echo "
              "YnRjaGVjay1tYXJrcwEEAAAAAAAAAAB1ktEWJJrf9AAL"
              " | base64 -d >robot.btlog.marks\n"
              "trace robot.btlog --to text"}},
    {.code = "BT1401",
     .summary = "a script names a leaf that does not exist",
     .description = "Before the colon stands the name of a leaf or of a "
                    "variable that moves on its own.",
     .help = "Take the name that is suggested.",
     .example = {.tree = kOneAction, .script = "b: success"}},
    {.code = "BT1402",
     .summary = "a script names something that cannot be scripted",
     .description =
         "A script can only say what the world decides: the answers of actions "
         "and conditions, what SetSV measures, and variables that move on "
         "their own. A name must not fit leaves of several kinds.",
     .help = "Script the leaves below the node.",
     .example = {.tree = R"((defsv fls :max 3)
(BehaviorTree :name t
  (Sequence :name s
    (Eval (< fls 3))
    (Action :ID a))))",
                 .script = "s: success"}},
    {.code = "BT1403",
     .summary = "a script's word that is no answer of its leaf",
     .description =
         "An action answers success, failure or running; a Condition success "
         "or failure; a measurement one of the variable's values.",
     .help = "Take an answer that the message names.",
     .example = {.tree = kOneAction, .script = "a: succes"}},
    {.code = "BT1404",
     .summary = "a line of a script that is not understood",
     .description = "A line is a name, a colon and results, such as `land: "
                    "running running success`.",
     .help = "See docs/simulate.md.",
     .example = {.tree = kOneAction, .script = "a success"}},
    {.code = "BT1405",
     .summary = "a script asks for what cannot happen",
     .description = "At this point of the run the leaf cannot give the answer: "
                    "its contract, its duration or `:transitions` excludes it.",
     .help = "Change the script, or the contract of the leaf.",
     .example = {.tree =
                     "(BehaviorTree :name t (Action :ID a :duration [2,3]))",
                 .script = "a: success"}},
    {.code = "BT1501",
     .summary = "neither a folder nor a tree nor a manifest",
     .description = "`btcheck batch` takes folders, in which it looks for "
                    "trees and rules, trees by themselves, and manifests: "
                    "files that end in .toml and say what is to be checked.",
     .help = "Name the tree, or its folder.",
     .example = {.other_name = "trees.txt",
                 .other = "patrol.btf",
                 .command = "batch trees.txt"}},
    {.code = "BT1502",
     .summary = "a manifest or a btcheck.toml that is not TOML",
     .description = "It is a TOML 1.0 file; at this place it cannot be read as "
                    "one.",
     .help = "Compare with the examples in docs/batch.md and "
             "docs/findings.md.",
     .example = {.other_name = "batch.toml",
                 .other = R"([[entry)",
                 .command = "batch batch.toml"}},
    {.code = "BT1503",
     .summary = "a key that a manifest or a btcheck.toml does not have",
     .description = "The key means nothing here; most often it is misspelt.",
     .help = "Write one of the keys of docs/batch.md, or of docs/findings.md "
             "in a btcheck.toml.",
     .example = manifest_example("[[entry]]\ntree = \"tree.btf\"\ncolour = 1",
                                 kOneAction)},
    {.code = "BT1504",
     .summary = "a value of the wrong kind, or a word that is not known",
     .description = "The key is known, but takes another kind of value or one "
                    "of a few words.",
     .help = "Write what the message lists.",
     .example = manifest_example("[[entry]]\ntree = 3")},
    {.code = "BT1505",
     .summary = "an entry without a tree, or keys that do not go together",
     .description = "An entry needs a tree, a property file that names one, or "
                    "a folder; a folder goes with no single tree.",
     .help = "Add `tree = \"…\"`, or split the entry in two.",
     .example = manifest_example("[[entry]]\nname = \"nothing\"")},
    {.code = "BT1506",
     .summary = "a verdict is expected of a property that does not exist",
     .description =
         "`expect` names a property that none of the entry's files has.",
     .help = "Write the name as it stands after `property`.",
     .example = {.tree = kOneAction,
                 .rules = "property ends: possible root.ended",
                 .other_name = "batch.toml",
                 .other = "[[entry]]\ntree = \"tree.btf\"\nproperties = "
                          "\"rules.ltl\"\nexpect = { end = \"holds\" }",
                 .command = "batch batch.toml"}},
    {.code = "BT1507",
     .summary = "nothing to check",
     .description =
         "There is no tree in the folder, or no entry in the manifest.",
     .help = "Trees end in .btf, rules in .ltl or .btp.",
     .example = {.other_name = "notes.txt",
                 .other = "nothing yet",
                 .command = "batch ."}},
    {.code = "BT1508",
     .summary = "kept results are damaged",
     .description = "The file in which --resume keeps results, or the folder "
                    "of --results, holds some that are not whole, as after a "
                    "power failure, or that are not sealed with "
                    "BTCHECK_RESULTS_KEY. Those entries are checked again; the "
                    "others are taken.",
     .help = "Nothing: they are made anew.",
     .severity = Severity::Warning,
     .example = {.tree = kOneAction,
                 .command =
                     "batch tree.btf --results kept -q\n$ truncate -s -1 "
                     "kept/*.result\nbatch tree.btf --results kept -q"}},
    {.code = "BT1509",
     .summary = "results cannot be kept",
     .description = "The file beside the manifest in which --resume keeps "
                    "results, or one in the folder of --results, cannot be "
                    "written. Everything is checked.",
     .help = "Give write access to the folder, and space, or leave out the "
             "option.",
     .severity = Severity::Warning,
     .example =
         {.tree = kOneAction,
          .command =
              "$ (ulimit -f 0; btcheck batch tree.btf --results kept -q)"}},
    {.code = "BT1510",
     .summary = "a level for what has none",
     .description =
         "Levels are for what is found in a tree (BT22xx, BT23xx, BT25xx) and "
         "what its "
         "readers warn of. An error of reading leaves nothing to check, and "
         "the verdict of a rule is what it is: neither has a level.",
     .help = "Write a code that `btcheck explain` lists, or `warnings`.",
     .example = {.tree = kOneAction,
                 .other_name = "btcheck.toml",
                 .other = "deny = [\"warning\"]",
                 .command = "tree.btf"}},
    {.code = "BT1511",
     .summary = "a file that is no baseline",
     .description = "`--baseline` reads what `--write-baseline` has written: "
                    "JSON with the codes, files and lines of findings.",
     .help = "Write it again: --write-baseline FILE.",
     .example = {.tree = kOneAction,
                 .other_name = "baseline.json",
                 .other = "{}",
                 .command = "tree.btf --baseline baseline.json"}},
    {.code = "BT1512",
     .summary = "findings of the baseline that occur no more",
     .description = "They have been repaired, or their lines have changed. The "
                    "baseline would hide them if they came back.",
     .help = "Write it again: --baseline FILE --write-baseline FILE.",
     .severity = Severity::Note,
     .example = {.tree = kOneAction,
                 .other_name = "known.json",
                 .other = R"*({"schema": "btcheck-baseline/1", "findings": [
  {"code": "BT2301", "file": "tree.btf", "node": "b",
   "text": "(Action :ID b)", "count": 1}]})*",
                 .command = "tree.btf --baseline known.json"}},
    {.code = "BT1513",
     .summary = "entries of which there is no result",
     .description = "`--join` makes a report of what is in a folder of "
                    "results, and these entries have none: nobody has checked "
                    "them yet, not with these inputs and options, or not with "
                    "this build of btcheck. With `--no-wait` they are those "
                    "that others are still checking. They are NOT RUN.",
     .help = "Run the batch with --results; it checks what is left.",
     .severity = Severity::Warning,
     .example = {.tree = kOneAction, .command = "batch tree.btf --join ."}},
    {.code = "BT1514",
     .summary = "files that cannot be watched",
     .description =
         "`--watch` asks the kernel to tell of each folder in which there is "
         "something to check. A user has so many of these watches, "
         "fs.inotify.max_user_watches, and editors take some; or the folder "
         "may not be read. The others are watched, and with each change that "
         "is seen everything is looked at.",
     .help = "Watch fewer folders, exclude some in btcheck.toml, or ask for "
             "more: sysctl fs.inotify.max_user_watches=524288.",
     .severity = Severity::Warning},
    {.code = "BT1515",
     .summary = "a file that is no result of `whatif`",
     .description =
         "`btcheck whatif --against` reads what `--format json` has written "
         "of the same mission. Results that were made of other faults, by "
         "`--late`, or beside other leaves, by `--others`, cannot be compared.",
     .help = "Write it again: btcheck whatif TREE --format json=FILE.",
     .example = {.tree = kOneAction,
                 .other_name = "faults.json",
                 .other = "{}",
                 .command = "whatif tree.btf --against faults.json"}},
    {.code = "BT1701",
     .summary = "a tree that is not run",
     .description = "`btcheck run` executes trees in .btf. A tree for "
                    "BehaviorTree.CPP has an executor: the program that loads "
                    "it.",
     .help = "Run it there; `btcheck trace` reads the logs that it writes.",
     .example = {.body = "<AlwaysSuccess/>",
                 .command = "run tree.xml --seed 1"}},
    {.code = "BT1702",
     .summary = "rules of another time than that of a run",
     .description =
         "A run ticks the root once in --tick-ms, and nothing in between takes "
         "time. The rules that name the tree say where time passes, and say "
         "something else.",
     .help = "Name the tree, and check it with `tick root` as well.",
     .example = {.tree = kOneAction,
                 .rules = "tree \"tree.btf\"\ntick nodes\n"
                          "property p: possible root.success",
                 .command = "run rules.ltl --seed 1"}},
    {.code = "BT1703",
     .summary = "a leaf has answered what the model does not allow",
     .description =
         "What was proven holds of leaves that keep their contracts: answers "
         "that their type and :returns have, within their :duration, values "
         "within their ranges and :transitions, once for each question and in "
         "time. A leaf that does not is told, and --on-breach says what "
         "follows. The run stays one of the model.",
     .help = "Mend the leaf; or widen its contract, and check the tree again.",
     .example = {.tree =
                     "(BehaviorTree :name t (Action :ID a :duration [2,3]))",
                 .script = "a: success",
                 .command = "run tree.btf --script script.txt --no-wait"}},
    {.code = "BT1704",
     .summary = "the process of the leaves is not there",
     .description =
         "The command of --leaves-exec cannot be started, has ended before it "
         "was ready, or did not say so within ten seconds.",
     .help = "Answer the first line with {\"id\": 0, \"answer\": "
             "\"ready\"}; docs/run.md has the messages.",
     .example = {.tree = kOneAction,
                 .command = "run tree.btf --leaves-exec true"}},
    {.code = "BT1705",
     .summary = "a run cannot be shown on that port",
     .description =
         "--view=PORT listens on that port of 127.0.0.1. Another program has "
         "it, or the system keeps it to itself, as it does with those below "
         "1024. Nothing has been run.",
     .help = "Write --view alone, which takes a port that is free; or end the "
             "program that has the port.",
     .example = {.tree = kOneAction,
                 .command = "run tree.btf --seed 1 --view=1"}},
    {.code = "BT1706",
     .summary = "the run has just broken a rule",
     .description =
         "A rule of --prop is violated, whatever comes then. The run goes on, "
         "and the command ends with exit code 1. A rule that the file expects "
         "to be violated is told as a note.",
     .help = "Check the tree with the rule: the shortest run that breaks it is "
             "shown.",
     .example = {
         .tree = kOneAction,
         .rules = "property p: never a.success",
         .script = "a: success",
         .command = "run tree.btf --prop rules.ltl --script script.txt"}}};

}  // namespace

std::span<const CodeRow> command_codes() { return kCommandCodes; }

}  // namespace btcheck
