# What glint stands on. The core needs GLM alone; a component whose libraries are missing is left out, and says so.

list(APPEND CMAKE_MODULE_PATH ${CMAKE_CURRENT_LIST_DIR})

find_package(glm REQUIRED)
find_package(TBB QUIET)
# Some distributions pack Imath's Python bindings apart, and its configuration notices on every run, QUIET or not.
set(message_level ${CMAKE_MESSAGE_LOG_LEVEL})
set(CMAKE_MESSAGE_LOG_LEVEL WARNING)
find_package(OpenEXR QUIET)
set(CMAKE_MESSAGE_LOG_LEVEL ${message_level})
find_package(tinyobjloader QUIET)
find_package(Stb QUIET)
find_package(nlohmann_json QUIET)

set(GLINT_MISSING "")
foreach(package TBB OpenEXR tinyobjloader Stb nlohmann_json)
  if(NOT ${package}_FOUND)
    list(APPEND GLINT_MISSING ${package})
  endif()
endforeach()

set(GLINT_WITH_PARALLEL ${TBB_FOUND})
set(GLINT_WITH_IO OFF)
if(OpenEXR_FOUND AND tinyobjloader_FOUND AND Stb_FOUND AND nlohmann_json_FOUND)
  set(GLINT_WITH_IO ON)
endif()
if(GLINT_MISSING)
  message(STATUS "glint: not found: ${GLINT_MISSING}; the components that need them are left out")
endif()
