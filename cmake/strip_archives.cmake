# Run by cpack between the installation into its folder and the packages: static libraries keep neither what debuggers
# need nor the compiler's comments. (CPACK_STRIP_FILES strips programs and modules alone.)
find_program(STRIP strip REQUIRED)
file(GLOB_RECURSE archives "${CPACK_TEMPORARY_DIRECTORY}/*.a")
foreach(archive IN LISTS archives)
  execute_process(COMMAND "${STRIP}" --strip-debug --remove-section=.comment --remove-section=.note
                          --enable-deterministic-archives "${archive}" COMMAND_ERROR_IS_FATAL ANY)
endforeach()
