// In: bodies and rays. Out: how much room they take (mm), and where each segment is drawn to.
import type { PageData } from './data';
import { length, sub, vecAt, type Vec } from './vec';

export interface Box { low: Vec; high: Vec }

const emptyBox = (): Box => ({ low: [Infinity, Infinity, Infinity], high: [-Infinity, -Infinity, -Infinity] });

function take(box: Box, p: Vec): void {
    for (let i = 0; i < 3; ++i) {
        if (!Number.isFinite(p[i])) continue;
        box.low[i] = Math.min(box.low[i]!, p[i]!);
        box.high[i] = Math.max(box.high[i]!, p[i]!);
    }
}

export const centreOf = (box: Box): Vec => [0, 1, 2].map(i => (box.low[i]! + box.high[i]!) / 2) as Vec;
export const sizeOf = (box: Box): Vec => (box.low[0] <= box.high[0] ? sub(box.high, box.low) : [0, 0, 0]);

export function transformed(matrix: number[], p: Vec): Vec {
    return [0, 1, 2].map(r => matrix[r]! * p[0] + matrix[3 + r]! * p[1] + matrix[6 + r]! * p[2] + matrix[9 + r]!) as Vec;
}

export function bodyBox(data: PageData, body: number): Box | undefined {
    const { mesh, matrix } = data.bodies[body]!;
    if (mesh === undefined) return undefined;
    const own = emptyBox(), places = data.meshes[mesh]!.places;
    for (let i = 0; i < places.length / 3; ++i) take(own, vecAt(places, i));
    const box = emptyBox();
    for (let corner = 0; corner < 8; ++corner)
        take(box, transformed(matrix, [0, 1, 2].map(i => (corner >> i) & 1 ? own.high[i]! : own.low[i]!) as Vec));
    return box;
}

export const escapes = 0.16; // how long what escapes is drawn, as a share of the box's diagonal
const stray = 2; // times the size of all bodies and starts: what lies further away would make all else a dot

export interface Extent {
    box: Box;
    diagonal: number;
    bodyBoxes: (Box | undefined)[];
    ends: Float64Array; // where each segment is drawn to
}

export function extentOf(data: PageData): Extent {
    const { rays } = data;
    const box = emptyBox();
    const bodyBoxes = data.bodies.map((_, i) => bodyBox(data, i));
    for (const b of bodyBoxes) if (b) { take(box, b.low); take(box, b.high); }
    for (const source of data.sources) take(box, source.at_mm as Vec);
    for (let ray = 0; ray + 1 < rays.begin.length; ++ray) take(box, vecAt(rays.at, rays.begin[ray]!));
    for (const mark of data.marks)
        for (const list of [mark.lines, mark.triangles]) for (let i = 0; i < list.length / 3; ++i) take(box, vecAt(list, i));
    const room = stray * Math.max(...sizeOf(box));
    const near: Box = { low: box.low.map(x => x - room) as Vec, high: box.high.map(x => x + room) as Vec };
    const inside = (p: Vec) => room === 0 || p.every((x, i) => x >= near.low[i]! && x <= near.high[i]!);
    const segments = rays.parent.length, ends = new Float64Array(3 * segments);
    for (let i = 0; i < segments; ++i) {
        const finite = Number.isFinite(rays.length[i]);
        for (let axis = 0; axis < 3; ++axis)
            ends[3 * i + axis] = rays.at[3 * i + axis]! + (finite ? rays.length[i]! * rays.toward[3 * i + axis]! : 0);
        for (const p of [vecAt(rays.at, i), vecAt(ends, i)]) if (inside(p)) take(box, p);
    }
    if (!(box.low[0] <= box.high[0])) { box.low = [-1, -1, -1]; box.high = [1, 1, 1]; }
    const diagonal = length(sizeOf(box)) || 10;
    for (let i = 0; i < segments; ++i)
        if (!Number.isFinite(rays.length[i]))
            for (let axis = 0; axis < 3; ++axis) ends[3 * i + axis]! += escapes * diagonal * rays.toward[3 * i + axis]!;
    return { box, diagonal, bodyBoxes, ends };
}
