// The scene: one leaf or two side by side on a plain ground, a camera that goes around them, the light.
import * as THREE from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { Emitter } from "../emitter";
import type { LeafInfo, Textures } from "../core/protocol";
import { ambientLight, gleam, ground, keyLight } from "./environment";
import { FILLED, VIEWS, direction, framed } from "./framing";
import { FULL_DETAIL, LEVELS, REST, SLOW } from "./detail";
import { warmUp } from "./leaf_material";
import { LeafModel, type Look, type Moment } from "./leaf_model";

/** The mark in the browser's performance time line when the first leaf is drawn. */
export const FIRST_PICTURE = "wilt-first-picture";
const kMostEnclosed = 2000; // points
const kBetween = 1.25; // leaf lengths between two leaves that are compared

export class Stage {
  readonly events = new Emitter<{ drawn: void; viewed: void }>();
  readonly models: (LeafModel | undefined)[] = [];
  readonly renderer: THREE.WebGLRenderer;
  readonly scene = new THREE.Scene();
  readonly camera = new THREE.PerspectiveCamera(28, 1, 0.02, 60);
  readonly controls: OrbitControls;
  private readonly key = keyLight();
  private dirty = true;
  private following = true; // the camera is where a named view put it
  private view = 0;
  private enclosed: THREE.Vector3[] = []; // by a named view
  private readonly shade = new THREE.ShadowMaterial();
  private level = 0;
  private intervals: number[] = [];
  private verySlow = 0;
  private lastDrawn = 0;
  private takingPictures = false;
  private rest = 0;
  private detail = FULL_DETAIL;

  /** `slow`: pictures are drawn without a graphics processor. Throws where the browser has no WebGL 2. */
  constructor(
    readonly canvas: HTMLCanvasElement,
    slow: boolean,
  ) {
    if (slow) this.level = LEVELS.length - 1;
    this.renderer = new THREE.WebGLRenderer({
      canvas,
      antialias: true,
      alpha: true,
      preserveDrawingBuffer: false,
    });
    this.renderer.toneMapping = THREE.NeutralToneMapping;
    this.renderer.shadowMap.enabled = true;
    this.renderer.shadowMap.type = THREE.VSMShadowMap;
    this.scene.add(this.key, ...gleam(), ambientLight(), ground(this.shade));
    this.controls = new OrbitControls(this.camera, canvas);
    Object.assign(this.controls, {
      enableDamping: true,
      dampingFactor: 0.12,
      minDistance: 0.3,
      maxDistance: 12,
    });
    this.controls.addEventListener("change", () => this.invalidate());
    this.controls.addEventListener("start", () => (this.following = false));
    this.controls.addEventListener("end", () => this.events.emit("viewed", undefined));
    this.setLevel(this.level);
    this.renderer.compile(new THREE.Group().add(...warmUp()), this.camera, this.scene);
    new ResizeObserver(() => this.resize()).observe(canvas.parentElement!);
    this.resize();
  }

  setLeaf(side: number, info: LeafInfo | undefined): void {
    this.models[side]?.group.removeFromParent();
    this.models[side]?.dispose();
    this.models[side] = info && new LeafModel(info);
    if (this.models[side]) this.scene.add(this.models[side].group);
    this.models.forEach((model, i) => {
      if (model) model.group.position.x = this.models[1] ? (i - 0.5) * kBetween : 0;
    });
    this.invalidate();
  }

  async setTextures(side: number, textures: Textures | undefined): Promise<void> {
    await this.models[side]?.setTextures(textures);
    this.invalidate();
  }

  show(side: number, moment: Moment, look: Look): void {
    this.models[side]?.show(moment, look);
    this.invalidate();
  }

  /** The ground's shadow, for a dark page or a light one. */
  setDark(dark: boolean): void {
    this.shade.color.set(dark ? "#000000" : "#1b2740");
    this.shade.opacity = dark ? 0.5 : 0.3;
    this.invalidate();
  }

  /** The next draw() draws. */
  invalidate(): void {
    this.dirty = true;
  }

  /** Once per picture of the screen. */
  draw(): void {
    this.controls.update();
    if (!this.dirty || this.takingPictures || !this.models[0]) return;
    if (this.following) this.keepInside();
    this.dirty = false;
    this.render(this.detail);
    this.keepUp(performance.now());
    clearTimeout(this.rest);
    if (this.level > 0) this.rest = window.setTimeout(() => this.render(FULL_DETAIL), REST);
  }

  private render(detail: number): void {
    if (this.takingPictures) return;
    if (detail !== this.renderer.getPixelRatio()) this.renderer.setPixelRatio(detail);
    this.renderer.render(this.scene, this.camera);
    if (this.models[0] && performance.getEntriesByName(FIRST_PICTURE).length === 0)
      performance.mark(FIRST_PICTURE);
    this.events.emit("drawn", undefined);
  }

  get viewIndex(): number {
    return this.view;
  }

  /** Puts the camera where a named view has it, so that the whole leaf is seen. */
  setView(index: number): void {
    this.view = index;
    this.following = true;
    this.frame(direction(VIEWS[index]!));
    this.events.emit("viewed", undefined);
  }

  /** Shows all of the leaf from where the camera is. */
  fit(): void {
    this.frame(this.camera.position.clone().sub(this.controls.target).normalize());
    this.events.emit("viewed", undefined);
  }

  /** Turns the camera around what it looks at: radians to the right, and up. */
  orbit(right: number, up: number): void {
    const from = this.camera.position.clone().sub(this.controls.target);
    const place = new THREE.Spherical().setFromVector3(from);
    place.theta += right;
    place.phi -= up;
    this.lookFrom(from.setFromSpherical(place.makeSafe()));
  }

