// In: the page as it was written. Out: the page as it is seen.
import { controls } from './controls';
import { isDark, setTheme } from './colours';
import { readData, type PageData } from './data';
import { h } from './dom';
import { explainText } from './explain';
import { PathFilter } from './path_filter';
import { detectorCard } from './panels/detectors';
import { checkPanel, marksLegend } from './panels/check';
import { ledgerPanel } from './panels/ledger';
import { methodsPanel } from './panels/methods';
import { sweepPanel } from './panels/sweep';
import { box, escaped, events, facts, howItWasRun, lostRays, objects } from './panels/tables';
import { fromFragment, toFragment } from './state';
import { growTree, rayOf } from './tree';
import { Viewer } from './viewer';

function section(title: string, content: HTMLElement | undefined | null, kind = ''): HTMLElement | null {
    return content ? h('section', { class: `panel ${kind}` }, h('h2', {}, title), content) : null;
}

function panels(data: PageData): HTMLElement {
    const { summary } = data;
    const cards = data.detectors.map(detector => detectorCard(data, detector));
    return h('div', { class: 'panels' },
        section(data.sweep ? 'Where the power of all runs went' : 'Where the power went', ledgerPanel(summary), 'wide'),
        section('Sweep', sweepPanel(data), 'wide'),
        section(data.sweep ? 'Detectors, of the first run' : 'Detectors', cards.length ? h('div', { class: 'cards' }, ...cards) : null, 'wide'),
        section('What each method costs, and how far it errs', methodsPanel(data.methods), 'wide'),
        data.kind === 'model' ? section('What the check says', checkPanel(summary), 'wide') : null,
        section('Objects', data.kind === 'model' ? null : objects(data), 'wide'), section('Events', events(summary)), section('Lost rays', lostRays(summary)),
        section('Mean direction of escaped light', escaped(summary)), section('The run', howItWasRun(summary), 'wide'));
}

const help: [string, string][] = [
    ['drag, arrows', 'turn'], ['wheel, + −', 'nearer, further'], ['right drag', 'shift'], ['click', 'choose a ray'], ['[ ]', 'ray before, next ray'], ['Esc', 'choose none'],
    ['x y z', 'look along an axis'], ['f', 'all in view'], ['space', 'play light'], ['1 2 3 4', 'colour by wavelength, power, depth, path'], ['/', 'filter'], ['l', 'names'],
    ['t', 'light or dark'], ['s', 'save a picture'], ['?', 'this list']];

function helpBox(): HTMLDialogElement {
    const dialog = h('dialog', { class: 'help' }, h('h2', {}, 'Keys'),
        h('dl', {}, ...help.flatMap(([key, what]) => [h('dt', {}, key), h('dd', {}, what)])),
        h('p', { class: 'note' }, 'The address of this page holds what you see: copy it to show it to somebody who has the same file.'));
    dialog.append(h('button', { on: { click: () => dialog.close() } }, 'Close'));
    return dialog;
}

async function savePicture(viewer: Viewer): Promise<void> {
    const blob = await viewer.picture();
    if (!blob) return;
    const link = h('a', { attr: { href: URL.createObjectURL(blob), download: `${viewer.data.title.replace(/[^\p{L}\p{N}]+/gu, '-').slice(0, 60) || 'sahl'}.png` } });
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}

function toast(text: string): void {
    const element = h('div', { class: 'toast', attr: { role: 'status' } }, text);
    document.body.append(element);
    setTimeout(() => element.remove(), 2500);
}

async function copyLink(): Promise<void> {
    try {
        await navigator.clipboard.writeText(location.href);
        toast('The link to this view is copied');
    } catch {
        toast('The address bar holds the link to this view');
    }
}

