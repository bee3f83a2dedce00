// SPDX-License-Identifier: MIT
//
// Writes random trees with scripted leaves into a folder, for btcheck and
// BehaviorTree.CPP to run (docs/engine_comparison.md).
#include <fmt/format.h>

#include <charconv>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <string_view>

#include "btcpp_random/finding_scripts.hpp"
#include "btcpp_random/random_rules.hpp"
#include "btcpp_random/scripted_run.hpp"
#include "btcpp_random/scripted_tree.hpp"
#include "reference/telling_names.hpp"

namespace fs = std::filesystem;

namespace btcheck::reference {
namespace {

struct Request {
  Profile profile = Profile::Btcpp4;
  std::uint64_t seed = 1;  // of the first tree
  std::uint64_t count = 100;
  int ticks = 20;
  World world = World::Scripted;
  bool plays_findings = false;
  int rules = 0;  // of each tree
  fs::path folder;
};

template <class Number>
Number number_in(std::string_view word) {
  Number number{};
  const auto [end, fault] =
      std::from_chars(word.data(), word.data() + word.size(), number);
  if (fault != std::errc{} || end != word.data() + word.size() || number < 1) {
    throw std::runtime_error(fmt::format("no number: {}", word));
  }
  return number;
}

bool is_yes(std::string_view option, std::string_view value) {
  if (value != "yes" && value != "no") {
    throw std::runtime_error(fmt::format("{} is yes or no", option));
  }
  return value == "yes";
}

Request request_in(int count, char** words) {
  Request request;
  for (int i = 1; i + 1 < count; i += 2) {
    const std::string_view option = words[i];
    const std::string_view value = words[i + 1];
    if (option == "--profile") {
      const auto profile = profile_named(value);
      if (!profile || !is_engine(*profile)) {
        throw std::runtime_error("--profile is that of an XML tree");
      }
      request.profile = *profile;
    } else if (option == "--seed") {
      request.seed = number_in<std::uint64_t>(value);
    } else if (option == "--count") {
      request.count = number_in<std::uint64_t>(value);
    } else if (option == "--ticks") {
      request.ticks = number_in<int>(value);
    } else if (option == "--clock") {
      request.world = is_yes(option, value) ? World::Clocked : World::Scripted;
    } else if (option == "--findings") {
      request.plays_findings = is_yes(option, value);
    } else if (option == "--rules") {
      request.rules = number_in<int>(value);
    } else if (option == "--dir") {
      request.folder = value;
    } else {
      throw std::runtime_error(fmt::format("unknown option {}", option));
    }
  }
  if (count % 2 == 0 || request.folder.empty()) {
    throw std::runtime_error(
        "usage: btcpp_random --dir DIR [--profile btcpp-4] [--seed 1] "
        "[--count 100] [--ticks 20] [--clock no] [--findings no] "
        "[--rules 10]");
  }
  return request;
}

void write(const fs::path& file, const std::string& text) {
  std::ofstream out(file, std::ios::binary);
  out << text;
  if (!out.flush()) throw std::runtime_error("cannot write " + file.string());
}

void write_tree(const fs::path& name, const ScriptedTree& tree) {
  write(fs::path(name).concat(".xml"), tree.xml);
  write(fs::path(name).concat(".script"), tree.script);
  write(fs::path(name).concat(".leaves"), tree.leaves);
  write(fs::path(name).concat(".entries"), tree.entries);
}

// Asked of the tree as btcheck reads it, by script/compare-observer.
void write_rules(const fs::path& name, const ScriptedTree& made,
                 const Request& request, std::uint64_t seed) {
  if (request.rules == 0) return;
  const auto tree = read_tree("t.xml", made.xml,
                              scripted_reading(request.profile, made.leaves));
  write(fs::path(name).concat(".ltl"),
        random_rules(seed, *tree.value, request.rules));
}

void write_trees(const Request& request) {
  fs::create_directories(request.folder);
  for (std::uint64_t i = 0; i < request.count; ++i) {
    const std::uint64_t seed = request.seed + i;
    const ScriptedTree tree = random_scripted_tree(
        seed, request.profile, request.world, request.ticks);
    if (!request.plays_findings) {
      const fs::path name = request.folder / fmt::format("t{}", seed);
      write_tree(name, tree);
      write_rules(name, tree, request, seed);
      continue;
    }
    int number = 0;
    const ScriptedTree named = {with_telling_names(tree.xml, seed),
                                with_telling_names(tree.script, seed),
                                with_telling_names(tree.leaves, seed),
                                tree.entries};
    for (const ScriptedTree& one : finding_scripts(named, request.profile)) {
      write_tree(request.folder / fmt::format("t{}-{}", seed, ++number), one);
    }
  }
}

}  // namespace
}  // namespace btcheck::reference

int main(int count, char** words) {
  try {
    btcheck::reference::write_trees(
        btcheck::reference::request_in(count, words));
  } catch (const std::exception& failure) {
    fmt::print(stderr, "{}\n", failure.what());
    return 2;
  }
  return 0;
}
