// SPDX-License-Identifier: MIT
//
// Runs the trees of a folder of btcpp_faults in BehaviorTree.CPP, 4 or 3.8,
// each by its two scripts, until the tree has ended, has thrown, or the ticks
// are over: NAME.script is logged as NAME.btlog, NAME.well as NAME.well.btlog,
// each with its marks.
//
//     run_faults TICKS DIR
#include "btcheck/observer.hpp"
#include "scripted_leaves.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <exception>
#include <filesystem>
#include <iostream>
#include <stdexcept>
#include <string>

namespace {

void run(const std::string& name, const char* script, const std::string& log,
         int ticks) {
  const std::string xml = text_of(name + ".xml");
  // Never destroyed: a script of `_onHalted` may throw there.
  auto& factory = *new BT::BehaviorTreeFactory;
  register_leaves(factory, xml, script_in(text_of(name + script)),
                  contracts_in(text_of(name + ".leaves")));
  BT::Tree& tree = *new BT::Tree(factory.createTreeFromText(xml));
  btcheck::ObserverOptions options;
  options.log = log;
  auto& observer =
      *new btcheck::Observer(tree, text_of(name + ".monitor"), options);
  try {
    for (int t = 0; t < ticks; ++t) {
      const BT::NodeStatus status = tick(observer);
      if (status == BT::NodeStatus::SUCCESS ||
          status == BT::NodeStatus::FAILURE) {
        break;
      }
    }
  } catch (const std::exception&) {
  }
  observer.flush();
}

void run_alone(const std::string& name, const char* script,
               const std::string& log, int ticks) {
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("cannot fork");
  if (child == 0) {
    try {
      run(name, script, log, ticks);
    } catch (const std::exception& refusal) {
      std::cerr << name << ": " << refusal.what() << "\n";
    }
    _exit(0);
  }
  while (wait(nullptr) > 0) continue;
}

}  // namespace

int main(int count, char** words) {
  if (count != 3) {
    std::cerr << "usage: run_faults TICKS DIR\n";
    return 2;
  }
  for (const auto& file : fs::directory_iterator(words[2])) {
    if (file.path().extension() != ".xml") continue;
    const std::string name = fs::path(file.path()).replace_extension().string();
    const int ticks = std::atoi(words[1]);
    run_alone(name, ".script", name + ".btlog", ticks);
    run_alone(name, ".well", name + ".well.btlog", ticks);
  }
  return 0;
}
