// SPDX-License-Identifier: MIT
//
// The lines of two texts are compared by their longest common subsequence. What
// they share at the beginning and the end is set aside before: a repair is
// short. Where the rest is long all the same, it is told as one change.
#include "text/repair.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <string_view>

#include "text/diagnostic.hpp"

namespace btcheck {
namespace {

std::vector<std::string_view> lines_of(std::string_view text) {
  std::vector<std::string_view> lines;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size() - 1) + 1;
    lines.push_back(text.substr(0, end));
    text.remove_prefix(end);
  }
  return lines;
}

// A stretch of lines in two texts: [begin, end) in each.
struct Hunk {
  std::size_t begin = 0;
  std::size_t end = 0;
  std::size_t new_begin = 0;
  std::size_t new_end = 0;
};

using Lines = std::vector<std::string_view>;

// What differs between the common beginning and the common end.
Hunk middle_of(const Lines& before, const Lines& after) {
  Hunk hunk{0, before.size(), 0, after.size()};
  while (hunk.begin < hunk.end && hunk.new_begin < hunk.new_end &&
         before[hunk.begin] == after[hunk.new_begin]) {
    ++hunk.begin;
    ++hunk.new_begin;
  }
  while (hunk.begin < hunk.end && hunk.new_begin < hunk.new_end &&
         before[hunk.end - 1] == after[hunk.new_end - 1]) {
    --hunk.end;
    --hunk.new_end;
  }
  return hunk;
}

// The length of the longest common subsequence from each pair of lines on.
class CommonLines {
 public:
  CommonLines(const Lines& before, const Lines& after, const Hunk& middle)
      : columns_(middle.new_end - middle.new_begin + 1),
        length_((middle.end - middle.begin + 1) * columns_) {
    for (std::size_t i = middle.end - middle.begin; i-- > 0;) {
      for (std::size_t j = columns_ - 1; j-- > 0;) {
        const bool is_same =
            before[middle.begin + i] == after[middle.new_begin + j];
        at(i, j) = is_same ? at(i + 1, j + 1) + 1
                           : std::max(at(i + 1, j), at(i, j + 1));
      }
    }
  }
  std::uint32_t& at(std::size_t i, std::size_t j) {
    return length_[i * columns_ + j];
  }

 private:
  std::size_t columns_;
  std::vector<std::uint32_t> length_;
};

std::vector<Hunk> hunks_of(const Lines& before, const Lines& after) {
  constexpr std::size_t kMostCompared = 1'000'000;
  const Hunk middle = middle_of(before, after);
  const std::size_t rows = middle.end - middle.begin;
  const std::size_t columns = middle.new_end - middle.new_begin;
  if (rows + columns == 0) return {};
  if ((rows + 1) * (columns + 1) > kMostCompared) return {middle};
  CommonLines common(before, after, middle);
  std::vector<Hunk> hunks;
  const auto hunk_at = [&](std::size_t i, std::size_t j) -> Hunk& {
    i += middle.begin;
    j += middle.new_begin;
    if (hunks.empty() || hunks.back().end != i || hunks.back().new_end != j) {
      hunks.push_back({i, i, j, j});
    }
    return hunks.back();
  };
  for (std::size_t i = 0, j = 0; i < rows || j < columns;) {
    if (i < rows && j < columns &&
        before[middle.begin + i] == after[middle.new_begin + j]) {
      ++i;
      ++j;
    } else if (j == columns ||
               (i < rows && common.at(i + 1, j) >= common.at(i, j + 1))) {
      ++hunk_at(i++, j).end;
    } else {
      ++hunk_at(i, j++).new_end;
    }
  }
  return hunks;
}

std::vector<std::string> copied(const Lines& lines, std::size_t begin,
                                std::size_t end) {
  std::vector<std::string> copies;
  for (std::size_t i = begin; i < end; ++i) copies.emplace_back(lines[i]);
  return copies;
}

// As a line of a file is quoted: without its end and what a terminal obeys.
std::string quoted(const std::string& line) {
  return SourceText("", line).line(1);
}

// Changes that are so near that they share their context, [first, end).
struct Group {
  std::size_t first = 0;
  std::size_t end = 0;
};

std::vector<Group> groups_of(const std::vector<ChangedLines>& changes) {
  constexpr int kContext = 2;  // behind one change and before the next
  std::vector<Group> groups;
  for (std::size_t i = 0; i < changes.size(); ++i) {
    const bool is_near =
        i > 0 && changes[i].first - line_behind(changes[i - 1]) <= kContext;
    if (is_near) {
      groups.back().end = i + 1;
    } else {
      groups.push_back({i, i + 1});
    }
  }
  return groups;
}

