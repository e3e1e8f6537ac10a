'use strict';
// Begins: reads the data, and makes the view that the header names.

const kViews = { view: MeshView, trace: TraceView };

function show_fault(text) {
  const place = document.getElementById('message');
  place.textContent = text;
  place.hidden = false;
}

async function begin() {
  const canvas = document.getElementById('scene');
  let view = null;
  let scene = null;
  const turn_theme = set_up_theme(() => {
    scene?.colors_changed();
    view?.theme_changed();
  });
  scene = new Scene(canvas);
  if (!scene.gl) {
    show_fault('This page draws with WebGL2, which this browser does not have or has switched off. ' +
               'A current Firefox, Chrome, Edge or Safari shows it; with an old graphics card, look ' +
               'for "hardware acceleration" in the settings.');
    return;
  }
  if (typeof DecompressionStream === 'undefined') {
    show_fault('This page needs a browser of 2023 or later (it reads compressed data).');
    return;
  }
  const data = await read_page_data();
  const View = kViews[data.header.kind];
  if (!View) throw new Error(`the page holds "${data.header.kind}", which its scripts do not know`);
  scene.message('');
  scene.camera.stand(data.header.up ?? [2, 1]);
  view = new View(scene, data);
  document.documentElement.dataset.kind = data.header.kind;

  const camera_keys = ['Camera', [['Drag', 'turn'], ['Shift+Drag', 'pan; also the right button'],
                                  ['Wheel', 'zoom, where the pointer is'],
                                  ['Two fingers', 'pan and zoom'],
                                  ['Double-click', 'turn about this point from now on'],
                                  ['Shift+Arrows', 'turn, when the view has the focus'],
                                  ['Alt+Arrows', 'pan'], ['+ -', 'zoom'], ['F', 'see all'],
                                  ['1 2 3', 'along x, y, z (Shift: from behind)']]];
  const turn_help = set_up_help(View.intro ?? [], [camera_keys, View.help(),
                                                   ['Page', [['T', 'dark or light'],
                                                             ['?', 'this help']]]]);
  listen_to_keys({ ...view.keys(), t: turn_theme, '?': turn_help, 1: () => scene.look_from([1, 0, 0]),
                   2: () => scene.look_from([0, 1, 0]), 3: () => scene.look_from([0, 0, 1]),
                   '!': () => scene.look_from([-1, 0, 0]), '@': () => scene.look_from([0, -1, 0]),
                   '#': () => scene.look_from([0, 0, -1]) });
  window.deliso = { view, scene };  // for the console, and for tests
}

window.addEventListener('error', (event) => show_fault(`Something went wrong: ${event.message}`));
// The data come behind the scripts: of a page that was cut off, there is what there is.
document.addEventListener('DOMContentLoaded', () => begin().catch((fault) => {
  show_fault(`Something went wrong: ${fault.message}`);
  throw fault;
}));
