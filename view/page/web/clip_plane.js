'use strict';
// A plane across an axis that cuts all panes of a scene open, and its part of the panel.

class ClipPlane {
  // box: what there is to cut.
  constructor(scene, box) {
    this.scene = scene;
    this.box = box;
    this.on = false;
    this.axis = 0;
    this.share = 0.5;    // of the box along the axis
    this.above = false;  // the upper part is kept
    const change = (values) => {
      Object.assign(this, values);
      if (!('on' in values)) this.on = cut.input.checked = true;
      this.apply();
    };
    const cut = toggle('Cut by a plane', false, (on) => change({ on }));
    this.element = section(
      'Cut open', false, cut,
      choice('Across', [['0', 'x'], ['1', 'y'], ['2', 'z']], '0',
             (axis) => change({ axis: Number(axis) })),
      slider('Where', { min: 0, max: 1, step: 0.002, value: 0.5 }, (share) => change({ share })),
      toggle('Keep the upper part', false, (above) => change({ above })));
  }

  // To the panes that there are: call it again when these change.
  apply() {
    const { axis, share, box } = this;
    const sign = this.above ? -1 : 1;
    const plane = [0, 0, 0, sign * (box.lo[axis] * (1 - share) + box.hi[axis] * share)];
    plane[axis] = sign;
    for (const pane of this.scene.panes) pane.clip = this.on ? plane : null;
    this.scene.invalidate();
  }
}
