// In: the page's segments. Out: them as lines of one buffer; which of them are drawn is a list of indices.
import { AddEquation, BufferAttribute, BufferGeometry, CustomBlending, DynamicDrawUsage, LineSegments, OneFactor, ShaderMaterial } from 'three';
import { LineMaterial } from 'three/addons/lines/LineMaterial.js';
import { LineSegments2 } from 'three/addons/lines/LineSegments2.js';
import { LineSegmentsGeometry } from 'three/addons/lines/LineSegmentsGeometry.js';
import { isDark, type Rgb } from './colours';
import type { PageData } from './data';
import { escapes, type Extent } from './extent';
import type { Stage } from './stage';
import { mediumIndex } from './tree';

const vertexShader = `
attribute vec4 tint;
attribute float way;
varying vec4 vTint;
varying float vWay;
void main() {
    vTint = tint;
    vWay = way;
    gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
}`;
// While light plays, what it has not reached is dark, and where it has just been is brightest.
const fragmentShader = `
uniform float now, tail;
varying vec4 vTint;
varying float vWay;
void main() {
    float light = vTint.a;
    if (now >= 0.0) {
        if (vWay > now) discard;
        light *= 0.15 + 3.0 * exp((vWay - now) / tail);
    }
    gl_FragColor = vec4(vTint.rgb * light, light);
}`;

const faintest = 0.1, decades = 3; // opacity falls with the logarithm of the power

export class RayLines {
    readonly segments: number;
    longestWay = 0; // mm of optical path
    private readonly geometry = new BufferGeometry();
    private readonly material: ShaderMaterial;
    private readonly tint: BufferAttribute;
    private readonly indices: Uint32Array;
    private readonly wholeRay = new LineSegments2(new LineSegmentsGeometry(), new LineMaterial({ linewidth: 2.2, transparent: true, depthTest: false }));
    private readonly chosen = new LineSegments2(new LineSegmentsGeometry(), new LineMaterial({ linewidth: 5, transparent: true, depthTest: false }));
    private drawn = 0;
    private dimmed = false;

    constructor(private readonly stage: Stage, private readonly data: PageData, private readonly extent: Extent) {
        const { rays } = data;
        this.segments = rays.parent.length;
        const n = this.segments, o = stage.origin;
        const position = new Float32Array(6 * n), way = new Float32Array(2 * n);
        for (let i = 0; i < n; ++i)
            for (let axis = 0; axis < 3; ++axis) {
                position[6 * i + axis] = rays.at[3 * i + axis]! - o[axis]!;
                position[6 * i + 3 + axis] = extent.ends[3 * i + axis]! - o[axis]!;
            }
        this.fillWays(way);
        this.tint = new BufferAttribute(new Uint8Array(8 * n), 4, true);
        this.indices = new Uint32Array(2 * n);
        const index = new BufferAttribute(this.indices, 1);
        index.setUsage(DynamicDrawUsage);
        this.geometry.setAttribute('position', new BufferAttribute(position, 3));
        this.geometry.setAttribute('way', new BufferAttribute(way, 1));
        this.geometry.setAttribute('tint', this.tint);
        this.geometry.setIndex(index);
        this.material = new ShaderMaterial({
            vertexShader, fragmentShader, transparent: true, depthTest: false, depthWrite: false,
            blending: CustomBlending, blendEquation: AddEquation, blendSrc: OneFactor, blendDst: OneFactor,
            uniforms: { now: { value: -1 }, tail: { value: 1 } },
        });
        const lines = new LineSegments(this.geometry, this.material);
        lines.frustumCulled = false;
        this.chosen.renderOrder = 1;
        this.wholeRay.visible = this.chosen.visible = false;
        this.wholeRay.frustumCulled = this.chosen.frustumCulled = false;
        stage.light.scene.add(lines);
        stage.over.add(this.wholeRay, this.chosen);
        stage.controls.addEventListener('end', () => this.expose());
    }

    /// Optical path (mm) at both ends of each segment, from its source.
    private fillWays(way: Float32Array): void {
        const { rays } = this.data;
        for (let ray = 0; ray + 1 < rays.begin.length; ++ray)
            for (let i = rays.begin[ray]!; i < rays.begin[ray + 1]!; ++i) {
                const n = mediumIndex(this.data, rays.medium[i]!, rays.wavelength[ray]!) ?? 1;
                const parent = rays.parent[i]! < 0 ? -1 : rays.index ? -2 : rays.begin[ray]! + rays.parent[i]!;
                const start = parent >= 0 ? rays.optical_path[parent]! : parent === -1 ? 0 : rays.optical_path[i]! - n * rays.length[i]!;
                const end = Number.isFinite(rays.length[i]) ? rays.optical_path[i]! : start + escapes * this.extent.diagonal * n;
                way[2 * i] = start;
                way[2 * i + 1] = end;
                if (end > this.longestWay) this.longestWay = end;
            }
    }

