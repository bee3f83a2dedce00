// SPDX-License-Identifier: MIT
#include "suites/described_suite.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>
#include <string_view>

#include "check/simulate/simulation.hpp"
#include "model/btcpp/known_types.hpp"
#include "model/btcpp/xml_text.hpp"
#include "model/tree/node_types.hpp"
#include "model/tree_file.hpp"
#include "suites/suite.hpp"
#include "trace/formats/text.hpp"

namespace btcheck {
namespace {

using btcpp::ParsedXml;
using btcpp::XmlElement;

std::string_view text_of(const XmlElement& element, std::string_view text) {
  const std::size_t end =
      element.end_tag.size() > 0 ? element.end_tag.end : element.start_tag.end;
  return text.substr(element.start_tag.begin, end - element.start_tag.begin);
}

// The trees that are used, and the models of SubTrees, which say what is passed
// where nothing is written.
std::string one_text(const BtcppDocument& document, const BehaviorTree& tree) {
  const std::string& main = tree.node(tree.roots.front()).name;
  std::set<std::string> used = {main};
  for (const Node& node : tree.nodes) {
    if (node.type == NodeType::SubTree) used.insert(node.id);
  }
  std::string trees;
  std::string models;
  std::set<std::string> known;
  bool has_main = false;
  for (const InputFile& file : document.files) {
    const auto parsed = file.text.parsed<ParsedXml>();
    if (!parsed->value) continue;
    const std::vector<XmlElement>& elements = *parsed->value;
    const auto take = [&](const XmlElement& element, std::string& to) {
      const std::string id = element.name + ' ' + element.value_or_empty("ID");
      if (!known.insert(id).second) return;
      to.append("  ").append(text_of(element, file.text)).append("\n");
    };
    for (const std::size_t child : elements[0].children) {
      const XmlElement& element = elements[child];
      const std::string* id = element.value("ID");
      has_main = has_main || (id != nullptr && *id == main);
      // One without an ID has been given a name by the reader.
      const bool is_used = id != nullptr ? used.contains(*id)
                                         : main.starts_with("BehaviorTree_");
      if (element.name == "BehaviorTree" && is_used) take(element, trees);
      if (element.name != "TreeNodesModel") continue;
      for (const std::size_t model : element.children) {
        if (elements[model].name == "SubTree") take(elements[model], models);
      }
    }
  }
  if (!models.empty()) {
    models = fmt::format("  <TreeNodesModel>\n{}  </TreeNodesModel>\n", models);
  }
  const bool is_4 = document.release == BtcppRelease::V4;
  return fmt::format(
      "<root{}{}>\n{}{}</root>\n", is_4 ? " BTCPP_format=\"4\"" : "",
      has_main ? fmt::format(" main_tree_to_execute=\"{}\"", main) : "", trees,
      models);
}

std::string_view plain_type(std::string_view type) {
  static const std::map<std::string_view, std::string_view> kTypes = {
      {"int", "int"},           {"int32_t", "int"},
      {"unsigned", "unsigned"}, {"unsigned int", "unsigned"},
      {"uint32_t", "unsigned"}, {"bool", "bool"},
      {"double", "double"},     {"std::string", "string"},
      {"string", "string"}};
  const auto found = kTypes.find(type);
  return found == kTypes.end() ? "" : found->second;
}

SuiteLeaf leaf_of(const Node& node, const BtcppDocument& document) {
  SuiteLeaf leaf{node.id, node.type == NodeType::Condition, {}};
  const BtcppModel* model = document.model(node.id);
  if (model == nullptr) return leaf;
  for (const BtcppPort& port : model->ports) {
    const char direction = port.direction == BtcppDirection::Input    ? 'i'
                           : port.direction == BtcppDirection::Output ? 'o'
                                                                      : 'b';
    leaf.ports.push_back(
        {port.name, direction, std::string(plain_type(port.type))});
  }
  return leaf;
}

// Of a node that no model has: the ports that the tree gives it.
void add_ports(const Node& node, SuiteLeaf& leaf) {
  for (const Argument& given : node.arguments) {
    if (std::ranges::count(leaf.ports, given.key, &SuiteLeafPort::name) > 0) {
      continue;
    }
    leaf.ports.push_back({given.key, 'i', ""});
  }
}

}  // namespace

DescribedSuite described_suite(const TreeInput& input,
                               const BehaviorTree& tree) {
  namespace fs = std::filesystem;
  DescribedSuite suite;
  const Node& root = tree.node(tree.roots.front());
  suite.name = identifier(fs::path(input.name).stem().string());
  suite.file = input.name;
  suite.title = root.name;
  suite.keys = tick_line_keys(tree);
  suite.release = is_engine(tree.profile) && tree.profile != Profile::PyTrees
                      ? (is_release_3(tree.profile) ? 3 : 4)
                      : 0;
  if (suite.release == 0) return suite;
  TreeReading reading = input.reading;
  reading.profile = tree.profile;
  const auto document = read_tree_document(input.name, input.text, reading);
  if (!document.value) return suite;
  suite.xml = one_text(*document.value, tree);
  std::map<std::string, SuiteLeaf> leaves;
  std::set<std::string> linked;
  std::set<std::string> unknown;
  for (const Node& node : tree.nodes) {
    if (node.is_root() ||
        btcpp::builtin_type(document.value->release, node.id) != nullptr) {
      continue;
    }
    if (is_scripted(node.type)) {
      const auto [at, is_new] =
          leaves.try_emplace(node.id, leaf_of(node, *document.value));
      add_ports(node, at->second);
    } else if (node.type == NodeType::OtherControl ||
               node.type == NodeType::OtherDecorator) {
      unknown.insert(node.id);
    } else if (btcpp::nav2_type(node.id) != nullptr) {
      linked.insert(node.id);
    }
  }
  for (auto& [id, leaf] : leaves) suite.leaves.push_back(std::move(leaf));
  suite.linked.assign(linked.begin(), linked.end());
  suite.unknown.assign(unknown.begin(), unknown.end());
  return suite;
}

}  // namespace btcheck
