// SPDX-License-Identifier: MIT
//
// Rules that watch a run of a behavior tree: C++17, the standard library and
// nothing else.
//
// A Table is what `btcheck export TREE --prop RULES --to monitor` writes: the
// nodes of the tree and each rule as an automaton. A Monitor is told what the
// nodes do and says of each rule, at the earliest moment, whether it is
// satisfied or violated whatever comes (docs/monitors.md). Nothing is allocated
// after its construction; what an event costs depends on the rules that speak
// of that node.
//
// One thread at a time may tell it something; any thread may ask.
#pragma once

// What `btcheck export --to monitor-cpp` writes into one header begins here.
#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace btcheck {
namespace monitor {

// The numbers of BehaviorTree.CPP.
enum class Status : std::uint8_t { Idle, Running, Success, Failure, Skipped };
inline const char* status_name(Status status) {
  constexpr const char* kNames[] = {"IDLE", "RUNNING", "SUCCESS", "FAILURE",
                                    "SKIPPED"};
  return kNames[static_cast<std::size_t>(status)];
}

enum class Verdict : std::uint8_t { Open, Satisfied, Violated, Excluded };
inline const char* verdict_name(Verdict verdict) {
  constexpr const char* kNames[] = {"OPEN", "SATISFIED", "VIOLATED",
                                    "EXCLUDED"};
  return kNames[static_cast<std::size_t>(verdict)];
}

// A node of the tree that runs, as its program knows it.
struct RunningNode {
  std::size_t parent = 0;  // its number
  std::string name;
  std::string type;  // as it is registered
};

// Another tree runs than the one that the rules were written for.
class WrongTree : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// A text that is no table, or a damaged one.
class WrongTable : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// --- Values of entries -----------------------------------------------------

// What an entry of a blackboard holds.
struct EntryValue {
  enum Kind : std::uint8_t { Unset, NoValue, Integer, Real, Text, Other };
  Kind kind = Unset;
  std::int64_t integer = 0;
  double real = 0;
  std::string text = {};

  bool is_number() const { return kind == Integer || kind == Real; }
  double number() const {
    return kind == Integer ? static_cast<double>(integer) : real;
  }
  friend bool operator==(const EntryValue& one, const EntryValue& other) {
    if (one.kind != other.kind) return false;
    if (one.kind == Integer) return one.integer == other.integer;
    if (one.kind == Real) {
      return one.real == other.real ||
             (std::isnan(one.real) && std::isnan(other.real));
    }
    return one.kind != Text || one.text == other.text;
  }
  friend bool operator!=(const EntryValue& one, const EntryValue& other) {
    return !(one == other);
  }
};

// --- The table -------------------------------------------------------------

struct Table {
  struct Node {
    std::string name;
    std::string id;    // what it is called where it has no name
    std::string type;  // "": a program may register it as it likes
    std::size_t parent = 0;
    bool is_leaf = false;
  };
  // A value of an entry as far as the rules tell it from others: a number from
  // `low` to `high`, a text by its word, any other text; or an entry that is
  // not there, holds nothing, or something else.
  struct Region {
    enum Kind : std::uint8_t { Numbers, Text, AnyText, Unset, NoValue, Other };
    Kind kind = Other;
    double low = 0;
    double high = 0;
    std::string text = {};
  };
  // It is looked up where that node looks, by its key.
  struct Entry {
    std::string name;  // as rules have it
    std::size_t node = 0;
    std::string key;
    std::vector<Region> regions;  // the first that fits is meant
  };
  enum class SlotKind : std::uint8_t {
    Location,
    LastStatus,
    Called,
    Answer,
    Remembered,
    Entry
  };
  struct Slot {
    SlotKind kind = SlotKind::Location;
    std::size_t of = 0;  // a node, or an entry
  };
  enum class Code : std::uint8_t {
    Constant,
    Slot,
    Add,
    Subtract,
    Multiply,
    Divide,
    Modulo,
    Negate,
    Equal,
    NotEqual,
    Less,
    LessEqual,
    Greater,
    GreaterEqual,
    And,
    Or,
    Not
  };
  // In postfix order.
  struct Term {
    Code code = Code::Constant;
    std::int32_t operand = 0;
  };
  enum class PastKind : std::uint8_t { Once, Since, Previously };
  // What it is; the slot that shows it; its conditions.
  struct Past {
    PastKind kind = PastKind::Once;
    std::size_t slot = 0;
    std::size_t held = 0;
    std::size_t began = 0;
  };
  // Bit i of a letter is condition bits[i], or, -1, that a unit of time has
  // passed.
  struct Rule {
    std::string name;
    std::string text;
    std::vector<int> bits;
    std::vector<std::uint8_t> outlook;  // by state
    std::vector<std::uint32_t> next;    // by state, then letter
  };

  std::string tree;   // the file
  std::string rules;  // the file
  std::vector<Node> nodes;
  std::vector<Entry> entries;
  std::vector<Slot> slots;
  std::vector<std::vector<Term>> conditions;
  std::vector<Past> past;
  std::vector<Rule> automata;

  static constexpr std::string_view kHeading = "btcheck-monitor 1";

  // Throws WrongTable, with the line.
  static Table read(std::string_view text);

  // The first node of these, in pre-order and without the tree itself, that is
  // not as the table has it: throws WrongTree.
  void require(const std::vector<RunningNode>& running) const;
};

// FNV-1a of 64 bits.
inline std::uint64_t fingerprint(std::string_view text) {
  std::uint64_t hash = 0xcbf29ce484222325U;
  for (const char c : text) {
    hash ^= static_cast<unsigned char>(c);
    hash *= 0x100000001b3U;
  }
  return hash;
}

// Words and texts in quotes, line by line.
class TableReader {
 public:
  explicit TableReader(std::string_view text) : text_(text) {}

