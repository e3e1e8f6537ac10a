'use strict';
// The page's address says behind # what the page shows, so that a link opens the same view. It has the
// camera, the brushes, and each choice, switch and slider of the panel that has been changed.

// Inputs without a word of their own, by what they are called, numbered where several are called the same.
function named_inputs(panel) {
  const names = new Map();
  for (const input of panel.querySelectorAll('select, input:not([data-own])')) {
    const label = input.getAttribute('aria-label') ?? input.parentElement.textContent;
    const word = label.toLowerCase().replace(/[^a-z0-9]+/g, '-');
    let name = word;
    for (let n = 2; names.has(name); ++n) name = `${word}-${n}`;
    names.set(name, input);
  }
  return names;
}

const value_of = (input) => input.type === 'checkbox' ? String(Number(input.checked)) : input.value;

// Angles, then, where not all is seen, target and distance in multiples of the scene's size.
function camera_text(camera) {
  const place = camera.fitted ? [] :
    [...scaled(subtract(camera.target, camera.middle), 1 / camera.radius), camera.distance / camera.radius];
  return [camera.azimuth, camera.elevation, ...place].map((x) => Number(x.toPrecision(5))).join(',');
}

// True if it is a camera's text, of which the camera then is.
function set_camera(camera, text) {
  const numbers = text.split(',').map(Number);
  if (![2, 6].includes(numbers.length) || !numbers.every(Number.isFinite)) return false;
  camera.glide = null;
  camera.turn(numbers[0] - camera.azimuth, numbers[1] - camera.elevation);
  if (numbers.length === 6) {
    camera.target = add(camera.middle, scaled(numbers.slice(2, 5), camera.radius));
    camera.distance = clamp(numbers[5], 1e-4, 40) * camera.radius;
  }
  camera.fitted = numbers.length === 2;
  return true;
}

const brush_word = (histogram) => ({
  name: 'brush-' + histogram.key,
  get: () => histogram.brush ? `${histogram.brush.from}-${histogram.brush.to}` : '',
  set: (text) => {
    const [from, to] = text.split('-').map(Number);
    const is_brush = text !== '' && 0 <= from && from <= to && to < kBins && Number.isInteger(from + to);
    histogram.set(is_brush ? { from, to } : null);
  } });

class Address {
  // words: {name, get, set} of what has no input; their texts are empty at first.
  constructor(scene, panel, words) {
    Object.assign(this, { scene, words, inputs: named_inputs(panel) });
    this.first = new Map([...this.inputs].map(([name, input]) => [name, value_of(input)]));
    this.timer = 0;
    this.open(location.hash);
    window.addEventListener('hashchange', () => this.open(location.hash));
    // Browsers refuse to change an address too often.
    scene.after_draw = () => {
      this.timer ||= setTimeout(() => {
        this.timer = 0;
        if (!scene.camera.glide) history.replaceState(null, '', '#' + this.text());
      }, 400);
    };
    scene.invalidate();
  }

  text() {
    const words = new URLSearchParams({ camera: camera_text(this.scene.camera) });
    for (const [name, input] of this.inputs) {
      if (value_of(input) !== this.first.get(name)) words.set(name, value_of(input));
    }
    for (const { name, get } of this.words) if (get() !== '') words.set(name, get());
    return words.toString().replaceAll('%2C', ',');
  }

  // What the text does not name becomes what it was at first; what it says wrongly is left as it is.
  open(hash) {
    const words = new URLSearchParams(hash.slice(1));
    // From the last to the first: a switch comes before what switches it on.
    for (const [name, input] of [...this.inputs].reverse()) {
      const before = value_of(input), value = words.get(name) ?? this.first.get(name);
      if (value === before) continue;
      if (input.type === 'checkbox') {
        input.checked = value === '1';
      } else {
        input.value = value;
        if (input.value === '') input.value = before;  // no such choice
      }
      input.dispatchEvent(new Event(input.type === 'range' ? 'input' : 'change'));
    }
    for (const { name, get, set } of this.words) {
      const text = words.get(name) ?? '';
      if (text !== get()) set(text);
    }
    const { camera } = this.scene;
    if (set_camera(camera, words.get('camera') ?? '') && camera.fitted) this.scene.fit(false);
    this.scene.invalidate();
  }
}
