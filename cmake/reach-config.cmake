# find_package(reach): reach::learner, and reach::lcmtypes where LCM is installed.
include(CMakeFindDependencyMacro)
find_dependency(PkgConfig)
pkg_check_modules(LCM IMPORTED_TARGET lcm)
include(${CMAKE_CURRENT_LIST_DIR}/reach-targets.cmake)
