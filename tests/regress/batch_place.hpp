// SPDX-License-Identifier: MIT
//
// Folders of trees to run `btcheck batch` on, and what it says of them.
#pragma once

#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "file_text.hpp"
#include "shell.hpp"
#include "temporary_folder.hpp"

namespace btcheck {

inline void put(const std::filesystem::path& file, const std::string& text) {
  std::filesystem::create_directories(file.parent_path());
  std::ofstream(file, std::ios::binary) << text;
}

// How often a line begins so.
inline std::size_t lines_with(const std::string& text,
                              const std::string& start) {
  std::size_t count = text.starts_with(start);
  for (std::size_t at = 0;
       (at = text.find("\n" + start, at)) != std::string::npos; ++at) {
    ++count;
  }
  return count;
}

// What two runs of the same batch may differ in, in any format. Reports have
// many megabytes: sed is far faster than <regex>.
inline std::string without_times(const std::string& text) {
  static const std::string kTimes =
      R"re( -e 's/ +[0-9]+\.[0-9]+ s\b/_/g')re"
      R"re( -e 's/"(seconds|peak_bytes)": ?[-+.0-9e]+/_/g')re"
      R"re( -e 's/"started": ?"[^"]*"/_/g')re"
      R"re( -e 's/ (time|timestamp)="[-.:0-9TZ]+"/_/g')re"
      R"re( -e 's/"peak_bytes" value="[0-9]+"/_/g')re"
      R"re( -e 's/[0-9]{4}-[0-9]{2}-[0-9]{2}T[0-9:]+Z/_/g')re"
      R"re( -e 's/>[0-9]+\.[0-9]+ s</_/g')re";
  const TemporaryFolder folder;
  put(folder.path() / "text", text);
  const Outcome outcome = run_in(folder.path(), "sed -E" + kTimes + " text");
  CHECK(outcome.code == 0);
  return outcome.text;
}

// In quotes, and a blank behind it.
inline const std::string kBatch = "'" BTCHECK_PROGRAM "' batch ";

// A folder to run `btcheck batch` in.
struct BatchPlace : TemporaryFolder {
  Outcome run(const std::string& words) const {
    return run_in(path(), kBatch + words);
  }
  // Of a command line that is run with -q: what it says on stderr.
  std::string complaints(const std::string& words) const {
    return run_in(path(), kBatch + words + " -q 2>&1 >/dev/null").text;
  }
};

// The i-th of many trees: its root, its children and their number vary.
inline std::string generated_tree(int i) {
  static const std::vector<std::string> kRoots = {
      "Sequence",           "Fallback",    "ReactiveSequence :halt 1",
      "SequenceWithMemory", "ParallelAll", "RoundRobin",
      "PipelineSequence"};
  static const std::vector<std::string> kChildren = {
      "(Action :ID go)", "(Condition :ID is_there)",
      "(Inverter (Action :ID look))", "(Repeat :repeat 2 (Action :ID turn))"};
  std::string tree = "(BehaviorTree :name t" + std::to_string(i) + " (" +
                     kRoots[static_cast<std::size_t>(i) % kRoots.size()] +
                     " :name it";
  for (int k = 0; k < 2 + i % 3; ++k) {
    const auto which = static_cast<std::size_t>(i + k * (1 + i / 50));
    tree += "\n " + kChildren[which % kChildren.size()];
  }
  return tree + "))\n";
}

// So many trees, each with its properties; each twentieth cannot be read, for
// one of several reasons.
inline void generate_trees(const std::filesystem::path& folder, int count) {
  static const std::vector<std::string> kBroken = {
      "(BehaviorTree :name x (Action :ID a)", "(BehaviorTree :name x (Seq))",
      "(BehaviorTree :name x (Action :ID a :duraton [1,2]))", "",
      "(BehaviorTree :name x)"};
  for (int i = 0; i < count; ++i) {
    const std::string number = std::to_string(1000 + i).substr(1);
    const bool is_broken = i % 20 == 7;
    const std::filesystem::path stem =
        folder / ("part" + std::to_string(i % 4)) / number;
    put(stem.string() + ".btf",
        is_broken ? kBroken[static_cast<std::size_t>(i / 20) % kBroken.size()]
                  : generated_tree(i));
    put(stem.string() + ".ltl",
        "property reached expect holds: possible it.ticked\n"
        "property one_answer expect holds:\n"
        "    never it.success and it.failure\n"
        "property idle expect violated: never it.success or it.failure\n");
  }
}

// Reports of all formats; and with runs.
inline const std::string kFormats =
    " --format json=r.json --format junit=r.xml --format sarif=r.sarif "
    "--format github=r.txt --format gitlab=r.lab --format jsonl=r.jsonl "
    "--report r.html ";
inline const std::string kReports = kFormats + "--trace-dir runs ";

// What a batch has printed and written.
inline std::string reports_in(const BatchPlace& place, const Outcome& outcome) {
  std::string all = std::to_string(outcome.code) + outcome.text;
  for (const char* file :
       {"r.json", "r.xml", "r.sarif", "r.txt", "r.lab", "r.jsonl", "r.html"}) {
    const std::string text = file_text(place.path() / file);
    CHECK(!text.empty());
    all += text;
  }
  return without_times(all);
}

// A pair of files with one property.
inline void put_pair(const std::filesystem::path& stem,
                     const std::string& property) {
  put(stem.string() + ".btf",
      "(BehaviorTree :name t (Sequence :name s (Action :ID a) "
      "(Action :ID b)))\n");
  put(stem.string() + ".ltl", "property p expect holds: " + property + "\n");
}

// A tree whose search takes far longer than any test.
inline void put_endless(const std::filesystem::path& stem) {
  std::string leaves;
  for (int i = 0; i < 14; ++i) {
    leaves += "(Action :ID a" + std::to_string(i) + " :duration [1,9])";
  }
  put(stem.string() + ".btf",
      "(BehaviorTree :name t (ParallelAll " + leaves + "))\n");
  put(stem.string() + ".ltl",
      "property p: never a0.success and a1.success and a2.success and "
      "a3.failure and a4.success and a5.running and a6.failure and a7.ticked "
      "and a8.halted\n");
}

}  // namespace btcheck
