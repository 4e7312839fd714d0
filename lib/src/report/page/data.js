// Points and links as the report packs them.

function bytesOf(base64) {
  const text = atob(base64), bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  return bytes;
}

function readData() {
  const data = JSON.parse(document.getElementById('view-data').textContent);
  data.scans.forEach((scan, number) => {
    scan.number = number;
    scan.name = number + ' ' + scan.file;
    scan.xyz = new Uint16Array(bytesOf(scan.xyz).buffer);
    scan.distances = bytesOf(scan.distances);
    scan.shown = scan.count > 0;
  });
  return data;
}

// Where a scan stands in drawings: its scanner, where that is known, else the middle of its points.
const placeOf = scan => new THREE.Vector3(...(scan.setup || scan.middle));

function lengthText(metres) {
  const size = Math.abs(metres);
  if (size >= 10) return metres.toFixed(0) + ' m';
  if (size >= 1) return metres.toFixed(1) + ' m';
  if (size >= 0.1) return (100 * metres).toFixed(0) + ' cm';
  if (size >= 0.01) return (1000 * metres).toFixed(0) + ' mm';
  return (1000 * metres).toFixed(1) + ' mm';
}
