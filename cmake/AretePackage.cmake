# `cpack -G DEB` in a build folder: one Debian package of program, manual, driver, Python module and library.
#
# What the binaries need is found by dpkg-shlibdeps; what Python needs is stated, since no binary says it.
set(CPACK_PACKAGE_NAME arete)
set(CPACK_PACKAGE_VENDOR "Arete")
set(CPACK_PACKAGE_CONTACT "The Arete developers <arete@example.org>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "terrain and surfaces at every level of detail, with proof")
set(CPACK_DEBIAN_PACKAGE_DESCRIPTION
"Builds one multitriangulation of a digital elevation model or a triangle
mesh, and takes triangle meshes of any tolerance from it, with an error
that can be checked independently.

The package has the program arete, a driver by which GDAL and QGIS open its
files, the Python module arete, and the C++ library.")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_GENERATOR DEB)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
# The module is of one minor version of the interpreter.
set(CPACK_DEBIAN_PACKAGE_DEPENDS
    "python3 (>= ${ARETE_PYTHON_VERSION}), python3 (<< ${ARETE_NEXT_PYTHON_VERSION}~), python3-numpy")
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "gdal-bin, qgis, python3-xarray, python3-meshio")
set(CPACK_DEBIAN_PACKAGE_HOMEPAGE "")
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION TRUE)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
# What Debian asks of every package beside its files.
set(folder "${CMAKE_BINARY_DIR}/debian")
file(MAKE_DIRECTORY "${folder}")
execute_process(COMMAND gzip -9nc "${CMAKE_SOURCE_DIR}/cmake/debian/changelog" OUTPUT_FILE "${folder}/changelog.gz")
install(FILES "${CMAKE_SOURCE_DIR}/cmake/debian/copyright" "${folder}/changelog.gz"
        DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/arete")
include(CPack)
