// In: what a person has set. Out: the same as the fragment of a link, and back.

export type ColourBy = 'wavelength' | 'power' | 'depth' | 'path';

export interface View {
    colour: ColourBy;
    depth: number;    // interactions: pieces with more are hidden; Infinity: none
    power: number;    // share of its ray's power: pieces with less are hidden; 0: none
    filter: string;
    segment: number;  // chosen, −1: none
    camera: number[]; // mm: place and what it looks at; empty: as it comes
    theme: '' | 'light' | 'dark';
}

export const plainView = (): View => ({ colour: 'wavelength', depth: Infinity, power: 0, filter: '', segment: -1, camera: [], theme: '' });

export function toFragment(view: View): string {
    const parts = new URLSearchParams();
    if (view.colour !== 'wavelength') parts.set('colour', view.colour);
    if (Number.isFinite(view.depth)) parts.set('depth', String(view.depth));
    if (view.power > 0) parts.set('power', view.power.toPrecision(3));
    if (view.filter) parts.set('filter', view.filter);
    if (view.segment >= 0) parts.set('segment', String(view.segment));
    if (view.camera.length === 6) parts.set('camera', view.camera.map(x => String(Number(x.toPrecision(6)))).join(','));
    if (view.theme) parts.set('theme', view.theme);
    return parts.toString();
}

/// What is no such thing is left as it comes.
export function fromFragment(fragment: string): View {
    const parts = new URLSearchParams(fragment.replace(/^#/, '')), view = plainView();
    const colour = parts.get('colour'), theme = parts.get('theme');
    if (colour === 'power' || colour === 'depth' || colour === 'path') view.colour = colour;
    if (theme === 'light' || theme === 'dark') view.theme = theme;
    const number = (key: string) => (parts.has(key) && parts.get(key) !== '' ? Number(parts.get(key)) : NaN);
    if (number('depth') >= 0) view.depth = number('depth');
    if (number('power') > 0 && number('power') <= 1) view.power = number('power');
    view.filter = parts.get('filter') ?? '';
    if (Number.isInteger(number('segment'))) view.segment = number('segment');
    const camera = (parts.get('camera') ?? '').split(',').map(Number);
    if (camera.length === 6 && camera.every(Number.isFinite)) view.camera = camera;
    return view;
}
