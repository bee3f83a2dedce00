// SPDX-License-Identifier: MIT
#include "model/tree_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <utility>

#include "model/btcpp/enumerators.hpp"
#include "model/btcpp/expand/expansion.hpp"
#include "model/btcpp/findings.hpp"
#include "model/btcpp/known_types.hpp"
#include "model/btcpp/nav2_branches.hpp"
#include "model/btcpp/outline.hpp"
#include "model/btcpp/tree/engine_tree.hpp"
#include "model/btcpp/unknown_leaves.hpp"
#include "model/foreign_format.hpp"
#include "model/tree/node_types.hpp"
#include "model/tree/releases.hpp"
#include "text/budget.hpp"
#include "text/choice.hpp"

namespace btcheck {
namespace {

IncludedFile find_tree(const TreeReading& reading, std::string_view id) {
  for (const InputFile& file : reading.neighbours) {
    const auto outline = outline_of(file.text);
    if (!outline || !outline->has(id)) continue;
    const auto other = reading.as_near.find(id);
    return {file.name, file.text, "",
            other == reading.as_near.end() ? "" : other->second};
  }
  return {};
}

IncludedFile find_included(const TreeReading& reading,
                           const IncludeRequest& request) {
  if (!request.tree.empty()) return find_tree(reading, request.tree);
  std::string name = included_name(request.from, request.path);
  if (!request.ros_package.empty()) {
    const auto package = reading.packages.find(request.ros_package);
    if (package == reading.packages.end()) {
      return {name, std::nullopt,
              fmt::format("there is no package `{}`, neither in "
                          "AMENT_PREFIX_PATH nor in this workspace",
                          request.ros_package)};
    }
    name = packaged_name(package->second, request.path);
  }
  const auto found =
      std::ranges::find(reading.included, name, &InputFile::name);
  if (found != reading.included.end()) return {name, found->text, ""};
  return {name, std::nullopt, fmt::format("there is no file `{}`", name)};
}

// Which engine the file is for, when nobody says so: Nav2's where one of its
// nodes is used, the oldest of the branches that can load it, and galactic,
// which is older still, where no other one can.
Profile profile_of(const BtcppDocument& document) {
  if (document.release == BtcppRelease::PyTrees) return Profile::PyTrees;
  const bool has_nav2 =
      std::ranges::any_of(document.trees, [&](const BtcppTree& tree) {
        return std::ranges::any_of(tree.nodes, [&](const BtcppNode& node) {
          return btcpp::builtin_type(document.release, node.id) == nullptr &&
                 btcpp::nav2_type(node.id) != nullptr;
        });
      });
  const bool is_release_3 = document.release == BtcppRelease::V3;
  if (!has_nav2) return is_release_3 ? Profile::Btcpp38 : Profile::Btcpp4;
  using enum btcpp::Nav2Branch;
  const btcpp::Nav2Branches branches = btcpp::branches_for(document);
  for (const auto branch : {Humble, Iron, Jazzy, Kilted, Lyrical, Galactic}) {
    if (branches.has(branch)) return btcpp::profile_of_branch(branch);
  }
  return is_release_3 ? Profile::Nav2Humble : Profile::Nav2Main;
}

bool has_round_robin(const BtcppDocument& document) {
  return std::ranges::any_of(document.trees, [](const BtcppTree& tree) {
    return std::ranges::find(tree.nodes, "RoundRobin", &BtcppNode::id) !=
           tree.nodes.end();
  });
}

Diagnostic guess_of(const std::string& name, const BtcppDocument& document,
                    Profile profile) {
  const std::string profiles =
      word(Choice::Profile,
           "nav2-galactic, nav2-humble, nav2-iron, nav2-jazzy, nav2-kilted, "
           "nav2-lyrical or nav2-main");
  return SourceText(name, "").diagnostic(
      Severity::Note, "BT1637", {},
      fmt::format("nodes of Nav2: checked as `{}`", profile_name(profile)), "",
      has_round_robin(document)
          ? fmt::format(
                "name yours, it matters here: {}; behind its last child "
                "RoundRobin begins again up to kilted, and fails from lyrical "
                "(main) on, unless `wrap_around=\"true\"`",
                profiles)
          : fmt::format("name the branch you run: {}", profiles));
}

// The leaves that contracts are about, by the end of their paths.
std::vector<std::string> described_by(const btcpp::LeafContracts& contracts) {
  std::vector<std::string> names;
  for (const btcpp::LeafRule& rule : contracts.rules) {
    names.push_back(rule.name.substr(rule.name.rfind('/') + 1));
  }
  return names;
}

// The entries of which they say what they hold.
std::vector<std::string> given_by(const btcpp::LeafContracts& contracts) {
  std::vector<std::string> names;
  for (const btcpp::DeclaredEntry& each : contracts.entries) {
    names.push_back(each.entry.name);
  }
  return names;
}

// What programs register is declared in files of contracts as well.
std::vector<Diagnostic> add_enumerators(const btcpp::LeafContracts& contracts,
                                        BtcppDocument& document) {
  btcpp::FileFindings findings(contracts.files);
  for (const auto& [file, span, name, number] : contracts.enumerators) {
    const auto first = btcpp::add_enumerator(document.models, name, number);
    if (!first) continue;
    findings.error({file, span}, btcpp::two_numbers_of(name, number, *first));
  }
  return findings.take();
}

// What the engine of the profile refuses is only a note (BT1651) where an older
// release takes the whole file; where none does, each is an error.
void settle_releases(Profile profile, std::vector<Diagnostic>& found) {
  const auto is_refused = [](const Diagnostic& each, int release) {
    return each.severity != Severity::Error && !each.is_doubtful &&
           is_among(release, each.refused_by);
  };
  const int present = engine_release(profile);
  const auto newest = std::ranges::find_if(releases::kKnown, [&](int release) {
    return release < present && release / 10'000 == present / 10'000 &&
           std::ranges::none_of(found, [&](const Diagnostic& each) {
             return is_refused(each, release);
           });
  });
  for (Diagnostic& each : found) {
    if (!is_refused(each, present)) continue;
    if (newest == releases::kKnown.end()) {
      each.severity = Severity::Error;
      continue;
    }
    each.code = "BT1651";
    each.message = fmt::format("refused by BehaviorTree.CPP {}: {}",
                               release_text(present), each.message);
    each.help = fmt::format(
        "{}; {} is the last release that takes this file, and it is checked "
        "as {} runs it",
        each.help, release_text(*newest), release_text(present));
  }
}

Result<BtcppDocument> read_document(const std::string& name,
                                    const FileText& text,
                                    const TreeReading& reading,
                                    std::vector<std::string> described) {
  BtcppOptions options;
  options.described = std::move(described);
  options.models = reading.models;
  options.neighbours = reading.neighbours;
  options.keeps_faulty = true;
  options.is_guess = reading.is_guess;
  if (reading.profile) {
    options.release = btcpp::dialect_of(*reading.profile);
    if (const int release = engine_release(*reading.profile)) {
      options.version = release;
    }
  }
  return read_btcpp(
      name, text,
      [&](const IncludeRequest& request) {
        return find_included(reading, request);
      },
      options);
}

// A tree read for one release, and what others it may be read for where that
// one refuses it, the newest first.
struct ReadTree : Result<BehaviorTree> {
  std::vector<Profile> others;
};

// The branch of Nav2 first, where nodes of Nav2 are used.
std::vector<Profile> profiles_for(const BtcppDocument& document) {
  using enum Profile;
  std::vector<Profile> profiles;
  if (document.release == BtcppRelease::PyTrees) return profiles;
  const Profile guess = profile_of(document);
  if (has_nav2(guess)) profiles.push_back(guess);
  const bool is_3 = document.release == BtcppRelease::V3;
  for (const Profile each :
       {Btcpp49, Btcpp48, Btcpp47, Btcpp46, Btcpp45, Btcpp44, Btcpp43, Btcpp42,
        Btcpp41, Btcpp40, Btcpp37, Btcpp36, Btcpp35, Btcpp351}) {
    if (is_release_3(each) == is_3) profiles.push_back(each);
  }
  return profiles;
}

ReadTree read_for_release(const std::string& name, const FileText& text,
                          const TreeReading& reading) {
  ReadTree result;
  auto leaves = read_leaf_files(reading.leaves, reading.tick_ms);
  auto document = read_document(
      name, text, reading,
      leaves.value ? described_by(*leaves.value) : std::vector<std::string>());
  const auto add = [&](std::vector<Diagnostic>& found) {
    std::ranges::move(found, std::back_inserter(result.diagnostics));
  };
  add(document.diagnostics);
  if (!document.value) return result;
  result.others = profiles_for(*document.value);
  if (leaves.value) {
    auto conflicts = add_enumerators(*leaves.value, *document.value);
    add(conflicts);
  }
  if (reading.profile && has_nav2(*reading.profile)) {
    auto missing = btcpp::missing_in_branch(*document.value, *reading.profile);
    add(missing);
  }
  auto expansion = expand_btcpp(
      *document.value, reading.main_tree,
      leaves.value ? given_by(*leaves.value) : std::vector<std::string>());
  if (!reading.tells_unread) {
    std::erase_if(expansion.diagnostics, [](const Diagnostic& found) {
      return found.code == "BT1645";
    });
  }
  add(expansion.diagnostics);
  if (!expansion.value || has_error(result.diagnostics)) return result;
  const Profile profile = reading.profile.value_or(profile_of(*document.value));
  settle_releases(profile, result.diagnostics);
  if (has_error(result.diagnostics)) return result;
  if (!reading.profile && has_nav2(profile)) {
    result.diagnostics.push_back(guess_of(name, *document.value, profile));
  }
  add(leaves.diagnostics);
  if (!leaves.value) return result;
  leaves.value->elsewhere = reading.other_leaves;
  auto tree = engine_tree(
      *expansion.value, {profile, reading.tick_ms, reading.loops, reading.wakes,
                         std::move(*leaves.value), reading.detail});
  add(tree.diagnostics);
  result.value = std::move(tree.value);
  return result;
}

// What the file was refused for, or would be if a model is right, and not by
// every release.
std::vector<Diagnostic> refusals_in(const std::vector<Diagnostic>& found) {
  std::vector<Diagnostic> refusals;
  std::ranges::copy_if(
      found, std::back_inserter(refusals), [](const Diagnostic& each) {
        return (each.severity == Severity::Error || each.is_doubtful) &&
               !each.refused_by.empty();
      });
  return refusals;
}

// Whether the release refuses the file for one of them.
bool is_refused(int release, const std::vector<Diagnostic>& refusals) {
  return std::ranges::any_of(refusals, [&](const Diagnostic& each) {
    return is_among(release, each.refused_by);
  });
}

std::ptrdiff_t count_errors(const std::vector<Diagnostic>& found) {
  return std::ranges::count(found, Severity::Error, &Diagnostic::severity);
}

// "4.8"; "3.5.1", where a later patch refuses what this one takes.
std::string last_to_take(int release, const std::vector<Diagnostic>& refusals) {
  const bool is_last_patch =
      std::ranges::none_of(releases::kKnown, [&](int other) {
        return other > release && other / 100 == release / 100 &&
               is_refused(other, refusals);
      });
  const std::string text = release_text(release);
  return is_last_patch ? text.substr(0, text.rfind('.')) : text;
}

// What the newest release says against it, as a note.
Diagnostic taken_by_older(const std::vector<Diagnostic>& refusals,
                          Profile older) {
  Diagnostic flaw = refusals.front();
  flaw.severity = Severity::Note;
  flaw.code = "BT1651";
  flaw.message = fmt::format(
      "refused by BehaviorTree.CPP {}: {}",
      release_text(is_release_3(older) ? kNewestRelease3 : kNewestRelease),
      flaw.message);
  const int release = engine_release(older);
  const bool is_alone = std::ranges::any_of(releases::kKnown, [&](int other) {
    return other < release && other / 10'000 == release / 10'000 &&
           is_refused(other, refusals);
  });
  const std::string last = last_to_take(release, refusals);
  flaw.help =
      fmt::format("{}: checked as `{}`",
                  is_alone ? fmt::format("{} is the newest that takes it", last)
                           : fmt::format("releases up to {} take it", last),
                  profile_name(older));
  return flaw;
}

// A file that the newest release refuses is read for the newest that takes it,
// and that is said. What is wrong in every release is told as the one has it
// that takes more of the rest.
Result<BehaviorTree> read_xml(const std::string& name, const FileText& text,
                              const TreeReading& reading) {
  ReadTree best = read_for_release(name, text, reading);
  std::vector<Diagnostic> refusals = refusals_in(best.diagnostics);
  if (reading.profile || refusals.empty()) return best;
  for (const Profile older : std::vector(best.others)) {
    if (is_refused(engine_release(older), refusals)) continue;
    TreeReading how = reading;
    how.is_guess = true;
    how.profile = older;
    ReadTree again = read_for_release(name, text, how);
    const auto more = refusals_in(again.diagnostics);
    refusals.insert(refusals.end(), more.begin(), more.end());
    const bool is_taken = again.value.has_value();
    if (is_taken || (!best.value && count_errors(again.diagnostics) <
                                        count_errors(best.diagnostics))) {
      best = std::move(again);
      best.diagnostics.insert(best.diagnostics.begin(),
                              taken_by_older(refusals, older));
    }
    // No other release is better, or nothing speaks for one.
    if (is_taken || more.empty()) break;
  }
  return best;
}

Result<BehaviorTree> refused(const std::string& name, std::string_view code,
                             std::string message, std::string help) {
  return {
      std::nullopt,
      {SourceText(name, "").diagnostic(
          Severity::Error, code, {}, std::move(message), "", std::move(help))}};
}

// What is asked of a .btf tree and only XML trees have.
std::optional<Result<BehaviorTree>> refused_of_btf(const std::string& name,
                                                   const TreeReading& reading) {
  if (!reading.leaves.empty()) {
    return refused(
        name, "BT1639", "a .btf tree has its contracts in its own file",
        fmt::format("leave {} out, and write `(defaction ...)` beside the tree",
                    word(Choice::Leaves)));
  }
  if (!reading.models.empty()) {
    return refused(name, "BT1636",
                   fmt::format("{} is for XML trees", word(Choice::Models)),
                   "leave it out: a .btf tree has the node types of .btf");
  }
  if (reading.wakes) {
    return refused(name, "BT1636",
                   fmt::format("{} is for XML trees", word(Choice::WakeUps)),
                   "leave it out: under `paper` a tree that runs is ticked "
                   "again a unit of time later");
  }
  if (!reading.main_tree.empty()) {
    return refused(name, "BT1636",
                   fmt::format("{} is for XML trees", word(Choice::MainTree)),
                   "leave it out, and write `(Trees NAME)` in the file");
  }
  return std::nullopt;
}

Result<BehaviorTree> read_paper(const std::string& name, const FileText& text,
                                const TreeReading& reading) {
  if (auto refusal = refused_of_btf(name, reading)) return *refusal;
  auto tree = read_btf(name, text, reading.tick_ms);
  if (!tree.value) return tree;
  for (Node& node : tree.value->nodes) {
    if (node.is_root()) node.loop |= reading.loops;
  }
  return tree;
}

}  // namespace

bool is_xml_name(std::string_view name) {
  return name.ends_with(".xml") || is_project_name(name);
}

bool is_xml(std::string_view name, std::string_view text) {
  if (is_xml_name(name) || name.ends_with(".btf")) return is_xml_name(name);
  return without_blanks(text).starts_with('<');
}

bool is_tree_name(std::string_view name) {
  return is_xml_name(name) || name.ends_with(".btf");
}

std::string included_name(std::string_view from, std::string_view path) {
  const std::filesystem::path asked(path);
  if (asked.is_absolute()) return asked.lexically_normal().string();
  return (std::filesystem::path(from).parent_path() / asked)
      .lexically_normal()
      .string();
}

std::string packaged_name(std::string_view folder, std::string_view path) {
  return (std::filesystem::path(folder) / path).lexically_normal().string();
}

Result<BehaviorTree> read_tree(const std::string& name, const FileText& text,
                               const TreeReading& reading) {
  const Stage stage("the tree was read");
  if (auto foreign = refusal_of_foreign(name, text)) {
    return {std::nullopt, {std::move(*foreign)}};
  }
  const bool has_xml = is_xml(name, text);
  if (reading.profile && is_engine(*reading.profile) != has_xml) {
    return has_xml
               ? refused(name, "BT1636",
                         "an XML tree has no meaning under `paper`",
                         fmt::format(
                             "leave {} out, or name an engine's: btcpp-4, "
                             "btcpp-3.8, nav2-humble, nav2-jazzy, nav2-main …",
                             word(Choice::Profile)))
               : refused(
                     name, "BT1636",
                     fmt::format("a .btf tree has no meaning under `{}`",
                                 profile_name(*reading.profile)),
                     fmt::format("leave {} out: .btf trees are checked under "
                                 "`paper`; or check the XML that `btcheck "
                                 "export TREE.btf --to xml` makes of it",
                                 word(Choice::Profile)));
  }
  return has_xml ? read_xml(name, text, reading)
                 : read_paper(name, text, reading);
}

Result<BtcppDocument> read_tree_document(const std::string& name,
                                         const FileText& text,
                                         const TreeReading& reading) {
  return read_document(name, text, reading, {});
}

std::vector<Diagnostic> add_unknown_leaves(const std::string& name,
                                           const FileText& text,
                                           const TreeReading& reading,
                                           UnknownLeaves& to) {
  if (auto foreign = refusal_of_foreign(name, text)) return {*foreign};
  const auto leaves = read_leaf_files(reading.leaves, reading.tick_ms);
  if (!leaves.value) return leaves.diagnostics;
  const auto described = described_by(*leaves.value);
  auto document = read_document(name, text, reading, described);
  if (document.value) to.add(*document.value, described);
  return std::move(document.diagnostics);
}

}  // namespace btcheck
