'use strict';
// A picture of the slice, as SVG in CSS pixels. It is drawn anew when something changes. Only what is
// dragged stays, the handles of sites and the samples, since it keeps the focus and the finger.

const kSvg = 'http://www.w3.org/2000/svg';

function svg_element(tag, attributes, ...children) {
  const made = document.createElementNS(kSvg, tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
  made.append(...children);
  return made;
}

// A finger that comes down on the element where `drags` holds does not scroll the page. The style touch-action says
// so of whole pictures; within one, browsers do not heed it. give_up(): it scrolls all the same, as while the page still
// rolls.
function take_touches(target, drags, give_up) {
  target.addEventListener('touchstart', (event) => {
    if (!drags(event.changedTouches[0])) return;
    if (event.cancelable) event.preventDefault();
    else give_up();
  }, { passive: false });
}

// A swatch of a legend: what `name` draws as a line, a dot, a ring, a square or a cross.
function swatch(shape, name) {
  const shapes = {
    line: () => svg_element('path', { d: 'M1 8H27', class: name }),
    dot: () => svg_element('circle', { cx: 14, cy: 8, r: 4.5, class: name }),
    ring: () => svg_element('circle', { cx: 14, cy: 8, r: 6.5, class: name }),
    square: () => svg_element('rect', { x: 6, y: 1, width: 14, height: 14, class: name }),
    cross: () => svg_element('path', { d: 'M9 3L19 13M9 13L19 3', class: name }),
  };
  return svg_element('svg', { class: 'picture swatch', viewBox: '0 0 28 16', 'aria-hidden': 'true' }, shapes[shape]());
}

class Picture {
  // act: {move_site(n, vertex), select_site(n), remove_site(n), choose_sample(i, j), set_sample(value),
  // point_at(place), press(place)}.
  constructor(place, { columns, rows }, act) {
    this.columns = columns;
    this.rows = rows;
    this.act = act;
    this.svg = svg_element('svg', { class: 'picture', role: 'group' });
    this.ground = svg_element('g', {});
    this.handles = svg_element('g', {});
    this.svg.append(this.ground, this.handles);
    place.append(this.svg);
    this.sites = [];
    this.widths = {};
    this.letters = [];  // where those stand that words shall not lie on
    this.contour = null;
    this.listen();
  }

  // From a part of the slice to pixels: all of it, with half a voxel and a bit all round, or a `view`.
  resize(view = { x: -0.45, y: -0.45, width: this.columns - 0.1, height: this.rows - 0.1 }) {
    this.view = view;
    this.scale = this.svg.getBoundingClientRect().width / view.width;
    this.width = this.scale * view.width;
    this.height = this.scale * view.height;
    this.svg.setAttribute('viewBox', `0 0 ${this.width} ${this.height}`);
  }
  to_paper([x, y]) {
    return [this.scale * (x - this.view.x), this.height - this.scale * (y - this.view.y)];
  }
  from_event(event) {
    const box = this.svg.getBoundingClientRect();
    return [(event.clientX - box.left) / this.scale + this.view.x,
            (this.height - (event.clientY - box.top)) / this.scale + this.view.y];
  }

  clear() {
    this.ground.replaceChildren();
    this.letters = [];
  }
  put(tag, attributes, ...children) {
    const made = svg_element(tag, attributes, ...children);
    this.ground.append(made);
    return made;
  }
  path(points, is_closed) {
    if (points.length === 0) return '';
    const places = points.map((p) => this.to_paper(p).map((x) => x.toFixed(1)).join(' '));
    return 'M' + places.join('L') + (is_closed ? 'Z' : '');
  }
  polyline(points, name, is_closed = false) {
    this.put('path', { d: this.path(points, is_closed), class: name });
  }
  dot(p, name, radius) {
    const [cx, cy] = this.to_paper(p);
    this.put('circle', { cx, cy, r: radius, class: name });
  }
  text(p, words, name, [dx, dy] = [0, 0]) {
    const [x, y] = this.to_paper(p);
    this.put('text', { x: x + dx, y: y + dy, class: name }, words);
  }
  cross(at, size) {
    const [x, y] = this.to_paper(at);
    const d = `M${x - size} ${y - size}L${x + size} ${y + size}M${x - size} ${y + size}L${x + size} ${y - size}`;
    this.put('path', { class: 'cross', d });
  }
  // Which side is which, where there is most room for the word.
  name_sides(contour, field, kappa) {
    for (const [word, is_inside] of [['inside', true], ['outside', false]]) {
      let best = null, most = 0;
      for (let y = 0.5; y < this.rows - 1; ++y) {
        for (let x = 0.5; x < this.columns - 1; ++x) {
          if ((field.value([x, y]) >= kappa) !== is_inside) continue;
          const room = Math.min(...contour.points.map((p) => distance(p, [x, y])));
          if (room > most) [best, most] = [[x, y], room];
        }
      }
      if (most <= 0.8) continue;
      const [x, y] = this.to_paper(best), size = Math.min(14, 0.42 * this.scale);
      this.put('text', { x, y: y + 0.3 * size, class: 'side', 'font-size': size.toFixed(1) }, word);
      this.letters.push([x - 1.2 * size, y], [x, y], [x + 1.2 * size, y]);
    }
  }
  // Words about a place, in red, with an arrow from them to it. They stand as near to it as they can without
  // lying on a curve, a handle or a letter. If it is not much further so, the arrow goes around the last two, and
  // nothing lies on the others.
  point_out(place, lines, curves, others = []) {
    const [px, py] = this.to_paper(place), kLine = 17;
    const words = lines.map((line) => this.put('text', { class: 'remark' }, line));
    // Measured once: to measure makes the browser lay out the page.
    const width_of = (text) => this.widths[`${this.width} ${text.textContent}`] ??= text.getBBox().width;
    const half = [Math.max(...words.map(width_of)) / 2 + 2, kLine * lines.length / 2];
    const named = [...this.sites.map((v) => this.to_paper(this.contour.points[v])), ...this.letters]
      .filter((q) => distance(q, [px, py]) > 1);
    const of = (points) => points.flat().map((p) => this.to_paper(p));
    const taken = [...of(curves), [px, py], ...named], better_free = of(others);
    const off = ([x, y], [qx, qy]) =>
      Math.hypot(Math.max(0, Math.abs(qx - x) - half[0]), Math.max(0, Math.abs(qy - y) - half[1]));
    const start = ([x, y]) => [clamp(px, x - half[0] + 6, x + half[0] - 6), clamp(py, y - half[1], y + half[1])];
    const passes = (p, q) => [0.2, 0.35, 0.5, 0.65, 0.8].some((t) => distance(between(p, [px, py], t), q) < 11);
    // The nearest places first: most of the others need no look.
    const places = [];
    for (let y = half[1] + 4; y <= this.height - half[1] - 4; y += 10) {
      for (let x = half[0] + 4; x <= this.width - half[0] - 4; x += 10) {
        places.push({ at: [x, y], gap: off([x, y], [px, py]) });
      }
    }
    places.sort((p, q) => p.gap - q.gap);
    const find = (margin) => {
      let best = null, least = Infinity;
      for (const { at, gap } of places) {
        if (gap >= least) break;
        if (gap < 10 + margin || taken.some((q) => off(at, q) < margin)) continue;
        const cost = gap + 40 * named.filter((q) => passes(start(at), q)).length +
                     (better_free.some((q) => off(at, q) < 4) ? 40 : 0);
        if (cost < least) [best, least] = [at, cost];
      }
      return best;
    };
    const best = find(12) ?? find(5);
    if (!best) {
      for (const text of words) text.remove();
      return;
    }
    const [x, y] = best, from = start(best);
    const size = distance(from, [px, py]), [ux, uy] = [(px - from[0]) / size, (py - from[1]) / size];
    const tip = [px - 9 * ux, py - 9 * uy];
    const back = (side) => `${tip[0] - 9 * ux - side * 4.5 * uy} ${tip[1] - 9 * uy + side * 4.5 * ux}`;
    this.put('path', { class: 'arrow', d: `M${from.join(' ')}L${tip.join(' ')}M${back(1)}L${tip.join(' ')}L${back(-1)}` });
    words.forEach((text, n) => {
      text.setAttribute('x', x);
      text.setAttribute('y', y - half[1] + kLine * (n + 0.76));
    });
  }
  draw_sides(contour) {
    this.put('rect', { width: this.width, height: this.height, class: 'below' });
    if (contour) {
      this.put('path', { d: contour.curves.map((curve) => this.path(curve, true)).join(''), class: 'above' });
    }
  }
  draw_grid() {
    const { columns, rows } = this;
    for (let i = 0; i < columns; ++i) this.polyline([[i, 0], [i, rows - 1]], 'grid');
    for (let j = 0; j < rows; ++j) this.polyline([[0, j], [columns - 1, j]], 'grid');
  }
  // `radius`: of the circles that have a sample's number in them, in voxels.
  draw_samples(field, kappa, chosen, radius) {
    for (let j = 0; j < this.rows; ++j) {
      for (let i = 0; i < this.columns; ++i) {
        const value = field.at(i, j), [x, y] = this.to_paper([i, j]);
        this.dot([i, j], value >= kappa ? 'sample inside' : 'sample outside', radius * this.scale);
        this.put('text', { x, y: y + 0.38 * radius * this.scale, class: 'number',
                           'font-size': (1.06 * radius * this.scale).toFixed(1) }, String(value));
      }
    }
    this.dot(chosen, 'chosen-sample', radius * this.scale + 3);
    this.put_samples(field);
  }
  // The numbers alone, each at its sample or beside it, clear of the vertices of T, of Sigma and of a square.
  draw_numbers(field, chosen, contour, [left, low]) {
    const square = [0, 0.2, 0.4, 0.6, 0.8].flatMap((t) =>
      [[left + t, low], [left + 1, low + t], [left + 1 - t, low + 1], [left, low + 1 - t]]);
    const lines = [...contour.points, ...contour.curves.flat(), ...square];
    const across = [0, 0.34, -0.34], up = [0, 0.3, -0.3];
    for (let j = 0; j < this.rows; ++j) {
      for (let i = 0; i < this.columns; ++i) {
        const near = lines.filter((p) => distance(p, [i, j]) < 1);
        const clear = ([x, y]) => Math.min(0.36, ...near.map((p) => distance(p, [x, y])));
        let place = [i, j], least = Infinity;
        for (const dy of up) {
          for (const dx of near.length > 0 ? across : [0]) {
            const p = [i + dx, j + dy], cost = Math.hypot(dx, dy) - 4 * clear(p);
            if (cost < least) [place, least] = [p, cost];
          }
        }
        const [x, y] = this.to_paper(place);
        if (i === chosen[0] && j === chosen[1]) this.dot(place, 'chosen-sample', 0.32 * this.scale);
        this.put('text', { x, y: y + 0.11 * this.scale, class: 'number bare', 'font-size': (0.31 * this.scale).toFixed(1) },
                 String(field.at(i, j)));
      }
    }
    this.put_samples(field);
  }
  draw_contour(contour, name, with_vertices) {
    for (const loop of contour.loops) this.polyline(loop.map((v) => contour.points[v]), name, true);
    if (with_vertices) for (const p of contour.points) this.dot(p, 'vertex', 0.09 * this.scale + 0.8);
  }
  draw_voronoi(points) {
    const kFar = 99;
    points.forEach((p, n) => {
      for (let m = n + 1; m < points.length; ++m) {
        const q = points[m], middle = between(p, q, 0.5), along = [p[1] - q[1], q[0] - p[0]];
        let from = -kFar, to = kFar;
        points.forEach((other, k) => {
          if (k === n || k === m) return;
          // Nearer to p than to the other: offset + t * slope >= 0.
          const offset = distance(middle, other) ** 2 - distance(middle, p) ** 2;
          const slope = -2 * (along[0] * (other[0] - p[0]) + along[1] * (other[1] - p[1]));
          if (slope > 0) from = Math.max(from, -offset / slope);
          else if (slope < 0) to = Math.min(to, -offset / slope);
          else if (offset < 0) to = -kFar;
        });
        const at = (t) => [middle[0] + t * along[0], middle[1] + t * along[1]];
        if (from < to) this.polyline([at(from), at(to)], 'voronoi');
      }
    });
  }

  // Places to drag samples by, up and down: a voxel's side is 40. The whole picture is such a place, so a finger
  // that goes over it scrolls the page. Only from the sample that it has tapped before does it drag.
  put_samples(field) {
    this.field = field;
    const [x, y] = this.to_paper([0, 0]), half = this.scale / 2;
    if (!this.grips) {
      this.grips = svg_element('rect', { class: 'draggable' });
      this.svg.append(this.grips);
      let held = null, tapped = null, by_finger = false;
      const sample_at = (event) => this.from_event(event).map(Math.round);
      const is_tapped = (event) => String(sample_at(event)) === String(tapped);
      take_touches(this.grips, is_tapped, () => { held = null; });
      this.grips.addEventListener('pointerdown', (event) => {
        by_finger = ['touch', 'pen'].includes(event.pointerType);
        if (by_finger && !is_tapped(event)) {
          tapped = null;
          return;
        }
        const [i, j] = sample_at(event);
        event.preventDefault();
        this.grips.setPointerCapture(event.pointerId);
        held = { y: event.clientY, value: this.field.at(i, j) };
        this.act.choose_sample(i, j);
      });
      this.grips.addEventListener('click', (event) => {
        if (!by_finger) return;
        tapped = sample_at(event);
        this.act.choose_sample(...tapped);
      });
      this.grips.addEventListener('pointermove', (event) => {
        if (!held) return;
        const value = held.value + 40 * (held.y - event.clientY) / this.scale;
        this.act.set_sample(clamp(Math.round(value), 0, 100));
      });
      for (const kind of ['pointerup', 'pointercancel']) {
        this.grips.addEventListener(kind, () => { held = null; });
      }
    }
    for (const [name, value] of Object.entries({ x: x - half, y: y - half - (this.rows - 1) * this.scale,
      width: this.columns * this.scale, height: this.rows * this.scale })) this.grips.setAttribute(name, value);
  }

  // The handles of the sites, or of the vertex that coarsening tries: names[n] is a letter, `chosen` the number of
  // the one selected. They go to vertices that are `allowed`.
  put_sites(contour, sites, names, chosen, notes, { role = 'Site', allowed = () => true } = {}) {
    this.contour = contour;
    this.sites = sites;
    this.allowed = (n, v) => v === this.sites[n] || !this.sites.includes(v) && allowed(v);
    while (this.handles.children.length > sites.length) this.handles.lastChild.remove();
    while (this.handles.children.length < sites.length) this.add_handle(this.handles.children.length);
    sites.forEach((v, n) => {
      const handle = this.handles.children[n];
      const [x, y] = this.to_paper(contour.points[v]);
      handle.setAttribute('transform', `translate(${x.toFixed(1)} ${y.toFixed(1)})`);
      handle.setAttribute('class', n === chosen ? 'handle chosen' : 'handle');
      handle.setAttribute('aria-valuemax', contour.points.length - 1);
      handle.setAttribute('aria-valuenow', v);
      handle.setAttribute('aria-label', `${role} ${names[n]}`);
      handle.setAttribute('aria-valuetext', notes[n]);
      // The letter is outside of the body.
      const p = contour.points[v], before = contour.points[contour.previous[v]];
      const after = contour.points[contour.next[v]], size = distance(before, after) || 1;
      const letter = handle.querySelector('text');
      letter.textContent = names[n];
      const aside = [17 * (after[1] - before[1]) / size, 17 * (after[0] - before[0]) / size];
      this.letters.push([x + aside[0], y + aside[1]]);
      letter.setAttribute('x', aside[0].toFixed(1));
      letter.setAttribute('y', (aside[1] + 5).toFixed(1));
      handle.dataset.place = p.map((x) => x.toFixed(2)).join(' ');
    });
  }
  add_handle(n) {
    const handle = svg_element('g', { class: 'handle', tabindex: this.takes_keys ? 0 : -1, role: 'slider', 'aria-valuemin': 0 },
      svg_element('circle', { r: 21, class: 'grip' }), svg_element('circle', { r: 7.5, class: 'knob' }),
      svg_element('text', { class: 'letter' }));
    let held = false;
    take_touches(handle, () => true, () => { held = false; });
    handle.addEventListener('pointerdown', (event) => {
      // A browser takes a finger that comes down beside a handle for one on it, and scrolls as well.
      const { x, y, width } = handle.querySelector('.grip').getBoundingClientRect();
      if (distance([event.clientX, event.clientY], [x + width / 2, y + width / 2]) > width / 2) return;
      event.preventDefault();
      event.stopPropagation();
      held = true;
      handle.setPointerCapture(event.pointerId);
      handle.focus({ preventScroll: true });
      this.act.select_site(n);
    });
    handle.addEventListener('pointermove', (event) => {
      if (held) this.act.move_site(n, this.free_vertex(n, this.from_event(event)));
    });
    for (const kind of ['pointerup', 'pointercancel']) handle.addEventListener(kind, () => { held = false; });
    handle.addEventListener('click', (event) => event.stopPropagation());
    handle.addEventListener('focus', () => this.act.select_site(n));
    handle.addEventListener('keydown', (event) => {
      const { contour, sites } = this;
      const ways = { ArrowRight: contour.next, ArrowUp: contour.next, ArrowLeft: contour.previous,
                     ArrowDown: contour.previous };
      if (event.key === 'Delete') {
        this.act.remove_site(n);
      } else if (ways[event.key]) {
        let v = ways[event.key][sites[n]];
        while (!this.allowed(n, v)) v = ways[event.key][v];
        this.act.move_site(n, v);
      } else {
        return;
      }
      event.preventDefault();
      event.stopPropagation();
    });
    this.handles.append(handle);
  }
  // The vertex of T nearest to a place that it may go to.
  free_vertex(n, place) {
    return nearest_vertex(this.contour, place, (v) => this.allowed(n, v));
  }

  listen() {
    this.svg.addEventListener('pointermove', (event) => this.act.point_at(this.from_event(event)));
    this.svg.addEventListener('click', (event) => {
      this.act.point_at(this.from_event(event));
      this.act.press(this.from_event(event));
    });
  }
}
