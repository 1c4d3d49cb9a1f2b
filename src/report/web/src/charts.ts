// In: columns of numbers. Out: line charts and bars, with names and units on their axes, in the colours of the theme.
// The door to uPlot.
import uPlot from 'uplot';
import { css, groupColour, onTheme, themed } from './colours';
import { h } from './dom';
import { figure } from './numbers';

export interface Series { name: string; values: (number | null)[]; bars?: boolean; dashed?: boolean; points?: boolean; line?: boolean }

export interface ChartOptions {
    xName: string;
    yName: string;
    x: number[];
    series: Series[];
    xLog?: boolean;
    yLog?: boolean;
    xLabels?: string[];  // in place of numbers: of x = 0, 1, 2, …
    fromZero?: boolean;  // the y axis begins at 0
    height?: number;
    overlay?: (plot: uPlot) => void; // drawn on top
}

function axis(name: string, labels?: string[]): uPlot.Axis {
    return {
        label: name, labelSize: 20, labelFont: '12px system-ui, sans-serif', font: '11px system-ui, sans-serif', stroke: () => themed('soft'), labelGap: 2,
        grid: { stroke: () => themed('line'), width: 1 }, ticks: { stroke: () => themed('line'), width: 1, size: 5 },
        values: (_plot, splits) => splits.map(v => (v === null ? '' : labels ? (Number.isInteger(v) ? labels[v] ?? '' : '') : figure(v, 5))),
    };
}

export function chart(options: ChartOptions): HTMLElement {
    const host = h('div', { class: 'chart' });
    const make = (width: number): uPlot => {
        const bars = options.series.some(s => s.bars), few = options.x.length < 60;
        const plot = new uPlot({
            width, height: options.height ?? 240, legend: { show: options.series.length > 1 || !bars, live: true },
            cursor: { points: { size: 6 }, drag: { x: true, y: true, uni: 20 } },
            scales: {
                x: { time: false, distr: options.xLog ? 3 : 1, range: (_p, low, high) => span(low, high, bars || options.x.length === 1, options.xLog) },
                y: { distr: options.yLog ? 3 : 1, range: (_p, low, high) => options.yLog ? [low, high] : span(options.fromZero ? Math.min(0, low) : low, high, false, false, options.fromZero) },
            },
            axes: [{ ...axis(options.xName, options.xLabels), size: 30 }, { ...axis(options.yName), size: 64 }],
            series: [{ label: options.xName, value: (_p, v) => v === null ? '–' : options.xLabels?.[v] ?? figure(v) },
            ...options.series.map((s, i): uPlot.Series => ({
                label: s.name, stroke: () => css(groupColour(i)), width: s.bars || s.line === false ? 0 : 2, spanGaps: s.dashed ?? false, dash: s.dashed ? [5, 4] : [],
                fill: s.bars ? () => css(groupColour(i)) : undefined, points: { show: s.points ?? (!s.bars && few), size: 5, fill: () => css(groupColour(i)) },
                paths: s.bars ? uPlot.paths.bars!({ size: [0.7, 26], align: 0 }) : undefined,
                value: (_p, v) => figure(v),
            }))],
            hooks: options.overlay ? { draw: [options.overlay] } : {},
        }, [options.x, ...options.series.map(s => s.values)] as uPlot.AlignedData, host);
        return plot;
    };
    let plot: uPlot | undefined;
    new ResizeObserver(() => {
        const width = Math.floor(host.clientWidth);
        if (width < 60) return;
        if (!plot) plot = make(width);
        else if (plot.width !== width) plot.setSize({ width, height: options.height ?? 240 });
    }).observe(host);
    onTheme(() => plot?.redraw());
    return host;
}

function span(low: number, high: number, wide: boolean, log = false, fromZero = false): [number, number] {
    if (low === null || high === null || !Number.isFinite(low) || !Number.isFinite(high)) return [0, 1];
    if (log) return low === high ? [low / 2, high * 2] : [low, high];
    const room = high > low ? (high - low) * (wide ? 0.08 : 0.04) : Math.abs(high) * 0.1 || 1;
    return [fromZero ? low : low - room, high + room];
}
