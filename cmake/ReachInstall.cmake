# cmake --install: where everything goes. Programs that people call by hand are in bin/, those that
# only services start in libexec/reach/, configuration in etc/reach/, units where systemd looks for
# those of packages.
include(GNUInstallDirs)

foreach(program reachd reach-learner reachctl reach-eval reach-bench)
  if(TARGET ${program})
    install(TARGETS ${program} RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
  endif()
endforeach()
if(REACH_TOOLS)
  install(PROGRAMS ${CMAKE_RUNTIME_OUTPUT_DIRECTORY}/reach-lcm-setup
          ${CMAKE_RUNTIME_OUTPUT_DIRECTORY}/reach-spy DESTINATION ${CMAKE_INSTALL_BINDIR})
  if(TARGET reach_lcmtypes_java)
    install(FILES ${CMAKE_BINARY_DIR}/java/reach_types.jar
            DESTINATION ${CMAKE_INSTALL_DATADIR}/reach)
  endif()
endif()
foreach(program simrobot vision)
  if(TARGET ${program})
    install(TARGETS ${program} RUNTIME DESTINATION ${CMAKE_INSTALL_LIBEXECDIR}/reach)
  endif()
endforeach()

file(GLOB configurations CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/etc/*.yaml)
install(FILES ${configurations} etc/systemd/robot.env
        DESTINATION ${CMAKE_INSTALL_FULL_SYSCONFDIR}/reach)
install(DIRECTORY etc/robots DESTINATION ${CMAKE_INSTALL_FULL_SYSCONFDIR}/reach)
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(DIRECTORY docs/ DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(FILES etc/systemd/lan.conf DESTINATION ${CMAKE_INSTALL_DOCDIR}/systemd)

# Units name installed paths, and share what they are hardened with.
file(READ etc/systemd/hardening.conf hardening)
string(STRIP "${hardening}" hardening)
foreach(unit reach.target reach-bus.service reachd.service reach-vision.service
        reach-simrobot.service reach-lcm-setup.service)
  configure_file(etc/systemd/${unit} ${CMAKE_BINARY_DIR}/systemd/${unit} @ONLY)
  install(FILES ${CMAKE_BINARY_DIR}/systemd/${unit} DESTINATION lib/systemd/system)
endforeach()
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS etc/systemd/hardening.conf)
