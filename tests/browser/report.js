// The report as a browser shows it: report.js FOLDER|PAGE.html|FOLDER.set... prints one line "ok - sentence" or "not ok - sentence" per
// case. Of a folder it is the report of a run, with cursor and animation; a page by itself has figures only; a set has several scenarios.
'use strict';
const fs = require('fs');
const path = require('path');
const {chromium} = require('playwright-core');

let failed = 0;
async function check(sentence, test) {
  let trouble;
  try {
    trouble = await test();
  } catch (error) {
    trouble = error.message.split('\n')[0];
  }
  console.log(`${trouble ? 'not ok' : 'ok'} - ${sentence}`);
  if (trouble) console.log(`    ${trouble}`);
  failed += trouble ? 1 : 0;
}

/* Columns of channels.csv by name, as numbers, NaN for an empty field; and the curves that a report makes of them. */
function readChannels(folder) {
  const [names, ...rows] = fs.readFileSync(path.join(folder, 'channels.csv'), 'utf8').trim().split('\r\n').map(row => row.split(','));
  const columns = {};
  names.forEach((name, i) => { columns[name] = rows.map(row => (row[i] === '' ? NaN : Number(row[i]))); });
  const interfaces = names.filter(name => /^E_.*-.*_kJ$/.test(name) && !name.startsWith('E_taken_up'));
  columns.E_interfaces_kJ = rows.map((row, i) => interfaces.reduce((sum, name) => sum + columns[name][i], 0));
  const initial = JSON.parse(fs.readFileSync(path.join(folder, 'summary.json'))).scenarios[0].energy.initial_kJ;
  columns.imbalance_ppm = columns.E_imbalance_kJ.map(off => 1e6 * off / initial);
  return columns;
}

/* Whether a curve was filtered by the report, so that only its shape can be looked at. */
const isFiltered = name => /^c_.*_g$/.test(name);

/* Tolerance of sums of columns that have nine digits. */
const nine = value => 5e-9 * Math.abs(value);

/* Half of the last digit that a number was written with. */
function halfDigit(text) {
  const point = text.indexOf('.');
  return 0.500001 * Math.pow(10, point < 0 ? 0 : point + 1 - text.length);
}

async function open(browser, file, options) {
  const context = await browser.newContext({viewport: {width: 1280, height: 900}, ...options});
  const page = await context.newPage();
  page.seen = {requests: [], messages: []};
  page.on('request', request => page.seen.requests.push(request.url()));
  page.on('console', message => page.seen.messages.push(message.text()));
  page.on('pageerror', error => page.seen.messages.push(error.message));
  await page.goto('file://' + path.resolve(file));
  return page;
}

async function movesQuietly(page) {
  await page.mouse.move(300, 300);
  await page.click('#play');
  await page.waitForTimeout(300);
  await page.click('#play');
  return isQuiet(page);
}

function isQuiet(page) {
  if (page.seen.requests.length !== 1) return 'requests: ' + page.seen.requests.join(' ');
  if (page.seen.messages.length !== 0) return 'messages: ' + page.seen.messages.join(' | ');
}

async function isWellFormed(page, file) {
  return page.evaluate(text => {
    const parsed = new DOMParser().parseFromString(text, 'application/xml').querySelector('parsererror');
    return parsed ? parsed.textContent : '';
  }, fs.readFileSync(file, 'utf8'));
}

/* Moves the mouse over a time plot and compares the values below it with the row of that time. */
async function cursorShowsChannels(page, channels, prefix, shares) {
  const plot = page.locator(`svg.plot:has(path[data-y^="${prefix}"]:not([data-x]))`).first();
  await plot.scrollIntoViewIfNeeded();
  const names = await plot.evaluate(svg => Array.from(svg.querySelectorAll('path[data-y]')).map(p => [p.dataset.name, p.dataset.y]));
  for (const share of shares) {
    await pointAt(page, plot, share, 0.5);
    const text = await plot.evaluate(svg => svg.parentNode.querySelector('output').textContent);
    const [time, ...values] = text.split(' \u00b7 ');
    const row = channels.t_ms.findIndex(t => Math.abs(t - parseFloat(time)) <= halfDigit(time.split(' ')[0]));
    if (row < 0) return `no sample at ${time}`;
    if (values.length !== names.length) return `${values.length} values of ${names.length}: ${text}`;
    for (let i = 0; i < names.length; i++) {
      const shown = values[i].slice(names[i][0].length + 1), real = channels[names[i][1]][row];
      if (!(Math.abs(Number(shown) - real) <= halfDigit(shown))) return `${names[i][1]} at ${time} is ${real}, shown as ${shown}`;
    }
  }
}

