// SPDX-License-Identifier: MIT
#include "groot2/robot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <thread>
#include <utility>

#include "groot2/entries.hpp"
#include "model/btcpp/xml_text.hpp"
#include "text/numbers.hpp"

namespace btcheck::groot2 {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds kFirstPatience{200};
constexpr milliseconds kLastPatience{500};  // of those that take leave
constexpr milliseconds kPause{20};          // between two looks at changes
constexpr milliseconds kShortPause{1};      // where many have come
constexpr std::size_t kMany = 100;
constexpr milliseconds kCompare{500};  // with the publisher's statuses
constexpr milliseconds kLookAtEntries{200};
constexpr int kMostSilences = 10;  // of who has never answered
constexpr std::int64_t kBackwards = 1'000'000;
constexpr int kMostTries = 200;  // to begin
// Recordings shorter than this, so many one after the other, are of no use.
constexpr std::chrono::seconds kQuick{5};
constexpr int kMostQuick = 5;

// What an XML comment may hold.
std::string commented(std::string text) {
  for (std::size_t at = text.find("--"); at != std::string::npos;
       at = text.find("--", at)) {
    text.replace(at, 2, "- -");
  }
  return text;
}

// The program has been started anew.
struct Anew {};

// Whether statuses have become those that they are compared with.
class Comparison {
 public:
  Comparison(std::vector<LogStatus> now, std::vector<LogStatus> wanted)
      : now_(std::move(now)), wanted_(std::move(wanted)) {
    for (std::size_t n = 0; n < now_.size(); ++n) {
      if (now_[n] != wanted_[n]) ++different_;
    }
  }

  void change(std::size_t node, LogStatus status) {
    if (now_[node] != wanted_[node]) --different_;
    now_[node] = status;
    if (now_[node] != wanted_[node]) ++different_;
  }
  bool is_met() const { return different_ == 0; }
  // Once some of these have been made.
  template <class Place>
  bool is_met_by(const std::vector<Change>& changes, const Place& place_of) {
    for (const Change& each : changes) {
      if (is_met()) break;
      change(place_of(each.uid), each.after);
    }
    return is_met();
  }

 private:
  std::vector<LogStatus> now_;
  std::vector<LogStatus> wanted_;
  std::size_t different_ = 0;
};

}  // namespace

Robot::Robot(Context& context, const Address& address,
             const Following& following, Listener& listener)
    : address_(address),
      following_(following),
      listener_(listener),
      link_(context, address,
            [this] { return !is_leaving_ && listener_.is_over(); }) {
  if (!following.faults.empty()) ear_.emplace(context, address);
}

void Robot::stop(std::string_view code, std::string message,
                 std::string help) const {
  throw Stop{{file_error(code, "groot2://" + address_.text(),
                         std::move(message), std::move(help))}};
}

std::vector<Diagnostic> Robot::follow() {
  std::vector<Diagnostic> found;
  int quick_starts = 0;
  try {
    for (;;) {
      try {
        read_tree(meet().text);
        record();
      } catch (const Anew&) {
        end("the program was started anew");
        const bool is_quick = Clock::now() - met_ < kQuick;
        quick_starts = is_quick ? quick_starts + 1 : 0;
        if (quick_starts > kMostQuick) {
          stop("BT1903", fmt::format("it was started anew {} times within "
                                     "seconds, or says so",
                                     quick_starts));
        }
      }
    }
  } catch (Stop& stopped) {
    end("nothing more can be heard of it");
    found = std::move(stopped.found);
  } catch (const Over&) {
    end("btcheck listens no longer");
  }
  leave(found);
  return found;
}

// --- Requests ----------------------------------------------------------------

