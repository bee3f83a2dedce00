// SPDX-License-Identifier: MIT
#include "cli/inputs.hpp"

#include <fmt/format.h>

#include <utility>

#include "cli/complaints.hpp"
#include "cli/files.hpp"

namespace btcheck {
namespace {

bool is_property_file(const std::string& name) {
  return name.ends_with(".ltl") || name.ends_with(".btp");
}

// `btcheck rules.ltl`: the tree is the one that the file names.
std::optional<std::string> tree_named_by(const Options& options,
                                         const InputFile& properties,
                                         std::vector<Diagnostic>& found) {
  const Result<std::string> named = tree_of_properties(properties);
  if (!named.value) {
    show(options, named.diagnostics);
    found = named.diagnostics;
    return std::nullopt;
  }
  if (!named.value->empty()) return path_beside(properties.name, *named.value);
  Diagnostic nameless;
  nameless.code = "BT0003";
  nameless.message =
      fmt::format("`{}` names no tree; write btcheck TREE.btf --prop {}",
                  properties.name, properties.name);
  complain(nameless.code, nameless.message);
  nameless.file = properties.name;
  found.push_back(std::move(nameless));
  return std::nullopt;
}

}  // namespace

std::optional<Inputs> read_inputs(const Options& options,
                                  std::vector<Diagnostic>& found) {
  const auto take = [&](const Result<InputFile>& read) {
    show(options, read.diagnostics);
    found.insert(found.end(), read.diagnostics.begin(), read.diagnostics.end());
  };
  Inputs inputs;
  std::string tree = options.input;
  std::vector<std::string> names = options.properties;
  if (is_property_file(tree)) names.insert(names.begin(), tree);
  bool is_readable = true;
  for (const std::string& name : names) {
    auto read = read_file(name);
    take(read);
    is_readable &= read.value.has_value();
    if (read.value) inputs.properties.push_back(std::move(*read.value));
  }
  if (!is_readable) return std::nullopt;
  if (is_property_file(tree)) {
    auto named = tree_named_by(options, inputs.properties[0], found);
    if (!named) return std::nullopt;
    tree = *named;
  }
  auto read = read_file(tree);
  take(read);
  if (!read.value) return std::nullopt;
  inputs.tree = std::move(*read.value);
  return inputs;
}

std::optional<Lowered> read_and_lower(const Options& options) {
  auto file = read_file(options.input);
  show(options, file.diagnostics);
  if (!file.value) return std::nullopt;
  auto read = read_btf(file.value->name, file.value->text);
  show(options, read.diagnostics);
  if (!read.value) return std::nullopt;
  Lowered lowered{std::move(*read.value), {}, std::move(file.value->text)};
  lowered.network =
      lower(lowered.tree, options.ticks.value_or(TickSemantics::Root));
  return lowered;
}

}  // namespace btcheck
