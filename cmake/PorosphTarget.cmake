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
