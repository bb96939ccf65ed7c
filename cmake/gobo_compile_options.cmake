# How gobo's own code is compiled: C++20, warnings as errors when gobo is the top-level project, ccache if present.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE RelWithDebInfo)
endif()

find_program(GOBO_CCACHE ccache)
if(GOBO_CCACHE AND PROJECT_IS_TOP_LEVEL)
  set(CMAKE_C_COMPILER_LAUNCHER "${GOBO_CCACHE}")
  set(CMAKE_CXX_COMPILER_LAUNCHER "${GOBO_CCACHE}")
endif()

add_library(gobo_options INTERFACE)
# Shaders are judged by what IEEE arithmetic gives: the compiler must not fuse or reorder it behind our back.
target_compile_options(gobo_options INTERFACE -Wall -Wextra -Wpedantic -Wshadow -ffp-contract=off)
if(PROJECT_IS_TOP_LEVEL)
  target_compile_options(gobo_options INTERFACE -Werror)
endif()
if(GOBO_SANITIZE)
  # Not vptr: it wants type information of glslang's classes, which distributions build without.
  target_compile_options(gobo_options INTERFACE -fsanitize=address,undefined -fno-sanitize=vptr -fno-sanitize-recover=undefined)
  # g++ 12 takes std::regex's own members for uninitialised once they are instrumented.
  target_compile_options(gobo_options INTERFACE -Wno-maybe-uninitialized)
  target_link_options(gobo_options INTERFACE -fsanitize=address,undefined)
endif()

# gobo_keep_roundings(TARGET): for code that rounds doubles to floats and goes on with doubles. Where g++ 12.2 makes one vector
# instruction of two such neighbours, as of a dvec2, from -O2 on, it leaves the rounding out.
function(gobo_keep_roundings target)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    target_compile_options(${target} PRIVATE -fno-tree-slp-vectorize)
  endif()
endfunction()

# gobo_library(NAME SOURCES a.cpp ... LINK lib ...): one folder of tools/ as a static library.
function(gobo_library name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "SOURCES;LINK")
  add_library(${name} STATIC ${arg_SOURCES})
  target_include_directories(${name} PUBLIC "${PROJECT_SOURCE_DIR}/tools" "${PROJECT_SOURCE_DIR}/include")
  target_link_libraries(${name} PUBLIC gobo_options ${arg_LINK})
endfunction()