  Table read() {
    Table table;
    if (text_.substr(0, Table::kHeading.size()) != Table::kHeading) {
      throw WrongTable(
          "btcheck: this is no table of rules; `btcheck export` writes one "
          "(docs/robots.md)");
    }
    check_fingerprint();
    at_ = Table::kHeading.size();
    keyword("tree");
    table.tree = quoted();
    keyword("rules");
    table.rules = quoted();
    const std::size_t nodes = count("nodes");
    for (std::size_t i = 0; i < nodes; ++i) table.nodes.push_back(node(i));
    if (nodes == 0) refuse("no nodes");
    const std::size_t entries = count("entries");
    for (std::size_t i = 0; i < entries; ++i) {
      table.entries.push_back(entry(nodes));
    }
    const std::size_t slots = count("slots");
    for (std::size_t i = 0; i < slots; ++i) {
      table.slots.push_back(slot(nodes, entries));
    }
    const std::size_t conditions = count("conditions");
    for (std::size_t i = 0; i < conditions; ++i) {
      table.conditions.push_back(condition(slots));
    }
    const std::size_t past = count("past");
    for (std::size_t i = 0; i < past; ++i) {
      table.past.push_back(past_of(slots, conditions));
    }
    const std::size_t automata = count("automata");
    for (std::size_t i = 0; i < automata; ++i) {
      table.automata.push_back(rule(conditions));
    }
    keyword("end");
    return table;
  }

 private:
  static constexpr std::size_t kMost = 16'000'000;

  [[noreturn]] void refuse(const std::string& what) const {
    const auto lines =
        std::count(text_.begin(),
                   text_.begin() +
                       static_cast<std::ptrdiff_t>(std::min(at_, text_.size())),
                   '\n');
    throw WrongTable("btcheck: a damaged table of rules, line " +
                     std::to_string(lines + 1) + ": " + what);
  }

  // Its last line is `end` and the fingerprint of all before it.
  void check_fingerprint() {
    const std::size_t end = text_.rfind("\nend ");
    if (end == std::string_view::npos) {
      at_ = text_.size();
      refuse("it has no end");
    }
    const std::uint64_t said = std::strtoull(
        std::string(text_.substr(end + 5, 16)).c_str(), nullptr, 16);
    if (said != fingerprint(text_.substr(0, end + 1))) {
      refuse("it is not as btcheck has written it");
    }
  }

  bool is_at_blank() const { return text_[at_] == ' ' || text_[at_] == '\n'; }
  void skip_blanks() {
    while (at_ < text_.size() && is_at_blank()) ++at_;
  }

  std::string_view word() {
    skip_blanks();
    const std::size_t begin = at_;
    while (at_ < text_.size() && !is_at_blank()) ++at_;
    return text_.substr(begin, at_ - begin);
  }

  void keyword(std::string_view expected) {
    if (word() != expected) refuse("`" + std::string(expected) + "` expected");
  }

  long long integer(long long least, long long most) {
    const std::string text(word());
    char* end = nullptr;
    const long long value = std::strtoll(text.c_str(), &end, 10);
    if (text.empty() || *end != '\0' || value < least || value > most) {
      refuse("`" + text + "` is no number that can stand here");
    }
    return value;
  }
  std::size_t number(std::size_t below) {
    if (below == 0) refuse("nothing can stand here");
    return static_cast<std::size_t>(
        integer(0, static_cast<long long>(below) - 1));
  }
  std::size_t count(std::string_view name) {
    keyword(name);
    return number(kMost);
  }
  double real() {
    const std::string text(word());
    char* end = nullptr;
    const double value = std::strtod(text.c_str(), &end);
    if (text.empty() || *end != '\0') refuse("`" + text + "` is no number");
    return value;
  }

  // `\022` for a byte that cannot stand as it is.
  std::string quoted() {
    skip_blanks();
    if (at_ >= text_.size() || text_[at_] != '"') refuse("`\"` expected");
    std::string result;
    for (++at_; at_ < text_.size() && text_[at_] != '"'; ++at_) {
      if (text_[at_] != '\\') {
        result += text_[at_];
        continue;
      }
      if (at_ + 3 >= text_.size()) refuse("a text that does not end");
      int code = 0;
      for (int i = 0; i < 3; ++i) code = code * 8 + (text_[++at_] - '0');
      result += static_cast<char>(code);
    }
    if (at_ >= text_.size()) refuse("a text that does not end");
    ++at_;
    return result;
  }

  template <class Names_>
  std::size_t choice(const Names_& names) {
    const std::string_view chosen = word();
    for (std::size_t i = 0; i < std::size(names); ++i) {
      if (chosen == names[i]) return i;
    }
    refuse("`" + std::string(chosen) + "` is not known here");
  }

  Table::Node node(std::size_t index) {
    Table::Node node;
    node.parent = number(index == 0 ? 1 : index);
    node.is_leaf = number(2) == 1;
    node.name = quoted();
    node.id = quoted();
    node.type = quoted();
    return node;
  }

  Table::Entry entry(std::size_t nodes) {
    Table::Entry entry;
    entry.name = quoted();
    entry.node = number(nodes);
    entry.key = quoted();
    const std::size_t regions = number(kMost);
    constexpr const char* kKinds[] = {"numbers", "text",     "any_text",
                                      "unset",   "no_value", "other"};
    for (std::size_t i = 0; i < regions; ++i) {
      Table::Region region;
      region.kind = static_cast<Table::Region::Kind>(choice(kKinds));
      if (region.kind == Table::Region::Numbers) {
        region.low = real();
        region.high = real();
      }
      if (region.kind == Table::Region::Text) region.text = quoted();
      entry.regions.push_back(std::move(region));
    }
    if (regions == 0) refuse("an entry without values");
    return entry;
  }

  Table::Slot slot(std::size_t nodes, std::size_t entries) {
    constexpr const char* kKinds[] = {"location", "last_status", "called",
                                      "answer",   "remembered",  "entry"};
    Table::Slot slot;
    slot.kind = static_cast<Table::SlotKind>(choice(kKinds));
    slot.of = number(slot.kind == Table::SlotKind::Entry ? entries : nodes);
    return slot;
  }

