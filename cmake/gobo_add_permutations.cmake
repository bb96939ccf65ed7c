# gobo_add_permutations(TARGET [PRIVATE|PUBLIC|INTERFACE] FAMILY family [HEADER name]
#                       [KEYS key...] [KEYS_FROM file...] [SCENES file...] [BUCKET_LIGHTS count...]
#                       [COVER t] [ALL] [WHERE condition] [OVER feature...] [EXCLUDED]
#                       [MAX_ERROR x] [DOMAIN file] [TYPICAL] [MAX_COST y] [STUDY file]
#                       [INCLUDE folder...] [NAMESPACE name] [DIALECT 450|330|es300|vulkan|gl_spirv]
#                       [OPTIMIZE] [DEBUG] [COMMENTS] [SPLIT] [LIBRARY folder])
#
# Has gobo write the header of the selected permutations and puts it on the include path of TARGET (or of what TARGET is an
# alias of): of it alone (PRIVATE), of those who link it too (PUBLIC), or of those alone (INTERFACE). By default an executable's
# is PRIVATE, a library's PUBLIC. The header is NAME.hpp after the family's name, or HEADER, which may begin with folders:
# "engine/shaders.hpp". FAMILY is a shipped name or a .toml file. The selection is that of `gobo build`; none means the family's default set. INCLUDE folders are searched for
# pieces before the family's own. LIBRARY holds shader_lib and templates, by default those that came with gobo.
#
# With SPLIT the header's tables of keys and texts go into a source file, which is compiled into TARGET: the header stays light for
# the files that include it, however many permutations it has.
#
# The shaders' comments stay out of the header unless COMMENTS is given. DIALECT vulkan and gl_spirv put SPIR-V into it: OPTIMIZE makes
# that faster, DEBUG keeps names and lines in it.
#
# MAX_ERROR and MAX_COST choose, for each combination of effects, the quality by its error and its cost; STUDY is what they
# choose by, by default the study that came with the family. An error is promised over the family's domain, or over that of
# the file DOMAIN; with TYPICAL only on scenes like the study's.
#
# GOBO_PROGRAM, where it is set, is the gobo that runs instead of the package's own. When cross-compiling it is by default one
# of the host that lies in PATH.
#
# GOBO_CACHE_DIR, where it is set, is a folder where gobo keeps results: a stage that some build folder compiled is not
# compiled again.
#
# The header follows every file that it was made from, and is left untouched where its text stays the same. Relative
# paths are relative to the current source folder. docs/build_integration.md says more.
cmake_policy(PUSH)
cmake_policy(VERSION 3.25)

function(gobo_add_permutations target)
  cmake_parse_arguments(PARSE_ARGV 1 arg "ALL;EXCLUDED;COMMENTS;SPLIT;OPTIMIZE;DEBUG;TYPICAL;PRIVATE;PUBLIC;INTERFACE"
                        "FAMILY;HEADER;COVER;WHERE;MAX_ERROR;MAX_COST;STUDY;DOMAIN;NAMESPACE;DIALECT;LIBRARY"
                        "KEYS;KEYS_FROM;SCENES;BUCKET_LIGHTS;OVER;INCLUDE")
  _gobo_check_arguments()
  if(NOT arg_LIBRARY)
    get_property(arg_LIBRARY GLOBAL PROPERTY GOBO_LIBRARY_FOLDER)
  endif()
  get_filename_component(arg_LIBRARY "${arg_LIBRARY}" ABSOLUTE)
  _gobo_find_family(family_argument family_file name)
  _gobo_name_header()
  set(folder "${CMAKE_CURRENT_BINARY_DIR}/gobo/${target}/${header_name}")
  _gobo_command_line(arguments inputs)
  _gobo_find_program(program)

  set(cache "")
  if(GOBO_CACHE_DIR)
    set(cache "${GOBO_CACHE_DIR}")
    if(NOT cache MATCHES "^redis://")
      get_filename_component(cache "${cache}" ABSOLUTE BASE_DIR "${CMAKE_BINARY_DIR}")
    endif()
    set(cache --cache "${cache}")
  endif()

  set(source "")
  if(arg_SPLIT)
    set(source "${folder}${header_folder}/${header_name}.cpp")
  endif()

  # Make compares times and would run gobo again for ever where the header stays untouched: the stamp is what has been
  # made. A changed command line must run it too, and Make knows of that by a file alone.
  set(stamp "${folder}/${header_name}.stamp")
  list(JOIN arguments "\n" argument_lines)
  _gobo_write("${folder}/${header_name}.arguments" "${argument_lines}\n")
  add_custom_command(
    OUTPUT "${stamp}"
    BYPRODUCTS "${folder}${header_folder}/${header_name}.hpp" "${folder}${header_folder}/${header_name}.json" ${source}
    COMMAND ${program} build ${arguments} ${cache} -o "${folder}${header_folder}" --header "${header_name}.hpp" --depfile-target "${stamp}" --quiet
    COMMAND "${CMAKE_COMMAND}" -E touch "${stamp}"
    DEPENDS ${program} ${inputs} "${folder}/${header_name}.arguments"
    DEPFILE "${folder}${header_folder}/${header_name}.d"
    COMMENT "Building the permutations ${header_name}.hpp of ${target}"
    VERBATIM)
  add_custom_target(${target}_${header_name}_permutations DEPENDS "${stamp}")
  add_dependencies(${target} ${target}_${header_name}_permutations)
  _gobo_use_header()
