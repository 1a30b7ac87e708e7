# What `cmake --install` lays down: the command, the libraries with the headers that docs/reference/cpp-api.md names, the
# cases, the docs, and a CMake package, so that find_package(soilbin) gives soilbin::scenario, soilbin::bekker_wong,
# soilbin::dem, soilbin::resistive_force, soilbin::cone_index, soilbin::compare, and of them soilbin::surface (dem/surface) and
# soilbin::experiments (compare/experiments).
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(floors scenario bekker_wong dem resistive_force cone_index compare)
set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/soilbin)

if(TARGET soilbin)
  install(TARGETS soilbin RUNTIME COMPONENT runtime)
  install(FILES ${PROJECT_BINARY_DIR}/share/soilbin.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT runtime)
  install(FILES ${PROJECT_BINARY_DIR}/share/soilbin.bash RENAME soilbin COMPONENT runtime
    DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
  install(DIRECTORY ${PROJECT_BINARY_DIR}/share/schema DESTINATION ${CMAKE_INSTALL_DATADIR}/soilbin COMPONENT runtime)
endif()
install(DIRECTORY cases DESTINATION ${CMAKE_INSTALL_DATADIR}/soilbin COMPONENT runtime)
install(FILES README.md CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT runtime)
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} RENAME copyright COMPONENT runtime)
install(DIRECTORY docs DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT runtime)
if(TARGET soilbin)  # in place of the page that says how to get it
  install(FILES ${PROJECT_BINARY_DIR}/share/commands.md DESTINATION ${CMAKE_INSTALL_DOCDIR}/docs/reference
    COMPONENT runtime)
endif()

install(TARGETS soilbin_options EXPORT soilbin)
foreach(library IN LISTS floors ITEMS surface experiments)
  set_target_properties(soilbin_${library} PROPERTIES EXPORT_NAME ${library})
  install(TARGETS soilbin_${library} EXPORT soilbin ARCHIVE COMPONENT development)
endforeach()
# Headers are included as in the project itself, "scenario/tire.hpp", from a folder of soilbin's own.
install(CODE "set(SOURCE \"${PROJECT_SOURCE_DIR}\")\nset(FOLDER \"${CMAKE_INSTALL_INCLUDEDIR}/soilbin\")"
  COMPONENT development)
install(SCRIPT ${PROJECT_SOURCE_DIR}/cmake/install_headers.cmake COMPONENT development)
install(EXPORT soilbin NAMESPACE soilbin:: DESTINATION ${package_folder} FILE soilbin-targets.cmake COMPONENT development)

configure_package_config_file(cmake/soilbin-config.cmake.in ${PROJECT_BINARY_DIR}/soilbin-config.cmake
  INSTALL_DESTINATION ${package_folder})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/soilbin-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/soilbin-config.cmake ${PROJECT_BINARY_DIR}/soilbin-config-version.cmake
  DESTINATION ${package_folder} COMPONENT development)

# The archives of CVODES, so that who links ours needs no package that brings MPI and PETSc (cmake/FindSUNDIALS.cmake).
foreach(archive IN LISTS SUNDIALS_ARCHIVES)
  install(FILES ${SUNDIALS_${archive}_LIBRARY} DESTINATION ${CMAKE_INSTALL_LIBDIR}/soilbin COMPONENT development)
endforeach()
find_file(SUNDIALS_COPYRIGHT copyright NO_DEFAULT_PATH
  PATHS ${SUNDIALS_INCLUDE_DIR}/../share/doc/libsundials-dev)
if(SUNDIALS_COPYRIGHT)
  install(FILES ${SUNDIALS_COPYRIGHT} DESTINATION ${CMAKE_INSTALL_LIBDIR}/soilbin RENAME copyright.sundials
    COMPONENT development)
endif()
