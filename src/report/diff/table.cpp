// SPDX-License-Identifier: MIT
//
// Side by side, for a terminal and for Markdown.
#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "report/diff/told.hpp"
#include "text/utf8.hpp"

namespace btcheck {
namespace {

std::vector<std::string> lines_within(const std::string& text,
                                      std::size_t width) {
  std::vector<std::string> lines;
  const std::string all = wrapped(text, 0, width);
  for (std::size_t at = 0;;) {
    const std::size_t end = all.find('\n', at);
    std::string line = all.substr(at, end - at);
    // A word that is too long for its column.
    while (static_cast<std::size_t>(count_code_points(line)) > width) {
      std::size_t cut = 0;
      for (std::size_t n = 0; n < width; ++n) cut += decode(line, cut).length;
      lines.push_back(line.substr(0, cut));
      line.erase(0, cut);
    }
    lines.push_back(std::move(line));
    if (end == std::string::npos) return lines;
    at = end + 1;
  }
}

std::string padded(std::string text, std::size_t width) {
  const auto letters = static_cast<std::size_t>(count_code_points(text));
  if (letters < width) text.append(width - letters, ' ');
  return text;
}

class SideBySide {
 public:
  explicit SideBySide(std::size_t width)
      : column_((std::max<std::size_t>(width, 40) - kMargin - kMiddle) / 2) {}

  void add(const std::string& margin, const std::string& one,
           const std::string& other, char sign) {
    const auto left = lines_within(one, column_);
    const auto right = lines_within(other, column_);
    for (std::size_t i = 0; i < std::max(left.size(), right.size()); ++i) {
      std::string line = padded(i == 0 ? margin : "", kMargin);
      line += padded(i < left.size() ? left[i] : "", column_);
      line += i == 0 ? fmt::format(" {} ", sign) : "   ";
      if (i < right.size()) line += right[i];
      line.erase(line.find_last_not_of(' ') + 1);
      text_ += line + '\n';
    }
  }
  std::string take() { return std::move(text_); }

 private:
  static constexpr std::size_t kMargin = 6;
  static constexpr std::size_t kMiddle = 3;

  std::size_t column_;
  std::string text_;
};

// In a cell of Markdown.
std::string in_markdown(std::string_view text) {
  std::string safe;
  for (const char c : harmless(unbroken(text))) {
    if (c == '|') {
      safe += "\\|";
    } else if (c == '<') {
      safe += "&lt;";
    } else if (c == '&') {
      safe += "&amp;";
    } else {
      safe += c;
    }
  }
  return safe;
}

}  // namespace

std::string diff_text(const DiffReport& report, std::size_t width) {
  const auto& [one, other] = report.names;
  std::string text = fmt::format("{} beside {}\n", one, other) +
                     wrapped(verdict_text(report), 0, width) + '\n';
  const std::vector<DiffRow> rows = rows_of(report);
  if (!rows.empty()) {
    SideBySide table(width);
    table.add("tick", report.label(0), report.label(1), '|');
    int tick = 0;
    for (const DiffRow& row : rows) {
      const bool is_new = row.tick != tick;
      tick = row.tick;
      table.add(is_new ? fmt::format("{:4}", tick) : "", row.cells[0],
                row.cells[1], row.differs ? '!' : '|');
    }
    text += '\n' + table.take();
  }
  const std::string partners = partners_text(report);
  if (!partners.empty()) text += '\n';
  for (std::size_t at = 0; at < partners.size();) {
    const std::size_t end = partners.find('\n', at);
    text += wrapped(partners.substr(at, end - at), 2, width) + '\n';
    at = end + 1;
  }
  if (!report.changes) return text;
  text += '\n';
  if (report.changes->empty()) {
    return text + "no verdict and no finding differs\n";
  }
  for (const DiffChange& change : *report.changes) {
    text += wrapped(change_text(change), 2, width) + '\n';
  }
  return text;
}

std::string diff_markdown(const DiffReport& report) {
  const auto& [one, other] = report.names;
  std::string text = fmt::format(
      "### {} beside {}: {}\n\n{}\n", in_markdown(one), in_markdown(other),
      report.verdict(), in_markdown(verdict_text(report)));
  const std::vector<DiffRow> rows = rows_of(report);
  if (!rows.empty()) {
    text +=
        fmt::format("\n| tick | {} | {} |\n|---:|---|---|\n",
                    in_markdown(report.label(0)), in_markdown(report.label(1)));
    int tick = 0;
    for (const DiffRow& row : rows) {
      const std::string mark = row.differs ? "**" : "";
      text += fmt::format("| {} | {}{}{} | {}{}{} |\n",
                          row.tick == tick ? "" : fmt::format("{}", row.tick),
                          mark, in_markdown(row.cells[0]), mark, mark,
                          in_markdown(row.cells[1]), mark);
      tick = row.tick;
    }
  }
  std::string list;
  const auto add = [&](std::string_view line) {
    list += fmt::format("- {}\n", in_markdown(line));
  };
  const std::string partners = partners_text(report);
  for (std::size_t at = 0; at < partners.size();) {
    const std::size_t end = partners.find('\n', at);
    add(std::string_view(partners).substr(at, end - at));
    at = end + 1;
  }
  if (report.changes) {
    for (const DiffChange& change : *report.changes) add(change_text(change));
    if (report.changes->empty()) add("no verdict and no finding differs");
  }
  return list.empty() ? text : text + '\n' + list;
}

}  // namespace btcheck
