# gobo_add_permutations(TARGET FAMILY family
#                       [KEYS key...] [KEYS_FROM file...] [SCENES file...] [BUCKET_LIGHTS count...]
#                       [COVER t] [ALL] [WHERE condition] [OVER feature...] [EXCLUDED]
#                       [MAX_ERROR x] [MAX_COST y] [STUDY file]
#                       [INCLUDE folder...] [NAMESPACE name] [DIALECT 450|330|es300] [COMMENTS] [LIBRARY folder])
#
# Has gobo write the header of the selected permutations, NAME.hpp after the family's name, and puts it on the include
# path of TARGET: of an executable for itself, of a library for those who link it too. FAMILY is a shipped name or a
# .toml file. The selection is that of `gobo build`; none means the family's default set. INCLUDE folders are searched for
# pieces before the family's own. LIBRARY holds shader_lib and templates, by default those that came with gobo.
#
# The shaders' comments stay out of the header unless COMMENTS is given.
#
# MAX_ERROR and MAX_COST choose, for each combination of effects, the quality by its error and its cost; STUDY is what they
# choose by, by default the study that came with the family.
#
# GOBO_PROGRAM, where it is set, is the gobo that runs instead of the package's own: one of the host when cross-compiling.
#
# The header follows every file that it was made from, and is left untouched where its text stays the same. Relative
# paths are relative to the current source folder. docs/build_integration.md says more.
cmake_policy(PUSH)
cmake_policy(VERSION 3.25)

function(gobo_add_permutations target)
  cmake_parse_arguments(PARSE_ARGV 1 arg "ALL;EXCLUDED;COMMENTS" "FAMILY;COVER;WHERE;MAX_ERROR;MAX_COST;STUDY;NAMESPACE;DIALECT;LIBRARY"
                        "KEYS;KEYS_FROM;SCENES;BUCKET_LIGHTS;OVER;INCLUDE")
  _gobo_check_arguments()
  if(NOT arg_LIBRARY)
    get_property(arg_LIBRARY GLOBAL PROPERTY GOBO_LIBRARY_FOLDER)
  endif()
  get_filename_component(arg_LIBRARY "${arg_LIBRARY}" ABSOLUTE)
  _gobo_find_family(family_argument family_file name)
  set(folder "${CMAKE_CURRENT_BINARY_DIR}/gobo/${target}/${name}")
  _gobo_command_line(arguments inputs)

  # Make compares times and would run gobo again for ever where the header stays untouched: the stamp is what has been
  # made. A changed command line must run it too, and Make knows of that by a file alone.
  set(stamp "${folder}/${name}.stamp")
  list(JOIN arguments "\n" argument_lines)
  _gobo_write("${folder}/${name}.arguments" "${argument_lines}\n")
  set(program gobo::gobo)
  if(GOBO_PROGRAM)
    set(program "${GOBO_PROGRAM}")
  endif()
  add_custom_command(
    OUTPUT "${stamp}"
    BYPRODUCTS "${folder}/${name}.hpp" "${folder}/${name}.json"
    COMMAND ${program} build ${arguments} -o "${folder}" --depfile-target "${stamp}" --quiet
    COMMAND "${CMAKE_COMMAND}" -E touch "${stamp}"
    DEPENDS ${program} ${inputs} "${folder}/${name}.arguments"
    DEPFILE "${folder}/${name}.d"
    COMMENT "Building the permutations ${name}.hpp of ${target}"
    VERBATIM)
  add_custom_target(${target}_${name}_permutations DEPENDS "${stamp}")
  add_dependencies(${target} ${target}_${name}_permutations)
  _gobo_use_header()
endfunction()

# The functions below are parts of the one above, read its variables, and set those whose names they are given.

function(_gobo_check_arguments)
  if(NOT TARGET "${target}")
    message(FATAL_ERROR "gobo_add_permutations: there is no target '${target}'; add it before")
  endif()
  if("RETIRED" IN_LIST arg_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "gobo_add_permutations: RETIRED is now EXCLUDED")
  endif()
  if(arg_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "gobo_add_permutations: unknown arguments: ${arg_UNPARSED_ARGUMENTS}")
  endif()
  if(arg_KEYWORDS_MISSING_VALUES)
    message(FATAL_ERROR "gobo_add_permutations: no value after ${arg_KEYWORDS_MISSING_VALUES}")
  endif()
  if(NOT arg_FAMILY)
    message(FATAL_ERROR "gobo_add_permutations: name a FAMILY: a shipped one (lit) or a .toml file")
  endif()
endfunction()

