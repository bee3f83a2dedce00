// SPDX-License-Identifier: MIT
//
// The node library has teeth: a fixed sample of wrong tables of every node
// type is noticed by its specification. All of them: script/mutants.
#include <doctest/doctest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "model/tree/node_types.hpp"
#include "mutation/mutants.hpp"

namespace btcheck::mutation::mutation_test {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kSample = 12;

TEST_CASE("every node type has a specification that its table meets") {
  for (const NodeTypeInfo& info : btf_node_types()) {
    const fs::path folder = fs::path(BTCHECK_PROPERTIES) / folder_of(info.type);
    CAPTURE(folder.string());
    REQUIRE(fs::is_directory(folder));
    const Specification specification = read_specification(folder);
    REQUIRE(!specification.harnesses.empty());
    for (const auto& harness : specification.harnesses) {
      CAPTURE(harness->file);
      CHECK(!harness->subjects.empty());
    }
    for (const std::string& wrong :
         Judge(specification).wrong_from_the_start()) {
      FAIL_CHECK(wrong);
    }
  }
}

TEST_CASE("wrong tables of every node type are noticed") {
  std::size_t killed = 0;
  for (const auto& entry : fs::directory_iterator(BTCHECK_PROPERTIES)) {
    if (!entry.is_directory()) continue;
    const Specification specification = read_specification(entry.path());
    CAPTURE(specification.name);
    Judge judge(specification);
    std::size_t killed_here = 0;
    for (const Mutant& mutant : sample_of(mutants_of(specification), kSample)) {
      CAPTURE(mutant.text);
      const Fate fate = judge.judge(mutant).fate;
      CHECK(fate != Fate::Survives);
      if (fate == Fate::Killed) ++killed_here;
    }
    CHECK(killed_here >= 6);
    killed += killed_here;
  }
  MESSAGE(killed << " wrong tables noticed");
}

}  // namespace
}  // namespace btcheck::mutation::mutation_test
