'use strict';
// The canvas: one or two panes along its longer side, with a camera in common and layers of their own.
// Pictures are drawn when something changed, once per frame at most.

class Scene {
  constructor(canvas) {
    this.canvas = canvas;
    this.camera = new Camera();
    this.panes = [{ layers: [], caption: '', clip: null }];
    this.on_pick = () => {};      // (ray, pane, twice)
    this.before_draw = () => {};
    this.after_draw = () => {};
    this.arrows_step = false;     // arrow keys are for something else
    this.waiting = false;
    this.frames = 0;
    this.drawing_ms = 0;          // of the last picture, without the card's own time
    this.view = { project: new Float32Array(16), half_size: new Float32Array(2),
                  key: [0, 0, 1], fill: [0, 0, 1], gloss: [0, 0, 1], outside: [0, 0, 0],
                  inside: [0, 0, 0], edge_color: [0, 0, 0], clip: [0, 0, 0, 1],
                  no_clip: [0, 0, 0, 1], ratio: 1 };
    this.colors_changed();
    this.begin();
    this.controls = new Controls(this);
    on_resize(canvas, () => {
      if (this.camera.fitted) this.fit(false);
      this.show_captions();
    });
    canvas.addEventListener('webglcontextlost', (event) => {
      event.preventDefault();
      this.message('The graphics card is away. The picture comes back with it.');
    });
    canvas.addEventListener('webglcontextrestored', () => {
      this.message('');
      this.begin();
      this.invalidate();
    });
  }

  begin() {
    // Where no graphics card helps, smooth borders would cost half of the speed.
    this.without_card ??= draws_by_software();
    this.gl = this.canvas.getContext('webgl2', { antialias: !this.without_card, alpha: false });
    if (!this.gl) return;
    this.gl.generation = {};
  }

  message(text) {
    const place = document.getElementById('message');
    place.textContent = text;
    place.hidden = text === '';
  }

  colors_changed() {
    this.background = parts_of_color(style_color('--canvas'));
    this.view.edge_color = parts_of_color(style_color('--edge'));
    this.view.outside = parts_of_color(kOutside);
    this.view.inside = parts_of_color(kInside);
    this.invalidate();
  }

  get height() { return this.pane_size.height; }

  // The pane at a place of the canvas, and the place in it, from -1 to 1.
  place_of(x, y) {
    const { width, height } = this.pane_size;
    const number = clamp(this.stacked ? Math.floor(y / height) : Math.floor(x / width),
                         0, this.panes.length - 1);
    const left = this.stacked ? 0 : number * width, top = this.stacked ? number * height : 0;
    return { x: 2 * (x - left) / width - 1, y: 1 - 2 * (y - top) / height,
             aspect: width / height, pane: number };
  }
  get stacked() { return this.canvas.clientHeight > this.canvas.clientWidth; }
  get pane_size() {
    const count = this.panes.length, width = this.canvas.clientWidth || 1;
    const height = this.canvas.clientHeight || 1;
    return this.stacked ? { width, height: height / count } : { width: width / count, height };
  }
  get aspect() {
    const { width, height } = this.pane_size;
    return width / height;
  }

  fit(glide = true) {
    const { camera } = this;
    const kCaption = 34;  // CSS pixels
    const free = this.panes.some((pane) => pane.caption) ? Math.min(kCaption / this.height, 0.3) : 0;
    const goal = camera.place_for(this.aspect, free);
    if (glide) camera.glide_to(goal);
    else Object.assign(camera, goal);
    camera.fitted = true;
    this.invalidate();
  }
  look_from(direction) {
    this.camera.glide_to(this.camera.angles_of(direction));
    this.invalidate();
  }

  picked(x, y, twice) {
    const at = this.place_of(x, y);
    this.on_pick(this.camera.ray(at.x, at.y, at.aspect), at.pane, twice);
  }

  invalidate() {
    if (this.waiting) return;
    this.waiting = true;
    requestAnimationFrame((now) => {
      this.waiting = false;
      if (this.camera.step(now)) this.invalidate();
      this.draw();
    });
  }

  draw() {
    const { gl, canvas, camera, view } = this;
    if (!gl || gl.isContextLost()) return;
    const began = performance.now();
    this.before_draw();
    const ratio = this.without_card ? 1 : Math.min(window.devicePixelRatio || 1, 2);
    const width = Math.max(1, Math.round(canvas.clientWidth * ratio));
    const height = Math.max(1, Math.round(canvas.clientHeight * ratio));
    if (canvas.width !== width || canvas.height !== height) {
      canvas.width = width;
      canvas.height = height;
    }
    const towards = (right, up, back) =>
      unit(add(add(scaled(camera.right, right), scaled(camera.up, up)), scaled(camera.back, back)));
    view.ratio = ratio;
    view.target = camera.target;
    view.unit = 1 / camera.radius;
    view.key = towards(-0.5, 0.6, 0.8);
    view.fill = towards(0.8, -0.1, 0.5);
    view.gloss = towards(-0.25, 0.3, 0.9);
    const { stacked } = this, count = this.panes.length;
    const columns = stacked ? width : Math.floor(width / count);
    const rows = stacked ? Math.floor(height / count) : height;
    camera.project(view.project, columns / rows);
    view.half_size[0] = columns / 2;
    view.half_size[1] = rows / 2;

    gl.enable(gl.DEPTH_TEST);
    gl.depthFunc(gl.LEQUAL);
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
    gl.enable(gl.SCISSOR_TEST);
    this.panes.forEach((pane, n) => {
      const left = stacked ? 0 : n * columns, bottom = stacked ? height - (n + 1) * rows : 0;
      gl.viewport(left, bottom, columns, rows);
      // The last takes the pixels that are left over.
      const last = n + 1 === count;
      gl.scissor(left, last ? 0 : bottom, last ? width - left : columns, last ? bottom + rows : rows);
      gl.clearColor(...this.background, 1);
      gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
      view.clip = pane.clip ?? view.no_clip;
      const shown = pane.layers.filter((layer) => layer.visible && layer.count > 0);
      for (const layer of shown) if (layer.solid) layer.draw(gl, view);
      for (const layer of shown) if (!layer.solid) layer.draw(gl, view);
    });
    this.drawing_ms = performance.now() - began;
    ++this.frames;
    this.after_draw();
  }

  // Captions of the panes, over the canvas.
  show_captions() {
    const place = document.getElementById('captions');
    place.classList.toggle('stacked', this.stacked);
    place.replaceChildren(...this.panes.map((pane) => {
      const made = element('span', {}, pane.caption);
      made.hidden = !pane.caption;
      return element('div', {}, made);
    }));
    this.invalidate();
  }
}
