// SPDX-License-Identifier: MIT
//
// Who checks what, among processes on any number of machines that share a
// folder and nothing else.
//
// A process that wants to check an entry makes the file KEY.1.lease with the
// name of its owner in it: itself. O_EXCL gives the file to one of those who
// try. It is taken away when the result is there. The owner shows that it lives
// by its sign, OWNER.alive: a file in which it counts on, now and then.
//
// Where the owner is gone, whoever needs the entry makes KEY.2.lease, then
// KEY.3.lease: again one of all who try gets it, and nobody takes away what
// somebody else has made. The last lease is the one that counts.
//
// An owner is gone when its sign is not there any more; on the same machine,
// when its process is not; and anywhere, when lease and sign have not changed
// for so long as `patience` says, *by the clock of the one who looks*, since it
// looked first. No time that another machine has written is compared with one
// of ours, so clocks may be wrong by any amount.
//
// This may err. An owner that was suspended, or whose network was gone, wakes
// up and goes on, while another one checks the same entry; a share may show one
// machine late what another one has done. Then an entry is checked twice, both
// find the same, and the second writes what is there already: the worst is
// double work, never a wrong report. So nothing here has to be certain, and
// nobody ever waits for a lock.
#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "batch/results/kept_results.hpp"
#include "cli/inputs/files.hpp"

namespace btcheck {

class Leases {
 public:
  using Holder = KeptResults::Holder;

  Leases(std::string folder, double patience_seconds)
      : folder_(std::move(folder)), patience_(patience_seconds) {}
  // Takes the sign of this process away.
  ~Leases();
  Leases(const Leases&) = delete;
  Leases& operator=(const Leases&) = delete;

  // Makes the sign of this process, without which it cannot hold anything.
  // Returns what went wrong, or "".
  std::string begin();
  // Counts on, where it is time to.
  void keep_alive();

  // True where the entry is ours now, or where the folder takes no leases:
  // everybody works for himself then.
  bool claim(const std::string& key);
  // Of what is ours.
  void release(const std::string& key);
  // Of what is done, whoever did it.
  void clear(const std::string& key) const;

  // Who holds the entry, as far as can be seen.
  Holder holder_of(const std::string& key);
  // "robot-ci, process 4711"; "" where nobody holds it.
  std::string holder_name(const std::string& key) const;

 private:
  using Clock = std::chrono::steady_clock;

  struct Seen {
    std::string text;
    Clock::time_point since;
    bool has_changed = false;
  };

  std::string lease_name(const std::string& key, int number) const;
  std::string sign_name(const std::string& owner) const;
  // The number of the lease that counts; 0 where there is none.
  int last_lease(const std::string& key) const;
  Holder holder_by(const std::string& lease);
  // By when that has changed last.
  Holder holder_by_age(const std::string& lease, std::string text);

  std::string folder_;
  double patience_;
  std::string name_;   // of this process as an owner; "" before it has begun
  std::string place_;  // where its number is that of a process
  std::unique_ptr<OpenFile> sign_;
  std::string said_;  // in the sign, before the count
  std::uint64_t count_ = 0;
  Clock::time_point last_count_;
  std::map<std::string, Seen> seen_;  // by the name of the lease
};

}  // namespace btcheck
