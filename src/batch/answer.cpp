// SPDX-License-Identifier: MIT
//
// The answers stand in a file of contracts: that of -o, else the last one that
// the tree is read with, else `answers.leaves` in the project's folder, which
// its btcheck.toml then names. What concerns no leaf becomes a comment in the
// tree.
#include "batch/answer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <system_error>
#include <tuple>
#include <utility>
#include <vector>

#include "batch/entries/entries.hpp"
#include "check/check.hpp"
#include "check/replies.hpp"
#include "cli/console/console.hpp"
#include "cli/inputs/files.hpp"
#include "cli/inputs/inputs.hpp"
#include "cli/inputs/watch.hpp"
#include "model/tree_file.hpp"
#include "report/text/report.hpp"
#include "text/utf8.hpp"

namespace btcheck {
namespace {

namespace fs = std::filesystem;

// "" where there is no such file; nothing, and what is wrong in `found`, where
// it cannot be read.
std::optional<std::string> text_of(const std::string& name,
                                   std::vector<Diagnostic>& found) {
  std::error_code fault;
  if (!fs::exists(name, fault)) return "";
  auto file = read_file(name);
  if (file.value) return std::string(file.value->text.text());
  found = std::move(file.diagnostics);
  return std::nullopt;
}

bool has_key(const std::string& text, std::string_view key) {
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    const auto begin = line.find_first_not_of(" \t");
    if (begin == line.npos || line.compare(begin, key.size(), key) != 0) {
      continue;
    }
    const auto sign = line.find_first_not_of(" \t", begin + key.size());
    if (sign != line.npos && line[sign] == '=') return true;
  }
  return false;
}

class Session {
 public:
  explicit Session(const Options& options) : options_(options) {}

  // The questions of one tree; false where nothing more is to be asked.
  bool ask(const BatchEntry& entry) {
    changes_behavior_ = changes_text_ = false;
    open_ = 0;
    return ask_once(entry);
  }
  // Whether an answer may have changed what the tree does, and so what is
  // asked.
  bool is_to_ask_again() const { return changes_behavior_; }
  // A comment was written: what was read of the files is out of date.
  bool has_changed_texts() const { return changes_text_; }
  void leave_tree() {
    left_ += open_;
    later_.clear();
  }

  void tell_end() const {
    if (options_.is_quiet) return;
    std::string text = fmt::format(
        "\n{}, {} left open\n",
        counted(answered_, "question answered", "questions answered"), left_);
    for (const std::string& file : written_) {
      text += fmt::format("written: {}\n", file);
    }
    print(text);
  }

  ExitCode code() const { return code_; }

 private:
  bool ask_once(const BatchEntry& entry) {
    Options own = applied(options_, entry.choices);
    own.project = entry.project;
    if (!settings_.empty()) own.settings = settings_;
    std::vector<Diagnostic> found;
    const auto inputs = gather_inputs(entry.input, {}, own, found);
    if (!inputs) return complain_of(found);
    Watch watch(inputs->options);
    CheckOptions how = check_options(inputs->options, watch.limits);
    how.tries_repairs = false;
    const CheckResult result = check(inputs->tree, {}, how);
    watch.monitor.clear();
    if (result.files.empty()) return complain_of(result.diagnostics);
    return ask_of(entry, *inputs, result);
  }

  bool complain_of(const std::vector<Diagnostic>& found) {
    std::vector<Diagnostic> errors = found;
    std::erase_if(errors, [](const Diagnostic& each) {
      return each.severity != Severity::Error;
    });
    show(options_, errors);
    code_ = worst_of(code_, ExitCode::BadInput);
    return true;
  }

  bool ask_of(const BatchEntry& entry, const Inputs& inputs,
              const CheckResult& result) {
    const CheckedFile& file = result.files.front();
    std::map<std::string, std::vector<int>> added;  // see keep_at_node
    bool is_named = false;
    for (const TreeFinding& question : file.findings) {
      const auto answers = replies_to(*result.tree, question);
      if (answers.empty() || is_answered(answers)) continue;
      const std::pair key(question.code, question.node);
      if (is_over_ || later_.contains(key)) {
        ++open_;
        continue;
      }
      if (!is_named) print(fmt::format("\n{}\n", entry.input));
      is_named = true;
      print(
          painted(options_, question_text(result, file, question, answers), 1));
      const auto choice = choose(answers.size());
      if (!choice) {
        ++open_;
        later_.insert(key);
        continue;
      }
      ++answered_;
      const QuestionReply& answer = answers[*choice];
      const bool is_kept = answer.clauses.empty()
                               ? keep_at_node(*result.tree, question, added)
                               : keep(answer, entry, inputs.options);
      if (!is_kept) return false;
    }
    if (file.defaults && file.defaults->stopped != StopReason::None) {
      print(
          fmt::format("\n{}: the search ended at a limit, and more may be to "
                      "be asked\n",
                      entry.input));
      code_ = worst_of(code_, ExitCode::Undecided);
    }
    return !is_over_;
  }

