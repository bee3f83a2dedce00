// SPDX-License-Identifier: MIT
//
// From files in BehaviorTree.CPP's XML to a document; this file is the order
// of the passes, and its neighbours are their chapters.
//
//   parse_xml      text to elements, with columns              xml_text
//   load_files     the file and all it includes                source_files
//   read_models    <TreeNodesModel>                            models
//   read_trees     <BehaviorTree> to nodes                     trees, children
//
// Then `expand_btcpp` puts each subtree into its place (expansion), and looks
// at what only the whole tree shows.
//
//   BT1600  the file is not XML
//   BT1601  the first element is not <root>
//   BT1602  too large: nesting, files, nodes
//   BT1603  an include that cannot be had
//   BT1604  an ID is missing, or stands where there can be none
//   BT1605  a name that BehaviorTree.CPP does not allow
//   BT1606  a name, path or <TreeNodesModel> that is there already
//   BT1607  wrong number of children
//   BT1608  a way of version 3 that version 4 does not know
//   BT1609  a port that the node does not have
//   BT1610  a port's value is of the wrong type
//   BT1611  it is open which tree runs
//   BT1612  a subtree that does not exist
//   BT1613  a tree that contains itself
//   BT1614  a port that the model of a subtree wants is not remapped
//   BT1615  a script that is none
//   BT1616  a blackboard entry of two types
//   BT1617  a mandatory port is missing
//   BT1618  numbers that a node cannot run with
//   BT1619  what a ReactiveSequence refuses
//   BT1620  note: a leaf that no model knows
//   BT1621  warning: an inner node that no model knows
//   BT1622  warning: no BTCPP_format
//   BT1623  warning: the tag contradicts the node's kind
//   BT1624  warning: two trees of one ID
//   BT1625  warning: something that BehaviorTree.CPP ignores
//   BT1626  warning: a port that the model does not have
//   BT1627  warning: an entry that nothing in the tree writes
//   BT1628  warning: a key that looks misspelt
//   BT1629  warning: a branch that is never reached
//   BT1630  warning: an output port that points at no entry
//   BT1631  warning: a number that takes the children their effect
#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <set>
#include <span>
#include <utility>

#include "model/btcpp/document.hpp"
#include "model/btcpp/findings.hpp"
#include "model/btcpp/models.hpp"
#include "model/btcpp/node_types.hpp"
#include "model/btcpp/source_files.hpp"
#include "model/btcpp/trees.hpp"

namespace btcheck {
namespace btcpp {
namespace {

class DocumentReader {
 public:
  explicit DocumentReader(const BtcppOptions& options) : options_(options) {}

  Result<BtcppDocument> read(std::string_view name, std::string_view text,
                             const IncludeLoader& loader) {
    load_files(name, text, loader, sources_, findings_);
    tree_files_ = sources_.files.size();
    for (const BtcppFile& file : options_.models) {
      load_files(file.name, file.text, loader, sources_, findings_);
    }
    // With a part of the files, nothing true could be said of the others.
    if (!findings_.has_error()) read_files();
    Result<BtcppDocument> result;
    const bool is_good = !findings_.has_error();
    // Before the texts are moved, which the findings quote.
    result.diagnostics = findings_.take();
    if (is_good) {
      std::move(sources_.texts.begin(), sources_.texts.end(),
                std::back_inserter(document_.files));
      result.value = std::move(document_);
    }
    return result;
  }

 private:
  // The file that was asked for comes after those it includes.
  const SourceFile& main_file() const {
    return sources_.files[tree_files_ - 1];
  }
  std::span<const SourceFile> tree_files() const {
    return std::span(sources_.files).first(tree_files_);
  }

