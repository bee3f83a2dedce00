// SPDX-License-Identifier: MIT
#include "lsp/methods.hpp"

#include <fmt/format.h>

#include <array>
#include <atomic>
#include <filesystem>

#include "lsp/diagnostics.hpp"
#include "lsp/features.hpp"
#include "lsp/words.hpp"
#include "model/tree/tree.hpp"
#include "serve/asked.hpp"
#include "text/numbers.hpp"
#include "text/version.hpp"

namespace btcheck::lsp {
namespace {

namespace fs = std::filesystem;

std::atomic<bool> is_ending = false;
// What the editor can do, as it has said.
std::atomic<bool> takes_snippets = false;
std::atomic<bool> registers_watchers = false;

// --- Parameters ------------------------------------------------------------

// members of members: {"a", "b"} of {"a": {"b": 1}}
const JsonValue* within(const JsonValue& value,
                        std::initializer_list<std::string_view> names) {
  const JsonValue* found = &value;
  for (const std::string_view name : names) {
    found = found->member(name);
    if (found == nullptr) return nullptr;
  }
  return found;
}

bool is_true(const JsonValue& value,
             std::initializer_list<std::string_view> names) {
  const JsonValue* found = within(value, names);
  return found != nullptr && found->text == "true";
}

Wishes wishes_of(const JsonValue* said) {
  Wishes wishes;
  if (said == nullptr || !said->is(JsonValue::Kind::Object)) return wishes;
  wishes.profile = said->word("profile");
  if (!wishes.profile.empty() && !profile_named(wishes.profile)) {
    workbench().notify(
        "window/showMessage",
        Json{{"type", 2},
             {"message", fmt::format("btcheck: there is no profile `{}`",
                                     wishes.profile.substr(0, 80))}});
    wishes.profile.clear();
  }
  wishes.checks_typing = said->word("checkOnType") != "false";
  wishes.tries_repairs = said->word("repairs") != "false";
  const auto seconds = as_number<double>(said->word("seconds"));
  if (seconds && *seconds >= 0) wishes.seconds = *seconds;
  return wishes;
}

Position place_in(const JsonValue& params) {
  return position_in(params, "position");
}

// --- The beginning and the end ---------------------------------------------

Json capabilities(Encoding encoding) {
  Json triggers = Json::array();
  for (const char* each : {"<", "\"", "{", " ", ".", ":", "(", "/", "@"}) {
    triggers.push(each);
  }
  Json kinds = Json::array();
  for (const char* each : {"quickfix", "refactor", "source"}) kinds.push(each);
  return {
      {"positionEncoding", encoding == Encoding::Utf8    ? "utf-8"
                           : encoding == Encoding::Utf32 ? "utf-32"
                                                         : "utf-16"},
      {"textDocumentSync", Json{{"openClose", true},
                                {"change", 2},
                                {"save", Json{{"includeText", false}}}}},
      {"hoverProvider", true},
      {"completionProvider",
       Json{{"triggerCharacters", triggers}, {"resolveProvider", false}}},
      {"definitionProvider", true},
      {"referencesProvider", true},
      {"documentHighlightProvider", true},
      {"documentSymbolProvider", true},
      {"codeActionProvider", Json{{"codeActionKinds", kinds}}},
      {"codeLensProvider", Json{{"resolveProvider", false}}},
      {"documentFormattingProvider", true},
      {"renameProvider", Json{{"prepareProvider", true}}},
      {"foldingRangeProvider", true},
      {"selectionRangeProvider", true},
      {"semanticTokensProvider",
       Json{{"legend", token_legend()}, {"full", true}}},
      {"inlayHintProvider", true},
      {"workspace",
       Json{{"workspaceFolders",
             Json{{"supported", true}, {"changeNotifications", true}}}}},
  };
}

Encoding agreed_encoding(const JsonValue& params) {
  const JsonValue* offered =
      within(params, {"capabilities", "general", "positionEncodings"});
  if (offered == nullptr || offered->items.empty()) return Encoding::Utf16;
  const auto has = [&](std::string_view word) {
    return std::ranges::count(offered->items, word, &JsonValue::text) > 0;
  };
  if (has("utf-16")) return Encoding::Utf16;
  if (has("utf-8")) return Encoding::Utf8;
  return has("utf-32") ? Encoding::Utf32 : Encoding::Utf16;
}

std::string initialize(const JsonValue& params, Work&) {
  std::vector<std::string> folders;
  const JsonValue* told = params.member("workspaceFolders");
  if (told != nullptr && told->is(JsonValue::Kind::List)) {
    for (const JsonValue& each : told->items) {
      folders.push_back(path_of(each.word("uri")));
    }
  } else if (!params.word("rootUri").empty()) {
    folders.push_back(path_of(params.word("rootUri")));
  }
  const Encoding encoding = agreed_encoding(params);
  const JsonValue caps = params.member("capabilities") == nullptr
                             ? JsonValue{}
                             : *params.member("capabilities");
  takes_snippets = is_true(
      caps, {"textDocument", "completion", "completionItem", "snippetSupport"});
  registers_watchers = is_true(
      caps, {"workspace", "didChangeWatchedFiles", "dynamicRegistration"});
  Takes takes;
  takes.lenses = is_true(caps, {"workspace", "codeLens", "refreshSupport"});
  takes.hints = is_true(caps, {"workspace", "inlayHint", "refreshSupport"});
  takes.progress = is_true(caps, {"window", "workDoneProgress"});
  workbench().set(wishes_of(params.member("initializationOptions")));
  workbench().begin(std::move(folders), encoding, takes);
  return Json{{"capabilities", capabilities(encoding)},
              {"serverInfo", Json{{"name", "btcheck"}, {"version", kVersion}}}}
      .text();
}

void initialized(const JsonValue&) {
  if (!registers_watchers) return;
  Json watchers = Json::array();
  watchers.push(
      Json{{"globPattern", "**/*.{xml,btproj,btf,ltl,btp,leaves,toml}"}});
  Json registrations = Json::array();
  registrations.push(Json{{"id", "btcheck-files"},
                          {"method", "workspace/didChangeWatchedFiles"},
                          {"registerOptions", Json{{"watchers", watchers}}}});
  workbench().demand("client/registerCapability",
                     Json{{"registrations", registrations}});
}

std::string shutdown(const JsonValue&, Work&) {
  is_ending = true;
  return "null";
}

// --- Texts -----------------------------------------------------------------

void did_open(const JsonValue& params) { workbench().open(params); }
void did_change(const JsonValue& params) { workbench().change(params); }
void did_save(const JsonValue& params) { workbench().save(params); }
void did_close(const JsonValue& params) { workbench().close(params); }
void did_change_files(const JsonValue& params) {
  workbench().change_files(params);
}
void did_change_folders(const JsonValue& params) {
  const JsonValue* event = params.member("event");
  if (event != nullptr) workbench().change_folders(*event);
}
void did_change_settings(const JsonValue& params) {
  workbench().set(wishes_of(within(params, {"settings", "btcheck"})));
}

// --- Questions -------------------------------------------------------------

template <Json (*Answer)(const View&, Position)>
std::string at_place(const JsonValue& params, Work&) {
  return Answer(workbench().view(params), place_in(params)).text();
}

template <Json (*Answer)(const View&)>
std::string of_document(const JsonValue& params, Work&) {
  return Answer(workbench().view(params)).text();
}

std::string completion(const JsonValue& params, Work&) {
  return completions(workbench().view(params), place_in(params), takes_snippets)
      .text();
}

std::string reference(const JsonValue& params, Work&) {
  return references(workbench().view(params), place_in(params),
                    is_true(params, {"context", "includeDeclaration"}))
      .text();
}

std::string rename(const JsonValue& params, Work&) {
  return renamed(workbench().view(params), place_in(params),
                 needed_text(params, "newName"))
      .text();
}

std::string code_action(const JsonValue& params, Work&) {
  return actions(workbench().view(params), range_in(params, "range")).text();
}

std::string inlay_hint(const JsonValue& params, Work&) {
  return hints(workbench().view(params), range_in(params, "range")).text();
}

std::string selection(const JsonValue& params, Work&) {
  std::vector<Position> places;
  const JsonValue* told = params.member("positions");
  if (told != nullptr) {
    for (const JsonValue& each : told->items) {
      JsonValue wrapped;
      wrapped.kind = JsonValue::Kind::Object;
      wrapped.names = {"at"};
      wrapped.items = {each};
      places.push_back(position_in(wrapped, "at"));
    }
  }
  return selections(workbench().view(params), places).text();
}

std::string semantic_tokens(const JsonValue& params, Work&) {
  return Json{{"data", tokens(workbench().view(params))}}.text();
}

std::string formatting(const JsonValue& params, Work&) {
  return formatted(workbench().view(params)).text();
}

// --- Pages -----------------------------------------------------------------

Json page(std::string_view title, const std::string& html) {
  return {{"title", title}, {"html", html}};
}

std::string page_of_run(const JsonValue& params, Work& work) {
  const std::string name = needed_text(params, "run");
  if (!workbench().wait_for_check(params, work)) {
    throw RpcError(rpc::kCancelled, "cancelled");
  }
  for (const Look& look : workbench().view(params).looks) {
    if (!look.check.report) continue;
    const std::string html = look.check.report->html(name);
    if (!html.empty()) return page(name, html).text();
  }
  throw RpcError(rpc::kNotFound, fmt::format("there is no run `{}` any more",
                                             name.substr(0, 80)));
}

std::string drawing(const JsonValue& params, Work& work) {
  const View view = workbench().view(params);
  const Look* look = described_look(view);
  if (look == nullptr) {
    throw RpcError(rpc::kNotFound, "the tree cannot be read");
  }
  const std::string html = workbench().drawn(*look, work);
  if (html.empty()) throw RpcError(rpc::kNotFound, "the tree cannot be drawn");
  return page(fs::path(look->subject.tree).filename().string(), html).text();
}

std::string check_now(const JsonValue& params, Work& work) {
  if (!workbench().wait_for_check(params, work)) {
    throw RpcError(rpc::kCancelled, "cancelled");
  }
  const View view = workbench().view(params);
  return Json{{"summary", summary(view)}}.text();
}

constexpr auto kMethods = std::to_array<MethodRow>({
    {"initialize", initialize, true},
    {"shutdown", shutdown, true},
    {"textDocument/hover", at_place<hover>, true},
    {"textDocument/completion", completion, true},
    {"textDocument/definition", at_place<definitions>, true},
    {"textDocument/references", reference, true},
    {"textDocument/documentHighlight", at_place<highlights>, true},
    {"textDocument/documentSymbol", of_document<symbols>, true},
    {"textDocument/codeAction", code_action, true},
    {"textDocument/codeLens", of_document<lenses>, true},
    {"textDocument/formatting", formatting, true},
    {"textDocument/prepareRename", at_place<rename_place>, true},
    {"textDocument/rename", rename, true},
    {"textDocument/foldingRange", of_document<foldings>, true},
    {"textDocument/selectionRange", selection, true},
    {"textDocument/semanticTokens/full", semantic_tokens, true},
    {"textDocument/inlayHint", inlay_hint, true},
    {"btcheck/page", page_of_run, true, true},
    {"btcheck/drawing", drawing, true, true},
    {"btcheck/check", check_now, true, true},
});

constexpr auto kNotices = std::to_array<NoticeRow>({
    {"initialized", initialized},
    {"textDocument/didOpen", did_open},
    {"textDocument/didChange", did_change},
    {"textDocument/didSave", did_save},
    {"textDocument/didClose", did_close},
    {"workspace/didChangeWatchedFiles", did_change_files},
    {"workspace/didChangeWorkspaceFolders", did_change_folders},
    {"workspace/didChangeConfiguration", did_change_settings},
});

// Nobody asks for progress here.
std::string no_progress(const std::string&, const v1::Progress&) { return {}; }

}  // namespace

const Protocol& lsp_protocol() {
  static const Protocol all{kMethods, no_progress, "$/cancelRequest", "id",
                            "exit",   true,        kNotices};
  return all;
}

bool is_shut_down() { return is_ending; }

}  // namespace btcheck::lsp
