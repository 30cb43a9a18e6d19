# reach_unit_test(name SOURCES a.c ... LIBS x y): a Check program under ctest, label "unit".
pkg_check_modules(CHECK REQUIRED IMPORTED_TARGET check)
function(reach_unit_test name)
  cmake_parse_arguments(T "" "" "SOURCES;LIBS" ${ARGN})
  add_executable(${name} ${T_SOURCES})
  set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/tests)
  target_link_libraries(${name} PRIVATE ${T_LIBS} reach_warnings PkgConfig::CHECK)
  add_test(NAME ${name} COMMAND ${name})
  set_tests_properties(${name} PROPERTIES LABELS unit TIMEOUT 120
    ENVIRONMENT "REACH_SOURCE_DIR=${CMAKE_SOURCE_DIR};REACH_BUILD_DIR=${CMAKE_BINARY_DIR}")
endfunction()
