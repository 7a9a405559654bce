#!/usr/bin/env bash
# Makes the tables of docs/measured/stiffness.md and its plot again: docs/stiffness.sh [PROGRAM [FOLDER]], where FOLDER holds
# stiffness.md.
# A test runs it and compares the tables, and the rows that the plot shows, with what is kept.
set -euo pipefail
program=${1:-build/hitpipe}
folder=${2:-docs/measured}
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT
"$program" check --stiff --scene spheres int_slabs,int_plucker --out "$out" --format csv >/dev/null 2>&1
cp "$out/stiffness.svg" "$out/stiffness.csv" "$folder"

# table WHAT: rows by ratio, columns by design and format, with the columns of the CSV by their names. The kinds of box of a
# ratio are added up, as the command does in text.
table() {
  awk -F, -v what="$1" '
    NR == 1 { for (i = 1; i <= NF; ++i) at[$i] = i; next }
    { bits = $at["bits"]; sub(/^n/, "", bits); unit = $at["design"] " " bits
      ratio = $at["log2_ratio"] == "inf" ? "zero" : "2^" $at["log2_ratio"]
      if (!(unit in seen_unit)) { seen_unit[unit] = 1; units[++n_units] = unit }
      if (!(ratio in seen_ratio)) { seen_ratio[ratio] = 1; ratios[++n_ratios] = ratio }
      key = ratio SUBSEP unit
      if ($at["rays"] == "") { misses[key] += $at["tests"] - $at["exact_hits"]; false_hits[key] += $at["false_hits"] }
      else { extra[key] = $at["extra_box_tests_pct"]; half[key] = ($at["extra_box_tests_pct_high"] - $at["extra_box_tests_pct_low"]) / 2 } }
    END {
      header = "| ratio |"; line = "|---|"
      for (u = 1; u <= n_units; ++u) {
        split(units[u], name, " ")
        header = header " " (name[1] == design ? name[2] : units[u]) " |"; line = line "--:|"; design = name[1]
      }
      print header; print line
      for (r = 1; r <= n_ratios; ++r) {
        exponent = substr(ratios[r], 3) + 0
        if (ratios[r] ~ /^2/ && (exponent == 2 || (exponent > 24 && exponent % 8))) continue
        text = "| " ratios[r] " |"
        for (u = 1; u <= n_units; ++u) {
          key = ratios[r] SUBSEP units[u]
          if (what == "boxes") text = text sprintf(" %.3f |", 100 * false_hits[key] / misses[key])
          else text = text sprintf(extra[key] < 100 ? " %.2f ± %.2f |" : " %.0f ± %.0f |", extra[key], half[key])
        }
        print text
      }
    }' "$out/stiffness.csv"
}
for what in boxes traversals; do
  table "$what" >"$out/$what.md"
  awk -v what="$what" -v table="$out/$what.md" '
    $0 == "<!-- " what " -->" { print; print ""; while ((getline row < table) > 0) print row; print ""; skip = 1; next }
    $0 == "<!-- end of " what " -->" { skip = 0 }
    !skip { print }' "$folder/stiffness.md" >"$out/page.md"
  cp "$out/page.md" "$folder/stiffness.md"
done
