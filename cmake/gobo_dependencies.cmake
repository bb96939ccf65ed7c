# The libraries gobo stands on, found once. tools/setup.sh installs them on Debian.
find_package(Threads REQUIRED)  # before glslang, whose package file forgets to ask for it
find_package(glslang REQUIRED CONFIG)
find_package(SPIRV-Tools REQUIRED CONFIG)
find_package(SPIRV-Tools-opt REQUIRED CONFIG)
find_package(fmt REQUIRED CONFIG)
find_package(tomlplusplus REQUIRED CONFIG)
find_path(GOBO_EXPECTED_INCLUDE tl/expected.hpp REQUIRED)
find_path(GOBO_SPIRV_INCLUDE spirv/unified1/spirv.hpp11 REQUIRED)
find_path(GOBO_JSON_INCLUDE nlohmann/json.hpp REQUIRED)
find_path(GOBO_CLI11_INCLUDE CLI/CLI.hpp REQUIRED)
find_path(GOBO_XXHASH_INCLUDE xxhash.h REQUIRED)
find_path(GOBO_GLM_INCLUDE glm/glm.hpp REQUIRED)
if(GOBO_LAB)
  find_package(OpenEXR REQUIRED CONFIG)
  find_package(tinyobjloader REQUIRED CONFIG)
  find_path(GOBO_VULKAN_INCLUDE vulkan/vulkan_core.h)
  if(NOT GOBO_VULKAN_INCLUDE)
    message(FATAL_ERROR "gobo-lab needs the header vulkan/vulkan_core.h: apt-get install libvulkan-dev, or leave gobo-lab out with -D GOBO_LAB=OFF")
  endif()
endif()
find_package(JPEG REQUIRED)  # libjpeg-turbo: its JCS_EXT_RGBA
find_path(GOBO_LODEPNG_INCLUDE lodepng.h REQUIRED)
find_library(GOBO_LODEPNG_LIBRARY lodepng REQUIRED)
set(GOBO_SPIRV_TOOLS $<IF:$<TARGET_EXISTS:SPIRV-Tools-static>,SPIRV-Tools-static,SPIRV-Tools>)

# Libraries that are headers only.
add_library(gobo_headers_of_libraries INTERFACE)
target_include_directories(gobo_headers_of_libraries SYSTEM INTERFACE "${GOBO_EXPECTED_INCLUDE}" "${GOBO_SPIRV_INCLUDE}" "${GOBO_JSON_INCLUDE}"
  "${GOBO_CLI11_INCLUDE}" "${GOBO_XXHASH_INCLUDE}" "${GOBO_GLM_INCLUDE}" "${GOBO_LODEPNG_INCLUDE}")

# glslang 14 and later hold everything in fewer libraries: link those of the old names that exist.
add_library(gobo_glslang INTERFACE)
foreach(target glslang::glslang glslang::SPIRV glslang::glslang-default-resource-limits)
  if(TARGET ${target})
    target_link_libraries(gobo_glslang INTERFACE ${target})
  endif()
endforeach()
target_link_libraries(gobo_glslang INTERFACE Threads::Threads)

# Where it is not there, gobo keeps results in folders alone.
find_library(GOBO_HIREDIS_LIBRARY hiredis)
if(NOT GOBO_HIREDIS_LIBRARY)
  set(GOBO_HIREDIS_LIBRARY "")
endif()
