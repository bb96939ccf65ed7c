# gobo as a package: gobo::gobo (the program), gobo::headers (what generated headers include) and gobo_add_permutations()
# and gobo_add_permutation_tests(), installed, from the build tree, or by add_subdirectory and FetchContent.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

find_package(glm REQUIRED CONFIG)
add_library(gobo_headers INTERFACE)
add_library(gobo::headers ALIAS gobo_headers)
set_target_properties(gobo_headers PROPERTIES EXPORT_NAME headers)
target_compile_features(gobo_headers INTERFACE cxx_std_17)
target_link_libraries(gobo_headers INTERFACE glm::glm)
target_include_directories(gobo_headers SYSTEM INTERFACE
  "$<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include>" "$<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>")
add_executable(gobo::gobo ALIAS gobo)
add_executable(gobo::lab ALIAS gobo-lab)

# Projects that take gobo in as a subdirectory call the function from their own folders.
set_property(GLOBAL PROPERTY GOBO_LIBRARY_FOLDER "${PROJECT_SOURCE_DIR}")
include("${PROJECT_SOURCE_DIR}/cmake/gobo_add_permutation_tests.cmake")

set(gobo_package_folder "${CMAKE_INSTALL_LIBDIR}/cmake/gobo")
set(gobo_version_file "${PROJECT_BINARY_DIR}/cmake/goboConfigVersion.cmake")
write_basic_package_version_file("${gobo_version_file}" COMPATIBILITY SameMinorVersion)

# From the build tree: cmake -D gobo_DIR=build/release/cmake.
set(GOBO_LIBRARY_FOLDER "${PROJECT_SOURCE_DIR}")
set(gobo_module "${PROJECT_SOURCE_DIR}/cmake/gobo_add_permutation_tests.cmake")
configure_package_config_file("${PROJECT_SOURCE_DIR}/cmake/goboConfig.cmake.in" "${PROJECT_BINARY_DIR}/cmake/goboConfig.cmake"
  INSTALL_DESTINATION "${PROJECT_BINARY_DIR}/cmake" INSTALL_PREFIX "${PROJECT_BINARY_DIR}"
  PATH_VARS GOBO_LIBRARY_FOLDER gobo_module)
export(TARGETS gobo gobo-lab gobo_headers NAMESPACE gobo:: FILE "${PROJECT_BINARY_DIR}/cmake/goboTargets.cmake")

# Installed.
if(NOT GOBO_INSTALL)
  return()
endif()
set(GOBO_LIBRARY_FOLDER "${CMAKE_INSTALL_DATADIR}/gobo")
set(gobo_module "${gobo_package_folder}/gobo_add_permutation_tests.cmake")
configure_package_config_file("${PROJECT_SOURCE_DIR}/cmake/goboConfig.cmake.in" "${PROJECT_BINARY_DIR}/installed/goboConfig.cmake"
  INSTALL_DESTINATION "${gobo_package_folder}" PATH_VARS GOBO_LIBRARY_FOLDER gobo_module)
install(TARGETS gobo gobo-lab gobo_headers EXPORT goboTargets RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}")
install(EXPORT goboTargets NAMESPACE gobo:: DESTINATION "${gobo_package_folder}")
install(FILES "${PROJECT_BINARY_DIR}/installed/goboConfig.cmake" "${gobo_version_file}"
              "${PROJECT_SOURCE_DIR}/cmake/gobo_add_permutations.cmake"
              "${PROJECT_SOURCE_DIR}/cmake/gobo_add_permutation_tests.cmake" DESTINATION "${gobo_package_folder}")
install(DIRECTORY "${PROJECT_SOURCE_DIR}/include/gobo" DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}")
install(DIRECTORY "${PROJECT_SOURCE_DIR}/shader_lib" "${PROJECT_SOURCE_DIR}/templates"
        DESTINATION "${CMAKE_INSTALL_DATADIR}/gobo")
