// In: a path filter and the page's rays. Out: which segments selected paths run through.
// As src/trace/path_filter.cpp: a path leads from a source to a segment without children.
import type { PageData } from './data';
import { asFilterName, FilterError } from './filter_words';
import { holds, parseFilter, type Condition, type FilterName, type Step, type Syntax } from './filter_syntax';
import { parentRow } from './tree';

/// Whether a name with * and ? stands for another; greedy, which is enough for a lone pattern.
function fits(pattern: string, name: string): boolean {
    let p = 0, n = 0, star = -1, resume = 0;
    while (n < name.length) {
        if (pattern[p] === '*') {
            star = p++;
            resume = n;
        } else if (p < pattern.length && (pattern[p] === '?' || pattern[p] === name[n])) {
            ++p;
            ++n;
        } else if (star >= 0) {
            p = star + 1;
            n = ++resume;
        } else {
            return false;
        }
    }
    return /^\**$/.test(pattern.slice(p));
}

function isCalled(wanted: { text: string; exact: boolean }, name: string): boolean {
    if (wanted.exact) return wanted.text === name;
    return fits(wanted.text, name) || fits(`${wanted.text}.*`, name) || fits(`*:${wanted.text}`, name);
}

/// One of the names as it has to be written in a filter that means this one alone.
export function loneFilterName(names: string[], id: number): string {
    const name = names[id]!, written = asFilterName(name);
    const alone = !names.some(other => other !== name && isCalled({ text: name, exact: false }, other));
    return alone || written.startsWith('"') ? written : `"${written}"`;
}

function idsCalled(syntax: Syntax, wanted: FilterName, names: string[], kind: string): boolean[] {
    const ids = names.map(name => isCalled(wanted, name));
    const any = !wanted.exact && /^\**$/.test(wanted.text);
    if (!ids.includes(true) && !any)
        throw new FilterError(syntax.text, wanted.span, `no ${kind} is called '${wanted.text}'`,
            names.length === 0 ? 'there is none at all' : `there are: ${names.slice(0, 12).join(', ')}${names.length > 12 ? ', …' : ''}`);
    return ids;
}

interface Prepared {
    events: Uint32Array[]; // by step, repeated ones apart: by surface + 1, bit by code
    ids: boolean[];        // of media or sources that have the name
}

function prepare(syntax: Syntax, condition: Condition, data: PageData): Prepared {
    const { names } = data;
    const eventsOf = (step: Step): Uint32Array => {
        const events = new Uint32Array(names.surfaces.length + 1).fill(step.events);
        if (step.surface) {
            const ids = idsCalled(syntax, step.surface, names.surfaces, 'surface or detector');
            events[0] = 0;
            ids.forEach((is, i) => { if (!is) events[i + 1] = 0; });
        }
        return events;
    };
    const steps = 'steps' in condition ? condition.steps : [];
    return {
        events: steps.flatMap((step: Step) => {
            const events = eventsOf(step);
            return Array.from({ length: step.times }, () => events);
        }),
        ids: condition.question === 'through' ? idsCalled(syntax, condition.name, names.media, 'medium')
            : condition.question === 'source' ? idsCalled(syntax, condition.name, names.sources, 'source') : [],
    };
}

export class PathFilter {
    private readonly syntax: Syntax;
    private readonly prepared: Prepared[];

    /// Throws FilterError.
    constructor(text: string, private readonly data: PageData) {
        this.syntax = parseFilter(text);
        this.prepared = this.syntax.conditions.map(condition => prepare(this.syntax, condition, data));
    }

    get selectsAll(): boolean { return this.syntax.program.length === 0; }

    /// By segment: whether a selected path leads through it.
    selected(): Uint8Array {
        const { rays } = this.data;
        const kept = new Uint8Array(rays.parent.length);
        if (this.selectsAll) return kept.fill(1);
        for (let ray = 0; ray + 1 < rays.begin.length; ++ray) this.selectRay(rays.begin[ray]!, rays.begin[ray + 1]!, ray, kept);
        return kept;
    }

