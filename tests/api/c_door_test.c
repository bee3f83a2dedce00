// SPDX-License-Identifier: MIT
//
// The door from C99: each call, what is wrong, callbacks, and two calls with
// one request. Prints the JSON of a check; fails with a line.
#include <btcheck/check.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char tree[] =
    "<root BTCPP_format=\"4\" main_tree_to_execute=\"M\">"
    "<include path=\"inner.xml\"/>"
    "<BehaviorTree ID=\"M\"><Sequence><Push/><SubTree ID=\"Inner\"/></Sequence>"
    "</BehaviorTree></root>";
static const char inner[] =
    "<root BTCPP_format=\"4\"><BehaviorTree ID=\"Inner\"><Pull/>"
    "</BehaviorTree></root>";

static void expect(int is_so, int line) {
  if (is_so) return;
  fprintf(stderr, "c_door_test.c:%d\n", line);
  exit(1);
}
#define EXPECT(what) expect((what) != 0, __LINE__)

static int source(void *context, const char *name, btcheck_text *to) {
  int *asked = context;
  ++*asked;
  if (strcmp(name, "inner.xml") != 0) return 0;
  btcheck_text_set(to, inner, strlen(inner));
  return 1;
}

static int never(void *context, uint64_t states, uint64_t transitions,
                 double seconds) {
  int *asked = context;
  (void)states;
  (void)transitions;
  ++*asked;
  return seconds < 0;
}

static int has(const char *text, const char *part) {
  return strstr(text, part) != NULL;
}

int main(void) {
  int asked = 0;
  int looked = 0;
  btcheck_request *request = btcheck_request_new();
  btcheck_report *report;
  EXPECT(request != NULL);
  EXPECT(has(btcheck_version(), "."));

  // What is wrong with a request changes nothing, and is told.
  EXPECT(btcheck_set(request, "tre", "a.xml") == -1);
  EXPECT(has(btcheck_request_error(request), "`tre`"));
  EXPECT(btcheck_set(request, "seconds", "-1") == -1);
  EXPECT(btcheck_set(request, "seconds", "nan") == -1);
  EXPECT(btcheck_set(request, "threads", "0") == -1);
  EXPECT(btcheck_set(request, "loops", "yes") == -1);
  EXPECT(btcheck_set(request, "seed", "x") == -1);
  EXPECT(btcheck_set(request, "tree", NULL) == -1);
  EXPECT(btcheck_set(NULL, "tree", "a.xml") == -1);
  EXPECT(btcheck_set(request, "tree", "a.xml") == 0);
  EXPECT(btcheck_request_error(request)[0] == '\0');
  EXPECT(btcheck_add_file(request, "a.xml", NULL, 3) == -1);
  EXPECT(btcheck_add_file(request, "a.xml", tree, strlen(tree)) == 0);
  EXPECT(btcheck_add_package(request, "robot", "share/robot") == 0);

  // Without the file that is included nothing is checked.
  report = btcheck_check(request);
  EXPECT(btcheck_report_outcome(report) == BTCHECK_BAD_INPUT);
  EXPECT(btcheck_report_error(report)[0] == '\0');
  btcheck_report_free(report);
  btcheck_set_source(request, source, &asked);
  EXPECT(btcheck_set(request, "typed_rules", "never Pull.failure") == 0);
  report = btcheck_check(request);
  EXPECT(asked > 0);
  EXPECT(btcheck_report_outcome(report) == BTCHECK_MISSED);
  EXPECT(has(btcheck_report_json(report), "\"btcheck/1\""));
  EXPECT(has(btcheck_report_sarif(report), "\"2.1.0\""));
  EXPECT(btcheck_report_itf(report)[0] == '\0');
  puts(btcheck_report_json(report));
  btcheck_report_free(report);

  report = btcheck_lint(request);
  EXPECT(has(btcheck_report_json(report), "\"btcheck/1\""));
  btcheck_report_free(report);
  report = btcheck_describe(request);
  EXPECT(btcheck_report_outcome(report) == BTCHECK_MET);
  EXPECT(has(btcheck_report_json(report), "\"type\":\"Pull\""));
  EXPECT(btcheck_report_sarif(report)[0] == '\0');
  btcheck_report_free(report);

  EXPECT(btcheck_set(request, "seed", "7") == 0);
  EXPECT(btcheck_set(request, "run_ticks", "3") == 0);
  report = btcheck_simulate(request);
  EXPECT(has(btcheck_report_json(report), "\"tick 1: "));
  EXPECT(has(btcheck_report_itf(report), "\"states\""));
  btcheck_report_free(report);

  // A monitor ends a call.
  btcheck_set_monitor(request, never, &looked);
  report = btcheck_check(request);
  EXPECT(looked > 0);
  EXPECT(btcheck_report_outcome(report) == BTCHECK_UNDECIDED);
  btcheck_report_free(report);
  btcheck_set_monitor(request, NULL, NULL);

  // What cannot be meant is an error of the report.
  EXPECT(btcheck_set(request, "profile", "btcpp-99") == 0);
  report = btcheck_check(request);
  EXPECT(btcheck_report_outcome(report) == BTCHECK_BAD_INPUT);
  EXPECT(has(btcheck_report_error(report), "btcpp-99"));
  EXPECT(has(btcheck_report_json(report), "btcheck-error/1"));
  btcheck_report_free(report);

  report = btcheck_explain("BT2208");
  EXPECT(has(btcheck_report_json(report), "\"help\""));
  btcheck_report_free(report);
  EXPECT(btcheck_explain("BT0000") == NULL);
  EXPECT(btcheck_check(NULL) == NULL);
  EXPECT(btcheck_report_outcome(NULL) == BTCHECK_BAD_INPUT);
  EXPECT(btcheck_report_json(NULL)[0] == '\0');
  btcheck_report_free(NULL);
  btcheck_request_free(request);
  btcheck_request_free(NULL);
  return 0;
}