  std::vector<Table::Term> condition(std::size_t slots) {
    constexpr const char* kCodes[] = {"c", "v",   "+",  "-",  "*", "/",
                                      "%", "neg", "==", "!=", "<", "<=",
                                      ">", ">=",  "&&", "||", "!"};
    std::vector<Table::Term> terms(number(kMost));
    std::size_t depth = 0;
    for (Table::Term& term : terms) {
      term.code = static_cast<Table::Code>(choice(kCodes));
      std::size_t taken = 2;
      if (term.code == Table::Code::Constant) {
        term.operand = static_cast<std::int32_t>(
            integer(std::numeric_limits<std::int32_t>::min(),
                    std::numeric_limits<std::int32_t>::max()));
        taken = 0;
      } else if (term.code == Table::Code::Slot) {
        term.operand = static_cast<std::int32_t>(number(slots));
        taken = 0;
      } else if (term.code == Table::Code::Negate ||
                 term.code == Table::Code::Not) {
        taken = 1;
      }
      if (depth < taken) refuse("an operator without its operands");
      depth = depth - taken + 1;
      if (depth > kDeepest) refuse("a condition that is too deep");
    }
    if (depth > 1) refuse("a condition of several");
    return terms;
  }

  Table::Past past_of(std::size_t slots, std::size_t conditions) {
    constexpr const char* kKinds[] = {"once", "since", "previously"};
    Table::Past past;
    past.kind = static_cast<Table::PastKind>(choice(kKinds));
    past.slot = number(slots);
    past.held = number(conditions);
    past.began = number(conditions);
    return past;
  }

  Table::Rule rule(std::size_t conditions) {
    Table::Rule rule;
    rule.name = quoted();
    rule.text = quoted();
    rule.bits.resize(number(17));
    for (int& bit : rule.bits) {
      bit =
          static_cast<int>(integer(-1, static_cast<long long>(conditions) - 1));
    }
    rule.outlook.resize(number(kMost >> rule.bits.size()));
    if (rule.outlook.empty()) refuse("an automaton without states");
    for (auto& outlook : rule.outlook) {
      outlook = static_cast<std::uint8_t>(number(4));
    }
    rule.next.resize(rule.outlook.size() << rule.bits.size());
    for (auto& target : rule.next) {
      target = static_cast<std::uint32_t>(number(rule.outlook.size()));
    }
    return rule;
  }

 public:
  static constexpr std::size_t kDeepest = 1024;  // terms that wait

 private:
  std::string_view text_;
  std::size_t at_ = 0;
};

inline Table Table::read(std::string_view text) {
  return TableReader(text).read();
}

inline std::string described(const RunningNode& node) {
  const bool is_typed = !node.type.empty() && node.type != node.name;
  return "`" + node.name + "`" + (is_typed ? " (" + node.type + ")" : "") +
         (node.parent == 0 ? " at the top"
                           : " below node " + std::to_string(node.parent));
}

inline void Table::require(const std::vector<RunningNode>& running) const {
  const std::string wrong =
      "btcheck: another tree runs than the one of the rules: ";
  // Releases call a subtree SubTree or SubTreePlus.
  const auto has_type = [](const Node& known, const RunningNode& runs) {
    if (known.type == "SubTree") return runs.type.compare(0, 7, "SubTree") == 0;
    return known.type.empty() || runs.type == known.type;
  };
  for (std::size_t i = 0; i < running.size() && i + 1 < nodes.size(); ++i) {
    const RunningNode& runs = running[i];
    const Node& known = nodes[i + 1];
    const bool fits = runs.parent == known.parent &&
                      (runs.name == known.name || runs.name == known.id) &&
                      has_type(known, runs);
    if (fits) continue;
    throw WrongTree(wrong + "its node " + std::to_string(i + 1) + " is " +
                    described(runs) + ", where " + tree + " has " +
                    described({known.parent, known.name, known.type}));
  }
  if (running.size() + 1 != nodes.size()) {
    throw WrongTree(wrong + "it has " + std::to_string(running.size()) +
                    " nodes, " + tree + " has " +
                    std::to_string(nodes.size() - 1));
  }
}

// --- The monitor -----------------------------------------------------------

// What a monitor is told.
enum class Knowledge : std::uint8_t {
  Changes,  // changes of status alone, as a logger is
  Exact     // that, and where each node begins its tick, and what it answers
};

class Monitor {
 public:
  // Called once for each rule that is decided, with its number.
  std::function<void(std::size_t, Verdict)> on_verdict;

  // The table must outlive it.
  explicit Monitor(const Table& table, Knowledge knowledge = Knowledge::Changes)
      : table_(table), is_exact_(knowledge == Knowledge::Exact) {
    const std::size_t nodes = table.nodes.size();
    location_.resize(nodes, kStart);
    before_.resize(nodes, kStart);
    last_.resize(nodes, kLastIdle);
    called_.resize(nodes, false);
    status_.resize(nodes, Status::Idle);
    answered_.resize(nodes, Status::Idle);
    ticking_.reserve(nodes);
    is_ticking_.resize(nodes, false);
    is_touched_.resize(nodes, false);
    is_asked_.resize(nodes, false);
    touched_.reserve(nodes);
    values_.resize(table.slots.size(), 0);
    others_.resize(table.slots.size());
    past_.resize(table.past.size(), kNo);
    index_slots();
    index_rules();
    for (std::size_t n = 0; n < nodes; ++n) touch(n);
    for (std::size_t r = 0; r < automata_.size(); ++r) settle(r);
    see();
  }
  Monitor(const Monitor&) = delete;
  Monitor& operator=(const Monitor&) = delete;

  const Table& table() const { return table_; }
  std::size_t rule_count() const { return table_.automata.size(); }
  // Of any thread.
  Verdict verdict(std::size_t rule) const {
    return verdicts_[rule].load(std::memory_order_acquire);
  }
  // How many ticks have begun.
  std::uint64_t ticks() const { return ticks_; }

  // `units` of time have passed since the tick before began: ticks, where
  // none was left out. A tick takes one at least. A tick that was begun and has
  // not ended is over; one that is told exactly was left by an exception.
  void begin_tick(std::uint64_t units = 1) {
    if (is_exact_) {
      leave_tick();
    } else {
      end_tick();
    }
    if (!has_begun_) tell_decided();
    has_begun_ = true;
    is_in_tick_ = true;
    ++ticks_;
    for (; units > 1; --units) pass_time();
    outcome_ = Status::Running;
    reach(0, kTick, true);
    set_location(0, kElsewhere);
    see();
  }

