#!/usr/bin/env bash
# Prints the table of docs/scenes.md, "What is lost on the way in". The program is build/hitpipe.
set -euo pipefail
cd "$(dirname "$0")/.."
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
awk 'BEGIN {
  srand(54)
  for (i = 0; i < 2000; ++i) {
    for (k = 0; k < 3; ++k) { a[k] = rand() - 0.5; along[k] = (rand() - 0.5) / 30; across[k] = (rand() - 0.5) * 2 ^ -(8 + i % 13) }
    printf "v %.9f %.9f %.9f\nv %.9f %.9f %.9f\n", a[0], a[1], a[2], a[0] + along[0], a[1] + along[1], a[2] + along[2]
    printf "v %.9f %.9f %.9f\nf -3 -2 -1\n", a[0] + across[0], a[1] + across[1], a[2] + across[2]
  }
}' > "$folder/slivers.obj"

# The cell of a CSV file's only row.
cell() { awk -F, -v name="$1" 'NR == 1 { for (i = 1; i <= NF; ++i) if ($i == name) at = i } NR == 2 { print $at }' <<<"$2"; }

echo '| scene | triangles | share of the cube, % | binary32 | n = 24 | 20 | 16 | 12 | 8 |'
echo '|---|--:|--:|--:|--:|--:|--:|--:|--:|'
for scene in spheres poppy statue city reading_room "$folder/slivers.obj"; do
  row=$(build/hitpipe bvh --scene "$scene" --format csv 2>/dev/null)
  lost=$(cell lost_to_rounding "$row")
  printf '| %s | %d | %.0f | %d |' "$(cell scene "$row")" $(($(cell triangles "$row") + lost)) \
    "$(cell mesh_share_of_cube_pct "$row")" "$lost"
  for n in 24 20 16 12 8; do
    row=$(build/hitpipe core image --scene "$scene" --bits "$n+1s$n" --format csv 2>/dev/null)
    printf ' %d |' "$(cell lost_to_rounding "$row")"
  done
  echo
done
echo
echo "By \`docs/losses.sh\`, $(build/hitpipe --version | head -n 1 | cut -d" " -f1,2)."
