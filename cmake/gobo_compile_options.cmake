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
  # Nor function, which clang has: drivers' functions are of C, with handles that go by names of their own.
  target_compile_options(gobo_options INTERFACE $<$<CXX_COMPILER_ID:Clang>:-fno-sanitize=function>)
  # g++ 12 takes std::regex's own members for uninitialised once they are instrumented.
  target_compile_options(gobo_options INTERFACE $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
  target_link_options(gobo_options INTERFACE -fsanitize=address,undefined)
endif()

if(CMAKE_CXX_COMPILER_ID STREQUAL "Clang" AND CMAKE_CXX_COMPILER_VERSION VERSION_GREATER_EQUAL 17)
  # It warns of what std::stable_sort calls in the headers of g++ 12.
  target_compile_options(gobo_options INTERFACE -Wno-deprecated-declarations)
endif()

if(GOBO_SANITIZE_THREADS)
  target_compile_options(gobo_options INTERFACE -fsanitize=thread)
  target_link_options(gobo_options INTERFACE -fsanitize=thread)
endif()

if(GOBO_FUZZ)
  target_compile_options(gobo_options INTERFACE -fsanitize=fuzzer-no-link)
endif()

# gobo_folder(FOLDER USES folder ... LINK lib ...): a folder of tools/ as a static library, lab/study as gobo_lab_study. Its files
# find what every folder includes in precompiled headers. main.cpp is left to gobo_program().
function(gobo_folder folder)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "USES;LINK;PRECOMPILE;OPTIONS")
  gobo_library_name(name ${folder})
  file(GLOB sources CONFIGURE_DEPENDS "${folder}/*.cpp")
  list(REMOVE_ITEM sources "${CMAKE_CURRENT_SOURCE_DIR}/${folder}/main.cpp")
  add_library(${name} STATIC ${sources})
  target_include_directories(${name} PUBLIC "${PROJECT_SOURCE_DIR}/tools" "${PROJECT_SOURCE_DIR}/include")
  foreach(used IN LISTS arg_USES)
    gobo_library_name(library ${used})
    target_link_libraries(${name} PUBLIC ${library})
  endforeach()
  target_link_libraries(${name} PUBLIC gobo_options gobo_headers_of_libraries ${arg_LINK})
  if(arg_OPTIONS)
    target_compile_options(${name} PRIVATE ${arg_OPTIONS})
  endif()
  gobo_precompile(${name} "${arg_PRECOMPILE}" ${arg_OPTIONS})
endfunction()

# What is precompiled once and used by every target of the same options: the standard library's headers, fmt, expected and `headers`.
set(GOBO_PRECOMPILED <algorithm> <array> <charconv> <cmath> <cstddef> <cstdint> <cstdio> <functional> <limits> <map> <memory> <numeric> <optional>
  <set> <string> <string_view> <tuple> <utility> <variant> <vector> <fmt/format.h> <tl/expected.hpp>)
function(gobo_precompile target headers)
  string(MAKE_C_IDENTIFIER "gobo_precompiled${headers}${ARGN}" owner)
  if(NOT TARGET ${owner})
    file(WRITE "${PROJECT_BINARY_DIR}/precompiled.cpp" "")
    add_library(${owner} OBJECT "${PROJECT_BINARY_DIR}/precompiled.cpp")
    target_link_libraries(${owner} PRIVATE gobo_options gobo_headers_of_libraries fmt::fmt $<TARGET_NAME_IF_EXISTS:GTest::gmock>)
    target_compile_options(${owner} PRIVATE ${ARGN})
    target_precompile_headers(${owner} PRIVATE ${GOBO_PRECOMPILED} ${headers})
  endif()
  target_precompile_headers(${target} REUSE_FROM ${owner})
endfunction()

# gobo_program(NAME FOLDER): the executable of a folder that holds main.cpp, and its manual page, which it writes itself.
function(gobo_program name folder)
  gobo_library_name(library ${folder})
  add_executable(${name} ${folder}/main.cpp)
  target_link_libraries(${name} PRIVATE ${library})
  set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/bin")
  file(MAKE_DIRECTORY "${PROJECT_BINARY_DIR}/share/man/man1")
  add_custom_command(TARGET ${name} POST_BUILD COMMAND ${name} manual > "${PROJECT_BINARY_DIR}/share/man/man1/${name}.1")
endfunction()

function(gobo_library_name variable folder)
  string(REPLACE "/" "_" name ${folder})
  set(${variable} gobo_${name} PARENT_SCOPE)
endfunction()
