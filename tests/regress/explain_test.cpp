// SPDX-License-Identifier: MIT
//
// Each code's smallest example, run: it shows that code and no other.
#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "cli/codes/codes.hpp"
#include "shell.hpp"
#include "temporary_folder.hpp"

namespace fs = std::filesystem;

namespace {

using btcheck::CodeRow;
using btcheck::Outcome;
using btcheck::run_in;

std::set<std::string> codes_in(const std::string& text) {
  static const std::regex kCode("BT[0-9]{4}");
  std::set<std::string> codes;
  for (std::sregex_iterator at(text.begin(), text.end(), kCode), end; at != end;
       ++at) {
    codes.insert(at->str());
  }
  return codes;
}

// What the example's last command prints; verdicts, whose codes only reports
// tell, as JSON.
std::string output_of(const CodeRow& row, const fs::path& folder) {
  for (const auto& file : btcheck::files_of(row.example)) {
    std::ofstream(folder / file.name, std::ios::binary) << file.text;
  }
  std::string text;
  for (const std::string& command : btcheck::commands_of(row.example)) {
    const bool is_verdict = row.code.starts_with("BT20") ||
                            row.code.starts_with("BT21") ||
                            row.code.starts_with("BT22");
    const Outcome outcome =
        run_in(folder, "'" BTCHECK_PROGRAM "' " + command +
                           (is_verdict ? " --format json" : "") + " 2>&1");
    text = outcome.text;
  }
  return text;
}

}  // namespace

TEST_CASE("the example of each code shows that code and no other") {
  std::size_t shown = 0;
  for (const CodeRow* row : btcheck::all_codes()) {
    if (!row->example.exists()) continue;
    const btcheck::TemporaryFolder folder;
    const std::string output = output_of(*row, folder.path());
    CAPTURE(row->code);
    CAPTURE(output);
    CHECK(codes_in(output) == std::set<std::string>{std::string(row->code)});
    // Which codes may have a level hangs on it.
    const std::string told =
        std::string(btcheck::severity_name(row->severity)) + "[";
    CHECK((row->code.starts_with("BT2") ||
           output.find(told) != std::string::npos));
    ++shown;
  }
  CHECK(shown >= 118);
}

// Large inputs, binary files, damaged disks, a full machine, a port that
// another has, our own mistakes; and two faults that no tree of today's node
// types has.
TEST_CASE("no code is without an example that could have one") {
  std::set<std::string> without;
  for (const CodeRow* row : btcheck::all_codes()) {
    if (!row->example.exists()) without.emplace(row->code);
  }
  CHECK(without ==
        std::set<std::string>{"BT1000", "BT1002", "BT1109", "BT1210", "BT1211",
                              "BT1303", "BT1304", "BT1310", "BT1508", "BT1509",
                              "BT1512", "BT1602", "BT1705", "BT1803", "BT1807",
                              "BT1809", "BT1810", "BT1811", "BT1812", "BT1813",
                              "BT2102", "BT2103", "BT9001", "BT9002"});
}

TEST_CASE("explain tells of each code what the table has") {
  for (const CodeRow* row : btcheck::all_codes()) {
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
