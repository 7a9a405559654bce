#!/bin/sh
# Installs packages that dpkg does not have. Needs root or sudo only when something is missing.
# install-packages.sh [PACKAGE...]: those, or all of packages.txt.
# install-packages.sh --groups GROUP...: those of some groups of packages.txt.
set -eu
list=$(dirname "$0")/../packages.txt
if [ "${1:-}" = --groups ]; then
  shift
  groups=$(sed -n 's/^## \([a-z]*\):.*/\1/p' "$list")
  allowed="allowed are $(echo $groups | sed 's/ /, /g')"
  if [ $# = 0 ]; then
    echo "hitpipe: --groups names none; $allowed" >&2
    exit 1
  fi
  for group in "$@"; do
    if ! echo "$groups" | grep -qx -e "$group"; then
      echo "hitpipe: packages.txt has no group \"$group\"; $allowed" >&2
      exit 1
    fi
  done
  wanted=$(awk -v groups=" $* " '/^## / { sub(":", "", $2); taken = index(groups, " " $2 " ") } !/^#/ && taken' "$list")
  set --
else
  wanted=${*:-$(sed 's/#.*//' "$list")}
fi
if ! command -v dpkg-query >/dev/null 2>&1; then
  if [ $# -gt 0 ]; then
    echo "hitpipe: this is no Debian; install $* by other means" >&2
  else
    echo "hitpipe: this is no Debian; install what packages.txt names by other means, then: make build" >&2
  fi
  exit 1
fi
missing=
for package in $wanted; do
  case $(dpkg-query -W -f='${Status}' "$package" 2>/dev/null || true) in
    *"ok installed") ;;
    *) missing="$missing $package" ;;
  esac
done
[ -n "$missing" ] || exit 0
if [ "$(id -u)" -eq 0 ]; then
  run=
elif command -v sudo >/dev/null 2>&1; then
  run=sudo
else
  echo "hitpipe: missing packages:$missing" >&2
  echo "hitpipe: neither root nor sudo is here; ask an administrator for: apt-get install$missing" >&2
  exit 1
fi
echo "hitpipe: installing$missing"
# Word splitting of $run and $missing is meant.
$run apt-get update -qq
$run env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends $missing >/dev/null
