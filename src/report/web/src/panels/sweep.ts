// In: the runs of a sweep. Out: each figure as a curve over the key that was swept, or as a map over two, and a table.
import { chart } from '../charts';
import { at, numberAt, type Json, type PageData, type SweepData } from '../data';
import { details, h, table } from '../dom';
import { lightScale } from '../light_scale';
import { figure, shown, withUnit } from '../numbers';
import { planePlot } from '../plane_plot';

type Row = SweepData['rows'][number];
interface Choice { name: string; of: (row: Row) => number | undefined }

function choices(sweep: SweepData): Choice[] {
    const list: Choice[] = [];
    const names = new Set(sweep.rows.flatMap(row => Object.keys(row.detectors)));
    const figures: [string, string][] = [['power_W', 'power (W)'], ['rms_radius_mm', 'RMS radius (mm)'], ['peak_W_per_mm2', 'peak (W/mm²)'], ['mean_optical_path_mm', 'mean optical path (mm)']];
    for (const name of names) {
        for (const [key, words] of figures) list.push({ name: `${name}: ${words}`, of: row => numberAt(row.detectors[name], key) });
        for (const [i, axis] of ['x', 'y'].entries())
            list.push({ name: `${name}: centroid ${axis} (mm)`, of: row => (at(row.detectors[name], 'centroid_mm') as number[] | undefined)?.[i] });
    }
    for (const term of ['detected', 'absorbed', 'escaped', 'cut'])
        list.push({ name: `all: ${term} (W)`, of: row => numberAt(row.energy_W, term) });
    return list.filter(choice => sweep.rows.some(row => typeof choice.of(row) === 'number'));
}

const number = (value: Json | undefined) => (typeof value === 'number' ? value : undefined);

/// Over the key that changes first; the others' values tell the curves apart.
function curves(sweep: SweepData, choice: Choice): HTMLElement {
    const last = sweep.keys.length - 1, key = sweep.keys[last]!;
    const places = [...new Set(sweep.rows.map(row => JSON.stringify(row.values[last])))];
    const numeric = sweep.rows.every(row => number(row.values[last]) !== undefined);
    const x = places.map((p, i) => (numeric ? (JSON.parse(p) as number) : i));
    const groups = new Map<string, (number | null)[]>();
    for (const row of sweep.rows) {
        const name = sweep.keys.slice(0, last).map((k, i) => `${k.split('.').slice(-2).join('.')} = ${shown(row.values[i], 4)}`).join(', ') || choice.name;
        if (!groups.has(name)) groups.set(name, places.map(() => null));
        groups.get(name)![places.indexOf(JSON.stringify(row.values[last]))] = choice.of(row) ?? null;
    }
    const order = x.map((_, i) => i).sort((a, b) => x[a]! - x[b]!);
    const all = [...groups].slice(0, 7);
    return h('div', {}, chart({
        xName: withUnit(key), yName: choice.name, x: order.map(i => x[i]!), height: 300, xLabels: numeric ? undefined : places.map(p => shown(JSON.parse(p))),
        series: all.map(([name, values]) => ({ name, values: order.map(i => values[i]!) })),
    }), groups.size > all.length ? h('p', { class: 'note' }, `The first ${all.length} of ${groups.size} curves.`) : null);
}

/// Over a full grid of two keys with numbers, evenly spaced or not: each run is a cell.
function map(sweep: SweepData, choice: Choice): HTMLElement | undefined {
    if (sweep.keys.length !== 2 || sweep.rows.some(row => row.values.some(v => typeof v !== 'number'))) return undefined;
    const axis = (i: number) => [...new Set(sweep.rows.map(row => row.values[i] as number))].sort((a, b) => a - b);
    const ys = axis(0), xs = axis(1);
    if (xs.length < 3 || ys.length < 3 || xs.length * ys.length !== sweep.rows.length) return undefined;
    const values = new Float64Array(xs.length * ys.length);
    for (const row of sweep.rows)
        values[(ys.length - 1 - ys.indexOf(row.values[0] as number)) * xs.length + xs.indexOf(row.values[1] as number)] = choice.of(row) ?? 0;
    const ends = (list: number[]): [number, number] => {
        const half = (list[list.length - 1]! - list[0]!) / (list.length - 1) / 2;
        return [list[0]! - half, list[list.length - 1]! + half];
    };
    const [x, y] = [ends(xs), ends(ys)];
    return h('div', { class: 'cell' }, planePlot({
        xName: withUnit(sweep.keys[1]!), yName: withUnit(sweep.keys[0]!), low: [x[0], y[0]], high: [x[1], y[1]], label: choice.name,
        image: { columns: xs.length, rows: ys.length, values, scale: lightScale(values, false), unit: '', name: choice.name },
    }));
}

function runTable(data: PageData, sweep: SweepData, all: Choice[]): HTMLElement {
    const shownOnes = all.slice(0, 5), most = 500;
    const runs = at(data.summary, 'sweep', 'runs');
    return details('Values of all runs', table([...sweep.keys.map(withUnit), ...shownOnes.map(c => c.name)],
        sweep.rows.slice(0, most).map((row, i) => {
            const folder = Array.isArray(runs) ? at(runs[i], 'folder') : undefined;
            const cells: (string | HTMLElement)[] = row.values.map(v => shown(v));
            if (typeof folder === 'string' && /^runs\/\d+$/.test(folder))
                cells[0] = h('a', { attr: { href: `${folder}/report.html` } }, String(cells[0]));
            return [...cells, ...shownOnes.map(c => figure(c.of(row)))];
        })), sweep.rows.length > most && h('p', { class: 'note' }, `The first ${most} of ${sweep.rows.length}; sweep.csv has them all.`));
}

export function sweepPanel(data: PageData): HTMLElement | undefined {
    const sweep = data.sweep;
    if (!sweep || sweep.rows.length === 0) return undefined;
    const all = choices(sweep), host = h('div');
    if (all.length === 0) return undefined;
    const show = (choice: Choice) => host.replaceChildren(map(sweep, choice) ?? curves(sweep, choice));
    const select = h('select', { attr: { 'aria-label': 'Figure' }, on: { change: () => show(all[select.selectedIndex]!) } }, ...all.map(c => h('option', {}, c.name)));
    show(all[0]!);
    const open = sweep.rows.filter(row => row.passed === false).length;
    return h('div', {}, h('p', { class: open ? 'bad' : 'good' }, open ? `⚑ In ${open} of ${sweep.rows.length} runs a check of the physics failed.` : `✓ All checks of the physics passed in ${sweep.rows.length} runs.`),
        h('label', { class: 'line' }, 'Figure ', select), host, runTable(data, sweep, all));
}
