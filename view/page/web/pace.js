'use strict';
// What runs along the timeline: the places of events, the seconds that playback stays at one, and two
// curves.

const kPlaySeconds = 60, kMostSeconds = 1.5;  // of a whole trace, and of one event

const kMeasured = ['h', 'h/r', 'r/l', 'r/pole', 'r'];  // criteria whose value is times the limit

// All events of one kind together last as the root of their number, so the rare last longer each.
function seconds_of_events(trace) {
  const { event_routine: routine, event_reason: reason, event_outcome: outcome } = trace.arrays;
  const counts = new Map(), kinds = [];
  for (let e = 0; e < trace.count; ++e) {
    const kind = (routine[e] << 16) + ((reason?.[e] ?? 0) << 8) + (outcome?.[e] ?? 0);
    kinds.push(kind);
    counts.set(kind, (counts.get(kind) ?? 0) + 1);
  }
  let all = 0;
  for (const n of counts.values()) all += Math.sqrt(n);
  return Float64Array.from(kinds, (kind) =>
    Math.min(kMostSeconds, kPlaySeconds / all / Math.sqrt(counts.get(kind))));
}

// Where events are along the timeline: event e from places[e] to places[e + 1], of 0 to 1. Removals that
// were refused are many and much alike: they are folded, to a tenth of the others' room at most.
const kFoldedShare = 0.1;
function places_of(trace) {
  const is_folded = Array.from({ length: trace.count },
                               (_, e) => trace.routine(e).name === 'removal' && trace.refused(e));
  const folded = is_folded.filter(Boolean).length;
  const width = Math.min(1, kFoldedShare * (trace.count - folded || 1) / folded);
  const places = new Float64Array(trace.count + 1);
  for (let e = 0; e < trace.count; ++e) places[e + 1] = places[e] + (is_folded[e] ? width : 1);
  return places.map((place) => place / (places[trace.count] || 1));
}

// The event at a place of the timeline.
function event_at(places, place) {
  let low = 0, high = places.length - 1;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (places[middle] <= place) low = middle;
    else high = middle;
  }
  return low;
}

// Of the criteria with a limit the first that the trace has: its name; null without one.
function measured_criterion(trace) {
  const used = new Set(trace.reasons_used.map((n) => trace.reasons[n]?.name));
  return kMeasured.find((name) => used.has(name)) ?? null;
}

// The vertices that the surface has after every event.
function live_vertices(trace) {
  const facets_at = new Int32Array(trace.points.length / 3), counts = new Uint32Array(trace.count);
  let live = 0;
  for (let e = 0; e < trace.count; ++e) {
    for (const v of trace.items('added', e)) if (facets_at[v]++ === 0) ++live;
    for (const v of trace.items('removed', e)) if (--facets_at[v] === 0) --live;
    counts[e] = live;
  }
  return counts;
}

// Per column of the timeline: the mesh's worst distance, from the switch on, and the vertices of the
// surface, `live` after every event.
function curves_of(trace, live, places, columns) {
  const worst = new Float64Array(columns).fill(NaN), vertices = new Float64Array(columns).fill(NaN);
  for (let e = 0; e < trace.count; ++e) {
    const column = Math.floor(places[e] * columns);
    vertices[column] = live[e];
    const distance = trace.arrays.event_worst?.[e];
    if (distance >= 0 && !(worst[column] >= distance)) worst[column] = distance;
  }
  return { worst, vertices };
}

// A curve from low to high over its highest value; columns without a value are passed over.
function draw_curve(context, values, left, top, height, color, dashes) {
  const most = values.reduce((a, b) => b > a ? b : a, 0);
  if (!(most > 0)) return;
  context.strokeStyle = color;
  context.lineWidth = 1.4;
  context.setLineDash(dashes);
  context.beginPath();
  values.forEach((value, n) => {
    if (Number.isFinite(value)) context.lineTo(left + n, top + height * (1 - 0.92 * value / most));
  });
  context.stroke();
  context.setLineDash([]);
}
