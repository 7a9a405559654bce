#!/usr/bin/env bash
# Compiles the top function of every design in several formats as C++14 against a vendor's integers, and replays vectors
# of which half hit, corner operands included.
#   HITPIPE_VENDOR_AP_INT=DIR   a folder that holds a vendor's ap_int.h
#   HITPIPE_AC_TYPES=DIR        a folder that holds ac_types' ac_int.h
#   CXX, CXXFLAGS               the compiler (c++) and more options for it (-O1)
# usage: hls_check.sh PROGRAM SOURCE [VECTORS]   PROGRAM is build/hitpipe, SOURCE holds hls/; a million vectors unless given
set -euo pipefail
program=$1 source=$2 vectors=${3:-1000000}
if [ -z "${HITPIPE_VENDOR_AP_INT:-}${HITPIPE_AC_TYPES:-}" ]; then
  echo "skipped: HITPIPE_VENDOR_AP_INT names no folder with a vendor's ap_int.h, HITPIPE_AC_TYPES none with ac_int.h"
  exit 77
fi
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# check DESIGN BITS MODULE DEFINITION HEADERS
check() {
  local binary=$work/csim
  ${CXX:-c++} -std=c++14 -pedantic-errors ${CXXFLAGS:--O1} -D"$4" -isystem "$5" -I"$source" \
    "$work/rtl/hls/$3.cpp" "$work/rtl/hls/$3_csim.cpp" -o "$binary"
  printf '%-18s %-10s %-16s ' "$1" "$2" "$4"
  (cd "$work/rtl/tb" && "$binary" "$3_vectors.hex")
}

"$program" list designs --format csv | tail -n +2 | cut -d, -f1,2 | while IFS=, read -r design default; do
  case $default in
    */*) case $default in *+*) formats="$default 12+1/10 32+3/28" ;; *) formats="$default 24/24 16/16 6/6 32/63" ;; esac ;;
    *) formats=$default ;;
  esac
  for bits in $formats; do
    rm -rf "$work/rtl"
    "$program" rtl "$design" --bits "$bits" --hls --vectors "$vectors" --out "$work/rtl" >"$work/log"
    module=$(basename "$work"/rtl/*.v .v)
    if [ -n "${HITPIPE_VENDOR_AP_INT:-}" ]; then check "$design" "$bits" "$module" HITPIPE_VENDOR "$HITPIPE_VENDOR_AP_INT"; fi
    if [ -n "${HITPIPE_AC_TYPES:-}" ]; then check "$design" "$bits" "$module" HITPIPE_AC_TYPES "$HITPIPE_AC_TYPES"; fi
  done
done
