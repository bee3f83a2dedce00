// SPDX-License-Identifier: MIT
//
// What an editor hovers over: the tree is read and nothing is searched.
#include <cstdint>
#include <utility>

#include "api/call.hpp"
#include "api/told.hpp"
#include "model/described.hpp"
#include "report/text/report.hpp"
#include "report/text/type_text.hpp"

namespace btcheck::v1 {
namespace {

Direction direction_of(const std::optional<BtcppDirection>& direction) {
  if (!direction) return Direction::Unknown;
  if (*direction == BtcppDirection::Input) return Direction::Input;
  return *direction == BtcppDirection::Output ? Direction::Output
                                              : Direction::Both;
}

Port port_of(DescribedPort from) {
  Port port;
  port.name = std::move(from.name);
  port.direction = direction_of(from.direction);
  port.type = std::move(from.type);
  port.value = std::move(from.value);
  port.preset = std::move(from.preset);
  port.about = std::move(from.about);
  port.entry = std::move(from.entry);
  if (port.value) port.where = position_of({std::move(from.file), from.span});
  return port;
}

DescribedNode node_of(const BehaviorTree& tree, NodeId id,
                      btcheck::DescribedNode from) {
  const btcheck::Node& of = tree.node(id);
  DescribedNode node;
  node.name = unique_name(tree, id);
  node.label = of.name;
  node.type = std::move(from.type);
  node.kind = std::move(from.kind);
  node.about =
      from.about.empty() ? type_text(of, tree.profile) : std::move(from.about);
  node.where = position_of(place_of(tree, id));
  node.parent = index(of.parent);
  for (DescribedPort& port : from.ports) {
    node.ports.push_back(port_of(std::move(port)));
  }
  return node;
}

void add_entries(const BehaviorTree& tree, Description& description) {
  for (DescribedEntry& from : described_entries(tree)) {
    const std::size_t number = description.entries.size();
    Entry entry{std::move(from.name), std::move(from.values), {}, {}};
    for (const NodeId writer : from.writers) {
      entry.writers.push_back(index(writer));
      description.nodes[index(writer)].writes.push_back(number);
    }
    for (const NodeId reader : from.readers) {
      entry.readers.push_back(index(reader));
      description.nodes[index(reader)].reads.push_back(number);
    }
    description.entries.push_back(std::move(entry));
  }
}

void describe_tree(const TreeInput& input, const BehaviorTree& tree,
                   Description& description) {
  description.profile = profile_name(tree.profile);
  auto nodes = described_nodes(tree, input.text, input.reading);
  for (std::uint32_t i = 0; i < nodes.size(); ++i) {
    description.nodes.push_back(node_of(tree, NodeId{i}, std::move(nodes[i])));
  }
  add_entries(tree, description);
}

}  // namespace

Description described(const Request& request, CallSources& sources,
                      Monitor* monitor) {
  Call call(request, monitor);
  const BudgetScope budget(&call);
  Description description;
  description.tree = request.tree;
  description.outcome = Outcome::BadInput;
  std::vector<Diagnostic> found;
  try {
    if (const auto inputs = inputs_of_tree(request, sources, found)) {
      const TreeInput& input = inputs->tree;
      auto read = read_tree(input.name, input.text, input.reading);
      judge(input, inputs->judgement, read.diagnostics);
      found.insert(found.end(), read.diagnostics.begin(),
                   read.diagnostics.end());
      if (read.value) {
        describe_tree(input, *read.value, description);
        description.outcome = Outcome::Met;
      }
    }
  } catch (const BudgetSpent& spent) {
    description = {};
    description.tree = request.tree;
    description.outcome = Outcome::Undecided;
    found = {spent_diagnostic(spent, request.tree)};
  }
  const BudgetScope telling(nullptr);
  for (const Diagnostic& each : found) {
    description.findings.push_back(finding_of(btcheck::finding_of(each)));
  }
  return description;
}

Description describe(const Request& request, Sources& sources,
                     Monitor* monitor) {
  AskedSources asked(sources, request.is_one_program);
  return described(request, asked, monitor);
}

}  // namespace btcheck::v1
