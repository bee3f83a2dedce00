// SPDX-License-Identifier: MIT
//
// Runs the trees of a folder in BehaviorTree.CPP, 4 or 3.8, and writes of each
// the lines that `btcheck simulate --script --loop` writes.
//
//     run_engine TICKS DIR [MS]
//
// reads NAME.xml, NAME.script, NAME.leaves and NAME.entries of DIR and writes
// NAME.engine and, where the release has FileLogger2, its log NAME.btlog. A
// contract `:answers once` makes a StatefulActionNode. The ticks begin MS
// milliseconds one after the other, 15 unless said otherwise: a Sleep that is
// halted and begun again at once may end at once, for the thread of its timer
// has then not seen the first yet. One line is one tickExactlyOnce, which
// resets the tree where it succeeds or fails. `root=none, ` and what the engine
// threw end the run.
#include "scripted_leaves.hpp"

#if __has_include(<behaviortree_cpp/loggers/bt_file_logger_v2.h>)
#include <behaviortree_cpp/loggers/bt_file_logger_v2.h>
#define HAS_LOGGER 1
#else
#define HAS_LOGGER 0
#endif
#include "nav2_nodes.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <memory>
#include <optional>
#include <regex>
#include <sstream>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace {

// --- Entries ---------------------------------------------------------------

// "3", "minus_1", "0_5", as btcheck calls the values of an entry.
std::string value_word(const BT::Any& value) {
  std::string word;
  std::ostringstream text;
  if (value.isString()) {
    text << value.cast<std::string>();
  } else {
    const double number = value.cast<double>();
    if (number < 0) word = "minus_";
    text << std::abs(number);
  }
  for (const char c : text.str()) {
    word += std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
  }
  return word.empty() ? "empty" : word;
}

// The entries to be written, from lines `NAME PATH ENTRY`.
class Entries {
 public:
  Entries(BT::Tree& tree, const std::string& lines) {
    std::istringstream words(lines);
    Entry entry;
    for (std::string path; words >> entry.name >> path >> entry.key;) {
      entry.blackboard = blackboard_of(tree, path);
      if (!entry.blackboard) throw std::runtime_error("no subtree " + path);
      entries_.push_back(std::move(entry));
      entry = {};
    }
  }

  std::string text() const {
    std::string text;
    for (const Entry& entry : entries_) {
      const auto value = value_of(entry);
      const bool is_set = value && !value->empty();
      text += " " + entry.name + "=" + (is_set ? value_word(*value) : "unset");
    }
    return text;
  }

 private:
  struct Entry {
    std::string name;
    BT::Blackboard::Ptr blackboard;
    std::string key;
  };
  static std::optional<BT::Any> value_of(const Entry& entry) {
    return value_in(*entry.blackboard, entry.key);
  }

  std::vector<Entry> entries_;
};

// --- Runs ------------------------------------------------------------------

// Notes what each node answers, and that it was halted: only a halt makes a
// running node idle. In its own tick it is a node of Nav2 that calls its halt()
// before it answers.
class Recorder {
 public:
  explicit Recorder(BT::Tree& tree) {
    BT::applyRecursiveVisitor(tree.rootNode(), [this](BT::TreeNode* node) {
      ++uses_[node->name()];
      nodes_.push_back(node);
    });
    for (BT::TreeNode* node : nodes_) listen_to(*node);
  }

  // What the nodes have done since the last time, in pre-order.
  std::string take() {
    std::string text;
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      std::string& answers = answers_[nodes_[i]];
      if (answers.empty()) continue;
      text.append(" ").append(called(*nodes_[i])).append("=").append(answers);
      answers.clear();
    }
    return text;
  }

 private:
  // By its path where its subtree is used twice.
  std::string called(const BT::TreeNode& node) const {
#if ENGINE_4
    if (uses_.at(node.name()) > 1) return node.fullPath();
#endif
    return node.name();
  }

  void listen_to(BT::TreeNode& node) {
#if ENGINE_4
    node.setPreTickFunction([this](BT::TreeNode& self) {
      begins_[&self] = true;
      return BT::NodeStatus::IDLE;  // ticks it
    });
    node.setPostTickFunction([this](BT::TreeNode& self, BT::NodeStatus status) {
      note_answer(self, status);
      return BT::NodeStatus::IDLE;  // changes nothing
    });
#else
    node.setPostTickOverrideFunction(
        [this](BT::TreeNode& self, BT::NodeStatus,
               BT::NodeStatus status) -> BT::Optional<BT::NodeStatus> {
          note_answer(self, status);
          return nonstd::make_unexpected("");  // changes nothing
        });
#endif
    subscribers_.push_back(node.subscribeToStatusChange(
        [this](BT::TimePoint, const BT::TreeNode& self, BT::NodeStatus before,
               BT::NodeStatus after) { see(self, before, after); }));
  }

  void note_answer(const BT::TreeNode& node, BT::NodeStatus answer) {
    begins_[&node] = false;
    answered_[&node] = node.status() != answer && word_of(answer) != "skipped";
    note(node, word_of(answer));
  }

  // A node that has ended and was not reset is ticked without the pre-tick
  // function: that it sets itself running before it answers tells of its tick.
  void see(const BT::TreeNode& node, BT::NodeStatus before,
           BT::NodeStatus after) {
    const bool has_answered = std::exchange(answered_[&node], false);
    if (after == BT::NodeStatus::RUNNING) {
      begins_[&node] = begins_[&node] || !has_answered;
    } else if (before == BT::NodeStatus::RUNNING &&
               after == BT::NodeStatus::IDLE && !begins_[&node]) {
      note(node, "halted");
    }
  }

  void note(const BT::TreeNode& node, const std::string& what) {
    std::string& answers = answers_[&node];
    answers += (answers.empty() ? "" : ",") + what;
  }

  std::vector<BT::TreeNode*> nodes_;
  std::map<std::string, int> uses_;
  std::map<const BT::TreeNode*, std::string> answers_;
  std::map<const BT::TreeNode*, bool> begins_;    // is in its tick
  std::map<const BT::TreeNode*, bool> answered_;  // and the status not yet set
  std::vector<BT::TreeNode::StatusChangeSubscriber> subscribers_;
};

