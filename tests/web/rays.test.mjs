// A click opens the ray that is there; sliders and filters hide what they should, as the program itself has it.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { after, before, test } from 'node:test';
import { closedWithoutFault, drawn, launch, opened, rowsOf, sahl, traced } from './browser.mjs';

let browser, folder, rows, page;
before(async () => {
    browser = await launch();
    folder = traced('ball-lens', '--set', 'source.beam.beam.rays=100');
    rows = rowsOf(folder);
    page = await opened(browser, folder);
});
after(() => browser.close());

const end = row => ['x_mm', 'y_mm', 'z_mm'].map((name, i) => Number(row[name]) + Number(row.length_mm) * Number(row[['dx', 'dy', 'dz'][i]]));

/// Where a place (mm) is seen in a picture of this size, by a camera of 30° whose up is y.
function projected(camera, place, width, height) {
    const sub = (a, b) => a.map((x, i) => x - b[i]), dot = (a, b) => a.reduce((s, x, i) => s + x * b[i], 0);
    const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
    const unit = a => a.map(x => x / Math.hypot(...a));
    const ahead = unit(sub(camera.slice(3), camera.slice(0, 3))), right = unit(cross(ahead, [0, 1, 0])), up = cross(right, ahead);
    const seen = sub(place, camera.slice(0, 3)), scale = height / 2 / Math.tan(Math.PI / 12) / dot(seen, ahead);
    return [width / 2 + scale * dot(seen, right), height / 2 - scale * dot(seen, up)];
}

const apart = (p, [a, b]) => {
    const d = [b[0] - a[0], b[1] - a[1]], t = Math.min(1, Math.max(0, ((p[0] - a[0]) * d[0] + (p[1] - a[1]) * d[1]) / (d[0] ** 2 + d[1] ** 2 || 1)));
    return Math.hypot(a[0] + t * d[0] - p[0], a[1] + t * d[1] - p[1]);
};

test('clicks at the middles of 20 segments open their rays, in the words and numbers of sahl explain', async () => {
    const camera = [9, 7, -25, 0.2, 0.1, -0.3], few = rows.filter(r => Number(r.ray) % 9 === 4 && Number.isFinite(Number(r.length_mm)) && Number(r.length_mm) > 0);
    const rays = [...new Set(rows.filter(r => Number(r.ray) % 9 === 4).map(r => r.ray))];
    const filter = rays.map(ray => `ray = ${ray}`).join(' or ');
    const own = await opened(browser, folder, { fragment: new URLSearchParams({ camera: camera.join(','), filter }).toString(), width: 1700, height: 1250 });
    const box = await own.locator('.stage canvas').boundingBox();
    const lines = new Map(few.map(r => [r, [[r.x_mm, r.y_mm, r.z_mm].map(Number), end(r)].map(p => projected(camera, p, box.width, box.height))]));
    const clear = few.filter(r => { // nothing else within 3 pixels, so that the place means one segment
        const [a, b] = lines.get(r);
        const place = [r.x_mm, r.y_mm, r.z_mm].map((x, i) => (Number(x) + end(r)[i]) / 2);
        r.at = projected(camera, place, box.width, box.height);
        return Math.hypot(b[0] - a[0], b[1] - a[1]) > 12 && few.every(o => o === r || apart(r.at, lines.get(o)) > 3) && r.at[0] > 5 && r.at[0] < box.width - 5 && r.at[1] > 40 && r.at[1] < box.height - 5;
    });
    assert.ok(clear.length >= 20, `only ${clear.length} segments stand alone`);
    const step = clear.length / 20;
    for (let k = 0; k < 20; ++k) {
        const row = clear[Math.floor(k * step)];
        await own.mouse.click(box.x + row.at[0], box.y + row.at[1]);
        const explained = sahl('explain', folder, '--ray', row.ray).trimEnd().split('\n');
        assert.equal(await own.locator('.ray-panel .heading').textContent(), explained[0]);
        assert.deepEqual(await own.locator('.tree .line').allTextContents(), explained.slice(1));
        const chosen = await own.locator('.tree .line.chosen.title').textContent();
        const heights = await own.locator('.tree .line').evaluateAll(lines => lines.map(line => line.clientHeight));
        assert.ok(Math.max(...heights) < 24, `a line of the tree is ${Math.max(...heights)} pixels high`);
        assert.match(chosen, new RegExp(`#${row.segment} ${row.born} in `));
        const cells = await own.locator('.ray-panel td').allTextContents();
        for (const [name, value] of [['power at start (W)', row.power_start_W], ['length (mm)', row.length_mm]]) {
            const shown = Number(cells[cells.indexOf(name) + 1]);
            assert.ok(Math.abs(shown - Number(value)) <= 4e-16 * Math.abs(Number(value)), `${name}: ${shown} is not ${value}`);
        }
    }
    await closedWithoutFault(own);
});

/// What is drawn: "ray/segment" of each.
const shown = () => page.evaluate(() => {
    const { viewer, data } = window.sahl, list = [];
    for (let ray = 0; ray + 1 < data.rays.begin.length; ++ray)
        for (let i = data.rays.begin[ray]; i < data.rays.begin[ray + 1]; ++i)
            if (viewer.visible[i]) list.push(`${data.rays.number[ray]}/${data.rays.index ? data.rays.index[i] : i - data.rays.begin[ray]}`);
    return list;
});
const named = list => list.map(r => `${r.ray}/${r.segment}`);

