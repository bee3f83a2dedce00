// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "report/explain/text.hpp"
#include "report/text/report.hpp"
#include "report/whatif/words.hpp"
#include "text/json.hpp"
#include "trace/logs/behavior_log.hpp"

namespace btcheck {
namespace {

constexpr std::array<std::string_view, 5> kOutcomes = {
    "nothing", "success", "failure", "exception", "running"};

class Writer {
 public:
  explicit Writer(const ExplainedRun& run)
      : run_(run), moments_(run.log.moments), found_(run.found) {}

  Json document() const {
    const Mission& mission = moments_.last();
    const auto outcome = static_cast<std::size_t>(mission.outcome);
    return Json{
        {"schema", "btcheck-run-explanation/1"},
        {"log", run_.name},
        {"tree", run_.tree.file},
        {"records", run_.log.log.transitions.size()},
        {"knows_ticks", moments_.knows_ticks()},
        {"outcome", kOutcomes[outcome]},
        {"end", mission.end == 0 ? Json::null() : moment(mission.end - 1)},
        {"exception", moments_.exception()},
        {"causes", causes(found_.causes)},
        {"stopped", stop_word(found_.stopped)},
        {"refused", refused()},
        {"is_fault_needed", found_.suspects.is_needed()},
        {"suspects", suspects(found_.suspects.single)},
        {"together", suspects(found_.suspects.together)},
        {"decided", way(found_.last_way, found_.is_hopeless)},
        {"decided_with_fault",
         way(found_.last_way_with_fault, found_.is_hopeless_with_fault)},
        {"rows", rows()},
        {"findings", findings()}};
  }

 private:
  Json node(NodeId id) const { return Json(short_name(run_.tree, id)); }

  Json moment(std::size_t at) const {
    const Moment& there = moments_.at(at);
    return Json{{"tick", there.tick},
                {"seconds", seconds(there.time)},
                {"records", there.records}};
  }
  static Json seconds(std::int64_t time) {
    return Json::number(seconds_text(time));
  }
  Json moments(const std::vector<std::size_t>& at) const {
    Json all = Json::array();
    for (const std::size_t each : at) all.push(moment(each));
    return all;
  }

  Json causes(const std::vector<Cause>& some) const {
    Json all = Json::array();
    for (const Cause& each : some) {
      all.push(Json{{"node", node(each.node)},
                    {"did", answer_word(each.what)},
                    {"at", moments(each.at)},
                    {"because", causes(each.because)}});
    }
    return all;
  }

  Json refused() const {
    if (!found_.followed.refused) return Json::null();
    return Json{{"record", *found_.followed.refused + 1},
                {"tick", found_.followed.tick}};
  }

  Json suspects(const std::vector<Suspect>& some) const {
    Json all = Json::array();
    for (const Suspect& each : some) {
      Json faults = Json::array();
      for (const InjectedFault& fault : each.faults) {
        faults.push(facts_of(fault.fault.kind).word);
      }
      all.push(Json{{"node", node(each.leaf)},
                    {"faults", faults},
                    {"text", suspect_text(moments_, each)},
                    {"answers", each.answers},
                    {"at", moments(each.at)}});
    }
    return all;
  }

  Json way(const std::optional<LastWay>& last, bool is_hopeless) const {
    if (!last) return is_hopeless ? Json("never open") : Json::null();
    Json events = Json::array();
    for (const NodeEvent& event : last->way) {
      events.push(Json{{"node", node(event.node())},
                       {"does", answer_word(event.what())}});
    }
    Json by = Json::null();
    if (last->moment) {
      const Moment& there = moments_.at(*last->moment);
      by = Json{{"node", node(there.node)},
                {"did", answer_word(there.what)},
                {"at", moment(*last->moment)}};
    }
    return Json{{"records", last->records},
                {"by", by},
                {"way", events},
                {"ticks", last->ticks}};
  }

  Json rows() const {
    Json all = Json::array();
    for (const FaultRowInTable& row : found_.rows) {
      all.push(Json{{"number", row.number},
                    {"fault", facts_of(row.fault.fault.kind).word},
                    {"harm", facts_of(row.harm).word}});
    }
    return all;
  }
  Json findings() const {
    Json all = Json::array();
    for (const FindingInLog& each : found_.findings) {
      all.push(Json{{"code", each.code},
                    {"node", node(each.node)},
                    {"message", each.message},
                    {"tick", each.tick}});
    }
    return all;
  }

  const ExplainedRun& run_;
  const LogMoments& moments_;
  const Explanation& found_;
};

}  // namespace

std::string explain_json(const ExplainedRun& run) {
  return Writer(run).document().indented(0) + "\n";
}

}  // namespace btcheck
