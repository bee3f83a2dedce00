# SPDX-License-Identifier: MIT
#
# btcheck_add_test(TREE FILE [PROPERTIES FILE...]
#                  [NAME NAME] [RUNS DIRECTORY] [TIMEOUT SECONDS]
#                  [OPTIONS WORD...] [LINT] [ALLOW_UNDECIDED])
#
# A test for ctest: the tree, checked against the properties, or the default
# report where there are none. Files are relative to the current source folder.
#   NAME             of the test (default: btcheck.TREE without its extension)
#   RUNS             where runs that break a property are kept, as ITF JSON and
#                    as pages for a browser, relative to the binary folder
#   TIMEOUT          the search stops then, and the test fails
#   OPTIONS          more words of the command line
#   LINT             a second test, NAME.lint, that nothing is wrong as it stands
#   ALLOW_UNDECIDED  a search that reaches a limit is skipped, not failed
function(btcheck_add_test)
  cmake_parse_arguments(PARSE_ARGV 0 arg "LINT;ALLOW_UNDECIDED"
    "TREE;NAME;RUNS;TIMEOUT" "PROPERTIES;OPTIONS")
  if(arg_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR
      "btcheck_add_test: unknown words: ${arg_UNPARSED_ARGUMENTS}")
  endif()
  if(NOT arg_TREE)
    message(FATAL_ERROR "btcheck_add_test: TREE is missing")
  endif()
  foreach(file ${arg_TREE} ${arg_PROPERTIES})
    get_filename_component(path ${file} ABSOLUTE)
    if(NOT EXISTS ${path})
      message(FATAL_ERROR "btcheck_add_test: there is no file ${path}")
    endif()
  endforeach()

  get_filename_component(tree ${arg_TREE} ABSOLUTE)
  set(words ${tree})
  foreach(file ${arg_PROPERTIES})
    get_filename_component(path ${file} ABSOLUTE)
    list(APPEND words --prop ${path})
  endforeach()
  if(NOT arg_NAME)
    get_filename_component(stem ${arg_TREE} NAME_WLE)
    set(arg_NAME btcheck.${stem})
  endif()

  set(check ${words})
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
