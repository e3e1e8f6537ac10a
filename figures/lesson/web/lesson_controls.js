'use strict';
// What the reader changes the state by: sliders and buttons under the pictures, and numbers in the sentences.

// What a slider or a number in a sentence changes, by name.
const kRanges = {
  kappa: { label: 'Isovalue \u03ba', min: 40, max: 65, step: 1, shown: String, get: (s) => s.kappa,
           set: (s, kappa) => s.set_kappa(kappa) },
  which: { label: 'Sample', min: 0, max: (s) => s.field.samples.length - 1, step: 1, shown: () => '',
           get: (s) => s.chosen_sample[1] * s.header.columns + s.chosen_sample[0],
           set: (s, n) => s.choose_sample(n % s.header.columns, Math.floor(n / s.header.columns)) },
  value: { label: 'Its value', min: 0, max: 100, step: 1, shown: String, get: (s) => s.field.at(...s.chosen_sample),
           set: (s, x) => s.set_sample(x) },
  // The sample that the text speaks of: the lower left one where the bodies meet.
  corner: { label: 'The sample at the neck', min: 0, max: 100, step: 1, shown: String,
            get: (s) => s.field.at(...s.header.chosen),
            set: (s, value) => {
              s.choose_sample(...s.header.chosen);
              s.set_sample(value);
            } },
  count: { label: 'Number of sites', min: 1, max: 20, step: 1, shown: String, get: (s) => s.sites.length,
           set: (s, count) => s.set_site_count(count) },
  limit: { label: 'Limit D', min: 0.05, max: 0.5, step: 0.01, shown: (x) => x.toFixed(2), get: (s) => s.limit,
           set: (s, limit) => { s.limit = limit; } },
  shown: { label: 'Rounds', min: 0, max: (s) => shown_rounds(s).last, step: 1, shown: String,
           get: (s) => shown_rounds(s).shown,
           set: (s, n) => { s.shown = n === shown_rounds(s).last ? null : n; } },
};
const most_of = ({ max }, state) => typeof max === 'function' ? max(state) : max;

// A slider or a button; refresh() shows what the state is now.
function range(name, state, act) {
  const { label, min, step, shown, get, set, ...rest } = kRanges[name];
  const made = slider(label, { min, max: most_of(rest, state), step, value: get(state) }, act((x) => set(state, x)));
  const value = element('output');
  made.append(value);
  made.refresh = () => {
    made.input.max = most_of(rest, state);
    made.input.value = get(state);
    value.textContent = shown(get(state));
  };
  return made;
}

// Makes an element of a sentence a slider: its number is dragged to the right and left, or changed by keys. A finger
// that goes up or down over it scrolls the page.
function make_slider(place, name, state, act) {
  const { label, min, step, shown, get, set, ...rest } = kRanges[name];
  const kPixels = 6;  // of a step
  const most = () => most_of(rest, state);
  const change = act((x) => set(state, clamp(Number(x.toFixed(2)), min, most())));
  for (const [key, value] of Object.entries({ role: 'slider', tabindex: 0, 'aria-label': label, 'aria-valuemin': min,
    title: `${label}: drag it, or use the arrow keys` })) place.setAttribute(key, value);
  let held = null;
  place.addEventListener('pointerdown', (event) => {
    event.preventDefault();
    place.focus({ preventScroll: true });
    place.setPointerCapture(event.pointerId);
    held = { x: event.clientX, value: get(state) };
  });
  place.addEventListener('pointermove', (event) => {
    if (held) change(held.value + step * Math.round((event.clientX - held.x) / kPixels));
  });
  for (const kind of ['pointerup', 'pointercancel']) place.addEventListener(kind, () => { held = null; });
  place.addEventListener('keydown', (event) => {
    const now = get(state);
    const next = { ArrowRight: now + step, ArrowUp: now + step, ArrowLeft: now - step, ArrowDown: now - step,
                   PageUp: now + 5 * step, PageDown: now - 5 * step, Home: min, End: most() }[event.key];
    if (next === undefined) return;
    event.preventDefault();
    change(next);
  });
  place.refresh = () => {
    place.textContent = shown(get(state));
    place.setAttribute('aria-valuemax', most());
    place.setAttribute('aria-valuenow', shown(get(state)));
  };
}
function press(label, title, act, is_possible = () => true) {
  const made = button(label, title, act);
  made.refresh = () => { made.disabled = !is_possible(); };
  return made;
}
// Goes on by itself, a step each time, until it is pressed again or nothing is left to do.
function play(title, act, is_possible, pause = 700) {
  let timer = 0;
  const stop = () => {
    clearInterval(timer);
    timer = 0;
    made.refresh();
  };
  const step = () => is_possible() ? act() : stop();
  const made = button('Play', title, () => {
    if (timer) return stop();
    timer = setInterval(step, pause);
    step();
  });
  made.refresh = () => {
    made.textContent = timer ? 'Pause' : 'Play';
    made.disabled = !timer && !is_possible();
  };
  return made;
}
function way(label, title, name, state, act) {
  const made = button(label, title, act(() => { state.way = name; }));
  made.refresh = () => made.setAttribute('aria-pressed', state.way === name);
  return made;
}

