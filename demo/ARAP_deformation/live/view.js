// What is drawn: the shape in the colors of its regions, marks, the gizmo; and what is where on
// the screen.
import * as THREE from 'three';
import { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js';
import { TransformControls } from 'three/examples/jsm/controls/TransformControls.js';

export { THREE };

// Packs the distance from the eye, as a share of the far plane, into three bytes.
const distanceMaterial = new THREE.ShaderMaterial({
  side: THREE.DoubleSide,
  uniforms: { far: { value: 1 } },
  vertexShader: `varying float depth; uniform float far;
    void main() {
      vec4 p = modelViewMatrix * vec4(position, 1.);
      depth = -p.z / far;
      gl_Position = projectionMatrix * p;
    }`,
  fragmentShader: `varying float depth;
    void main() {
      vec3 e = fract(depth * vec3(1., 255., 65025.));
      e.xy -= e.yz / 255.;
      gl_FragColor = vec4(e, 1.);
    }`,
});

function disc() {
  const canvas = document.createElement('canvas');
  canvas.width = canvas.height = 64;
  const context = canvas.getContext('2d');
  context.arc(32, 32, 26, 0, 7);
  context.fillStyle = '#fff';
  context.fill();
  context.lineWidth = 7;
  context.strokeStyle = '#333';
  context.stroke();
  return new THREE.CanvasTexture(canvas);
}

export class View {
  constructor(container) {
    this.container = container;
    this.renderer = new THREE.WebGLRenderer({ antialias: true, preserveDrawingBuffer: true });
    this.canvas = this.renderer.domElement;
    this.canvas.tabIndex = 0;
    this.canvas.setAttribute('role', 'img');
    this.canvas.setAttribute('aria-label', 'the shape');
    this.canvas.addEventListener('webglcontextrestored', () => this.moved());
    container.append(this.canvas);
    this.scene = new THREE.Scene();
    this.scene.background = new THREE.Color(0xeef1f5);
    this.camera = new THREE.PerspectiveCamera(35, 1, 0.01, 100);
    const light = new THREE.DirectionalLight(0xffffff, 2);
    light.position.set(0.5, 0.8, 1);
    this.camera.add(new THREE.HemisphereLight(0xffffff, 0x8a94a6, 1.5), light);
    this.scene.add(this.camera);
    this.material = new THREE.MeshStandardMaterial({
      vertexColors: true,
      side: THREE.DoubleSide,
      roughness: 0.62,
    });
    this.mesh = new THREE.Mesh(new THREE.BufferGeometry(), this.material);
    this.mesh.frustumCulled = false;
    this.inverted = new THREE.Mesh(
      new THREE.BufferGeometry(),
      new THREE.MeshBasicMaterial({
        color: 0xff00d4,
        side: THREE.DoubleSide,
        depthTest: false,
        transparent: true,
        opacity: 0.75,
      }),
    );
    this.inverted.frustumCulled = false;
    this.inverted.renderOrder = 2;
    this.marks = new THREE.Points(
      new THREE.BufferGeometry(),
      new THREE.PointsMaterial({
        sizeAttenuation: false,
        vertexColors: true,
        map: disc(),
        alphaTest: 0.4,
        depthTest: false,
        transparent: true,
      }),
    );
    this.marks.frustumCulled = false;
    this.marks.renderOrder = 3;
    this.scene.add(this.mesh, this.inverted, this.marks);
    this.proxy = new THREE.Object3D();
    this.scene.add(this.proxy);
    this.gizmo = new TransformControls(this.camera, this.canvas);
    this.gizmo.setSize(0.75);
    this.scene.add(this.gizmo.getHelper());
    this.gizmo.addEventListener('change', () => {
      this.isDirty = true;
    });
    this.up = 'z';
    this.makeOrbit();
    new ResizeObserver(() => this.resize()).observe(container);
    this.resize();
  }

  makeOrbit() {
    const target = this.orbit?.target;
    this.orbit?.dispose();
    this.camera.up.set(0, this.up === 'y' ? 1 : 0, this.up === 'z' ? 1 : 0);
    this.orbit = new OrbitControls(this.camera, this.canvas);
    if (target) this.orbit.target.copy(target);
    this.orbit.enableDamping = false;
    this.orbit.zoomToCursor = true; // where two fingers turn, there is no other way aside
    this.orbit.addEventListener('change', () => this.moved());
  }

  // what is drawn is elsewhere on the screen
  moved() {
    this.isDirty = true;
    this.lastScreen = null;
  }

  // whether a drag of the first button or finger turns the view
  letTurn(does) {
    this.orbit.mouseButtons.LEFT = does ? THREE.MOUSE.ROTATE : -1;
    this.orbit.touches.ONE = does ? THREE.TOUCH.ROTATE : -1;
  }

  // whether two fingers move the view as they zoom; else they turn it
  letMove(does) {
    this.orbit.touches.TWO = does ? THREE.TOUCH.DOLLY_PAN : THREE.TOUCH.DOLLY_ROTATE;
  }

  resize() {
    const { clientWidth: w, clientHeight: h } = this.container;
    if (!w || !h) return;
    const ratio = Math.min(devicePixelRatio, 2); // it changes when the page is zoomed
    this.renderer.setPixelRatio(ratio);
    this.renderer.setSize(w, h);
    this.marks.material.size = 15 * ratio;
    this.camera.aspect = w / h;
    this.camera.updateProjectionMatrix();
    this.moved();
  }

  setShape(points, faces) {
    this.mesh.geometry.dispose();
    const geometry = new THREE.BufferGeometry(),
      n = points.length / 3;
    geometry.setAttribute('position', new THREE.BufferAttribute(new Float32Array(points), 3));
    geometry.setAttribute(
      'color',
      new THREE.BufferAttribute(new Uint8Array(3 * n).fill(200), 3, true),
    );
    geometry.setIndex(new THREE.BufferAttribute(Uint32Array.from(faces), 1));
    this.faces = faces;
    this.mesh.geometry = geometry;
    this.isSmooth = n <= 60000;
    if (this.isSmooth) {
      geometry.setAttribute('normal', new THREE.BufferAttribute(new Float32Array(3 * n), 3));
      this.updateNormals();
      this.isSmooth = !this.hasSharpEdges();
    }
    this.material.flatShading = !this.isSmooth;
    this.material.needsUpdate = true;
    this.moved();
  }

  get positions() {
    return this.mesh.geometry.attributes.position.array;
  }

  // returns an array that is no longer used, of the same length
  setPositions(points) {
    const attribute = this.mesh.geometry.attributes.position,
      before = attribute.array;
    attribute.array = points;
    attribute.needsUpdate = true;
    this.updateNormals();
    this.moved();
    return before;
  }

  updateNormals() {
    if (!this.isSmooth) return;
    const p = this.positions,
      f = this.faces,
      attribute = this.mesh.geometry.attributes.normal,
      q = attribute.array;
    q.fill(0);
    for (let i = 0; i < f.length; i += 3) {
      const a = 3 * f[i],
        b = 3 * f[i + 1],
        c = 3 * f[i + 2];
      const ux = p[b] - p[a],
        uy = p[b + 1] - p[a + 1],
        uz = p[b + 2] - p[a + 2];
      const vx = p[c] - p[a],
        vy = p[c + 1] - p[a + 1],
        vz = p[c + 2] - p[a + 2];
      const x = uy * vz - uz * vy,
        y = uz * vx - ux * vz,
        z = ux * vy - uy * vx;
      q[a] += x;
      q[a + 1] += y;
      q[a + 2] += z;
      q[b] += x;
      q[b + 1] += y;
      q[b + 2] += z;
      q[c] += x;
      q[c + 1] += y;
      q[c + 2] += z;
    }
    for (let i = 0; i < q.length; i += 3) {
      const l = 1 / (Math.hypot(q[i], q[i + 1], q[i + 2]) || 1);
      q[i] *= l;
      q[i + 1] *= l;
      q[i + 2] *= l;
    }
    attribute.needsUpdate = true;
  }

  // whether many faces meet at an angle at which a mean of their normals looks wrong
  hasSharpEdges() {
    const p = this.positions,
      f = this.faces,
      q = this.mesh.geometry.attributes.normal.array;
    const at = (array, v) => new THREE.Vector3().fromArray(array, 3 * v);
    let sharp = 0;
    for (let i = 0; i < f.length; i += 3) {
      const [a, b, c] = [at(p, f[i]), at(p, f[i + 1]), at(p, f[i + 2])],
        normal = b.sub(a).cross(c.sub(a)).normalize();
      for (let k = 0; k < 3; ++k) sharp += normal.dot(at(q, f[i + k])) < 0.75;
    }
    return sharp > 0.02 * f.length;
  }

  // colorOf(vertex) returns a color as 0xrrggbb
  setColors(colorOf) {
    const attribute = this.mesh.geometry.attributes.color,
      c = attribute.array;
    for (let v = 0, i = 0; i < c.length; ++v) {
      const rgb = colorOf(v);
      c[i++] = linear[rgb >> 16];
      c[i++] = linear[(rgb >> 8) & 255];
      c[i++] = linear[rgb & 255];
    }
    attribute.needsUpdate = true;
    this.isDirty = true;
  }

  setMarks(points, colors) {
    this.marks.geometry.dispose();
    this.marks.geometry = new THREE.BufferGeometry();
    this.marks.geometry.setAttribute('position', new THREE.Float32BufferAttribute(points, 3));
    this.marks.geometry.setAttribute(
      'color',
      new THREE.Float32BufferAttribute(
        colors.flatMap((rgb) => new THREE.Color(rgb).toArray()),
        3,
      ),
    );
    this.marks.visible = points.length > 0;
    this.isDirty = true;
  }

  // faces of inverted tetrahedra, corner by corner
  setInverted(corners) {
    this.inverted.visible = corners.length > 0;
    if (!corners.length) return;
    this.inverted.geometry.dispose();
    this.inverted.geometry = new THREE.BufferGeometry();
    this.inverted.geometry.setAttribute('position', new THREE.Float32BufferAttribute(corners, 3));
  }

  fit() {
    const box = new THREE.Box3().setFromArray(this.positions);
    const sphere = box.getBoundingSphere(new THREE.Sphere());
    this.radius = sphere.radius || 1;
    const direction = (
      this.up === 'z' ? new THREE.Vector3(0.45, -0.85, 0.32) : new THREE.Vector3(0.45, 0.32, 0.85)
    ).normalize();
    // so far that each corner of the box is in the picture, with a margin
    const right = new THREE.Vector3().crossVectors(this.camera.up, direction).normalize(),
      up = new THREE.Vector3().crossVectors(direction, right);
    const high = 0.8 * Math.tan((this.camera.fov * Math.PI) / 360),
      wide = high * this.camera.aspect;
    let distance = 1e-3 * this.radius;
    for (let k = 0; k < 8; ++k) {
      const c = new THREE.Vector3(
        ...['x', 'y', 'z'].map((axis, i) => ((k >> i) & 1 ? box.max : box.min)[axis]),
      ).sub(sphere.center);
      distance = Math.max(
        distance,
        c.dot(direction) + Math.max(Math.abs(c.dot(right)) / wide, Math.abs(c.dot(up)) / high),
      );
    }
    this.camera.position.copy(sphere.center).addScaledVector(direction, distance);
    this.camera.near = distance / 100;
    this.camera.far = distance * 20;
    this.camera.updateProjectionMatrix();
    this.orbit.target.copy(sphere.center);
    this.orbit.update();
    this.camera.updateMatrixWorld();
    this.moved();
  }

  render() {
    this.isDirty = false;
    this.renderer.render(this.scene, this.camera);
  }

  // in pixels of the page, relative to the canvas
  toScreen(x, y, z) {
    const p = new THREE.Vector3(x, y, z).project(this.camera);
    return [
      ((p.x + 1) / 2) * this.container.clientWidth,
      ((1 - p.y) / 2) * this.container.clientHeight,
    ];
  }

  ray(x, y) {
    const caster = new THREE.Raycaster(),
      w = this.container.clientWidth,
      h = this.container.clientHeight;
    caster.setFromCamera(new THREE.Vector2((2 * x) / w - 1, 1 - (2 * y) / h), this.camera);
    return caster;
  }

  // where the vertices are on the screen, and which are seen
  screen() {
    return (this.lastScreen ??= this.newScreen());
  }

  newScreen() {
    const w = this.container.clientWidth,
      h = this.container.clientHeight,
      far = this.camera.far;
    const target = new THREE.WebGLRenderTarget(w, h),
      pixels = new Uint8Array(4 * w * h);
    distanceMaterial.uniforms.far.value = far;
    this.mesh.material = distanceMaterial;
    const color = this.renderer.getClearColor(new THREE.Color()).clone(),
      alpha = this.renderer.getClearAlpha();
    this.renderer.setRenderTarget(target);
    this.renderer.setClearColor(0xffffff, 1);
    this.renderer.clear();
    this.camera.updateMatrixWorld();
    this.renderer.render(this.mesh, this.camera);
    this.renderer.readRenderTargetPixels(target, 0, 0, w, h, pixels);
    this.renderer.setRenderTarget(null);
    this.renderer.setClearColor(color, alpha);
    this.mesh.material = this.material;
    target.dispose();
    const distance = (x, y) => {
      if (x < 0 || y < 0 || x >= w || y >= h) return -1;
      const i = 4 * ((h - 1 - y) * w + x);
      return (far * (pixels[i] + pixels[i + 1] / 255 + pixels[i + 2] / 65025)) / 255;
    };
    const p = this.positions,
      n = p.length / 3,
      xs = new Float32Array(n),
      ys = new Float32Array(n),
      seen = new Uint8Array(n);
    const m = new THREE.Matrix4().multiplyMatrices(
      this.camera.projectionMatrix,
      this.camera.matrixWorldInverse,
    ).elements;
    const tolerance = 0.012 * this.radius;
    for (let v = 0; v < n; ++v) {
      const x = p[3 * v],
        y = p[3 * v + 1],
        z = p[3 * v + 2],
        s = m[3] * x + m[7] * y + m[11] * z + m[15];
      xs[v] = (((m[0] * x + m[4] * y + m[8] * z + m[12]) / s + 1) / 2) * w;
      ys[v] = ((1 - (m[1] * x + m[5] * y + m[9] * z + m[13]) / s) / 2) * h;
      const i = Math.floor(xs[v]),
        j = Math.floor(ys[v]); // s is the distance along the view
      for (let k = 0; k < 9 && !seen[v]; ++k)
        seen[v] = s > 0 && s <= distance(i + (k % 3) - 1, j + Math.floor(k / 3) - 1) + tolerance;
    }
    const isOn = (x, y) => distance(Math.floor(x), Math.floor(y)) < 0.99 * far;
    return { xs, ys, seen, isOn };
  }
}

// the colors of the page in the space in which three.js computes
const linear = Uint8Array.from({ length: 256 }, (_, i) =>
  Math.round(255 * new THREE.Color(`rgb(${i},${i},${i})`).r),
);
