// In: a place on the screen. Out: the segment that a person means by it.
import type { PageData } from './data';
import type { Extent } from './extent';
import type { Stage } from './stage';

const reach = 7, alike = 0.75; // pixels

/// The visible segment nearest to (x, y) in CSS pixels, none further than a few pixels; of those as near as the nearest
/// the one next to the camera.
export function pick(stage: Stage, data: PageData, extent: Extent, visible: Uint8Array, x: number, y: number): number | undefined {
    const m = stage.camera.projectionMatrix.clone().multiply(stage.camera.matrixWorldInverse).elements;
    const { clientWidth: width, clientHeight: height } = stage.host, o = stage.origin;
    const clip = (list: Float64Array, i: number): [number, number, number] => {
        const px = list[3 * i]! - o[0], py = list[3 * i + 1]! - o[1], pz = list[3 * i + 2]! - o[2];
        return [m[0]! * px + m[4]! * py + m[8]! * pz + m[12]!, m[1]! * px + m[5]! * py + m[9]! * pz + m[13]!,
            m[3]! * px + m[7]! * py + m[11]! * pz + m[15]!];
    };
    const near: { segment: number; distance: number; depth: number }[] = [];
    const least = stage.camera.near;
    for (let i = 0; i < visible.length; ++i) {
        if (!visible[i] || data.rays.length[i] === 0) continue;
        let [ax, ay, aw] = clip(data.rays.at, i);
        let [bx, by, bw] = clip(extent.ends, i);
        if (aw < least && bw < least) continue;
        if (aw < least || bw < least) { // cut at the plane before the camera
            const t = (least - aw) / (bw - aw);
            const cut: [number, number, number] = [ax + t * (bx - ax), ay + t * (by - ay), least];
            if (aw < least) [ax, ay, aw] = cut;
            else [bx, by, bw] = cut;
        }
        const sx = ((ax / aw + 1) / 2) * width, sy = ((1 - ay / aw) / 2) * height;
        const ex = ((bx / bw + 1) / 2) * width, ey = ((1 - by / bw) / 2) * height;
        const dx = ex - sx, dy = ey - sy, square = dx * dx + dy * dy;
        const t = square > 0 ? Math.min(1, Math.max(0, ((x - sx) * dx + (y - sy) * dy) / square)) : 0;
        const distance = Math.hypot(sx + t * dx - x, sy + t * dy - y);
        if (distance <= reach) near.push({ segment: i, distance, depth: 1 / ((1 - t) / aw + t / bw) });
    }
    const nearest = Math.min(...near.map(n => n.distance));
    return near.filter(n => n.distance <= nearest + alike)
        .sort((a, b) => a.depth - b.depth || data.rays.power_start[b.segment]! - data.rays.power_start[a.segment]!)[0]?.segment;
}
