// SPDX-License-Identifier: MIT
//
// A row for each choice: the option of the program, the field of a Request.
#include "text/choice.hpp"

#include <fmt/format.h>

#include <array>

#include "text/tables.hpp"

namespace btcheck {
namespace {

struct Words {
  Choice id;
  std::string_view option;
  std::string_view field;  // the option's name where no request has it
};

constexpr std::array<Words, 21> kWords = {{
    {Choice::Assume, "--assume", "`assume`"},
    {Choice::Disk, "--on-disk", "`on_disk`"},
    {Choice::Export, "--export", "`export`"},
    {Choice::Format, "--to", "`to`"},
    {Choice::Leaves, "--leaves", "`leaves`"},
    {Choice::Loop, "--loop", "`loops`"},
    {Choice::MainTree, "--main-tree", "`main_tree`"},
    {Choice::MaxStates, "--max-states", "`states`"},
    {Choice::Memory, "--memory", "`bytes`"},
    {Choice::Models, "--models", "`models`"},
    {Choice::Profile, "--profile", "`profile`"},
    {Choice::Reduce, "--reduce", "`reduce`"},
    {Choice::Rules, "--prop", "`rules`"},
    {Choice::Tick, "--tick", "`ticks`"},
    {Choice::TickGap, "--tick-gap", "`tick_gap`"},
    {Choice::TickMs, "--tick-ms", "`tick_milliseconds`"},
    {Choice::Ticks, "--ticks", "`ticks`"},
    {Choice::Timeout, "--timeout", "`seconds`"},
    {Choice::Topic, "--topic", "`topic`"},
    {Choice::TraceDir, "--trace-dir", "`trace_dir`"},
    {Choice::WakeUps, "--wake-ups", "`wake_ups`"},
}};
static_assert(is_indexed(kWords, &Words::id));

thread_local bool speaks_of_requests = false;

const Words& words_of(Choice choice) {
  return kWords[static_cast<std::size_t>(choice)];
}

}  // namespace

std::string_view word(Choice choice) {
  const Words& words = words_of(choice);
  return speaks_of_requests ? words.field : words.option;
}

std::string word(Choice choice, std::string_view value) {
  const std::string_view name = word(choice);
  if (!speaks_of_requests) return fmt::format("{} {}", name, value);
  return fmt::format("{} = {}`", name.substr(0, name.size() - 1), value);
}

SpeaksOfRequests::SpeaksOfRequests() : before_(speaks_of_requests) {
  speaks_of_requests = true;
}

SpeaksOfRequests::~SpeaksOfRequests() { speaks_of_requests = before_; }

}  // namespace btcheck
