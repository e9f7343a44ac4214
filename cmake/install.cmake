# Files of `cmake --install`: program, library, headers, shipped problems, CMake package and pkg-config file. The component
# `program` is in the Debian package too.
install(TARGETS crushzone EXPORT crushzone
        LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT program NAMELINK_COMPONENT development)
install(TARGETS crushzone-installed RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT program)
if(TARGET crushzone-mpi-installed)
    install(TARGETS crushzone-mpi-installed RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT mpi)
endif()
install(DIRECTORY include/crushzone DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT development)
install(DIRECTORY problems/ DESTINATION ${CMAKE_INSTALL_DATADIR}/crushzone COMPONENT program)
install(FILES README.md DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)
install(FILES CHANGELOG.md CONTRIBUTING.md LICENSE NOTICE DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT development)
install(FILES problems/README.md DESTINATION ${CMAKE_INSTALL_DOCDIR}/problems COMPONENT program)
install(DIRECTORY docs DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program FILES_MATCHING PATTERN "*.md" PATTERN "*.svg")

install(FILES docs/crushzone.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT development)
install(FILES docs/crushzone.bash RENAME crushzone DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions
        COMPONENT program)

set(CZ_PACKAGE_FOLDER ${CMAKE_INSTALL_LIBDIR}/cmake/crushzone)
install(EXPORT crushzone NAMESPACE crushzone:: FILE crushzone-targets.cmake DESTINATION ${CZ_PACKAGE_FOLDER}
        COMPONENT development)
configure_package_config_file(cmake/crushzone-config.cmake.in crushzone-config.cmake
                              INSTALL_DESTINATION ${CZ_PACKAGE_FOLDER})
write_basic_package_version_file(crushzone-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/crushzone-config.cmake
              ${CMAKE_CURRENT_BINARY_DIR}/crushzone-config-version.cmake
        DESTINATION ${CZ_PACKAGE_FOLDER} COMPONENT development)

# The pkg-config file finds its prefix from its own place, so that an installed tree can be moved.
file(RELATIVE_PATH CZ_PREFIX_FROM_PC ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig ${CMAKE_INSTALL_PREFIX})
configure_file(cmake/crushzone.pc.in crushzone.pc @ONLY)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/crushzone.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT development)

include(cmake/package.cmake)
