'use strict';
// A trace and its surface at every step. The trace lists what each event took from the surface and
// put there. From this follows when every facet came and when it went. The surface at a step is made
// from that of a neighboring step by changing a few facets, or in one pass over all facets. So any
// step is quickly reached, and no copies are kept.

// The lists of a trace, with the numbers that an item has.
const kLists = { removed: 3, added: 3, zone: 4, star: 3, cone: 3, hits: 3, relabel: 2 };

// What puts the mesh of Stage 2 in the place of Stage 1's facets, in either program.
const kSwitches = ['build_tri_mesh', 'coarsen'];

class Trace {
  constructor({ header, arrays }) {
    this.header = header;
    this.arrays = arrays;
    this.points = arrays.points ?? new Float32Array(0);
    this.routines = header.routines ?? [];
    this.outcomes = header.outcomes ?? ['done'];
    this.reasons = header.reasons ?? [];
    this.count = this.whole_events();
    this.switch_at = -1;  // the event between the stages
    for (let e = 0; e < this.count && this.switch_at < 0; ++e) {
      if (kSwitches.includes(this.routine(e).name)) this.switch_at = e;
    }
    this.routines_used = this.numbers_used('routine');
    this.reasons_used = this.numbers_used('reason');
    this.add_up();
  }

  // Which numbers events have, ascending: the order of the header, that of the paper's figures.
  numbers_used(what) {
    const values = this.arrays['event_' + what]?.subarray(0, this.count) ?? [];
    return [...new Set(values)].sort((a, b) => a - b);
  }
  routine_style(routine) { return kOperations[this.routines[routine]?.name] ?? kOther; }
  reason_style(reason) { return kCriteria[this.reasons[reason]?.name] ?? kOther; }

  // The events of which all is there: a page may be cut off.
  whole_events() {
    const { arrays } = this;
    let count = arrays.event_routine?.length ?? 0;
    for (const [name, each] of [['outcome', 1], ['reason', 1], ['value', 1], ['vertex', 1],
                                ['place', 3], ['caller', 3], ['micros', 1], ['searches', 1],
                                ['computations', 1], ['worst', 1], ['edge', 6], ['ball', 4]]) {
      const values = arrays['event_' + name];
      if (values) count = Math.min(count, Math.floor(values.length / each));
    }
    for (const [name, each] of Object.entries(kLists)) {
      const begin = arrays[name + '_begin'];
      if (!begin) continue;
      count = Math.min(count, begin.length - 1);
      const there = (arrays[name]?.length ?? 0) / each;
      while (count > 0 && begin[count] > there) --count;
    }
    return Math.max(0, count);
  }

  routine(e) { return this.routines[this.arrays.event_routine[e]] ?? { name: 'step', stage: 1 }; }
  outcome_text(e) { return this.header.outcome_texts?.[this.arrays.event_outcome?.[e] ?? 0] ?? ''; }
  outcome(e) { return this.outcomes[this.arrays.event_outcome?.[e] ?? 0] ?? ''; }
  reason(e) { return this.reasons[this.arrays.event_reason?.[e]] ?? null; }
  value(e) { return this.arrays.event_value?.[e] ?? NaN; }
  vertex(e) { return this.arrays.event_vertex?.[e] ?? kNone; }
  stage(e) { return this.switch_at >= 0 && e > this.switch_at ? 2 : this.routine(e).stage === 2 ? 2 : 1; }
  // Nothing was changed in the end.
  refused(e) { return this.outcome(e).startsWith('refused'); }

  numbers(name, e, each) {
    const values = this.arrays['event_' + name];
    if (!values) return null;
    const part = values.subarray(each * e, each * e + each);
    return Number.isFinite(part[0]) ? part : null;
  }
  place(e) { return this.numbers('place', e, 3); }
  edge(e) { return this.numbers('edge', e, 6); }
  ball(e) { return this.numbers('ball', e, 4); }
  // The vertices that called for an event: of a facet, or one, or none.
  caller(e) {
    const values = this.arrays.event_caller?.subarray(3 * e, 3 * e + 3) ?? [];
    return Array.from(values).filter((v) => v !== kNone);
  }

  begin(name, e) { return this.arrays[name + '_begin']?.[e] ?? 0; }
  size(name, e) { return this.begin(name, e + 1) - this.begin(name, e); }
  // The numbers of a list's items at an event.
  items(name, e) {
    const each = kLists[name];
    const begin = each * this.begin(name, e), end = each * this.begin(name, e + 1);
    return this.arrays[name]?.subarray(begin, end) ?? new Uint32Array(0);
  }

