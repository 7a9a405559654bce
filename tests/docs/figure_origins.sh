#!/usr/bin/env bash
# figure_origins.sh ROOT: in CONTRIBUTING.md, "Where every figure comes from", every page and script is there, every row of the slow
# figures has a commit, and that commit is one of this history. Without the history (an archive, a shallow clone) commits are not
# looked up.
set -euo pipefail
cd "$1"
page=CONTRIBUTING.md
section=$(sed -n '/^## Where every figure comes from/,$p' "$page")
wrong=0
say() {
  echo "$page: $1"
  wrong=1
}

while read -r link; do
  [[ -e $link ]] || say "$link: no such page"
done < <(grep -oE '\]\([^)]+\)' <<<"$section" | sed 's/^](//; s/)$//')
while read -r script; do
  [[ -x $script ]] || say "$script: no such script"
done < <(grep -oE '(docs|bench)/[A-Za-z0-9_]+\.(sh|py)|area_model/measure/[a-z]+\.py' <<<"$section" | sort -u)

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
done < <(sed -n '/^### Made by a command/,$p' <<<"$section" | grep '^| \[')
[[ $rows -gt 20 ]] || say "only $rows slow figures"
exit $wrong
