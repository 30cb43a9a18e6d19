# Languages, warnings and output folders that every target shares.
set(CMAKE_C_STANDARD 11)
set(CMAKE_C_STANDARD_REQUIRED ON)
set(CMAKE_CXX_STANDARD 17)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/bin)
if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE RelWithDebInfo CACHE STRING "" FORCE)
endif()
# Lines and functions, enough for backtraces and profiles; whole debug information doubles the time
# that Eigen's templates take. Whoever needs variables in a debugger builds with
# -DCMAKE_BUILD_TYPE=Debug.
add_compile_options($<$<AND:$<COMPILE_LANGUAGE:CXX>,$<CONFIG:RelWithDebInfo>>:-g1>)
# No fused multiply-add chosen by the compiler: the same source gives the same bits everywhere.
add_compile_options(-ffp-contract=off -fstack-protector-strong)
# Eigen asks for fused ones itself where the processor has them, which every arm64 does.
if(CMAKE_SYSTEM_PROCESSOR MATCHES "^(aarch64|arm64)$")
  add_compile_options($<$<COMPILE_LANGUAGE:CXX>:-U__ARM_FEATURE_FMA>)
endif()
# For C alone. With it GCC 14 forgets stores in C++: an Eigen expression handed on by address is read
# before it is written (test_simrobot_eyes, the capsules' visibility). GCC 12 does not.
add_compile_options($<$<COMPILE_LANGUAGE:C>:-fno-math-errno>)
add_compile_definitions(_GNU_SOURCE)

if(REACH_SANITIZE)
  add_compile_options(-fsanitize=${REACH_SANITIZE} -fno-omit-frame-pointer)
  add_link_options(-fsanitize=${REACH_SANITIZE})
endif()

if(REACH_FUZZ) # every source tells the fuzzer where it has been
  add_compile_options(-fsanitize=fuzzer-no-link)
  add_link_options(-fsanitize=fuzzer-no-link)
endif()

# Warnings for our own sources; generated code and libraries are not ours to mend. A compiler of
# tomorrow warns of more than today's: only continuous integration stops there.
add_library(reach_warnings INTERFACE)
target_compile_options(reach_warnings INTERFACE
  -Wall -Wextra $<$<BOOL:${REACH_WERROR}>:-Werror> -Wshadow -Wundef -Wpointer-arith -Wcast-qual -Wformat=2
  $<$<COMPILE_LANGUAGE:C>:-Wstrict-prototypes -Wmissing-prototypes -Wconversion -Wvla>
  $<$<COMPILE_LANGUAGE:CXX>:-Wnon-virtual-dtor -Woverloaded-virtual>)

# Python with the packages of requirements.txt: ./run setup makes it.
find_program(REACH_PYTHON python NAMES python3 PATHS ${CMAKE_SOURCE_DIR}/.venv/bin NO_DEFAULT_PATH)

# reach_room(target SOURCES a.c ... [LIBS x ...] [PRIVATE y ...]): the sources of one folder. They are
# objects that the folder above gathers into its library; LIBS reach whoever includes their headers.
function(reach_room target)
  cmake_parse_arguments(R "" "" "SOURCES;LIBS;PRIVATE" ${ARGN})
  add_library(${target} OBJECT ${R_SOURCES})
  target_include_directories(${target} PUBLIC $<BUILD_INTERFACE:${CMAKE_SOURCE_DIR}>)
  target_link_libraries(${target} PUBLIC ${R_LIBS} PRIVATE ${R_PRIVATE} reach_warnings)
endfunction()
