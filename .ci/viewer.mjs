// Exercises every control of the viewer's pages in a folder, and fails on any message of the console.
import { chromium } from 'playwright-core';
import assert from 'node:assert/strict';
import { statSync } from 'node:fs';
import path from 'node:path';

const out = path.resolve(process.argv[2]);
const browser = await chromium.launch({
  executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium',
  args: ['--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--disable-background-networking'],
});

async function open(name, width, height) {
  const page = await browser.newPage({ viewport: { width, height } });
  page.said = [];
  page.on('console', (message) => page.said.push(message.text()));
  page.on('pageerror', (error) => page.said.push(error.message));
  page.on('request', (request) => {
    if (!/^(file|data|blob):/.test(request.url())) page.said.push(`asked for ${request.url()}`);
  });
  await page.goto(`file://${out}/${name}.html`);
  await page.waitForFunction(() => window.drapeViewer, null, { timeout: 60000 });
  page.shot = (what) => page.screenshot({ path: `${out}/${name}-${width}-${what}.png` });
  const loaded = await page.evaluate(() => window.drapeViewer.loaded);
  console.log(`${name} at ${width} pixels: loaded in ${(loaded / 1000).toFixed(2)} s by the page's clock`);
  return page;
}

// What the canvas shows, as a text to compare.
const picture = async (page) => (await page.locator('#canvas').screenshot()).toString('base64');

// Does something that must change the picture.
async function changes(page, what, action) {
  const before = await picture(page);
  await action();
  await page.waitForTimeout(250);
  assert.notEqual(await picture(page), before, `${what} changes nothing`);
}

async function exercise(page) {
  await page.shot('start');
  const fields = await page.$$eval('#field option', (all) => all.map((own) => own.value));
  for (const field of fields.filter(Boolean)) {
    await page.selectOption('#field', field);
    await page.waitForTimeout(150);
    assert.ok(await page.isVisible('#legend'), field);
    await page.shot(field);
  }
  await page.selectOption('#field', '');
  for (const [id, what] of [['back', 'back'], ['flank', 'side'], ['top', 'top'], ['front', 'front'], ['lines', 'lines'],
    ['lines', 'lines'], ['edges', 'triangles'], ['edges', 'triangles'], ['theme', 'theme']]) {
    await changes(page, what, () => page.click(`#${id}`));
  }
  await page.shot('other-theme');
  await page.click('#theme');
  await changes(page, 'section', () => page.selectOption('#axis', 'x'));
  await changes(page, 'place of the section', () => page.fill('#cut', '300'));
  await changes(page, 'side of the section', () => page.check('#flip'));
  await page.shot('section');
  await page.selectOption('#axis', '');
  for (const part of await page.$$('#parts input')) {
    await changes(page, 'part', () => part.click());
    await part.click();
  }
  await changes(page, 'time', () => page.fill('#scrub', '0'));
  await page.shot('first');
  const plot = page.locator('.energy svg').first();
  await plot.scrollIntoViewIfNeeded();
  await changes(page, 'click on the plot of the energy', () => plot.click());
  await page.selectOption('#speed', '5');
  await changes(page, 'play', () => page.click('#play'));
  const box = await page.locator('#canvas').boundingBox();
  const [x, y] = [box.x + box.width / 4, box.y + box.height / 2];
  await changes(page, 'drag', async () => {
    await page.mouse.move(x, y);
    await page.mouse.down();
    await page.mouse.move(x + 90, y + 20, { steps: 4 });
    await page.mouse.up();
  });
  await changes(page, 'wheel', () => page.mouse.wheel(0, 400));
  await page.click('#fit');
  await page.waitForTimeout(600);
  await page.mouse.click(x, y);
  assert.match(await page.textContent('#picked'), /weft, warp, mm/);
  await page.focus('#canvas');
  for (const key of ['Space', 'Space', 'ArrowLeft', 'ArrowRight', 'm', 'l', 'l', 't', 't', '1', '2', '3', '4', 'f']) {
    await page.keyboard.press(key);
    await page.waitForTimeout(50);
  }
}

// Draws for some seconds, while the camera turns or with another frame each time; returns the rate in
// 1/s, and the time of the page's own script for each in ms, which a faster graphics card leaves as it is.
async function draws(page, what) {
  const client = await page.context().newCDPSession(page);
  await client.send('Profiler.enable');
  await client.send('Profiler.start');
  const [count, seconds] = await page.evaluate(async (what) => {
    const { camera } = window.drapeViewer;
    const scrub = document.getElementById('scrub');
    const start = performance.now();
    let count = 0;
    while (performance.now() - start < 3000) {
      if (what === 'turning') {
        camera.position.x += 0.002;
        window.dispatchEvent(new Event('resize'));
      } else {
        scrub.value = count % (+scrub.max + 1);
        scrub.dispatchEvent(new Event('input'));
      }
      await new Promise(requestAnimationFrame);
      count++;
    }
    return [count, (performance.now() - start) / 1000];
  }, what);
  const { profile } = await client.send('Profiler.stop');
  const others = profile.nodes.filter((node) => /^\((idle|program|root)\)$/.test(node.callFrame.functionName));
  const ids = new Set(others.map((node) => node.id));
  const script = profile.timeDeltas.reduce((sum, passed, k) => sum + (ids.has(profile.samples[k]) ? 0 : passed), 0);
  return { rate: count / seconds, script: script / count / 1000 };
}

