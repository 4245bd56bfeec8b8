# What a tree over a mesh costs a user, in lines that reach the compiler; a count, since timings differ from one machine
# to the next. The standard library is most of it, so the budget holds for more than one of them. It has no room for
# <memory>, <ranges> or <atomic>, each of which would bring a fifth as much again, or more.
set(budget 56000)

set(source ${CMAKE_CURRENT_BINARY_DIR}/compile_budget.cpp)
file(WRITE ${source} "#include <glint/bvh/bvh.hpp>
#include <glint/geometry/mesh_buffers.hpp>
#include <glint/geometry/triangle_mesh.hpp>
")
execute_process(COMMAND ${COMPILER} -std=c++20 -I${INCLUDE_DIR} -E ${source} OUTPUT_VARIABLE text
                COMMAND_ERROR_IS_FATAL ANY)

foreach(library tbb OpenEXR Imath tiny_obj_loader stb_image nlohmann)
  if(text MATCHES "\n# [0-9]+ \"[^\"]*(${library}[^\"]*)\"")
    message(FATAL_ERROR "a tree over a mesh includes ${CMAKE_MATCH_1}: the core stands on GLM alone")
  endif()
endforeach()

string(REGEX REPLACE "\n#[^\n]*" "" text "${text}")
string(REGEX REPLACE "\n[ \n]+" "\n" text "${text}")
string(REGEX MATCHALL "\n" lines "${text}")
list(LENGTH lines count)
message(STATUS "a tree over a mesh: ${count} lines of a budget of ${budget}")
if(count GREATER budget)
  message(FATAL_ERROR "a tree over a mesh brings in ${count} lines, over the budget of ${budget}")
endif()
