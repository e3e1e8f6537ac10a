// SPDX-License-Identifier: MIT
// The page: a volume, an isovalue, a mesh. Each step is one run of the program in a worker. A newer run ends an
// older one, and so does the stop button.
import { command_of, heights_of, histogram_of, input_of, label_in, label_to_try, rounded, stem_of, words_of } from './report.js';

const by_id = (id) => document.getElementById(id);
const kFormats = ['ply', 'stl', '3mf', 'glb'];
const kMaySlide = 250;  // milliseconds that the isovalue stands still before its surface is looked at

// files: {path: Blob}; input: the path that the program opens; range: of its samples; info: with --json.
const volume = { files: {}, input: '', range: [0, 1] };
// Of the last mesh: its arguments without -o, and its files by format.
const made = { args: [], files: {} };
let module = null, worker = null, waiting = null;

function show(id, on = true) {
  by_id(id).hidden = !on;
}

function say(text) {
  by_id('message').textContent = text;
  show('message', text !== '');
}

// Ends what runs. Its caller learns that with null.
function stop() {
  worker?.terminate();
  worker = null;
  waiting?.(null);
  waiting = null;
  show('run', false);
}

// Sends a job to a worker. Returns its answer, or null if it was stopped or failed, which the page then says.
async function job(task, stage) {
  stop();
  say('');
  show('run');
  by_id('stage').textContent = stage;
  by_id('progress').removeAttribute('value');
  worker = new Worker('worker.js', { type: 'module' });
  const current = worker;
  const answer = await new Promise((resolve) => {
    waiting = resolve;
    current.onmessage = ({ data }) => {
      if (data.progress === undefined) return resolve(data);
      by_id('progress').value = data.progress;
      by_id('stage').textContent = data.stage;
    };
    current.onerror = (event) => resolve({ fault: event.message });
    current.postMessage(task);
  });
  if (!answer) return null;
  stop();
  if (answer.fault === undefined) return answer.done;
  say(`It cannot be done here: ${answer.fault}`);
  return null;
}

// Runs the program. Returns {said, errors, outputs} or null, as job() does, also for bad usage or input.
async function run(args, wanted, stage) {
  const done = await job({ module, args, files: volume.files, wanted }, stage);
  if (!done) return null;
  if (done.errors.trim()) say(done.errors.trim());
  return done.status === 2 ? null : done;
}

// A new volume: what is in it, and which isovalues may be of interest.
async function open_volume(files, name) {
  const input = input_of(Object.keys(files));
  for (const id of ['isovalue-section', 'mesh-section', 'result', 'slices']) show(id, false);
  for (const id of ['loaded', 'surface']) by_id(id).textContent = '';
  Object.assign(volume, { files, input });
  const done = await run(['info', input, '--json', 'info.json'], ['info.json'], `reading ${name}`);
  if (!done) return;
  const info = JSON.parse(new TextDecoder().decode(done.outputs['info.json']));
  volume.range = info.volume.range;
  by_id('loaded').textContent = `${name}: ${info.volume.dims.join(' × ')} ${info.volume.type} samples from ` +
    `${Number(volume.range[0].toPrecision(6))} to ${Number(volume.range[1].toPrecision(6))}`;
  by_id('info').textContent = done.said;
  draw_histogram(histogram_of(done.said));
  suggest(info.suggestions.map((one) => rounded(one.isovalue, volume.range)), label_to_try(done.said));
  show('isovalue-section');
  show('mesh-section');
  look();
}

function draw_histogram(bars) {
  const heights = heights_of(bars);
  by_id('histogram').replaceChildren(...bars.map(({ from, share }, n) => {
    const bar = document.createElement('div');
    bar.style.height = `${100 * heights[n]}%`;
    bar.title = `from ${from}: ${share} %`;
    return bar;
  }));
  const mark = document.createElement('div');
  mark.className = 'mark';
  by_id('histogram').append(mark);
}

// Zero is what a formula is about; a segmentation has labels.
function suggest(isovalues, label) {
  const [low, high] = volume.range;
  const is_formula = volume.input === kSampled && low < 0 && high > 0;
  const all = [...new Set([...(is_formula ? [0] : []), ...isovalues])];
  const button = (text, meaning, choose) => {
    const made = document.createElement('button');
    made.type = 'button';
    made.textContent = text;
    made.setAttribute('aria-label', meaning);
    made.addEventListener('click', () => {
      choose();
      look();
    });
    return made;
  };
  const labels = (label === null ? [] : [label, 'all']).map((one) =>
    button(one === 'all' ? 'all labels' : `label ${one}`, one === 'all' ? 'Mesh all labels' : `Mesh label ${one}`,
           () => set_label(one)));
  by_id('suggestions').replaceChildren(...(all.length + labels.length > 0 ? ['Try'] : []), ...labels,
    ...all.map((value) => button(value, `Isovalue ${value}`, () => {
      set_label(null);
      set_isovalue(value);
    })));
  Object.assign(by_id('slider'), { min: low, max: high });
  set_label(label);
  set_isovalue(all[0] ?? rounded((low + high) / 2, volume.range));
}

