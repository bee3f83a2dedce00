// SPDX-License-Identifier: MIT
//
// Runs scripts in BehaviorTree.CPP 4, each on a blackboard of its own: reads
// lines `SCRIPT => …` and writes `SCRIPT => OUTCOME`, as btcpp_random_scripts
// does (docs/engine_comparison.md).
//   run_scripts < IN > OUT
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <iostream>
#include <string>
#include <vector>

#include "behaviortree_cpp/bt_factory.h"
#include "behaviortree_cpp/scripting/script_parser.hpp"

namespace {

// "1", "0.5", "-1.0", "'idle'", or "nothing".
std::string shown(const BT::Any& value) {
  if (value.empty()) return "nothing";
  if (value.isString()) return "'" + value.cast<std::string>() + "'";
  if (value.isIntegral()) return std::to_string(value.cast<int64_t>());
  const double number = value.cast<double>();
  if (std::isnan(number)) return "nan";
  char digits[40];
  std::snprintf(digits, sizeof digits, "%.17g", number);
  const std::string text = digits;
  return text.find_first_of(".en") == text.npos ? text + ".0" : text;
}

std::string truth_of(const BT::Any& value) {
  try {
    return value.cast<bool>() ? "true" : "false";
  } catch (const std::exception&) {
    return "no truth";
  }
}

std::string outcome(const std::string& script) {
  const auto blackboard = BT::Blackboard::create();
  std::string told;
  try {
    const auto parsed = BT::ParseScript(script);
    if (!parsed) return "no script: " + parsed.error();
    BT::Ast::Environment environment{blackboard, nullptr};
    told = truth_of((*parsed)(environment));
  } catch (const std::exception&) {
    return "throws";
  }
  std::vector<std::string> names;
  for (const auto name : blackboard->getKeys()) names.emplace_back(name);
  std::sort(names.begin(), names.end());
  for (const std::string& name : names) {
    told += " " + name + "=" + shown(*blackboard->getAnyLocked(name).get());
  }
  return told;
}

}  // namespace

int main() {
  for (std::string line; std::getline(std::cin, line);) {
    const std::string script = line.substr(0, line.find(" => "));
    std::cout << script << " => " << outcome(script) << '\n';
  }
}