/* Moves the mouse to a place between the axes, in shares of width and height. */
async function pointAt(page, plot, x, y) {
  const place = await plot.evaluate((svg, [shareX, shareY]) => {
    const [left, top, width, height] = svg.dataset.box.split(' ').map(Number);
    const point = svg.createSVGPoint();
    point.x = left + shareX * width;
    point.y = top + shareY * height;
    const screen = point.matrixTransform(svg.getScreenCTM());
    return [screen.x, screen.y];
  }, [x, y]);
  await page.mouse.move(place[0], place[1]);
}

/* Over a loop the nearest point is selected; force and closure are of the same row. */
async function cursorFollowsLoops(page, channels) {
  for (const plot of await page.locator('svg.plot:has(path[data-x])').all()) {
    await plot.scrollIntoViewIfNeeded();
    const [x, y] = await plot.evaluate(svg => [svg.querySelector('path[data-x]').dataset.x, svg.querySelector('path[data-x]').dataset.y]);
    for (const [shareX, shareY] of [[0.3, 0.5], [0.95, 0.7]]) {
      await pointAt(page, plot, shareX, shareY);
      const text = await plot.evaluate(svg => svg.parentNode.querySelector('output').textContent);
      const [, time, closure, force] = text.match(/^([\d.]+) ms \u00b7 closure ([-\d.]+) mm, force ([-\d.]+) kN$/) || [];
      const row = channels.t_ms.findIndex(t => Math.abs(t - Number(time)) <= halfDigit(time));
      if (row < 0 || !(Math.abs(Number(closure) - channels[x][row]) <= halfDigit(closure)) ||
          !(Math.abs(Number(force) - channels[y][row]) <= halfDigit(force)))
        return `${y}: ${text}, row ${row}`;
    }
  }
}

/* The values below each figure at rows of channels.csv, up to the last row that the page contains
 * without gaps. */
async function everyRowIsThere(page, channels) {
  const told = await page.locator('p', {hasText: 'Cursor and animation cover'}).textContent();
  const until = told.includes('every row') ? Number(told.match(/until ([\d.]+) ms/)[1]) * 0.995 : Infinity; // told with three digits
  const times = channels.t_ms.filter((t, i) => t <= until && (i < 400 || i % 7 === 0));
  const plots = await page.evaluate(all => {
    const figures = Array.from(document.querySelectorAll('svg.plot:has(path[data-y])'));
    const input = document.getElementById('scrub');
    return figures.map(svg => Array.from(svg.querySelectorAll('path[data-y]')).map(p => [p.dataset.x, p.dataset.y])).concat([all.map(t => {
      input.value = t;
      input.dispatchEvent(new Event('input'));
      return figures.map(svg => svg.parentNode.querySelector('output').textContent);
    })]);
  }, times);
  const shown = plots.pop();
  for (let i = 0; i < times.length; i++) {
    const row = channels.t_ms.indexOf(times[i]);
    for (let k = 0; k < plots.length; k++) {
      const [time, ...values] = shown[i][k].split(' \u00b7 ');
      if (parseFloat(time) !== times[i]) return `at ${times[i]} ms stands ${time}`;
      const [x, y] = plots[k][0];
      const pairs = x ? [[x, values[0].match(/closure ([-\d.]+) mm/)[1]], [y, values[0].match(/force ([-\d.]+) kN/)[1]]]
                      : plots[k].map(([, name], n) => [name, values[n].slice(values[n].lastIndexOf(' ') + 1)]);
      for (const [name, text] of pairs) {
        if (isFiltered(name) && !isNaN(Number(text))) continue;
        const real = channels[name][row];
        if (text === '\u2013' ? !isNaN(real) : !(Math.abs(Number(text) - real) <= halfDigit(text) + nine(real))) return `${name} at ${time} is ${real}, shown as ${text}`;
      }
    }
  }
  if (times.length < 300 || plots.length < 8) return `only ${times.length} rows of ${plots.length} figures`;
}

