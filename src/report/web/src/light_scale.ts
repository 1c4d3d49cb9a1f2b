// In: numbers of a detector's picture or far field. Out: the scale that they are coloured by, and the picture itself.
import { lightColour } from './colours';

export interface LightScale {
    logarithmic: boolean;
    least: number; // what the dark end stands for
    most: number;
    share: (value: number) => number;
}

const decades = 4, spotToMean = 30; // as the program draws its own pictures

export function lightScale(values: ArrayLike<number>, logarithmic?: boolean): LightScale {
    let most = 0, sum = 0;
    for (let i = 0; i < values.length; ++i) {
        most = Math.max(most, values[i]!);
        sum += values[i]!;
    }
    const log = logarithmic ?? most > spotToMean * (sum / Math.max(1, values.length));
    const least = log ? most / 10 ** decades : 0;
    const share = (value: number) => (most <= 0 ? 0 : log ? (value > 0 ? 1 + Math.log10(value / most) / decades : 0) : value / most);
    return { logarithmic: log, least, most, share };
}

/// Pixels of four bytes, the first row as the values have it.
export function lightPixels(values: ArrayLike<number>, scale: LightScale, opacity = (_share: number) => 255): Uint8ClampedArray<ArrayBuffer> {
    const pixels = new Uint8ClampedArray(4 * values.length);
    for (let i = 0; i < values.length; ++i) {
        const share = Math.min(1, Math.max(0, scale.share(values[i]!)));
        pixels.set([...lightColour(share), opacity(share)], 4 * i);
    }
    return pixels;
}
