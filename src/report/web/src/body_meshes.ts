// In: the page's bodies. Out: them in the scene: glass that one sees through, mirrors, detectors with the light on them.
import {
    BackSide, BufferAttribute, BufferGeometry, Color, DataTexture, DoubleSide, FrontSide, LineBasicMaterial, LineSegments, Matrix4, Mesh,
    MeshBasicMaterial, NearestFilter, NormalBlending, PlaneGeometry, ShaderMaterial, type Material,
} from 'three';
import { LineMaterial } from 'three/addons/lines/LineMaterial.js';
import { LineSegments2 } from 'three/addons/lines/LineSegments2.js';
import { LineSegmentsGeometry } from 'three/addons/lines/LineSegmentsGeometry.js';
import { isDark, themed } from './colours';
import type { BodyData, DetectorData, PageData } from './data';
import type { Extent } from './extent';
import { lightPixels, lightScale } from './light_scale';
import type { Stage } from './stage';
import { cross, type Vec } from './vec';

const vertexShader = `
varying vec3 vNormal, vView;
void main() {
    vec4 at = modelViewMatrix * vec4(position, 1.0);
    vView = -at.xyz;
    #ifdef NORMALS
    vNormal = normalMatrix * normal;
    #endif
    gl_Position = projectionMatrix * at;
}`;
// Clear where one looks straight through, bright towards the rim: enough to see a body, too little to hide a ray.
const fragmentShader = `
uniform vec3 middle, rim;
uniform float least, most, power;
varying vec3 vNormal, vView;
void main() {
    #ifdef NORMALS
    vec3 n = normalize(vNormal);
    #else
    vec3 n = normalize(cross(dFdx(vView), dFdy(vView)));
    #endif
    float facing = abs(dot(n, normalize(vView)));
    float edge = pow(1.0 - facing, power);
    gl_FragColor = vec4(mix(middle, rim, edge), mix(least, most, edge));
}`;

interface Look { middle: string; rim: string; least: number; most: number; power: number }

function lookOf(kind: string): Look {
    const dark = isDark();
    switch (kind) {
        case 'glass': return dark ? { middle: '#5b86a8', rim: '#d7efff', least: 0.05, most: 0.5, power: 2.2 }
            : { middle: '#7fa8c4', rim: '#2b5f86', least: 0.09, most: 0.45, power: 2 };
        case 'mirror': return dark ? { middle: '#8b98a5', rim: '#ffffff', least: 0.24, most: 0.7, power: 1.5 }
            : { middle: '#9aa7b3', rim: '#4a5763', least: 0.35, most: 0.75, power: 1.5 };
        case 'half': return { middle: '#8f9fae', rim: '#c9d6e2', least: 0.16, most: 0.5, power: 1.5 };
        case 'absorber': return dark ? { middle: '#000000', rim: '#5a5f66', least: 0.3, most: 0.5, power: 1.5 }
            : { middle: '#3a3f46', rim: '#15181c', least: 0.3, most: 0.6, power: 1.5 };
        case 'diffuse': return dark ? { middle: '#b9b4a8', rim: '#fffdf5', least: 0.14, most: 0.4, power: 1.2 }
            : { middle: '#d8d2c4', rim: '#8a8372', least: 0.35, most: 0.6, power: 1.2 };
        default: return { middle: '#b08a6a', rim: '#d8b08c', least: 0.22, most: 0.5, power: 1.2 };
    }
}

const kinds = ['glass', 'mirror', 'half', 'absorber', 'diffuse', 'paint'];

export class BodyMeshes {
    private readonly materials = new Map<string, ShaderMaterial>();
    private readonly edges = new LineBasicMaterial({ transparent: true, depthWrite: false });
    private readonly rims = new LineBasicMaterial({ transparent: true, depthWrite: false });
    private readonly marks: { material: Material & { color: Color }; name: string }[] = [];

