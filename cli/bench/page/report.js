// Draws the report from the data in the page. Plots: Chart.js, bundled.
'use strict';
const data = JSON.parse(document.getElementById('data').textContent);
const {summary, models} = data;
const methods = Object.keys(summary.methods);
const titles = Object.fromEntries(methods.map(key => [key, summary.methods[key].title]));
const compared = models.filter(m => methods.every(key => m.methods?.[key]?.cells));

// Small helpers.
const element = (tag, properties = {}, ...children) => {
  const node = Object.assign(document.createElement(tag), properties);
  node.append(...children.filter(c => c !== null && c !== undefined));
  return node;
};
const at = (object, path) => path.split('.').reduce((o, key) => o?.[key], object);
const fixed = (value, digits) => Number.isFinite(value) ? value.toFixed(digits) : '–';
const percent = (value, digits = 0) => Number.isFinite(value) ? (100 * value).toFixed(digits) + '%' : '–';
const count = value => !Number.isFinite(value) ? '–' : Math.round(value).toLocaleString('en-US');
const thousands = value => !Number.isFinite(value) ? '–' : value >= 99950 ? (value / 1000).toFixed(0) + 'K' : (value / 1000).toFixed(1) + 'K';
const color = name => getComputedStyle(document.documentElement).getPropertyValue('--' + name).trim();

// Head.
function showHead() {
  const meshes = summary.meshes, blocks = summary.methods.blocks;
  document.getElementById('lead').textContent =
    `hexwright ${data.version}, ${summary.models} models, ${summary.compared} of them through every method. ` +
    `After Pitzalis, Livesu, Cherchi, Scateni, Gobbetti: Generalized Adaptive Refinement for Grid-based Hexahedral Meshing, ACM TOG 40(6), 2021, section 6.`;
  const ratio = summary.methods.sheets.hexes_per_blocks.avg;
  const cards = [
    [fixed(blocks.factor.avg, 2) + '×', `blocks, mean factor (paper ${summary.paper.methods.blocks.factor.avg}×)`],
    [fixed(summary.methods.octree_strong.factor.avg, 2) + '×', `octree + strong (paper ${summary.paper.methods.octree_strong.factor.avg}×)`],
    ratio > 0 ? [percent(ratio), 'hexes of sheets, of blocks\' hexes'] : null,
    [count(blocks.time.with_dual.cells_per_second), `input cells/s, blocks (paper ${summary.paper.cells_per_second})`],
    meshes.made > 0 ? [`${meshes.valid} / ${summary.models}`, 'final meshes pass the gate'] : null,
    meshes.made > 0 ? [count(meshes.inverted), 'inverted hexes in all of them'] : null,
  ].filter(Boolean);
  document.getElementById('cards').append(...cards.map(([value, text]) =>
    element('div', {className: 'card'}, element('b', {textContent: value}), element('span', {textContent: text}))));
}

// Table 1.
function showTable1() {
  const table = document.getElementById('table1');
  const span = (text, n) => element('th', {textContent: text, colSpan: n, className: 'left'});
  const head = element('thead', {},
    element('tr', {}, element('th'), span('growth, cells', 2), span('relative growth', 2), span('factor', 2), span('hexes of the dual mesh', 3)),
    element('tr', {}, element('th', {textContent: 'method'}), ...['avg', 'max', 'avg', 'max', 'avg', 'max', 'avg', 'max', 'of blocks\''].map((t, i) =>
      element('th', {textContent: t, className: i % 2 === 0 && i < 7 ? 'left' : ''}))));
  const cell = (value, paper, left) => element('td', {className: left ? 'left' : ''}, value, element('small', {textContent: paper ?? '\u00a0'}));
  const rows = methods.map(key => {
    const m = summary.methods[key], p = summary.paper.methods[key];
    const pair = (name, show) => ['avg', 'max'].map((k, i) => cell(show(m[name][k]), p ? show(p[name][k]) : null, i === 0));
    const dot = element('span', {className: 'key'});
    dot.style.background = `var(--${key})`;
    const hasHexes = m.hexes.max > 0;
    return element('tr', {}, element('td', {}, dot, m.title), ...pair('growth', thousands), ...pair('relative_growth', v => percent(v)),
      ...pair('factor', v => fixed(v, 1) + '×'), cell(hasHexes ? thousands(m.hexes.avg) : '–', null, true), cell(hasHexes ? thousands(m.hexes.max) : '–'),
      cell(hasHexes ? percent(m.hexes_per_blocks.avg) : '–'));
  });
  const input = element('tr', {}, element('td', {textContent: 'input grid, cells'}),
    cell(thousands(summary.input.avg), thousands(summary.paper.input.avg), true), cell(thousands(summary.input.max), thousands(summary.paper.input.max)),
    ...Array.from({length: 7}, (_, i) => element('td', {className: i % 2 === 0 && i < 5 ? 'left' : ''})));
  table.append(head, element('tbody', {}, input, ...rows));
}

