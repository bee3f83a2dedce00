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
#include <sstream>
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

// The block of arrows in docs/architecture.md: which rooms a room may include,
// in the order of the block. A line without an arrow goes on with the last.
struct Room {
  std::string name;
  std::set<std::string> may_include;
};

std::vector<Room> rooms() {
  std::vector<Room> all;
  bool is_inside = false;
  for (const std::string& line :
       read(fs::path(BTCHECK_ROOT) / "docs/architecture.md").lines) {
    if (line.rfind("<!-- rooms:", 0) == 0) is_inside = true;
    if (!is_inside || line.rfind("```", 0) == 0) {
      if (!all.empty()) break;
      continue;
    }
    if (line.rfind("<!--", 0) == 0) continue;
    std::istringstream words(line);
    std::string word;
    if (line[0] != ' ') {
      words >> word;
      all.push_back({word, {}});
      words >> word;  // the arrow
    }
    while (words >> word) all.back().may_include.insert(word);
  }
  return all;
}

// The room of a source, given its path from the root; of a header as included.
std::string room_of(const fs::path& file) {
  return file.parent_path().string();
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
       {"src/explore/components/component_bytes.cpp",
        "src/explore/components/component_store.cpp",
        "src/explore/store/state_store.cpp",
        "src/explore/halves/half_dictionary.cpp",
        "src/explore/large/sorted_run.cpp", "src/batch/results/seal.cpp",
        "src/cli/inputs/build.cpp"}},
      {"zstd.h",
       {"src/explore/large/sorted_run.cpp", "src/trace/logs/unpacked.cpp"}},
      {"lz4frame.h", {"src/trace/logs/unpacked.cpp"}},
      {"sqlite3.h",
       {"src/trace/logs/rosbag_messages.cpp",
        "src/cli/inputs/component_cache.cpp"}},
      {"zmq.h", {"src/groot2/link.cpp"}},
      {"nlohmann/",
       {"src/trace/run/itf.cpp", "src/batch/results/kept_text.cpp",
        "src/run/process/message.cpp", "src/trace/oracle/oracle.cpp",
        "src/report/formats/json_report.cpp", "src/report/whatif/earlier.cpp",
        "src/cli/settings/baseline.cpp", "src/serve/message.cpp"}},
      {"CLI/", {"src/cli/options/words.cpp"}},
      {"doctest/", {}},
      {"tbb/", {"src/explore/", "src/ltl/", "src/cli/inputs/watch.cpp"}},
      {"toml++/", {"src/settings/toml.cpp"}},
      {"boost/asio", {"src/run/view/server.cpp"}},
      {"boost/beast", {"src/run/view/server.cpp"}},
      {"ltsmin/", {"src/pins/module.cpp"}},
      {"tinyxml2.h", {"src/model/btcpp/xml_text.cpp"}},
      {"boost/dynamic_bitset",
       {"src/explore/", "src/ltl/", "src/model/btcpp/expand/",
        "src/model/btcpp/entries/"}}};
  return all;
}

}  // namespace

TEST_CASE("includes follow the arrows between the rooms, and no others") {
  std::map<std::string, std::set<std::string>> drawn;
  for (const Room& room : rooms()) {
    for (const std::string& other : room.may_include) {
      CAPTURE(room.name);
      CAPTURE(other);
      CHECK(drawn.contains(other));  // above it, so that no circle closes
    }
    drawn[room.name] = room.may_include;
  }
  REQUIRE(drawn.size() > 40);
  std::map<std::string, std::set<std::string>> used;
  for (const SourceFile& source : sources_in("src")) {
    const std::string room = room_of(source.path.substr(4));
    used[room];
    for (const std::string& line : source.lines) {
      const std::string other = room_of(included(line, '"', '"'));
      if (other.empty() || other == room) continue;
      used[room].insert(other);
      CAPTURE(source.path);
      CAPTURE(line);
      CHECK(drawn[room].contains(other));
    }
  }
  CHECK(used == drawn);
}

