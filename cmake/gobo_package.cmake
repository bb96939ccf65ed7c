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
export(TARGETS gobo gobo_headers NAMESPACE gobo:: FILE "${PROJECT_BINARY_DIR}/cmake/goboTargets.cmake")

# Installed: component gobo is the compiler with all that a build needs, component lab is gobo-lab beside it.
if(NOT GOBO_INSTALL)
  return()
endif()
set(GOBO_LIBRARY_FOLDER "${CMAKE_INSTALL_DATADIR}/gobo")
set(gobo_module "${gobo_package_folder}/gobo_add_permutation_tests.cmake")
configure_package_config_file("${PROJECT_SOURCE_DIR}/cmake/goboConfig.cmake.in" "${PROJECT_BINARY_DIR}/installed/goboConfig.cmake"
  INSTALL_DESTINATION "${gobo_package_folder}" PATH_VARS GOBO_LIBRARY_FOLDER gobo_module)
set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME gobo)
install(TARGETS gobo gobo_headers EXPORT goboTargets RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}" COMPONENT gobo)
install(EXPORT goboTargets NAMESPACE gobo:: DESTINATION "${gobo_package_folder}" COMPONENT gobo)
install(FILES "${PROJECT_BINARY_DIR}/installed/goboConfig.cmake" "${gobo_version_file}"
              "${PROJECT_SOURCE_DIR}/cmake/gobo_add_permutations.cmake"
              "${PROJECT_SOURCE_DIR}/cmake/gobo_add_permutation_tests.cmake" DESTINATION "${gobo_package_folder}" COMPONENT gobo)
install(DIRECTORY "${PROJECT_SOURCE_DIR}/include/gobo" DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}" COMPONENT gobo)
install(DIRECTORY "${PROJECT_SOURCE_DIR}/shader_lib" "${PROJECT_SOURCE_DIR}/templates"
        DESTINATION "${CMAKE_INSTALL_DATADIR}/gobo" COMPONENT gobo)
install(FILES "${PROJECT_SOURCE_DIR}/LICENSE" DESTINATION "${CMAKE_INSTALL_DOCDIR}" RENAME copyright COMPONENT gobo)
install(FILES "${PROJECT_SOURCE_DIR}/README.md" "${PROJECT_SOURCE_DIR}/CHANGELOG.md" DESTINATION "${CMAKE_INSTALL_DOCDIR}" COMPONENT gobo)
install(DIRECTORY "${PROJECT_SOURCE_DIR}/docs" DESTINATION "${CMAKE_INSTALL_DOCDIR}" COMPONENT gobo)
install(FILES "${PROJECT_BINARY_DIR}/share/man/man1/gobo.1" DESTINATION "${CMAKE_INSTALL_MANDIR}/man1" COMPONENT gobo)
install(DIRECTORY "${PROJECT_SOURCE_DIR}/share/" DESTINATION "${CMAKE_INSTALL_DATADIR}" COMPONENT gobo)
# Debian's zsh looks here, not into /usr/share/zsh/site-functions.
install(FILES "${PROJECT_SOURCE_DIR}/share/zsh/site-functions/_gobo" DESTINATION "${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions" COMPONENT gobo)
if(GOBO_LAB)
  install(TARGETS gobo-lab RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}" COMPONENT lab)
  install(FILES "${PROJECT_SOURCE_DIR}/LICENSE" DESTINATION "${CMAKE_INSTALL_DOCDIR}-lab" RENAME copyright COMPONENT lab)
  # As in the source tree: the script reads the list beside it.
  install(PROGRAMS "${PROJECT_SOURCE_DIR}/tools/fetch_mesa.sh" DESTINATION "${CMAKE_INSTALL_DATADIR}/gobo/tools" COMPONENT lab)
  install(FILES "${PROJECT_SOURCE_DIR}/data/study/mesa_packages.txt" DESTINATION "${CMAKE_INSTALL_DATADIR}/gobo/data/study" COMPONENT lab)
  install(FILES "${PROJECT_BINARY_DIR}/share/man/man1/gobo-lab.1" DESTINATION "${CMAKE_INSTALL_MANDIR}/man1" COMPONENT lab)
endif()

# cpack -G DEB writes the packages gobo and gobo-lab.
if(PROJECT_IS_TOP_LEVEL)
  set(CPACK_PACKAGE_CONTACT "The gobo authors <gobo@localhost>")
  set(CPACK_GENERATOR DEB)
  set(CPACK_COMPONENTS_ALL gobo)
  set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
  set(CPACK_STRIP_FILES ON)
  set(CPACK_DEB_COMPONENT_INSTALL ON)
  set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
  set(CPACK_DEBIAN_PACKAGE_SECTION devel)
  set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
  set(CPACK_DEBIAN_GOBO_PACKAGE_NAME gobo)
  set(CPACK_DEBIAN_GOBO_PACKAGE_RECOMMENDS "libglm-dev, gobo-lab")
  set(CPACK_COMPONENT_GOBO_DESCRIPTION "Composes lighting shaders from pieces, validates every permutation, emits a C++ header")
  if(GOBO_LAB)
    list(APPEND CPACK_COMPONENTS_ALL lab)
    set(CPACK_DEBIAN_LAB_PACKAGE_NAME gobo-lab)
    set(CPACK_DEBIAN_LAB_PACKAGE_DEPENDS "gobo (= ${PROJECT_VERSION})")
    set(CPACK_DEBIAN_LAB_PACKAGE_RECOMMENDS "libosmesa6 | libegl1, libgl1-mesa-dri, mesa-vulkan-drivers")
    set(CPACK_COMPONENT_LAB_DESCRIPTION "Proves, draws and measures what gobo builds: gobo eval, test, sanitize, render, probe, cost, study")
  endif()
  include(CPack)
endif()
