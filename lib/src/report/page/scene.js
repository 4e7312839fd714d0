// Camera, points, set-ups and links in one scene.

// Set-ups and links lie within the cloud: its points do not hide them.
const onTop = look => new THREE.MeshBasicMaterial({...look, depthTest: false, depthWrite: false});

class CloudView {
  constructor(canvas, data) {
    this.data = data;
    this.canvas = canvas;
    this.renderer = new THREE.WebGLRenderer({canvas, antialias: true, preserveDrawingBuffer: true});
    this.renderer.setClearColor(0xf4f6f8);
    this.scene = new THREE.Scene();
    this.camera = new THREE.PerspectiveCamera(45, 1, 0.1, 1000);
    this.camera.up.set(0, 0, 1);
    this.controls = new THREE.OrbitControls(this.camera, canvas);
    this.controls.enableKeys = false;  // arrow keys scroll the page
    this.controls.addEventListener('change', () => this.draw());
    this.group = 0;
    this.clouds = data.scans.map(scan => pointsOf(scan, data));
    this.clouds.forEach(cloud => this.scene.add(cloud));
    this.setups = this.makeSetups();
    this.lines = this.makeLines();
    this.marks = new THREE.Group();
    this.scene.add(this.marks);
    this.pointSize = 1;
    this.mode = kByScan;
    this.registered = true;
    this.selected = null;
    this.look('oblique');
  }

  // Each group has a frame of its own; they are shown one at a time.
  boxOf(group) {
    return this.data.groups[group].box.map(corner => new THREE.Vector3(...corner));
  }

  reachOf(group) {
    const [low, high] = this.boxOf(group);
    return Math.max(high.distanceTo(low), 1e-3);
  }

  makeSetups() {
    const group = new THREE.Group();
    for (const scan of this.data.scans) {
      if (!scan.count) continue;
      const size = this.reachOf(scan.group) / 140;
      const ball = scan.setup ? new THREE.ConeGeometry(0.8 * size, 2 * size, 12).rotateX(-Math.PI / 2)
                              : new THREE.SphereGeometry(0.7 * size, 12, 8);
      const mark = new THREE.Mesh(ball, onTop({color: scan.colour}));
      const rim = new THREE.Mesh(ball, onTop({color: 0x1c2733, side: THREE.BackSide}));
      rim.scale.setScalar(1.3);
      rim.renderOrder = 2;
      mark.renderOrder = 3;
      mark.add(rim);
      mark.position.copy(placeOf(scan));
      mark.userData.scan = scan;
      group.add(mark);
    }
    this.scene.add(group);
    return group;
  }

  makeLines() {
    const group = new THREE.Group(), colours = {accepted: 0x1a7f37, doubtful: 0xd08700, rejected: 0xc62828};
    const rod = new THREE.CylinderGeometry(1, 1, 1, 6, 1).rotateX(Math.PI / 2);  // lines are one pixel wide at most
    this.data.links.forEach((link, number) => {
      const ends = [placeOf(this.data.scans[link.a]), placeOf(this.data.scans[link.b])];
      const line = new THREE.Mesh(rod, onTop({color: colours[link.verdict] || 0x6b7885}));
      const width = this.reachOf(this.data.scans[link.a].group) / 900;
      line.position.addVectors(ends[0], ends[1]).multiplyScalar(0.5);
      line.lookAt(ends[1]);
      line.scale.set(width, width, Math.max(ends[0].distanceTo(ends[1]), 1e-6));
      line.renderOrder = 1;
      line.userData = {link: number, ends};
      group.add(line);
    });
    this.scene.add(group);
    return group;
  }

  look(from) {
    const directions = {oblique: [-0.55, -0.75, 0.62], top: [0, -0.0005, 1], side: [0, -1, 0.06]};
    const box = this.registered ? this.boxOf(this.group) : this.inputBox();
    const middle = box[0].clone().add(box[1]).multiplyScalar(0.5), reach = Math.max(box[1].distanceTo(box[0]), 1e-3);
    const towards = new THREE.Vector3(...directions[from]).normalize();
    const spare = from === 'oblique' ? 0.82 : 1.02;  // the box's corners are empty, seen obliquely
    this.controls.target.copy(middle);
    this.camera.position.copy(middle).addScaledVector(
        towards, Math.max(spare * this.distanceFor(box, middle, towards), reach / 1000));
    this.camera.near = reach / 2000;
    this.camera.far = 20 * reach / Math.min(1, this.camera.aspect);
    this.camera.updateProjectionMatrix();
    this.controls.update();
    this.draw();
  }

