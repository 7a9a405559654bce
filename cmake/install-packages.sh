#!/bin/sh
# Installs packages that dpkg does not have, named here or all of packages.txt: install-packages.sh [PACKAGE...]
# Needs root or sudo only when something is missing.
set -eu
list=$(dirname "$0")/../packages.txt
wanted=${*:-$(sed 's/#.*//' "$list")}
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
