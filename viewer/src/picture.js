// The view as a PNG: the drawing over the page's background, with what it shows and the meaning of its colours written below.
import {categoryColor, css} from './colors.js';
import {element} from './dom.js';

const ROW = 24, MARGIN = 12, MOST_ROWS = 4;  // pixels of the page

/// What the colours mean, as entries {text, color}, or {text, bar} with a colour for 0 to 1.
function legendEntries(app) {
  const {label, legend, key} = app.coloring(), {summary} = app.mesh;
  if (key === 'patch') return summary.patches.map((p, i) => ({...p, color: categoryColor(i), i})).filter(p => p.quads > 0 && !app.state.hiddenPatches.has(p.i)).sort((a, b) => b.quads - a.quads).map(p => ({text: p.name, color: p.color}));
  if (key === 'region') return summary.regions.map((r, i) => ({text: r.name, color: categoryColor(i), i})).filter(r => !app.state.hiddenRegions.has(r.i));
  if (!legend) return [];
  if (legend.steps) return legend.steps.map(([text, color]) => ({text: `${label} ${text}`, color}));
  return [{text: `${label}: ${legend.low}`, bar: legend.color, after: legend.high}];
}

/// Pieces of text and colour in rows: what finds no room is told as a number.
function placeEntries(context, entries, width) {
  const placed = [];
  let x = MARGIN, row = 1;
  for (const [i, entry] of entries.entries()) {
    const size = entry.bar ? context.measureText(entry.text + entry.after).width + 180 : context.measureText(entry.text).width + 20;
    if (x > MARGIN && x + size > width - MARGIN) { x = MARGIN; ++row; }
    if (row > MOST_ROWS) return {placed, rows: MOST_ROWS, left: entries.length - i};
    placed.push({...entry, x, row});
    x += size + 16;
  }
  return {placed, rows: entries.length ? row : 0, left: 0};
}

function drawEntry(context, {text, color, bar, after, x, row}, top, ink) {
  const y = top + ROW * (row + 0.5);
  if (color) { context.fillStyle = css(color); context.fillRect(x, y - 6, 12, 12); }
  context.fillStyle = ink;
  context.fillText(text, bar ? x : x + 18, y);
  if (!bar) return;
  const left = x + context.measureText(text).width + 8;
  for (let k = 0; k < 150; ++k) { context.fillStyle = css(bar((k + 0.5) / 150)); context.fillRect(left + k, y - 6, 1.5, 12); }
  context.fillStyle = ink;
  context.fillText(after, left + 158, y);
}

export function savePicture(app) {
  app.work();  // in the same task as reading: a canvas forgets its pixels afterwards
  const {canvas, mesh} = app, scale = canvas.width / canvas.clientWidth, picture = document.createElement('canvas'), context = picture.getContext('2d');
  const font = '13px system-ui, sans-serif', [width, height] = [canvas.clientWidth, canvas.clientHeight];
  context.font = font;
  const {placed, rows, left} = placeEntries(context, legendEntries(app), width), style = getComputedStyle(document.documentElement), ink = style.getPropertyValue('--ink');
  picture.width = canvas.width;
  picture.height = canvas.height + Math.round(scale * ROW * (rows + 1 + (left ? 1 : 0)));
  context.scale(scale, scale);  // a canvas forgets all when its size is set
  const sky = context.createLinearGradient(0, 0, 0, height);
  sky.addColorStop(0, style.getPropertyValue('--sky'));
  sky.addColorStop(1, style.getPropertyValue('--ground'));
  context.fillStyle = style.getPropertyValue('--paper');
  context.fillRect(0, 0, width, picture.height);
  context.fillStyle = sky;
  context.fillRect(0, 0, width, height);
  context.drawImage(canvas, 0, 0, width, height);
  context.font = font;
  context.textBaseline = 'middle';
  context.fillStyle = ink;
  context.fillText(`${mesh.summary.title}: ${element('status').textContent}, coloured by ${app.coloring().label}`, MARGIN, height + ROW / 2);
  for (const entry of placed) drawEntry(context, entry, height, ink);
  context.fillStyle = ink;
  if (left) context.fillText(`and ${left} more`, MARGIN, height + ROW * (rows + 1.5));
  picture.toBlob(blob => {
    const link = document.createElement('a');
    link.href = URL.createObjectURL(blob);
    link.download = `${mesh.summary.title.replace(/[^\w.-]+/g, '_')}.png`;
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 10000);
  }, 'image/png');
}
