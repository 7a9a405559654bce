#!/usr/bin/env bash
# links.sh ROOT: every relative link and picture in README.md, CONTRIBUTING.md and docs/*.md is a file that is there.
set -euo pipefail
cd "$1"
wrong=0
links=0
for page in README.md CONTRIBUTING.md docs/*.md; do
  while read -r link; do
    links=$((links + 1))
    [[ -e $(dirname "$page")/$link ]] && continue
    echo "$page: $link: no such file"
    wrong=1
  done < <(grep -oE '\]\([^)]+' "$page" | sed 's/^](//; s/#.*//' | grep -vE '^(https?:|$)')
done
[[ $links -gt 100 ]] || { echo "only $links links were found"; wrong=1; }
exit $wrong
