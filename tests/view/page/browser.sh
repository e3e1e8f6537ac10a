#!/bin/sh
# SPDX-License-Identifier: MIT
# Pages in a browser: they begin, say nothing of faults, and draw something. Needs Chromium or Chrome,
# which draws by the processor here. Usage: browser.sh DELISO
set -eu
deliso=$1
browser=
for name in chromium chromium-browser google-chrome google-chrome-stable; do
  if command -v "$name" >/dev/null; then
    browser=$name
    break
  fi
done
[ -n "$browser" ] || exit 77
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

"$deliso" builtin:torus:20 -q -o "$work/torus.ply"
"$deliso" builtin:fuel:20 --max-distance 0.3vox -q -o "$work/fuel <b>.ply"
printf 'OFF\n0 0 0\n' >"$work/empty.off"
"$deliso" view "$work/torus.ply" "$work/fuel <b>.ply" --volume builtin:fuel:20 -q \
  -o "$work/two.html"
"$deliso" view "$work/empty.off" -q -o "$work/empty.html"
"$deliso" trace builtin:torus:20 -q -o "$work/exact.html"
"$deliso" trace builtin:fuel:20 --paper -q -o "$work/paper.html"
# The tour, by its keys, to the end; then a few steps. A fault in it is told by the page's message.
for page in exact paper; do
  sed '/^<\/body>$/,$d' "$work/$page.html" >"$work/$page-tour.html"
  cat >>"$work/$page-tour.html" <<'END'
<script>
const press = (key) => document.dispatchEvent(new KeyboardEvent('keydown', { key, bubbles: true }));
const wait = setInterval(() => {
  if (!window.deliso) return;
  clearInterval(wait);
  const { view } = window.deliso, seen = new Set();
  document.querySelector('#tour button').click();
  const stops = view.tour.stops.length;
  for (let n = 0; n < stops; ++n) {
    seen.add(document.querySelector('#tour strong').textContent);
    if (n < stops - 1) press('ArrowRight');
  }
  press('ArrowLeft');
  press('Escape');
  document.querySelector('#tour .term').focus();
  press('Home');
  if (seen.size !== stops || view.tour.on || view.event !== 0 ||
      document.querySelector('.term-entry').hidden) throw new Error('the tour');
}, 20);
</script>
</body>
</html>
END
done
# Cut off in the middle of its data.
head -c $(($(wc -c <"$work/paper.html") * 9 / 10)) "$work/paper.html" >"$work/cut.html"

# What a link opens and what a button saves, written into the page's text.
sed 's|^</body>|<script>HTMLAnchorElement.prototype.click = function() { document.body.dataset.saved = this.download; };\
setTimeout(() => document.dispatchEvent(new KeyboardEvent("keydown", {key: "p"})), 1500);</script></body>|' \
  "$work/two.html" >"$work/link.html"

# A page is fine when it has begun and hides its message, and the link's shows what it is to show.
is_fine() {
  grep -q 'id="message"[^>]*hidden=""' "$work/$page.dom" || return 1
  [ "$page" != link ] && return 0
  for text in 'data-saved="torus-fuel' ' or more</li>' 'Brushed: ' 'bars: torus.ply'; do
    grep -q "$text" "$work/link.dom" || return 1
  done
}

# The browser's virtual time does not wait for the decompression of the data: on a busy machine a
# page may need more of it.
faults=0
for page in two empty exact paper exact-tour paper-tour cut link; do
  verdict=
  for budget in 4000 20000 100000; do
    timeout 120 "$browser" --headless=new --no-sandbox --use-angle=swiftshader \
      --enable-unsafe-swiftshader --user-data-dir="$work/profile" --virtual-time-budget=$budget \
      --dump-dom "file://$work/$page.html$([ $page = link ] && echo "#color-by=r_over_l&brush-angle=0-47")" \
      >"$work/$page.dom" 2>"$work/$page.log" || true
    # A browser that cannot run here (a container without what it needs) tests nothing.
    if [ ! -s "$work/$page.dom" ]; then
      echo "$browser does not run here"
      exit 77
    fi
    if is_fine; then
      verdict=fine
      break
    fi
  done
  if [ -z "$verdict" ]; then
    verdict=$(sed -n 's/.*id="message"[^>]*>\([^<]*\)<.*/\1/p' "$work/$page.dom")
    faults=$((faults + 1))
  fi
  echo "$page: $verdict"
done
exit "$((faults > 0))"
