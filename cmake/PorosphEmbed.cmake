# Builds a text file into a library: porosph_embed(TARGET NAME FILE) defines porosph::resources::NAME, a
# std::string_view of the whole file. The header that declares it is written by hand beside its users.
function(porosph_embed target name file)
  file(READ ${file} POROSPH_TEXT)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${file})
  set(source ${CMAKE_CURRENT_BINARY_DIR}/embedded/${name}.cpp)
  file(CONFIGURE OUTPUT ${source} @ONLY CONTENT [[
#include <string_view>

namespace porosph::resources {

extern const std::string_view @name@;
const std::string_view @name@ = R"resource(@POROSPH_TEXT@)resource";

}  // namespace porosph::resources
]])
  target_sources(${target} PRIVATE ${source})
endfunction()
