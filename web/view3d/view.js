// The 3-D view: draws what the page hands it in typed arrays, and tells what was picked. It knows no document and computes no
// photogrammetry. Coordinates come about the object's middle, Z up.
//
// open(host, tell) puts two canvases into the host, WebGL below and text above, and throws where there is no WebGL. What it gives has
// show(scene), state(options), look(name), picture(lines), counts(), close().
import {
  AmbientLight, BufferAttribute, BufferGeometry, Color, DirectionalLight, DynamicDrawUsage, Group, IcosahedronGeometry, InstancedMesh, LineBasicMaterial, Matrix4,
  MeshLambertMaterial, OrthographicCamera, PerspectiveCamera, Points, Scene, ShaderMaterial, Vector3, WebGLRenderer,
} from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';

import { POINT_SHADER, edges, grid, line, parts, segments, sheet, spread, surface, token } from './things.js';
import { words } from './words.js';

/** A frame may take this long while the view moves: thirty a second. */
const FRAME = 1000 / 30;
/** Ellipsoids at rest. */
const MOST_ELLIPSOIDS = 4000;

const VIEWS = { home: [1, -1.35, 0.95], top: [0, 0, 1], front: [0, -1, 0], right: [1, 0, 0] };

/** Whether a processor draws in place of a graphics card: smooth edges would cost it four times the pixels. */
function drawnBySoftware() {
  const probe = document.createElement('canvas').getContext('webgl2');
  const names = probe?.getExtension('WEBGL_debug_renderer_info');
  const name = names ? probe.getParameter(names.UNMASKED_RENDERER_WEBGL) : '';
  probe?.getExtension('WEBGL_lose_context')?.loseContext();
  return /swiftshader|llvmpipe|software/i.test(name);
}

