# snug_add_unit_test(module RANKS 1 2 3): one GoogleTest program of all
# tests/unit/<module>/*.cc (start-up costs half a second), run with each number
# of ranks. The ctest labels are unit and the module's name.
function(snug_add_unit_test module)
  cmake_parse_arguments(ARG "" "LABEL;FOLDER" "RANKS;USES" ${ARGN})
  if(NOT ARG_LABEL)
    set(ARG_LABEL unit)
  endif()
  file(GLOB sources CONFIGURE_DEPENDS
       ${CMAKE_CURRENT_SOURCE_DIR}/${ARG_LABEL}/${module}/*.cc)
  set(target ${ARG_LABEL}.${module})
  add_executable(${target} ${sources} ${CMAKE_CURRENT_SOURCE_DIR}/main.cc)
  target_include_directories(${target} PRIVATE ${CMAKE_CURRENT_SOURCE_DIR})
  target_compile_options(${target} PRIVATE -Wall -Wextra -pedantic)
  foreach(used ${module} ${ARG_USES})
    if(TARGET snug_${used})
      target_link_libraries(${target} snug_${used})
    endif()
  endforeach()
  target_link_libraries(${target} GTest::gtest)
  deal_ii_setup_target(${target})
  foreach(ranks ${ARG_RANKS})
    set(test ${target}.np${ranks})
    add_test(NAME ${test}
      COMMAND ${MPIEXEC_EXECUTABLE} ${MPIEXEC_NUMPROC_FLAG} ${ranks}
              ${MPIEXEC_PREFLAGS} $<TARGET_FILE:${target}>)
    set_tests_properties(${test} PROPERTIES
      LABELS "${ARG_LABEL};${module}" PROCESSORS ${ranks} TIMEOUT 300
      ENVIRONMENT "${SNUG_TEST_ENVIRONMENT}")
  endforeach()
endfunction()