    private selectRay(first: number, end: number, ray: number, kept: Uint8Array): void {
        const { rays } = this.data;
        const parents: number[] = [], states: number[][] = [], leaf: boolean[] = [];
        for (let row = first; row < end; ++row) {
            const parent = parentRow(this.data, first, row);
            parents.push(parent);
            leaf.push(true);
            const state = parent < 0 ? this.prepared.map(() => 0) : states[parent - first]!.slice();
            if (parent >= 0) {
                leaf[parent - first] = false;
                this.takeStep(state, rays.surface[parent]!, rays.born[row]!);
            }
            this.syntax.conditions.forEach((c, i) => {
                if (c.question === 'through' && this.prepared[i]!.ids[rays.medium[row]!]) state[i]! += 1;
            });
            states.push(state);
        }
        for (let row = end; row-- > first;) {
            const parent = parents[row - first]!;
            if (leaf[row - first]) kept[row] = this.pathTo(states[row - first]!, row, first, ray, parent) ? 1 : 0;
            if (kept[row] && parent >= 0) kept[parent] = 1;
        }
    }

    private takeStep(state: number[], surface: number, event: number): void {
        this.syntax.conditions.forEach((condition, i) => {
            const { events } = this.prepared[i]!;
            const occurs = (step: number) => ((events[step]![surface + 1]! >> event) & 1) === 1;
            const word = state[i]!;
            switch (condition.question) {
                case 'count': state[i] = word + (occurs(0) ? 1 : 0); break;
                case 'ends': state[i] = occurs(0) ? 1 : 0; break;
                case 'order': state[i] = word + (word < events.length && occurs(word) ? 1 : 0); break;
                case 'path': state[i] = word < events.length && occurs(word) ? word + 1 : events.length + 1; break;
                case 'run': state[i] = this.ranOn(i, word, events.length, occurs); break;
                default: break;
            }
        });
    }

    // Of a run the state is a number of a set of open beginnings, kept aside since it may have 64 bits.
    private readonly runs: bigint[] = [0n];
    private readonly runNumbers = new Map<bigint, number>([[0n, 0]]);

    private ranOn(_condition: number, word: number, steps: number, occurs: (step: number) => boolean): number {
        const before = this.runs[word]!, last = BigInt(steps - 1);
        let going = before & (1n << last); // once all, for good
        for (let k = 0; k < steps; ++k)
            if ((k === 0 || ((before >> BigInt(k - 1)) & 1n) === 1n) && occurs(k)) going |= 1n << BigInt(k);
        let number = this.runNumbers.get(going);
        if (number === undefined) {
            number = this.runs.length;
            this.runs.push(going);
            this.runNumbers.set(going, number);
        }
        return number;
    }

    private pathTo(before: number[], row: number, first: number, ray: number, parent: number): boolean {
        const { rays } = this.data;
        const state = before.slice();
        this.takeStep(state, rays.surface[row]!, rays.ended[row]!);
        const truths: boolean[] = [];
        for (const join of this.syntax.program) {
            if (typeof join === 'number') truths.push(this.holds(join, state[join]!, row, first, ray, parent));
            else if (join === 'not') truths.push(!truths.pop());
            else {
                const last = truths.pop()!, other = truths.pop()!;
                truths.push(join === 'and' ? other && last : other || last);
            }
        }
        return truths[0]!;
    }

    private holds(i: number, state: number, row: number, first: number, ray: number, parent: number): boolean {
        const condition = this.syntax.conditions[i]!, { events, ids } = this.prepared[i]!;
        switch (condition.question) {
            case 'count':
            case 'through': return holds(condition.comparison, state);
            case 'source': return ids[this.data.rays.source[ray]!] ?? false;
            case 'ends': return state !== 0;
            case 'order':
            case 'path': return state === events.length;
            case 'run': return ((this.runs[state]! >> BigInt(events.length - 1)) & 1n) === 1n;
            case 'quantity': return holds(condition.comparison, this.quantity(condition.quantity, row, first, ray, parent));
        }
    }

    private quantity(which: string, row: number, first: number, ray: number, parent: number): number {
        const { rays, names } = this.data;
        switch (which) {
            case 'wavelength_nm': return names.wavelengths_nm[rays.wavelength[ray]!]!;
            case 'power_W': return rays.power_end[row]!;
            case 'share': return rays.power_start[first]! > 0 ? rays.power_end[row]! / rays.power_start[first]! : 0;
            case 'depth': return rays.depth[row]!;
            case 'ray': return rays.number[ray]!;
            default: {
                const path = rays.optical_path[row]!;
                return Number.isFinite(path) ? path : parent < 0 ? 0 : rays.optical_path[parent]!;
            }
        }
    }
}
