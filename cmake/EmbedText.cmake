# arete_embed_text(OUTPUT NAMESPACE::FUNCTION HEADER FILES...): a source file that defines
# std::string_view FUNCTION(std::string_view name), the text of each file by its name; made again when one changes.
# The function is declared in HEADER.
function(arete_embed_text OUTPUT FUNCTION HEADER)
  set(entries "")
  foreach(file IN LISTS ARGN)
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${file}")
    file(READ "${file}" text)
    get_filename_component(name "${file}" NAME)
    string(APPEND entries "  if (name == \"${name}\") return R\"EMBEDDED(${text})EMBEDDED\";\n")
  endforeach()
  file(CONFIGURE OUTPUT "${OUTPUT}" @ONLY CONTENT
"// Made by cmake/EmbedText.cmake.
#include \"@HEADER@\"
std::string_view @FUNCTION@(std::string_view name) {
@entries@  return {};
}
")
endfunction()
