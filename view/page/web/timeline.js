'use strict';
// The timeline. Every routine has a lane, with a mark where it was at work. The head is dragged or
// played. Buttons go by steps, and to the next event of a kind.

const kLane = 11;         // height in CSS pixels
const kHead = 11;         // of the room above the lanes for the head's knob
const kCurves = 44;       // height of the curves

// What makes two events of one kind.
const kKindsOfEvent = {
  routine: { name: 'same routine', of: (trace, e) => trace.arrays.event_routine[e] },
  reason: { name: 'same criterion', of: (trace, e) => trace.arrays.event_reason?.[e] ?? 0 },
  outcome: { name: 'same outcome', of: (trace, e) => trace.arrays.event_outcome?.[e] ?? 0 },
};

class Timeline {
  // go(event) shows an event.
  constructor(place, trace, go) {
    this.trace = trace;
    this.go = go;
    this.at = 0;
    this.playing = false;
    this.speed = 0;       // events per second; 0: as long as the event is rare
    this.places = places_of(trace);
    this.seconds = seconds_of_events(trace);
    this.live = live_vertices(trace);
    this.kind = 'routine';
    this.canvas = element('canvas', { class: 'lanes', tabindex: 0, role: 'slider',
                                      'aria-label': 'Event', 'aria-valuemin': 1,
                                      'aria-valuemax': Math.max(1, trace.count) });
    this.lanes = trace.routines_used;
    this.canvas.style.height = `${this.top + this.lanes.length * kLane + 15}px`;
    this.picture = document.createElement('canvas');
    place.append(this.buttons(), this.canvas);
    this.listen();
    on_resize(this.canvas, () => this.redraw());
  }

  buttons() {
    const { trace } = this;
    this.play_button = icon_button('play', 'Play (Space)', () => this.play(!this.playing));
    this.number = element('input', { type: 'number', min: 1, max: Math.max(1, trace.count),
                                     'aria-label': 'Number of the event',
                                     onchange: () => this.show(Number(this.number.value) - 1) });
    const kinds = Object.entries(kKindsOfEvent).map(([key, { name }]) => [key, name]);
    const others = trace.outcomes.map((name, n) => [`outcome ${n}`, name])
      .filter(([, name], n) => n > 0 && this.occurs('outcome', n));
    const kind = choice('Kind', [...kinds, ...others], this.kind, (value) => { this.kind = value; });
    kind.classList.add('inline');
    const speed = choice('Speed', [[0, 'slow where rare'], ...[1, 4, 15, 60, 250, 1000].map((n) => [n, `${n} / s`])], this.speed,
                         (value) => { this.speed = Number(value); });
    speed.classList.add('inline');
    return element('div', { class: 'buttons' },
                   icon_button('first', 'First event (Home)', () => this.show(0)),
                   icon_button('back', 'One step back (left arrow)', () => this.step(-1)),
                   this.play_button,
                   icon_button('on', 'One step on (right arrow)', () => this.step(1)),
                   icon_button('last', 'Last event (End)', () => this.show(trace.count - 1)),
                   element('span', { class: 'of' }, this.number, ` of ${grouped(trace.count)}`),
                   element('span', { class: 'group' },
                           icon_button('previous-kind', 'Previous of this kind (P)',
                                       () => this.next_of_kind(-1)), kind,
                           icon_button('next-kind', 'Next of this kind (N)',
                                       () => this.next_of_kind(1))),
                   speed);
  }

  occurs(what, number) {
    const values = this.trace.arrays['event_' + what];
    return values ? values.subarray(0, this.trace.count).includes(number) : false;
  }

  step(by) {
    this.play(false);
    this.show(this.at + by);
  }

  show(event) {
    const at = clamp(Number.isFinite(event) ? Math.round(event) : 0, 0, Math.max(0, this.trace.count - 1));
    this.at = at;
    this.number.value = at + 1;
    this.canvas.setAttribute('aria-valuenow', at + 1);
    this.canvas.setAttribute('aria-valuetext', this.trace.count > 0 ?
      `event ${at + 1}, ${this.trace.routine(at).name}` : 'no events');
    this.draw_head();
    this.go(at);
  }

  next_of_kind(direction) {
    this.play(false);
    const { trace, at } = this;
    if (trace.count === 0) return;
    const [what, number] = this.kind.split(' ');
    const of = (e) => kKindsOfEvent[what].of(trace, e);
    const wanted = number === undefined ? of(at) : Number(number);
    for (let e = at + direction; e >= 0 && e < trace.count; e += direction) {
      if (of(e) === wanted) return this.show(e);
    }
  }

  play(on) {
    if (on === this.playing) return;
    this.playing = on;
    this.play_button.replaceChildren(icon(on ? 'pause' : 'play'));
    this.play_button.setAttribute('aria-pressed', on);
    if (!on) return;
    if (this.at >= this.trace.count - 1) this.show(0);
    let before = performance.now(), due = 0;
    const tick = (now) => {
      if (!this.playing) return;
      due += Math.min(now - before, 250) / 1000;
      before = now;
      let to = this.at;
      for (; to < this.trace.count - 1 && due >= this.stay(to); ++to) due -= this.stay(to);
      if (to > this.at) this.show(to);
      if (this.at >= this.trace.count - 1) this.play(false);
      else requestAnimationFrame(tick);
    };
    requestAnimationFrame(tick);
  }

