# cmake -DVERSION=... -DPREFIX=... [-DSOURCE=...] -P instrumented_tbb.cmake: builds oneTBB with the thread sanitizer.
#
# Through a library that is not instrumented the sanitizer cannot see that a parallel loop ends before what follows it,
# and reports a race at every loop. Same version as the system's, so the tests need only find it first
# (LD_LIBRARY_PATH). SOURCE is a folder of its sources; without it they are fetched from Debian's archive, or from where
# oneTBB is published.
if(NOT SOURCE)
  set(code 1)
  foreach(url "https://deb.debian.org/debian/pool/main/o/onetbb/onetbb_${VERSION}.orig.tar.xz"
              "https://github.com/uxlfoundation/oneTBB/archive/refs/tags/v${VERSION}.tar.gz")
    if(code)
      file(DOWNLOAD "${url}" "${PREFIX}/source.tar" STATUS status INACTIVITY_TIMEOUT 60)
      list(GET status 0 code)
      if(code)
        message(STATUS "${url} cannot be fetched: ${status}")
      endif()
    endif()
  endforeach()
  if(code)
    message(FATAL_ERROR "the sources of oneTBB ${VERSION} cannot be fetched")
  endif()
  file(ARCHIVE_EXTRACT INPUT "${PREFIX}/source.tar" DESTINATION "${PREFIX}/source")
  file(GLOB SOURCE "${PREFIX}/source/oneTBB-*")
endif()

function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE code)
  if(code)
    message(FATAL_ERROR "failed: ${ARGN}")
  endif()
endfunction()

run("${CMAKE_COMMAND}" -S "${SOURCE}" -B "${PREFIX}/build" -G Ninja -Wno-dev
    -DCMAKE_CXX_COMPILER=clang++ -DCMAKE_BUILD_TYPE=RelWithDebInfo -DCMAKE_CXX_FLAGS=-fsanitize=thread "-DCMAKE_INSTALL_PREFIX=${PREFIX}"
    -DCMAKE_INSTALL_LIBDIR=lib -DTBB_TEST=OFF -DTBB_STRICT=OFF -DTBBMALLOC_BUILD=OFF)
run("${CMAKE_COMMAND}" --build "${PREFIX}/build" --target install)
