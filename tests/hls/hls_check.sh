#!/usr/bin/env bash
# Compiles the top function of every design in several formats as C++14 against a vendor's integers, and replays vectors
# of which half hit, corner operands included. Where Bambu is found, it makes Verilog of each design at its default format,
# and the Verilog is simulated too.
#   HITPIPE_VENDOR_AP_INT=DIR   a folder that holds a vendor's ap_int.h
#   HITPIPE_AC_TYPES=DIR        a folder that holds ac_types' ac_int.h
#   CXX, CXXFLAGS               the compiler (c++) and more options for it (-O1)
#   BAMBU_VECTORS               vectors for Bambu's Verilog, 6,000 unless given: its simulation is slow
# usage: hls_check.sh PROGRAM SOURCE [VECTORS]   PROGRAM is build/hitpipe, SOURCE holds hls/; a million vectors unless given
set -euo pipefail
program=$1 source=$2 vectors=${3:-1000000}
headers=${HITPIPE_VENDOR_AP_INT:-}${HITPIPE_AC_TYPES:-}
bambu=$(command -v bambu || true)
if [ -z "$headers$bambu" ]; then
  echo "skipped: HITPIPE_VENDOR_AP_INT names no folder with a vendor's ap_int.h, HITPIPE_AC_TYPES none with ac_int.h, and" \
    "there is no bambu"
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

# bambu_check DESIGN BITS
bambu_check() {
  rm -rf "$work/bambu"
  "$program" rtl "$1" --bits "$2" --hls --vectors "${BAMBU_VECTORS:-6000}" --out "$work/bambu" >"$work/log"
  if ! INCLUDE=$source PROJECT=$work/bambu/project "$work"/bambu/hls/*_bambu.sh >"$work/log" 2>&1; then
    cat "$work/log" >&2
    echo "$1 $2: Bambu stopped, or its Verilog answers otherwise" >&2
    exit 1
  fi
  printf '%-18s %-10s %-16s %s\n' "$1" "$2" Bambu "$(tail -n 1 "$work/log")"
}

"$program" list designs --format csv | tail -n +2 | cut -d, -f1,2 | while IFS=, read -r design default; do
  default=${default#n}
  case $default in
    */*) case $default in *+*) formats="$default 12+1/10 32+3/28" ;; *) formats="$default 24/24 16/16 6/6 32/63" ;; esac ;;
    *+*) formats="$default ${default}b1c1 ${default}c2" ;;
    *) formats=$default ;;
  esac
  if [ -n "$bambu" ]; then bambu_check "$design" "$default"; fi
  if [ -z "$headers" ]; then continue; fi
  for bits in $formats; do
    rm -rf "$work/rtl"
    "$program" rtl "$design" --bits "$bits" --hls --vectors "$vectors" --out "$work/rtl" >"$work/log"
    module=$(basename "$work"/rtl/*.v .v)
    if [ -n "${HITPIPE_VENDOR_AP_INT:-}" ]; then check "$design" "$bits" "$module" HITPIPE_VENDOR "$HITPIPE_VENDOR_AP_INT"; fi
    if [ -n "${HITPIPE_AC_TYPES:-}" ]; then check "$design" "$bits" "$module" HITPIPE_AC_TYPES "$HITPIPE_AC_TYPES"; fi
  done
done