async function measure(page, name) {
  for (const what of ['turning', 'playing']) {
    const { rate, script } = await draws(page, what);
    console.log(`${name}, ${what}: ${rate.toFixed(1)} frames per second, drawn by the processor; ${script.toFixed(1)} ms of script each`);
  }
}

// What the measures say: tables of names and values with units, no JSON, within the width of the page.
async function readMeasures(page) {
  const tables = await page.$$eval('#measures table', (all) => all.map((table) => ({
    title: table.caption.textContent,
    rows: [...table.rows].map((row) => [...row.cells].map((cell) => cell.textContent)),
  })));
  for (const cell of tables.flatMap((table) => table.rows).flat()) assert.doesNotMatch(cell, /[{}[\]"_]/);
  const rowOf = (title, name) => tables.find((table) => table.title === title)?.rows.find((row) => row[0] === name);
  assert.match(rowOf('run', 'simulated time')[1], /^[\d.]+ s$/);
  assert.match(rowOf('strain at the end', 'largest strain of a yarn')[1], /^[\d.e−]+ %$/);
  assert.match(rowOf('balance of the energy', 'gravity')[1], /^−?[\d.e−]+ [mµn]?J$/);
  const [needed, shown] = await page.$eval('#side', (side) => [side.scrollWidth, side.clientWidth]);
  assert.ok(needed <= shown, `the measures need ${needed} of ${shown} pixels`);
  await page.$eval('#measures table', (table) => table.scrollIntoView());
  await page.shot('measures');
  return rowOf;
}

for (const name of ['sphere', 'both']) {
  const page = await open(name, 1280, 800);
  await readMeasures(page);
  await page.$eval('#side', (side) => { side.scrollTop = 0; });
  await exercise(page);
  await measure(page, name);
  assert.deepEqual(page.said, []);
  await page.close();
}
for (const name of ['run-25000', 'run-40000']) {
  const megabytes = statSync(path.join(out, `${name}.html`)).size / 1e6;
  console.log(`${name}: ${megabytes.toFixed(1)} MB`);
  assert.ok(megabytes <= 20, name);
  const page = await open(name, 1280, 800);
  assert.equal(await page.evaluate(() => window.drapeViewer.views[0].run.frames.length), 60);
  await measure(page, name);
  await page.shot('start');
  assert.deepEqual(page.said, []);
  await page.close();
}
const narrow = await open('sphere', 390, 844);
await narrow.shot('start');
await narrow.click('#drawer');
await narrow.waitForTimeout(300);
await narrow.shot('drawer');
assert.ok(await narrow.isVisible('#play'));
await readMeasures(narrow);
assert.deepEqual(narrow.said, []);
// A garment of two fabrics, with measures that nobody knows: a legend, and colours as in the list of parts.
for (const [width, height] of [[1280, 800], [390, 844]]) {
  const page = await open('fabrics', width, height);
  const named = await page.$$eval('#fabrics li', (all) => all.map((item) => [item.textContent, item.querySelector('i').style.background]));
  assert.deepEqual(named.map(([name]) => name), ['linen', 'wool']);
  assert.notEqual(named[0][1], named[1][1]);
  const parts = await page.$$eval('#parts i', (all) => all.map((swatch) => swatch.style.background));
  assert.deepEqual(parts.slice(0, 2), [named[1][1], named[0][1]]);
  assert.ok(await page.isVisible('#fabrics'));
  await page.shot('fabrics');
  if (width < 760) await page.click('#drawer');
  const rowOf = await readMeasures(page);
  assert.deepEqual(rowOf('garment', 'widest gap of a seam'), ['widest gap of a seam', '0.250 mm']);
  assert.deepEqual(rowOf('openings', 'length'), ['length', '631 mm']);
  assert.deepEqual(rowOf('openings', 'ease'), ['ease', '82.0 mm']);
  assert.deepEqual(rowOf('strain of the garment', 'largest'), ['largest', '3.64 %', '12.6 %', '24.3°']);
  assert.deepEqual(rowOf('sway', 'left right'), ['left right', '4°']);
  await page.selectOption('#field', 'strain-warp');
  assert.ok(await page.isHidden('#fabrics') && await page.isVisible('#legend'));
  assert.deepEqual(page.said, []);
  await page.close();
}
const hostile = await open('hostile', 1280, 800);
assert.equal(await hostile.evaluate(() => window.hostile), undefined);
assert.match(await hostile.textContent('#parts'), /<\/script>/);
assert.deepEqual(hostile.said, []);
await browser.close();
console.log('every control works, and the console is silent');
