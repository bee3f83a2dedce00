// SPDX-License-Identifier: MIT
//
// The object and the lines are made of the same pieces, under the same names.
#include <nlohmann/json.hpp>
#include <utility>

#include "report/formats/formats.hpp"
#include "report/text/report.hpp"
#include "report/text/space_report.hpp"
#include "text/version.hpp"

namespace btcheck {
namespace {

// Keys keep the order in which they are written.
using OrderedJson = nlohmann::ordered_json;

// Bytes that are no UTF-8 are replaced.
std::string dumped(const OrderedJson& value, int indent = -1) {
  return value.dump(indent, ' ', false, OrderedJson::error_handler_t::replace) +
         "\n";
}

// An object with these members, a name and a value by turns, and room for
// more: one that grows copies all that it has.
template <class... Members>
OrderedJson object(std::size_t more, Members&&... members) {
  OrderedJson json = OrderedJson::object();
  auto& to = json.get_ref<OrderedJson::object_t&>();
  to.reserve(sizeof...(members) / 2 + more);
  const auto add = [&to](auto&& self, auto&& name, auto&& value,
                         auto&&... rest) -> void {
    to.emplace_back(name, OrderedJson(std::forward<decltype(value)>(value)));
    if constexpr (sizeof...(rest) > 0) {
      self(self, std::forward<decltype(rest)>(rest)...);
    }
  };
  add(add, std::forward<Members>(members)...);
  return json;
}

// null where there is nothing.
OrderedJson given(bool is_there, const OrderedJson& value) {
  return is_there ? value : OrderedJson(nullptr);
}
OrderedJson word(std::string_view text) { return given(!text.empty(), text); }

void add_place(OrderedJson& to, const Place& place) {
  to["file"] = place.file;
  if (place.span.line == 0) return;
  to["line"] = place.span.line;
  to["column"] = place.span.column;
  to["length"] = place.span.length;
}

OrderedJson events_json(const ToldRun& run) {
  OrderedJson events = OrderedJson::array();
  for (const ToldStep& step : run.steps) {
    if (step.kind == ToldStep::Kind::Time) continue;
    const bool is_event = step.kind == ToldStep::Kind::Event;
    OrderedJson event =
        object(3, "time", step.time, is_event ? "event" : "remark", step.text);
    if (is_event) {
      event["chosen"] = step.is_chosen;
      event["line"] = step.place.span.line;
      event["column"] = step.place.span.column;
    }
    events.push_back(std::move(event));
  }
  return events;
}

OrderedJson run_json(const std::optional<ToldRun>& run) {
  if (!run) return nullptr;
  return object(0, "unit", run->unit, "time", run->time, "infinite",
                run->loop.has_value(), "events", events_json(*run));
}

// Each change replaces whole lines: from column 1 of one to column 1 of
// another.
OrderedJson repair_json(const std::optional<CheckedRepair>& repair) {
  if (!repair) return nullptr;
  OrderedJson changes = OrderedJson::array();
  for (const ChangedFile& file : repair->files) {
    for (const ChangedLines& each : file.changes) {
      changes.push_back({{"file", file.file},
                         {"line", each.first},
                         {"end_line", line_behind(each)},
                         {"replacement", text_put_in(each)}});
    }
  }
  return {{"of", word(repair->comes_from)}, {"changes", std::move(changes)}};
}

OrderedJson diagnostic_json(const Diagnostic& diagnostic) {
  OrderedJson json =
      object(7, "severity", severity_name(diagnostic.severity), "code",
             diagnostic.code, "message", diagnostic.message);
  add_place(json, {diagnostic.file, diagnostic.span});
  json["label"] = word(diagnostic.label);
  json["help"] = word(diagnostic.help);
  json["repair"] = repair_json(diagnostic.repair);
  return json;
}

OrderedJson finding_json(const Report& report, const Finding& finding) {
  OrderedJson json =
      object(9, "severity", severity_name(finding.severity), "code",
             finding.code, "title", finding.title, "message", finding.message);
  add_place(json, finding.place);
  json["node"] = word(finding.node);
  json["fingerprint"] = fingerprint_of(report, finding);
  json["related"] = OrderedJson::array();
  for (const RelatedPlace& related : finding.related) {
    OrderedJson place = {{"text", related.text}};
    add_place(place, related.place);
    json["related"].push_back(std::move(place));
  }
  json["repair"] = repair_json(finding.repair);
  json["answers"] = OrderedJson::array();
  for (const ReportedReply& each : finding.answers) {
    json["answers"].push_back({{"words", each.words},
                               {"contracts", each.contracts},
                               {"comment", word(each.comment)}});
  }
  return json;
}

OrderedJson expectation_json(Expectation expectation) {
  if (expectation == Expectation::None) return nullptr;
  return expectation == Expectation::Holds ? "HOLDS" : "VIOLATED";
}

void add_progress(OrderedJson& to, const SearchProgress& progress) {
  to["states"] = progress.states;
  to["transitions"] = progress.transitions;
}

OrderedJson verdict_json(const ReportedProperty& property) {
  OrderedJson json =
      object(18, "name", property.name, "title", word(property.title),
             "property", property.text, "tags", property.tags);
  add_place(json, property.place);
  const bool has_failed = !property.error.empty();
  const bool is_open = has_failed || property.verdict == Verdict::Undecided;
  json["verdict"] = given(!has_failed, verdict_word(property.verdict));
  json["expected"] = expectation_json(property.expectation);
  json["met"] = given(!is_open, property.is_met);
  json["vacuous"] = property.is_vacuous;
  json["note"] = word(property.note);
  json["why"] = word(property.reason);
  json["stopped"] = word(stop_word(property.stopped));
  json["error"] = word(property.error);
  add_progress(json, property.progress);
  json["asked"] =
      given(property.triggers.has_value(), property.triggers.value_or(0));
  json["longest_answer"] =
      given(property.longest_answer >= 0, property.longest_answer);
  json["for_every"] = OrderedJson::array();
  for (const ReportedCount& each : property.for_every) {
    OrderedJson count = {{"node", each.node},
                         {"attribute", each.attribute},
                         {"from", each.from}};
    add_place(count, each.place);
    json["for_every"].push_back(std::move(count));
  }
  json["run"] = run_json(property.run);
  return json;
}

OrderedJson answer_json(const ReportedAnswer& answer) {
  return object(0, "key", answer.key, "question", answer.question, "verdict",
                verdict_word(answer.verdict), "answer", answer.answer, "fault",
                answer.is_fault, "run", run_json(answer.run));
}

OrderedJson node_json(const ReportedNode& node) {
  OrderedJson json = object(4 + kNodeQuestionCount, "key", node.key, "name",
                            node.name, "type", node.type);
  add_place(json, node.place);
  for (std::size_t q = 0; q < kNodeQuestionCount; ++q) {
    if (!node.answers[q]) continue;
    OrderedJson& answer = json[std::string(kNodeQuestionNames[q])];
    answer = object(1, "verdict", verdict_word(node.answers[q]->verdict));
    if (node.answers[q]->verdict == Verdict::Holds) {
      answer["time"] = node.answers[q]->time;
    }
  }
  return json;
}

template <class Parts, class ToJson>
OrderedJson array_of(const Parts& parts, const ToJson& to_json) {
  OrderedJson array = OrderedJson::array();
  array.get_ref<OrderedJson::array_t&>().reserve(parts.size());
  for (const auto& part : parts) array.push_back(to_json(part));
  return array;
}

// How the properties of a file were checked.
OrderedJson file_heading(const ReportedFile& file) {
  return {{"properties", word(file.properties)},
          {"profile", file.profile},
          {"tick", file.ticks},
          {"assumptions", file.assumptions}};
}

bool is_default(const ReportedFile& file) { return file.properties.empty(); }

// How the search for the default report ended.
void add_search(OrderedJson& to, const ReportedFile& file) {
  add_progress(to, file.progress);
  to["stopped"] = word(stop_word(file.stopped));
  to["error"] = word(file.error);
}

OrderedJson file_json(const ReportedFile& file) {
  OrderedJson json = file_heading(file);
  if (is_default(file)) {
    json["answers"] = array_of(file.answers, answer_json);
    json["nodes"] = array_of(file.nodes, node_json);
    add_search(json, file);
  } else {
    json["faults"] = file.has_faults;
    json["verdicts"] = array_of(file.verdicts, verdict_json);
  }
  return json;
}

OrderedJson timing_json(const ReportedTree& tree) {
  return {{"seconds", tree.seconds}, {"peak_bytes", tree.peak_bytes}};
}

// What only a tree of a batch has.
OrderedJson entry_heading(const ReportedTree& tree) {
  if (tree.entry.empty()) return OrderedJson::object();
  return {{"entry", tree.entry}, {"not_run", word(tree.not_run)}};
}

OrderedJson tree_json(const Report& report, const ReportedTree& tree) {
  const auto to_json = [&](const Finding& finding) {
    return finding_json(report, finding);
  };
  OrderedJson json = entry_heading(tree);
  json["tree"] = tree.file;
  json["nodes"] = tree.nodes;
  json["variables"] = tree.variables;
  json["exit_code"] = static_cast<int>(tree.code);
  json["diagnostics"] = array_of(tree.diagnostics, diagnostic_json);
  json["files"] = array_of(tree.files, file_json);
  json["findings"] = array_of(tree.findings, to_json);
  const JudgedCount count = count_of(tree.judged);
  json["allowed"] = count.allowed;
  json["in_baseline"] = count.known;
  json["timing"] = timing_json(tree);
  return json;
}

OrderedJson tool_heading() {
  return {{"schema", kJsonSchema}, {"tool", "btcheck"}, {"version", kVersion}};
}

OrderedJson report_timing(const Report& report) {
  return {{"started", report.started}, {"seconds", report.seconds()}};
}

// The lines about one tree: each names it, and what kind of line it is.
std::string lines_of(const Report& report, const ReportedTree& tree) {
  std::string lines;
  const auto add = [&](std::string_view kind, const OrderedJson& heading,
                       const OrderedJson& what) {
    OrderedJson line = {{"event", kind}};
    if (!tree.entry.empty()) line["entry"] = tree.entry;
    line["tree"] = tree.file;
    line.update(heading);
    line.update(what);
    lines += dumped(line);
  };
  const OrderedJson none = OrderedJson::object();
  for (const Diagnostic& diagnostic : tree.diagnostics) {
    add("diagnostic", none, diagnostic_json(diagnostic));
  }
  for (const ReportedFile& file : tree.files) {
    const OrderedJson heading = file_heading(file);
    for (const ReportedProperty& property : file.verdicts) {
      add("verdict", heading, verdict_json(property));
    }
    for (const ReportedAnswer& answer : file.answers) {
      add("answer", heading, answer_json(answer));
    }
    for (const ReportedNode& node : file.nodes) {
      add("node", heading, node_json(node));
    }
  }
  for (const Finding& finding : tree.findings) {
    add("finding", none, finding_json(report, finding));
  }
  return lines;
}

}  // namespace

std::string json_text(const Report& report) {
  OrderedJson document = tool_heading();
  document["exit_code"] = static_cast<int>(report.code());
  document["trees"] = array_of(report.trees, [&](const ReportedTree& tree) {
    return tree_json(report, tree);
  });
  document["timing"] = report_timing(report);
  return dumped(document, 1);
}

std::string json_start_line(const std::string& tree,
                            const std::vector<std::string>& properties) {
  OrderedJson line = {{"event", "start"}};
  line.update(tool_heading());
  line["tree"] = tree;
  line["properties"] = properties;
  return dumped(line);
}

std::string json_progress_line(const SearchProgress& progress, double seconds) {
  OrderedJson line = {{"event", "progress"}};
  add_progress(line, progress);
  line["depth"] = progress.depth;
  line["frontier"] = progress.states - progress.expanded;
  line["timing"] = {{"seconds", seconds}, {"bytes", progress.bytes}};
  return dumped(line);
}

std::string json_tree_lines(const Report& report, const ReportedTree& tree) {
  std::vector<std::string> properties;
  for (const ReportedFile& file : tree.files) {
    if (!is_default(file)) properties.push_back(file.properties);
  }
  std::string lines;
  if (tree.entry.empty()) {
    lines = json_start_line(tree.file, properties);
  } else {
    OrderedJson line = {{"event", "entry"}};
    line.update(entry_heading(tree));
    line["tree"] = tree.file;
    line["properties"] = properties;
    line["exit_code"] = static_cast<int>(tree.code);
    line["timing"] = timing_json(tree);
    lines = dumped(line);
  }
  return lines + lines_of(report, tree);
}

std::string json_end_line(const Report& report) {
  OrderedJson end = {{"event", "end"},
                     {"exit_code", static_cast<int>(report.code())}};
  end["timing"] = report_timing(report);
  return dumped(end);
}

std::string json_result_lines(const Report& report) {
  std::string lines;
  for (const ReportedTree& tree : report.trees) {
    lines += lines_of(report, tree);
  }
  return lines + json_end_line(report);
}

std::string json_batch_line(std::size_t entries) {
  OrderedJson line = {{"event", "batch"}};
  line.update(tool_heading());
  line["entries"] = entries;
  return dumped(line);
}

std::string json_lines(const Report& report) {
  const bool is_batch =
      report.trees.size() != 1 || !report.trees[0].entry.empty();
  std::string lines = is_batch ? json_batch_line(report.trees.size()) : "";
  for (const ReportedTree& tree : report.trees) {
    lines += json_tree_lines(report, tree);
  }
  return lines + json_end_line(report);
}

namespace {

// Figures that are not known are null.
OrderedJson quotient_json(const SpaceQuotient& quotient) {
  const bool is_known = quotient.stopped == StopReason::None;
  const auto figure = [&](std::uint64_t count) {
    return is_known ? OrderedJson(count) : OrderedJson();
  };
  OrderedJson object;
  object["equivalence"] = quotient.equivalence == Equivalence::Strong
                              ? "strong"
                              : "branching-with-divergence";
  object["observe"] = seen_word(quotient.seen);
  object["states"] = figure(quotient.graph.size());
  object["transitions"] = figure(quotient.graph.arc_count());
  object["labels"] =
      figure(quotient.labels.empty() ? 0 : quotient.labels.size() - 1);
  object["stopped"] = word(stop_word(quotient.stopped));
  return object;
}

}  // namespace

std::string space_json(const SpaceReport& report, const SpaceContext& context) {
  const SearchProgress& progress = report.result.progress;
  OrderedJson object;
  object["tree"] = context.tree;
  object["tick"] = tick_name(context.network.ticks);
  object["reduce"] = reduction_asked(context);
  object["threads"] = context.options.threads;
  object["store"] =
      context.options.store == StateSetKind::Exact ? "exact" : "compressed";
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
  object["stopped"] = word(stop_word(report.result.stopped));
  object["disk_bytes"] = report.bytes_on_disk;
  if (context.quotient != nullptr) {
    object["quotient"] = quotient_json(*context.quotient);
  }
  return dumped(object);
}

}  // namespace btcheck
