// In: the segment that was chosen. Out: its ray's tree in the words of `sahl explain`, and its numbers in full.
import type { PageData } from './data';
import { h, table, details } from './dom';
import { boundaryAt, explainLines, heading, mediumName, surfaceName } from './explain';
import { eventNames } from './events';
import { pathFilterOf } from './path_groups';
import { growTree, indexOf, rayOf, type RayTree } from './tree';
import { add, scale, vecAt } from './vec';
import type { Viewer } from './viewer';

const mostLines = 1500;

/// Of the paths that lead through a segment the strongest: its last segment.
function strongestEnd(tree: RayTree, row: number): number {
    const { rays } = tree.data;
    let best = row;
    for (let children = tree.children.get(row); children; children = tree.children.get(best))
        best = children.reduce((a, b) => (rays.power_start[b]! > rays.power_start[a]! ? b : a));
    return best;
}

function numbers(data: PageData, tree: RayTree, row: number): HTMLElement {
    const { rays, names } = data;
    const b = boundaryAt(tree, row), degrees = (x: number) => `${(x * 180) / Math.PI}°`;
    const triple = (v: readonly number[]) => `(${v.join(', ')})`;
    const at = vecAt(rays.at, row), toward = vecAt(rays.toward, row), finite = Number.isFinite(rays.length[row]);
    const rows: [string, string | undefined][] = [
        ['segment', `${indexOf(data, tree.first, row)}, depth ${rays.depth[row]}, from segment ${rays.parent[row]}`],
        ['born, ended', `${eventNames[rays.born[row]!]}, ${eventNames[rays.ended[row]!]}`],
        ['ends at', rays.surface[row]! < 0 ? 'nothing' : surfaceName(tree, rays.surface[row]!) + (rays.primitive && rays.primitive[row]! >= 0 ? `, triangle ${rays.primitive[row]}` : '')],
        ['medium', mediumName(tree, rays.medium[row]!)],
        ['wavelength (nm)', String(names.wavelengths_nm[rays.wavelength[tree.ray]!])],
        ['start (mm)', triple(at)], ['end (mm)', finite ? triple(add(at, scale(rays.length[row]!, toward))) : undefined],
        ['direction', triple(toward)], ['length (mm)', finite ? String(rays.length[row]) : 'without end'],
        ['optical path to its end (mm)', finite ? String(rays.optical_path[row]) : undefined],
        ['power at start (W)', String(rays.power_start[row])], ['power at end (W)', String(rays.power_end[row])],
        ['n before', b.before?.toString()], ['n after', b.after?.toString()],
        ['incidence', b.incidence === undefined ? undefined : degrees(b.incidence)], ['refraction', b.refraction === undefined ? undefined : degrees(b.refraction)],
        ['critical angle', b.critical === undefined ? undefined : degrees(b.critical)],
        ['R', b.reflected?.toString()], ['T', b.transmitted?.toString()], ['absorbed there', b.absorbed?.toString()],
    ];
    return table(['', ''], rows.filter((r): r is [string, string] => r[1] !== undefined));
}

export function rayPanel(viewer: Viewer): HTMLElement {
    const { data } = viewer, row = viewer.view.segment;
    if (row < 0) return h('p', { class: 'note' }, 'Click a ray to read its tree: what it met, at which angles, and how its power was shared.');
    const tree = growTree(data, rayOf(data, row)), number = data.rays.number[tree.ray]!;
    const lines = explainLines(tree), near = lines.findIndex(line => line.row === row);
    const from = lines.length <= mostLines ? 0 : Math.max(0, Math.min(near - mostLines / 2, lines.length - mostLines));
    const list = h('div', { class: 'tree', attr: { role: 'tree' } }, ...lines.slice(from, from + mostLines).map(line =>
        h('div', {
            class: `line${line.first ? ' title' : ''}${line.row === row ? ' chosen' : ''}`, attr: { 'data-segment': String(line.row) },
            on: { click: () => viewer.choose(line.row) },
        }, line.text)));
    const path = pathFilterOf(data, tree.first, strongestEnd(tree, row));
    const panel = h('div', { class: 'ray-panel' }, h('p', { class: 'heading' }, heading(tree)),
        h('p', { class: 'buttons' },
            h('button', { title: path, on: { click: () => viewer.set({ filter: path }) } }, 'Only this path'),
            h('button', { on: { click: () => viewer.set({ filter: `ray = ${number}` }) } }, 'Only this ray'),
            h('button', { on: { click: () => viewer.choose(-1) } }, 'Close')),
        h('p', { class: 'path' }, path), list,
        lines.length > mostLines ? h('p', { class: 'note' }, `${mostLines / 3} of ${lines.length / 3} segments are listed; sahl explain prints all.`) : null,
        details('All numbers of this segment', numbers(data, tree, row)));
    requestAnimationFrame(() => {
        const chosen = list.querySelector('.chosen'), room = panel.parentElement;
        if (!chosen || !room) return;
        const line = chosen.getBoundingClientRect(), seen = room.getBoundingClientRect();
        if (line.top < seen.top || line.bottom > seen.bottom) room.scrollTop += line.top - seen.top - seen.height / 3;
    });
    return panel;
}
