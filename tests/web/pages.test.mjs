// Pages of the demo and of experiments load without a fault, say what their runs say, and ask for nothing.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { closedWithoutFault, launch, opened, sahl, scratch, summaryOf, traced, tracedText } from './browser.mjs';

let browser;
before(async () => { browser = await launch(); });
after(() => browser.close());

/// How many pixels of the picture differ from its corner: something is drawn.
const coloured = page => page.evaluate(() => {
    const { stage } = window.sahl.viewer, copy = document.createElement('canvas');
    copy.width = 200;
    copy.height = 150;
    stage.drawNow();
    const context = copy.getContext('2d');
    context.drawImage(stage.canvas, 0, 0, 200, 150);
    const pixels = context.getImageData(0, 0, 200, 150).data;
    let count = 0;
    for (let i = 0; i < pixels.length; i += 4) if (Math.abs(pixels[i] - pixels[0]) + Math.abs(pixels[i + 1] - pixels[1]) + Math.abs(pixels[i + 2] - pixels[2]) > 12) ++count;
    return count;
});

const terms = ['detected', 'absorbed', 'escaped', 'cut', 'error'];

// bent-guide is what scripts/demo traces
for (const [experiment, theme] of [['bent-guide', 'dark'], ['ball-lens', 'light'], ['achromat', 'dark'], ['prism-minimum-deviation', 'light']])
    test(`the page of ${experiment} loads without a fault, and its ledger adds up`, async () => {
        const folder = traced(experiment);
        const summary = summaryOf(folder), page = await opened(browser, folder, { theme });
        assert.equal(await page.locator('h1').textContent(), summary.title);
        assert.ok((await coloured(page)) > 600);
        const bar = await page.locator('.ledger-bar').boundingBox();
        const energy = summary.energy_W, sum = terms.reduce((s, t) => s + Math.max(0, energy[t]), 0);
        let covered = 0;
        for (const term of terms) {
            const part = page.locator(`.ledger-bar .${term}`);
            if (energy[term] <= 0) {
                assert.equal(await part.count(), 0);
                continue;
            }
            const { width } = await part.evaluate(element => { const { width: w } = element.getBoundingClientRect(); return { width: w }; });
            assert.ok(Math.abs(width - (bar.width * energy[term]) / sum) < 1, `${term} is ${width} of ${bar.width} pixels wide`);
            covered += width;
        }
        assert.ok(Math.abs(covered - bar.width) < 1);
        assert.ok(Math.abs(sum + energy.remainder - energy.emitted) <= 1e-12 * energy.emitted);
        for (const name of Object.keys(summary.detectors ?? {})) assert.equal(await page.locator(`[data-detector="${name}"]`).count(), 1);
        await page.locator('.panels').screenshot(); // every panel is drawn
        await closedWithoutFault(page);
    });

// names have no dots, brackets and equality signs
const hostile = '</script><script>alert(1)</script><img src onerror>', title = '<!--<script>alert(1)</script><img src=x onerror=alert(2)>';

