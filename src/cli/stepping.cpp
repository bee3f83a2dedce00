// SPDX-License-Identifier: MIT
//
// A conversation: what has happened since the last question, the tree when a
// tick is over, a question with its answers, a line read. Where there is only
// one answer none is asked for. An empty line takes the first answer, so Enter
// alone walks a tree in which everything goes well.
#include <fmt/format.h>

#include <algorithm>
#include <istream>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "cli/inputs/files.hpp"
#include "cli/options/interface.hpp"
#include "cli/simulate.hpp"
#include "model/tree/node_types.hpp"
#include "report/text/report.hpp"
#include "trace/formats/text.hpp"
#include "trace/run/record.hpp"

namespace btcheck {
namespace {

constexpr std::size_t kMostListed = 20;  // choices of one question
// After so many ticks without a choice, the person is asked all the same.
constexpr int kMostTicksUnasked = 100;

constexpr std::string_view kHelp =
    R"(  NUMBER    take this choice; Enter takes the first
  WORD      take the choice that ends with it: success, Low
  t         on to the next tick, always taking the first
  r [SEED]  on to the next tick at random
  b         back to the choice before
  p         the whole tree, and what its nodes do
  l         the ticks so far, a line for each
  s FILE    save the run as ITF JSON, for btcheck trace
  q         quit
)";

std::string trimmed(const std::string& line) {
  const std::size_t first = line.find_first_not_of(" \t\r");
  if (first == std::string::npos) return {};
  return line.substr(first, line.find_last_not_of(" \t\r") - first + 1);
}

class Session {
 public:
  Session(const SimulatedTree& simulated, std::istream& in, std::ostream& out,
          Echo echo)
      : simulated_(simulated),
        tree_(simulated.tree),
        simulation_(simulated.tree, simulated.network, Interleaving::Open),
        in_(in),
        out_(out),
        echo_(echo) {}

  void run() {
    begin();
    go_to_question();
    while (true) {
      ask();
      const std::optional<std::string> line = read();
      if (!line || obey(*line) == GoOn::Quit) return;
    }
  }

 private:
  enum class GoOn : unsigned char { Ask, Quit };

  void begin() {
    out_ << fmt::format(
        "{}: {}, {}; profile {}, tick {}\n", tree_.file,
        counted(tree_.nodes.size(), "node", "nodes"),
        counted(tree_.variables.size(), "variable", "variables"),
        profile_name(tree_.profile),
        btcheck::tick_name(simulated_.network.ticks));
    show_tree(0, Folding::None);
    out_ << "\nA number and Enter choose what the world does, Enter alone the "
            "first; ? for help.\n\n";
    tell_latest();
  }

  void go_to_question() {
    int ticks = 0;
    while (!is_question() && !simulation_.choices().empty()) {
      const ChoiceKind kind = simulation_.choices()[0].kind;
      if (kind == ChoiceKind::Move) return;
      if (kind == ChoiceKind::Tick && ++ticks > kMostTicksUnasked) return;
      take(0);
    }
  }

  bool is_question() const { return simulation_.choices().size() > 1; }

  void take(std::size_t choice) {
    has_chosen_ |= is_question();
    simulation_.take(choice);
    tell_latest();
  }

  void tell_latest() {
    simulation_.for_each_latest(
        [&](const Valuation& before, const RunStep& step) {
          ++steps_;
          tell(before, step);
        });
  }

  // The beginning and the end of a tick, and what happens in between.
  void tell(const Valuation& before, const RunStep& step) {
    if (step.step.edge == kTimeStep) return;
    const Automaton& mover = simulated_.network.owner_of_edge(step.step.edge);
    const Edge& edge = simulated_.network.edge(step.step.edge);
    const bool is_root =
        mover.kind == AutomatonKind::Node && tree_.node(mover.node).is_root();
    if (is_root && mover.source(edge).role == LocationRole::Tick) {
      out_ << tick_name(mover.node, simulation_.ticks(mover.node)) << '\n';
    }
    if (const auto event = event_of(tree_, simulated_.network, before, step)) {
      out_ << "  " << event->text << '\n';
    }
    if (is_root && is_answer(mover.target(edge).role)) end_tick();
  }

