# Bindings from lcmtypes/*.lcm:
#   reach_lcmtypes      static C library, headers <reach_robot_state_t.h> ...
#   reach_lcmtypes_cpp  header-only C++, <reach/robot_state_t.hpp>, <bot_core/images_t.hpp>
#   reach_lcmtypes_python  build/python/reach_lcm/{reach,bot_core}
#   reach_lcmtypes_java    build/java/reach_types.jar, where a JDK and lcm.jar are present
find_package(PkgConfig REQUIRED)
pkg_check_modules(LCM REQUIRED IMPORTED_TARGET lcm)
find_program(LCM_GEN lcm-gen REQUIRED)