  // And with the tick its time is over: what had to come by then is lost
  // here. What is told before the next tick begins comes later than that.
  void end_tick() {
    if (!is_exact_) settle_leaf();
    if (!is_in_tick_) return;
    let_go_below(0);
    is_in_tick_ = false;
    const bool has_ended =
        outcome_ == Status::Success || outcome_ == Status::Failure;
    if (!has_ended && outcome_ != Status::Skipped) outcome_ = Status::Running;
    if (outcome_ != Status::Skipped) last_[0] = last_of(outcome_);
    reach(0, location_of(outcome_), false);
    if (is_exact_ || !has_ended) rest(0);
    pass_time();
  }

  // An exception has left it.
  void leave_tick() {
    if (!is_in_tick_) return;
    is_in_tick_ = false;
    for (const std::size_t node : ticking_) {
      let_go(node);
      is_ticking_[node] = false;
    }
    ticking_.clear();
    let_go(0);
    see();
    pass_time();
  }

  // Throws std::out_of_range for a number that no node has, std::logic_error
  // before the first tick: without ticks no rule could be lost in time.
  void change(std::size_t node, Status before, Status after) {
    require_node(node);
    if (is_exact_) return change_exactly(node, before, after);
    if (taken_up_ == node && after != Status::Running &&
        after != Status::Idle) {
      taken_up_ = 0;
    } else {
      settle_leaf();
    }
    const std::size_t halted = halted_before_;
    halted_before_ = 0;
    if (after != Status::Idle) call(table_.nodes[node].parent);
    status_[node] = after;
    touch(node);
    const bool is_leaf = table_.nodes[node].is_leaf;
    if (after == Status::Running) {
      if (!is_leaf && location_[node] == kElsewhere) {
        last_[node] = kLastRunning;
        return see();
      }
      reach(node, kTick, true);
      last_[node] = kLastRunning;
      touch(node);
      if (!is_leaf) {
        set_location(node, kElsewhere);
        return see();
      }
      taken_up_ = node;
      return;
    }
    if (after != Status::Idle) {
      const bool is_called =
          before == Status::Running || location_[node] == kElsewhere;
      if (!is_called) reach(node, kTick, true);
      return give_answer(node, after);
    }
    last_[node] = kLastIdle;
    if (before != Status::Running) return see();
    halted_before_ = node;
    const bool is_certain =
        is_leaf || (halted != 0 && table_.nodes[halted].parent == node);
    if (is_certain) {
      reach(node, kHalted, false);
      return rest(node);
    }
    maybe_halted_ = node;
    reach(node, kStart, false);
    maybe_halted_ = 0;
    touch(node);
  }

  // These three of what is known exactly. A node begins its tick.
  void begin_node(std::size_t node) {
    require_node(node);
    has_set_ = 0;
    answered_[node] = Status::Idle;
    take_up(node);
  }

  // It answers; a change of its status to that may follow.
  void answer(std::size_t node, Status status) {
    require_node(node);
    const std::size_t set = std::exchange(has_set_, 0);
    answered_[node] = status;
    if (set == node && status_[node] == status) return;
    enter(node);
    give_answer(node, status);
  }

  // An entry has that value from the next event on.
  void set_entry(std::size_t entry, const EntryValue& value) {
    if (entry >= table_.entries.size()) {
      throw std::out_of_range("btcheck: there is no entry " +
                              std::to_string(entry));
    }
    const int region = region_of(table_.entries[entry], value);
    for (const std::size_t slot : slots_of_entry_[entry]) {
      set_value(slot, region);
    }
  }

  static int region_of(const Table::Entry& entry, const EntryValue& value) {
    for (std::size_t i = 0; i < entry.regions.size(); ++i) {
      if (fits(entry.regions[i], value)) return static_cast<int>(i);
    }
    return static_cast<int>(entry.regions.size()) - 1;
  }

 private:
  enum Location : std::uint8_t {
    kStart,
    kTick,
    kSuccess,
    kFailure,
    kRunning,
    kSkipped,
    kHalt,
    kHalted,
    kDone,
    kElsewhere
  };
  enum Last : std::uint8_t {
    kLastIdle,
    kLastSuccess,
    kLastFailure,
    kLastRunning
  };
  enum Truth : std::uint8_t { kNo, kYes, kUnknown };

  // What else a slot may be.
  struct Others {
    int count = 0;
    std::array<int, 3> values{};

    friend bool operator!=(const Others& one, const Others& other) {
      return one.count != other.count || one.values != other.values;
    }
  };

  struct Condition {
    std::vector<std::size_t> reads;  // slots, each once
    Truth truth = kNo;
    bool is_stale = true;
    bool is_of_past = false;
    // `slot == value`, as most are.
    bool is_equation = false;
    std::size_t slot = 0;
    int value = 0;
  };

  // A rule on its way: one state, or several where something is not known.
  struct Automaton {
    std::uint32_t state = 0;
    bool is_one = true;
    bool is_stuttering = false;  // a letter that comes again changes nothing
    bool is_timed = false;
    bool is_marked = true;  // to be read
    std::uint32_t letter = 0;
    bool has_letter = false;
    std::vector<std::uint64_t> states;  // where it is not one
    std::vector<std::uint64_t> next;
  };

  static Last last_of(Status status) {
    return status == Status::Success   ? kLastSuccess
           : status == Status::Failure ? kLastFailure
           : status == Status::Running ? kLastRunning
                                       : kLastIdle;
  }
  static Location location_of(Status status) {
    return status == Status::Success   ? kSuccess
           : status == Status::Failure ? kFailure
           : status == Status::Running ? kRunning
                                       : kSkipped;
  }

  static bool fits(const Table::Region& region, const EntryValue& value) {
    switch (region.kind) {
      case Table::Region::Numbers:
        return value.is_number() && value.number() >= region.low &&
               value.number() <= region.high;
      case Table::Region::Text:
        return value.kind == EntryValue::Text &&
               has_word(value.text, region.text);
      case Table::Region::AnyText:
        return value.kind == EntryValue::Text;
      case Table::Region::Unset:
        return value.kind == EntryValue::Unset;
      case Table::Region::NoValue:
        return value.kind == EntryValue::NoValue;
      case Table::Region::Other:
        return value.kind == EntryValue::Other ||
               (value.is_number() && std::isnan(value.number()));
    }
    return false;
  }