    constructor(private readonly stage: Stage, private readonly data: PageData, private readonly extent: Extent) {
        const geometries = data.meshes.map(() => undefined as BufferGeometry | undefined);
        data.bodies.forEach(body => {
            const detector = body.detector === undefined ? undefined : data.detectors[body.detector];
            if (detector?.x && detector.y && detector.size_mm) this.addDetector(detector);
            else if (body.endless) this.addPlane(body);
            else if (body.mesh !== undefined) this.addBody(body, geometries[body.mesh] ??= this.geometryOf(body.mesh));
        });
        this.addMarks();
        this.dress();
    }

    private materialOf(kind: string, normals: boolean): ShaderMaterial {
        const key = `${kinds.includes(kind) ? kind : 'paint'}${normals ? '' : ' flat'}`;
        let material = this.materials.get(key);
        if (!material) {
            material = new ShaderMaterial({
                vertexShader, fragmentShader, transparent: true, depthWrite: false, side: DoubleSide, blending: NormalBlending,
                defines: normals ? { NORMALS: '' } : {},
                uniforms: { middle: { value: new Color() }, rim: { value: new Color() }, least: { value: 0 }, most: { value: 0 }, power: { value: 1 } },
            });
            this.materials.set(key, material);
        }
        return material;
    }

    /// Colours of the theme.
    dress(): void {
        for (const [key, material] of this.materials) {
            const look = lookOf(key.split(' ')[0]!), u = material.uniforms;
            (u.middle!.value as Color).set(look.middle);
            (u.rim!.value as Color).set(look.rim);
            u.least!.value = look.least;
            u.most!.value = look.most;
            u.power!.value = look.power;
        }
        this.edges.color.set(isDark() ? '#9fc3dd' : '#2f5f80');
        this.edges.opacity = isDark() ? 0.55 : 0.6;
        this.rims.color.set(isDark() ? '#d4dde5' : '#38434d');
        this.rims.opacity = 0.75;
        for (const { material, name } of this.marks) material.color.set(themed(name));
        this.stage.draw();
    }

    private geometryOf(mesh: number): BufferGeometry {
        const data = this.data.meshes[mesh]!, geometry = new BufferGeometry();
        geometry.setAttribute('position', new BufferAttribute(data.places, 3));
        if (data.normals) geometry.setAttribute('normal', new BufferAttribute(data.normals, 3, true));
        geometry.setIndex(new BufferAttribute(data.triangles, 1));
        for (let face = 0; face + 1 < data.face_begins.length; ++face) {
            const begin = data.face_begins[face]!;
            geometry.addGroup(3 * begin, 3 * (data.face_begins[face + 1]! - begin), face);
        }
        return geometry;
    }

    private matrixOf(m: number[]): Matrix4 {
        const o = this.stage.origin;
        return new Matrix4().set(m[0]!, m[3]!, m[6]!, m[9]! - o[0], m[1]!, m[4]!, m[7]!, m[10]! - o[1], m[2]!, m[5]!, m[8]!, m[11]! - o[2], 0, 0, 0, 1);
    }

    private place<T extends Mesh | LineSegments>(object: T, matrix: Matrix4, order: number): T {
        object.matrixAutoUpdate = false;
        object.matrix.copy(matrix);
        object.renderOrder = order;
        this.stage.scene.add(object);
        return object;
    }

    private addBody(body: BodyData, geometry: BufferGeometry): void {
        const mesh = this.data.meshes[body.mesh!]!, matrix = this.matrixOf(body.matrix);
        const materials = body.faces.map(([, kind]) => this.materialOf(kind, mesh.normals !== undefined));
        this.place(new Mesh(geometry, materials), matrix, 1);
        for (const [list, material] of [[mesh.creases, this.edges], [mesh.borders, this.rims]] as const) {
            if (list.length === 0) continue;
            const lines = new BufferGeometry();
            lines.setAttribute('position', geometry.getAttribute('position'));
            lines.setIndex(new BufferAttribute(list, 1));
            this.place(new LineSegments(lines, material), matrix, 2);
        }
    }

