# Part of ReachPackages.cmake that cpack reads when it starts: a commit after the last run of CMake
# is no surprise.
execute_process(COMMAND ${CPACK_REACH_SOURCE}/tools/dev/version.sh --debian
  OUTPUT_VARIABLE CPACK_DEBIAN_PACKAGE_VERSION OUTPUT_STRIP_TRAILING_WHITESPACE
  COMMAND_ERROR_IS_FATAL ANY)
