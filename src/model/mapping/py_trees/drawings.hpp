// SPDX-License-Identifier: MIT
//
// What each node type of py_trees does (composites.py and decorators.py of
// 2.2.3; docs/pytrees.md). `rstatus` is the status that py_trees keeps, and is
// kept as there: a node that has ended keeps its status until somebody stops it
// with INVALID, and all below it with it.
#pragma once

#include <vector>

#include "model/mapping/btcpp/builder.hpp"

namespace btcheck::mapping {

// The pen for them. Nothing is skipped, and there are no scripts around a tick.
class PyTreesBuilder : public EngineBuilder {
 public:
  explicit PyTreesBuilder(NodeBuilder& draw)
      : EngineBuilder(draw, Begins::Silently) {}

  // That this child, and all below it, are INVALID.
  std::vector<Assignment> invalid(std::size_t child);
  std::vector<Assignment> invalid(const std::vector<std::size_t>& of);

  // child.stop(INVALID) for each of these that is not INVALID, where some may
  // run.
  void stop(LocationId from, LocationId then,
            const std::vector<std::size_t>& children,
            std::vector<Assignment> updates = {});
  // The children behind this one.
  std::vector<std::size_t> behind(std::size_t child) const;
  // stop(INVALID) of the node itself.
  void on_stop(std::vector<Assignment> updates = {});
};

// That a node, and all below it, are INVALID.
std::vector<Assignment> all_invalid(const Context& context, NodeId node);

extern const Family kPyTreesLeafDrawings;
extern const Family kPyTreesCompositeDrawings;
extern const Family kPyTreesDecoratorDrawings;

}  // namespace btcheck::mapping