  void read_files() {
    decide_release();
    TreeContext context{document_, {}, 0};
    for (const SourceFile& file :
         std::span(sources_.files).subspan(tree_files_)) {
      read_models(file, document_.models, findings_);
    }
    for (const SourceFile& file : tree_files()) {
      read_models(file, document_.models, findings_);
      note_tree_ids(file, context);
    }
    for (const SourceFile& file : tree_files()) {
      read_trees(file, context, findings_);
    }
    decide_main_tree();
    report_unknown_types();
    if (const auto* project = main_file().root().value("project_name")) {
      document_.project_name = *project;
    }
  }

  void decide_release() {
    const XmlElement& root = main_file().root();
    const XmlAttribute* format = root.attribute("BTCPP_format");
    document_.release = format == nullptr || format->value.starts_with('3')
                            ? BtcppRelease::V3
                            : BtcppRelease::V4;
    if (options_.release) document_.release = *options_.release;
    if (format != nullptr || options_.release) return;
    const bool is_v3 = document_.release == BtcppRelease::V3;
    findings_.warning(
        main_file().place(root.span),
        {"BT1622", "the file does not say its version",
         fmt::format("read as version {}", is_v3 ? 3 : 4),
         "write `<root BTCPP_format=\"4\">` if it is for BehaviorTree.CPP 4"});
  }

  void note_tree_ids(const SourceFile& file, TreeContext& context) {
    for (const std::size_t child : file.root().children) {
      const XmlElement& element = file.elements[child];
      if (element.name == "BehaviorTree") {
        const std::string* id = element.value("ID");
        if (id != nullptr) context.tree_ids.insert(*id);
      } else if (element.name != "include" &&
                 element.name != "TreeNodesModel") {
        findings_.warning(
            file.place(element.span),
            {"BT1625", fmt::format("`<{}>` is ignored", element.name),
             "it means nothing here",
             "a file holds include, BehaviorTree and TreeNodesModel"});
      }
    }
  }

  void decide_main_tree() {
    const SourceFile& file = main_file();
    if (const auto* id = file.root().value("main_tree_to_execute")) {
      document_.main_tree = *id;
      return;
    }
    std::vector<const BtcppTree*> own;
    for (const BtcppTree& tree : document_.trees) {
      if (tree.place.file == file.number) own.push_back(&tree);
    }
    if (document_.release == BtcppRelease::V4 && own.size() == 1) {
      document_.main_tree = own.front()->id;
    } else if (document_.trees.size() == 1) {
      document_.main_tree = document_.trees.front().id;
    }
  }

  // Each type once, where it is first used.
  void report_unknown_types() {
    std::set<std::string> told;
    for (const BtcppTree& tree : document_.trees) {
      for (const BtcppNode& node : tree.nodes) {
        if (node.is_known || !told.insert(node.id).second) continue;
        report_unknown(node);
      }
    }
  }

  void report_unknown(const BtcppNode& node) {
    const std::string_view kind =
        kBtcppKindNames[static_cast<std::size_t>(node.kind)];
    Finding finding{
        "BT1620", fmt::format("no model has the node `{}`", node.id),
        fmt::format("taken as {} {}", kind == "Action" ? "an" : "a", kind),
        did_you_mean(node.id, builtin_names(document_.release))};
    const std::string_view today = renamed_type(document_.release, node.id);
    if (!today.empty()) {
      finding.help = fmt::format("version 4 calls it `{}`", today);
    }
    if (finding.help.empty()) {
      finding.help = "describe it in `<TreeNodesModel>`";
    }
    if (node.children.empty()) return findings_.note(node.place, finding);
    finding.code = "BT1621";
    findings_.warning(node.place, finding);
  }

  const BtcppOptions& options_;
  SourceFiles sources_;
  std::size_t tree_files_ = 0;  // those after are models only
  FileFindings findings_;
  BtcppDocument document_;
};

}  // namespace
}  // namespace btcpp

Result<BtcppDocument> read_btcpp(std::string_view name, std::string_view text,
                                 const IncludeLoader& loader,
                                 const BtcppOptions& options) {
  return btcpp::DocumentReader(options).read(name, text, loader);
}

}  // namespace btcheck
