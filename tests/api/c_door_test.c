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

// The one package and the one tree that nobody has added.
static int near(void *context, const char *name, btcheck_text *to) {
  const char *const *known = context;
  if (strcmp(name, known[0]) != 0) return 0;
  btcheck_text_set(to, known[1], strlen(known[1]));
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

  // Its run, by the name of its rule, and the page that shows it.
  EXPECT(has(btcheck_report_runs(report), "\"btcheck-runs/1\""));
  EXPECT(has(btcheck_report_runs(report), "\"name\":\"prove1\""));
  EXPECT(has(btcheck_report_runs(report), "Pull -> failure"));
  EXPECT(has(btcheck_report_html(report, "prove1"), "</html>"));
  EXPECT(btcheck_report_html(report, "prove1") ==
         btcheck_report_html(report, "prove1"));
  EXPECT(btcheck_report_html(report, "prove2")[0] == '\0');
  EXPECT(btcheck_report_html(report, "")[0] == '\0');
  EXPECT(btcheck_report_html(report, NULL)[0] == '\0');
  EXPECT(btcheck_report_html(NULL, "prove1")[0] == '\0');
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
  EXPECT(has(btcheck_report_html(report, ""), "</html>"));
  EXPECT(btcheck_report_runs(report)[0] == '\0');
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

  // Packages and trees are asked for; a request that was cancelled stays so.
  {
    const char *package[] = {"far", "share/far"};
    const char *holder[] = {"Inner", "inner.xml"};
    const char asks[] =
        "<root BTCPP_format=\"4\" main_tree_to_execute=\"N\">"
        "<include ros_pkg=\"far\" path=\"b.xml\"/><BehaviorTree ID=\"N\">"
        "<Sequence><SubTree ID=\"Inner\"/><SubTree ID=\"B\"/></Sequence>"
        "</BehaviorTree></root>";
    const char packed[] =
        "<root BTCPP_format=\"4\"><BehaviorTree ID=\"B\"><Lift/></BehaviorTree>"
        "</root>";
    btcheck_request *other = btcheck_request_new();
    EXPECT(btcheck_add_file(other, "n.xml", asks, strlen(asks)) == 0);
    EXPECT(btcheck_add_file(other, "share/far/b.xml", packed, strlen(packed)) ==
           0);
    EXPECT(btcheck_set(other, "tree", "n.xml") == 0);
    EXPECT(btcheck_set(other, "one_program", "false") == 0);
    EXPECT(btcheck_set(other, "directory", "/robot") == 0);
    report = btcheck_check(other);
    EXPECT(btcheck_report_outcome(report) == BTCHECK_BAD_INPUT);
    btcheck_report_free(report);
    btcheck_set_packages(other, near, package);
    btcheck_set_source(other, source, &asked);
    btcheck_set_trees(other, near, holder);
    report = btcheck_check(other);
    EXPECT(btcheck_report_outcome(report) == BTCHECK_MET);
    EXPECT(has(btcheck_report_json(report), "Lift"));
    EXPECT(has(btcheck_report_json(report), "Pull"));
    btcheck_report_free(report);
    btcheck_cancel(other);
    report = btcheck_check(other);
    EXPECT(btcheck_report_outcome(report) == BTCHECK_UNDECIDED);
    btcheck_report_free(report);
    btcheck_request_free(other);
    btcheck_cancel(NULL);
  }

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
