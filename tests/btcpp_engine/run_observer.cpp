// SPDX-License-Identifier: MIT
//
// Runs the trees of a folder in BehaviorTree.CPP, 4 or 3.8, each twice: with an
// event recorder, which writes NAME.events, and with an observer that has the
// table NAME.monitor, which writes NAME.btlog, its marks, and NAME.verdicts, a
// line for each rule: `r1 VIOLATED tick 3`.
//
//     run_observer TICKS DIR
//
// reads NAME.xml, NAME.script, NAME.leaves and NAME.entries, as run_engine
// does. A tick that throws is the last one.
#include "btcheck/observer.hpp"
#include "event_recorder.hpp"
#include "scripted_leaves.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <stdexcept>
#include <string>

namespace {

class Program {
 public:
  explicit Program(const fs::path& xml_file) : xml_file_(xml_file) {}

  fs::path file(const char* extension) const {
    return fs::path(xml_file_).replace_extension(extension);
  }
  std::string beside(const char* extension) const {
    return text_of(file(extension));
  }
  void write(const char* extension, const std::string& text) const {
    std::ofstream(file(extension)) << text;
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
      tick(tree);
    }
  } catch (const std::exception&) {
    recorder.leave_tick();
  }
  program.write(".events", recorder.text());
}

void observe(Program& program, int ticks) {
  BT::Tree& tree = program.tree();
  btcheck::ObserverOptions options;
  options.log = program.file(".btlog").string();
  auto& observer =
      *new btcheck::Observer(tree, program.beside(".monitor"), options);
  std::map<std::string, std::string> decided;
  observer.call("*", [&](const btcheck::Decision& decision) {
    decided[decision.name] =
        std::string(btcheck::monitor::verdict_name(decision.verdict)) +
        " tick " + std::to_string(decision.tick);
  });
  try {
    for (int t = 0; t < ticks; ++t) tick(observer);
  } catch (const std::exception&) {
  }
  observer.flush();
  std::string text;
  for (std::size_t r = 0; r < observer.rule_count(); ++r) {
    const std::string& name = observer.rule_name(r);
    const bool is_told = decided.count(name) > 0;
    text += name + " " +
            (is_told ? decided[name]
                     : btcheck::monitor::verdict_name(observer.verdict(r))) +
            "\n";
  }
  program.write(".verdicts", text);
}

void run_tree(const fs::path& xml_file, int ticks) {
  Program program(xml_file);
  try {
    record(program, ticks);
    if (fs::exists(program.file(".monitor"))) observe(program, ticks);
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