// Charts. They are drawn anew when the page turns light or dark.
let charts = [];
const axis = (title, extra = {}) => ({
  title: {display: true, text: title, color: color('faint')}, grid: {color: color('line')}, border: {color: color('line')},
  ticks: {color: color('faint'), ...extra.ticks}, ...Object.fromEntries(Object.entries(extra).filter(([k]) => k !== 'ticks'))});
function draw(id, config) {
  config.options = {animation: false, responsive: true, maintainAspectRatio: false, ...config.options};
  config.options.plugins = {legend: {labels: {color: color('ink'), usePointStyle: true, boxHeight: 7,
    filter: item => !item.text.startsWith('_')}}, ...config.options.plugins};
  charts.push(new Chart(document.getElementById(id), config));
}
const nameTooltip = show => ({tooltip: {filter: item => item.raw.name !== undefined, callbacks: {label: item => item.raw.name + ': ' + show(item.raw)}}});
const dots = (label, key, points) => ({label, data: points, backgroundColor: color(key) + 'b0', borderColor: color(key), pointRadius: 4.5, pointHoverRadius: 7});
const heading = text => ({title: {display: true, text, color: color('ink'), font: {size: 14, weight: 600}}});

function drawShares() {
  const bars = [2, 3, 4];
  const sets = methods.filter(key => key !== 'sheets').flatMap(key => [
    {label: titles[key], data: bars.map(b => 100 * summary.methods[key].at_least[b]), backgroundColor: color(key), stack: key},
    {label: titles[key] + ', paper', data: bars.map(b => 100 * summary.paper.methods[key].at_least[b]), backgroundColor: color(key) + '30',
      borderColor: color(key), borderWidth: 1, stack: key + ' paper'}]);
  draw('shares', {type: 'bar', data: {labels: bars.map(b => `at least ${b}×`), datasets: sets}, options: {
    scales: {x: axis(''), y: axis('% of models', {min: 0, max: 100})}, plugins: {...heading('Shares of models, outlined: the paper\'s')}}});
}

function drawHexes() {
  const points = compared.filter(m => m.methods.blocks.hexes && m.methods.sheets.hexes).map(m => (
    {x: m.methods.blocks.hexes / m.input.cells, y: m.methods.sheets.hexes / m.input.cells, name: m.model}));
  drawDiagonal('hexes', 'sheets', points, 'blocks, hexes per input cell', 'sheets, hexes per input cell', 'Hexes of the dual mesh',
    p => `${fixed(p.x, 2)} blocks, ${fixed(p.y, 2)} sheets`);
}

function drawDiagonal(id, key, points, xTitle, yTitle, title, show) {
  const most = 1.05 * Math.max(0.1, ...points.map(p => Math.max(p.x, p.y)));
  const top = Math.ceil(most * 2) / 2;
  draw(id, {type: 'scatter', data: {datasets: [
    dots('model', key, points),
    {label: 'equal', type: 'line', data: [{x: 0, y: 0}, {x: top, y: top}], borderColor: color('faint'), borderWidth: 1, borderDash: [5, 4], pointRadius: 0, pointStyle: 'line'}]},
    options: {scales: {x: axis(xTitle, {min: 0, max: top}), y: axis(yTitle, {min: 0, max: top})}, plugins: {...heading(title), ...nameTooltip(show)}}});
}

// Every method against the one it is to improve on.
function drawFigure12() {
  for (const [id, across, up] of [['fig12strong', 'octree_strong', 'blocks'], ['fig12weak', 'octree_weak', 'blocks'],
    ['fig12octree', 'octree_strong', 'octree_weak'], ['fig12sheets', 'blocks', 'sheets']]) {
    const points = compared.map(m => ({x: m.methods[across].relative_growth, y: m.methods[up].relative_growth, name: m.model}));
    drawDiagonal(id, up, points, titles[across] + ', relative growth', titles[up] + ', relative growth', `${titles[up]} against ${titles[across]}`,
      p => `${percent(p.x)} ${titles[across]}, ${percent(p.y)} ${titles[up]}`);
  }
}

