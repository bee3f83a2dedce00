// SPDX-License-Identifier: MIT
//
// Writes random scripts, each in a line with what becomes of it in the naive
// engine of tests/model: tests/btcpp_engine/run_scripts puts what the real one
// does there instead (docs/engine_comparison.md).
//   btcpp_random_scripts SEED COUNT
#include <cstdio>
#include <random>
#include <string>
#include <vector>

#include "model/random_script.hpp"
#include "model/script_engine.hpp"

namespace {

using namespace btcheck::script_engine;

std::string random_line(unsigned seed) {
  std::mt19937 random(seed);
  const bool is_wild = seed % 2 == 0;
  Writer writer(random, is_wild);
  std::vector<Script> script = writer.first();
  for (const Script& each : writer.statements()) script.push_back(each);
  return text_of(script) + " => " + outcome(script);
}

}  // namespace

int main(int count, char** words) {
  if (count != 3) {
    std::fputs("usage: btcpp_random_scripts SEED COUNT\n", stderr);
    return 2;
  }
  const auto first = static_cast<unsigned>(std::stoul(words[1]));
  const auto lines = static_cast<unsigned>(std::stoul(words[2]));
  for (unsigned i = 0; i < lines; ++i)
    std::puts(random_line(first + i).c_str());
  return 0;
}
