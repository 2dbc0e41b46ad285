'use strict';
// Plot of the balance of the energy over time, with the values of the frame that is shown.
const energyPlot = (() => {
const SVG = 'http://www.w3.org/2000/svg';
const WIDTH = 280, HEIGHT = 110;
const COLOURS = ['#d1495b', '#00798c', '#e09f3e', '#6a4c93', '#4f772d', '#8d6e63', '#3d5a98', '#7a8288'];
const UNITS = [[1, 'J'], [1e-3, 'mJ'], [1e-6, 'µJ'], [1e-9, 'nJ']];
// Entries that are less than this fraction of the largest value are left out.
const SMALL = 0.002;

function add(parent, name, attributes) {
  const own = document.createElementNS(SVG, name);
  for (const [key, value] of Object.entries(attributes)) own.setAttribute(key, value);
  parent.append(own);
  return own;
}

// Returns the element of the plot, and a function that shows a frame in it.
return ({ names, rows }, times, seek) => {
  // The balance of a garment begins when it is sewn.
  const first = rows.findIndex(Boolean);
  const size = Math.max(...rows.slice(first).flat().map(Math.abs));
  const [scale, unit] = UNITS.find(([own]) => size >= own) ?? UNITS.at(-1);
  const series = names.map((name, k) => ({ name: name.replaceAll('_', ' '), values: rows.slice(first).map((row) => row[k] / scale) }))
    .filter(({ values }) => Math.max(...values.map(Math.abs)) > SMALL * size / scale);
  const all = series.flatMap(({ values }) => values);
  const low = Math.min(0, ...all), high = Math.max(low + 1e-12, ...all), end = Math.max(times.at(-1) - times[0], 1e-12);
  const x = (time) => WIDTH * (time - times[0]) / end, y = (value) => HEIGHT * (high - value) / (high - low);
  const figure = document.createElement('figure');
  figure.className = 'energy';
  const caption = document.createElement('figcaption');
  caption.textContent = `energy, ${unit}`;
  const svg = document.createElementNS(SVG, 'svg');
  svg.setAttribute('viewBox', `-2 -2 ${WIDTH + 4} ${HEIGHT + 4}`);
  svg.setAttribute('role', 'img');
  svg.setAttribute('aria-label', 'balance of the energy over time');
  add(svg, 'path', { d: `M0 ${y(0)}H${WIDTH}`, class: 'zero' });
  const list = document.createElement('ul');
  const cells = series.map(({ name, values }, k) => {
    const colour = COLOURS[k % COLOURS.length];
    const points = values.map((value, k) => `${x(times[first + k]).toFixed(1)},${y(value).toFixed(1)}`);
    add(svg, 'polyline', { points: points.join(' '), stroke: colour });
    const line = document.createElement('li');
    const chip = document.createElement('i');
    chip.style.background = colour;
    const cell = document.createElement('b');
    line.append(chip, name, cell);
    list.append(line);
    return cell;
  });
  const now = add(svg, 'path', { class: 'now' });
  svg.addEventListener('click', (event) => {
    const box = svg.getBoundingClientRect();
    seek(times[0] + end * Math.min(Math.max((event.clientX - box.left) / box.width, 0), 1));
  });
  figure.append(caption, svg, list);
  const show = (frame) => {
    now.setAttribute('d', `M${x(times[frame])} 0V${HEIGHT}`);
    series.forEach(({ values }, k) => { cells[k].textContent = frame < first ? '' : values[frame - first].toPrecision(3); });
  };
  return { element: figure, show };
};
})();
