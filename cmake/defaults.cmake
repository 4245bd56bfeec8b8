# How our own programs, tests and benchmarks are built. Nothing here reaches a user's target.

if(PROJECT_IS_TOP_LEVEL)
  get_property(multi_config GLOBAL PROPERTY GENERATOR_IS_MULTI_CONFIG)
  if(NOT multi_config AND NOT CMAKE_BUILD_TYPE)
    set(CMAKE_BUILD_TYPE Release CACHE STRING "Release unless asked otherwise" FORCE)
  endif()
  set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/bin)
  set(CMAKE_CXX_EXTENSIONS OFF)
  find_program(ccache ccache)
  if(ccache AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
    set(CMAKE_CXX_COMPILER_LAUNCHER ${ccache})
  endif()
endif()

option(GLINT_NATIVE "Build our programs and benchmarks for this machine's instruction set" OFF)
set(GLINT_SANITIZE "" CACHE STRING "Sanitizers for our own targets: address,undefined or thread")

add_library(glint_build_options INTERFACE)
if(CMAKE_CXX_COMPILER_ID MATCHES "GNU|Clang")
  target_compile_options(glint_build_options INTERFACE -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Werror)
  if(GLINT_NATIVE)
    target_compile_options(glint_build_options INTERFACE -march=native)
  endif()
  if(GLINT_SANITIZE)
    target_compile_options(glint_build_options INTERFACE -fsanitize=${GLINT_SANITIZE} -fno-sanitize-recover=all
                                                         -fno-omit-frame-pointer)
    target_link_options(glint_build_options INTERFACE -fsanitize=${GLINT_SANITIZE})
    if(GLINT_SANITIZE MATCHES thread)
      # Threads that the sanitizer can see, in place of oneTBB's: see the header there.
      target_include_directories(glint_build_options BEFORE INTERFACE ${PROJECT_SOURCE_DIR}/tests/support/tsan)
    endif()
  endif()
endif()
