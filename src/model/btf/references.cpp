// SPDX-License-Identifier: MIT
//
// First every name of a tree is looked up; then a depth-first search over the
// forms, with an explicit stack, finds and cuts the references that close a
// circle; what is left can be expanded, by a second stack that walks through
// the forms as if they were one tree and gives out numbers in pre-order. A few
// short forms can expand to more nodes than fit into any memory, so the
// expansion counts and stops.
//
// Several nodes may share a name, and a subtree used twice doubles all of its
// names. A reference to a node therefore looks around itself first: in the
// nearest copy of a BehaviorTree form, then in the one that contains that copy,
// and last in the whole file. As nodes are numbered in pre-order, what lies
// below a node is an interval of numbers.
#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <iterator>

#include "model/btf/trees.hpp"
#include "model/tree/node_types.hpp"
#include "text/budget.hpp"

namespace btcheck::btf {
namespace {

// As many as an XML tree may have.
constexpr std::size_t kMostNodes = 65'535;
constexpr std::size_t kMostWords = 2'000'000;

NodeId node_id(std::size_t number) {
  return NodeId{static_cast<std::uint32_t>(number)};
}

// Appends the node of a draft under its parent, or as a root.
NodeId add_node(TreeForms::Expansion& expansion, const NodeDraft& draft,
                std::optional<NodeId> parent) {
  std::vector<Node>& nodes = expansion.tree.nodes;
  const NodeId id = node_id(nodes.size());
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

// `name_btnM`, where M is the number of a node called `name`.
std::optional<NodeId> find_unique_name(const BehaviorTree& tree,
                                       std::string_view word) {
  constexpr std::string_view kInfix = "_btn";
  const std::size_t at = word.rfind(kInfix);
  if (at == std::string_view::npos) return std::nullopt;
  const auto number = whole_number(word.substr(at + kInfix.size()));
  if (!number || *number < 0 ||
      *number >= static_cast<long long>(tree.nodes.size())) {
    return std::nullopt;
  }
  const NodeId id = node_id(static_cast<std::size_t>(*number));
  const bool fits = equal_ignoring_case(tree.node(id).name, word.substr(0, at));
  return fits ? std::optional(id) : std::nullopt;
}

void report_ambiguous(const Reading& reading, const Form& place,
                      std::string_view word, const BehaviorTree& tree,
                      const std::vector<NodeId>& candidates) {
  if (reading.findings.is_full()) return;
  constexpr std::size_t kMost = 6;
  std::string choices;
  for (std::size_t i = 0; i < std::min(candidates.size(), kMost); ++i) {
    choices += i == 0 ? "" : i + 1 == candidates.size() ? " or " : ", ";
    choices += fmt::format("`{}` (line {})", unique_name(tree, candidates[i]),
                           tree.node(candidates[i]).span.line);
  }
  if (candidates.size() > kMost) choices += " and more";
  reading.error(
      place.span, "BT1014",
      fmt::format("`{}` is the name of {} nodes", word, candidates.size()),
      "which one is meant?", fmt::format("write {}", choices));
}

void report_too_large(const Reading& reading, SourceSpan span,
                      std::size_t words) {
  const bool has_many_words = words > kMostWords;
  reading.error(span, "BT1002",
                fmt::format("the tree has more than {} {}",
                            has_many_words ? kMostWords : kMostNodes,
                            has_many_words ? "words" : "nodes"),
                "with its subtrees expanded", "check its parts one by one");
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
    const Node& root = root_of(tree);
    for (const std::string& name : {root.name, root.id}) {
      if (name.empty()) continue;
      const auto [entry, is_new] = by_name_.emplace(name_key(name), tree);
      if (is_new || entry->second == tree) continue;
      reading_.error(root.span, "BT1011",
                     fmt::format("two trees are called `{}`", name),
                     "declared again here",
                     fmt::format("the first is on line {}",
                                 root_of(entry->second).span.line));
    }
  }
}

void TreeForms::resolve_references() {
  for (TreeDraft& tree : trees_) {
    for (NodeDraft& draft : tree) {
      if (draft.node.type != NodeType::SubTree) continue;
      const std::string& name = referred_name(draft.node);
      draft.refers_to = named(draft.reference, name);
      if (!draft.refers_to) continue;
      const Node& root = root_of(*draft.refers_to);
      if (name == root.id) continue;
      reading_.findings.case_warning(draft.reference, name, root.name);
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
      auto& [tree, next_node] = path.back();
      if (next_node == trees_[tree].size()) {
        marks[tree] = Mark::Done;
        path.pop_back();
        continue;
      }
      NodeDraft& draft = trees_[tree][next_node++];
      if (!draft.refers_to || marks[*draft.refers_to] == Mark::Done) continue;
      if (marks[*draft.refers_to] == Mark::New) {
        marks[*draft.refers_to] = Mark::Open;
        path.push_back({*draft.refers_to, 0});
        continue;
      }
      reading_.error(
          draft.reference, "BT1018",
          fmt::format("the tree `{}` contains itself",
                      root_of(*draft.refers_to).name),
          "a subtree of itself here",
          "repeat with `Repeat`, or with `:loop 1` on the BehaviorTree");
      draft.refers_to.reset();
    }
  }
}

std::optional<TreeNumber> TreeForms::named(SourceSpan span,
                                           std::string_view name) const {
  const auto found = by_name_.find(name_key(name));
  if (found != by_name_.end()) return found->second;
  if (reading_.findings.is_full()) return std::nullopt;
  std::vector<std::string> names;
  for (const TreeDraft& tree : trees_) names.push_back(tree[0].node.name);
  reading_.error(
      span, "BT1018", fmt::format("there is no tree `{}`", name), "",
      did_you_mean(name, names,
                   fmt::format("write `(BehaviorTree :name {} ...)`", name)));
  return std::nullopt;
}

std::vector<TreeNumber> TreeForms::roots(
    const std::vector<FormId>& trees_forms) const {
  if (trees_forms.empty()) return unreferenced();
  for (std::size_t i = 1; i < trees_forms.size(); ++i) {
    reading_.error(reading_.forms.head(trees_forms[i])->span, "BT1019",
                   "`Trees` is given twice", "",
                   "name all trees that run in parallel in one `(Trees a b)`");
  }
  return named_roots(trees_forms.front());
}

std::vector<TreeNumber> TreeForms::named_roots(FormId form) const {
  const std::vector<FormId>& items = reading_.form(form).items;
  std::vector<TreeNumber> roots;
  for (std::size_t i = 1; i < items.size(); ++i) {
    const Form& word = reading_.form(items[i]);
    const auto tree = named(word.span, word.is_word() ? word.text : "(...)");
    if (!tree) continue;
    if (std::ranges::find(roots, *tree) != roots.end()) {
      reading_.error(word.span, "BT1011",
                     fmt::format("`{}` is named twice", word.text), "",
                     "give each robot a BehaviorTree of its own");
    } else {
      roots.push_back(*tree);
    }
  }
  if (items.size() == 1) {
    reading_.error(reading_.forms.head(form)->span, "BT1019",
                   "`Trees` names no tree", "", "write `(Trees a b)`");
  }
  return roots;
}

std::vector<TreeNumber> TreeForms::unreferenced() const {
  std::vector<bool> is_referenced(trees_.size());
  for (const TreeDraft& tree : trees_) {
    for (const NodeDraft& draft : tree) {
      if (draft.refers_to) is_referenced[*draft.refers_to] = true;
    }
  }
  std::vector<TreeNumber> roots;
  std::vector<std::string> names;
  for (TreeNumber tree = 0; tree < trees_.size(); ++tree) {
    const std::string& name = root_of(tree).name;
    const bool has_its_name = by_name_.find(name_key(name))->second == tree;
    if (is_referenced[tree] || !has_its_name) continue;
    roots.push_back(tree);
    names.push_back(name);
  }
  if (roots.size() > 1) {
    names.resize(std::min<std::size_t>(names.size(), 4));
    reading_.error(root_of(roots[1]).span, "BT1019",
                   fmt::format("there are {} trees to run", roots.size()),
                   "no SubTree refers to it",
                   fmt::format("to run them in parallel, write `(Trees {})`",
                               fmt::join(names, " ")));
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
    for (const NodeDraft& draft : trees_[tree]) {
      if (draft.refers_to) open.push_back(*draft.refers_to);
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
  std::ranges::reverse(work);
  while (!work.empty()) {
    const Work next = work.back();
    work.pop_back();
    const NodeDraft& draft = trees_[next.tree][next.node];
    ask_budget();
    words += draft.words;
    if (result.drafts.size() == kMostNodes || words > kMostWords) {
      report_too_large(reading_, draft.node.span, words);
      return result;
    }
    const NodeId id = add_node(result, draft, next.parent);
    if (const auto tree = draft.refers_to) {
      for (const std::uint32_t child : trees_[*tree][0].children) {
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

NodeNames::NodeNames(const BehaviorTree& tree) : tree_(tree) {
  const std::size_t count = tree.nodes.size();
  scope_.resize(count);
  end_.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    const NodeId parent = tree.nodes[i].parent;
    const bool opens_scope = tree.node(parent).is_root() ||
                             tree.node(parent).type == NodeType::SubTree;
    scope_[i] = opens_scope ? parent : scope_[index(parent)];
    by_name_[name_key(tree.nodes[i].name)].push_back(node_id(i));
  }
  for (std::size_t i = count; i-- > 0;) {
    const std::vector<NodeId>& children = tree.nodes[i].children;
    end_[i] = children.empty() ? node_id(i + 1) : end_[index(children.back())];
  }
}

std::optional<NodeId> NodeNames::find(const Reading& reading, const Form& place,
                                      std::string_view word,
                                      NodeId from) const {
  if (const auto unique = find_unique_name(tree_, word)) return unique;
  const auto found = by_name_.find(name_key(word));
  if (found == by_name_.end()) {
    report_unknown(reading, place, word);
    return std::nullopt;
  }
  const std::vector<NodeId> meant = candidates(found->second, word, from);
  assert(!meant.empty());
  if (meant.size() > 1) {
    report_ambiguous(reading, place, word, tree_, meant);
    return std::nullopt;
  }
  reading.findings.case_warning(place.span, word,
                                tree_.node(meant.front()).name);
  return meant.front();
}

// The nodes that a name may mean: in the innermost scope that has any, the
// ones in that very scope before those in subtrees of it, and those spelled
// exactly so before the others.
std::vector<NodeId> NodeNames::candidates(const std::vector<NodeId>& all,
                                          std::string_view word,
                                          NodeId from) const {
  NodeId scope = scope_[index(from)];
  std::vector<NodeId> meant;
  while (meant.empty()) {
    const auto first = std::lower_bound(all.begin(), all.end(), scope);
    meant.assign(first, std::lower_bound(first, all.end(), end_[index(scope)]));
    if (!meant.empty()) break;
    if (tree_.node(scope).is_root()) meant = all;
    scope = scope_[index(scope)];
  }
  const auto prefer = [&](const auto& is_better) {
    std::vector<NodeId> better;
    std::ranges::copy_if(meant, std::back_inserter(better), is_better);
    if (!better.empty()) meant = std::move(better);
  };
  prefer([&](NodeId id) { return scope_[index(id)] == scope; });
  prefer([&](NodeId id) { return tree_.node(id).name == word; });
  return meant;
}

void NodeNames::report_unknown(const Reading& reading, const Form& place,
                               std::string_view word) const {
  if (reading.findings.is_full()) return;
  std::vector<std::string> names;
  for (const auto& [key, nodes] : by_name_) {
    names.push_back(tree_.node(nodes.front()).name);
  }
  reading.error(place.span, "BT1014", fmt::format("unknown node `{}`", word),
                "no node has this name", nearest_or_all(word, names));
}

}  // namespace btcheck::btf