  // Before every event: how many vertices have been named, and by stage sums of insertions and
  // microseconds.
  add_up() {
    const { count } = this;
    const { added } = this.arrays;
    this.vertices = new Uint32Array(count + 1);
    this.inserted = [1, 2].map(() => new Uint32Array(count + 1));
    this.micros = [1, 2].map(() => new Float64Array(count + 1));
    for (let e = 0; e < count; ++e) {
      const stage = this.stage(e) - 1;
      const came = this.vertex(e) !== kNone ? 1 : 0;
      let named = Math.max(this.vertices[e], came ? this.vertex(e) + 1 : 0);
      for (let n = 3 * this.begin('added', e); n < 3 * this.begin('added', e + 1); ++n) {
        named = Math.max(named, added[n] + 1);
      }
      this.vertices[e + 1] = named;
      for (const s of [0, 1]) {
        this.inserted[s][e + 1] = this.inserted[s][e] + (s === stage ? came : 0);
        this.micros[s][e + 1] = this.micros[s][e] +
                                (s === stage ? this.arrays.event_micros?.[e] ?? 0 : 0);
      }
    }
  }
}

// When facets come and go. A facet's id is its place in the list of those added.
class FacetHistory {
  constructor(trace) {
    const added = trace.arrays.added ?? new Uint32Array(0);
    const removed = trace.arrays.removed ?? new Uint32Array(0);
    this.corners = added;
    this.count = trace.begin('added', trace.count);
    this.birth = new Int32Array(this.count);
    this.death = new Int32Array(this.count).fill(0x7fffffff);
    this.removed = new Int32Array(trace.begin('removed', trace.count)).fill(-1);
    this.unknown = 0;  // that went without having come: 0 in a sound trace

    let bits = 4;
    while (1 << bits < this.count) ++bits;
    const head = new Int32Array(1 << bits).fill(-1), next = new Int32Array(this.count);
    const corners_of = (list, n) => {
      const a = list[3 * n], b = list[3 * n + 1], c = list[3 * n + 2];
      return a < b && a < c ? [a, b, c] : b < c ? [b, c, a] : [c, a, b];
    };
    const slot_of = ([a, b, c]) =>
      (Math.imul(a, 0x9e3779b1) ^ Math.imul(b, 0x85ebca6b) ^ Math.imul(c, 0xc2b2ae35)) >>> 32 - bits;
    const same = (id, key) => {
      const other = corners_of(added, id);
      return other[0] === key[0] && other[1] === key[1] && other[2] === key[2];
    };
    for (let e = 0; e < trace.count; ++e) {
      for (let n = trace.begin('removed', e); n < trace.begin('removed', e + 1); ++n) {
        const key = corners_of(removed, n);
        const slot = slot_of(key);
        let before = -1, id = head[slot];
        while (id >= 0 && !same(id, key)) {
          before = id;
          id = next[id];
        }
        if (id < 0) {
          ++this.unknown;
          continue;
        }
        if (before < 0) head[slot] = next[id];
        else next[before] = next[id];
        this.death[id] = e;
        this.removed[n] = id;
      }
      for (let n = trace.begin('added', e); n < trace.begin('added', e + 1); ++n) {
        const slot = slot_of(corners_of(added, n));
        this.birth[n] = e;
        next[n] = head[slot];
        head[slot] = n;
      }
    }
  }
}

// The facets there are before an event, as a list without gaps.
class LiveFacets {
  // write(slot, id): slot of the list now holds this facet. It is told of every change.
  constructor(trace, history, write) {
    this.trace = trace;
    this.history = history;
    this.write = write;
    this.ids = new Int32Array(history.count);
    this.slot = new Int32Array(history.count).fill(-1);
    this.count = 0;
    this.step = 0;
  }

  insert(id) {
    this.ids[this.count] = id;
    this.slot[id] = this.count;
    this.write(this.count++, id);
  }
  erase(id) {
    const slot = this.slot[id], last = this.ids[--this.count];
    this.slot[id] = -1;
    if (last === id) return;
    this.ids[slot] = last;
    this.slot[last] = slot;
    this.write(slot, last);
  }

  // To the state before event `step`.
  go_to(step) {
    const { trace, history } = this;
    const items = (name) => Math.abs(trace.begin(name, step) - trace.begin(name, this.step));
    if (items('added') + items('removed') > Math.max(2000, trace.begin('added', step) / 4)) {
      this.gather(step);
    }
    for (; this.step < step; ++this.step) {
      const e = this.step;
      for (let n = trace.begin('removed', e); n < trace.begin('removed', e + 1); ++n) {
        if (history.removed[n] >= 0) this.erase(history.removed[n]);
      }
      for (let n = trace.begin('added', e); n < trace.begin('added', e + 1); ++n) this.insert(n);
    }
    for (; this.step > step; --this.step) {
      const e = this.step - 1;
      for (let n = trace.begin('added', e + 1) - 1; n >= trace.begin('added', e); --n) this.erase(n);
      for (let n = trace.begin('removed', e + 1) - 1; n >= trace.begin('removed', e); --n) {
        if (history.removed[n] >= 0) this.insert(history.removed[n]);
      }
    }
  }

  // The state by looking at all facets that had come by then.
  gather(step) {
    const { birth, death } = this.history;
    for (let n = 0; n < this.count; ++n) this.slot[this.ids[n]] = -1;
    this.count = 0;
    const end = this.trace.begin('added', step);
    for (let id = 0; id < end; ++id) {
      if (birth[id] < step && death[id] >= step) this.insert(id);
    }
    this.step = step;
  }
}
