'use strict';
// Begins: figures that name a picture get it in place of their drawing, with its controls.

function begin() {
  const header = JSON.parse(document.getElementById('header').textContent);
  const state = new State(header);
  state.way = 'cubes';
  const act = (change) => (...values) => {
    change(...values);
    state.redraw();
  };
  const boards = [...document.querySelectorAll('figure[data-picture]')].map((figure) => new Board(figure, state, act));
  const sliders = [...document.querySelectorAll('[data-slider]')];
  for (const place of sliders) make_slider(place, place.dataset.slider, state, act);
  state.redraw = () => {
    // All are measured before one is changed.
    for (const board of boards) board.resize();
    for (const shown of [...boards, ...sliders]) shown.refresh();
    for (const number of document.querySelectorAll('[data-number]')) {
      number.textContent = kNumbers[number.dataset.number](state);
    }
  };
  for (const figure of document.querySelectorAll('figure[data-solids]')) {
    put_solids(figure, header[figure.dataset.solids]);
  }
  put_torus(document.getElementById('torus'), header.torus);
  fold_code(matchMedia('(min-width: 62rem)'));
  document.documentElement.classList.add('live');
  state.redraw();
  on_resize(boards[0].board, state.redraw);
  window.lesson = { state };  // for the console, and for tests
}

// Pseudocode is open where there is room beside its picture, and on paper.
function fold_code(has_room) {
  const fold = (is_open) => { for (const code of document.querySelectorAll('.fold')) code.open = is_open; };
  has_room.addEventListener('change', () => fold(has_room.matches));
  window.addEventListener('beforeprint', () => fold(true));
  window.addEventListener('afterprint', () => fold(has_room.matches));
  fold(has_room.matches);
}

// The text of a function or method as the browser has it, with its words in colors.
function code_of(run) {
  const lines = run.toString().replace(/^\(/, `const ${run.name} = (`).split('\n');
  const indent = lines.at(-1).match(/^ */)[0].length;
  const text = [lines[0], ...lines.slice(1).map((line) => line.slice(Math.min(indent, line.search(/\S|$/))))].join('\n');
  const words = new RegExp('(//.*)|(\'[^\']*\'|`[^`]*`)|' +
    '\\b(const|let|for|of|in|if|else|while|return|function|new|null|true|false|continue|break)\\b', 'g');
  const kinds = [null, 'comment', 'string', 'word'];
  return text.split(words).reduce((made, piece, n) => {
    if (piece) made.push(n % 4 === 0 ? piece : element('span', { class: kinds[n % 4] }, piece));
    return made;
  }, []);
}

// A picture of the slice, what is told of it, its controls and its code.
class Board {
  constructor(figure, state, act) {
    this.state = state;
    const kind = this.kind = kPictures[figure.dataset.picture];
    const handles = kind.handles ?? {
      select: (s, n) => { s.chosen = n; },
      move: (s, n, v) => s.move_site(n, v),
      remove: (s, n) => s.remove_site(n),
    };
    const acts = {
      move_site: act((n, v) => handles.move(state, n, v)),
      remove_site: act((n) => handles.remove(state, n)),
      select_site: act((n) => handles.select(state, n)),
      choose_sample: act((i, j) => state.choose_sample(i, j)),
      set_sample: act((value) => state.set_sample(value)),
      point_at: (at) => {
        state.place = at;
        if (kind === kPictures.samples) this.tell();
      },
      press: act((at) => kind.press?.(state, at)),
    };
    const views = element('div', { class: 'views' });
    this.picture = new Picture(views, state.header, acts);
    this.picture.takes_keys = kind.takes_keys;
    this.zoom = kind.zoom && new Picture(views, state.header, acts);
    this.legend = element('ul', { class: 'legend' });
    // What others change is not read out here.
    this.status = element('p', { class: 'status', 'aria-live': 'off' });
    this.controls = kind.controls.map((name) => kControls[name](state, act));
    const is_button = (control) => control.tagName === 'BUTTON';
    this.board = element('div', { class: 'board' }, views, this.legend, this.status,
      element('div', { class: 'controls' }, ...this.controls.filter((control) => !is_button(control)),
              element('div', { class: 'buttons' }, ...this.controls.filter(is_button))),
      element('details', { class: 'script' }, element('summary', {}, 'The code that runs here'),
              element('pre', { tabindex: 0, role: 'group', 'aria-label': 'Code' },
                      ...kind.code().map((run) => element('code', {}, ...code_of(run))))));
    this.board.addEventListener('focusin', () => this.status.setAttribute('aria-live', 'polite'));
    this.board.addEventListener('focusout', () => this.status.setAttribute('aria-live', 'off'));
    figure.querySelector('img').after(this.board);
    this.lines = [...figure.querySelectorAll('[data-line]')];
    this.task = figure.querySelector('[data-task]');
  }

  resize() {
    this.picture.resize();
    this.zoom?.resize(this.kind.zoom.view(this.state));
  }
  refresh() {
    const { picture, zoom, state, kind } = this;
    picture.clear();
    kind.draw(picture, state);
    if (zoom) {
      zoom.clear();
      kind.zoom.draw(zoom, state);
    }
    this.show_legend();
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
  show_legend() {
    const entries = this.kind.legend(this.state), shown = entries.flat().join();
    if (this.shown === shown) return;
    this.shown = shown;
    this.legend.replaceChildren(...entries.map(([shape, name, words]) => element('li', {}, swatch(shape, name), words)));
  }
  // The picture's name says the same as the line below it.
  tell() {
    const lines = this.kind.tell(this.state).join(' ');
    if (this.status.textContent === lines) return;
    this.status.textContent = lines;
    this.picture.svg.setAttribute('aria-label', lines);
    this.zoom?.svg.setAttribute('aria-label', `A voxel, large. ${lines}`);
  }
}

window.addEventListener('error', (event) => {
  const message = document.getElementById('message');
  message.textContent = `Something went wrong: ${event.message}`;
  message.hidden = false;
});
document.addEventListener('DOMContentLoaded', begin);