  // Whether rules call that text so: `go_home` for "go home", `empty` for "",
  // `text_3` for "3" where the number is called so. Letters count as one,
  // capital or not.
  static bool has_word(std::string_view text, std::string_view word) {
    if (text.empty()) return word == "empty";
    constexpr std::string_view kOfText = "text_";
    const bool is_marked = word.substr(0, kOfText.size()) == kOfText &&
                           word.size() == text.size() + kOfText.size();
    if (is_marked) word.remove_prefix(kOfText.size());
    const auto letter = [](char c) {
      const bool is_capital = c >= 'A' && c <= 'Z';
      if (is_capital) return static_cast<char>(c - 'A' + 'a');
      const bool is_kept = (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') ||
                           static_cast<unsigned char>(c) >= 0x80;
      return is_kept ? c : '_';
    };
    return std::equal(text.begin(), text.end(), word.begin(), word.end(),
                      [&](char of_text, char of_word) {
                        return letter(of_text) == letter(of_word);
                      });
  }

  // --- Made once ---

  void index_slots() {
    slots_of_node_.resize(table_.nodes.size());
    is_asked_[0] = true;  // where it answers a tick ends
    slots_of_entry_.resize(table_.entries.size());
    for (std::size_t s = 0; s < table_.slots.size(); ++s) {
      const Table::Slot& slot = table_.slots[s];
      if (slot.kind == Table::SlotKind::Remembered) continue;
      if (slot.kind == Table::SlotKind::Entry) {
        slots_of_entry_[slot.of].push_back(s);
        values_[s] = region_of(table_.entries[slot.of], {});
        continue;
      }
      slots_of_node_[slot.of].push_back(s);
      is_asked_[slot.of] = true;
      if (slot.kind == Table::SlotKind::Answer) answer_slots_.push_back(s);
    }
  }

  void index_rules() {
    conditions_.resize(table_.conditions.size());
    conditions_of_slot_.resize(table_.slots.size());
    rules_of_condition_.resize(table_.conditions.size());
    for (std::size_t c = 0; c < conditions_.size(); ++c) {
      auto& reads = conditions_[c].reads;
      for (const Table::Term& term : table_.conditions[c]) {
        if (term.code != Table::Code::Slot) continue;
        const auto slot = static_cast<std::size_t>(term.operand);
        if (std::find(reads.begin(), reads.end(), slot) != reads.end()) {
          continue;
        }
        reads.push_back(slot);
        conditions_of_slot_[slot].push_back(c);
      }
      const auto& terms = table_.conditions[c];
      if (terms.size() == 3 && terms[0].code == Table::Code::Slot &&
          terms[1].code == Table::Code::Constant &&
          terms[2].code == Table::Code::Equal) {
        conditions_[c].is_equation = true;
        conditions_[c].slot = static_cast<std::size_t>(terms[0].operand);
        conditions_[c].value = terms[1].operand;
      }
    }
    for (const Table::Past& past : table_.past) {
      conditions_[past.held].is_of_past = true;
      conditions_[past.began].is_of_past = true;
    }
    automata_.resize(table_.automata.size());
    verdicts_ =
        std::make_unique<std::atomic<Verdict>[]>(table_.automata.size() + 1);
    for (std::size_t r = 0; r < automata_.size(); ++r) {
      const Table::Rule& rule = table_.automata[r];
      verdicts_[r] = Verdict::Open;
      automata_[r].states.resize((rule.outlook.size() + 63) / 64);
      automata_[r].next.resize(automata_[r].states.size());
      for (const int bit : rule.bits) {
        if (bit < 0) {
          automata_[r].is_timed = true;
          timed_.push_back(r);
        } else {
          rules_of_condition_[static_cast<std::size_t>(bit)].push_back(r);
        }
      }
      automata_[r].is_stuttering = stutters(rule);
      marked_.push_back(r);
    }
    marked_.reserve(automata_.size());
  }

  // Reading a letter without time once more leads nowhere else.
  static bool stutters(const Table::Rule& rule) {
    std::uint32_t time = 0;
    for (std::size_t i = 0; i < rule.bits.size(); ++i) {
      if (rule.bits[i] < 0) time |= std::uint32_t{1} << i;
    }
    const std::size_t letters = std::size_t{1} << rule.bits.size();
    for (std::size_t state = 0; state < rule.outlook.size(); ++state) {
      for (std::size_t letter = 0; letter < letters; ++letter) {
        const std::uint32_t once = rule.next[state * letters + letter];
        // Behind a letter with time the same without it follows.
        if (rule.next[once * letters + (letter & ~std::size_t{time})] != once) {
          return false;
        }
      }
    }
    return true;
  }

  // --- Nodes ---

  void require_node(std::size_t node) const {
    if (node == 0 || node >= table_.nodes.size()) {
      throw std::out_of_range("btcheck: there is no node " +
                              std::to_string(node));
    }
    if (!has_begun_ && !is_exact_) {
      throw std::logic_error(
          "btcheck: begin_tick() comes before the first change");
    }
  }

  // Nothing is asked of most nodes.
  void touch(std::size_t node) {
    if (is_touched_[node] || !is_asked_[node]) return;
    is_touched_[node] = true;
    touched_.push_back(node);
  }
  void set_location(std::size_t node, Location location) {
    location_[node] = location;
    touch(node);
  }

  void change_exactly(std::size_t node, Status before, Status after) {
    status_[node] = after;
    has_set_ = 0;
    const Status said = std::exchange(answered_[node], Status::Idle);
    if (after == Status::Idle) {
      last_[node] = kLastIdle;
      touch(node);
      if (before != Status::Running || location_[node] != kStart) return see();
      reach(node, kHalted, false);
      return rest(node);
    }
    if (said == after) return;
    if (after == Status::Running) {
      take_up(node);
      last_[node] = kLastRunning;
      touch(node);
      return see();
    }
    has_set_ = node;
    enter(node);
    give_answer(node, after);
  }

  // The node is ticked, if it was not before. What else is below its parent
  // has ended its tick.
  void enter(std::size_t node) {
    const std::size_t parent = table_.nodes[node].parent;
    call(parent);
    if (location_[node] != kStart) return;
    let_go_below(parent);
    note_ticking(node);
    reach(node, kTick, true);
  }
  void take_up(std::size_t node) {
    if (location_[node] != kStart) return call(table_.nodes[node].parent);
    enter(node);
    if (table_.nodes[node].is_leaf) return;
    set_location(node, kElsewhere);
    see();
  }

  // The leaf that became RUNNING last has answered so. An answer in the next
  // change would have come first: SimpleActionNode is RUNNING before it calls
  // its function.
  void settle_leaf() {
    const std::size_t leaf = std::exchange(taken_up_, 0);
    if (leaf == 0) return;
    reach(leaf, kRunning, false);
    rest(leaf);
  }

  // A node whose child does something is ticked. Some, such as Switch, tell it
  // at their answer only.
  void call(std::size_t node) {
    if (node == 0 || location_[node] != kStart) return;
    call(table_.nodes[node].parent);
    note_ticking(node);
    reach(node, kTick, true);
    set_location(node, kElsewhere);
    see();
  }

  bool is_below(std::size_t node, std::size_t above) const {
    while (node > above) node = table_.nodes[node].parent;
    return node == above;
  }

  void let_go(std::size_t node) {
    set_location(node, kStart);
    called_[node] = false;
  }

  // What was ticked and tells no answer was skipped, has answered what it
  // had, or was left by an exception: its parent has gone on.
  void let_go_below(std::size_t above) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < ticking_.size(); ++i) {
      const std::size_t node = ticking_[i];
      const bool is_said = !is_exact_ && status_[node] == Status::Running;
      if (node == above || (!is_said && !is_below(node, above))) {
        ticking_[kept++] = node;
        continue;
      }
      is_ticking_[node] = false;
      if (is_said) continue;
      // A leaf that tells no answers, such as a CoroActionNode, and runs.
      const bool has_answered =
          table_.nodes[node].is_leaf && status_[node] == Status::Running;
      if (has_answered) {
        reach(node, kRunning, false);
        rest(node);
      } else {
        let_go(node);
        see();
      }
    }
    ticking_.resize(kept);
  }
  void note_ticking(std::size_t node) {
    if (is_ticking_[node]) return;
    is_ticking_[node] = true;
    ticking_.push_back(node);
  }
  void note_answered(std::size_t node) {
    if (!is_ticking_[node]) return;
    is_ticking_[node] = false;
    ticking_.erase(std::find(ticking_.begin(), ticking_.end(), node));
  }

