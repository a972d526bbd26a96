# Flags that every target of the project shares: porosph_flags(TARGET).
function(porosph_flags target)
  target_compile_features(${target} PUBLIC cxx_std_20)
  target_include_directories(${target} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>
                                              $<INSTALL_INTERFACE:include/porosph>)
  target_compile_options(${target} PRIVATE
    -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion -Wnon-virtual-dtor
    -Woverloaded-virtual
    # g++ 12 sees overlaps in std::string that are not there (GCC bug 105651)
    $<$<CXX_COMPILER_ID:GNU>:-Wduplicated-cond -Wlogical-op -Wno-restrict>
    $<$<BOOL:${POROSPH_WERROR}>:-Werror>
    $<$<CONFIG:Release>:-O3>
    $<$<BOOL:${POROSPH_COVERAGE}>:--coverage;-fprofile-update=atomic;-O1>
    -fno-math-errno -fno-trapping-math  # square roots and comparisons in vector code; no result changes
    $<$<BOOL:${POROSPH_NATIVE}>:-march=native>)
  target_link_options(${target} PUBLIC $<$<BOOL:${POROSPH_COVERAGE}>:--coverage>)
endfunction()

# Reads what most files include once for all files of a target, which saves two of the five seconds that a small file takes:
# porosph_precompile(TARGET). Not for the kernels, which are compiled for other vector units.
function(porosph_precompile target)
  target_precompile_headers(${target} PRIVATE
    <algorithm> <array> <cmath> <cstdint> <functional> <limits> <map> <memory> <numeric> <optional> <set> <span> <sstream>
    <stdexcept> <string> <string_view> <utility> <vector> <fmt/format.h> <Eigen/Core> <Eigen/Geometry>)
  # g++ 12 then reports overruns in std::string that are not there, as in the tests.
  target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-stringop-overflow;-Wno-array-bounds>)
endfunction()
