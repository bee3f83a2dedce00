// SPDX-License-Identifier: MIT
//
// Runs without questions, and conversations.
#include "cli/simulate.hpp"

#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <variant>
#include <vector>

#include "cli/options/options.hpp"
#include "model/btf_text.hpp"
#include "model/lowering.hpp"
#include "temporary_folder.hpp"
#include "trace/run/itf.hpp"

namespace btcheck::simulate_test {
namespace {

// A tree to simulate, with its text.
struct Model {
  explicit Model(const std::string& text,
                 TickSemantics ticks = TickSemantics::Root)
      : input("tree.btf", text),
        tree(tree_of(text)),
        network(lower(tree, ticks)) {}
  SimulatedTree simulated() const { return {tree, network, input}; }

  TreeInput input;
  BehaviorTree tree;
  Network network;
};

const std::string kLook =
    "(defsv battery :states (Good Low))\n"
    "(BehaviorTree :name look (Sequence :name s\n"
    " (SetSV :ID measure :sv battery) (Action :ID photo)))\n";

// --- Runs without questions ----------------------------------------------

std::string random_lines(const Model& model, std::uint64_t seed, int ticks) {
  std::ostringstream out;
  const auto run = simulate(model.simulated(), {seed, "", ticks}, out);
  REQUIRE(run.value.has_value());
  CHECK(run.diagnostics.empty());
  return out.str();
}

std::size_t count(const std::string& text, char c) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), c));
}

TEST_CASE("a seed is a run, the same on every machine") {
  const Model drone(example("drone3.btf"));
  CHECK(random_lines(drone, 7, 9) == random_lines(drone, 7, 9));
  CHECK(random_lines(drone, 7, 9) != random_lines(drone, 2, 9));
  CHECK(random_lines(drone, 1, 9) ==
        "tick 1: root=failure fls=0 battery=Good Sequence12=failure "
        "ParallelAll13=failure start_drone=failure start_camera=success\n");
}

TEST_CASE("a run is as long as it is asked to be") {
  const Model round("(BehaviorTree :name t :loop 1 (Condition :ID c))");
  CHECK(count(random_lines(round, 3, 1), '\n') == 1);
  CHECK(count(random_lines(round, 3, 12), '\n') == 12);
  const std::string longer = random_lines(round, 3, 12);
  const std::string shorter = random_lines(round, 3, 5);
  CHECK(longer.substr(0, shorter.size()) == shorter);
}

TEST_CASE("a run ends with its tree, in words") {
  const auto ending = [](const std::string& text, int ticks) {
    const Model model(text);
    std::ostringstream out;
    const auto run = simulate(model.simulated(), {1, "", ticks}, out);
    REQUIRE(run.value.has_value());
    return ending_text(*run.value, ticks);
  };
  CHECK(ending("(defaction a :returns (success))"
               "(BehaviorTree :name t (Action :ID a))",
               5) == "t ended with success in tick 1");
  CHECK(ending("(BehaviorTree :name t :loop 1 (Condition :ID c))", 1) ==
        "stopped after 1 tick; --ticks asks for more");
  CHECK(ending("(BehaviorTree :name t :loop 1 (Condition :ID c))", 4) ==
        "stopped after 4 ticks; --ticks asks for more");
  CHECK(ending("(defsv x :max 1)"
               "(BehaviorTree :name t :loop 1 (Eval (:= x (+ x 1))))",
               5) ==
        "a fault ended the run in tick 2: an assignment out of range, or a "
        "division by zero");
  CHECK(ending("(BehaviorTree :name a (Wait :duration 1))"
               "(BehaviorTree :name b (Wait :duration 2)) (Trees a b)",
               9) ==
        "a ended with success in tick 2, b ended with success in tick 3");
}

struct Files : TemporaryFolder {
  std::string put(const std::string& name, const std::string& text) const {
    const std::string file = path() / name;
    std::ofstream(file, std::ios::binary) << text;
    return file;
  }
};

