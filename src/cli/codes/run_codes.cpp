// SPDX-License-Identifier: MIT
//
// What is wrong with runs, logs and scripts.
#include "cli/codes/codes.hpp"

#include <array>

namespace btcheck {
namespace {

constexpr std::array kCodes = {
    CodeRow{
        .code = "BT1301",
        .summary = "a file that is no run in ITF JSON, or a damaged one",
        .description =
            "`btcheck trace` reads what --trace-dir writes: ITF JSON with"
            " the tree and its nodes in `#meta`. Other programs' ITF has "
            "no nodes.",
        .help = "Let btcheck write the run again.",
        .example = {.other_name = "run.itf.json",
                    .other = R"({})",
                    .command = "trace run.itf.json --to text"},
    },
    CodeRow{
        .code = "BT1302",
        .summary = "a file that is no log of BehaviorTree.CPP 4",
        .description =
            "The file does not begin as FileLogger2 writes it, or is of a"
            " version that is not known.",
        .help = "Look whether the file is the one that FileLogger2 wrote "
                "(.btlog), or FileLogger (.fbl).",
        .example = {.other_name = "robot.btlog",
                    .other = R"(not a log)",
                    .command = "trace robot.btlog --to text"},
    },
    CodeRow{
        .code = "BT1303",
        .summary = "a damaged log",
        .description =
            "The log breaks off in its heading, or a record names a node "
            "that the log's tree does not have.",
        .help = "Record it again, and let the executor end before you "
                "copy the file.",
    },
    CodeRow{
        .code = "BT1304",
        .summary = "a log whose last record is cut off",
        .description =
            "The program that wrote it was probably killed while it was "
            "writing. All records before the last one are told.",
        .help = "Nothing, unless the end matters.",
    },
    CodeRow{
        .code = "BT1305",
        .summary = "a tick that the run does not have",
        .description = "`--at` asks for a tick after the run's last one.",
        .help = "The help of the message says which tick is the last.",
        .example = {.tree = R"((BehaviorTree :name t (Action :ID a)))",
                    .rules = R"(property p expect violated: never a.failure)",
                    .command = "tree.btf --prop rules.ltl --trace-dir runs\n"
                               "trace runs/tree.p.itf.json --to svg --at 9"},
    },
    CodeRow{
        .code = "BT1306",
        .summary = "a log that can only be printed",
        .description =
            "A log of BehaviorTree.CPP has the changes of statuses and "
            "neither variables nor the automata, so it cannot become a "
            "picture or another format.",
        .help = "Write --to text.",
        .example = {.tree = R"((BehaviorTree :name t (Action :ID a)))",
                    .rules = R"(property p expect violated: never a.failure)",
                    .command =
                        "tree.btf --prop rules.ltl --trace-dir runs\n"
                        "trace runs/tree.p.itf.json --to btlog -o robot.btlog\n"
                        "trace robot.btlog --to svg"},
    },
    CodeRow{
        .code = "BT1401",
        .summary = "a script names a leaf that does not exist",
        .description =
            "Before the colon stands the name of a leaf or of a variable "
            "that moves on its own.",
        .help = "Take the name that is suggested.",
        .example = {.tree = R"((BehaviorTree :name t (Action :ID a)))",
                    .script = R"(b: success)",
                    .command = "simulate tree.btf --script script.txt"},
    },
    CodeRow{
        .code = "BT1402",
        .summary = "a script names something that cannot be scripted",
        .description =
            "Only what the world decides can be told by a script: the "
            "answers of actions and conditions, what SetSV measures, and "
            "variables that move on their own.",
        .help = "Script the leaves below the node.",
        .example = {.tree = R"((defsv fls :max 3)
(BehaviorTree :name t
  (Sequence :name s
    (Eval (< fls 3))
    (Action :ID a))))",
                    .script = R"(s: success)",
                    .command = "simulate tree.btf --script script.txt"},
    },
    CodeRow{
        .code = "BT1403",
        .summary = "a script's word that is no answer of its leaf",
        .description =
            "An action answers success, failure or running; a Condition "
            "success or failure; a measurement one of the variable's "
            "values.",
        .help = "Take an answer that the message names.",
        .example = {.tree = R"((BehaviorTree :name t (Action :ID a)))",
                    .script = R"(a: succes)",
                    .command = "simulate tree.btf --script script.txt"},
    },
    CodeRow{
        .code = "BT1404",
        .summary = "a line of a script that is not understood",
        .description = "A line is a name, a colon and results, such as `land: "
                       "running running success`.",
        .help = "See docs/simulate.md.",
        .example = {.tree = R"((BehaviorTree :name t (Action :ID a)))",
                    .script = R"(a success)",
                    .command = "simulate tree.btf --script script.txt"},
    },
    CodeRow{
        .code = "BT1405",
        .summary = "a script asks for what cannot happen",
        .description =
            "At this point of the run the leaf cannot give the answer: "
            "its contract, its duration or `:transitions` excludes it.",
        .help = "Change the script, or the contract of the leaf.",
        .example =
            {.tree = R"((BehaviorTree :name t (Action :ID a :duration [2,3])))",
             .script = R"(a: success)",
             .command = "simulate tree.btf --script script.txt"},
    }};

}  // namespace

std::span<const CodeRow> run_codes() { return kCodes; }

}  // namespace btcheck
