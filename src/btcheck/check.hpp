// SPDX-License-Identifier: MIT
//
// Trees and rules, checked in memory: the header of btcheck::check for other
// people's programs. It needs the standard library alone.
//
//     btcheck::v1::Files files;
//     files.add("patrol.xml", text);
//     btcheck::v1::Request request;
//     request.tree = "patrol.xml";
//     const auto report = btcheck::v1::check(request, files);
//     for (const auto& finding : report.findings) {
//       show(finding.where.file, finding.where.line, finding.message);
//     }
//
// A call reads no file, no environment and no clock but the steady one, writes
// nothing and keeps nothing: calls in several threads know nothing of each
// other. What is wrong with a tree or its rules is a finding; what is wrong
// with the call itself, a profile that does not exist, throws
// std::invalid_argument. Version 1 of this interface stays as it is: names are
// added, and a change of meaning is a namespace of its own.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace btcheck::v1 {

// --- What goes in ---------------------------------------------------------

struct NamedText {
  std::string name;
  std::string text;
};

// Where texts come from. Asked by the thread that called, while the call lasts.
class Sources {
 public:
  virtual ~Sources() = default;

  // The text of a file; nothing where there is none. An <include path="b.xml">
  // in "trees/a.xml" asks for "trees/b.xml".
  virtual std::optional<std::string> text(const std::string& name) = 0;

  // The files that the program registers beside the tree's: their trees may be
  // used without an <include>, and their models count.
  virtual std::vector<std::string> files() { return {}; }

  // The share folder of a ROS package, for <include ros_pkg="...">; "" where
  // there is none.
  virtual std::string package(const std::string& /*name*/) { return {}; }

  // The name of the file that has a tree which is in none of files(); "" where
  // there is none.
  virtual std::string file_with_tree(const std::string& /*id*/) { return {}; }

  // The btcheck.toml that holds for a tree; nothing where there is none. It
  // says what the request does not: profile, length of a tick, models,
  // contracts; and which findings are meant, or are errors. What it names lies
  // beside it.
  virtual std::optional<NamedText> settings(const std::string& /*tree*/) {
    return std::nullopt;
  }
};

// Texts by their names. All of them are files of the program. Settings are the
// `btcheck.toml` in the folder of the tree, or the next one above it.
class Files final : public Sources {
 public:
  void add(std::string name, std::string text);
  void add_package(std::string name, std::string folder);

  std::optional<std::string> text(const std::string& name) override;
  std::vector<std::string> files() override;
  std::string package(const std::string& name) override;
  std::optional<NamedText> settings(const std::string& tree) override;

 private:
  std::map<std::string, std::string> texts_;
  std::map<std::string, std::string> packages_;
};

struct Request {
  std::string tree;                // the name of a file: XML, or .btf
  std::vector<std::string> rules;  // names of files of rules
  // Rules as on a command line: "never dock.failure".
  std::vector<std::string> typed_rules;
  std::vector<std::string> leaves;  // names of files of contracts
  std::vector<std::string> models;  // names of files with <TreeNodesModel>
  std::string profile;              // "nav2-jazzy"; "": as the files say
  std::string main_tree;            // its ID; "": as the file says
  std::string ticks;  // where time passes: root, leaves, nodes, none; "": root,
                      // or as the rules say
  int tick_milliseconds = 0;  // what one tick of the root takes; 0: as the
                              // settings say, else 100
  bool loops = false;         // ticked again after it has ended
  bool wake_ups = false;      // ticked by tickOnce
  bool tries_repairs = true;  // a checked change beside findings
  // All files() belong to one program. False, as for a command that is given
  // one file of a folder: models in files with trees of their own do not count.
  bool is_one_program = true;
  // Absolute: where names that are not absolute begin. "": nobody says.
  std::string directory;
  unsigned threads = 1;

  // 0: no limit. Seconds count from the call, through all that is done.
  double seconds = 0;
  std::uint64_t states = 0;
  std::uint64_t bytes = 0;  // of what a search stores
};

struct Progress {
  std::uint64_t states = 0;       // stored by a search, 0 outside one
  std::uint64_t transitions = 0;  // taken by it
  double seconds = 0;             // since the call
};

// Asked by the threads of the call, a hundred times a second or more. Must not
// throw; what a source throws leaves the call.
class Monitor {
 public:
  virtual ~Monitor() = default;
  // False ends the call within a tenth of a second: what is known then is in
  // the report.
  virtual bool goes_on(const Progress& progress) = 0;
};

// --- What comes out -------------------------------------------------------

enum class Level : std::uint8_t { Note, Warning, Error };
enum class Verdict : std::uint8_t { Holds, Violated, Undecided };