// A label is meshed in place of an isovalue, by an option.
function set_label(label) {
  const others = by_id('options').value.replace(/ *--label +\S+/, '').trim();
  by_id('options').value = label === null ? others : `${others} --label ${label}`.trim();
  show_command();
}
function set_isovalue(value) {
  by_id('isovalue').value = value;
  by_id('slider').value = value;
  const [low, high] = volume.range, share = Math.min(1, Math.max(0, (value - low) / (high - low || 1)));
  const mark = by_id('histogram').querySelector('.mark');
  if (mark) mark.style.left = `calc(${100 * share}% - 1px)`;
  show_command();
}

// The surface of this isovalue, or label, in three slices, and its topology.
async function look() {
  clearTimeout(look.timer);
  const isovalue = by_id('isovalue').value, label = label_in(further_options());
  const what = label === null ? ['--iso', isovalue] : ['--label', label];
  const args = ['info', volume.input, ...what, '-o', 'slices.png', '--json', 'info.json', ...smoothing()];
  const done = label === 'all' ? null : await run(args, ['slices.png', 'info.json'], 'looking at the surface');
  by_id('surface').textContent = '';
  show('slices', done !== null);
  if (!done) return;
  const { topology } = JSON.parse(new TextDecoder().decode(done.outputs['info.json'])).surface;
  const count = (number, noun) => `${number.toLocaleString('en')} ${noun}${number === 1 ? '' : 's'}`;
  by_id('surface').textContent = `${label === null ? `At ${isovalue}` : `Label ${label}`}: ` +
    `${count(topology.components, 'component')}, Euler number ${topology.euler}, ` +
    count(topology.boundary_loops, 'boundary loop');
  URL.revokeObjectURL(by_id('slices').src);
  by_id('slices').src = URL.createObjectURL(new Blob([done.outputs['slices.png']], { type: 'image/png' }));
}
function look_soon() {
  clearTimeout(look.timer);
  look.timer = setTimeout(look, kMaySlide);
}

function smoothing() {
  const voxels = Number(by_id('smooth').value);
  return voxels > 0 ? ['--smooth', `${voxels}vox`] : [];
}
function further_options() {
  return words_of(by_id('options').value);
}
function mesh_arguments() {
  const distance = by_id('distance').value, further = further_options();
  const has_size = further.some((word) => /^--(max-distance|vertices|triangles)$/.test(word));
  const side = by_id('below').checked ? ['--inside', 'below'] : [];
  return [volume.input, ...(label_in(further) === null ? ['--iso', by_id('isovalue').value, ...side] : []),
    ...(distance === '0.1' || distance === '' || has_size ? [] : ['--max-distance', `${distance}vox`]),
    ...smoothing(), ...(by_id('cap').checked ? ['--cap'] : []), ...further];
}
// All labels are one mesh, whose regions have common surfaces.
function saved_as(args, name) {
  return [...args, label_in(args) === 'all' ? '--shared' : '-o', name];
}
function show_command() {
  by_id('command').textContent = command_of(saved_as(mesh_arguments(), 'mesh.ply'));
}

async function make_mesh() {
  clearTimeout(look.timer);
  show('result', false);
  const args = mesh_arguments();
  const done = await run(saved_as(args, 'mesh.ply'), ['mesh.ply'], 'meshing');
  const mesh = done?.outputs['mesh.ply'];
  if (!mesh) return;
  Object.assign(made, { args, files: { ply: mesh } });
  by_id('report').textContent = done.said;
  show('result');
  by_id('result-title').focus();
  await show_mesh(mesh);
}

// The page that `deliso view` makes is one file, which the frame shows.
async function show_mesh(mesh) {
  const message = by_id('message').textContent;
  const files = { 'mesh.ply': new Blob([mesh]) };
  const done = await job({ module, args: ['view', 'mesh.ply', '-q', '-o', 'view.html'], files, wanted: ['view.html'] },
                         'showing the mesh');
  if (!done?.outputs['view.html']) return;
  say(message);
  URL.revokeObjectURL(by_id('view').src);
  by_id('view').src = URL.createObjectURL(new Blob([done.outputs['view.html']], { type: 'text/html' }));
}