// The log of a tree, in the file of that name. What the logger has not written
// when it is told to end is lost: it writes every 10 ms.
class Log {
 public:
  Log([[maybe_unused]] const BT::Tree& tree,
      [[maybe_unused]] const fs::path& file) {
#if HAS_LOGGER
    logger_ = std::make_unique<BT::FileLogger2>(tree, file);
#endif
  }
  ~Log() {
#if HAS_LOGGER
    std::this_thread::sleep_for(std::chrono::milliseconds(60));
#endif
  }

#if HAS_LOGGER
 private:
  std::unique_ptr<BT::FileLogger2> logger_;
#endif
};

// How many ticks, and how long after each other they begin.
struct Pace {
  int ticks = 0;
  std::chrono::milliseconds between{0};
};

std::string run(const fs::path& xml_file, const Pace& pace) {
  const std::string xml = text_of(xml_file);
  const auto beside = [&](const char* extension) {
    return text_of(fs::path(xml_file).replace_extension(extension));
  };
  BT::BehaviorTreeFactory factory;
  register_nav2_nodes(factory);
  register_leaves(factory, xml, script_in(beside(".script")),
                  contracts_in(beside(".leaves")));
  // Never destroyed, see begin_run.
  BT::Tree& tree = *new BT::Tree(factory.createTreeFromText(xml));
  const Entries entries(tree, beside(".entries"));
  Recorder& recorder = *new Recorder(tree);
  const Log log(tree, fs::path(xml_file).replace_extension(".btlog"));
  std::string text;
  const auto start = std::chrono::steady_clock::now();
  for (int t = 1; t <= pace.ticks; ++t) {
    std::this_thread::sleep_until(start + t * pace.between);
    text += "tick " + std::to_string(t) + ": root=";
    try {
      text += word_of(tick(tree));
    } catch (const std::exception& thrown) {
      std::string why = thrown.what();
      std::replace(why.begin(), why.end(), '\n', ' ');
      return text + "none, " + why + "\n";
    }
    text += entries.text();
    text += recorder.take() + "\n";
  }
  return text;
}

void write_text(const fs::path& xml_file, const std::string& text) {
  std::ofstream(fs::path(xml_file).replace_extension(".engine")) << text;
}

void write_run(const Pace& pace, const fs::path& xml_file) {
  std::string text;
  try {
    text = run(xml_file, pace);
  } catch (const std::exception& refusal) {
    text = std::string("the engine refuses: ") + refusal.what() + "\n";
  }
  write_text(xml_file, text);
}

// One tree in a process of its own, which ends without destroying it: a tree
// halts itself in its destructor, and a script of `_onHalted` may throw there.
void begin_run(const Pace& pace, const fs::path& xml_file) {
  write_text(xml_file, "the engine crashed\n");
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("cannot fork");
  if (child > 0) return;
  write_run(pace, xml_file);
  _exit(0);
}

// Many at a time, for with a clock they wait most of the time.
void run_folder(const Pace& pace, const fs::path& folder) {
  constexpr int kMostAtOnce = 16;
  int running = 0;
  for (const auto& file : fs::directory_iterator(folder)) {
    if (file.path().extension() != ".xml") continue;
    if (running == kMostAtOnce && wait(nullptr) > 0) --running;
    begin_run(pace, file.path());
    ++running;
  }
  while (wait(nullptr) > 0) continue;
}

}  // namespace

int main(int count, char** words) {
  if (count != 3 && count != 4) {
    std::cerr << "usage: run_engine TICKS DIR [MS]\n";
    return 2;
  }
  const int ms = count == 4 ? std::atoi(words[3]) : 15;
  run_folder({std::atoi(words[1]), std::chrono::milliseconds(ms)}, words[2]);
  return 0;
}
