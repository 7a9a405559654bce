#!/bin/sh
# Runs the compile command that makes one object file (-o FILE, last a source). An object of Verilator's own code is kept in
# $HITPIPE_CACHE by the command, the compiler and the source.
for source; do :; done
case $source in */include/verilated*.cpp) ;; *) exec "$@" ;; esac
output=$(echo " $*" | sed 's/.* -o \([^ ]*\).*/\1/')
kept=$HITPIPE_CACHE/testbench-$({ echo "$*"; "$1" --version; cat "$source"; } | cksum | tr ' ' -).o
[ -n "$HITPIPE_CACHE" ] || exec "$@"
if [ ! -f "$kept" ]; then
  "$@" && mkdir -p "$HITPIPE_CACHE" && cp "$output" "$kept.$$" && mv "$kept.$$" "$kept"
else
  cp "$kept" "$output"
fi