test('a name that is markup stays text, and no request leaves the page', async () => {
    const quoted = JSON.stringify(hostile);
    const folder = tracedText('hostile', `
title = ${JSON.stringify(title)}
[[object]]
name = ${quoted}
shape = {sphere = {radius_mm = 5}}
medium = ${quoted}
[medium]
${quoted} = {n = 1.5}
[[source]]
name = ${JSON.stringify(`${hostile} source`)}
beam = {from_mm = [0, 0, -10], toward = [0, 0, 1], radius_mm = 2, rays = 20}
[[detector]]
name = ${JSON.stringify(`${hostile} screen`)}
at_mm = [0, 0, 9]
facing = [0, 0, -1]
size_mm = [4, 4]
pixels = [16, 16]
`);
    const page = await opened(browser, folder);
    assert.equal(await page.locator('h1').textContent(), title);
    assert.equal(await page.title(), title);
    assert.equal(await page.locator('script').count(), 2); // its data and its own
    assert.equal(await page.locator('img').count(), 0);
    assert.ok((await page.locator('.label').allTextContents()).includes(hostile));
    await page.evaluate(() => window.sahl.viewer.choose(1));
    assert.ok((await page.locator('.tree').textContent()).includes(`in ${hostile} (n 1.5)`));
    assert.ok((await page.locator('.panels').textContent()).includes(hostile));
    assert.deepEqual(page.faults, []);
    const refused = await page.evaluate(async () => {
        const violations = [];
        document.addEventListener('securitypolicyviolation', event => violations.push(event.effectiveDirective));
        await fetch('http://127.0.0.1:9/').catch(() => {});
        const image = new Image();
        image.src = 'http://127.0.0.1:9/x.png';
        const script = document.createElement('script');
        script.textContent = 'window.ran = true';
        document.body.append(script);
        await new Promise(done => setTimeout(done, 100));
        return { violations: violations.sort(), ran: 'ran' in window };
    });
    assert.deepEqual(refused, { violations: ['connect-src', 'img-src', 'script-src-elem'], ran: false });
    await page.close();
});

test('a page without light, bodies or detectors opens', async () => {
    const folder = tracedText('dark', '[[source]]\nname = "beam"\nbeam = {from_mm = [0, 0, 0], toward = [0, 0, 1], radius_mm = 1, rays = 1}\n');
    await closedWithoutFault(await opened(browser, folder));
});

test('the page of a model draws what is wrong with it in place', async () => {
    const file = join(scratch, 'torn.obj');
    writeFileSync(file, 'v 0 0 0\nv 10 0 0\nv 10 10 0\nv 0 10 0\nv 5 5 10\nf 1 3 2\nf 1 4 3\nf 1 2 5\nf 2 5 3\nf 3 4 5\n'); // one is turned, one is missing
    const folder = join(scratch, 'torn-view');
    assert.equal(sahl('view', file, '--out', folder).trim(), join(folder, 'report.html'));
    const page = await opened(browser, folder);
    assert.equal(await page.locator('h1').textContent(), 'torn.obj');
    assert.deepEqual((await page.locator('.marks li').allTextContents()).map(text => text.replace(/.*: /, '')), ['3', '1']);
    assert.deepEqual(await page.evaluate(() => window.sahl.data.marks.map(m => [m.kind, m.lines.length, m.triangles.length])), [['holes', 18, 0], ['turned', 0, 9]]);
    assert.match(await page.locator('.box.bad').textContent(), /not closed/);
    assert.ok((await coloured(page)) > 600);
    await closedWithoutFault(page);
});

test('a page that is written anew is the same, and shows the chart of methods where one was measured', async () => {
    const folder = tracedText('again', `title = "again"
[[object]]
name = "ball"
shape = {sphere = {radius_mm = 5}}
medium = "N-BK7"
[[source]]
name = "beam"
beam = {from_mm = [0, 0, -10], toward = [0, 0, 1], radius_mm = 2, rays = 20}
`);
    const file = join(folder, 'report.html'), before = readFileSync(file, 'utf8');
    sahl('view', folder);
    assert.equal(readFileSync(file, 'utf8'), before);
    sahl('view', folder, '--experiment', join(scratch, 'again.toml'));
    assert.equal(readFileSync(file, 'utf8'), before);
    const method = (name, ns, rms, front) => ({ method: name, ns_per_segment: ns, rms_rad: rms, front });
    writeFileSync(join(folder, 'chart.json'), JSON.stringify({ held_against: 'the exact shapes', methods: [method('facet', 150, 1e-2, true), method('fitted', 400, 1e-8, true), method('quadratic', 500, 1e-6, false)] }));
    sahl('view', folder);
    const page = await opened(browser, folder, { theme: 'dark' });
    assert.equal(await page.getByText('Errors are held against the exact shapes').count(), 1);
    await closedWithoutFault(page);
});