  void pass_time() {
    has_passed_ = true;
    see();
  }

  void reach(std::size_t node, Location location, bool is_called) {
    set_location(node, location);
    called_[node] = is_called;
    see();
  }

  void give_answer(std::size_t node, Status status) {
    let_go_below(node);
    note_answered(node);
    if (table_.nodes[node].parent == 0) outcome_ = status;
    if (!is_exact_ || status != Status::Skipped) last_[node] = last_of(status);
    reach(node, location_of(status), false);
    rest(node);
  }

  void rest(std::size_t node) {
    set_location(node, kDone);
    see();
    set_location(node, kStart);
    see();
  }

  // The answer that a location gives: success, failure, running, skipped.
  static int answer_in(Location location) {
    return location >= kSuccess && location <= kSkipped
               ? static_cast<int>(location) - kTick
               : 0;
  }

  // --- Slots ---

  void set_value(std::size_t slot, int value) {
    if (values_[slot] == value) return;
    values_[slot] = value;
    mark_slot(slot);
  }
  void mark_slot(std::size_t slot) {
    for (const std::size_t c : conditions_of_slot_[slot]) {
      conditions_[c].is_stale = true;
      is_past_new_ |= conditions_[c].is_of_past;
      for (const std::size_t rule : rules_of_condition_[c]) mark(rule);
    }
  }
  void mark(std::size_t rule) {
    if (automata_[rule].is_marked) return;
    automata_[rule].is_marked = true;
    marked_.push_back(rule);
  }

  void add(Others& others, int value) const {
    others.values[static_cast<std::size_t>(others.count++)] = value;
  }

  // A node that runs may be ticked and answer so again; one that has ended
  // and was not reset may answer as before.
  Others unseen(std::size_t node, bool is_answer) const {
    Others others;
    const Location here = location_[node];
    if (is_exact_ || node == 0) return others;
    if (here != kStart && here != kElsewhere) return others;
    if (maybe_halted_ == node) {
      if (!is_answer) add(others, kHalted);
      return others;
    }
    const Status status = status_[node];
    if (status == Status::Idle || status == Status::Skipped) {
      if (here != kElsewhere) return others;
      if (is_answer) {
        add(others, answer_in(kSkipped));
        return others;
      }
      add(others, kSkipped);
      add(others, kDone);
      return others;
    }
    const Location again = location_of(status);
    if (is_answer) {
      add(others, answer_in(again));
      return others;
    }
    add(others, kTick);
    add(others, again);
    add(others, kDone);
    return others;
  }

  void read_slot(std::size_t s) {
    const Table::Slot& slot = table_.slots[s];
    const std::size_t node = slot.of;
    Others others;
    int value = values_[s];
    if (slot.kind == Table::SlotKind::Location) {
      value = location_[node];
      others = unseen(node, false);
    } else if (slot.kind == Table::SlotKind::LastStatus) {
      value = last_[node];
    } else if (slot.kind == Table::SlotKind::Called) {
      value = called_[node] ? 1 : 0;
    } else {
      const int code = answer_in(location_[node]);
      if (code != 0 && location_[node] != before_[node]) value = code;
      others = unseen(node, true);
    }
    const bool is_new = value != values_[s] || others != others_[s];
    values_[s] = value;
    others_[s] = others;
    if (is_new) mark_slot(s);
  }