function drawFigure13() {
  const withDual = document.getElementById('timed').value === 'with_dual';
  const time = m => m.seconds + (withDual ? m.dual_seconds ?? 0 : 0);
  const sizes = compared.map(m => m.input.cells);
  const line = (label, key, f, dash) => ({label, type: 'line', data: [Math.min(...sizes), Math.max(...sizes)].map(x => ({x, y: f(x)})),
    borderColor: color(key), borderWidth: 1.5, borderDash: dash, pointRadius: 0, pointStyle: 'line'});
  const sets = methods.flatMap(key => {
    const law = summary.methods[key].time[withDual ? 'with_dual' : 'alone'];
    const points = compared.map(r => ({x: r.input.cells, y: time(r.methods[key]), name: r.model}));
    return [dots(`${titles[key]}, slope ${fixed(law.exponent, 2)}`, key, points),
      ...(law.factor > 0 ? [line(`_${key}`, key, x => law.factor * x ** law.exponent, [])] : [])];
  });
  sets.push(line(`the paper, ${summary.paper.cells_per_second} cells/s`, 'paper', x => x / summary.paper.cells_per_second, [6, 4]));
  draw('fig13', {type: 'scatter', data: {datasets: sets}, options: {
    scales: {x: axis('cells of the input grid', {type: 'logarithmic'}), y: axis('seconds', {type: 'logarithmic'})},
    plugins: nameTooltip(p => `${count(p.x)} cells, ${p.y.toPrecision(3)} s`)}});
  const speeds = part => methods.map(key => `${titles[key]} ${count(summary.methods[key].time[part].cells_per_second)}`).join(', ');
  document.getElementById('speednote').textContent = `Median input cells per second, completion and dual mesh together: ${speeds('with_dual')}; ` +
    `completion alone: ${speeds('alone')}. The paper: ${summary.paper.cells_per_second}, over 90% of it pairing, on another machine (Core i9 2.9 GHz). ` +
    'Slopes are of the fitted lines; small grids are timed too coarsely to carry weight.';
}

function drawHistogram(id, values, edges, labels, title, key) {
  const counts = Array.from({length: edges.length - 1}, (_, i) => values.filter(v => v >= edges[i] && v < edges[i + 1]).length);
  draw(id, {type: 'bar', data: {labels, datasets: [{label: 'models', data: counts, backgroundColor: color(key), barPercentage: 1, categoryPercentage: 0.92}]},
    options: {scales: {x: axis('', {grid: {display: false}}), y: axis('models', {ticks: {precision: 0}})},
      plugins: {...heading(title), legend: {display: false}}}});
}

function drawMeshes() {
  const meshes = models.filter(m => m.mesh?.verdict).map(m => m.mesh);
  const s = summary.meshes;
  document.getElementById('meshnote').textContent = meshes.length === 0 ? 'None were made.' :
    `The whole pipeline with its own sizing: ${s.made} made, ${s.valid} pass the gate, ${s.inverted} inverted hexes; least scaled Jacobian ${fixed(s.min_sj.least, 3)} ` +
    `(median of the minima ${fixed(s.min_sj.median, 2)}), mean of the averages ${fixed(s.avg_sj.avg, 3)}; distance ${percent(s.distance.median, 2)} of the diagonal ` +
    `in the median, ${percent(s.distance.max, 2)} at most; ${fixed(s.seconds.avg, 1)} s in the mean, ${fixed(s.seconds.max, 1)} s at most.`;
  const tenths = [-Infinity, 0, ...Array.from({length: 10}, (_, i) => (i + 1) / 10)];
  tenths[tenths.length - 1] = Infinity;
  drawHistogram('quality', meshes.map(m => m.verdict.quality.min_scaled_jacobian), tenths,
    ['< 0', ...Array.from({length: 10}, (_, i) => `.${i}`)], 'Least scaled Jacobian, by model', 'blocks');
  drawHistogram('distance', meshes.map(m => m.verdict.distance?.max).filter(Number.isFinite), [0, .001, .002, .003, .004, .005, .0075, .01, .02, Infinity],
    ['0', '.1', '.2', '.3', '.4', '.5', '.75', '1', '> 2'].map(t => t + '%'), 'Largest two-way distance, by model', 'sheets');
}

