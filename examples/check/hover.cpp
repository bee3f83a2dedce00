// SPDX-License-Identifier: MIT
//
// What an editor shows of a line of a tree: the nodes that stand there, what
// they do, and their ports with the nodes that write what they read.
//   hover LINE TREE [FILE...]
#include <btcheck/check.hpp>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <iterator>
#include <string>

namespace {

namespace bt = btcheck::v1;

void show(const bt::Port& port) {
  std::cout << "  " << port.name;
  if (!port.type.empty()) std::cout << " (" << port.type << ')';
  if (port.value) {
    std::cout << " = " << *port.value;
  } else if (port.preset) {
    std::cout << " is " << *port.preset;
  }
  if (!port.about.empty()) std::cout << "  " << port.about;
  std::cout << '\n';
}

void show(const bt::Description& tree, const bt::DescribedNode& node) {
  std::cout << node.type << ' ' << node.label << ": " << node.about << '\n';
  for (const bt::Port& port : node.ports) show(port);
  for (const std::size_t read : node.reads) {
    const bt::Entry& entry = tree.entries[read];
    std::cout << "  reads " << entry.name << ", written by";
    for (const std::size_t writer : entry.writers) {
      std::cout << ' ' << tree.nodes[writer].label;
    }
    std::cout << (entry.writers.empty() ? " nobody here\n" : "\n");
  }
}

}  // namespace

int main(int count, char** words) {
  if (count < 3) {
    std::cerr << "usage: hover LINE TREE [FILE...]\n";
    return 2;
  }
  bt::Files files;
  for (int i = 2; i < count; ++i) {
    std::ifstream stream(words[i]);
    files.add(words[i],
              std::string(std::istreambuf_iterator<char>(stream), {}));
  }
  bt::Request request;
  request.tree = words[2];
  const bt::Description tree = bt::describe(request, files);
  const auto line = static_cast<std::size_t>(std::atoi(words[1]));
  for (const bt::DescribedNode& node : tree.nodes) {
    if (node.where.line == line && node.where.file == request.tree) {
      show(tree, node);
    }
  }
  return static_cast<int>(tree.outcome);
}