TEST_CASE("a script is a file") {
  const Files files;
  const Model model(kLook);
  const auto played = [&](const std::string& file, std::ostream& out) {
    return simulate(model.simulated(), {std::nullopt, file, 9}, out);
  };
  std::ostringstream out;
  const auto run =
      played(files.put("s.txt", "measure: Low\nphoto: running success\n"), out);
  CHECK(run.value.has_value());
  CHECK(run.diagnostics.empty());
  CHECK(out.str() ==
        "tick 1: root=running battery=Low s=running measure=success "
        "photo=running\n"
        "tick 2: root=success battery=Low s=success photo=success\n");

  std::ostringstream nothing;
  const auto wrong = played(files.put("w.txt", "foto: success\n"), nothing);
  CHECK(!wrong.value.has_value());
  REQUIRE(wrong.diagnostics.size() == 1);
  CHECK(wrong.diagnostics[0].code == "BT1401");
  const auto missing = played(files.path() / "none.txt", nothing);
  CHECK(!missing.value.has_value());
  REQUIRE(missing.diagnostics.size() == 1);
  CHECK(missing.diagnostics[0].code == "BT0002");
  CHECK(nothing.str() == "");
}

TEST_CASE("where a script asks for too much the run ends there") {
  const Files files;
  const Model model(
      "(BehaviorTree :name t (Sequence (Action :ID a :duration [2,3])"
      " (Action :ID b)))");
  std::ostringstream out;
  const auto run = simulate(
      model.simulated(),
      {std::nullopt, files.put("s.txt", "a: running failure\n"), 9}, out);
  CHECK(run.value.has_value());
  REQUIRE(run.diagnostics.size() == 1);
  CHECK(run.diagnostics[0].code == "BT1405");
  CHECK(run.diagnostics[0].message == "in tick 2 `a` cannot answer failure");
  CHECK(out.str() ==
        "tick 1: root=running Sequence1=running a=running\n"
        "tick 2: root=none Sequence1=none a=none\n");
}

TEST_CASE("a run is kept as ITF, whole") {
  const Model model(kLook);
  std::ostringstream out;
  const auto run = simulate(model.simulated(), {3, "", 9}, out);
  REQUIRE(run.value.has_value());
  const auto kept =
      read_itf("r.itf.json",
               simulated_itf(model.simulated(), run.value->run(), "seed 3"));
  REQUIRE(kept.value.has_value());
  CHECK(kept.value->property == "seed 3");
  CHECK(kept.value->verdict == "SIMULATED");
  CHECK(kept.value->source == kLook);
  CHECK(kept.value->states.size() == run.value->run().state_count());
}

// --- Conversations -------------------------------------------------------

std::string conversation(const Model& model, const std::string& typed,
                         Echo echo = Echo::Yes) {
  std::istringstream in(typed);
  std::ostringstream out;
  step_through(model.simulated(), in, out, echo);
  return out.str();
}

// What follows the heading, the tree and the word of welcome.
std::string after_welcome(const std::string& text) {
  const std::string last = "? for help.\n\n";
  const std::size_t at = text.find(last);
  REQUIRE(at != std::string::npos);
  return text.substr(at + last.size());
}

TEST_CASE("a conversation begins with the tree and ends with its input") {
  CHECK(conversation(Model(kLook), "") ==
        "t.btf: 4 nodes, 1 variable; profile paper, tick root\n"
        "    look\n"
        "      s\n"
        "        measure\n"
        "        photo\n"
        "\n"
        "A number and Enter choose what the world does, Enter alone the first; "
        "? for help.\n"
        "\n"
        "tick 1\n"
        "What does measure find?\n"
        "  1  measure: battery := Good\n"
        "  2  measure: battery := Low\n"
        "> \n");
}

TEST_CASE("a number, a word and nothing at all are answers") {
  CHECK(after_welcome(
            conversation(Model(kLook), "2\nRUNNING\n\n\nl\nq\nnever read")) ==
        "tick 1\n"
        "What does measure find?\n"
        "  1  measure: battery := Good\n"
        "  2  measure: battery := Low\n"
        "> 2\n"
        "  measure: battery := Low\n"
        "What does photo answer?\n"
        "  1  photo -> success\n"
        "  2  photo -> failure\n"
        "  3  photo -> running\n"
        "> RUNNING\n"
        "  photo -> running\n"
        "\n"
        "    look         running\n"
        "      s          running\n"
        "        measure  success\n"
        "        photo    running\n"
        "\n"
        "tick 2\n"
        "What does photo answer?\n"
        "  1  photo -> success\n"
        "  2  photo -> failure\n"
        "  3  photo -> running\n"
        "> \n"
        "  photo -> success\n"
        "  look -> success\n"
        "\n"
        "    look         success\n"
        "      s          success\n"
        "        measure  (success)\n"
        "        photo    success\n"
        "\n"
        "look ended with success in tick 2; b goes back, q quits\n"
        "> \n"
        "There is nothing to choose.\n"
        "look ended with success in tick 2; b goes back, q quits\n"
        "> l\n"
        "tick 1: root=running battery=Low s=running measure=success "
        "photo=running\n"
        "tick 2: root=success battery=Low s=success photo=success\n"
        "look ended with success in tick 2; b goes back, q quits\n"
        "> q\n");
}