  static std::string question_text(const CheckResult& result,
                                   const CheckedFile& file,
                                   const TreeFinding& question,
                                   const std::vector<QuestionReply>& answers) {
    std::string text =
        finding_text(result, file, question, {Detail::Events, kLineWidth});
    std::size_t widest = 0;
    for (const QuestionReply& each : answers) {
      widest = std::max(widest, each.words.size());
    }
    for (std::size_t i = 0; i < answers.size(); ++i) {
      text += fmt::format("  {}  {:<{}}  {}\n", i + 1, answers[i].words, widest,
                          kept_as(answers[i], question));
    }
    return text + "  Enter: later; q: no more questions\n";
  }

  static std::string kept_as(const QuestionReply& answer,
                             const TreeFinding& question) {
    if (answer.clauses.empty()) {
      return fmt::format("a comment at the node: {}", allowing(question));
    }
    std::string text = contract_of(answer.clauses[0]);
    if (answer.clauses.size() > 1) {
      text += fmt::format(" and {} more", answer.clauses.size() - 1);
    }
    return text;
  }

  // Nothing: later.
  std::optional<std::size_t> choose(std::size_t count) {
    while (true) {
      print("> ");
      flush_output();
      std::string line;
      is_over_ = !std::getline(std::cin, line);
      while (!line.empty() && (line.back() == '\r' || line.back() == ' ')) {
        line.pop_back();
      }
      is_over_ = is_over_ || line == "q";
      if (line.empty() || is_over_) return std::nullopt;
      const auto number = whole_number(line);
      if (number && *number >= 1 && *number <= count) return *number - 1;
      print(count == 1
                ? "1, Enter or q\n"
                : fmt::format("a number from 1 to {}, Enter or q\n", count));
    }
  }

  // All that one of the answers would say has been said in this session.
  bool is_answered(const std::vector<QuestionReply>& answers) const {
    return std::ranges::any_of(answers, [&](const QuestionReply& answer) {
      return !answer.clauses.empty() &&
             std::ranges::all_of(answer.clauses, [&](const auto& clause) {
               return said_.contains(key_of(clause));
             });
    });
  }
  // Of a list, with what is in it.
  using Key = std::tuple<std::string, std::string, std::string>;
  static Key key_of(const LeafClause& clause) {
    return {clause.name, clause.keyword,
            clause.value.starts_with('(') ? clause.value : ""};
  }

  bool keep(const QuestionReply& answer, const BatchEntry& entry,
            const Options& read_with) {
    const std::string name = contracts_for(entry, read_with);
    auto text = read(name);
    if (!text) return false;
    if (text->empty()) {
      text = "; What the leaves of this project mean, by `btcheck answer`\n";
    }
    for (const LeafClause& clause : answer.clauses) {
      said_.insert(key_of(clause));
      changes_behavior_ |=
          clause.keyword == "duration" || clause.keyword == "returns";
    }
    return write(name, with_reply(*std::move(text), answer)) &&
           name_in_settings(name);
  }

  std::string contracts_for(const BatchEntry& entry, const Options& read_with) {
    if (!options_.output.empty()) return options_.output;
    if (!contracts_.empty()) return contracts_;
    for (const std::string& name : read_with.leaves) {
      if (!name.starts_with('(')) contracts_ = name;
    }
    if (!contracts_.empty()) return contracts_;
    new_settings_ = settings_file(read_with, entry.input);
    if (new_settings_.empty()) {
      new_settings_ =
          (folder_for(entry) / "btcheck.toml").lexically_normal().string();
    }
    const fs::path folder = fs::path(new_settings_).parent_path();
    contracts_ = (folder / "answers.leaves").lexically_normal().string();
    return contracts_;
  }

  // The folder that was named, else that of the tree.
  fs::path folder_for(const BatchEntry& entry) const {
    std::error_code fault;
    for (const std::string& source : options_.inputs) {
      if (fs::is_directory(source, fault)) return source;
    }
    return fs::path(entry.input).parent_path();
  }

