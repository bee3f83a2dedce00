// SPDX-License-Identifier: MIT
//
// How much memory there is for this process: of the machine, of the container
// it runs in, of `ulimit -v`. A program that asks the machine alone is killed
// in a container, and tells nothing.
#pragma once

#include <cstdint>
#include <string_view>

namespace btcheck {

struct AvailableMemory {
  std::uint64_t bytes = 0;
  std::string_view whose;  // "the machine", "the cgroup" or "ulimit -v"
};

// `root` is where /proc and /sys are. Reads cgroups of version 1 (memory
// controller, memory.limit_in_bytes) and 2 (memory.max), as Linux's
// Documentation/admin-guide/cgroup-v1 and cgroup-v2.rst have them: the limits
// of all groups that the process is in count, the least decides.
AvailableMemory available_memory(std::string_view root = "");

}  // namespace btcheck
