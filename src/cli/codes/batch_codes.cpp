// SPDX-License-Identifier: MIT
//
// What is wrong with batches and their manifests.
#include "cli/codes/codes.hpp"

#include <array>

namespace btcheck {
namespace {

constexpr std::string_view kTree = R"((BehaviorTree :name t (Action :ID a)))";

constexpr std::array kCodes = {
    CodeRow{
        .code = "BT1501",
        .summary = "neither a folder nor a manifest",
        .description = "`btcheck batch` takes folders, in which it looks for "
                       "trees and rules, and manifests: files that end in "
                       ".toml and say what is to be checked.",
        .help = "Name the folder of the tree.",
        .example = {.tree = kTree, .command = "batch tree.btf"},
    },
    CodeRow{
        .code = "BT1502",
        .summary = "the manifest is not TOML",
        .description = "A manifest is a TOML 1.0 file; at this place it "
                       "cannot be read as one.",
        .help = "Compare with the example in docs/batch.md.",
        .example = {.other_name = "batch.toml",
                    .other = R"([[entry)",
                    .command = "batch batch.toml"},
    },
    CodeRow{
        .code = "BT1503",
        .summary = "a key that manifests do not have",
        .description = "The key means nothing here; most often it is misspelt.",
        .help = "Write one of the keys of docs/batch.md.",
        .example = {.tree = kTree,
                    .other_name = "batch.toml",
                    .other = "[[entry]]\ntree = \"tree.btf\"\ncolour = 1",
                    .command = "batch batch.toml"},
    },
    CodeRow{
        .code = "BT1504",
        .summary = "a value of the wrong kind, or a word that is not known",
        .description = "The key is known, but takes another kind of value or "
                       "one of a few words.",
        .help = "Write what the message lists.",
        .example = {.other_name = "batch.toml",
                    .other = "[[entry]]\ntree = 3",
                    .command = "batch batch.toml"},
    },
    CodeRow{
        .code = "BT1505",
        .summary = "an entry without a tree, or keys that do not go together",
        .description = "An entry needs a tree, a property file that names one, "
                       "or a folder; a folder goes with no single tree.",
        .help = "Add `tree = \"…\"`, or split the entry in two.",
        .example = {.other_name = "batch.toml",
                    .other = "[[entry]]\nname = \"nothing\"",
                    .command = "batch batch.toml"},
    },
    CodeRow{
        .code = "BT1506",
        .summary = "a verdict is expected of a property that does not exist",
        .description = "`expect` names a property that none of the entry's "
                       "files has.",
        .help = "Write the name as it stands after `property`.",
        .example = {.tree = kTree,
                    .rules = "property ends: possible root.ended",
                    .other_name = "batch.toml",
                    .other = "[[entry]]\ntree = \"tree.btf\"\nproperties = "
                             "\"rules.ltl\"\nexpect = { end = \"holds\" }",
                    .command = "batch batch.toml"},
    },
    CodeRow{
        .code = "BT1507",
        .summary = "nothing to check",
        .description = "There is no tree in the folder, or no entry in the "
                       "manifest.",
        .help = "Trees end in .btf, rules in .ltl or .btp.",
        .example = {.other_name = "notes.txt",
                    .other = "nothing yet",
                    .command = "batch ."},
    },
    CodeRow{
        .code = "BT1508",
        .summary = "kept results are damaged",
        .description = "The file in which --resume keeps results holds lines "
                       "that are not whole, as after a power failure. Those "
                       "entries are checked again; the others are taken.",
        .help = "Nothing: the file is made anew.",
        .severity = Severity::Warning,
    },
    CodeRow{
        .code = "BT1509",
        .summary = "results cannot be kept",
        .description = "The file beside the manifest in which --resume keeps "
                       "results cannot be written. Everything is checked.",
        .help = "Give write access to the folder, or leave out --resume.",
        .severity = Severity::Warning,
    }};

}  // namespace

std::span<const CodeRow> batch_codes() { return kCodes; }

}  // namespace btcheck