test('every explanation on the page is that of sahl explain', async () => {
    for (const ray of [...new Set(rows.map(r => r.ray))].filter((_, i) => i % 7 === 0)) {
        const place = await page.evaluate(number => window.sahl.data.rays.number.indexOf(number), Number(ray));
        assert.equal(await page.evaluate(at => window.sahl.explain(at), place), sahl('explain', folder, '--ray', ray));
    }
});

test('the sliders hide what is deeper or weaker', async () => {
    assert.deepEqual(await shown(), named(rows));
    for (const depth of [0, 1, 3]) {
        await page.locator('#depth').fill(String(depth));
        const left = rows.filter(r => Number(r.depth) <= depth);
        assert.deepEqual(await shown(), named(left));
        assert.match(await page.locator('.shown').textContent(), new RegExp(`^${String(left.length).replace(/\B(?=(\d{3})+$)/g, '\u202f')} of `));
    }
    await page.getByTitle('Draw all rays again').click();
    const roots = Object.fromEntries(rows.filter(r => r.parent === '-1').map(r => [r.ray, Number(r.power_start_W)]));
    for (const power of [-1, -2.5, 0]) {
        const slider = page.locator('#power'), least = Number(await slider.getAttribute('min'));
        await slider.evaluate((element, value) => { element.value = value; element.dispatchEvent(new Event('input')); }, power);
        const set = await slider.inputValue();
        assert.ok(Math.abs(Number(set) - power) < 0.06 && Number(set) > least);
        assert.deepEqual(await shown(), named(rows.filter(r => Number(r.power_start_W) / roots[r.ray] >= 10 ** Number(set))));
    }
    await page.getByTitle('Draw all rays again').click();
    assert.equal((await shown()).length, rows.length);
});

const filters = [
    'hits(ball)', 'hits(ball) >= 3 and not ends(escaped)', 'reflected(ball)', 'reflected >= 2', 'total_internal', 'refracted in [1, 2]', 'through(glass) > 2',
    'ends("paraxial focus")', 'ends(escaped) or ends(cut_power)', 'order(refracted, reflected, escaped)', 'run(2 reflected)', 'run(refracted(ball), any, refracted)',
    'path(refracted(ball), refracted(ball), detected("paraxial focus"))', 'path(refracted(ball), 2 reflected(b*), any, any)', 'source(fan)', 'not source(f?n) and depth = 2',
    'wavelength_nm in [500, 600]', 'power_W < 1e-6', 'share >= 0.01 and share < 0.1', 'optical_path_mm > 25', 'ray != 7 and ray <= 30', 'not (depth > 2 or reflected) and ray < 50'];

test('the filter box selects what the program selects', async () => {
    for (const filter of filters) {
        await page.locator('#filter').fill(filter);
        assert.equal(await page.locator('#filter-problem').textContent(), '', filter);
        assert.deepEqual(await shown(), named(rowsOf(folder, '--where', filter)), filter);
    }
});

test('a filter that is wrong is marked at the word, as the program marks it, and changes nothing', async () => {
    await page.locator('#filter').fill('reflected >= 2');
    const before = await shown();
    for (const filter of ['hits(bal) and reflected', 'reflected >=', 'hits(ball', 'nonsense', 'run(65 any)', 'depth', 'share in [2, 1]', 'hits("ball)', 'ball', 'reflected reflected', 'ray = 1e', 'order()']) {
        await page.locator('#filter').fill(filter);
        const marked = (await page.locator('#filter-problem').textContent()).split('\n');
        assert.deepEqual(await shown(), before, filter);
        const said = (() => {
            try {
                sahl('export', folder, '--to', '/dev/null/x.csv', '--where', filter);
            } catch (error) {
                return String(error.stderr).trimEnd().split('\n');
            }
            return [];
        })();
        assert.equal(marked[1], said[2]?.slice(4), filter);
        assert.ok(said[0].includes(marked[2].split('; ')[0]), `${said[0]} is not ${marked[2]}`);
    }
});

test('a path in the list is drawn alone by a click, and light plays along it', async () => {
    await page.getByTitle('Draw all rays again').click();
    await page.locator('.groups .entry').first().click();
    const filter = await page.locator('#filter').inputValue();
    assert.match(filter, /^path\(/);
    const wanted = named(rowsOf(folder, '--where', filter));
    assert.deepEqual(await shown(), wanted);
    await page.locator('#play').click();
    await page.waitForFunction(() => window.sahl.viewer.way > 0);
    await page.locator('#play').click();
    assert.match(await page.locator('.play output').textContent(), /mm, .* ps/);
    await drawn(page);
});

test('a link brings back the view', async () => {
    await page.locator('#filter').fill('reflected >= 1');
    await page.keyboard.press('Escape');
    await page.locator('.stage').focus();
    await page.keyboard.press('ArrowLeft');
    await page.keyboard.press('3');
    await page.keyboard.press(']');
    await page.waitForFunction(() => location.hash.includes('camera=') && location.hash.includes('segment=') && location.hash.includes('colour=depth'));
    const state = p => p.evaluate(() => ({ ...window.sahl.viewer.view, camera: window.sahl.viewer.stage.view.map(x => Number(x.toPrecision(5))) }));
    const again = await opened(browser, folder, { fragment: new URL(page.url()).hash.slice(1) });
    assert.deepEqual(await state(again), await state(page));
    await closedWithoutFault(again);
});

test('a picture is saved as PNG', async () => {
    const [download] = await Promise.all([page.waitForEvent('download'), page.getByTitle('Save a picture (s)').click()]);
    const bytes = readFileSync(await download.path());
    assert.equal(bytes.subarray(1, 4).toString(), 'PNG');
    assert.ok(bytes.length > 10000);
});

test('none of that made the console complain', () => closedWithoutFault(page));
