# Installs the headers, the glint program, and the package that find_package(glint COMPONENTS …) reads.

include(CMakePackageConfigHelpers)
include(GNUInstallDirs)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/glint)

# A file a component: whoever asks for the core never meets the targets of other components.
foreach(component IN LISTS components)
  install(TARGETS glint_${component} EXPORT glint_${component} FILE_SET HEADERS COMPONENT development)
  install(EXPORT glint_${component} NAMESPACE glint:: DESTINATION ${package_dir} COMPONENT development)
endforeach()

configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/glint-config.cmake.in ${PROJECT_BINARY_DIR}/glint-config.cmake
                              INSTALL_DESTINATION ${package_dir} NO_SET_AND_CHECK_MACRO)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/glint-config-version.cmake COMPATIBILITY SameMinorVersion
                                 ARCH_INDEPENDENT)
install(FILES ${PROJECT_BINARY_DIR}/glint-config.cmake ${PROJECT_BINARY_DIR}/glint-config-version.cmake
              ${PROJECT_SOURCE_DIR}/cmake/FindStb.cmake
        DESTINATION ${package_dir} COMPONENT development)
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT development)

if(TARGET glint_program)
  install(TARGETS glint_program COMPONENT program)
endif()