  // Seconds that playback stays at an event.
  stay(e) { return this.speed > 0 ? 1 / this.speed : this.seconds[e]; }

  get labels() { return this.canvas.clientWidth > 700 ? 130 : 104; }
  get top() { return kHead + kCurves; }

  listen() {
    const { canvas } = this;
    let dragging = false;
    const scrub = (event) => {
      const width = canvas.clientWidth - this.labels;
      const share = (event.offsetX - this.labels) / Math.max(1, width);
      this.show(event_at(this.places, share));
    };
    canvas.addEventListener('pointerdown', (event) => {
      this.play(false);
      const lane = Math.floor((event.offsetY - this.top) / kLane);
      if (event.offsetX < this.labels) {
        if (lane >= 0 && lane < this.lanes.length) this.next_in_lane(this.lanes[lane]);
        return;
      }
      canvas.setPointerCapture(event.pointerId);
      dragging = true;
      scrub(event);
    });
    canvas.addEventListener('pointermove', (event) => {
      if (dragging) scrub(event);
    });
    const end = () => { dragging = false; };
    canvas.addEventListener('pointerup', end);
    canvas.addEventListener('pointercancel', end);
  }

  // The next event of a routine; after the last one the first.
  next_in_lane(routine) {
    const events = this.trace.arrays.event_routine.subarray(0, this.trace.count);
    const next = events.indexOf(routine, this.at + 1);
    this.show(next >= 0 ? next : events.indexOf(routine));
  }

  // The lanes, once for every size.
  redraw() {
    const width = this.canvas.clientWidth, height = this.canvas.clientHeight;
    if (width === 0) return;
    const context = fit_canvas(this.picture, width, height);
    const { trace, labels, places } = this;
    const ink = css_color(style_color('--ink-soft')), line = css_color(style_color('--line'));
    context.font = '10.5px system-ui, sans-serif';
    const columns = Math.max(1, Math.floor(width - labels));
    const row_of = new Map(this.lanes.map((routine, row) => [routine, row]));
    const there = new Float32Array(columns * this.lanes.length);
    let widest = 0;  // of the events, in columns
    for (let e = 0; e < trace.count; ++e) {
      widest = Math.max(widest, (places[e + 1] - places[e]) * columns);
      const column = Math.floor(places[e] * columns);
      there[row_of.get(trace.arrays.event_routine[e]) * columns + column] += 1;
    }
    const wide = Math.max(1, widest), full = Math.max(1, 1 / widest);
    this.lanes.forEach((routine, row) => {
      const y = this.top + row * kLane;
      const { color, dash, label } = trace.routine_style(routine);
      context.fillStyle = css_color(color);
      for (let column = 0; column < columns; ++column) {
        const share = there[row * columns + column] / full;
        if (share === 0) continue;
        context.globalAlpha = clamp(0.25 + 0.75 * share, 0, 1);
        if (dash === 'solid') context.fillRect(labels + column, y + 1, wide, kLane - 2);
        else for (const dy of dash === 'dashed' ? [1, 6] : [1, 4, 7]) {
          context.fillRect(labels + column, y + dy, wide, dash === 'dashed' ? 4 : 2);
        }
      }
      context.globalAlpha = 1;
      context.fillStyle = line;
      context.fillRect(labels, y + kLane - 0.5, columns, 0.5);
      context.fillStyle = ink;
      context.textAlign = 'left';
      context.textBaseline = 'middle';
      context.fillText(label, 2, y + kLane / 2 + 0.5, labels - 10);
    });
    const curves = curves_of(trace, this.live, places, columns);
    const orange = css_color(style_color('--accent')), blue = css_color(style_color('--focus'));
    draw_curve(context, curves.worst, labels, kHead, kCurves - 4, orange, []);
    draw_curve(context, curves.vertices, labels, kHead, kCurves - 4, blue, [5, 3]);
    context.fillStyle = orange;
    if (curves.worst.some(Number.isFinite)) context.fillText('\u2014 worst distance', 2, kHead + 12, labels - 10);
    context.fillStyle = blue;
    context.fillText('- - vertices', 2, kHead + 28, labels - 10);
    const bottom = this.top + this.lanes.length * kLane;
    context.fillStyle = ink;
    context.textBaseline = 'bottom';
    if (trace.switch_at >= 0) {
      const x = labels + places[trace.switch_at] * columns;
      context.fillRect(x, kHead, 1, bottom - kHead);
      context.textAlign = 'center';
      for (const [stage, from, to] of [[1, labels, x], [2, x, width]]) {
        const text = to - from > 60 ? `Stage ${stage}` : to - from > 10 ? String(stage) : '';
        context.fillText(text, (from + to) / 2, height);
      }
    }
    this.draw_head();
  }

  draw_head() {
    const { canvas, labels, places } = this;
    const width = canvas.clientWidth, height = canvas.clientHeight;
    if (width === 0 || this.picture.width <= 1) return;
    const context = fit_canvas(canvas, width, height);
    context.drawImage(this.picture, 0, 0, width, height);
    const x = labels + (places[this.at] + (places[this.at + 1] ?? 1)) / 2 * (width - labels);
    context.fillStyle = css_color(style_color('--accent'));
    context.fillRect(x - 1, 5, 2, this.top - 5 + this.lanes.length * kLane);
    context.beginPath();
    context.arc(clamp(x, 5, width - 5), 5.5, 5, 0, 7);
    context.fill();
  }
}
