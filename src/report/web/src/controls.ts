// In: the viewer. Out: what stands beside it: colours and their legend, sliders, filter, playing, the chosen ray.
import { css, groupColour, groupColours, groupGrey, isDark, onTheme, rampColour } from './colours';
import type { PageData } from './data';
import { h } from './dom';
import { count, figure, percent } from './numbers';
import { rayPanel } from './ray_panel';
import type { ColourBy } from './state';
import type { Viewer } from './viewer';

const ways: [ColourBy, string][] = [['wavelength', 'wavelength'], ['power', 'power'], ['depth', 'depth'], ['path', 'path']];

function gradient(low: string, high: string): HTMLElement {
    const stops = Array.from({ length: 12 }, (_, i) => css(rampColour(i / 11, isDark())));
    return h('div', { class: 'ramp' }, h('span', {}, low), h('i', { style: { background: `linear-gradient(to right, ${stops.join(', ')})` } }), h('span', {}, high));
}

function swatch(colour: string, ...text: (string | HTMLElement)[]): HTMLElement {
    return h('span', { class: 'entry' }, h('i', { class: 'swatch', style: { background: colour } }), ...text);
}

function legend(viewer: Viewer): HTMLElement {
    const { data } = viewer, dark = isDark() ? 1 : 0;
    switch (viewer.view.colour) {
        case 'wavelength': {
            const used = [...new Set(data.rays.wavelength)].sort((a, b) => data.names.wavelengths_nm[a]! - data.names.wavelengths_nm[b]!);
            const few = used.length <= 12 ? used : [used[0]!, used[used.length - 1]!];
            return h('div', { class: 'legend' }, ...few.map(w => swatch(data.names.colours[w]![dark], `${figure(data.names.wavelengths_nm[w], 7)} nm`)),
                used.length > 12 && h('span', { class: 'note' }, `${used.length} wavelengths`));
        }
        case 'power': return h('div', { class: 'legend' }, gradient(`≤ ${figure(viewer.mostPower * 1e-6, 3)} W`, `${figure(viewer.mostPower, 3)} W`));
        case 'depth': return h('div', { class: 'legend' }, gradient('0', `${viewer.deepest} interactions`));
        case 'path': return h('p', { class: 'note' }, 'By the strongest path that leads through a piece; the list below says which is which.');
    }
}

/// The ways that light took, the strongest first.
function pathList(viewer: Viewer): HTMLElement {
    const { groups, power } = viewer.pathGroups, most = 24;
    const colour = (i: number) => (viewer.view.colour !== 'path' ? 'transparent' : css(i < groupColours ? groupColour(i) : groupGrey));
    return h('div', {}, h('h2', {}, 'Ways the light took'),
        h('div', { class: 'legend groups' }, ...groups.slice(0, most).map((group, i) =>
            h('button', { class: 'entry', title: 'Draw only this path', on: { click: () => viewer.set({ filter: group.filter }) } },
                h('i', { class: 'swatch', style: { background: colour(i) } }), h('b', {}, percent(power > 0 ? group.power / power : 0, 3)), ` ${group.filter}`)),
            groups.length > most && h('span', { class: 'note' }, `and ${groups.length - most}${groups.length === 200 ? ' or more' : ''} others`)),
        h('p', { class: 'note' }, 'Shares of the power of the rays on this page. Click one to see it alone.'));
}

function drawnText(data: PageData): string {
    const rays = data.rays.begin.length - 1, all = data.summary.rays;
    const of = typeof all === 'number' && data.kind === 'run' && all > rays ? ` of ${count(all)}` : '';
    const thinned = of ? ', evenly spread over the run' : '';
    return `${count(rays)}${of} rays are on this page${thinned}` + (data.kind === 'sweep' ? ', of the first run of the sweep' : '');
}

