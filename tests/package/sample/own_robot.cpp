// SPDX-License-Identifier: MIT
//
// A program of one's own that runs a tree: the door opens, and somebody passes.
#include <btcheck/run.hpp>

#include <cstdio>

int main() {
  using namespace btcheck::run;
  Options options;
  options.pace = Pace::AtOnce;
  options.answer_within = std::chrono::seconds(2);
  Engine engine("door.btf",
                "(BehaviorTree :name door (Sequence (Action :ID open :args (by "
                "0.5)) (Condition :ID is_open)))",
                options);
  double opened_by = 0;
  engine.action("open", [&](const Call& call, std::stop_token) {
    opened_by = call.number("by");
    return Answer::Success;
  });
  engine.condition("is_open", [&](const Call&) { return opened_by > 0; });
  const Report report = engine.run();
  std::puts(report.text.c_str());
  return report.end == End::Success && opened_by == 0.5 ? 0 : 1;
}