function drawAll() {
  charts.forEach(chart => chart.destroy());
  charts = [];
  drawShares();
  drawHexes();
  drawFigure12();
  drawFigure13();
  drawMeshes();
}

// Figure 11.
function showAgreements() {
  const text = summary.agree.length === 0 ? 'None of these models: block pairing needs fewer cells on every one (the paper: 8 of 202).' :
    `${summary.agree.length} of ${summary.compared} (the paper: 8 of 202): ${summary.agree.join(', ')}.`;
  document.getElementById('agree').textContent = text;
  document.getElementById('agreeing').append(...models.filter(m => summary.agree.includes(m.model)).map(m =>
    element('div', {className: 'agreeing'}, element('b', {textContent: `${m.model}, ${count(m.input.cells)} cells`}), makeStrip(m))));
}

// Models: one body of two rows each, numbers and pictures.
const outcome = m => !m.mesh?.verdict ? 'failed' : m.mesh.valid ? 'valid' : 'gate';
const factor = (m, key) => m.methods?.[key]?.cells ? m.methods[key].cells / m.input.cells : NaN;
const columns = [
  {title: 'model', value: m => m.model.toLowerCase(), show: m => m.model.replace(/[_./-]/g, '$&\u200b'), className: 'name'},
  {title: 'input cells', value: m => m.input?.cells, show: m => count(m.input?.cells)},
  ...methods.map(key => ({title: titles[key], value: m => factor(m, key), show: m => fixed(factor(m, key), 2) + '×',
    small: m => m.methods?.[key]?.hexes ? count(m.methods[key].hexes) + ' hexes' : ''})),
  {title: 'mesh hexes', value: m => m.mesh?.hexes, show: m => count(m.mesh?.hexes), className: 'left',
    small: m => ({valid: 'valid', gate: 'fails the gate', failed: m.status === 'done' ? 'none' : m.status})[outcome(m)],
    tone: m => ({valid: 'good', gate: 'warn', failed: 'bad'})[outcome(m)]},
  {title: 'min SJ', value: m => at(m, 'mesh.verdict.quality.min_scaled_jacobian'), digits: 3},
  {title: 'avg SJ', value: m => at(m, 'mesh.verdict.quality.avg_scaled_jacobian'), digits: 3},
  {title: 'quality', spark: m => at(m, 'mesh.verdict.quality.histogram.counts')},
  {title: 'distance', value: m => at(m, 'mesh.verdict.distance.max'), show: m => percent(at(m, 'mesh.verdict.distance.max'), 2),
    small: m => 'mean ' + percent(at(m, 'mesh.verdict.distance.mean'), 3)},
  {title: 'features', value: m => at(m, 'mesh.verdict.features.length') > 0 ? at(m, 'mesh.verdict.features.length_share') : NaN,
    show: m => at(m, 'mesh.verdict.features.length') > 0 ? percent(at(m, 'mesh.verdict.features.length_share'), 1) : '–',
    small: m => at(m, 'mesh.verdict.features.corners') > 0 ? `${m.mesh.verdict.features.corners_recovered}/${m.mesh.verdict.features.corners} corners` : ''},
  {title: 'mesh s', value: m => m.mesh?.seconds, digits: 1},
];

function sparkline(counts) {
  const bars = counts.slice(10), most = Math.max(1, ...bars.map(Math.sqrt));
  const svg = document.createElementNS('http://www.w3.org/2000/svg', 'svg');
  svg.setAttribute('viewBox', '0 0 84 22');
  svg.setAttribute('class', 'spark');
  svg.innerHTML = '<title>Hexes by scaled Jacobian, 0 to 1 (square root of the count)</title>' + bars.map((n, i) => {
    const h = 21 * Math.sqrt(n) / most;
    return `<rect x="${i * 8.4 + 0.5}" y="${22 - h}" width="7.4" height="${h}" fill="var(--blocks)"/>`;
  }).join('');
  return svg;
}

function makeCell(column, m) {
  const cell = element('td', {className: column.className ?? ''});
  if (column.spark) {
    const counts = column.spark(m);
    cell.append(counts ? sparkline(counts) : '–');
    return cell;
  }
  cell.append(column.show ? column.show(m) : fixed(column.value(m), column.digits));
  const small = column.small?.(m);
  if (small) cell.append(element('small', {textContent: small, className: column.tone?.(m) ?? ''}));
  return cell;
}