  void read_slots() {
    if (has_ended_) {
      for (const std::size_t s : answer_slots_) set_value(s, 0);
    }
    for (const std::size_t node : touched_) {
      for (const std::size_t s : slots_of_node_[node]) read_slot(s);
    }
  }

  // --- Conditions ---

  bool holds(const std::vector<Table::Term>& terms) const {
    if (terms.empty()) return true;
    std::array<std::int64_t, TableReader::kDeepest> stack;
    std::size_t depth = 0;
    for (const Table::Term& term : terms) {
      if (term.code == Table::Code::Constant) {
        stack[depth++] = term.operand;
        continue;
      }
      if (term.code == Table::Code::Slot) {
        stack[depth++] = values_[static_cast<std::size_t>(term.operand)];
        continue;
      }
      std::int64_t& top = stack[depth - 1];
      if (term.code == Table::Code::Negate || term.code == Table::Code::Not) {
        top = term.code == Table::Code::Not ? (top == 0 ? 1 : 0) : -top;
        continue;
      }
      stack[depth - 2] = combined(term.code, stack[depth - 2], top);
      --depth;
    }
    return stack[0] != 0;
  }

  static std::int64_t combined(Table::Code code, std::int64_t left,
                               std::int64_t right) {
    switch (code) {
      case Table::Code::Add:
        return left + right;
      case Table::Code::Subtract:
        return left - right;
      case Table::Code::Multiply:
        return left * right;
      case Table::Code::Divide:
        return right == 0 ? 0 : left / right;
      case Table::Code::Modulo:
        return right == 0 ? 0 : left % right;
      case Table::Code::Equal:
        return left == right ? 1 : 0;
      case Table::Code::NotEqual:
        return left != right ? 1 : 0;
      case Table::Code::Less:
        return left < right ? 1 : 0;
      case Table::Code::LessEqual:
        return left <= right ? 1 : 0;
      case Table::Code::Greater:
        return left > right ? 1 : 0;
      case Table::Code::GreaterEqual:
        return left >= right ? 1 : 0;
      case Table::Code::And:
        return left != 0 && right != 0 ? 1 : 0;
      case Table::Code::Or:
        return left != 0 || right != 0 ? 1 : 0;
      case Table::Code::Constant:
      case Table::Code::Slot:
      case Table::Code::Negate:
      case Table::Code::Not:
        break;
    }
    return 0;
  }

  Truth truth(std::size_t number) {
    Condition& condition = conditions_[number];
    if (condition.is_stale) {
      condition.truth = find_truth(number);
      condition.is_stale = false;
    }
    return condition.truth;
  }

  Truth find_truth(std::size_t number) {
    const Condition& condition = conditions_[number];
    if (condition.is_equation && others_[condition.slot].count == 0) {
      return values_[condition.slot] == condition.value ? kYes : kNo;
    }
    constexpr std::size_t kMostWays = 4096;
    const std::vector<Table::Term>& terms = table_.conditions[number];
    const std::vector<std::size_t>& reads = conditions_[number].reads;
    std::size_t ways = 1;
    for (const std::size_t slot : reads) {
      ways *= static_cast<std::size_t>(others_[slot].count) + 1;
      if (ways > kMostWays) return kUnknown;
    }
    if (ways == 1) return holds(terms) ? kYes : kNo;
    bool some_hold = false;
    bool some_fail = false;
    for (std::size_t way = 0; way < ways; ++way) {
      turn(reads, way);
      (holds(terms) ? some_hold : some_fail) = true;
      turn(reads, way);
    }
    return some_hold && some_fail ? kUnknown : some_hold ? kYes : kNo;
  }

  // Exchanges the values of slots with others that they may have; again, and
  // they are as they were.
  void turn(const std::vector<std::size_t>& reads, std::size_t way) {
    for (const std::size_t slot : reads) {
      Others& others = others_[slot];
      const std::size_t ways = static_cast<std::size_t>(others.count) + 1;
      const std::size_t chosen = way % ways;
      way /= ways;
      if (chosen > 0) std::swap(values_[slot], others.values[chosen - 1]);
    }
  }

  void note_past(bool is_tick_end) {
    is_past_new_ = false;
    for (std::size_t p = 0; p < table_.past.size(); ++p) {
      const Table::Past& past = table_.past[p];
      Truth& now = past_[p];
      if (past.kind == Table::PastKind::Once) {
        now = either(truth(past.held), now);
      } else if (past.kind == Table::PastKind::Since) {
        now = either(truth(past.began), both(truth(past.held), now));
      }
      Others others;
      if (now == kUnknown) add(others, 1);
      const int value = now == kYes ? 1 : 0;
      if (values_[past.slot] != value || others_[past.slot] != others) {
        values_[past.slot] = value;
        others_[past.slot] = others;
        mark_slot(past.slot);
      }
      // What holds where this tick ends is told from the next state on.
      const bool is_told = past.kind == Table::PastKind::Previously;
      if (is_told && is_tick_end) now = truth(past.held);
    }
    is_past_new_ |= is_tick_end;
  }

  static Truth either(Truth one, Truth other) {
    if (one == kYes || other == kYes) return kYes;
    return one == kNo && other == kNo ? kNo : kUnknown;
  }
  static Truth both(Truth one, Truth other) {
    if (one == kNo || other == kNo) return kNo;
    return one == kYes && other == kYes ? kYes : kUnknown;
  }

  // --- Rules ---

  // The present state.
  void see() {
    const bool is_new = !touched_.empty() || !marked_.empty() || has_ended_ ||
                        has_passed_ || is_past_new_;
    if (!is_new) return;
    read_slots();
    has_ended_ = answer_in(location_[0]) != 0 && location_[0] != before_[0];
    for (const std::size_t node : touched_) {
      before_[node] = location_[node];
      is_touched_[node] = false;
    }
    touched_.clear();
    if (is_past_new_ || (has_ended_ && !past_.empty())) note_past(has_ended_);
    if (has_passed_) {
      for (const std::size_t rule : timed_) mark(rule);
    }
    // One that reads every state stays marked and listed; one that is decided
    // stays marked, so that it is never listed again.
    std::size_t kept = 0;
    for (std::size_t i = 0; i < marked_.size(); ++i) {
      const std::size_t rule = marked_[i];
      read(rule);
      if (verdicts_[rule].load(std::memory_order_relaxed) != Verdict::Open) {
        continue;
      }
      if (automata_[rule].is_stuttering) {
        automata_[rule].is_marked = false;
      } else {
        marked_[kept++] = rule;
      }
    }
    marked_.resize(kept);
    has_passed_ = false;
  }

