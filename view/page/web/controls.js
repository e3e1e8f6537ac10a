'use strict';
// Mouse, pen, fingers and keys on the canvas move the camera. One pointer turns; with the right
// button, Shift, or a second finger it pans; the wheel and two fingers zoom.

class Controls {
  // scene: has canvas, camera, place_of(x, y), invalidate(), picked(x, y), fit().
  constructor(scene) {
    this.scene = scene;
    this.pointers = new Map();
    this.moved = 0;
    const { canvas } = scene;
    const on = (name, act, options) => canvas.addEventListener(name, act.bind(this), options);
    on('pointerdown', this.down);
    on('pointermove', this.move);
    on('pointerup', this.up);
    on('pointercancel', this.up);
    on('wheel', this.wheel, { passive: false });
    on('keydown', this.key);
    on('contextmenu', (event) => event.preventDefault());
    on('dblclick', (event) => scene.picked(event.offsetX, event.offsetY, true));
  }

  down(event) {
    this.scene.canvas.setPointerCapture(event.pointerId);
    this.pointers.set(event.pointerId, { x: event.offsetX, y: event.offsetY });
    this.moved = this.pointers.size > 1 ? Infinity : 0;
    this.scene.camera.glide = null;
  }

  move(event) {
    const pointer = this.pointers.get(event.pointerId);
    if (!pointer) return;
    const dx = event.offsetX - pointer.x, dy = event.offsetY - pointer.y;
    const before = this.spread();
    pointer.x = event.offsetX;
    pointer.y = event.offsetY;
    this.moved += Math.abs(dx) + Math.abs(dy);
    const { scene } = this;
    const { camera } = scene;
    const height = scene.height;
    if (this.pointers.size === 2) {
      const after = this.spread();
      camera.pan(0.5 * dx / height, -0.5 * dy / height);
      if (before.size > 0 && after.size > 0) {
        const at = scene.place_of(after.x, after.y);
        camera.zoom(before.size / after.size, at.x * at.aspect, at.y);
      }
    } else if (event.shiftKey || event.buttons & 6) {
      camera.pan(dx / height, -dy / height);
    } else {
      camera.turn(-0.4 * dx, 0.4 * dy);
    }
    scene.invalidate();
  }

  up(event) {
    if (!this.pointers.delete(event.pointerId)) return;
    if (event.type === 'pointerup' && this.moved < 5) {
      this.scene.picked(event.offsetX, event.offsetY, false);
    }
  }

  // The middle of two pointers, and how far apart they are.
  spread() {
    const [p, q] = this.pointers.values();
    if (!q) return { x: 0, y: 0, size: 0 };
    return { x: (p.x + q.x) / 2, y: (p.y + q.y) / 2, size: Math.hypot(q.x - p.x, q.y - p.y) };
  }

  wheel(event) {
    event.preventDefault();
    const lines = event.deltaMode === 1 ? 16 * event.deltaY : event.deltaY;
    const at = this.scene.place_of(event.offsetX, event.offsetY);
    this.scene.camera.zoom(Math.exp(clamp(lines, -240, 240) * 0.0022), at.x * at.aspect, at.y);
    this.scene.invalidate();
  }

  key(event) {
    if (event.ctrlKey || event.metaKey) return;
    const { camera } = this.scene;
    const arrows = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
    const arrow = arrows[event.key];
    if (arrow && event.altKey) {
      camera.pan(-0.05 * arrow[0], -0.05 * arrow[1]);
    } else if (arrow && (event.shiftKey || !this.scene.arrows_step)) {
      camera.turn(6 * arrow[0], 6 * arrow[1]);
    } else if (event.key === '+' || event.key === '=') {
      camera.zoom(0.85);
    } else if (event.key === '-') {
      camera.zoom(1 / 0.85);
    } else {
      return;
    }
    event.preventDefault();
    this.scene.invalidate();
  }
}
