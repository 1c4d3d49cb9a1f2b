// In: shares and wavelengths. Out: colours: maps that people who see colours differently can read too, and the theme's.

export type Rgb = [number, number, number]; // 0 to 255

const rgb = (hex: string): Rgb => [1, 3, 5].map(i => parseInt(hex.slice(i, i + 2), 16)) as Rgb;

// Ten evenly spaced colours of matplotlib's maps (S. van der Walt and N. Smith, CC0): even steps look even.
const viridis = ['#440154', '#482878', '#3e4989', '#31688e', '#26828e', '#1f9e89', '#35b779', '#6ece58', '#b5de2b', '#fde725'].map(rgb);
const inferno = ['#000004', '#1b0c41', '#4a0c6b', '#781c6d', '#a52c60', '#cf4446', '#ed6925', '#fb9b06', '#f7d13d', '#fcffa4'].map(rgb);
// M. Okabe and K. Ito, Color Universal Design: told apart with any kind of colour vision.
const okabeIto = ['#0072b2', '#e69f00', '#009e73', '#d55e00', '#cc79a7', '#56b4e9', '#b8a500'].map(rgb);
const brighter = ['#4aa8e8', '#f0ab1c', '#1fc496', '#f5793f', '#e596c3', '#a5d8f5', '#dcd23e'].map(rgb); // the same on black
export const groupGrey: Rgb = [140, 140, 140];

function mapped(map: Rgb[], share: number): Rgb {
    const place = Math.min(Math.max(share, 0), 1) * (map.length - 1);
    const below = Math.min(Math.floor(place), map.length - 2), part = place - below;
    return map[below]!.map((c, i) => Math.round(c + part * (map[below + 1]![i]! - c))) as Rgb;
}

/// For light on a surface: black where there is none.
export const lightColour = (share: number): Rgb => mapped(inferno, share);

/// For numbers of rays; the end of the map that a page's background would swallow is left out.
export const rampColour = (share: number, dark: boolean): Rgb => mapped(viridis, dark ? 0.2 + 0.8 * share : 0.88 * share);

export const groupColour = (rank: number): Rgb => (isDark() ? brighter : okabeIto)[rank] ?? groupGrey;
export const groupColours = okabeIto.length;

export const hexRgb = rgb;
export const css = (c: Rgb): string => `rgb(${c[0]} ${c[1]} ${c[2]})`;

let theme: 'light' | 'dark' = matchMedia('(prefers-color-scheme: dark)').matches ? 'dark' : 'light';
const listeners: (() => void)[] = [];

export const isDark = (): boolean => theme === 'dark';
export function setTheme(which: 'light' | 'dark'): void {
    theme = which;
    document.documentElement.dataset.theme = which;
    listeners.forEach(listener => listener());
}
export const onTheme = (listener: () => void): void => { listeners.push(listener); };

/// A colour that the style sheet names.
export const themed = (name: string): string => getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
