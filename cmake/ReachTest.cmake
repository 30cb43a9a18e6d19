# Tests spend their time in what they test; optimising their own C++ would only lengthen the build.
set(REACH_TEST_OPTIMISATION $<$<AND:$<COMPILE_LANGUAGE:CXX>,$<CONFIG:RelWithDebInfo>>:-O1>)

# reach_unit_test(name [NETNS | NO_ROUTE] [LOADS_DRIVERS] SOURCES a.c ... LIBS x y): a Check program
# under ctest, label "unit". NETNS runs it in a network namespace of its own where LCM works,
# NO_ROUTE in one without the multicast route. LOADS_DRIVERS: it draws or opens cameras.
pkg_check_modules(CHECK REQUIRED IMPORTED_TARGET check)
set(REACH_TEST_ENVIRONMENT
    "REACH_SOURCE_DIR=${CMAKE_SOURCE_DIR};REACH_BUILD_DIR=${CMAKE_BINARY_DIR}")
set(REACH_TEST_PATIENCE 1) # times every limit below
if(REACH_SANITIZE)
  # Instrumented programs take up to ten times as long.
  set(REACH_TEST_PATIENCE 6)
  list(APPEND REACH_TEST_ENVIRONMENT CK_TIMEOUT_MULTIPLIER=${REACH_TEST_PATIENCE}
    "TSAN_OPTIONS=suppressions=${CMAKE_SOURCE_DIR}/cmake/tsan-suppressions.txt")
  # Mesa's driver and a camera driver of OpenCV's leak and are unloaded by the end, so that no
  # suppression can name them. Leaks are looked for in all tests that load neither.
  set(REACH_LEAKS_ALLOWED "ASAN_OPTIONS=detect_leaks=0")
endif()

function(reach_unit_test name)
  cmake_parse_arguments(T "NETNS;NO_ROUTE;LOADS_DRIVERS" "" "SOURCES;LIBS" ${ARGN})
  add_executable(${name} ${T_SOURCES})
  set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/tests)
  target_link_libraries(${name} PRIVATE ${T_LIBS} reach_warnings PkgConfig::CHECK)
  target_compile_options(${name} PRIVATE ${REACH_TEST_OPTIMISATION})
  set(namespace "")
  if(T_NETNS)
    set(namespace ${CMAKE_SOURCE_DIR}/tools/netns.sh)
  elseif(T_NO_ROUTE)
    set(namespace ${CMAKE_SOURCE_DIR}/tools/netns.sh --no-route)
  endif()
  # CMake puts the emulator in front of a target's name alone, and here a namespace may come first.
  add_test(NAME ${name}
    COMMAND ${namespace} ${CMAKE_CROSSCOMPILING_EMULATOR} $<TARGET_FILE:${name}>)
  math(EXPR timeout "120 * ${REACH_TEST_PATIENCE}")
  set_tests_properties(${name} PROPERTIES LABELS unit TIMEOUT ${timeout}
    ENVIRONMENT "${REACH_TEST_ENVIRONMENT};$<$<BOOL:${T_LOADS_DRIVERS}>:${REACH_LEAKS_ALLOWED}>")
endfunction()

# reach_python_test(name script.py LABEL unit|system [NETNS] [TIMEOUT seconds] [ARGS ...]): a
# unittest script, run by the project's virtual environment where there is one.
function(reach_python_test name script)
  cmake_parse_arguments(T "NETNS" "LABEL;TIMEOUT" "ARGS" ${ARGN})
  if(NOT REACH_PYTHON)
    message(STATUS "No .venv: test ${name} is left out; ./run setup makes it")
    return()
  endif()
  set(namespace "")
  if(T_NETNS)
    set(namespace ${CMAKE_SOURCE_DIR}/tools/netns.sh)
  endif()
  if(NOT T_TIMEOUT)
    set(T_TIMEOUT 120)
  endif()
  math(EXPR T_TIMEOUT "${T_TIMEOUT} * ${REACH_TEST_PATIENCE}")
  add_test(NAME ${name}
    COMMAND ${namespace} ${REACH_PYTHON} ${CMAKE_CURRENT_SOURCE_DIR}/${script} ${T_ARGS})
  set_tests_properties(${name} PROPERTIES LABELS ${T_LABEL} TIMEOUT ${T_TIMEOUT} ENVIRONMENT
    "${REACH_TEST_ENVIRONMENT};${REACH_LEAKS_ALLOWED};PYTHONPATH=${CMAKE_SOURCE_DIR}/tools:${CMAKE_SOURCE_DIR}/tools/dev:${CMAKE_SOURCE_DIR}/tests:${CMAKE_BINARY_DIR}/python;PYTHONDONTWRITEBYTECODE=1")
endfunction()
