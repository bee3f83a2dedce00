// SPDX-License-Identifier: MIT
//
// Each code's smallest example, run: it shows that code and no other.
#include <doctest/doctest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "report/codes/codes.hpp"
#include "shell.hpp"
#include "temporary_folder.hpp"

namespace fs = std::filesystem;

namespace btcheck::explain_test {
namespace {

std::set<std::string> codes_in(const std::string& text) {
  static const std::regex kCode("BT[0-9]{4}");
  std::set<std::string> codes;
  for (std::sregex_iterator at(text.begin(), text.end(), kCode), end; at != end;
       ++at) {
    codes.insert(at->str());
  }
  return codes;
}

// The system keeps port 1 to itself, but not from root: here it is taken.
class TakenPort {
 public:
  TakenPort() {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(1);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    ::bind(socket_, reinterpret_cast<sockaddr*>(&address), sizeof address);
    ::listen(socket_, 1);
  }
  ~TakenPort() { ::close(socket_); }

 private:
  int socket_ = ::socket(AF_INET, SOCK_STREAM, 0);
};

// What the example's last command prints; verdicts, whose codes only reports
// tell, as JSON.
std::string output_of(const CodeRow& row, const fs::path& folder) {
  for (const auto& file : files_of(row.example)) {
    std::ofstream(folder / file.name, std::ios::binary) << file.text;
  }
  std::string text;
  for (const std::string& command : commands_of(row.example)) {
    const bool is_verdict = row.code.starts_with("BT20") ||
                            row.code.starts_with("BT21") ||
                            row.code.starts_with("BT22");
    const Outcome outcome = run_in(
        folder, "btcheck() { '" BTCHECK_PROGRAM "' \"$@\"; }; " + command +
                    (is_verdict ? " --format json" : "") + " 2>&1");
    text = outcome.text;
  }
  return text;
}

}  // namespace

TEST_CASE("the example of each code shows that code and no other") {
  const TakenPort port;
  std::size_t shown = 0;
  for (const CodeRow* row : all_codes()) {
    if (!row->example.exists()) continue;
    const TemporaryFolder folder;
    const std::string output = output_of(*row, folder.path());
    CAPTURE(row->code);
    CAPTURE(output);
    std::set<std::string> codes = codes_in(output);
    // Questions may be asked of many an example.
    std::erase_if(codes, [&](const std::string& code) {
      return code.starts_with("BT25") && code != row->code;
    });
    CHECK(codes == std::set<std::string>{std::string(row->code)});
    // Which codes may have a level hangs on it.
    const std::string told = std::string(severity_name(row->severity)) + "[";
    CHECK((row->code.starts_with("BT2") ||
           output.find(told) != std::string::npos));
    ++shown;
  }
  CHECK(shown >= 139);
}

// A full machine, one without watches, a packed log, our own mistakes, robots
// that run; and two faults that no tree of today's node types has.
TEST_CASE("no code is without an example that could have one") {
  std::set<std::string> without;
  for (const CodeRow* row : all_codes()) {
    if (!row->example.exists()) without.emplace(row->code);
  }
  CHECK(without == std::set<std::string>{"BT1311", "BT1514", "BT1902", "BT1903",
                                         "BT1904", "BT1905", "BT1906", "BT1907",
                                         "BT1908", "BT2102", "BT2103", "BT9001",
                                         "BT9002"});
}

TEST_CASE("explain tells of each code what the table has") {
  for (const CodeRow* row : all_codes()) {
    const Outcome outcome =
        run_in(fs::temp_directory_path(),
               "'" BTCHECK_PROGRAM "' explain " + std::string(row->code));
    CAPTURE(row->code);
    CHECK(outcome.code == 0);
    CHECK(outcome.text.starts_with(std::string(row->code) + ": "));
    CHECK(outcome.text.find("\nWhat to do: ") != std::string::npos);
    CHECK((outcome.text.find("The smallest example") != std::string::npos) ==
          row->example.exists());
    CHECK(row->description.ends_with('.'));
    CHECK(row->help.ends_with('.'));
  }
}

}  // namespace btcheck::explain_test
