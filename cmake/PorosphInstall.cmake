# cmake --install and cpack: the program with its cases and pages (component runtime), what reads
# drawings (component drawings), and the libraries for programs of one's own (component development).
set(CMAKE_INSTALL_DOCDIR share/doc/porosph)
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

# What the program tells about itself: the completion of command lines for bash, and the manual page.
set(told ${CMAKE_BINARY_DIR}/share)
set(completion ${told}/completion/porosph)
add_custom_command(OUTPUT ${completion} DEPENDS porosph VERBATIM
                   COMMAND ${CMAKE_COMMAND} -E make_directory ${told}/completion
                   COMMAND porosph completion bash > ${completion})
install(FILES ${completion} DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions COMPONENT runtime)
set(page ${told}/man/man1/porosph.1.gz)
add_custom_command(OUTPUT ${page} DEPENDS porosph VERBATIM
                   COMMAND ${CMAKE_COMMAND} -E make_directory ${told}/man/man1
                   COMMAND porosph man | gzip -9n > ${page})
add_custom_target(porosph_pages ALL DEPENDS ${completion} ${page})

install(TARGETS porosph RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT runtime)
if(TARGET porosph_read_drawing)
  install(TARGETS porosph_read_drawing RUNTIME DESTINATION libexec/porosph COMPONENT drawings)
endif()
install(FILES ${page} DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT runtime)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/cases DESTINATION ${CMAKE_INSTALL_DATADIR}/porosph COMPONENT runtime)
install(DIRECTORY python DESTINATION ${CMAKE_INSTALL_DATADIR}/porosph COMPONENT runtime
        FILES_MATCHING PATTERN "*.py" PATTERN "__pycache__" EXCLUDE)
install(FILES README.md DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT runtime)
install(FILES LICENSE RENAME copyright DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT runtime)
install(DIRECTORY docs DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT runtime)

# find_package(Porosph): Porosph::solver and Porosph::run_folder; with COMPONENTS vtk_io Porosph::vtk_io too.
set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/Porosph)
install(TARGETS porosph_solver porosph_run_folder EXPORT PorosphTargets COMPONENT development)
install(EXPORT PorosphTargets NAMESPACE Porosph:: DESTINATION ${package_folder} COMPONENT development)
if(POROSPH_VTK)
  install(TARGETS porosph_vtk_io EXPORT PorosphVtkTargets COMPONENT development)
  install(EXPORT PorosphVtkTargets NAMESPACE Porosph:: DESTINATION ${package_folder} COMPONENT development)
endif()
install(DIRECTORY solver vtk_io DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/porosph COMPONENT development
        FILES_MATCHING PATTERN "*.hpp")
install(DIRECTORY examples DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT development)
configure_package_config_file(cmake/PorosphConfig.cmake.in ${CMAKE_BINARY_DIR}/PorosphConfig.cmake
                              INSTALL_DESTINATION ${package_folder})
write_basic_package_version_file(${CMAKE_BINARY_DIR}/PorosphConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/PorosphConfig.cmake ${CMAKE_BINARY_DIR}/PorosphConfigVersion.cmake
        DESTINATION ${package_folder} COMPONENT development)

# cpack: porosph_*.deb and porosph-dev_*.deb.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME porosph)
set(CPACK_PACKAGE_CONTACT "The Porosph authors <porosph@localhost>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL runtime development)
if(TARGET porosph_read_drawing)
  list(APPEND CPACK_COMPONENTS_ALL drawings)
endif()
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_NAME porosph)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SECTION science)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_DEPENDS fonts-dejavu-core)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SUGGESTS porosph-drawings)
set(CPACK_DEBIAN_DRAWINGS_PACKAGE_NAME porosph-drawings)
set(CPACK_DEBIAN_DRAWINGS_PACKAGE_SECTION science)
set(CPACK_DEBIAN_DRAWINGS_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_DRAWINGS_PACKAGE_DEPENDS porosph)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME porosph-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
    "libeigen3-dev, libboost-dev, libfmt-dev, libtomlplusplus-dev, nlohmann-json3-dev")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_RECOMMENDS libvtk9-dev)
set(CPACK_COMPONENT_RUNTIME_DESCRIPTION "Computes submerged foundations, embankments and slopes, writes particle series for ParaView and draws pictures.")
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION "Libraries of Porosph, for programs that add a material of their own.")
set(CPACK_COMPONENT_DRAWINGS_DESCRIPTION "Reads drawings (DXF, GeoJSON, CSV, WKT) for porosph import, by GDAL.")
include(CPack)
