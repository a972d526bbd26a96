# Which vector units the hot loops are compiled for, besides those of any x86-64 machine: dispatch_avx2 and
# dispatch_avx512 are set to their flags, POROSPH_CPU_LEVELS to whether the compiler can ask a processor for
# x86-64-v3 and -v4. Where it cannot (clang 14), both flags and questions name the units one by one. Turns
# POROSPH_DISPATCH off where the compiler has neither.
include(CheckCXXCompilerFlag)
include(CheckCXXSourceCompiles)

check_cxx_source_compiles("int main() { return __builtin_cpu_supports(\"x86-64-v4\") != 0; }" POROSPH_CPU_LEVELS)
if(POROSPH_CPU_LEVELS)
  set(dispatch_avx2 -march=x86-64-v3)
  set(dispatch_avx512 -march=x86-64-v4)
else()
  set(dispatch_avx2 -mavx2 -mfma -mbmi -mbmi2)
  set(dispatch_avx512 ${dispatch_avx2} -mavx512f -mavx512bw -mavx512cd -mavx512dq -mavx512vl)
endif()
list(APPEND dispatch_avx512 -mprefer-vector-width=512)
list(JOIN dispatch_avx512 " " flags)
check_cxx_compiler_flag("${flags}" POROSPH_HAS_VECTOR_FLAGS)
if(NOT POROSPH_HAS_VECTOR_FLAGS)
  message(STATUS "This compiler does not know ${flags}: POROSPH_DISPATCH is off")
  set(POROSPH_DISPATCH OFF)
endif()