export function controls(viewer: Viewer): HTMLElement {
    const { data } = viewer;
    const choice = h('div', { class: 'choice', attr: { role: 'group', 'aria-label': 'Colour by' } },
        ...ways.map(([way, name]) => h('button', { attr: { 'data-colour': way }, on: { click: () => viewer.set({ colour: way }) } }, name)));
    const legendHost = h('div'), depthText = h('output'), powerText = h('output'), shownText = h('p', { class: 'note shown' });
    const depth = h('input', { id: 'depth', attr: { type: 'range', min: '0', max: String(viewer.deepest), step: '1' } });
    depth.addEventListener('input', () => viewer.set({ depth: depth.valueAsNumber >= viewer.deepest ? Infinity : depth.valueAsNumber }));
    const least = Math.floor(Math.log10(viewer.leastShare) * 10) / 10;
    const power = h('input', { id: 'power', attr: { type: 'range', min: String(least - 0.1), max: '0', step: '0.1' } });
    power.addEventListener('input', () => viewer.set({ power: power.valueAsNumber < least ? 0 : 10 ** power.valueAsNumber }));
    const filter = h('input', { id: 'filter', attr: { type: 'text', spellcheck: 'false', autocomplete: 'off', placeholder: example(data), 'aria-describedby': 'filter-problem' } });
    filter.addEventListener('input', () => viewer.set({ filter: filter.value }));
    const problem = h('pre', { id: 'filter-problem', class: 'problem' });
    const clear = h('button', { title: 'Draw all rays again', on: { click: () => viewer.set({ filter: '', depth: Infinity, power: 0 }) } }, 'All');
    const play = h('button', { id: 'play', on: { click: () => viewer.play(!viewer.isPlaying) } });
    const way = h('input', { id: 'way', attr: { type: 'range', min: '0', max: '1000', 'aria-label': 'How far the light has gone' } });
    way.addEventListener('input', () => {
        viewer.play(false);
        viewer.goTo(way.valueAsNumber >= 1000 ? -1 : (way.valueAsNumber / 1000) * viewer.longestWay);
    });
    const wayText = h('output'), ray = h('section', { class: 'ray', attr: { 'aria-live': 'polite' } });

    let legendOf = '', rayOf = NaN;
    const showRay = () => ray.replaceChildren(rayPanel(viewer), ...(viewer.view.segment < 0 && viewer.visible.length > 0 ? [pathList(viewer)] : []));
    const update = () => {
        const { view } = viewer;
        for (const button of choice.querySelectorAll('button')) button.setAttribute('aria-pressed', String(button.dataset.colour === view.colour));
        const key = `${view.colour} ${isDark()}`;
        if (key !== legendOf) {
            legendHost.replaceChildren(legend(viewer));
            rayOf = NaN;
        }
        legendOf = key;
        depth.value = String(Math.min(view.depth, viewer.deepest));
        depthText.textContent = Number.isFinite(view.depth) ? `up to ${view.depth}` : 'all';
        power.value = String(view.power > 0 ? Math.log10(view.power) : least - 0.1);
        powerText.textContent = view.power > 0 ? `from ${percent(view.power, 2)}` : 'all';
        if (filter.value !== view.filter) filter.value = view.filter;
        const error = viewer.problem;
        filter.setAttribute('aria-invalid', String(error !== undefined));
        problem.textContent = error ? `${view.filter}\n${' '.repeat(error.span.at)}${'^'.repeat(Math.max(1, error.span.length))}\n${error.problem}; ${error.remedy}` : '';
        const shown = viewer.shown;
        shownText.textContent = `${count(shown)} of ${count(viewer.visible.length)} segments drawn. ${drawnText(data)}.`;
        play.textContent = viewer.isPlaying ? '❚❚ Pause' : '▶ Play light';
        way.value = String(viewer.way < 0 ? 1000 : (1000 * viewer.way) / viewer.longestWay);
        wayText.textContent = viewer.way < 0 ? '' : `${figure(viewer.way, 3)} mm, ${figure(viewer.way / 0.299792458, 3)} ps`;
        if (rayOf !== view.segment) showRay();
        rayOf = view.segment;
    };
    viewer.onChange(update);
    onTheme(update);
    const row = (name: string, control: HTMLElement, text: HTMLElement, hint: string) =>
        h('label', { class: 'row', title: hint }, h('span', {}, name), control, text);
    return h('aside', { class: 'side' },
        h('section', {}, h('div', { class: 'row' }, h('span', {}, 'Colour'), choice), legendHost,
            row('Depth', depth, depthText, 'Pieces of path behind more interactions are hidden'),
            row('Power', power, powerText, 'Pieces that begin with a smaller share of their ray’s power are hidden'),
            h('label', { class: 'row', title: 'Which paths are drawn: the language of sahl explain --where' }, h('span', {}, 'Filter'), filter, clear), problem,
            h('div', { class: 'row play' }, play, way, wayText), shownText),
        ray);
}

function example(data: PageData): string {
    const name = data.detectors[0]?.name ?? data.bodies[0]?.name;
    return name && /^[\w.-]+$/.test(name) ? `hits(${name}) and reflected >= 1` : 'reflected >= 2 and escaped';
}
