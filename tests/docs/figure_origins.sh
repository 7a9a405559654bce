#!/usr/bin/env bash
# figure_origins.sh ROOT: in docs/figures.md every page and script is there, every row of the slow figures has a commit, and that
# commit is one of this history. Without the history (an archive, a shallow clone) commits are not looked up.
set -euo pipefail
cd "$1"
page=docs/figures.md
wrong=0
say() {
  echo "$page: $1"
  wrong=1
}

while read -r link; do
  [[ -e docs/$link ]] || say "$link: no such page"
done < <(grep -oE '\]\([^)]+\)' "$page" | sed 's/^](//; s/)$//')
while read -r script; do
  [[ -x $script ]] || say "$script: no such script"
done < <(grep -oE '(docs|bench)/[A-Za-z0-9_]+\.(sh|py)|area_model/measure/[a-z]+(\.py)?' "$page" | sort -u)

history=
if git rev-parse --verify --quiet HEAD >/dev/null && [[ $(git rev-parse --is-shallow-repository) == false ]]; then history=yes; fi
rows=0
while IFS= read -r row; do
  rows=$((rows + 1))
  if [[ ! $row =~ \|\ ([0-9a-f]{7,})(\ \*)?\ \|$ ]]; then
    say "no commit: $row"
  elif [[ -n $history ]] && ! git merge-base --is-ancestor "${BASH_REMATCH[1]}" HEAD 2>/dev/null; then
    say "${BASH_REMATCH[1]}: no commit of this history"
  fi
done < <(sed -n '/^## Made by a command/,$p' "$page" | grep '^| \[')
[[ $rows -gt 0 ]] || say "no slow figures"
exit $wrong
