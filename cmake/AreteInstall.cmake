# What `cmake --install` leaves behind: the program, and Arete as a library.
#
#   bin/arete
#   lib/libarete_{engine,surface,terrain,io_store,...}.a the layers of the library
#   include/arete/<room>/<header>.h         users write #include <arete/engine/cut/cut.h>
#   include/arete/arete.h                   the face of the library: io/query/face/arete.h
#   lib/cmake/Arete/                        find_package(Arete) gives Arete::arete, Arete::engine, Arete::surface, Arete::terrain, Arete::io
#
# In the source tree headers include each other as "engine/cut/cut.h"; on the way to include/arete that becomes
# "arete/engine/cut/cut.h" (install_headers.cmake), so that no folder named engine or io gets into anybody's include path.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set_property(GLOBAL PROPERTY ARETE_PUBLIC_HEADERS "")

function(arete_install_layer NAME)
  set_target_properties(arete_${NAME} PROPERTIES EXPORT_NAME ${NAME})
  install(TARGETS arete_${NAME} EXPORT AreteTargets ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}"
          INCLUDES DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}")
endfunction()

# Once all layers are declared.
function(arete_install_library)
  get_property(headers GLOBAL PROPERTY ARETE_PUBLIC_HEADERS)
  install(CODE "
    set(ARETE_SOURCE \"${CMAKE_SOURCE_DIR}\")
    set(ARETE_STAGE \"${CMAKE_BINARY_DIR}/install_headers\")
    set(ARETE_DESTINATION \"${CMAKE_INSTALL_INCLUDEDIR}/arete\")
    set(ARETE_HEADERS \"${headers}\")")
  install(SCRIPT "${CMAKE_SOURCE_DIR}/cmake/install_headers.cmake")
  # The face of the library has a short name.
  file(WRITE "${CMAKE_BINARY_DIR}/arete.h" "#pragma once\n#include \"arete/io/query/face/arete.h\"  // IWYU pragma: export\n")
  install(FILES "${CMAKE_BINARY_DIR}/arete.h" DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/arete")
  install(TARGETS arete RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}")

  set(package "${CMAKE_INSTALL_LIBDIR}/cmake/Arete")
  install(EXPORT AreteTargets NAMESPACE Arete:: DESTINATION "${package}")
  configure_package_config_file("${CMAKE_SOURCE_DIR}/cmake/AreteConfig.cmake.in" "${CMAKE_BINARY_DIR}/AreteConfig.cmake"
                                INSTALL_DESTINATION "${package}")
  # Before 1.0 a minor version may change anything.
  write_basic_package_version_file("${CMAKE_BINARY_DIR}/AreteConfigVersion.cmake" COMPATIBILITY SameMinorVersion)
  install(FILES "${CMAKE_BINARY_DIR}/AreteConfig.cmake" "${CMAKE_BINARY_DIR}/AreteConfigVersion.cmake"
          DESTINATION "${package}")
endfunction()