// The tree of who answers there, however long that takes.
Answer Robot::meet() {
  bool is_told = false;
  int silences = 0;
  for (;;) {
    // That nobody is there is said soon.
    Answer answer = link_.ask(
        Request::Tree, is_told ? following_.patience
                               : std::min(following_.patience, kFirstPatience));
    switch (answer.kind) {
      case Answer::Kind::Good:
        if (is_told) listener_.is_back();
        is_met_ = true;
        met_ = Clock::now();
        id_ = answer.tree;
        return answer;
      case Answer::Kind::Over:
        throw Over();
      case Answer::Kind::Absent:
        if (!std::exchange(is_told, true)) {
          listener_.waits("nobody answers there yet");
        }
        break;
      case Answer::Kind::Silent:
        if (!is_met_ && ++silences >= kMostSilences) {
          stop("BT1902",
               fmt::format("somebody listens there, and has not answered for "
                           "{} s",
                           kMostSilences * following_.patience.count() / 1000),
               "name the port of a Groot2Publisher, 1667 unless the program "
               "says another");
        }
        break;
      case Answer::Kind::Refused:
      case Answer::Kind::Foreign:
        refuse(answer);
    }
  }
}

void Robot::refuse(const Answer& answer) const {
  if (answer.kind == Answer::Kind::Refused) {
    stop("BT1902", "the request was refused: " + answer.text,
         "btcheck speaks to the Groot2Publisher of BehaviorTree.CPP 4");
  }
  stop("BT1902", "this is no publisher that btcheck knows: " + answer.text,
       "btcheck speaks to the Groot2Publisher of BehaviorTree.CPP 4");
}

// Good, or refused by the server.
Answer Robot::ask(Request kind, std::optional<std::string_view> argument) {
  bool is_told = false;
  bool is_lost = false;
  for (;;) {
    Answer answer = link_.ask(kind, following_.patience, argument);
    switch (answer.kind) {
      case Answer::Kind::Over:
        throw Over();
      case Answer::Kind::Foreign:
        refuse(answer);
      case Answer::Kind::Absent:
      case Answer::Kind::Silent:
        // Whoever has sent changes keeps them no longer.
        is_lost |=
            kind == Request::Changes && answer.kind == Answer::Kind::Silent;
        if (!std::exchange(is_told, true)) {
          listener_.waits("it does not answer any more");
        }
        break;
      case Answer::Kind::Good:
      case Answer::Kind::Refused:
        if (is_told) listener_.is_back();
        if (answer.kind == Answer::Kind::Good && answer.tree != id_) {
          throw Anew();
        }
        if (is_lost) throw Gap{"an answer with changes was lost"};
        return answer;
    }
  }
}

// --- The tree ----------------------------------------------------------------

void Robot::read_tree(std::string_view xml) {
  std::string text(xml);
  if (!following_.faults.empty()) {
    text += "<!-- recorded by btcheck watch; on purpose:";
    for (const Fault& fault : following_.faults) {
      text += commented(
          fmt::format("{} {}{}", &fault == &following_.faults[0] ? "" : ";",
                      fault.is_break ? "break " : "", fault.text));
    }
    text += " -->\n";
  }
  auto read = read_log("", btlog_heading(text, 0));
  if (!read.value) {
    const Diagnostic& why = read.diagnostics.front();
    stop("BT1903", "the tree that it sends cannot be read: " + why.message);
  }
  log_ = std::move(*read.value);
  boards_.clear();
  if (following_.asks_for_entries) {
    const btcpp::ParsedXml parsed{log_.xml};
    for (std::size_t i = 1; i < parsed.value->size(); ++i) {
      const btcpp::XmlElement& element = (*parsed.value)[i];
      if (element.parent != 0 || element.name != "BehaviorTree") continue;
      const std::string path = element.value_or_empty("_fullpath");
      const std::string id = element.value_or_empty("ID");
      const std::string& name = path.empty() ? id : path;
      if (!name.empty() && name.find(';') == std::string::npos) {
        boards_.push_back(name);
      }
    }
  }
  has_entries_ = !boards_.empty();
  auto hooks = hooks_of(following_.faults, log_, "groot2://" + address_.text());
  if (!hooks.value) throw Stop{std::move(hooks.diagnostics)};
  hooks_ = std::move(*hooks.value);
  is_armed_.assign(hooks_.size(), false);
  stands_.assign(hooks_.size(), false);
  quick_gaps_ = 0;
}

std::size_t Robot::place_of(std::uint16_t uid) const {
  const LogNode* node = log_.find(uid);
  if (node == nullptr) {
    stop("BT1903",
         fmt::format("it tells of node {}, which its tree does not have", uid));
  }
  return static_cast<std::size_t>(node - log_.nodes.data());
}

