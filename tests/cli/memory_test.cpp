// SPDX-License-Identifier: MIT
#include "cli/inputs/memory.hpp"

#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "temporary_folder.hpp"

namespace btcheck::memory_test {
namespace {

class Machine {
 public:
  void put(const std::string& path, const std::string& text) {
    const std::filesystem::path file = folder_.path() / path;
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file) << text;
  }
  AvailableMemory memory() const {
    return available_memory(folder_.path().string());
  }

 private:
  TemporaryFolder folder_;
};

TEST_CASE("without groups the machine's memory is what there is") {
  Machine machine;
  const std::uint64_t all = machine.memory().bytes;
  CHECK(all > 1'000'000);
  machine.put("proc/self/cgroup", "no line of a group\n0::\n");
  CHECK(machine.memory().bytes == all);
}

TEST_CASE("cgroups of version 2: the least of a group and those around it") {
  Machine machine;
  machine.put("proc/self/cgroup", "0::/ci/job\n");
  machine.put("sys/fs/cgroup/ci/job/memory.max", "max\n");
  CHECK(machine.memory().whose == "the machine");
  machine.put("sys/fs/cgroup/ci/memory.max", "200000000\n");
  CHECK(machine.memory().bytes == 200'000'000);
  CHECK(machine.memory().whose == "the cgroup");
  machine.put("sys/fs/cgroup/ci/job/memory.max", "100000000\n");
  CHECK(machine.memory().bytes == 100'000'000);
}

TEST_CASE("cgroups of version 2 in a container have the limit at their root") {
  Machine machine;
  machine.put("proc/self/cgroup", "0::/\n");
  machine.put("sys/fs/cgroup/memory.max", "100000000\n");
  CHECK(machine.memory().bytes == 100'000'000);
}

TEST_CASE("cgroups of version 1, also where the path is the host's") {
  Machine machine;
  machine.put("proc/self/cgroup",
              "5:devices:/\n4:cpu,memory:/docker/ab12\n0::/\n");
  machine.put("sys/fs/cgroup/memory/memory.limit_in_bytes",
              "9223372036854771712\n");
  CHECK(machine.memory().whose == "the machine");
  machine.put("sys/fs/cgroup/memory/memory.limit_in_bytes", "150000000\n");
  CHECK(machine.memory().bytes == 150'000'000);
  machine.put("sys/fs/cgroup/memory/docker/ab12/memory.limit_in_bytes",
              "100000000\n");
  CHECK(machine.memory().bytes == 100'000'000);
}

}  // namespace
}  // namespace btcheck::memory_test
