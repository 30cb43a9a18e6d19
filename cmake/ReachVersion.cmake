# The version with the git revision, for every program. Each build asks tools/dev/version.sh; what holds
# the version is made anew when it has changed, and nothing else is.
set(REACH_VERSION_FILE ${CMAKE_BINARY_DIR}/generated/version.txt)
file(MAKE_DIRECTORY ${CMAKE_BINARY_DIR}/generated)
add_custom_target(reach_version BYPRODUCTS ${REACH_VERSION_FILE}
  COMMAND ${CMAKE_SOURCE_DIR}/tools/dev/version.sh ${REACH_VERSION_FILE} VERBATIM)

# reach_put_version(template file): the template with the version in place of @REACH_VERSION@.
function(reach_put_version template file)
  add_custom_command(OUTPUT ${file}
    COMMAND ${CMAKE_COMMAND} -D TEMPLATE=${template} -D FILE=${file}
            -D VERSION_FILE=${REACH_VERSION_FILE} -P ${CMAKE_SOURCE_DIR}/cmake/put_version.cmake
    DEPENDS ${template} ${REACH_VERSION_FILE} reach_version VERBATIM)
endfunction()
