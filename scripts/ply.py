"""Reads and writes the vertices of binary PLY files. Needs numpy."""

import numpy as np

TYPES = {"char": "i1", "int8": "i1", "uchar": "u1", "uint8": "u1", "short": "i2", "int16": "i2", "ushort": "u2",
         "uint16": "u2", "int": "i4", "int32": "i4", "uint": "u4", "uint32": "u4", "float": "f4", "float32": "f4",
         "double": "f8", "float64": "f8"}


def read_header(f):
    """(format, number of vertices, [(name, numpy type) of each field]) of an open PLY, which is then at its data."""
    if f.readline().strip() != b"ply":
        raise ValueError(f"{f.name}: not a PLY file")
    fmt, count, fields, in_vertex = None, 0, [], False
    for line in iter(f.readline, b""):
        w = line.decode("ascii", "replace").split()
        if w[:1] == ["format"]:
            fmt = w[1]
        elif w[:1] == ["element"]:
            in_vertex = w[1] == "vertex"
            count = int(w[2]) if in_vertex else count
        elif w[:1] == ["property"] and in_vertex:
            fields.append((w[2], TYPES[w[1]]))
        elif w == ["end_header"]:
            break
    return fmt, count, fields


def read_ply(path):
    """The vertices of a binary PLY as a structured array."""
    with open(path, "rb") as f:
        fmt, count, fields = read_header(f)
        if fmt not in ("binary_little_endian", "binary_big_endian"):
            raise ValueError(f"{path}: only binary PLY is read, this is {fmt}")
        end = "<" if fmt == "binary_little_endian" else ">"
        dtype = np.dtype([(n, end + t) for n, t in fields])
        return np.frombuffer(f.read(count * dtype.itemsize), dtype=dtype)


def header_of_points(count, scalar):
    """The header of a binary PLY of x, y, z, as float or double."""
    fields = "".join(f"property {scalar} {axis}\n" for axis in "xyz")
    return f"ply\nformat binary_little_endian 1.0\nelement vertex {count}\n{fields}end_header\n".encode()


def coordinates(vertices):
    return np.stack([vertices["x"], vertices["y"], vertices["z"]], 1).astype(float)


def read_points(path):
    """(N, 3) points; those that are not finite are left out."""
    points = coordinates(read_ply(path))
    return points[np.isfinite(points).all(1)]


def write_points(path, points):
    """Binary PLY with x, y, z as doubles."""
    with open(path, "wb") as f:
        f.write(header_of_points(len(points), "double"))
        f.write(np.ascontiguousarray(points, "<f8").tobytes())
