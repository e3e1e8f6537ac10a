// SPDX-License-Identifier: MIT
// The lesson by finger, on a phone's screen: what is dragged by its handle changes and the page stays; a swipe
// over a picture scrolls the page and changes nothing. The tours of the site's traces show all that they tell of.
// Needs Chromium. Usage: node site.mjs SITE [all]; without `all` 32 of the 80 gestures on pictures.
import { spawnSync } from 'node:child_process';
import { existsSync } from 'node:fs';
import { resolve } from 'node:path';
import { Browser, serve } from '../../web/browser.mjs';

const program = ['chromium', 'chromium-browser', 'google-chrome', 'google-chrome-stable']
  .find((name) => spawnSync('sh', ['-c', `command -v ${name}`]).status === 0);
if (!program) process.exit(77);
const server = await serve(resolve(process.argv[2])), browser = new Browser(program);
const few = process.argv[3] !== 'all';
let faults = 0;
function count(what, good, all) {
  console.log(`${good === all ? 'fine ' : 'FAULT'}  ${what}: ${good} of ${all}`);
  if (good !== all) ++faults;
}

// All that a reader may change, as text.
const kAll = `(({ kappa, field, sites, chosen_sample, chosen, edge, chosen_vertex, rounds }) => Object.fromEntries(Object.entries(
  { kappa, samples: field.samples, sites, chosen_sample, chosen, edge, chosen_vertex, rounds: rounds.length })
  .map(([key, value]) => [key, JSON.stringify(value) ?? ''])))(lesson.state)`;
// The picture amid the screen.
async function show(name) {
  await browser.value(`document.querySelector('#picture-${name} svg').scrollIntoView({ block: 'center', behavior: 'instant' })`);
  await browser.frame();
}
async function until_still() {
  for (let before = NaN, same = 0; same < 3;) {
    await browser.frame();
    const now = await browser.value('scrollY');
    same = now === before ? same + 1 : 0;
    before = now;
  }
}
// Where a place of the slice is on the screen, and the picture's handles.
const on_screen = (name, place) => browser.value(`(() => {
  const box = document.querySelector('#picture-${name} svg').getBoundingClientRect(), scale = box.width / 12.9;
  return [box.left + scale * (${place[0]} + .45), box.bottom - scale * (${place[1]} + .45)];
})()`);
const knobs = (name) => browser.value(`[...document.querySelectorAll('#picture-${name} .knob')].map((knob) => {
  const box = knob.getBoundingClientRect();
  return [box.x + box.width / 2, box.y + box.height / 2];
})`);
// What the gesture changed of the state, '' for nothing, and how far the picture went over the screen. (Lines above
// it may come and go, whereupon the browser scrolls to keep it.)
async function swiped(name, from, by) {
  const top = () => browser.value(`document.querySelector('#picture-${name} svg').getBoundingClientRect().top`);
  const [before, was] = [await browser.value(kAll), await top()];
  await browser.swipe(from, by);
  await until_still();
  const after = await browser.value(kAll);
  return { changes: Object.keys(after).filter((key) => after[key] !== before[key]).join(), scrolled: Math.abs(await top() - was) };
}

