// SPDX-License-Identifier: MIT
//
// SPIN, if it is installed, asked for its opinion.
//
// `spin -a` writes a verifier in C, gcc compiles it, and each claim is one call
// of it. Without partial order reduction: with one process there is nothing to
// reduce, and the counts are then beyond doubt.
#include "reference/spin.hpp"

#include <cassert>
#include <fstream>
#include <map>
#include <regex>

#include "shell.hpp"

namespace btcheck::reference {
namespace {

std::optional<std::uint64_t> number_before(const std::string& text,
                                           const std::string& words) {
  const std::regex pattern("([0-9]+) " + words);
  std::smatch found;
  if (!std::regex_search(text, found, pattern)) return std::nullopt;
  return std::stoull(found[1]);
}

// Nothing has been cut off, and something has been searched.
bool is_complete(const std::string& report) {
  return report.find("too small") == std::string::npos &&
         report.find("out of memory") == std::string::npos &&
         report.find("Search not completed") == std::string::npos &&
         report.find("errors: 0") != std::string::npos;
}

std::string sign_of(FormulaKind kind) {
  switch (kind) {
    case FormulaKind::Not:
      return "!";
    case FormulaKind::Always:
      return "[]";
    case FormulaKind::Eventually:
      return "<>";
    case FormulaKind::And:
      return "&&";
    case FormulaKind::Or:
      return "||";
    case FormulaKind::Implies:
      return "->";
    case FormulaKind::Equivalent:
      return "<->";
    case FormulaKind::Until:
      return "U";
    case FormulaKind::Release:
      return "V";
    default:
      assert(false && "an operator that SPIN has");
      return {};
  }
}

}  // namespace

bool spin_is_installed() {
  return !run("command -v spin").text.empty() &&
         !run("command -v gcc").text.empty();
}

std::string spin_text(const FormulaPool& pool, FormulaId id) {
  std::map<FormulaId, std::string> texts;
  for (const FormulaId part : pool.nodes(id)) {
    const FormulaNode& node = pool[part];
    std::string& text = texts[part];
    if (node.kind == FormulaKind::True || node.kind == FormulaKind::False) {
      text = node.kind == FormulaKind::True ? "true" : "false";
    } else if (node.kind == FormulaKind::Atom) {
      text = "p" + std::to_string(node.atom);
    } else if (is_unary(node.kind)) {
      text = "(" + sign_of(node.kind) + " " + texts.at(node.left) + ")";
    } else if (node.kind == FormulaKind::WeakUntil) {
      const std::string& right = texts.at(node.right);
      text = "(" + right + " V (" + texts.at(node.left) + " || " + right + "))";
    } else {
      text = "(" + texts.at(node.left) + " " + sign_of(node.kind) + " " +
             texts.at(node.right) + ")";
    }
  }
  return texts.at(id);
}

SpinVerifier::SpinVerifier(const std::string& model, SpinUse use) {
  std::ofstream(folder_.path() / "model.pml") << model;
  // It prints each ltl block and how to choose one; that is no complaint.
  complaints_ = called(
      "timeout 60 spin -a model.pml 2>&1 | "
      "grep -E 'warning|[Ee]rror|spin:'");
  if (use == SpinUse::CountAndDecide) {
    complaints_ += called("gcc -O0 -DNOREDUCE -o pan pan.c");
  }
  complaints_ += called("gcc -O0 -DNOREDUCE -DNOCLAIM -DSAFETY -o count pan.c");
}

std::string SpinVerifier::called(const std::string& command) const {
  return run_in(folder_.path(), "{ " + command + "; } 2>&1").text;
}

std::optional<SpinVerifier::Space> SpinVerifier::space() const {
  const std::string report = called("./count -n -w16 -m200000");
  const auto states = number_before(report, "states, stored");
  const auto transitions = number_before(report, "transitions");
  if (!is_complete(report) || !states || !transitions) return std::nullopt;
  return Space{*states, *transitions};
}

std::optional<bool> SpinVerifier::holds(const std::string& claim) const {
  const std::string report = called("./pan -a -n -w16 -m200000 -N " + claim);
  // An assertion of the claim fails where no continuation can help any more.
  for (const char* finding : {"acceptance cycle", "assertion violated"}) {
    if (report.find(finding) != std::string::npos) return false;
  }
  if (is_complete(report)) return true;
  return std::nullopt;
}

}  // namespace btcheck::reference