/* The dot of a curve is at its value, on one of the line segments of the curve. */
async function dotsLieOnCurves(page) {
  return page.evaluate(() => {
    const distance = (px, py, x, y, dx, dy) => {
      const along = dx * dx + dy * dy > 0 ? ((px - x) * dx + (py - y) * dy) / (dx * dx + dy * dy) : 0;
      const share = Math.min(1, Math.max(0, along));
      return Math.hypot(px - x - share * dx, py - y - share * dy);
    };
    for (const svg of document.querySelectorAll('svg.plot')) {
      const paths = svg.querySelectorAll('path[data-y]'), dots = svg.querySelectorAll('circle.dot');
      for (let i = 0; i < paths.length; i++) {
        const at = [Number(dots[i].getAttribute('cx')), Number(dots[i].getAttribute('cy'))];
        if (at[1] < 0) continue; // no value at this time
        let x = 0, y = 0, nearest = Infinity; // in tenths, as the path
        const moves = paths[i].getAttribute('d').matchAll(/([Ml])(-?[\d.]+) ?(-?[\d.]+)/g);
        for (const [, command, first, second] of moves) {
          const dx = command === 'l' ? Number(first) : 0, dy = command === 'l' ? Number(second) : 0;
          if (command === 'M') [x, y] = [Number(first), Number(second)];
          nearest = Math.min(nearest, distance(10 * at[0], 10 * at[1], x, y, dx, dy) / 10);
          x += dx;
          y += dy;
        }
        if (!(nearest <= 0.5)) return `${paths[i].dataset.y}: dot ${nearest} away`;
      }
    }
    return '';
  });
}

async function scrub(page, share) {
  await page.evaluate(s => {
    const input = document.getElementById('scrub');
    input.value = Math.round(s * input.max);
    input.dispatchEvent(new Event('input'));
  }, share);
  return parseFloat(await page.locator('#now').textContent());
}

/* Cars, ends and wheels are at the places of the channels. */
async function animationFollowsChannels(page, channels) {
  let crushed = 0;
  for (const share of [0, 0.05, 0.1, 0.3, 1]) {
    const time = await scrub(page, share);
    const row = channels.t_ms.findIndex(t => Math.abs(t - time) < 0.051);
    const cars = await page.evaluate(() => Array.from(document.querySelectorAll('svg.animation g.car')).map(g => ({
      name: g.dataset.car, at: Number(g.dataset.at), x: g.transform.baseVal.getItem(0).matrix.e, bare: Number(g.dataset.front),
      end: g.querySelector('.end.front') ? Number(g.querySelector('.end.front').getAttribute('x2')) : NaN,
      wheel: g.querySelector('.wheel') ? Number(g.querySelector('.wheel').getAttribute('cy')) + Number(g.querySelector('.wheel').getAttribute('r')) : NaN})));
    for (let i = 1; i < cars.length; i++) {
      const apart = cars[i].at + channels[`x_${cars[i].name}_m`][row] - cars[0].at - channels[`x_${cars[0].name}_m`][row];
      if (Math.abs((cars[i].x - cars[0].x) / 24 - apart) > 2e-3) return `${cars[i].name} at ${time} ms is ${(cars[i].x - cars[0].x) / 24} m ahead instead of ${apart}`;
    }
    for (const car of cars) {
      const stroke = channels[`d_end_front_${car.name}_mm`], lift = channels[`z_${car.name}_w1_mm`];
      if (stroke && Math.abs(car.bare - car.end / 24 - stroke[row] / 1e3) > 1e-3) return `end of ${car.name} at ${time} ms`;
      if (lift && Math.abs(-car.wheel / 24 - 10 * lift[row] / 1e3) > 2e-3) return `wheel of ${car.name} at ${time} ms`;
      crushed = Math.max(crushed, stroke ? stroke[row] : 0);
    }
  }
  return '';
}

async function playsAndStops(page) {
  await scrub(page, 0);
  await page.click('#play');
  await page.waitForTimeout(700);
  await page.click('#play');
  const then = parseFloat(await page.locator('#now').textContent());
  if (!(then > 0)) return 'time stands still';
  await page.waitForTimeout(200);
  if (parseFloat(await page.locator('#now').textContent()) !== then) return 'it goes on after the pause';
  if (await page.locator('#focus option').count() === 1) return; // of two cars
  const before = await page.locator('#now').textContent();
  await page.locator('#focus').selectOption({index: 0});
  if (await page.locator('#now').textContent() === before) return 'another interface shows nothing else';
}

