// Starts the page: unpacks the mesh, draws it, binds the controls.
import {App} from './app.js';
import {readMesh} from './data.js';
import {findNeighbors} from './topology.js';

const dark = matchMedia('(prefers-color-scheme: dark)');
let app = null;
const followTheme = () => {
  document.documentElement.dataset.theme = dark.matches ? 'dark' : 'light';
  app?.refresh('lines', 'panel');
};
followTheme();
dark.addEventListener('change', followTheme);

async function start() {
  const mesh = await readMesh();
  mesh.neighbors = findNeighbors(mesh.hexes, mesh.positions.length / 3);
  app = new App(mesh);
  app.start();
  // Two more frames: then the first picture has been shown.
  requestAnimationFrame(() => requestAnimationFrame(() => { document.body.dataset.ready = Math.round(performance.now()); }));
}

start().catch(error => {
  document.getElementById('status').textContent = `This page cannot be shown: ${error.message} (it needs a browser of 2023 or later with WebGL 2)`;
  throw error;
});
