# Where cmake --install puts things: GNU's folders below CMAKE_INSTALL_PREFIX. The presets have /usr
# there, as the Debian packages want it; another prefix keeps configuration (etc) and units below it.
include(GNUInstallDirs)
set(REACH_INSTALLED_ETC ${CMAKE_INSTALL_FULL_SYSCONFDIR}/reach)
set(REACH_INSTALLED_PYTHON lib/python3/dist-packages) # below the prefix; Debian's Python looks there
set(REACH_INSTALLED_UNITS lib/systemd/system)
