# What cmake --install puts where, each thing in a component that becomes a Debian package.
find_program(REACH_BUILD_PYTHON python3 REQUIRED) # makes manual pages and the Python package
set(bin ${CMAKE_RUNTIME_OUTPUT_DIRECTORY})
set(dev COMPONENT libreach-dev)
file(MAKE_DIRECTORY ${CMAKE_BINARY_DIR}/man)

# reach_manual_page(name section component [DEPENDS target...] [HELP command...])
function(reach_manual_page name section component)
  cmake_parse_arguments(P "" "" "DEPENDS;HELP" ${ARGN})
  set(source ${CMAKE_SOURCE_DIR}/docs/man/${name}.${section})
  set(page ${CMAKE_BINARY_DIR}/man/${name}.${section}.gz)
  set(tools ${CMAKE_SOURCE_DIR}/tools/dev)
  add_custom_command(OUTPUT ${page}
    COMMAND ${REACH_BUILD_PYTHON} -B ${tools}/manual.py ${source} ${page} ${bin} ${P_HELP}
    DEPENDS ${source} ${tools}/manual.py ${tools}/reference.py ${P_DEPENDS} VERBATIM)
  add_custom_target(manual_of_${name} ALL DEPENDS ${page})
  install(FILES ${page} DESTINATION ${CMAKE_INSTALL_MANDIR}/man${section} COMPONENT ${component})
endfunction()

