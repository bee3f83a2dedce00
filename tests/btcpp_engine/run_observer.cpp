// SPDX-License-Identifier: MIT
//
// Runs the trees of a folder in BehaviorTree.CPP, 4 or 3.8, each twice: with an
// event recorder, which writes NAME.events, and, where NAME.hpp says what to
// observe, with an observer.
//
//     run_observer TICKS DIR
//
// reads NAME.xml, NAME.script, NAME.leaves and NAME.entries, as run_engine
// does. A tick that throws is the last one.
#include "event_recorder.hpp"
#include "scripted_leaves.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <stdexcept>
#include <string>

namespace {

class Program {
 public:
  explicit Program(const fs::path& xml_file) : xml_file_(xml_file) {}

  std::string beside(const char* extension) const {
    return text_of(fs::path(xml_file_).replace_extension(extension));
  }
  void write(const char* extension, const std::string& text) const {
    std::ofstream(fs::path(xml_file_).replace_extension(extension)) << text;
  }

  // Never destroyed: a script of `_onHalted` may throw there.
  BT::Tree& tree() {
    const std::string xml = beside(".xml");
    auto& factory = *new BT::BehaviorTreeFactory;
    register_leaves(factory, xml, script_in(beside(".script")),
                    contracts_in(beside(".leaves")));
    return *new BT::Tree(factory.createTreeFromText(xml));
  }

 private:
  fs::path xml_file_;
};

void record(Program& program, int ticks) {
  BT::Tree& tree = program.tree();
  auto& recorder = *new EventRecorder(tree, program.beside(".entries"));
  try {
    for (int t = 0; t < ticks; ++t) {
      recorder.begin_tick();
      recorder.end_tick(tick(tree));
    }
  } catch (const std::exception&) {
    recorder.leave_tick();
  }
  program.write(".events", recorder.text());
}

void run_tree(const fs::path& xml_file, int ticks) {
  Program program(xml_file);
  try {
    record(program, ticks);
  } catch (const std::exception& refusal) {
    program.write(".refused", std::string(refusal.what()) + "\n");
  }
}

void run_folder(int ticks, const fs::path& folder) {
  for (const auto& file : fs::directory_iterator(folder)) {
    if (file.path().extension() != ".xml") continue;
    const pid_t child = fork();
    if (child < 0) throw std::runtime_error("cannot fork");
    if (child == 0) {
      run_tree(file.path(), ticks);
      _exit(0);
    }
    while (wait(nullptr) > 0) continue;
  }
}

}  // namespace

int main(int count, char** words) {
  if (count != 3) {
    std::cerr << "usage: run_observer TICKS DIR\n";
    return 2;
  }
  run_folder(std::atoi(words[1]), words[2]);
  return 0;
}
