// SPDX-License-Identifier: MIT
//
// What `WriteTreeToXML(tree, true, true)` of BehaviorTree.CPP 4.10.0 (MIT
// licence) writes for a tree with no node types but its own. Ports stand in
// BehaviorTree.CPP in a hash table, so their order means nothing.
#include "trace/logs/btcpp_models.hpp"

#include <cstddef>

namespace btcheck {
namespace {

constexpr LoggedModel kModels[] = {
    {LoggedKind::Action, "AlwaysFailure"},
    {LoggedKind::Action, "AlwaysSuccess"},
    {LoggedKind::Control, "AsyncFallback"},
    {LoggedKind::Control, "AsyncSequence"},
    {LoggedKind::Decorator, "Delay"},
    {LoggedKind::Control, "Fallback"},
    {LoggedKind::Decorator, "ForceFailure"},
    {LoggedKind::Decorator, "ForceSuccess"},
    {LoggedKind::Control, "IfThenElse"},
    {LoggedKind::Decorator, "Inverter"},
    {LoggedKind::Decorator, "KeepRunningUntilFailure"},
    {LoggedKind::Decorator, "LoopBool"},
    {LoggedKind::Decorator, "LoopDouble"},
    {LoggedKind::Decorator, "LoopInt"},
    {LoggedKind::Decorator, "LoopString"},
    {LoggedKind::Control, "Parallel"},
    {LoggedKind::Control, "ParallelAll"},
    {LoggedKind::Decorator, "Precondition"},
    {LoggedKind::Control, "ReactiveFallback"},
    {LoggedKind::Control, "ReactiveSequence"},
    {LoggedKind::Decorator, "Repeat"},
    {LoggedKind::Decorator, "RetryUntilSuccessful"},
    {LoggedKind::Decorator, "RunOnce"},
    {LoggedKind::Action, "Script"},
    {LoggedKind::Condition, "ScriptCondition"},
    {LoggedKind::Control, "Sequence"},
    {LoggedKind::Control, "SequenceWithMemory"},
    {LoggedKind::Action, "SetBlackboard"},
    {LoggedKind::Decorator, "SkipUnlessUpdated"},
    {LoggedKind::Action, "Sleep"},
    {LoggedKind::SubTree, "SubTree"},
    {LoggedKind::Control, "Switch2"},
    {LoggedKind::Control, "Switch3"},
    {LoggedKind::Control, "Switch4"},
    {LoggedKind::Control, "Switch5"},
    {LoggedKind::Control, "Switch6"},
    {LoggedKind::Decorator, "Timeout"},
    {LoggedKind::Control, "TryCatch"},
    {LoggedKind::Action, "UnsetBlackboard"},
    {LoggedKind::Decorator, "WaitValueUpdate"},
    {LoggedKind::Action, "WasEntryUpdated"},
    {LoggedKind::Control, "WhileDoElse"}};

constexpr LoggedPort kPorts[] = {
    {"Delay", "input_port", "delay_msec", "unsigned int", "",
     "Tick the child after a few milliseconds"},
    {"LoopBool", "output_port", "value", "bool", "", ""},
    {"LoopBool", "input_port", "if_empty", "BT::NodeStatus", "SUCCESS",
     "Status to return if queue is empty: SUCCESS, FAILURE, SKIPPED"},
    {"LoopBool", "inout_port", "queue", "BT::AnyTypeAllowed", "", ""},
    {"LoopDouble", "output_port", "value", "double", "", ""},
    {"LoopDouble", "input_port", "if_empty", "BT::NodeStatus", "SUCCESS",
     "Status to return if queue is empty: SUCCESS, FAILURE, SKIPPED"},
    {"LoopDouble", "inout_port", "queue", "BT::AnyTypeAllowed", "", ""},
    {"LoopInt", "output_port", "value", "int", "", ""},
    {"LoopInt", "input_port", "if_empty", "BT::NodeStatus", "SUCCESS",
     "Status to return if queue is empty: SUCCESS, FAILURE, SKIPPED"},
    {"LoopInt", "inout_port", "queue", "BT::AnyTypeAllowed", "", ""},
    {"LoopString", "output_port", "value", "std::string", "", ""},
    {"LoopString", "input_port", "if_empty", "BT::NodeStatus", "SUCCESS",
     "Status to return if queue is empty: SUCCESS, FAILURE, SKIPPED"},
    {"LoopString", "inout_port", "queue", "BT::AnyTypeAllowed", "", ""},
    {"Parallel", "input_port", "failure_count", "int", "1",
     "number of children that need to fail to trigger a FAILURE"},
    {"Parallel", "input_port", "success_count", "int", "-1",
     "number of children that need to succeed to trigger a SUCCESS"},
    {"ParallelAll", "input_port", "max_failures", "int", "1",
     "If the number of children returning FAILURE exceeds this value, "
     "ParallelAll returns FAILURE"},
    {"Precondition", "input_port", "else", "BT::NodeStatus", "FAILURE",
     "Return status if condition is false"},
    {"Precondition", "input_port", "if", "std::string", "", ""},
    {"Repeat", "input_port", "num_cycles", "int", "",
     "Repeat a successful child up to N times. Use -1 to create an infinite "
     "loop."},
    {"RetryUntilSuccessful", "input_port", "num_attempts", "int", "",
     "Execute again a failing child up to N times. Use -1 to create an "
     "infinite loop."},
    {"RunOnce", "input_port", "then_skip", "bool", "true",
     "If true, skip after the first execution, otherwise return the same "
     "NodeStatus returned once by the child."},
    {"Script", "input_port", "code", "std::string", "",
     "Piece of code that can be parsed"},
    {"ScriptCondition", "input_port", "code", "BT::AnyTypeAllowed", "",
     "Piece of code that can be parsed. Must return false or true"},
    {"SetBlackboard", "inout_port", "output_key", "BT::AnyTypeAllowed", "",
     "Name of the blackboard entry where the value should be written"},
    {"SetBlackboard", "input_port", "value", "BT::AnyTypeAllowed", "",
     "Value to be written into the output_key"},
    {"SkipUnlessUpdated", "input_port", "entry", "BT::Any", "",
     "Entry to check"},
    {"Sleep", "input_port", "msec", "unsigned int", "", ""},
    {"SubTree", "input_port", "_autoremap", "bool", "false",
     "If true, all the ports with the same name will be remapped"},
    {"Switch2", "input_port", "case_2", "std::string", "", ""},
    {"Switch2", "input_port", "case_1", "std::string", "", ""},
    {"Switch2", "input_port", "variable", "std::string", "", ""},
    {"Switch3", "input_port", "case_3", "std::string", "", ""},
    {"Switch3", "input_port", "case_2", "std::string", "", ""},
    {"Switch3", "input_port", "case_1", "std::string", "", ""},
    {"Switch3", "input_port", "variable", "std::string", "", ""},
    {"Switch4", "input_port", "case_4", "std::string", "", ""},
    {"Switch4", "input_port", "case_3", "std::string", "", ""},
    {"Switch4", "input_port", "case_2", "std::string", "", ""},
    {"Switch4", "input_port", "case_1", "std::string", "", ""},
    {"Switch4", "input_port", "variable", "std::string", "", ""},
    {"Switch5", "input_port", "case_5", "std::string", "", ""},
    {"Switch5", "input_port", "case_4", "std::string", "", ""},
    {"Switch5", "input_port", "case_3", "std::string", "", ""},
    {"Switch5", "input_port", "case_2", "std::string", "", ""},
    {"Switch5", "input_port", "case_1", "std::string", "", ""},
    {"Switch5", "input_port", "variable", "std::string", "", ""},
    {"Switch6", "input_port", "case_5", "std::string", "", ""},
    {"Switch6", "input_port", "case_4", "std::string", "", ""},
    {"Switch6", "input_port", "case_6", "std::string", "", ""},
    {"Switch6", "input_port", "case_3", "std::string", "", ""},
    {"Switch6", "input_port", "case_2", "std::string", "", ""},
    {"Switch6", "input_port", "case_1", "std::string", "", ""},
    {"Switch6", "input_port", "variable", "std::string", "", ""},
    {"Timeout", "input_port", "msec", "unsigned int", "",
     "After a certain amount of time, halt() the child if it is still "
     "running."},
    {"TryCatch", "input_port", "catch_on_halt", "bool", "false",
     "If true, execute the catch child when the node is halted during the "
     "try-block"},
    {"UnsetBlackboard", "input_port", "key", "std::string", "",
     "Key of the entry to remove"},
    {"WaitValueUpdate", "input_port", "entry", "BT::Any", "", "Entry to check"},
    {"WasEntryUpdated", "input_port", "entry", "BT::Any", "",
     "Entry to check"}};

}  // namespace

std::string_view kind_name(LoggedKind kind) {
  constexpr std::string_view kNames[] = {"Action", "Condition", "Control",
                                         "Decorator", "SubTree"};
  return kNames[static_cast<std::size_t>(kind)];
}

std::span<const LoggedModel> btcpp_models() { return kModels; }

std::span<const LoggedPort> btcpp_ports() { return kPorts; }

}  // namespace btcheck