// As the exit codes of the program.
enum class Outcome : std::uint8_t {
  Met = 0,        // every rule is as expected; without rules: no fault
  Missed = 1,     // some rule is not, or a finding is an error
  BadInput = 2,   // nothing was checked
  Undecided = 3,  // a limit was reached, and nothing is violated
  Internal = 4    // a mistake of btcheck
};

// Lines and columns count from 1, columns and lengths in code points. Line 0:
// the file as a whole.
struct Position {
  std::string file;
  std::size_t line = 0;
  std::size_t column = 0;
  std::size_t length = 0;
};

struct Step {
  std::string text;        // "tick 2 begins", "dock -> failure"
  int time = 0;            // units of time since the beginning: ticks, mostly
  bool is_chosen = false;  // by the world outside, not by the tree
  Position where;
};

struct Run {
  std::vector<Step> steps;
  // Of an endless run: the number of the step with which its loop begins.
  std::optional<std::size_t> loop;
  // By which Report::html knows it: that of its rule, the key of its answer,
  // "BT2208-RecoveryActions" of a finding, as the files of --trace-dir. "":
  // there is no page.
  std::string name;
};

// Lines [first, first + removed) of a file become `added`.
struct Change {
  std::string file;
  std::size_t first = 1;
  std::size_t removed = 0;
  std::vector<std::string> added;
};

struct Finding {
  std::string code;  // "BT2208"; explain() says what it means. BT25xx
                     // are questions that the owner of the tree can answer
  Level level = Level::Warning;
  std::string message;  // its first line is a sentence that stands alone
  std::string help;     // what to do about it; "" where nothing is known
  Position where;
  std::string node;  // names from the root down to the node; "" for none
  std::optional<Run> run;
  // With these made the finding is gone, and nothing else breaks: all was
  // checked again. Empty where there is no such change.
  std::vector<Change> repair;
};

struct Rule {
  std::string name;
  std::string text;
  Position where;
  Verdict verdict = Verdict::Undecided;
  bool is_met = true;       // the verdict is what the file expects
  bool is_vacuous = false;  // it holds because it is never asked
  std::string note;         // how the verdict came about: "after 2 ticks"
  std::string reason;       // why it is violated
  std::optional<Run> run;   // that shows it
};

// Of a tree without rules: a question about the mission as a whole.
struct Answer {
  std::string key;       // "can_succeed"
  std::string question;  // "the mission can succeed"
  std::string answer;    // "yes, e.g. in tick 1"
  Verdict verdict = Verdict::Undecided;
  bool is_fault = false;
  std::optional<Run> run;  // that shows it
};

// Of a tree without rules: what is proven of a node. Nothing where nodes of its
// type can never do it.
struct Node {
  std::string name;  // unique, as rules have it
  std::string type;
  Position where;
  std::optional<Verdict> is_ticked;  // Holds: some run has it
  std::optional<Verdict> succeeds;
  std::optional<Verdict> fails;
  std::optional<Verdict> runs;
  std::optional<Verdict> is_halted;
  std::optional<Verdict> is_skipped;
};

class Report {
 public:
  Outcome outcome = Outcome::Met;
  std::string tree;
  std::string profile;  // that was used; "" where nothing was checked
  std::size_t node_count = 0;
  std::size_t variable_count = 0;
  std::uint64_t states = 0;  // the most that a search has stored
  std::string stopped;       // "timeout", "max-states", ...; "" for no limit
  std::vector<Finding> findings;
  // Findings that are not told: a comment at the node or the settings allow
  // them.
  std::size_t allowed = 0;
  std::vector<Rule> rules;
  std::vector<Answer> answers;
  std::vector<Node> nodes;
  double seconds = 0;

  // The report as `btcheck --format json` and `--format sarif` print it.
  std::string json() const;
  std::string sarif() const;
  // All runs by their names.
  std::string runs_json() const;
  // The page that shows the run of that name, one file for any browser; "" for
  // a name that no run has.
  std::string html(std::string_view name) const;

  // For check() and lint().
  struct Whole;
  std::shared_ptr<const Whole> whole;
};

// --- A tree described -------------------------------------------------------

enum class Direction : std::uint8_t { Unknown, Input, Output, Both };

struct Port {
  std::string name;
  Direction direction = Direction::Unknown;
  std::string type;                   // "int"; "" where nobody tells it
  std::optional<std::string> value;   // as written; nothing where it is not
  std::optional<std::string> preset;  // what it is where nothing is written
  std::string about;                  // what it is for; "" where nobody says
  std::string entry;                  // that the value points at: "goal"
  Position where;                     // of the value
};

