// In: lines, each faint. Out: the sum of all that cross a pixel, shown so that neither a single ray is lost nor a dense beam
// becomes a blot: on dark pages they add up like light, on light ones like ink.
import {
    AddEquation, CustomBlending, FloatType, HalfFloatType, LinearFilter, Mesh, NoBlending, OneFactor, OneMinusSrcAlphaFactor, OrthographicCamera, PlaneGeometry,
    RGBAFormat, Scene, ShaderMaterial, SrcColorFactor, UnsignedByteType, WebGLRenderTarget, ZeroFactor, type Camera, type WebGLRenderer,
} from 'three';
import { isDark } from './colours';

const vertexShader = 'varying vec2 at; void main() { at = uv; gl_Position = vec4(position.xy, 0.0, 1.0); }';
// The root keeps a single ray visible beside a thousand that lie on each other.
const fragmentShader = `
uniform sampler2D sums;
uniform float exposure, dark;
varying vec2 at;
void main() {
    vec3 sum = max(texture2D(sums, at).rgb, 0.0) * exposure;
    float most = max(sum.r, max(sum.g, sum.b));
    if (most <= 1e-7) discard;
    vec3 hue = sum / most;
    float strength = 1.0 - exp(-1.5 * pow(most, 0.6));
    if (dark > 0.5) {
        vec3 lit = hue * strength + vec3(1.0) * 0.35 * smoothstep(0.75, 1.0, strength);
        gl_FragColor = vec4(lit, strength);
    } else {
        gl_FragColor = vec4(exp(-2.1 * strength * hue), 1.0);
    }
}`;

const mostFine = 2500;

export class LightLayer {
    readonly scene = new Scene();
    private readonly rough: WebGLRenderTarget; // for many lines
    private readonly fine: WebGLRenderTarget;  // for few: smooth edges cost as much as four times the lines
    private few = false;
    private readonly quad = new Scene();
    private readonly flat = new OrthographicCamera();
    private readonly material: ShaderMaterial;
    private dark: boolean | undefined;

    constructor(private readonly renderer: WebGLRenderer) {
        const gl = renderer.getContext();
        const half = gl.getExtension('EXT_color_buffer_float') !== null || gl.getExtension('EXT_color_buffer_half_float') !== null;
        const sums = (samples: number) => new WebGLRenderTarget(1, 1, {
            type: half ? HalfFloatType : gl.getExtension('EXT_float_blend') ? FloatType : UnsignedByteType, format: RGBAFormat,
            minFilter: LinearFilter, magFilter: LinearFilter, depthBuffer: false, samples,
        });
        this.rough = sums(0);
        this.fine = sums(4);
        this.material = new ShaderMaterial({
            vertexShader, fragmentShader, transparent: true, depthTest: false, depthWrite: false, blending: NoBlending,
            uniforms: { sums: { value: this.rough.texture }, exposure: { value: 1 }, dark: { value: 1 } },
        });
        const quad = new Mesh(new PlaneGeometry(2, 2), this.material);
        quad.frustumCulled = false;
        this.quad.add(quad);
    }

    set exposure(value: number) { this.material.uniforms.exposure!.value = value; }

    /// How many lines there will be.
    expect(lines: number): void {
        this.few = lines <= mostFine;
        this.material.uniforms.sums!.value = (this.few ? this.fine : this.rough).texture;
    }

    resize(width: number, height: number): void {
        this.rough.setSize(width, height);
        this.fine.setSize(width, height);
    }

    draw(camera: Camera): void {
        this.dress();
        const renderer = this.renderer;
        renderer.setRenderTarget(this.few ? this.fine : this.rough);
        renderer.setClearColor(0x000000, 0);
        renderer.clear();
        renderer.render(this.scene, camera);
        renderer.setRenderTarget(null);
        renderer.render(this.quad, this.flat);
    }

    private dress(): void {
        if (this.dark === isDark()) return;
        this.dark = isDark();
        const m = this.material;
        m.blending = CustomBlending;
        if (this.dark) {
            m.blendEquation = AddEquation;
            m.blendSrc = OneFactor;
            m.blendDst = OneMinusSrcAlphaFactor;
            m.blendSrcAlpha = OneFactor;
            m.blendDstAlpha = OneMinusSrcAlphaFactor;
        } else {
            m.blendEquation = AddEquation;
            m.blendSrc = ZeroFactor;
            m.blendDst = SrcColorFactor;
            m.blendSrcAlpha = ZeroFactor;
            m.blendDstAlpha = OneFactor;
        }
        m.uniforms.dark!.value = this.dark ? 1 : 0;
        m.needsUpdate = true;
    }
}
