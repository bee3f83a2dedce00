# SPDX-License-Identifier: MIT
#
# btcheck_add_test(TREE FILE [PROPERTIES FILE...]
#                  [MODELS FILE...] [LEAVES FILE...] [PROFILE PROFILE]
#                  [MAIN_TREE ID]
#                  [NAME NAME] [RUNS DIRECTORY] [TIMEOUT SECONDS]
#                  [OPTIONS WORD...] [LINT] [ALLOW_UNDECIDED])
#
# A test for ctest: the tree, checked against the properties, or the default
# report where there are none. Files are relative to the current source folder.
#   MODELS           files with TreeNodesModel
#   LEAVES           files of leaf contracts
#   PROFILE          the engine and version whose nodes the tree has
#   MAIN_TREE        the tree that runs, where the file does not name one
#   NAME             of the test (default: btcheck.TREE without its extension)
#   RUNS             where runs that break a property are kept, as ITF JSON and
#                    as pages for a browser, relative to the binary folder
#   TIMEOUT          the search stops then, and the test fails
#   OPTIONS          more words of the command line
#   LINT             a second test, NAME.lint, that nothing is wrong as it stands
#   ALLOW_UNDECIDED  a search that reaches a limit is skipped, not failed
#
# The results are also written as JUnit XML, where ament_cmake's tests write
# theirs and `colcon test-result` looks: test_results/PROJECT/NAME.xunit.xml in
# the binary folder.
function(btcheck_add_test)
  cmake_parse_arguments(PARSE_ARGV 0 arg "LINT;ALLOW_UNDECIDED"
    "TREE;NAME;RUNS;TIMEOUT;PROFILE;MAIN_TREE"
    "PROPERTIES;MODELS;LEAVES;OPTIONS")
  if(arg_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR
      "btcheck_add_test: unknown words: ${arg_UNPARSED_ARGUMENTS}")
  endif()
  if(arg_KEYWORDS_MISSING_VALUES)
    message(FATAL_ERROR "btcheck_add_test: nothing follows "
      "${arg_KEYWORDS_MISSING_VALUES}")
  endif()
  if(NOT arg_TREE)
    message(FATAL_ERROR "btcheck_add_test: TREE is missing")
  endif()
  foreach(file ${arg_TREE} ${arg_PROPERTIES} ${arg_MODELS} ${arg_LEAVES})
    get_filename_component(path ${file} ABSOLUTE)
    if(NOT EXISTS ${path})
      message(FATAL_ERROR "btcheck_add_test: there is no file ${path}")
    endif()
  endforeach()

  get_filename_component(tree ${arg_TREE} ABSOLUTE)
  set(words ${tree})
  foreach(option PROPERTIES:--prop MODELS:--models LEAVES:--leaves)
    string(REPLACE ":" ";" option ${option})
    list(POP_FRONT option word)
    foreach(file ${arg_${word}})
      get_filename_component(path ${file} ABSOLUTE)
      list(APPEND words ${option} ${path})
    endforeach()
  endforeach()
  if(arg_PROFILE)
    list(APPEND words --profile ${arg_PROFILE})
  endif()
  if(arg_MAIN_TREE)
    list(APPEND words --main-tree ${arg_MAIN_TREE})
  endif()
  if(NOT arg_NAME)
    get_filename_component(stem ${arg_TREE} NAME_WLE)
    set(arg_NAME btcheck.${stem})
  endif()

  set(results ${AMENT_TEST_RESULTS_DIR})
  if(NOT results)
    set(results ${CMAKE_BINARY_DIR}/test_results)
  endif()
  file(MAKE_DIRECTORY ${results}/${PROJECT_NAME})
  set(check ${words}
    --format junit=${results}/${PROJECT_NAME}/${arg_NAME}.xunit.xml)
  if(arg_RUNS)
    get_filename_component(runs ${arg_RUNS} ABSOLUTE
      BASE_DIR ${CMAKE_CURRENT_BINARY_DIR})
    list(APPEND check --trace-dir ${runs})
  endif()
  if(arg_TIMEOUT)
    list(APPEND check --timeout ${arg_TIMEOUT})
  endif()
  add_test(NAME ${arg_NAME}
    COMMAND btcheck::program check -q ${check} ${arg_OPTIONS})
  set_tests_properties(${arg_NAME} PROPERTIES LABELS btcheck)
  if(arg_ALLOW_UNDECIDED)
    set_tests_properties(${arg_NAME} PROPERTIES SKIP_RETURN_CODE 3)
  endif()
  if(arg_LINT)
    add_test(NAME ${arg_NAME}.lint COMMAND btcheck::program lint -q ${words})
    set_tests_properties(${arg_NAME}.lint PROPERTIES LABELS btcheck)
  endif()
endfunction()
