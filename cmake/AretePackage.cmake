# `cpack -G DEB` in a build folder (./dev package: that of the preset "package"): two Debian packages, arete (the component
# "program") and libarete-dev ("library").
#
# What the binaries need is found by dpkg-shlibdeps; what Python, and what a program that links the static libraries
# need, is stated, since no binary says it. The first entry of cmake/debian/changelog and CHANGELOG.md have the version of
# the project. The Maintainer is ARETE_CONTACT; without one lintian's complaints about that alone are overridden, by name.
set(ARETE_DEBIAN_REVISION 1)
foreach(file IN ITEMS cmake/debian/changelog CHANGELOG.md)
  file(READ "${CMAKE_SOURCE_DIR}/${file}" text)
  string(REGEX MATCH "(\narete|^arete|\n##) [(]?([0-9]+[.][0-9]+[.][0-9]+(-[0-9]+)?)" first "${text}")
  string(REGEX REPLACE "-[0-9]+$" "" version "${CMAKE_MATCH_2}")
  if(NOT version STREQUAL PROJECT_VERSION)
    message(FATAL_ERROR "The first release in ${file} is ${version}, and the project's version is ${PROJECT_VERSION}")
  endif()
endforeach()

set(CPACK_PACKAGE_NAME arete)
set(CPACK_PACKAGE_VENDOR "Arete")
set(CPACK_PACKAGE_CONTACT "${ARETE_CONTACT}")
if(NOT ARETE_CONTACT)
  set(CPACK_PACKAGE_CONTACT "The Arete developers <>")
endif()
# The first line of each package's description is its summary; CPack puts no other before it.
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "arete built using CMake")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_GENERATOR DEB)
set(CPACK_COMPONENTS_ALL program library)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE ${ARETE_DEBIAN_REVISION})
set(CPACK_DEBIAN_PACKAGE_SOURCE arete)
set(CPACK_DEBIAN_PACKAGE_HOMEPAGE "${ARETE_TRACKER_URL}")
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION TRUE)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_PRE_BUILD_SCRIPTS "${CMAKE_SOURCE_DIR}/cmake/strip_binaries.cmake")

set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME arete)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PROGRAM_DESCRIPTION
"terrain and surfaces at every level of detail, with proof
Builds one multitriangulation of a digital elevation model or a triangle
mesh, and takes triangle meshes of any tolerance from it, with an error
that can be checked independently.

The package has the programs arete and arete-datasets, a driver by which
GDAL and QGIS open its files, a plugin of QGIS, the Python module arete,
and the pages of the documentation.")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
# The module is of one minor version of the interpreter; the driver's is that of libgdal, which dpkg-shlibdeps names. The
# viewer opens OpenGL's libraries by their names, which no tool sees, and draws in software where there is no graphics card.
set(CPACK_DEBIAN_PROGRAM_PACKAGE_DEPENDS
    "libegl1, libgl1, libgl1-mesa-dri, python3 (>= ${ARETE_PYTHON_VERSION}), python3 (<< ${ARETE_NEXT_PYTHON_VERSION}~), python3-numpy")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS "ca-certificates")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS
    "gdal-bin, libarete-dev, qgis, python3-geopandas, python3-matplotlib, python3-meshio, python3-xarray")

# What AreteConfig.cmake looks for, the libraries that the static ones link, and what builds a program at once, also where
# apt installs no recommended packages. The libraries are compiled with GDAL's headers:
# a libgdal-dev of another minor version has another ABI.
string(REGEX MATCH "^[0-9]+[.][0-9]+" gdal "${GDAL_VERSION}")
string(REGEX MATCH "[0-9]+$" minor "${gdal}")
math(EXPR next "${minor} + 1")
string(REGEX REPLACE "[0-9]+$" "${next}" next "${gdal}")
set(CPACK_DEBIAN_LIBRARY_PACKAGE_NAME libarete-dev)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_LIBRARY_DESCRIPTION
"terrain and surfaces at every level of detail (development files)
Builds one multitriangulation of a digital elevation model or a triangle
mesh, and takes triangle meshes of any tolerance from it, with an error
that can be checked independently.