// A node as its files have it. A subtree that is used twice has its nodes
// twice.
struct DescribedNode {
  std::string name;   // unique, as that of a Node in a report
  std::string label;  // as its author calls it
  std::string type;   // as it is registered: "RetryUntilSuccessful"
  std::string kind;   // Tree, Control, Decorator, Action, Condition, SubTree
  std::string about;  // what it does, in a sentence
  Position where;
  std::size_t parent = 0;  // a number in `nodes`; of the first node its own
  std::vector<Port> ports;
  std::vector<std::size_t> reads;  // numbers in `entries`
  std::vector<std::size_t> writes;
};

// An entry of a blackboard, or a state variable of a .btf tree. Two subtrees
// may each have an entry of the same name.
struct Entry {
  std::string name;
  std::vector<std::string> values;   // that are told apart, where they are few
  std::vector<std::size_t> writers;  // numbers in `nodes`
  std::vector<std::size_t> readers;
};

struct Description {
  Outcome outcome = Outcome::Met;  // BadInput: the tree could not be read
  std::string tree;
  std::string profile;
  std::vector<Finding> findings;     // of reading
  std::vector<DescribedNode> nodes;  // a parent before its children
  std::vector<Entry> entries;

  // All of it as one object.
  std::string json() const;
};

// --- One run of a tree ------------------------------------------------------

// What decides where the tree leaves something open, as `btcheck simulate` has
// it: chance, or a script of answers.
struct Plan {
  std::optional<std::uint64_t> seed;  // the same seed: the same run everywhere
  // Without a seed: the name of a file of answers. "": each leaf answers the
  // first that it can.
  std::string script;
  int ticks = 100;  // where the run stops
};

enum class Ending : std::uint8_t {
  Ended,    // the tree has succeeded or failed, and is not ticked again
  Fault,    // an assignment out of range, or a division by zero
  Stuck,    // no node can go on
  Ticks,    // all that were asked for
  Stopped,  // by a limit or the monitor
  Refused   // the script asks for what the tree cannot do: a finding says what
};

struct Value {
  std::string name;
  std::string value;
};

class Simulation {
 public:
  // Met; BadInput: there was no run, or the script was refused; Missed: what is
  // a warning is to be an error; Undecided: a limit was reached.
  Outcome outcome = Outcome::Met;
  std::string tree;
  std::string profile;
  std::vector<Finding> findings;
  std::optional<Run> run;
  std::vector<std::string> lines;  // of ticks, as the program prints them
  Ending ending = Ending::Stopped;
  std::string end;               // "t ended with success in tick 3"
  int ticks = 0;                 // begun by the tree that has begun most
  std::vector<Value> variables;  // in the last state, as declared
  std::vector<Value> statuses;   // of the nodes, there

  // All of it as one object.
  std::string json() const;
  // The run as `btcheck simulate -o` writes it, and as a page; "" where there
  // was none.
  std::string itf() const;
  std::string html() const;

  // For simulate().
  struct Whole;
  std::shared_ptr<const Whole> whole;
};

// Rules as data, for btcheck/observer.hpp in the program that runs the tree.
struct RuleTable {
  Outcome outcome = Outcome::Met;  // BadInput: there is none
  std::vector<Finding> findings;
  std::string text;
};

struct Explanation {
  std::string code;
  std::string summary;      // a few words
  std::string description;  // whole sentences
  std::string help;         // what to do about it

  // All of it as one object.
  std::string json() const;
};

// --- Calls ----------------------------------------------------------------

Report check(const Request& request, Sources& sources,
             Monitor* monitor = nullptr);

// Reads the tree and its rules, and searches nothing.
Report lint(const Request& request, Sources& sources,
            Monitor* monitor = nullptr);

// Reads the tree alone, and says what its files tell of each node. Rules are
// not read. What a check has proven of a node is in Report::nodes by the same
// name.
Description describe(const Request& request, Sources& sources,
                     Monitor* monitor = nullptr);

// One run. Rules are not read. A tick that does not return goes on until a
// limit or the monitor ends it, and then the run is told as far as it went: the
// longer it is, the longer that takes.
Simulation simulate(const Request& request, const Plan& plan, Sources& sources,
                    Monitor* monitor = nullptr);

// The rules of one file, or the typed ones, as what watches a run of the tree
// (docs/robots.md). Refused is what no run shows.
RuleTable monitor_table(const Request& request, Sources& sources,
                        Monitor* monitor = nullptr);

// Nothing for a code that does not exist.
std::optional<Explanation> explain(std::string_view code);

// "0.1.0".
std::string_view version();

}  // namespace btcheck::v1
