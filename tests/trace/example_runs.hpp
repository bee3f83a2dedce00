// SPDX-License-Identifier: MIT
//
// Every counterexample and witness that the examples have.
#pragma once

#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "check/check.hpp"
#include "model/btf_text.hpp"
#include "trace/run/record.hpp"

namespace btcheck {

inline void add_runs_of(const InputFile& properties,
                        std::vector<RecordedRun>& runs) {
  const auto tree = tree_of_properties(properties);
  REQUIRE(tree.value);
  const std::string name = tree.value->empty() ? "drone3.btf" : *tree.value;
  const InputFile input{name, example(name)};
  CheckOptions options;
  options.limits.max_states = 200'000;
  const CheckResult result = check(input, {properties}, options);
  REQUIRE(result.files.size() == 1);
  for (const PropertyVerdict& verdict : result.files[0].verdicts) {
    if (!verdict.run) continue;
    RunHeading heading{
        {verdict.property->name, verdict.property->text, "VIOLATED"}};
    heading.source = input.text;
    heading.watched = verdict.watched;
    runs.push_back(recorded(*result.tree, *result.files[0].network,
                            *verdict.run, heading));
  }
}

// Checks the examples the first time it is called.
inline const std::vector<RecordedRun>& example_runs() {
  static const std::vector<RecordedRun> all = [] {
    std::vector<std::string> names;
    for (const auto& entry :
         std::filesystem::directory_iterator(BTCHECK_EXAMPLES)) {
      if (entry.path().extension() != ".ltl") continue;
      names.push_back(entry.path().filename().string());
    }
    std::sort(names.begin(), names.end());
    std::vector<RecordedRun> runs;
    for (const std::string& name : names) {
      add_runs_of({name, example(name)}, runs);
    }
    return runs;
  }();
  REQUIRE(all.size() > 40);
  return all;
}

}  // namespace btcheck
