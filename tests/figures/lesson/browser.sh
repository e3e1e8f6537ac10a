#!/bin/sh
# SPDX-License-Identifier: MIT
# The lesson in a browser: every screen, a site that is dragged and one that the keys move, both themes'
# colors. Needs Chromium or Chrome. Usage: browser.sh SOURCE_FOLDER
set -eu
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

# What a reader does, after the page has begun. The answers are elements at the end of the page.
sed '/^<\/body>$/,$d' "$1/docs/lesson.html" >"$work/lesson.html"
cat >>"$work/lesson.html" <<'END'
<script>
window.addEventListener('load', () => {
  const answers = [];
  const check = (what, holds) => answers.push(`${holds ? 'fine' : 'FAULT'}: ${what}`);
  const find = (name) => document.querySelector(name);
  const status = () => find('#status').textContent;
  // A synthetic pointer cannot be captured.
  Element.prototype.setPointerCapture = () => {};
  const point = (target, kind, [x, y]) => target.dispatchEvent(new PointerEvent(kind,
    { clientX: x, clientY: y, pointerId: 1, bubbles: true, cancelable: true }));
  const middle = (target) => {
    const box = target.getBoundingClientRect();
    return [box.x + box.width / 2, box.y + box.height / 2];
  };
  const place = (n) => find(`.site:nth-of-type(${n})`).dataset.place;
  const titles = new Set();
  for (let n = 0; n < 6; ++n) {
    lesson.show(n);
    titles.add(find('#screen-title').textContent);
    check(`screen ${n + 1} draws and speaks`, document.querySelectorAll('.picture *').length > 50 &&
          status().length > 20 && find('#lead').children.length > 0);
  }
  check('six titles', titles.size === 6);
  lesson.show(3);
  check('the certificate fails at first', status().includes('fails') && find('.asked') !== null);
  const first = find('.site'), before = place(1), at = middle(first.querySelector('.knob'));
  point(first, 'pointerdown', at);
  point(first, 'pointermove', [at[0] - 150, at[1] - 60]);
  point(first, 'pointerup', [at[0] - 150, at[1] - 60]);
  check('a drag moves the site', place(1) !== before);
  const dragged = place(1);
  point(first, 'pointermove', [at[0] + 200, at[1]]);
  check('a site that was let go stays', place(1) === dragged);
  first.focus();
  first.dispatchEvent(new KeyboardEvent('keydown', { key: 'ArrowRight', bubbles: true }));
  check('an arrow key moves the site', place(1) !== dragged);
  check('the site keeps the focus', document.activeElement === first);
  const press = (label) => [...document.querySelectorAll('#controls button')]
    .find((button) => button.textContent === label).click();
  press('Insert until it holds');
  check('then the certificate holds', status().includes('holds'));
  lesson.show(4);
  const ball = find('.ball')?.getAttribute('r');
  press('Insert x');
  check('an insertion shows another ball', ball && find('.ball') && find('.ball').getAttribute('r') !== ball);
  lesson.show(5);
  const edges = Number(status().match(/(\d+) edges/)?.[1]);
  const slider = find('#controls input');
  slider.value = 0.05;
  slider.dispatchEvent(new Event('input', { bubbles: true }));
  check('a smaller limit needs more edges', Number(status().match(/(\d+) edges/)?.[1]) > edges);
  const root = document.documentElement, theme = root.dataset.theme;
  find('#theme-button').click();
  check('the other theme', root.dataset.theme !== theme);
  check('nothing is wider than the page', root.scrollWidth <= window.innerWidth);
  check('the message is hidden', find('#message').hidden);
  document.body.append(...answers.map((text) => Object.assign(document.createElement('pre'), { textContent: text })));
});
</script>
</body>
</html>
END

faults=0
for size in 1280,800 390,844; do
  if ! timeout 120 "$browser" --headless=new --no-sandbox --user-data-dir="$work/profile" \
    --window-size=$size --virtual-time-budget=20000 --enable-logging=stderr --dump-dom \
    "file://$work/lesson.html" >"$work/dom" 2>"$work/log"; then
    # A browser that cannot run here (a container without what it needs) tests nothing.
    if [ ! -s "$work/dom" ]; then
      echo "$browser does not run here"
      exit 77
    fi
  fi
  tr '\n' ' ' <"$work/dom" | grep -o '<pre>[^<]*</pre>' | sed 's/<[^>]*>//g' >"$work/answers"
  sed "s/^/$size /" "$work/answers"
  [ "$(grep -c '^fine' "$work/answers")" -eq 18 ] || faults=1
  if grep 'CONSOLE' "$work/log"; then faults=1; fi
done
exit $faults
