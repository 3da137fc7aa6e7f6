# Installs the library, its headers and a CMake package: find_package(hexwright) gives hexwright::hexwright.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

install(TARGETS hexwright EXPORT hexwright-targets
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}
  RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(DIRECTORY include/hexwright DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(EXPORT hexwright-targets NAMESPACE hexwright::
  DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/hexwright)
configure_package_config_file(cmake/hexwright-config.cmake.in hexwright-config.cmake
  INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/hexwright)
write_basic_package_version_file(hexwright-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/hexwright-config.cmake
  ${CMAKE_CURRENT_BINARY_DIR}/hexwright-config-version.cmake
  DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/hexwright)