endfunction()

# The functions below are parts of the one above, read its variables, and set those whose names they are given.

function(_gobo_check_arguments)
  if(NOT TARGET "${target}")
    message(FATAL_ERROR "gobo_add_permutations: there is no target '${target}'; add it before")
  endif()
  get_target_property(aliased "${target}" ALIASED_TARGET)
  if(aliased)
    set(target "${aliased}" PARENT_SCOPE)
    set(target "${aliased}")
  endif()
  get_target_property(is_imported "${target}" IMPORTED)
  if(is_imported)
    message(FATAL_ERROR "gobo_add_permutations: '${target}' is imported: nothing of it is compiled here; name a target of this project")
  endif()
  if(arg_PRIVATE AND arg_PUBLIC OR arg_PRIVATE AND arg_INTERFACE OR arg_PUBLIC AND arg_INTERFACE)
    message(FATAL_ERROR "gobo_add_permutations: give one of PRIVATE, PUBLIC and INTERFACE")
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

# The header's name without its end (header_name), and the folders before it (header_folder: empty, or "/engine").
function(_gobo_name_header)
  set(header_folder "")
  set(header_name "${name}")
  if(arg_HEADER)
    if(NOT arg_HEADER MATCHES "^(([A-Za-z0-9_.-]+/)*)([A-Za-z0-9_][A-Za-z0-9_.-]*)\\.hpp$" OR arg_HEADER MATCHES "(^|/)\\.\\.?/")
      message(FATAL_ERROR "gobo_add_permutations: HEADER is a name such as shaders.hpp or engine/shaders.hpp, not '${arg_HEADER}'")
    endif()
    get_filename_component(header_name "${arg_HEADER}" NAME_WLE)
    get_filename_component(header_folder "/${arg_HEADER}" DIRECTORY)
    string(REGEX REPLACE "/$" "" header_folder "${header_folder}")
  endif()
  set(header_folder "${header_folder}" PARENT_SCOPE)
  set(header_name "${header_name}" PARENT_SCOPE)
endfunction()

# The gobo to run: the package's own, or one of the host where what is built here runs elsewhere.
function(_gobo_find_program variable)
  set(${variable} gobo::gobo PARENT_SCOPE)
  get_target_property(is_imported gobo::gobo IMPORTED)
  if(CMAKE_CROSSCOMPILING AND NOT GOBO_PROGRAM AND NOT CMAKE_CROSSCOMPILING_EMULATOR)
    if(is_imported)
      get_target_property(location gobo::gobo LOCATION)
      execute_process(COMMAND "${location}" --version RESULT_VARIABLE status OUTPUT_QUIET ERROR_QUIET)
      if(status STREQUAL "0")
        return()
      endif()
    endif()
    find_program(GOBO_PROGRAM gobo NO_CMAKE_FIND_ROOT_PATH DOC "The gobo of the host")
    if(NOT GOBO_PROGRAM)
      message(FATAL_ERROR "gobo_add_permutations: cross-compiling needs a gobo that runs here; build one for the host and give -D GOBO_PROGRAM=.../gobo")
    endif()
  endif()
  if(GOBO_PROGRAM)
    set(${variable} "${GOBO_PROGRAM}" PARENT_SCOPE)
  endif()
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
    _gobo_write("${folder}/${header_name}.keys" "${lines}")
    list(PREPEND arg_KEYS_FROM "${folder}/${header_name}.keys")
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
  foreach(option STUDY DOMAIN)
    if(DEFINED arg_${option})
      string(TOLOWER "--${option}" flag)
      get_filename_component(file "${arg_${option}}" ABSOLUTE)
      add(${flag} "${file}")
      list(APPEND inputs "${escaped}")
    endif()
  endforeach()
  foreach(include IN LISTS arg_INCLUDE)
    get_filename_component(include "${include}" ABSOLUTE)
    add(-I "${include}")
  endforeach()
  foreach(option ALL EXCLUDED COMMENTS SPLIT OPTIMIZE DEBUG TYPICAL)
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
  if(type STREQUAL "INTERFACE_LIBRARY" OR arg_INTERFACE)
    set(scope INTERFACE)
  elseif(arg_PRIVATE OR type STREQUAL "EXECUTABLE" AND NOT arg_PUBLIC)
    set(scope PRIVATE)
  else()
    set(scope PUBLIC)
  endif()
  if(source)
    # Whoever links the target has the tables with it; of an interface library they are compiled there.
    if(scope STREQUAL "PUBLIC")
      target_sources(${target} PRIVATE "${source}")
    else()
      target_sources(${target} ${scope} "$<BUILD_INTERFACE:${source}>")
    endif()
  endif()
  target_include_directories(${target} ${scope} "$<BUILD_INTERFACE:${folder}>")
  target_link_libraries(${target} ${scope} gobo::headers)
endfunction()

cmake_policy(POP)
