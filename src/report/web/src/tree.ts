// In: the segments of one ray. Out: who begot whom, and what the directions tell of the boundaries between.
// As src/record/ray_tree.cpp, which says why.
import type { PageData } from './data';
import { Ev } from './events';
import { cross, dot, length, normalized, scale, sub, vecAt, type Vec } from './vec';

/// Rows are numbers of segments, in the page's columns.
export interface RayTree {
    data: PageData;
    ray: number; // its place among the page's rays
    first: number;
    end: number;
    children: Map<number, number[]>;
    parent: (row: number) => number; // −1: none
    whole: boolean;
}

export function rayOf(data: PageData, segment: number): number {
    const begin = data.rays.begin;
    let low = 0, high = begin.length - 1;
    while (high - low > 1) {
        const middle = (low + high) >> 1;
        if (begin[middle]! <= segment) low = middle;
        else high = middle;
    }
    return low;
}

export function indexOf(data: PageData, first: number, row: number): number {
    return data.rays.index ? data.rays.index[row]! : row - first;
}

/// The row of a segment's parent, or −1 where it has none or that is not there.
export function parentRow(data: PageData, first: number, row: number): number {
    const wanted = data.rays.parent[row]!;
    if (wanted < 0) return -1;
    const index = data.rays.index;
    if (!index) return first + wanted < row ? first + wanted : -1;
    let low = first, high = row;
    while (low < high) {
        const middle = (low + high) >> 1;
        if (index[middle]! < wanted) low = middle + 1;
        else high = middle;
    }
    return low < row && index[low] === wanted ? low : -1;
}

export function growTree(data: PageData, ray: number): RayTree {
    const first = data.rays.begin[ray]!, end = data.rays.begin[ray + 1]!;
    const tree: RayTree = {
        data, ray, first, end, children: new Map(), parent: row => parentRow(data, first, row),
        whole: data.names.min_power === 0 && data.names.where === '',
    };
    for (let row = first; row < end; ++row) {
        tree.whole = tree.whole && indexOf(data, first, row) === row - first;
        const parent = tree.parent(row);
        if (parent >= 0) {
            const siblings = tree.children.get(parent);
            if (siblings) siblings.push(row);
            else tree.children.set(parent, [row]);
        }
    }
    return tree;
}

export function childBorn(tree: RayTree, row: number, ...events: number[]): number | undefined {
    return tree.children.get(row)?.find(child => events.includes(tree.data.rays.born[child]!));
}

export function mediumIndex(data: PageData, medium: number, wavelength: number): number | undefined {
    const n = data.names.refractive_index[medium * data.names.wavelengths_nm.length + wavelength];
    return wavelength < data.names.wavelengths_nm.length ? n : undefined;
}

/// A unit vector along the normal where a row ends, of either sign, from the branch that tells it best.
export function normalAtEnd(tree: RayTree, row: number): Vec | undefined {
    const { rays } = tree.data;
    const wavelength = rays.wavelength[tree.ray]!;
    const direction = vecAt(rays.toward, row);
    let normal: Vec = [0, 0, 0];
    const mirrored = childBorn(tree, row, Ev.reflected, Ev.total_internal);
    if (mirrored !== undefined) normal = sub(direction, vecAt(rays.toward, mirrored));
    const bent = childBorn(tree, row, Ev.refracted);
    if (bent !== undefined) {
        const before = mediumIndex(tree.data, rays.medium[row]!, wavelength);
        const after = mediumIndex(tree.data, rays.medium[bent]!, wavelength);
        if (before !== undefined && after !== undefined) {
            const step = sub(scale(before, direction), scale(after, vecAt(rays.toward, bent)));
            if (dot(step, step) > dot(normal, normal)) normal = step;
        }
    }
    return dot(normal, normal) > 1e-16 ? normalized(normal) : undefined;
}

export interface Behind {
    medium: number;
    criticalAngle: number;
    seen: boolean;
}

/// What lies beyond the total reflection that ends a row, at this angle of incidence in radians.
export function beyond(tree: RayTree, row: number, incidence: number): Behind | undefined {
    const { rays } = tree.data;
    const here = rays.medium[row]!;
    let medium: number | undefined;
    for (let near = tree.first; near < tree.end && medium === undefined; ++near) {
        const far = rays.surface[near] === rays.surface[row] ? childBorn(tree, near, Ev.refracted) : undefined;
        if (far === undefined) continue;
        if (rays.medium[near] === here) medium = rays.medium[far]!;
        else if (rays.medium[far] === here) medium = rays.medium[near]!;
    }
    const seen = medium !== undefined;
    for (let up = tree.parent(row); up >= 0 && medium === undefined; up = tree.parent(up))
        if (rays.medium[up] !== here) medium = rays.medium[up]!;
    if (medium === undefined) return undefined;
    const wavelength = rays.wavelength[tree.ray]!;
    const nHere = mediumIndex(tree.data, here, wavelength), nThere = mediumIndex(tree.data, medium, wavelength);
    if (nHere === undefined || nThere === undefined || !(nThere <= nHere * Math.sin(incidence))) return undefined;
    return { medium, criticalAngle: Math.asin(nThere / nHere), seen };
}

/// The angle between a direction and the line along `normal`, both unit, in [0, π/2].
export function angleTo(direction: Vec, normal: Vec): number {
    return Math.atan2(length(cross(direction, normal)), Math.abs(dot(direction, normal)));
}
