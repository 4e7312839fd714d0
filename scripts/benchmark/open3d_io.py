#!/usr/bin/env python3
"""open3d_io.py IN [OUT]: what benchmarks/cloud_io.cpp prints, for Open3D."""

import json
import sys
import time

import open3d

begin = time.process_time()
cloud = open3d.io.read_point_cloud(sys.argv[1])
read_s = time.process_time()
if len(sys.argv) > 2:
    open3d.io.write_point_cloud(sys.argv[2], cloud)
written_s = time.process_time()
print(json.dumps({"points": len(cloud.points), "read_s": read_s - begin, "write_s": written_s - read_s}))
