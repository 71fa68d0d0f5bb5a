# What `cmake --install` leaves behind: the program, and Arete as a library.
#
#   bin/arete, bin/arete-datasets
# and, as the component "library" (cmake --install ... --component library):
#
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
  install(TARGETS arete_${NAME} EXPORT AreteTargets
          ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT library INCLUDES DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}")
  set_property(GLOBAL APPEND PROPERTY ARETE_LIBRARY_TARGETS arete_${NAME})
endfunction()

# Once all layers are declared.
function(arete_install_library)
  get_property(headers GLOBAL PROPERTY ARETE_PUBLIC_HEADERS)
  # All that is installed of the library, without a test.
  get_property(layers GLOBAL PROPERTY ARETE_LIBRARY_TARGETS)
  add_custom_target(arete_library DEPENDS ${layers})
  install(CODE "
    set(ARETE_SOURCE \"${CMAKE_SOURCE_DIR}\")
    set(ARETE_STAGE \"${CMAKE_BINARY_DIR}/install_headers\")
    set(ARETE_DESTINATION \"${CMAKE_INSTALL_INCLUDEDIR}/arete\")
    set(ARETE_HEADERS \"${headers}\")" COMPONENT library)
  install(SCRIPT "${CMAKE_SOURCE_DIR}/cmake/install_headers.cmake" COMPONENT library)
  # The face of the library has a short name.
  file(WRITE "${CMAKE_BINARY_DIR}/arete.h" "#pragma once\n#include \"arete/io/query/face/arete.h\"  // IWYU pragma: export\n")
  install(FILES "${CMAKE_BINARY_DIR}/arete.h" DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/arete" COMPONENT library)
  install(TARGETS arete arete-datasets RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}")

  set(package "${CMAKE_INSTALL_LIBDIR}/cmake/Arete")
  install(EXPORT AreteTargets NAMESPACE Arete:: DESTINATION "${package}" COMPONENT library)
  configure_package_config_file("${CMAKE_SOURCE_DIR}/cmake/AreteConfig.cmake.in" "${CMAKE_BINARY_DIR}/AreteConfig.cmake"
                                INSTALL_DESTINATION "${package}")
  # Before 1.0 a minor version may change anything.
  write_basic_package_version_file("${CMAKE_BINARY_DIR}/AreteConfigVersion.cmake" COMPATIBILITY SameMinorVersion)
  install(FILES "${CMAKE_BINARY_DIR}/AreteConfig.cmake" "${CMAKE_BINARY_DIR}/AreteConfigVersion.cmake"
          DESTINATION "${package}" COMPONENT library)
endfunction()