TEST_CASE("no room holds more than a reader can look over") {
  std::map<std::string, int> files;
  for (const SourceFile& source : sources_in("src")) {
    ++files[room_of(source.path)];
  }
  for (const auto& [room, count] : files) {
    CAPTURE(room);
    CHECK(count <= 24);
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
  return source.path.rfind("src/report/codes/", 0) == 0;
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

// A run takes real time, a robot is waited for, and a call of a program may
// take so much.
bool has_a_clock(const SourceFile& source) {
  return source.path.rfind("src/run/", 0) == 0 ||
         source.path.rfind("src/groot2/", 0) == 0 ||
         source.path.rfind("src/api/", 0) == 0 ||
         source.path.rfind("src/serve/", 0) == 0 ||
         source.path.rfind("src/lsp/", 0) == 0 ||
         source.path.rfind("src/btcheck/", 0) == 0;
}

TEST_CASE("only the command line prints, reads files or exits") {
  for (const SourceFile& source : sources_in("src")) {
    // The observer is of another program, and writes its log; so is a file of
    // tests, which prints.
    if (source.path.rfind("src/cli/", 0) == 0 ||
        source.path.rfind("src/batch/", 0) == 0 ||
        source.path == "src/suites/googletest.cpp" ||
        source.path == "src/btcheck/observer.hpp") {
      continue;
    }
    for (const std::string& line : source.lines) {
      for (std::string_view word :
           {"std::cout", "std::cerr", "printf(", "std::exit", "fstream",
            "fmt::print", "std::chrono"}) {
        if (word == "std::chrono" && has_a_clock(source)) continue;
        CAPTURE(source.path);
        CAPTURE(line);
        CHECK(line.find(word) == std::string::npos);
      }
    }
  }
}

// What other front ends call otherwise is a Choice (text/choice.hpp).
TEST_CASE("only the command line speaks of options") {
  const std::regex option(R"rx("[^"]*--[a-z][a-z-]+)rx");
  for (const SourceFile& source : sources_in("src")) {
    const std::string room =
        source.path.substr(4, source.path.find('/', 4) - 4);
    const bool may_speak = room == "cli" || room == "batch" || room == "pins" ||
                           room == "serve" || room == "lsp" ||
                           source.path.starts_with("src/report/codes/") ||
                           source.path.starts_with("src/check/export/ltsmin") ||
                           // Files that call other programs.
                           source.path == "src/suites/googletest.cpp" ||
                           source.path == "src/suites/pytest.cpp" ||
                           source.path == "src/text/choice.cpp";
    if (may_speak) continue;
    for (const std::string& line : source.lines) {
      if (line.find("//") != std::string::npos) continue;
      CAPTURE(source.path);
      CAPTURE(line);
      // A command that is quoted whole is one.
      CHECK((!std::regex_search(line, option) ||
             line.find("export TREE.btf --to") != std::string::npos));
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

// Two types of one name, in two headers, link without a word where no file
// includes both, and the functions of one then serve objects of the other.
TEST_CASE("no two headers define a type of the same name") {
  const std::regex definition(
      R"((?:struct|class|union|enum class) (\w+)( final)?( : .*)?( \{.*)?)");
  const std::regex scope(R"(namespace ([\w:]+) \{)");
  std::map<std::string, std::string> homes_of_types;
  for (const SourceFile& source : sources_in("src")) {
    if (!source.path.ends_with(".hpp")) continue;
    std::string space;
    for (const std::string& line : source.lines) {
      std::smatch found;
      if (std::regex_match(line, found, scope)) space = found[1];
      if (!std::regex_match(line, found, definition)) continue;
      const std::string type = space + "::" + found[1].str();
      const auto [home, is_new] = homes_of_types.emplace(type, source.path);
      INFO(type, " in ", home->second, " and ", source.path);
      CHECK(is_new);
    }
  }
  CHECK(homes_of_types.size() > 300);
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
