// In: what detectors recorded. Out: a card for each: figures, irradiance, spots, spectrum, encircled energy, far field.
import { chart } from '../charts';
import { css, hexRgb, isDark, themed } from '../colours';
import { entriesAt, numberAt, at, type DetectorData, type Json, type PageData } from '../data';
import { details, h, table } from '../dom';
import { lightScale } from '../light_scale';
import { count, figure, shown } from '../numbers';
import { planePlot, type PlaneOptions } from '../plane_plot';
import { encircled, hitsOf, spotFigures, type Hit, type SpotFigures } from './hits';

const figures: [key: string, name: string, unit: string][] = [
    ['power_W', 'power', 'W'], ['sigma_W', 'standard error', 'W'], ['hits', 'hits', ''], ['centroid_mm', 'centroid', 'mm'],
    ['rms_radius_mm', 'RMS radius', 'mm'], ['peak_W_per_mm2', 'peak', 'W/mm²'], ['mean_direction', 'mean direction', ''],
    ['mean_optical_path_mm', 'mean optical path', 'mm']];

/// "between a and b W": the light that was cut might have reached the detector.
function bound(found: Json | undefined): string {
    const [low, high] = (at(found, 'power_bound_W') as (number | null)[] | undefined) ?? [];
    if (typeof low === 'number' && typeof high === 'number')
        return low === high ? 'nothing was cut' : `between ${figure(low, 8)} and ${figure(high, 8)} W`;
    return typeof low === 'number' && low > 0 ? `at least ${figure(low, 8)} W` : '';
}

function numbers(found: Json | undefined): HTMLElement {
    const list = h('dl');
    for (const [key, name, unit] of figures) {
        const value = at(found, key);
        if ((value === undefined || value === null) && key !== 'power_W') continue;
        if (key === 'sigma_W' && value === 0) continue;
        const text = key === 'hits' ? count(value) : shown(value);
        const note = key === 'power_W' ? bound(found) : '';
        list.append(h('dt', {}, name), h('dd', {}, unit ? `${text} ${unit}` : text, note && h('span', { class: 'note' }, ` ${note}`)));
    }
    return list;
}

function split(found: Json | undefined, key: string, heading: string): HTMLElement | undefined {
    const entries = entriesAt(found, key);
    if (entries.length < 2) return undefined;
    return details(`By ${heading.split(' ')[0]}`, table([heading, 'power (W)', 'hits', 'centroid (mm)', 'RMS radius (mm)', 'mean direction'],
        entries.slice(0, 200).map(([name, e]) => [name, shown(at(e, 'power_W')), count(at(e, 'hits')), shown(at(e, 'centroid_mm'), 5), shown(at(e, 'rms_radius_mm'), 5), shown(at(e, 'mean_direction'), 5)])));
}

function titled(title: string, content: HTMLElement, note?: string): HTMLElement {
    return h('figure', {}, h('figcaption', {}, title), content, note ? h('p', { class: 'note' }, note) : null);
}

function irradiance(detector: DetectorData): HTMLElement | undefined {
    const { irradiance: values, columns, rows, size_mm: size } = detector;
    if (!values || !columns || !rows || !size) return undefined;
    const host = h('div');
    const show = (logarithmic?: boolean) => {
        const scale = lightScale(values, logarithmic);
        host.replaceChildren(planePlot({
            xName: 'x (mm)', yName: 'y (mm)', low: [-size[0] / 2, -size[1] / 2], high: [size[0] / 2, size[1] / 2], equal: true,
            image: { columns, rows, values, scale, unit: 'W/mm²', name: 'irradiance' }, label: `Light on the detector ${detector.name}`,
        }));
        linear.setAttribute('aria-pressed', String(!scale.logarithmic));
        log.setAttribute('aria-pressed', String(scale.logarithmic));
    };
    const linear = h('button', { on: { click: () => show(false) } }, 'linear'), log = h('button', { on: { click: () => show(true) } }, 'logarithmic');
    show();
    const block = detector.pixels_in_one ?? 1;
    return h('figure', {}, h('figcaption', {}, 'Irradiance', h('span', { class: 'choice' }, linear, log)), host,
        block > 1 ? h('p', { class: 'note' }, `Each pixel here is the mean of ${block} × ${block} that were recorded.`) : null);
}

