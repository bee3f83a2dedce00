// SPDX-License-Identifier: MIT
#include "serve/mcp.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <stdexcept>

#include "serve/resources.hpp"
#include "serve/tools.hpp"
#include "text/version.hpp"

namespace btcheck {
namespace {

constexpr std::array<std::string_view, 4> kVersions = {
    "2025-11-25", "2025-06-18", "2025-03-26", "2024-11-05"};
constexpr std::string_view kScheme = "btcheck://";

constexpr std::string_view kInstructions =
    "btcheck tries every run of a behavior tree (XML of BehaviorTree.CPP and "
    "Nav2, or .btf). Call check_tree first; its findings have names such as "
    "BT2208@50:12. apply_repair returns the text with a checked repair made; "
    "write it to the file yourself and check again. Findings called questions "
    "can be answered by contracts: docs/findings.md.";

std::string mcp_progress(const std::string& token,
                         const v1::Progress& progress) {
  return fmt::format(
      R"({{"jsonrpc":"2.0","method":"notifications/progress","params":)"
      R"({{"progressToken":{},"progress":{},"message":"{} states"}}}})",
      token, progress.states, progress.states);
}

std::string answer_mcp(const JsonValue& params, Work&) {
  const std::string asked = params.word("protocolVersion");
  const bool is_known = std::ranges::count(kVersions, asked) > 0;
  return Json{{"protocolVersion",
               is_known ? std::string_view(asked) : kVersions.front()},
              {"capabilities",
               Json{{"tools", Json::object()}, {"resources", Json::object()}}},
              {"serverInfo", Json{{"name", "btcheck"},
                                  {"title", "btcheck, for behavior trees"},
                                  {"version", kVersion}}},
              {"instructions", kInstructions}}
      .text();
}

std::string answer_ping(const JsonValue&, Work&) { return "{}"; }

std::string answer_tools(const JsonValue&, Work&) {
  Json list = Json::array();
  for (const ToolRow& tool : tools()) {
    list.push(Json{{"name", tool.name},
                   {"title", tool.title},
                   {"description", tool.about},
                   {"inputSchema", schema_of(tool)},
                   {"annotations",
                    Json{{"readOnlyHint", true}, {"openWorldHint", false}}}});
  }
  return Json{{"tools", list}}.text();
}

std::string told(const ToolAnswer& answer, bool is_error) {
  Json result{
      {"content",
       Json::array(std::array{Json{{"type", "text"}, {"text", answer.text}}})},
      {"isError", is_error}};
  if (!is_error) result.add("structuredContent", answer.data);
  return result.text();
}

// What is wrong with a call is told to the agent, which can mend it.
std::string answer_call(const JsonValue& params, Work& work) {
  const std::string name = needed_text(params, "name");
  const auto tool = std::ranges::find(tools(), name, &ToolRow::name);
  if (tool == tools().end()) {
    throw RpcError(rpc::kInvalidParams,
                   fmt::format("there is no tool `{}`", name.substr(0, 80)));
  }
  if (const JsonValue* meta = params.member("_meta")) {
    const JsonValue* token = meta->member("progressToken");
    if (token != nullptr && token->is(JsonValue::Kind::Number)) {
      work.tell_progress(token->text);
    } else if (token != nullptr && token->is(JsonValue::Kind::Text)) {
      work.tell_progress(Json(token->text).text());
    }
  }
  const JsonValue* arguments = params.member("arguments");
  static const JsonValue none{JsonValue::Kind::Object, {}, {}, {}};
  try {
    return told(tool->call(arguments == nullptr ? none : *arguments, work),
                false);
  } catch (const RpcError& fault) {
    return told({fault.what()}, true);
  } catch (const std::invalid_argument& fault) {
    return told({fault.what()}, true);
  }
}

std::string_view mime_of(const ResourceRow& resource) {
  if (resource.name.ends_with(".md")) return "text/markdown";
  return resource.name.ends_with(".xml") ? "text/xml" : "text/plain";
}

std::string answer_resources(const JsonValue&, Work&) {
  Json list = Json::array();
  for (const ResourceRow& each : resources()) {
    list.push(Json{{"uri", fmt::format("{}{}", kScheme, each.name)},
                   {"name", each.name},
                   {"description", each.title},
                   {"mimeType", mime_of(each)}});
  }
  return Json{{"resources", list}}.text();
}

std::string answer_templates(const JsonValue&, Work&) {
  return Json{{"resourceTemplates", Json::array()}}.text();
}

std::string answer_read(const JsonValue& params, Work&) {
  const std::string uri = needed_text(params, "uri");
  for (const ResourceRow& each : resources()) {
    if (uri != fmt::format("{}{}", kScheme, each.name)) continue;
    const Json content{
        {"uri", uri}, {"mimeType", mime_of(each)}, {"text", each.text}};
    return Json{{"contents", Json::array(std::array{content})}}.text();
  }
  throw RpcError(rpc::kNotFound,
                 fmt::format("there is no `{}`", uri.substr(0, 80)));
}

constexpr auto kMcpMethods = std::to_array<MethodRow>({
    {"initialize", answer_mcp},
    {"ping", answer_ping},
    {"tools/list", answer_tools},
    {"tools/call", answer_call, true},
    {"resources/list", answer_resources},
    {"resources/templates/list", answer_templates},
    {"resources/read", answer_read},
});

}  // namespace

const Protocol& mcp_protocol() {
  static const Protocol all{
      kMcpMethods, mcp_progress, "notifications/cancelled",
      "requestId", "",           false};
  return all;
}

}  // namespace btcheck
