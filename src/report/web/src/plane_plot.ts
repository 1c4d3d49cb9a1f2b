// In: numbers over a plane, or spots on it. Out: a picture with axes and their units, and a colour bar.
import { lightColour, css, onTheme, themed } from './colours';
import { h } from './dom';
import { lightPixels, type LightScale } from './light_scale';
import { figure } from './numbers';

export interface PlaneOptions {
    xName: string;
    yName: string;
    low: [number, number];  // of the picture's corner at the lower left
    high: [number, number];
    equal?: boolean;        // one scale for both axes
    image?: { columns: number; rows: number; values: ArrayLike<number>; scale: LightScale; unit: string; name: string };
    paint?: (context: CanvasRenderingContext2D, x: (v: number) => number, y: (v: number) => number, pixel: number) => void;
    label: string;          // for who cannot see it
}

/// Round numbers within [low, high].
export function ticks(low: number, high: number, about: number): number[] {
    const raw = (high - low) / Math.max(1, about), power = 10 ** Math.floor(Math.log10(raw));
    const step = [1, 2, 5, 10].map(k => k * power).find(s => s >= raw * 0.999) ?? power;
    const list: number[] = [];
    for (let i = Math.ceil(low / step - 1e-9); i * step <= high + 1e-9 * step; ++i) list.push(Number((i * step).toPrecision(12)));
    return list;
}

const left = 58, bottom = 40, top = 10, right = 14, barRoom = 92;

export function planePlot(options: PlaneOptions): HTMLElement {
    const canvas = h('canvas', { attr: { role: 'img', 'aria-label': options.label } });
    const reading = h('div', { class: 'reading' }, '\u00a0');
    const host = h('div', { class: 'plane-plot' }, canvas, reading);
    let place: ((event: MouseEvent) => [number, number]) | undefined;
    const draw = () => { place = drawPlane(canvas, host.clientWidth, options); };
    new ResizeObserver(draw).observe(host);
    onTheme(draw);
    canvas.addEventListener('mousemove', event => {
        if (!place) return;
        const [x, y] = place(event);
        const inside = x >= options.low[0] && x <= options.high[0] && y >= options.low[1] && y <= options.high[1];
        reading.textContent = inside ? readingAt(options, x, y) : '\u00a0';
    });
    canvas.addEventListener('mouseleave', () => { reading.textContent = '\u00a0'; });
    return host;
}

function readingAt(options: PlaneOptions, x: number, y: number): string {
    const text = `${options.xName} = ${figure(x, 4)}, ${options.yName} = ${figure(y, 4)}`, image = options.image;
    if (!image) return text;
    const column = Math.min(image.columns - 1, Math.floor((image.columns * (x - options.low[0])) / (options.high[0] - options.low[0])));
    const row = Math.min(image.rows - 1, Math.floor((image.rows * (options.high[1] - y)) / (options.high[1] - options.low[1])));
    return `${text}: ${figure(image.values[row * image.columns + column], 4)} ${image.unit}`;
}

function drawPlane(canvas: HTMLCanvasElement, room: number, options: PlaneOptions): ((event: MouseEvent) => [number, number]) | undefined {
    if (room < 120) return undefined;
    const size = [options.high[0] - options.low[0], options.high[1] - options.low[1]] as const;
    const bar = options.image ? barRoom : 0;
    let width = Math.min(room - left - right - bar, 420), height = Math.min(300, width);
    if (options.equal) {
        const scale = Math.min(width / size[0], 330 / size[1]);
        width = Math.max(40, size[0] * scale);
        height = Math.max(40, size[1] * scale);
    }
    const ratio = Math.min(devicePixelRatio, 2), full = [left + width + right + bar, top + height + bottom] as const;
    canvas.width = Math.round(full[0] * ratio);
    canvas.height = Math.round(full[1] * ratio);
    canvas.style.width = `${full[0]}px`;
    canvas.style.height = `${full[1]}px`;
    const context = canvas.getContext('2d')!;
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    context.clearRect(0, 0, ...full);
    const x = (v: number) => left + ((v - options.low[0]) / size[0]) * width, y = (v: number) => top + ((options.high[1] - v) / size[1]) * height;
    context.save();
    context.beginPath();
    context.rect(left, top, width, height);
    context.clip();
    if (options.image) drawImage(context, options.image, width, height);
    options.paint?.(context, x, y, size[0] / width);
    context.restore();
    drawAxes(context, options, width, height, x, y);
    if (options.image) drawBar(context, options.image, left + width + 22, height);
    return event => {
        const box = canvas.getBoundingClientRect();
        return [options.low[0] + ((event.clientX - box.left - left) / width) * size[0], options.high[1] - ((event.clientY - box.top - top) / height) * size[1]];
    };
}

