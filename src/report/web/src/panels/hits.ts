// In: the rays on the page. Out: those pieces of them that a detector counts, in its own frame.
import type { DetectorData, PageData } from '../data';
import { Ev } from '../events';
import { rayOf, mediumIndex } from '../tree';
import { add, cross, dot, length, scale, sub, vecAt, type Vec } from '../vec';

export interface Hit { x: number; y: number; power: number; direction: Vec; wavelength: number; index: number }

export function hitsOf(data: PageData, detector: DetectorData): Hit[] {
    const surface = data.names.surfaces.indexOf(detector.name);
    if (surface < 0 || !detector.x || !detector.y) return [];
    const { rays } = data, normal = cross(detector.x, detector.y), hits: Hit[] = [];
    for (let i = 0; i < rays.parent.length; ++i) {
        if (rays.surface[i] !== surface || (rays.ended[i] !== Ev.detected && rays.ended[i] !== Ev.passed)) continue;
        const direction = vecAt(rays.toward, i);
        if (!detector.back && dot(direction, normal) > 0) continue;
        const place = sub(add(vecAt(rays.at, i), scale(rays.length[i]!, direction)), detector.at_mm);
        const wavelength = rays.wavelength[rayOf(data, i)]!;
        hits.push({
            x: dot(place, detector.x), y: dot(place, detector.y), power: rays.power_end[i]!, direction, wavelength,
            index: mediumIndex(data, rays.medium[i]!, wavelength) ?? 1,
        });
    }
    return hits;
}

export interface SpotFigures { x: number; y: number; rms: number; aperture: number; wavelength_nm: number; airy_mm: number }

/// Centroid and RMS radius by power; the numerical aperture is that of the cone about the mean direction that holds all
/// but 0.1 % of the power, and the Airy disc's radius 0.61 λ / NA (Born and Wolf, Principles of Optics, 8.5.2).
export function spotFigures(data: PageData, hits: Hit[]): SpotFigures | undefined {
    const power = hits.reduce((sum, hit) => sum + hit.power, 0);
    if (!(power > 0)) return undefined;
    const mean = (of: (hit: Hit) => number) => hits.reduce((sum, hit) => sum + hit.power * of(hit), 0) / power;
    const x = mean(h => h.x), y = mean(h => h.y);
    const rms = Math.sqrt(mean(h => (h.x - x) ** 2 + (h.y - y) ** 2));
    const axis: Vec = [mean(h => h.direction[0]), mean(h => h.direction[1]), mean(h => h.direction[2])];
    const wavelength_nm = mean(h => data.names.wavelengths_nm[h.wavelength]!);
    const sines = hits.map(h => [(h.index * length(cross(h.direction, axis))) / length(axis), h.power] as const).sort((a, b) => b[0] - a[0]);
    let beyond = 0, aperture = 0;
    for (const [sine, p] of sines) {
        beyond += p;
        aperture = sine;
        if (beyond > 1e-3 * power) break;
    }
    return { x, y, rms, aperture, wavelength_nm, airy_mm: aperture > 1e-6 ? (0.61 * wavelength_nm * 1e-6) / aperture : Infinity };
}

/// Shares of the power within radii about the centroid.
export function encircled(hits: Hit[], spot: SpotFigures): { radius: number[]; share: number[] } {
    const sorted = hits.map(h => [Math.hypot(h.x - spot.x, h.y - spot.y), h.power] as const).sort((a, b) => a[0] - b[0]);
    const all = sorted.reduce((sum, [, p]) => sum + p, 0), radius = [0], share = [0];
    let sum = 0;
    for (const [r, p] of sorted) {
        sum += p;
        if (sum / all - share[share.length - 1]! > 0.004 || sum >= all * (1 - 1e-12)) {
            radius.push(r);
            share.push(Math.min(1, sum / all));
        }
    }
    return { radius, share };
}
