# The textbook mixture: the tests and the benches link it.
find_package(Eigen3 REQUIRED NO_MODULE)
add_library(reach_oracle STATIC
  ${CMAKE_CURRENT_LIST_DIR}/textbook_learning.cc
  ${CMAKE_CURRENT_LIST_DIR}/textbook_prediction.cc
  ${CMAKE_CURRENT_LIST_DIR}/recursive_learning.cc
  ${CMAKE_CURRENT_LIST_DIR}/recursive_prediction.cc)
target_include_directories(reach_oracle PUBLIC ${CMAKE_SOURCE_DIR})
target_link_libraries(reach_oracle PUBLIC Eigen3::Eigen PRIVATE reach_warnings)
