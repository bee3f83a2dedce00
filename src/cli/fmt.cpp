// SPDX-License-Identifier: MIT
//
// `btcheck fmt`: files in one style, each written as a whole or not at all.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "batch/entries/entries.hpp"
#include "cli/commands.hpp"
#include "cli/console/console.hpp"
#include "cli/inputs/file_sources.hpp"
#include "cli/inputs/files.hpp"
#include "cli/inputs/inputs.hpp"
#include "ltl/rules/property.hpp"
#include "model/btcpp/outline.hpp"
#include "model/tree_file.hpp"
#include "project/xml_project.hpp"
#include "report/text/report.hpp"
#include "style/kept.hpp"
#include "style/moved.hpp"
#include "style/style.hpp"
#include "text/repair.hpp"

namespace btcheck {
namespace {

namespace fs = std::filesystem;

// A file to be formatted, and the XML files of the folder that it was found in.
struct FileToFormat {
  InputFile file;
  std::shared_ptr<const XmlProject> project;
};

// What is no tree may be XML all the same, a package.xml for instance.
bool is_of_ours(const InputFile& file) {
  return !file.name.ends_with(".xml") || outline_of(file.text).has_value();
}

bool is_formatted_name(const std::string& name) {
  return is_tree_name(name) || is_property_file(name) ||
         name.ends_with(".leaves");
}

class Formatter {
 public:
  explicit Formatter(const Options& options)
      : options_(options), plan_(options.formatting) {}

  ExitCode run() {
    for (const std::string& input : options_.inputs) {
      if (is_folder(input)) {
        format_folder(input);
      } else if (auto file = taken(read_file_in(options_.roots, input))) {
        if (input == kStandardInput && !plan_.stdin_name.empty()) {
          file->name = plan_.stdin_name;
        }
        format({std::move(*file), nullptr});
      }
    }
    if (!options_.is_quiet && options_.input != kStandardInput) tell_summary();
    const bool is_missed = plan_.checks && changed_ > 0;
    return worst_of(has_failed_ ? ExitCode::BadInput : ExitCode::Met,
                    is_missed ? ExitCode::Missed : ExitCode::Met);
  }

 private:
  // The value, or a complaint.
  template <class T>
  std::optional<T> taken(Result<T> result) {
    show(options_, result.diagnostics);
    has_failed_ = has_failed_ || has_error(result.diagnostics);
    return std::move(result.value);
  }
  void fail(std::vector<Diagnostic> found) {
    show(options_, found);
    has_failed_ = true;
  }

  void format_folder(const std::string& folder) {
    const auto names =
        taken(files_in(folder, {}, excludes_of(options_, folder)));
    if (!names) return;
    std::vector<InputFile> files;
    const auto project = std::make_shared<XmlProject>();
    for (const std::string& name : *names) {
      std::error_code fault;
      if (!is_formatted_name(name) || fs::is_symlink(name, fault)) continue;
      auto file = taken(read_file_in(options_.roots, name));
      if (!file || !is_of_ours(*file)) continue;
      if (is_xml_name(name)) add_file(*project, options_.roots, name);
      files.push_back(std::move(*file));
    }
    if (files.empty()) {
      fail({file_error("BT1507", folder,
                       fmt::format("nothing to format in `{}`", folder),
                       "trees end in .btf, .xml or .btproj, rules in .ltl or "
                       ".btp, contracts in .leaves")});
    }
    for (InputFile& file : files) format({std::move(file), project});
  }

  void format(const FileToFormat& asked) {
    const InputFile& file = asked.file;
    const bool is_stdin = options_.input == kStandardInput;
    ++count_;
    const auto text = taken(styled(file));
    if (!text) return;
    const bool is_changed = *text != file.text.text();
    if (is_changed && plan_.verifies && !is_proved(asked, *text)) return;
    if (is_changed && plan_.writes() && !is_stdin) {
      const std::string complaint = rewrite_file(file.name, *text);
      if (!complaint.empty()) {
        complain("BT0004", complaint);
        has_failed_ = true;
        return;
      }
    }
    changed_ += is_changed ? 1 : 0;
    if (is_changed && !is_stdin) warn_of_rules(file, *text);
    if (plan_.writes() && is_stdin) {
      print_for_programs(*text);
    } else if (is_changed && plan_.shows) {
      print_for_programs(
          unified_diff(changed_lines(file.name, file.text.text(), *text)));
    } else if (is_changed) {
      print(file.name + "\n");
    }
  }

