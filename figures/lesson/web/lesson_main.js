'use strict';
// Begins: figures that name a picture get it in place of their drawing, with its controls.

function begin() {
  const header = JSON.parse(document.getElementById('header').textContent);
  const state = new State(header);
  state.way = 'cubes';
  const boards = [...document.querySelectorAll('figure[data-picture]')].map((figure) => new Board(figure, state));
  state.redraw = () => {
    for (const board of boards) board.draw();
    for (const number of document.querySelectorAll('[data-number]')) {
      number.textContent = kNumbers[number.dataset.number](state);
    }
  };
  for (const figure of document.querySelectorAll('figure[data-solids]')) {
    put_solids(figure, header[figure.dataset.solids]);
  }
  document.documentElement.classList.add('live');
  state.redraw();
  on_resize(boards[0].board, state.redraw);
  window.lesson = { state };  // for the console, and for tests
}

// A picture of the slice, what is told of it, and its controls.
class Board {
  constructor(figure, state) {
    this.state = state;
    this.kind = kPictures[figure.dataset.picture];
    this.board = element('div', { class: 'board' });
    figure.querySelector('img').after(this.board);
    const act = (change) => (...values) => {
      change(...values);
      state.redraw();
    };
    this.picture = new Picture(this.board, state.header, figure.querySelector('img').alt, {
      move_site: act((n, v) => state.move_site(n, v)),
      remove_site: act((n) => state.remove_site(n)),
      select_site: act((n) => { state.chosen = n; }),
      choose_sample: act((i, j) => state.choose_sample(i, j)),
      set_sample: act((value) => state.set_sample(value)),
      point_at: (at) => {
        state.place = at;
        if (this.kind === kPictures.samples) this.tell();
      },
      press: act((at) => this.kind.press?.(state, at)),
    });
    this.picture.takes_keys = this.kind.takes_keys;
    // What others change is not read out here.
    this.status = element('p', { class: 'status', 'aria-live': 'off' });
    this.board.addEventListener('focusin', () => this.status.setAttribute('aria-live', 'polite'));
    this.board.addEventListener('focusout', () => this.status.setAttribute('aria-live', 'off'));
    this.controls = this.kind.controls.map((name) => kControls[name](state, act));
    this.lines = [...figure.querySelectorAll('[data-line]')];
    this.task = figure.querySelector('[data-task]');
    this.board.append(this.status, element('div', { class: 'controls' }, ...this.controls));
  }

  draw() {
    const { picture, state, kind } = this;
    picture.resize();
    picture.clear();
    kind.draw(picture, state);
    this.tell();
    for (const control of this.controls) control.refresh();
    const running = this.lines.length > 0 ? kind.line(state) : '';
    for (const line of this.lines) {
      if (line.dataset.line === running) line.setAttribute('aria-current', 'step');
      else line.removeAttribute('aria-current');
    }
    if (this.task && !this.task.classList.contains('done') && kTasks[this.task.dataset.task](state)) {
      this.task.classList.add('done');
      this.task.append(' Done.');
    }
  }
  tell() {
    const lines = this.kind.tell(this.state).join(' ');
    if (this.status.textContent !== lines) this.status.textContent = lines;
  }
}

// A slider or a button; refresh() shows what the state is now.
function range(label, limits, shown, get, set, act) {
  const made = slider(label, { ...limits, value: get() }, act(set));
  const value = element('output');
  made.append(value);
  made.refresh = () => {
    made.input.value = get();
    value.textContent = shown(get());
  };
  return made;
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
  refined: (s, act) => way('A few points, refined', 'Refine the mesh of the sites at once', 'few', s, act),
  kappa: (s, act) => range('Isovalue \u03ba', { min: 40, max: 65, step: 1 }, String, () => s.kappa,
                           (kappa) => s.set_kappa(kappa), act),
  // Any sample, and its value: for keys.
  sample: (s, act) => {
    const { columns } = s.header;
    const which = range('Sample', { min: 0, max: s.field.samples.length - 1, step: 1 }, () => '',
                        () => s.chosen_sample[1] * columns + s.chosen_sample[0],
                        (n) => s.choose_sample(n % columns, Math.floor(n / columns)), act);
    const value = range('Its value', { min: 0, max: 100, step: 1 }, String, () => s.field.at(...s.chosen_sample),
                        (x) => s.set_sample(x), act);
    const made = element('div', { class: 'controls', style: 'flex: 1 1 100%' }, which, value);
    made.refresh = () => {
      which.refresh();
      value.refresh();
      which.input.setAttribute('aria-valuetext', `column ${s.chosen_sample[0] + 1}, row ${s.chosen_sample[1] + 1}`);
      value.input.disabled = !s.can_change(...s.chosen_sample);
    };
    return made;
  },
  limit: (s, act) => range('Limit D', { min: 0.05, max: 0.5, step: 0.01 }, (x) => x.toFixed(2), () => s.limit,
                           (limit) => { s.limit = limit; }, act),
  add: (s, act) => press('Add a site', 'Where T is furthest from all sites', act(() => s.add_furthest_site()),
                         () => Math.max(...s.regions.far) > 0),
  remove: (s, act) => press('Remove it', 'Remove the site that is selected (Delete)',
                            act(() => s.remove_site(s.chosen)), () => s.sites.length > 1),
  again: (s, act) => press('Start again', 'The samples, the isovalue and the sites of the beginning',
                           act(() => s.start_again())),
  undo: undo('Undo'),
  // Stage 1: a site a step.
  back: undo('Back'),
  ask: (s, act) => press('Make v a site', 'Insert the vertex that the certificate asks for',
                         act(() => s.add_site(s.fault.insert)), () => (s.fault?.insert ?? -1) >= 0),
  play_sites: (s, act) => play('Insert what the certificate asks for until it holds',
                               act(() => s.add_site(s.fault.insert)), () => (s.fault?.insert ?? -1) >= 0),
  certify: (s, act) => press('Insert until it holds', 'Insert what the certificate asks for',
                             act(() => s.certify()), () => s.added.length > 0),
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
  shown: (s, act) => {
    const made = range('Rounds', { min: 0, max: 1, step: 1 }, String, () => shown_rounds(s).shown,
                       (n) => { s.shown = n === shown_rounds(s).last ? null : n; }, act);
    const refresh = made.refresh;
    made.refresh = () => {
      made.input.max = shown_rounds(s).last;
      refresh();
    };
    return made;
  },
  worst: (s, act) => press('Worst edge', 'Select the edge that is furthest from \u03a3', act(() => { s.edge = null; })),
  next: (s, act) => press('Next edge', 'Select the edge after this one', act(() => {
    const facets = s.facets(), at = facets.indexOf(s.facet(facets));
    s.edge = facets[(at + 1) % facets.length].center;
  })),
};

window.addEventListener('error', (event) => {
  const message = document.getElementById('message');
  message.textContent = `Something went wrong: ${event.message}`;
  message.hidden = false;
});
document.addEventListener('DOMContentLoaded', begin);
