# arete_layer(PATH [PUBLIC ...] [PRIVATE ...] [ROOMS ...] | SOURCES ...): one layer of the house, made of rooms (its
# sub-folders) or of files. PATH is its folder; the target of io/geo is arete::io_geo.
#
# A layer may include the layers it links and nothing else: each layer's headers are reached through an include folder
# of its own in the build tree (build/.../include/io_geo/io/geo -> source/io/geo), so that an include of a layer that
# is not linked does not compile.
#
# arete_room(PATH MAY_INCLUDE ... [HEADERS ...] SOURCES ... [CGAL_SOURCES ...]), in PATH/CMakeLists.txt: one room.
#
# MAY_INCLUDE names the rooms, of its own layer and of those below, whose headers its files may include; tests/house
# walks all includes and fails on any other (rooms.txt in the build folder is what it reads). HEADERS are public: part of
# the library that others install (cmake/AreteInstall.cmake). What they include is installed with them; a header that is
# not listed may change at any time. A room belongs to the nearest layer above it, or to the LAYER it names. CGAL_SOURCES
# are compiled with the flags that CGAL requires, of which -frounding-math would slow down everything else.

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}")

option(ARETE_PRECOMPILE "Precompile the headers that most files include" ON)
option(ARETE_UNITY "Compile each room as one unit: the fastest where all is built, the slowest where one file changes" OFF)
find_program(CCACHE_PROGRAM ccache)
if(CCACHE_PROGRAM)
  # The sloppiness and -fpch-preprocess are required by ccache where headers are precompiled.
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env CCACHE_SLOPPINESS=pch_defines,time_macros "${CCACHE_PROGRAM}")
  if(ARETE_PRECOMPILE AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    add_compile_options(-fpch-preprocess)
  endif()
endif()

# GCC 12 forgets, of what it reads precompiled, that a header is the system's, and warns of std::string.
function(arete_quiet_precompiled TARGET)
  target_compile_options(${TARGET} PRIVATE
    "$<$<CXX_COMPILER_ID:GNU>:-Wno-array-bounds;-Wno-restrict;-Wno-stringop-overflow;-Wno-stringop-overread>")
endfunction()

# arete_precompile(TARGET HEADERS...): the standard headers that most files include, precompiled once for all layers;
# where HEADERS are named, precompiled with them. Files still include what they use: the sanitized builds and the
# fuzzers do without (CMakePresets.json).
function(arete_precompile TARGET)
  if(NOT ARETE_PRECOMPILE)
    return()
  endif()
  if(NOT "${ARGN}" STREQUAL "" OR "${TARGET}" STREQUAL "arete_headers")
    target_precompile_headers(${TARGET} PRIVATE
      <algorithm> <array> <atomic> <cmath> <cstdint> <filesystem> <functional> <limits> <memory> <numeric> <optional>
      <span> <string> <string_view> <utility> <vector> <fmt/format.h> <tl/expected.hpp> <tbb/blocked_range.h>
      <tbb/parallel_for.h> ${ARGN})
  else()
    target_precompile_headers(${TARGET} REUSE_FROM arete_headers)
  endif()
  arete_quiet_precompiled(${TARGET})
endfunction()

add_library(arete_options INTERFACE)
target_compile_options(arete_options INTERFACE
  -Wall -Wextra -Wnon-virtual-dtor -Wcast-qual -Woverloaded-virtual
  # (a < b) | (c < d) computes both sides without a branch, on purpose.
  $<$<CXX_COMPILER_ID:Clang>:-Wno-bitwise-instead-of-logical>
  # The same numbers on every machine: no contraction of a*b+c into a fused operation.
  -ffp-contract=off)
if(ARETE_UNITY)
  # GCC takes the .cpp file that a unit includes for a header, whose classes must not have members of a type in an
  # unnamed namespace.
  target_compile_options(arete_options INTERFACE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
  # A program takes whole rooms from a library then; the linker leaves out the functions that it does not call.
  target_compile_options(arete_options INTERFACE -ffunction-sections -fdata-sections)
  target_link_options(arete_options INTERFACE -Wl,--gc-sections)
else()
  # In a unit of several files a name may well be another file's too.
  target_compile_options(arete_options INTERFACE -Wshadow)
endif()
if(ARETE_WERROR)
  target_compile_options(arete_options INTERFACE -Werror)
endif()
if(ARETE_SANITIZE)
  target_compile_options(arete_options INTERFACE -fsanitize=${ARETE_SANITIZE} -fno-omit-frame-pointer -g1)
  target_link_options(arete_options INTERFACE -fsanitize=${ARETE_SANITIZE})
  if(ARETE_SANITIZE MATCHES "address")
    set(program "$<STREQUAL:$<TARGET_PROPERTY:TYPE>,EXECUTABLE>")
    target_sources(arete_options INTERFACE "$<${program}:${CMAKE_SOURCE_DIR}/cmake/keep_libraries.cpp>")
    target_link_options(arete_options INTERFACE "$<${program}:-Wl,--export-dynamic-symbol=dlclose>")
  endif()
endif()
if(ARETE_FUZZ)
  if(NOT CMAKE_CXX_COMPILER_ID MATCHES "Clang")
    message(FATAL_ERROR "ARETE_FUZZ needs clang, whose libFuzzer it uses: cmake --preset asan")
  endif()
  # fuzzer-no-link: every layer tells the fuzzer which of its branches an input took.
  target_compile_options(arete_options INTERFACE -fsanitize=fuzzer-no-link -fno-sanitize-recover=all)
endif()

function(arete_include_root LAYER)
  string(REPLACE "/" "_" name "${LAYER}")
  set(root "${CMAKE_BINARY_DIR}/include/${name}")
  get_filename_component(above "${root}/${LAYER}" DIRECTORY)
  file(MAKE_DIRECTORY "${above}")
  file(CREATE_LINK "${CMAKE_SOURCE_DIR}/${LAYER}" "${root}/${LAYER}" SYMBOLIC)
  set(ARETE_INCLUDE_ROOT "${root}" PARENT_SCOPE)
endfunction()

set_property(GLOBAL PROPERTY ARETE_ROOMS "")
set_property(GLOBAL PROPERTY ARETE_LAYERS "")

macro(arete_layer PATH)
  arete_include_root(${PATH})
  arete_add_layer(${PATH} ${ARGN})
endmacro()

function(arete_add_layer PATH)
  cmake_parse_arguments(ARG "" "" "ROOMS;SOURCES;PUBLIC;PRIVATE" ${ARGN})
  string(REPLACE "/" "_" name "${PATH}")
  set_property(GLOBAL APPEND PROPERTY ARETE_LAYERS "${PATH}")
  add_library(arete_${name} STATIC ${ARG_SOURCES})
  add_library(arete::${name} ALIAS arete_${name})
  target_include_directories(arete_${name} PUBLIC "$<BUILD_INTERFACE:${ARETE_INCLUDE_ROOT}>")
  target_compile_features(arete_${name} PUBLIC cxx_std_20)
  target_link_libraries(arete_${name} PUBLIC ${ARG_PUBLIC} PRIVATE $<BUILD_INTERFACE:arete_options> ${ARG_PRIVATE})
  # A unit of each room takes two thirds of the time of one of each file (arete_room sets the groups).
  set_target_properties(arete_${name} PROPERTIES UNITY_BUILD "${ARETE_UNITY}" UNITY_BUILD_MODE GROUP)
  foreach(room IN LISTS ARG_ROOMS)
    add_subdirectory(${room})
  endforeach()
endfunction()

function(arete_room PATH)
  cmake_parse_arguments(ARG "" "LAYER" "MAY_INCLUDE;HEADERS;SOURCES;CGAL_SOURCES" ${ARGN})
  set(layer "${ARG_LAYER}")
  if(NOT layer)
    set(layer "${PATH}")
    get_property(layers GLOBAL PROPERTY ARETE_LAYERS)
    while(NOT layer IN_LIST layers)
      get_filename_component(layer "${layer}" DIRECTORY)
    endwhile()
  endif()
  string(REPLACE "/" "_" layer "${layer}")
  if(ARG_SOURCES)
    list(TRANSFORM ARG_SOURCES PREPEND "${CMAKE_CURRENT_SOURCE_DIR}/")
    target_sources(arete_${layer} PRIVATE ${ARG_SOURCES})
    set_source_files_properties(${ARG_SOURCES} TARGET_DIRECTORY arete_${layer} PROPERTIES UNITY_GROUP "${PATH}")
  endif()
  if(ARG_CGAL_SOURCES)
    # CGAL's flags are those of a top layer's part of its own.
    string(REGEX REPLACE "(.*io/formats|[a-z]+).*" "\\1" cgal "${PATH}")
    string(REPLACE "/" "_" cgal "${cgal}")
    list(TRANSFORM ARG_CGAL_SOURCES PREPEND "${CMAKE_CURRENT_SOURCE_DIR}/")
    target_sources(arete_${cgal}_cgal PRIVATE ${ARG_CGAL_SOURCES})
  endif()
  string(REPLACE ";" " " may_include "${ARG_MAY_INCLUDE}")
  set_property(GLOBAL APPEND PROPERTY ARETE_ROOMS "${PATH}: ${may_include}")
  if(ARG_HEADERS)
    list(TRANSFORM ARG_HEADERS PREPEND "${PATH}/")
    set_property(GLOBAL APPEND PROPERTY ARETE_PUBLIC_HEADERS ${ARG_HEADERS})
  endif()
endfunction()

# Once all rooms are declared: build/rooms.txt has a line for each, "room: rooms it may include".
function(arete_write_rooms)
  get_property(rooms GLOBAL PROPERTY ARETE_ROOMS)
  list(JOIN rooms "\n" text)
  file(WRITE "${CMAKE_BINARY_DIR}/rooms.txt" "${text}\n")
endfunction()