  // Rules beside a tree that name its nodes by lines.
  void warn_of_rules(const InputFile& tree, const std::string& text) {
    if (!is_tree_name(tree.name)) return;
    const auto nodes = moved_nodes(tree, text);
    const fs::path folder = fs::path(tree.name).parent_path();
    std::error_code fault;
    fs::directory_iterator at(folder.empty() ? "." : folder, fault);
    for (; !fault && at != fs::directory_iterator(); at.increment(fault)) {
      const std::string name = folder / at->path().filename();
      if (!is_property_file(name) || !at->is_regular_file(fault)) continue;
      const auto rules = read_file_in(options_.roots, name);
      if (!rules.value) continue;
      const auto named = tree_of_properties(*rules.value);
      if (!named.value) continue;
      const bool is_its =
          named.value->empty()
              ? fs::path(name).stem() == fs::path(tree.name).stem()
              : included_name(name, *named.value) ==
                    fs::path(tree.name).lexically_normal();
      if (is_its) show(options_, stale_names(*rules.value, tree.name, nodes));
    }
  }

  // As it is, but for a terminal, which would obey it.
  void print_for_programs(const std::string& text) {
    (::isatty(STDOUT_FILENO) != 0 ? print : print_exactly)(text);
  }

  // Whether each tree of a file is checked as before. Of contracts and rules
  // the words are the same, and with them what they mean.
  bool is_proved(const FileToFormat& asked, const std::string& text) {
    const InputFile& file = asked.file;
    if (is_xml(file.name, file.text)) {
      const auto outline = outline_of(file.text);
      return !outline || std::ranges::all_of(outline->trees, [&](auto& tree) {
        return is_proved(asked, text, tree);
      });
    }
    return !file.name.ends_with(".btf") || is_proved(asked, text, "");
  }

  bool is_proved(const FileToFormat& asked, const std::string& text,
                 const std::string& main_tree) {
    Options options = options_;
    options.project = asked.project;
    options.main_tree = main_tree;
    std::vector<Diagnostic> found;
    const auto inputs = inputs_of(asked.file, options, found);
    if (!inputs) {
      fail(found);
      return false;
    }
    const auto network_of = [&](const FileText& of) {
      const TreeInput tree({asked.file.name, of}, inputs->tree.reading);
      auto lowered =
          lowered_input(tree, inputs->options.judgement, TickSemantics::Root);
      std::erase_if(lowered.diagnostics, [](const Diagnostic& each) {
        return each.severity != Severity::Error;
      });
      return taken(std::move(lowered));
    };
    const auto before = network_of(asked.file.text);
    if (!before) return false;
    const auto after = network_of(text);
    if (!after) return false;
    const std::string other = difference(*before, *after);
    if (other.empty()) return true;
    fail({file_error("BT0013", asked.file.name,
                     "this file would be checked otherwise in the style of "
                     "`btcheck fmt`: " +
                         other,
                     "it is left as it is; please report this")});
    return false;
  }

  void tell_summary() {
    flush_output();
    if (plan_.writes()) {
      tell(fmt::format("{} of {} files formatted\n", changed_, count_));
    } else {
      tell(
          fmt::format("{} of {} files would be formatted\n", changed_, count_));
    }
  }

  const Options& options_;
  const FormattingPlan& plan_;
  std::size_t count_ = 0;
  std::size_t changed_ = 0;
  bool has_failed_ = false;
};

}  // namespace

ExitCode run_fmt(const Options& options) { return Formatter(options).run(); }

}  // namespace btcheck
