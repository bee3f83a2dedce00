// SPDX-License-Identifier: MIT
//
// Subtrees in place of their names.
//
// A SubTree names another BehaviorTree form. First every name is looked up;
// then a depth-first search over the forms, with an explicit stack, finds and
// cuts the references that close a circle; what is left can be expanded, by a
// second stack that walks through the forms as if they were one tree and gives
// out numbers in pre-order. A few short forms can expand to more nodes than
// fit into any memory, so the expansion counts and stops.
#include "model/btf/expansion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <functional>
#include <map>

#include "model/btf/variables.hpp"
#include "model/tree/node_types.hpp"

namespace btcheck::btf {
namespace {

constexpr std::size_t kMostNodes = 20'000;
constexpr std::size_t kMostWords = 2'000'000;

// Appends the node of a draft under its parent, or as a root.
NodeId add_node(TreeForms::Expansion& expansion, const NodeDraft& draft,
                std::optional<NodeId> parent) {
  std::vector<Node>& nodes = expansion.tree.nodes;
  const NodeId id{static_cast<std::uint32_t>(nodes.size())};
  nodes.push_back(draft.node);
  nodes.back().parent = parent.value_or(id);
  if (parent) {
    nodes[index(*parent)].children.push_back(id);
  } else {
    expansion.tree.roots.push_back(id);
  }
  expansion.drafts.push_back(&draft);
  return id;
}

// The name a SubTree refers to: its :ID, else its :name.
const std::string& referred_name(const Node& node) {
  return node.id.empty() ? node.name : node.id;
}

}  // namespace

TreeForms::TreeForms(const Reading& reading, std::vector<TreeDraft> trees)
    : reading_(reading), trees_(std::move(trees)) {
  name_trees();
  resolve_references();
  cut_cycles();
}

// A form is known by its :name and by its :ID.
void TreeForms::name_trees() {
  for (TreeNumber tree = 0; tree < trees_.size(); ++tree) {
    const Node& root = trees_[tree].root();
    for (const std::string& name : {root.name, root.id}) {
      if (name.empty()) continue;
      const auto [entry, is_new] = by_name_.emplace(name_key(name), tree);
      if (is_new || entry->second == tree) continue;
      reading_.findings.error(
          root.span, {"BT1011", fmt::format("two trees are called `{}`", name),
                      "declared again here",
                      fmt::format("the first is on line {}",
                                  trees_[entry->second].root().span.line)});
    }
  }
}

void TreeForms::resolve_references() {
  for (const TreeDraft& tree : trees_) {
    std::vector<Reference>& references = references_.emplace_back();
    for (const NodeDraft& draft : tree.nodes) {
      Reference& reference = references.emplace_back();
      if (draft.node.type != NodeType::SubTree) continue;
      const std::string& name = referred_name(draft.node);
      const auto found = by_name_.find(name_key(name));
      if (found == by_name_.end()) {
        report_unknown(draft.reference, name);
        continue;
      }
      reference = found->second;
      const Node& root = trees_[*reference].root();
      const bool is_exact = name == root.name || name == root.id;
      if (!is_exact) {
        reading_.findings.case_warning(draft.reference, name, root.name);
      }
    }
  }
}

// Depth-first over the forms; a reference to a form that is still open closes
// a circle.
void TreeForms::cut_cycles() {
  enum class Mark : unsigned char { New, Open, Done };
  struct Visit {
    TreeNumber tree;
    std::size_t next_node;
  };
  std::vector<Mark> marks(trees_.size(), Mark::New);
  for (TreeNumber start = 0; start < trees_.size(); ++start) {
    if (marks[start] != Mark::New) continue;
    std::vector<Visit> path = {{start, 0}};
    marks[start] = Mark::Open;
    while (!path.empty()) {
      Visit& visit = path.back();
      if (visit.next_node == trees_[visit.tree].nodes.size()) {
        marks[visit.tree] = Mark::Done;
        path.pop_back();
        continue;
      }
      const std::size_t node = visit.next_node++;
      Reference& reference = references_[visit.tree][node];
      if (!reference || marks[*reference] == Mark::Done) continue;
      if (marks[*reference] == Mark::New) {
        marks[*reference] = Mark::Open;
        path.push_back({*reference, 0});
        continue;
      }
      reading_.findings.error(
          trees_[visit.tree].nodes[node].reference,
          {"BT1018",
           fmt::format("the tree `{}` contains itself",
                       trees_[*reference].root().name),
           "a subtree of itself here",
           "repeat with `Repeat`, or with `:loop 1` on the BehaviorTree"});
      reference.reset();
    }
  }
}

TreeForms::Reference TreeForms::find(const Form& word) const {
  const auto found = by_name_.find(name_key(word.text));
  if (!word.is_word() || found == by_name_.end()) return std::nullopt;
  return found->second;
}

void TreeForms::report_unknown(SourceSpan span, std::string_view name) const {
  if (reading_.findings.is_full()) return;
  std::vector<std::string> names;
  for (const TreeDraft& tree : trees_) names.push_back(tree.root().name);
  const std::string guess = did_you_mean(name, names);
  reading_.findings.error(
      span,
      {"BT1018", fmt::format("there is no tree `{}`", name), "",
       guess.empty() ? fmt::format("write `(BehaviorTree :name {} ...)`", name)
                     : guess});
}

std::vector<TreeNumber> TreeForms::roots(
    const std::vector<FormId>& trees_forms) const {
  if (trees_forms.empty()) return unreferenced();
  for (std::size_t i = 1; i < trees_forms.size(); ++i) {
    reading_.findings.error(
        reading_.forms.head(trees_forms[i])->span,
        {"BT1019", "`Trees` is given twice", "",
         "name all trees that run in parallel in one `(Trees a b)`"});
  }
  return named_roots(trees_forms.front());
}

std::vector<TreeNumber> TreeForms::named_roots(FormId form) const {
  const std::vector<FormId>& items = reading_.form(form).items;
  std::vector<TreeNumber> roots;
  for (std::size_t i = 1; i < items.size(); ++i) {
    const Form& word = reading_.form(items[i]);
    const Reference tree = find(word);
    if (!tree) {
      report_unknown(word.span, word.is_word() ? word.text : "(...)");
    } else if (std::find(roots.begin(), roots.end(), *tree) != roots.end()) {
      reading_.findings.error(
          word.span, {"BT1011", fmt::format("`{}` is named twice", word.text),
                      "", "give each robot a BehaviorTree of its own"});
    } else {
      roots.push_back(*tree);
    }
  }
  if (items.size() == 1) {
    reading_.findings.error(
        reading_.forms.head(form)->span,
        {"BT1019", "`Trees` names no tree", "", "write `(Trees a b)`"});
  }
  return roots;
}

std::vector<TreeNumber> TreeForms::unreferenced() const {
  std::vector<bool> is_referenced(trees_.size());
  for (const auto& references : references_) {
    for (const Reference reference : references) {
      if (reference) is_referenced[*reference] = true;
    }
  }
  std::vector<TreeNumber> roots;
  std::vector<std::string> names;
  for (TreeNumber tree = 0; tree < trees_.size(); ++tree) {
    const bool has_its_name =
        by_name_.find(name_key(trees_[tree].root().name))->second == tree;
    if (is_referenced[tree] || !has_its_name) continue;
    roots.push_back(tree);
    names.push_back(trees_[tree].root().name);
  }
  if (roots.size() > 1) {
    reading_.findings.error(
        trees_[roots[1]].root().span,
        {"BT1019", fmt::format("there are {} trees to run", roots.size()),
         "no SubTree refers to it",
         fmt::format("to run them in parallel, write `(Trees {})`",
                     fmt::join(names.begin(),
                               names.begin() +
                                   static_cast<std::ptrdiff_t>(
                                       std::min<std::size_t>(names.size(), 4)),
                               " "))});
  }
  return roots;
}

std::vector<TreeNumber> TreeForms::unused(
    const std::vector<TreeNumber>& roots) const {
  std::vector<bool> is_used(trees_.size());
  std::vector<TreeNumber> open = roots;
  while (!open.empty()) {
    const TreeNumber tree = open.back();
    open.pop_back();
    if (is_used[tree]) continue;
    is_used[tree] = true;
    for (const Reference reference : references_[tree]) {
      if (reference) open.push_back(*reference);
    }
  }
  std::vector<TreeNumber> unused;
  for (TreeNumber tree = 0; tree < trees_.size(); ++tree) {
    if (!is_used[tree]) unused.push_back(tree);
  }
  return unused;
}

TreeForms::Expansion TreeForms::expand(
    const std::vector<TreeNumber>& roots) const {
  struct Work {
    TreeNumber tree;
    std::size_t node;
    std::optional<NodeId> parent;
  };
  Expansion result;
  std::size_t words = 0;
  std::vector<Work> work;
  for (const TreeNumber root : roots) work.push_back({root, 0, std::nullopt});
  std::reverse(work.begin(), work.end());
  while (!work.empty()) {
    const Work next = work.back();
    work.pop_back();
    const NodeDraft& draft = trees_[next.tree].nodes[next.node];
    words += draft.words;
    if (result.drafts.size() == kMostNodes || words > kMostWords) {
      report_too_large(draft.node.span, words);
      return result;
    }
    const NodeId id = add_node(result, draft, next.parent);
    if (const Reference tree = references_[next.tree][next.node]) {
      for (const std::uint32_t child : trees_[*tree].nodes[0].children) {
        work.push_back({*tree, child, id});
      }
    }
    for (auto child = draft.children.rbegin(); child != draft.children.rend();
         ++child) {
      work.push_back({next.tree, *child, id});
    }
  }
  return result;
}

void TreeForms::report_too_large(SourceSpan span, std::size_t words) const {
  const bool has_many_words = words > kMostWords;
  reading_.findings.error(
      span, {"BT1002",
             fmt::format("the tree has more than {} {}",
                         has_many_words ? kMostWords : kMostNodes,
                         has_many_words ? "words" : "nodes"),
             "with its subtrees expanded", "check its parts one by one"});
}

}  // namespace btcheck::btf
