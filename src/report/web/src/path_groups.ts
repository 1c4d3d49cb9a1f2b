// In: the page's rays. Out: their paths, grouped by the surfaces they met and what happened there, as `sahl paths` does.
import type { PageData } from './data';
import { eventNames } from './events';
import { loneFilterName } from './path_filter';
import { parentRow } from './tree';

export interface PathGroup {
    filter: string; // selects these and no others
    paths: number;
    power: number; // W, at the paths' ends, of the rays on the page
}

export interface PathGroups {
    groups: PathGroup[];    // of greatest power first
    ofSegment: Int32Array;  // the strongest group that leads through it
    power: number;          // of all
}

const filters = new WeakMap<PageData, string[]>();

function nameOf(data: PageData, surface: number): string {
    let known = filters.get(data);
    if (!known) filters.set(data, known = []);
    return known[surface] ??= loneFilterName(data.names.surfaces, surface);
}

type StepKey = string; // "event/surface"

function filterOf(data: PageData, steps: StepKey[]): string {
    const parts: string[] = [];
    for (let i = 0; i < steps.length;) {
        let end = i + 1;
        while (end < steps.length && steps[end] === steps[i]) ++end;
        const [event, surface] = steps[i]!.split('/').map(Number) as [number, number];
        parts.push((end - i > 1 ? `${end - i} ` : '') + eventNames[event]! + (surface >= 0 ? `(${nameOf(data, surface)})` : ''));
        i = end;
    }
    return `path(${parts.join(', ')})`;
}

/// The steps from the source to a segment, and to its end where it is asked for.
export function stepsTo(data: PageData, first: number, row: number, withEnd: boolean): StepKey[] {
    const { rays } = data;
    const steps: StepKey[] = withEnd ? [`${rays.ended[row]}/${rays.surface[row]}`] : [];
    for (let here = row, up = parentRow(data, first, row); up >= 0; here = up, up = parentRow(data, first, up))
        steps.push(`${rays.born[here]}/${rays.surface[up]}`);
    return steps.reverse();
}

/// "path(2 refracted(lens.front), escaped)"
export function pathFilterOf(data: PageData, first: number, row: number): string {
    return filterOf(data, stepsTo(data, first, row, true));
}

export function groupPaths(data: PageData): PathGroups {
    const { rays } = data;
    const segments = rays.parent.length;
    // a path so far is a number: that of what went before and the step
    const known = new Map<string, number>();
    const numbered = (before: number, event: number, surface: number): number => {
        const key = `${before}/${event}/${surface}`;
        let number = known.get(key);
        if (number === undefined) known.set(key, number = known.size + 1);
        return number;
    };
    const soFar = new Int32Array(segments), leafOf = new Int32Array(segments).fill(-1);
    const sums = new Map<number, { paths: number; power: number; first: number; row: number }>();
    for (let ray = 0; ray + 1 < rays.begin.length; ++ray) {
        const first = rays.begin[ray]!, end = rays.begin[ray + 1]!;
        const leaf = new Uint8Array(end - first).fill(1);
        for (let row = first; row < end; ++row) {
            const parent = parentRow(data, first, row);
            if (parent < 0) continue;
            leaf[parent - first] = 0;
            soFar[row] = numbered(soFar[parent]!, rays.born[row]!, rays.surface[parent]!);
        }
        for (let row = first; row < end; ++row) {
            if (!leaf[row - first]) continue;
            const number = numbered(soFar[row]!, rays.ended[row]!, rays.surface[row]!);
            leafOf[row] = number;
            const sum = sums.get(number);
            if (sum) {
                ++sum.paths;
                sum.power += rays.power_end[row]!;
            } else {
                sums.set(number, { paths: 1, power: rays.power_end[row]!, first, row });
            }
        }
    }
    const sorted = [...sums].sort(([, a], [, b]) => b.power - a.power);
    const rank = new Map(sorted.map(([number], i) => [number, i]));
    const ofSegment = new Int32Array(segments).fill(segments);
    for (let ray = 0; ray + 1 < rays.begin.length; ++ray) {
        const first = rays.begin[ray]!;
        for (let row = rays.begin[ray + 1]!; row-- > first;) {
            if (leafOf[row]! >= 0) ofSegment[row] = rank.get(leafOf[row]!)!;
            const parent = parentRow(data, first, row);
            if (parent >= 0) ofSegment[parent] = Math.min(ofSegment[parent]!, ofSegment[row]!);
        }
    }
    return {
        groups: sorted.slice(0, 200).map(([, sum]) => ({ filter: filterOf(data, stepsTo(data, sum.first, sum.row, true)), paths: sum.paths, power: sum.power })),
        ofSegment,
        power: sorted.reduce((total, [, sum]) => total + sum.power, 0),
    };
}
