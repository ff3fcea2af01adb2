# One regression test (snug_add_regression_test): run PROGRAM on SCENE with
# RANKS ranks into WORK, then COMPARE its summary with REFERENCE.
set(options)
foreach(setting ${SETTINGS})
  list(APPEND options --set "${setting}")
endforeach()

file(REMOVE_RECURSE ${WORK})
get_filename_component(parent ${WORK} DIRECTORY)
file(MAKE_DIRECTORY ${parent})
execute_process(
  COMMAND ${MPIEXEC} ${RANKS} ${PROGRAM} ${SCENE} --output ${WORK} ${options}
  WORKING_DIRECTORY ${parent} RESULT_VARIABLE status)
if(NOT status EQUAL 0)
  message(FATAL_ERROR "${SCENE} on ${RANKS} ranks ends with ${status}")
endif()

execute_process(
  COMMAND ${PYTHON} -B ${COMPARE} ${WORK}/summary.json ${REFERENCE}
          --ranks ${RANKS}
  RESULT_VARIABLE status)
if(NOT status EQUAL 0)
  message(FATAL_ERROR "${WORK}/summary.json differs from ${REFERENCE}")
endif()
