// SPDX-License-Identifier: MIT
//
// A table of rules as C++, for who wants one header and no file beside it.
#pragma once

#include <string>
#include <string_view>

namespace btcheck {

// What btcheck/monitor.hpp is made of.
extern const std::string_view kMonitorCore;

// One header in C++17 without dependencies: the table, and what reads it. It
// is told of changes of status, as loggers of BehaviorTree.CPP are, and says of
// each rule what `btcheck trace LOG --prop RULES` would say of the log up to
// there. Another tree is refused when it runs. `space` is its namespace, ""
// for `btcheck_monitor` and one that names the files of rules and tree.
std::string cpp_monitor(std::string_view table, std::string_view space);

}  // namespace btcheck
