'use strict';
// A tour of a trace: its stops are events of this very trace.

const kInsertions = ['surface_point', 'foot', 'far_point'];

// The event with the greatest weight; -1 where none has a finite one.
function heaviest(trace, weight) {
  let best = -1, most = -Infinity;
  for (let e = 0; e < trace.count; ++e) {
    const w = weight(e);
    if (w > most) [best, most] = [e, w];
  }
  return best;
}

// Whether Stage 1 has made the surface's topology, by the counts of the run.
function topology_at_switch({ topology, exact_topology: exact }) {
  if (!topology || !exact) return 'The topology is done.';
  const counts = ({ components, euler, boundary_loops: loops }) =>
    `${counted(components, 'component', 'components')}, Euler number ${euler} and ` +
    `${counted(loops, 'boundary loop', 'boundary loops')}`;
  const is_right = ['components', 'euler', 'boundary_loops'].every((key) => topology[key] === exact[key]);
  return is_right ? `The topology is right, ${counts(topology)} as the surface has.`
                  : `The topology is wrong, and stays so: ${counts(topology)}, where the surface has ${counts(exact)}.`;
}

// {title, event, text, whole}: event -1, where the trace has none such; `whole`: all is in view.
function tour_stops(trace) {
  return [...(trace.header.program === 'published' ? published_stops : exact_stops)(trace),
          ...stops_in_stage2(trace)];
}

function stop(title, event, text, missing, whole = false) {
  return { title, event, text: event < 0 ? missing : text(event), whole };
}

const kNoEvents = 'The trace has no events.';
const kNoSwitch = 'The trace ends before Stage 2 begins; there is no switch.';

function exact_stops(trace) {
  const facets = (e) => counted(trace.size('added', e), 'facet', 'facets');
  const is_by = (e, name) => trace.routine(e).name === name;
  // The one with the most facets that can be seen well.
  const removal = heaviest(trace, (e) => is_by(e, 'remove_vertices') ? -Math.abs(trace.size('removed', e) - 6) : -Infinity);
  const flips = heaviest(trace, (e) => is_by(e, 'flip_edges') ? trace.size('removed', e) : -Infinity);
  return [
    stop('The exact contour', trace.count > 0 ? 0 : -1, (e) =>
      `The run begins with the exact contour T, ${facets(e)}. It has the topology of the isosurface, and its ` +
      'vertices, the dots, lie on it.', kNoEvents, true),
    stop('A vertex of T goes', removal, (e) =>
      `T is coarsened, a vertex at a time. Of this one ${counted(trace.size('removed', e), 'facet goes', 'facets go')}, ` +
      `and ${counted(trace.size('added', e), 'facet fills', 'facets fill')} the hole. Go on by the right arrow key, ` +
      'to see the next ones go.', 'No vertex of T was removed in this trace.'),
    stop('Edges are flipped', flips, (e) =>
      `Between removals vertices move to the middles of their stars, and edges are flipped: ${trace.size('removed', e) >> 1} ` +
      'or so in this sweep. Then more vertices can go.', 'No edge of T was flipped in this trace.', true),
    stop('The coarsened mesh', trace.switch_at, (e) =>
      `Stage 1 coarsens T to ${facets(e)}, as far as distance and shape allow. ` +
      `${topology_at_switch(trace.header)} Stage 2 gives the mesh its shape.`, kNoSwitch, true),
  ];
}

function published_stops(trace) {
  // Where a test failed, with few enough facets to be seen.
  const failed = (title, reasons, missing) => stop(title, heaviest(trace, (e) =>
    reasons.includes(trace.reason(e)?.name) && !trace.refused(e) ? -Math.abs(trace.size('removed', e) - 8) : -Infinity),
    (e) => `${sentence(trace.reason(e).text.split('; value: ')[0])} A new site is inserted to mend it.`, missing);
  const is_certified = trace.routines_used.some((n) => trace.routines[n]?.name === 'certify');
  return [
    stop('The first sites', trace.count > 0 ? 0 : -1, () =>
      `The run begins with ${counted(trace.vertices[1], 'site', 'sites')} on the isosurface, samples of it. Each dot is one.`,
         kNoEvents, true),
    ...is_certified
      ? [failed('A region that breaks a condition', ['region', 'interface', 'triple', 'boundary'],
                'No region broke a condition in this trace.')]
      : [failed('MultiIntersect', ['several hits'], 'No Voronoi edge met the surface twice in this trace.'),
         failed('ExtractManifold', ['no disk', 'no half disk', 'facet cycle'], 'The facets at no vertex had to be mended in this trace.')],
    stop('From Recover to Refine', trace.switch_at, () =>
      `The switch. ${topology_at_switch(trace.header)} The tetrahedra are left behind, and Refine gives the plain ` +
      'mesh of triangles its shape.', kNoSwitch, true),
  ];
}