  // From where all corners of the box are seen.
  distanceFor(box, middle, towards) {
    const right = this.camera.up.clone().cross(towards).normalize(), up = towards.clone().cross(right);
    const slope = Math.tan(this.camera.fov * Math.PI / 360);
    let distance = 0;
    for (let corner = 0; corner < 8; ++corner) {
      const p = new THREE.Vector3(box[corner & 1].x, box[corner >> 1 & 1].y, box[corner >> 2].z).sub(middle);
      const needed = Math.max(Math.abs(p.dot(up)), Math.abs(p.dot(right)) / this.camera.aspect) / slope;
      distance = Math.max(distance, p.dot(towards) + needed);
    }
    return distance;
  }

  // The frames of the files may be anywhere: what they hold, roughly.
  inputBox() {
    const low = new THREE.Vector3(Infinity, Infinity, Infinity), high = low.clone().negate();
    for (const scan of this.data.scans) {
      if (!scan.count || scan.group !== this.group) continue;
      const matrix = new THREE.Matrix4().fromArray(scan.input);
      for (const corner of [0, 1]) {
        const p = new THREE.Vector3(...scan.least.map((x, k) => x + corner * scan.size[k])).applyMatrix4(matrix);
        low.min(p);
        high.max(p);
      }
    }
    return [low, high];
  }

  setMode(mode) {
    this.mode = mode;
    this.draw();
  }

  setRegistered(registered) {
    this.registered = registered;
    this.clouds.forEach((cloud, i) => cloud.matrix.fromArray(this.data.scans[i][registered ? 'registered' : 'input']));
    this.look('oblique');
  }

  setGroup(group) {
    this.group = group;
    this.look('oblique');
  }

  isVisible(scan) {
    if (scan.group !== this.group) return false;
    if (this.selected === null) return scan.shown;
    const link = this.data.links[this.selected];
    return scan.number === link.a || scan.number === link.b;
  }

  resize() {
    const width = this.canvas.clientWidth, height = this.canvas.clientHeight;
    if (!width || !height) return;
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio || 1, 2));
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    this.draw();
  }

  draw() {
    const pixels = this.pointSize * this.canvas.height * this.reachOf(this.group) / 1100;
    this.clouds.forEach((cloud, i) => {
      cloud.visible = this.isVisible(this.data.scans[i]);
      cloud.material.uniforms.mode.value = this.mode;
      cloud.material.uniforms.pixels.value = pixels;
    });
    const drawn = this.registered && this.withLinks;
    this.lines.children.forEach(line => {
      const link = this.data.links[line.userData.link];
      const scans = [this.data.scans[link.a], this.data.scans[link.b]];
      const shown = s => s.group === this.group && (this.selected !== null || s.shown);
      line.visible = drawn && scans.every(shown) && (this.selected === null || line.userData.link === this.selected);
    });
    this.setups.children.forEach(mark => {
      mark.visible = this.registered && this.withSetups && this.isVisible(mark.userData.scan);
    });
    this.marks.visible = this.registered;
    this.renderer.render(this.scene, this.camera);
    if (this.onDraw) this.onDraw();
  }

  // In pixels of the page within the canvas; null behind the camera.
  onScreen(place) {
    const p = place.clone().project(this.camera);
    if (p.z > 1) return null;
    return [(p.x + 1) / 2 * this.canvas.clientWidth, (1 - p.y) / 2 * this.canvas.clientHeight];
  }

  // The link whose line is nearest to a place in the canvas, within a finger's breadth.
  linkAt(x, y) {
    let best = null, least = 14;
    for (const line of this.lines.children) {
      if (!line.visible) continue;
      const [a, b] = line.userData.ends.map(end => this.onScreen(end));
      if (!a || !b) continue;
      const along = [b[0] - a[0], b[1] - a[1]], square = along[0] ** 2 + along[1] ** 2;
      const t = square ? Math.min(1, Math.max(0, ((x - a[0]) * along[0] + (y - a[1]) * along[1]) / square)) : 0;
      const distance = Math.hypot(x - a[0] - t * along[0], y - a[1] - t * along[1]);
      if (distance < least) [least, best] = [distance, line.userData.link];
    }
    return best;
  }

  // Both ways the two scans of a link can slide, from where they meet; drawn long enough to be seen.
  select(number) {
    this.selected = number;
    this.marks.children.slice().forEach(mark => this.marks.remove(mark));
    const slide = number === null ? null : slideOf(this.data.links[number]);
    if (slide && slide.direction) {
      const direction = new THREE.Vector3(...slide.direction), from = new THREE.Vector3(...slide.centre);
      const reach = this.reachOf(this.group);
      for (const sign of [1, -1]) {
        this.marks.add(new THREE.ArrowHelper(direction.clone().multiplyScalar(sign), from, reach / 7, 0xc62828,
                                             reach / 40, reach / 60));
      }
    }
    this.draw();
  }
}
