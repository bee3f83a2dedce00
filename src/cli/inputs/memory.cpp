// SPDX-License-Identifier: MIT
#include "cli/inputs/memory.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <fstream>
#include <string>

#include "text/numbers.hpp"

namespace btcheck {
namespace {

std::uint64_t machine_bytes() {
  return static_cast<std::uint64_t>(::sysconf(_SC_PHYS_PAGES)) *
         static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
}

class Least {
 public:
  explicit Least(AvailableMemory memory) : memory_(memory) {}

  void offer(std::uint64_t bytes, std::string_view whose) {
    if (bytes < memory_.bytes) memory_ = {bytes, whose};
  }

  // The limit that stands in a file; none for "max", or where there is no file.
  void offer_file(const std::string& path) {
    std::ifstream file(path);
    std::string word;
    if (!(file >> word)) return;
    if (const auto bytes = as_number<std::uint64_t>(word)) {
      offer(*bytes, "the cgroup");
    }
  }

  // Of a group and all around it. Within a container the path may be that of
  // the host; then only the mounted root exists.
  void offer_groups(const std::string& mount, std::string group,
                    const std::string& file) {
    while (true) {
      offer_file(mount + group + "/" + file);
      if (group.empty()) return;
      group.resize(group.rfind('/'));
    }
  }

  AvailableMemory memory() const { return memory_; }

 private:
  AvailableMemory memory_;
};

// A line of /proc/self/cgroup: "4:cpu,memory:/a/b", or "0::/a/b" in version 2.
void offer_line(Least& least, const std::string& mount,
                const std::string& line) {
  const std::size_t first = line.find(':');
  const std::size_t second = line.find(':', first + 1);
  if (first == line.npos || second == line.npos) return;
  const std::string controllers =
      "," + line.substr(first + 1, second - first - 1) + ",";
  std::string group = line.substr(second + 1);
  if (group.empty() || group.front() != '/') return;
  if (group == "/") group.clear();
  if (controllers == ",,") {
    least.offer_groups(mount, group, "memory.max");
    least.offer_groups(mount + "/unified", group, "memory.max");
  } else if (controllers.find(",memory,") != controllers.npos) {
    least.offer_groups(mount + "/memory", group, "memory.limit_in_bytes");
  }
}

}  // namespace

AvailableMemory available_memory(std::string_view root) {
  Least least({machine_bytes(), "the machine"});
  rlimit limit{};
  if (::getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY) {
    least.offer(limit.rlim_cur, "ulimit -v");
  }
  const std::string before(root);
  std::ifstream groups(before + "/proc/self/cgroup");
  for (std::string line; std::getline(groups, line);) {
    offer_line(least, before + "/sys/fs/cgroup", line);
  }
  return least.memory();
}

}  // namespace btcheck
