'use strict';
// A picture of what the canvas shows, with captions and legend, as a PNG file.

// entries: pairs of a color and what it stands for.
async function save_picture(scene, entries, name) {
  scene.draw();  // a browser may forget the canvas's content after the frame
  const { canvas } = scene;
  const ratio = canvas.width / canvas.clientWidth, size = 13 * ratio, margin = 10 * ratio;
  const picture = element('canvas', { width: canvas.width, height: canvas.height });
  const context = picture.getContext('2d');
  context.drawImage(canvas, 0, 0);
  context.font = `${size}px system-ui, sans-serif`;
  context.fillStyle = css_color(style_color('--ink'));
  context.textBaseline = 'middle';
  context.textAlign = 'center';
  const width = ratio * scene.pane_size.width, height = ratio * scene.pane_size.height;
  scene.panes.forEach((pane, n) => {
    const [left, top] = scene.stacked ? [0, n * height] : [n * width, 0];
    context.fillText(pane.caption, left + width / 2, top + margin + size / 2, width - 2 * margin);
  });
  context.textAlign = 'left';
  entries.forEach(([color, text], n) => {
    const y = canvas.height - margin - (entries.length - n - 0.5) * 1.5 * size;
    context.fillStyle = css_color(color);
    context.fillRect(margin, y - size / 2, size, size);
    context.fillStyle = css_color(style_color('--ink'));
    context.fillText(text, margin + 1.6 * size, y);
  });
  const blob = await new Promise((done) => picture.toBlob(done, 'image/png'));
  const link = element('a', { href: URL.createObjectURL(blob), download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}