TEST_CASE("what cannot be understood is said, and asked again") {
  const std::string text =
      after_welcome(conversation(Model(kLook),
                                 "0\n3\nmedium\ng ood\nb\ns\n"
                                 "r seven\n"));
  const std::string question =
      "What does measure find?\n"
      "  1  measure: battery := Good\n"
      "  2  measure: battery := Low\n";
  CHECK(text ==
        "tick 1\n" + question + "> 0\nThe choices are numbered from 1 to 2.\n" +
            question + "> 3\nThe choices are numbered from 1 to 2.\n" +
            question + "> medium\n`medium` is no command; ? lists them.\n" +
            question + "> g ood\n`g ood` is no command; ? lists them.\n" +
            question + "> b\nThis is the first choice.\n" + question +
            "> s\nWrite the name of a file after s.\n" + question +
            "> r seven\n`seven` is no seed; write for instance r 7.\n" +
            question + "> \n");
}

TEST_CASE("on a terminal nothing is written twice") {
  const std::string text =
      after_welcome(conversation(Model(kLook), "Low\nq\n", Echo::No));
  CHECK(text.find("Low\n") == text.find(":= Low\n") + 3);
  CHECK(text.find("> Low") == std::string::npos);
  CHECK(text.find(">   measure: battery := Low\n") != std::string::npos);
}

TEST_CASE("t goes on to the next tick, r at random, b back") {
  const Model model(
      "(BehaviorTree :name t :loop 1 (Sequence :name s (Action :ID a :SF 1)"
      " (Action :ID b :SF 1)))");
  const std::string text = after_welcome(
      conversation(model, "failure\nt\nb\nfailure\nb\nb\nl\nr 3\nr 3\nr\nl\n"));
  CHECK(text.find("tick 2\nWhat does a answer?") != std::string::npos);
  CHECK(text.find("> t\n  a -> success\n  b -> success\n  t -> success\n") !=
        std::string::npos);
  CHECK(text.find("> b\nback in tick 2\nWhat does b answer?") !=
        std::string::npos);
  CHECK(text.find("> b\nback in tick 2\nWhat does a answer?") !=
        std::string::npos);
  CHECK(text.find("> l\ntick 1: root=failure s=failure a=failure\n"
                  "tick 2: root=none s=none a=none\n") != std::string::npos);
  const std::string ticks = text.substr(text.rfind("> l\n"));
  CHECK(count(ticks, '\n') >= 5);
  // The same seed, the same tick.
  const std::size_t first = text.find("> r 3\n");
  const std::size_t second = text.find("> r 3\n", first + 1);
  const auto told = [&](std::size_t from) {
    return text.substr(from, text.find("\n\n", from) - from);
  };
  CHECK(told(first) == told(second));
}

TEST_CASE("where nothing is ever open the person is asked all the same") {
  const Model model(
      "(defsv x :max 1) (BehaviorTree :name t :loop 1"
      " (Eval (:= x (- 1 x))))");
  const std::string text = after_welcome(conversation(model, "\nq\n"));
  CHECK(text.find("tick 100\n") != std::string::npos);
  CHECK(text.find("Does something change before the next tick?\n"
                  "  1  tick 101 begins\n> \n") != std::string::npos);
  CHECK(text.find("  1  tick 202 begins\n> q\n") != std::string::npos);
}

TEST_CASE("a long list of choices is cut") {
  const Model model(
      "(defsv x :max 99) (BehaviorTree :name t"
      " (SetSV :ID m :sv x))");
  const std::string text = after_welcome(conversation(model, "77\n"));
  CHECK(text.find(" 20  m: x := 19\n     and so on, up to 100\n> 77\n"
                  "  m: x := 76\n") != std::string::npos);
}

