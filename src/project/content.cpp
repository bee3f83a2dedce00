// SPDX-License-Identifier: MIT
#include "project/content.hpp"

#include <fmt/format.h>

#include <iterator>

#include "model/tree_file.hpp"

namespace btcheck {

void Content::add(std::string_view part) {
  fmt::format_to(std::back_inserter(text_), "{}:{}\n", part.size(), part);
}

void Content::add(const std::vector<InputFile>& files) {
  for (const InputFile& file : files) {
    add(file.name);
    add(file.text);
  }
  add("");
}

void Content::add(const TreeInput& tree) {
  add(tree.name);
  add(tree.text);
  const TreeReading& reading = tree.reading;
  for (const auto* files : {&reading.models, &reading.leaves, &reading.included,
                            &reading.neighbours}) {
    add(*files);
  }
  for (const std::string& leaf : reading.other_leaves) add(leaf);
  add("");
  add(fmt::format("profile {} tick {} loop {} wake {} main {}",
                  reading.profile ? profile_name(*reading.profile) : "",
                  reading.tick_ms, reading.loops, reading.wakes,
                  reading.main_tree));
  for (const auto* names : {&reading.packages, &reading.as_near}) {
    for (const auto& [name, place] : *names) {
      add(name);
      add(place);
    }
    add("");
  }
}

}  // namespace btcheck
