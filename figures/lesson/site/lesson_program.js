// SPDX-License-Identifier: MIT
// On a site that has the program for browsers: the reader's slice as a body in space, meshed by the program. It
// is loaded when it is asked for; from then on every change of the slice is meshed again.

const kLayers = 4;  // on each side of the slice
const kBend = 4;    // a sample of the layer at height z is less by this times z squared

// The body as a NRRD file; its middle layer is the slice.
function volume_of({ columns, rows, samples }) {
  const head = ['NRRD0004', 'type: float', 'dimension: 3', `sizes: ${columns} ${rows} ${2 * kLayers + 1}`, 'endian: little',
                'encoding: raw', '', ''].join('\n');
  const values = Float32Array.from({ length: (2 * kLayers + 1) * samples.length }, (_, n) =>
    samples[n % samples.length] - kBend * (Math.floor(n / samples.length) - kLayers) ** 2);
  return new Blob([head, values]);
}

// {points, triangles} of an OBJ file.
function mesh_of(obj) {
  const lines = obj.split('\n');
  const rows = (kind) => lines.filter((line) => line.startsWith(`${kind} `)).map((line) => line.split(' ').slice(1));
  return { points: rows('v').map((row) => row.map(Number)),
           triangles: rows('f').map((row) => row.map((n) => parseInt(n) - 1)) };
}

const beside = (name) => new URL(name, import.meta.url);
let module = null;

// Runs the program. Returns its answer {status, said, errors, outputs}; throws what is told of it.
async function run(args, files, wanted) {
  module ??= await WebAssembly.compile(await (await fetch(beside('deliso.wasm'))).arrayBuffer());
  const worker = new Worker(beside('worker.js'), { type: 'module' });
  const answer = await new Promise((resolve) => {
    worker.onmessage = ({ data }) => { if (data.progress === undefined) resolve(data); };
    worker.onerror = ({ message }) => resolve({ fault: message });
    worker.postMessage({ module, args, files, wanted });
  });
  worker.terminate();
  if (answer.fault !== undefined || answer.done.status !== 0) throw new Error(answer.fault ?? answer.done.errors.trim());
  return answer.done;
}

function set_up(figure, state) {
  const svg = svg_element('svg', { role: 'img', tabindex: 0 });
  const status = element('p', { class: 'status', 'aria-live': 'polite' }, 'Nothing is loaded yet: the program has 4 MB.');
  let solid = null, shown = '', is_running = false, is_asked = false;
  let [yaw, pitch] = [0.2, 0.75];
  const draw = () => solid?.draw(yaw, pitch);
  const show = ({ points, triangles }) => {
    const { columns, rows } = state.field, middle = [(columns - 1) / 2, (rows - 1) / 2, kLayers];
    const placed = (p) => scaled(subtract(p, middle), 2 / columns);
    const at = points.map(placed);
    // Sigma in the slice, on it.
    const curves = state.contour.curves.flatMap((curve) => curve.map((p, n) =>
      ({ points: [p, curve[(n + 1) % curve.length]].map((q) => placed([...q, kLayers])), line: 'joined', lift: 0.06 })));
    const facets = triangles.map((t) => ({ points: t.map((v) => at[v]), front: 'outer', back: 'inner', lit: true }));
    solid = new Solid(svg, [...facets, ...curves], 2.3, 1.22);
    draw();
  };
  // The slice as it is. A change during a run is meshed after it.
  const mesh = async () => {
    const asked = JSON.stringify([state.field.samples, state.kappa, state.limit]);
    if (is_running || asked === shown) return;
    is_running = is_asked = true;
    shown = asked;
    press.disabled = true;
    if (!module) status.textContent = 'The program is loaded.';
    try {
      const args = ['slice.nrrd', '--iso', String(state.kappa), '--max-distance', `${state.limit.toFixed(2)}vox`,
                    '-o', 'body.obj'];
      const begun = performance.now();
      const { said, outputs } = await run(args, { 'slice.nrrd': volume_of(state.field) }, ['body.obj']);
      const seconds = ((performance.now() - begun) / 1000).toFixed(2);
      show(mesh_of(new TextDecoder().decode(outputs['body.obj'])));
      const [, counts, topology] = /^mesh +(.*) ->.*\n +(.*)/m.exec(said);
      status.textContent = `${counts}; ${topology}. By deliso ${args.slice(0, 5).join(' ')}, in ${seconds} s.`;
    } catch (fault) {
      status.textContent = `The program could not do it: ${fault.message}`;
    }
    svg.setAttribute('aria-label', `The body. ${status.textContent} Arrow keys turn it.`);
    is_running = false;
    mesh();
  };
  const press = button('Mesh it', 'Mesh it: load the program and run it on this slice', mesh);
  listen_to_turns(svg, (across, up) => {
    yaw += across;
    pitch = clamp(pitch + up, -1.5, 1.5);
    draw();
  });
  svg.setAttribute('aria-label', 'The body, not meshed yet');
  const controls = element('div', { class: 'controls' }, press);
  figure.prepend(element('div', { class: 'board torus meshed' }, svg, status, controls));
  const { redraw } = state;
  state.redraw = () => {
    redraw();
    if (is_asked) mesh();
  };
}

// After the page has begun.
document.addEventListener('DOMContentLoaded', () => set_up(document.getElementById('body'), lesson.state));
