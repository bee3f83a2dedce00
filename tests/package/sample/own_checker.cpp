// SPDX-License-Identifier: MIT
//
// A program of one's own with the library: a rule that holds, one that does
// not, and the run that breaks it.
#include <cstdio>
#include <string>

#include "check/check.hpp"
#include "trace/formats/text.hpp"

int main() {
  const btcheck::InputFile tree{
      "door.btf",
      "(BehaviorTree :name door (Sequence (Action :ID open :SF)"
      " (Action :ID pass :SF)))"};
  const btcheck::InputFile rules{"door.ltl",
                                 "property p: never pass.success\n"
                                 "property q: never pass.running\n"};
  const btcheck::CheckResult result = btcheck::check(tree, {rules}, {});
  for (const btcheck::Diagnostic& found : result.diagnostics) {
    std::fputs(btcheck::render(found).c_str(), stderr);
  }
  if (result.files.size() != 1) return 2;
  const auto& verdicts = result.files[0].verdicts;
  const bool is_right = verdicts.size() == 2 &&
                        verdicts[0].verdict == btcheck::Verdict::Violated &&
                        verdicts[1].verdict == btcheck::Verdict::Holds &&
                        verdicts[0].run.has_value();
  std::puts(is_right ? "as expected" : "not as expected");
  return is_right ? 0 : 1;
}
