#!/bin/sh
# SPDX-License-Identifier: MIT
# The lesson in a browser: every picture, samples and sites that are dragged and that keys move, steps forward
# and back, cells that are turned, larger text. Needs Chromium or Chrome. Usage: browser.sh SOURCE_FOLDER
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

# What a reader does, after the page has begun. The answers are elements at the end of the page. Its
# drawings are where the page is.
ln -s "$(cd "$1/docs" && pwd)/guide" "$work/guide"
sed '/^<\/body>$/,$d' "$1/docs/index.html" >"$work/lesson.html"
cat >>"$work/lesson.html" <<'END'
<script>
window.addEventListener('load', () => {
  const answers = [];
  const check = (what, holds) => answers.push(`${holds ? 'fine' : 'FAULT'}: ${what}`);
  const { state } = lesson;
  const figure = (name) => document.querySelector(`#picture-${name}`);
  const status = (name) => figure(name).querySelector('.status').textContent;
  // A synthetic pointer cannot be captured.
  Element.prototype.setPointerCapture = () => {};
  const point = (target, kind, [x, y]) => target.dispatchEvent(new PointerEvent(kind,
    { clientX: x, clientY: y, pointerId: 1, bubbles: true, cancelable: true }));
  const middle = (target) => {
    const box = target.getBoundingClientRect();
    return [box.x + box.width / 2, box.y + box.height / 2];
  };
  const key = (target, name) => target.dispatchEvent(new KeyboardEvent('keydown', { key: name, bubbles: true }));
  const press = (name, label) => [...figure(name).querySelectorAll('button')]
    .find((button) => button.textContent === label).click();
  const marked = (name) => figure(name).querySelector('.code [aria-current]')?.textContent ?? '';
  const move = (name, label, value) => {
    const slider = figure(name).querySelector(`input[aria-label="${label}"]`);
    slider.value = value;
    slider.dispatchEvent(new Event('input', { bubbles: true }));
  };
  for (const name of ['need', 'samples', 'contour', 'sites', 'dual', 'coarsen', 'insertion', 'mesh']) {
    check(`the picture ${name} draws and speaks, in place of its drawing`,
          figure(name).querySelectorAll('.picture *').length > 50 && status(name).length > 20 &&
          figure(name).querySelector('img').offsetWidth === 0 && figure(name).querySelector('img').naturalWidth > 0);
  }
  check('Marching Cubes cuts the neck', status('need').includes('2 loops'));
  for (const name of ['insertion', 'mesh']) {
    check(`${name} shows a mesh of Stage 2 on arrival`, status(name).includes('here it holds, with 1 site more') &&
          figure(name).querySelector('.added') && [...figure(name).querySelectorAll('button')]
            .every((b) => b.textContent === 'Back' || !b.disabled));
  }
  check('so the finished mesh is there', status('mesh').includes('30 edges') &&
        figure('mesh').querySelectorAll('.views .vertex').length === 30);
  check('coarsening begins with a refusal', status('coarsen').includes('It stays') && marked('coarsen').startsWith('p or'));
  press('need', 'A few points');
  check('ten points meet themselves', status('need').includes('meets itself at A'));

  const numbers = () => figure('samples').querySelectorAll('.number')[44].textContent;
  const at = middle(figure('samples').querySelectorAll('.number')[44]), was = numbers();
  const grips = figure('samples').querySelector('.draggable');
  point(grips, 'pointerdown', at);
  const down = 0.28 * figure('samples').querySelector('svg').clientWidth / 12.9;  // of 40 for a voxel's side
  point(grips, 'pointermove', [at[0], at[1] + down]);
  point(grips, 'pointerup', [at[0], at[1] + down]);
  check('a number is dragged down', Number(numbers()) < Number(was));
  check('the saddle follows', status('contour').includes('below 50: apart'));
  const loops = document.querySelector('[data-number=loops]');
  check('a number in the text follows, and the task is done', loops.textContent === '2 loops' &&
        figure('contour').querySelector('.task').textContent.endsWith('Done.'));
  move('contour', 'Its value', was);
  check('and goes back by its slider', status('contour').includes('52.4, at least 50: joined'));

  press('dual', 'Reset');
  check('the certificate fails at first, and its line is marked', status('dual').includes('C1 fails') &&
        figure('dual').querySelector('.asked') && marked('dual').includes('C1'));
  const place = () => first.dataset.place;
  const first = figure('sites').querySelector('.handle'), before = place(), from = middle(first.querySelector('.knob'));
  point(first, 'pointerdown', from);
  point(first, 'pointermove', [from[0] - 150, from[1] - 60]);
  point(first, 'pointerup', [from[0] - 150, from[1] - 60]);
  check('a drag moves the site', place() !== before);
  const dragged = place();
  point(first, 'pointermove', [from[0] + 200, from[1]]);
  check('a site that was let go stays', place() === dragged);
  first.focus();
  key(first, 'ArrowRight');
  check('an arrow key moves the site', place() !== dragged);
  check('the site keeps the focus', document.activeElement === first);
  check('its picture speaks, others are silent', figure('sites').querySelector('.status').ariaLive === 'polite' &&
        figure('dual').querySelector('.status').ariaLive === 'off');
  press('dual', 'Reset');
  press('dual', 'Insert v');
  check('then the certificate holds, and Stage 1 returns', status('dual').includes('holds') &&
        marked('dual').startsWith('return') && marked('sites').includes('Refine'));
  press('dual', 'Back');
  check('a step back', status('dual').includes('C1 fails'));
  press('dual', 'Insert v');
  const ball = figure('insertion').querySelector('.ball')?.getAttribute('r');
  press('insertion', 'Insert x');
  press('insertion', 'Insert x');
  const another = figure('insertion').querySelector('.ball')?.getAttribute('r');
  check('an insertion shows another ball', ball && another && another !== ball);
  check('points are counted', status('insertion').includes('2 points inserted') && status('mesh').includes('30 edges'));
  press('insertion', 'Back');
  check('an insertion is taken back', status('insertion').includes('1 point inserted'));
  check('what asks for sites is gone with the fault', ![...figure('mesh').querySelectorAll('button')]
    .some((b) => b.textContent === 'Certify' && b.offsetWidth > 0));
  move('mesh', 'Rounds', 3);
  check('the mesh after three insertions', status('mesh').includes('14 edges') && marked('mesh').startsWith('while'));
  move('mesh', 'Rounds', 19);
  press('coarsen', 'Try p');
  check('a vertex is tried', status('coarsen').includes('38 of 38') && !figure('coarsen').querySelector('button').disabled);
  const tried = () => figure('coarsen').querySelector('.handle'), vertex = tried().getAttribute('aria-valuenow');
  tried().focus();
  key(tried(), 'ArrowRight');
  check('a key chooses the vertex that coarsening tries', tried().getAttribute('aria-valuenow') !== vertex &&
        document.activeElement === tried() && tried().getAttribute('aria-label') === 'Vertex p');
  for (let n = 0; n < 40 && !status('coarsen').includes('It may go'); ++n) key(tried(), 'ArrowRight');
  key(tried(), 'Delete');
  check('and another tries it', status('coarsen').includes('37 of 38'));
  check('a picture is named as its line says', ['need', 'samples', 'contour', 'sites', 'dual', 'coarsen', 'insertion', 'mesh']
    .every((name) => figure(name).querySelector('.picture').getAttribute('aria-label') === status(name)));

  // Numbers in sentences.
  const number = (name) => document.querySelector(`[data-slider=${name}]`);
  for (const name of ['kappa', 'corner', 'count', 'limit', 'shown']) {
    const at = number(name), was = at.textContent, step = name === 'shown' ? 'ArrowLeft' : 'ArrowRight';
    const before = [...document.querySelectorAll('.picture')].map((picture) => picture.innerHTML).join();
    key(at, step);
    check(`the number ${name} in a sentence goes by keys, and pictures follow`, at.textContent !== was &&
          at.getAttribute('aria-valuenow') === at.textContent &&
          [...document.querySelectorAll('.picture')].map((picture) => picture.innerHTML).join() !== before);
    key(at, step === 'ArrowLeft' ? 'ArrowRight' : 'ArrowLeft');
    check(`and back: ${name}`, at.textContent === was);
  }
  const kappa = number('kappa'), [x, y] = middle(kappa);
  point(kappa, 'pointerdown', [x, y]);
  point(kappa, 'pointermove', [x + 24, y]);
  point(kappa, 'pointerup', [x + 24, y]);
  check('or is dragged', kappa.textContent === '54' && status('samples').includes('\u03ba = 54'));
  check('all numbers that name one thing agree', [...document.querySelectorAll('[data-slider=kappa]')]
    .every((one) => one.textContent === '54'));
  key(kappa, 'Home');
  check('a key leads to its least value', kappa.textContent === '40');
  press('contour', 'Undo');

  // The voxel that is shown large.
  const large = figure('contour').querySelectorAll('.picture:not(.swatch)')[1];
  const saddle = () => [...large.querySelectorAll('.remark')].map((text) => text.textContent).join(' ');
  check('the large voxel tells what the saddle decides', saddle() === 'saddle 52.4 \u2265 50: joined');
  move('contour', 'Isovalue \u03ba', 53);
  check('and what else', saddle() === 'saddle 52.4 < 53: apart');
  press('contour', 'Undo');
  press('sites', 'Reset');
  check('a piece astray has its own color, and words', figure('sites').querySelector('.astray') &&
        figure('sites').querySelector('.remark').textContent === 'nearest to A too,');
  check('every picture has a legend', ['need', 'samples', 'contour', 'sites', 'dual', 'coarsen', 'insertion', 'mesh']
    .every((name) => figure(name).querySelectorAll('.legend .swatch').length >= 3));
  const scripts = [...document.scripts].map((script) => script.textContent.replaceAll(/\s/g, '')).join('');
  const codes = [...document.querySelectorAll('.script code')].map((code) => code.textContent);
  check('the code that is shown is that which runs', document.querySelectorAll('.script').length === 8 &&
        codes.every((text) => text.length > 80 && scripts.includes(text.replaceAll(/\s/g, ''))));
  check('pseudocode is open where there is room', [...document.querySelectorAll('.fold')]
    .every((fold) => fold.open === (window.innerWidth > 991)));

  // The torus.
  const torus = document.querySelector('#torus svg'), apart = document.querySelector('#torus input');
  const set_apart = (value) => {
    apart.value = value;
    apart.dispatchEvent(new Event('input', { bubbles: true }));
  };
  set_apart(0);
  const closed = torus.innerHTML;
  check('the torus is closed', torus.getAttribute('aria-label').includes('closed') && torus.children.length > 1000);
  set_apart(1);
  check('and pulled apart', torus.getAttribute('aria-label').includes('apart') && torus.innerHTML !== closed);
  const pieces = torus.children.length;
  document.querySelector('#torus button').click();
  // A mesh of V vertices with one hole has 3 V edges.
  check('its mesh has one hole', torus.children.length === pieces + 3 * 40);
  const edges = () => Number(status('mesh').match(/(\d+) edges/)?.[1]), few = edges();
  move('mesh', 'Limit D', 0.05);
  check('a smaller limit needs more edges', edges() > few);

  const solid = figure('cells').querySelector('svg'), seen = () => solid.innerHTML, turned = seen();
  key(solid, 'ArrowLeft');
  check('a cell is turned', solid.children.length > 20 && seen() !== turned &&
        figure('cells').querySelectorAll('svg').length === 4);
  check('four conditions, with their duals', figure('broken').querySelectorAll('svg').length === 8);
  const root = document.documentElement;
  check('nothing is wider than the page', root.scrollWidth <= window.innerWidth);
  check('every button is named by its text', [...document.querySelectorAll('button')]
    .every((button) => !button.ariaLabel || button.ariaLabel.includes(button.textContent)));
  check('every link inside leads somewhere', [...document.querySelectorAll('a[href^="#"]')]
    .every((link) => document.getElementById(link.hash.slice(1))));
  root.style.fontSize = '200%';
  state.redraw();
  check('larger text stays within the page', root.scrollWidth <= window.innerWidth &&
        figure('sites').querySelector('svg').clientWidth > 0.6 * Math.min(window.innerWidth, 832));
  check('no message', document.querySelector('#message').hidden);
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
  [ "$(grep -c '^fine' "$work/answers")" -eq 65 ] || faults=1
  if grep 'CONSOLE' "$work/log"; then faults=1; fi
done
exit $faults
