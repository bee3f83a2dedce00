// SPDX-License-Identifier: MIT
#include "serve/methods.hpp"

#include <fmt/format.h>

#include <array>
#include <utility>

#include "model/btcpp/unknown_leaves.hpp"
#include "model/tree_file.hpp"
#include "report/formats/reported.hpp"
#include "report/text/proposed_rules.hpp"
#include "serve/asked.hpp"
#include "text/version.hpp"

namespace btcheck {
namespace {

// --- What requests say ------------------------------------------------------

AskedTree asked_of(const JsonValue& params, Work& work,
                   std::vector<std::string> others = {}) {
  others.emplace_back("progress");
  AskedTree asked = asked_by(params, others);
  if (params.word("progress") == "true") work.tell_progress(work.id());
  return asked;
}

std::string serve_progress(const std::string& token,
                           const v1::Progress& progress) {
  return fmt::format(
      R"({{"jsonrpc":"2.0","method":"$/progress","params":{{"id":{},)"
      R"("states":{},"transitions":{},"seconds":{:.3f}}}}})",
      token, progress.states, progress.transitions, progress.seconds);
}

// What reading alone has found, for methods that have no report.
Json json_of(const std::vector<Diagnostic>& diagnostics) {
  Json list = Json::array();
  for (const Diagnostic& each : diagnostics) {
    const Finding finding = finding_of(each);
    list.push(Json{{"code", finding.code},
                   {"level", severity_name(each.severity)},
                   {"message", finding.message},
                   {"file", finding.place.file},
                   {"line", finding.place.span.line},
                   {"column", finding.place.span.column}});
  }
  return list;
}

// --- Methods --------------------------------------------------------------

std::string answer_check(const JsonValue& params, Work& work) {
  const AskedTree asked = asked_of(params, work, {"sarif"});
  const v1::Report report = checked_once(asked, work);
  return params.word("sarif") == "true" ? report.sarif() : report.json();
}

std::string answer_lint(const JsonValue& params, Work& work) {
  const AskedTree asked = asked_of(params, work, {"sarif"});
  const v1::Report report = linted_once(asked, work);
  return params.word("sarif") == "true" ? report.sarif() : report.json();
}

std::string answer_describe(const JsonValue& params, Work& work) {
  const AskedTree asked = asked_of(params, work);
  return v1::described(asked.fields.request, *asked.sources, &work).json();
}

std::string answer_simulate(const JsonValue& params, Work& work) {
  const AskedTree asked = asked_of(params, work);
  return v1::simulated(asked.fields.request, asked.fields.plan, *asked.sources,
                       &work)
      .json();
}

// The tree that is asked for, as `tell` tells of it.
template <class Tell>
std::string of_tree(const AskedTree& asked, Work& work, Tell tell) {
  v1::Call call(asked.fields.request, &work);
  const BudgetScope budget(&call);
  std::vector<Diagnostic> found;
  try {
    const auto inputs =
        v1::inputs_of_tree(asked.fields.request, *asked.sources, found);
    if (inputs) return tell(*inputs, call, found);
    return Json{{"outcome", static_cast<int>(ExitCode::BadInput)},
                {"diagnostics", json_of(found)}}
        .text();
  } catch (const BudgetSpent& spent) {
    found.push_back(v1::spent_diagnostic(spent, asked.fields.request.tree));
    return Json{{"outcome", static_cast<int>(ExitCode::Undecided)},
                {"diagnostics", json_of(found)}}
        .text();
  }
}

std::string answer_init(const JsonValue& params, Work& work) {
  const AskedTree asked = asked_of(params, work);
  return of_tree(asked, work,
                 [&](const v1::Inputs& inputs, v1::Call& call,
                     std::vector<Diagnostic>& found) {
                   ProposedRules proposed = proposed_rules(
                       inputs.tree, inputs.tree.name,
                       v1::options_of(asked.fields.request, inputs, call));
                   found.insert(found.end(), proposed.diagnostics.begin(),
                                proposed.diagnostics.end());
                   return Json{{"outcome", static_cast<int>(proposed.code)},
                               {"diagnostics", json_of(found)},
                               {"rules", proposed.text}}
                       .text();
                 });
}

std::string answer_leaves(const JsonValue& params, Work& work) {
  const AskedTree asked = asked_of(params, work);
  return of_tree(
      asked, work,
      [&](const v1::Inputs& inputs, v1::Call&, std::vector<Diagnostic>& found) {
        UnknownLeaves leaves;
        const auto wrong = add_unknown_leaves(
            inputs.tree.name, inputs.tree.text, inputs.tree.reading, leaves);
        found.insert(found.end(), wrong.begin(), wrong.end());
        const bool are_none = leaves.types().empty();
        return Json{
            {"outcome", static_cast<int>(has_error(found) ? ExitCode::BadInput
                                                          : ExitCode::Met)},
            {"diagnostics", json_of(found)},
            {"count", leaves.types().size()},
            {"models", are_none ? std::string() : leaves.xml()},
            {"contracts", are_none ? std::string() : leaves.contracts()}}
            .text();
      });
}

std::string answer_explain(const JsonValue& params, Work&) {
  refuse_others(params, {"code"});
  const std::string code = needed_text(params, "code");
  const auto explained = v1::explain(code);
  if (!explained) {
    throw RpcError(rpc::kInvalidParams,
                   fmt::format("there is no code `{}`", code.substr(0, 80)));
  }
  return explained->json();
}

std::string answer_serve(const JsonValue&, Work&);

std::string answer_shutdown(const JsonValue&, Work&) { return "null"; }

constexpr auto kServeMethods = std::to_array<MethodRow>({
    {"initialize", answer_serve},
    {"check", answer_check, true},
    {"lint", answer_lint, true},
    {"describe", answer_describe, true},
    {"simulate", answer_simulate, true},
    {"init", answer_init, true},
    {"leaves", answer_leaves, true},
    {"explain", answer_explain},
    {"shutdown", answer_shutdown},
});

std::string answer_serve(const JsonValue&, Work&) {
  Json methods = Json::array();
  for (const MethodRow& each : kServeMethods) methods.push(each.name);
  return Json{{"name", "btcheck"},
              {"version", kVersion},
              {"methods", methods},
              {"fields", Json::array(request_names())}}
      .text();
}

}  // namespace

const Protocol& serve_protocol() {
  static const Protocol all{kServeMethods, serve_progress, "$/cancelRequest",
                            "id",          "exit",         true};
  return all;
}

}  // namespace btcheck
