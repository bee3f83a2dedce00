// SPDX-License-Identifier: MIT
//
// Goes by the layout of the lines, after all else was done: names that carry
// escapes were made harmless by then, and nothing before need know of colours.
#include "text/colors.hpp"

#include <fmt/format.h>

#include <array>
#include <cstddef>
#include <utility>

namespace btcheck {
namespace {

constexpr std::string_view kRed = "\x1b[1;31m";
constexpr std::string_view kGreen = "\x1b[1;32m";
constexpr std::string_view kYellow = "\x1b[1;33m";
constexpr std::string_view kBlue = "\x1b[1;34m";
constexpr std::string_view kCyan = "\x1b[1;36m";
constexpr std::string_view kStrong = "\x1b[1m";
constexpr std::string_view kPlain = "\x1b[0m";

struct InkedWord {
  std::string_view word;
  std::string_view ink;
};
// Verdicts, and the results of entries of a batch.
constexpr std::array<InkedWord, 9> kVerdicts = {{{"HOLDS", kGreen},
                                                 {"VIOLATED", kRed},
                                                 {"UNDECIDED", kYellow},
                                                 {"MET", kGreen},
                                                 {"MISSED", kRed},
                                                 {"BROKEN", kRed},
                                                 {"NO FAULT", kGreen},
                                                 {"FAULT", kRed},
                                                 {"FAILED", kRed}}};
constexpr std::array<InkedWord, 3> kSeverities = {
    {{"error", kRed}, {"warning", kYellow}, {"note", kCyan}}};

std::string inked(std::string_view ink, std::string_view text) {
  return text.empty() ? "" : fmt::format("{}{}{}", ink, text, kPlain);
}

class Painter {
 public:
  std::string line(std::string_view line) {
    for (const auto& [word, ink] : kVerdicts) {
      if (!begins_with_word(line, word)) continue;
      return inked(ink, word) + std::string(line.substr(word.size()));
    }
    for (const auto& [word, ink] : kSeverities) {
      if (!begins_with_word(line, word)) continue;
      const std::size_t colon = line.find(": ");
      if (colon == line.npos) break;
      severity_ = ink;
      return inked(ink, line.substr(0, colon)) + ": " +
             inked(kStrong, line.substr(colon + 2));
    }
    const std::size_t first = line.find_first_not_of(' ');
    if (first == line.npos) {
      is_repair_ = false;
      return std::string(line);
    }
    return indented(line, line.substr(first));
  }

 private:
  // `warning[BT2201]: …`, not `warnings`.
  static bool begins_with_word(std::string_view line, std::string_view word) {
    if (!line.starts_with(word)) return false;
    const std::string_view rest = line.substr(word.size());
    return rest.empty() || rest[0] == ' ' || rest[0] == ':' || rest[0] == '[';
  }

  std::string indented(std::string_view line, std::string_view text) {
    for (const std::string_view frame : {"--> ", "= help: ", "= repair"}) {
      if (!text.starts_with(frame)) continue;
      is_repair_ = frame == "= repair";
      return behind_frame(line, line.size() - text.size() +
                                    frame.substr(0, frame.find(' ')).size());
    }
    if (text.starts_with("-- ")) return inked(kStrong, line);
    if (is_repair_ && (text[0] == '-' || text[0] == '+')) {
      return inked(text[0] == '-' ? kRed : kGreen, line);
    }
    // "12 | the line", or " | ^^^^ a label".
    const std::size_t bar = line.find_first_not_of(" 0123456789");
    const bool is_framed =
        bar != line.npos && bar > 0 && line[bar] == '|' && line[bar - 1] == ' ';
    return is_framed ? behind_frame(line, bar + 1) : std::string(line);
  }

  std::string behind_frame(std::string_view line, std::size_t end) const {
    const std::string_view rest = line.substr(end);
    const bool is_quoted =
        line.substr(0, end).find_first_of("0123456789") != line.npos;
    const std::size_t mark = rest.find_first_not_of(' ');
    const bool is_marked = !is_quoted && mark != rest.npos && rest[mark] == '^';
    return inked(kBlue, line.substr(0, end)) +
           (is_marked ? inked(severity_, rest) : std::string(rest));
  }

  std::string_view severity_ = kRed;  // of the diagnostic that it is in
  bool is_repair_ = false;            // these lines are a diff
};

}  // namespace

std::string colored(std::string_view text) {
  Painter painter;
  std::string result;
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    result += painter.line(text.substr(0, end));
    if (end == text.npos) break;
    result += '\n';
    text.remove_prefix(end + 1);
  }
  return result;
}

}  // namespace btcheck