// --- A recording -------------------------------------------------------------

void Robot::record() {
  for (;;) {
    try {
      begin();
      for (;;) go_on();
    } catch (const Gap& gap) {
      const bool is_quick = Clock::now() - begin_ < kQuick;
      quick_gaps_ = is_quick ? quick_gaps_ + 1 : 1;
      end("changes were lost: " + gap.why);
      if (quick_gaps_ >= kMostQuick) {
        stop("BT1905",
             fmt::format("changes were lost {} times within seconds: {}",
                         quick_gaps_, gap.why),
             "a publisher keeps 1,000 changes: attach btcheck::observer to a "
             "tree that makes more of them at once");
      }
    }
  }
}

void Robot::begin() {
  begin_ = Clock::now();
  std::vector<LogStatus> before;
  bool has_begun = false;
  for (int i = 0; i < kMostTries && !has_begun; ++i) {
    has_begun = begin_in(before);
  }
  if (!has_begun) throw Gap{"they come faster than they can be asked for"};
  log_.transitions.clear();
  for (std::size_t n = 0; n < before.size(); ++n) {
    if (before[n] == LogStatus::Idle) continue;
    log_.transitions.push_back(
        {0, log_.nodes[n].uid, LogStatus::Idle, before[n]});
  }
  known_ = std::move(before);
  time_ = 0;
  ticks_.emplace(log_, following_.reading);
  tick_ = log_.transitions.empty() ? 0 : ticks_->tick_at(0);
  has_begun_ = true;
  auto found = listener_.begins(log_, entries());
  if (has_error(found)) throw Stop{std::move(found)};
  arm();
  take(first_);
  compared_ = looked_ = Clock::now();
}

// Whether the statuses are known from which the recording goes on: those before
// it begins must lead, by some of the changes since, to those after that.
bool Robot::begin_in(std::vector<LogStatus>& before) {
  before = statuses();
  const Answer start = ask(Request::Record, "start");
  const auto begin = as_number<std::int64_t>(start.text);
  if (start.kind != Answer::Kind::Good || !begin || *begin < 0) {
    stop("BT1903", fmt::format("it says `{}` to the beginning of a recording",
                               start.text));
  }
  log_.begin = *begin;
  Comparison comparison(before, statuses());
  first_ = changes();
  const auto place = [this](std::uint16_t uid) { return place_of(uid); };
  return comparison.is_met_by(first_, place) && first_.size() < kMostKept;
}

void Robot::end(std::string_view why) {
  if (std::exchange(has_begun_, false)) listener_.ends(why);
}

void Robot::go_on() {
  std::this_thread::sleep_for(came_ > kMany ? kShortPause : kPause);
  if (listener_.is_over()) throw Over();
  hear();
  const Clock::time_point now = Clock::now();
  std::optional<Comparison> comparison;
  if (now - compared_ >= kCompare) {
    compared_ = now;
    comparison.emplace(known_, statuses());
  }
  const std::vector<Change> more = changes();
  if (more.size() >= kMostKept) {
    throw Gap{fmt::format("{} came at once, which is as many as are kept",
                          more.size())};
  }
  const auto place = [this](std::uint16_t uid) { return place_of(uid); };
  if (comparison && !comparison->is_met_by(more, place)) {
    throw Gap{"another program asks for them as well, Groot2 for instance"};
  }
  take(more);
  arm();
  if (has_entries_ && now - looked_ >= kLookAtEntries) {
    looked_ = now;
    listener_.knows_entries(entries());
  }
}

std::vector<LogStatus> Robot::statuses() {
  const Answer answer = ask(Request::Statuses);
  if (answer.kind == Answer::Kind::Refused) refuse(answer);
  const StatusesRead read = statuses_in(answer.text);
  if (!read.flaw.empty()) stop("BT1903", read.flaw);
  std::vector<LogStatus> found(log_.nodes.size(), LogStatus::Idle);
  for (const NodeStatus& node : read.statuses) {
    found[place_of(node.uid)] = node.status;
  }
  return found;
}

