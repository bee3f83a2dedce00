// SPDX-License-Identifier: MIT
//
// Messages on two descriptors, as the Language Server Protocol has them, behind
// a `Content-Length`, or as the Model Context Protocol does, one on a line.
#pragma once

#include <cstddef>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "cli/inputs/files.hpp"

namespace btcheck {

enum class Framing : unsigned char { Headers, Lines };

class Wire {
 public:
  // A message may be as large as the largest file of a tree, written as JSON.
  static constexpr std::size_t kMostBytes = std::size_t{128} << 20;

  // The descriptors must outlive it.
  Wire(const OpenFile& in, const OpenFile& out, Framing framing)
      : in_(in), out_(out), framing_(framing) {}

  struct Received {
    std::string text;
    std::string
        refused;  // why the message was passed over; "" where it is there
  };
  // Waits for the next message; nothing at the end, or where what comes is no
  // message and the next one cannot be found.
  std::optional<Received> next();
  // Why there is no next message, where the other side is to blame; "" at an
  // end.
  const std::string& fault() const { return fault_; }

  // Any thread may send. False once the other side does not take it.
  bool send(const std::string& text);
  // Whether somebody still reads, as far as the system can tell.
  bool is_heard() const;

 private:
  std::optional<Received> next_line();
  std::optional<Received> next_framed();
  // One line without its end, cut behind `most` bytes; nothing at the end.
  std::optional<std::string> line(std::size_t most, bool& is_cut);
  // The next bytes, or fewer at the end. Kept in `to` unless that is null.
  bool bytes(std::size_t count, std::string* to);
  bool fill();

  const OpenFile& in_;
  const OpenFile& out_;
  const Framing framing_;
  std::vector<char> block_ = std::vector<char>(1 << 16);
  std::size_t at_ = 0;
  std::size_t end_ = 0;
  std::string fault_;
  std::mutex sending_;
  bool is_closed_ = false;
};

}  // namespace btcheck
