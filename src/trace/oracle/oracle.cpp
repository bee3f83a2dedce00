// SPDX-License-Identifier: MIT
//
// A message is taken as a whole or not at all: a change that is not understood
// would leave the rules with half of a tick. What a line says is answered by
// its own text, so that the robot finds its `time` as it wrote it.
#include "trace/oracle/oracle.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>

#include "text/json.hpp"
#include "trace/conform/conform.hpp"
#include "trace/run/shown_text.hpp"

namespace btcheck {

using PlainJson = nlohmann::json;

struct Oracle::Change {
  std::int64_t time = 0;  // microseconds since 1970
  std::string name;
  std::optional<std::uint16_t> uid = {};
  LogStatus before{};
  LogStatus after{};

  // From an event; returns why it is none, or "".
  std::string read(const PlainJson& event);
};

namespace {

std::optional<LogStatus> status_in(const PlainJson& event, const char* name) {
  const auto found = event.find(name);
  if (found == event.end() || !found->is_string()) return std::nullopt;
  const auto place =
      std::ranges::find(kLogStatusNames, found->get_ref<const std::string&>());
  if (place == kLogStatusNames.end()) return std::nullopt;
  return static_cast<LogStatus>(place - kLogStatusNames.begin());
}

// {"sec": 12, "nanosec": 5000}, as microseconds.
std::optional<std::int64_t> time_in(const PlainJson& event) {
  const auto stamp = event.find("timestamp");
  if (stamp == event.end() || !stamp->is_object()) return std::nullopt;
  const auto seconds = stamp->find("sec");
  const auto rest = stamp->find("nanosec");
  const auto fits = [&](const auto& number, std::int64_t least,
                        std::int64_t most) {
    if (number == stamp->end() || !number->is_number_integer()) return false;
    if (number->is_number_unsigned() &&
        number->template get<std::uint64_t>() > std::uint64_t{INT64_MAX}) {
      return false;
    }
    const auto value = number->template get<std::int64_t>();
    return value >= least && value <= most;
  };
  if (!fits(seconds, INT32_MIN, INT32_MAX) || !fits(rest, 0, 999'999'999)) {
    return std::nullopt;
  }
  return seconds->get<std::int64_t>() * 1'000'000 +
         rest->get<std::int64_t>() / 1000;
}

// Its uid, if it has one; false where that is none.
bool take_uid(const PlainJson& event, std::optional<std::uint16_t>& uid) {
  const auto found = event.find("uid");
  if (found == event.end()) return true;
  if (!found->is_number_unsigned()) return false;
  const auto number = found->get<std::uint64_t>();
  if (number > UINT16_MAX) return false;
  uid = static_cast<std::uint16_t>(number);
  return true;
}

// The object with one more member.
std::string with_member(std::string_view object, std::string_view name,
                        const std::string& text) {
  const std::size_t end = object.rfind('}');
  std::string made(object.substr(0, end));
  const std::size_t last = made.find_last_not_of(" \t\r\n");
  if (made[last] != '{') made += ", ";
  return made + Json(name).text() + ": " + Json(text).text() + "}";
}

}  // namespace

Result<std::unique_ptr<Oracle>> Oracle::make(
    const BehaviorTree& tree, const RecordedRun& run,
    const std::vector<OracleRules>& rules, const LogReading& reading) {
  Result<std::unique_ptr<Oracle>> result;
  std::unique_ptr<Oracle> made(new Oracle(tree, run, reading));
  for (const OracleRules& each : rules) {
    auto watch =
        RecordedWatch::make(run, Recording::Log, each.file, each.source);
    std::ranges::move(watch.diagnostics,
                      std::back_inserter(result.diagnostics));
    if (watch.value) made->watches_.push_back(std::move(*watch.value));
  }
  if (!has_error(result.diagnostics)) result.value = std::move(made);
  return result;
}

// The nodes of the log are those of the tree, each in its place: by uid or, of
// a Nav2 that says none, by the names that only one of them has.
void Oracle::begin(bool has_uids, std::vector<Diagnostic>& told) {
  log_.topic = "events";
  log_.has_uids = has_uids;
  const BehaviorLog all = log_of_tree(run_);
  std::map<std::string, bool> known;
  for (const LogNode& node : all.nodes) {
    if (!has_uids && !known.emplace(node.name, true).second) continue;
    LogNode& made = log_.nodes.emplace_back();
    made.uid =
        has_uids ? node.uid : static_cast<std::uint16_t>(log_.nodes.size());
    made.name = made.type = node.name;
  }
  auto in_tree = placed(std::move(log_), tree_, run_);
  told = std::move(in_tree.diagnostics);
  log_ = std::move(*in_tree.value);
  player_ = std::make_unique<LogPlayer>(log_, reading_, TickWays::All);
}

// Why the changes are none of this tree; "" where they are taken.
std::string Oracle::take(const std::vector<Change>& changes,
                         std::vector<Diagnostic>& told) {
  if (changes.empty()) return "";
  if (!player_) begin(changes.front().uid.has_value(), told);
  std::vector<LogTransition> records;
  for (const Change& change : changes) {
    const auto is_meant = [&](const LogNode& node) {
      return (!change.uid || node.uid == *change.uid) &&
             (node.name == change.name || node.type == change.name);
    };
    const auto node = std::ranges::find_if(log_.nodes, is_meant);
    if (node == log_.nodes.end()) {
      return fmt::format(
          "the tree has no node `{}`{}", shortened(one_line(change.name), 40),
          change.uid ? fmt::format(" with the uid {}", *change.uid) : "");
    }
    if (node->is_silent) continue;
    if (log_.begin == 0) log_.begin = changes.front().time;
    records.push_back(
        {change.time - log_.begin, node->uid, change.before, change.after});
  }
  changes_ += changes.size();
  const std::function<bool()> see = [&] {
    for (const auto& watch : watches_) {
      watch->see(
          player_->state(), [&](std::size_t n) { return player_->unseen(n); },
          player_->is_possible());
    }
    return true;
  };
  // Nav2 sends a message when a tick is over; a robot that is woken up may have
  // ended others before.
  player_->play_on(records, see);
  if (!records.empty()) player_->end_here(see);
  return "";
}

std::string Oracle::Change::read(const PlainJson& event) {
  if (!event.is_object()) return "is no object";
  const auto node = event.find("node_name");
  if (node == event.end() || !node->is_string()) {
    return "has no text `node_name`";
  }
  const auto stamp = time_in(event);
  if (!stamp) return "has no `timestamp` with `sec` and `nanosec`";
  const auto was = status_in(event, "previous_status");
  const auto is = status_in(event, "current_status");
  if (!was || !is) {
    return "has no `previous_status` and `current_status`, such as IDLE and "
           "RUNNING";
  }
  *this = {*stamp, *node, {}, *was, *is};
  return take_uid(event, uid)
             ? ""
             : "has an `uid` that is no number from 0 to 65535";
}

Oracle::Answer Oracle::answer(std::string_view line) {
  ++lines_;
  Answer answer;
  const auto refuse = [&](const std::string& why) {
    Diagnostic& found = answer.told.emplace_back();
    found.severity = Severity::Warning;
    found.code = "BT1813";
    found.message = fmt::format("line {} is not understood: {}", lines_, why);
    found.help = "write a message of /behavior_tree_log as one JSON object";
    const Json told{{"verdict", verdict()}, {"error", why}};
    answer.line = told.text();
  };
  const PlainJson message = PlainJson::parse(line, nullptr, false);
  if (message.is_discarded()) {
    refuse("it is no JSON");
    return answer;
  }
  if (!message.is_object()) {
    refuse("it is no object");
    return answer;
  }
  std::vector<Change> changes;
  if (const auto events = message.find("event_log"); events != message.end()) {
    if (!events->is_array()) {
      refuse("`event_log` is no list");
      return answer;
    }
    for (const PlainJson& event : *events) {
      Change change;
      const std::string why = change.read(event);
      if (!why.empty()) {
        refuse(fmt::format("event {} of it {}", changes.size() + 1, why));
        return answer;
      }
      changes.push_back(std::move(change));
    }
  }
  const std::string why = take(changes, answer.told);
  if (!why.empty()) {
    refuse(why);
    return answer;
  }
  answer.line = with_member(line, "verdict", std::string(verdict()));
  const auto broken = violated();
  if (!broken.empty()) {
    std::string names;
    for (const std::string& name : broken) {
      names += (names.empty() ? "" : ", ") + name;
    }
    answer.line = with_member(answer.line, "spec", names);
  }
  return answer;
}

std::string_view Oracle::verdict() const {
  if (!violated().empty()) return "false";
  bool is_open = watches_.empty();
  for (const auto& watch : watches_) {
    for (const auto& rule : watch->rules()) {
      is_open |= rule.run.outlook() != Outlook::Satisfied;
    }
  }
  return is_open ? "unknown" : "true";
}

std::vector<std::string> Oracle::violated() const {
  std::vector<std::string> names;
  for (const auto& watch : watches_) {
    for (const auto& rule : watch->rules()) {
      const Property& property = *rule.rule->property;
      if (rule.run.outlook() == Outlook::Violated &&
          property.expectation != Expectation::Violated) {
        names.push_back(property.name);
      }
    }
  }
  return names;
}

}  // namespace btcheck