    private addPlane(body: BodyData): void {
        const m = body.matrix, size = 1.2 * this.extent.diagonal, o = this.stage.origin;
        const normal: Vec = [m[6]!, m[7]!, m[8]!];
        const norm2 = normal[0] ** 2 + normal[1] ** 2 + normal[2] ** 2;
        const off = (normal[0] * (o[0] - m[9]!) + normal[1] * (o[1] - m[10]!) + normal[2] * (o[2] - m[11]!)) / norm2;
        const placed = this.matrixOf([...m.slice(0, 9), o[0] - off * normal[0], o[1] - off * normal[1], o[2] - off * normal[2]]);
        this.place(new Mesh(new PlaneGeometry(size, size), this.materialOf(body.faces[0]?.[1] ?? 'mirror', true)), placed, 1);
    }

    private addDetector(detector: DetectorData): void {
        const [width, height] = detector.size_mm!, x = detector.x!, y = detector.y!;
        const matrix = this.matrixOf([...x, ...y, ...cross(x, y), ...detector.at_mm]);
        const plane = new PlaneGeometry(width, height);
        const { irradiance, columns, rows } = detector;
        if (irradiance && columns && rows && irradiance.some(v => v > 0)) {
            const pixels = lightPixels(irradiance, lightScale(irradiance), share => Math.round(70 + 185 * Math.min(1, 3 * share)));
            const turned = new Uint8Array(pixels.length); // a texture begins at the bottom
            for (let row = 0; row < rows; ++row) turned.set(pixels.subarray(4 * columns * row, 4 * columns * (row + 1)), 4 * columns * (rows - 1 - row));
            const texture = new DataTexture(turned, columns, rows);
            texture.magFilter = NearestFilter;
            texture.needsUpdate = true;
            this.place(new Mesh(plane, new MeshBasicMaterial({ map: texture, transparent: true, side: FrontSide, depthWrite: false })), matrix, 0);
            this.place(new Mesh(plane, new MeshBasicMaterial({ map: texture, transparent: true, opacity: 0.35, side: BackSide, depthWrite: false })), matrix, 0);
        } else {
            this.place(new Mesh(plane, this.materialOf('absorber', true)), matrix, 0);
        }
        const [w, h] = [width / 2, height / 2];
        const frame = new BufferGeometry();
        frame.setAttribute('position', new BufferAttribute(new Float32Array([-w, -h, 0, w, -h, 0, w, -h, 0, w, h, 0, w, h, 0, -w, h, 0, -w, h, 0, -w, -h, 0]), 3));
        this.place(new LineSegments(frame, this.rims), matrix, 2);
    }

    private addMarks(): void {
        const o = this.stage.origin;
        const placed = (list: Float32Array) => {
            const geometry = new BufferGeometry();
            geometry.setAttribute('position', new BufferAttribute(list.map((x, i) => x - o[i % 3]!), 3));
            return geometry;
        };
        for (const mark of this.data.marks) {
            const name = `mark-${mark.kind}`;
            if (mark.triangles.length > 0) {
                const fill = new MeshBasicMaterial({ transparent: true, opacity: 0.6, side: DoubleSide, depthTest: false });
                this.marks.push({ material: fill, name });
                this.place(new Mesh(placed(mark.triangles), fill), new Matrix4(), 3);
            }
            const outline = mark.lines.length > 0 ? mark.lines : outlineOf(mark.triangles);
            const line = new LineMaterial({ linewidth: mark.lines.length > 0 ? 3 : 1.5, transparent: true, depthTest: false });
            this.marks.push({ material: line, name });
            this.stage.over.add(new LineSegments2(new LineSegmentsGeometry().setPositions(outline.map((x, i) => x - o[i % 3]!)), line));
        }
    }
}

/// The sides of triangles: of a sliver there is little else to see.
function outlineOf(triangles: Float32Array): Float32Array {
    const lines = new Float32Array(2 * triangles.length);
    for (let t = 0; t < triangles.length / 9; ++t)
        [0, 1, 1, 2, 2, 0].forEach((corner, i) => lines.set(triangles.subarray(9 * t + 3 * corner, 9 * t + 3 * corner + 3), 18 * t + 3 * i));
    return lines;
}
