# Builds TARGET in BUILD_DIR. If SENTENCE is empty this must succeed, else it must fail, and the first
# error must contain SENTENCE.
execute_process(
  COMMAND ${CMAKE_COMMAND} --build ${BUILD_DIR} --target ${TARGET} --config "${CONFIG}"
  RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
if(SENTENCE STREQUAL "")
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "the model that is not wrong does not compile:\n${output}")
  endif()
  return()
endif()
if(result EQUAL 0)
  message(FATAL_ERROR "the wrong model compiles")
endif()
string(REGEX MATCH "error[ :][^\n]*" first_error "${output}")
string(FIND "${first_error}" "${SENTENCE}" position)
if(position EQUAL -1)
  message(FATAL_ERROR "the first error does not contain \"${SENTENCE}\":\n${output}")
endif()
