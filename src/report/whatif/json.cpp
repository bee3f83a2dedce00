// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>

#include "model/tree/node_types.hpp"
#include "report/formats/reported.hpp"
#include "report/text/report.hpp"
#include "report/whatif/files.hpp"
#include "report/whatif/words.hpp"
#include "text/json.hpp"
#include "text/version.hpp"

namespace btcheck {
namespace {

std::string_view event_word(TopEvent::Kind kind) {
  switch (kind) {
    case TopEvent::Kind::Fails:
      return "fails";
    case TopEvent::Kind::CannotSucceed:
      return "cannot-succeed";
    case TopEvent::Kind::NeverEnds:
      return "never-ends";
    case TopEvent::Kind::Throws:
      return "throws";
    case TopEvent::Kind::Rule:
      return "rule-breaks";
  }
  return "";
}

Json or_null(std::string_view text) {
  return text.empty() ? Json::null() : Json(text);
}

class Document {
 public:
  explicit Document(const WhatIfReport& report)
      : report_(report), tree_(report.tree()), result_(report.result) {}

  Json take() const {
    Json document{{"schema", kWhatIfSchema},
                  {"tool", "btcheck"},
                  {"version", kVersion},
                  {"tree", tree_.file},
                  {"profile", profile_name(tree_.profile)},
                  {"ticks", tick_name(report_.ticks)},
                  {"options", options()},
                  {"rules", rules()},
                  {"broken_rules", Json::array(result_.broken_rules)},
                  {"healthy", effect_of(result_.healthy)},
                  {"taken_for_conditions", names(result_.possible.guessed)},
                  {"left_out", left_out()},
                  {"stopped", or_null(stop_word(result_.stopped))},
                  {"score", score_of(result_.score())},
                  {"parts", parts()}};
    Json rows = Json::array();
    for (std::size_t n = 1; n <= result_.rows.size(); ++n) rows.push(row(n));
    document.add("rows", rows);
    document.add("pairs_in_all", result_.pairs_in_all);
    document.add("pairs_searched", result_.pairs_searched);
    Json pairs = Json::array();
    for (std::size_t n = result_.rows.size() + 1; n <= row_count(result_);
         ++n) {
      pairs.push(row(n));
    }
    document.add("pairs", pairs);
    document.add("cut_sets", cut_sets());
    return document;
  }

 private:
  template <class Range>
  Json names(const Range& nodes) const {
    Json all = Json::array();
    for (const NodeId node : nodes) all.push(short_name(tree_, node));
    return all;
  }
  static Json kinds(const std::vector<FaultKind>& all) {
    Json words = Json::array();
    for (const FaultKind kind : all) words.push(facts_of(kind).word);
    return words;
  }

  Json options() const {
    const FaultChoices& choices = result_.choices;
    return Json{
        {"order", result_.order},
        {"others", choices.others == Others::Work ? "work" : "contract"},
        {"late", choices.late},
        {"faults", kinds(choices.kinds)},
        {"only", or_null(report_.only)}};
  }

  Json rules() const {
    Json all = Json::array();
    for (std::size_t file = 0; file < result_.rules.size(); ++file) {
      for (const Property& rule : result_.rules[file].properties) {
        all.push(Json{{"name", rule.name},
                      {"file", report_.input.rule_texts[file].name()}});
      }
    }
    return all;
  }

  Json left_out() const {
    Json all = Json::array();
    for (const OmittedFaults& each : result_.possible.left_out) {
      all.push(Json{{"why", each.why},
                    {"leaves", names(each.leaves)},
                    {"faults", kinds(each.kinds)}});
    }
    return all;
  }

  static Json effect_of(const Effect& effect) {
    return Json::array(outcomes_of(effect));
  }

  static Json score_of(const Score& score) {
    Json all{{"told", score_text(score)}, {"faults", score.total()}};
    for (std::size_t h = 0; h < kHarms; ++h) {
      all.add(kHarmFacts[h].word, score.of[h]);
    }
    return all;
  }

  Json parts() const {
    Json all = Json::array();
    for (const NodeId part : scored_parts(tree_)) {
      const Score score = result_.score_below(tree_, part);
      if (score.total() == 0) continue;
      all.push(Json{{"node", short_name(tree_, part)},
                    {"path", stable_path(tree_, part)},
                    {"score", score_of(score)}});
    }
    return all;
  }

