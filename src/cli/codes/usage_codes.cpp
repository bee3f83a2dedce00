// SPDX-License-Identifier: MIT
//
// What is wrong with a command line, with files, and with memory.
#include "cli/codes/codes.hpp"

#include <array>

namespace btcheck {
namespace {

constexpr std::array kCodes = {
    CodeRow{
        .code = "BT0001",
        .summary = "a wrong command line",
        .description =
            "The words after `btcheck` cannot be understood: an unknown "
            "option, one of another command, a value it does not take. "
            "Nothing was read.",
        .help = "`btcheck COMMAND --help` lists what a command takes.",
        .example = {.tree = R"((BehaviorTree :name t (Action :ID a)))",
                    .command = "tree.btf --tick leaf"},
    },
    CodeRow{
        .code = "BT0002",
        .summary = "an input file cannot be read",
        .description =
            "There is no such file, it is a directory, it may not be "
            "read, or it is larger than 64 MiB.",
        .help = "Look at the name: it is relative to the directory you "
                "are in.",
        .example = {.command = "nowhere.btf"},
    },
    CodeRow{
        .code = "BT0003",
        .summary = "a property file that names no tree was given alone",
        .description =
            "A property file can stand alone on the command line only if "
            "it says which tree it is about.",
        .help = "Write `tree \"FILE.btf\"` as its first line, or name "
                "both files: btcheck TREE.btf --prop RULES.ltl.",
        .example = {.rules = R"(property p: never dead)",
                    .command = "rules.ltl"},
    },
    CodeRow{
        .code = "BT0004",
        .summary = "an output cannot be written",
        .description =
            "The file or directory for a report, a run or a graph cannot "
            "be written to. This is found out before anything is checked,"
            " so no result is lost.",
        .help = "Make the directory, or choose another place.",
        .example = {.tree = R"((BehaviorTree :name t (Action :ID a)))",
                    .command = "tree.btf --format json=nowhere/report.json"},
    },
    CodeRow{
        .code = "BT0005",
        .summary = "a tree that cannot be exported",
        .description =
            "A value in a guard or an assignment may leave the 32 bits "
            "that numbers have in the other language. There it would wrap"
            " around, here it does not, so the model would be another "
            "one.",
        .help = "Give the variables smaller ranges.",
        .example = {.tree = R"((defsv x :min 0 :max 50000)
(BehaviorTree :name t (Eval (< (* x x) 100))))",
                    .command = "export tree.btf --to promela"},
    },
    CodeRow{
        .code = "BT0006",
        .summary = "a property that is not exported",
        .description =
            "The other language cannot say this property, or not in a way"
            " that surely means the same. The model is written without "
            "it, and a comment in it says so.",
        .help = "Check the property with btcheck.",
        .example = {.tree = R"((BehaviorTree :name t (Action :ID a)))",
                    .rules = R"(property p: AG (EF a.success))",
                    .command = "export tree.btf --to promela --prop rules.ltl"},
    },
    CodeRow{
        .code = "BT0007",
        .summary = "a state space too large for a graph",
        .description =
            "`space --export` writes every state and step, and stops "
            "where no other tool would read the result any more.",
        .help = "Measure it without --export, or draw a part of the tree.",
        .example = {.tree = R"((defsv x :max 100000)
(BehaviorTree :name t :loop 1
  (Eval (:= x (mod (+ x 1) 100000)))))",
                    .command = "space tree.btf --export dot"},
    },
    CodeRow{
        .code = "BT0008",
        .summary = "a property that Fiacre's compiler does not read",
        .description =
            "Fiacre has this real-time pattern, but its compiler frac 2.3.0"
            " knows no `first` and no interval without an end. The model is"
            " written without the property, and a comment in it says so.",
        .help = "Check the property with btcheck, or ask for less: an answer"
                " from the start on, or one until some time.",
        .example = {.tree = R"((BehaviorTree :name t (Action :ID a)))",
                    .rules = R"(property p:
    a.ticked leadsto first a.success within [1,2])",
                    .command = "export tree.btf --to fiacre --prop rules.ltl"},
    },
    CodeRow{
        .code = "BT9001",
        .summary = "memory ran out",
        .description =
            "The system refused more memory before btcheck's own limit "
            "was reached. There is no verdict.",
        .help = "Set a limit that is kept, for instance --memory 4G: then"
                " what has been searched is told.",
    }};

}  // namespace

std::span<const CodeRow> usage_codes() { return kCodes; }

}  // namespace btcheck