  /** Goes nearer, by a factor below 1, or away. */
  zoom(factor: number): void {
    this.lookFrom(this.camera.position.clone().sub(this.controls.target).multiplyScalar(factor));
  }

  /** The camera as six numbers: where it is, what it looks at. */
  get cameraState(): number[] {
    return [...this.camera.position.toArray(), ...this.controls.target.toArray()];
  }

  set cameraState(state: number[]) {
    this.following = false;
    this.camera.position.fromArray(state);
    this.controls.target.fromArray(state, 3);
    this.controls.update();
    this.invalidate();
  }

  /** 1, or the share of the pixels' side that this machine draws quickly. */
  get pixelShare(): number {
    return LEVELS[this.level]!.pixels;
  }

  get isNamedView(): boolean {
    return this.following;
  }

  /** Where a point of the scene is on the canvas, CSS pixels; z below 1: before the far plane. */
  project(point: THREE.Vector3): THREE.Vector3 {
    const { clientWidth, clientHeight } = this.canvas;
    const p = point.clone().project(this.camera);
    return p.set(((p.x + 1) / 2) * clientWidth, ((1 - p.y) / 2) * clientHeight, p.z);
  }

  /** Draws pictures of another size until `endPictures`; both even for films. */
  beginPictures(width: number, height: number): void {
    this.takingPictures = true;
    this.renderer.setPixelRatio(1);
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
  }

  /** The scene as it is now, before its background. */
  takePicture(onto: HTMLCanvasElement): void {
    const { width, height } = this.renderer.domElement;
    if (onto.width !== width || onto.height !== height) Object.assign(onto, { width, height });
    this.renderer.render(this.scene, this.camera);
    const pen = onto.getContext("2d")!;
    const style = getComputedStyle(this.canvas.parentElement!);
    const fill = pen.createRadialGradient(
      width / 2,
      height * 0.4,
      0,
      width / 2,
      height * 0.4,
      Math.hypot(width, height) * 0.6,
    );
    fill.addColorStop(0, style.getPropertyValue("--stage-centre"));
    fill.addColorStop(1, style.getPropertyValue("--stage-edge"));
    pen.fillStyle = fill;
    pen.fillRect(0, 0, width, height);
    pen.drawImage(this.canvas, 0, 0);
  }

  endPictures(): void {
    this.takingPictures = false;
    this.resize();
  }

  private lookFrom(away: THREE.Vector3): void {
    this.following = false;
    this.camera.position.copy(this.controls.target).add(away);
    this.invalidate();
    this.events.emit("viewed", undefined);
  }

  private resize(): void {
    const { clientWidth, clientHeight } = this.canvas.parentElement!;
    if (clientWidth === 0 || clientHeight === 0 || this.takingPictures) return;
    this.renderer.setPixelRatio(this.detail);
    this.renderer.setSize(clientWidth, clientHeight, false);
    this.camera.aspect = clientWidth / clientHeight;
    this.camera.updateProjectionMatrix();
    if (this.following) this.frame(direction(VIEWS[this.view]!));
    this.dirty = true;
    this.draw();
  }

  private outline(): THREE.Vector3[] {
    return this.models.flatMap((model) => {
      model?.group.updateMatrixWorld();
      return model?.outlinePoints() ?? [];
    });
  }

  private frame(towards: THREE.Vector3, points = this.outline()): void {
    this.enclosed = points;
    if (points.length === 0) return;
    const { position, target } = framed(this.camera, points, towards);
    this.camera.position.copy(position);
    this.controls.target.copy(target);
    this.controls.update();
    this.invalidate();
  }

  /** A named view goes back as the leaf moves out of the window, never nearer. */
  private keepInside(): void {
    const outside = this.outline().filter((point) => {
      const at = point.clone().project(this.camera);
      return Math.max(Math.abs(at.x), Math.abs(at.y)) > FILLED;
    });
    if (outside.length === 0) return;
    const kept =
      this.enclosed.length > kMostEnclosed ? this.enclosed.filter((_, i) => i % 2 === 0) : this.enclosed;
    this.frame(direction(VIEWS[this.view]!), [...kept, ...outside]);
  }

  /** Fewer pixels and plainer shadows where pictures take too long: SLOW in the median of some in a row. */
  private keepUp(now: number): void {
    const since = now - this.lastDrawn;
    this.lastDrawn = now;
    if (since < 500) this.intervals.push(since);
    if (since >= 500) ++this.verySlow;
    if (this.intervals.length + this.verySlow < 6) return;
    const median =
      this.verySlow > 2 ? 500 : this.intervals.sort((a, b) => a - b)[this.intervals.length >> 1]!;
    this.intervals = [];
    this.verySlow = 0;
    if (median < SLOW || this.level === LEVELS.length - 1) return;
    this.setLevel(this.level + 1);
  }

  private setLevel(level: number): void {
    this.level = level;
    const { pixels, shadow, blur } = LEVELS[level]!;
    const { map, mapPass } = this.key.shadow;
    map?.dispose();
    mapPass?.dispose();
    Object.assign(this.key.shadow, { map: null, mapPass: null });
    this.key.shadow.mapSize.set(shadow, shadow);
    this.key.shadow.blurSamples = blur;
    this.key.shadow.radius = (5 * shadow) / 1024;
    this.detail = FULL_DETAIL * pixels;
    this.invalidate();
  }
}
