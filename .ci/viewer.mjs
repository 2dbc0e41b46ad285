import { chromium } from '/tmp/three/node_modules/playwright-core/index.mjs';
const [,, file, out, width = '1280', height = '800'] = process.argv;
const browser = await chromium.launch({ executablePath: '/usr/bin/chromium', args: ['--no-sandbox', '--disable-gpu-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--disable-background-networking', '--disable-component-update', '--disable-sync'] });
const page = await browser.newPage({ viewport: { width: +width, height: +height } });
const said = [];
page.on('console', (m) => said.push(m.type() + ': ' + m.text()));
page.on('pageerror', (e) => said.push('error: ' + e.message));
const t0 = Date.now();
await page.goto('file://' + file);
await page.waitForFunction(() => window.drapeViewer, null, { timeout: 120000 });
console.log('loaded, ms by page clock', await page.evaluate(() => window.drapeViewer.loaded), 'wall', Date.now() - t0);
await page.screenshot({ path: out + '-1.png' });
for (const value of await page.$$eval('#field option', (all) => all.map((o) => o.value))) {
  await page.evaluate((v) => { const f = document.getElementById('field'); f.value = v; f.dispatchEvent(new Event('change')); }, value);
  await page.waitForTimeout(150);
  if (value) await page.screenshot({ path: `${out}-field-${value}.png` });
}
const box = await page.locator('#canvas').boundingBox();
await page.mouse.click(box.x + box.width / 2, box.y + box.height / 2);
await page.waitForTimeout(200);
console.log('picked:', (await page.textContent('#picked')).slice(0, 400));
if (+width > 760) {
for (const id of ['front', 'flank', 'back', 'top', 'fit', 'theme', 'theme', 'lines', 'edges', 'edges', 'lines']) { await page.click('#' + id); await page.waitForTimeout(100); }
await page.selectOption('#axis', 'x'); await page.fill('#cut', '400'); await page.check('#flip'); await page.waitForTimeout(200);
await page.screenshot({ path: out + '-section.png' });
await page.selectOption('#axis', '');
for (const check of await page.$$('#parts input')) { await check.click(); await page.waitForTimeout(30); await check.click(); }
await page.click('#theme'); await page.waitForTimeout(200); await page.screenshot({ path: out + '-dark.png' }); await page.click('#theme');
await page.fill('#scrub', '0'); await page.waitForTimeout(200); await page.screenshot({ path: out + '-first.png' });
for (const speed of ['0.1', '5']) await page.selectOption('#speed', speed);
await page.click('#play'); await page.waitForTimeout(500); console.log('clock', await page.textContent('#clock'));
await page.focus('#canvas');
for (const key of ['Space', 'ArrowLeft', 'ArrowRight', 'm', 'l', 'f', 't', '1', '2', '3', '4', 't']) { await page.keyboard.press(key); await page.waitForTimeout(60); }
} else {
await page.click('#drawer'); await page.waitForTimeout(300); await page.screenshot({ path: out + '-drawer.png' });
}
// Frames per second while turning, by the page's own clock.
const fps = await page.evaluate(async () => {
  const { camera, views } = window.drapeViewer; let n = 0; const t0 = performance.now();
  while (performance.now() - t0 < 3000) { camera.position.applyAxisAngle({x:0,y:1,z:0}, 0.02); camera.lookAt(0, 0, 0); window.dispatchEvent(new Event('resize')); await new Promise(requestAnimationFrame); n++; }
  return n / 3;
});
console.log('turning, frames per second', fps.toFixed(1));
console.log('console:', said);
await browser.close();
