// SPDX-License-Identifier: MIT
//
// A line `SEAL KEY TREE`: a hash of what follows it, the content hash of an
// entry, and its results.
//
// Without a secret the seal is a checksum: it finds damage, not forgery. Who
// can write the line can then say what the results are.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace btcheck {

// 32 hexadecimal digits, the same on every machine (XXH3, 128 bits).
std::string content_hash(std::string_view text);

// "robot-ci"
std::string host_name();

// A line that says who writes results and where, for people:
// # btcheck 0.1.0 (build 3f…) on robot-ci in /home/me/missions, process 4711
std::string heading();
// The build that a heading names; "" for another text.
std::string build_in(std::string_view heading);

struct SealedLine {
  std::string_view key;
  std::string_view tree;
};

class Seal {
 public:
  explicit Seal(std::string secret) : secret_(std::move(secret)) {}

  // With its end.
  std::string line(std::string_view key, std::string_view tree) const;
  // Nothing for a line, without its end, that was not written so.
  std::optional<SealedLine> opened(std::string_view line) const;

 private:
  std::string of(std::string_view text) const;

  std::string secret_;
};

}  // namespace btcheck
