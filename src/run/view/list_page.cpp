// SPDX-License-Identifier: MIT
#include "run/view/list_page.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "text/json.hpp"
#include "text/utf8.hpp"

namespace btcheck {
namespace {

std::string small_page(std::string_view title, bool looks_again,
                       std::string_view body) {
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<meta charset=\"utf-8\">\n"
      "<meta name=\"color-scheme\" content=\"light dark\">\n{}"
      "<title>{}</title>\n<style>body{{font:16px/1.6 Inter,system-ui,"
      "sans-serif;max-width:40rem;margin:3rem auto;padding:0 1rem}}"
      "li{{margin:.5rem 0}}</style>\n{}",
      looks_again ? "<meta http-equiv=\"refresh\" content=\"1\">\n" : "", title,
      body);
}

std::string as_html(std::string_view text) {
  return with_entities(valid_utf8(text));
}

}  // namespace

std::string list_page(const std::vector<ListedRun>& runs,
                      std::string_view token) {
  std::string body = "<h1>Robots</h1>\n<ul>\n";
  for (std::size_t i = 0; i < runs.size(); ++i) {
    body += fmt::format("<li><a href=\"/{}/?token={}\">{}</a>{}</li>\n", i + 1,
                        token, as_html(runs[i].name),
                        runs[i].is_there ? "" : " – nobody answers there yet");
  }
  const bool is_complete = std::ranges::all_of(
      runs, [](const ListedRun& run) { return run.is_there; });
  return small_page(fmt::format("{} robots", runs.size()), !is_complete,
                    body + "</ul>\n");
}

std::string waiting_page(std::string_view name) {
  return small_page(
      as_html(name), true,
      fmt::format("<h1>{}</h1>\n<p role=\"status\">nobody answers "
                  "there yet; this page goes on looking</p>\n",
                  as_html(name)));
}

}  // namespace btcheck