function keys(viewer: Viewer, dialog: HTMLDialogElement, switchTheme: () => void): void {
    const { rays } = viewer.data;
    const stepRay = (by: number) => {
        const count = rays.begin.length - 1;
        if (count < 1) return;
        const here = viewer.view.segment < 0 ? (by > 0 ? -1 : count) : rayOf(viewer.data, viewer.view.segment);
        viewer.choose(rays.begin[(here + by + count) % count]!);
    };
    const actions: Record<string, () => void> = {
        ArrowLeft: () => viewer.turn(-5, 0), ArrowRight: () => viewer.turn(5, 0), ArrowUp: () => viewer.turn(0, 5), ArrowDown: () => viewer.turn(0, -5),
        '+': () => viewer.turn(0, 0, 1.2), '=': () => viewer.turn(0, 0, 1.2), '-': () => viewer.turn(0, 0, 1 / 1.2),
        x: () => viewer.look(90, 0), y: () => viewer.look(0, 89.9), z: () => viewer.look(0, 0), f: () => viewer.look(), Home: () => viewer.look(),
        ' ': () => viewer.play(!viewer.isPlaying), Escape: () => viewer.choose(-1), '[': () => stepRay(-1), ']': () => stepRay(1),
        '1': () => viewer.set({ colour: 'wavelength' }), '2': () => viewer.set({ colour: 'power' }), '3': () => viewer.set({ colour: 'depth' }), '4': () => viewer.set({ colour: 'path' }),
        '/': () => document.getElementById('filter')?.focus(), l: () => viewer.labels.toggle(), t: switchTheme, s: () => void savePicture(viewer), '?': () => dialog.showModal(),
    };
    addEventListener('keydown', event => {
        const target = event.target as HTMLElement;
        if (event.ctrlKey || event.metaKey || event.altKey || target.matches('input[type=text], select, textarea') || dialog.open) {
            if (event.key === 'Escape' && target.matches('input')) target.blur();
            return;
        }
        const arrow = event.key.startsWith('Arrow') || event.key === 'Home';
        if ((arrow && (target.matches('input') || !target.matches('.stage, .stage *'))) || (event.key === ' ' && target.matches('button, summary, a'))) return;
        const action = Object.hasOwn(actions, event.key) ? actions[event.key] : undefined;
        if (!action) return;
        event.preventDefault();
        action();
    });
}

function start(): void {
    const source = document.getElementById('sahl-data');
    const data = readData(source?.textContent ?? '{}');
    const view = fromFragment(location.hash);
    if (view.theme) setTheme(view.theme);
    else setTheme(isDark() ? 'dark' : 'light');
    document.title = data.title;
    document.getElementById('waiting')?.remove();

    const stageHost = h('div', { class: 'stage', attr: { tabindex: '0', 'aria-label': 'The scene and its rays; drag to turn' } });
    const dialog = helpBox(), tools = h('div', { class: 'tools' });
    const header = h('header', {}, h('div', {}, h('h1', {}, data.title), facts(data.summary)), tools);
    const scene = h('div', { class: 'scene' }, stageHost);
    document.body.append(h('div', { class: 'first' }, header,
        ...[box(data.summary, 'failures', 'bad', 'A check of the physics failed'), box(data.summary, 'problems', 'bad', 'Problems'), box(data.summary, 'warnings', 'warnings', 'Warnings')].filter(x => x !== undefined),
        scene), panels(data), dialog);

    let viewer: Viewer;
    try {
        viewer = new Viewer(data, stageHost);
    } catch (error) {
        stageHost.append(h('p', { class: 'no-webgl' }, `The scene cannot be drawn here: this browser has no WebGL (${error instanceof Error ? error.message : String(error)}). All figures are below.`));
        return;
    }
    stageHost.append(h('div', { class: 'hint' }, `drag to turn · wheel to zoom${data.kind === 'model' ? '' : ' · click a ray'} · ? for keys`));
    scene.append(data.kind === 'model' ? h('aside', { class: 'side' }, marksLegend(data)) : controls(viewer));
    const switchTheme = () => {
        viewer.view.theme = isDark() ? 'light' : 'dark';
        setTheme(viewer.view.theme);
        remember();
    };
    let waiting = 0;
    const remember = () => {
        clearTimeout(waiting);
        waiting = window.setTimeout(() => {
            const fragment = toFragment(viewer.view);
            if (fragment !== location.hash.slice(1)) history.replaceState(null, '', fragment ? `#${fragment}` : location.pathname + location.search);
        }, 200);
    };
    const button = (name: string, title: string, click: () => void) => h('button', { title, on: { click } }, name);
    tools.append(button('Fit', 'All in view (f)', () => viewer.look()), button('Picture', 'Save a picture (s)', () => void savePicture(viewer)),
        button('Link', 'Copy the link to this view', () => { remember(); setTimeout(() => void copyLink(), 250); }),
        button('Light / dark', 'Light or dark (t)', switchTheme), button('?', 'Keys', () => dialog.showModal()));
    keys(viewer, dialog, switchTheme);
    viewer.apply(view);
    viewer.onChange(remember);
    addEventListener('hashchange', () => {
        const next = fromFragment(location.hash);
        if (next.theme) setTheme(next.theme);
        viewer.apply(next);
    });
    // for whoever has the page open and wants to ask it something
    Object.assign(window, {
        sahl: {
            data, viewer, explain: (ray: number) => explainText(growTree(data, ray)), select: (filter: string) => new PathFilter(filter, data).selected(),
        },
    });
}

start();