/* No text of a figure lies on another one, none of the legend between the axes. */
async function labelsKeepApart(page) {
  return page.evaluate(() => {
    document.querySelectorAll('details').forEach(d => { d.open = true; });
    for (const svg of document.querySelectorAll('figure svg, svg.row')) {
      const boxes = Array.from(svg.querySelectorAll('text')).map(t => [t.textContent, t.getBoundingClientRect()]);
      const own = svg.getBoundingClientRect();
      if (svg.classList.contains('frame')) continue; // names on cars lie where the cars are
      for (let i = 0; i < boxes.length; i++) {
        const a = boxes[i][1];
        if (a.left < own.left - 1 || a.right > own.right + 1 || a.bottom > own.bottom + 1) return `"${boxes[i][0]}" leaves the figure`;
        for (let k = 0; k < i; k++) {
          const b = boxes[k][1];
          if (Math.min(a.right, b.right) - Math.max(a.left, b.left) > 0.5 && Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top) > 2)
            return `"${boxes[i][0]}" on "${boxes[k][0]}"`;
        }
      }
    }
    return '';
  });
}

async function isWholeWithoutScript(browser, file, withScript) {
  const page = await open(browser, file, {javaScriptEnabled: false});
  const n = await page.locator('svg.plot path[d]').count();
  if (n !== withScript || n < 10) return `${n} curves instead of ${withScript}`;
  if (!await page.locator('.strip').isVisible()) return 'the strip of frames is hidden';
  if (await page.locator('#stage').isVisible()) return 'controls that do nothing are shown';
  if (page.seen.messages.length > 0) return page.seen.messages.join(' | ');
  await page.context().close();
}

async function fits(browser, file, width, picture, colorScheme) {
  const page = await open(browser, file, {viewport: {width, height: 900}, colorScheme});
  const wide = await page.evaluate(() => document.documentElement.scrollWidth);
  await page.screenshot({path: picture, fullPage: true});
  const [ink, paper] = await page.evaluate(() => [getComputedStyle(document.body).color, getComputedStyle(document.body).backgroundColor]);
  await page.context().close();
  const bright = text => text.match(/\d+/g).map(Number).reduce((a, b) => a + b);
  if (wide > width) return `it is ${wide} wide`;
  if ((bright(ink) > bright(paper)) !== (colorScheme === 'dark')) return `ink ${ink} on ${paper}`;
}

async function prints(page) {
  const pdf = await page.pdf({format: 'A4'});
  if (pdf.slice(0, 5).toString() !== '%PDF-') return 'no PDF';
  if (pdf.length < 50000) return `only ${pdf.length} bytes`;
}

/* A page without cursor: of a sweep, a map, samples, a comparison. */
async function lookAtPage(browser, file) {
  const name = path.basename(file, '.html'), page = await open(browser, file);
  const n = await page.locator('figure svg').count();
  await check(`${name}: the page loads nothing and prints nothing on the console`, () => isQuiet(page));
  await check(`${name}: it has figures, and the same number without scripts`, async () => {
    const plain = await open(browser, file, {javaScriptEnabled: false});
    const others = await plain.locator('figure svg').count();
    await plain.context().close();
    return n > 0 && others === n ? '' : `${n} figures, ${others} without scripts`;
  });
  await check(`${name}: an XML parser accepts it`, () => isWellFormed(page, file));
  await check(`${name}: labels do not overlap`, () => labelsKeepApart(page));
  await check(`${name}: it fits 1280 pixels`, () => fits(browser, file, 1280, `${name}-1280.png`, 'light'));
  await check(`${name}: at 400 pixels tables of many columns are within the page`, () => tablesFit(browser, file, 400));
  await check(`${name}: it fits 400 pixels, in the dark`, () => fits(browser, file, 400, `${name}-400.png`, 'dark'));
  await page.context().close();
}

/* Cells of tables with more than four columns that are outside a narrow page. */
async function tablesFit(browser, file, width) {
  const page = await open(browser, file, {viewport: {width, height: 900}, javaScriptEnabled: true});
  const wide = await page.evaluate(width => {
    for (const table of document.querySelectorAll('.wide > table'))
      if (table.querySelectorAll('th').length > 4)
        for (const cell of table.querySelectorAll('td'))
          if (cell.getBoundingClientRect().right > width) return `"${cell.textContent}" ends beyond ${width}`;
    return '';
  }, width);
  await page.context().close();
  return wide;
}

