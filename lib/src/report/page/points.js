// The points of a scan on the graphics card, and what colours them.

const kByScan = 0, kByHeight = 1, kByDistance = 2;

const vertexShader = `
  attribute float distanceCode;
  uniform mat4 registered;
  uniform vec3 least, size, colour;
  uniform float pixels, heightLow, heightHigh;
  uniform int mode;
  varying vec3 shade;
  vec3 ramp(float t) {  // dark blue, green, yellow, red: even in brightness to the eye
    t = clamp(t, 0.0, 1.0);
    vec3 low = mix(vec3(0.19, 0.28, 0.60), vec3(0.13, 0.63, 0.53), clamp(3.0 * t, 0.0, 1.0));
    vec3 middle = mix(low, vec3(0.98, 0.85, 0.22), clamp(3.0 * t - 1.0, 0.0, 1.0));
    return mix(middle, vec3(0.80, 0.13, 0.10), clamp(3.0 * t - 2.0, 0.0, 1.0));
  }
  void main() {
    vec3 inScan = least + position * size;
    vec4 eye = modelViewMatrix * vec4(inScan, 1.0);
    gl_Position = projectionMatrix * eye;
    gl_PointSize = clamp(pixels * projectionMatrix[1][1] / -eye.z, 1.0, 6.0);
    float height = ((registered * vec4(inScan, 1.0)).z - heightLow) / max(heightHigh - heightLow, 1e-6);
    if (mode == ${kByScan}) shade = colour * (0.72 + 0.38 * clamp(height, 0.0, 1.0));
    if (mode == ${kByHeight}) shade = ramp(height);
    if (mode == ${kByDistance}) {
      float d = distanceCode / 254.0;
      shade = distanceCode > 254.5 ? vec3(0.62, 0.65, 0.68) : ramp(d);
    }
  }`;

const fragmentShader = `
  varying vec3 shade;
  void main() {
    vec2 from = gl_PointCoord - 0.5;
    if (dot(from, from) > 0.25) discard;
    gl_FragColor = vec4(shade, 1.0);
  }`;

function pointsOf(scan, data) {
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute('position', new THREE.BufferAttribute(scan.xyz, 3, true));
  geometry.setAttribute('distanceCode', new THREE.BufferAttribute(scan.distances, 1, false));
  const material = new THREE.ShaderMaterial({
    vertexShader, fragmentShader,
    uniforms: {
      registered: {value: new THREE.Matrix4().fromArray(scan.registered)},
      least: {value: new THREE.Vector3(...scan.least)}, size: {value: new THREE.Vector3(...scan.size)},
      colour: {value: new THREE.Color(scan.colour)}, mode: {value: kByScan}, pixels: {value: 1},
      heightLow: {value: data.groups[scan.group].box[0][2]}, heightHigh: {value: data.groups[scan.group].box[1][2]},
    },
  });
  const points = new THREE.Points(geometry, material);
  points.frustumCulled = false;  // the shader knows where they are, three.js does not
  points.matrixAutoUpdate = false;
  points.matrix.fromArray(scan.registered);
  return points;
}
