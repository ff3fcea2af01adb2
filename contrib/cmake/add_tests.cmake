# snug_add_unit_test(module RANKS 1 2 3): one GoogleTest program of all
# tests/unit/<module>/*.cc (start-up costs half a second), run with each number
# of ranks. The ctest labels are unit and the module's name; the target
# build.unit builds the programs of a label.
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
    target_link_libraries(${target} snug_${used})
  endforeach()
  target_link_libraries(${target} GTest::gtest)
  deal_ii_setup_target(${target})
  # A quarter less to compile; what takes time when it runs is in the libraries.
  # gcc 14 takes no precompiled headers whose -mvzeroupper differs, which -O1 alone leaves out.
  if(NOT SNUG_INSTRUMENT)
    target_compile_options(${target} PRIVATE
                           $<$<CONFIG:Release>:-O1;-fexpensive-optimizations>)
  endif()
  snug_precompile_headers(${target})
  if(NOT TARGET build.${ARG_LABEL})
    add_custom_target(build.${ARG_LABEL})
  endif()
  add_dependencies(build.${ARG_LABEL} ${target})
  set(timeout 300)
  if(SNUG_INSTRUMENT)
    set(timeout 1800)
  endif()
  # The assertions of deal.II cost time, so that each module runs once, on 2 ranks if it is
  # collective. The tests of meshes are long, and run on 1 rank.
  if(CMAKE_BUILD_TYPE STREQUAL "Debug" AND 3 IN_LIST ARG_RANKS)
    set(ARG_RANKS 2)
    if(module MATCHES "^(geometry|mesh|contact|shape|cad)$")
      set(ARG_RANKS 1)
    endif()
  endif()
  foreach(ranks ${ARG_RANKS})
    set(test ${target}.np${ranks})
    add_test(NAME ${test}
      COMMAND ${MPIEXEC_EXECUTABLE} ${MPIEXEC_NUMPROC_FLAG} ${ranks}
              ${MPIEXEC_PREFLAGS} $<TARGET_FILE:${target}>)
    set_tests_properties(${test} PROPERTIES
      LABELS "${ARG_LABEL};${module}" PROCESSORS ${ranks} TIMEOUT ${timeout}
      ENVIRONMENT "${SNUG_TEST_ENVIRONMENT}")
  endforeach()
endfunction()

# snug_add_regression_test(name RANKS 1 2 3 [SCENE file.prm] [LABELS label...]
# [SET "Subsection/Entry=value"...]): run snug on regression/<name>.prm (or
# SCENE) with the entries of SET and compare its summary.json with
# regression/<name>.json. The ctest labels are regression and LABELS.
function(snug_add_regression_test name)
  cmake_parse_arguments(ARG "" "SCENE" "RANKS;LABELS;SET" ${ARGN})
  set(folder ${CMAKE_CURRENT_SOURCE_DIR}/regression)
  if(NOT ARG_SCENE)
    set(ARG_SCENE ${folder}/${name}.prm)
  endif()
  foreach(ranks ${ARG_RANKS})
    set(test regression.${name}.np${ranks})
    add_test(NAME ${test}
      COMMAND ${CMAKE_COMMAND} -DPROGRAM=$<TARGET_FILE:snug>
              "-DMPIEXEC=${MPIEXEC_EXECUTABLE};${MPIEXEC_NUMPROC_FLAG}"
              -DRANKS=${ranks} -DSCENE=${ARG_SCENE} "-DSETTINGS=${ARG_SET}"
              -DPYTHON=${Python3_EXECUTABLE} -DCOMPARE=${folder}/compare.py
              -DREFERENCE=${folder}/${name}.json
              -DWORK=${CMAKE_CURRENT_BINARY_DIR}/regression/${name}.np${ranks}
              -P ${PROJECT_SOURCE_DIR}/contrib/cmake/run_case.cmake)
    set_tests_properties(${test} PROPERTIES
      LABELS "regression;${ARG_LABELS}" PROCESSORS ${ranks} TIMEOUT 600
      ENVIRONMENT "${SNUG_TEST_ENVIRONMENT}")
  endforeach()
endfunction()

# snug_add_script_test(name LABELS label... [SAMPLE n] [NIGHT] SCRIPT file.py [arguments]): a test
# that is a Python program; it fails with its exit status, and is skipped with the status 77.
# Runs of snug on one rank may share a start of stability.many. With SAMPLE the test takes one of
# n cases (sample() in contrib/lib/runs.py), and the test night.<name> takes all. NIGHT leaves out
# the test of the sample. Tests of the night run with contrib/test --night only.
function(snug_add_script_test name)
  cmake_parse_arguments(ARG "NIGHT" "SAMPLE" "LABELS;SCRIPT" ${ARGN})
  list(POP_FRONT ARG_SCRIPT script)
  set(command COMMAND ${Python3_EXECUTABLE} -B ${CMAKE_CURRENT_SOURCE_DIR}/${script} ${ARG_SCRIPT})
  set(environment ${SNUG_TEST_ENVIRONMENT} SNUG=$<TARGET_FILE:snug>
      SNUG_MANY=$<TARGET_FILE:stability.many> SNUG_RANDOM=$<TARGET_FILE:random.problems>
      MPIEXEC=${MPIEXEC_EXECUTABLE})
  if(ARG_SAMPLE OR ARG_NIGHT)
    add_test(NAME night.${name} CONFIGURATIONS night ${command})
    set_tests_properties(night.${name} PROPERTIES LABELS "night;${ARG_LABELS}" TIMEOUT 3000
                         SKIP_RETURN_CODE 77
                         ENVIRONMENT "${environment}")
  endif()
  if(NOT ARG_NIGHT)
    if(ARG_SAMPLE)
      list(APPEND environment SNUG_SAMPLE=${ARG_SAMPLE})
    endif()
    add_test(NAME ${name} ${command})
    set_tests_properties(${name} PROPERTIES LABELS "${ARG_LABELS}" TIMEOUT 300
                         SKIP_RETURN_CODE 77
                         ENVIRONMENT "${environment}")
  endif()
endfunction()