  void read(std::size_t number) {
    Automaton& automaton = automata_[number];
    if (verdicts_[number].load(std::memory_order_relaxed) != Verdict::Open) {
      return;
    }
    const Table::Rule& rule = table_.automata[number];
    std::uint32_t known = 0;
    std::uint32_t unknown = 0;
    std::uint32_t passed = 0;
    for (std::size_t i = 0; i < rule.bits.size(); ++i) {
      const std::uint32_t bit = std::uint32_t{1} << i;
      if (rule.bits[i] < 0) {
        if (has_passed_) passed = bit;
        continue;
      }
      const Truth now = truth(static_cast<std::size_t>(rule.bits[i]));
      if (now == kYes) known |= bit;
      if (now == kUnknown) unknown |= bit;
    }
    if (unknown == 0 && automaton.is_one) {
      const bool is_again = automaton.has_letter && automaton.letter == known &&
                            passed == 0 && automaton.is_stuttering;
      automaton.letter = known;
      automaton.has_letter = true;
      if (is_again) return;
      const std::size_t row = std::size_t{automaton.state} << rule.bits.size();
      automaton.state = rule.next[row | known | passed];
      return settle(number);
    }
    automaton.has_letter = false;
    if (automaton.is_one) {
      std::fill(automaton.states.begin(), automaton.states.end(), 0);
      automaton.states[automaton.state / 64] |= std::uint64_t{1}
                                                << (automaton.state % 64);
      automaton.is_one = false;
    }
    std::fill(automaton.next.begin(), automaton.next.end(), 0);
    follow(number, known | passed, unknown);
    automaton.states = automaton.next;
    while (unknown != 0) {
      follow(number, known, unknown);
      if (automaton.next == automaton.states) break;
      automaton.states = automaton.next;
    }
    settle(number);
  }

  // Adds to `next` where the states lead.
  void follow(std::size_t number, std::uint32_t known, std::uint32_t unknown) {
    const Table::Rule& rule = table_.automata[number];
    Automaton& automaton = automata_[number];
    for (std::size_t w = 0; w < automaton.states.size(); ++w) {
      std::uint64_t bits = automaton.states[w];
      for (std::size_t state = w * 64; bits != 0; ++state, bits >>= 1U) {
        if ((bits & 1U) == 0) continue;
        for (std::uint32_t way = unknown;; way = (way - 1) & unknown) {
          const std::uint32_t target =
              rule.next[(state << rule.bits.size()) | known | way];
          automaton.next[target / 64] |= std::uint64_t{1} << (target % 64);
          if (way == 0) break;
        }
      }
    }
  }

  void settle(std::size_t number) {
    const Table::Rule& rule = table_.automata[number];
    Automaton& automaton = automata_[number];
    std::uint8_t outlook = 0;
    if (automaton.is_one) {
      outlook = rule.outlook[automaton.state];
    } else {
      std::size_t count = 0;
      for (std::size_t w = 0; w < automaton.states.size(); ++w) {
        std::uint64_t bits = automaton.states[w];
        for (std::size_t state = w * 64; bits != 0; ++state, bits >>= 1U) {
          if ((bits & 1U) == 0) continue;
          automaton.state = static_cast<std::uint32_t>(state);
          if (count++ > 0 && rule.outlook[state] != outlook) return;
          outlook = rule.outlook[state];
        }
      }
      automaton.is_one = count == 1;
    }
    if (outlook == 0) return;
    const auto verdict = static_cast<Verdict>(outlook);
    verdicts_[number].store(verdict, std::memory_order_release);
    if (on_verdict) on_verdict(number, verdict);
  }

  // What is decided before anything has happened.
  void tell_decided() const {
    if (!on_verdict) return;
    for (std::size_t rule = 0; rule < automata_.size(); ++rule) {
      if (verdict(rule) != Verdict::Open) on_verdict(rule, verdict(rule));
    }
  }

  const Table& table_;
  const bool is_exact_;

  std::vector<Location> location_;  // these by node
  std::vector<Location> before_;
  std::vector<Last> last_;
  std::vector<char> called_;
  std::vector<Status> status_;
  std::vector<Status> answered_;      // and has not become so yet
  std::vector<std::size_t> ticking_;  // in their tick, as far as is known
  std::vector<char> is_ticking_;
  std::vector<char> is_asked_;  // some slot is of it
  std::vector<char> is_touched_;
  std::vector<std::size_t> touched_;

  std::vector<int> values_;  // these by slot
  std::vector<Others> others_;
  std::vector<std::vector<std::size_t>> conditions_of_slot_;
  std::vector<std::vector<std::size_t>> slots_of_node_;
  std::vector<std::vector<std::size_t>> slots_of_entry_;
  std::vector<std::size_t> answer_slots_;

  std::vector<Truth> past_;
  std::vector<Condition> conditions_;
  std::vector<std::vector<std::size_t>> rules_of_condition_;
  std::vector<Automaton> automata_;
  std::unique_ptr<std::atomic<Verdict>[]> verdicts_;
  std::vector<std::size_t> timed_;
  std::vector<std::size_t> marked_;

  std::uint64_t ticks_ = 0;
  Status outcome_ = Status::Running;
  std::size_t maybe_halted_ = 0;
  std::size_t halted_before_ = 0;
  std::size_t taken_up_ = 0;  // a leaf, by the change before
  // Has set its status in its own tick, as SimpleActionNode does, and is to
  // answer it.
  std::size_t has_set_ = 0;
  bool has_begun_ = false;
  bool is_in_tick_ = false;
  bool has_ended_ = false;
  bool has_passed_ = false;
  bool is_past_new_ = true;  // something that is remembered may be another
};

}  // namespace monitor
}  // namespace btcheck
// What stands in such a header ends here.