const micrometres = (mm: number) => (mm < 0.1 ? `${figure(mm * 1000, 3)} µm` : `${figure(mm, 3)} mm`);

function spots(data: PageData, hits: Hit[], spot: SpotFigures): HTMLElement {
    const distances = hits.map(hit => Math.hypot(hit.x - spot.x, hit.y - spot.y)).sort((a, b) => a - b);
    const most = distances[Math.floor(0.98 * (distances.length - 1))]!, airy = spot.airy_mm;
    const half = 1.15 * Math.max(most, Math.min(airy, 20 * Math.max(most, 1e-9)), 1e-9) || 1;
    const inMicrometres = half < 0.2, unit = inMicrometres ? 'µm' : 'mm', factor = inMicrometres ? 1000 : 1;
    const step = Math.max(1, Math.ceil(hits.length / 20000));
    const paint: PlaneOptions['paint'] = (context, x, y, pixel) => {
        for (let i = 0; i < hits.length; i += step) {
            const hit = hits[i]!;
            context.fillStyle = css(hexRgb(data.names.colours[hit.wavelength]![isDark() ? 1 : 0]));
            context.globalAlpha = 0.7;
            context.fillRect(x((hit.x - spot.x) * factor) - 1, y((hit.y - spot.y) * factor) - 1, 2, 2);
        }
        context.globalAlpha = 1;
        if (airy > 40 * half) return;
        context.strokeStyle = themed('text');
        context.lineWidth = 1.2;
        context.setLineDash([4, 3]);
        context.beginPath();
        context.arc(x(0), y(0), (airy * factor) / pixel, 0, 2 * Math.PI);
        context.stroke();
        context.setLineDash([]);
        const long = (2 * airy * factor) / pixel; // the ruler: the disc's diameter
        const from = x(-half * factor) + 10, foot = y(-half * factor) - 12;
        if (long > 3 && long < x(half * factor) - from - 10) {
            context.fillStyle = themed('text');
            context.fillRect(from, foot, long, 2);
            context.fillRect(from, foot - 4, 1, 10);
            context.fillRect(from + long - 1, foot - 4, 1, 10);
            context.font = '11px system-ui, sans-serif';
            context.fillText(`Airy disc ⌀ ${micrometres(2 * airy)}`, from, foot - 8);
        }
    };
    const plot = planePlot({
        xName: `x − centroid (${unit})`, yName: `y − centroid (${unit})`, low: [-half * factor, -half * factor], high: [half * factor, half * factor],
        equal: true, paint, label: `Where ${hits.length} drawn rays meet the detector`,
    });
    const disc = Number.isFinite(airy)
        ? ` Diffraction alone would make an Airy disc of radius ${micrometres(airy)} (${figure(spot.wavelength_nm, 4)} nm, NA ${figure(spot.aperture, 3)}); it is dashed where it is large enough to be seen.` : '';
    return titled('Spot diagram', plot, `${count(hits.length)} hits of the rays drawn; RMS radius ${micrometres(spot.rms)}.${disc}`);
}

function encircledEnergy(detector: DetectorData, hits: Hit[], spot: SpotFigures | undefined): HTMLElement | undefined {
    const recorded = detector.encircled_mm;
    if (!recorded && (!spot || hits.length < 3 || spot.rms === 0)) return undefined;
    const { radius, share } = recorded
        ? { radius: [0, ...recorded], share: [0, ...Array.from(recorded, (_, i) => (i + 1) / 100)] } : encircled(hits, spot!);
    if (!radius.some(r => r > 0)) return undefined;
    const largest = radius[radius.length - 1]!, small = largest < 0.2;
    return titled('Encircled energy', chart({
        xName: `radius about the centroid (${small ? 'µm' : 'mm'})`, yName: 'share of the power (%)', x: radius.map(r => (small ? 1000 * r : r)),
        series: [{ name: 'encircled', values: share.map(s => 100 * s), points: false }], fromZero: true,
    }), recorded ? 'Of all hits.' : 'Of the rays drawn; with spot = true a run records it of all.');
}

