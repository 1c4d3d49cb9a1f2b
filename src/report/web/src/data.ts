// In: the JSON that the program put into the page. Out: it with its arrays as typed arrays. Lengths are in mm,
// wavelengths in nm, powers in W.

export interface Names {
    sources: string[];
    surfaces: string[];
    media: string[];
    wavelengths_nm: Float64Array;
    refractive_index: Float64Array; // by medium, in it by wavelength
    colours: [string, string][];    // of each wavelength, on light and on dark pages
    every: number;
    min_power: number;
    where: string;
}

/// Columns as in the log, one entry a segment; `begin`, `source` and `wavelength` have one a ray.
export interface Rays {
    shown: number;
    number: Float64Array;
    begin: Uint32Array;
    source: Uint16Array;
    wavelength: Uint16Array;
    index?: Uint32Array; // absent: a segment's place in its ray
    parent: Int32Array;
    depth: Uint16Array;
    born: Uint8Array;
    ended: Uint8Array;
    surface: Int32Array;
    medium: Uint16Array;
    primitive?: Int32Array;
    at: Float64Array;
    toward: Float64Array;
    length: Float64Array;
    optical_path: Float64Array;
    power_start: Float64Array;
    power_end: Float64Array;
}

export interface MeshData {
    places: Float32Array;
    normals?: Int16Array;
    triangles: Uint32Array;
    face_begins: Uint32Array;
    creases: Uint32Array;
    borders: Uint32Array;
    triangles_of_model: number;
}

export interface BodyData {
    name: string;
    open: boolean;
    medium?: number;
    detector?: number;
    mesh?: number;
    endless?: boolean;
    matrix: number[]; // linear part column by column, then the offset in mm
    faces: [name: string, kind: string, surface: string][];
}

export interface DetectorData {
    name: string;
    kind: 'rectangle' | 'sphere' | 'surface';
    absorbs: boolean;
    back: boolean;
    where: string;
    at_mm: [number, number, number];
    x?: [number, number, number];
    y?: [number, number, number];
    size_mm?: [number, number];
    radius_mm?: number;
    surface?: string;
    columns?: number;
    rows?: number;
    pixels_in_one?: number;
    irradiance?: Float32Array;
    encircled_mm?: Float64Array;
    far_field?: { rings: number; sectors: number; largest_deg: number; W_per_sr: Float64Array };
    optical_path?: { from_mm: number; to_mm: number; powers_W: Float64Array };
}

export type Json = null | boolean | number | string | Json[] | { [key: string]: Json };
export type JsonTable = { [key: string]: Json };

export interface SweepData {
    keys: string[];
    rows: { values: Json[]; energy_W?: JsonTable; passed?: boolean; escaped_direction?: JsonTable; detectors: Record<string, JsonTable> }[];
}

export interface Mark {
    kind: string;
    text: string;
    lines: Float32Array;
    triangles: Float32Array;
}

export interface PageData {
    format: number;
    kind: 'run' | 'sweep' | 'model';
    title: string;
    summary: JsonTable;
    names: Names;
    rays: Rays;
    bodies: BodyData[];
    bodies_in_all: number;
    meshes: MeshData[];
    surroundings: number;
    sources: { name: string; power_W: number; at_mm: number[]; toward: number[] }[];
    detectors: DetectorData[];
    sweep?: SweepData;
    marks: Mark[];
    methods: Json;
}

const kinds = {
    f64: Float64Array, f32: Float32Array, u32: Uint32Array, i32: Int32Array, u16: Uint16Array, i16: Int16Array, u8: Uint8Array,
} as const;

function decoded(kind: keyof typeof kinds, base64: string): ArrayBufferView {
    const binary = atob(base64);
    const bytes = new Uint8Array(binary.length);
    for (let i = 0; i < binary.length; ++i) bytes[i] = binary.charCodeAt(i);
    return new kinds[kind](bytes.buffer);
}

/// {"f64": "…"} and its like are arrays of numbers.
function revived(_key: string, value: unknown): unknown {
    if (typeof value !== 'object' || value === null || Array.isArray(value)) return value;
    const keys = Object.keys(value);
    const kind = keys[0];
    if (keys.length !== 1 || kind === undefined || !(kind in kinds)) return value;
    const text = (value as Record<string, unknown>)[kind];
    return typeof text === 'string' ? decoded(kind as keyof typeof kinds, text) : value;
}

export function readData(text: string): PageData {
    const data = JSON.parse(text, revived) as PageData;
    data.rays.power_end ??= data.rays.power_start;
    return data;
}

/// The entry under a path of keys, or undefined.
export function at(value: Json | undefined, ...path: string[]): Json | undefined {
    let here: Json | undefined = value;
    for (const key of path) {
        if (typeof here !== 'object' || here === null || Array.isArray(here)) return undefined;
        here = Object.hasOwn(here, key) ? here[key] : undefined;
    }
    return here;
}

export function numberAt(value: Json | undefined, ...path: string[]): number | undefined {
    const found = at(value, ...path);
    return typeof found === 'number' ? found : undefined;
}

/// The entries of a table under their keys, or those of a list of tables under what they call themselves.
export function entriesAt(value: Json | undefined, ...path: string[]): [string, Json][] {
    const found = at(value, ...path);
    if (typeof found !== 'object' || found === null) return [];
    if (!Array.isArray(found)) return Object.entries(found);
    return found.map((entry, i) => {
        const name = ['name', 'wavelength_nm', 'source', 'object'].map(k => at(entry, k)).find(x => x !== undefined && x !== null);
        return [name === undefined ? String(i) : String(name), entry];
    });
}

export function textsAt(value: Json | undefined, key: string): string[] {
    const found = at(value, key);
    return Array.isArray(found) ? found.filter((x): x is string => typeof x === 'string') : [];
}
