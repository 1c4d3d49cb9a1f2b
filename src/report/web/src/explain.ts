// In: the tree of one ray. Out: it as text, in the words of `sahl explain` (src/record/explain.cpp).
import { Ev, eventNames } from './events';
import { general } from './numbers';
import { angleTo, beyond, childBorn, indexOf, mediumIndex, normalAtEnd, type RayTree } from './tree';
import { add, cross, scale, vecAt, type Vec } from './vec';

const degrees = (radians: number) => `${((radians * 180) / Math.PI).toFixed(2)}°`;
const percent = (share: number) => `${general(100 * share, 4)} %`;
const triple = (v: Vec) => `(${v.map(x => general(x)).join(', ')})`;
const millimetres = (mm: number) => `${general(mm)} mm`;

export const mediumName = (tree: RayTree, medium: number) => tree.data.names.media[medium] ?? `medium ${medium}`;
export const surfaceName = (tree: RayTree, surface: number) => tree.data.names.surfaces[surface] ?? `surface ${surface}`;

function withIndex(tree: RayTree, medium: number): string {
    const n = mediumIndex(tree.data, medium, tree.data.rays.wavelength[tree.ray]!);
    return mediumName(tree, medium) + (n === undefined ? '' : ` (n ${general(n)})`);
}

function verbOf(ended: number, splits: boolean): string {
    switch (ended) {
        case Ev.refracted: return splits ? 'split by ' : 'refracted by ';
        case Ev.reflected: return 'reflected by ';
        case Ev.total_internal: return 'meets ';
        case Ev.absorbed: return 'absorbed by ';
        case Ev.detected: return 'detected by ';
        case Ev.passed: return 'passed through ';
        case Ev.scattered: return 'scattered by ';
        default: return '';
    }
}

/// What a boundary did to the light that a segment brought, in full doubles; absent where the log does not tell.
export interface Boundary {
    incidence?: number; // rad
    refraction?: number;
    critical?: number;
    before?: number; // refractive indices
    after?: number;
    reflected?: number; // shares of the arriving power
    transmitted?: number;
    absorbed?: number;
}

export function boundaryAt(tree: RayTree, row: number): Boundary {
    const { rays } = tree.data;
    const wavelength = rays.wavelength[tree.ray]!;
    const made: Boundary = {};
    const normal = normalAtEnd(tree, row);
    const bent = childBorn(tree, row, Ev.refracted);
    if (normal) {
        made.incidence = angleTo(vecAt(rays.toward, row), normal);
        if (bent !== undefined) {
            made.refraction = angleTo(vecAt(rays.toward, bent), normal);
            made.before = mediumIndex(tree.data, rays.medium[row]!, wavelength);
            made.after = mediumIndex(tree.data, rays.medium[bent]!, wavelength);
        } else if (rays.ended[row] === Ev.total_internal) {
            const behind = beyond(tree, row, made.incidence);
            made.critical = behind?.criticalAngle;
            made.before = mediumIndex(tree.data, rays.medium[row]!, wavelength);
            made.after = behind && mediumIndex(tree.data, behind.medium, wavelength);
        }
    }
    const arriving = rays.power_end[row]!, children = tree.children.get(row) ?? [];
    if (arriving > 0 && children.length > 0) {
        let left = 1;
        for (const child of children) {
            const share = rays.power_start[child]! / arriving;
            const through = rays.born[child] === Ev.refracted || rays.born[child] === Ev.passed;
            if (through) made.transmitted = (made.transmitted ?? 0) + share;
            else made.reflected = (made.reflected ?? 0) + share;
            left -= share;
        }
        if (tree.whole && left > 1e-12) made.absorbed = left;
    }
    return made;
}

const bothIndices = (before?: number, after?: number) =>
    before === undefined || after === undefined ? '' : `, n ${general(before)} → ${general(after)}`;

function angles(tree: RayTree, row: number): string {
    const { rays } = tree.data;
    const normal = normalAtEnd(tree, row);
    if (!normal) return '';
    const incidence = angleTo(vecAt(rays.toward, row), normal), made = boundaryAt(tree, row);
    if (rays.ended[row] === Ev.total_internal) {
        const behind = beyond(tree, row, incidence);
        if (!behind) return `total internal reflection: incidence ${degrees(incidence)}`;
        return `total internal reflection: incidence ${degrees(incidence)} exceeds the critical angle ` +
            `${degrees(behind.criticalAngle)} against ${mediumName(tree, behind.medium)}` +
            `${bothIndices(made.before, made.after)}${behind.seen ? '' : ', where it came in from'}`;
    }
    let text = `incidence ${degrees(incidence)}`;
    if (made.refraction !== undefined) {
        text += `, refraction ${degrees(made.refraction)}`;
        text += bothIndices(made.before, made.after);
    }
    return text;
}

function shares(tree: RayTree, row: number): string {
    const { rays } = tree.data;
    const arriving = rays.power_end[row]!, children = tree.children.get(row);
    if (!children) return 'its branches are not in the log';
    if (!(arriving > 0)) return '';
    let left = 1;
    const parts = children.map(child => {
        const share = rays.power_start[child]! / arriving;
        left -= share;
        return `${rays.born[child] === Ev.refracted || rays.born[child] === Ev.passed ? 'T' : 'R'} ${percent(share)}`;
    });
    if (tree.whole && left > 1e-12) parts.push(`absorbed ${percent(left)}`);
    return parts.join(', ');
}