  // The tree is shown after a tick in which something was chosen.
  void end_tick() {
    if (has_chosen_) {
      out_ << '\n';
      show_tree(steps_, Folding::Unvisited);
      out_ << '\n';
    }
    has_chosen_ = false;
  }

  void ask() {
    if (simulation_.choices().empty()) {
      out_ << ending_text(simulation_, 0) << "; b goes back, q quits\n";
      return;
    }
    if (simulation_.end() != RunEnd::None) {
      out_ << ending_text(simulation_, 0) << '\n';
    }
    out_ << question();
  }

  // The question, and its answers by number.
  std::string question() const {
    const auto choices = simulation_.choices();
    const SimulationChoice& first = choices[0];
    bool is_about_one = true;
    for (const SimulationChoice& choice : choices) {
      is_about_one &=
          choice.kind == first.kind || choice.kind == ChoiceKind::Due;
      is_about_one &= first.kind != ChoiceKind::Answer ||
                      choice.kind != ChoiceKind::Answer ||
                      mover_of(choice) == mover_of(first);
    }
    const bool is_order = !is_about_one && (first.kind == ChoiceKind::Answer ||
                                            first.kind == ChoiceKind::Tree);
    std::string text =
        (is_order ? "What comes first?" : question_about(first)) + '\n';
    for (std::size_t i = 0; i < choices.size() && i < kMostListed; ++i) {
      text += fmt::format("{:>3}  {}\n", i + 1, choice_text(choices[i]));
    }
    if (choices.size() > kMostListed) {
      text += fmt::format("     and so on, up to {}\n", choices.size());
    }
    return text;
  }

  std::string question_about(const SimulationChoice& first) const {
    switch (first.kind) {
      case ChoiceKind::Tick:
        return "Does something change before the next tick?";
      case ChoiceKind::Time:
      case ChoiceKind::Move:
        return "What else happens?";
      case ChoiceKind::Due:
      case ChoiceKind::Tree:
        return "What comes first?";
      case ChoiceKind::World:
        return fmt::format("What holds at {}?",
                           short_name(tree_, mover_of(first)));
      case ChoiceKind::Answer:
        break;
    }
    const NodeId leaf = mover_of(first);
    const std::string name = short_name(tree_, leaf);
    return tree_.node(leaf).type == NodeType::SetSV
               ? fmt::format("What does {} find?", name)
               : fmt::format("What does {} answer?", name);
  }

  std::string choice_text(const SimulationChoice& choice) const {
    if (choice.kind == ChoiceKind::Time) return std::string(kTimePasses);
    if (choice.kind == ChoiceKind::Tick) {
      const NodeId root = mover_of(choice);
      return tick_name(root, simulation_.ticks(root) + 1) + " begins";
    }
    const RunStep step{choice.step, simulation_.after(choice)};
    const auto event =
        event_of(tree_, simulated_.network, simulation_.state(), step);
    return event ? event->text : step_text(simulated_.network, step);
  }

  std::string tick_name(NodeId root, int number) const {
    std::string name = fmt::format("tick {}", number);
    if (tree_.roots.size() > 1) {
      name += fmt::format(" of {}", tree_.node(root).name);
    }
    return name;
  }

  std::optional<std::string> read() {
    out_ << "> " << std::flush;
    std::string line;
    if (!std::getline(in_, line)) {
      out_ << '\n';
      return std::nullopt;
    }
    line = trimmed(line);
    if (echo_ == Echo::Yes) out_ << line << '\n';
    return line;
  }

  GoOn obey(const std::string& line) {
    const std::string word = line.substr(0, line.find_first_of(" \t"));
    const std::string rest = trimmed(line.substr(word.size()));
    if (word == "q") return GoOn::Quit;
    if (word == "s") {
      save(rest);
    } else if (word == "r") {
      go_at_random(rest);
    } else if (!rest.empty()) {
      answer(line);
    } else if (word == "t") {
      go_to_next_tick([] { return std::size_t{0}; });
    } else if (word == "b") {
      go_back();
    } else if (word == "p") {
      show_tree(steps_, Folding::None);
    } else if (word == "l") {
      out_ << tick_lines(tree_, simulated_.network, simulation_.run());
    } else if (word == "?" || word == "h" || word == "help") {
      out_ << kHelp;
    } else {
      answer(line);
    }
    return GoOn::Ask;
  }