// "@@ -3,4 +3,5 @@", with the lines of a group; `shift` is how far the lines
// before it have moved those behind.
std::string heading(int first, const std::vector<std::string>& lines,
                    std::ptrdiff_t shift) {
  const auto stretch = [&](std::ptrdiff_t line, char other) {
    const auto count = std::ranges::count_if(
        lines, [&](const std::string& each) { return each[0] != other; });
    // Of no lines, the one before them is named.
    if (count == 0) --line;
    return count == 1 ? std::to_string(line)
                      : fmt::format("{},{}", line, count);
  };
  return fmt::format("@@ -{} +{} @@", stretch(first, '+'),
                     stretch(first + shift, '-'));
}

// As a program takes it.
std::string exact(const std::string& line) {
  if (line.ends_with('\n')) return line.substr(0, line.size() - 1);
  return line + "\n\\ No newline at end of file";
}

using ShownLine = std::string (*)(const std::string& line);

std::vector<std::string> lines_of(const ChangedFile& file, const Group& group,
                                  ShownLine shown) {
  std::vector<std::string> lines;
  const auto add = [&](char sign, const std::string& line) {
    lines.push_back(sign + shown(line));
  };
  for (std::size_t i = group.first; i < group.end; ++i) {
    const auto& [before, after] = file.around[i];
    // Of two changes a line apart, the first has told it.
    const bool is_told =
        i > group.first &&
        file.changes[i].first - line_behind(file.changes[i - 1]) == 1;
    if (!before.empty() && !is_told) add(' ', before);
    for (const std::string& each : file.changes[i].before) add('-', each);
    for (const std::string& each : file.changes[i].after) add('+', each);
    if (!after.empty()) add(' ', after);
  }
  return lines;
}

void add_diff(const ChangedFile& file, ShownLine shown,
              std::vector<std::string>& lines) {
  std::ptrdiff_t shift = 0;
  for (const Group& group : groups_of(file.changes)) {
    const bool has_before = !file.around[group.first].first.empty();
    const int first =
        file.changes[group.first].first - static_cast<int>(has_before);
    const std::vector<std::string> told = lines_of(file, group, shown);
    lines.push_back(heading(first, told, shift));
    lines.insert(lines.end(), told.begin(), told.end());
    for (std::size_t i = group.first; i < group.end; ++i) {
      shift += std::ssize(file.changes[i].after) -
               std::ssize(file.changes[i].before);
    }
  }
}

}  // namespace

int line_behind(const ChangedLines& change) {
  return change.first + static_cast<int>(change.before.size());
}

std::string text_put_in(const ChangedLines& change) {
  std::string text;
  for (const std::string& line : change.after) text += line;
  return text;
}

ChangedFile changed_lines(const std::string& file, const std::string& before,
                          const std::string& after) {
  const Lines old_lines = lines_of(before);
  const Lines new_lines = lines_of(after);
  ChangedFile changed;
  changed.file = file;
  for (const Hunk& hunk : hunks_of(old_lines, new_lines)) {
    changed.changes.push_back(
        {static_cast<int>(hunk.begin) + 1,
         copied(old_lines, hunk.begin, hunk.end),
         copied(new_lines, hunk.new_begin, hunk.new_end)});
    changed.around.emplace_back(
        hunk.begin > 0 ? old_lines[hunk.begin - 1] : "",
        hunk.end < old_lines.size() ? old_lines[hunk.end] : "");
  }
  return changed;
}

std::string unified_diff(const ChangedFile& file) {
  std::vector<std::string> lines = {"--- " + file.file, "+++ " + file.file};
  add_diff(file, exact, lines);
  return fmt::format("{}\n", fmt::join(lines, "\n"));
}

std::vector<std::string> diff_lines(const CheckedRepair& repair,
                                    std::size_t most) {
  std::vector<std::string> lines;
  for (const ChangedFile& file : repair.files) {
    if (repair.files.size() > 1) {
      lines.push_back("--- " + file.file);
      lines.push_back("+++ " + file.file);
    }
    add_diff(file, quoted, lines);
  }
  if (lines.size() > most + 1) {
    const std::size_t left_out = lines.size() - most;
    lines.resize(most);
    lines.push_back(fmt::format("… {} more lines", left_out));
  }
  return lines;
}

}  // namespace btcheck