TEST_CASE("a run is saved, or it is said why not") {
  const Files files;
  const std::string file = files.path() / "run.itf.json";
  const std::string text =
      conversation(Model(kLook), "low\ns " + file + "\ns /nonexistent/x\nq\n");
  CHECK(text.find("Saved: 14 steps in " + file + ".\n") != std::string::npos);
  CHECK(text.find("cannot write `/nonexistent/x`") != std::string::npos);
  std::ifstream stream(file);
  std::ostringstream kept;
  kept << stream.rdbuf();
  const auto run = read_itf("run.itf.json", kept.str());
  REQUIRE(run.value.has_value());
  CHECK(run.value->property == "by hand");
  CHECK(run.value->states.size() == 15);
}

TEST_CASE("every example can be walked through") {
  for (const std::string_view name : kExamples) {
    CAPTURE(name);
    std::string typed;
    for (int i = 0; i < 30; ++i) typed += i % 7 == 6 ? "r\n" : "\n";
    for (const TickSemantics ticks :
         {TickSemantics::Root, TickSemantics::Nodes, TickSemantics::None}) {
      const std::string text =
          conversation(Model(example(name), ticks), typed + "b\np\nl\n");
      CHECK(text.find("tick 1") != std::string::npos);
      CHECK(text.find("root=") != std::string::npos);
    }
  }
}

// --- Options -------------------------------------------------------------

std::variant<Options, Answer> parsed(const std::vector<std::string>& words) {
  std::vector<const char*> argv = {"btcheck"};
  for (const std::string& word : words) argv.push_back(word.c_str());
  return parse_options(static_cast<int>(argv.size()), argv.data());
}

std::string refusal(const std::vector<std::string>& words) {
  const auto result = parsed(words);
  REQUIRE(std::holds_alternative<Answer>(result));
  CHECK(std::get<Answer>(result).code == ExitCode::BadInput);
  const std::string& text = std::get<Answer>(result).text;
  return text.substr(0, text.find('\n'));
}

TEST_CASE("the command line says which run") {
  const auto by_hand = std::get<Options>(parsed({"simulate", "t.btf"}));
  CHECK(by_hand.command == Command::Simulate);
  CHECK(!by_hand.simulation.seed.has_value());
  CHECK(by_hand.simulation.script == "");
  const auto random = std::get<Options>(
      parsed({"simulate", "t.btf", "--seed", "18446744073709551615", "--ticks",
              "3", "-o", "r.json"}));
  CHECK(random.simulation.seed == UINT64_MAX);
  CHECK(random.simulation.ticks == 3);
  CHECK(random.output == "r.json");
  const auto scripted = std::get<Options>(
      parsed({"simulate", "t.btf", "--script", "s.txt", "--tick", "nodes"}));
  CHECK(scripted.simulation.script == "s.txt");
  CHECK(scripted.ticks == TickSemantics::Nodes);
}

TEST_CASE("what makes no run is refused") {
  CHECK(refusal({"simulate"}) == "error[BT0001]: no tree");
  CHECK(refusal({"simulate", "t.btf", "--ticks", "3"}) ==
        "error[BT0001]: --ticks needs --seed or --script");
  CHECK(refusal({"simulate", "t.btf", "-o", "f"}) ==
        "error[BT0001]: -o needs --seed or --script");
  CHECK(refusal({"simulate", "t.btf", "--seed", "1", "--script", "s"}) ==
        "error[BT0001]: a run is either random or scripted");
  CHECK(refusal({"simulate", "t.btf", "--prop", "p.ltl"}) ==
        "error[BT0001]: --prop belongs to check, lint, export, trace, run, "
        "monitor, watch, whatif and diff");
  CHECK(refusal({"t.btf", "--seed", "1"}) ==
        "error[BT0001]: --seed belongs to simulate and run");
  CHECK(refusal({"simulate", "t.btf", "--seed", "-1"}) ==
        "error[BT0001]: --seed -1: not a number that it takes");
  CHECK(refusal({"simulate", "t.btf", "--seed", "1", "--ticks", "0"})
            .find("--ticks") != std::string::npos);
}

}  // namespace
}  // namespace btcheck::simulate_test