const undo = (label) => (s, act) => press(label, 'Take the last change of samples, isovalue or sites back',
                                          act(() => s.undo()), () => s.past.length > 0);

// By name: made from the state, and what wraps a change of it.
const kControls = {
  cubes: (s, act) => way('Marching Cubes', 'Show what Marching Cubes makes', 'cubes', s, act),
  refined: (s, act) => way('A few points', 'A few points: refine the mesh of the sites at once', 'few', s, act),
  kappa: (s, act) => range('kappa', s, act),
  // Any sample, and its value: for keys.
  sample: (s, act) => {
    const which = range('which', s, act), value = range('value', s, act);
    const made = element('div', { class: 'controls', style: 'flex: 1 1 100%' }, which, value);
    made.refresh = () => {
      which.refresh();
      value.refresh();
      which.input.setAttribute('aria-valuetext', `column ${s.chosen_sample[0] + 1}, row ${s.chosen_sample[1] + 1}`);
      value.input.disabled = !s.can_change(...s.chosen_sample);
    };
    return made;
  },
  limit: (s, act) => range('limit', s, act),
  add: (s, act) => press('Add', 'Add a site where T is furthest from all sites', act(() => s.add_furthest_site()),
                         () => Math.max(...s.regions.far) > 0),
  remove: (s, act) => press('Remove', 'Remove the site that is selected (Delete)',
                            act(() => s.remove_site(s.chosen)), () => s.sites.length > 1),
  again: (s, act) => press('Reset', 'Reset the samples, the isovalue and the sites of the beginning',
                           act(() => s.start_again())),
  undo: undo('Undo'),
  // Stage 1: a site a step.
  back: undo('Back'),
  ask: (s, act) => press('Insert v', 'Insert v, the vertex that the certificate asks for',
                         act(() => s.add_site(s.fault.insert)), () => (s.fault?.insert ?? -1) >= 0),
  play_sites: (s, act) => play('Insert what the certificate asks for until it holds',
                               act(() => s.add_site(s.fault.insert)), () => (s.fault?.insert ?? -1) >= 0),
  // Only where it fails.
  certify: (s, act) => {
    const made = press('Certify', 'Certify: insert what the certificate asks for until it holds', act(() => s.certify()));
    made.refresh = () => { made.hidden = s.added.length === 0; };
    return made;
  },
  // Coarsening: a vertex a step.
  back_removal: (s, act) => press('Back', 'Take the last step back', act(() => s.take_back_removal()),
                                  () => s.coarse.length > 1),
  remove_vertex: (s, act) => press('Try p', 'Remove p, if nothing is against it', act(() => s.remove_vertex()),
                                   () => s.tried_vertex() >= 0),
  play_removals: (s, act) => play('Try all vertices in turn', act(() => s.remove_vertex()),
                                  () => s.coarsened.waiting.length > 0, 250),
  // Stage 2: a surface point a step.
  back_round: (s, act) => press('Back', 'Take the last insertion back', act(() => s.take_back_round()),
                                () => s.rounds.length > 1),
  insert: (s, act) => press('Insert x', 'Insert the surface point', act(() => s.insert()),
                            () => s.edge !== null || s.next_facet(s.facets()) !== null),
  play_rounds: (s, act) => play('Insert the surface point of the worst edge until no h is above D', act(() => {
    s.edge = null;
    s.insert();
  }), () => s.next_facet(s.facets()) !== null),
  shown: (s, act) => range('shown', s, act),
  worst: (s, act) => press('Worst', 'Select the worst edge, the one that is furthest from \u03a3',
                           act(() => { s.edge = null; })),
  next: (s, act) => press('Next', 'Select the next edge, the one after this one', act(() => {
    const facets = s.facets(), at = facets.indexOf(s.facet(facets));
    s.edge = facets[(at + 1) % facets.length].center;
  })),
};
