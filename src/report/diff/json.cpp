// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "model/tree/node_types.hpp"
#include "report/diff/told.hpp"
#include "report/text/report.hpp"
#include "report/whatif/words.hpp"
#include "text/json.hpp"
#include "text/version.hpp"

namespace btcheck {
namespace {

class DiffDocument {
 public:
  explicit DiffDocument(const DiffReport& report)
      : report_(report), diff_(report.diff) {}

  Json take() const {
    Json trees = Json::array();
    for (std::size_t side = 0; side < 2; ++side) {
      const DiffSide& own = diff_.sides[side];
      trees.push(Json{{"file", report_.names[side]},
                      {"profile", profile_name(own.tree.profile)},
                      {"nodes", own.tree.nodes.size()},
                      {"states", own.states}});
    }
    const std::string_view stopped = stop_word(diff_.stopped);
    Json document{
        {"schema", kDiffSchema},
        {"tool", "btcheck"},
        {"version", kVersion},
        {"trees", trees},
        {"ticks", tick_name(diff_.sides[0].network.ticks)},
        {"caller", report_.caller == Caller::Any ? "any" : "once"},
        {"observe", report_.observe.empty() ? Json::array().push("leaves")
                                            : Json::array(report_.observe)},
        {"verdict", report_.verdict()},
        {"stopped", stopped.empty() ? Json::null() : Json(stopped)},
        {"classes", diff_.classes},
        {"watched", watched()},
        {"difference",
         diff_.difference ? difference(*diff_.difference) : Json::null()},
        {"rows", rows()}};
    document.add("changes", report_.changes ? changes() : Json::null());
    return document;
  }

 private:
  Json name(const std::optional<NodeId>& node, std::size_t side) const {
    return node ? Json(short_name(diff_.sides[side].tree, *node))
                : Json::null();
  }

  Json watched() const {
    Json all = Json::array();
    for (const WatchedPair& each : diff_.watched) {
      all.push(
          Json{{"nodes", Json::array()
                             .push(name(each.nodes.one, 0))
                             .push(name(each.nodes.other, 1))},
               {"is_root", each.is_root},
               {"otherwise",
                each.otherwise.empty() ? Json::null() : Json(each.otherwise)}});
    }
    return all;
  }

  static Json event(SeenEvent event) {
    if (event == kThrown) {
      return Json{{"watched", Json::null()}, {"what", "exception"}};
    }
    return Json{{"watched", event.number()},
                {"what", answer_word(event.what())}};
  }
  static Json events(const std::vector<SeenEvent>& all) {
    Json list = Json::array();
    for (const SeenEvent& each : all) list.push(event(each));
    return list;
  }

  static Json difference(const Difference& found) {
    switch (found.kind) {
      case Difference::Kind::Runs:
        return Json{{"kind", "run"},
                    {"of", found.side},
                    {"run", events(found.run)},
                    {"end", found.end == TraceEnd::Seen    ? "seen"
                            : found.end == TraceEnd::Stops ? "stops"
                                                           : "unseen"},
                    {"instead", events(found.instead)},
                    {"other_stops", found.other_stops},
                    {"other_unseen", found.other_unseen}};
      case Difference::Kind::Told:
        return Json{{"kind", "told"}, {"run", events(found.run)}};
      case Difference::Kind::Choices:
        break;
    }
    return Json{{"kind", "choice"}, {"play", play(found.play)}};
  }

  static Json play(const std::vector<PlayRound>& rounds) {
    static constexpr std::string_view kKinds[] = {"moves", "settles", "yields",
                                                  "wins", "stays"};
    Json all = Json::array();
    for (const PlayRound& round : rounds) {
      all.push(Json{{"kind", kKinds[static_cast<std::size_t>(round.kind)]},
                    {"of", round.is_of_first ? 0 : 1},
                    {"event", round.label == LabelledGraph::kSilent
                                  ? Json::null()
                                  : event(SeenEvent(round.label))}});
    }
    return all;
  }

  Json rows() const {
    Json all = Json::array();
    for (const DiffRow& row : rows_of(report_)) {
      all.push(
          Json{{"tick", row.tick},
               {"cells", Json::array().push(row.cells[0]).push(row.cells[1])},
               {"differs", row.differs}});
    }
    return all;
  }

  Json changes() const {
    static constexpr std::string_view kKinds[] = {"verdict", "new", "gone"};
    Json all = Json::array();
    for (const DiffChange& each : *report_.changes) {
      Json change{{"kind", kKinds[static_cast<std::size_t>(each.kind)]},
                  {"text", each.text},
                  {"file", each.file},
                  {"line", each.line}};
      if (each.kind == DiffChange::Kind::Verdict) {
        change.add("was", each.was);
        change.add("is", each.is);
      } else {
        change.add("code", each.code);
      }
      all.push(change);
    }
    return all;
  }

  const DiffReport& report_;
  const Diff& diff_;
};

}  // namespace

std::string diff_json(const DiffReport& report) {
  return DiffDocument(report).take().indented(2) + '\n';
}

}  // namespace btcheck
