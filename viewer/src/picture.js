// The view as a PNG: the drawing over the page's background, with what it shows written below.
import {element} from './dom.js';

export function savePicture(app) {
  app.work();  // in the same task as reading: a canvas forgets its pixels afterwards
  const {canvas, mesh} = app, footer = Math.round(26 * devicePixelRatio), picture = document.createElement('canvas');
  picture.width = canvas.width;
  picture.height = canvas.height + footer;
  const context = picture.getContext('2d'), style = getComputedStyle(document.documentElement), sky = context.createLinearGradient(0, 0, 0, canvas.height);
  sky.addColorStop(0, style.getPropertyValue('--sky'));
  sky.addColorStop(1, style.getPropertyValue('--ground'));
  context.fillStyle = sky;
  context.fillRect(0, 0, picture.width, canvas.height);
  context.drawImage(canvas, 0, 0);
  context.fillStyle = style.getPropertyValue('--paper');
  context.fillRect(0, canvas.height, picture.width, footer);
  context.fillStyle = style.getPropertyValue('--ink');
  context.font = `${Math.round(13 * devicePixelRatio)}px system-ui, sans-serif`;
  context.textBaseline = 'middle';
  context.fillText(`${mesh.summary.title}: ${element('status').textContent}, coloured by ${app.coloring().label}`, 10, canvas.height + footer / 2);
  picture.toBlob(blob => {
    const link = document.createElement('a');
    link.href = URL.createObjectURL(blob);
    link.download = `${mesh.summary.title.replace(/[^\w.-]+/g, '_')}.png`;
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 10000);
  }, 'image/png');
}
