# Writes tests for ctest into LIST: one for each suite of PROGRAM, which is made with GoogleTest.
execute_process(COMMAND "${PROGRAM}" --gtest_list_tests OUTPUT_FILE "${LIST}" TIMEOUT 60 COMMAND_ERROR_IS_FATAL ANY)
# A suite ends with a dot, and what its type is may follow. Tests are indented.
file(STRINGS "${LIST}" suites REGEX "^[^ ]+\\.( +#.*)?$")
set(tests "")
foreach(suite IN LISTS suites)
  string(REGEX REPLACE "\\.( +#.*)?$" "" suite "${suite}")
  # Where all tests of a suite are skipped, the output ends with their names.
  string(APPEND tests "add_test([==[${suite}]==] [==[${PROGRAM}]==] [==[--gtest_filter=${suite}.*]==])
set_tests_properties([==[${suite}]==] PROPERTIES TIMEOUT 900 WORKING_DIRECTORY [==[${WORKING_DIRECTORY}]==]
  SKIP_REGULAR_EXPRESSION [==[ 0 tests\\.\n\\[  SKIPPED \\] [^\n]*\n(\\[  SKIPPED \\] [^\n]*\n)+$]==])
")
endforeach()
file(WRITE "${LIST}" "${tests}")