# The family as gobo takes it, its file, and its name, which the header bears.
function(_gobo_find_family argument_variable file_variable name_variable)
  if(arg_FAMILY MATCHES "\\.toml$")
    get_filename_component(file "${arg_FAMILY}" ABSOLUTE)
    set(${argument_variable} "${file}" PARENT_SCOPE)
  else()
    set(file "${arg_LIBRARY}/templates/${arg_FAMILY}.toml")
    set(${argument_variable} "${arg_FAMILY}" PARENT_SCOPE)
  endif()
  if(NOT EXISTS "${file}")
    message(FATAL_ERROR "gobo_add_permutations: there is no family '${arg_FAMILY}' (${file})")
  endif()
  file(STRINGS "${file}" lines REGEX "^[ \t]*name[ \t]*=" LIMIT_COUNT 1)
  if(NOT lines MATCHES "=[ \t]*[\"']([^\"']+)[\"']")
    message(FATAL_ERROR "gobo_add_permutations: ${file} gives the family no name (name = \"...\")")
  endif()
  set(${name_variable} "${CMAKE_MATCH_1}" PARENT_SCOPE)
  set(${file_variable} "${file}" PARENT_SCOPE)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${file}")
endfunction()

# The arguments of `gobo build`, and the files among them. Keys go through a file: there may be thousands.
function(_gobo_command_line arguments_variable inputs_variable)
  set(arguments "")
  set(inputs "${family_file}")
  macro(add option value)
    string(REPLACE ";" "\\;" escaped "${value}")
    list(APPEND arguments ${option} "${escaped}")
  endmacro()
  string(REPLACE ";" "\\;" inputs "${family_file}")
  string(REPLACE ";" "\\;" arguments "${family_argument}")
  add(--library "${arg_LIBRARY}")
  if(DEFINED arg_KEYS)
    set(lines "")
    foreach(key IN LISTS arg_KEYS)
      string(APPEND lines "${key}\n")
    endforeach()
    _gobo_write("${folder}/${name}.keys" "${lines}")
    list(PREPEND arg_KEYS_FROM "${folder}/${name}.keys")
  endif()
  foreach(file IN LISTS arg_KEYS_FROM)
    get_filename_component(file "${file}" ABSOLUTE)
    add(--keys-from "${file}")
    list(APPEND inputs "${escaped}")
  endforeach()
  foreach(scene IN LISTS arg_SCENES)
    get_filename_component(scene "${scene}" ABSOLUTE)
    add(--scene "${scene}")
    list(APPEND inputs "${escaped}")
  endforeach()
  if(DEFINED arg_STUDY)
    get_filename_component(study "${arg_STUDY}" ABSOLUTE)
    add(--study "${study}")
    list(APPEND inputs "${escaped}")
  endif()
  foreach(include IN LISTS arg_INCLUDE)
    get_filename_component(include "${include}" ABSOLUTE)
    add(-I "${include}")
  endforeach()
  foreach(option ALL EXCLUDED COMMENTS)
    if(arg_${option})
      string(TOLOWER "--${option}" flag)
      list(APPEND arguments ${flag})
    endif()
  endforeach()
  foreach(option COVER WHERE MAX_ERROR MAX_COST NAMESPACE DIALECT)
    if(DEFINED arg_${option})
      string(TOLOWER "--${option}" flag)
      string(REPLACE "_" "-" flag "${flag}")
      add(${flag} "${arg_${option}}")
    endif()
  endforeach()
  if(arg_BUCKET_LIGHTS)
    list(JOIN arg_BUCKET_LIGHTS "," counts)
    add(--bucket-lights "${counts}")
  endif()
  if(arg_OVER)
    list(JOIN arg_OVER "," features)
    add(--over "${features}")
  endif()
  set(${arguments_variable} "${arguments}" PARENT_SCOPE)
  set(${inputs_variable} "${inputs}" PARENT_SCOPE)
endfunction()

# Writes a file, unless it holds that text already.
function(_gobo_write file text)
  set(present "")
  if(EXISTS "${file}")
    file(READ "${file}" present)
  endif()
  if(NOT present STREQUAL text OR NOT EXISTS "${file}")
    file(WRITE "${file}" "${text}")
  endif()
endfunction()

# Puts the header, and what it includes, on the include path of the target and of those who may include it through it.
function(_gobo_use_header)
  get_target_property(type ${target} TYPE)
  if(type STREQUAL "EXECUTABLE")
    set(scope PRIVATE)
  elseif(type STREQUAL "INTERFACE_LIBRARY")
    set(scope INTERFACE)
  else()
    set(scope PUBLIC)
  endif()
  target_include_directories(${target} ${scope} "$<BUILD_INTERFACE:${folder}>")
  target_link_libraries(${target} ${scope} gobo::headers)
endfunction()

cmake_policy(POP)