function stops_in_stage2(trace) {
  const none = -Infinity;
  const value = (e) => Number.isFinite(trace.value(e)) ? trace.value(e) : 0;
  const because = (e) => trace.reason(e)?.name;
  const done = (e) => !trace.refused(e);
  const operation = (e) => (kOperations[trace.routine(e).name] ?? kOther).label;
  const limit = measured_criterion(trace);
  const cavity = (e) => trace.size('removed', e);
  const insertion = heaviest(trace, (e) => kInsertions.includes(trace.routine(e).name) &&
    done(e) && trace.vertex(e) !== kNone && cavity(e) > 0 && cavity(e) <= 12 ? cavity(e) : none);
  // What refuses it can be drawn, and few facets are around it.
  const refusal = heaviest(trace, (e) => kInsertions.includes(trace.routine(e).name) && trace.refused(e)
    ? (trace.edge(e) ? 1000 : 0) - Math.abs(trace.size('cone', e) - 6) : none);
  const worst = heaviest(trace, (e) => limit && because(e) === limit && trace.stage(e) === 2 ? value(e) : none);
  const last = trace.count - 1;
  const farthest = trace.arrays.event_worst?.[last];
  const live = trace.begin('added', trace.count) - trace.begin('removed', trace.count);
  return [
    stop('An insertion with its cavity', insertion, (e) =>
      `A point is inserted. The cavity of ${counted(cavity(e), 'facet', 'facets')} goes, and a cone of ` +
      `${counted(trace.size('added', e), 'facet', 'facets')} around the point takes its place.`,
         'No point was inserted in Stage 2.'),
    stop('A refused insertion', refusal, (e) =>
      `The operation \u201c${operation(e)}\u201d was refused: ${trace.outcome_text(e)}` +
      `${trace.edge(e) ? ' (in red)' : ''}. Every change is tested, and the mesh stays as it was.`,
         'No insertion was refused in this trace.'),
    stop('The worst facet', worst, (e) =>
      `This facet breaks its criterion most: ${kCriteria[limit].label} is ${rounded(value(e))} times the limit.`,
         'No facet was over a limit in Stage 2.'),
    stop('Done', last, () =>
      `The finished mesh has ${counted(live, 'facet', 'facets')}, after ${counted(trace.count, 'step', 'steps')}` +
      `: ${grouped(trace.inserted[0][trace.count])} points inserted in Stage 1, ` +
      `${grouped(trace.inserted[1][trace.count])} in Stage 2.` + (farthest >= 0
        ? ` The largest distance from the surface is ${rounded(farthest)}, of all facets above r_min.` : ''),
         kNoEvents, true),
  ];
}

class Tour {
  // go(stop, n) shows stop n; leave() takes away what only the tour shows.
  constructor(place, trace, go, leave) {
    Object.assign(this, { place, go, leave, stops: tour_stops(trace), at: -1 });
    const facets = trace.begin('added', trace.count) - trace.begin('removed', trace.count);
    this.opening = `This is the finished surface, ${counted(facets, 'facet', 'facets')} made in ` +
                   `${counted(trace.count, 'step', 'steps')}; the timeline goes back to any of them.`;
    place.hidden = false;
    this.invite();
  }

  get on() { return this.at >= 0; }

  invite() {
    this.place.replaceChildren(element('p', {}, ...with_terms(this.opening)),
      element('div', { class: 'row' }, button('Take the tour', `A tour of ${this.stops.length} stops`, () => this.show(0))));
  }

  show(n) {
    if (n < 0) return;
    if (n >= this.stops.length) return this.end();
    this.at = n;
    const stop = this.stops[n];
    const last = n + 1 === this.stops.length;
    const next = button(last ? 'Explore' : 'Next', 'Next (right arrow)', () => this.show(n + 1));
    const back = button('Back', 'Back (left arrow)', () => this.show(n - 1));
    back.disabled = n === 0;
    this.place.replaceChildren(
      element('p', { 'aria-live': 'polite' },
              element('strong', {}, `${n + 1} of ${this.stops.length}. ${stop.title}. `), ...with_terms(stop.text)),
      element('div', { class: 'row' }, back, next, button('Leave', 'Leave the tour (Escape)', () => this.end())));
    next.focus();
    if (stop.event >= 0) this.go(stop, n);
  }

  step(by) { this.show(this.at + by); }

  end() {
    if (!this.on) return;
    this.at = -1;
    this.invite();
    this.place.querySelector('button').focus();
    this.leave();
  }
}
