// SPDX-License-Identifier: MIT
//
// Writes random trees into a folder, each with one leaf that has a fault, for
// script/compare-explain: NAME.xml, NAME.leaves, the scripts NAME.script and
// NAME.well with and without it, a table of rules for btcheck::observer, and
// NAME.fault, `a3 fails-once`.
//
//     btcpp_faults DIR PROFILE FIRST-SEED COUNT TICKS
#include <fmt/format.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

#include "btcpp_random/faulty_scripts.hpp"
#include "btcpp_random/scripted_run.hpp"
#include "check/check.hpp"
#include "ltl/rules/property.hpp"
#include "model/tree_file.hpp"
#include "trace/run/record.hpp"
#include "trace/watch/monitor_table.hpp"

namespace fs = std::filesystem;

namespace btcheck::reference {
namespace {

void write(const fs::path& file, const std::string& text) {
  std::ofstream out(file, std::ios::binary);
  out << text;
  if (!out.flush()) throw std::runtime_error("cannot write " + file.string());
}

constexpr std::size_t kMostOfTree = 3;

// An observer wants rules; this one is about every tree.
std::string table_for(const FaultyScript& made, Profile profile) {
  const std::string text = "property can: possible root.success\n";
  const SourceText source("rules.ltl", text);
  const auto rules = read_properties("rules.ltl", text);
  const auto tree = read_tree("t.xml", made.tree.xml,
                              scripted_reading(profile, made.tree.leaves));
  const auto table = monitor_table(
      *tree.value,
      recorded_tree(*tree.value, TreeInput("t.xml", made.tree.xml)),
      *rules.value, source);
  return table.value.value();
}

void write_trees(const fs::path& folder, Profile profile, std::uint64_t first,
                 int count, int ticks) {
  fs::create_directories(folder);
  for (int i = 0; i < count; ++i) {
    const std::uint64_t seed = first + static_cast<std::uint64_t>(i);
    int number = 0;
    for (const FaultyScript& made :
         random_faulty_scripts(seed, profile, ticks, kMostOfTree)) {
      const std::string name =
          (folder / fmt::format("t{}-{}", seed, ++number)).string();
      write(name + ".xml", made.tree.xml);
      write(name + ".leaves", made.tree.leaves);
      write(name + ".script", made.tree.script);
      write(name + ".well", made.well);
      write(name + ".monitor", table_for(made, profile));
      write(name + ".fault",
            fmt::format("{} {}\n", made.leaf, facts_of(made.kind).word));
    }
  }
}

}  // namespace
}  // namespace btcheck::reference

int main(int count, char** words) {
  try {
    const auto profile = count == 6 ? btcheck::profile_named(words[2])
                                    : std::optional<btcheck::Profile>();
    if (!profile) {
      throw std::runtime_error(
          "usage: btcpp_faults DIR PROFILE FIRST-SEED COUNT TICKS");
    }
    btcheck::reference::write_trees(words[1], *profile,
                                    std::strtoull(words[3], nullptr, 10),
                                    std::atoi(words[4]), std::atoi(words[5]));
  } catch (const std::exception& failure) {
    fmt::print(stderr, "{}\n", failure.what());
    return 2;
  }
  return 0;
}