/// Where nothing goes on from that would tell the normal: at a flat detector.
function incidenceOn(tree: RayTree, row: number, surface: string): string {
    const detector = tree.data.detectors.find(one => one.name === surface && one.kind === 'rectangle');
    if (!detector?.x || !detector.y) return '';
    return `incidence ${degrees(angleTo(vecAt(tree.data.rays.toward, row), cross(detector.x, detector.y)))}`;
}

function endOf(tree: RayTree, row: number): string {
    const { rays } = tree.data;
    const ended = rays.ended[row]!;
    switch (ended) {
        case Ev.escaped: return `escaped towards ${triple(vecAt(rays.toward, row))}`;
        case Ev.cut_power: return 'cut: power below the limit';
        case Ev.cut_depth: return `cut: too many interactions, ${rays.depth[row]}`;
        case Ev.leak: return 'lost: no consistent next crossing was found (a leak, counted as error)';
        case Ev.invalid: return 'lost: a number was not finite (invalid, counted as error)';
        case Ev.none:
        case Ev.emitted: return 'its end is not recorded';
    }
    const splits = (tree.children.get(row)?.length ?? 0) > 1;
    const surface = rays.surface[row]!;
    let text = surface < 0 ? eventNames[ended]! : verbOf(ended, splits) + surfaceName(tree, surface);
    text += ` at ${triple(add(vecAt(rays.at, row), scale(rays.length[row]!, vecAt(rays.toward, row))))} mm`;
    const forGood = ended === Ev.absorbed || ended === Ev.detected;
    const bent = (forGood || ended === Ev.passed || ended === Ev.scattered ? '' : angles(tree, row)) ||
        (surface < 0 ? '' : incidenceOn(tree, row, surfaceName(tree, surface)));
    const carried = forGood ? '' : shares(tree, row);
    return text + (bent ? `: ${bent}` : '') + (carried ? (bent ? '; ' : ': ') + carried : '');
}

function powerOf(tree: RayTree, row: number): string {
    const { rays } = tree.data;
    const root = rays.power_start[tree.first]!;
    const ofRay = rays.parent[tree.first]! < 0 && root > 0;
    const start = rays.power_start[row]!, end = rays.power_end[row]!;
    const withShare = (power: number) => `${general(power)} W${ofRay ? ` (${percent(power / root)})` : ''}`;
    let text = `power ${withShare(start)}`;
    if (end !== start && start > 0) text += ` → ${withShare(end)}, absorbed ${percent(1 - end / start)} on the way`;
    return text;
}

function titleOf(tree: RayTree, row: number): string {
    const { rays } = tree.data;
    let text = `#${indexOf(tree.data, tree.first, row)} ${eventNames[rays.born[row]!]} in ${withIndex(tree, rays.medium[row]!)}`;
    if (rays.parent[row]! >= 0 && tree.parent(row) < 0) text += `, from #${rays.parent[row]}, which is not in the log`;
    const length = rays.length[row]!;
    if (!Number.isFinite(length)) return `${text}, without end`;
    return length === 0 ? text : `${text}, ${millimetres(length)}, optical path ${millimetres(rays.optical_path[row]!)}`;
}

function missing(tree: RayTree): string {
    if (tree.whole) return '';
    const least = tree.data.names.min_power;
    return least > 0 ? `; pieces below ${percent(least)} of its power are not in the log` : '; some of its rows are not in the log';
}

export function heading(tree: RayTree): string {
    const { rays, names } = tree.data;
    const segments = tree.end - tree.first;
    const source = names.sources[rays.source[tree.ray]!];
    return `ray ${rays.number[tree.ray]}${source === undefined ? '' : ` of ${source}`}, ` +
        `${general(names.wavelengths_nm[rays.wavelength[tree.ray]!]!, 10)} nm, ${segments} ${segments === 1 ? 'segment' : 'segments'}${missing(tree)}`;
}

/// A line of the tree, and the segment that it tells of.
export interface Line {
    row: number;
    text: string;
    first: boolean; // of the three that a segment has
}

/// No recursion: a light guide may be 10⁴ deep.
export function explainLines(tree: RayTree): Line[] {
    const todo: { row: number; first: string; rest: string }[] = [];
    for (let row = tree.end; row-- > tree.first;) if (tree.parent(row) < 0) todo.push({ row, first: '', rest: '' });
    const lines: Line[] = [];
    for (let entry = todo.pop(); entry; entry = todo.pop()) {
        const { row, first, rest } = entry;
        const children = tree.children.get(row) ?? [];
        const margin = rest + (children.length === 0 ? '   ' : '│  ');
        lines.push({ row, text: first + titleOf(tree, row), first: true });
        lines.push({ row, text: margin + powerOf(tree, row), first: false });
        lines.push({ row, text: margin + endOf(tree, row), first: false });
        for (let k = children.length; k-- > 0;) {
            const only = children.length === 1, last = k + 1 === children.length;
            todo.push({
                row: children[k]!, first: rest + (only ? '' : last ? '└─ ' : '├─ '), rest: rest + (only ? '' : last ? '   ' : '│  '),
            });
        }
    }
    return lines;
}

/// All of what `sahl explain` prints of the ray.
export function explainText(tree: RayTree): string {
    return [heading(tree), ...explainLines(tree).map(line => line.text)].join('\n') + '\n';
}
