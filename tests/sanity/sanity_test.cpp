// SPDX-License-Identifier: MIT
//
// The rules of docs/architecture.md that a machine can check: who may include
// whom, which library belongs where, licence lines, line width, no copies.
#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace fs = std::filesystem;

namespace {

struct SourceFile {
  std::string path;  // from the root
  std::vector<std::string> lines;
};

SourceFile read(const fs::path& file) {
  SourceFile source{fs::relative(file, BTCHECK_ROOT).string(), {}};
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);) {
    source.lines.push_back(line);
  }
  return source;
}

std::vector<SourceFile> sources_in(std::string_view folder) {
  std::vector<SourceFile> sources;
  for (const auto& entry :
       fs::recursive_directory_iterator(fs::path(BTCHECK_ROOT) / folder)) {
    const auto extension = entry.path().extension();
    if (extension == ".cpp" || extension == ".hpp") {
      sources.push_back(read(entry.path()));
    }
  }
  REQUIRE(!sources.empty());
  return sources;
}

// What stands between the quotes or angle brackets of an #include, or "".
std::string included(const std::string& line, char open, char close) {
  const std::string start = std::string("#include ") + open;
  if (line.rfind(start, 0) != 0) return {};
  return line.substr(start.size(), line.rfind(close) - start.size());
}

// A layer may include what begins with one of these.
struct Arrow {
  std::string_view layer;
  std::vector<std::string_view> may_include;
};

const std::vector<Arrow>& arrows() {
  static const std::vector<Arrow> all = {
      {"src/utf8", {"utf8.hpp"}},
      {"src/diagnostic", {"diagnostic.hpp", "utf8.hpp"}},
      {"src/model/", {"model/", "diagnostic.hpp", "utf8.hpp"}},
      {"src/model/btcpp/",
       {"model/btcpp/", "model/btf_findings.hpp", "model/tree.hpp",
        "model/expression.hpp", "model/profile.hpp", "diagnostic.hpp",
        "utf8.hpp"}},
      {"src/explore/", {"explore/", "model/network.hpp", "diagnostic.hpp"}},
      {"src/ltl/",
       {"ltl/", "diagnostic.hpp", "utf8.hpp", "explore/transition_system.hpp",
        "explore/state_store.hpp", "explore/stored_graph.hpp",
        "explore/limits.hpp", "explore/breadth_first_tree.hpp",
        "explore/stored_run.hpp", "explore/growing_array.hpp"}},
      {"src/check/",
       {"check/", "explore/", "ltl/", "model/", "diagnostic.hpp"}},
      {"src/trace/",
       {"trace/", "check/verdict.hpp", "model/tree.hpp", "model/network.hpp",
        "diagnostic.hpp", "utf8.hpp"}},
      {"src/cli/",
       {"cli/", "check/", "trace/", "model/", "diagnostic.hpp", "utf8.hpp"}}};
  return all;
}

bool begins_with_one_of(std::string_view text,
                        const std::vector<std::string_view>& starts) {
  return std::any_of(starts.begin(), starts.end(), [&](std::string_view s) {
    return text.substr(0, s.size()) == s;
  });
}

// A library and the only places that may include it.
struct Home {
  std::string_view header;
  std::vector<std::string_view> places;
};

const std::vector<Home>& homes() {
  static const std::vector<Home> all = {
      {"xxhash.h",
       {"src/explore/state_store.cpp", "src/explore/half_dictionary.cpp",
        "src/explore/sorted_run.cpp", "src/cli/batch/content_hash.cpp"}},
      {"zstd.h", {"src/explore/sorted_run.cpp"}},
      {"nlohmann/",
       {"src/trace/itf.cpp", "src/trace/packed.cpp", "src/trace/chrome.cpp",
        "src/trace/mcap.cpp", "src/trace/substitution.cpp",
        "src/cli/batch/kept_tree.cpp", "src/cli/space_report.cpp",
        "src/cli/report_formats/sarif.cpp",
        "src/cli/report_formats/json_report.cpp"}},
      {"CLI/", {"src/cli/option_words.cpp"}},
      {"doctest/", {}},
      {"tbb/", {"src/explore/", "src/ltl/", "src/cli/batch/job_pool.cpp"}},
      {"toml++/", {"src/cli/batch/manifest.cpp"}},
      {"tinyxml2.h", {"src/model/btcpp/xml_text.cpp"}},
      {"boost/dynamic_bitset",
       {"src/explore/", "src/ltl/", "src/model/btcpp/"}}};
  return all;
}

}  // namespace

