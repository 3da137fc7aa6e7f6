# Installs the library, its headers and a CMake package: find_package(hexwright) gives hexwright::hexwright, and
# find_package(hexwright COMPONENTS ilp cad) also the integer-program oracle hexwright::ilp and the reader of CAD files
# hexwright::cad where they were built.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

install(TARGETS hexwright EXPORT hexwright-targets
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}
  RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
if(TARGET hexwright_ilp)
  # An export set of its own: the core package must load where HiGHS is missing.
  install(TARGETS hexwright_ilp EXPORT hexwright-ilp-targets
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
  install(EXPORT hexwright-ilp-targets NAMESPACE hexwright::
    DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/hexwright)
  install(FILES cmake/FindHiGHS.cmake DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/hexwright)
  # Where the solver was found, as a hint for projects that use the package on this machine.
  get_filename_component(hexwright_highs_dir "${HiGHS_INCLUDE_DIR}" DIRECTORY)
endif()
if(HEXWRIGHT_CAD)
  # Of its own for the same reason: the core package must load where OpenCASCADE is missing.
  install(TARGETS hexwright_cad EXPORT hexwright-cad-targets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
  install(EXPORT hexwright-cad-targets NAMESPACE hexwright::
    DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/hexwright)
endif()
if(HEXWRIGHT_NETCDF)
  install(FILES cmake/FindNetcdfLibrary.cmake DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/hexwright)
  # Where the library was found, as a hint for projects that use the package on this machine.
  get_filename_component(hexwright_netcdf_dir "${NetcdfLibrary_INCLUDE_DIR}" DIRECTORY)
endif()
install(DIRECTORY include/hexwright DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(EXPORT hexwright-targets NAMESPACE hexwright::
  DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/hexwright)
configure_package_config_file(cmake/hexwright-config.cmake.in hexwright-config.cmake
  INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/hexwright)
write_basic_package_version_file(hexwright-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/hexwright-config.cmake
  ${CMAKE_CURRENT_BINARY_DIR}/hexwright-config-version.cmake
  DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/hexwright)
