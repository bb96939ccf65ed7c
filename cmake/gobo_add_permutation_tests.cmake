# gobo_add_permutation_tests(NAME name FAMILY family
#                            [KEYS key...] [KEYS_FROM file...] [SCENES file...] [BUCKET_LIGHTS count...]
#                            [COVER t] [ALL] [WHERE condition] [OVER feature...] [EXCLUDED]
#                            [RENDER] [BACKEND osmesa|egl|vulkan] [DIALECT dialect] [SHARDS n] [INCLUDE folder...] [LIBRARY folder]
#                            [COST_BASELINE file GPU chip...])
#
# Registers tests that run `gobo test` on the selected permutations: with CTest, and so in what `ctest --output-junit`
# writes. KEYS and KEYS_FROM alone give one test for each key, NAME.KEY; any other selection, or SHARDS, gives n tests
# NAME.I_of_N (by default 1) that share the keys and print each one that fails. RENDER adds tests NAME.render.... that draw
# the same keys and hold each pixel against the evaluation. The points and pictures of keys that fail are left in
# gobo/tests/NAME of the current binary folder.
#
# COST_BASELINE adds the test NAME.cost: what the keys cost on the chips, held against a table that
# `gobo cost --baseline file --update` made.
#
# FAMILY, the selection, INCLUDE and LIBRARY are those of gobo_add_permutations(). docs/build_integration.md says more.
include("${CMAKE_CURRENT_LIST_DIR}/gobo_add_permutations.cmake")
cmake_policy(PUSH)
cmake_policy(VERSION 3.25)

function(gobo_add_permutation_tests)
  cmake_parse_arguments(PARSE_ARGV 0 arg "ALL;EXCLUDED;RENDER" "NAME;FAMILY;COVER;WHERE;BACKEND;DIALECT;SHARDS;LIBRARY;COST_BASELINE"
                        "GPU;KEYS;KEYS_FROM;SCENES;BUCKET_LIGHTS;OVER;INCLUDE")
  _gobo_check_test_arguments()
  if(NOT arg_LIBRARY)
    get_property(arg_LIBRARY GLOBAL PROPERTY GOBO_LIBRARY_FOLDER)
  endif()
  get_filename_component(arg_LIBRARY "${arg_LIBRARY}" ABSOLUTE)
  _gobo_find_family(family_argument family_file name)
  set(header_name "${name}")
  set(folder "${CMAKE_CURRENT_BINARY_DIR}/gobo/tests/${arg_NAME}")
  _gobo_add_mode_tests("${arg_NAME}" "")
  if(arg_RENDER)
    set(render --render)
    if(arg_BACKEND)
      list(APPEND render --backend "${arg_BACKEND}")
    endif()
    _gobo_add_mode_tests("${arg_NAME}.render" "${render}")
  endif()
  if(arg_COST_BASELINE)
    get_filename_component(baseline "${arg_COST_BASELINE}" ABSOLUTE)
    list(JOIN arg_GPU "," gpus)
    set(folder "${folder}/cost")
    _gobo_command_line(arguments inputs)
    add_test(NAME "${arg_NAME}.cost"
      COMMAND "$<TARGET_FILE:gobo::gobo>" cost ${arguments} --gpu "${gpus}" --baseline "${baseline}" -o "${folder}" --jobs 1)
  endif()
endfunction()

# The functions below are parts of the one above and read its variables.

function(_gobo_check_test_arguments)
  if("RETIRED" IN_LIST arg_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "gobo_add_permutation_tests: RETIRED is now EXCLUDED")
  endif()
  if(arg_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "gobo_add_permutation_tests: unknown arguments: ${arg_UNPARSED_ARGUMENTS}")
  endif()
  if(arg_KEYWORDS_MISSING_VALUES)
    message(FATAL_ERROR "gobo_add_permutation_tests: no value after ${arg_KEYWORDS_MISSING_VALUES}")
  endif()
  foreach(needed NAME FAMILY)
    if(NOT arg_${needed})
      message(FATAL_ERROR "gobo_add_permutation_tests: give a ${needed}")
    endif()
  endforeach()
  if(arg_BACKEND AND NOT arg_RENDER)
    message(FATAL_ERROR "gobo_add_permutation_tests: BACKEND goes with RENDER")
  endif()
  if(arg_COST_BASELINE AND NOT arg_GPU OR arg_GPU AND NOT arg_COST_BASELINE)
    message(FATAL_ERROR "gobo_add_permutation_tests: COST_BASELINE and GPU go together")
  endif()
  if(DEFINED arg_SHARDS AND NOT arg_SHARDS MATCHES "^[1-9][0-9]*$")
    message(FATAL_ERROR "gobo_add_permutation_tests: SHARDS is a whole number from 1, not '${arg_SHARDS}'")
  endif()
endfunction()

# The tests of one way to test: `options` are its options of `gobo test`.
function(_gobo_add_mode_tests prefix options)
  _gobo_listed_keys(keys)
  if(keys AND NOT DEFINED arg_SHARDS)
    unset(arg_KEYS)
    unset(arg_KEYS_FROM)
    _gobo_command_line(arguments inputs)
    foreach(key IN LISTS keys)
      string(REPLACE ";" "\\;" key "${key}")
      _gobo_add_one_test("${prefix}.${key}" --key "${key}")
    endforeach()
    return()
  endif()
  if(NOT DEFINED arg_SHARDS)
    set(arg_SHARDS 1)
  endif()
  _gobo_command_line(arguments inputs)
  foreach(shard RANGE 1 ${arg_SHARDS})
    _gobo_add_one_test("${prefix}.${shard}_of_${arg_SHARDS}" --shard "${shard}/${arg_SHARDS}")
  endforeach()
endfunction()

function(_gobo_add_one_test test)
  add_test(NAME "${test}" COMMAND "$<TARGET_FILE:gobo::gobo>" test ${arguments} ${ARGN} ${options} -o "${folder}" --jobs 1)
endfunction()

# The keys, where the selection is nothing but a list of them.
function(_gobo_listed_keys keys_variable)
  set(${keys_variable} "" PARENT_SCOPE)
  if(arg_ALL OR DEFINED arg_COVER OR DEFINED arg_WHERE OR arg_OVER OR arg_SCENES)
    return()
  endif()
  set(keys "${arg_KEYS}")
  foreach(file IN LISTS arg_KEYS_FROM)
    get_filename_component(file "${file}" ABSOLUTE)
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${file}")
    file(STRINGS "${file}" lines)
    foreach(line IN LISTS lines)
      string(REGEX REPLACE "#.*$" "" line "${line}")
      string(STRIP "${line}" line)
      if(line)
        list(APPEND keys "${line}")
      endif()
    endforeach()
  endforeach()
  if(keys)
    list(REMOVE_DUPLICATES keys)
  endif()
  set(${keys_variable} "${keys}" PARENT_SCOPE)
endfunction()

cmake_policy(POP)
