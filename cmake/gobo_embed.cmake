# cmake -D OUTPUT=... -D ROOT=... -P gobo_embed.cmake: writes a C++ file that holds the text of every file below ROOT/shader_lib,
# ROOT/templates, ROOT/data/meshes, ROOT/data/environments and ROOT/data/study, and the published light probes. Untouched where
# nothing changed, so that a touched file alone rebuilds nothing.
file(GLOB_RECURSE files RELATIVE "${ROOT}" "${ROOT}/shader_lib/*" "${ROOT}/templates/*" "${ROOT}/data/meshes/*"
  "${ROOT}/data/environments/*.exr" "${ROOT}/data/study/*" "${ROOT}/data/light_probes.csv" "${ROOT}/docs/data/guard_prices.csv")
list(SORT files)
set(rows "")
foreach(file IN LISTS files)
  if(file MATCHES "\\.exr$")  # bytes, zeros among them
    file(READ "${ROOT}/${file}" digits HEX)
    string(LENGTH "${digits}" length)
    math(EXPR size "${length} / 2")
    string(REGEX REPLACE "(................................................................)" "\\1\n" lines "${digits}")
    string(REGEX REPLACE "([0-9a-f][0-9a-f])" "\\\\x\\1" lines "${lines}")
    string(REGEX REPLACE "([^\n]+)" "\n     \"\\1\"" literals "${lines}")
    string(REPLACE "\n\n" "\n" literals "${literals}")
    string(APPEND rows "    {\"${file}\", std::string(${literals}, ${size})},\n")
    continue()
  endif()
  file(READ "${ROOT}/${file}" text)
  # Some compilers end a literal at 16 KB; adjacent ones are joined.
  set(literals "")
  string(LENGTH "${text}" length)
  set(at 0)
  while(at LESS length)
    string(SUBSTRING "${text}" ${at} 8000 chunk)
    string(APPEND literals "\n     R\"gobo(${chunk})gobo\"")
    math(EXPR at "${at} + 8000")
  endwhile()
  if(literals STREQUAL "")
    set(literals "\"\"")
  endif()
  string(APPEND rows "    {\"${file}\",${literals}},\n")
endforeach()
set(content "// Written by cmake/gobo_embed.cmake.
#include \"core/shipped_files.hpp\"

#if defined(__clang__)  // the literals of a table are long: each compiler that gobo is built by takes them
#pragma clang diagnostic ignored \"-Woverlength-strings\"
#endif

namespace gobo {

std::map<std::string, std::string, std::less<>> shipped_files() {
  return {
${rows}  };
}

}  // namespace gobo
")
set(present "")
if(EXISTS "${OUTPUT}")
  file(READ "${OUTPUT}" present)
endif()
if(NOT present STREQUAL content)
  file(WRITE "${OUTPUT}" "${content}")
endif()
