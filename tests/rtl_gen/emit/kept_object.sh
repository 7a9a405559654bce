#!/bin/sh
# Runs the compile command that makes one object file (OPTIONS -c -o FILE SOURCE). $HITPIPE_CACHE keeps objects of Verilator's own
# code, and its header compiled, by the command, the compiler and the source.
[ -n "$HITPIPE_CACHE" ] || exec "$@"
for source; do :; done
key() { { echo "$1"; "${1%% *}" --version; cat "$2"; } | cksum | tr ' ' -; }
case $source in
  */include/verilated*.cpp)
    output=$(echo " $*" | sed 's/.* -o \([^ ]*\).*/\1/')
    kept=$HITPIPE_CACHE/testbench-$(key "$*" "$source").o
    if [ ! -f "$kept" ]; then
      "$@" && mkdir -p "$HITPIPE_CACHE" && cp "$output" "$kept.$$" && mv "$kept.$$" "$kept"
    else
      cp "$kept" "$output"
    fi
    ;;
  *)
    command=$*
    options=${command%% -c -o *}
    root=$(echo " $options" | sed 's/.* -I\([^ ]*include\) .*/\1/')
    header=$HITPIPE_CACHE/testbench-$(key "$options" "$root/verilated.h").h
    if [ ! -f "$header.gch" ]; then
      mkdir -p "$HITPIPE_CACHE"
      # Without the compiled one this is the header, too.
      echo '#include "verilated.h"' >"$header.$$" && mv "$header.$$" "$header"
      # shellcheck disable=SC2086 # these are words
      $options -MF /dev/null -x c++-header "$header" -o "$header.$$" && mv "$header.$$" "$header.gch"
    fi
    exec "$@" -include "$header"
    ;;
esac