function spectrum(found: Json | undefined): HTMLElement | undefined {
    const lines = entriesAt(found, 'by_wavelength').map(([nm, e]) => [Number(nm), numberAt(e, 'power_W') ?? 0] as const)
        .filter(([nm]) => Number.isFinite(nm)).sort((a, b) => a[0] - b[0]);
    if (lines.length < 2) return undefined;
    const many = lines.length > 40;
    return titled('Spectrum', chart({
        xName: 'wavelength (nm)', yName: 'power (W)', x: lines.map(l => l[0]), fromZero: true,
        series: [{ name: 'power', values: lines.map(l => l[1]), bars: !many, points: false }],
    }));
}

function farField(detector: DetectorData): HTMLElement | undefined {
    const far = detector.far_field;
    if (!far || far.W_per_sr.length !== far.rings * far.sectors) return undefined;
    const ring = far.largest_deg / far.rings;
    if (far.sectors === 1)
        return titled('Far field', chart({
            xName: 'angle from the axis (°)', yName: 'intensity (W/sr)', x: Array.from(far.W_per_sr, (_, i) => (i + 0.5) * ring), fromZero: true,
            series: [{ name: 'intensity', values: [...far.W_per_sr], points: false }],
        }));
    const side = 240, values = new Float32Array(side * side);
    for (let row = 0; row < side; ++row)
        for (let column = 0; column < side; ++column) {
            const x = (2 * (column + 0.5)) / side - 1, y = 1 - (2 * (row + 0.5)) / side, r = Math.hypot(x, y);
            const azimuth = (Math.atan2(y, x) / (2 * Math.PI) + 1) % 1;
            if (r < 1) values[row * side + column] = far.W_per_sr[Math.floor(r * far.rings) * far.sectors + Math.floor(azimuth * far.sectors) % far.sectors]!;
        }
    const a = far.largest_deg;
    return titled('Far field', planePlot({
        xName: 'angle along azimuth 0° (°)', yName: 'angle along azimuth 90° (°)', low: [-a, -a], high: [a, a], equal: true, label: 'Intensity by direction',
        image: { columns: side, rows: side, values, scale: lightScale(far.W_per_sr), unit: 'W/sr', name: 'intensity' },
    }));
}

function opticalPath(detector: DetectorData): HTMLElement | undefined {
    const path = detector.optical_path;
    if (!path || !(path.to_mm > path.from_mm)) return undefined;
    const width = (path.to_mm - path.from_mm) / path.powers_W.length;
    return titled('Optical path', chart({
        xName: 'optical path (mm)', yName: 'power (W)', x: Array.from(path.powers_W, (_, i) => path.from_mm + (i + 0.5) * width), fromZero: true,
        series: [{ name: 'power', values: [...path.powers_W], points: false }],
    }));
}

export function detectorCard(data: PageData, detector: DetectorData): HTMLElement {
    const found = at(data.summary, 'detectors', detector.name) ?? at(data.sweep?.rows[0]?.detectors, detector.name);
    const hits = hitsOf(data, detector), spot = spotFigures(data, hits);
    const kind = detector.kind === 'sphere' ? (detector.radius_mm ? `sphere of ${figure(detector.radius_mm)} mm` : 'sphere at infinity')
        : detector.kind === 'surface' ? `what arrives at ${detector.surface ?? ''}` : `${detector.size_mm?.map(s => figure(s)).join(' × ')} mm`;
    const notes = [kind, detector.absorbs ? '' : 'lets light pass', detector.where && `counts ${detector.where}`].filter(Boolean).join('; ');
    return h('article', { class: 'card', attr: { 'data-detector': detector.name } }, h('h3', {}, detector.name, h('span', { class: 'note' }, ` ${notes}`)), numbers(found),
        h('div', { class: 'figures' }, irradiance(detector), hits.length > 1 && spot ? spots(data, hits, spot) : null,
            encircledEnergy(detector, hits, spot), spectrum(found), farField(detector), opticalPath(detector)),
        split(found, 'by_wavelength', 'wavelength (nm)'), split(found, 'by_source', 'source'));
}
