// In: what each method costs and how far it errs. Out: the chart of one against the other, the front marked.
import { chart } from '../charts';
import { css, groupColour, themed } from '../colours';
import { at, numberAt, type Json } from '../data';
import { h } from '../dom';

interface Point { name: string; cost: number; error: number; front: boolean }

export function methodsPanel(methods: Json | undefined): HTMLElement | undefined {
    const list = at(methods, 'methods');
    if (!Array.isArray(list)) return undefined;
    const points: Point[] = list.map(m => ({
        name: String(at(m, 'method')), cost: numberAt(m, 'ns_per_segment') ?? NaN, error: numberAt(m, 'rms_rad') ?? NaN, front: at(m, 'front') === true,
    })).filter(p => p.cost > 0 && p.error >= 0).sort((a, b) => a.cost - b.cost);
    if (points.length === 0) return undefined;
    const least = Math.min(...points.map(p => p.error).filter(e => e > 0)), foot = least / 10;
    const y = points.map(p => Math.max(p.error, foot));
    return h('div', {}, chart({
        xName: 'CPU time per segment (ns)', yName: 'error of directions, RMS (rad)', x: points.map(p => p.cost), xLog: points.at(-1)!.cost > 30 * points[0]!.cost, yLog: true, height: 320,
        series: [{ name: 'front: nothing is both faster and nearer', values: points.map((p, i) => (p.front ? y[i]! : null)), dashed: true, points: false },
        { name: 'others', values: points.map((p, i) => (p.front ? null : y[i]!)), points: false, line: false }],
        overlay: plot => {
            const { ctx } = plot;
            ctx.font = `${12 * devicePixelRatio}px system-ui, sans-serif`;
            points.forEach((p, i) => {
                const px = plot.valToPos(p.cost, 'x', true), py = plot.valToPos(y[i]!, 'y', true);
                ctx.fillStyle = css(groupColour(p.front ? 0 : 1));
                ctx.beginPath();
                ctx.arc(px, py, 5 * devicePixelRatio, 0, 2 * Math.PI);
                ctx.fill();
                ctx.fillStyle = themed('text');
                const late = px > plot.bbox.left + 0.8 * plot.bbox.width;
                ctx.textAlign = late ? 'right' : 'left';
                ctx.fillText(p.name, px + (late ? -9 : 9) * devicePixelRatio, py - 7 * devicePixelRatio);
            });
        },
    }), h('p', { class: 'note' }, `Errors are held against ${String(at(methods, 'held_against') ?? 'the finest method')}; those that are 0 stand at the foot.`));
}
