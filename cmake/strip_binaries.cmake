# Run by cpack between the installation into its folder and the packages: no binary keeps the compiler's comments, and
# static libraries keep nothing for debuggers. (CPACK_STRIP_FILES has stripped programs and modules of the latter.)
find_program(STRIP strip REQUIRED)
file(GLOB_RECURSE archives "${CPACK_TEMPORARY_DIRECTORY}/*.a")
file(GLOB_RECURSE programs "${CPACK_TEMPORARY_DIRECTORY}/*.so" "${CPACK_TEMPORARY_DIRECTORY}/*/usr/bin/*")
set(sections --remove-section=.comment --remove-section=.note)
foreach(archive IN LISTS archives)
  execute_process(COMMAND "${STRIP}" --strip-debug ${sections} --enable-deterministic-archives "${archive}"
                  COMMAND_ERROR_IS_FATAL ANY)
endforeach()
foreach(program IN LISTS programs)
  execute_process(COMMAND "${STRIP}" ${sections} "${program}" COMMAND_ERROR_IS_FATAL ANY)
endforeach()
