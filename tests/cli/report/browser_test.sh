#!/bin/sh
# Opens a report in headless Chromium, at the widths of a desktop and of a telephone: nothing on the console, every
# picture loaded, every drawing drawn, the page no wider than its window, nothing asked of the network. Then on paper.
# browser_test.sh REPORT CHROMIUM
set -eu
report=$1
chromium=$2
here=$(dirname "$0")
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

fail() {
  echo "$1"
  exit 1
}

page=$report/index.html
python3 "$here/check_needs.py" "$report"
if grep -qE '(src|href)="?(https?:|//)|@import|<script' "$page"; then fail 'the page refers to something outside or has a script'; fi
# The copy has the checker inside; the page itself has no script. It is shown in frames, which may be narrower than a
# window of the browser.
{
  sed '/<\/head>/,$d' "$page"
  echo '<script>'
  cat "$here/check_page.js"
  echo '</script>'
  sed -n '/<\/head>/,$p' "$page"
} | sed 's/&/\&amp;/g; s/"/\&quot;/g' >"$folder/escaped"
{
  echo '<!DOCTYPE html><meta charset="utf-8"><link rel="icon" href="data:,"><title>frames</title><body>'
  for width in 1280 390; do
    printf '<iframe width="%s" height="900" srcdoc="' "$width"
    cat "$folder/escaped"
    echo '"></iframe>'
  done
} >"$folder/frames.html"

"$chromium" --headless --no-sandbox --disable-gpu --disable-dev-shm-usage --hide-scrollbars \
  --user-data-dir="$folder/profile" --enable-logging=stderr --window-size=1400,900 --virtual-time-budget=3000 \
  --dump-dom "file://$folder/frames.html" >"$folder/dom" 2>"$folder/log" || fail 'the browser failed'
if grep ':CONSOLE' "$folder/log"; then fail 'the console has messages'; fi
for width in 1280 390; do
  checked=$(sed -n "s/.*<output id=\"checked-$width\">\([^<]*\)<.*/\1/p" "$folder/dom")
  echo "$checked"
  drawings=$(echo "$checked" | sed -n "s/^width $width, pictures 5, drawings \([0-9]*\), faults 0: *$/\1/p")
  [ "${drawings:-0}" -ge 20 ] || fail "at a width of $width: expected 5 pictures, at least 20 drawings and no fault"
done

"$chromium" --headless --no-sandbox --disable-gpu --disable-dev-shm-usage --user-data-dir="$folder/profile" --no-pdf-header-footer \
  --print-to-pdf="$folder/page.pdf" "file://$page" >"$folder/log" 2>&1 || fail 'the browser did not print'
python3 "$here/check_paper.py" "$page" "$folder/page.pdf"
