// SPDX-License-Identifier: MIT
//
// The program behind docs/mutations.md: every wrong table against the
// specification of its node type.
//   table_of_mutants PROPERTIES [TYPE…]   the page, on stdout
// With a type named, each of its mutants is listed with its fate. The exit
// code is 1 when a mutant survives.
#include <array>
#include <atomic>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "mutation/mutants.hpp"

namespace fs = std::filesystem;

namespace {

using namespace btcheck::mutation;

struct Row {
  std::string name;
  std::size_t questions = 0;
  std::vector<std::pair<Mutant, Judgement>> judged;
  std::vector<std::string> wrong;  // properties, of the right tables
  std::string error;

  std::size_t count(Fate fate) const {
    std::size_t sum = 0;
    for (const auto& [mutant, judgement] : judged) {
      if (judgement.fate == fate) ++sum;
    }
    return sum;
  }
};

void fill(Row& row, const fs::path& folder) try {
  const Specification specification = read_specification(folder);
  row.questions = questions_of(specification).size();
  Judge judge(specification);
  row.wrong = judge.wrong_from_the_start();
  for (const Mutant& mutant : mutants_of(specification)) {
    row.judged.emplace_back(mutant, judge.judge(mutant));
  }
} catch (const std::exception& failure) {
  row.error = failure.what();
}

// Two types at a time.
std::vector<Row> rows_of(const fs::path& properties,
                         const std::set<std::string>& types) {
  std::vector<Row> rows;
  for (const std::string& type : types) rows.push_back({type, 0, {}, {}, {}});
  std::atomic<std::size_t> next = 0;
  const auto work = [&] {
    for (std::size_t i = next++; i < rows.size(); i = next++) {
      fill(rows[i], properties / rows[i].name);
    }
  };
  std::thread other(work);
  work();
  other.join();
  return rows;
}

void print_types(const std::vector<Row>& rows) {
  std::printf(
      "| type | properties | mutants | killed | never taken | same runs | "
      "survive |\n|---|--:|--:|--:|--:|--:|--:|\n");
  std::array<std::size_t, 6> sums{};
  for (const Row& row : rows) {
    const std::array<std::size_t, 6> numbers = {row.questions,
                                                row.judged.size(),
                                                row.count(Fate::Killed),
                                                row.count(Fate::NeverTaken),
                                                row.count(Fate::SameRuns),
                                                row.count(Fate::Survives)};
    std::printf("| `%s` |", row.name.c_str());
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      std::printf(" %zu |", numbers[i]);
      sums[i] += numbers[i];
    }
    std::printf("\n");
  }
  std::printf("| all |");
  for (const std::size_t sum : sums) std::printf(" %zu |", sum);
  std::printf("\n");
}

void print_operators(const std::vector<Row>& rows) {
  std::array<std::array<std::size_t, 4>, kOperatorCount> counts{};
  for (const Row& row : rows) {
    for (const auto& [mutant, judgement] : row.judged) {
      ++counts[static_cast<std::size_t>(mutant.which)]
              [static_cast<std::size_t>(judgement.fate)];
    }
  }
  std::printf(
      "\n| mistake | mutants | killed | never taken | same runs | survive "
      "|\n|---|--:|--:|--:|--:|--:|\n");
  for (std::size_t o = 0; o < kOperatorCount; ++o) {
    const auto& [killed, never, same, survive] = counts[o];
    std::printf("| %s | %zu | %zu | %zu | %zu | %zu |\n",
                std::string(operator_name(static_cast<Operator>(o))).c_str(),
                killed + never + same + survive, killed, never, same, survive);
  }
}

std::string fate_text(const Judgement& judgement) {
  switch (judgement.fate) {
    case Fate::Killed:
      return "killed by " + judgement.killer;
    case Fate::NeverTaken:
      return "never taken";
    case Fate::SameRuns:
      return "same runs";
    default:
      return "SURVIVES";
  }
}

// Prints what is wrong to stderr; true when nothing is.
bool all_well(const std::vector<Row>& rows) {
  bool well = true;
  for (const Row& row : rows) {
    if (!row.error.empty()) {
      std::fprintf(stderr, "%s: %s\n", row.name.c_str(), row.error.c_str());
      well = false;
    }
    for (const std::string& property : row.wrong) {
      std::fprintf(stderr, "%s: not as expected: %s\n", row.name.c_str(),
                   property.c_str());
      well = false;
    }
    for (const auto& [mutant, judgement] : row.judged) {
      if (judgement.fate != Fate::Survives) continue;
      std::fprintf(stderr, "%s: survives: %s\n", row.name.c_str(),
                   mutant.text.c_str());
      well = false;
    }
  }
  return well;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) return 2;
  std::set<std::string> types(argv + 2, argv + argc);
  const bool is_listed = !types.empty();
  for (const auto& entry : fs::directory_iterator(argv[1])) {
    if (!is_listed && entry.is_directory()) {
      types.insert(entry.path().filename().string());
    }
  }
  const std::vector<Row> rows = rows_of(argv[1], types);
  for (const Row& row : rows) {
    for (const auto& [mutant, judgement] : row.judged) {
      if (!is_listed) break;
      std::printf("%-13s %s: %s\n",
                  std::string(operator_name(mutant.which)).c_str(),
                  mutant.text.c_str(), fate_text(judgement).c_str());
    }
  }
  print_types(rows);
  print_operators(rows);
  return all_well(rows) ? 0 : 1;
}
