'use strict';
// Elements of the page, and numbers as it writes them.

// element('button', {class: 'x', onclick: f, 'aria-label': 'y'}, 'text', otherElement, ...)
function element(tag, attributes = {}, ...children) {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (name.startsWith('on')) {
      made.addEventListener(name.slice(2), value);
    } else if (value === true) {
      made.setAttribute(name, '');
    } else if (value !== false && value !== undefined) {
      made.setAttribute(name, value);
    }
  }
  made.append(...children);
  return made;
}

// A part of the panel that can be folded away.
function section(title, open, ...children) {
  return element('details', { class: 'section', open }, element('summary', {}, title),
                 element('div', { class: 'content' }, ...children));
}

// A switch with a text beside it. change(checked) is called when it is used.
function toggle(label, checked, change, color) {
  const input = element('input', { type: 'checkbox', onchange: () => change(input.checked) });
  input.checked = checked;
  const swatch = color === undefined ? [] :
    [element('span', { class: 'swatch', style: `background:${css_color(color)}` })];
  const made = element('label', { class: 'toggle' }, input, ...swatch, element('span', {}, label));
  made.input = input;
  return made;
}

// choices: pairs of a value and what stands for it.
function choice(label, choices, value, change) {
  const select = element('select', { 'aria-label': label, onchange: () => change(select.value) });
  for (const [key, text] of choices) select.append(element('option', { value: key }, text));
  select.value = value;
  const made = element('label', { class: 'choice' }, element('span', {}, label), select);
  made.select = select;
  return made;
}

function slider(label, { min, max, step, value }, change) {
  const input = element('input', { type: 'range', min, max, step, 'aria-label': label,
                                   oninput: () => change(Number(input.value)) });
  input.value = value;
  const made = element('label', { class: 'choice' }, element('span', {}, label), input);
  made.input = input;
  return made;
}

// Its name is its text, so that it can be called by what one sees, and the title says more. A sign or a
// picture has the title for a name.
function button(label, title, press) {
  const name = /\w/.test(label) ? undefined : title;
  return element('button', { type: 'button', title, 'aria-label': name, onclick: press }, label);
}

// A symbol of page.html, made anew as an element.
function icon(name) {
  const symbol = document.getElementById('icon-' + name);
  const made = symbol.parentNode.cloneNode(false);
  made.removeAttribute('hidden');
  made.setAttribute('viewBox', symbol.getAttribute('viewBox'));
  made.setAttribute('class', 'icon');
  made.append(...[...symbol.children].map((child) => child.cloneNode(true)));
  return made;
}

function icon_button(name, title, press) {
  const made = button('', title, press);
  made.append(icon(name));
  return made;
}

const grouped = (n) => Math.round(n).toLocaleString('en');
const counted = (n, one, many) => `${grouped(n)} ${n === 1 ? one : many}`;

// To three significant digits or so.
function rounded(x) {
  if (!Number.isFinite(x)) return Number.isNaN(x) ? '-' : x > 0 ? '\u221e' : '-\u221e';
  if (x === 0) return '0';
  const size = Math.abs(x);
  const digits = size >= 1000 && size < 1e6 ? Math.ceil(Math.log10(size + 1)) : 3;
  return String(Number(x.toPrecision(digits)));
}

// A canvas's own resolution made that of the screen; the 2D context is scaled to CSS pixels.
function fit_canvas(canvas, width, height) {
  const ratio = Math.min(window.devicePixelRatio || 1, 3);
  const columns = Math.max(1, Math.round(width * ratio)), rows = Math.max(1, Math.round(height * ratio));
  if (canvas.width !== columns || canvas.height !== rows) {
    canvas.width = columns;
    canvas.height = rows;
  }
  const context = canvas.getContext('2d');
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  context.clearRect(0, 0, width, height);
  return context;
}

// Calls act() when the element's size has changed, before the next picture.
function on_resize(target, act) {
  new ResizeObserver(() => requestAnimationFrame(act)).observe(target);
}

const prefers_stillness = () => matchMedia('(prefers-reduced-motion: reduce)').matches;

// Dark or light: the system's choice until the button is used.
function set_up_theme(changed) {
  const root = document.documentElement;
  const system = matchMedia('(prefers-color-scheme: dark)');
  let chosen = null;
  const apply = () => {
    root.dataset.theme = chosen ?? (system.matches ? 'dark' : 'light');
    changed();
  };
  system.addEventListener('change', apply);
  const turn = () => {
    chosen = root.dataset.theme === 'dark' ? 'light' : 'dark';
    apply();
  };
  document.getElementById('theme-button').addEventListener('click', turn);
  apply();
  return turn;
}

// The overlay with help; `groups`: [heading, [[keys, meaning], ...]], ...
function set_up_help(intro, groups) {
  const dialog = document.getElementById('help');
  const tables = groups.map(([heading, rows]) =>
    element('div', {}, element('h3', {}, heading),
            element('dl', { class: 'keys' }, ...rows.flatMap(([keys, meaning]) =>
              [element('dt', {}, ...keys.split(' ').map((key) => element('kbd', {}, key))),
               element('dd', {}, meaning)]))));
  dialog.append(element('h2', { id: 'help-title' }, 'How to use this page'),
                ...intro.map((text) => element('p', {}, text)),
                element('div', { class: 'columns' }, ...tables),
                element('form', { method: 'dialog' }, element('button', {}, 'Close')));
  dialog.addEventListener('click', (event) => {
    if (event.target === dialog) dialog.close();
  });
  const turn = () => dialog.open ? dialog.close() : dialog.showModal();
  document.getElementById('help-button').addEventListener('click', turn);
  return turn;
}

// Keys that work wherever the focus is, but for where text or a choice is entered. A name is the
// event's key, with 'Shift+' in front for keys that are no characters.
function listen_to_keys(actions) {
  document.addEventListener('keydown', (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || event.defaultPrevented) return;
    const target = event.target;
    const takes_keys = target.matches?.('select, textarea, input:not([type=checkbox])');
    if (takes_keys && event.key !== 'Escape') return;
    if (event.key === ' ' && target.matches?.('button, summary, input')) return;
    const shifted = event.shiftKey && event.key.length > 1 ? 'Shift+' : '';
    const action = actions[shifted + event.key] ?? actions[shifted + event.key.toLowerCase()];
    if (!action) return;
    event.preventDefault();
    action();
  });
}