async function look(browser, folder) {
  const file = path.join(folder, 'report.html'), channels = readChannels(folder);
  const page = await open(browser, file);
  const n = await page.locator('svg.plot path[d]').count();
  await check(`${folder}: the report loads nothing and prints nothing on the console`, () => movesQuietly(page));
  await check(`${folder}: an XML parser accepts it`, () => isWellFormed(page, file));
  await check(`${folder}: it is smaller than 1 MB`, () => (fs.statSync(file).size <= 1e6 ? '' : `${fs.statSync(file).size} bytes`));
  await check(`${folder}: speeds at the cursor equal those of channels.csv`, () => cursorShowsChannels(page, channels, 'v_', [0.001, 0.1, 0.37, 0.8, 0.999]));
  await check(`${folder}: forces at the cursor equal those of channels.csv`, () => cursorShowsChannels(page, channels, 'F_', [0.02, 0.3, 0.9]));
  await check(`${folder}: energies at the cursor equal those of channels.csv`, () => cursorShowsChannels(page, channels, 'E_kinetic', [0.05, 0.5]));
  await check(`${folder}: closure and force at the cursor belong to one row`, () => cursorFollowsLoops(page, channels));
  await check(`${folder}: the cursor shows every row up to the last one of the page`, () => everyRowIsThere(page, channels));
  await check(`${folder}: dots are on their curves`, () => dotsLieOnCurves(page));
  await check(`${folder}: cars, ends and wheels move as in the channels`, () => animationFollowsChannels(page, channels));
  await check(`${folder}: the animation plays, stops and changes its view`, () => playsAndStops(page));
  await check(`${folder}: labels do not overlap and legends are outside the axes`, () => labelsKeepApart(page));
  await check(`${folder}: it prints`, () => prints(page));
  await check(`${folder}: it is complete without its script`, () => isWholeWithoutScript(browser, file, n));
  await check(`${folder}: it fits 1280 pixels`, () => fits(browser, file, 1280, `${folder}-1280.png`, 'light'));
  await check(`${folder}: it fits 400 pixels, in the dark`, () => fits(browser, file, 400, `${folder}-400.png`, 'dark'));
  await page.context().close();
}

/* Every link of a page leads to something: a part of the page, or a file. */
async function linksLead(page, file) {
  const targets = await page.evaluate(() => Array.from(document.querySelectorAll('a[href]')).map(a => a.getAttribute('href')));
  const ids = await page.evaluate(() => Array.from(document.querySelectorAll('[id]')).map(e => e.id));
  if (new Set(ids).size !== ids.length) return 'an id is there twice';
  for (const target of targets) {
    const there = target.startsWith('#') ? ids.includes(target.slice(1)) : fs.existsSync(path.join(path.dirname(file), decodeURIComponent(target)));
    if (!there) return `${target} is not there`;
  }
}

/* Rows of the tables of checks and of the matrix on a narrow page: nothing of limit, value and margin is cut off. */
async function isReadable(browser, file, width) {
  const page = await open(browser, file, {viewport: {width, height: 900}, javaScriptEnabled: true});
  const wrong = await page.evaluate(width => {
    let n = 0;
    for (const table of document.querySelectorAll('table.matrix, section > .wide > table.checks')) {
      const heads = Array.from(table.querySelectorAll('th')).map(th => th.textContent);
      for (const row of table.querySelectorAll('tr')) {
        const cells = Array.from(row.querySelectorAll('td'));
        const wanted = table.classList.contains('matrix') ? cells : cells.filter((cell, k) => ['limit', 'value', 'margin', 'verdict'].includes(heads[k]));
        for (const cell of wanted.filter(cell => cell.textContent !== '')) {
          const box = cell.getBoundingClientRect();
          n++;
          if (!(box.width > 0) || box.left < 0 || box.right > width) return `"${cell.textContent}" is at ${box.left} to ${box.right}`;
        }
      }
    }
    return n > 40 ? '' : `only ${n} cells`;
  }, width);
  await page.context().close();
  return wrong;
}

