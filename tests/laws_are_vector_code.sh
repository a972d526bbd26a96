#!/usr/bin/env bash
# The step of every soil law has to run in whole vectors: the compiler says nothing where it gives up, and the law
# is then several times slower. Usage: laws_are_vector_code.sh AVX512_OBJECT...
set -euo pipefail
[ $# -gt 0 ] || { echo "no objects given" >&2; exit 2; }
objdump --disassemble --no-show-raw-insn --demangle "$@" | awk '
  /^[0-9a-f]+ <.*(material|interface)_step</ { name = $0; sub(/^[0-9a-f]+ </, "", name); sub(/\(porosph::[A-Z].*/, "", name); wide[name] += 0 }
  /^$/ { name = "" }
  name != "" && /zmm/ { ++wide[name] }
  END {
    for (name in wide) { ++count; if (wide[name] < 100) { ++scalar; print "not vector code: " name } }
    if (count < 8) { print "only " count + 0 " steps found"; exit 1 }
    exit scalar > 0
  }'
