# Files of `cmake --install`: program, library, headers, shipped problems, CMake package and pkg-config file.
install(TARGETS crushzone EXPORT crushzone
        LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(TARGETS crushzone-installed RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(DIRECTORY include/crushzone DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(DIRECTORY problems/ DESTINATION ${CMAKE_INSTALL_DATADIR}/crushzone)
install(FILES README.md CHANGELOG.md CONTRIBUTING.md LICENSE NOTICE DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(FILES problems/README.md DESTINATION ${CMAKE_INSTALL_DOCDIR}/problems)
install(DIRECTORY docs DESTINATION ${CMAKE_INSTALL_DOCDIR} FILES_MATCHING PATTERN "*.md" PATTERN "*.svg")

install(FILES docs/crushzone.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
install(FILES docs/crushzone.bash RENAME crushzone DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)

set(CZ_PACKAGE_FOLDER ${CMAKE_INSTALL_LIBDIR}/cmake/crushzone)
install(EXPORT crushzone NAMESPACE crushzone:: FILE crushzone-targets.cmake DESTINATION ${CZ_PACKAGE_FOLDER})
configure_package_config_file(cmake/crushzone-config.cmake.in crushzone-config.cmake
                              INSTALL_DESTINATION ${CZ_PACKAGE_FOLDER})
write_basic_package_version_file(crushzone-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/crushzone-config.cmake
              ${CMAKE_CURRENT_BINARY_DIR}/crushzone-config-version.cmake
        DESTINATION ${CZ_PACKAGE_FOLDER})

# The pkg-config file finds its prefix from its own place, so that an installed tree can be moved.
file(RELATIVE_PATH CZ_PREFIX_FROM_PC ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig ${CMAKE_INSTALL_PREFIX})
configure_file(cmake/crushzone.pc.in crushzone.pc @ONLY)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/crushzone.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
