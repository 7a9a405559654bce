#!/bin/bash
# fresh.sh [COMMAND...]: runs the README's commands in a Debian 12 that has only git and make, from a clone of the last commit, and says
# how long each took.
# fresh.sh --packages FOLDER [COMMAND...]: without a clone, with the Debian packages of FOLDER; runs tests/release/from_outside.py.
# The Debian comes from the mirror that this machine's apt uses. Its folder in TMPDIR takes some 6 GB and goes at the end; its mounts are
# seen by no other process and end with this one.
set -euo pipefail
fail() {
  echo "fresh: $1" >&2
  exit 1
}

# Inside the namespace: fresh.sh --in ROOT TREE COMMAND...
if [ "${1:-}" = --in ]; then
  root=$2 tree=$3
  shift 3
  apt=$(apt-get indextargets --format '$(CODENAME) $(REPO_URI) $(RELEASE)' 'Created-By: Packages' 'Component: main' | sort -u)
  mirror=$(awk '$1 == "bookworm" { print $2; exit }' <<< "$apt")
  [ -n "$mirror" ] || fail 'apt has no mirror of Debian 12 (bookworm)'
  [[ $mirror == https:* ]] && certificates=,ca-certificates || certificates=
  debootstrap --variant=minbase --include=git,make$certificates bookworm "$root" "$mirror" > "$root.log" 2>&1 ||
    fail "debootstrap: $(tail -n 1 "$root.log")"
  awk '$1 ~ /^bookworm/ { print "deb", $2, $3, "main" }' <<< "$apt" > "$root/etc/apt/sources.list"
  apt-config dump Acquire | grep -iE '^Acquire::(https?|Check-|Retries)' > "$root/etc/apt/apt.conf.d/90host" || true
  mount -t proc proc "$root/proc" || echo 'fresh: no /proc' >&2
  mount -t devpts -o newinstance,ptmxmode=0666 devpts "$root/dev/pts" && ln -sf pts/ptmx "$root/dev/ptmx" ||
    echo 'fresh: no /dev/pts' >&2
  mkdir -p "$root/dev/shm" && mount -t tmpfs shm "$root/dev/shm" || echo 'fresh: no /dev/shm' >&2
  if [ -n "${PACKAGES:-}" ]; then
    mkdir "$root/hitpipe"
    cp "$PACKAGES"/*.deb tests/release/from_outside.py "$root/hitpipe"
  else
    git clone -q --no-hardlinks "$tree" "$root/hitpipe"
  fi
  for command in "$@"; do
    begin=$SECONDS
    chroot "$root" env -i HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin ${http_proxy:+http_proxy="$http_proxy"} \
      ${https_proxy:+https_proxy="$https_proxy"} sh -c "cd /hitpipe && $command" < /dev/null ||
      fail "$command failed after $((SECONDS - begin)) s"
    times+="fresh: $command took $((SECONDS - begin)) s"$'\n'
  done
  printf %s "$times"
  exit
fi

if [ "${1:-}" = --packages ]; then
  PACKAGES=$(cd "$2" && pwd)
  export PACKAGES
  shift 2
  # What README asks for beside the packages and what they recommend.
  [ $# -gt 0 ] || set -- 'apt-get update -qq && DEBIAN_FRONTEND=noninteractive apt-get install -y -qq ./*.deb pkg-config nextpnr-ice40 fpga-icestorm > apt.log 2>&1' \
    'cd /root && python3 /hitpipe/from_outside.py'
fi
# The unit alone first, so that it has no more packages than its own.
[ $# -gt 0 ] || set -- 'make build' 'build/hitpipe rtl int_major --out unit > unit.txt && make -s -C unit/tb icarus' 'make demo' 'make test'
cd "$(dirname "$0")/.."
if [ "$(id -u)" -ne 0 ]; then
  command -v sudo > /dev/null || fail 'a fresh Debian needs root or sudo'
  exec sudo --preserve-env=PACKAGES "$PWD/cmake/fresh.sh" "$@"
fi
cmake/install-packages.sh debootstrap
folder=$(mktemp -d)
mkdir "$folder/root"
enter=(unshare --mount --pid --fork --kill-child)
"${enter[@]}" true 2> /dev/null || enter=()
trap 'exit 1' HUP INT TERM
trap 'set +e; exec 2> /dev/null; kill -KILL "$run"; wait "$run"; rm -rf --one-file-system "$folder"' EXIT
"${enter[@]}" "$PWD/cmake/fresh.sh" --in "$folder/root" "$PWD" "$@" &
run=$!
wait "$run"
