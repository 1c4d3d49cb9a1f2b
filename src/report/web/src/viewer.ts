// In: the page's data. Out: the picture that can be turned, and what chooses which rays of it are drawn, and how.
import { BodyMeshes } from './body_meshes';
import { groupColour, groupColours, groupGrey, hexRgb, isDark, onTheme, rampColour, themed, type Rgb } from './colours';
import type { PageData } from './data';
import { h } from './dom';
import { extentOf, type Extent } from './extent';
import { FilterError } from './filter_words';
import { Labels } from './labels';
import { PathFilter } from './path_filter';
import { groupPaths, type PathGroups } from './path_groups';
import { pick } from './pick';
import { RayLines } from './ray_lines';
import { Stage } from './stage';
import { plainView, type View } from './state';
import { rayOf } from './tree';

const decades = 6; // of power, below the greatest, that colours tell apart

export class Viewer {
    readonly view: View = plainView();
    readonly stage: Stage;
    readonly extent: Extent;
    readonly labels: Labels;
    readonly deepest: number;
    readonly mostPower: number;
    readonly leastShare: number;
    visible: Uint8Array;
    problem: FilterError | undefined;
    private readonly rays: RayLines;
    private readonly bodies: BodyMeshes;
    private readonly shares: Float64Array; // of its ray's power, by segment
    private groups: PathGroups | undefined;
    private chosenPaths: { text: string; rows: Uint8Array } | undefined;
    private readonly listeners: (() => void)[] = [];
    private now = -1;
    private last = 0;
    private playing = false;

    constructor(readonly data: PageData, readonly host: HTMLElement) {
        const { rays } = data;
        this.extent = extentOf(data);
        this.stage = new Stage(host, this.extent);
        this.bodies = new BodyMeshes(this.stage, data, this.extent);
        this.rays = new RayLines(this.stage, data, this.extent);
        this.labels = new Labels(this.stage, data, this.extent);
        this.deepest = rays.depth.reduce((a, b) => Math.max(a, b), 0);
        this.mostPower = rays.power_start.reduce((a, b) => Math.max(a, b), 0);
        this.shares = new Float64Array(rays.parent.length);
        let least = 1;
        for (let ray = 0; ray + 1 < rays.begin.length; ++ray) {
            const first = rays.begin[ray]!, root = rays.power_start[first]!;
            for (let i = first; i < rays.begin[ray + 1]!; ++i) {
                const share = this.shares[i] = root > 0 ? rays.power_start[i]! / root : 0;
                if (share > 0 && share < least) least = share;
            }
        }
        this.leastShare = Math.max(least, 1e-12);
        this.visible = new Uint8Array(rays.parent.length).fill(1);
        this.listen();
        onTheme(() => {
            this.bodies.dress();
            this.recolour();
            this.choose(this.view.segment);
        });
    }

    onChange(listener: () => void): void { this.listeners.push(listener); }
    private changed(): void { this.listeners.forEach(listener => listener()); }

    get pathGroups(): PathGroups { return this.groups ??= groupPaths(this.data); }

    /// Takes over all of a view, as from a link.
    apply(view: View): void {
        Object.assign(this.view, view);
        if (view.camera.length === 6) this.stage.view = view.camera;
        this.recolour();
        this.refilter();
        this.choose(view.segment < this.rays.segments ? view.segment : -1);
    }

    set(change: Partial<View>): void {
        Object.assign(this.view, change);
        if ('colour' in change) this.recolour();
        if ('depth' in change || 'power' in change || 'filter' in change) this.refilter();
        this.changed();
    }

    private colourOf(): (segment: number) => Rgb {
        const { rays, names } = this.data, dark = isDark();
        switch (this.view.colour) {
            case 'wavelength': {
                const colours = names.colours.map(pair => hexRgb(pair[dark ? 1 : 0])), ofRay = new Map<number, Rgb>();
                const wavelengths = new Uint16Array(rays.parent.length);
                for (let ray = 0; ray + 1 < rays.begin.length; ++ray) wavelengths.fill(rays.wavelength[ray]!, rays.begin[ray], rays.begin[ray + 1]);
                colours.forEach((c, i) => ofRay.set(i, c));
                return i => ofRay.get(wavelengths[i]!) ?? groupGrey;
            }
            case 'power': return i => rampColour(1 + Math.log10(Math.max(rays.power_start[i]! / this.mostPower, 1e-300)) / decades, dark);
            case 'depth': return i => rampColour(this.deepest ? rays.depth[i]! / this.deepest : 0, dark);
            case 'path': {
                const ranks = this.pathGroups.ofSegment;
                return i => (ranks[i]! < groupColours ? groupColour(ranks[i]!) : groupGrey);
            }
        }
    }

    private recolour(): void { this.rays.colour(this.colourOf()); }

