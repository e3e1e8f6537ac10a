'use strict';
// Begins: the page's frame, and one screen of six in it.

// Words between asterisks are terms, said for the first time.
function paragraph(text) {
  const made = element('p');
  text.split('*').forEach((piece, n) => made.append(n % 2 ? element('dfn', {}, piece) : piece));
  return made;
}

function begin() {
  const place = (id) => document.getElementById(id);
  const state = new State(JSON.parse(place('header').textContent));
  let number = -1;

  const draw = () => {
    const screen = kScreens[number];
    picture.svg.setAttribute('aria-label', screen.title);
    picture.resize();
    picture.clear();
    screen.draw(picture, state);
    picture.handles.toggleAttribute('hidden', !screen.controls.includes('again'));
    const lines = screen.tell(state).join(' ');
    if (place('status').textContent !== lines) place('status').textContent = lines;
    for (const name of screen.controls) controls[name].refresh?.();
  };
  const redraw = (act) => (...values) => {
    act(...values);
    draw();
  };
  const picture = new Picture(place('figure'), state.field, {
    move_site: redraw((n, v) => state.move_site(n, v)),
    remove_site: redraw((n) => state.remove_site(n)),
    select_site: (n) => {
      if (n === state.chosen) return;
      state.chosen = n;
      draw();
    },
    point_at: (at) => {
      state.place = at;
      if (number === 0) draw();
    },
    press: (at) => {
      if (number !== 4 || !state.loops) return;
      state.edge = at;
      draw();
    },
  });

  // Slider or button by name; refresh() shows what the state is now.
  const range = (label, limits, shown, get, set) => {
    const made = slider(label, { ...limits, value: get() }, redraw(set));
    const value = element('output');
    made.append(value);
    made.refresh = () => {
      made.input.value = get();
      value.textContent = shown(get());
    };
    return made;
  };
  const press = (label, title, act, is_possible = () => true) => {
    const made = button(label, title, redraw(act));
    made.refresh = () => { made.disabled = !is_possible(); };
    return made;
  };
  const has_mesh = () => state.loops !== null;
  const controls = {
    kappa: range('Isovalue \u03ba', { min: 40, max: 65, step: 1 }, String, () => state.kappa,
                 (kappa) => state.set_kappa(kappa)),
    limit: range('Limit D', { min: 0.05, max: 0.5, step: 0.01 }, (x) => x.toFixed(2), () => state.limit,
                 (limit) => { state.limit = limit; }),
    add: press('Add a site', 'Add a site where T is furthest from all', () => state.add_furthest_site(),
               () => Math.max(...state.regions.far) > 0),
    remove: press('Remove it', 'Remove the site that is selected (Delete)',
                  () => state.remove_site(state.chosen), () => state.sites.length > 1),
    again: press('Start again', 'The first sites and the first isovalue', () => state.start_again()),
    ask: press('Make v a site', 'Insert the vertex that the certificate asks for',
               () => state.add_site(state.fault.insert), () => (state.fault?.insert ?? -1) >= 0),
    certify: press('Insert until it holds', 'Insert what the certificate asks for, until it holds',
                   () => state.certify(), () => state.fault !== null),
    insert: press('Insert x', 'Insert the surface point', () => state.insert(), has_mesh),
    worst: press('Worst edge', 'Select the edge that is furthest from \u03a3',
                 () => { state.edge = null; state.said = ''; }, has_mesh),
    next: press('Next edge', 'Select the next edge', () => {
      const facets = state.facets(), at = facets.indexOf(state.facet(facets));
      state.edge = facets[(at + 1) % facets.length].center;
      state.said = '';
    }, has_mesh),
  };

  const steps = kScreens.map(({ title }, n) => element('button',
    { type: 'button', 'aria-label': `Screen ${n + 1}: ${title}`, title, onclick: () => show(n) }, String(n + 1)));
  const back = button('Back', 'The screen before (P)', () => show(number - 1));
  const on = button('Next', 'The next screen (N)', () => show(number + 1));
  place('steps').append(back, ...steps, on);

  const show = (n) => {
    const to = clamp(n, 0, kScreens.length - 1);
    if (to === number) return;
    number = to;
    const screen = kScreens[number];
    state.said = '';
    place('screen-title').textContent = `${number + 1}. ${screen.title}`;
    place('lead').replaceChildren(...screen.lead.map(paragraph));
    place('more').replaceChildren(...screen.more.map(paragraph));
    place('controls').replaceChildren(...screen.controls.map((name) => controls[name]));
    steps.forEach((step, k) => step.setAttribute('aria-current', k === number ? 'step' : 'false'));
    back.disabled = number === 0;
    on.disabled = number === kScreens.length - 1;
    document.documentElement.dataset.screen = number + 1;
    history.replaceState(null, '', `#${number + 1}`);
    window.scrollTo(0, 0);
    draw();
  };

  const turn_theme = set_up_theme(() => {});
  listen_to_keys({ n: () => show(number + 1), p: () => show(number - 1), t: turn_theme,
                   ...Object.fromEntries(kScreens.map((_, n) => [n + 1, () => show(n)])) });
  window.addEventListener('hashchange', () => show(Number(location.hash.slice(1)) - 1 || 0));
  on_resize(place('figure'), () => { if (number >= 0) draw(); });
  show(Number(location.hash.slice(1)) - 1 || 0);
  place('message').hidden = true;
  window.lesson = { state, show, draw };  // for the console, and for tests
}

window.addEventListener('error', (event) => {
  const message = document.getElementById('message');
  message.textContent = `Something went wrong: ${event.message}`;
  message.hidden = false;
});
document.addEventListener('DOMContentLoaded', begin);