  void answer(const std::string& line) {
    const auto choices = simulation_.choices();
    if (choices.empty()) {
      out_ << "There is nothing to choose.\n";
      return;
    }
    if (line.empty()) return choose(0);
    if (const auto number = whole_number(line)) {
      if (*number >= 1 && *number <= choices.size()) return choose(*number - 1);
      out_ << fmt::format("The choices are numbered from 1 to {}.\n",
                          choices.size());
      return;
    }
    std::vector<std::size_t> fitting;
    for (std::size_t i = 0; i < choices.size(); ++i) {
      const std::string text = choice_text(choices[i]);
      const std::string last = text.substr(text.find_last_of(' ') + 1);
      if (equal_ignoring_case(last, line)) fitting.push_back(i);
    }
    if (fitting.size() == 1) return choose(fitting[0]);
    out_ << (fitting.empty()
                 ? fmt::format("`{}` is no command; ? lists them.\n", line)
                 : fmt::format("{} choices end with `{}`; type a number.\n",
                               fitting.size(), line));
  }

  void choose(std::size_t number) {
    take(number);
    go_to_question();
  }

  template <class Choose>
  void go_to_next_tick(Choose choose) {
    if (simulation_.end() != RunEnd::None) {
      out_ << "There is no next tick.\n";
      return;
    }
    do {
      take(choose());
    } while (simulation_.end() == RunEnd::None &&
             simulation_.choices()[0].kind != ChoiceKind::Move &&
             !begins_next_tick());
    go_to_question();
  }

  void go_at_random(const std::string& seed) {
    if (!seed.empty()) {
      const auto number = whole_number(seed);
      if (!number) {
        out_ << fmt::format("`{}` is no seed; write for instance r 7.\n", seed);
        return;
      }
      random_ = SplitMix64(*number);
    }
    go_to_next_tick(
        [&] { return random_choice(simulation_.choices(), random_); });
  }

  // A root is about to begin a tick that none has begun.
  bool begins_next_tick() const {
    const SimulationChoice& first = simulation_.choices()[0];
    if (first.kind != ChoiceKind::Tick) return false;
    return simulation_.ticks(mover_of(first)) == most_ticks(simulation_);
  }

  void go_back() {
    if (!simulation_.back()) {
      out_ << "This is the first choice.\n";
      return;
    }
    steps_ = simulation_.run().steps.size();
    has_chosen_ = true;
    out_ << fmt::format("back in tick {}\n", most_ticks(simulation_));
  }

  void save(const std::string& file) {
    if (file.empty()) {
      out_ << "Write the name of a file after s.\n";
      return;
    }
    const std::string complaint =
        keep_run(file, simulated_, simulation_.run(), "by hand");
    out_ << (complaint.empty()
                 ? fmt::format("Saved: {} steps in {}.\n", steps_, file)
                 : complaint + ".\n");
  }

  void show_tree(std::size_t state, Folding folding) {
    RunHeading heading;
    const RecordedRun run =
        recorded(tree_, simulated_.network, simulation_.run(), heading);
    const std::string text = tree_text(run, state, folding);
    for (std::size_t begin = 0; begin < text.size();) {
      const std::size_t end = text.find('\n', begin);
      out_ << "    " << text.substr(begin, end - begin) << '\n';
      begin = end + 1;
    }
  }

  NodeId mover_of(const SimulationChoice& choice) const {
    return simulated_.network.owner_of_edge(choice.step.edge).node;
  }

  const SimulatedTree& simulated_;
  const BehaviorTree& tree_;
  Simulation simulation_;
  SplitMix64 random_{1};
  std::istream& in_;
  std::ostream& out_;
  Echo echo_;
  std::size_t steps_ = 0;    // of the run so far
  bool has_chosen_ = false;  // among several, in this tick
};

}  // namespace

void step_through(const SimulatedTree& simulated, std::istream& in,
                  std::ostream& out, Echo echo) {
  Session(simulated, in, out, echo).run();
}

}  // namespace btcheck
