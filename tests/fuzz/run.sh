#!/bin/sh
# run.sh FOLDER SECONDS: runs every *_fuzz of FOLDER, SECONDS in all, from the seeds beside this script, those in FOLDER/seeds
# and what earlier runs found. SEED=n (1) draws other inputs: with one seed a fresh folder sees the same inputs each time, as far as
# the seconds last. One line a target. Fails on a crash, a leak, a time-out, or a target that did not run; the input that did it
# is kept.
set -eu
seeds=$(cd "$(dirname "$0")" && pwd)/seeds
folder=$1
seconds=$2
cd "$folder"
targets=$(echo *_fuzz)
count=$(echo "$targets" | wc -w)
each=$((seconds / count))
[ "$each" -gt 0 ] || each=1
failed=0
printf '%-14s %9s %8s  %s\n' target runs seconds result
for target in $targets; do
  name=${target%_fuzz}
  mkdir -p "corpus/$name"
  set -- "corpus/$name"
  for found in "seeds/$name" "$seeds/$name"; do [ ! -d "$found" ] || set -- "$@" "$found"; done
  begin=$(date +%s)
  result=ok
  "./$target" -seed="${SEED:-1}" -max_total_time="$each" -timeout=100 -rss_limit_mb=2048 -print_final_stats=1 -artifact_prefix="$name-" \
    "$@" >"$name.log" 2>&1 || result="FAILED, see $folder/$name.log"
  runs=$(sed -n 's/^stat::number_of_executed_units: *//p' "$name.log")
  if [ "$result" = ok ] && [ "${runs:-0}" -lt 5 ]; then
    result="FAILED, too few runs"
  fi
  [ "$result" = ok ] || failed=1
  printf '%-14s %9s %8s  %s\n' "$name" "${runs:-0}" $(($(date +%s) - begin)) "$result"
done
exit $failed
