// In: what is to be drawn. Out: a picture of it that can be turned; drawn when something has changed, and only then.
import { ColorManagement, LinearSRGBColorSpace, MathUtils, PerspectiveCamera, Scene, Vector3, WebGLRenderer } from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import { centreOf, sizeOf, type Extent } from './extent';
import { isDark, themed } from './colours';
import { LightLayer } from './light_layer';
import { sub, type Vec } from './vec';

ColorManagement.enabled = false;

export class Stage {
    readonly scene = new Scene(); // bodies
    readonly over = new Scene();  // what is drawn over all
    readonly light: LightLayer;
    readonly camera = new PerspectiveCamera(30, 1, 0.1, 1e6);
    readonly controls: OrbitControls;
    readonly origin: Vec; // mm: what the scene's coordinates are counted from, so that floats suffice
    private readonly renderer: WebGLRenderer;
    private readonly afterDraw: (() => void)[] = [];
    private wanted = false;

    /// Throws where there is no WebGL.
    constructor(readonly host: HTMLElement, private readonly extent: Extent) {
        this.renderer = new WebGLRenderer({ antialias: true, powerPreference: 'high-performance' });
        this.renderer.autoClear = false;
        this.light = new LightLayer(this.renderer);
        this.renderer.outputColorSpace = LinearSRGBColorSpace;
        this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
        this.renderer.sortObjects = true;
        host.prepend(this.renderer.domElement);
        this.origin = centreOf(extent.box);
        this.controls = new OrbitControls(this.camera, this.renderer.domElement);
        this.controls.enableDamping = false;
        this.controls.zoomToCursor = true;
        this.controls.addEventListener('change', () => this.draw());
        new ResizeObserver(() => this.resize()).observe(host);
        this.resize();
        this.look();
    }

    get canvas(): HTMLCanvasElement { return this.renderer.domElement; }
    onDraw(listener: () => void): void { this.afterDraw.push(listener); }

    /// Along the short way of the scene, a little from the side and from above; y is up, z or x to the right.
    look(azimuth?: number, elevation?: number): void {
        const size = sizeOf(this.extent.box);
        const alongZ = size[2] > size[0], flat = size[1] < 0.6 * Math.min(size[0], size[2]);
        const turn = azimuth ?? (alongZ ? -90 + 22 : 22), lift = elevation ?? (flat ? 48 : 15);
        const a = MathUtils.degToRad(turn), e = MathUtils.degToRad(lift);
        const toward = new Vector3(Math.sin(a) * Math.cos(e), Math.sin(e), Math.cos(a) * Math.cos(e));
        this.controls.target.set(0, 0, 0);
        this.camera.up.set(0, 1, 0);
        this.camera.position.copy(toward.multiplyScalar(this.fitting(toward)));
        this.controls.update();
        this.draw();
    }

    /// How far away the camera has to be to see all corners of the box, seen along −toward.
    private fitting(toward: Vector3): number {
        const size = sizeOf(this.extent.box);
        const right = new Vector3(0, 1, 0).cross(toward).normalize(), up = toward.clone().cross(right);
        const half = Math.tan(MathUtils.degToRad(this.camera.fov / 2)), aspect = this.camera.aspect;
        let distance = 0;
        for (let corner = 0; corner < 8; ++corner) {
            const p = new Vector3(...([0, 1, 2].map(i => ((corner >> i) & 1 ? 0.5 : -0.5) * size[i]!) as Vec));
            const need = Math.max(Math.abs(p.dot(right)) / (half * aspect), Math.abs(p.dot(up)) / half);
            distance = Math.max(distance, p.dot(toward) + 1.06 * need);
        }
        return distance || 10;
    }

    draw(): void {
        if (this.wanted) return;
        this.wanted = true;
        requestAnimationFrame(() => this.drawNow());
    }

    drawNow(): void {
        this.wanted = false;
        const distance = this.camera.position.distanceTo(this.controls.target);
        this.camera.near = distance / 500;
        this.camera.far = 20 * (distance + this.extent.diagonal);
        this.camera.updateProjectionMatrix();
        this.camera.updateMatrixWorld();
        this.renderer.setClearColor(themed('stage') || (isDark() ? '#000' : '#fff'), 1);
        this.renderer.clear();
        this.renderer.render(this.scene, this.camera);
        this.light.draw(this.camera);
        this.renderer.render(this.over, this.camera);
        this.afterDraw.forEach(listener => listener());
    }

    private resize(): void {
        const { clientWidth: width, clientHeight: height } = this.host;
        if (width === 0 || height === 0) return;
        this.renderer.setSize(width, height, false);
        this.light.resize(this.renderer.domElement.width, this.renderer.domElement.height);
        this.camera.aspect = width / height;
        this.camera.updateProjectionMatrix();
        this.draw();
    }

    /// Of a place (mm, world) where it stands on the screen, in CSS pixels from the canvas's corner; z > 1: behind.
    project(p: Vec): Vec {
        const v = new Vector3(...sub(p, this.origin)).project(this.camera);
        const { clientWidth: width, clientHeight: height } = this.host;
        const behind = new Vector3(...sub(p, this.origin)).applyMatrix4(this.camera.matrixWorldInverse).z > -this.camera.near;
        return [((v.x + 1) / 2) * width, ((1 - v.y) / 2) * height, behind ? 2 : v.z];
    }

    /// From the scene's coordinates to those of the screen.
    matrix(): number[] {
        this.camera.updateMatrixWorld();
        return this.camera.projectionMatrix.clone().multiply(this.camera.matrixWorldInverse).elements;
    }

    /// mm for a pixel, where the camera looks at.
    millimetresPerPixel(): number {
        const distance = this.camera.position.distanceTo(this.controls.target);
        return (2 * distance * Math.tan(MathUtils.degToRad(this.camera.fov / 2))) / this.host.clientHeight;
    }

    /// Turns by so many degrees, moves nearer by a factor.
    turn(right: number, up: number, nearer = 1): void {
        const offset = this.camera.position.clone().sub(this.controls.target);
        offset.applyAxisAngle(this.camera.up, MathUtils.degToRad(-right));
        const side = this.camera.up.clone().cross(offset).normalize();
        const lifted = offset.clone().applyAxisAngle(side, MathUtils.degToRad(-up));
        if (lifted.angleTo(this.camera.up) > 0.03 && lifted.angleTo(this.camera.up) < Math.PI - 0.03) offset.copy(lifted);
        this.camera.position.copy(this.controls.target).add(offset.divideScalar(nearer));
        this.controls.update();
        this.draw();
    }

    /// Where it stands and what it looks at, in mm of the world.
    get view(): number[] {
        const p = this.camera.position, t = this.controls.target, o = this.origin;
        return [p.x + o[0], p.y + o[1], p.z + o[2], t.x + o[0], t.y + o[1], t.z + o[2]];
    }
    set view(v: number[]) {
        if (v.length !== 6 || v.some(x => !Number.isFinite(x))) return;
        const o = this.origin;
        this.camera.position.set(v[0]! - o[0], v[1]! - o[1], v[2]! - o[2]);
        this.controls.target.set(v[3]! - o[0], v[4]! - o[1], v[5]! - o[2]);
        this.controls.update();
        this.draw();
    }
}
