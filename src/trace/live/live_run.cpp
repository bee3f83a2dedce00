// SPDX-License-Identifier: MIT
#include "trace/live/live_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "text/json.hpp"
#include "text/numbers.hpp"
#include "trace/viewer/html.hpp"

namespace btcheck {
namespace {

// Place::heard of those who have been sent away.
constexpr std::size_t kAway = static_cast<std::size_t>(-1);

}  // namespace

LiveRun::LiveRun(RecordedRun beginning, Kind kind, std::size_t most_cells)
    : kind_(kind), most_cells_(most_cells) {
  open_chapter(std::move(beginning));
}

void LiveRun::open_chapter(RecordedRun beginning) {
  ++chapter_;
  messages_.clear();
  states_ = beginning.states.size();
  beginning_ = std::make_shared<const RecordedRun>(std::move(beginning));
  packer_ = std::make_unique<RunPacker>(*beginning_);
  Json document = packer_->about();
  document.add("live", chapter_);
  if (kind_ == Kind::Replaced) document.add("replaced", 1);
  if (!rules_.empty()) document.add("rules", told_rules());
  packer_->add(beginning_->states, document);
  packed_ = safe_json(document);
}

// States are told as numbers of the chapter's; those that are dropped, not.
Json LiveRun::told_rules() const {
  Json list = Json::array();
  for (const LiveVerdict& rule : rules_) {
    Json told{{"name", rule.name},
              {"text", rule.text},
              {"verdict", rule.verdict},
              {"moment", rule.moment}};
    if (rule.state != kNoState && rule.state >= before_) {
      told.add("step", rule.state - before_);
    }
    if (rule.is_expected) told.add("expected", 1);
    list.push(std::move(told));
  }
  return list;
}

void LiveRun::judge(std::vector<LiveVerdict> rules) {
  {
    const std::lock_guard lock(mutex_);
    if (rules == rules_) return;
    rules_ = std::move(rules);
    push("verdict", told_rules().text());
  }
  tell();
}

void LiveRun::push(std::string_view event, std::string_view data) {
  std::string text = fmt::format("id: {}-{}\n", chapter_, messages_.size() + 1);
  if (!event.empty()) text += fmt::format("event: {}\n", event);
  text += fmt::format("data: {}\n\n", data);
  messages_.push_back(std::make_shared<const std::string>(std::move(text)));
}

void LiveRun::add(std::span<const RecordedState> states) {
  if (states.empty()) return;
  {
    const std::lock_guard lock(mutex_);
    const std::size_t width =
        std::max<std::size_t>(1, beginning_->nodes.size());
    if (states_ > most_cells_ / width) {
      RecordedRun beginning = *beginning_;
      beginning.states = {states.front()};
      states = states.subspan(1);
      before_ += states_;
      open_chapter(std::move(beginning));
    }
    Json document = Json::object();
    packer_->add(states, document);
    states_ += states.size();
    push("", document.text());
  }
  tell();
}

void LiveRun::end(std::string_view words) {
  {
    const std::lock_guard lock(mutex_);
    if (is_over_) return;
    is_over_ = true;
    push("end", Json(words).text());
  }
  tell();
}

void LiveRun::begin_anew(RecordedRun beginning) {
  {
    const std::lock_guard lock(mutex_);
    before_ = 0;
    rules_.clear();
    open_chapter(std::move(beginning));
  }
  tell();
}

void LiveRun::on_news(std::function<void()> hear) {
  const std::lock_guard lock(mutex_);
  hear_ = std::move(hear);
}

void LiveRun::tell() const {
  std::function<void()> hear;
  {
    const std::lock_guard lock(mutex_);
    hear = hear_;
  }
  if (hear) hear();
}

std::optional<LiveRun::Place> LiveRun::place_of(std::string_view text) {
  const std::size_t line = text.find('-');
  if (line == std::string_view::npos) return std::nullopt;
  const auto chapter = as_number<std::uint64_t>(text.substr(0, line));
  const auto heard = as_number<std::size_t>(text.substr(line + 1));
  if (!chapter || !heard) return std::nullopt;
  return Place{*chapter, *heard};
}

LiveRun::Message LiveRun::next(Place& place) const {
  static const Message kAnew =
      std::make_shared<const std::string>("event: anew\ndata: \n\n");
  const std::lock_guard lock(mutex_);
  if (place.heard == kAway) return nullptr;
  if (place.chapter != chapter_ || place.heard > messages_.size()) {
    place.heard = kAway;
    return kAnew;
  }
  return place.heard < messages_.size() ? messages_[place.heard++] : nullptr;
}

bool LiveRun::is_told(const Place& place) const {
  const std::lock_guard lock(mutex_);
  return place.heard == kAway || (is_over_ && place.chapter == chapter_ &&
                                  place.heard >= messages_.size());
}

std::string LiveRun::page(std::string_view nonce) const {
  std::shared_ptr<const RecordedRun> beginning;
  std::string packed;
  {
    const std::lock_guard lock(mutex_);
    beginning = beginning_;
    packed = packed_;
  }
  return live_page(*beginning, std::move(packed), nonce);
}

}  // namespace btcheck
