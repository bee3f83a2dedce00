// SPDX-License-Identifier: MIT
//
// The table is for people, in the order of TINA's sift: classes, markings,
// transitions. The object is for programs, with the same figures under fixed
// names; what a name means never changes, new ones are added at the end.
#include "report/text/space_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "report/text/report.hpp"

namespace btcheck {
namespace {

std::string_view reduction_word(Reduction reduction) {
  switch (reduction) {
    case Reduction::None:
      return "none";
    case Reduction::Live:
      return "live";
    case Reduction::Full:
      return "full";
  }
  return "";
}

std::string_view store_word(StateSetKind store) {
  return store == StateSetKind::Exact ? "exact" : "compressed";
}

// How many in a second, or bytes of each; nothing is ever divided by 0.
double per(std::uint64_t count, double unit) {
  return static_cast<double>(count) / std::max(unit, 1e-9);
}

double bytes_per_state(const SpaceReport& report) {
  return per(report.bytes, static_cast<double>(report.result.progress.states));
}

// One line of the table.
std::string row(std::string_view name, const std::string& figure,
                std::string_view unit = "") {
  return fmt::format("  {:<17} {:>15}{}\n", name, figure, unit);
}

}  // namespace

std::string space_text(const SpaceReport& report, const SpaceContext& context) {
  const SearchProgress& progress = report.result.progress;
  std::string text = fmt::format(
      "{}: {} automata; profile {}, tick {}, reduce {}\n", context.tree,
      context.network.automata.size(), profile_name(context.network.profile),
      tick_name(context.network.ticks), reduction_word(context.options.reduce));
  text += row("states", grouped(progress.states));
  text += row("markings", grouped(report.markings));
  text += row("transitions", grouped(progress.transitions));
  text += row("dead states", grouped(report.dead_states));
  text += row("depth", grouped(progress.depth));
  if (context.options.search == SearchOrder::BreadthFirst) {
    text += row("largest frontier", grouped(report.largest_frontier));
    text += row("threads", grouped(context.options.threads));
  }
  text += row("state vector", grouped(report.vector_bits), " bits");
  text += row("memory", fmt::format("{:.1f}", bytes_per_state(report)),
              " bytes per state");
  if (report.bytes_on_disk > 0) {
    text += row("on disk", grouped(report.bytes_on_disk >> 20), " MB");
  }
  text += row("peak of process", grouped(context.peak_bytes >> 20), " MB");
  text += row("time", fmt::format("{:.2f}", context.seconds),
              fmt::format(" s, {:.2f} M states/s, {:.2f} M transitions/s",
                          per(progress.states, context.seconds) / 1e6,
                          per(progress.transitions, context.seconds) / 1e6));
  if (!report.result.is_complete) {
    text += fmt::format("UNDECIDED  not all states, {}\n",
                        stop_text(report.result.stopped, progress));
  }
  return text;
}

std::string space_json(const SpaceReport& report, const SpaceContext& context) {
  const SearchProgress& progress = report.result.progress;
  nlohmann::ordered_json object;
  object["tree"] = context.tree;
  object["tick"] = tick_name(context.network.ticks);
  object["reduce"] = reduction_word(context.options.reduce);
  object["threads"] = context.options.threads;
  object["store"] = store_word(context.options.store);
  object["automata"] = context.network.automata.size();
  object["vector_bits"] = report.vector_bits;
  object["states"] = progress.states;
  object["markings"] = report.markings;
  object["transitions"] = progress.transitions;
  object["depth"] = progress.depth;
  object["largest_frontier"] = report.largest_frontier;
  object["dead_states"] = report.dead_states;
  object["seconds"] = context.seconds;
  object["states_per_second"] = per(progress.states, context.seconds);
  object["transitions_per_second"] = per(progress.transitions, context.seconds);
  object["bytes_per_state"] = bytes_per_state(report);
  object["search_bytes"] = report.bytes;
  object["peak_bytes"] = context.peak_bytes;
  object["complete"] = report.result.is_complete;
  const std::string_view stopped = stop_word(report.result.stopped);
  object["stopped"] = nullptr;
  if (!stopped.empty()) object["stopped"] = stopped;
  object["disk_bytes"] = report.bytes_on_disk;
  return object.dump() + "\n";
}

}  // namespace btcheck
