// SPDX-License-Identifier: MIT
//
// What the steps of a network are called in a graph of its states.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "model/automata/network.hpp"

namespace btcheck {

// Whose answers are seen of a space, beside the passing of time; in the order
// of --observe in cli/options/tables.cpp.
enum class SeenAnswers : std::uint8_t { OfRoot, OfLeaves, OfAll };

// Of a step that nobody sees, as CADP writes it (`man aldebaran`).
inline constexpr std::string_view kHiddenLabel = "i";

// The labels of single steps. Each is made when it is asked for, once.
class StepLabels {
 public:
  // Everything is seen: `land_btn12.tick_node -> success, battery := Good`, the
  // edge and what it assigns, or `time`. Otherwise a node's answer is, in the
  // step in which it decides on it, `land_btn12 -> success`, and `time`. The
  // network must outlive this.
  explicit StepLabels(const Network& network,
                      std::optional<SeenAnswers> seen = std::nullopt);

  // By the number of the edge, or kTimeStep; "" where it is not seen.
  const std::string& of(std::uint32_t edge);

 private:
  const Network& network_;
  std::optional<SeenAnswers> seen_;
  std::vector<std::optional<std::string>> labels_;  // by edge; then time
};

}  // namespace btcheck