    private refilter(): void {
        const { rays } = this.data, { depth, power, filter } = this.view;
        this.problem = undefined;
        if (this.chosenPaths?.text !== filter) {
            try {
                this.chosenPaths = { text: filter, rows: new PathFilter(filter, this.data).selected() };
            } catch (error) {
                if (!(error instanceof FilterError)) throw error;
                this.problem = error; // what was drawn before stays
            }
        }
        const paths = this.chosenPaths?.rows;
        for (let i = 0; i < this.visible.length; ++i)
            this.visible[i] = (paths ? paths[i]! : 1) && rays.depth[i]! <= depth && this.shares[i]! >= power ? 1 : 0;
        this.rays.show(this.visible);
    }

    /// The number of drawn segments.
    get shown(): number { return this.visible.reduce((sum, v) => sum + v, 0); }

    choose(segment: number): void {
        const { rays } = this.data;
        this.view.segment = segment;
        const rows: number[] = [];
        if (segment >= 0) {
            const ray = rayOf(this.data, segment);
            for (let i = rays.begin[ray]!; i < rays.begin[ray + 1]!; ++i) if (this.visible[i] || i === segment) rows.push(i);
        }
        this.rays.choose(rows.slice(0, 20000), segment, themed('chosen'));
        this.changed();
    }

    /// Where a segment's middle is on the screen, in CSS pixels from the picture's corner.
    middleOf(segment: number): [number, number] {
        const middle = [0, 1, 2].map(axis => (this.data.rays.at[3 * segment + axis]! + this.extent.ends[3 * segment + axis]!) / 2);
        const [x, y] = this.stage.project(middle as [number, number, number]);
        return [x, y];
    }

    pickAt(x: number, y: number): number | undefined {
        return pick(this.stage, this.data, this.extent, this.visible, x, y);
    }

    private listen(): void {
        const canvas = this.stage.canvas;
        let down: [number, number] | undefined;
        canvas.addEventListener('pointerdown', event => { down = [event.clientX, event.clientY]; });
        canvas.addEventListener('pointerup', event => {
            if (!down || event.button !== 0 || Math.hypot(event.clientX - down[0], event.clientY - down[1]) > 4) return;
            const box = canvas.getBoundingClientRect();
            this.choose(this.pickAt(event.clientX - box.left, event.clientY - box.top) ?? -1);
        });
        this.stage.controls.addEventListener('end', () => {
            this.view.camera = this.stage.view;
            this.changed();
        });
    }

    look(azimuth?: number, elevation?: number): void {
        this.stage.look(azimuth, elevation);
        this.view.camera = azimuth === undefined ? [] : this.stage.view;
        this.changed();
    }

    turn(right: number, up: number, nearer = 1): void {
        this.stage.turn(right, up, nearer);
        this.view.camera = this.stage.view;
        this.changed();
    }

    get way(): number { return this.now; }
    get longestWay(): number { return this.rays.longestWay; }
    get isPlaying(): boolean { return this.playing; }

    /// Light that has gone so far along its optical path, mm; −1: all of it.
    goTo(way: number): void {
        this.now = way;
        this.rays.play(way);
        this.changed();
    }

    play(on: boolean): void {
        this.playing = on;
        if (on && (this.now < 0 || this.now >= this.longestWay)) this.now = 0;
        this.last = performance.now();
        const step = (time: number) => {
            if (!this.playing) return;
            this.now += (Math.min(100, time - this.last) / 7000) * this.longestWay;
            this.last = time;
            if (this.now >= this.longestWay) {
                this.playing = false;
                this.now = -1;
            }
            this.goTo(this.now);
            if (this.playing) requestAnimationFrame(step);
        };
        requestAnimationFrame(step);
        this.changed();
    }

    /// The picture as it stands, with its names and a title.
    picture(): Promise<Blob | null> {
        this.stage.drawNow();
        const gl = this.stage.canvas, { clientWidth: width, clientHeight: height } = this.host;
        const ratio = gl.width / width, copy = h('canvas');
        copy.width = gl.width;
        copy.height = gl.height;
        const context = copy.getContext('2d')!;
        context.scale(ratio, ratio);
        context.fillStyle = themed('stage');
        context.fillRect(0, 0, width, height);
        context.drawImage(gl, 0, 0, width, height);
        context.fillStyle = themed('text');
        context.font = '12px system-ui, sans-serif';
        context.textAlign = 'center';
        context.textBaseline = 'middle';
        for (const { text, x, y } of this.labels.texts()) context.fillText(text, x, y);
        context.textAlign = 'left';
        context.font = '600 15px system-ui, sans-serif';
        context.fillText(this.data.title, 14, 20, width - 28);
        return new Promise(resolve => copy.toBlob(resolve, 'image/png'));
    }
}