TEST_CASE("includes follow the arrows between the layers") {
  for (const SourceFile& source : sources_in("src")) {
    bool has_layer = false;
    for (const Arrow& arrow : arrows()) {
      if (source.path.rfind(arrow.layer, 0) != 0) continue;
      has_layer = true;
      for (const std::string& line : source.lines) {
        const std::string header = included(line, '"', '"');
        if (header.empty()) continue;
        CAPTURE(source.path);
        CAPTURE(header);
        CHECK(begins_with_one_of(header, arrow.may_include));
      }
    }
    CAPTURE(source.path);
    CHECK(has_layer);
  }
}

TEST_CASE("each library is included only where it belongs") {
  for (const SourceFile& source : sources_in("src")) {
    for (const std::string& line : source.lines) {
      const std::string header = included(line, '<', '>');
      for (const Home& home : homes()) {
        if (header.rfind(home.header, 0) != 0) continue;
        CAPTURE(source.path);
        CAPTURE(header);
        CHECK(begins_with_one_of(source.path, home.places));
      }
    }
  }
}

// Where the codes themselves are told.
bool is_code_table(const SourceFile& source) {
  return source.path.rfind("src/cli/codes/", 0) == 0;
}

TEST_CASE("every code in the sources is explained") {
  std::set<std::string> explained;
  std::set<std::string> shown;
  static const std::regex kCode("\"(BT[0-9]{4})\"");
  for (const SourceFile& source : sources_in("src")) {
    for (const std::string& line : source.lines) {
      std::smatch code;
      if (!std::regex_search(line, code, kCode)) continue;
      (is_code_table(source) ? explained : shown).insert(code[1].str());
    }
  }
  // Written into a message as it stands.
  shown.insert("BT0001");
  CHECK(explained.size() >= 80);
  CHECK(explained == shown);
}

TEST_CASE("only the command line prints, reads files or exits") {
  for (const SourceFile& source : sources_in("src")) {
    if (source.path.rfind("src/cli/", 0) == 0) continue;
    for (const std::string& line : source.lines) {
      for (std::string_view word :
           {"std::cout", "std::cerr", "printf(", "std::exit", "fstream",
            "fmt::print", "std::chrono"}) {
        CAPTURE(source.path);
        CAPTURE(line);
        CHECK(line.find(word) == std::string::npos);
      }
    }
  }
}

TEST_CASE("every source names its licence, and no line is too wide") {
  for (const char* folder : {"src", "tests"}) {
    for (const SourceFile& source : sources_in(folder)) {
      CAPTURE(source.path);
      REQUIRE(!source.lines.empty());
      CHECK(source.lines[0] == "// SPDX-License-Identifier: MIT");
    }
  }
  for (const SourceFile& source : sources_in("src")) {
    for (const std::string& line : source.lines) {
      const auto width = std::count_if(line.begin(), line.end(), [](char c) {
        return (static_cast<unsigned char>(c) & 0xc0) != 0x80;
      });
      CAPTURE(source.path);
      CAPTURE(line);
      CHECK(width <= 80);
    }
  }
}

TEST_CASE("no file is named after nothing in particular") {
  for (const SourceFile& source : sources_in("src")) {
    const std::string name = fs::path(source.path).stem().string();
    for (std::string_view vague :
         {"util", "utils", "helpers", "common", "misc"}) {
      CHECK(name != vague);
    }
  }
}

TEST_CASE("no two sources are the same file") {
  std::map<std::vector<std::string>, std::string> path_of;
  for (const char* folder : {"src", "tests"}) {
    for (const SourceFile& source : sources_in(folder)) {
      const std::string& first =
          path_of.emplace(source.lines, source.path).first->second;
      CHECK(source.path == first);
    }
  }
}