// The same mesh in another format is the same run with another name, and made when it is asked for.
async function download(format) {
  if (!made.files[format]) {
    const name = `mesh.${format}`;
    const done = await run(saved_as([...made.args, '-q'], name), [name], `writing ${format.toUpperCase()}`);
    if (!done?.outputs[name]) return;
    made.files[format] = done.outputs[name];
  }
  const link = document.createElement('a');
  link.href = URL.createObjectURL(new Blob([made.files[format]]));
  link.download = `${stem_of(volume.input)}.${format}`;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 60000);
}

const kSampled = 'function.nrrd';
async function open_formula(event) {
  event.preventDefault();
  const formula = by_id('formula').value, size = Number(by_id('size').value), half = Number(by_id('half').value);
  const done = await job({ formula, size, half }, 'sampling');
  if (done) await open_volume({ [kSampled]: new Blob([done.file]) }, formula);
}

function open_list(list) {
  const files = Object.fromEntries([...list].map((file) => [file.webkitRelativePath || file.name, file]));
  if (list.length > 0) open_volume(files, list.length === 1 ? list[0].name : `${list.length} files`);
}

// Folders that are dropped have to be walked.
async function files_below(entry) {
  if (entry.isFile) {
    return [[entry.fullPath.slice(1), await new Promise((resolve, reject) => entry.file(resolve, reject))]];
  }
  const reader = entry.createReader(), all = [];
  for (;;) {
    // It hands out some at a time, and none at the end.
    const some = await new Promise((resolve, reject) => reader.readEntries(resolve, reject));
    if (some.length === 0) return all;
    for (const one of some) all.push(...await files_below(one));
  }
}
async function drop(event) {
  event.preventDefault();
  by_id('drop').classList.remove('over');
  const entries = [...event.dataTransfer.items].map((item) => item.webkitGetAsEntry?.()).filter(Boolean);
  if (entries.length === 0) return open_list(event.dataTransfer.files);
  const found = (await Promise.all(entries.map(files_below))).flat();
  await open_volume(Object.fromEntries(found), entries.length === 1 ? entries[0].name : `${found.length} files`);
}

async function show_help() {
  if (by_id('help-text').textContent !== '' || !by_id('help').open) return;
  const done = await run(['help', 'mesh'], [], 'looking up');
  by_id('help-text').textContent = done?.said ?? '';
}

async function begin() {
  try {
    const bytes = await (await fetch('deliso.wasm')).arrayBuffer();
    module = await WebAssembly.compile(bytes);
  } catch (fault) {
    by_id('begin').textContent = `The program cannot be loaded: ${fault.message}`;
    return;
  }
  for (const format of kFormats) {
    const button = document.createElement('button');
    button.type = 'button';
    button.textContent = format.toUpperCase();
    button.addEventListener('click', () => download(format));
    by_id('downloads').append(button);
  }
  for (const kind of ['files', 'folder']) {
    by_id(`choose-${kind}`).addEventListener('click', () => by_id(kind).click());
    by_id(kind).addEventListener('change', () => open_list(by_id(kind).files));
  }
  // A drop anywhere, as one that misses would open the file in place of the page.
  document.addEventListener('dragover', (event) => {
    event.preventDefault();
    by_id('drop').classList.add('over');
  });
  document.addEventListener('dragleave', () => by_id('drop').classList.remove('over'));
  document.addEventListener('drop', drop);
  by_id('formula-form').addEventListener('submit', open_formula);
  by_id('slider').addEventListener('input', () => {
    set_isovalue(rounded(Number(by_id('slider').value), volume.range));
    look_soon();
  });
  by_id('isovalue').addEventListener('input', () => {
    set_isovalue(by_id('isovalue').value);
    if (by_id('isovalue').value !== '') look_soon();
  });
  for (const id of ['distance', 'smooth', 'below', 'cap', 'options']) by_id(id).addEventListener('input', show_command);
  by_id('smooth').addEventListener('change', look_soon);
  by_id('help').addEventListener('toggle', show_help);
  by_id('mesh').addEventListener('click', make_mesh);
  by_id('stop').addEventListener('click', () => {
    stop();
    say('Stopped.');
    // The button is gone, and would take the focus with it.
    by_id(by_id('mesh-section').hidden ? 'choose-files' : 'mesh').focus();
  });
  show('begin', false);
  show('main');
}
begin();