function drawImage(context: CanvasRenderingContext2D, image: NonNullable<PlaneOptions['image']>, width: number, height: number): void {
    const small = document.createElement('canvas');
    small.width = image.columns;
    small.height = image.rows;
    small.getContext('2d')!.putImageData(new ImageData(lightPixels(image.values, image.scale), image.columns, image.rows), 0, 0);
    context.imageSmoothingEnabled = image.columns > 1.5 * width;
    context.drawImage(small, left, top, width, height);
}

function drawAxes(context: CanvasRenderingContext2D, options: PlaneOptions, width: number, height: number, x: (v: number) => number, y: (v: number) => number): void {
    context.strokeStyle = themed('line-strong');
    context.fillStyle = themed('soft');
    context.lineWidth = 1;
    context.strokeRect(left + 0.5, top + 0.5, width - 1, height - 1);
    context.font = '11px system-ui, sans-serif';
    context.textAlign = 'center';
    context.textBaseline = 'top';
    for (const t of ticks(options.low[0], options.high[0], width / 70)) {
        context.fillRect(x(t), top + height, 1, 4);
        context.fillText(figure(t, 4), x(t), top + height + 6);
    }
    context.textAlign = 'right';
    context.textBaseline = 'middle';
    for (const t of ticks(options.low[1], options.high[1], height / 45)) {
        context.fillRect(left - 4, y(t), 4, 1);
        context.fillText(figure(t, 4), left - 7, y(t));
    }
    context.font = '12px system-ui, sans-serif';
    context.textAlign = 'center';
    context.textBaseline = 'bottom';
    context.fillText(options.xName, left + width / 2, top + height + bottom);
    context.save();
    context.translate(11, top + height / 2);
    context.rotate(-Math.PI / 2);
    context.textBaseline = 'middle';
    context.fillText(options.yName, 0, 0);
    context.restore();
}

function drawBar(context: CanvasRenderingContext2D, image: NonNullable<PlaneOptions['image']>, at: number, height: number): void {
    const { scale } = image;
    for (let i = 0; i < height; ++i) {
        context.fillStyle = css(lightColour(1 - i / height));
        context.fillRect(at, top + i, 12, 1.5);
    }
    context.strokeStyle = themed('line-strong');
    context.strokeRect(at + 0.5, top + 0.5, 11, height - 1);
    context.fillStyle = themed('soft');
    context.font = '11px system-ui, sans-serif';
    context.textAlign = 'left';
    context.textBaseline = 'middle';
    const marks = scale.most <= 0 ? [0] : scale.logarithmic
        ? [0, 1, 2, 3, 4].map(d => scale.most / 10 ** d) : ticks(0, scale.most, height / 50);
    for (const value of marks) {
        const y = top + height * (1 - Math.min(1, Math.max(0, scale.share(value))));
        context.fillRect(at + 12, y, 3, 1);
        context.fillText(figure(value, 3), at + 17, Math.min(top + height - 5, Math.max(top + 5, y)));
    }
    context.save();
    context.translate(at + 76 - 4, top + height / 2);
    context.rotate(-Math.PI / 2);
    context.textAlign = 'center';
    context.fillText(`${image.name} (${image.unit})`, 0, 0);
    context.restore();
}
