'use strict';
// A histogram whose bars can be brushed: drag over them, or with the arrow keys when it has the
// focus (Shift changes the upper end). Values of a second mesh are drawn as a line over the bars,
// then both as shares.

const kBins = 48;

class Histogram {
  // measure: {name, unit, lo, hi, values: one array per mesh, open: whether values may lie beyond
  // hi}. changed() is called when the brush is.
  constructor(measure, changed) {
    this.measure = measure;
    this.changed = changed;
    this.brush = null;  // {from, to}: bins, both included
    this.colored = false;
    this.counts = measure.values.map((v) => count_bins(v, measure.lo, measure.hi, kBins));
    this.totals = measure.values.map((v) => v.length);
    this.canvas = element('canvas', { class: 'histogram', tabindex: 0, role: 'slider',
                                      'aria-label': `${measure.name}: brush a range` });
    this.note = element('span', { class: 'note' });
    this.clear_button = button('\u00d7', `Clear the brush of ${measure.name}`, () => this.set(null));
    this.element = element('div', { class: 'measure' },
                           element('div', { class: 'row' }, element('strong', {}, measure.name),
                                   this.note, this.clear_button), this.canvas);
    this.listen();
    on_resize(this.canvas, () => this.draw());
    this.describe();
  }

  get width_of_bin() { return (this.measure.hi - this.measure.lo) / kBins; }

  holds(value) {
    if (!this.brush) return true;
    const bin = clamp(Math.floor((value - this.measure.lo) / this.width_of_bin), 0, kBins - 1);
    const at = value < this.measure.hi ? bin : kBins - 1;
    return this.brush.from <= at && at <= this.brush.to;
  }

  set(brush) {
    this.brush = brush;
    this.describe();
    this.draw();
    this.changed();
  }

  listen() {
    const { canvas } = this;
    let from = null;
    const bin_at = (event) =>
      clamp(Math.floor(event.offsetX / canvas.clientWidth * kBins), 0, kBins - 1);
    const drag = (event) => {
      const to = bin_at(event);
      this.set({ from: Math.min(from, to), to: Math.max(from, to) });
    };
    canvas.addEventListener('pointerdown', (event) => {
      canvas.setPointerCapture(event.pointerId);
      from = bin_at(event);
      drag(event);
    });
    canvas.addEventListener('pointermove', (event) => {
      if (from !== null) drag(event);
    });
    const end = () => { from = null; };
    canvas.addEventListener('pointerup', end);
    canvas.addEventListener('pointercancel', end);
    canvas.addEventListener('dblclick', () => this.set(null));
    canvas.addEventListener('keydown', (event) => {
      const step = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
      if (event.key === 'Escape') {
        this.set(null);
      } else if (step && !this.brush) {
        this.set(step > 0 ? { from: 0, to: 3 } : { from: kBins - 4, to: kBins - 1 });
      } else if (step && event.shiftKey) {
        const { from: first, to } = this.brush;
        this.set({ from: first, to: clamp(to + step, first, kBins - 1) });
      } else if (step) {
        const shift = clamp(step, -this.brush.from, kBins - 1 - this.brush.to);
        this.set({ from: this.brush.from + shift, to: this.brush.to + shift });
      } else {
        return;
      }
      event.preventDefault();
      event.stopPropagation();
    });
  }

  describe() {
    const { lo, unit, open } = this.measure;
    const { brush } = this;
    this.clear_button.hidden = !brush;
    let text = '';
    if (brush) {
      const low = rounded(lo + brush.from * this.width_of_bin);
      const high = open && brush.to === kBins - 1 ? 'more'
                                                  : rounded(lo + (brush.to + 1) * this.width_of_bin);
      const shares = this.counts.map((counts, n) => {
        let sum = 0;
        for (let bin = brush.from; bin <= brush.to; ++bin) sum += counts[bin];
        return `${grouped(sum)} (${rounded(100 * sum / Math.max(1, this.totals[n]))}\u00a0%)`;
      });
      text = `${low} \u2013 ${high}${unit}: ${shares.join(' | ')}`;
    } else {
      // What is nothing beside the scale is 0.
      const plain = (x) => rounded(Math.abs(x) < 1e-6 * this.measure.hi ? 0 : x);
      const least = this.measure.values.map((v) => plain(v.reduce((a, b) => Math.min(a, b), Infinity)));
      const most = this.measure.values.map((v) => rounded(v.reduce((a, b) => Math.max(a, b), -Infinity)));
      if (this.totals.some((n) => n > 0)) {
        text = least.map((low, n) => `${low} \u2013 ${most[n]}${unit}`).join(' | ');
      }
    }
    this.note.textContent = text;
    this.canvas.setAttribute('aria-valuetext', text || 'no values');
    this.canvas.setAttribute('aria-valuenow', brush ? brush.from : 0);
    this.canvas.setAttribute('aria-valuemin', 0);
    this.canvas.setAttribute('aria-valuemax', kBins - 1);
  }

  draw() {
    const width = this.canvas.clientWidth, height = this.canvas.clientHeight;
    if (width === 0 || height === 0) return;
    const context = fit_canvas(this.canvas, width, height);
    const { lo, hi, open } = this.measure;
    const ink = css_color(style_color('--ink-soft')), faint = css_color(style_color('--line'));
    const floor = height - 15, step = width / kBins;
    const share = (mesh, bin) => this.counts[mesh][bin] / Math.max(1, this.totals[mesh]);
    let most = 0;
    this.counts.forEach((_, mesh) => {
      for (let bin = 0; bin < kBins; ++bin) most = Math.max(most, share(mesh, bin));
    });
    // Roots, so that the few bad triangles can be seen beside the many good ones.
    const rise = (value) => value > 0 ? Math.max(1.5, Math.sqrt(value / most) * (floor - 3)) : 0;
    for (let bin = 0; bin < kBins; ++bin) {
      const inside = this.brush && this.brush.from <= bin && bin <= this.brush.to;
      const color = this.colored ? css_color(sequential_color((bin + 0.5) / kBins))
                                 : css_color(inside ? style_color('--accent') : style_color('--bar'));
      context.globalAlpha = this.brush && !inside ? 0.35 : 1;
      context.fillStyle = color;
      const up = rise(share(0, bin));
      context.fillRect(bin * step + 0.5, floor - up, Math.max(1, step - 1), up);
    }
    context.globalAlpha = 1;
    if (this.counts.length > 1) {
      context.strokeStyle = css_color(style_color('--second'));
      context.lineWidth = 1.5;
      context.beginPath();
      for (let bin = 0; bin < kBins; ++bin) {
        const y = floor - rise(share(1, bin));
        if (bin === 0) context.moveTo(0, y);
        context.lineTo(bin * step, y);
        context.lineTo((bin + 1) * step, y);
      }
      context.stroke();
    }
    if (this.brush) {
      context.strokeStyle = css_color(style_color('--accent'));
      context.lineWidth = 1.5;
      context.strokeRect(this.brush.from * step + 0.75, 0.75,
                         (this.brush.to - this.brush.from + 1) * step - 1.5, floor - 0.75);
    }
    context.fillStyle = faint;
    context.fillRect(0, floor, width, 1);
    context.fillStyle = ink;
    context.font = '11px system-ui, sans-serif';
    context.textBaseline = 'bottom';
    [0, 0.25, 0.5, 0.75, 1].forEach((at) => {
      context.textAlign = at === 0 ? 'left' : at === 1 ? 'right' : 'center';
      const more = open && at === 1 ? '+' : '';
      context.fillText(rounded(lo + at * (hi - lo)) + more, at * width, height);
    });
  }
}