/* The matrix has the verdicts of checks.csv's document, a cell for each check that decides there. */
async function matrixIsThatOfChecks(page, folder) {
  const summary = JSON.parse(fs.readFileSync(path.join(folder, 'summary.json')));
  const table = await page.evaluate(() => Array.from(document.querySelectorAll('table.matrix tr')).map(row => Array.from(row.children).map(cell => [cell.textContent, cell.className])));
  const heads = table[0].map(cell => cell[0]);
  for (const row of table.slice(2))
    for (let k = 1; k < heads.length - 1; k++) {
      const checks = summary.checks.filter(check => check.name === row[0][0] && (check.family || check.scenario) === heads[k]);
      if ((checks.length === 0) !== (row[k][0] === '')) return `${row[0][0]}, ${heads[k]}: "${row[k][0]}" for ${checks.length} checks`;
      if (checks.some(check => check.verdict === 'fail') !== row[k][1].includes('fail')) return `${row[0][0]}, ${heads[k]}: ${row[k]}`;
    }
  if (table.length < 10 || heads.length < 5) return 'it is small';
}

/* A run of several scenarios: the first page has the matrix, and figures of the scenarios that decide. */
async function lookAtSet(browser, folder) {
  const set = path.basename(folder, '.set'), file = path.join(folder, 'report.html'), page = await open(browser, file);
  await check(`${set}: the report loads nothing and prints nothing on the console`, () => movesQuietly(page));
  await check(`${set}: an XML parser accepts it`, () => isWellFormed(page, file));
  await check(`${set}: it is smaller than 1 MB`, () => (fs.statSync(file).size <= 1e6 ? '' : `${fs.statSync(file).size} bytes`));
  await check(`${set}: the matrix is that of the checks`, () => matrixIsThatOfChecks(page, folder));
  await check(`${set}: every link leads to a check, a figure or the report of a scenario`, () => linksLead(page, file));
  await check(`${set}: a margin leads to its check, also in a folded table`, async () => {
    const target = await page.evaluate(() => Array.from(document.querySelectorAll('table.matrix a[href^="#check-"]'))
      .map(link => link.getAttribute('href').slice(1)).find(id => document.getElementById(id).closest('details')));
    if (!target || await page.locator(`#${target}`).isVisible()) return `${target} is not folded`;
    await page.locator(`table.matrix a[href="#${target}"]`).first().click();
    await page.waitForTimeout(100);
    return await page.locator(`#${target}`).isVisible() ? '' : `${target} stays hidden`;
  });
  await check(`${set}: links of a scenario's report lead somewhere, too`, async () => {
    const other = path.join(folder, 'slow', 'report.html'), below = await open(browser, other);
    return linksLead(below, other);
  });
  await check(`${set}: the head has project, author, revision, date and profile`, async () => {
    const head = await page.locator('dl.document').textContent();
    return ['Line 8', 'J. Doe', 'B', '2026-11-30', 'en15227-2008', 'C-II', 'crushzone '].find(word => !head.includes(word));
  });
  await check(`${set}: figures of other scenarios have no cursor`, async () => {
    const still = await page.locator('#deciding svg.still').count(), moving = await page.locator('#deciding svg.still path[data-y]').count();
    return still > 0 && moving === 0 ? '' : `${still} figures, ${moving} curves with a cursor`;
  });
  await check(`${set}: labels do not overlap and legends are outside the axes`, () => labelsKeepApart(page));
  await check(`${set}: at 400 pixels limit, value and margin are visible`, () => isReadable(browser, file, 400));
  await check(`${set}: it fits 1280 pixels`, () => fits(browser, file, 1280, `${set}-1280.png`, 'light'));
  await check(`${set}: it fits 400 pixels, in the dark`, () => fits(browser, file, 400, `${set}-400.png`, 'dark'));
  await check(`${set}: it prints`, () => prints(page));
  await page.context().close();
}

(async () => {
  const browser = await chromium.launch({
    executablePath: process.env.CHROMIUM || '/usr/bin/chromium',
    args: ['--no-sandbox', '--disable-gpu', '--disable-quic', '--no-first-run', '--disable-background-networking',
           '--disable-component-update', '--disable-sync']});
  for (const what of process.argv.slice(2)) await (what.endsWith('.html') ? lookAtPage : what.endsWith('.set') ? lookAtSet : look)(browser, what);
  await browser.close();
  process.exit(failed > 0 ? 1 : 0);
})().catch(error => {
  console.log(`not ok - the browser starts\n    ${error.message}`);
  process.exit(1);
});
