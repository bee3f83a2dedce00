// SPDX-License-Identifier: MIT
//
// What goes wrong where a robot is watched while it runs.
#include "report/codes/codes.hpp"

namespace btcheck {
namespace {

constexpr CodeRow kRobotCodes[] = {
    {.code = "BT1901",
     .summary = "nobody answers at the address of a robot",
     .description =
         "`btcheck watch` waits for a program with a Groot2Publisher, and goes "
         "on looking for it. With --timeout it gives up in the end.",
     .help = "Start the program, and look at the address: the port is the one "
             "that its Groot2Publisher was given, 1667 where it was given "
             "none.",
     .example = {.command = "watch groot2://127.0.0.1:9 --timeout 0.2"}},
    {.code = "BT1902",
     .summary = "what listens at the address is no publisher of Groot2",
     .description =
         "Somebody accepts the connection and does not answer, or answers in "
         "another way than the Groot2Publisher of BehaviorTree.CPP 4 does. Its "
         "replies begin with the request that they are to.",
     .help = "Name the port of the publisher, not the one after it, and not "
             "that of a publisher of BehaviorTree.CPP 3."},
    {.code = "BT1903",
     .summary = "what a robot says of itself does not fit together",
     .description =
         "The tree that the publisher sends cannot be read, or what it says of "
         "nodes, changes of status and blackboards is damaged, or about nodes "
         "that the tree does not have. Nothing more is believed.",
     .help = "Report it to the owners of the program: the publisher of "
             "BehaviorTree.CPP 4.10 sends none of this."},
    {.code = "BT1904",
     .summary = "a recording of a robot has come to its end",
     .description =
         "The program was started anew, or changes of status were lost: a "
         "publisher keeps the last thousand, for one who asks. What comes "
         "later is another recording, in another file, and rules begin anew: "
         "whatever was open stays so.",
     .help = "Close Groot2 while btcheck watches: one takes changes away from "
             "the other.",
     .severity = Severity::Warning},
    {.code = "BT1905",
     .summary = "changes of a robot are lost again and again",
     .description =
         "Several recordings in a row ended within seconds. Either another "
         "program asks for changes of status as well, or a single tick of the "
         "tree makes more than the thousand that a publisher keeps.",
     .help = "Close Groot2; or attach btcheck::observer to the tree, or the "
             "engine's FileLogger2, which lose nothing."},
    {.code = "BT1906",
     .summary = "a fault names no node of the robot's tree, or several",
     .description =
         "--inject and --break name nodes as rules do: by the name, the end of "
         "the path, or the number in the tree.",
     .help = "Write a name of the tree that the message proposes."},
    {.code = "BT1907",
     .summary = "two faults name the same node",
     .description =
         "A publisher keeps one hook for each node: the second one would take "
         "the place of the first.",
     .help = "Leave out one of them."},
    {.code = "BT1908",
     .summary = "what was injected could not be taken back",
     .description =
         "At its end `btcheck watch` removes its hooks. The robot does not "
         "answer any more. A publisher disables all hooks five seconds after "
         "the last request, and enables them when somebody asks it again.",
     .help = "Start the program anew before Groot2 or btcheck connects to it.",
     .severity = Severity::Warning}};

}  // namespace

std::span<const CodeRow> robot_codes() { return kRobotCodes; }

}  // namespace btcheck