std::vector<Change> Robot::changes() {
  const Answer answer = ask(Request::Changes);
  if (answer.kind == Answer::Kind::Refused) refuse(answer);
  ChangesRead read = changes_in(answer.text);
  if (!read.flaw.empty()) stop("BT1903", read.flaw);
  came_ = read.changes.size();
  return std::move(read.changes);
}

void Robot::take(const std::vector<Change>& changes) {
  std::vector<LogTransition> records;
  records.reserve(changes.size());
  for (const Change& change : changes) {
    LogStatus& status = known_[place_of(change.uid)];
    if (status == change.after) {
      throw Gap{"a node has got the status that it had"};
    }
    if (change.time + kBackwards < time_) {
      throw Gap{"another program has begun a recording, Groot2 for instance"};
    }
    time_ = std::max(time_, change.time);
    records.push_back({time_, change.uid, status, change.after});
    status = change.after;
    tick_ = ticks_->tick_at(time_);
  }
  if (!records.empty()) listener_.goes_on(records);
}

EntryValues Robot::entries() {
  EntryValues values;
  if (!has_entries_) return values;
  std::string names;
  for (const std::string& board : boards_) {
    names += (names.empty() ? "" : ";") + board;
  }
  const Answer answer = ask(Request::Entries, names);
  if (answer.kind == Answer::Kind::Refused) {
    has_entries_ = false;  // it has none to show
    return values;
  }
  const EntriesRead read = entries_in(answer.text);
  if (!read.flaw.empty()) stop("BT1903", read.flaw);
  for (const auto& [board, found] : read.boards) {
    const std::string above = board == log_.tree ? "" : board + "/";
    for (const auto& [name, value] : found) values[above + name] = value;
  }
  return values;
}

// --- Hooks -------------------------------------------------------------------

void Robot::arm() {
  for (std::size_t i = 0; i < hooks_.size(); ++i) {
    const std::int64_t from = following_.faults[i].from_tick;
    if (is_armed_[i] || (from > 1 && tick_ < from)) continue;
    const Answer answer = ask(Request::InsertHook, insert_text(hooks_[i]));
    if (answer.kind == Answer::Kind::Refused) refuse(answer);
    is_armed_[i] = true;
  }
}

void Robot::hear() {
  if (!ear_) return;
  for (auto uid = ear_->hear(); uid; uid = ear_->hear()) {
    const auto hook = std::ranges::find(hooks_, *uid, &Hook::uid);
    if (hook == hooks_.end()) continue;
    const auto fault = static_cast<std::size_t>(hook - hooks_.begin());
    if (!hook->is_break) {
      listener_.is_injected(fault);
    } else if (!stands_[fault]) {
      stands_[fault] = true;
      listener_.stands_at(fault);
    }
  }
  for (std::size_t i = 0; i < hooks_.size(); ++i) {
    if (!stands_[i] || !listener_.may_go_on(i)) continue;
    stands_[i] = false;
    ask(Request::UnlockHook, unlock_text(hooks_[i].uid));
  }
}

// Nothing of ours stays there.
void Robot::leave(std::vector<Diagnostic>& found) {
  if (!is_met_) return;
  is_leaving_ = true;
  bool is_heard = true;
  bool has_hooks = false;
  const auto tell = [&](Request kind, std::string_view argument) {
    if (!is_heard) return;
    const Answer answer = link_.ask(kind, kLastPatience, argument);
    is_heard = answer.kind == Answer::Kind::Good ||
               answer.kind == Answer::Kind::Refused;
  };
  for (std::size_t i = 0; i < hooks_.size(); ++i) {
    if (!is_armed_[i]) continue;
    has_hooks = true;
    tell(Request::RemoveHook, remove_text(hooks_[i].uid));
  }
  tell(Request::Record, "stop");
  if (is_heard || !has_hooks) return;
  found.push_back(
      file_error("BT1908", "groot2://" + address_.text(),
                 "what was injected could not be taken back: it does not "
                 "answer",
                 "where the program still runs, it forgets it 5 s after the "
                 "last request"));
  found.back().severity = Severity::Warning;
}

}  // namespace btcheck::groot2
