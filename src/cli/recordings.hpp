// SPDX-License-Identifier: MIT
//
// What the commands that read logs and kept runs share.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "check/check.hpp"
#include "cli/inputs/inputs.hpp"
#include "cli/options/options.hpp"
#include "trace/live/live_log.hpp"
#include "trace/logs/behavior_log.hpp"

namespace btcheck {

// What the command line says of the ticks of logs.
LogReading reading_of(const Options& options);

// The log, with the marks that lie beside it where there are such.
Result<BehaviorLog> read_whole_log(const Options& options,
                                   const std::string& name,
                                   std::string_view bytes,
                                   const Limits& limits);
// The bytes of these marks; nothing where there are none.
std::optional<Result<InputFile>> marks_beside(const std::string& name,
                                              std::string_view bytes);

// The tree that is named, else the one that the log brings along; ticked again
// after its end, with `loops`. Nothing, and shows why, where there is none or
// it cannot be read.
std::optional<Lowered> tree_of_log(const Options& options,
                                   const std::string& tree,
                                   const std::string& name,
                                   const BehaviorLog& log, bool loops);

// The rules of --prop and -e, to be asked of a log that grows; nothing, and
// shows why, where they cannot be read.
std::optional<std::vector<LiveRules>> live_rules(const Options& options,
                                                 const std::string& file);

// Asks the rules of --prop of a log or an ITF file: Missed where one is broken
// and was not expected to be.
ExitCode watch_recorded(const Options& options, const InputFile& file);

}  // namespace btcheck
