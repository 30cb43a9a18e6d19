# Debian packages by CPack (./run package): one for each component of ReachInstall.cmake.
if(NOT CMAKE_INSTALL_PREFIX STREQUAL "/usr")
  message(STATUS "No packages: they want CMAKE_INSTALL_PREFIX=/usr, as the presets have it")
  return()
endif()
set(CPACK_GENERATOR DEB)
set(CPACK_COMPONENTS_ALL reachd reach-sim reach-tools libreach-dev)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_SET_DESTDIR ON) # /etc is not below the prefix
set(CPACK_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_PACKAGE_DIRECTORY ${CMAKE_BINARY_DIR}/packages)
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "") # each has its own
set(CPACK_DEBIAN_PACKAGE_MAINTAINER "The reachd authors <authors@reachd.invalid>")
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_PROJECT_CONFIG_FILE ${CMAKE_SOURCE_DIR}/cmake/package_version.cmake)
set(CPACK_REACH_SOURCE ${CMAKE_SOURCE_DIR}) # for that file

# reach_package(component SECTION s SUMMARY text DESCRIPTION text [DEPENDS x] [RECOMMENDS y]
#   [SUGGESTS z]): libraries that the programs are linked with are found by dpkg-shlibdeps.
macro(reach_package component)
  cmake_parse_arguments(P "" "SECTION;SUMMARY;DESCRIPTION;DEPENDS;RECOMMENDS;SUGGESTS" "" ${ARGN})
  string(TOUPPER ${component} upper)
  set(package_name ${component})
  set(CPACK_DEBIAN_${upper}_PACKAGE_NAME ${component})
  set(CPACK_DEBIAN_${upper}_PACKAGE_SECTION ${P_SECTION})
  set(CPACK_DEBIAN_${upper}_DESCRIPTION "${P_SUMMARY}\n${P_DESCRIPTION}")
  set(CPACK_DEBIAN_${upper}_PACKAGE_DEPENDS "${P_DEPENDS}")
  set(CPACK_DEBIAN_${upper}_PACKAGE_RECOMMENDS "${P_RECOMMENDS}")
  set(CPACK_DEBIAN_${upper}_PACKAGE_SUGGESTS "${P_SUGGESTS}")
  set(CPACK_DEBIAN_${upper}_PACKAGE_CONTROL_EXTRA "")
  set(folder ${CMAKE_BINARY_DIR}/debian/${component})
  set(files ${${component}_etc})
  if(files) # what people may have changed is kept when the package is upgraded
    list(TRANSFORM files REPLACE "^.*systemd/" "")
    list(TRANSFORM files PREPEND "/etc/reach/")
    list(JOIN files "\n" files)
    file(CONFIGURE OUTPUT ${folder}/conffiles CONTENT "${files}\n")
    list(APPEND CPACK_DEBIAN_${upper}_PACKAGE_CONTROL_EXTRA ${folder}/conffiles)
  endif()
  if(${component}_units)
    list(JOIN ${component}_units " " units)
    foreach(script postinst prerm postrm)
      configure_file(cmake/debian/${script}.in ${folder}/${script} @ONLY
        FILE_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE
                         WORLD_READ WORLD_EXECUTE)
      list(APPEND CPACK_DEBIAN_${upper}_PACKAGE_CONTROL_EXTRA ${folder}/${script})
    endforeach()
  endif()
endmacro()

list(APPEND reach-sim_etc ${robots})
set(state /var/lib/reach /var/lib/private/reach # what purging removes
    /var/lib/reach-learner /var/lib/private/reach-learner
    /var/lib/reach-recorder /var/lib/private/reach-recorder)
list(JOIN state " " state)

reach_package(reachd SECTION science
  SUMMARY "real-time daemon that learns to reach with any tool"
  DESCRIPTION "It learns, one sample at a time, where a robot's hand goes, notices by itself
when a tool is in the hand, keeps a solution for each tool, and reaches with
them. With it comes the process that finds a marker in the pictures of two
eyes. Robots and programs speak to it over LCM."
  DEPENDS "iproute2, procps"
  RECOMMENDS "reach-tools"
  SUGGESTS "reach-sim, liblcm-bin")
set(state "")
reach_package(reach-sim SECTION science
  SUMMARY "simulated robot with two eyes for reachd"
  DESCRIPTION "Bodies, motors, a flexible tube and two cameras, simulated from a URDF file,
in lockstep with reachd or in real time. It needs neither screen nor graphics
card."
  DEPENDS "libegl-mesa0, libgl1-mesa-dri"
  RECOMMENDS "reachd")
reach_package(reach-tools SECTION science
  SUMMARY "command line, measurements and log readers for reachd"
  DESCRIPTION "reachctl sends requests to reachd and shows what it does, reach-eval and
reach-bench measure the learner, reach-spy shows the bus in a window,
reach-export writes logs as CSV, and a Python package reads them as arrays."
  DEPENDS "iproute2, python3 (>= 3.11), python3-numpy"
  RECOMMENDS "liblcm-bin"
  SUGGESTS "default-jre, libjchart2d-java, liblcm-java, reachd")
reach_package(libreach-dev SECTION libdevel
  SUMMARY "IMLE learner of reachd, and its messages, for programs of one's own"
  DESCRIPTION "A static library that learns a relation with several values, one sample at a
time, without allocating, locking or blocking. For robot drivers it has the
message types of reachd, as a library and as sources."
  RECOMMENDS "liblcm-dev, pkg-config")
include(CPack)
