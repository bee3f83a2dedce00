// SPDX-License-Identifier: MIT
//
// A tree as a drawing, or with its properties as a model for another program.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "check/bind/bound_property.hpp"
#include "check/check.hpp"
#include "check/export/claims.hpp"
#include "model/automata/network.hpp"
#include "text/diagnostic.hpp"

namespace btcheck {

// In the order of `--to`. The first three draw the tree alone, Automata (in
// Graphviz's language) also what it is lowered to; Xml and Btf write it in the
// other language. Monitor writes no model, but the rules as a table for what
// watches the program that runs the tree, and MonitorCpp both as a header;
// Ltsmin the command lines with which LTSmin checks it, which has the model
// from libbtcheck-pins.so.
enum class ExportFormat : std::uint8_t {
  Dot,
  Svg,
  Mermaid,
  Automata,
  Promela,
  Smv,
  Fiacre,
  HFiacre,
  Xml,
  Btf,
  Monitor,
  MonitorCpp,
  Ltsmin
};

struct ExportOptions {
  ExportFormat format = ExportFormat::Dot;
  std::optional<TickSemantics> ticks;  // overrides what property files say
  ExtraAssumption extra = ExtraAssumption::None;
  std::string words = {};  // Ltsmin: the tree and the options, as typed
  std::string space = {};  // MonitorCpp: its namespace; "": one of its own
};

// The model, or with Xml and Btf the tree itself in the other language; of a
// model, with every property of the files that the language can say; the
// others are named in comments at its end and by warnings. After an error in
// reading or binding there is no text.
Result<std::string> export_model(const TreeInput& tree,
                                 const std::vector<InputFile>& properties,
                                 const ExportOptions& options);

// What LTSmin searches.
struct LtsminModel {
  std::unique_ptr<BehaviorTree> tree;
  std::unique_ptr<Network> network;
  std::vector<LtsminClaim> claims;
};
Result<LtsminModel> ltsmin_model(const TreeInput& tree,
                                 const std::vector<InputFile>& properties,
                                 const ExportOptions& options);

}  // namespace btcheck
