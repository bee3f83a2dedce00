// SPDX-License-Identifier: MIT
//
// A folder of trees in BehaviorTree.CPP's XML, compared with what the engine
// itself said of each. The environment variable BTCHECK_BTCPP_CORPUS names the
// folder; in it stands load.tsv, or another .tsv file, with the columns
//
//   file   OK or ERR and the message   subtrees   nodes
//
// Lines that begin with `#` are left out. Skipped when the variable is unset.
#include <doctest/doctest.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "model/btcpp/document.hpp"
#include "model/btcpp/expand/expansion.hpp"

namespace fs = std::filesystem;

namespace {

using btcheck::Diagnostic;

struct Row {
  std::string file;
  std::string result;
  std::size_t subtrees = 0;
  std::size_t nodes = 0;

  bool is_loaded() const { return result == "OK"; }
};

std::string text_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

std::vector<std::string> columns_of(const std::string& line) {
  std::vector<std::string> columns;
  std::istringstream stream(line);
  for (std::string column; std::getline(stream, column, '\t');) {
    columns.push_back(column);
  }
  columns.resize(std::max<std::size_t>(columns.size(), 4));
  return columns;
}

std::vector<Row> rows_of(const fs::path& table) {
  std::vector<Row> rows;
  std::ifstream stream(table);
  for (std::string line; std::getline(stream, line);) {
    if (line.empty() || line.front() == '#') continue;
    const auto columns = columns_of(line);
    rows.push_back({columns[0], columns[1],
                    std::strtoul(columns[2].c_str(), nullptr, 10),
                    std::strtoul(columns[3].c_str(), nullptr, 10)});
  }
  return rows;
}

fs::path table_in(const fs::path& folder) {
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() == ".tsv") return entry.path();
  }
  return {};
}

btcheck::IncludedFile load(const btcheck::IncludeRequest& request) {
  const fs::path file =
      (fs::path(request.from).parent_path() / request.path).lexically_normal();
  if (!request.ros_package.empty() || !fs::is_regular_file(file)) {
    return {file.string(), std::nullopt, "there is no such file"};
  }
  return {file.string(), text_of(file), {}};
}

struct Reading {
  bool is_read = false;
  std::size_t subtrees = 0;
  std::size_t nodes = 0;
  std::vector<Diagnostic> diagnostics;

  std::set<std::string> errors() const {
    std::set<std::string> codes;
    for (const Diagnostic& found : diagnostics) {
      if (found.severity == btcheck::Severity::Error) codes.insert(found.code);
    }
    return codes;
  }
};

// As version 4 whatever the file says: so did the engine of the table.
Reading read(const fs::path& file) {
  Reading reading;
  auto document = btcheck::read_btcpp(
      file.string(), text_of(file), load,
      {.release = btcheck::BtcppRelease::V4, .version = 41000, .models = {}});
  reading.diagnostics = std::move(document.diagnostics);
  if (!document.value) return reading;
  auto expansion = btcheck::expand_btcpp(*document.value);
  for (auto& found : expansion.diagnostics) {
    reading.diagnostics.push_back(std::move(found));
  }
  if (!expansion.value) return reading;
  reading.is_read = true;
  reading.subtrees = expansion.value->subtrees.size();
  reading.nodes = expansion.value->nodes.size();
  return reading;
}

// Which code says what the engine's message says.
std::string_view code_of(std::string_view message) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 20>
      kReasons = {{{"main_tree_to_execute", "BT1611"},
                   {"Error parsing the XML", "BT1600"},
                   {"called <root>", "BT1601"},
                   {"nesting depth", "BT1602"},
                   {"<include>", "BT1603"},
                   {"attribute [ID]", "BT1604"},
                   {"Attribute [ID]", "BT1604"},
                   {"forbidden character", "BT1605"},
                   {"Duplicate SubTree", "BT1606"},
                   {"child", "BT1607"},
                   {"not recognized", "BT1608"},
                   {"providedPorts", "BT1609"},
                   {"can not be converted", "BT1610"},
                   {"Can't find a tree", "BT1612"},
                   {"Recursive", "BT1613"},
                   {"mandatory port", "BT1614"},
                   {"script", "BT1615"},
                   {"operand", "BT1615"},
                   {"initially created", "BT1616"},
                   {"Unknown node type", "BT1619"}}};
  for (const auto& [words, code] : kReasons) {
    if (message.find(words) != message.npos) return code;
  }
  return "no code";
}

std::string listed(const std::set<std::string>& codes) {
  std::string text;
  for (const std::string& code : codes) text += ' ' + code;
  return text;
}

}  // namespace

TEST_CASE("a corpus is read as BehaviorTree.CPP reads it") {
  const char* name = std::getenv("BTCHECK_BTCPP_CORPUS");
  if (name == nullptr) {
    MESSAGE("skipped: BTCHECK_BTCPP_CORPUS names no folder");
    return;
  }
  const fs::path table = table_in(name);
  REQUIRE(!table.empty());
  std::size_t loaded = 0;
  std::size_t rejected = 0;
  for (const Row& row : rows_of(table)) {
    const Reading reading = read(fs::path(name) / row.file);
    std::string said;
    for (const Diagnostic& found : reading.diagnostics) said += render(found);
    CAPTURE(row.file);
    CAPTURE(row.result);
    CAPTURE(said);
    if (row.is_loaded()) {
      CHECK(reading.is_read);
      CHECK(reading.subtrees == row.subtrees);
      CHECK(reading.nodes == row.nodes);
      loaded += reading.is_read ? 1 : 0;
    } else {
      CHECK(!reading.is_read);
      CHECK_MESSAGE(reading.errors().contains(std::string(code_of(row.result))),
                    code_of(row.result), " expected, found",
                    listed(reading.errors()));
      ++rejected;
    }
    if (std::getenv("BTCHECK_BTCPP_CORPUS_SHOW") != nullptr) std::cout << said;
  }
  MESSAGE(loaded, " loaded, ", rejected, " rejected");
  CHECK(loaded + rejected > 0);
}