# A program, its manual page docs/man/NAME.SECTION and its completion; section 8 goes to sbin.
#   reach_program(name section component [SCRIPT file] [DEPENDS target...] [HELP command...])
# Without SCRIPT it is the target of that name. HELP: what prints its --help while it is not yet
# installed, otherwise the program.
function(reach_program name section component)
  cmake_parse_arguments(P "" "SCRIPT" "DEPENDS;HELP" ${ARGN})
  set(place ${CMAKE_INSTALL_BINDIR})
  if(section EQUAL 8)
    set(place ${CMAKE_INSTALL_SBINDIR})
  endif()
  if(P_SCRIPT)
    install(PROGRAMS ${P_SCRIPT} DESTINATION ${place} RENAME ${name} COMPONENT ${component})
  else()
    install(TARGETS ${name} RUNTIME DESTINATION ${place} COMPONENT ${component})
    set(P_DEPENDS ${name})
  endif()
  if(NOT P_HELP)
    set(P_HELP ${bin}/${name})
  endif()
  reach_manual_page(${name} ${section} ${component} DEPENDS ${P_DEPENDS} HELP ${P_HELP})
  install(FILES tools/install/completion/reach.bash RENAME ${name} COMPONENT ${component}
          DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
endfunction()

# One line a program.
reach_program(reachd          8 reachd)
reach_program(reach-vision    8 reachd)
reach_program(reach-finder    8 reachd)
reach_program(reach-learner   8 reachd)
reach_program(reach-simrobot  1 reach-sim)
reach_program(reachctl        1 reach-tools)
reach_program(reach-eval      1 reach-tools)
reach_program(reach-log       1 reach-tools)
reach_program(reach-bench     1 reach-tools)
reach_program(reach-spy       1 reach-tools SCRIPT ${bin}/reach-spy       DEPENDS reach_scripts)
reach_program(reach-lcm-setup 8 reach-tools SCRIPT ${bin}/reach-lcm-setup DEPENDS reach_scripts)
reach_manual_page(reach.yaml  5 reachd DEPENDS reachd reach-vision reach-learner
  reach-simrobot)

# The Python package, as pip would install it, and what calls it.
set(package ${CMAKE_BINARY_DIR}/package)
file(GLOB package_sources CONFIGURE_DEPENDS tools/reach/*.py lcmtypes/*.lcm lcmtypes/bot_core/*.lcm)
add_custom_command(OUTPUT ${package}.stamp
  COMMAND ${REACH_BUILD_PYTHON} -B ${CMAKE_SOURCE_DIR}/tools/install/package/wheel_of_reach.py ${package}
  COMMAND ${CMAKE_COMMAND} -E touch ${package}.stamp
  DEPENDS ${package_sources} tools/install/package/wheel_of_reach.py ${REACH_VERSION_FILE} reach_version
  VERBATIM)
add_custom_target(reach_python_package ALL DEPENDS ${package}.stamp)
install(DIRECTORY ${package}/ DESTINATION ${REACH_INSTALLED_PYTHON} COMPONENT reach-tools
        PATTERN __pycache__ EXCLUDE)
if(REACH_PYTHON) # with numpy, which its --help wants
  reach_program(reach-export  1 reach-tools SCRIPT tools/install/package/reach-export
    DEPENDS ${package}.stamp reach_python_package
    HELP ${CMAKE_COMMAND} -E env PYTHONPATH=${package} ${REACH_PYTHON} -B -m reach.export)
endif()
if(TARGET reach_lcmtypes_java)
  install(FILES ${CMAKE_BINARY_DIR}/java/reach_types.jar
          DESTINATION ${CMAKE_INSTALL_DATADIR}/reach COMPONENT reach-tools)
endif()

# Configuration. Whose files are whose:
file(GLOB configurations RELATIVE ${CMAKE_SOURCE_DIR}/etc CONFIGURE_DEPENDS etc/*.yaml)
set(reach-sim_etc ${configurations})
list(FILTER reach-sim_etc INCLUDE REGEX "^simrobot-")
set(reach-tools_etc ${configurations})
list(FILTER reach-tools_etc INCLUDE REGEX "^learner-(icub|kobian-offline)")
set(reachd_etc ${configurations})
list(REMOVE_ITEM reachd_etc ${reach-sim_etc} ${reach-tools_etc})
list(APPEND reachd_etc systemd/robot.env)
file(GLOB robots RELATIVE ${CMAKE_SOURCE_DIR}/etc CONFIGURE_DEPENDS etc/robots/*)
foreach(component reachd reach-sim reach-tools)
  list(TRANSFORM ${component}_etc PREPEND ${CMAKE_SOURCE_DIR}/etc/ OUTPUT_VARIABLE files)
  install(FILES ${files} DESTINATION ${REACH_INSTALLED_ETC} COMPONENT ${component})
endforeach()
install(DIRECTORY etc/robots DESTINATION ${REACH_INSTALLED_ETC} COMPONENT reach-sim)

# Documentation.
install(DIRECTORY docs/ DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT reachd
        PATTERN man EXCLUDE)
install(FILES etc/systemd/lan.conf DESTINATION ${CMAKE_INSTALL_DOCDIR}/systemd COMPONENT reachd)
install(DIRECTORY examples/learner
        DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/libreach-dev/examples ${dev})
install(DIRECTORY examples DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/reach-tools
        COMPONENT reach-tools PATTERN CMakeLists.txt EXCLUDE PATTERN learner EXCLUDE)
set(changelog ${CMAKE_BINARY_DIR}/generated/changelog)
reach_put_version(${CMAKE_SOURCE_DIR}/cmake/debian/changelog.in ${changelog})
add_custom_command(OUTPUT ${changelog}.gz COMMAND gzip -9nkf ${changelog} DEPENDS ${changelog})
add_custom_target(reach_changelog ALL DEPENDS ${changelog}.gz)
foreach(component reachd reach-sim reach-tools libreach-dev)
  install(FILES cmake/debian/copyright ${changelog}.gz
          DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${component} COMPONENT ${component})
endforeach()

# Units name installed paths, and share what they are hardened with.
file(READ etc/systemd/hardening.conf hardening)
string(STRIP "${hardening}" hardening)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS etc/systemd/hardening.conf)
set(reachd_units
    reach.target reach-failed.target reach-bus.service reachd.service reach-finder.service reach-vision.service
    reach-learner.service reach-recorder.service)
set(reach-sim_units reach-simrobot.service)
set(reach-tools_units reach-lcm-setup.service)
foreach(component reachd reach-sim reach-tools)
  foreach(unit ${${component}_units})
    configure_file(etc/systemd/${unit} ${CMAKE_BINARY_DIR}/systemd/${unit} @ONLY)
    install(FILES ${CMAKE_BINARY_DIR}/systemd/${unit} DESTINATION ${REACH_INSTALLED_UNITS}
            COMPONENT ${component})
  endforeach()
endforeach()

# What other programs link: the learner, and the message types. Static: they are of one version with
# the headers, and a real-time program has them in its own locked memory.
include(CMakePackageConfigHelpers)
set(cmake_place ${CMAKE_INSTALL_LIBDIR}/cmake/reach)
set_target_properties(learner PROPERTIES EXPORT_NAME learner)
set_target_properties(reach_lcmtypes PROPERTIES EXPORT_NAME lcmtypes)
install(TARGETS learner reach_lcmtypes EXPORT reach
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} ${dev})
install(FILES learner/learner.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/reach ${dev})
install(FILES common/base/arena.h # where learner.h includes it from
        DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/reach/common/base ${dev})
install(DIRECTORY ${CMAKE_BINARY_DIR}/lcmtypes/c/
        DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/reach/lcmtypes ${dev} FILES_MATCHING PATTERN "*.h")
install(DIRECTORY lcmtypes DESTINATION ${CMAKE_INSTALL_DATADIR}/reach ${dev}
        FILES_MATCHING PATTERN "*.lcm")
install(EXPORT reach NAMESPACE reach:: FILE reach-targets.cmake DESTINATION ${cmake_place} ${dev})
write_basic_package_version_file(${CMAKE_BINARY_DIR}/generated/reach-config-version.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES cmake/reach-config.cmake ${CMAKE_BINARY_DIR}/generated/reach-config-version.cmake
        DESTINATION ${cmake_place} ${dev})
file(RELATIVE_PATH prefix_from_pkgconfig
     ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig ${CMAKE_INSTALL_PREFIX})
foreach(name reach-learner reach-lcmtypes)
  configure_file(cmake/${name}.pc.in ${CMAKE_BINARY_DIR}/generated/${name}.pc @ONLY)
  install(FILES ${CMAKE_BINARY_DIR}/generated/${name}.pc
          DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig ${dev})
endforeach()