export function open(host, tell) {
  const software = drawnBySoftware();
  const canvas = host.appendChild(document.createElement('canvas'));
  const above = host.appendChild(document.createElement('canvas'));
  canvas.className = 'object-gl';
  above.className = 'object-text';
  let renderer;
  try {
    renderer = new WebGLRenderer({ canvas, antialias: !software });
  } catch (error) {
    canvas.remove();
    above.remove();
    throw error;
  }
  const pen = above.getContext('2d');
  const world = new Scene();
  world.add(new AmbientLight(0xffffff, 1.6));
  const lamp = new DirectionalLight(0xffffff, 1.8);
  world.add(lamp);
  const perspective = new PerspectiveCamera(40, 1, 0.01, 1e6);
  const orthographic = new OrthographicCamera(-1, 1, 1, -1, -1e6, 1e6);
  for (const each of [perspective, orthographic]) each.up.set(0, 0, 1);
  let camera = perspective;
  const controls = new OrbitControls(camera, above);
  Object.assign(controls, { enableDamping: false, zoomToCursor: true, screenSpacePanning: true, zoomSpeed: 1.2 });

  let scene;
  let group;
  let options = {
    selected: -1, photo: -1, names: true, ellipsoids: true, photos: true, rays: true, features: true, deviations: true, grid: true, perspective: true, factor: 1, sticks: 1, chosen: [],
  };
  let made = {};
  let width = 1;
  let height = 1;
  let ratio = 1;
  let dirty = true;
  let budget = software ? 400 : MOST_ELLIPSOIDS;
  let quality = 1;
  let bare = 0;
  let good = 0;
  let lastFrame = 0;
  let moving = 0;
  let closed = false;
  let drawn = { ellipsoids: 0, names: 0, frames: 0, time: 0 };
  let shownNames = [];

  const invalidate = () => {
    dirty = true;
  };

  // ---- what is drawn ----

  function release() {
    if (!group) return;
    group.traverse((thing) => {
      thing.geometry?.dispose();
      for (const material of [thing.material].flat().filter(Boolean)) {
        material.map?.dispose();
        material.dispose();
      }
      thing.dispose?.();
    });
    world.remove(group);
    group = undefined;
    made = {};
  }

  function build() {
    release();
    if (!scene) return;
    group = new Group();
    const count = scene.points.length / 3;
    if (count) {
      const geometry = new BufferGeometry();
      geometry.setAttribute('position', new BufferAttribute(scene.points, 3));
      geometry.setAttribute('tint', new BufferAttribute(new Float32Array(3 * count), 3));
      geometry.setAttribute('size', new BufferAttribute(new Float32Array(count), 1));
      // Thinned out evenly: every so many, in an order that any beginning of it covers the object.
      made.order = spread(count);
      geometry.setIndex(new BufferAttribute(made.order, 1));
      made.points = new Points(geometry, new ShaderMaterial({ ...POINT_SHADER, uniforms: { ratio: { value: 1 } } }));
      made.points.frustumCulled = false;
      group.add(made.points);
    }
    if (scene.ellipsoids.length) {
      const most = Math.min(count, MOST_ELLIPSOIDS);
      const material = new MeshLambertMaterial({ transparent: true, opacity: 0.55 });
      made.ellipsoids = new InstancedMesh(new IcosahedronGeometry(1, most > 1500 ? 0 : most > 300 ? 1 : 2), material, most);
      made.ellipsoids.instanceMatrix.setUsage(DynamicDrawUsage);
      made.ellipsoids.frustumCulled = false;
      group.add(made.ellipsoids);
    }
    if (scene.photos.length) {
      made.frusta = segments(edges(scene), line(token('--edge')));
      made.sheet = sheet(scene);
      made.cameras = new Group();
      made.cameras.add(made.frusta, made.sheet);
      group.add(made.cameras);
    }
    made.grid = grid(scene);
    group.add(made.grid);
    made.lines = segments(scene.lines, new LineBasicMaterial({ vertexColors: true }));
    made.lines.geometry.setAttribute('color', new BufferAttribute(new Float32Array(scene.lines.length), 3));
    made.distances = segments(scene.distances, line(token('--ink')));
    made.residuals = segments(new Float32Array(scene.residuals.length), line(token('--bad')));
    made.forms = segments(scene.forms, line(token('--accent')));
    made.surfaces = surface(scene.surfaces, 0.12);
    made.chosenSurface = surface(scene.chosenSurface, 0.3);
    made.sticks = segments(new Float32Array(scene.sticks.length), new LineBasicMaterial({ vertexColors: true }));
    made.sticks.geometry.setAttribute('color', new BufferAttribute(new Float32Array(scene.sticks.length), 3));
    made.rays = segments(new Float32Array(0), line(token('--accent'), 0.8));
    for (const name of ['lines', 'distances', 'residuals', 'forms', 'surfaces', 'chosenSurface', 'sticks', 'rays']) {
      made[name].frustumCulled = false;
      group.add(made[name]);
    }
    world.add(group);
    paint();
  }

  // ---- how it looks ----

  function paint() {
    renderer.setClearColor(new Color(token('--paper')), 1);
    if (!group) return invalidate();
    const colours = { role: [token('--data-a'), token('--ink'), token('--pass')].map(parts), doubt: parts(token('--warn')), chosen: parts(token('--accent')), b: parts(token('--data-b')) };
    if (made.points) {
      const { tint, size } = made.points.geometry.attributes;
      const chosen = new Set(options.chosen);
      const many = scene.roles.length > 2000;
      for (let k = 0; k < scene.roles.length; k++) {
        const role = scene.roles[k] & 3;
        const is = chosen.has(k) || k === options.selected;
        tint.array.set(is ? colours.chosen : scene.roles[k] & 4 ? colours.doubt : colours.role[role], 3 * k);
        size.array[k] = is ? 9 : role ? 8 : many ? 4 : 6;
      }
      tint.needsUpdate = size.needsUpdate = true;
    }
    if (made.ellipsoids) made.ellipsoids.material.color.set(token('--data-a'));
    made.frusta?.material.color.set(token('--edge'));
    made.grid.material.color.set(token('--line'));
    made.distances.material.color.set(token('--ink'));
    made.residuals.material.color.set(token('--bad'));
    made.forms.material.color.set(token('--accent'));
    made.surfaces.material.color.set(token('--edge'));
    made.chosenSurface.material.color.set(token('--accent'));
    made.rays.material.color.set(token('--accent'));
    const ink = new Color(token('--ink'));
    const lineColours = made.lines.geometry.attributes.color;
    for (let k = 0; k < scene.lines.length / 6; k++) {
      const [r, g, b] = scene.lineColours.subarray(3 * k, 3 * k + 3);
      const colour = r + g + b ? new Color(r / 255, g / 255, b / 255).convertSRGBToLinear() : ink;
      for (const end of [0, 3]) lineColours.array.set([colour.r, colour.g, colour.b], 6 * k + end);
    }
    lineColours.needsUpdate = true;
    vectors(made.residuals, scene.residuals);
    vectors(made.sticks, scene.sticks);
    const stickColours = made.sticks.geometry.attributes.color;
    const [outside, inside] = [new Color(token('--data-a')), new Color(token('--data-b'))];
    for (let k = 0; k < scene.stickSigns.length; k++) {
      const { r, g, b } = scene.stickSigns[k] < 0 ? inside : outside;
      stickColours.array.set([r, g, b, r, g, b], 6 * k);
    }
    stickColours.needsUpdate = true;
    const show = { ellipsoids: options.ellipsoids, cameras: options.photos, grid: options.grid, forms: options.features, surfaces: options.features, chosenSurface: options.features, distances: options.features, sticks: options.deviations, residuals: options.deviations, rays: options.rays };
    for (const [name, on] of Object.entries(show)) if (made[name]) made[name].visible = on;
    rays();
    swell();
    invalidate();
  }

  /** Vectors from their places, as long as the exaggeration makes them. */
  function vectors(into, from) {
    const { position } = into.geometry.attributes;
    for (let k = 0; k < from.length; k += 6) {
      for (let axis = 0; axis < 3; axis++) {
        position.array[k + axis] = from[k + axis];
        position.array[k + 3 + axis] = from[k + axis] + options.sticks * from[k + 3 + axis];
      }
    }
    position.needsUpdate = true;
  }

  function rays() {
    const ends = [];
    const centre = (photo) => scene.photos.subarray(15 * photo, 15 * photo + 3);
    const ray = (point, photo) => ends.push(...scene.points.subarray(3 * point, 3 * point + 3), ...centre(photo));
    const k = options.selected;
    if (k >= 0) for (let n = scene.rayStart[k]; n < scene.rayStart[k + 1]; n++) ray(k, scene.rayPhotos[n]);
    made.rays.geometry.dispose();
    made.rays.geometry = new BufferGeometry();
    made.rays.geometry.setAttribute('position', new BufferAttribute(Float32Array.from(ends), 3));
  }

  /** The ellipsoids at their exaggeration: the chosen ones first, then as many as the frame has time for. */
  function swell() {
    const mesh = made.ellipsoids;
    if (!mesh) return;
    const matrix = new Matrix4();
    const most = Math.min(mesh.instanceMatrix.count, made.order.length);
    const put = (slot, k) => {
      const [a, b, c, d, e, f, g, h, i] = scene.ellipsoids.subarray(9 * k, 9 * k + 9);
      const s = options.factor;
      matrix.set(a * s, d * s, g * s, scene.points[3 * k], b * s, e * s, h * s, scene.points[3 * k + 1], c * s, f * s, i * s, scene.points[3 * k + 2], 0, 0, 0, 1);
      mesh.setMatrixAt(slot, matrix);
    };
    let slot = 0;
    const first = options.selected >= 0 ? [options.selected] : [];
    for (const k of first) put(slot++, k);
    for (let n = 0; slot < most; n++) {
      if (n >= made.order.length) break;
      if (!first.includes(made.order[n])) put(slot++, made.order[n]);
    }
    made.filled = slot;
    mesh.instanceMatrix.needsUpdate = true;
  }

  // ---- where it is seen from ----

  const box = () => [new Vector3(...scene.box.slice(0, 3)), new Vector3(...scene.box.slice(3, 6))];

  /** All of the object, and the photos where they are shown, from a direction. */
  function look(name) {
    if (!scene) return;
    const direction = name === 'fit' ? camera.position.clone().sub(controls.target) : new Vector3(...(VIEWS[name] ?? VIEWS.home));
    if (name === 'along' && options.along) direction.set(...options.along);
    direction.normalize();
    const places = [];
    const take = (array, stride, most) => {
      const by = Math.max(1, Math.floor(array.length / stride / most));
      for (let k = 0; k < array.length; k += stride * by) places.push(new Vector3(array[k], array[k + 1], array[k + 2]));
    };
    take(scene.points, 3, 4000);
    if (options.photos) take(scene.photos, 3, 4000);
    if (options.grid) take(made.grid.geometry.attributes.position.array, 3, 400);
    if (!places.length) places.push(...box());
    const middle = places.reduce((sum, p) => sum.add(p), new Vector3()).divideScalar(places.length);
    const up = Math.abs(direction.z) > 0.999 ? new Vector3(0, 1, 0) : new Vector3(0, 0, 1);
    const right = up.clone().cross(direction).normalize();
    const upwards = direction.clone().cross(right);
    // The box of all places across the direction, and the distance at which the nearest still are inside.
    const range = (axis) => {
      const all = places.map((p) => p.dot(axis));
      return [all.reduce((a, b) => Math.min(a, b)), all.reduce((a, b) => Math.max(a, b))];
    };
    const [[l, r], [b, t]] = [range(right), range(upwards)];
    const target = middle.clone().addScaledVector(right, (l + r) / 2 - middle.dot(right)).addScaledVector(upwards, (b + t) / 2 - middle.dot(upwards));
    const aspect = width / height;
    const tangent = Math.tan((perspective.fov * Math.PI) / 360) * 0.9;
    let distance = 1e-6 * scene.size;
    for (const p of places) {
      const d = p.clone().sub(target);
      distance = Math.max(distance, d.dot(direction) + Math.abs(d.dot(upwards)) / tangent, d.dot(direction) + Math.abs(d.dot(right)) / (tangent * aspect));
    }
    const half = Math.max((t - b) / 2, (r - l) / 2 / aspect, 1e-6 * scene.size) / 0.9;
    controls.target.copy(target);
    for (const each of [perspective, orthographic]) each.position.copy(target).addScaledVector(direction, Math.max(distance, scene.size * 0.05));
    orthographic.zoom = 1;
    Object.assign(orthographic, { top: half, bottom: -half, left: -half * aspect, right: half * aspect });
    fitPlanes();
    controls.update();
    invalidate();
  }

  function fitPlanes() {
    const distance = perspective.position.distanceTo(controls.target);
    const reach = distance + 20 * scene.size;
    Object.assign(perspective, { near: Math.max(distance * 1e-3, 1e-9), far: reach, aspect: width / height });
    Object.assign(orthographic, { near: -reach, far: reach });
    perspective.updateProjectionMatrix();
    orthographic.updateProjectionMatrix();
  }

  /** The other way of seeing, from the same place and as large at the target. */
  function project(on) {
    const next = on ? perspective : orthographic;
    if (next === camera) return;
    const direction = camera.position.clone().sub(controls.target).normalize();
    const tangent = Math.tan((perspective.fov * Math.PI) / 360);
    if (on) {
      const half = orthographic.top / orthographic.zoom;
      perspective.position.copy(controls.target).addScaledVector(direction, half / tangent);
    } else {
      const half = camera.position.distanceTo(controls.target) * tangent;
      orthographic.position.copy(camera.position);
      orthographic.zoom = 1;
      Object.assign(orthographic, { top: half, bottom: -half, left: (-half * width) / height, right: (half * width) / height });
    }
    camera = next;
    controls.object = camera;
    if (scene) fitPlanes();
    controls.update();
    invalidate();
  }

  function resize() {
    const [w, h] = [host.clientWidth, host.clientHeight];
    if (!w || !h) return;
    const first = width === 1;
    const half = orthographic.top;
    [width, height, ratio] = [w, h, Math.min(devicePixelRatio || 1, 2)];
    renderer.setPixelRatio(ratio * (moving ? quality : 1));
    renderer.setSize(w, h, false);
    above.width = Math.round(w * ratio);
    above.height = Math.round(h * ratio);
    Object.assign(orthographic, { left: (-half * w) / h, right: (half * w) / h });
    if (scene) {
      if (first) look('home');
      else fitPlanes();
    }
    invalidate();
  }

  // ---- text above ----

  const projected = new Vector3();
  function screen(x, y, z) {
    projected.set(x, y, z).project(camera);
    return projected.z < -1 || projected.z > 1 ? undefined : [((projected.x + 1) / 2) * width, ((1 - projected.y) / 2) * height];
  }

  /** Length of a pixel at the target. */
  const perPixel = () =>
    camera === perspective ? (2 * camera.position.distanceTo(controls.target) * Math.tan((perspective.fov * Math.PI) / 360)) / height : (orthographic.top - orthographic.bottom) / orthographic.zoom / height;

  function write() {
    pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    pen.clearRect(0, 0, width, height);
    if (!scene) return;
    const family = getComputedStyle(host).fontFamily;
    shownNames = words(pen, { scene, options, order: made.order, quick: moving && bare, screen, camera, perPixel, width, height, family });
    drawn.names = shownNames.length;
  }

  // ---- frames ----

  function frame(time) {
    if (closed) return;
    request = requestAnimationFrame(frame);
    if (moving && time - lastFrame > 0 && lastFrame) adapt(time - lastFrame);
    lastFrame = moving ? time : 0;
    // A move that is not drawn yet comes first, thinned out: where frames are slow, all of it between two moves would keep them slow.
    if (moving && !dirty && time > moving + 250) rest();
    if (!dirty) return;
    dirty = false;
    render();
  }

  /** Photos that stand before the object become outlines. */
  function outlines() {
    if (!made.sheet || !options.photos) return;
    const { index } = made.sheet.geometry;
    const place = made.sheet.geometry.attributes.position.array;
    const [low, high] = box();
    const corners = [0, 1, 2, 3, 4, 5, 6, 7].map((k) => screen(k & 1 ? high.x : low.x, k & 2 ? high.y : low.y, k & 4 ? high.z : low.z)).filter(Boolean);
    if (corners.length < 8) return;
    const range = [0, 1].map((axis) => [Math.min(...corners.map((c) => c[axis])), Math.max(...corners.map((c) => c[axis]))]);
    const middle = low.add(high).multiplyScalar(0.5);
    const far = camera.position.distanceTo(middle);
    const shown = [];
    for (let k = 0; k < place.length / 12; k++) {
      const ends = [0, 1, 2, 3].map((c) => screen(...place.subarray(12 * k + 3 * c, 12 * k + 3 * c + 3)));
      const before = camera.position.distanceTo(projected.set(...place.subarray(12 * k, 12 * k + 3))) < far;
      const over = ends.every(Boolean) && [0, 1].every((axis) => Math.max(...ends.map((e) => e[axis])) > range[axis][0] && Math.min(...ends.map((e) => e[axis])) < range[axis][1]);
      if (!(before && over)) shown.push(k);
    }
    const key = shown.join();
    if (key === made.outlined) return;
    made.outlined = key;
    shown.forEach((k, n) => index.array.set([0, 1, 2, 0, 2, 3].map((c) => 4 * k + c), 6 * n));
    index.needsUpdate = true;
    made.sheet.geometry.setDrawRange(0, 6 * shown.length);
  }

  function render() {
    camera.updateMatrixWorld();
    outlines();
    if (made.ellipsoids) {
      made.ellipsoids.count = Math.min(made.filled ?? 0, moving ? budget : MOST_ELLIPSOIDS);
      drawn.ellipsoids = made.ellipsoids.visible ? made.ellipsoids.count : 0;
    }
    if (made.points) {
      made.points.material.uniforms.ratio.value = ratio * (moving ? quality : 1);
      made.points.geometry.setDrawRange(0, moving && bare > 1 ? Math.max(2000, made.order.length >> 2) : Infinity);
    }
    if (made.sheet) made.sheet.visible = !(moving && bare > 1);
    lamp.position.copy(camera.position);
    const began = performance.now();
    renderer.render(world, camera);
    write();
    drawn.frames += 1;
    drawn.time += performance.now() - began;
  }

  /** While it moves: fewer ellipsoids, then coarser pixels, then no names, then fewer points and frusta without photos, until thirty frames
      a second are reached; more again where there is time. */
  function adapt(took) {
    if (took > FRAME * 1.1) {
      good = 0;
      if (budget > 100) budget = Math.max(100, Math.floor(budget * Math.max(0.2, Math.min(0.8, FRAME / took))));
      else if (quality > 0.5) sharpen(quality - 0.125);
      else bare = Math.min(2, bare + 1);
    } else if (took < FRAME * 0.6 && ++good > 10) {
      good = 0;
      if (bare) bare -= 1;
      else if (quality < 1) sharpen(quality + 0.125);
      else budget = Math.min(MOST_ELLIPSOIDS, Math.ceil(budget * 1.3));
    }
  }

  function sharpen(to) {
    quality = Math.min(1, Math.max(0.5, to));
    renderer.setPixelRatio(ratio * quality);
  }

  function rest() {
    moving = 0;
    renderer.setPixelRatio(ratio);
    invalidate();
  }

  function moved() {
    if (!moving && quality < 1) renderer.setPixelRatio(ratio * quality);
    moving = performance.now();
    invalidate();
  }

  // ---- hands ----

  const near = (place, x, y) => place && Math.hypot(place[0] - x, place[1] - y);

  function pick(x, y, reach) {
    let best = [reach, undefined];
    for (let k = 0; k < scene.points.length / 3; k++) {
      const place = screen(scene.points[3 * k], scene.points[3 * k + 1], scene.points[3 * k + 2]);
      const distance = near(place, x, y);
      if (distance < best[0]) best = [distance, { kind: 'point', index: k }];
    }
    if (best[1] || !options.photos) return best[1];
    let nearest = Infinity;
    for (let k = 0; k < scene.photos.length / 15; k++) {
      const corners = [1, 2, 3, 4].map((c) => screen(...scene.photos.subarray(15 * k + 3 * c, 15 * k + 3 * c + 3))).filter(Boolean);
      if (corners.length < 4 || !inside(corners, x, y)) continue;
      const depth = camera.position.distanceTo(projected.set(...scene.photos.subarray(15 * k + 3, 15 * k + 6)));
      if (depth < nearest) [nearest, best] = [depth, [0, { kind: 'photo', index: k }]];
    }
    return best[1];
  }

  const inside = (corners, x, y) => {
    let sign = 0;
    for (let k = 0; k < 4; k++) {
      const [[a, b], [c, d]] = [corners[k], corners[(k + 1) % 4]];
      const side = Math.sign((c - a) * (y - b) - (d - b) * (x - a));
      if (sign && side && side !== sign) return false;
      sign ||= side;
    }
    return true;
  };

  let pressed;
  const down = (event) => {
    pressed = [event.offsetX, event.offsetY];
  };
  const up = (event) => {
    if (!pressed || !scene || event.button !== 0 || Math.hypot(event.offsetX - pressed[0], event.offsetY - pressed[1]) > 4) return;
    const found = pick(event.offsetX, event.offsetY, event.pointerType === 'touch' ? 22 : 12);
    tell(found?.kind ?? 'nothing', found?.index ?? -1, event.shiftKey || event.ctrlKey || event.metaKey);
  };

  /** Arrows turn, with Shift they move; plus and minus zoom. */
  const key = (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || !scene) return;
    const turn = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[event.key];
    const zoom = { '+': 0.8, '=': 0.8, '-': 1.25, _: 1.25 }[event.key];
    if (!turn && !zoom) return;
    event.preventDefault();
    event.stopPropagation();
    const arm = camera.position.clone().sub(controls.target);
    if (zoom) {
      if (camera === orthographic) orthographic.zoom /= zoom;
      else arm.multiplyScalar(zoom);
    } else if (event.shiftKey) {
      const step = perPixel() * 40;
      const [right, upwards] = [new Vector3().setFromMatrixColumn(camera.matrix, 0), new Vector3().setFromMatrixColumn(camera.matrix, 1)];
      controls.target.addScaledVector(right, turn[0] * step).addScaledVector(upwards, turn[1] * step);
    } else {
      arm.applyAxisAngle(camera.up, -turn[0] * 0.12);
      const side = new Vector3().setFromMatrixColumn(camera.matrix, 0);
      const lifted = arm.clone().applyAxisAngle(side, -turn[1] * 0.12);
      if (Math.abs(lifted.clone().normalize().z) < 0.999) arm.copy(lifted);
    }
    camera.position.copy(controls.target).add(arm);
    fitPlanes();
    controls.update();
    moved();
  };

  controls.addEventListener('change', () => {
    if (scene) fitPlanes();
    moved();
  });
  above.addEventListener('pointerdown', down);
  above.addEventListener('pointerup', up);
  host.addEventListener('keydown', key);
  const lost = (event) => {
    event.preventDefault();
    if (!closed) tell('lost', -1, false);
  };
  canvas.addEventListener('webglcontextlost', lost);
  const watch = new ResizeObserver(resize);
  watch.observe(host);
  let request = requestAnimationFrame(frame);
  resize();

  return {
    show(next) {
      const again = scene && scene.key === next.key;
      scene = next;
      build();
      if (!again) look('home');
    },
    state(next) {
      options = { ...options, ...next };
      project(options.perspective);
      paint();
    },
    look,
    /** Where a point is drawn, by its number or its name: for tests and for what is put beside it. */
    place(point) {
      const k = typeof point === 'string' ? scene?.names.indexOf(point) : point;
      return scene && screen(scene.points[3 * k], scene.points[3 * k + 1], scene.points[3 * k + 2]);
    },
    /** Where the corners of a photo are drawn. */
    sheet: (k) => scene && [1, 2, 3, 4].map((c) => screen(...scene.photos.subarray(15 * k + 3 * c, 15 * k + 3 * c + 3))),
    counts: () => ({ ...drawn, surfaces: scene ? (scene.surfaces.length + scene.chosenSurface.length) / 9 : 0, residuals: scene ? scene.residuals.length / 6 : 0, points: scene ? scene.points.length / 3 : 0, photos: scene ? scene.photos.length / 15 : 0, budget, quality, bare }),
    labels: () => shownNames.map(({ words, box: place }) => ({ words, box: place })),
    /** The view with its caption as a PNG. */
    async picture(lines) {
      moving = 0;
      render();
      const sheetOf = document.createElement('canvas');
      const margin = (22 + 16 * lines.length) * ratio;
      sheetOf.width = above.width;
      sheetOf.height = above.height + margin;
      const draw = sheetOf.getContext('2d');
      draw.fillStyle = token('--paper');
      draw.fillRect(0, 0, sheetOf.width, sheetOf.height);
      draw.drawImage(canvas, 0, 0, above.width, above.height);
      draw.drawImage(above, 0, 0);
      draw.setTransform(ratio, 0, 0, ratio, 0, 0);
      draw.fillStyle = token('--ink');
      for (const [k, words] of lines.entries()) {
        draw.font = `${k ? 400 : 600} 12px ${getComputedStyle(host).fontFamily}`;
        draw.fillText(words, 12, height + 18 + 16 * k);
      }
      return new Promise((resolve) => sheetOf.toBlob(resolve, 'image/png'));
    },
    close() {
      closed = true;
      cancelAnimationFrame(request);
      watch.disconnect();
      controls.dispose();
      above.removeEventListener('pointerdown', down);
      above.removeEventListener('pointerup', up);
      host.removeEventListener('keydown', key);
      release();
      scene = undefined;
      renderer.dispose();
      renderer.forceContextLoss();
      canvas.width = canvas.height = above.width = above.height = 0;
      canvas.remove();
      above.remove();
    },
  };
}
