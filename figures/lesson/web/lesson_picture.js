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

class Picture {
  // act: {move_site(n, vertex), select_site(n), remove_site(n), choose_sample(i, j), set_sample(value),
  // point_at(place), press(place)}.
  constructor(place, { columns, rows }, label, act) {
    this.columns = columns;
    this.rows = rows;
    this.act = act;
    this.svg = svg_element('svg', { class: 'picture', role: 'group', 'aria-label': label });
    this.ground = svg_element('g', {});
    this.handles = svg_element('g', {});
    this.svg.append(this.ground, this.handles);
    place.append(this.svg);
    this.sites = [];
    this.contour = null;
    this.listen();
  }

  // From the slice to pixels, with half a voxel and a bit all round.
  resize() {
    this.scale = this.svg.getBoundingClientRect().width / (this.columns - 0.1);
    this.width = this.scale * (this.columns - 0.1);
    this.height = this.scale * (this.rows - 0.1);
    this.svg.setAttribute('viewBox', `0 0 ${this.width} ${this.height}`);
  }
  to_paper([x, y]) {
    return [this.scale * (x + 0.45), this.height - this.scale * (y + 0.45)];
  }
  from_event(event) {
    const box = this.svg.getBoundingClientRect();
    return [(event.clientX - box.left) / this.scale - 0.45,
            (this.height - (event.clientY - box.top)) / this.scale - 0.45];
  }

  clear() { this.ground.replaceChildren(); }
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
  // `bare`: the numbers alone.
  draw_samples(field, kappa, chosen, bare) {
    const radius = 0.34 * this.scale;
    for (let j = 0; j < this.rows; ++j) {
      for (let i = 0; i < this.columns; ++i) {
        const value = field.at(i, j), [x, y] = this.to_paper([i, j]);
        if (!bare) this.dot([i, j], value >= kappa ? 'sample inside' : 'sample outside', radius);
        this.put('text', { x, y: y + 0.13 * this.scale, class: bare ? 'number bare' : 'number',
                           'font-size': (0.36 * this.scale).toFixed(1) }, String(value));
      }
    }
    this.dot(chosen, 'chosen-sample', radius + 3);
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

  // The handles of the sites: names[n] is a letter, `chosen` the number of the one selected.
  put_sites(contour, sites, names, chosen, notes) {
    this.contour = contour;
    this.sites = sites;
    while (this.handles.children.length > sites.length) this.handles.lastChild.remove();
    while (this.handles.children.length < sites.length) this.add_handle(this.handles.children.length);
    sites.forEach((v, n) => {
      const handle = this.handles.children[n];
      const [x, y] = this.to_paper(contour.points[v]);
      handle.setAttribute('transform', `translate(${x.toFixed(1)} ${y.toFixed(1)})`);
      handle.setAttribute('class', n === chosen ? 'handle chosen' : 'handle');
      handle.setAttribute('aria-valuemax', contour.points.length - 1);
      handle.setAttribute('aria-valuenow', v);
      handle.setAttribute('aria-label', `Site ${names[n]}`);
      handle.setAttribute('aria-valuetext', notes[n]);
      // The letter is outside of the body.
      const p = contour.points[v], before = contour.points[contour.previous[v]];
      const after = contour.points[contour.next[v]], size = distance(before, after) || 1;
      const letter = handle.querySelector('text');
      letter.textContent = names[n];
      letter.setAttribute('x', (17 * (after[1] - before[1]) / size).toFixed(1));
      letter.setAttribute('y', (17 * (after[0] - before[0]) / size + 5).toFixed(1));
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
        while (sites.includes(v) && v !== sites[n]) v = ways[event.key][v];
        this.act.move_site(n, v);
      } else {
        return;
      }
      event.preventDefault();
      event.stopPropagation();
    });
    this.handles.append(handle);
  }
  // The vertex of T nearest to a place that is no other site's.
  free_vertex(n, place) {
    return nearest_vertex(this.contour, place, (v) => v === this.sites[n] || !this.sites.includes(v));
  }

  listen() {
    this.svg.addEventListener('pointermove', (event) => this.act.point_at(this.from_event(event)));
    this.svg.addEventListener('click', (event) => {
      this.act.point_at(this.from_event(event));
      this.act.press(this.from_event(event));
    });
  }
}
