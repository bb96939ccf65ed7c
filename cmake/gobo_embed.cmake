# cmake -D OUTPUT=... -D ROOT=... -P gobo_embed.cmake: writes a C++ file that holds the text of every file below ROOT/shader_lib,
# ROOT/templates and ROOT/data/meshes. Untouched where nothing changed, so that a touched file alone rebuilds nothing.
file(GLOB_RECURSE files RELATIVE "${ROOT}" "${ROOT}/shader_lib/*" "${ROOT}/templates/*" "${ROOT}/data/meshes/*")
list(SORT files)
set(rows "")
foreach(file IN LISTS files)
  file(READ "${ROOT}/${file}" text)
  # Compilers need not take literals above 64 KiB; adjacent ones are joined.
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
#include \"library/shipped_files.hpp\"

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
