# `cpack -G DEB` in a build of the preset `package`: a Debian package with program, library, shipped data, manual page, bash
# completion and pages; where MPI was found, another one with crushzone-mpi alone, because it depends on Open MPI. The library is in a folder of the package's own, because it is for this program (for
# one just below lib, cpack would call ldconfig); projects that link it use `cmake --install`.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME crushzone)
set(CPACK_PACKAGE_CONTACT "The crushzone authors <crushzone@users.noreply.github.com>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "design of the crush zones of railway trains")
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
    OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)

# Packages of these components: not of headers, of CMake files, or of files that a package has in another form.
set(CPACK_COMPONENTS_ALL program debian)
set(CPACK_COMPONENT_PROGRAM_GROUP main)
set(CPACK_COMPONENT_DEBIAN_GROUP main)
set(CPACK_DEBIAN_MAIN_PACKAGE_NAME crushzone)
if(TARGET crushzone-mpi-installed)
    list(APPEND CPACK_COMPONENTS_ALL mpi debian-mpi)
    set(CPACK_COMPONENT_MPI_GROUP ranks)
    set(CPACK_COMPONENT_DEBIAN-MPI_GROUP ranks)
    set(CPACK_DEBIAN_RANKS_PACKAGE_NAME crushzone-mpi)
    set(CPACK_DEBIAN_RANKS_PACKAGE_DEPENDS "crushzone (= ${PROJECT_VERSION}-1), openmpi-bin")
endif()
set(CPACK_COMPONENTS_GROUPING ONE_PER_GROUP)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_PACKAGE_NAME crushzone)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${CMAKE_CURRENT_BINARY_DIR})
set(CPACK_DEBIAN_MAIN_PACKAGE_SUGGESTS "bash-completion")
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_COMPONENT_MAIN_DESCRIPTION
"crushzone simulates collisions of trains: couplers, anti-climbers and crush
zones, with wheel lift and override, judges them by published limits, and
sizes the absorbers so that every check passes, also against tolerances.

The package has the program, catalogues of parts, profiles of limits and
example problems.")
set(CPACK_COMPONENT_RANKS_DESCRIPTION
"crushzone-mpi is the program crushzone for mpirun: searches, samples and
sweeps run in the ranks of an MPI job, on one machine or many, with the same
results.")

# Files that Debian wants in this form.
function(cz_install_compressed component file name)
    install(CODE "
        set(target \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_DATADIR}/${name}\")
        get_filename_component(folder \"\${target}\" DIRECTORY)
        file(MAKE_DIRECTORY \"\${folder}\")
        execute_process(COMMAND gzip -9nc ${CMAKE_CURRENT_SOURCE_DIR}/${file} OUTPUT_FILE \"\${target}\"
                        RESULT_VARIABLE failed)
        if(failed)
            message(FATAL_ERROR \"${file} cannot be compressed\")
        endif()
        file(CHMOD \"\${target}\" PERMISSIONS OWNER_READ OWNER_WRITE GROUP_READ WORLD_READ)" COMPONENT ${component})
endfunction()
function(cz_install_for_debian component package)
    install(FILES packaging/copyright DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${package} COMPONENT ${component})
    configure_file(packaging/lintian-overrides ${package}.lintian-overrides @ONLY)
    install(FILES ${CMAKE_CURRENT_BINARY_DIR}/${package}.lintian-overrides RENAME ${package}
            DESTINATION ${CMAKE_INSTALL_DATADIR}/lintian/overrides COMPONENT ${component})
    cz_install_compressed(${component} CHANGELOG.md doc/${package}/changelog.gz)
    cz_install_compressed(${component} packaging/changelog doc/${package}/changelog.Debian.gz)
endfunction()
cz_install_for_debian(debian crushzone)
cz_install_compressed(debian docs/crushzone.1 man/man1/crushzone.1.gz)
if(TARGET crushzone-mpi-installed)
    cz_install_for_debian(debian-mpi crushzone-mpi)
    cz_install_compressed(debian-mpi packaging/crushzone-mpi.1 man/man1/crushzone-mpi.1.gz)
endif()
if(EXISTS ${CMAKE_CURRENT_SOURCE_DIR}/python/crushzone) # the Python client
    string(APPEND CPACK_DEBIAN_MAIN_PACKAGE_SUGGESTS ", python3")
    install(DIRECTORY python/crushzone DESTINATION lib/python3/dist-packages COMPONENT debian
            FILES_MATCHING PATTERN "*.py" PATTERN "py.typed" PATTERN "__pycache__" EXCLUDE PATTERN "tests" EXCLUDE)
endif()
include(CPack)
