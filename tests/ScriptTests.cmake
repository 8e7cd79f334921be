# swarmanoid_script_tests(PREFIX SCRIPTS file... TIMEOUT s LABELS label... ENVIRONMENT NAME=value... [PROCESSORS n]
#   [FIXTURES_REQUIRED name...] [QUICK regex]) makes each case of each script a test, PREFIX.SCRIPT.CASE. ctest runs the cases of a script in
# parallel, and names those that fail. A case that ends with exit code 77 was skipped. Tests that match QUICK also have the label quick.
function(swarmanoid_script_tests prefix)
  cmake_parse_arguments(ARG "" "TIMEOUT;PROCESSORS;QUICK" "SCRIPTS;LABELS;FIXTURES_REQUIRED;ENVIRONMENT" ${ARGN})
  math(EXPR timeout "${ARG_TIMEOUT} * ${TEST_TIME_FACTOR}")
  list(APPEND ARG_ENVIRONMENT PYTHONDONTWRITEBYTECODE=1)
  if(NOT ARG_PROCESSORS)
    set(ARG_PROCESSORS 1)
  endif()
  # ctest includes the generated file whenever it lists the tests.
  set(tests ${CMAKE_CURRENT_BINARY_DIR}/${prefix}_script_tests.cmake)
  file(GENERATE OUTPUT ${tests} CONTENT "\
set(prefix [==[${prefix}]==])
set(scripts [==[${ARG_SCRIPTS}]==])
set(python [==[${Python3_EXECUTABLE}]==])
set(node [==[${NODE_PROGRAM}]==])
set(cases [==[${CMAKE_CURRENT_BINARY_DIR}/${prefix}_script_cases.txt]==])
set(list_cases [==[${CMAKE_SOURCE_DIR}/tests/list_script_cases.py]==])
set(timeout ${timeout})
set(processors ${ARG_PROCESSORS})
set(labels [==[${ARG_LABELS}]==])
set(quick [==[${ARG_QUICK}]==])
set(fixtures [==[${ARG_FIXTURES_REQUIRED}]==])
set(environment [==[${ARG_ENVIRONMENT}]==])
include([==[${CMAKE_SOURCE_DIR}/tests/AddScriptTests.cmake]==])
")
  set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES ${tests})
endfunction()