  Json fault(const InjectedFault& fault) const {
    const Node& node = tree_.node(fault.leaf);
    return Json{
        {"leaf", short_name(tree_, fault.leaf)},
        {"path", stable_path(tree_, fault.leaf)},
        {"type", node.id.empty() ? std::string(type_name(node.type)) : node.id},
        {"file", tree_.file_of(fault.leaf)},
        {"line", node.span.line},
        {"kind", facts_of(fault.fault.kind).word}};
  }

  Json row(std::size_t number) const {
    const FaultRow& row = row_numbered(result_, number);
    Json faults = Json::array();
    for (const InjectedFault& each : row.faults) faults.push(fault(each));
    return Json{
        {"number", number},
        {"faults", faults},
        {"harm", facts_of(row.harm).word},
        {"told", fmt::format("{}: the mission {}", faults_text(tree_, row),
                             harm_text(tree_, result_, row))},
        {"outcomes", effect_of(row.effect)},
        {"outcomes_without", effect_of(row.healthy)},
        {"broken", Json::array(broken_rules(result_, row.effect))},
        {"left_running", names(row.effect.left_running)},
        {"left_on", names(row.effect.left_on)},
        {"notice", notice(row)},
        {"within", row.within ? Json(*row.within) : Json::null()},
        {"recovery", recovery(row)},
        {"states", row.effect.states},
        {"stopped", or_null(stop_word(row.effect.stopped))},
        {"run", run(number)}};
  }

  Json notice(const FaultRow& row) const {
    if (!row.notice) return Json::null();
    return Json{{"node", short_name(tree_, row.notice->node)},
                {"answer", answer_word(row.notice->what)},
                {"ticks", row.notice->ticks}};
  }

  Json recovery(const FaultRow& row) const {
    if (!row.recovery) return Json::null();
    return Json{{"caught_by", short_name(tree_, row.recovery->caught_by)},
                {"through", names(row.recovery->through)},
                {"asked_again", row.recovery->is_asked_again}};
  }

  // What happens, tick by tick.
  Json run(std::size_t number) const {
    const FaultRow& row = row_numbered(result_, number);
    const auto run = run_of_row(report_, number);
    if (!run) return Json::null();
    Json ticks = Json::array();
    int tick = -1;
    std::vector<std::string> events;
    const auto close = [&] {
      if (!events.empty()) {
        ticks.push(Json{{"tick", tick}, {"events", Json::array(events)}});
      }
      events.clear();
    };
    for (const RecordedState& state : run->states) {
      if (state.event.empty()) continue;
      if (state.tick != tick) close();
      tick = state.tick;
      events.push_back(state.event);
    }
    close();
    const std::string file =
        number <= report_.runs.size() ? report_.runs[number - 1] : "";
    return Json{{"struck_in", row.struck_in},
                {"ended_in", row.ended_in},
                {"goes_round", run->loop != kNoState},
                {"ticks", ticks},
                {"file", or_null(file)}};
  }

  Json cut_sets() const {
    Json all = Json::array();
    for (const CutSets& cut : result_.cut_sets) {
      Json sets = Json::array();
      for (const auto& set : cut.sets) sets.push(number_of(set));
      const bool is_rule = cut.event.kind == TopEvent::Kind::Rule;
      all.push(Json{{"event", event_word(cut.event.kind)},
                    {"rule", is_rule ? Json(result_.rules[cut.event.rule.file]
                                                .properties[cut.event.rule.rule]
                                                .name)
                                     : Json::null()},
                    {"told", event_text(result_, cut.event)},
                    {"sets", sets}});
    }
    return all;
  }

  // A set is a row, or a pair.
  std::size_t number_of(const std::vector<InjectedFault>& set) const {
    const auto& rows = set.size() == 1 ? result_.rows : result_.pairs;
    const std::size_t before = set.size() == 1 ? 0 : result_.rows.size();
    const auto found = std::ranges::find(rows, set, &FaultRow::faults);
    return before + static_cast<std::size_t>(found - rows.begin()) + 1;
  }

  const WhatIfReport& report_;
  const BehaviorTree& tree_;
  const WhatIf& result_;
};

}  // namespace

std::string what_if_json(const WhatIfReport& report) {
  return Document(report).take().indented(2) + '\n';
}

}  // namespace btcheck
