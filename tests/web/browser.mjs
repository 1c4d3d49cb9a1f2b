// In: experiments. Out: their runs, and their pages in headless Chromium, where software draws WebGL.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';

export const source = process.env.SAHL_SOURCE, program = process.env.SAHL_PROGRAM;
const { chromium } = await import(pathToFileURL(join(source, 'build/web/node_modules/playwright-core/index.mjs')).href);

export const scratch = mkdtempSync(join(tmpdir(), 'sahl-web-'));
process.on('exit', () => rmSync(scratch, { recursive: true, force: true }));

export function sahl(...words) {
    return execFileSync(program, words, { encoding: 'utf8', maxBuffer: 1 << 28, stdio: ['ignore', 'pipe', 'pipe'] });
}

/// Traces an experiment of the project into a folder of its own, and returns that.
export function traced(experiment, ...words) {
    const out = join(scratch, `${experiment}-${words.join('').replace(/\W/g, '')}`);
    sahl('trace', join(source, 'experiments', experiment, `${experiment}.toml`), '--quiet', '--out', out, ...words);
    return out;
}

export function tracedText(name, text) {
    const file = join(scratch, `${name}.toml`);
    writeFileSync(file, text);
    sahl('trace', file, '--quiet', '--out', join(scratch, name));
    return join(scratch, name);
}

export const summaryOf = folder => JSON.parse(readFileSync(join(folder, 'summary.json'), 'utf8'));

/// The log's rows, as sahl export writes them.
export function rowsOf(folder, ...words) {
    const file = join(scratch, 'rows.csv');
    sahl('export', folder, '--to', file, ...words);
    const [head, ...lines] = readFileSync(file, 'utf8').trimEnd().split('\n');
    const names = head.split(',');
    return lines.map(line => Object.fromEntries(line.split(',').map((cell, i) => [names[i], cell])));
}

export const launch = () => chromium.launch({
    executablePath: process.env.SAHL_CHROMIUM, args: ['--no-sandbox', '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader'],
});

/// A page that has been drawn. Its `faults` are what the console complained of, and requests that left it.
export async function opened(browser, folder, { fragment = '', theme = 'light', width = 1000, height = 700 } = {}) {
    const page = await browser.newPage({ viewport: { width, height }, colorScheme: theme });
    const file = pathToFileURL(join(folder, 'report.html')).href;
    page.faults = [];
    page.on('console', message => { if (['error', 'warning'].includes(message.type()) && !/GPU stall|ReadPixels/.test(message.text())) page.faults.push(message.text()); });
    page.on('pageerror', error => page.faults.push(error.message));
    page.on('dialog', dialog => { page.faults.push(`a dialog: ${dialog.message()}`); void dialog.dismiss(); });
    page.on('request', request => { if (request.url().split('#')[0] !== file && !/^(blob|data):/.test(request.url())) page.faults.push(`asked for ${request.url()}`); });
    await page.goto(file + (fragment ? `#${fragment}` : ''));
    await drawn(page);
    return page;
}

/// Waits until what was asked for is drawn.
export const drawn = page => page.evaluate(() => new Promise(done => requestAnimationFrame(() => requestAnimationFrame(() => done()))));

export async function closedWithoutFault(page) {
    assert.deepEqual(page.faults, []);
    await page.close();
}