The package has the headers and the static libraries of the C++ library,
what find_package(Arete) reads, and examples.")
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SHLIBDEPS OFF)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_DEPENDS
    "libcurl4-gnutls-dev | libcurl-dev, libdraco-dev, libembree-dev (>= 3), libembree-dev (<< 4~), libexpected-dev, libfmt-dev"
    "libgdal-dev (>= ${gdal}), libgdal-dev (<< ${next}~), libgeographiclib-dev, libgmp-dev, libmeshoptimizer-dev"
    "libmpfr-dev, libproj-dev, libsqlite3-dev, libtbb-dev, pkg-config, cmake, g++, make | ninja-build")
list(JOIN CPACK_DEBIAN_LIBRARY_PACKAGE_DEPENDS ", " CPACK_DEBIAN_LIBRARY_PACKAGE_DEPENDS)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SUGGESTS "arete")
# Up to 0.1 the package arete had the library too.
set(CPACK_DEBIAN_LIBRARY_PACKAGE_BREAKS "arete (<< 0.2.0~)")
set(CPACK_DEBIAN_LIBRARY_PACKAGE_REPLACES "arete (<< 0.2.0~)")

# What Debian asks of every package beside its files.
set(folder "${CMAKE_BINARY_DIR}/debian")
set(ARETE_MAINTAINER "${CPACK_PACKAGE_CONTACT}")
file(REMOVE_RECURSE "${folder}")
configure_file(cmake/debian/changelog "${folder}/changelog" @ONLY)
configure_file(cmake/debian/copyright "${folder}/copyright" @ONLY)
execute_process(COMMAND gzip -9nc "${folder}/changelog" OUTPUT_FILE "${folder}/changelog.Debian.gz")
execute_process(COMMAND gzip -9nc "${CMAKE_SOURCE_DIR}/CHANGELOG.md" OUTPUT_FILE "${folder}/changelog.gz")
set(ARETE_BYTECODE_FOLDERS "/usr/lib/python3/dist-packages/arete /usr/share/qgis/python/plugins/arete")
foreach(script IN ITEMS postinst prerm)
  configure_file(cmake/debian/${script} "${folder}/${script}" @ONLY FILE_PERMISSIONS
    OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
endforeach()
set(CPACK_DEBIAN_PROGRAM_PACKAGE_CONTROL_EXTRA "${folder}/postinst;${folder}/prerm")
foreach(component IN ITEMS program library)
  string(TOUPPER ${component} upper)
  set(package "${CPACK_DEBIAN_${upper}_PACKAGE_NAME}")
  install(FILES "${folder}/copyright" "${folder}/changelog.Debian.gz" "${folder}/changelog.gz"
          DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/${package}" COMPONENT ${component})
  set(overrides "")
  if(EXISTS "${CMAKE_SOURCE_DIR}/cmake/debian/${package}.lintian-overrides")
    file(READ "${CMAKE_SOURCE_DIR}/cmake/debian/${package}.lintian-overrides" overrides)
  endif()
  if(NOT ARETE_CONTACT)
    file(READ "${CMAKE_SOURCE_DIR}/cmake/debian/no-contact.lintian-overrides" more)
    string(APPEND overrides "${more}")
  endif()
  if(overrides)
    string(REPLACE "@PACKAGE@" "${package}" overrides "${overrides}")
    file(WRITE "${folder}/lintian/${package}" "${overrides}")
    install(FILES "${folder}/lintian/${package}" DESTINATION "${CMAKE_INSTALL_DATADIR}/lintian/overrides"
            COMPONENT ${component})
  endif()
endforeach()
# The pages name each other by their paths from the root.
install(FILES README.md DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/arete")
install(DIRECTORY docs DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/arete" FILES_MATCHING PATTERN "*.md" PATTERN "*.png"
        PATTERN "docs/decisions" EXCLUDE PATTERN "docs/site" EXCLUDE)
install(DIRECTORY examples DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/libarete-dev" COMPONENT library)
include(CPack)