    /// A colour for each segment, for both of its ends.
    colour(of: (segment: number) => Rgb): void {
        const { rays } = this.data, array = this.tint.array as Uint8Array;
        const dark = isDark(); // on light pages colours are taken away from white
        let most = 0;
        for (const p of rays.power_start) if (p > most) most = p;
        for (let i = 0; i < this.segments; ++i) {
            const colour = of(i), rgb = dark ? colour : colour.map(c => 255 - c), power = rays.power_start[i]!;
            const share = power > 0 ? 1 + Math.log10(power / most) / decades : 0;
            const opacity = Math.round(255 * (faintest + (1 - faintest) * Math.min(Math.max(share, 0), 1)));
            for (let end = 0; end < 2; ++end) array.set([...rgb, opacity], 8 * i + 4 * end);
        }
        this.tint.needsUpdate = true;
        this.expose();
    }

    /// The more lines lie on each other, the fainter is each: so that where most light is there are about as many as one
    /// can still tell apart. Counted on a coarse grid over the screen.
    private expose(): void {
        const { clientWidth: width, clientHeight: height } = this.stage.host, cell = 12;
        const columns = Math.ceil(width / cell), rows = Math.ceil(height / cell), sums = new Float32Array(columns * rows);
        const m = this.stage.matrix(), o = this.stage.origin, tint = this.tint.array as Uint8Array;
        const step = Math.max(1, Math.floor(this.drawn / 20000));
        const clip = (list: Float64Array, i: number): [number, number] | undefined => {
            const x = list[3 * i]! - o[0], y = list[3 * i + 1]! - o[1], z = list[3 * i + 2]! - o[2];
            const w = m[3]! * x + m[7]! * y + m[11]! * z + m[15]!;
            if (w <= 0) return undefined;
            return [((m[0]! * x + m[4]! * y + m[8]! * z + m[12]!) / w + 1) * 0.5 * width, (1 - (m[1]! * x + m[5]! * y + m[9]! * z + m[13]!) / w) * 0.5 * height];
        };
        for (let k = 0; k < this.drawn; k += step) {
            const i = this.indices[2 * k]! / 2, a = clip(this.data.rays.at, i), b = clip(this.extent.ends, i);
            if (!a || !b) continue;
            const long = Math.hypot(b[0] - a[0], b[1] - a[1]), pieces = Math.min(200, Math.ceil(long / cell));
            const weight = ((tint[8 * i + 3]! / 255) * step * (long / pieces)) / (cell * cell); // lines on each pixel of the cell
            for (let p = 0; p < pieces; ++p) {
                const t = (p + 0.5) / pieces, column = Math.floor((a[0] + t * (b[0] - a[0])) / cell), row = Math.floor((a[1] + t * (b[1] - a[1])) / cell);
                if (column >= 0 && column < columns && row >= 0 && row < rows) sums[row * columns + column]! += weight;
            }
        }
        const filled = sums.filter(s => s > 0).sort(), dense = filled[Math.floor(0.9 * filled.length)] ?? 0;
        this.stage.light.exposure = (dense > 0 ? Math.min(1.4, 0.9 / dense) : 1) * (this.dimmed ? 0.3 : 1);
        this.stage.draw();
    }

    show(visible: Uint8Array): void {
        let n = 0;
        for (let i = 0; i < this.segments; ++i)
            if (visible[i]) {
                this.indices[n++] = 2 * i;
                this.indices[n++] = 2 * i + 1;
            }
        this.drawn = n / 2;
        this.stage.light.expect(this.drawn);
        this.geometry.index!.needsUpdate = true;
        this.geometry.setDrawRange(0, n);
        this.expose();
    }

    /// Light that has gone so far (mm of optical path); −1: all of it.
    play(now: number): void {
        this.material.uniforms.now!.value = now;
        this.material.uniforms.tail!.value = this.longestWay / 14;
        this.stage.draw();
    }

    /// Draws one ray over all others, and one segment of it thicker; none where `rows` is empty.
    choose(rows: number[], segment: number, colour: string): void {
        const places = (list: number[]) => list.flatMap(i => [0, 1].flatMap(end => [0, 1, 2].map(axis =>
            (end ? this.extent.ends : this.data.rays.at)[3 * i + axis]! - this.stage.origin[axis]!)));
        for (const [lines, list] of [[this.wholeRay, rows], [this.chosen, rows.length ? [segment] : []]] as const) {
            lines.visible = list.length > 0;
            if (!lines.visible) continue;
            lines.geometry.dispose();
            lines.geometry = new LineSegmentsGeometry().setPositions(places([...list]));
            (lines.material as LineMaterial).color.set(colour);
        }
        this.dimmed = rows.length > 0;
        this.expose();
    }
}