try {
  await browser.begin();
  await browser.size(390, 844);
  await browser.open(`http://127.0.0.1:${server.address().port}/`);
  await browser.until('window.lesson !== undefined');

  // Sites by their handles, any way, to the vertex of T nearest to the finger; a number after a tap on it, up or down.
  let arrived = 0;
  for (let [dx, dy] of [[0, 70], [0, -70], [70, 0], [-70, 0]].slice(0, few ? 1 : 4)) {
    for (const n of [1, 2, 3, 4, 5, 6]) {
      await show('sites');
      const at = (await knobs('sites'))[n];
      const nearest = () => browser.value(`(() => {
        const { left, bottom, width } = document.querySelector('#picture-sites svg').getBoundingClientRect(), scale = width / 12.9;
        const { contour, sites } = lesson.state;
        return nearest_vertex(contour, [(${at[0] + dx} - left) / scale - .45, (bottom - ${at[1] + dy}) / scale - .45],
                              (v) => v === sites[${n}] || !sites.includes(v));
      })()`);
      const site = () => browser.value(`lesson.state.sites[${n}]`);
      // No vertex is nearer to the finger over there: the other way.
      if (await nearest() === await site()) [dx, dy] = [-dx, -dy];
      const aim = await nearest();
      const { changes, scrolled } = await swiped('sites', at, [dx, dy]);
      // Or within a line of text of it: lines above may come and go.
      const off = await browser.value(`distance(lesson.state.contour.points[${aim}],
                                                lesson.state.contour.points[lesson.state.sites[${n}]])`);
      const fine = changes.includes('sites') && scrolled < 1 && off < 1.5;
      if (!fine) console.log(`site ${n} by ${dx}, ${dy}: changed ${changes}, scrolled ${scrolled}, off by ${off}`);
      arrived += fine;
    }
  }
  count('sites that are dragged move, and the page does not', arrived, few ? 6 : 24);
  arrived = 0;
  for (const name of ['samples', 'contour']) {
    for (const [n, place] of [[2, 2], [5, 4], [8, 6], [4, 6], [9, 3], [7, 4], [3, 5], [6, 2]].slice(few ? 5 : 0).entries()) {
      await show(name);
      const at = await on_screen(name, place);
      await browser.swipe(at, [0, 0]);
      await until_still();
      const { changes, scrolled } = await swiped(name, at, [0, (n + (name === 'contour')) % 2 ? 17 : -17]);
      const fine = changes.includes('samples') && scrolled < 1;
      if (!fine) console.log(`${name}, sample ${place}: changed ${changes}, scrolled ${scrolled}`);
      arrived += fine;
    }
  }
  count('numbers that are tapped, then dragged change, and the page does not', arrived, few ? 6 : 16);

  // Numbers in sentences by a finger that goes to the side.
  arrived = 0;
  const count_of = await browser.value(`document.querySelectorAll('[data-slider]').length`);
  const every = few ? 4 : 1, tried = Math.ceil(count_of / every);
  const place_of = async (n) => {
    await browser.value(`document.querySelectorAll('[data-slider]')[${n}].scrollIntoView({ block: 'center', behavior: 'instant' })`);
    await browser.frame();
    return browser.value(`(({ x, y, width, height }) => [x + width / 2, y + height / 2])(
      document.querySelectorAll('[data-slider]')[${n}].getBoundingClientRect())`);
  };
  const number = (n) => browser.value(`document.querySelectorAll('[data-slider]')[${n}].textContent`);
  for (let n = 0; n < count_of; n += every) {
    await browser.value('lesson.state.limit = 0.1; lesson.state.redraw()');  // several name it, and it has a least value
    const at = await place_of(n), before = await number(n);
    await browser.swipe(at, [at[0] > 195 ? -60 : 60, 0], 8);
    await until_still();
    const after = await number(n);
    if (after === before) console.log(`number ${n} in a sentence: still ${after}`);
    arrived += after !== before;
  }
  count('numbers in sentences that are dragged to the side change', arrived, tried);
  arrived = 0;
  for (let n = 0; n < count_of; n += every) {
    const at = await place_of(n), before = await number(n), top = await browser.value('scrollY');
    await browser.swipe(at, [0, n % 2 ? 140 : -140]);
    await until_still();
    const fine = await number(n) === before && await browser.value('scrollY') !== top;
    if (!fine) console.log(`number ${n} in a sentence: ${before} to ${await number(n)}`);
    arrived += fine;
  }
  count('swipes over numbers in sentences scroll the page, and change nothing', arrived, tried);

  let unchanged = 0, went = 0, all = 0;
  for (const name of ['samples', 'contour', 'coarsen', 'insertion', 'mesh']) {
    for (const [n, place] of [[1, 7], [11, 7], [1, 1], [11, 1], [6, 5], [6, 1], [3, 7], [10, 7]].slice(few ? 4 : 0).entries()) {
      await show(name);
      // Also from the number that is chosen; not from a handle.
      const handles = await knobs(name), chosen = name === 'samples' && n === 4;
      const at = await on_screen(name, chosen ? await browser.value('lesson.state.chosen_sample') : place);
      while (handles.some(([x, y]) => Math.hypot(at[0] - x, at[1] - y) < 24)) at[0] += at[0] < 195 ? 6 : -6;
      const { changes, scrolled } = await swiped(name, at, [n % 3 - 1, n % 2 ? 140 : -140]);
      if (changes || scrolled < 10) console.log(`${name} from ${place}: changed ${changes}, scrolled ${scrolled}`);
      unchanged += !changes;
      went += scrolled >= 10;
      ++all;
    }
  }
  count('swipes over a picture change nothing', unchanged, all);
  count('swipes over a picture scroll the page', went, all);

  // The reader's slice by the program, where the site has it: the neck is cut, then a piece has a hole.
  if (existsSync(resolve(process.argv[2], 'browser/deliso.wasm'))) {
    const told = `document.querySelector('#body .status').textContent`;
    const edges = `document.querySelectorAll('#body .outer, #body .inner').length`;
    await browser.value(`lesson.state.start_again(); lesson.state.redraw(); document.querySelector('#body button').click()`);
    const shows = async (counts) => {
      await browser.until(`${told}.includes('; ${counts}')`);
      return Number((await browser.value(told)).match(/(\d+) triangles/)[1]) === await browser.value(edges);
    };
    let right = await shows('1 component, Euler number 2');
    await browser.value('lesson.state.set_kappa(53); lesson.state.redraw()');
    right &= await shows('2 components, Euler number 4');
    await browser.value('lesson.state.choose_sample(9, 5); lesson.state.set_sample(10); lesson.state.redraw()');
    right &= await shows('2 components, Euler number 2');
    count('meshes of the slice by the program, of three', right ? 3 : 0, 3);
  } else if (await browser.value(`document.getElementById('body').offsetWidth`) > 0) {
    count('pictures of a program that is not there', 1, 0);
  }

  for (const [page, stops] of [['tori-paper.html', 8], ['tori.html', 8]]) {
    await browser.open(`http://127.0.0.1:${server.address().port}/${page}`);
    await browser.until('window.deliso?.view.trace !== undefined');
    count(`stops of the tour of ${page} that the trace has`,
          await browser.value('tour_stops(deliso.view.trace).filter(({ event }) => event >= 0).length'), stops);
  }
  const messages = browser.console.filter((line) => !line.includes('favicon'));
  for (const line of messages) console.log(line);
  count('messages of the page', messages.length, 0);
} finally {
  await browser.close();
  server.close();
}
process.exit(faults ? 1 : 0);