  bool name_in_settings(const std::string& contracts) {
    if (new_settings_.empty() || contracts != contracts_) return true;
    const auto text = read(new_settings_);
    if (!text) return false;
    if (has_key(*text, "leaves")) {
      print(fmt::format("  add \"answers.leaves\" to `leaves` in {}\n",
                        new_settings_));
      new_settings_.clear();
      return true;
    }
    // A key behind a table would be one of the table.
    const bool is_written =
        write(new_settings_, "leaves = [\"answers.leaves\"]\n" + *text);
    settings_ = std::exchange(new_settings_, "");
    return is_written;
  }

  // Nothing, and told, where it cannot be read: it is not written over then.
  std::optional<std::string> read(const std::string& name) {
    std::vector<Diagnostic> found;
    auto text = text_of(name, found);
    if (!text) complain_of(found);
    return text;
  }

  // A comment before the node, in a line of its own where the node begins one.
  // `added` has the lines, as they were counted before, that have one now.
  bool keep_at_node(const BehaviorTree& tree, const TreeFinding& question,
                    std::map<std::string, std::vector<int>>& added) {
    const Node& node = tree.node(question.node);
    const std::string& name = tree.file_of(question.node);
    std::vector<int>& lines = added[name];
    const int line =
        node.span.line +
        static_cast<int>(std::ranges::count_if(
            lines, [&](int each) { return each <= node.span.line; }));
    const auto read_text = read(name);
    if (!read_text) return false;
    const std::string& text = *read_text;
    const SourceText source(name, text);
    const auto begin = source.offset(line, 1);
    const auto word = source.offset(line, node.span.column);
    const bool is_there =
        begin && word && *word > *begin && text[*word - 1] == '<';
    if (!is_there) {
      print("the line has changed: ask again\n");
      return true;
    }
    const std::string before = text.substr(*begin, *word - 1 - *begin);
    changes_text_ = true;
    const bool is_first = before.find_first_not_of(" \t") == before.npos;
    if (is_first) lines.push_back(node.span.line);
    return write(name,
                 fmt::format("{}<!-- {} -->{}{}", text.substr(0, *word - 1),
                             allowing(question), is_first ? "\n" + before : "",
                             text.substr(*word - 1)));
  }

  bool write(const std::string& name, const std::string& text) {
    const ExitCode code = write_output(name, text);
    code_ = worst_of(code_, code);
    if (code == ExitCode::Met) written_.insert(name);
    return code == ExitCode::Met;
  }

  const Options& options_;
  ExitCode code_ = ExitCode::Met;
  std::string contracts_;     // the file that answers stand in, once known
  std::string new_settings_;  // that have still to name it
  std::string settings_;      // that do, and were not there before
  std::set<Key> said_;
  std::set<std::string> written_;
  std::size_t answered_ = 0;
  std::size_t left_ = 0;
  // Of the tree at hand: what is still open, and was put off.
  std::size_t open_ = 0;
  std::set<std::pair<std::string_view, NodeId>> later_;
  bool changes_behavior_ = false;
  bool changes_text_ = false;
  bool is_over_ = false;
};

}  // namespace

ExitCode run_answer(const Options& options) {
  ExitCode code = ExitCode::Met;
  for (const std::string& source : options.inputs) {
    if (source == kStandardInput) {
      complain("BT0001", "standard input has the answers: name a file");
      return ExitCode::BadInput;
    }
    if (!source.ends_with(".btf")) continue;
    show(options,
         {file_error("BT1636", source, "questions are asked of XML trees only",
                     "write the answer into the contract in its own file, as "
                     "in `(defaction clean :may-be-cut-off)`")});
    code = ExitCode::BadInput;
  }
  Session session(options);
  std::vector<BatchEntry> entries = gather_batch(options);
  bool goes_on = true;
  for (std::size_t i = 0; i < entries.size() && goes_on; ++i) {
    if (has_error(entries[i].diagnostics)) {
      show(options, entries[i].diagnostics);
      code = worst_of(code, ExitCode::BadInput);
      continue;
    }
    if (!is_xml_name(entries[i].input)) continue;
    do {
      goes_on = session.ask(entries[i]);
      if (session.has_changed_texts()) entries = gather_batch(options);
    } while (goes_on && session.is_to_ask_again() && i < entries.size());
    session.leave_tree();
  }
  session.tell_end();
  return worst_of(code, session.code());
}

}  // namespace btcheck
