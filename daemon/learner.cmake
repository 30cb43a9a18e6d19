# The learner, a library of its own: the daemon, the benches and the tests link it.
add_library(reach_learner STATIC
  ${CMAKE_CURRENT_LIST_DIR}/arena.c
  ${CMAKE_CURRENT_LIST_DIR}/elementary.c
  ${CMAKE_CURRENT_LIST_DIR}/learner.c
  ${CMAKE_CURRENT_LIST_DIR}/learner_config.c
  ${CMAKE_CURRENT_LIST_DIR}/learner_null.c
  ${CMAKE_CURRENT_LIST_DIR}/feature_map.c
  ${CMAKE_CURRENT_LIST_DIR}/feature_polynomial.c
  ${CMAKE_CURRENT_LIST_DIR}/kernels.c
  ${CMAKE_CURRENT_LIST_DIR}/kernels_plain.c
  ${CMAKE_CURRENT_LIST_DIR}/imle.c
  ${CMAKE_CURRENT_LIST_DIR}/imle_gating.c
  ${CMAKE_CURRENT_LIST_DIR}/imle_answer.c
  ${CMAKE_CURRENT_LIST_DIR}/imle_whitener.c
  ${CMAKE_CURRENT_LIST_DIR}/imle_layout.c
  ${CMAKE_CURRENT_LIST_DIR}/imle_expert.c
  ${CMAKE_CURRENT_LIST_DIR}/imle_density.c
  ${CMAKE_CURRENT_LIST_DIR}/imle_priors.c
  ${CMAKE_CURRENT_LIST_DIR}/imle_learn.c
  ${CMAKE_CURRENT_LIST_DIR}/imle_predict.c
  ${CMAKE_CURRENT_LIST_DIR}/imle_split.c
  ${CMAKE_CURRENT_LIST_DIR}/imle_leader.c
  ${CMAKE_CURRENT_LIST_DIR}/imle_fuse.c
  ${CMAKE_CURRENT_LIST_DIR}/imle_inverse.c
  ${CMAKE_CURRENT_LIST_DIR}/imle_store.c
  ${CMAKE_CURRENT_LIST_DIR}/imle_chi2.c
  ${CMAKE_CURRENT_LIST_DIR}/imle_triangle.c
  ${CMAKE_CURRENT_LIST_DIR}/lwpr.c
  ${CMAKE_CURRENT_LIST_DIR}/lwpr_layout.c
  ${CMAKE_CURRENT_LIST_DIR}/lwpr_field.c
  ${CMAKE_CURRENT_LIST_DIR}/lwpr_pls.c
  ${CMAKE_CURRENT_LIST_DIR}/lwpr_metric.c
  ${CMAKE_CURRENT_LIST_DIR}/lwpr_learn.c
  ${CMAKE_CURRENT_LIST_DIR}/lwpr_predict.c
  ${CMAKE_CURRENT_LIST_DIR}/lwpr_store.c)
target_include_directories(reach_learner PUBLIC $<BUILD_INTERFACE:${CMAKE_SOURCE_DIR}>
  $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
target_link_libraries(reach_learner PRIVATE $<BUILD_INTERFACE:reach_warnings> PUBLIC m)

# The inner loops, once for each vector width. -fno-trapping-math lets the compiler turn a choice
# between two numbers into a vector instruction; it changes no result.
set(REACH_KERNEL_OPTIONS -O3 -fno-trapping-math)
set_source_files_properties(${CMAKE_CURRENT_LIST_DIR}/kernels_plain.c PROPERTIES
  COMPILE_OPTIONS "${REACH_KERNEL_OPTIONS}")
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  target_sources(reach_learner PRIVATE
    ${CMAKE_CURRENT_LIST_DIR}/kernels_avx2.c ${CMAKE_CURRENT_LIST_DIR}/kernels_avx512.c)
  set_source_files_properties(${CMAKE_CURRENT_LIST_DIR}/kernels_avx2.c PROPERTIES
    COMPILE_OPTIONS "${REACH_KERNEL_OPTIONS};-mavx2")
  set_source_files_properties(${CMAKE_CURRENT_LIST_DIR}/kernels_avx512.c PROPERTIES
    COMPILE_OPTIONS "${REACH_KERNEL_OPTIONS};-mavx512f")
  target_compile_definitions(reach_learner PRIVATE REACH_KERNELS_X86)
endif()

# Its parameters from YAML, for programs that know no robot.
add_library(reach_learner_options STATIC ${CMAKE_CURRENT_LIST_DIR}/learner_options.c)
target_link_libraries(reach_learner_options PUBLIC reach_learner reach_common PRIVATE reach_warnings)
