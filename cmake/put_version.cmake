# Part of ReachVersion.cmake that runs while the project is built.
file(STRINGS ${VERSION_FILE} REACH_VERSION)
configure_file(${TEMPLATE} ${FILE} @ONLY)
