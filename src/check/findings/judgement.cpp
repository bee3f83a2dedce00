// SPDX-License-Identifier: MIT
#include "check/findings/judgement.hpp"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "check/findings/allowances.hpp"
#include "text/utf8.hpp"
#include "text/wildcards.hpp"

namespace btcheck {
namespace {

namespace fs = std::filesystem;

// --- Comments ------------------------------------------------------------

// In the line, or in those right above it.
bool is_allowed_at(const SourceText& source, int line, std::string_view code) {
  const auto allows = [&](const std::string& text) {
    return allowed_in(text).find(code) != std::string_view::npos;
  };
  if (allows(source.line(line))) return true;
  for (int above = line - 1; above > 0; --above) {
    const std::string text = source.line(above);
    if (!is_comment_line(text)) return false;
    if (allows(text)) return true;
  }
  return false;
}

// --- Levels --------------------------------------------------------------

Level level_of(Severity severity) {
  if (severity == Severity::Error) return Level::Error;
  return severity == Severity::Warning ? Level::Warning : Level::Note;
}

Severity severity_of(Level level) {
  if (level == Level::Error) return Severity::Error;
  return level == Level::Warning ? Severity::Warning : Severity::Note;
}

bool is_about(const LevelRule& rule, const std::string& file) {
  return rule.pattern.empty() ||
         matches_path(rule.pattern,
                      fs::path(file).lexically_relative(rule.folder).string());
}

bool is_named(std::string_view word, std::string_view code, Level level) {
  return equal_ignoring_case(word, code) ||
         (word == kWarnings && level == Level::Warning);
}

Level level_for(const Judgement& said, const KnownFinding& finding,
                Level level) {
  const std::string file = placed(said.directory, finding.file);
  for (const LevelRule& rule : said.levels) {
    if (!is_named(rule.code, finding.code, level)) continue;
    if (is_about(rule, file)) level = rule.level;
  }
  const bool is_denied =
      std::ranges::any_of(said.denied, [&](const std::string& word) {
        return is_named(word, finding.code, level);
      });
  return is_denied ? Level::Error : level;
}

// --- The baseline --------------------------------------------------------

// The beginning of a line: one may be a whole file.
std::string shortened_line(const std::string& line) {
  constexpr std::size_t kMost = 160;
  const auto begin = line.find_first_not_of(' ');
  if (begin == line.npos) return {};
  std::string text = line.substr(begin, line.find_last_not_of(' ') + 1 - begin);
  if (text.size() <= kMost) return text;
  std::size_t end = kMost;
  while (end > 0 && continues_character(text[end])) --end;
  return text.substr(0, end);
}

}  // namespace

std::string placed(const std::string& directory, const std::string& file) {
  return (fs::path(directory) / file).lexically_normal().string();
}

std::string folder_of(const std::string& directory, const std::string& file) {
  return fs::path(placed(directory, file)).parent_path().string();
}

std::vector<KnownFinding> counted_alike(std::vector<KnownFinding> findings) {
  std::ranges::sort(findings, {}, &KnownFinding::key);
  std::vector<KnownFinding> distinct;
  for (KnownFinding& each : findings) {
    if (!distinct.empty() && distinct.back().key() == each.key()) {
      distinct.back().count += each.count;
      distinct.back().can_fail |= each.can_fail;
    } else {
      distinct.push_back(std::move(each));
    }
  }
  return distinct;
}

std::string FindingsJudge::line_of(const std::string& file, int line) const {
  const auto source = std::ranges::find(sources_, file, &SourceText::name);
  return source == sources_.end() ? std::string() : source->line(line);
}

bool FindingsJudge::is_told(KnownFinding finding, int line, Severity& severity,
                            Severity least) {
  const auto source =
      std::ranges::find(sources_, finding.file, &SourceText::name);
  const Level level = level_for(said_, finding, level_of(severity));
  if (level == Level::Allow || (source != sources_.end() &&
                                is_allowed_at(*source, line, finding.code))) {
    judged_.allowed += severity <= least;
    return false;
  }
  severity = severity_of(level);
  if (severity > least) return false;
  finding.can_fail = severity != Severity::Note;
  KnownFinding wanted = finding;
  wanted.file = placed(said_.directory, finding.file);
  const auto known =
      std::ranges::lower_bound(unused_, wanted.key(), {}, &KnownFinding::key);
  const bool is_new = known == unused_.end() || known->count == 0 ||
                      known->key() != wanted.key();
  if (!is_new) --known->count;
  (is_new ? judged_.told : judged_.known).push_back(std::move(finding));
  return is_new;
}

void FindingsJudge::judge(std::vector<TreeFinding>& findings,
                          const BehaviorTree& tree, Severity least) {
  std::erase_if(findings, [&](TreeFinding& each) {
    return !judge(each.code, tree, each.node, each.severity, least);
  });
}

bool FindingsJudge::judge(std::string_view code, const BehaviorTree& tree,
                          NodeId at, Severity& severity, Severity least) {
  const Node& node = tree.node(at);
  const std::string& file = tree.file_of(at);
  const std::string text = line_of(file, node.span.line);
  return is_told(
      {std::string(code), file, stable_name(node), shortened_line(text)},
      node.span.line, severity, least);
}

void FindingsJudge::judge(std::vector<Diagnostic>& diagnostics) {
  std::erase_if(diagnostics, [&](Diagnostic& each) {
    if (each.severity == Severity::Error) return false;
    const bool is_left =
        is_told({each.code, each.file, {}, shortened_line(each.source_line)},
                each.span.line, each.severity, Severity::Note);
    judged_.is_denied |= is_left && each.severity == Severity::Error;
    return !is_left;
  });
}

Judged FindingsJudge::take() {
  judged_.told = counted_alike(std::move(judged_.told));
  judged_.has_baseline = said_.has_baseline;
  judged_.known = counted_alike(std::move(judged_.known));
  return std::move(judged_);
}

}  // namespace btcheck
