# Compiles CASE with and without REJECTED. Its line `// Says: …` holds a regular expression for the error.

file(STRINGS ${CASE} says REGEX "^// Says: ")
string(REGEX REPLACE "^// Says: " "" says "${says}")
if(says STREQUAL "")
  message(FATAL_ERROR "${CASE} has no line '// Says: …'")
endif()

list(TRANSFORM INCLUDE_DIRS PREPEND -idirafter)  # -I/usr/include would hide the standard library from itself
set(compile ${COMPILER} -std=c++20 -fsyntax-only ${INCLUDE_DIRS} ${CASE})
execute_process(COMMAND ${compile} RESULT_VARIABLE plain ERROR_VARIABLE plain_words)
if(NOT plain EQUAL 0)
  message(FATAL_ERROR "without the lines to reject it must compile:\n${plain_words}")
endif()
execute_process(COMMAND ${compile} -DREJECTED RESULT_VARIABLE rejected ERROR_VARIABLE words)
if(rejected EQUAL 0)
  message(FATAL_ERROR "compiles, but must be rejected")
endif()
if(NOT words MATCHES "${says}")
  message(FATAL_ERROR "is rejected without saying '${says}', but with:\n${words}")
endif()
