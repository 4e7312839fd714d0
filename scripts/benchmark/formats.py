"""What reading costs by file format, with all that files hold of their points."""

import json

from benchmark.spent import run, say

HEADER = ("file", "bytes a point", "coordinates alone [million points/s]", "with attributes [million points/s]")


def measure(folder, read_formats, num_points):
    """Rows of HEADER, a file each; ours alone."""
    rows = []
    for line in run([read_formats, folder, num_points]).output.strip().splitlines():
        read = json.loads(line)
        speeds = [f"{read['points'] / read[part] / 1e6:.1f}" for part in ("coordinates_s", "all_s")]
        rows.append((read["file"], round(read["bytes"] / read["points"]), *speeds))
        say(" ".join(map(str, rows[-1])))
    return rows
