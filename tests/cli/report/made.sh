#!/bin/sh
# A report, made anew: made.sh PROGRAM FOLDER
set -eu
rm -rf "$2"
exec "$1" report int_slabs,int_major_pair,fp_slabs --scene spheres --width 16 --height 16 --bits 6/6,12+1/10 --tests 600 --out "$2"
