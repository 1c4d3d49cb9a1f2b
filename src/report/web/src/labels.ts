// In: names of bodies, detectors and sources. Out: them beside what they name, as text over the picture, with a bar that
// tells the size of things.
import type { PageData } from './data';
import { h } from './dom';
import { centreOf, type Extent } from './extent';
import { figure, roundBelow } from './numbers';
import type { Stage } from './stage';
import type { Vec } from './vec';

const mostLabels = 60;

export class Labels {
    private readonly layer = h('div', { class: 'labels' });
    private readonly bar = h('div', { class: 'scale-bar' }, h('span'));
    private readonly labels: { element: HTMLElement; at: Vec }[] = [];
    private readonly axes = h('div', { class: 'axes' });
    private readonly tips: [HTMLElement, Vec][] = [];

    constructor(private readonly stage: Stage, data: PageData, extent: Extent) {
        const add = (name: string, kind: string, place: Vec) => {
            const element = h('div', { class: `label ${kind}` }, kind === 'source' && h('i'), name);
            this.labels.push({ element, at: place });
            this.layer.append(element);
        };
        data.sources.slice(0, mostLabels).forEach(s => add(s.name, 'source', s.at_mm as Vec));
        data.bodies.slice(0, mostLabels).forEach((body, i) => {
            const box = extent.bodyBoxes[i];
            if (box) add(body.name, body.detector === undefined ? 'body' : 'detector', [centreOf(box)[0], box.high[1], centreOf(box)[2]]);
        });
        ['x', 'y', 'z'].forEach((name, axis) => {
            const tip = h('b', { class: `axis axis-${name}` }, name);
            this.axes.append(tip);
            this.tips.push([tip, [0, 1, 2].map(i => (i === axis ? 1 : 0)) as Vec]);
        });
        stage.host.append(this.layer, this.bar, this.axes);
        stage.onDraw(() => this.place());
    }

    toggle(): void {
        this.layer.hidden = !this.layer.hidden;
        this.stage.draw();
    }

    /// Those nearest to the viewer first; one that would cover another is left out.
    private place(): void {
        const taken: DOMRect[] = [];
        const { clientWidth: width, clientHeight: height } = this.stage.host;
        const projected = this.labels.map(label => ({ ...label, on: this.stage.project(label.at) })).sort((a, b) => a.on[2] - b.on[2]);
        for (const { element, on } of projected) {
            const w = 7 * (element.textContent?.length ?? 0) + 14, box = new DOMRect(on[0] - w / 2, on[1] - 22, w, 18);
            const covered = taken.some(t => t.left < box.right && box.left < t.right && t.top < box.bottom && box.top < t.bottom);
            const outside = on[2] > 1 || on[0] < 0 || on[0] > width || on[1] < 0 || on[1] > height;
            element.style.visibility = covered || outside ? 'hidden' : 'visible';
            if (covered || outside) continue;
            taken.push(box);
            element.style.transform = `translate(${on[0].toFixed(1)}px, ${on[1].toFixed(1)}px) translate(-50%, -120%)`;
        }
        const each = this.stage.millimetresPerPixel(), length = roundBelow(each * Math.min(160, width / 4));
        this.bar.style.width = `${length / each}px`;
        this.bar.firstElementChild!.textContent = length >= 1000 ? `${figure(length / 1000)} m` : length < 0.1 ? `${figure(length * 1000)} µm` : `${figure(length)} mm`;
        const view = this.stage.camera.matrixWorldInverse.elements;
        for (const [tip, axis] of this.tips) {
            const x = view[0]! * axis[0] + view[4]! * axis[1] + view[8]! * axis[2], y = view[1]! * axis[0] + view[5]! * axis[1] + view[9]! * axis[2];
            tip.style.transform = `translate(${(26 * x).toFixed(1)}px, ${(-26 * y).toFixed(1)}px)`;
            const length = Math.hypot(x, y);
            tip.style.setProperty('--turn', `${Math.atan2(y, -x)}rad`);
            tip.style.setProperty('--long', `${(26 * length).toFixed(1)}px`);
        }
    }

    /// What stands over the picture, for a copy of it.
    texts(): { text: string; x: number; y: number }[] {
        if (this.layer.hidden) return [];
        const origin = this.stage.host.getBoundingClientRect();
        return [...this.labels.map(l => l.element).filter(e => e.style.visibility !== 'hidden'), this.bar].map(element => {
            const box = element.getBoundingClientRect();
            return { text: element.textContent ?? '', x: box.left - origin.left + box.width / 2, y: box.top - origin.top + box.height / 2 };
        });
    }
}