function makeStrip(m) {
  const captions = {input: `input, ${count(m.input?.cells)}`, ...Object.fromEntries(methods.map(key => [key, `${titles[key]}, ${fixed(factor(m, key), 2)}×`])),
    mesh: 'final mesh, cut', surface: 'final mesh'};
  const pictures = Object.entries(captions).filter(([part]) => m.pictures?.[part]);
  const look = m.page ? [element('a', {className: 'look', href: m.page.split('/').map(encodeURIComponent).join('/'), textContent: 'look into the mesh'})] : [];
  return element('div', {className: 'strip'}, ...look, ...pictures.map(([part, caption]) => {
    const button = element('button', {type: 'button'}, element('img', {src: m.pictures[part], alt: `${m.model}: ${caption}`, decoding: 'async'}), element('span', {textContent: caption}));
    button.addEventListener('click', () => enlarge(m.pictures[part], `${m.model}: ${caption}`));
    return button;
  }));
}

function enlarge(source, caption) {
  const dialog = document.getElementById('large');
  dialog.querySelector('img').src = source;
  dialog.querySelector('p').textContent = caption;
  dialog.showModal();
}

function messages(m) {
  const parts = [m.message, m.mesh?.failure, ...(m.mesh?.failures ?? []),
    ...methods.map(key => m.methods?.[key]?.failure && `${titles[key]}: ${m.methods[key].failure}`)].filter(Boolean);
  return parts.map(text => element('p', {className: 'message', textContent: text}));
}

function showModels() {
  const table = document.getElementById('models');
  const head = element('tr', {}, ...columns.map((column, i) => {
    const th = element('th', {textContent: column.title, className: column.className === 'left' ? 'left' : ''});
    if (column.value) {
      th.dataset.sort = i;
      th.tabIndex = 0;
      th.addEventListener('click', () => sortBy(i));
      th.addEventListener('keydown', event => event.key === 'Enter' && sortBy(i));
    }
    return th;
  }));
  const bodies = models.map((m, i) => {
    const body = element('tbody', {}, element('tr', {}, ...columns.map(column => makeCell(column, m))),
      element('tr', {}, element('td', {className: 'pictures', colSpan: columns.length}, ...messages(m), makeStrip(m))));
    body.dataset.model = i;
    return body;
  });
  table.append(element('thead', {}, head), ...bodies);
}

let sorted = {column: 0, down: false};
function sortBy(i) {
  sorted = {column: i, down: sorted.column === i ? !sorted.down : i !== 0};
  const table = document.getElementById('models'), value = columns[i].value;
  const key = body => value(models[body.dataset.model]);
  const isMissing = v => v === undefined || v === null || Number.isNaN(v);
  const bodies = [...table.tBodies].sort((a, b) => {
    const u = key(a), v = key(b);
    if (isMissing(u) || isMissing(v)) return isMissing(u) - isMissing(v);
    const order = u < v ? -1 : u > v ? 1 : a.dataset.model - b.dataset.model;
    return sorted.down ? -order : order;
  });
  table.append(...bodies);
  for (const th of table.tHead.rows[0].cells) th.removeAttribute('aria-sort');
  table.tHead.rows[0].cells[i].setAttribute('aria-sort', sorted.down ? 'descending' : 'ascending');
}

function filterModels() {
  const text = document.getElementById('filter').value.toLowerCase(), wanted = document.getElementById('outcome').value;
  let shown = 0;
  for (const body of document.getElementById('models').tBodies) {
    const m = models[body.dataset.model];
    body.hidden = !m.model.toLowerCase().includes(text) || (wanted !== '' && outcome(m) !== wanted);
    shown += !body.hidden;
  }
  document.getElementById('count').textContent = `${shown} of ${models.length} models`;
}

showHead();
showTable1();
showAgreements();
showModels();
filterModels();
drawAll();
document.getElementById('filter').addEventListener('input', filterModels);
document.getElementById('timed').addEventListener('change', drawAll);
document.getElementById('outcome').addEventListener('change', filterModels);
document.getElementById('showpictures').addEventListener('change', event =>
  document.getElementById('models').classList.toggle('nopictures', !event.target.checked));
document.getElementById('large').addEventListener('click', event => event.currentTarget.close());
matchMedia('(prefers-color-scheme: dark)').addEventListener('change', drawAll);
