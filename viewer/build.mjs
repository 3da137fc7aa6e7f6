// Makes dist/viewer.html, the page that the program fills with a mesh: `npm ci && npm run build`. The same sources and
// versions give the same bytes; `node build.mjs FILE` writes elsewhere.
import {createHash} from 'node:crypto';
import {readFileSync, writeFileSync} from 'node:fs';
import {dirname, join} from 'node:path';
import {fileURLToPath} from 'node:url';
import {build} from 'esbuild';

const folder = dirname(fileURLToPath(import.meta.url));
const read = name => readFileSync(join(folder, name), 'utf8').replaceAll('\r\n', '\n');

async function bundle(entry) {
  const result = await build({
    entryPoints: [join(folder, entry)], bundle: true, minify: true, write: false, format: 'iife', target: ['es2022', 'chrome105', 'firefox113', 'safari16.4'],
    legalComments: 'none', charset: 'ascii', absWorkingDir: folder, logLevel: 'warning'});
  return result.outputFiles[0].text.trim();
}

const policyHash = text => `'sha256-${createHash('sha256').update(text, 'utf8').digest('base64')}'`;
const script = await bundle('src/main.js');
const style = await bundle('src/style.css');
const policy = `default-src 'none'; script-src ${policyHash(script)}; style-src ${policyHash(style)}; img-src data: blob:; base-uri 'none'; form-action 'none'`;
const notices = `The page, without the mesh in it:\n${read('../LICENSE').trim()}\n\nIt contains three.js (https://threejs.org):\n${read('node_modules/three/LICENSE').trim()}`;

// Functions as replacements: '$' has no meaning in their results.
const page = read('src/page.html')
  .replace('{{NOTICES}}', () => notices)
  .replace('{{POLICY}}', () => policy)
  .replace('{{STYLE}}', () => style)
  .replace('{{SCRIPT}}', () => script);
writeFileSync(process.argv[2] ?? join(folder, 'dist/viewer.html'), page);
