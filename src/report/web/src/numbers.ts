// In: numbers. Out: them as a person reads them. `general` and `fixed` write as the program's own texts do.

/// As C's %.{digits}g.
export function general(value: number, digits = 6): string {
    if (Number.isNaN(value)) return 'nan';
    if (!Number.isFinite(value)) return value > 0 ? 'inf' : '-inf';
    if (value === 0) return Object.is(value, -0) ? '-0' : '0';
    const [mantissa, power] = value.toExponential(digits - 1).split('e') as [string, string];
    const exponent = Number(power);
    if (exponent < -4 || exponent >= digits) {
        const short = mantissa.includes('.') ? mantissa.replace(/\.?0+$/, '') : mantissa;
        return `${short}e${exponent < 0 ? '-' : '+'}${String(Math.abs(exponent)).padStart(2, '0')}`;
    }
    const text = value.toFixed(Math.max(0, digits - 1 - exponent));
    return text.includes('.') ? text.replace(/\.?0+$/, '') : text;
}

const superscripts = '⁰¹²³⁴⁵⁶⁷⁸⁹';

/// For a person: a true minus, powers of ten as 1.5×10⁻⁷, and a dash for what is no number.
export function figure(value: unknown, digits = 6): string {
    if (typeof value !== 'number' || Number.isNaN(value)) return '–';
    const text = general(value, digits);
    const [mantissa, power] = text.split('e') as [string, string | undefined];
    const minus = (t: string) => t.replace('-', '−');
    if (power === undefined) return minus(mantissa);
    const exponent = Number(power);
    const raised = String(Math.abs(exponent)).split('').map(d => superscripts[Number(d)]).join('');
    return `${minus(mantissa)}×10${exponent < 0 ? '⁻' : ''}${raised}`;
}

/// A whole number with its thousands apart.
export function count(value: unknown): string {
    return typeof value === 'number' ? Math.round(value).toString().replace(/\B(?=(\d{3})+$)/g, '\u202f') : '–';
}

export function percent(share: number, digits = 4): string {
    return `${figure(100 * share, digits)} %`;
}

/// A number, a list of numbers, a text or a truth; parts of a list below any length's meaning are 0.
export function shown(value: unknown, digits = 6): string {
    if (typeof value === 'number') return figure(value, digits);
    if (typeof value === 'string') return value;
    if (typeof value === 'boolean') return value ? 'yes' : 'no';
    if (Array.isArray(value))
        return value.length === 0 ? '–' : `(${value.map(x => typeof x === 'number' && Math.abs(x) < 1e-12 ? '0' : shown(x, digits)).join(', ')})`;
    return '–';
}

/// The unit that the name of a key ends with: "object.lens.move_mm[2]" is in mm.
export function unitOfKey(key: string): string {
    const last = key.slice(key.lastIndexOf('.') + 1).replace(/\[.*$/, '');
    const units: [string, string][] = [
        ['_W_per_mm2', 'W/mm²'], ['_W_per_sr', 'W/sr'], ['_per_mm2', '1/mm²'], ['_per_mm', '1/mm'], ['_um2', 'µm²'],
        ['_um4', 'µm⁴'], ['_deg', '°'], ['_rad', 'rad'], ['_mm', 'mm'], ['_nm', 'nm'], ['_m', 'm'], ['_W', 'W'], ['_s', 's']];
    return units.find(([suffix]) => last.endsWith(suffix))?.[1] ?? '';
}

export function withUnit(key: string): string {
    const unit = unitOfKey(key);
    return unit ? `${key} (${unit})` : key;
}

/// 1, 2 or 5 times a power of ten, at most `most`.
export function roundBelow(most: number): number {
    const power = 10 ** Math.floor(Math.log10(most));
    return [5, 2, 1].map(k => k * power).find(x => x <= most * (1 + 1e-9)) ?? power;
}
